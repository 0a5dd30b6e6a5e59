# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a user may ask of a lattice that is not the same everywhere, and what follows from it."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .errors import VolfrepError
from .law import Law
from .mapping import (
    Base,
    LatticeMap,
    block_stretch,
    frame_about,
    mapped_box,
    part_stretch,
    rotation,
)
from .point_field import PointField, TransferCurve, default_curve, read_point_field

Floats = NDArray[np.float64]
Vector = tuple[float, float, float]

MAPS = ("cartesian", "cylindrical", "spherical")
RADIUS_BY = ("direction", "skin", "core", "field")
#: Fewest cells around a full turn: with fewer, a cell would be its own neighbour's neighbour.
LEAST_AROUND = 4
MOST_AROUND = 100_000


@dataclass(frozen=True)
class SizeGrading:
    """Cells that grow along a direction: the published grading (section 2.5 of the paper).

    Attributes:
        law: lambda over s, the place along the direction from 0 to 1.
        direction: g, of any length.
    """

    law: Law
    direction: Vector = (1.0, 0.0, 0.0)

    def __post_init__(self) -> None:
        check_vector("grading direction", self.direction)


@dataclass(frozen=True)
class RadiusGrading:
    """Struts whose radius varies from node to node, and linearly between.

    Attributes:
        by: ``direction``: over the place s along a direction. ``skin``: over the depth below the
            part's surface, s = 1 at the surface and 0 at `reach` and deeper. ``core``: the
            reverse, s = 0 at the surface. ``field``: from a field of values at points.
        law: the radius in mm over s; for a field, its ends are the radii of the field's smallest
            and largest value.
        direction: of any length.
        reach: depth in mm at which the law ends.
        field: the values, or the file that holds them.
        column: which values of the file.
        curve: (value, radius in mm) pairs, rising in value, to use instead of the law.
    """

    by: str
    law: Law
    direction: Vector = (1.0, 0.0, 0.0)
    reach: float = 5.0
    field: PointField | str | None = field(default=None, compare=False)
    column: str | None = None
    curve: tuple[tuple[float, float], ...] = ()

    def __post_init__(self) -> None:
        if self.by not in RADIUS_BY:
            raise VolfrepError(
                f"The radius cannot be graded by '{self.by}': choose {', '.join(RADIUS_BY)}."
            )
        check_vector("radius grading direction", self.direction)
        if not (math.isfinite(self.reach) and self.reach > 0):
            raise VolfrepError(
                f"The depth that the radius is graded over must be above 0 mm, not {self.reach:g}."
            )
        if self.by == "field" and self.field is None:
            raise VolfrepError(
                "A radius graded by a field needs one: name a CSV or VTK file with x, y, z and a "
                "value, or choose a FEM result."
            )
        if self.curve:
            _ = self._transfer()

    @property
    def extremes(self) -> tuple[float, float]:
        """The smallest and the largest radius that can come out, mm."""
        if self.by == "field" and self.curve:
            radii = [radius for _, radius in self.curve]
            return min(radii), max(radii)
        return self.law.extremes()

    def _transfer(self) -> TransferCurve:
        values, radii = np.array(self.curve, float).reshape(-1, 2).T
        return TransferCurve(values, radii)

    def radii(self, points: Floats, bounds: Floats, depth: Callable[[Floats], Floats]) -> Floats:
        """(n,) radius of the struts at (n, 3) points, mm.

        Args:
            points: of the part, mm.
            bounds: (2, 3) the part's box, mm.
            depth: gives the depth below the part's surface of points, mm; not above 0 outside.
        """
        if self.by == "direction":
            ends = np.sort(bounds * np.asarray(self.direction), axis=0).sum(axis=1)
            return self.law((points @ np.asarray(self.direction) - ends[0]) / (ends[1] - ends[0]))
        if self.by == "field":
            values = self.field
            if isinstance(values, str):
                values = read_point_field(values, self.column)
            assert values is not None
            if self.curve:
                return self._transfer()(values(points))
            ends = default_curve(values.values, self.law.start, self.law.end)
            return ends(values(points))
        s = np.clip(depth(points) / self.reach, 0.0, 1.0)
        return self.law(1.0 - s if self.by == "skin" else s)


@dataclass(frozen=True)
class CellMap:
    """Cells about an axis or a centre.

    Attributes:
        kind: ``cylindrical`` (cells along radius, angle and axis) or ``spherical`` (along radius,
            angle from the axis, angle around it).
        centre: a point of the axis, or the centre; None: the middle of the part's box.
        axis: of any length.
        around: cells around the full turn; None: as many as make them L wide half-way out.
    """

    kind: str
    centre: Vector | None = None
    axis: Vector = (0.0, 0.0, 1.0)
    around: int | None = None

    def __post_init__(self) -> None:
        if self.kind not in MAPS[1:]:
            raise VolfrepError(
                f"There is no cell map '{self.kind}': choose {' or '.join(MAPS[1:])}."
            )
        if self.centre is not None:
            check_point("centre of the cell map", self.centre)
        check_vector("axis of the cell map", self.axis)
        if self.around is not None and (
            self.around != int(self.around) or not LEAST_AROUND <= self.around <= MOST_AROUND
        ):
            raise VolfrepError(
                f"The cells around must be a whole number from {LEAST_AROUND} to {MOST_AROUND}, "
                f"not {self.around:g}."
            )


@dataclass(frozen=True)
class Orientation:
    """The lattice turned, and not the part.

    Attributes:
        axis: of the rotation, of any length.
        angle: in degrees, counter-clockwise seen against the axis.
        origin: a point of the axis; None: the middle of the part's box.
    """

    axis: Vector = (0.0, 0.0, 1.0)
    angle: float = 0.0
    origin: Vector | None = None

    def __post_init__(self) -> None:
        check_vector("axis of the rotation", self.axis)
        if not math.isfinite(self.angle):
            raise VolfrepError(f"The rotation must be a finite angle, not {self.angle}.")
        if self.origin is not None:
            check_point("origin of the rotation", self.origin)

    @property
    def matrix(self) -> Floats:
        """(3, 3) the rotation."""
        return rotation(np.array(self.axis, float), math.radians(self.angle))


def lattice_map(
    cell_size: float,
    bounds: Floats,
    size: SizeGrading | None,
    cells: CellMap | None,
    turned: Orientation | None,
    *,
    block: bool = False,
) -> LatticeMap:
    """The map from lattice space to the part.

    Args:
        cell_size: L, mm.
        bounds: (2, 3) box of the part; of a block, in lattice space; mm.
        size: the size grading.
        cells: the cell map.
        turned: the orientation; it turns the axis of a cell map too.
        block: whether the lattice is a block of given cells, whose box grows with the grading,
            instead of what fills the box.

    Raises:
        VolfrepError: the size grading folds space.
    """
    middle = bounds.mean(axis=0)
    frame, centre = np.eye(3), np.zeros(3)
    if cells is not None:
        frame = frame_about(np.array(cells.axis, float))
        fallback = np.zeros(3) if block else middle
        centre = fallback if cells.centre is None else np.array(cells.centre, float)
    if turned is not None and math.fmod(turned.angle, 360.0):
        origin = middle if turned.origin is None else np.array(turned.origin, float)
        if cells is not None and turned.origin is None:
            origin = centre
        frame = turned.matrix @ frame
        centre = origin + turned.matrix @ (centre - origin)
    kind = "cartesian" if cells is None else cells.kind
    around = 0
    if cells is not None:
        around = cells.around or _cells_around(cells.kind, cell_size, bounds, centre, frame)
    base = Base(kind, centre, frame, around, cell_size)
    if size is None:
        return LatticeMap(base)
    direction = np.array(size.direction, float) / np.linalg.norm(size.direction)
    if block:
        box = mapped_box(base.to_part, bounds)
        return LatticeMap(base, block_stretch(direction, size.law, box))
    return LatticeMap(base, part_stretch(direction, size.law, bounds, cell_size))


def _cells_around(
    kind: str, cell_size: float, bounds: Floats, centre: Floats, frame: Floats
) -> int:
    """So many cells that they are L wide half-way between the nearest and the farthest corner."""
    corners = np.stack(np.meshgrid(*bounds.T), axis=-1).reshape(-1, 3)
    local = (corners - centre) @ frame
    count = 2 if kind == "cylindrical" else 3
    outermost = float(np.linalg.norm(local[:, :count], axis=1).max())
    return int(np.clip(round(2.0 * np.pi * 0.5 * outermost / cell_size), LEAST_AROUND, MOST_AROUND))


def check_point(name: str, point: Sequence[float]) -> None:
    """Refuse what is not three finite coordinates."""
    if len(point) != 3 or not all(math.isfinite(c) for c in point):
        raise VolfrepError(f"The {name} must be three finite coordinates, not {tuple(point)}.")


def check_vector(name: str, vector: Sequence[float]) -> None:
    """Refuse what has no direction."""
    check_point(name, vector)
    if math.hypot(*vector) < 1e-9:
        raise VolfrepError(f"The {name} must have a length above 0, not {tuple(vector)}.")


def as_plain(value: Any) -> Any:
    """A grading as plain JSON values."""
    if isinstance(value, Law):
        return value.as_dict()
    if isinstance(value, PointField):
        return f"{len(value.values)} points" + f" of {value.source}" * bool(value.source)
    if hasattr(value, "as_plain"):
        return value.as_plain()
    if hasattr(value, "__dataclass_fields__"):
        return {name: as_plain(getattr(value, name)) for name in value.__dataclass_fields__}
    if isinstance(value, tuple):
        return [as_plain(item) for item in value]
    return value

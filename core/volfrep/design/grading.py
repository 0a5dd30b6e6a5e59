# SPDX-License-Identifier: LGPL-2.1-or-later
"""Grading: sizes and radii that vary over the part, cells about an axis or a centre, rotation.

Radii live at nodes: struts are cones between them, the same from both cells that share a node.
Struts stay round by default; the published way stretches them with their cells, so that no strut
has the radius that was asked for.
"""

from __future__ import annotations

import math
import os
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..util.errors import VolfrepError, listed
from ..util.linalg import along, rotation, times
from ..util.numbers import direction, number, point, whole
from ..util.types import Floats
from .profile import Profile
from .sampled_field import SampledField
from .scattered_field import PointField, TransferCurve, default_curve

Vector = tuple[float, float, float]
#: What a quantity may follow: values at points, or samples of a function.
Field = PointField | SampledField

MAPS = ("cartesian", "cylindrical", "spherical")
RADIUS_BY = ("direction", "skin", "core", "field")
#: Fewest cells around a full turn: with fewer, a cell would be its own neighbour's neighbour.
LEAST_AROUND = 4
MOST_AROUND = 100_000


@dataclass(frozen=True)
class SizeGrading:
    """Cells that grow along a direction: the published grading (section 2.5 of the paper).

    Attributes:
        profile: lambda over s, the place along the direction from 0 to 1.
        direction: g, of any length.

    >>> SizeGrading(Profile("linear", 1, 2), (0, 0, 1)).profile.end
    2.0
    """

    profile: Profile
    direction: Vector = (1.0, 0.0, 0.0)

    def __post_init__(self) -> None:
        direction("grading direction", self.direction)
        as_tuples(self, "direction")


def read_point_field(path: str | os.PathLike[str], column: str | None = None) -> PointField:
    """Read a field from a table of points (CSV, text) or from a VTK file (.vtk, .vtu).

    Args:
        path: the file; what `volfrep.design.field_files` says of its formats holds.
        column: name of the column or point data array that holds the value; may be left out
            when there is only one.

    Raises:
        VolfrepError: naming the file, the line where there is one, and what is wrong.
    """
    from .field_files import read_points  # reads many formats, slow to import

    return PointField(*read_points(path, column), source=os.fspath(path))


@dataclass(frozen=True)
class RadiusGrading:
    """Struts whose radius varies from node to node, and linearly between.

    Attributes:
        by: ``direction``: over the place s along a direction. ``skin``: over the depth below the
            part's surface, s = 1 at the surface and 0 at `reach` and deeper. ``core``: the
            reverse, s = 0 at the surface. ``field``: from a field of values at points.
        profile: the radius in mm over s; for a field, its ends are the radii of its smallest
            and largest value.
        direction: of any length.
        reach: depth in mm at which the profile ends.
        field: the values; or the file that holds them, which is read here and now.
        column: which values of the file.
        curve: (value, radius in mm) pairs, rising in value, to use instead of the profile.
    """

    by: str
    profile: Profile
    direction: Vector = (1.0, 0.0, 0.0)
    reach: float = 5.0
    field: Field | str | None = None
    column: str | None = None
    curve: tuple[tuple[float, float], ...] = ()

    def __post_init__(self) -> None:
        if self.by not in RADIUS_BY:
            raise VolfrepError(
                f"The radius cannot be graded by '{self.by}': choose {', '.join(RADIUS_BY)}."
            )
        direction("radius grading direction", self.direction)
        as_tuples(self, "direction")
        object.__setattr__(self, "curve", tuple(tuple(pair) for pair in self.curve))
        number("depth that the radius is graded over", self.reach, "mm", positive=True)
        if self.by == "field" and self.field is None:
            raise VolfrepError(
                "A radius graded by a field needs one: name a CSV or VTK file with x, y, z and a "
                "value, or choose a FEM result."
            )
        if self.by == "field" and isinstance(self.field, str):
            object.__setattr__(self, "field", read_point_field(self.field, self.column))
        if self.curve:
            _ = self._transfer()

    @property
    def extremes(self) -> tuple[float, float]:
        """The smallest and the largest radius that can come out, mm."""
        if self.by == "field" and self.curve:
            radii = [radius for _, radius in self.curve]
            return min(radii), max(radii)
        return self.profile.extremes()

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
            return self.profile(
                (along(points, np.asarray(self.direction)) - ends[0]) / (ends[1] - ends[0])
            )
        if self.by == "field":
            values = self.field
            assert isinstance(values, Field)
            if self.curve:
                return self._transfer()(values(points))
            ends = default_curve(values.range, self.profile.start, self.profile.end)
            return ends(values(points))
        s = np.clip(depth(points) / self.reach, 0.0, 1.0)
        return self.profile(1.0 - s if self.by == "skin" else s)


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
            raise VolfrepError(f"There is no cell map '{self.kind}': choose {listed(MAPS[1:])}.")
        if self.centre is not None:
            point("centre of the cell map", self.centre)
        direction("axis of the cell map", self.axis)
        as_tuples(self, "axis", "centre")
        if self.around is not None:
            whole("number of cells around", self.around, LEAST_AROUND, MOST_AROUND)

    def cells_around(self, cell_size: float, bounds: Floats, centre: Floats, frame: Floats) -> int:
        """`around`, or as many as are L wide half-way from the axis to the farthest corner.

        Args:
            cell_size: L, mm.
            bounds: (2, 3) box of the part, mm.
            centre: (3,) where the axis or the centre lies, mm.
            frame: (3, 3) the map's axes as columns; the last one is the axis.
        """
        if self.around is not None:
            return self.around
        corners = np.stack(np.meshgrid(*bounds.T), axis=-1).reshape(-1, 3)
        local = times(corners - centre, frame)
        count = 2 if self.kind == "cylindrical" else 3
        outermost = float(np.linalg.norm(local[:, :count], axis=1).max())
        wanted = round(2.0 * np.pi * 0.5 * outermost / cell_size)
        return int(np.clip(wanted, LEAST_AROUND, MOST_AROUND))


@dataclass(frozen=True)
class Orientation:
    """The lattice turned, and not the part.

    Attributes:
        axis: of the rotation, of any length.
        angle: in degrees, counter-clockwise seen against the axis.
        origin: a point of the axis; None: the middle of the part's box.

    >>> (Orientation(axis=(0, 0, 1), angle=90).matrix @ [1, 0, 0]).round(9).tolist()
    [0.0, 1.0, 0.0]
    """

    axis: Vector = (0.0, 0.0, 1.0)
    angle: float = 0.0
    origin: Vector | None = None

    def __post_init__(self) -> None:
        direction("axis of the rotation", self.axis)
        number("angle of the rotation", self.angle, "degrees", positive=None)
        if self.origin is not None:
            point("origin of the rotation", self.origin)
        as_tuples(self, "axis", "origin")

    @property
    def matrix(self) -> Floats:
        """(3, 3) the rotation."""
        return rotation(np.array(self.axis, float), math.radians(self.angle))


def as_tuples(part: object, *names: str) -> None:
    """Sequences that a part of a specification was given, as tuples, which can be hashed."""
    for name in names:
        value = getattr(part, name)
        if value is not None:
            object.__setattr__(part, name, tuple(value))


def as_json(value: Any) -> Any:
    """A grading as plain JSON values, which files hold that are handed on: no folders."""
    if isinstance(value, Profile):
        return value.as_dict()
    if isinstance(value, PointField):
        return f"{len(value.values)} points" + f" of {Path(value.source).name}" * bool(value.source)
    if hasattr(value, "as_json"):
        return value.as_json()
    if hasattr(value, "__dataclass_fields__"):
        return {name: as_json(getattr(value, name)) for name in value.__dataclass_fields__}
    if isinstance(value, tuple):
        return [as_json(item) for item in value]
    return value

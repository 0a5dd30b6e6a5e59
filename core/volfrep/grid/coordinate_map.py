# SPDX-License-Identifier: LGPL-2.1-or-later
"""Coordinate maps: from lattice space, where all cells are equal cubes, to the part and back.

One map serves the cells' activation, the wireframe and the vertices, so that what is counted, drawn
and meshed agrees. It is a base (turned Cartesian, cylindrical or spherical cells) followed by the
size grading along a direction (Eq. 11-13 of the VOLFREP paper).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..design.grading import CellMap, Orientation, SizeGrading
from ..design.profile import Profile
from ..mesh.triangle_mesh import TriangleMesh
from ..util.errors import VolfrepError
from ..util.linalg import along, frame_about, times
from ..util.types import Floats

#: Points along the grading at which its monotony is looked at and its inverse is tabulated.
TABLE = 8192
#: Step of the difference quotients that make the Jacobian, in units of L.
DIFFERENCE = 1e-5
#: A triangle's edge is split where its middle is mapped this far beside the middle of its mapped
#: ends, in units of L; and where it is longer than `LONGEST_EDGE` L.
STRAIGHT = 0.01
LONGEST_EDGE = 4.0
MOST_SPLITS = 12
SMALLEST_EDGE = 0.05
BOX_POINTS = 33


@dataclass(frozen=True, eq=False)
class Base:
    """Cells along x, y, z of a turned frame; or along radius, angle, axis; or radius, two angles.

    Attributes:
        kind: ``cartesian``, ``cylindrical`` or ``spherical``.
        centre: (3,) where the frame lies, mm.
        frame: (3, 3) its axes as columns.
        around: cells around the full turn (cylindrical and spherical).
        cell_size: L, mm.
    """

    kind: str
    centre: Floats
    frame: Floats
    around: int
    cell_size: float

    @property
    def periodic(self) -> tuple[bool, bool, bool]:
        """Along which axes of lattice space the cells close upon themselves."""
        return (False, self.kind == "cylindrical", self.kind == "spherical")

    @property
    def turn(self) -> float:
        """Length of the full turn in lattice space, mm."""
        return self.around * self.cell_size

    def to_part(self, points: Floats) -> Floats:
        """(n, 3) points of lattice space in the part, mm."""
        if self.kind == "cartesian":
            local = points
        else:
            angle = points * (2.0 * np.pi / self.turn)
            radius = points[:, 0]
            if self.kind == "cylindrical":
                across, along = radius, points[:, 2]
                azimuth = angle[:, 1]
            else:
                across, along = radius * np.sin(angle[:, 1]), radius * np.cos(angle[:, 1])
                azimuth = angle[:, 2]
            local = np.stack([across * np.cos(azimuth), across * np.sin(azimuth), along], axis=1)
        result: Floats = times(local, self.frame.T) + self.centre
        return result

    def to_lattice(self, points: Floats) -> Floats:
        """(n, 3) points of the part in lattice space; angles from 0 to the full turn."""
        local = times(points - self.centre, self.frame)
        if self.kind == "cartesian":
            return local
        scale = self.turn / (2.0 * np.pi)
        azimuth = np.mod(np.arctan2(local[:, 1], local[:, 0]), 2.0 * np.pi) * scale
        across = np.hypot(local[:, 0], local[:, 1])
        if self.kind == "cylindrical":
            return np.stack([across, azimuth, local[:, 2]], axis=1)
        radius = np.hypot(across, local[:, 2])
        return np.stack([radius, np.arctan2(across, local[:, 2]) * scale, azimuth], axis=1)


@dataclass(frozen=True, eq=False)
class Stretch:
    """The published size grading: s moves to s lambda(s), rescaled to the part's box (Eq. 11-13).

    Attributes:
        direction: (3,) unit vector g.
        start: position of the near end along g, mm.
        before: length along g before the stretch, mm.
        length: the same after it, mm.
        at: `TABLE` + 1 normalised positions from 0 to 1.
        profile: lambda at them and between.
        moved: where they go, from 0 to 1.
    """

    direction: Floats
    start: float
    before: float
    length: float
    profile: Profile
    at: Floats
    moved: Floats

    def to_part(self, points: Floats) -> Floats:
        """(n, 3) points moved along the direction; beyond the ends with the slope they have."""
        position = along(points, self.direction)
        t = (position - self.start) / self.before
        inside = np.clip(t, 0.0, 1.0)
        moved = inside * self.profile(inside) / self.profile.end
        moved += np.minimum(t, 0.0) * self._slope(0) + np.maximum(t - 1.0, 0.0) * self._slope(-1)
        new = self.start + self.length * moved
        result: Floats = points + (new - position)[:, None] * self.direction
        return result

    def to_lattice(self, points: Floats) -> Floats:
        """The inverse, by the table: good to some 1e-8 of the length."""
        position = along(points, self.direction)
        moved = (position - self.start) / self.length
        t = np.interp(moved, self.moved, self.at)
        t += np.minimum(moved, 0.0) / self._slope(0)
        t += np.maximum(moved - 1.0, 0.0) / self._slope(-1)
        new = self.start + self.before * t
        result: Floats = points + (new - position)[:, None] * self.direction
        return result

    def _slope(self, end: int) -> float:
        return float(np.diff(self.moved)[end] * TABLE)


def part_stretch(direction: Floats, profile: Profile, bounds: Floats, cell_size: float) -> Stretch:
    """The size grading that fills a part's box.

    The lattice is laid as long as it takes for cells of L lambda(0) at the near end; along an
    axis of the box that is a whole number of cells.

    Args:
        direction: (3,) unit vector g.
        profile: lambda over the normalised position.
        bounds: (2, 3) the part's box, mm.
        cell_size: L, mm.

    Raises:
        VolfrepError: the profile folds space.
    """
    start, length = _extent(direction, bounds)
    before = length / profile.end
    if np.abs(direction).max() > 1.0 - 1e-12:
        before = cell_size * max(1, round(before / cell_size))
    return _stretch(direction, profile, start, before, length)


def block_stretch(direction: Floats, profile: Profile, bounds: Floats) -> Stretch:
    """The size grading of a block of given cells, whose box grows: see `part_stretch`."""
    start, before = _extent(direction, bounds)
    return _stretch(direction, profile, start, before, before * profile.end)


def _extent(direction: Floats, bounds: Floats) -> tuple[float, float]:
    """Where a box begins along a direction, and how long it is."""
    ends = np.sort(bounds * direction, axis=0).sum(axis=1)
    return float(ends[0]), float(ends[1] - ends[0])


def _stretch(
    direction: Floats, profile: Profile, start: float, before: float, length: float
) -> Stretch:
    at = np.linspace(0.0, 1.0, TABLE + 1)
    moved = at * profile(at) / profile.end
    folds = np.diff(moved) <= 0.0
    if folds.any():
        raise VolfrepError(
            f"The size grading folds the lattice at s = {at[folds.argmax()]:.3g}: s times lambda "
            "must rise all the way, so let it fall less steeply (a linear one to more than half)."
        )
    return Stretch(direction, start, before, length, profile, at, moved)


@dataclass(frozen=True, eq=False)
class CoordinateMap:
    """The whole way from lattice space to the part.

    Attributes:
        base: where the cells lie.
        stretch: the size grading after it; None for none.
    """

    base: Base
    stretch: Stretch | None = None

    @property
    def is_identity(self) -> bool:
        """Whether lattice space is the part's own."""
        base = self.base
        plain = base.kind == "cartesian" and not base.centre.any()
        return plain and self.stretch is None and bool((base.frame == np.eye(3)).all())

    @property
    def is_rigid(self) -> bool:
        """Whether cells keep their shape."""
        return self.base.kind == "cartesian" and self.stretch is None

    def to_part(self, points: Floats) -> Floats:
        """(n, 3) points of lattice space in the part, mm."""
        moved = self.base.to_part(points)
        return moved if self.stretch is None else self.stretch.to_part(moved)

    def to_lattice(self, points: Floats) -> Floats:
        """(n, 3) points of the part in lattice space; angles from 0 to the full turn."""
        if self.stretch is not None:
            points = self.stretch.to_lattice(points)
        return self.base.to_lattice(points)

    def jacobians(self, points: Floats) -> Floats:
        """(n, 3, 3) derivatives of `to_part` at points of lattice space; columns are its axes'."""
        step = DIFFERENCE * self.base.cell_size
        columns = []
        for axis in range(3):
            ahead, behind = points.copy(), points.copy()
            ahead[:, axis] += step
            behind[:, axis] -= step
            columns.append((self.to_part(ahead) - self.to_part(behind)) / (2.0 * step))
        return np.stack(columns, axis=2)

    def unwrapped(self, points: Floats) -> Floats:
        """Points of lattice space, each row's angles within half a turn of its first point's.

        Args:
            points: (n, k, 3).
        """
        result = points.copy()
        for axis in np.flatnonzero(self.base.periodic):
            away = points[:, :, axis] - points[:, :1, axis]
            turn = self.base.turn
            result[:, :, axis] = points[:, :1, axis] + away - turn * np.round(away / turn)
        return result


def identity_map(cell_size: float) -> CoordinateMap:
    """The map of cells along x, y, z, which changes nothing."""
    return CoordinateMap(Base("cartesian", np.zeros(3), np.eye(3), 0, cell_size))


def mapped_box(place: Callable[[Floats], Floats], bounds: Floats) -> Floats:
    """(2, 3) box of what a map makes of a (2, 3) box, by `BOX_POINTS` points along its edges."""
    axes = [np.linspace(bounds[0, k], bounds[1, k], BOX_POINTS) for k in range(3)]
    points = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    placed = place(points)
    return np.stack([placed.min(axis=0), placed.max(axis=0)])


def triangles_in_lattice(mesh: TriangleMesh, mapping: CoordinateMap) -> Floats:
    """(m, 3, 3) corners in lattice space of a mesh's triangles, split until straight there.

    They cover the surface but do not join up: for telling which cells it crosses.
    """
    corners = mesh.vertices[mesh.triangles]
    size = mapping.base.cell_size
    if mapping.is_rigid:
        return mapping.to_lattice(corners.reshape(-1, 3)).reshape(-1, 3, 3)
    done = []
    for round_ in range(MOST_SPLITS + 1):
        middle = 0.5 * (corners + np.roll(corners, -1, axis=1))
        both = np.concatenate([corners, middle], axis=1)
        there = mapping.unwrapped(mapping.to_lattice(both.reshape(-1, 3)).reshape(-1, 6, 3))
        ends, middles = there[:, :3], there[:, 3:]
        following = np.roll(ends, -1, axis=1)
        beside = np.linalg.norm(middles - 0.5 * (ends + following), axis=2).max(axis=1)
        longest = np.linalg.norm(following - ends, axis=2).max(axis=1)
        short = np.linalg.norm(np.roll(corners, -1, axis=1) - corners, axis=2).max(axis=1)
        split = (beside > STRAIGHT * size) | (longest > LONGEST_EDGE * size)
        # About an axis nothing is ever straight, and no cell is as small.
        split &= short > SMALLEST_EDGE * size
        if round_ == MOST_SPLITS:
            split[:] = False
        done.append(ends[~split])
        if not split.any():
            break
        (a, b, c), (ab, bc, ca) = corners[split].swapaxes(0, 1), middle[split].swapaxes(0, 1)
        corners = np.concatenate(
            [np.stack(t, axis=1) for t in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))]
        )
    return np.concatenate(done)


def lattice_map(
    cell_size: float,
    bounds: Floats,
    size: SizeGrading | None,
    cells: CellMap | None,
    turned: Orientation | None,
    *,
    block: bool = False,
) -> CoordinateMap:
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
        frame = times(turned.matrix, frame)
        centre = origin + times(centre - origin, turned.matrix.T)
    kind = "cartesian" if cells is None else cells.kind
    around = 0
    if cells is not None:
        around = cells.cells_around(cell_size, bounds, centre, frame)
    base = Base(kind, centre, frame, around, cell_size)
    if size is None:
        return CoordinateMap(base)
    direction = np.array(size.direction, float) / np.linalg.norm(size.direction)
    if block:
        box = mapped_box(base.to_part, bounds)
        return CoordinateMap(base, block_stretch(direction, size.profile, box))
    return CoordinateMap(base, part_stretch(direction, size.profile, bounds, cell_size))

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Depth: the distance of points below a solid's surface, and where the offset wall runs.

A skin with open faces (`OpenDepth`) has as its cavity all that is deep enough below the other
faces. It reaches half a thickness beyond the open ones, so that nothing of it coincides with them
and nothing outside the part is in it that is not in front of an open face: cut at the part's
surface, it opens there.

A skin that is not alike everywhere (`SheetDepth`) has its thickness below each group of faces: the
cavity is what is farther from every group than that group's length. So the wall is a level set of
one function that changes no faster than one goes, the largest of (length - distance): it cannot
cross itself, and where a thick skin ends beside a thin one it is rounded off by its own thickness,
as a ball that rolls along the edge of the thick faces leaves it.

A skin whose thickness follows a field has its wall where the depth is the thickness of that place
(`thickness_field`).
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ..design.skins.own_faces import Thicknesses
from ..mesh.triangle_mesh import TriangleMesh
from ..spatial.proximity import SharedIndex, SurfaceIndex, index_surface, near_shared
from ..spatial.rays import inside_points
from ..util.progress import Monitor
from ..util.types import Bools, Floats
from .thickness_field import STEEPEST, ThicknessField

#: Points of one step between two looks at the cancel button.
POINTS_PER_STEP = 40_000
#: Points that a worker is asked for at a time, and a quarter of these where they are few; what is
#: no more is looked up here.
POINTS_PER_CALL = 1 << 11
#: How far the cavity reaches beyond the open faces, in thicknesses of the skin.
BEYOND = 0.5


@dataclass(frozen=True, eq=False)
class Depth:
    """Distance to the outer surface, for points of a solid with a wall.

    Attributes:
        index: the outer surface.
        thickness: of the wall, mm; of one that follows a field the least.
        monitor: asked for a cancel between steps.
        lengths: the field that the thickness follows; None for one thickness.
        shared: the index for the monitor's backend; None: threads look up the distances.
    """

    index: SurfaceIndex
    thickness: float
    monitor: Monitor
    lengths: ThicknessField | None = field(default=None, kw_only=True)
    shared: SharedIndex | None = field(default=None, kw_only=True)

    def nearest(self, points: Floats) -> tuple[Floats, Floats]:
        """(n, 3) closest points of the outer surface and (n,) distances, not signed, mm."""
        parts, shared = [], self.shared
        step = min(POINTS_PER_CALL, max(len(points), POINTS_PER_CALL) // 4)
        if shared is None or len(points) <= step:
            for start in range(0, len(points), POINTS_PER_STEP):
                self.monitor.tick()
                parts.append(self.index.near(points[start : start + POINTS_PER_STEP]))
        else:
            starts = range(0, len(points), step)
            given = ((shared, points[start : start + step]) for start in starts)
            for found in self.monitor.backend.starmap(near_shared, given):
                self.monitor.tick()
                parts.append(found)
        if not parts:
            return np.zeros((0, 3)), np.zeros(0)
        closest, distance = (np.concatenate(values) for values in zip(*parts, strict=True))
        return closest, distance

    @property
    def steepest(self) -> float:
        """By so much the values change with the way, at most."""
        return 1.0 if self.lengths is None else STEEPEST

    @property
    def inset(self) -> float:
        """The wall lies so far inside the box of the solid, at least, mm."""
        return self.thickness

    @property
    def error(self) -> float:
        """By so much the depth of a point inside, about as deep as the wall, may be too large.

        See `SurfaceIndex.near`; mm.
        """
        spacing = self.index.spacing
        return 0.1 * spacing + 0.3 * spacing**2 / self.thickness

    def values(
        self, points: Floats, inside: Bools | None = None, unknown: Bools | None = None
    ) -> tuple[Floats, Floats]:
        """Thickness less depth at points (n, 3), mm, and its gradients (n, 3).

        Below 0 inside the inner wall. `inside` (n,) tells which points are inside the solid;
        None: all. Of the `unknown` ones (n,) the surface next to them tells it; None: of none.
        """
        closest, distance = self.nearest(points)
        if inside is not None and unknown is not None:
            # Nearer than the wall it does not matter.
            asked = np.flatnonzero(unknown & (distance >= 0.99 * self.thickness))
            inside = inside.copy()
            inside[asked] = self.index.below(points[asked])
        sign = np.ones(len(points)) if inside is None else np.where(inside, 1.0, -1.0)
        gradient = (closest - points) * (sign / np.maximum(distance, 1e-300))[:, None]
        if self.lengths is not None:
            wanted, slopes = self.lengths.with_slopes(points)
            return wanted - sign * distance, gradient + slopes
        return self.thickness - sign * distance, gradient

    def planes(self, points: Floats) -> tuple[Floats, Floats]:
        """Tangent planes of the wall near points inside: a point at exact depth, and the normal."""
        closest, distance = self.nearest(points)
        normals = (closest - points) / np.maximum(distance, 1e-300)[:, None]
        if self.lengths is not None:
            wanted, slopes = self.lengths.with_slopes(points)
            return level_planes(points, wanted - distance, normals + slopes)
        return closest - self.thickness * normals, normals

    def deviation(self, points: Floats) -> Floats:
        """(n,) relative errors of the wall's thickness at points of it: above 0 is too thick.

        Of one that follows a field in units of the least.
        """
        if self.lengths is not None:
            return (self.nearest(points)[1] - self.lengths(points)) / self.thickness
        return np.asarray(self.nearest(points)[1] / self.thickness - 1.0)

    def deviation_and_slopes(self, points: Floats) -> tuple[Floats, Floats]:
        """As `deviation`, with its gradients (n, 3), 1/mm: not a number where it has none."""
        value, gradient = self.values(points)
        return -value / self.thickness, -gradient / self.thickness


@dataclass(frozen=True, eq=False)
class OpenDepth(Depth):
    """Distance to the faces with a skin, and to where the cavity ends beyond the open ones.

    Outside the solid the cavity ends at a distance of `reach` to the surface: of the two values,
    the larger one holds.

    Attributes:
        solid: the part.
        surface: all of its surface.
        reach: mm; less than the thickness, so that no point outside is in the cavity that is not
            in front of an open face.
    """

    solid: TriangleMesh
    surface: SurfaceIndex
    reach: float

    @property
    def error(self) -> float:
        """Also points inside may now be nearest to a border that has no samples around it."""
        return self.surface.spacing

    @property
    def inset(self) -> float:
        """Beyond open faces the cavity ends outside the solid's box."""
        return -self.reach

    def values(
        self, points: Floats, inside: Bools | None = None, unknown: Bools | None = None
    ) -> tuple[Floats, Floats]:
        """As `Depth.values`; which points are inside is looked up in any case."""
        value, gradient = super().values(points)
        beyond, outward = self._beyond(points)
        ends = beyond > value
        return np.where(ends, beyond, value), np.where(ends[:, None], outward, gradient)

    def planes(self, points: Floats) -> tuple[Floats, Floats]:
        """As `Depth.planes`; beyond the open faces, of where the cavity ends."""
        anchor, normal = super().planes(points)
        wanted = self.thickness if self.lengths is None else self.lengths(points)
        skin = wanted - self.nearest(points)[1]
        beyond, outward = self._beyond(points)
        ends = (beyond > skin)[:, None]
        end = points - beyond[:, None] * outward
        return np.where(ends, end, anchor), np.where(ends, outward, normal)

    def deviation(self, points: Floats) -> Floats:
        """As `Depth.strays`; what lies outside the solid is cut off and has no error."""
        return np.where(self._inside(points), super().deviation(points), 0.0)

    def deviation_and_slopes(self, points: Floats) -> tuple[Floats, Floats]:
        """As `Depth.deviation_and_slopes`; what lies outside the solid has no slope."""
        value, gradient = super().values(points)
        inside = self._inside(points)
        slopes = np.where(inside[:, None], -gradient / self.thickness, np.nan)
        return np.where(inside, -value / self.thickness, 0.0), slopes

    def _beyond(self, points: Floats) -> tuple[Floats, Floats]:
        """How far points are beyond the cavity's end, below 0 before it; directions outward."""
        closest, distance = self.surface.near(points)
        sign = np.where(self._inside(points), -1.0, 1.0)
        outward = (points - closest) * (sign / np.maximum(distance, 1e-300))[:, None]
        return sign * distance - self.reach, outward

    def _inside(self, points: Floats) -> Bools:
        return inside_points(self.solid, points, self.monitor)


def level_planes(points: Floats, values: Floats, gradient: Floats) -> tuple[Floats, Floats]:
    """Tangent planes of a level set: where it is, of (n,) values near 0 at points, and normals."""
    size = np.maximum(np.linalg.norm(gradient, axis=1), 1e-300)[:, None]
    return points - values[:, None] * gradient / size**2, gradient / size


def open_depth(
    solid: TriangleMesh, is_open: Bools, thickness: float, spacing: float, monitor: Monitor
) -> OpenDepth:
    """The depth below the faces of a solid that are not open.

    Args:
        solid: checked closed solid, mm.
        is_open: (m,) which of its triangles have no skin.
        thickness: of the skin, mm.
        spacing: of the samples on the surface, mm.
        monitor: for progress and cancel.
    """
    surface = monitor.call(lambda: index_surface(solid, spacing))
    return OpenDepth(
        surface.without(is_open), thickness, monitor, solid, surface, BEYOND * thickness
    )


@dataclass(frozen=True, eq=False)
class SheetDepth(Depth):
    """Distance to groups of faces, each with the thickness of its skin; `index` is the thinnest's.

    Attributes:
        thinnest: the depth below the faces of the thinnest skin, and where the cavity ends beyond
            open faces.
        others: the depths below the other groups of faces.
        solid: the part, where it has open faces; else None.
    """

    thinnest: Depth
    others: tuple[Depth, ...]
    solid: TriangleMesh | None

    @property
    def error(self) -> float:
        """Points inside may be nearest to a group's border, which has few samples around it."""
        return self.index.spacing

    @property
    def steepest(self) -> float:
        """The largest of all groups'."""
        return max(one.steepest for one in (self.thinnest, *self.others))

    @property
    def inset(self) -> float:
        """As of the thinnest."""
        return self.thinnest.inset

    def values(
        self, points: Floats, inside: Bools | None = None, unknown: Bools | None = None
    ) -> tuple[Floats, Floats]:
        """As `Depth.values`: the largest of all groups' inside, the least outside."""
        if self.solid is not None:
            inside = None  # the thinnest group looks it up, for where the cavity ends
        value, gradient = self.thinnest.values(points, inside, unknown)
        sign = np.ones(len(points)) if inside is None else np.where(inside, 1.0, -1.0)
        for other in self.others:
            here, way = other.values(points, inside)
            nearer = np.where(sign > 0.0, here > value, here < value)
            value = np.where(nearer, here, value)
            gradient = np.where(nearer[:, None], way, gradient)
        return value, gradient

    def planes(self, points: Floats) -> tuple[Floats, Floats]:
        """As `Depth.planes`, of the group that the wall belongs to there."""
        value, normals = self.values(points)
        if self.steepest > 1.0:
            return level_planes(points, value, normals)
        return points - value[:, None] * normals, normals

    def deviation(self, points: Floats) -> Floats:
        """As `Depth.strays`, in units of the thinnest skin."""
        result = np.asarray(-self.values(points)[0] / self.thickness)
        if self.solid is not None:
            result[~inside_points(self.solid, points, self.monitor)] = 0.0
        return result

    def deviation_and_slopes(self, points: Floats) -> tuple[Floats, Floats]:
        """As `OpenDepth.deviation_and_slopes`, in units of the thinnest skin."""
        strays, slopes = super().deviation_and_slopes(points)
        if self.solid is not None:
            outside = ~inside_points(self.solid, points, self.monitor)
            strays[outside], slopes[outside] = 0.0, np.nan
        return strays, slopes


def thinnest_of(thicknesses: Thicknesses, usual: float) -> float:
    """The thinnest of a skin's thicknesses, mm; `usual` is that of all other faces."""
    present = [usual] if thicknesses.usual.any() else []
    return min(*present, *(length for _, length in thicknesses.others), np.inf)


def sheet_depth(
    solid: TriangleMesh,
    thicknesses: Thicknesses,
    usual: float,
    spacing: float,
    monitor: Monitor,
    lengths: ThicknessField | None = None,
) -> Depth:
    """The depth below the faces of a solid whose skin is not alike everywhere.

    Args:
        solid: checked closed solid, mm.
        thicknesses: of its skin.
        usual: thickness of the skin below all other faces, mm.
        spacing: of the samples on the surface, mm.
        monitor: for progress and cancel.
        lengths: what that follows, nowhere thinner; None where it is the same below all of them.
    """
    surface = monitor.call(lambda: index_surface(solid, spacing))
    groups = [(thicknesses.usual, usual)] if thicknesses.usual.any() else []
    groups = sorted([*groups, *thicknesses.others], key=lambda group: group[1])
    sheets = [
        Depth(
            surface if faces.all() else surface.without(~faces), length, monitor,
            lengths=lengths if faces is thicknesses.usual else None,
        )
        for faces, length in groups
    ]  # fmt: skip
    first, *others = sheets
    is_open = thicknesses.is_open
    if is_open is not None:
        first = OpenDepth(
            first.index, first.thickness, monitor, solid, surface, BEYOND * first.thickness,
            lengths=first.lengths,
        )  # fmt: skip
    if not others:
        return first
    part = None if is_open is None else solid
    return SheetDepth(first.index, first.thickness, monitor, first, tuple(others), part)

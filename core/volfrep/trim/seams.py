# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where two surfaces cross: the points and segments of their seam, every sign of it certain.

A segment of the seam lies in one facet of each surface. It ends where an edge of one facet runs
through the other, so that what is decided for an edge and a facet holds for all that share them,
and both surfaces are cut along the very same points (P. Cignoni et al. and others call it the
intersection graph). Signs of determinants are taken where rounding cannot turn them, after
J. R. Shewchuk, Discrete & Computational Geometry 18, 1997; where one is too near to zero nothing
is decided at all.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..mesh.remesh import unit_normals
from ..mesh.triangle_mesh import TriangleMesh, corners_at, triangle_boxes
from ..spatial.self_intersection import meeting_boxes
from ..util.linalg import cross_columns, dot_columns
from ..util.types import Bools, Floats, Ints

#: Facets of the first surface that are looked at together, in their order.
RUN = 32
#: Runs and facets of the second surface that one vectorised step takes at a time.
PAIRS_PER_STEP = 4_000
#: Bins along the largest facet of the second surface.
MOST_BINS = 64
#: Determinants below this part of what their factors could give have no certain sign.
UNSURE = 2e-15
#: What is computed of lengths by a few steps is right to this part of them.
ROUNDING = 1e-14


class NotCertain(Exception):
    """The surfaces touch, or cross in a way that rounding could turn."""


@dataclass(frozen=True, eq=False)
class Crossings:
    """Where edges of one surface run through facets of the other.

    Attributes:
        edge: (k, 2) the vertices of each edge, the lower number first.
        facet: (k,) the facet of the other surface.
        along: (k,) how far along the edge, 0 to 1.
        falls: (k,) bool, whether the edge runs against the facet's normal, from its front to
            its back.
        points: (k, 3) where, mm.
    """

    edge: Ints
    facet: Ints
    along: Floats
    falls: Bools
    points: Floats


@dataclass(frozen=True, eq=False)
class Seam:
    """What two surfaces have in common.

    Attributes:
        first: crossings of edges of the first surface.
        second: of edges of the second one; points are numbered on, after the first ones.
        facets: (s, 2) the facets of both that each segment lies in.
        ends: (s, 2) the points it runs from and to: the second surface's back is on its left in
            the first facet, and the first surface's front in the second facet.
    """

    first: Crossings
    second: Crossings
    facets: Ints
    ends: Ints

    @property
    def points(self) -> Floats:
        """(n, 3) all the points, mm."""
        return np.concatenate([self.first.points, self.second.points])


def seam_of(first: TriangleMesh, second: TriangleMesh) -> Seam:
    """The seam of two surfaces.

    Args:
        first: a mesh whose neighbours in order mostly lie near each other; mm.
        second: another one.

    Raises:
        NotCertain: they touch within rounding.
    """
    one, two = _near_pairs(first, second)
    planes = _Planes.of(first), _Planes.of(second)
    rises, doubt = _heights(first, planes[1], one, two)
    keep = np.flatnonzero(_straddle(rises))
    one, two, rises, doubt = one[keep], two[keep], _some(rises, keep), doubt[keep]
    back, more = _heights(second, planes[0], two, one)
    keep = np.flatnonzero(_straddle(back))
    one, two, rises, back = one[keep], two[keep], _some(rises, keep), _some(back, keep)
    # Most of these go through the planes of each other beside each other.
    axis = _main_axis(planes[0], planes[1], one, two)
    ours, theirs = _Sides.of(first, one, rises), _Sides.of(second, two, back)
    low, high = ours.reach(first, axis, doubt[keep])
    least, most = theirs.reach(second, axis, more[keep])
    keep = np.flatnonzero((low <= most) & (least <= high))
    one, two = one[keep], two[keep]
    ahead, where = _crossings(first, second, ours.some(keep), two)
    behind, elsewhere = _crossings(second, first, theirs.some(keep), one)
    # Where an edge of the first facet leaves the back of the second one, the seam begins; where an
    # edge of the second one goes from the front of the first one to its back, too.
    shift = len(ahead.edge)
    pair = np.concatenate([where[0], elsewhere[0]])
    point = np.concatenate([where[1], elsewhere[1] + shift])
    begins = np.concatenate([where[2], ~elsewhere[2]])
    start, end = np.full(len(one), -1, np.int64), np.full(len(one), -1, np.int64)
    start[pair[begins]], end[pair[~begins]] = point[begins], point[~begins]
    some = np.flatnonzero((start >= 0) | (end >= 0))
    if len(pair) != 2 * len(some) or (start[some] < 0).any() or (end[some] < 0).any():
        raise NotCertain
    facets = np.stack([one[some], two[some]], axis=1)
    return Seam(ahead, behind, facets, np.stack([start[some], end[some]], axis=1))


def _near_pairs(first: TriangleMesh, second: TriangleMesh) -> tuple[Ints, Ints]:
    """Facets of both surfaces whose boxes touch, where the first reach the second ones' planes."""
    found = [(np.zeros(0, np.int64), np.zeros(0, np.int64))]
    if len(first.triangles) and len(second.triangles):
        low, high = triangle_boxes(first.vertices.T, first.triangles.T)
        least, most = triangle_boxes(second.vertices.T, second.triangles.T)
        others = corners_at(second.vertices, second.triangles)
        normal = unit_normals(others)
        offset = np.einsum("ij,ij->i", others[:, 0], normal)
        # The last run is filled up with its last facet.
        count = low.shape[1]
        middle = 0.5 * (low + high)
        half = high - middle
        order = _neighbourly(middle)
        runs = order[np.minimum(np.arange(-(-count // RUN) * RUN), count - 1)].reshape(-1, RUN)
        rows, begin = runs.ravel(), np.arange(0, runs.size, RUN)
        run, facet = _touching(
            np.stack([np.minimum.reduceat(column[rows], begin) for column in low], axis=1),
            np.stack([np.maximum.reduceat(column[rows], begin) for column in high], axis=1),
            least.T, most.T, others[:, 0], normal,
        )  # fmt: skip
        reach = np.sqrt((half * half).sum(axis=0)) * (1.0 + 1e-9)
        reach = (reach + 1e-12 * max(np.abs(low).max(), np.abs(high).max()))[runs]
        reach[-1, (count - 1) % RUN + 1 :] = -1.0  # what fills up meets nothing
        middle = np.stack([column[runs] for column in middle], axis=1)
        for k in range(0, len(run), PAIRS_PER_STEP):
            r, f = run[k : k + PAIRS_PER_STEP], facet[k : k + PAIRS_PER_STEP]
            above = np.einsum("ij,ijk->ik", corners_at(normal, f), corners_at(middle, r))
            above -= offset[f, None]
            row, place = np.divmod(np.flatnonzero(np.abs(above) <= corners_at(reach, r)), RUN)
            two, one = f[row], rows.take(r[row] * RUN + place, mode="clip")
            for axis in range(3):
                starts, ends = low[axis].take(one, mode="clip"), high[axis].take(one, mode="clip")
                keep = starts <= most[axis].take(two, mode="clip")
                keep &= least[axis].take(two, mode="clip") <= ends
                one, two = _some((one, two), np.flatnonzero(keep))
            found.append((one, two))
    one, two = (np.concatenate(column) for column in zip(*found, strict=True))
    return one, two


def _neighbourly(points: Floats) -> Ints:
    """An order of (3, n) points, neighbours mostly one after the other (G. M. Morton, 1966).

    Not that of `proximity.neighbours_together`: where outlines begin, and so how facets are
    divided, follows from it.
    """
    low = points.min(axis=1)
    scale = 1023.0 / max(float((points.max(axis=1) - low).max()), 1e-300)
    code = np.zeros(points.shape[1], np.int32)
    for axis in range(3):
        bits = ((points[axis] - low[axis]) * scale).astype(np.int32)
        for shift, mask in ((16, 0x30000FF), (8, 0x300F00F), (4, 0x30C30C3), (2, 0x9249249)):
            bits = (bits | (bits << shift)) & mask
        code |= bits << axis
    return np.argsort(code, kind="stable")


def _touching(
    low: Floats, high: Floats, least: Floats, most: Floats, on: Floats, normal: Floats
) -> tuple[Ints, Ints]:
    """Boxes and facets that touch, by the facets' boxes and planes."""
    size = max(1.5 * float(np.median(high - low)), float((most - least).max()) / MOST_BINS)
    a, b = meeting_boxes(low, high, least, most, size)
    # Axis by axis, which numpy takes in faster than rows of three.
    above, reach = np.zeros((2, len(a)))
    for axis in range(3):
        along = normal[:, axis]
        middle, half = 0.5 * (low[:, axis] + high[:, axis]), 0.5 * (high[:, axis] - low[:, axis])
        above += (middle[a] - on[b, axis]) * along[b]
        reach += half[a] * np.abs(along)[b]
    meets = np.abs(above) <= reach * (1.0 + 1e-9) + 1e-12 * np.abs(high).max()
    pairs = np.sort(a[meets] * np.int64(len(least)) + b[meets])
    return np.divmod(pairs, len(least))


@dataclass(frozen=True, eq=False)
class _Planes:
    """The planes of a mesh's facets, axis by axis, which numpy takes in faster than rows of three.

    Attributes:
        origin: where a corner of each is, three of (m,), mm.
        normal: three of (m,), as long as twice its area, mm2.
        size: (m,) product of two sides' lengths, mm2.
    """

    origin: list[Floats]
    normal: list[Floats]
    size: Floats

    @staticmethod
    def of(mesh: TriangleMesh) -> _Planes:
        columns = np.ascontiguousarray(mesh.vertices.T)
        a, b, c = (mesh.triangles[:, k].astype(np.int64) for k in range(3))
        origin = _some(columns, a)
        e, f = ([x - o for x, o in zip(_some(columns, q), origin, strict=True)] for q in (b, c))
        size = np.sqrt(dot_columns(e, e) * dot_columns(f, f))
        return _Planes(origin, cross_columns(e, f), size)


def _some(columns: Iterable[NDArray[Any]], rows: Ints) -> list[NDArray[Any]]:
    """Some rows of each column: numpy takes twice as long by an index."""
    return [column.take(rows, mode="clip") for column in columns]


def _heights(
    mesh: TriangleMesh, planes: _Planes, one: Ints, two: Ints
) -> tuple[list[Floats], Floats]:
    """Three of (k,), corners of facets above others' planes, times twice these' areas, mm3.

    And (k,) by how much each three may be wrong.
    """
    origin, normal = _some(planes.origin, two), _some(planes.normal, two)
    size = UNSURE * planes.size.take(two, mode="clip")
    columns = np.ascontiguousarray(mesh.vertices.T)
    result, doubt = [], np.zeros(len(one))
    for k in range(3):
        corner = mesh.triangles[:, k].astype(np.int64).take(one, mode="clip")
        away = [x - o for x, o in zip(_some(columns, corner), origin, strict=True)]
        height = dot_columns(away, normal)
        unsure = size * np.sqrt(dot_columns(away, away))
        if (np.abs(height) <= unsure).any():
            raise NotCertain
        result.append(height)
        np.maximum(doubt, unsure, out=doubt)
    return result, doubt


def _straddle(heights: list[Floats]) -> Bools:
    x, y, z = (each > 0 for each in heights)
    return np.asarray((x | y | z) & ~(x & y & z), np.bool_)


def _main_axis(first: _Planes, second: _Planes, one: Ints, two: Ints) -> Ints:
    """(k,) the axis that the line in both of two facets' planes runs along most."""
    along = cross_columns(_some(first.normal, one), _some(second.normal, two))
    x, y, z = (np.abs(each) for each in along)
    return np.asarray((y > x) * 1 + (z > np.maximum(x, y)) * (2 - (y > x)), np.int64)


@dataclass(frozen=True, eq=False)
class _Sides:
    """The two sides of facets that run through planes; both end in one corner.

    Attributes:
        corner: three of (k,), the vertex that is alone on its side of the plane, and those that
            follow it about the facet.
        height: three of (k,), theirs above the plane, as of `_heights`.
    """

    corner: list[Ints]
    height: list[Floats]

    @staticmethod
    def of(mesh: TriangleMesh, facet: Ints, heights: list[Floats]) -> _Sides:
        """Of facets with corners on both sides."""
        x, y, z = (each > 0 for each in heights)
        alone = 2 * (x == y) + (x == z)
        every, count = np.concatenate(heights), len(facet)
        corners = np.ascontiguousarray(mesh.triangles.T).ravel()
        corner, height = [], []
        for step in range(3):
            place = (alone + step) % 3
            corner.append(
                corners.take(place * len(mesh.triangles) + facet, mode="clip").astype(np.int64)
            )
            height.append(every.take(place * count + np.arange(count), mode="clip"))
        return _Sides(corner, height)

    def some(self, rows: Ints) -> _Sides:
        """Those of some of the facets."""
        return _Sides(_some(self.corner, rows), _some(self.height, rows))

    def reach(self, mesh: TriangleMesh, axis: Ints, doubt: Floats) -> tuple[Floats, Floats]:
        """(k,) and (k,) from where to where facets are in the planes along an axis each, at most.

        Args:
            mesh: that the facets are of.
            axis: (k,).
            doubt: (k,) by how much heights may be wrong.
        """
        flat = mesh.vertices.ravel()
        tip, *ends = (flat.take(3 * corner + axis, mode="clip") for corner in self.corner)
        low, high = np.full(len(axis), np.inf), np.full(len(axis), -np.inf)
        for end, height in zip(ends, self.height[1:], strict=True):
            rise = self.height[0] - height
            at = tip + (end - tip) * (self.height[0] / rise)
            room = np.abs(end - tip) * (4.0 * doubt / np.abs(rise) + ROUNDING)
            room += ROUNDING * np.abs(tip)
            np.minimum(low, at - room, out=low)
            np.maximum(high, at + room, out=high)
        return low, high


def _crossings(
    mesh: TriangleMesh, other: TriangleMesh, sides: _Sides, two: Ints
) -> tuple[Crossings, tuple[Ints, Ints, Bools]]:
    """Where sides of facets run through facets `two` of another mesh.

    Returns:
        the crossings, each once, and for every pair of facets that has one: which pair, which
        crossing, and whether the facet's side, as it runs about it, goes from back to front.
    """
    tip, following, last = sides.corner
    pair = np.tile(np.arange(len(two)), 2)
    start, end = np.concatenate([tip, last]), np.concatenate([following, tip])
    low = np.concatenate([sides.height[0], sides.height[2]])
    high = np.concatenate([sides.height[1], sides.height[0]])
    rises, turned = low < 0, start > end
    start, end = np.minimum(start, end), np.maximum(start, end)
    low, high = np.where(turned, high, low), np.where(turned, low, high)
    edge, count = start * len(mesh.vertices) + end, len(other.triangles)
    if len(mesh.vertices) ** 2 * count > np.iinfo(np.int64).max:
        edge = np.unique(edge, return_inverse=True)[1].ravel()
    _, first, number = np.unique(
        edge * np.int64(count) + two[pair], return_index=True, return_inverse=True
    )
    facet = two[pair[first]]
    u, v = (corners_at(mesh.vertices, ends[first]) for ends in (start, end))
    through = _through(u, v, corners_at(other.vertices, other.triangles[facet]))
    row = np.cumsum(through) - 1
    kept = np.flatnonzero(through)
    first, facet, u, v = first[kept], facet[kept], corners_at(u, kept), corners_at(v, kept)
    low, high = low[first], high[first]
    along = low / (low - high)
    ends = np.stack([start[first], end[first]], axis=1)
    found = Crossings(ends, facet, along, low > 0, u + along[:, None] * (v - u))
    number = number.ravel()
    met = np.flatnonzero(through[number])
    return found, (pair[met], row[number[met]], rises[met])


def _through(u: Floats, v: Floats, corners: Floats) -> Bools:
    """Whether segments whose ends lie on both sides of (k, 3, 3) facets run through these."""
    along = list((v - u).T)
    away = [list((corners[:, k] - u).T) for k in range(3)]
    long = np.sqrt(dot_columns(along, along))
    far = [np.sqrt(dot_columns(a, a)) for a in away]
    left = []
    for k in range(3):
        following = (k + 1) % 3
        side = dot_columns(along, cross_columns(away[k], away[following]))
        if (np.abs(side) <= UNSURE * long * far[k] * far[following]).any():
            raise NotCertain
        left.append(side > 0)
    result: Bools = (left[0] == left[1]) & (left[1] == left[2])
    return result

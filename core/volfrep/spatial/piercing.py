# SPDX-License-Identifier: LGPL-2.1-or-later
"""Exact self-intersection: which triangles of a mesh run through each other.

A part's facets lie as close as a millionth of a millimetre to each other where the Boolean has cut
needles. Rounding then decides what a test of floating-point numbers finds: FreeCAD's, in single
precision and with a tolerance, names pairs that do not meet. Here the signs of determinants are
taken as computed where they are larger than any rounding could be (the bound of Shewchuk, Adaptive
Precision Floating-Point Arithmetic, 1997), and are otherwise computed again in whole numbers.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..mesh.closest import closest_on_triangles
from ..mesh.triangle_mesh import TriangleMesh, corners_at, triangle_boxes
from ..util.linalg import cross_columns, dot_columns
from ..util.progress import Monitor
from ..util.threads import in_threads
from ..util.types import Bools, Floats, Ints
from .self_intersection import about, portions_of_pairs

Signs = NDArray[np.int8]

#: Pairs of triangles that are looked at together: what is gathered of them fits the cache.
BLOCK_PAIRS = 1 << 14

#: And so many that are looked at roughly.
BLOCK_CLOSE = 1 << 17

#: A determinant of 3 x 3 differences errs by no more than this times its terms without signs.
ROUNDING = 8.0 * np.finfo(np.float64).eps
#: And one of a corner and a plane by no more than this times the lengths of the three differences.
ROUGHLY = 64.0 * np.finfo(np.float64).eps


def piercing_pairs(mesh: TriangleMesh, monitor: Monitor | None = None) -> Ints:
    """Pairs of triangles of which an edge of the first runs through the second.

    Neighbours over an edge are not looked at. Triangles that only touch, with a corner or in a
    plane that they share, do not count. Edges that meet each other between their ends do, where
    either triangle has corners on both sides of the other's plane: from the two alone nobody can
    tell whether surfaces cross or touch there.

    Args:
        mesh: any mesh; exact for the coordinates as they are, so read it as a file would be.
        monitor: told how far it is, asked for a cancel.

    Returns:
        (k, 2) int64, in rising order; two triangles may pierce each other and come in both orders.

    Raises:
        Cancelled: when the monitor says so.
    """
    return piercing_among(mesh, pairs_at_planes(mesh, 0.0, monitor))


def meeting_triangles(
    mesh: TriangleMesh, among: Bools, gap: float, monitor: Monitor | None = None
) -> Bools:
    """(m,) the triangles that pierce each other or come near, of pairs with at least one of some.

    Neighbours over an edge are not looked at; of those that share a corner what lies away from it.

    Args:
        mesh: as of `piercing_pairs`.
        among: (m,) bool, those.
        gap: what is nearer than this is near, mm.
        monitor: asked for a cancel.
    """
    rows = np.flatnonzero(about(mesh, among))
    part = TriangleMesh(mesh.vertices, mesh.triangles[rows])
    pairs = pairs_at_planes(part, gap, monitor, among[rows])
    result = np.zeros(len(mesh.triangles), bool)
    result[rows[piercing_among(part, pairs)]] = True
    result[rows[pairs[_are_near(part, pairs, gap)]]] = True
    return result


def pairs_at_planes(
    mesh: TriangleMesh,
    moves: float,
    monitor: Monitor | None = None,
    among: Bools | None = None,
) -> Ints:
    """(k, 2) pairs of triangles that may pierce each other, once vertices have moved a little.

    What is left out does not: their boxes are apart, or one lies in front of or behind the plane
    of the other, or a plane across the way between them or upright on an edge divides them, by more
    than the moves and rounding can turn.

    Args:
        mesh: any mesh, mm.
        moves: no coordinate of a vertex changes by more, mm.
        monitor: asked for a cancel.
        among: (m,) bool, triangles of which each pair has at least one; None: all.
    """
    monitor = monitor or Monitor()
    corners = corners_at(mesh.vertices, mesh.triangles)
    planes = _Planes(mesh, moves)
    found = [np.empty((0, 2), np.int64)]
    among = np.ones(len(corners), bool) if among is None else among
    portions = portions_of_pairs(corners, among, moves)
    for pairs in in_threads(lambda portion: planes.met(*portion()), portions):
        monitor.tick()
        found.append(pairs)
    return np.concatenate(found)


def pairs_among(mesh: TriangleMesh, moves: float, pairs: Ints) -> Ints:
    """As `pairs_at_planes`, of (k, 2) pairs of triangles only."""
    low, high = triangle_boxes(mesh.vertices.T, mesh.triangles.T)
    a, b = pairs.T
    for lowest, highest in zip(low - moves, high + moves, strict=True):
        meets = (lowest[a] <= highest[b]) & (lowest[b] <= highest[a])
        a, b = a[meets], b[meets]
    pairs = np.stack([a, b], axis=1)
    planes = _Planes(mesh, moves)
    blocks = (pairs[k : k + BLOCK_CLOSE].T for k in range(0, len(pairs), BLOCK_CLOSE))
    found = [np.empty((0, 2), np.int64), *in_threads(lambda some: planes.met(*some), blocks)]
    return np.concatenate(found)


class _Planes:
    """The planes of triangles, and which others may have corners on both sides of them."""

    def __init__(self, mesh: TriangleMesh, moves: float) -> None:
        # A column for every coordinate of every corner: numpy takes rows of three slowly.
        self._corner = np.ascontiguousarray(mesh.triangles.T)
        columns = np.ascontiguousarray(mesh.vertices.T)
        self._at = [[column[corner] for column in columns] for corner in self._corner]
        a, b, c = self._at
        e, f = ([q[k] - a[k] for k in range(3)] for q in (b, c))
        self._normal = cross_columns(e, f)
        # A difference of two vertices moves by so much; a determinant is linear in three of them.
        self._far = 2.0 * np.sqrt(3.0) * moves
        long, wide = (np.sqrt(dot_columns(d, d)) for d in (e, f))
        self._both = (long + self._far) * (wide + self._far)
        self._less = self._both - long * wide

    def met(self, a: Ints, b: Ints) -> Ints:
        """(k, 2) those of pairs of triangles a and b that may pierce each other."""
        for _ in range(2):
            meets = self.reached(a, b)
            a, b = b[meets], a[meets]
        meets = ~self.divided(a, b)
        a, b = a[meets], b[meets]
        for _ in range(2):
            meets = ~self.beside(a, b)
            a, b = b[meets], a[meets]
        return np.stack([a, b], axis=1)

    def reached(self, a: Ints, b: Ints) -> NDArray[np.bool_]:
        """(n,) whether triangles a may have corners on both sides of triangles b.

        Not where they share an edge. A corner that they share is on neither side.
        """
        origin = [column[b] for column in self._at[0]]
        normal = [column[b] for column in self._normal]
        both, less = self._both[b], self._less[b]
        theirs = [corner[b] for corner in self._corner]
        above, below = np.zeros((2, len(a)), bool)
        shared = np.zeros(len(a), np.int8)
        for number, at in zip(self._corner, self._at, strict=True):
            own = number[a]
            same = _among(own, theirs)
            x, y, z = (column[a] - start for column, start in zip(at, origin, strict=True))
            height = x * normal[0] + y * normal[1] + z * normal[2]
            away = np.sqrt(x * x + y * y + z * z)
            # (away + far) both - away long wide, and what rounding adds to it.
            unsure = self._far * both + away * (less + ROUGHLY * both)
            above |= (height >= -unsure) & ~same
            below |= (height <= unsure) & ~same
            shared += same
        result: NDArray[np.bool_] = above & below & (shared < 2)
        return result

    def divided(self, a: Ints, b: Ints) -> NDArray[np.bool_]:
        """(n,) whether a plane across the way between their middles has both on its two sides.

        Of triangles that share a corner it goes through that, and the way is between what they
        go from there.
        """
        ours, theirs = ([corner[rows] for corner in self._corner] for rows in (a, b))
        at = [[[column[rows] for column in corner] for corner in self._at] for rows in (a, b)]
        # Places from the corner that they share, or else from the first one of a.
        origin = at[0][0]
        for corner, places in zip(ours[1:], at[0][1:], strict=True):
            same = _among(corner, theirs)
            origin = [np.where(same, x, start) for x, start in zip(places, origin, strict=True)]
        at = [[[x - o for x, o in zip(p, origin, strict=True)] for p in each] for each in at]
        shared = [_among(corner, theirs) for corner in ours], [_among(c, ours) for c in theirs]
        meets = shared[0][0] | shared[0][1] | shared[0][2]
        way: list[Floats] = [np.zeros(len(a)) for _ in range(3)]
        for each, sign in zip(at, (1.0, -1.0), strict=True):
            middle = [sum(places[k] for places in each) / 3.0 for k in range(3)]
            length = np.sqrt(sum(x * x for x in middle))
            scale = np.where(meets, sign / np.maximum(length, 1e-300), sign)
            way = [w + scale * x for w, x in zip(way, middle, strict=True)]
        long = np.sqrt(sum(w * w for w in way))
        unsure = np.zeros(len(a))
        ends = []
        for each, alike, sign in zip(at, shared, (1.0, -1.0), strict=True):
            least = np.full(len(a), np.inf)
            for places, is_shared in zip(each, alike, strict=True):
                along = sum(w * x for w, x in zip(way, places, strict=True))
                far = sum(np.abs(x) for x in places)
                unsure = np.maximum(unsure, long * (self._far + ROUGHLY * far))
                least = np.minimum(least, np.where(is_shared, np.inf, sign * along))
            ends.append(least)
        # Without a common corner the plane may lie anywhere between them.
        both = (ends[0] > unsure) & (ends[1] > unsure)
        result: NDArray[np.bool_] = np.where(meets, both, ends[0] + ends[1] > 2.0 * unsure)
        return result

    def beside(self, a: Ints, b: Ints) -> NDArray[np.bool_]:
        """(n,) whether b lies beyond an edge of a: beyond the plane upright on a through it.

        Not where they share a corner.
        """
        ours, theirs = ([corner[rows] for corner in self._corner] for rows in (a, b))
        shared = _among(ours[0], theirs) | _among(ours[1], theirs) | _among(ours[2], theirs)
        origin = [column[a] for column in self._at[0]]
        one, two = ([[column[rows] - o for column, o in zip(corner, origin, strict=True)]
                     for corner in self._at] for rows in (a, b))  # fmt: skip
        normal = [column[a] for column in self._normal]
        # By how far a product with a vector of length 1 may be wrong, at any of the six corners.
        far = [np.abs(x) + np.abs(y) + np.abs(z) for x, y, z in one + two]
        unsure = self._far + ROUGHLY * np.maximum.reduce(far)
        result = np.zeros(len(a), bool)
        for k in range(3):
            edge = [x - y for x, y in zip(one[(k + 1) % 3], one[k], strict=True)]
            # Any vector will do, for both are measured along the same one.
            way = cross_columns(edge, normal)
            most = np.maximum.reduce([dot_columns(way, corner) for corner in one])
            least = np.minimum.reduce([dot_columns(way, corner) for corner in two])
            result |= least - most > 2.0 * unsure * np.sqrt(dot_columns(way, way))
        return np.asarray(result & ~shared, np.bool_)


def _among(corner: NDArray[np.int32], others: list[NDArray[np.int32]]) -> NDArray[np.bool_]:
    return np.asarray((corner == others[0]) | (corner == others[1]) | (corner == others[2]))


def piercing_among(mesh: TriangleMesh, pairs: Ints) -> Ints:
    """As `piercing_pairs`, of (k, 2) pairs of triangles only, in either order."""
    blocks = (pairs[k : k + BLOCK_PAIRS] for k in range(0, len(pairs), BLOCK_PAIRS))
    found = [np.empty((0, 2), np.int64), *in_threads(lambda some: _piercing(mesh, some), blocks)]
    result: Ints = np.unique(np.concatenate(found), axis=0)
    return result


def _are_near(mesh: TriangleMesh, pairs: Ints, gap: float) -> Bools:
    """(k,) whether pairs of triangles are near by a corner of one, or by an edge of each."""
    both = mesh.triangles[pairs]
    corners = mesh.vertices[both]
    shared = both[:, 0, :, None] == both[:, 1, None, :]
    near = np.zeros(len(pairs), bool)
    for one, other in ((0, 1), (1, 0)):
        for k in range(3):
            place = corners[:, one, k]
            away = np.linalg.norm(closest_on_triangles(corners[:, other], place)[0] - place, axis=1)
            near |= (away < gap) & ~shared.any(axis=2 - one)[:, k]
    for i in range(3):
        for j in range(3):
            # Nearest between their ends: else it is a corner of one.
            p, r = corners[:, 0, i], corners[:, 1, j]
            along, across = corners[:, 0, i - 2] - p, corners[:, 1, j - 2] - r
            upright = np.cross(along, across)
            size = np.maximum(np.einsum("ij,ij->i", upright, upright), 1e-300)
            parts = (np.einsum("ij,ij->i", np.cross(r - p, way), upright) / size
                     for way in (across, along))  # fmt: skip
            inner = np.all([(part > 0.0) & (part < 1.0) for part in parts], axis=0)
            away = np.abs(np.einsum("ij,ij->i", r - p, upright)) / np.sqrt(size)
            meets = shared[:, [i, i - 2]][:, :, [j, j - 2]].any(axis=(1, 2))
            near |= inner & (away < gap) & ~meets
    return near


def _piercing(mesh: TriangleMesh, pairs: Ints) -> Ints:
    a, b = pairs.T
    one, two = mesh.triangles[a], mesh.triangles[b]
    for _ in range(2):
        both = _on_both_sides(mesh.vertices, one, two)
        a, b, one, two = b[both], a[both], two[both], one[both]
    found = []
    for first, second, edges, faces in ((a, b, one, two), (b, a, two, one)):
        pierced = _edges_pierce(mesh.vertices, edges, faces)
        found.append(np.stack([first[pierced], second[pierced]], axis=1))
    return np.concatenate(found)


def _on_both_sides(
    vertices: Floats, one: NDArray[np.int32], two: NDArray[np.int32]
) -> NDArray[np.bool_]:
    """(n,) whether triangles `one` have corners on both sides of the planes of `two`."""
    sides = np.stack([_sides(vertices, two, one[:, k]) for k in range(3)], axis=1)
    return np.asarray((sides > 0).any(axis=1) & (sides < 0).any(axis=1), np.bool_)


def _edges_pierce(
    vertices: Floats, edges: NDArray[np.int32], faces: NDArray[np.int32]
) -> NDArray[np.bool_]:
    """(n,) whether an edge of the first triangles runs through the second ones."""
    pierced = np.zeros(len(edges), bool)
    sides = np.stack([_sides(vertices, faces, edges[:, k]) for k in range(3)], axis=1)
    for k in range(3):
        following = (k + 1) % 3
        rows = np.flatnonzero(sides[:, k] * sides[:, following] < 0)
        p, q = edges[rows, k], edges[rows, following]
        turns = np.stack(
            [
                _sides(vertices, np.stack([p, q, faces[rows, e]], axis=1), faces[rows, (e + 1) % 3])
                for e in range(3)
            ],
            axis=1,
        )
        pierced[rows[(turns >= 0).all(axis=1) | (turns <= 0).all(axis=1)]] = True
    return pierced


def _sides(vertices: Floats, planes: NDArray[np.int32], points: NDArray[np.int32]) -> Signs:
    """(n,) the exact side, -1, 0 or 1, of points against planes through three vertices each."""
    # Axis by axis, which numpy takes in faster than rows of three.
    columns = [vertices[:, k] for k in range(3)]
    corners = [np.ascontiguousarray(planes[:, k]) for k in range(3)]
    origin = [column[points] for column in columns]
    u, v, w = ([c[q] - o for c, o in zip(columns, origin, strict=True)] for q in corners)
    value = np.zeros(len(points))
    size = np.zeros(len(points))
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        left, right = v[j] * w[k], v[k] * w[j]
        value += u[i] * (left - right)
        size += np.abs(u[i]) * (np.abs(left) + np.abs(right))
    signs = np.sign(value).astype(np.int8)
    unsure = np.flatnonzero(np.abs(value) <= ROUNDING * size)
    # Where every term is zero a difference is, and that is exact.
    unsure = unsure[size[unsure] > 0.0]
    if len(unsure):
        signs[unsure] = _exact_sides(vertices, planes[unsure], points[unsure])
    return signs


def _exact_sides(vertices: Floats, planes: NDArray[np.int32], points: NDArray[np.int32]) -> Signs:
    """As `_sides`, in whole numbers of any length."""
    used, rows = np.unique(np.column_stack([planes, points]), return_inverse=True)
    whole = _as_whole_numbers(vertices[used])[rows.reshape(-1, 4)]
    u, v, w = (whole[:, k] - whole[:, 3] for k in range(3))
    value = sum(
        u[:, i] * (v[:, (i + 1) % 3] * w[:, (i + 2) % 3] - v[:, (i + 2) % 3] * w[:, (i + 1) % 3])
        for i in range(3)
    )
    signs: Signs = (value > 0).astype(np.int8) - (value < 0).astype(np.int8)
    return signs


def _as_whole_numbers(values: Floats) -> NDArray[np.object_]:
    """All values times one power of two that makes Python integers of them."""
    mantissa, exponent = np.frexp(values)
    digits = np.ldexp(mantissa, 53).astype(np.int64).astype(object)
    lowest = int(exponent[mantissa != 0.0].min(initial=exponent.max()))
    shift = np.where(mantissa != 0.0, exponent - lowest, 0)
    whole: NDArray[np.object_] = digits * np.power(np.array(2, object), shift.astype(object))
    return whole

# SPDX-License-Identifier: LGPL-2.1-or-later
"""A closed mesh filled with tetrahedra of a lattice, which takes any surface.

Isosurface stuffing (F. Labelle and J. R. Shewchuk, ACM Trans. Graphics 26 (3), 57, 2007): a body-
centred cubic lattice of tetrahedra is laid over the solid. Its points that lie near the surface are
moved onto it, and tetrahedra that still reach through it are cut there. As no cut is near a corner,
none of them can be flat, whatever triangles the surface has: they are asked only where the
lattice's edges cross them. The price is that sharp edges are rounded, that walls and gaps thinner
than the lattice's edge may be lost, and that there are more tetrahedra. A point lies inside by
winding number; both it and the crossings are found along straight lines through the lattice.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from ..mesh.triangle_mesh import TriangleMesh
from ..spatial.rays import column_crossings, inside_grid
from ..util.errors import VolfrepError
from ..util.progress import Monitor
from ..util.types import Bools, Floats, Ints

#: A lattice point goes to the surface where this is nearer than such a part of one of its long
#: (along an axis) and its short edges: the paper's for the largest least dihedral angle.
NEAR_LONG, NEAR_SHORT = 0.24999, 0.41189
#: Diagonals of a quadrangle whose squares differ by no more than this part are as long.
EQUAL = 1e-9
#: Pieces that hang on the rest by less than a face, with less than this part of the volume, go.
CRUMB = 1e-3
#: A lattice with more cubes than this would take more than about 2 GB.
MOST_CUBES = 100_000_000
#: The directions from a lattice point to those whose row is higher, in half edges: along the axes,
#: and to the middles of cubes.
_WAYS = np.array([[2, 0, 0], [0, 2, 0], [0, 0, 2], [1, 1, 1], [1, 1, -1], [1, -1, 1], [1, -1, -1]])
_EDGES = np.array([[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]])
#: Faces of a tetrahedron, opposite to each corner, seen from outside.
FACES = np.array([[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]])


@dataclass(frozen=True, eq=False)
class _Lattice:
    """A body-centred cubic lattice: points are named by whole numbers of half edges.

    Attributes:
        origin: (3,) mm.
        edge: of its cubes, mm.
        cubes: (3,) along each axis.
    """

    origin: Floats
    edge: float
    cubes: Ints

    @property
    def strides(self) -> Ints:
        """(3,) by what a point's row grows with each of its numbers."""
        size = 2 * self.cubes + 1
        return np.array([size[1] * size[2], size[2], 1])

    def numbers(self, rows: Ints) -> Ints:
        """(n, 3) the numbers of points by their rows."""
        size = 2 * self.cubes + 1
        return np.stack(np.unravel_index(rows, tuple(size.tolist())), axis=1).astype(np.int64)

    def along(self, axis: int, odd: bool) -> Floats:
        """Coordinates of the corners of cubes, or of their middles, from the origin, mm."""
        return self.edge * (np.arange(self.cubes[axis] + (not odd)) + 0.5 * odd)


def stuffed_mesh(mesh: TriangleMesh, edge: float, monitor: Monitor) -> tuple[Floats, Ints]:
    """Fill a closed mesh with tetrahedra of a lattice.

    Args:
        mesh: closed, outward oriented, mm.
        edge: of the lattice's cubes, mm.
        monitor: for cancel.

    Returns:
        (n, 3) nodes, mm; (m, 4) corners, of positive volume. Those of outer faces lie on the mesh.
        Tetrahedra that share a node are joined by faces about it.

    Raises:
        VolfrepError: the lattice would have more than `MOST_CUBES` cubes.
    """
    low, high = mesh.bounds
    cubes = np.ceil((high - low) / edge).astype(np.int64) + 3
    if cubes.prod() > MOST_CUBES:
        raise VolfrepError(
            f"Its lattice of tetrahedra would have {cubes.prod():,} cubes (the limit is "
            f"{MOST_CUBES:,})."
        )
    # A hair off the middle, so that round sizes do not end on lattice points.
    lattice = _Lattice(0.5 * (low + high) - (0.5 * cubes + 0.0137) * edge, edge, cubes)
    moved = TriangleMesh(mesh.vertices - lattice.origin, mesh.triangles)
    rows, inside = _tetrahedra(moved, lattice, monitor)
    if not len(rows):
        return np.zeros((0, 3)), rows
    used, corners = np.unique(rows, return_inverse=True)
    corners = corners.reshape(-1, 4)
    sign = np.where(inside[used], 1, -1)
    number = lattice.numbers(used)
    points = 0.5 * edge * number
    ends, share, is_long = _cut_edges(moved, lattice, corners, sign, used, number, monitor)
    cut = points[ends[:, 0]] + share[:, None] * (points[ends[:, 1]] - points[ends[:, 0]])
    points, sign = _warped(points, sign, ends, share, is_long, cut, edge)
    still = (sign[ends] != 0).all(axis=1)
    points, corners = _stencils(points, sign, corners, ends[still], cut[still])
    points, corners = _without_hinges(points, corners)
    return points + lattice.origin, corners


def _along_all(lattice: _Lattice, odd: bool) -> tuple[Floats, Floats, Floats]:
    return lattice.along(0, odd), lattice.along(1, odd), lattice.along(2, odd)


def _tetrahedra(mesh: TriangleMesh, lattice: _Lattice, monitor: Monitor) -> tuple[Ints, Bools]:
    """The tetrahedra (m, 4) that reach inside, by rows of points; (rows,) which are inside."""
    even, odd = (
        inside_grid(mesh, *_along_all(lattice, is_odd), monitor) for is_odd in (False, True)
    )
    strides, found = lattice.strides, []
    for axis in range(3):
        monitor.tick()
        # Two middles of cubes that meet in a face, and each of its four sides.
        middle, corner = np.moveaxis(odd, axis, 0), np.moveaxis(even, axis, 0)[1:-1]
        one, two = (stride for k, stride in enumerate(strides) if k != axis)
        corner_of = {(i, j): corner[:, i : i - 1 or None, j : j - 1 or None]
                     for i in (0, 1) for j in (0, 1)}  # fmt: skip
        ring = ((0, 0), (1, 0), (1, 1), (0, 1))
        for begin, end in zip(ring, ring[1:] + ring[:1], strict=True):
            reach = middle[:-1] | middle[1:] | corner_of[begin] | corner_of[end]
            at = np.stack(np.nonzero(reach), axis=1)
            first = 2 * at @ np.array([strides[axis], one, two]) + strides.sum()
            face = first + strides[axis] - one - two
            sides = [face + 2 * (i * one + j * two) for i, j in (begin, end)]
            found.append(np.stack([first, first + 2 * strides[axis], *sides], axis=1))
    inside = np.zeros(2 * lattice.cubes + 1, bool)
    inside[::2, ::2, ::2], inside[1::2, 1::2, 1::2] = even, odd
    return np.concatenate(found), inside.ravel()


def _cut_edges(
    mesh: TriangleMesh, lattice: _Lattice, corners: Ints, sign: Ints, used: Ints, number: Ints,
    monitor: Monitor,
) -> tuple[Ints, Floats, Bools]:  # fmt: skip
    """Edges from inside to outside: their ends (k, 2), where they are cut, whether they are long.

    Of several cuts one; where rounding tells of none though its ends differ, in the middle.
    """
    pairs = corners[:, _EDGES].reshape(-1, 2)
    pairs = pairs[sign[pairs[:, 0]] != sign[pairs[:, 1]]]
    pairs = np.unique(np.sort(pairs, axis=1) @ np.array([len(used), 1]))
    ends = np.stack(np.divmod(pairs, len(used)), axis=1)
    way = (number[ends[:, 1]] - number[ends[:, 0]]) @ np.array([9, 3, 1])
    order = np.argsort(_WAYS @ np.array([9, 3, 1]))
    kind = order[np.searchsorted((_WAYS @ np.array([9, 3, 1]))[order], way)]
    name = used[ends[:, 0]] * len(_WAYS) + kind
    names, shares = (np.concatenate(part) for part in zip(*_crossings(mesh, lattice, monitor),
                                                          strict=True))  # fmt: skip
    order = np.lexsort((shares, names))
    names, shares = names[order], shares[order]
    at = np.minimum(np.searchsorted(names, name), len(names) - 1)
    share = np.where(names[at] == name, shares[at], 0.5)
    turned = sign[ends[:, 0]] < 0
    ends[turned] = ends[turned][:, ::-1]
    return ends, np.where(turned, 1.0 - share, share), kind < 3


def _crossings(
    mesh: TriangleMesh, lattice: _Lattice, monitor: Monitor
) -> Iterator[tuple[Ints, Floats]]:
    """Where lattice edges cross the mesh: edges by the row of their lower end and their way."""
    half = 0.5 * lattice.edge
    for kind, way in enumerate(_WAYS.tolist()):
        monitor.tick()
        axis = kind if kind < 3 else 0
        turned = [(axis + 1) % 3, (axis + 2) % 3, axis]
        step = way[axis]
        # Sheared so that the lines of this way are upright, and stand in a square grid.
        lean = np.array([way[turned[0]], way[turned[1]]]) // step
        sheared = mesh.vertices[:, turned].copy()
        sheared[:, :2] -= sheared[:, 2:] * lean
        upright = TriangleMesh(sheared, mesh.triangles)
        low, high = upright.bounds / half
        for odd in (0, 1) if kind < 3 else (0,):
            lines = [2 * np.arange(int(low[k] // 2), int(high[k] // 2) + 2) + odd for k in (0, 1)]
            xs, ys = (half * line for line in lines)
            i, j, height, _ = column_crossings(upright, xs, ys, monitor)
            place = (height / half - odd) / step
            below = np.floor(place).astype(np.int64)
            number = np.empty((len(i), 3), np.int64)
            number[:, axis] = below * step + odd
            for k, line in enumerate((lines[0][i], lines[1][j])):
                number[:, turned[k]] = line + lean[k] * number[:, axis]
            yield number @ lattice.strides * len(_WAYS) + kind, place - below


def _warped(
    points: Floats, sign: Ints, ends: Ints, share: Floats, is_long: Bools, cut: Floats, edge: float
) -> tuple[Floats, Ints]:
    """Points too near to a cut put there, the nearest one, where they are neither in nor out."""
    near = np.where(is_long, NEAR_LONG, NEAR_SHORT)
    length = edge * np.where(is_long, 1.0, np.sqrt(0.75))
    points, sign = points.copy(), sign.copy()
    point, place, apart = [], [], []
    for k, part in enumerate((share, 1.0 - share)):
        some = part < near
        point.append(ends[some, k])
        place.append(cut[some])
        apart.append((part * length)[some])
    who = np.concatenate(point)
    order = np.lexsort((np.concatenate(apart), who))
    moved, first = np.unique(who[order], return_index=True)
    points[moved] = np.concatenate(place)[order][first]
    sign[moved] = 0
    return points, sign


def _stencils(
    points: Floats, sign: Ints, corners: Ints, ends: Ints, cut: Floats
) -> tuple[Floats, Ints]:
    """What of each tetrahedron lies inside, as tetrahedra; the cuts follow the points."""
    count = len(points)
    name = np.sort(ends, axis=1) @ np.array([count, 1])
    order = np.argsort(name)
    name = name[order]
    points = np.concatenate([points, cut[order]])

    def between(a: Ints, b: Ints) -> Ints:
        at: Ints = count + np.searchsorted(name, np.minimum(a, b) * count + np.maximum(a, b))
        return at

    corners = corners[(sign[corners] == 1).any(axis=1)]
    # First those inside, then those on the surface.
    corners = np.take_along_axis(corners, np.argsort(-sign[corners], axis=1, kind="stable"), 1)
    ins, outs = ((sign[corners] == side).sum(axis=1) for side in (1, -1))
    found = [corners[outs == 0]]
    for out in (1, 2, 3):
        a, *rest = corners[(ins == 1) & (outs == out)].T
        kept = rest[: 3 - out]
        found.append(np.stack([a, *kept, *(between(a, b) for b in rest[3 - out :])], axis=1))
    a, b, c, d = corners[(ins == 2) & (outs == 1)].T
    found += _pyramids(points, c, (a, b, between(b, d), between(a, d)))
    a, b, c, d = corners[(ins == 2) & (outs == 2)].T
    low, high = (a, between(a, c), between(a, d)), (b, between(b, c), between(b, d))
    a, b, c, d = corners[(ins == 3) & (outs == 1)].T
    prisms = (low, (a, b, c)), (high, (between(a, d), between(b, d), between(c, d)))
    one, other = (
        np.stack([np.concatenate(pair) for pair in zip(*both, strict=True)], axis=1)
        for both in prisms
    )
    middles, pieces = _prisms(points, one, other)
    points = np.concatenate([points, middles])
    filled = np.concatenate([*found, *pieces])
    turned = signed_volumes(points, filled) < 0.0
    filled[turned] = filled[turned][:, [0, 1, 3, 2]]
    used, filled = np.unique(filled, return_inverse=True)
    return points[used], filled.reshape(-1, 4)


def signed_volumes(points: Floats, corners: Ints) -> Floats:
    """(m,) volumes of tetrahedra (m, 4), mm3."""
    a, b, c, d = (points[corners[:, k]] for k in range(4))
    result: Floats = np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a) / 6.0
    return result


def _is_first(points: Floats, a: Ints, b: Ints, c: Ints, d: Ints) -> Bools:
    """Whether quadrangles are divided from a to c: the shorter way, from both sides the same."""
    one, two = (((points[p] - points[q]) ** 2).sum(axis=1) for p, q in ((a, c), (b, d)))
    tied = np.abs(one - two) <= EQUAL * (one + two)
    result: Bools = np.where(tied, np.minimum(a, c) < np.minimum(b, d), one < two)
    return result


def _pyramids(points: Floats, top: Ints, base: tuple[Ints, Ints, Ints, Ints]) -> list[Ints]:
    """Pyramids as two tetrahedra each."""
    a, b, c, d = base
    first = _is_first(points, a, b, c, d)
    return [
        np.stack([top, p, q, r], axis=1)[chosen]
        for chosen, halves in ((first, ((a, b, c), (a, c, d))), (~first, ((a, b, d), (b, c, d))))
        for p, q, r in halves
    ]


def _prisms(points: Floats, low: Ints, high: Ints) -> tuple[Floats, list[Ints]]:
    """Prisms between triangles (k, 3) as tetrahedra, and points in the middles of some.

    Where the diagonals of the three sides run round, no three tetrahedra fill it: then eight do,
    about its middle.
    """
    after = [1, 2, 0]
    up = np.stack([_is_first(points, low[:, k], low[:, after[k]], high[:, after[k]], high[:, k])
                   for k in range(3)], axis=1)  # fmt: skip
    pieces: list[Ints] = []

    def side(rows: Ints, k: int, chosen: Bools) -> list[tuple[Bools, Ints]]:
        a, b, c, d = low[rows, k], low[rows, after[k]], high[rows, after[k]], high[rows, k]
        return [
            (chosen, np.stack([a, b, c], 1)[chosen]), (chosen, np.stack([a, c, d], 1)[chosen]),
            (~chosen, np.stack([a, b, d], 1)[~chosen]), (~chosen, np.stack([b, c, d], 1)[~chosen]),
        ]  # fmt: skip

    for k in range(3):
        # Both sides at this lower corner are divided from there.
        rows = np.flatnonzero(up[:, k] & ~up[:, k - 1])
        apex = low[rows, k]
        pieces.append(np.concatenate([apex[:, None], high[rows]], axis=1))
        for chosen, facet in side(rows, after[k], up[rows, after[k]]):
            pieces.append(np.concatenate([apex[chosen, None], facet], axis=1))
    rows = np.flatnonzero(up.all(axis=1) | ~up.any(axis=1))
    middle = len(points) + np.arange(len(rows))
    pieces += [np.concatenate([middle[:, None], ends[rows]], axis=1) for ends in (low, high)]
    for k in range(3):
        for chosen, facet in side(rows, k, up[rows, k]):
            pieces.append(np.concatenate([middle[chosen, None], facet], axis=1))
    return (points[low[rows]].sum(axis=1) + points[high[rows]].sum(axis=1)) / 6.0, pieces


def face_pairs(corners: Ints) -> tuple[Ints, Ints]:
    """Tetrahedra (k, 2) that share a face, and the outer faces (f, 3), seen from outside."""
    faces = corners[:, FACES].reshape(-1, 3)
    ordered = np.sort(faces, axis=1)
    order = np.lexsort(ordered.T[::-1])
    same = (ordered[order[1:]] == ordered[order[:-1]]).all(axis=1)
    pairs = np.stack([order[:-1][same], order[1:][same]], axis=1) // 4
    outer = np.ones(len(faces), bool)
    outer[order[:-1][same]] = outer[order[1:][same]] = False
    return pairs, faces[outer]


def bodies_of(corners: Ints) -> tuple[int, Ints]:
    """How many bodies tetrahedra are that share faces, and (m,) that of each."""
    pairs, _ = face_pairs(corners)
    return _groups(pairs, len(corners))


def _groups(pairs: Ints, count: int) -> tuple[int, Ints]:
    graph = coo_array((np.ones(len(pairs), bool), tuple(pairs.T)), shape=(count, count))
    number, group = connected_components(graph, directed=False)
    return int(number), np.asarray(group, np.int64)


def _without_hinges(points: Floats, corners: Ints) -> tuple[Floats, Ints]:
    """Tetrahedra without crumbs, and with a node of its own for each side of a mere touch."""
    number, body = bodies_of(corners)
    volume = np.bincount(body, signed_volumes(points, corners), number)
    corners = corners[(volume > CRUMB * volume.sum())[body]]
    pairs, _ = face_pairs(corners)
    # Corners of tetrahedra are one node where those share a face at it.
    one, two = corners[pairs[:, 0]], corners[pairs[:, 1]]
    row, here, there = np.nonzero(one[:, :, None] == two[:, None, :])
    same = np.stack([4 * pairs[row, 0] + here, 4 * pairs[row, 1] + there], axis=1)
    _, node = _groups(same, corners.size)
    _, first, node = np.unique(node, return_index=True, return_inverse=True)
    return points[corners.ravel()[first]], node.reshape(-1, 4)

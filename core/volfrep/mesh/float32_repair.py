# SPDX-License-Identifier: LGPL-2.1-or-later
"""Repair for single precision: collapse edges as short as the steps between its numbers.

And slivers as thin: three corners almost on a line may lie on it after rounding.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..util.parallel import ParallelBackend, SharedArray
from ..util.ragged import rows_of
from ..util.threads import in_threads
from ..util.types import Bools, Ints
from . import remesh
from .precision import merging_vertices
from .topology import edge_keys, numbered, open_vertices, touching, vertices_of
from .triangle_mesh import TriangleMesh, corners_at, rows_where

#: By rounding a height may come out so many times as large, from whichever corner it is taken.
NEARLY = 1.001
#: Edges shorter than this many steps of float32 at the mesh's farthest coordinate are removed.
STEPS = 16
#: Passes over the edges: each takes those that do not touch each other.
PASSES = 8
#: Corners of so many times fewer triangles than there are vertices are sorted and not counted.
FEW = 32
#: Triangles looked at at a time.
BLOCK_TRIANGLES = 1 << 15
#: Rows of a mesh that another process writes at a time.
CALL_ROWS = 1 << 19


def shortest_edge(mesh: TriangleMesh) -> float:
    """Length in mm below which an edge may not survive in a file of single precision."""
    return edge_within(mesh.bounds)


def edge_within(bounds: NDArray[np.float64]) -> float:
    """`shortest_edge` of a mesh with such bounds, (2, 3) mm."""
    return float(STEPS * np.spacing(np.float32(np.abs(bounds).max(initial=1.0))))


def remove_slivers(mesh: TriangleMesh, tolerance: float) -> TriangleMesh:
    """The closed mesh without edges or heights below `tolerance` mm, where topology allows it.

    Only the neighbourhoods of such triangles are touched; genus, shells and closedness stay.

    Args:
        mesh: closed.
        tolerance: mm.
    """
    repair = repair_slivers(mesh, tolerance)
    return repair.applied(mesh)[0] if len(repair.old) else mesh


@dataclass(frozen=True, eq=False)
class Repair:
    """Triangles of a mesh that others take the place of.

    Attributes:
        old: (k,) those that go, ascending.
        piece: (p, 3) int32, those that come, of the same vertices.
        origin: (p,) which of the old ones each is in the place of.
        new: (p,) bool, those that were not among the old ones, or elsewhere.
        moved: (v,) vertices of theirs that move, of no other triangle, ascending.
        places: (v, 3) where to, mm.
        unused: (u,) vertices that go, ascending.
    """

    old: Ints
    piece: NDArray[np.int32]
    origin: Ints
    new: Bools
    moved: Ints
    places: NDArray[np.float64]
    unused: Ints

    @property
    def gone(self) -> Ints:
        """The triangles that are not there any more, or elsewhere."""
        is_gone = np.ones(len(self.old), bool)
        is_gone[self.origin[~self.new]] = False
        result: Ints = self.old[is_gone]
        return result

    def stays(self, mesh: TriangleMesh) -> Bools:
        """(m,) which triangles of the mesh stay."""
        result = np.ones(len(mesh.triangles), bool)
        result[self.old] = False
        return result

    def some(self, mesh: TriangleMesh, triangles: NDArray[np.int32]) -> TriangleMesh:
        """A mesh of some of the triangles that stay and that come."""
        used: Ints
        if FEW * triangles.size < len(mesh.vertices):
            used, local = np.unique(triangles.astype(np.int64), return_inverse=True)
            local = local.reshape(-1, 3)
        else:
            used, local = numbered(triangles, len(mesh.vertices))
        vertices = corners_at(mesh.vertices, used)
        place = np.searchsorted(used, self.moved)
        here = place < len(used)
        here[here] = used[place[here]] == self.moved[here]
        vertices[place[here]] = self.places[here]
        return TriangleMesh(vertices, local.astype(np.int32))

    def applied(
        self,
        mesh: TriangleMesh,
        goes: Bools | None = None,
        piece_goes: Bools | None = None,
        backend: ParallelBackend | None = None,
    ) -> tuple[TriangleMesh, NDArray[np.int32]]:
        """What is left of the mesh, triangles that come last; (n,) the number of vertices in use.

        Args:
            mesh: that it is of, all of its vertices in use.
            goes: (m,) bool, triangles of the mesh that go, too, whole shells; None: none.
            piece_goes: (p,) bool, those that come of these; None: none.
            backend: gathers what is left, for its calls; None: for threads.
        """
        backend = backend or ParallelBackend()
        in_use, stays, piece = np.ones(len(mesh.vertices), bool), self.stays(mesh), self.piece
        in_use[self.unused] = False
        if goes is not None:
            in_use[mesh.triangles[goes]] = False
            stays &= ~goes
        if piece_goes is not None:
            in_use[piece[piece_goes]] = False
            piece = piece[~piece_goes]
        number = np.cumsum(in_use, dtype=np.int32)
        number -= 1
        there = in_use[self.moved]
        moved, places = number[self.moved[there]], self.places[there]
        counts = int(np.count_nonzero(in_use)), int(np.count_nonzero(stays)) + len(piece)
        size = CALL_ROWS if backend.uses_processes else BLOCK_TRIANGLES
        arrays = mesh.vertices, mesh.triangles, in_use, stays, number
        with backend.sharing(*arrays) as (points, corners, is_used, is_kept, numbers):

            def some_vertices() -> Iterator[tuple[int, tuple[Any, ...]]]:
                filled = 0
                for start in range(0, len(in_use), size):
                    count = int(np.count_nonzero(in_use[start : start + size]))
                    first, last = np.searchsorted(moved, (filled, filled + count))
                    change = moved[first:last] - filled, places[first:last]
                    yield count, (points, is_used, start, size, *change)
                    filled += count

            def some_triangles() -> Iterator[tuple[int, tuple[Any, ...]]]:
                for start in range(0, len(stays), size):
                    last = piece if start + size >= len(stays) else piece[:0]
                    count = int(np.count_nonzero(stays[start : start + size])) + len(last)
                    yield count, (corners, is_kept, start, size, numbers, last)

            vertices = backend.made(_left_vertices, some_vertices(), (counts[0], 3), np.float64)
            triangles = backend.made(_left_triangles, some_triangles(), (counts[1], 3), np.int32)
        return TriangleMesh(vertices, triangles), number


def _left_vertices(
    vertices: SharedArray,
    in_use: SharedArray,
    start: int,
    size: int,
    moved: Ints,
    places: NDArray[np.float64],
) -> NDArray[np.float64]:
    """Those of some vertices that are in use, a few of them, by their rows then, elsewhere."""
    part = _kept(in_use, vertices, start, size)
    if len(moved):
        part = part.copy()
        part[moved] = places
    return part


def _left_triangles(
    triangles: SharedArray,
    stays: SharedArray,
    start: int,
    size: int,
    number: SharedArray,
    more: NDArray[np.int32],
) -> NDArray[np.int32]:
    """Those of some triangles that stay, and more, of the vertices' new numbers."""
    rows = _kept(stays, triangles, start, size)
    if len(more):
        rows = np.concatenate([rows, more])
    return np.take(number.array, rows, mode="clip")


def _kept(kept: SharedArray, rows: SharedArray, start: int, size: int) -> NDArray[Any]:
    """Those that are kept, nearly all of them, of some rows."""
    some, part = kept.array[start : start + size], rows.array[start : start + size]
    return part if some.all() else rows_where(some, part)


_NONE = np.zeros(0, np.int64)
#: Nothing changes.
NO_REPAIR = Repair(
    _NONE, np.zeros((0, 3), np.int32), _NONE, _NONE > 0, _NONE, np.zeros((0, 3)), _NONE
)


def repair_slivers(
    mesh: TriangleMesh,
    tolerance: float,
    among: Ints | None = None,
    backend: ParallelBackend | None = None,
) -> Repair:
    """As `remove_slivers`: what changes; with `among` only these triangles are looked at.

    Args:
        mesh: all of its vertices in use.
        tolerance: mm.
        among: rows of triangles; None: all.
        backend: as of `touching`.
    """
    if among is None:
        thin = slivers(mesh, tolerance)
    else:
        thin = among[_slivers(mesh.vertices, mesh.triangles[among], tolerance)]
    if not len(thin):
        return NO_REPAIR
    rest = _without(mesh.vertices, mesh.triangles, thin, tolerance, PASSES, None, backend)
    differs, new = rest.differences(mesh)
    # Vertices at the border of what was looked at are those of other triangles, too, and stay.
    unused = vertices_of(mesh.triangles[rest.old], len(mesh.vertices))
    unused[rest.piece] = False
    return Repair(
        rest.old, rest.piece, rest.origin, new, rest.stay[differs], rest.places[differs],
        np.flatnonzero(unused),
    )  # fmt: skip


def without_inner_slivers(
    mesh: TriangleMesh, rim: Ints, tolerance: float
) -> tuple[TriangleMesh, Bools, Ints]:
    """As `remove_slivers`, of an open mesh: nothing changes near its rim.

    Args:
        mesh: open at its rim only.
        rim: vertices at open edges.
        tolerance: mm.

    Returns:
        the mesh with all its vertices, some of them out of use, (m,) bool which of its triangles
        were not there or elsewhere, and (m,) which one each was, -1 for these.
    """
    thin = _slivers(mesh.vertices, mesh.triangles, tolerance)
    at_rim = vertices_of(rim, len(mesh.vertices))
    near = vertices_of(mesh.triangles[touching(at_rim, mesh.triangles)], len(at_rim))
    near |= at_rim
    result = _rebuilt(mesh, thin[~touching(near, mesh.triangles[thin])], tolerance)
    if touching(at_rim, result[0].triangles[result[1]]).any():
        return mesh, np.zeros(len(mesh.triangles), bool), np.arange(len(mesh.triangles))
    return result


def _rebuilt(mesh: TriangleMesh, thin: Ints, tolerance: float) -> tuple[TriangleMesh, Bools, Ints]:
    """As `without_inner_slivers`, of chosen triangles."""
    if not len(thin):
        return mesh, *_nothing_new(mesh)
    rest = _without(mesh.vertices, mesh.triangles, thin, tolerance, PASSES)
    stayed, new, origin = rest.compared(mesh)
    points = mesh.vertices.copy()
    points[rest.stay] = rest.places
    was = np.where(new, -1, origin)
    return TriangleMesh(points, rest.joined(mesh.triangles, stayed)), new, was


def _nothing_new(mesh: TriangleMesh) -> tuple[Bools, Ints]:
    return np.zeros(len(mesh.triangles), bool), np.arange(len(mesh.triangles))


def _differ(rows: NDArray[Any], others: NDArray[Any]) -> Bools:
    """(m,) which rows of three are not the same."""
    # A column at a time: numpy is slow at reducing many short rows.
    a, b, c = (rows[:, k] != others[:, k] for k in range(3))
    return np.asarray(a | b | c, np.bool_)


def slivers(mesh: TriangleMesh, tolerance: float) -> Ints:
    """The triangles with an edge or a height below the tolerance, mm."""
    return _slivers(mesh.vertices, mesh.triangles, tolerance)


def _slivers(points: NDArray[np.float64], triangles: NDArray[Any], tolerance: float) -> Ints:
    columns = points.T

    def block(start: int) -> Ints:
        part = triangles[start : start + BLOCK_TRIANGLES]
        found: Ints = _slivers_in(columns, part, tolerance) + start
        return found

    found = in_threads(block, range(0, len(triangles), BLOCK_TRIANGLES))
    return np.concatenate([np.zeros(0, np.int64), *found])


def _slivers_in(columns: NDArray[np.float64], triangles: NDArray[Any], tolerance: float) -> Ints:
    corners = [np.ascontiguousarray(triangles[:, k]) for k in range(3)]
    sides: list[list[NDArray[np.float64]]] = [[], [], []]
    for column in columns:
        a, b, c = (column[corner] for corner in corners)
        for side, difference in zip(sides, (a - b, b - c, c - a), strict=True):
            side.append(difference)
    first, second, third = (x * x + y * y + z * z for x, y, z in sides)
    (x, y, z), (u, v, w) = sides[:2]
    twice = (y * w - z * v) ** 2 + (z * u - x * w) ** 2 + (x * v - y * u) ** 2
    thin = twice < tolerance**2 * np.maximum(np.maximum(first, second), third)
    thin |= np.minimum(np.minimum(first, second), third) < tolerance**2
    return np.flatnonzero(thin)


class _Rest(NamedTuple):
    """What is left of the triangles of a mesh that were looked at.

    Attributes:
        stay: (k,) vertices of theirs that may still be in use.
        places: (k, 3) where these are now.
        piece: (p, 3) int32, the triangles that are left.
        old: which triangles were looked at, ascending.
        origin: (p,) which of the old ones each triangle was.
    """

    stay: Ints
    places: NDArray[np.float64]
    piece: NDArray[np.int32]
    old: Ints
    origin: Ints

    def joined(self, triangles: NDArray[np.int32], stayed: Ints) -> NDArray[np.int32]:
        """The mesh's triangles that stayed, and then those that are left."""
        result = np.empty((len(stayed) + len(self.piece), 3), np.int32)
        np.take(triangles, stayed, axis=0, out=result[: len(stayed)], mode="clip")
        result[len(stayed) :] = self.piece
        return result

    def compared(self, mesh: TriangleMesh) -> tuple[Ints, Bools, Ints]:
        """The triangles of the mesh that stayed; which of all are new, and what each was."""
        untouched = np.ones(len(mesh.triangles), bool)
        untouched[self.old] = False
        stayed = np.flatnonzero(untouched)
        new = np.pad(self.differences(mesh)[1], (len(stayed), 0))
        return stayed, new, np.concatenate([stayed, self.old[self.origin]])

    def differences(self, mesh: TriangleMesh) -> tuple[Bools, Bools]:
        """Which vertices that stay move, and which triangles were not there, or elsewhere."""
        moved = np.zeros(len(mesh.vertices), bool)
        differs = _differ(self.places, mesh.vertices[self.stay])
        moved[self.stay] = differs
        was = mesh.triangles[self.old[self.origin]]
        return differs, _differ(self.piece, was) | touching(moved, self.piece)


def _without(
    points: NDArray[np.float64],
    triangles: NDArray[np.int32],
    thin: Ints,
    tolerance: float,
    passes: int,
    changed: Bools | None = None,
    backend: ParallelBackend | None = None,
) -> _Rest:
    """What is left of a mesh with some slivers.

    A pass leaves few slivers: the next one looks at their neighbourhoods only, and only where the
    last one has `changed` something, (n,) bool: it would leave all else as it is once more.
    """
    # Two rings of triangles about the slivers; the outer ring's border stays as it is.
    if changed is not None:
        thin = thin[touching(changed, triangles[thin])]
        if not len(thin):
            nothing = np.zeros(0, np.int64)
            return _Rest(nothing, points[nothing], triangles[nothing], nothing, nothing)
    near = vertices_of(triangles[thin], len(points))
    near[triangles[touching(near, triangles, backend)]] = True
    part = np.flatnonzero(touching(near, triangles, backend))
    used, local = numbered(triangles[part], len(points))
    moved, kept, inner, origin = _collapse(points[used], local, tolerance)
    inner, flipped = _flip_slivers(moved, inner, tolerance)
    if not flipped and len(kept) == len(used):
        moved, kept, inner, origin = _close_slivers(moved, inner, tolerance)
    stay = used[kept]
    piece = inner.astype(np.int32)
    if passes > 1 and (flipped or len(stay) < len(used)):
        left = _slivers(moved, piece, tolerance)
        if len(left):
            fresh = _differ(stay[piece], triangles[part[origin]])
            fresh |= touching(_differ(moved, points[stay]), piece)
            near = vertices_of(piece[fresh], len(stay))
            for _ in range(2):  # rings within which it may have kept back something else
                near[piece[touching(near, piece)]] = True
            rest = _without(moved, piece, left, tolerance, passes - 1, near)
            moved[rest.stay] = rest.places
            stayed = np.delete(np.arange(len(piece)), rest.old)
            origin = origin[np.concatenate([stayed, rest.old[rest.origin]])]
            piece = rest.joined(piece, stayed)
    return _Rest(stay, moved, stay[piece].astype(np.int32), part, origin)


class _Collapsed(NamedTuple):
    """An open piece of mesh after edges were collapsed.

    Attributes:
        points: (k, 3) that are left.
        kept: (k,) which they were.
        triangles: that are left.
        origin: (m,) which they were.
    """

    points: NDArray[np.float64]
    kept: Ints
    triangles: Ints
    origin: Ints

    @classmethod
    def of(
        cls,
        points: NDArray[np.float64],
        triangles: Ints,
        used: Ints,
        some: NDArray[np.float64],
        renumber: Ints,
    ) -> _Collapsed:
        """What `remesh.collapse` has made of all triangles at those `used` points that went.

        Args:
            points: (n, 3) as they were.
            triangles: (m, 3) as they were.
            used: (u,) the points that it was given, ascending.
            some: those of these that are left.
            renumber: (u,) as it returns it.
        """
        every, gone = np.arange(len(points)), renumber < 0
        if not gone.any():
            return cls(points, every, triangles, np.arange(len(triangles)))
        left, merged, moved = used[~gone], every.copy(), points.copy()
        moved[left] = some
        merged[used[gone]] = left[~renumber[gone]]
        kept = np.flatnonzero(merged == every)
        number = np.zeros(len(points), np.int64)
        number[kept] = np.arange(len(kept))
        result = number[merged[triangles]]
        one, two, three = result.T
        stays = np.flatnonzero((one != two) & (two != three) & (three != one))
        return cls(moved[kept], kept, result[stays], stays)


def _collapse(points: NDArray[np.float64], triangles: Ints, tolerance: float) -> _Collapsed:
    """An open piece of mesh, collapsed within its border."""
    # Short edges are few: the triangles about their ends tell all of what may be done there, and
    # in their order.
    ends = _short_ends(points, triangles, NEARLY * tolerance)
    used, local = numbered(triangles[touching(ends, triangles)], len(points))
    rank = open_vertices(local, len(used)).astype(np.int64)
    rules = _rules(rank, lambda a, b: _keeps_side(a, b, tolerance))
    some, _, renumber = remesh.collapse(points[used], local, rules, tolerance, np.inf)
    return _Collapsed.of(points, triangles, used, some, renumber)


def _short_ends(points: NDArray[np.float64], triangles: Ints, length: float) -> Bools:
    """(n,) which vertices are at edges shorter than a length, mm."""
    found = np.zeros(len(points), bool)
    corners = [np.ascontiguousarray(triangles[:, k]) for k in range(3)]
    for one, two in zip(corners, [*corners[1:], corners[0]], strict=True):
        square = np.zeros(len(one))
        for column in points.T:
            square += (column[one] - column[two]) ** 2
        short = square < length**2
        found[one[short]] = True
        found[two[short]] = True
    return found


def _rules(
    rank: Ints,
    stays_good: Callable[[NDArray[np.float64], NDArray[np.float64]], Bools],
    merge: Callable[[Ints, Ints], tuple[NDArray[np.float64], NDArray[np.float64]]] | None = None,
) -> remesh.Rules:
    """What may be collapsed: all but vertices of the border, which stay where they are."""

    def is_free(gone: Ints, _: Ints) -> Bools:
        free: Bools = rank[gone] == 0
        return free

    return remesh.Rules(rank, is_free, _none, stays_good, merge)


def _flip_slivers(
    points: NDArray[np.float64], triangles: Ints, tolerance: float
) -> tuple[Ints, int]:
    """Slivers given away to the triangle beyond their longest edge."""
    thin = vertices_of(_slivers(points, triangles, NEARLY * tolerance), len(triangles))
    # Slivers are few: the triangles about their corners tell which edges there are.
    rows = np.flatnonzero(touching(vertices_of(triangles[thin], len(points)), triangles))
    used, local = numbered(triangles[rows], len(points))
    some = points[used]

    def gain(ends: Ints, corners: Ints) -> NDArray[np.float64]:
        a, b, c, d = (
            some[ends[:, 0]],
            some[ends[:, 1]],
            some[corners[:, 0]],
            some[corners[:, 1]],
        )
        old, new = (
            np.minimum(*(remesh.heights(np.stack(corners, axis=1)) for corners in pair))
            for pair in (((a, b, c), (b, a, d)), ((c, d, b), (d, c, a)))
        )
        wanted: NDArray[np.float64] = np.where(old < tolerance, new - 1.5 * old, -1.0)
        return wanted

    local, flipped = remesh.flip(some, local, gain, _none, thin[rows])
    if flipped:
        triangles = triangles.copy()
        triangles[rows] = used[local]
    return triangles, flipped


def _close_slivers(points: NDArray[np.float64], triangles: Ints, tolerance: float) -> _Collapsed:
    """As `_collapse`, of slivers that no flip helps, such as some in a row along a crease.

    The corner that lies on the edge opposite to it is merged into the nearer end of that edge, if
    this lies in the planes of all other facets about the corner: the surface stays.
    """
    count = len(points)
    rank = open_vertices(triangles, count).astype(np.int64)
    thin = triangles[_slivers(points, triangles, tolerance)]
    corners, row = points[thin], np.arange(len(thin))
    opposite = np.linalg.norm(np.roll(corners, -1, axis=1) - np.roll(corners, 1, axis=1), axis=2)
    middle = opposite.argmax(axis=1)
    one, two = (middle + 1) % 3, (middle + 2) % 3
    nearer = np.where(opposite[row, two] <= opposite[row, one], one, two)
    inner = rank[thin[row, middle]] == 0
    gone, kept = thin[row, middle][inner], thin[row, nearer][inner]
    start, around = remesh.grouped(
        triangles.ravel(), np.repeat(np.arange(len(triangles)), 3), count
    )
    rows, owner = rows_of(start, gone)
    facets = corners_at(points, triangles[around[rows]])
    way = points[kept[owner]] - points[gone[owner]]
    off = np.abs((remesh.unit_normals(facets) * way).sum(axis=1))
    off[_is_thin(facets, tolerance)] = 0.0  # it has no plane
    farthest = np.zeros(len(gone))
    np.maximum.at(farthest, owner, off)
    flat = farthest < tolerance
    if not flat.any():
        return _Collapsed(points, np.arange(count), triangles, np.arange(len(triangles)))
    gone, kept, farthest = gone[flat], kept[flat], farthest[flat]
    edge, first = np.unique(edge_keys(gone, kept, count), return_index=True)

    def merge(a: Ints, b: Ints) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        name = edge_keys(a, b, count)
        place = np.minimum(np.searchsorted(edge, name), len(edge) - 1)
        cost = np.where(edge[place] == name, farthest[first[place]], np.inf)
        return cost, points[kept[first[place]]]

    def good(old: NDArray[np.float64], new: NDArray[np.float64]) -> Bools:
        before, after = remesh.heights(old), remesh.heights(new)
        return (after >= np.minimum(before, tolerance)) & _keeps_side(old, new, tolerance)

    rules = _rules(rank, good, merge)
    some, _, renumber = remesh.collapse(points, triangles, rules, np.inf, np.inf)
    return _Collapsed.of(points, triangles, np.arange(count), some, renumber)


def _none(one: Ints, two: Ints) -> Bools:
    return np.zeros(len(one), bool)


def _keeps_side(old: NDArray[np.float64], new: NDArray[np.float64], tolerance: float) -> Bools:
    """Whether triangles keep their side; a sliver as thin as the tolerance has none to keep."""
    before, after = remesh.normals(old), remesh.normals(new)
    result: Bools = _is_thin(old, tolerance) | (np.einsum("ij,ij->i", before, after) > 0.0)
    return result


def _is_thin(corners: NDArray[np.float64], tolerance: float) -> Bools:
    """Whether triangles (m, 3, 3) are so thin that their normals may be anything."""
    result: Bools = remesh.heights(corners) < 4.0 * tolerance
    return result


def separate_vertices(
    mesh: TriangleMesh, precision: float, backend: ParallelBackend | None = None
) -> TriangleMesh:
    """The mesh with no two vertices that single precision would take for one, where possible.

    Where two sheets of a surface touch, a reader that merges equal corners finds edges of four
    triangles. Such vertices are moved into the material, against their normals, by a few steps of
    single precision.

    Args:
        mesh: closed.
        precision: `shortest_edge` of the part, mm.
        backend: as of `merging_vertices`.
    """
    for attempt in range(1, PASSES + 1):
        twins = merging_vertices(mesh, backend)
        if not len(twins):
            return mesh
        part = mesh.triangles[touching(vertices_of(twins, len(mesh.vertices)), mesh.triangles)]
        normal = np.repeat(remesh.normals(mesh.vertices[part]), 3, axis=0)
        total = np.stack(
            [
                np.bincount(part.ravel(), normal[:, k], minlength=len(mesh.vertices))[twins]
                for k in range(3)
            ],
            axis=1,
        )
        # Twins whose normals agree part nevertheless: each goes a little further than the last.
        length = np.maximum(np.linalg.norm(total, axis=1), 1e-300)
        reach = precision / STEPS * (2.0 + attempt + 3.0 * (np.arange(len(twins)) % 5))
        vertices = mesh.vertices.copy()
        vertices[twins] -= total * (reach / length)[:, None]
        mesh = TriangleMesh(vertices, mesh.triangles)
    return mesh

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Which triangles, edges and vertices of a mesh belong together: all that needs no coordinates.

An edge is a pair of vertices in either order, and has a key. Meshes may be open or not manifold.

scipy's graphs are loaded when a large one is asked for: that takes as long as a small block.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..util.parallel import LocalArray, ParallelBackend, SharedArray
from ..util.ragged import rows_of
from ..util.threads import in_threads
from ..util.types import Bools, Ints
from .triangle_mesh import TriangleMesh

#: Triangles whose edges are counted at once: what that takes does not grow with the mesh then.
BLOCK_TRIANGLES = 1 << 17
#: Triangles that another process looks at at a time.
CALL_TRIANGLES = 1 << 20
#: Vertices chosen at one place are among so few of all that follow each other.
NARROW = 0.05
#: A use of an edge from its lower to its higher end, and one the other way, in one sum of both.
AHEAD, BACK = 1, 1 << 32
#: Vertices per block in `pinched_vertices`.
BLOCK_VERTICES = 1 << 14
#: Up to so many pairs, pieces are found without scipy.
FEW_PAIRS = 50_000


def edge_keys(one: NDArray[Any], two: NDArray[Any], count: int | np.int64) -> Ints:
    """A number for each edge between two of `count` vertices, whichever end comes first."""
    low, high = np.minimum(one, two), np.maximum(one, two)
    keys: Ints = low.astype(np.int64, copy=False) * np.int64(count) + high
    return keys


def ways_along(one: NDArray[Any], two: NDArray[Any], count: int | np.int64) -> Ints:
    """A number for each way from one of `count` vertices to another: an even one and the next one.

    Those two are the ways along one edge, and follow each other where all are sorted.
    """
    return edge_keys(one, two, count) * 2 + (one > two)


def among_edges(one: NDArray[Any], two: NDArray[Any], keys: Ints, count: int | np.int64) -> Bools:
    """Which edges between two of `count` vertices have one of the keys."""
    return np.isin(edge_keys(one, two, count), keys)


def corners_among(chosen: Bools, triangles: NDArray[Any]) -> NDArray[np.int8]:
    """(m,) how many corners of each triangle are among the chosen vertices, (n,) bool."""

    def block(start: int) -> NDArray[np.int8]:
        # A column at a time: numpy is slow at reducing many short rows. An index takes twice as
        # long; numpy copies that of what it takes.
        part = triangles[start : start + BLOCK_TRIANGLES]
        a, b, c = (chosen.take(part[:, k], mode="clip").view(np.int8) for k in range(3))
        return np.asarray(a + b + c, np.int8)

    if len(triangles) <= BLOCK_TRIANGLES:
        return block(0)
    return np.concatenate(list(in_threads(block, range(0, len(triangles), BLOCK_TRIANGLES))))


def touching(
    chosen: Bools, triangles: NDArray[Any], backend: ParallelBackend | None = None
) -> Bools:
    """(m,) which triangles have a corner among the chosen vertices, (n,) bool.

    Args:
        chosen: vertices.
        triangles: corners of each.
        backend: looks at those that lie where it sees them; None: threads do.
    """
    rows = np.flatnonzero(chosen)
    if backend is not None and backend.sees(triangles) and len(rows):
        found = np.zeros(len(triangles), bool)
        with backend.sharing(rows, triangles) as shared:
            starts = range(0, len(triangles), CALL_TRIANGLES)
            calls = ((len(chosen), *shared, start) for start in starts)
            for some in backend.starmap(_touching_some, calls):
                found[some] = True
        return found
    first, last = (int(rows[0]), int(rows[-1])) if len(rows) else (0, -1)

    def block(start: int) -> Bools:
        part = triangles[start : start + BLOCK_TRIANGLES]
        if last - first < NARROW * len(chosen):  # few vertices lie between: the others are not read
            result, corners = np.zeros(len(part), bool), part.ravel()
            near = np.flatnonzero((corners >= first) & (corners <= last))
            result[near[chosen[corners[near]]] // 3] = True
            return result
        a, b, c = (chosen.take(part[:, k], mode="clip") for k in range(3))
        return np.asarray(a | b | c, np.bool_)

    if len(triangles) <= BLOCK_TRIANGLES:
        return block(0)
    return np.concatenate(list(in_threads(block, range(0, len(triangles), BLOCK_TRIANGLES))))


def _touching_some(count: int, rows: SharedArray, triangles: SharedArray, start: int) -> Ints:
    """As `touching`, the numbers of some of many triangles; chosen are rows of so many vertices."""
    chosen = np.zeros(count, bool)
    chosen[rows.array] = True
    some = touching(chosen, triangles.array[start : start + CALL_TRIANGLES])
    found: Ints = np.flatnonzero(some) + start
    return found


def vertices_of(triangles: NDArray[Any], count: int) -> Bools:
    """(count,) which vertices some triangles use."""
    used = np.zeros(count, bool)
    used[triangles] = True
    return used


def displaced_vertices(before: TriangleMesh, after: TriangleMesh) -> Bools:
    """(n,) which vertices of a mesh are elsewhere in one that has as many."""
    moved = np.zeros(len(before.vertices), bool)
    # All coordinates in one row: numpy is slow at reducing many short rows.
    moved[np.flatnonzero((before.vertices != after.vertices).ravel()) // 3] = True
    return moved


def adjacent(chosen: Bools, triangles: NDArray[Any], count: int) -> Bools:
    """(m,) which triangles share one of `count` vertices with a chosen triangle, (m,) bool."""
    return touching(vertices_of(triangles[chosen], count), triangles)


def numbered(triangles: NDArray[Any], count: int) -> tuple[Ints, Ints]:
    """The vertices, of `count`, that triangles use, ascending; the triangles in rows of these."""
    used = vertices_of(triangles, count)
    number = np.cumsum(used, dtype=np.int32)  # half as much to be read at random
    number -= 1
    return np.flatnonzero(used), np.take(number, triangles, mode="clip").astype(np.int64)


@dataclass(frozen=True, eq=False)
class Sides:
    """Sides of triangles, numbered triangle by triangle, and the edges they lie on.

    Attributes:
        sides: (3 m, 2) the vertices a side runs from and to.
        number: (3 m,) the edge of each side; an edge is a pair of vertices in either order.
        count: (e,) sides on each edge.
        balance: (e,) sides that run one way less those that run the other.
    """

    sides: Ints
    number: Ints
    count: Ints
    balance: Ints

    @property
    def open_sides(self) -> Ints:
        """Sides without another triangle across."""
        return np.flatnonzero((self.count == 1)[self.number])

    @property
    def is_closed(self) -> bool:
        """Whether as many triangles run along each edge one way as the other."""
        return not self.balance.any()

    @property
    def is_manifold(self) -> bool:
        """Whether two triangles share each edge."""
        return bool((self.count == 2).all())

    def pairs(self) -> tuple[Ints, Ints]:
        """The two sides on every edge that has two."""
        both = np.flatnonzero((self.count == 2)[self.number])
        order = both[np.argsort(self.number[both], kind="stable")]
        return order[0::2], order[1::2]


def edges_of(mesh: TriangleMesh) -> Sides:
    """The edges of a mesh."""
    t = mesh.triangles.astype(np.int64)
    sides = np.stack([t, np.roll(t, -1, axis=1)], axis=2).reshape(-1, 2)
    keys = edge_keys(sides[:, 0], sides[:, 1], len(mesh.vertices))
    number = np.unique(keys, return_inverse=True)[1].ravel()
    count = np.bincount(number)
    forward = np.bincount(number[sides[:, 0] < sides[:, 1]], minlength=len(count))
    return Sides(sides, number, count, 2 * forward - count)


def triangles_across(mesh: TriangleMesh) -> NDArray[np.int32]:
    """(t, 3) the triangle across each side, from a corner to the next; -1 unless there is just one.

    Found of some triangles at a time: an edge is used in two blocks only if both its ends are.

    Args:
        mesh: any.
    """
    triangles, count = mesh.triangles, len(mesh.vertices)
    starts = range(0, len(triangles), BLOCK_TRIANGLES)
    shared = _in_several_blocks(triangles, starts, count)
    across = np.full(triangles.size, -1, np.int32)

    def join(keys: Ints, sides: Ints) -> None:
        order = np.argsort(keys)
        keys = keys[order]
        same = np.concatenate([[False], keys[1:] == keys[:-1], [False]])
        two = np.flatnonzero(same[1:-1] & ~same[:-2] & ~same[2:])
        one, other = sides[order[two]], sides[order[two + 1]]
        across[one], across[other] = other // 3, one // 3

    def block(start: int) -> tuple[Ints, Ints]:
        part = triangles[start : start + BLOCK_TRIANGLES]
        one, two = part.ravel(), np.roll(part, -1, axis=1).ravel()
        keys = edge_keys(one.astype(np.int64), two.astype(np.int64), count)
        sides = 3 * start + np.arange(len(keys))
        elsewhere = shared[one] & shared[two]
        join(keys[~elsewhere], sides[~elsewhere])
        return keys[elsewhere], sides[elsewhere]

    left = list(in_threads(block, starts))
    if left:
        keys, sides = (np.concatenate(each) for each in zip(*left, strict=True))
        join(keys, sides)
    return across.reshape(-1, 3)


def _in_several_blocks(triangles: NDArray[np.int32], starts: range, count: int) -> Bools:
    """(n,) which of so many vertices triangles of several blocks use."""
    last, shared = np.full(count, -1, np.int32), np.zeros(count, bool)
    for start in starts:
        corners = triangles[start : start + BLOCK_TRIANGLES].ravel()
        before = last[corners]
        shared[corners[(before >= 0) & (before != start)]] = True
        last[corners] = start
    return shared


@dataclass(frozen=True, eq=False)
class EdgeUses:
    """How often the edges of a mesh are used, and what hangs together.

    Attributes:
        count: of edges, pairs of vertices in either order.
        open: edges of a single triangle.
        overused: edges of more than two.
        misoriented: edges whose two triangles run along them in the same direction.
        piece: (n,) int32, which piece of surface each vertex belongs to, pieces by their lowest
            vertex; of no meaning where no triangle uses it.
        pieces: how many there are.
    """

    count: int
    open: int
    overused: int
    misoriented: int
    piece: NDArray[np.int32]
    pieces: int


def edge_uses(
    mesh: TriangleMesh, backend: ParallelBackend | None = None, triangles: SharedArray | None = None
) -> EdgeUses:
    """How often edges are used, found of some triangles at a time.

    An edge is used in two blocks only if both its ends are: such edges are added up at the end.

    Args:
        mesh: any.
        backend: looks at the blocks; None: threads.
        triangles: those of the mesh, as the backend shares them.
    """
    backend, size = backend or ParallelBackend(), np.int64(len(mesh.vertices))
    starts = range(0, len(mesh.triangles), BLOCK_TRIANGLES)
    shared = _in_several_blocks(mesh.triangles, starts, len(mesh.vertices))
    with backend.sharing(shared) as (is_shared,):
        every = triangles or LocalArray(mesh.triangles)
        given = ((every, start, BLOCK_TRIANGLES, is_shared) for start in starts)
        found = list(backend.starmap(_uses_in, given))
    ends, uses = np.zeros((0, 2), np.int64), np.zeros((0, 2), np.int64)
    if found:
        ends = np.concatenate([block.ends for block in found])
        uses = np.concatenate([block.uses for block in found])
    edge, row = np.unique(ends[:, 0] * size + ends[:, 1], return_inverse=True)
    ahead, back = (np.bincount(row.ravel(), uses[:, k], len(edge)) for k in (0, 1))
    counts = np.array([_count_edges(ahead, back), *(block.counted for block in found)]).sum(axis=0)
    count, single, overused, misoriented = counts.tolist()
    piece, pieces = _join_pieces(found, shared)
    return EdgeUses(count, single, overused, misoriented, piece, pieces)


@dataclass(frozen=True, eq=False)
class _Block:
    """What is found of the edges of some triangles.

    Attributes:
        counted: edges that no other block uses, and open, overused, misoriented ones among them.
        ends: (k, 2) the others, and `uses` (k, 2), how often each way.
        vertices: (v,) ascending, that these triangles use, and `piece` (v,) of the block.
        lowest: (p,) the lowest vertex of each piece.
    """

    counted: tuple[int, int, int, int]
    ends: Ints
    uses: Ints
    vertices: NDArray[np.int32]
    piece: NDArray[np.int32]
    lowest: Ints


def _uses_in(every: SharedArray, first: int, count: int, is_shared_in: SharedArray) -> _Block:
    """What is found of some triangles of all, of whose vertices some other ones use, too."""
    from scipy.sparse.csgraph import connected_components

    triangles = every.array[first : first + count]
    low, high = int(triangles.min()), int(triangles.max())
    shared = is_shared_in.array[low : high + 1]
    is_used = np.zeros(len(shared), bool)
    is_used[triangles - np.int32(low)] = True
    used = np.flatnonzero(is_used)
    number = np.cumsum(is_used, dtype=np.int32) - np.int32(1)
    corners = np.ascontiguousarray(number[triangles - np.int32(low)].T)
    vertices = (used + low).astype(np.int32)
    both = _counts(corners, len(used))
    is_shared = shared[used]
    start = np.flatnonzero(is_shared)
    entry, row = rows_of(both.indptr, start)
    elsewhere = is_shared[both.indices[entry]]
    entry, start = entry[elsewhere], start[row[elsewhere]]
    ends = vertices[np.stack([start, both.indices[entry]], axis=1)].astype(np.int64)
    # Most edges are used once each way, and need no further look.
    once = both.data == AHEAD + BACK
    once[entry] = True
    other = both.data[~once]
    _, *faults = _count_edges(other % BACK, other // BACK)
    counted = both.nnz - len(entry), *faults
    uses = np.stack([both.data[entry] % BACK, both.data[entry] // BACK], axis=1)
    pieces, piece = connected_components(both, directed=False)
    lowest = np.empty(pieces, np.int64)
    lowest[piece[::-1]] = vertices[::-1]
    return _Block(counted, ends, uses, vertices, piece, lowest)


def _counts(corners: NDArray[np.int32], size: int) -> Any:
    """Sparse (lower end, higher end) -> `AHEAD` and `BACK` for each way that triangles run there.

    Building it is a counting sort, in compiled code that lets other threads run.
    """
    from scipy.sparse import csr_matrix

    start, end = corners.ravel(), np.concatenate([corners[1], corners[2], corners[0]])
    uses = np.where(start < end, np.int64(AHEAD), np.int64(BACK))
    places = np.minimum(start, end), np.maximum(start, end)
    repeated = start == end
    if repeated.any():
        uses, places = uses[~repeated], (places[0][~repeated], places[1][~repeated])
    return csr_matrix((uses, places), shape=(size, size))


def _count_edges(ahead: Ints, back: Ints) -> tuple[int, int, int, int]:
    """How many edges there are, and open, overused and misoriented ones among them."""
    uses = ahead + back
    return (
        len(uses),
        int(np.count_nonzero(uses == 1)),
        int(np.count_nonzero(uses > 2)),
        int(np.count_nonzero((uses == 2) & (ahead != 1))),
    )


def _join_pieces(blocks: list[_Block], shared: Bools) -> tuple[NDArray[np.int32], int]:
    """The piece of each vertex, and how many there are, of blocks with vertices in common."""
    result = np.zeros(len(shared), np.int32)
    if not blocks:
        return result, 0
    first = np.cumsum([0] + [len(block.lowest) for block in blocks])
    some = [shared[block.vertices] for block in blocks]
    vertex = np.concatenate([block.vertices[at] for block, at in zip(blocks, some, strict=True)])
    owner = np.concatenate(
        [block.piece[at] + k for block, at, k in zip(blocks, some, first, strict=False)]
    )
    order = np.argsort(vertex, kind="stable")
    vertex, owner = vertex[order], owner[order].astype(np.int64)
    same = vertex[1:] == vertex[:-1]
    pieces, label = pieces_of(owner[:-1][same], owner[1:][same], int(first[-1]))
    # Numbered by their lowest vertices.
    lowest = np.full(pieces, len(shared))
    np.minimum.at(lowest, label, np.concatenate([block.lowest for block in blocks]))
    rank = np.empty(pieces, np.int32)
    rank[np.argsort(lowest)] = np.arange(pieces)
    for block, k in zip(blocks, first, strict=False):
        result[block.vertices] = rank[label[k : k + len(block.lowest)]][block.piece]
    return result, pieces


def open_vertices(triangles: NDArray[Any], count: int) -> Bools:
    """(count,) which vertices are at edges of one triangle; no edge has more than two."""
    corners = [np.ascontiguousarray(triangles[:, k]) for k in range(3)]
    key = np.concatenate(
        [ways_along(a, b, count) for a, b in zip(corners, [*corners[1:], corners[0]], strict=True)]
    )
    key.sort()
    first = np.flatnonzero((key[1:] ^ key[:-1]) == 1)
    alone = np.ones(len(key), bool)
    alone[first] = alone[first + 1] = False
    start, end = np.divmod(key[alone] >> 1, max(count, 1))
    return vertices_of(np.concatenate([start, end]), count)


def pieces_of(first: NDArray[Any], second: NDArray[Any], count: int) -> tuple[int, Ints]:
    """How many pieces `count` things make that are joined in pairs, and the piece of each.

    Pieces are numbered in the order of their first things.
    """
    if len(first) <= FEW_PAIRS:
        return _few_pieces(first, second, count)
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components

    graph = coo_matrix((np.ones(len(first), bool), (first, second)), shape=(count, count))
    pieces, piece = connected_components(graph, directed=False)
    return int(pieces), piece.astype(np.int64)


def _few_pieces(first: NDArray[Any], second: NDArray[Any], count: int) -> tuple[int, Ints]:
    """As `pieces_of`: each thing points to a lower one of its piece, at last to the lowest."""
    lowest = np.arange(count)
    while True:
        one, two = lowest[first], lowest[second]
        apart = one != two
        if not apart.any():
            break
        one, two = one[apart], two[apart]
        np.minimum.at(lowest, np.maximum(one, two), np.minimum(one, two))
        while (lower := lowest[lowest]).tobytes() != lowest.tobytes():
            lowest = lower
    roots, piece = np.unique(lowest, return_inverse=True)
    return len(roots), piece.astype(np.int64)


def pinched_vertices(mesh: TriangleMesh) -> int:
    """Vertices at which more than one fan of triangles meets (two cones tip to tip).

    Every edge of such a mesh can be shared by exactly two triangles, and yet its surface is
    not a manifold there.
    """
    # Corners ordered by their vertex: one block then holds all the corners of its vertices.
    order = np.argsort(mesh.triangles.ravel(), kind="stable")
    at = mesh.triangles.ravel()[order]
    cuts = np.searchsorted(at, np.arange(0, len(mesh.vertices) + BLOCK_VERTICES, BLOCK_VERTICES))
    spans = [slice(start, stop) for start, stop in itertools.pairwise(cuts.tolist())]
    return sum(in_threads(lambda span: _count_pinched(mesh, order[span], at[span]), spans))


def _count_pinched(mesh: TriangleMesh, corner: NDArray[np.int64], at: NDArray[np.int32]) -> int:
    """Pinched vertices among those whose (complete) sets of corners are given."""
    if not len(corner):
        return 0
    triangle, place = np.divmod(corner, 3)
    apex = at.astype(np.int64) << 32
    one = apex | mesh.triangles[triangle, (place + 1) % 3]
    two = apex | mesh.triangles[triangle, (place + 2) % 3]
    # A corner joins the two edges it lies between: a fan is a connected set of edges.
    edges, index = np.unique(np.concatenate([one, two]), return_inverse=True)
    index = index.reshape(2, -1)
    fans, fan_of_edge = pieces_of(index[0], index[1], len(edges))
    vertex_of_fan = np.zeros(fans, np.int64)
    vertex_of_fan[fan_of_edge] = edges >> 32
    _, fans_of_vertex = np.unique(vertex_of_fan, return_counts=True)
    return int(np.count_nonzero(fans_of_vertex > 1))

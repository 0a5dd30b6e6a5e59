# SPDX-License-Identifier: LGPL-2.1-or-later
"""Edge table: the edges of any triangles, closed or not, and what lies on their sides."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_matrix, csr_matrix
from scipy.sparse.csgraph import connected_components

from ..util.ragged import rows_of
from ..util.threads import in_threads
from ..util.types import Bools, Ints
from .triangle_mesh import TriangleMesh

#: Triangles whose edges are counted at once: what that takes does not grow with the mesh then.
BLOCK_TRIANGLES = 1 << 17
#: A use of an edge from its lower to its higher end, and one the other way, in one sum of both.
AHEAD, BACK = 1, 1 << 32


@dataclass(frozen=True, eq=False)
class Edges:
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


def edges_of(mesh: TriangleMesh) -> Edges:
    """The edges of a mesh."""
    t = mesh.triangles.astype(np.int64)
    sides = np.stack([t, np.roll(t, -1, axis=1)], axis=2).reshape(-1, 2)
    low, high = sides.min(axis=1), sides.max(axis=1)
    number = np.unique(low * len(mesh.vertices) + high, return_inverse=True)[1].ravel()
    count = np.bincount(number)
    forward = np.bincount(number[sides[:, 0] < sides[:, 1]], minlength=len(count))
    return Edges(sides, number, count, 2 * forward - count)


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


def edge_uses(mesh: TriangleMesh) -> EdgeUses:
    """How often edges are used, found of some triangles at a time.

    An edge is used in two blocks only if both its ends are: such edges are added up at the end.
    """
    size, starts = np.int64(len(mesh.vertices)), range(0, len(mesh.triangles), BLOCK_TRIANGLES)
    blocks = [mesh.triangles[k : k + BLOCK_TRIANGLES] for k in starts]
    last, shared = np.full(size, -1, np.int32), np.zeros(size, bool)
    for number, block in enumerate(blocks):
        corners = block.ravel()
        before = last[corners]
        shared[corners[(before >= 0) & (before != number)]] = True
        last[corners] = number
    found = list(in_threads(lambda block: _uses_in(block, shared), blocks))
    ends, uses = np.zeros((0, 2), np.int64), np.zeros((0, 2), np.int64)
    if found:
        ends = np.concatenate([block.ends for block in found])
        uses = np.concatenate([block.uses for block in found])
    edge, row = np.unique(ends[:, 0] * size + ends[:, 1], return_inverse=True)
    ahead, back = (np.bincount(row.ravel(), uses[:, k], len(edge)) for k in (0, 1))
    counts = np.array([_counted(ahead, back), *(block.counted for block in found)]).sum(axis=0)
    count, single, overused, misoriented = counts.tolist()
    piece, pieces = _joined(found, shared)
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


def _uses_in(triangles: NDArray[np.int32], shared: Bools) -> _Block:
    """What is found of some triangles, of whose vertices others use the shared ones."""
    low, high = int(triangles.min()), int(triangles.max())
    is_used = np.zeros(high - low + 1, bool)
    is_used[triangles - np.int32(low)] = True
    used = np.flatnonzero(is_used)
    number = np.cumsum(is_used, dtype=np.int32) - np.int32(1)
    corners = np.ascontiguousarray(number[triangles - np.int32(low)].T)
    vertices = (used + low).astype(np.int32)
    both = _counts(corners, len(used))
    start = np.flatnonzero(shared[vertices])
    entry, row = rows_of(both.indptr, start)
    elsewhere = shared[vertices[both.indices[entry]]]
    entry, start = entry[elsewhere], start[row[elsewhere]]
    ends = vertices[np.stack([start, both.indices[entry]], axis=1)].astype(np.int64)
    # Most edges are used once each way, and need no further look.
    once = both.data == AHEAD + BACK
    once[entry] = True
    other = both.data[~once]
    _, *faults = _counted(other % BACK, other // BACK)
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
    start, end = corners.ravel(), np.concatenate([corners[1], corners[2], corners[0]])
    uses = np.where(start < end, np.int64(AHEAD), np.int64(BACK))
    places = np.minimum(start, end), np.maximum(start, end)
    repeated = start == end
    if repeated.any():
        uses, places = uses[~repeated], (places[0][~repeated], places[1][~repeated])
    return csr_matrix((uses, places), shape=(size, size))


def _counted(ahead: Ints, back: Ints) -> tuple[int, int, int, int]:
    """How many edges there are, and open, overused and misoriented ones among them."""
    uses = ahead + back
    return (
        len(uses),
        int(np.count_nonzero(uses == 1)),
        int(np.count_nonzero(uses > 2)),
        int(np.count_nonzero((uses == 2) & (ahead != 1))),
    )


def _joined(blocks: list[_Block], shared: Bools) -> tuple[NDArray[np.int32], int]:
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


def pieces_of(first: Ints, second: Ints, count: int) -> tuple[int, Ints]:
    """How many pieces `count` things make that are joined in pairs, and the piece of each."""
    graph = coo_matrix((np.ones(len(first), bool), (first, second)), shape=(count, count))
    pieces, piece = connected_components(graph, directed=False)
    return int(pieces), piece.astype(np.int64)


def areas_of(mesh: TriangleMesh) -> NDArray[np.float64]:
    """(m,) area of each triangle."""
    a, b, c = mesh.corners()
    areas: NDArray[np.float64] = 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1)
    return areas


def place_text(point: NDArray[np.float64]) -> str:
    """A point for a message."""
    return "({:.4g}, {:.4g}, {:.4g})".format(*point)


def plural(count: int, one: str, many: str = "") -> str:
    """The count with its noun, as in '1 hole' and '2 holes'."""
    return f"{count:,} {one if count == 1 else many or one + 's'}"

# SPDX-License-Identifier: LGPL-2.1-or-later
"""T-junctions: vertices that lie on an open edge of a neighbour, and slivers that fill them."""

from __future__ import annotations

import numpy as np

from ...mesh.topology import edges_of
from ...mesh.triangle_mesh import TriangleMesh, compact
from ...util.numbers import plural
from ...util.ragged import spread
from ...util.types import Floats, Ints

#: More open edges, or candidates for vertices on them, are no T-junctions but loose triangles.
MOST_OPEN = 300_000
MOST_CANDIDATES = 20_000_000
#: Each pass splits one edge of a triangle; a triangle has three, and its pieces may have more.
MOST_PASSES = 12


def mend_junctions(mesh: TriangleMesh, tolerance: float) -> tuple[TriangleMesh, list[str]]:
    """Open edges joined to the vertices that lie on them.

    Triangles thinner than the tolerance at odd edges go first: they lie along an edge that two
    others share already, or fill a T-junction.

    Args:
        mesh: welded.
        tolerance: how far a vertex may lie beside the edge, mm.
    """
    done: list[str] = []
    edges = edges_of(mesh)
    if len(edges.open_sides) > MOST_OPEN:
        return mesh, done
    odd = (edges.count != 2)[edges.number].reshape(-1, 3).any(axis=1)
    a, b, c = mesh.corners()
    longest = np.sqrt(
        np.max([((p - q) ** 2).sum(axis=1) for p, q in ((a, b), (b, c), (c, a))], axis=0)
    )
    thin = odd & (2.0 * mesh.areas() <= tolerance * longest)
    if thin.any():
        mesh = compact(TriangleMesh(mesh.vertices, mesh.triangles[~thin]))
        done.append(f"{plural(int(thin.sum()), 'sliver')} along edges removed")
    splits = 0
    for _ in range(MOST_PASSES):
        mesh, more = _split(mesh, tolerance)
        splits += more
        if not more:
            break
    if splits:
        done.append(f"{plural(splits, 'T-junction')} joined")
    return mesh, done


def _split(mesh: TriangleMesh, tolerance: float) -> tuple[TriangleMesh, int]:
    """One edge of every triangle that has a vertex on an open edge, split there."""
    side, vertex, share = _on_open_sides(mesh, tolerance)
    if not len(side):
        return mesh, 0
    # One side a triangle in each pass.
    triangle = side // 3
    first = np.unique(triangle, return_index=True)[1]
    chosen = np.zeros(3 * len(mesh.triangles), bool)
    chosen[side[first]] = True
    keep = chosen[side]
    side, vertex, share = side[keep], vertex[keep], share[keep]
    order = np.lexsort((share, side))
    side, vertex = side[order], vertex[order]
    own, start, count = np.unique(side, return_index=True, return_counts=True)
    rows, corner = own // 3, own % 3
    t = mesh.triangles.astype(np.int64)
    a, b, c = (t[rows, (corner + k) % 3] for k in range(3))
    piece, place = spread(count + 1)
    before = np.where(place == 0, a[piece], vertex[np.maximum(start[piece] + place - 1, 0)])
    last = place == count[piece]
    at = np.minimum(start[piece] + place, len(vertex) - 1)
    after = np.where(last, b[piece], vertex[at])
    pieces = np.stack([before, after, c[piece]], axis=1)
    rest = np.delete(t, rows, axis=0)
    triangles = np.concatenate([rest, pieces]).astype(np.int32)
    return TriangleMesh(mesh.vertices, triangles), len(vertex)


def _on_open_sides(mesh: TriangleMesh, tolerance: float) -> tuple[Ints, Ints, Floats]:
    """Open sides, the vertices of other open sides on them, and how far along they lie (0 to 1)."""
    from scipy.spatial import cKDTree  # slow to import

    none = np.zeros(0, np.int64), np.zeros(0, np.int64), np.zeros(0)
    edges = edges_of(mesh)
    open_sides = edges.open_sides
    if not len(open_sides):
        return none
    ends = edges.sides[open_sides]
    loose = np.unique(ends)
    tree = cKDTree(mesh.vertices[loose])
    start, along = mesh.vertices[ends[:, 0]], np.diff(mesh.vertices[ends], axis=1)[:, 0]
    length = np.linalg.norm(along, axis=1)
    middle, reach = start + along / 2.0, length / 2.0 + tolerance
    counts = tree.query_ball_point(middle, reach, return_length=True)
    if counts.sum() > MOST_CANDIDATES:
        return none
    found = tree.query_ball_point(middle, reach)
    row = np.repeat(np.arange(len(ends)), counts)
    vertex = loose[np.concatenate(list(found)).astype(np.int64)]
    from_start = mesh.vertices[vertex] - start[row]
    share = np.einsum("ij,ij->i", from_start, along[row]) / np.maximum(length[row] ** 2, 1e-300)
    beside = np.linalg.norm(from_start - share[:, None] * along[row], axis=1)
    # Past the ends by more than the tolerance, so that no new edge is shorter.
    inside = (share * length[row] > tolerance) & ((1.0 - share) * length[row] > tolerance)
    third = mesh.triangles.ravel()[_opposite(open_sides)][row]
    keep = inside & (beside <= tolerance) & (vertex != third)
    return open_sides[row[keep]], vertex[keep], share[keep]


def _opposite(sides: Ints) -> Ints:
    """The corner of its triangle that a side does not touch."""
    return sides // 3 * 3 + (sides % 3 + 2) % 3

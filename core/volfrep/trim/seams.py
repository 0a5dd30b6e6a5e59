# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pieces of a surface joined where they are open: vertex to vertex, proved edge by edge."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from ..mesh.edge_table import pieces_of
from ..mesh.triangle_mesh import TriangleMesh, compact, concatenate
from ..util.types import Bools, Floats, Ints
from .group_cut import Piece
from .trimmed_surface import equal_rows


@dataclass(frozen=True, eq=False)
class Joined:
    """Pieces as one mesh.

    Attributes:
        mesh: of all of them, first vertices first.
        on_wall: (m,) bool, triangles that lie on the wall.
        loose: pieces that are open where no other one nor the rim follows.
    """

    mesh: TriangleMesh
    on_wall: Bools
    loose: Ints


def joined(pieces: Sequence[Piece], rim: Floats, tolerance: float) -> Joined:
    """Join pieces of a surface along their seams.

    Vertices at open edges that lie within the tolerance of each other become one, in the place
    that the first piece has. The same edge and facet met in both, so that they differ by rounding.

    Args:
        pieces: each closed but for its seams.
        rim: (k, 3) vertices at which the whole may be open, mm.
        tolerance: mm.
    """
    whole = concatenate(*(piece.mesh for piece in pieces))
    on_wall = np.concatenate([piece.on_wall for piece in pieces])
    first = np.cumsum([0] + [len(piece.mesh.vertices) for piece in pieces])
    begin = np.cumsum([0] + [len(piece.mesh.triangles) for piece in pieces])
    seam = np.concatenate([piece.rim + k for piece, k in zip(pieces, first, strict=False)])
    owner = np.searchsorted(first, seam, "right") - 1
    points = whole.vertices[seam]
    pairs = cKDTree(points).query_pairs(tolerance, output_type="ndarray").astype(np.int64)
    count, cluster = pieces_of(pairs[:, 0], pairs[:, 1], len(seam))
    # Of one piece no two vertices may become one.
    loose = [_twice(cluster, owner)]
    chosen = np.full(count, len(seam))
    np.minimum.at(chosen, cluster, np.arange(len(seam)))
    number = np.arange(len(whole.vertices), dtype=np.int32)
    number[seam] = seam[chosen[cluster]]
    triangles = number[whole.triangles]
    at_rim = np.zeros(len(whole.vertices), bool)
    row = equal_rows(rim, points[chosen])
    at_rim[seam[chosen[row[row >= 0]]]] = True
    loose.append(np.searchsorted(begin, _open(triangles, number, seam, at_rim), "right") - 1)
    mesh = compact(TriangleMesh(whole.vertices, triangles))
    return Joined(mesh, on_wall, np.unique(np.concatenate(loose)))


def _twice(cluster: Ints, owner: Ints) -> Ints:
    """The owners of more than one vertex of a cluster."""
    pair, often = np.unique(cluster * (owner.max(initial=0) + 1) + owner, return_counts=True)
    result: Ints = pair[often > 1] % (owner.max(initial=0) + 1)
    return result


def _open(
    triangles: NDArray[np.int32], number: NDArray[np.int32], seam: Ints, at_rim: Bools
) -> Ints:
    """The triangles with an edge that does not run once each way and is not at the rim."""
    at_seam = np.zeros(len(number), bool)
    at_seam[number[seam]] = True
    corners = at_seam[triangles]
    some = np.flatnonzero(corners.sum(axis=1) >= 2)
    start = triangles[some].astype(np.int64)
    end = np.roll(start, -1, axis=1)
    here = at_seam[start] & at_seam[end]
    owner = np.repeat(some, 3).reshape(-1, 3)[here]
    start, end = start[here], end[here]
    size = np.int64(len(number))
    key = start * size + end
    key.sort()
    back = end * size + start
    ahead = np.searchsorted(key, start * size + end, "right") - np.searchsorted(
        key, start * size + end
    )
    behind = np.searchsorted(key, back, "right") - np.searchsorted(key, back)
    wrong = (ahead != 1) | (behind > 1) | ((behind == 0) & ~(at_rim[start] & at_rim[end]))
    result: Ints = owner[wrong]
    return result

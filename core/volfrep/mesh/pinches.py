# SPDX-License-Identifier: LGPL-2.1-or-later
"""Non-manifold vertices of surfaces whose edges are all shared by two triangles."""

from __future__ import annotations

import itertools
from concurrent.futures import ThreadPoolExecutor

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

from ..util.threads import threads
from .triangle_mesh import TriangleMesh

#: Vertices per block in `pinched_vertices`.
BLOCK_VERTICES = 1 << 14


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
    with ThreadPoolExecutor(max_workers=threads()) as pool:
        return sum(pool.map(lambda span: _pinched_in(mesh, order[span], at[span]), spans))


def _pinched_in(mesh: TriangleMesh, corner: NDArray[np.int64], at: NDArray[np.int32]) -> int:
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
    links = coo_matrix((np.ones(len(corner), np.int8), tuple(index)), shape=(len(edges),) * 2)
    fans, fan_of_edge = connected_components(links, directed=False)
    vertex_of_fan = np.zeros(fans, np.int64)
    vertex_of_fan[fan_of_edge] = edges >> 32
    _, fans_of_vertex = np.unique(vertex_of_fan, return_counts=True)
    return int(np.count_nonzero(fans_of_vertex > 1))

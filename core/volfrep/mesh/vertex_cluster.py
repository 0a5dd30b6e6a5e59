# SPDX-License-Identifier: LGPL-2.1-or-later
"""Decimation by vertex clustering: a coarse proxy of a mesh, for looking at.

For looking only. Reducing a finished mesh by quadrics was tried for files and dropped: a larger
deviation from the start makes fewer triangles, in less time.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from .topology import pieces_of
from .triangle_mesh import TriangleMesh, compact

#: Triangles on each square of the raster that a surface runs through.
TRIANGLES_PER_SQUARE = 2.5
#: How much coarser the raster is made where the mesh came out with too many triangles.
COARSER = 1.3


def cluster_vertices(mesh: TriangleMesh, most: int) -> TriangleMesh:
    """A mesh of at most `most` triangles that looks like the given one; in general not closed.

    Vertices in the same cube of a raster become one, their mean (J. Rossignac and P. Borrel,
    "Multi-resolution 3D approximations for rendering complex scenes", 1993). It takes a fraction
    of a second per million triangles, and is no mesh to measure or to print.
    """
    if len(mesh.triangles) <= most:
        return mesh
    step = math.sqrt(TRIANGLES_PER_SQUARE * mesh.area / most)
    while True:
        result = _cluster(mesh, step)
        if len(result.triangles) <= most:
            return result
        step *= COARSER


def is_outside(mesh: TriangleMesh) -> NDArray[np.bool_]:
    """(t,) whether a triangle's shell bounds the closed mesh from outside, and not a cavity."""
    triangles, count = mesh.triangles, len(mesh.vertices)
    rows = np.concatenate([triangles[:, 0], triangles[:, 1]])
    columns = np.concatenate([triangles[:, 1], triangles[:, 2]])
    shells, shell = pieces_of(rows, columns, count)
    shell = shell[triangles[:, 0]]
    volume = np.bincount(shell, weights=mesh.signed_volumes(), minlength=shells)
    return np.asarray(volume[shell] > 0)


def _cluster(mesh: TriangleMesh, step: float) -> TriangleMesh:
    cube = np.floor((mesh.vertices - mesh.bounds[0]) / step).astype(np.int64)
    size = cube.max(axis=0) + 1
    key = (cube[:, 0] * size[1] + cube[:, 1]) * size[2] + cube[:, 2]
    _, index, count = np.unique(key, return_inverse=True, return_counts=True)
    vertices = np.stack(
        [np.bincount(index, mesh.vertices[:, axis]) / count for axis in range(3)], axis=1
    )
    t = index.ravel()[mesh.triangles]
    t = t[(t[:, 0] != t[:, 1]) & (t[:, 1] != t[:, 2]) & (t[:, 2] != t[:, 0])]
    t = np.take_along_axis(t, (t.argmin(axis=1)[:, None] + np.arange(3)) % 3, axis=1)
    return compact(TriangleMesh(vertices, np.unique(t, axis=0).astype(np.int32)))

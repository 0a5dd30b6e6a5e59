# SPDX-License-Identifier: LGPL-2.1-or-later
"""Decimation by vertex clustering: a coarse proxy of a mesh, for looking at.

For looking only. Reducing a finished mesh by quadrics was tried for files and dropped: a larger
deviation from the start makes fewer triangles, in less time.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from ..util.threads import in_threads
from ..util.types import Floats, Ints
from .topology import pieces_of
from .triangle_mesh import TRIANGLES_PER_STEP, TriangleMesh, compact

#: Triangles on each square of the raster that a surface runs through.
TRIANGLES_PER_SQUARE = 2.5
#: How much coarser the raster is made where the mesh came out with too many triangles.
COARSER = 1.3
#: A raster of no more cubes for each point is counted as a whole.
CUBES_PER_POINT = 4


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
    index, count = _cubes_of(mesh.vertices, step)
    vertices = np.stack(
        [np.bincount(index, mesh.vertices[:, axis]) / count for axis in range(3)], axis=1
    )

    def block(start: int) -> Ints:
        t = index[mesh.triangles[start : start + TRIANGLES_PER_STEP]]
        t = t[(t[:, 0] != t[:, 1]) & (t[:, 1] != t[:, 2]) & (t[:, 2] != t[:, 0])]
        return np.take_along_axis(t, (t.argmin(axis=1)[:, None] + np.arange(3)) % 3, axis=1)

    starts = range(0, len(mesh.triangles), TRIANGLES_PER_STEP)
    t = _once_each(np.concatenate(list(in_threads(block, starts))), len(vertices))
    return compact(TriangleMesh(vertices, t.astype(np.int32)))


def _once_each(triangles: Ints, count: int) -> Ints:
    """The different ones of triangles of `count` vertices, in order.

    By numbers, which numpy sorts in a quarter of the time that it takes for rows.
    """
    sides, number = np.unique(triangles[:, 0] * count + triangles[:, 1], return_inverse=True)
    rows, last = np.divmod(np.unique(number.ravel() * count + triangles[:, 2]), count)
    return np.stack([*np.divmod(sides[rows], count), last], axis=1)


def _cubes_of(points: Floats, step: float) -> tuple[Ints, Ints]:
    """(n,) the cube of each point, of those that hold any, and (c,) how many points these hold."""
    low, high = points.min(axis=0), points.max(axis=0)
    size = np.floor((high - low) / step).astype(np.int64) + 1
    key = np.zeros(len(points), np.int64)
    for k in range(3):
        key *= size[k]
        key += ((points[:, k] - low[k]) / step).astype(np.int64)
    if size.prod() > CUBES_PER_POINT * len(points):  # of a surface that fills little of its box
        _, index, count = np.unique(key, return_inverse=True, return_counts=True)
        return index.ravel(), count
    held = np.bincount(key, minlength=int(size.prod()))
    number = np.cumsum(held > 0) - 1
    return number[key], held[held > 0]

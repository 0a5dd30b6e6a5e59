# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where a surface turns back on itself, at edges between triangles that face each other."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..mesh.triangle_mesh import TriangleMesh
from ..util.threads import in_threads
from ..util.types import Bools, Floats

#: The surface turns back at an edge where the cosine between its normals is below this.
TURNS_BACK = -0.9
#: Deformed struts do so at an edge that sticks out and is sharper than this: facets round a strut
#: turn by 60 degrees at most, and where struts meet is a valley.
STICKS_OUT = -0.2
#: By how much a vertex' rough normals may be wrong, each.
ROUGHNESS = 1e-6
#: Triangles whose rough normals are found at a time: they should stay in the processor's cache.
BLOCK_TRIANGLES = 1 << 15


def find_folds(mesh: TriangleMesh, deformed: bool = False) -> Bools:
    """(m,) the triangles that have a corner at an edge where the surface turns back on itself.

    Where it is deformed, also those at sharp edges that stick out.
    """
    size = len(mesh.vertices)
    corners, columns = mesh.triangles.T, mesh.vertices.T
    # At both ends of such an edge two of the normals nearly cancel out, and so their sum is short.
    # For that they need not be known well, and half as long numbers take half the memory.
    length, count = np.zeros(size), np.zeros(size, np.int32)
    for along in _rough_normals(columns, corners):
        total = np.zeros(size)
        for corner in corners:
            total += np.bincount(corner, along, size)
        length += np.square(total, out=total)
    for corner in corners:
        count += np.bincount(corner, minlength=size)
    least = STICKS_OUT if deformed else TURNS_BACK
    sharp = np.sqrt(length) <= count - 2.0 + np.sqrt(2.0 + 2.0 * least) + ROUGHNESS * count
    rows = np.flatnonzero(sum(sharp[corner].view(np.int8) for corner in corners) > 1)
    normal = _unit_normals(columns, corners[:, rows])
    start = mesh.triangles[rows].astype(np.int64)
    end = np.roll(start, -1, axis=1)
    side = np.flatnonzero((sharp[start] & sharp[end]).ravel())
    apex = np.roll(start, -2, axis=1).ravel()[side]
    start, end, owner = start.ravel()[side], end.ravel()[side], side // 3
    edge = np.minimum(start, end) * np.int64(size) + np.maximum(start, end)
    order = np.argsort(edge)
    same = edge[order[1:]] == edge[order[:-1]]
    side, other = order[:-1][same], order[1:][same]
    one, two = owner[side], owner[other]
    cosine = sum(along[one] * along[two] for along in normal)
    turned = cosine < TURNS_BACK
    if deformed:
        beyond = mesh.vertices[apex[other]] - mesh.vertices[start[side]]
        sticks_out = sum(along[one] * beyond[:, k] for k, along in enumerate(normal)) < 0.0
        turned |= (cosine < STICKS_OUT) & sticks_out
    near = np.zeros(size, bool)
    near[mesh.triangles[rows[one[turned]]]] = True
    near[mesh.triangles[rows[two[turned]]]] = True
    return touching(near, corners)


def _rough_normals(columns: Floats, corners: NDArray[np.int32]) -> NDArray[np.float32]:
    """(3, m) the unit normals of triangles, (3, m), of vertices (3, n), to single precision."""
    normal = np.empty(corners.shape, np.float32)

    def block(start: int) -> None:
        part = slice(start, start + BLOCK_TRIANGLES)
        normal[:, part] = _unit_normals(columns, np.ascontiguousarray(corners[:, part]))

    for _ in in_threads(block, range(0, corners.shape[1], BLOCK_TRIANGLES)):
        pass
    return normal


def _unit_normals(columns: Floats, corners: NDArray[np.int32]) -> list[Floats]:
    """Three of (m,): the normals of triangles, (3, m), of length 1, axis by axis."""
    a, b, c = ([column[corner] for column in columns] for corner in corners)
    e, f = ([q[k] - a[k] for k in range(3)] for q in (b, c))
    normal = [e[i] * f[j] - e[j] * f[i] for i, j in ((1, 2), (2, 0), (0, 1))]
    length = np.maximum(np.sqrt(sum(along * along for along in normal)), 1e-300)
    return [along / length for along in normal]


def touching(near: Bools, corners: NDArray[np.int32]) -> Bools:
    """(m,) which of the triangles, (3, m), have a corner among the near vertices."""
    a, b, c = (near[corner] for corner in corners)
    return np.asarray(a | b | c, np.bool_)

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Binary STL: the format of every slicer, with the precision of float32."""

from __future__ import annotations

import os
from collections import deque
from collections.abc import Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from itertools import islice

import numpy as np
from numpy.typing import NDArray

from ..mesh import TriangleMesh, compact
from ..progress import Monitor
from .files import replacing
from .precision import refuse_lost_corners, single_precision

HEADER_BYTES = 80
#: One facet as it lies in the file.
FACET = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
#: Facets prepared at once by each thread (bounds the memory).
BLOCK_FACETS = 1 << 16


def write_stl(
    mesh: TriangleMesh, path: str | os.PathLike[str], monitor: Monitor | None = None
) -> None:
    """Write a binary STL with facet normals, beside the target and then renamed.

    Args:
        mesh: in mm.
        path: of the file; an old file stays if anything goes wrong.
        monitor: told the progress, asked for a cancel.

    Raises:
        VolfrepError: the mesh is empty, holds coordinates that float32 cannot, or has triangles
            that lose a corner in float32; or the path cannot be written.
        Cancelled: when the monitor says so; no file is left behind.
    """
    vertices = single_precision(mesh, path)
    count = len(mesh.triangles)
    threads = os.cpu_count() or 1
    starts = iter(range(0, count, BLOCK_FACETS))
    with replacing(path) as file, ThreadPoolExecutor(max_workers=threads) as pool:

        def prepare() -> Iterator[Future[NDArray[np.void]]]:
            for start in islice(starts, 1):
                block = mesh.triangles[start : start + BLOCK_FACETS]
                yield pool.submit(_facets, vertices, block, path)

        file.write(b"binary STL, mm".ljust(HEADER_BYTES, b" "))
        file.write(np.array(count, "<u4").tobytes())
        # A few blocks ahead, so that the threads work on while a block is written.
        ahead = deque(future for _ in range(2 * threads) for future in prepare())
        written = 0
        while ahead:
            facets = ahead.popleft().result()
            ahead.extend(prepare())
            file.write(facets.data)
            written += len(facets)
            if monitor is not None:
                monitor.tick(written / count)


def merge_corners(corners: NDArray[np.float32]) -> TriangleMesh:
    """A mesh from (3 m, 3) float32 corners, three a triangle, equal ones made one vertex."""
    # Adding zero turns -0.0 into 0.0: equal numbers then have equal bits.
    bits = (np.asarray(corners, np.float32) + np.float32(0.0)).view(np.uint32)
    key = bits[:, 0].astype(np.uint64) << np.uint64(32) | bits[:, 1]
    _, column = np.unique(key, return_inverse=True)
    key = column.ravel().astype(np.uint64) << np.uint64(32) | bits[:, 2]
    del column
    _, first, index = np.unique(key, return_index=True, return_inverse=True)
    return TriangleMesh(corners[first].astype(np.float64), index.reshape(-1, 3).astype(np.int32))


def as_read(mesh: TriangleMesh) -> TriangleMesh:
    """The mesh as it will come back from an STL file, without the way through the disk."""
    used = compact(mesh)
    return merge_corners(used.vertices.astype(np.float32)[used.triangles].reshape(-1, 3))


def _facets(
    vertices: NDArray[np.float32], triangles: NDArray[np.int32], path: str | os.PathLike[str]
) -> NDArray[np.void]:
    facets = np.zeros(len(triangles), FACET)
    corners = vertices[triangles]
    facets["corners"] = corners
    e, f = (np.ascontiguousarray((corners[:, k] - corners[:, 0]).T) for k in (1, 2))
    normal = np.stack([e[i] * f[j] - e[j] * f[i] for i, j in ((1, 2), (2, 0), (0, 1))])
    length = np.sqrt((normal * normal).sum(axis=0))
    flat = np.flatnonzero(length == 0.0)
    refuse_lost_corners(vertices, triangles[flat], path)
    length[flat] = 1.0
    facets["normal"] = (normal / length).T
    return facets

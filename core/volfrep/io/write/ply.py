# SPDX-License-Identifier: LGPL-2.1-or-later
"""Binary PLY: half of STL's size, and the vertices keep their numbers."""

from __future__ import annotations

import os
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from ...mesh.precision import BLOCK_ROWS, refuse_lost_corners, single_precision
from ...mesh.triangle_mesh import TriangleMesh
from ...util.files import replacing
from ...util.progress import Monitor

#: One triangle as it lies in the file.
FACE = np.dtype([("corners", "u1"), ("index", "<i4", 3)])
END_OF_HEADER = b"end_header\n"
_HEADER = """ply
format binary_little_endian 1.0
comment mm
element vertex {vertices}
property float x
property float y
property float z
element face {triangles}
property list uchar int vertex_indices
end_header
"""


def write_ply(
    mesh: TriangleMesh, path: str | os.PathLike[str], monitor: Monitor | None = None
) -> None:
    """Write a binary PLY, beside the target and then renamed.

    Arguments and errors as of `stl.write_stl`.
    """
    vertices = single_precision(mesh, path)
    refuse_lost_corners(vertices, mesh.triangles, path)
    with replacing(path) as file:
        for count, chunk in enumerate(ply_chunks(vertices, mesh.triangles)):
            file.write(chunk)
            if monitor is not None:
                monitor.tick(count * BLOCK_ROWS / len(mesh.triangles))


def ply_chunks(vertices: NDArray[np.float32], triangles: NDArray[np.int32]) -> Iterator[bytes]:
    """The bytes of the file, piece by piece."""
    yield _HEADER.format(vertices=len(vertices), triangles=len(triangles)).encode("ascii")
    yield vertices.astype("<f4").tobytes()
    for start in range(0, len(triangles), BLOCK_ROWS):
        block = triangles[start : start + BLOCK_ROWS]
        faces = np.empty(len(block), FACE)
        faces["corners"] = 3
        faces["index"] = block
        yield faces.tobytes()

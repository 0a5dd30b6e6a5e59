# SPDX-License-Identifier: LGPL-2.1-or-later
"""Binary PLY: half of STL's size, and the vertices keep their numbers."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator

import numpy as np
from numpy.typing import NDArray

from ...mesh.triangle_mesh import TriangleMesh
from ...trim.trimmed_surface import TrimmedSurface
from ...util.files import replacing
from ...util.progress import Monitor
from .numbered import number_vertices

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
    surface: TriangleMesh | TrimmedSurface,
    path: str | os.PathLike[str],
    monitor: Monitor | None = None,
) -> None:
    """Write a binary PLY, beside the target and then renamed.

    Arguments and errors as of `stl.write_stl`; of a surface, octants beside its mesh are written
    as they are placed.
    """
    given = number_vertices(surface, path, as_text=False)
    points = (block.astype("<f4") for block in given.points())
    chunks = _chunks(given.vertices, given.triangles, points, given.corners())
    with replacing(path, 12 * given.vertices + FACE.itemsize * given.triangles) as file:
        written = 0
        for chunk in chunks:
            file.write(chunk)
            written += len(chunk)
            if monitor is not None:
                monitor.tick(written / (12 * given.vertices + FACE.itemsize * given.triangles))


def _chunks(
    vertices: int,
    triangles: int,
    points: Iterable[NDArray[np.float32]],
    corners: Iterable[NDArray[np.int32]],
) -> Iterator[bytes]:
    yield _HEADER.format(vertices=vertices, triangles=triangles).encode("ascii")
    for block in points:
        yield block.tobytes()
    for rows in corners:
        faces = np.empty(len(rows), FACE)
        faces["corners"] = 3
        faces["index"] = rows
        yield faces.tobytes()

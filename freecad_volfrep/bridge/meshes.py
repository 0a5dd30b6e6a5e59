# SPDX-License-Identifier: LGPL-2.1-or-later
"""FreeCAD's meshes and the engine's, by way of files in the temporary folder.

FreeCAD offers a mesh to Python as lists of objects, about a second per million triangles and
several from lists to a mesh. Its own binary format, which holds neighbours and is read without a
look at the edges, is ten times faster; an indexed binary PLY file brings a mesh back.
"""

from __future__ import annotations

import struct
import tempfile
from collections.abc import Generator
from concurrent.futures import ThreadPoolExecutor, wait
from pathlib import Path

import Mesh
import numpy as np
from numpy.typing import NDArray

from volfrep.io.write.ply import END_OF_HEADER, FACE
from volfrep.mesh.display_parts import facets_with_neighbours
from volfrep.mesh.triangle_mesh import TriangleMesh
from volfrep.util.errors import VolfrepError

#: How FreeCAD's binary meshes begin: a number by which they are known, a version, room for a text.
_BMS_HEAD = struct.pack("<II", 0xA0B0C0D0, 0x010000) + bytes(256)

#: A file that is being written is looked for so long at a time, s.
_LOOKS = 0.005


def to_freecad(mesh: TriangleMesh) -> Mesh.Mesh:
    """The mesh as FreeCAD's (single precision); vertices and triangles keep their order.

    Raises:
        VolfrepError: FreeCAD did not take every triangle.
    """
    return with_neighbours(mesh.vertices, facets_with_neighbours(mesh))


def with_neighbours(vertices: NDArray[np.float64], facets: NDArray[np.uint32]) -> Mesh.Mesh:
    """As `to_freecad`, of a mesh whose neighbours are known already.

    Args:
        vertices: (n, 3) mm.
        facets: (t, 6) of `volfrep.mesh.display_parts.facets_with_neighbours`.

    Raises:
        VolfrepError: FreeCAD did not take every triangle.
    """
    steps = neighbours_in_steps(vertices, facets)
    while True:
        try:
            next(steps)
        except StopIteration as end:
            return end.value


def neighbours_in_steps(
    vertices: NDArray[np.float64], facets: NDArray[np.uint32]
) -> Generator[None, None, Mesh.Mesh]:
    """As `with_neighbours`: the file is written on a thread, until which there are steps."""
    if not len(facets):
        return Mesh.Mesh()
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(1) as beside:
        path = Path(folder) / "mesh.bms"
        writing = beside.submit(_write_bms, path, vertices, facets)
        while not wait([writing], _LOOKS).done:
            yield
        writing.result()
        result = Mesh.Mesh(str(path))
    if result.CountFacets != len(facets):
        raise VolfrepError(
            f"FreeCAD took {result.CountFacets} of the mesh's {len(facets)} triangles: "
            "use a coarser deviation."
        )
    return result


def _write_bms(path: Path, vertices: NDArray[np.float64], facets: NDArray[np.uint32]) -> None:
    """Write FreeCAD's own binary format."""
    points = np.ascontiguousarray(vertices, "<f4")
    box = np.stack([points.min(axis=0), points.max(axis=0)], axis=1)
    with path.open("wb") as file:
        file.write(_BMS_HEAD + struct.pack("<II", len(points), len(facets)))
        for array in (points, np.ascontiguousarray(facets, "<u4"), box):
            file.write(array.data)


def from_freecad(mesh: Mesh.Mesh) -> TriangleMesh:
    """FreeCAD's mesh, its placement applied, as the engine's.

    Raises:
        VolfrepError: the mesh has no triangles.
    """
    if not mesh.CountFacets:
        raise VolfrepError("The mesh is empty: choose one that has triangles.")
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "mesh.ply"
        mesh.write(str(path))
        data = path.read_bytes()
    start = data.index(END_OF_HEADER) + len(END_OF_HEADER)
    points = np.frombuffer(data, "<f4", 3 * mesh.CountPoints, start).reshape(-1, 3)
    faces = np.frombuffer(data, FACE, mesh.CountFacets, start + points.nbytes)
    if not (faces["corners"] == 3).all():
        raise VolfrepError("FreeCAD wrote a mesh that is not made of triangles.")
    return TriangleMesh(points.astype(np.float64), faces["index"].astype(np.int32))

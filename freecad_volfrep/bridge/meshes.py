# SPDX-License-Identifier: LGPL-2.1-or-later
"""FreeCAD's meshes and the engine's, by way of an indexed binary PLY file.

FreeCAD offers a mesh to Python as lists of objects, about a second per million triangles and
several from lists to a mesh; a file in the temporary folder is several times faster.
"""

from __future__ import annotations

import tempfile
from pathlib import Path

import Mesh
import numpy as np

from volfrep.io.write.ply import END_OF_HEADER, FACE, ply_chunks
from volfrep.mesh.triangle_mesh import TriangleMesh
from volfrep.util.errors import VolfrepError


def to_freecad(mesh: TriangleMesh) -> Mesh.Mesh:
    """The mesh as FreeCAD's (single precision); vertices and triangles keep their order.

    Raises:
        VolfrepError: FreeCAD did not take every triangle.
    """
    if not len(mesh.triangles):
        return Mesh.Mesh()
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "mesh.ply"
        with path.open("wb") as file:
            file.writelines(ply_chunks(mesh.vertices.astype(np.float32), mesh.triangles))
        result = Mesh.Mesh(str(path))
    if result.CountFacets != len(mesh.triangles):
        raise VolfrepError(
            f"FreeCAD took {result.CountFacets} of the mesh's {len(mesh.triangles)} triangles: "
            "use a coarser deviation."
        )
    return result


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

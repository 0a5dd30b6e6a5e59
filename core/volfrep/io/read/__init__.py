# SPDX-License-Identifier: LGPL-2.1-or-later
"""From a user's file to a closed solid: a module a format, and a module a kind of repair."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np

from ...util.errors import VolfrepError
from ...util.progress import Monitor
from .cad import read_cad
from .contents import Contents, read_bytes
from .exchange import read_glb, read_off
from .obj import read_obj
from .ply import read_ply
from .stl import read_stl
from .threemf import read_3mf

#: A new format of meshes is one module and one line here.
READERS = {
    ".stl": read_stl,
    ".obj": read_obj,
    ".ply": read_ply,
    ".3mf": read_3mf,
    ".off": read_off,
    ".glb": read_glb,
}
CAD_SUFFIXES = (".step", ".stp", ".iges", ".igs", ".brep", ".brp")


def read_file(path: str | os.PathLike[str], monitor: Monitor | None = None) -> Contents:
    """The triangles of a file as they are, nothing repaired.

    Args:
        path: the file.
        monitor: asked for a cancel while FreeCAD reads a CAD file, which may take long.

    Raises:
        VolfrepError: the file is missing, damaged, or of another kind.
        Cancelled: when the monitor says so.
    """
    file = Path(path)
    suffix = file.suffix.lower()
    if suffix == ".fcstd":
        raise VolfrepError(
            f"'{file.name}' is a FreeCAD document: open it in FreeCAD and fill it there, or "
            "export its solid as STEP."
        )
    if suffix not in READERS and suffix not in CAD_SUFFIXES:
        raise VolfrepError(
            f"'{file.name}' is not a kind of file that holds a solid: give an STL, OBJ, PLY, 3MF, "
            "OFF, GLB, STEP, IGES or BREP file."
        )
    data = read_bytes(file)
    if suffix in CAD_SUFFIXES:
        contents = read_cad(data, file, monitor)
    else:
        contents = READERS[suffix](data, file.name)
    mesh = contents.mesh
    if not len(mesh.triangles):
        raise VolfrepError(f"'{file.name}' holds no triangles: export the solid again.")
    if not np.isfinite(mesh.vertices[mesh.triangles]).all():
        raise VolfrepError(f"'{file.name}' has a coordinate that is not a number: export it again.")
    return contents

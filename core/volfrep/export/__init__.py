# SPDX-License-Identifier: LGPL-2.1-or-later
"""One file a format, behind one function that picks the format by the file's extension."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

from ..errors import VolfrepError
from ..mesh import TriangleMesh
from ..progress import Monitor
from .obj import write_obj
from .ply import write_ply
from .step_faceted import write_step_faceted
from .stl import write_stl
from .threemf import write_3mf

MeshWriter = Callable[[TriangleMesh, "str | os.PathLike[str]", "Monitor | None"], None]

#: Writers by extension. A new format is one more line here.
MESH_WRITERS: dict[str, MeshWriter] = {
    ".stl": write_stl,
    ".3mf": write_3mf,
    ".ply": write_ply,
    ".obj": write_obj,
    ".step": write_step_faceted,
    ".stp": write_step_faceted,
}


def mesh_writer(path: str | os.PathLike[str]) -> MeshWriter:
    """The writer for the path's extension (case does not matter).

    Raises:
        VolfrepError: listing the known extensions.
    """
    extension = Path(path).suffix
    writer = MESH_WRITERS.get(extension.lower())
    if writer is None:
        named = f"the extension '{extension}'" if extension else "a name without an extension"
        raise VolfrepError(
            f"Cannot write '{path}': {named} is not a known mesh format, "
            f"use {' or '.join(MESH_WRITERS)}."
        )
    return writer


def write_mesh(
    mesh: TriangleMesh, path: str | os.PathLike[str], monitor: Monitor | None = None
) -> None:
    """Write a mesh in the format that the path's extension names.

    Raises:
        VolfrepError: unknown extension, unwritable path, or a mesh the format cannot hold.
        Cancelled: when the monitor says so; no file is left behind.
    """
    mesh_writer(path)(mesh, path, monitor)

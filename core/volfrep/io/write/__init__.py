# SPDX-License-Identifier: LGPL-2.1-or-later
"""One file a format, behind one function that picks the format by the file's extension."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING

from ...util.errors import VolfrepError

if TYPE_CHECKING:
    from ...mesh.triangle_mesh import TriangleMesh
    from ...trim.trimmed_surface import TrimmedSurface
    from ...util.progress import Monitor

MeshWriter = Callable[["TriangleMesh", "str | os.PathLike[str]", "Monitor | None"], None]

#: Modules and functions by extension, imported when used. A new format is one more line here.
MESH_WRITERS: dict[str, tuple[str, str]] = {
    ".stl": ("stl", "write_stl"),
    ".3mf": ("threemf", "write_3mf"),
    ".ply": ("ply", "write_ply"),
    ".obj": ("obj", "write_obj"),
    ".off": ("exchange", "write_off"),
    ".glb": ("exchange", "write_glb"),
    ".step": ("step_faceted", "write_step_faceted"),
    ".stp": ("step_faceted", "write_step_faceted"),
}
#: Those that hold a surface without the mesh of all of it.
STREAMED = (".stl", ".ply", ".obj", ".3mf")


def mesh_writer(path: str | os.PathLike[str]) -> MeshWriter:
    """The writer for the path's extension (case does not matter).

    Raises:
        VolfrepError: listing the known extensions.
    """
    extension = Path(path).suffix
    home = MESH_WRITERS.get(extension.lower())
    if home is None:
        named = f"the extension '{extension}'" if extension else "a name without an extension"
        raise VolfrepError(
            f"Cannot write '{path}': {named} is not a known mesh format, "
            f"use {' or '.join(MESH_WRITERS)}."
        )
    module, function = home
    writer: MeshWriter = getattr(import_module(f".{module}", __name__), function)
    return writer


def write_mesh(
    mesh: TriangleMesh,
    path: str | os.PathLike[str],
    monitor: Monitor | None = None,
    figures: Mapping[str, str] | None = None,
) -> None:
    """Write a mesh in the format that the path's extension names.

    Args:
        mesh: in mm.
        path: of the file; an old file stays if anything goes wrong.
        monitor: told the progress, asked for a cancel.
        figures: of the run, which a 3MF keeps (`threemf.write_3mf`); no other format has a place.

    Raises:
        VolfrepError: unknown extension, unwritable path, or a mesh the format cannot hold.
        Cancelled: when the monitor says so; no file is left behind.

    >>> import tempfile, volfrep
    >>> mesh = volfrep.block((1, 1, 1), cell="BCC", cell_size=10, strut_radius=1).result.mesh
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Path(folder) / "cell.stl"
    ...     write_mesh(mesh, file)
    ...     print(file.stat().st_size == 84 + 50 * len(mesh.triangles))
    True
    """
    writer = mesh_writer(path)
    if figures and Path(path).suffix.lower() == ".3mf":
        from .threemf import write_3mf

        write_3mf(mesh, path, monitor, figures)
        return
    writer(mesh, path, monitor)


def write_surface(
    surface: TrimmedSurface,
    path: str | os.PathLike[str],
    monitor: Monitor | None = None,
    *,
    figures: Mapping[str, str] | None = None,
) -> None:
    """Write a surface in the format that the path's extension names.

    What lies beside its mesh goes into an STL, PLY, OBJ or 3MF as it is laid; for the others the
    mesh of the whole is made.

    Args:
        surface: in mm.
        path: of the file; an old file stays if anything goes wrong.
        monitor: told the progress, asked for a cancel.
        figures: as of `write_mesh`.

    Raises:
        VolfrepError: as `write_mesh`.
        Cancelled: when the monitor says so; no file is left behind.
    """
    suffix = Path(path).suffix.lower()
    if suffix == ".stl":
        from .stl_octants import write_surface_stl

        write_surface_stl(surface, path, monitor)
    elif suffix == ".ply":
        from .ply import write_ply

        write_ply(surface, path, monitor)
    elif suffix == ".obj":
        from .obj import write_obj

        write_obj(surface, path, monitor)
    elif suffix == ".3mf":
        from .threemf import write_3mf

        write_3mf(surface, path, monitor, figures or {})
    else:
        mesh_writer(path)  # refused before the mesh is made
        from ...util.progress import Monitor

        write_mesh(surface.whole(monitor or Monitor()), path, monitor, figures=figures)

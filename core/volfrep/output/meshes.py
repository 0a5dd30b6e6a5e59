# SPDX-License-Identifier: LGPL-2.1-or-later
"""Forms that are a mesh and nothing else: one function writes any of them."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from concurrent.futures import Executor
from pathlib import Path
from typing import Any

from ..mesh.triangle_mesh import TriangleMesh
from ..trim.trimmed_surface import TrimmedSurface
from ..util.errors import VolfrepError
from ..util.progress import Monitor
from .form import Form, files, suffixes, unknown
from .writer import Settings, Source, Writer, Written, load

MeshBytes = Callable[..., Any]


def mesh_form(path: str | os.PathLike[str]) -> Form:
    """The form of a mesh by the path's extension (case does not matter).

    Raises:
        VolfrepError: listing the known extensions.
    """
    suffix = Path(path).suffix.lower()
    for form in files():
        if form.bytes_by and suffix in form.suffixes:
            return form
    raise VolfrepError(f"Cannot write '{path}': {unknown(path, suffixes(meshes=True))}")


def write_mesh(
    surface: TriangleMesh | TrimmedSurface,
    path: str | os.PathLike[str],
    monitor: Monitor | None = None,
    figures: Mapping[str, str] | None = None,
    executor: Executor | None = None,
) -> None:
    """Write a mesh in the format that the path's extension names.

    Args:
        surface: in mm. Octants beside the mesh of a surface go into an STL, PLY, OBJ or 3MF as
            they are placed; for the others the mesh of the whole is made.
        path: of the file; an old file stays if anything goes wrong.
        monitor: told the progress, asked for a cancel.
        figures: of the run, which a 3MF keeps (`threemf.write_3mf`); no other format has a place.
        executor: its processes on this machine help with an STL; None: threads.

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
    form = mesh_form(path)
    if isinstance(surface, TrimmedSurface) and not form.streamed:
        surface = surface.whole(monitor or Monitor())
    write: MeshBytes = load(form.bytes_by)
    if isinstance(surface, TrimmedSurface) and form.octants_by:
        load(form.octants_by)(surface, path, monitor, executor)
    elif form.name == "3mf":
        write(surface, path, monitor, figures or {})
    else:
        write(surface, path, monitor)


class MeshWriter(Writer):
    """A mesh in the format of its extension."""

    def write(self, source: Source, path: str | os.PathLike[str], settings: Settings) -> Written:
        """As of `Writer`."""
        write_mesh(source.surface, path, figures=source.figures, executor=source.executor)
        return Written()

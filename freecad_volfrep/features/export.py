# SPDX-License-Identifier: LGPL-2.1-or-later
"""Writes a mesh object to a file through the engine, which checks what a reader will see."""

from __future__ import annotations

import os

import FreeCAD as App

from freecad_volfrep.engine import require_engine
from volfrep.errors import VolfrepError


def export_mesh(obj: App.DocumentObject, path: str | os.PathLike[str]) -> None:
    """Write the object's mesh, where it lies in the document, in the format of the extension.

    Args:
        obj: a lattice infill, or any mesh object.
        path: the file to write; one that exists is replaced only when the new one is complete.

    Raises:
        VolfrepError: there is no mesh, or the file cannot be written.
    """
    require_engine()
    from freecad_volfrep.bridge.solids import mesh_in_document
    from volfrep.export import write_mesh

    if not obj.isDerivedFrom("Mesh::Feature") or not obj.Mesh.CountFacets:
        raise VolfrepError(f"'{obj.Label}' has no mesh to export: update it first.")
    write_mesh(mesh_in_document(obj), path)

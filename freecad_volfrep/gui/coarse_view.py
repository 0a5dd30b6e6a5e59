# SPDX-License-Identifier: LGPL-2.1-or-later
"""Large meshes on the screen: a coarse likeness in the place of millions of triangles."""

from __future__ import annotations

from typing import Any

from freecad_volfrep.preferences import largest_shown

from .filled_view import FilledPart, mesh_and_kinds

#: The display mode.
COARSE = "Coarse"
#: The likeness has this share of the triangles that may be shown: what is small keeps turning.
SHARE = 0.25


def show_likeness(obj: Any, node: Any) -> FilledPart:
    """Fill the node with a likeness of an infill's mesh, drawn as the mesh itself would be."""
    from volfrep.mesh.vertex_cluster import coarse_likeness

    limit = int(SHARE * largest_shown())
    return FilledPart(node, *mesh_and_kinds(obj), lambda part: coarse_likeness(part, limit))

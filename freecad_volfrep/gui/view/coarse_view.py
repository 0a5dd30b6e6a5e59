# SPDX-License-Identifier: LGPL-2.1-or-later
"""Large meshes on the screen: a coarse proxy in the place of millions of triangles."""

from __future__ import annotations

from typing import Any

from .filled_view import FilledPart, show_parts

#: The display mode.
COARSE = "Coarse"


def show_proxy(obj: Any, node: Any) -> FilledPart:
    """Fill the node with a proxy of an infill's mesh, drawn as the mesh itself would be."""
    return show_parts(obj, node, is_coarse=True)

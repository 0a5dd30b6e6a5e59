# SPDX-License-Identifier: LGPL-2.1-or-later
"""A lattice without its mesh: the struts themselves, in the transparent solid."""

from __future__ import annotations

from typing import Any

#: The display mode.
SIMPLIFIED = "Simplified"


def show_struts(obj: Any, node: Any) -> None:
    """Fill the node with the struts of the infill's present properties, and its solid.

    The node lies where FreeCAD's own nodes of the mesh lie: it is moved by the object's Placement.

    Raises:
        VolfrepError: the properties make no sense.
    """
    from freecad_volfrep.features.live_preview import LivePreview

    from .preview_view import add_solid, add_struts

    shown = LivePreview(obj).show()
    if obj.Output != "domain":
        struts = shown.preview
        add_struts(node, struts.start, struts.end, struts.radii, pickable=True)
    add_solid(node, shown.solid, pickable=True)

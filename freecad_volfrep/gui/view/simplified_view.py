# SPDX-License-Identifier: LGPL-2.1-or-later
"""A lattice without its mesh: the struts themselves, in the see-through solid."""

from __future__ import annotations

from typing import Any

from freecad_volfrep import preferences
from freecad_volfrep.gui.draw import drawing
from freecad_volfrep.gui.draw.drawn_preview import draw_struts

from .preview_view import Struts, paint_solid

#: The display mode.
SIMPLIFIED = "Simplified"


class SimplifiedPart:
    """The struts of an infill's present properties in a node of the scene, and its solid.

    The node lies where FreeCAD's own nodes of the mesh lie: it is moved by the object's Placement.

    Args:
        obj: the infill.
        node: an empty node of the scene.

    Raises:
        VolfrepError: the properties make no sense.
    """

    def __init__(self, obj: Any, node: Any) -> None:
        from freecad_volfrep.features.infill.live_preview import LivePreview

        shown = LivePreview(obj).show()
        self._struts = None
        if obj.Output != "Domain":
            most = preferences.read(preferences.MOST_PRISMS)
            self._struts = Struts(shown.preview, draw_struts(shown.preview, most))
            for _ in self._struts.add_pieces():
                pass
            node.addChild(self._struts.node)
        self._skin = drawing.SeeThrough(drawing.edges(shown.solid), drawing.faces(shown.solid))
        node.addChild(self._skin.node)

    def set_look(self, view: Any, is_cut: bool) -> None:
        """Colours of the object's view, and of cut faces in a section."""
        if self._struts is not None:
            self._struts.set_look(view, is_cut)
        paint_solid(self._skin, view)

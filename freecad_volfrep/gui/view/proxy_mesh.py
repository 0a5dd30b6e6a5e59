# SPDX-License-Identifier: LGPL-2.1-or-later
"""The proxy of a mesh in the 3D view, until the document has the mesh."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import FreeCADGui as Gui

from freecad_volfrep.bridge.solids import parent_placement
from freecad_volfrep.gui.draw import drawing

from .filled_view import FilledPart

if TYPE_CHECKING:
    import FreeCAD as App

    from volfrep.jobs.pipeline import FilledMesh

#: Name of what is added to the view's scene.
NODE = "VolfrepLikeness"


class ProxyMesh:
    """What has come of an infill, in place of the infill, until it is removed.

    Args:
        obj: the infill.
        filled: with what is shown of it.
    """

    def __init__(self, obj: App.DocumentObject, filled: FilledMesh) -> None:
        self._scene: Any = None
        if filled.shown is None or not filled.shown.parts:
            return
        view = Gui.getDocument(obj.Document.Name).activeView()
        if not hasattr(view, "getSceneGraph"):
            return
        self._obj, self._was_visible = obj, obj.ViewObject.Visibility
        part = drawing.separate()
        FilledPart(part, filled.shown.parts, is_proxy=True).set_look(obj.ViewObject, False)
        turn = drawing.transform(parent_placement(obj).multiply(obj.Placement))
        self._root = drawing.separate(turn, drawing.unpickable(), part)
        self._root.setName(NODE)
        self._scene = view.getSceneGraph()
        self._scene.addChild(self._root)
        obj.ViewObject.Visibility = False

    def remove(self) -> None:
        """Leave nothing in the view."""
        if self._scene is None:
            return
        self._scene.removeChild(self._root)
        self._scene = None
        try:
            self._obj.ViewObject.Visibility = self._was_visible
        except (ReferenceError, AttributeError):
            return  # deleted meanwhile

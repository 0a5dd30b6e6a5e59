# SPDX-License-Identifier: LGPL-2.1-or-later
"""The solid of an infill beside its lattice: shown and taken away by a command.

It lies to the right in the view as that is turned now, and turns with everything else from then on.
"""

from __future__ import annotations

from typing import Any

import FreeCAD as App
import FreeCADGui as Gui
import numpy as np

from freecad_volfrep.bridge.solids import parent_placement
from freecad_volfrep.gui.draw import drawing
from freecad_volfrep.gui.qt import QtCore

#: Its name in the view's scene.
NODE = "VolfrepSolidBeside"
#: So many of its widths to the right.
APART = 1.15

_shown: dict[tuple[str, str], tuple[Any, Any]] = {}
_observer: _Observer | None = None


def toggle_beside(obj: App.DocumentObject) -> bool:
    """Show an infill's solid beside it, or take it away; returns whether it is shown now.

    A solid that changes is taken away.

    Args:
        obj: an infill with a solid, in the 3D view in front.

    Raises:
        VolfrepError: the solid cannot be read.
    """
    global _observer
    key = obj.Document.Name, obj.Name
    if _take_away(key):
        Gui.SendMsgToActiveView("ViewFit")
        return False
    _, solid = obj.Proxy.read(obj)
    view = Gui.getDocument(obj.Document.Name).activeView()
    node = _drawn(obj, solid, view.getCameraOrientation())
    scene = view.getSceneGraph()
    scene.addChild(node)
    _shown[key] = scene, node
    if _observer is None:
        _observer = _Observer()
        App.addDocumentObserver(_observer)
    Gui.SendMsgToActiveView("ViewFit")
    return True


def _drawn(obj: App.DocumentObject, solid: Any, turn: App.Rotation) -> Any:
    from pivy import coin

    right = turn.multVec(App.Vector(1, 0, 0))
    placement = parent_placement(obj)
    along = solid.vertices @ np.array(placement.Rotation.inverted().multVec(right))
    shift = coin.SoTranslation()
    shift.translation = tuple(right * (APART * float(np.ptp(along))))
    skin = drawing.SeeThrough(drawing.edges(solid), drawing.faces(solid))
    skin.paint(obj.ViewObject.ShapeColor, 0.0)
    parts = drawing.unpickable(), shift, drawing.transform(placement), skin.node
    node = drawing.separate(*parts)
    node.setName(NODE)
    return node


def _take_away(key: tuple[str, str]) -> bool:
    scene, node = _shown.pop(key, (None, None))
    if scene is not None:
        scene.removeChild(node)
    return scene is not None


class _Observer:
    """Hears from FreeCAD that a solid has changed or gone."""

    def slotChangedObject(self, obj: Any, name: str) -> None:  # noqa: N802
        """What is shown of it is an old one."""
        if name not in ("Shape", "Mesh", "Placement", "Base"):
            return
        for key in list(_shown):
            doc, infill = key
            found = App.getDocument(doc).getObject(infill) if obj.Document.Name == doc else None
            if found is not None and (obj == found.Base or (obj == found and name == "Base")):
                QtCore.QTimer.singleShot(0, lambda key=key: _take_away(key))

    def slotDeletedObject(self, obj: Any) -> None:  # noqa: N802
        """It goes with its infill."""
        _take_away((obj.Document.Name, obj.Name))

    def slotDeletedDocument(self, doc: Any) -> None:  # noqa: N802
        """The view goes with it."""
        for key in [key for key in _shown if key[0] == doc.Name]:
            _shown.pop(key)

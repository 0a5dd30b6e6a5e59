# SPDX-License-Identifier: LGPL-2.1-or-later
"""The legend of an infill that is coloured by a quantity, in the 3D view."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import FreeCADGui as Gui

from freecad_volfrep.translation import translate

from .coloured_struts import legend, legend_of_names

#: Its name in the view's scene.
LEGEND = "VolfrepLegend"


class Legend:
    """A colour bar in the 3D view of an object, until it is removed."""

    def __init__(self) -> None:
        self._scene: Any = None
        self._node: Any = None

    def show(
        self, obj: Any, quantity: str, low: float, high: float, names: Sequence[str] = ()
    ) -> None:
        """Show it in the place of the last one; with names, of which values are the rows."""
        from volfrep.jobs.figures.point_values import QUANTITIES

        self.remove()
        view = Gui.getDocument(obj.Document.Name).activeView()
        if not hasattr(view, "getSceneGraph"):
            return
        title = translate("VolfrepColours", QUANTITIES[quantity])
        self._node = legend_of_names(title, names) if names else legend(title, low, high)
        self._node.setName(LEGEND)
        self._scene = view.getSceneGraph()
        self._scene.addChild(self._node)

    def remove(self) -> None:
        """Leave nothing in the view."""
        if self._scene is not None:
            self._scene.removeChild(self._node)
            self._scene = None

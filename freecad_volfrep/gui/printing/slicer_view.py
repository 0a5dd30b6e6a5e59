# SPDX-License-Identifier: LGPL-2.1-or-later
"""How a slicer infill shows: nested bands, seen through from the outside to the densest."""

from __future__ import annotations

from contextlib import suppress
from typing import TYPE_CHECKING, Any

import FreeCADGui as Gui

from freecad_volfrep import ICONS
from freecad_volfrep.gui.draw import drawing
from freecad_volfrep.gui.qt import QtCore
from freecad_volfrep.gui.shown_status import show_status
from freecad_volfrep.saved_names import SavesNothing, saved_module

from .band_colours import colours_of

if TYPE_CHECKING:
    from volfrep.mesh.triangle_mesh import TriangleMesh

#: The display mode that a new one has.
BANDS = "Bands"
#: How far they are seen through: the solid outside the most.
CLEAR, CLEAREST = 0.62, 0.85
#: Selected, it keeps its colours.
SELECTION_STYLE = "BoundBox"


class SlicerInfillView(SavesNothing):
    """View provider of a slicer infill: its icon, its panel, and a display mode of nested bands."""

    def __init__(self, view: Any) -> None:
        view.Proxy = self
        view.SelectionStyle = SELECTION_STYLE
        view.DisplayMode = BANDS

    def attach(self, view: Any) -> None:
        """Called by FreeCAD for a new object and for one from a file."""
        from pivy import coin

        self.object = view.Object
        self._node = coin.SoSeparator()
        view.addDisplayMode(self._node, BANDS)
        self._draw_soon()
        show_status(view.Object)

    def getDisplayModes(self, view: Any) -> list[str]:  # noqa: N802
        """The mode beside those of every mesh."""
        return [BANDS]

    def getDefaultDisplayMode(self) -> str:  # noqa: N802
        """The mode of a new object."""
        return BANDS

    def setDisplayMode(self, mode: str) -> str:  # noqa: N802
        """Every mode of the list is one of the view's own."""
        return mode

    def updateData(self, obj: Any, name: str) -> None:  # noqa: N802
        """Draw anew what has changed, once all of it has."""
        if name in ("Mesh", "Facets"):
            self._draw_soon()
        if name == "Status":
            show_status(obj)

    def getIcon(self) -> str:  # noqa: N802
        """Path of the tree's icon."""
        return str(ICONS / "slicer_infill.svg")

    def doubleClicked(self, view: Any) -> bool:  # noqa: N802
        """Change it in its panel."""
        view.Document.setEdit(view.Object.Name)
        return True

    def setEdit(self, view: Any, mode: int = 0) -> bool:  # noqa: N802
        """Open the panel."""
        from .slicer_panel import SlicerPanel

        Gui.Control.showDialog(SlicerPanel(view.Object))
        return True

    def unsetEdit(self, view: Any, mode: int = 0) -> bool:  # noqa: N802
        """Leave the panel to its own buttons."""
        return False

    def claimChildren(self) -> list[Any]:  # noqa: N802
        """In the tree the solid lies under it, where both lie in the same group."""
        obj, base = self.object, self.object.Base
        if base is None or base.getParentGeoFeatureGroup() != obj.getParentGeoFeatureGroup():
            return []
        return [base]

    def onDelete(self, view: Any, names: Any) -> bool:  # noqa: N802
        """Let it go, and show its solid again."""
        if view.Object.Base is not None:
            view.Object.Base.Visibility = True
        return True

    def _draw_soon(self) -> None:
        """In a moment: while a step is undone, mesh and counts change one after the other."""
        QtCore.QTimer.singleShot(0, self._draw)

    def _draw(self) -> None:
        from freecad_volfrep.features.export.slicer_infill import pieces_of

        with suppress(ReferenceError):  # deleted meanwhile
            if self.object.Document.Restoring:
                self._draw_soon()
                return
            self._node.removeAllChildren()
            draw_bands(self._node, pieces_of(self.object))


# Saved files find the class under this name.
SlicerInfillView.__module__ = saved_module("gui.view_provider")


def draw_bands(node: Any, pieces: list[TriangleMesh]) -> None:
    """Fill a node with the solid and its bands, the innermost first.

    They do not hide each other, whichever is nearer: what is dense shines through.
    """
    from pivy import coin

    if not pieces:
        return
    edges = drawing.material((0.2, 0.2, 0.2))
    edges.diffuseColor = (0.25, 0.25, 0.25)
    node.addChild(drawing.separate(edges, drawing.edges(pieces[0])))
    colours = colours_of(len(pieces))
    for k in range(len(pieces) - 1, -1, -1):
        depth = coin.SoDepthBuffer()
        depth.test, depth.write = True, False
        clear = CLEAREST - (CLEAREST - CLEAR) * k / max(len(pieces) - 1, 1)
        node.addChild(
            drawing.separate(
                drawing.see_through(),
                depth,
                drawing.seen_from(outside=True),
                drawing.material(colours[k], clear),
                drawing.faces(pieces[k]),
            )
        )

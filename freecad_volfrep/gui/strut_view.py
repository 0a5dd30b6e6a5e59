# SPDX-License-Identifier: LGPL-2.1-or-later
"""Strut Results: what struts carry, in colours with a legend, deformed or not, case by case."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import FreeCAD as App
import FreeCADGui as Gui

from freecad_volfrep import preferences
from freecad_volfrep.bridge.solids import parent_placement
from freecad_volfrep.translation import marked, translate
from volfrep.sizing.strut_state import QUANTITIES, drawn_factor, value_range

from . import drawing
from .coloured_struts import coloured_struts, colours_of, legend
from .object_dock import ObjectDock, close_docks
from .qt import QtWidgets

if TYPE_CHECKING:
    from volfrep.sizing.strut_state import StrutState

#: Name of what hangs in the view's scene.
NODE = "VolfrepStrutResults"
#: Colour of the solid's edges.
OUTLINE = (0.75, 0.75, 0.75)
#: What struts may be coloured by, marked for translation: `volfrep.sizing.strut_state.QUANTITIES`.
QUANTITY_NAMES = marked(
    "VolfrepStrutView",
    "Radius, mm",
    "Stress (von Mises), MPa",
    "Share of the buckling load",
    "Displacement, mm",
)


class StrutDock(ObjectDock):
    """Draws the struts of an infill in place of it until it is closed.

    Args:
        obj: the infill.
        states: its struts in each load case.
    """

    NAME = "VolfrepStrutView"

    def __init__(self, obj: App.DocumentObject, states: Sequence[StrutState]) -> None:
        from pivy import coin

        title = translate("VolfrepStrutView", "Strut results of {label}").format(label=obj.Label)
        super().__init__(obj, title)
        self._states = tuple(states)
        self._was_visible = {
            shown: shown.ViewObject.Visibility for shown in (obj, obj.Base) if shown is not None
        }
        for shown in self._was_visible:
            shown.ViewObject.Visibility = False
        solid = obj.Proxy.wanted(obj)[0]
        self._outline = drawing.separate(drawing.material(OUTLINE), drawing.edges(solid))
        self._root = coin.SoSeparator()
        self._root.setName(NODE)
        self._scene = Gui.getDocument(obj.Document.Name).activeView().getSceneGraph()
        self._scene.addChild(self._root)
        self._case, self._quantity = QtWidgets.QComboBox(), QtWidgets.QComboBox()
        self._case.setObjectName("Case")
        self._quantity.setObjectName("Quantity")
        for state in self._states:
            self._case.addItem(state.name)
        for name, text in QUANTITIES.items():
            self._quantity.addItem(translate("VolfrepStrutView", text), name)
        self._quantity.setCurrentIndex(self._quantity.findData("stress"))
        self._deformed = QtWidgets.QCheckBox(translate("VolfrepStrutView", "Deformed"))
        self._deformed.setObjectName("Deformed")
        self._factor = QtWidgets.QLabel()
        self._factor.setObjectName("Factor")
        self._lay_out()
        self._case.currentIndexChanged.connect(lambda _: self.draw())
        self._quantity.currentIndexChanged.connect(lambda _: self.draw())
        self._deformed.toggled.connect(lambda _: self.draw())
        self.draw()

    def draw(self) -> None:
        """Draw the struts of the chosen case by the chosen quantity."""
        self._root.removeAllChildren()
        state = self._states[self._case.currentIndex()]
        name = self._quantity.currentData()
        low, high = value_range(self._states, name)
        ends = state.ends
        self._factor.setText("")
        if self._deformed.isChecked():
            factor = drawn_factor(self._states)
            self._factor.setText(
                translate("VolfrepStrutView", "{factor:g} times enlarged").format(factor=factor)
            )
            ends = ends + factor * state.moved
        colours = colours_of(state.values(name).ravel(), low, high).reshape(-1, 2, 3)
        from pivy import coin

        turn = coin.SoMatrixTransform()
        a = parent_placement(self._obj).toMatrix().A
        turn.matrix.setValue(*[a[4 * column + row] for row in range(4) for column in range(4)])
        most_prisms = preferences.read(preferences.MOST_PRISMS)
        struts = coloured_struts(ends[:, 0], ends[:, 1], state.radii, colours, most_prisms)
        self._root.addChild(drawing.separate(turn, drawing.unpickable(), struts, self._outline))
        self._root.addChild(legend(translate("VolfrepStrutView", QUANTITIES[name]), low, high))

    def slotChangedObject(self, obj: App.DocumentObject, name: str) -> None:  # noqa: N802
        """Called by FreeCAD: the struts of a new mesh are others."""
        if obj == self._obj and name == "Mesh":
            self.close_later()

    def forget(self, document_too: bool) -> None:
        """There is nothing to be shown again; with the document, the scene is gone."""
        self._was_visible.clear()
        if document_too:
            self._scene = None

    def take_away(self) -> None:
        """Show the infill again."""
        if self._scene is not None:
            self._scene.removeChild(self._root)
            self._scene = None
        for shown, visible in self._was_visible.items():
            shown.ViewObject.Visibility = visible
        self._was_visible.clear()

    def _lay_out(self) -> None:
        panel = QtWidgets.QWidget()
        line = QtWidgets.QHBoxLayout(panel)
        for text, box in (
            (translate("VolfrepStrutView", "Load case"), self._case),
            (translate("VolfrepStrutView", "Colour by"), self._quantity),
        ):
            line.addWidget(QtWidgets.QLabel(text))
            line.addWidget(box)
        line.addWidget(self._deformed)
        line.addWidget(self._factor)
        line.addStretch()
        self.setWidget(panel)


def open_struts(obj: App.DocumentObject, states: Sequence[StrutState]) -> StrutDock:
    """Show what an infill's struts carry, in place of what is shown of struts already."""
    close_docks(StrutDock)
    dock = StrutDock(obj, states)
    dock.put_up()
    return dock


def close_struts(obj: App.DocumentObject) -> None:
    """Show the infill itself again."""
    close_docks(StrutDock, obj)

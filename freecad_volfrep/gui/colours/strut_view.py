# SPDX-License-Identifier: LGPL-2.1-or-later
"""Strut Results: what struts carry, in colours with a legend, deformed or not, case by case."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import FreeCAD as App
import FreeCADGui as Gui
import numpy as np

from freecad_volfrep import preferences
from freecad_volfrep.bridge.solids import parent_placement
from freecad_volfrep.gui.draw import drawing
from freecad_volfrep.gui.draw.coloured_struts import coloured_struts, colours_of, legend
from freecad_volfrep.gui.draw.probe import Probe
from freecad_volfrep.gui.qt import QtWidgets
from freecad_volfrep.gui.widgets.colour_range import ColourRange
from freecad_volfrep.gui.widgets.object_dock import ObjectDock, close_docks
from freecad_volfrep.translation import figure, marked, translate
from volfrep.sizing.strut_state import QUANTITIES, drawn_factor, value_range
from volfrep.spatial.nearest_struts import NearestStrut

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
        self._ends: dict[str, tuple[float, float]] = {}
        self._range = ColourRange(self._set_range)
        self._pointed = QtWidgets.QLabel()
        self._pointed.setObjectName("Pointed")
        self._factor = QtWidgets.QLabel()
        self._factor.setObjectName("Factor")
        self._lay_out()
        self._case.currentIndexChanged.connect(lambda _: self.draw())
        self._quantity.currentIndexChanged.connect(lambda _: self.draw())
        self._deformed.toggled.connect(lambda _: self.draw())
        self._shapes: list[Any] = []
        view = Gui.getDocument(obj.Document.Name).activeView()
        self._probe: Probe | None = Probe(view, lambda: self._shapes, self._tell)
        self.draw()

    def draw(self) -> None:
        """Draw the struts of the chosen case by the chosen quantity."""
        self._root.removeAllChildren()
        state = self._states[self._case.currentIndex()]
        name = self._quantity.currentData()
        low, high = self._ends.get(name) or value_range(self._states, name)
        self._range.show_ends(low, high)
        ends = state.ends
        self._factor.setText("")
        if self._deformed.isChecked():
            factor = drawn_factor(self._states)
            self._factor.setText(
                translate("VolfrepStrutView", "{factor:g} times enlarged").format(factor=factor)
            )
            ends = ends + factor * state.moved
        colours = colours_of(state.values(name).ravel(), low, high).reshape(-1, 2, 3)
        turn = drawing.transform(parent_placement(self._obj))
        most_prisms = preferences.read(preferences.MOST_PRISMS)
        struts = coloured_struts(ends[:, 0], ends[:, 1], state.radii, colours, most_prisms)
        self._shapes = [turn, struts]
        self._nearest = NearestStrut(ends)
        self._root.addChild(drawing.separate(turn, drawing.unpickable(), struts, self._outline))
        self._root.addChild(legend(translate("VolfrepStrutView", QUANTITIES[name]), low, high))

    def _set_range(self, low: float, high: float) -> None:
        name = self._quantity.currentData()
        if low == high:
            self._ends.pop(name, None)
        else:
            self._ends[name] = low, high
        self.draw()

    def _tell(self, place: tuple[float, float, float] | None) -> None:
        if place is None:
            self._pointed.setText("")
            return
        strut, share = (found[0] for found in self._nearest.of(np.array([place])))
        state = self._states[self._case.currentIndex()]
        one, two = state.values(self._quantity.currentData())[strut]
        said = translate("VolfrepColours", "{value} under the mouse")
        self._pointed.setText(said.format(value=figure((1.0 - share) * one + share * two, 4)))

    def slotChangedObject(self, obj: App.DocumentObject, name: str) -> None:  # noqa: N802
        """Called by FreeCAD: the struts of a new mesh are others."""
        if obj == self._obj and name == "Mesh":
            self.close_later()

    def forget(self, document_too: bool) -> None:
        """There is nothing to be shown again; with the document, the scene is gone."""
        if self._probe is not None:
            self._probe.end(view_is_gone=document_too)
            self._probe = None
        self._was_visible.clear()
        if document_too:
            self._scene = None

    def take_away(self) -> None:
        """Show the infill again."""
        if self._probe is not None:
            self._probe.end()
            self._probe = None
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
        line.addWidget(self._range)
        line.addWidget(self._pointed)
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

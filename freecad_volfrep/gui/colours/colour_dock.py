# SPDX-License-Identifier: LGPL-2.1-or-later
"""Colour By: what an infill is coloured by, the scale, and the value under the mouse."""

from __future__ import annotations

from typing import Any

import FreeCAD as App
import FreeCADGui as Gui

from freecad_volfrep.bridge.solids import parent_placement
from freecad_volfrep.gui.draw import drawing
from freecad_volfrep.gui.draw.probe import Probe
from freecad_volfrep.gui.qt import QtCore, QtWidgets
from freecad_volfrep.gui.view import section_view
from freecad_volfrep.gui.widgets.colour_range import ColourRange
from freecad_volfrep.gui.widgets.object_dock import ObjectDock, close_docks
from freecad_volfrep.translation import figure, translate

from .colouring import Colouring

#: The first choice of somebody who opens it.
FIRST = "Radius"
#: What is made beside the window is looked for so often, ms.
TICK = 150


class ColourDock(ObjectDock):
    """Says what the view's properties ColourBy, ColourFrom and ColourTo are; these stay.

    Args:
        obj: the infill.
    """

    NAME = "VolfrepColourBy"

    def __init__(self, obj: App.DocumentObject) -> None:
        super().__init__(obj, translate("VolfrepColours", "Colours of {label}").format(
            label=obj.Label))  # fmt: skip
        view = obj.ViewObject
        if view.ColourBy == "None":
            view.ColourBy = FIRST
        self._quantity = QtWidgets.QComboBox()
        self._quantity.setObjectName("Quantity")
        for name in view.getEnumerationsOfProperty("ColourBy"):
            self._quantity.addItem(translate("VolfrepColours", name), name)
        self._range = ColourRange(self._set_range)
        self._said = QtWidgets.QLabel(translate("VolfrepColours", "Point at the lattice"))
        self._said.setObjectName("Said")
        self._why = ""
        panel = QtWidgets.QWidget()
        line = QtWidgets.QHBoxLayout(panel)
        line.addWidget(QtWidgets.QLabel(translate("VolfrepColours", "Colour by")))
        for widget in (self._quantity, self._range, self._said):
            line.addWidget(widget)
        line.addStretch()
        self.setWidget(panel)
        self._probe: Probe | None = Probe(
            Gui.getDocument(obj.Document.Name).activeView(), self._shapes, self._tell
        )
        self._timer = QtCore.QTimer(self)
        self._timer.timeout.connect(self.show_state)
        self._timer.start(TICK)
        self._quantity.currentIndexChanged.connect(lambda _: self._choose())
        self.show_state()

    def show_state(self) -> None:
        """Show what the view says: it may be changed elsewhere."""
        view = self._obj.ViewObject
        row = self._quantity.findData(view.ColourBy)
        if row != self._quantity.currentIndex():
            self._quantity.blockSignals(True)
            self._quantity.setCurrentIndex(row)
            self._quantity.blockSignals(False)
        ends = self._colouring.range
        self._range.setEnabled(ends is not None)
        why = self._colouring.why
        self._range.setToolTip(why)
        if why:
            self._said.setText(why)
        elif self._said.text() == self._why:
            self._tell(None)
        self._why = why
        if ends is not None and not self._range.isAncestorOf(QtWidgets.QApplication.focusWidget()):
            self._range.show_ends(*ends)

    @property
    def _colouring(self) -> Colouring:
        colouring: Colouring = self._obj.ViewObject.Proxy.colouring
        return colouring

    def _choose(self) -> None:
        view = self._obj.ViewObject
        view.ColourFrom = view.ColourTo = 0.0
        view.ColourBy = self._quantity.currentData()
        self._tell(None)
        self.show_state()

    def _set_range(self, low: float, high: float) -> None:
        view = self._obj.ViewObject
        view.ColourFrom, view.ColourTo = low, high
        if low == high and self._colouring.range is not None:
            self._range.show_ends(*self._colouring.range)

    def _shapes(self) -> list[Any]:
        shapes = self._colouring.shapes()
        if not shapes or not self._obj.ViewObject.Visibility:
            return []
        turn = drawing.transform(parent_placement(self._obj))
        plane = section_view.plane_of(self._obj)
        local = drawing.transform(self._obj.Placement)
        return [turn, *([] if plane is None else [plane]), local, *shapes]

    def _tell(self, place: tuple[float, float, float] | None) -> None:
        value = None if place is None else self._colouring.value_at(place)
        text = translate("VolfrepColours", "Point at the lattice")
        if value is not None:
            text = translate("VolfrepColours", "{value} under the mouse").format(
                value=figure(value, 4)
            )
        self._said.setText(text)

    def take_away(self) -> None:
        """The colours stay; the mouse is followed no more."""
        self._timer.stop()
        if self._probe is not None:
            self._probe.end()
            self._probe = None

    def forget(self, document_too: bool) -> None:
        """There is nothing to point at."""
        self._timer.stop()
        if self._probe is not None:
            self._probe.end(view_is_gone=document_too)
            self._probe = None


def open_colours(obj: App.DocumentObject) -> ColourDock:
    """Choose the colours of an infill, in the place of another one's."""
    close_docks(ColourDock)
    dock = ColourDock(obj)
    dock.put_up()
    return dock

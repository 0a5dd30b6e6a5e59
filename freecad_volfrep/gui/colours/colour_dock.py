# SPDX-License-Identifier: LGPL-2.1-or-later
"""Colour By and Strut Results: one dock for values on a lattice, their scale, and the mouse.

What is coloured is one of two: the infill's mesh as its view says, or its struts in each load case
(`strut_colours`).
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import FreeCAD as App
import FreeCADGui as Gui

from freecad_volfrep.bridge.solids import parent_placement
from freecad_volfrep.gui.draw import drawing
from freecad_volfrep.gui.draw.coloured_struts import save_picture
from freecad_volfrep.gui.draw.probe import Probe
from freecad_volfrep.gui.qt import QtCore, QtWidgets
from freecad_volfrep.gui.view import section_view
from freecad_volfrep.gui.widgets.colour_range import ColourRange
from freecad_volfrep.gui.widgets.controls import push_button
from freecad_volfrep.gui.widgets.object_dock import ObjectDock, close_docks
from freecad_volfrep.gui.widgets.panel_manners import fits_any_width
from freecad_volfrep.translation import figure, translate

from .colouring import Colouring
from .strut_colours import StrutColours

if TYPE_CHECKING:
    from volfrep.sizing.strut_state import StrutState

#: The first choice of somebody who opens it.
FIRST = "Radius"
#: What is made in background is looked for so often, ms.
TICK = 150
#: Displacements are enlarged by no more than this.
MOST_ENLARGED = 1e6


class MeshColours:
    """What the view's properties ColourBy, ColourFrom and ColourTo say; they stay afterwards.

    Args:
        obj: the infill.
    """

    is_of_mesh = False
    printed = ""

    def __init__(self, obj: App.DocumentObject) -> None:
        self._obj, self._view = obj, obj.ViewObject
        self._colouring: Colouring = self._view.Proxy.colouring
        self.cases: tuple[str, ...] = ()
        self.quantities = {
            name: translate("VolfrepColours", name)
            for name in self._view.getEnumerationsOfProperty("ColourBy")
        }
        if self._view.ColourBy == "None":
            self._view.ColourBy = FIRST

    @property
    def quantity(self) -> str:
        """What is shown; it may be changed elsewhere."""
        name: str = self._view.ColourBy
        return name

    @property
    def title(self) -> str:
        """What the legend says."""
        from volfrep.jobs.figures.point_values import QUANTITIES

        return str(translate("VolfrepColours", QUANTITIES.get(self.quantity, "")))

    @property
    def names(self) -> tuple[str, ...]:
        """What the values are rows of; empty for a number."""
        return self._colouring.names

    @property
    def range(self) -> tuple[float, float] | None:
        """Of the scale; None while there is none."""
        return self._colouring.range

    @property
    def why(self) -> str:
        """Why there are none."""
        return self._colouring.why

    def choose(self, quantity: str) -> None:
        """Show another quantity, on the scale of its values."""
        self._view.ColourFrom = self._view.ColourTo = 0.0
        self._view.ColourBy = quantity

    def set_range(self, low: float, high: float) -> None:
        """Set the scale, or give it back to the values by two equal ends."""
        self._view.ColourFrom, self._view.ColourTo = low, high

    def shapes(self) -> list[Any]:
        """What the mouse may point at."""
        shapes = self._colouring.shapes()
        if not shapes or not self._view.Visibility:
            return []
        turn = drawing.transform(parent_placement(self._obj))
        plane = section_view.plane_of(self._obj)
        local = drawing.transform(self._obj.Placement)
        return [turn, *([] if plane is None else [plane]), local, *shapes]

    def value_at(self, place: tuple[float, float, float]) -> float | None:
        """The value at a point of them."""
        return self._colouring.value_at(place)

    def remove(self) -> None:
        """The colours stay."""

    def forget(self, document_too: bool) -> None:
        """There is nothing to forget."""


class ColourDock(ObjectDock):
    """What is shown, in which load case, on which scale, and the value under the mouse.

    Args:
        obj: the infill.
        colours: what is coloured.
    """

    NAME = "VolfrepColourBy"

    def __init__(self, obj: App.DocumentObject, colours: MeshColours | StrutColours) -> None:
        super().__init__(obj, translate("VolfrepColours", "Colours of {label}"))
        self._colours = colours
        self._quantity, self._case = QtWidgets.QComboBox(), QtWidgets.QComboBox()
        for name, text in colours.quantities.items():
            self._quantity.addItem(text, name)
        self._case.addItems(colours.cases)
        self._deformed = QtWidgets.QCheckBox(translate("VolfrepColours", "Deformed"))
        self._factor, self._said = self._factor_field(), QtWidgets.QLabel()
        self._range = ColourRange(self._set_range)
        for name, widget in (
            ("Quantity", self._quantity), ("Case", self._case), ("Deformed", self._deformed),
            ("Factor", self._factor), ("Said", self._said),
        ):  # fmt: skip
            widget.setObjectName(name)
        case = QtWidgets.QLabel(translate("VolfrepColours", "Load case"))
        of_cases = (case, self._case, self._deformed, self._factor)
        for widget in of_cases:
            widget.setVisible(bool(colours.cases))
        by = QtWidgets.QLabel(translate("VolfrepColours", "Colour by"))
        tip = translate("VolfrepColours", "Save the view with its legend, on white, for a report")
        text = translate("VolfrepColours", "Picture")
        shot = push_button("Picture", text, self._save_picture, tip)
        column = self.set_line((by, self._quantity, *of_cases, self._range, shot))
        fits_any_width(self._said)  # in the line it would make the window wider than the screen
        column.addWidget(self._said)
        self._why = ""
        self._ends: tuple[float, float] | None = None
        view = Gui.getDocument(obj.Document.Name).activeView()
        self._probe: Probe | None = Probe(view, colours.shapes, self._tell)
        self._timer = QtCore.QTimer(self)
        self._timer.timeout.connect(self.show_state)
        self._timer.start(TICK)
        self._tell(None)
        self.show_state()
        self._quantity.currentIndexChanged.connect(lambda _: self._choose())
        self._case.currentIndexChanged.connect(lambda _: self._show_case())
        self._deformed.toggled.connect(lambda _: self._show_case())
        self._factor.valueChanged.connect(lambda _: self._show_case())

    def _factor_field(self) -> Any:
        """How many times displacements are enlarged; 0 is what fits."""
        field = QtWidgets.QDoubleSpinBox()
        field.setRange(0.0, MOST_ENLARGED)
        field.setStepType(QtWidgets.QDoubleSpinBox.AdaptiveDecimalStepType)
        field.setKeyboardTracking(False)
        field.setSuffix(" \u00d7")
        if isinstance(self._colours, StrutColours):
            text = translate("VolfrepColours", "automatic: {factor:g} \u00d7")
            field.setSpecialValueText(text.format(factor=self._colours.fitting_factor))
        field.setToolTip(translate("VolfrepColours", "Displacements enlarged; 0: automatic"))
        field.setEnabled(False)
        return field

    def show_state(self) -> None:
        """Show what is coloured: it may be changed elsewhere."""
        row = self._quantity.findData(self._colours.quantity)
        if row != self._quantity.currentIndex():
            self._quantity.blockSignals(True)
            self._quantity.setCurrentIndex(row)
            self._quantity.blockSignals(False)
        self._range.setEnabled(self._colours.range is not None)
        self._range.setVisible(not self._colours.names)
        why = self._colours.why
        self._range.setToolTip(why)
        if why:
            self._said.setText(why)
        elif self._said.text() == self._why:
            self._tell(None)
        self._why = why
        self._show_ends()

    def slotChangedObject(self, obj: App.DocumentObject, name: str) -> None:  # noqa: N802
        """Called by FreeCAD: the struts of a new mesh are others."""
        super().slotChangedObject(obj, name)
        if obj == self._obj and name == "Mesh" and self._colours.is_of_mesh:
            self.close_later()

    def take_away(self) -> None:
        """Follow the mouse no more; struts give way to the infill again."""
        self._end_probe(view_is_gone=False)
        self._colours.remove()

    def forget(self, document_too: bool) -> None:
        """There is nothing to point at."""
        self._end_probe(view_is_gone=document_too)
        self._colours.forget(document_too)

    def _end_probe(self, view_is_gone: bool) -> None:
        self._timer.stop()
        if self._probe is not None:
            self._probe.end(view_is_gone=view_is_gone)
            self._probe = None

    def _save_picture(self) -> None:
        path, _ = QtWidgets.QFileDialog.getSaveFileName(
            Gui.getMainWindow(), self.windowTitle(), f"{self._obj.Label}.png", "PNG (*.png)"
        )
        if path:
            save_picture(Gui.getDocument(self._doc.Name).activeView(), path)

    def _choose(self) -> None:
        self._colours.choose(self._quantity.currentData())
        self._tell(None)
        self._show_ends()

    def _show_case(self) -> None:
        assert isinstance(self._colours, StrutColours)
        is_deformed = self._deformed.isChecked()
        self._factor.setEnabled(is_deformed)
        factor = (self._factor.value() or None) if is_deformed else 0.0
        self._colours.show_case(self._case.currentIndex(), factor)

    def _set_range(self, low: float, high: float) -> None:
        self._colours.set_range(low, high)
        if low == high:
            self._ends = None
            self._show_ends()

    def _show_ends(self) -> None:
        """Show the ends once they are others: what is being typed stays until then."""
        ends = self._colours.range
        if ends is not None and ends != self._ends:
            self._ends = ends
            self._range.show_ends(*ends)

    def _tell(self, place: tuple[float, float, float] | None) -> None:
        value = None if place is None else self._colours.value_at(place)
        if value is None:
            text = translate("VolfrepColours", "Move the mouse over the lattice to read values")
            if self._colours.printed:
                of = translate("VolfrepColours", "Of struts as printed ({table}).")
                text = f"{of.format(table=self._colours.printed)} {text}"
        elif self._colours.names:
            name = self._colours.names[round(value)]
            text = translate("VolfrepColours", "{value} under the mouse").format(value=name)
        else:
            unit = self._colours.title.rpartition(", ")[2] if "," in self._colours.title else ""
            text = translate("VolfrepColours", "{value} under the mouse").format(
                value=f"{figure(value, 4)} {unit}".rstrip()
            )
        self._said.setText(text)


def open_colours(obj: App.DocumentObject) -> ColourDock:
    """Choose the colours of an infill, in the place of what is shown in this way."""
    return _put_up(obj, MeshColours)


def open_struts(
    obj: App.DocumentObject,
    states: Sequence[StrutState],
    printed: str = "",
    limits: tuple[str, ...] = (),
) -> ColourDock:
    """Show what an infill's struts carry, in the place of what is shown in this way.

    Args:
        obj: the infill.
        states: its struts in each load case.
        printed: title of the table by which they are as printed; empty for as drawn.
        limits: what governs them, by the rows of the states; empty where they were not sized.
    """
    return _put_up(obj, lambda obj: StrutColours(obj, states, printed, limits))


def _put_up(obj: App.DocumentObject, colours: Any) -> ColourDock:
    close_docks(ColourDock)
    dock = ColourDock(obj, colours(obj))
    dock.put_up()
    return dock


def close_struts(obj: App.DocumentObject) -> None:
    """Show the infill itself again."""
    close_docks(ColourDock, obj)

# SPDX-License-Identifier: LGPL-2.1-or-later
"""The task panel of build directions: their figures, what hangs over in red, and what to do."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import FreeCAD as App
import FreeCADGui as Gui
import numpy as np

from freecad_volfrep import preferences
from freecad_volfrep.features.infill.lattice_infill import is_infill
from freecad_volfrep.features.reports.build_direction import (
    find_directions,
    first_inclination,
    set_build_direction,
    turn_part,
)
from freecad_volfrep.gui.draw import drawing
from freecad_volfrep.gui.messages import errors_shown
from freecad_volfrep.gui.qt import CLOSE, QtCore, QtWidgets
from freecad_volfrep.gui.undo import undo_step
from freecad_volfrep.gui.widgets.controls import Message, push_button, table_of_rows
from freecad_volfrep.gui.widgets.panel_manners import PanelForm, leave_the_wheel
from freecad_volfrep.translation import QT_TRANSLATE_NOOP, figure, spoken, translate
from volfrep.util.errors import VolfrepError

if TYPE_CHECKING:
    from volfrep.reports.orientation import Orientation, Orientations

_CONTEXT = "VolfrepOrient"
HEADS = (
    QT_TRANSLATE_NOOP("VolfrepOrient", "cost"),
    QT_TRANSLATE_NOOP("VolfrepOrient", "overhang"),
    QT_TRANSLATE_NOOP("VolfrepOrient", "height"),
)
#: The arrow's length over the part's diagonal; how near facets are drawn before the part.
ARROW, NEARER = 0.5, 4e-4
#: How far facets are seen through that the part hides.
HIDDEN = 0.4


class OrientPanel:
    """Finds the build directions of a part, shows the picked one, and turns the part to it.

    Args:
        obj: a lattice infill with a mesh, or a solid.
    """

    def __init__(self, obj: App.DocumentObject) -> None:
        import pivy.coin  # noqa: F401 - before FreeCAD 1.0 is asked for a scene

        self._obj, self._doc = obj, obj.Document
        self._found: Orientations | None = None
        self._node: Any = None
        self._scene = Gui.getDocument(self._doc.Name).activeView().getSceneGraph()
        self.form = self._build()
        # Once FreeCAD has put the panel up.
        QtCore.QTimer.singleShot(0, self.find)

    def getStandardButtons(self) -> int:  # noqa: N802
        """Close."""
        return CLOSE

    def reject(self) -> bool:
        """Close."""
        self._clear()
        Gui.Control.closeDialog()
        return True

    def find(self) -> None:
        """Find the directions for the inclination in the field."""
        self._clear()
        with errors_shown():
            self._found = find_directions(self._obj, self._inclination.value())
        self._show()

    def turn(self) -> None:
        """Turn the part to the picked direction, as one undo step, and look at it anew."""
        chosen = self._chosen()
        if self._found is None or chosen is None:
            return
        try:
            with undo_step(self._doc, translate(_CONTEXT, "Turn Part")):
                turn_part(self._obj, self._found, chosen)
                self._doc.recompute()
        except VolfrepError as error:
            self._text.say(str(error), wrong=True)
            return
        self.find()
        self._text.say(translate(_CONTEXT, "Turned: z is up, and it stands on z = 0."))

    def check(self) -> None:
        """Let the infill's print checks be of the picked direction, as one undo step."""
        chosen = self._chosen()
        if chosen is None:
            return
        try:
            with undo_step(self._doc, translate(_CONTEXT, "Set Build Direction")):
                checks = set_build_direction(self._obj, chosen.up)
                self._doc.recompute()
        except VolfrepError as error:
            self._text.say(str(error), wrong=True)
            return
        names = ", ".join(one.Label for one in checks)
        self._text.say(translate(_CONTEXT, "{checks}: built along it.").format(checks=names))

    def _build(self) -> Any:
        form = PanelForm("VolfrepOrientPanel", self._obj.Label, "orient")
        line = QtWidgets.QHBoxLayout()
        line.addWidget(QtWidgets.QLabel(translate(_CONTEXT, "Needs support below")))
        self._inclination = QtWidgets.QDoubleSpinBox()
        self._inclination.setObjectName("Inclination")
        self._inclination.setRange(0.0, 90.0)
        self._inclination.setDecimals(0)
        self._inclination.setSuffix("\u00b0")
        self._inclination.setValue(first_inclination(self._obj))
        self._inclination.setKeyboardTracking(False)
        self._inclination.valueChanged.connect(lambda _: self.find())
        line.addWidget(self._inclination, 1)
        form.column.addLayout(line)
        order = Message("Order")
        order.say(
            translate(
                _CONTEXT, "Least cost first: overhang, supports, height, footprint off the plate"
            )
        )
        form.column.addWidget(order)
        self._table = table_of_rows("Directions", (translate(_CONTEXT, head) for head in HEADS))
        columns = self._table.horizontalHeader()
        columns.setStretchLastSection(False)  # it would be a pixel too wide
        columns.setSectionResizeMode(QtWidgets.QHeaderView.ResizeToContents)
        columns.setSectionResizeMode(len(HEADS) - 1, QtWidgets.QHeaderView.Stretch)
        self._table.currentCellChanged.connect(lambda *_: self._pick())
        form.column.addWidget(self._table, 1)
        self._text = Message("Figures")
        form.column.addWidget(self._text)
        tip = translate(_CONTEXT, "The part stays; its print checks look along this direction")
        self._buttons = [
            push_button("Turn", translate(_CONTEXT, "Turn Part"), self.turn),
            push_button("Check", translate(_CONTEXT, "Set Build Direction"), self.check, tip),
        ]
        for button in self._buttons:
            button.setEnabled(False)
            form.column.addWidget(button)
        self._buttons[1].setVisible(is_infill(self._obj))
        leave_the_wheel(form, [self._inclination])
        return form

    def _rows(self) -> list[Orientation]:
        """As it is, and the best."""
        found = self._found
        return [] if found is None else [found.as_it_is, *found.best]

    def _show(self) -> None:
        rows = self._rows()
        self._table.blockSignals(True)
        self._table.setRowCount(len(rows))
        for number, one in enumerate(rows):
            over, height = figure(one.overhang_mm2, 3), figure(one.height_mm, 3)
            texts = (spoken(f"{one.cost:.4f}"), f"{over} mm\u00b2", f"{height} mm")
            for place, text in enumerate(texts):
                self._table.setItem(number, place, QtWidgets.QTableWidgetItem(text))
        name = translate(_CONTEXT, "now")
        self._table.setVerticalHeaderLabels([name, *map(str, range(1, len(rows)))])
        # All rows are seen: a bar beside them would leave the columns too little room.
        height = self._table.horizontalHeader().sizeHint().height()
        height += self._table.verticalHeader().length() + 2 * self._table.frameWidth()
        self._table.setMinimumHeight(height)
        self._table.blockSignals(False)
        if rows:
            self._table.selectRow(min(1, len(rows) - 1))
            self._pick()

    def _chosen(self) -> Orientation | None:
        rows, number = self._rows(), self._table.currentRow()
        return rows[number] if 0 <= number < len(rows) else None

    def _pick(self) -> None:
        """Show the direction that is picked, and what hangs over then."""
        from pivy import coin

        chosen, found = self._chosen(), self._found
        for button in self._buttons:
            button.setEnabled(chosen is not None)
        if chosen is None or found is None:
            return
        text = translate(
            _CONTEXT,
            "up: {up}\n{inside} mm\u00b2 of the overhang in closed rooms; supports at most "
            "{support} mm\u00b3; stands on {base} mm\u00b2, footprint {footprint} mm\u00b2",
        )
        figures = {
            "inside": chosen.inside_mm2, "support": chosen.support_mm3,
            "base": chosen.base_mm2, "footprint": chosen.footprint_mm2,
        }  # fmt: skip
        told = {name: figure(value, 4) for name, value in figures.items()}
        up = "; ".join(spoken(f"{part:.2f}") for part in chosen.up)
        self._text.say(text.format(up=up, **told))
        self._clear()
        low, high = found.mesh.bounds
        middle, reach = (low + high) / 2.0, ARROW * float(np.linalg.norm(high - low))
        up = np.array(chosen.up)
        tip = middle + reach * up
        side = np.cross(up, np.eye(3)[int(np.argmin(np.abs(up)))])
        side /= np.linalg.norm(side)
        barbs = [tip - 0.12 * reach * up + way * 0.06 * reach * side for way in (-1.0, 1.0)]
        starts = np.array([middle, tip, tip])
        ends = np.array([tip, *barbs])
        hanging = found.hanging(chosen.up)
        colour = preferences.colour(preferences.OVERHANG_COLOUR)
        shaft = drawing.material((0.0, 0.5, 0.2))
        shaft.diffuseColor = (0.0, 0.55, 0.25)
        parts = [drawing.unpickable(), drawing.separate(shaft, drawing.lines(starts, ends, 4.0))]
        if len(hanging.triangles):
            red = drawing.material(colour)
            shape = drawing.faces(hanging)
            parts.append(drawing.separate(drawing.nearer(NEARER), red, shape))
            through = coin.SoDepthBuffer()
            through.test, through.write = False, False
            clear = drawing.material(colour, HIDDEN)
            clear.diffuseColor = tuple(colour[:3])
            look = (drawing.see_through(), through, drawing.flat_light(), clear)
            parts.append(drawing.separate(*look, shape))
        self._node = drawing.separate(*parts)
        self._scene.addChild(self._node)

    def _clear(self) -> None:
        """Leave nothing in the view."""
        if self._node is not None:
            self._scene.removeChild(self._node)
            self._node = None


def open_orientations(obj: App.DocumentObject) -> None:
    """Open the panel of a part's build directions."""
    Gui.Selection.clearSelection()  # its colour would hide what is shown
    Gui.Control.showDialog(OrientPanel(obj))

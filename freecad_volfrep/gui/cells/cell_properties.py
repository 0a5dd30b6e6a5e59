# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a cell does, with a size, a radius and a material that can be changed: a part of windows."""

from __future__ import annotations

import html
from typing import Any

import FreeCADGui as Gui

from freecad_volfrep.features.infill.materials import material_of
from freecad_volfrep.features.jobs.progress import run_job
from freecad_volfrep.gui.qt import QtCore, QtWidgets
from freecad_volfrep.gui.widgets.controls import push_button
from freecad_volfrep.sentences import localise
from freecad_volfrep.translation import QT_TRANSLATE_NOOP, translate
from volfrep.design.cells import UnitCell
from volfrep.design.parameters.table import BY_NAME, NOTHING
from volfrep.design.tpms import PeriodicSurface
from volfrep.util.errors import Cancelled, VolfrepError

_CONTEXT = "VolfrepCells"
#: What stands before an error, which the engine writes in ASCII.
PLUS_MINUS = "\u00b1"
#: What the fields begin with, mm.
_FIRST = {"CellSize": 10.0, "StrutRadius": 1.0, "WallThickness": 1.0}
#: The figures follow once no value has changed for so long, ms.
_SETTLED = 150
_FIELDS = {
    "CellSize": QT_TRANSLATE_NOOP("VolfrepCells", "Cell size L"),
    "StrutRadius": QT_TRANSLATE_NOOP("VolfrepCells", "Strut radius r"),
    "WallThickness": QT_TRANSLATE_NOOP("VolfrepCells", "Sheet thickness"),
}
#: What is said in place of figures that are not known at once, by what says how thick it is.
_UNKNOWN = {
    "StrutRadius": QT_TRANSLATE_NOOP(
        "VolfrepCells", "This cell with this radius is not in the catalogue: press Compute."
    ),
    "WallThickness": QT_TRANSLATE_NOOP(
        "VolfrepCells", "The properties of this TPMS take some seconds: press Compute."
    ),
}


class CellProperties(QtWidgets.QWidget):
    """Density, moduli, strength and conductivity of the picked cell, each with its error.

    Library cells are read off the catalogue at once; for others there is a button, because it takes
    seconds.
    """

    def __init__(self) -> None:
        super().__init__()
        self._cell: UnitCell | PeriodicSurface | None = None
        self._solid: Any = None
        column = QtWidgets.QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        rows = self._form = QtWidgets.QFormLayout()
        column.addLayout(rows)
        self._timer = QtCore.QTimer(self)
        self._timer.setSingleShot(True)
        self._timer.timeout.connect(self._refresh)
        self._fields = {name: self._length(name) for name in _FIELDS}
        for name, field in self._fields.items():
            rows.addRow(translate(_CONTEXT, _FIELDS[name]), field)
        self._material = QtWidgets.QComboBox()
        self._material.setObjectName("Material")
        rows.addRow(translate(_CONTEXT, "Material"), self._material)
        self._figures = QtWidgets.QLabel()
        self._figures.setObjectName("Properties")
        self._figures.setTextInteractionFlags(QtCore.Qt.TextSelectableByMouse)
        column.addWidget(self._figures)
        tip = translate(_CONTEXT, "Homogenise this cell with this radius: it takes some seconds")
        text = translate(_CONTEXT, "Compute")
        self._compute = push_button("ComputeProperties", text, self.compute, tip)
        column.addWidget(self._compute)
        self._offer_materials()
        self._material.currentIndexChanged.connect(lambda _: self._timer.start(0))

    def begin_with(self, infill: Any) -> None:
        """Take size, radius and material of an infill over."""
        for name, field in self._fields.items():
            field.setProperty("rawValue", getattr(infill, name).Value)
        try:
            self._solid = material_of(infill)
        except VolfrepError:  # the infill itself says what is wrong with it
            self._solid = None
        self._offer_materials()

    def show_cell(self, cell: UnitCell | PeriodicSurface) -> None:
        """Tell what this cell does, of struts or a TPMS."""
        self._cell = cell
        for name in _UNKNOWN:
            is_shown = name == self._thickness(cell)
            self._fields[name].setVisible(is_shown)
            self._form.labelForField(self._fields[name]).setVisible(is_shown)
        self._refresh()

    def compute(self) -> None:
        """Homogenise the cell; says here what is wrong with the values."""
        from volfrep.jobs.figures.properties import lattice_properties

        cell, size = self._cell, self._size("CellSize")
        assert cell is not None
        given: dict[str, Any] = {cell.measure: self._size(self._thickness(cell))}
        given["material"] = self._material.currentData()
        title = translate(_CONTEXT, "Properties of {name}").format(name=cell.name)
        try:
            found = run_job(title, lattice_properties, cell, size, has_progress=False, **given)
        except VolfrepError as error:
            self._figures.setText(html.escape(localise(str(error))))
        except Cancelled:
            return
        else:
            self._tell(found.rows())

    def _length(self, name: str) -> Any:
        spin = Gui.UiLoader().createWidget("Gui::QuantitySpinBox")
        spin.setObjectName(name)
        spin.setProperty("unit", "mm")
        spin.setProperty("minimum", 0.0)
        spin.setProperty("rawValue", _FIRST[name])
        spin.findChild(QtWidgets.QLineEdit).textChanged.connect(
            lambda _: self._timer.start(_SETTLED)
        )
        return spin

    def _offer_materials(self) -> None:
        from volfrep.mechanics.materials import MATERIALS

        self._material.blockSignals(True)
        self._material.clear()
        self._material.addItem(translate("App::Property", NOTHING))
        for material in MATERIALS.values():
            self._material.addItem(material.name, material)
        if self._solid is not None:
            row = self._material.findText(self._solid.name)
            if row < 0:
                self._material.addItem(self._solid.name, self._solid)
                row = self._material.count() - 1
            self._material.setCurrentIndex(row)
        self._material.blockSignals(False)

    @staticmethod
    def _thickness(cell: UnitCell | PeriodicSurface) -> str:
        """The field that says how thick a lattice of a cell is."""
        return BY_NAME[cell.measure].property_name

    def _size(self, name: str) -> float:
        return float(self._fields[name].property("rawValue"))

    def _refresh(self) -> None:
        from volfrep.mechanics.catalogue import known_properties

        if self._cell is None:
            return
        size, thickness = self._size("CellSize"), self._thickness(self._cell)
        found = None
        if size > 0.0:
            material = self._material.currentData()
            found = known_properties(self._cell, size, self._size(thickness), material)
        if found is not None:
            self._tell(found.rows())
            return
        self._figures.setText(translate(_CONTEXT, _UNKNOWN[thickness]))

    def _tell(self, rows: list[tuple[str, str]]) -> None:
        lines = "".join(
            f"<tr><td>{html.escape(translate('VolfrepReport', name))}&nbsp;&nbsp;</td>"
            f"<td>{html.escape(localise(text).replace('+-', PLUS_MINUS))}</td></tr>"
            for name, text in rows
            if name not in ("cell", "material")
        )
        self._figures.setText(f"<table>{lines}</table>")

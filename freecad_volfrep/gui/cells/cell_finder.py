# SPDX-License-Identifier: LGPL-2.1-or-later
"""The window that finds cells by what they do: sliders, a chart, answers, one for an infill."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from freecad_volfrep.gui.qt import QtCore, QtWidgets
from freecad_volfrep.gui.selection import selected_infill
from freecad_volfrep.gui.undo import undo_step
from freecad_volfrep.gui.widgets.controls import push_button, table_of_rows
from freecad_volfrep.sentences import localise
from freecad_volfrep.translation import QT_TRANSLATE_NOOP, figure, translate
from volfrep.util.errors import VolfrepError

from .cell_chart import CellChart
from .cell_window import CellWindow, show_one

if TYPE_CHECKING:
    from volfrep.mechanics.summary import CellProperties

_CONTEXT = "VolfrepFinder"
#: Steps of a slider; what it goes over: densities, and moduli over the solid's, by powers of ten.
STEPS, DENSITIES, MODULI = 400, (0.01, 0.7), (1e-5, 0.6)
#: A search begins when nothing has moved for so long, ms.
SETTLED = 150
#: Where it begins.
FIRST_DENSITY, FIRST_MATERIAL, FIRST_SIZE = 0.2, "PA12", 10.0
#: A strength below is that of what carries nothing in some direction.
NOTHING = 1e-9
#: Of the table's columns, px; the last one takes the rest.
WIDTHS = (150, 65, 80, 110)
DIRECTIONS = ("x", "y", "z", "110", "111")
HEADS = (
    QT_TRANSLATE_NOOP("VolfrepFinder", "cell"),
    QT_TRANSLATE_NOOP("VolfrepFinder", "r, mm"),
    QT_TRANSLATE_NOOP("VolfrepFinder", "density, %"),
    QT_TRANSLATE_NOOP("VolfrepFinder", "modulus"),
    QT_TRANSLATE_NOOP("VolfrepFinder", "least strength"),
)
#: The last two where the material is known.
MPA_HEADS = (
    QT_TRANSLATE_NOOP("VolfrepFinder", "modulus, MPa"),
    QT_TRANSLATE_NOOP("VolfrepFinder", "least strength, MPa"),
)


class CellFinder(CellWindow):
    """Finds the library's cells that have a modulus or a density, each at its radius."""

    def __init__(self) -> None:
        super().__init__("VolfrepCellFinder", translate(_CONTEXT, "Find Cells"))
        self._found: list[CellProperties] = []
        self._timer = QtCore.QTimer(self)
        self._timer.setSingleShot(True)
        self._timer.timeout.connect(self.search)
        infill = selected_infill()
        self._size = FIRST_SIZE if infill is None else infill.CellSize.Value
        self._build()
        self._show_curves()
        self.search()
        self.follow_selection()

    def search(self) -> None:
        """Find the cells that have what the fields say; says here what is wrong."""
        from volfrep.jobs.figures.find import direction_of, error_along, find_lattices

        self._timer.stop()
        density, modulus = self._wanted()
        way = direction_of(self._direction.currentText())
        try:
            self._found = find_lattices(
                modulus=modulus,
                relative_density=density,
                direction=way,
                material=self._material.currentData() or None,
                cell_size=self._size,
            )
        except VolfrepError as error:
            self._found = []
            self._note.say(str(error), wrong=True)
        else:
            count = len(self._found)
            text = translate(_CONTEXT, "{count} cells, with L = {size} mm") if count else (
                translate(_CONTEXT, "No cell of the library has that: ask for something else.")
            )  # fmt: skip
            self._note.say(text.format(count=count, size=figure(self._size, 4)), wrong=not count)
        self._table.setRowCount(len(self._found))
        for row, one in enumerate(self._found):
            texts = (
                one.cell, figure(one.strut_radius, 3), figure(100.0 * one.relative_density, 3),
                f"{figure(one.young(way), 4)} \u00b1 {figure(100.0 * error_along(one))} %",
                figure(one.values["strength"], 3) if one.values["strength"] > NOTHING else "0",
            )  # fmt: skip
            for column, text in enumerate(texts):
                self._table.setItem(row, column, QtWidgets.QTableWidgetItem(text))
        places = [(one.relative_density, one.young(way)) for one in self._found]
        self._chart.show_answers([one.cell for one in self._found], places, (density, modulus))
        if self._found:
            self.pick(0)
        self._enable()

    def pick(self, number: int) -> None:
        """Pick an answer in the table and in the chart."""
        self._table.selectRow(number)
        self._chart.choose(number)

    def apply(self) -> None:
        """Give the picked cell and its radius to the selected infill, as one undo step."""
        infill, row = selected_infill(), self._table.currentRow()
        if infill is None or not 0 <= row < len(self._found):
            return
        one = self._found[row]
        with undo_step(infill.Document, translate("VolfrepCells", "Set Unit Cell")):
            infill.CellType = one.cell
            infill.CellSize = one.cell_size
            infill.RadiusDrivenBy = "Radius"
            infill.StrutRadius = one.strut_radius
            infill.Document.recompute()
        self._note.say(f"{infill.Label}: {localise(infill.Status)}", wrong=not infill.isValid())

    def _wanted(self) -> tuple[float | None, float | None]:
        """Density and modulus; None for any."""
        density = self._density.value() / 100.0 if self._asks_density.isChecked() else None
        modulus = self._modulus.value() if self._asks_modulus.isChecked() else None
        return density, modulus

    def _young(self) -> float:
        """Of the solid; 1 without a material."""
        from volfrep.mechanics.materials import find_material

        name = self._material.currentData()
        return float(find_material(name).young) if name else 1.0

    def _build(self) -> None:
        from volfrep.mechanics.materials import MATERIALS

        self._material = QtWidgets.QComboBox()
        self._material.setObjectName("Material")
        self._material.addItem(translate(_CONTEXT, "any: moduli over the solid's"), "")
        for material in MATERIALS.values():
            self._material.addItem(material.name, material.name)
        self._material.setCurrentText(FIRST_MATERIAL)
        self._direction = QtWidgets.QComboBox()
        self._direction.setObjectName("Direction")
        self._direction.addItems(DIRECTIONS)
        self._direction.setCurrentText("z")
        self._asks_density, self._density, self._density_slider = self._quantity(
            "Density", translate(_CONTEXT, "Density"), " %", DENSITIES, 100.0
        )
        self._asks_modulus, self._modulus, self._modulus_slider = self._quantity(
            "Modulus", translate(_CONTEXT, "Modulus"), " MPa", MODULI, self._young()
        )
        self._asks_density.setChecked(True)
        self._density.setValue(100.0 * FIRST_DENSITY)
        self._enable_fields()
        grid = QtWidgets.QGridLayout()
        for row, widgets in enumerate(
            (
                (self._asks_modulus, self._modulus, self._modulus_slider),
                (self._asks_density, self._density, self._density_slider),
            )
        ):
            for column, widget in enumerate(widgets):
                grid.addWidget(widget, row, column)
        grid.setColumnStretch(2, 1)
        line = QtWidgets.QHBoxLayout()
        line.addWidget(QtWidgets.QLabel(translate(_CONTEXT, "along")))
        line.addWidget(self._direction)
        line.addWidget(QtWidgets.QLabel(translate(_CONTEXT, "of")))
        line.addWidget(self._material, 1)
        self._chart = CellChart(self.pick)
        self._table = table_of_rows("Answers", HEADS)
        self._table.verticalHeader().hide()
        for column, width in enumerate(WIDTHS):
            self._table.setColumnWidth(column, width)
        self._table.currentCellChanged.connect(lambda row, *_: self._chart.choose(row))
        self._apply = push_button("Apply", "", self.apply)
        close = push_button("Close", translate("VolfrepCells", "Close"), self.close)
        buttons = QtWidgets.QHBoxLayout()
        buttons.addWidget(self._note, 1)
        buttons.addWidget(self._apply)
        buttons.addWidget(close)
        column = QtWidgets.QVBoxLayout(self)
        column.addLayout(grid)
        column.addLayout(line)
        column.addWidget(self._chart, 3)
        column.addWidget(self._table, 2)
        column.addLayout(buttons)
        self.resize(600, 720)
        self._direction.currentIndexChanged.connect(lambda _: self._change_solid())
        self._material.currentIndexChanged.connect(lambda _: self._change_solid())

    def _quantity(
        self, name: str, text: str, suffix: str, span: tuple[float, float], unit: float
    ) -> tuple[Any, Any, Any]:
        """A box to tick, a number and a slider over the powers of ten, which follow each other."""
        tick = QtWidgets.QCheckBox(text)
        spin = QtWidgets.QDoubleSpinBox()
        slider = QtWidgets.QSlider(QtCore.Qt.Horizontal)
        for widget, what in ((tick, "Asks"), (spin, ""), (slider, "Slider")):
            widget.setObjectName(f"{name}{what}")
            widget.setAccessibleName(text)
        spin.setSuffix(suffix)
        spin.setKeyboardTracking(False)
        slider.setRange(0, STEPS)
        _set_span(spin, span, unit)

        def slide(step: int) -> None:
            low, high = spin.minimum(), spin.maximum()
            spin.setValue(float(f"{low * (high / low) ** (step / STEPS):.3g}"))

        def follow(value: float) -> None:
            low, high = spin.minimum(), spin.maximum()
            slider.blockSignals(True)
            slider.setValue(round(STEPS * math.log(max(value, low) / low) / math.log(high / low)))
            slider.blockSignals(False)
            self._timer.start(SETTLED)

        slider.valueChanged.connect(slide)
        spin.valueChanged.connect(follow)
        tick.toggled.connect(lambda _: self._enable_fields())
        return tick, spin, slider

    def _enable_fields(self) -> None:
        """What is not asked for is grey; at least one is."""
        if not hasattr(self, "_modulus_slider"):
            return  # not all are there
        pairs = (
            (self._asks_density, self._density, self._density_slider),
            (self._asks_modulus, self._modulus, self._modulus_slider),
        )
        for tick, *widgets in pairs:
            for widget in widgets:
                widget.setEnabled(tick.isChecked())
        self._timer.start(SETTLED)

    def _change_solid(self) -> None:
        """Another material or direction: other curves, the same share of the solid's modulus."""
        before = self._modulus.value() / self._modulus.maximum()
        young = self._young()
        self._modulus.setSuffix(" MPa" if self._material.currentData() else "")
        _set_span(self._modulus, MODULI, young)
        self._modulus.setValue(float(f"{before * self._modulus.maximum():.3g}"))
        self._show_curves()
        self._timer.start(SETTLED)

    def _show_curves(self) -> None:
        from volfrep.jobs.figures.find import cell_curves

        is_known = bool(self._material.currentData())
        over = translate(_CONTEXT, "modulus over the solid's")
        word = translate(_CONTEXT, MPA_HEADS[0]) if is_known else over
        heads = (*HEADS[:3], *MPA_HEADS) if is_known else HEADS
        self._table.setHorizontalHeaderLabels([translate(_CONTEXT, head) for head in heads])
        young = self._young()
        curves = {
            name: (densities.tolist(), (young * moduli).tolist())
            for name, (densities, moduli) in cell_curves(self._direction.currentText()).items()
        }
        self._chart.show_curves(curves, (translate(_CONTEXT, "relative density"), word))

    def _enable(self) -> None:
        self._enable_apply(self._apply, bool(self._found))


def _set_span(spin: Any, span: tuple[float, float], unit: float) -> None:
    low, high = (unit * end for end in span)
    spin.setDecimals(max(0, 3 - math.floor(math.log10(low)) - 2))
    spin.setRange(low, high)


def show_cell_finder() -> CellFinder:
    """Open the window, or bring the one that is open to the front."""
    window: CellFinder = show_one("VolfrepCellFinder", CellFinder)
    return window

# SPDX-License-Identifier: LGPL-2.1-or-later
"""The task panel of a design study: what varies, its start, its plot, a design for the infill."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

import FreeCAD as App
import FreeCADGui as Gui

from freecad_volfrep.features.study.design_study import (
    apply_design,
    design_spec,
    designs_asked,
    designs_of_study,
    expected_seconds,
    parameter_of,
    run_study,
    unit_of_moduli,
    values_about,
    variable,
    varied_of_study,
)
from freecad_volfrep.gui.messages import tell_error
from freecad_volfrep.gui.panel.property_fields import label_of
from freecad_volfrep.gui.qt import CLOSE, QtCore, QtGui, QtWidgets
from freecad_volfrep.gui.undo import undo_step
from freecad_volfrep.gui.view.preview_thread import PreviewThread
from freecad_volfrep.gui.view.preview_view import PreviewView
from freecad_volfrep.gui.widgets.controls import Message, push_button
from freecad_volfrep.gui.widgets.panel_manners import PanelForm, close_panel, leave_the_wheel
from freecad_volfrep.translation import QT_TRANSLATE_NOOP, grouped, translate
from volfrep.util.errors import VolfrepError

from .study_plot import StudyPlot

if TYPE_CHECKING:
    from freecad_volfrep.gui.view.preview_thread import ReadyPreview

#: Rows of properties that vary.
ROWS = 3
#: What a plot shows first, where the table has it.
FIRST = (("fill.mass_g", "forecast.mass_g"), ("properties.E100", "forecast.seconds"))
#: Figures of its table in words, in the order in which axes offer them.
WORDS = {
    "fill.mass_g": QT_TRANSLATE_NOOP("VolfrepStudy", "mass, g"),
    "forecast.mass_g": QT_TRANSLATE_NOOP("VolfrepStudy", "expected mass, g"),
    "properties.E100": QT_TRANSLATE_NOOP("VolfrepStudy", "stiffness along an edge"),
    "properties.E110": QT_TRANSLATE_NOOP("VolfrepStudy", "stiffness across a face"),
    "properties.E111": QT_TRANSLATE_NOOP("VolfrepStudy", "stiffness along a diagonal"),
    "properties.G": QT_TRANSLATE_NOOP("VolfrepStudy", "shear modulus"),
    "properties.bulk": QT_TRANSLATE_NOOP("VolfrepStudy", "bulk modulus"),
    "properties.strength": QT_TRANSLATE_NOOP("VolfrepStudy", "strength"),
    "properties.shear_strength": QT_TRANSLATE_NOOP("VolfrepStudy", "shear strength"),
    "properties.nu": QT_TRANSLATE_NOOP("VolfrepStudy", "Poisson's ratio"),
    "properties.zener": QT_TRANSLATE_NOOP("VolfrepStudy", "Zener anisotropy"),
    "properties.conductivity": QT_TRANSLATE_NOOP("VolfrepStudy", "conductivity, of the solid's"),
    "fill.relative_density": QT_TRANSLATE_NOOP("VolfrepStudy", "relative density"),
    "forecast.relative_density": QT_TRANSLATE_NOOP("VolfrepStudy", "expected relative density"),
    "fill.volume_mm3": QT_TRANSLATE_NOOP("VolfrepStudy", "volume, mm3"),
    "forecast.volume_mm3": QT_TRANSLATE_NOOP("VolfrepStudy", "expected volume, mm3"),
    "fill.area_mm2": QT_TRANSLATE_NOOP("VolfrepStudy", "surface, mm2"),
    "fill.strut_radius_mm": QT_TRANSLATE_NOOP("VolfrepStudy", "strut radius, mm"),
    "forecast.strut_radius_mm": QT_TRANSLATE_NOOP("VolfrepStudy", "expected strut radius, mm"),
    "fill.struts": QT_TRANSLATE_NOOP("VolfrepStudy", "struts"),
    "forecast.struts": QT_TRANSLATE_NOOP("VolfrepStudy", "expected struts"),
    "fill.triangles": QT_TRANSLATE_NOOP("VolfrepStudy", "triangles"),
    "forecast.triangles": QT_TRANSLATE_NOOP("VolfrepStudy", "expected triangles"),
    "forecast.seconds": QT_TRANSLATE_NOOP("VolfrepStudy", "time, s"),
    "forecast.memory_gb": QT_TRANSLATE_NOOP("VolfrepStudy", "memory, GB"),
}
#: Those whose unit is the run's.
MODULI = {f"properties.{name}" for name in ("E100", "E110", "E111", "G", "bulk", "strength",
                                            "shear_strength")}  # fmt: skip
#: As `unit_of_moduli` has it.
OF_SOLID = QT_TRANSLATE_NOOP("VolfrepStudy", "of the solid's")
#: The time is told once nothing was typed for so long, ms.
SETTLED = 250
UNITS = {"length": " mm", "mass": " g"}


class StudyPanel:
    """Runs a study and shows its designs; every change of the document is an undo step.

    Args:
        obj: the design study.
    """

    def __init__(self, obj: App.DocumentObject) -> None:
        self._obj, self._doc = obj, obj.Document
        self._picked: dict[str, Any] | None = None
        self._previews = PreviewThread(obj.Infill)
        self._view: PreviewView | None = None
        self._was_visible: dict[Any, bool] = {}
        self.form = self._build()
        self._show_table()

    def getStandardButtons(self) -> int:  # noqa: N802
        """Close."""
        return CLOSE

    def reject(self) -> bool:
        """Close."""
        self._show_infill()
        close_panel(self._doc)
        return True

    def start(self) -> None:
        """Run what is missing of the study that the panel shows, as one undo step."""
        self._text.say("")
        self._show_infill()
        try:
            with undo_step(self._doc, translate("VOLFREP_DesignStudy", "Design Study")):
                self._write()
                done = run_study(self._obj)
        except VolfrepError as error:
            self._text.say(str(error), wrong=True)
            return
        self._show_table()
        if not done or self._obj.Refused:
            self._text.say("\n".join([self._obj.Status, *self._obj.Refused[:3]]), wrong=not done)

    def apply(self) -> None:
        """Give the design that was picked to the infill, as one undo step."""
        if self._picked is None:
            return
        step = translate("VOLFREP_DesignStudy", "Apply Design")
        self._show_infill()
        try:
            with undo_step(self._doc, step):
                went_well = apply_design(self._obj, self._picked["key"])
        except VolfrepError as error:
            self._text.say(str(error), wrong=True)
            return
        self._text.say(self._obj.Infill.Status, wrong=not went_well)

    def open_page(self) -> None:
        """Show the study's page in the browser."""
        page = Path(self._obj.Folder) / "index.html"
        QtGui.QDesktopServices.openUrl(QtCore.QUrl.fromLocalFile(str(page)))

    def _build(self) -> Any:
        form = PanelForm("VolfrepStudyPanel", self._obj.Label, "design_study")
        box = QtWidgets.QGroupBox(translate("VolfrepStudy", "What varies"))
        rows = QtWidgets.QGridLayout(box)
        rows.setContentsMargins(6, 4, 6, 4)
        self._known = {p.property_name: p for p in variable(self._obj.Infill)}
        self._rows = [self._row(rows, number) for number in range(ROWS)]
        form.column.addWidget(box)
        self._fill = QtWidgets.QCheckBox(translate("VolfrepStudy", "Mesh and measure every design"))
        self._fill.setObjectName("Fill")
        self._fill.setChecked(self._obj.Fill)
        self._fill.toggled.connect(lambda _: self._show_count())
        form.column.addWidget(self._fill)
        line = QtWidgets.QHBoxLayout()
        self._count = QtWidgets.QLabel()
        self._count.setObjectName("Count")
        line.addWidget(self._count, 1)
        self._settles = QtCore.QTimer(form)
        self._settles.setSingleShot(True)
        self._settles.timeout.connect(self._show_time)
        self._show_count()
        line.addWidget(push_button("Start", translate("VolfrepStudy", "Start"), self.start))
        form.column.addLayout(line)
        self._plot = StudyPlot(self._pick)
        form.column.addWidget(self._plot, 1)
        lines = QtWidgets.QFormLayout()  # a line each: names of figures are long
        self._across, self._up = (
            self._axis(lines, *axis) for axis in (("x", "Across"), ("y", "Up"))
        )
        form.column.addLayout(lines)
        self._text = Message("Picked")
        form.column.addWidget(self._text)
        line = QtWidgets.QHBoxLayout()
        tip = translate("VolfrepStudy", "Give this design to the infill, as one undo step")
        self._applies = push_button("Apply", translate("VolfrepStudy", "Apply"), self.apply, tip)
        tip = translate("VolfrepStudy", "Show the table and all plots in the browser")
        text = translate("VolfrepStudy", "Open report")
        self._page = push_button("Page", text, self.open_page, tip)
        for button in (self._applies, self._page):
            line.addWidget(button)
        form.column.addLayout(line)
        leave_the_wheel(form, [self._across, self._up, *(name for name, _ in self._rows)])
        return form

    def _row(self, rows: Any, number: int) -> tuple[Any, Any]:
        """A property and its values."""
        name, values = QtWidgets.QComboBox(), QtWidgets.QLineEdit()
        name.setObjectName(f"Property{number + 1}")
        values.setObjectName(f"Values{number + 1}")
        name.setSizeAdjustPolicy(QtWidgets.QComboBox.AdjustToMinimumContentsLengthWithIcon)
        name.setMinimumContentsLength(13)  # the longest name in Italian; values take the rest
        values.setToolTip(translate("VolfrepStudy", "Values: 6, 8, 10, or 6 to 10 in 5"))
        name.addItem("", "")
        for known in self._known:
            name.addItem(label_of(known), known)
        if number < len(self._obj.Vary):
            varied, _, text = (part.strip() for part in self._obj.Vary[number].partition(":"))
            name.setCurrentIndex(max(0, name.findData(varied)))
            _show_text(values, text)
        name.currentIndexChanged.connect(lambda _: self._suggest(name, values))
        values.textChanged.connect(lambda _: self._show_count())
        rows.addWidget(name, number, 0)
        rows.addWidget(values, number, 1)
        rows.setColumnStretch(1, 1)
        return name, values

    def _suggest(self, name: Any, values: Any) -> None:
        """Values about the present one, for a property that was chosen now."""
        parameter = self._known.get(name.currentData())
        _show_text(values, "" if parameter is None else values_about(self._obj.Infill, parameter))

    def _axis(self, lines: Any, letter: str, name: str) -> Any:
        choice = QtWidgets.QComboBox()
        choice.setObjectName(name)
        choice.setSizeAdjustPolicy(QtWidgets.QComboBox.AdjustToMinimumContentsLengthWithIcon)
        choice.setMinimumContentsLength(7)
        choice.currentIndexChanged.connect(lambda _: self._show_plot())
        lines.addRow(letter, choice)
        return choice

    def _lines(self) -> list[str]:
        """What varies, as the object has it."""
        lines = [
            f"{name.currentData()}: {values.text()}"
            for name, values in self._rows
            if name.currentData()
        ]
        return lines + list(self._obj.Vary[ROWS:])  # written by hand, and not shown

    def _show_count(self) -> None:
        """How many designs a start makes; nothing while what varies makes no sense."""
        try:
            number = designs_asked(self._obj.Infill, self._lines())
        except VolfrepError:
            self._count.setText("")
            self._settles.stop()
            return
        text = translate("VolfrepStudy", "{number} designs")
        self._count.setText(text.format(number=grouped(number)))
        self._settles.start(SETTLED)

    def _show_time(self) -> None:
        """And about how long that takes."""
        from volfrep.studies.running.executors import time_text

        try:
            seconds = expected_seconds(self._obj.Infill, self._lines(), self._fill.isChecked())
        except VolfrepError as error:
            self._count.setToolTip(str(error))
            return
        text = translate("VolfrepStudy", "{designs}, about {time}")
        self._count.setText(text.format(designs=self._count.text(), time=time_text(seconds)))

    def _write(self) -> None:
        """What the panel shows, into the object."""
        self._obj.Vary = self._lines()
        self._obj.Fill = self._fill.isChecked()

    def _show_table(self) -> None:
        """The axes that the table has figures for, and the plot."""
        rows = designs_of_study(self._obj)
        numeric = [
            name for name in WORDS if any(isinstance(row.get(name), (int, float)) for row in rows)
        ]
        for choice, wanted in zip((self._across, self._up), FIRST, strict=True):
            before = choice.currentData()
            choice.blockSignals(True)
            choice.clear()
            for name in numeric:
                choice.addItem(self._in_words(name), name)
            shown = [name for name in (before, *wanted) if name in numeric]
            choice.setCurrentIndex(choice.findData(shown[0]) if shown else -1)
            choice.setEnabled(bool(numeric))
            choice.blockSignals(False)
        self._picked = None
        self._applies.setEnabled(False)
        self._page.setEnabled((Path(self._obj.Folder or "/none") / "index.html").is_file())
        self._text.say(self._obj.Status if rows else "")  # the plot itself says that there are none
        self._show_plot()

    def _show_plot(self) -> None:
        words = [name for name in varied_of_study(self._obj) if name == "cell"]
        colour = words[0] if words else ""
        rows = designs_of_study(self._obj)
        axes = [choice.currentData() or "" for choice in (self._across, self._up)]
        self._plot.show_rows(
            rows, (axes[0], axes[1]), [self._in_words(name) for name in axes], colour
        )

    def _pick(self, row: dict[str, Any]) -> None:
        self._picked = row
        self._applies.setEnabled(True)
        values = [_value_in_words(name, row[name]) for name in varied_of_study(self._obj)]
        for axis in (self._across, self._up):
            name, _, unit = self._in_words(axis.currentData()).partition(", ")
            values.append(f"{name} {_shown(row[axis.currentData()])} {unit}".rstrip())
        self._text.say(", ".join(values))
        self._show_design(row["key"])

    def _show_design(self, key: str) -> None:
        """Have a design's preview made, for the place of the infill and its solid."""
        try:
            spec = design_spec(self._obj, key)
        except VolfrepError as error:
            self._refuse_design(error)
            return
        self._previews.ask(self._show_preview, self._refuse_design, spec)

    def _refuse_design(self, error: VolfrepError) -> None:
        self._show_infill()
        self._text.say(str(error), wrong=True)

    def _show_preview(self, ready: ReadyPreview) -> None:
        infill = self._obj.Infill
        if self._view is None:
            self._view = PreviewView(infill)
            self._was_visible = {
                part: part.ViewObject.Visibility for part in (infill, infill.Base) if part
            }
            for part in self._was_visible:
                part.ViewObject.Visibility = False
        ready.show_in(self._view)

    def _show_infill(self) -> None:
        """What was shown before a design was."""
        self._previews.drop()
        if self._view is None:
            return
        self._view.remove()
        self._view = None
        for part, visible in self._was_visible.items():
            with suppress(ReferenceError):  # deleted meanwhile
                part.ViewObject.Visibility = visible

    def _in_words(self, name: str) -> str:
        """A figure of the table as a user reads it, with its unit; empty for none."""
        words = str(translate("VolfrepStudy", WORDS[name])) if name in WORDS else name
        unit = unit_of_moduli(self._obj) if name in MODULI else ""
        return ", ".join(filter(None, (words, unit and translate("VolfrepStudy", unit))))


def open_study(obj: App.DocumentObject) -> bool:
    """Open the panel of a study; False, and why, where it has no infill any more."""
    if obj.Infill is None:
        tell_error(
            translate("VolfrepStudy", "The infill of this study has gone: choose another one.")
        )
        return False
    Gui.Control.showDialog(StudyPanel(obj))
    return True


def _value_in_words(name: str, value: Any) -> str:
    """What a parameter of a design is, as a user reads it."""
    parameter = parameter_of(name)
    return f"{label_of(parameter.property_name)} {_shown(value)}{UNITS.get(parameter.kind, '')}"


def _show_text(line: Any, text: str) -> None:
    """Put a text into a line that may be narrower: its beginning is what is seen."""
    line.setText(text)
    line.setCursorPosition(0)


def _shown(value: Any) -> str:
    return f"{value:.4g}" if isinstance(value, float) else str(value)

# SPDX-License-Identifier: LGPL-2.1-or-later
"""The task panel of Loads and Sizing: load cases, what is wanted, limits, bounds, and the steps."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import FreeCAD as App
import FreeCADGui as Gui

from freecad_volfrep.features.infill.materials import process_of
from freecad_volfrep.features.sizing.ahead import goal_ahead
from freecad_volfrep.features.sizing.as_built import (
    building_in_words,
    building_of,
    is_sized_for_print,
    sized_as_printed,
)
from freecad_volfrep.features.sizing.sizing import (
    GOALS,
    ONLY_OF,
    Outcome,
    first_numbers,
    size_struts,
    store_outcome,
)
from freecad_volfrep.gui.colours.colour_dock import close_struts, open_struts
from freecad_volfrep.gui.jobs.updating import begin_update, show_mesh
from freecad_volfrep.gui.panel.property_fields import PropertyFields, direction_text, label_of
from freecad_volfrep.gui.qt import OK_CANCEL, QtCore, QtWidgets
from freecad_volfrep.gui.widgets.controls import Message, push_button, table_of_rows
from freecad_volfrep.gui.widgets.panel_manners import (
    PanelForm,
    bring_into_sight,
    close_panel,
    leave_the_wheel,
    number_width,
)
from freecad_volfrep.gui.widgets.printed_table import PrintedTableFields
from freecad_volfrep.gui.windows.plot_window import show_plot
from freecad_volfrep.gui.windows.report_window import show_report
from freecad_volfrep.translation import QT_TRANSLATE_NOOP, spoken, translate
from volfrep.util.errors import Cancelled, VolfrepError

from .ahead import Ahead
from .heat_box import HeatBox
from .loads_box import LoadsBox

#: The table of steps is brought up to date so often while they are made, ms.
TICK = 150
#: Of the list of tables, px: their names are long.
_TABLE_WIDTH = 180
#: Standard deviations that may be asked for, at most.
_MOST_SCATTER = 6.0
HEADER = (
    QT_TRANSLATE_NOOP("VolfrepSizePanel", "Step"),
    QT_TRANSLATE_NOOP("VolfrepSizePanel", "Mass, g"),
    QT_TRANSLATE_NOOP("VolfrepSizePanel", "Work, N mm"),
    QT_TRANSLATE_NOOP("VolfrepSizePanel", "Most used limit"),
)
#: Columns that say something for one of the goals only.
WORK, USED = 2, 3
#: Fields: name of `volfrep.jobs.sizing.GOALS`, label, unit, what it means.
FIELDS = (
    (
        "safety",
        QT_TRANSLATE_NOOP("VolfrepSizePanel", "Yield safety"),
        "",
        QT_TRANSLATE_NOOP(
            "VolfrepSizePanel",
            "Yield stress over the largest von Mises stress in a strut; 0 for no limit",
        ),
    ),
    (
        "max_displacement",
        QT_TRANSLATE_NOOP("VolfrepSizePanel", "Displacement"),
        "mm",
        QT_TRANSLATE_NOOP(
            "VolfrepSizePanel", "The largest of any point under any case; 0 for no limit"
        ),
    ),
    (
        "buckling",
        QT_TRANSLATE_NOOP("VolfrepSizePanel", "Buckling safety"),
        "",
        QT_TRANSLATE_NOOP(
            "VolfrepSizePanel",
            "How many times the load may be before struts buckle, one alone or together; 0 for "
            "no limit",
        ),
    ),
    (
        "min_frequency",
        QT_TRANSLATE_NOOP("VolfrepSizePanel", "Frequency, Hz"),
        "",
        QT_TRANSLATE_NOOP(
            "VolfrepSizePanel", "The lowest natural one, held as in the first case; 0 for no limit"
        ),
    ),
    (
        "strut_mass",
        QT_TRANSLATE_NOOP("VolfrepSizePanel", "Mass, g"),
        "",
        QT_TRANSLATE_NOOP(
            "VolfrepSizePanel",
            "What the stiffest struts weigh, with a skin that is sized; 0 for what those of "
            "StrutRadius and the present skin do",
        ),
    ),
    (
        "thinnest",
        QT_TRANSLATE_NOOP("VolfrepSizePanel", "Smallest radius"),
        "mm",
        QT_TRANSLATE_NOOP("VolfrepSizePanel", "The thinnest strut that the process prints"),
    ),
    (
        "thickest",
        QT_TRANSLATE_NOOP("VolfrepSizePanel", "Largest radius"),
        "mm",
        QT_TRANSLATE_NOOP(
            "VolfrepSizePanel", "Nodes whose struts would grow together stay below it"
        ),
    ),
    (
        "skin_thinnest",
        QT_TRANSLATE_NOOP("VolfrepSizePanel", "Thinnest skin"),
        "mm",
        QT_TRANSLATE_NOOP(
            "VolfrepSizePanel",
            "Size the skin, too, from this thickness on; 0 leaves it as it is",
        ),
    ),
    (
        "skin_thickest",
        QT_TRANSLATE_NOOP("VolfrepSizePanel", "Thickest skin"),
        "mm",
        QT_TRANSLATE_NOOP(
            "VolfrepSizePanel",
            "Where more is needed the part becomes solid; 0 for half the cell size",
        ),
    ),
)


class SizePanel:
    """Sizes an infill's struts inside one transaction, which Cancel takes back as a whole.

    Args:
        obj: the infill.
        is_new: whether it was made for this panel, in a transaction that is open.
    """

    def __init__(self, obj: App.DocumentObject, is_new: bool = False) -> None:
        self._obj, self._doc = obj, obj.Document
        if not is_new:
            self._doc.openTransaction(translate("VOLFREP_SizeLattice", "Loads and Sizing"))
        self._steps: list[tuple[str, ...]] = []
        self._outcome: Outcome | None = None
        self._is_open = True
        App.addDocumentObserver(self)
        close_struts(obj)
        self.form = self._build(first_numbers(obj))
        self._timer = QtCore.QTimer(self.form)
        self._timer.timeout.connect(self._show_steps)
        self._show_fields()
        # Once FreeCAD has put the panel up.
        QtCore.QTimer.singleShot(0, self._begin_loads)
        self._ahead = Ahead()
        QtCore.QTimer.singleShot(0, self._begin_ahead)

    def getStandardButtons(self) -> int:  # noqa: N802
        """OK and Cancel."""
        return OK_CANCEL

    def accept(self) -> bool:
        """Keep the radii that were found, and close; their mesh comes while the user goes on.

        Stays open without any.
        """
        if self._outcome is None and self._loads.has_heat_alone():
            return self._take_heat()
        if self._outcome is None and not self._find():
            return False
        outcome = self._outcome
        assert outcome is not None
        close_struts(self._obj)
        store_outcome(self._obj, outcome)
        if not self._keep():
            return False
        label = self._obj.Label
        tables = outcome.tables()
        if self._heat.outcome is not None:
            tables += self._heat.outcome.tables()
        show_report(self._title, f"{label} sizing", tables, lambda: outcome.page(label))
        return True

    def _take_heat(self) -> bool:
        """Keep what is warm, and report it: there is nothing to size for."""
        if self._heat.outcome is None and not self._heat.solve():
            return False
        outcome = self._heat.outcome
        assert outcome is not None
        if not self._keep():
            return False
        show_report(self._title, f"{self._obj.Label} heat", outcome.tables())
        return True

    def _keep(self) -> bool:
        """Update the infill, keep its loads as one step, and close; or say what is wrong."""
        begin_update(self._obj, ended=self._show_mesh)
        if not self._obj.isValid():
            self._say(self._obj.Status, wrong=True)
            return False
        self._loads.end(is_kept=True)
        self._doc.commitTransaction()
        self._close()
        return True

    @property
    def _title(self) -> str:
        text = translate("VolfrepSizePanel", "Loads and Sizing: {label}")
        return str(text.format(label=self._obj.Label))

    def _begin_loads(self) -> None:
        if self._is_open:
            self._loads.begin()

    def _begin_ahead(self) -> None:
        """Have made what no load changes, of the values that the panel begins with."""
        if not self._is_open:
            return
        for_print = self._for_print.isChecked()
        try:
            goal = goal_ahead(
                self._obj, self._numbers(), self._printed_table(), self._scatter.value(), for_print
            )
        except VolfrepError:  # a sizing tells it
            return
        self._ahead.begin(self._obj, goal, for_print)

    def _show_mesh(self, is_there: bool | None) -> None:
        if is_there:
            show_mesh(self._obj)

    def reject(self) -> bool:
        """Close and leave the infill as it was."""
        close_struts(self._obj)
        self._loads.end(is_kept=False)
        self._doc.abortTransaction()  # to end the editing would commit it
        self._close()
        self._doc.recompute()
        return True

    def size(self) -> bool:
        """Size the struts now, and show them. Says what is wrong."""
        if not self._find():
            return False
        assert self._outcome is not None
        open_struts(self._obj, self._outcome.states, self._outcome.printed, self._outcome.limits)
        return True

    def _find(self) -> bool:
        """Size the struts; a cancel keeps the best design so far. Says what is wrong."""
        self._loads.end_picking()
        self._say("")
        self._steps.clear()
        # What is looked for, and no more: the panel is narrow.
        for column in (WORK, USED):
            only = "mass" if column == USED else "stiffness"
            self._table.setColumnHidden(column, self._goal.currentData() != only)
        self._show_steps()
        self._outcome = None
        self._plot.setEnabled(False)
        self._timer.start(TICK)
        try:
            self._outcome = size_struts(
                self._obj,
                self._loads.chosen(),
                self._numbers(),
                self._steps.append,
                goal=self._goal.currentData(),
                prove=self._prove.isChecked(),
                remove_thin=self._remove.isChecked(),
                as_printed=self._printed_table(),
                scatter=self._scatter.value(),
                for_print=self._for_print.isChecked(),
                ahead=self._ahead.take,
            )
        except VolfrepError as error:
            self._say(str(error), wrong=True)
            return False
        except Cancelled:
            self._say(translate("VolfrepSizePanel", "Cancelled before the first step."))
            return False
        finally:
            self._timer.stop()
            self._show_steps()
        self._plot.setEnabled(True)
        self._say(self._outcome.summary(), wrong=not self._outcome.holds)
        return True

    def _show_plot(self) -> None:
        """The steps as a plot."""
        from volfrep.reports.sizing_plot import sizing_plot

        if self._outcome is not None:
            title = translate("VolfrepSizePanel", "Steps of {label}")
            show_plot(title.format(label=self._obj.Label), sizing_plot(self._outcome.part.report))

    def _build(self, first: Mapping[str, float]) -> Any:
        form = PanelForm("VolfrepSizePanel", self._title, "size_lattice")
        self._loads = LoadsBox(self._obj)
        self._heat = HeatBox(self._obj, self._loads.chosen, self._loads.end_picking)
        self._loads.changed.connect(self._heat.look)
        self._lists = [self._loads.size, self._loads.direction, self._heat.conductivity]
        for box in (self._loads, self._heat, self._material_box(), self._goal_box(first)):
            form.column.addWidget(box)
        heads = (translate("VolfrepSizePanel", text) for text in HEADER)
        self._table = table_of_rows("Steps", heads)
        self._table.verticalHeader().setVisible(False)
        self._table.setMinimumHeight(160)
        self._said = Message("Said")
        tip = translate(
            "VolfrepSizePanel",
            "Find the radii now and stay in this panel; Cancel in the status bar keeps the "
            "best design so far",
        )
        find = push_button("Size", translate("VolfrepSizePanel", "Find radii"), self.size, tip)
        tip = translate("VolfrepSizePanel", "How mass and limits went, step by step")
        text = translate("VolfrepSizePanel", "Plot")
        self._plot = push_button("Plot", text, self._show_plot, tip)
        self._plot.setEnabled(False)
        for widget in (find, self._said, self._table, self._plot):
            form.column.addWidget(widget)
        leave_the_wheel(
            form, [*self._lists, self._goal, *(field for _, field in self._fields.values())]
        )
        return form

    def _material_box(self) -> Any:
        """Material, process and build direction, which are the infill's own."""
        box = QtWidgets.QGroupBox(translate("App::Property", "Material"))
        rows = QtWidgets.QFormLayout(box)
        rows.setContentsMargins(6, 4, 6, 4)
        rows.setRowWrapPolicy(QtWidgets.QFormLayout.WrapLongRows)
        made = PropertyFields(self._obj, self._made_of, self._refuse)
        for name in ("PrintMaterial", "PrintProcess", "BuildDirection"):
            field = made.field(name)
            field.setObjectName(name)
            field.setAccessibleName(label_of(name))
            rows.addRow(QtWidgets.QLabel(label_of(name)), field)
            self._lists.append(field)
        field.setToolTip(translate("App::Property", "From the build plate up"))
        self._add_printed(rows)
        self._for_print = _switch(
            "ForPrint",
            is_sized_for_print(self._obj),
            translate("VolfrepSizePanel", "For printing"),
            translate(
                "VolfrepSizePanel",
                "Struts and skin no thinner than the process prints, and none flatter as far as "
                "limits allow",
            ),
        )
        rows.addRow(self._for_print)
        self._building = Message("Building")
        rows.addRow(self._building)
        self._show_building()
        return box

    def _refuse(self, name: str, text: str) -> None:
        """Say what was wrong with what was typed, and show what holds again."""
        way = self.form.findChild(QtWidgets.QLineEdit, name)
        way.setText(direction_text(name, getattr(self._obj, name)))
        self._say(text, wrong=True)

    def _show_building(self) -> None:
        """What the infill's process asks for, or that none is chosen."""
        try:
            building = building_of(self._obj)
        except VolfrepError as error:
            self._for_print.setEnabled(False)
            self._for_print.setChecked(False)
            self._building.say(str(error))
            return
        self._for_print.setEnabled(True)
        self._building.say(building_in_words(building))

    def _add_printed(self, rows: Any) -> None:
        """How struts come out: as drawn, by a table of the infill's process, or by one's own."""
        self._printed = PrintedTableFields(self._show_printed)
        self._printed.choice.setMinimumWidth(_TABLE_WIDTH)  # on a line of its own
        self._scatter = QtWidgets.QDoubleSpinBox()
        self._scatter.setRange(0.0, _MOST_SCATTER)
        self._scatter.setSingleStep(0.5)
        fields = (
            (
                "Printed",
                self._printed.choice,
                translate("VolfrepSizePanel", "Struts"),
                translate(
                    "VolfrepSizePanel",
                    "As drawn, or as this printer makes them: stress, stiffness and mass are then "
                    "of struts as printed, and the radii found are those to draw",
                ),
            ),
            (
                "Table",
                self._printed.file,
                translate("VolfrepPrinterFile", "Table"),
                translate(
                    "VolfrepSizePanel",
                    "A .csv file with the columns inclination, nominal, measured, as Coupons makes",
                ),
            ),
            (
                "Scatter",
                self._scatter,
                translate("VolfrepSizePanel", "Standard deviations"),
                translate(
                    "VolfrepSizePanel",
                    "Stress and buckling are of struts thinner by so many standard deviations of "
                    "the table",
                ),
            ),
        )
        self._printed_rows = {}
        for name, field, text, tip in fields:
            field.setObjectName(name)
            field.setAccessibleName(text)
            field.setToolTip(tip)
            label = QtWidgets.QLabel(text)
            rows.addRow(label, field)
            self._printed_rows[name] = label, field
        self._lists += [self._printed.choice, self._scatter]
        table, scatter = sized_as_printed(self._obj)
        self._offer_tables()
        self._printed.show(table)
        self._scatter.setValue(scatter)
        self._show_printed()

    def _offer_tables(self) -> None:
        """Those of the process that the infill is printed by, or of all."""
        try:
            self._printed.offer(process_of(self._obj))
        except VolfrepError:  # its material's file says nothing yet, which sizing tells
            self._printed.offer(None)

    def _show_printed(self) -> None:
        """Ask for what the choice of a table needs only."""
        known = self._printed.published
        has_scatter = known is None or any(row.scatter for row in known.rows)
        shown = {
            "Table": self._printed.is_own,
            "Scatter": has_scatter and bool(self._printed.choice.currentData()),
        }
        for name, is_shown in shown.items():
            for widget in self._printed_rows[name]:
                widget.setVisible(is_shown)
        if not shown["Scatter"]:
            self._scatter.setValue(0.0)

    def _printed_table(self) -> str:
        """The table that was chosen; empty for struts as drawn.

        Raises:
            VolfrepError: a file is to be chosen yet.
        """
        if self._printed.is_own and not self._printed.wanted:
            raise VolfrepError("Choose the .csv file of your own measurements, or another table.")
        return self._printed.wanted

    def _made_of(self, name: str) -> None:
        """Struts no thinner than the process prints; its tables of printed diameters."""
        self._say("")
        self._offer_tables()
        self._show_building()
        first = first_numbers(self._obj)
        for bound in ("thinnest", "thickest"):
            field = self._fields[bound][1]
            field.setProperty("rawValue", max(field.property("rawValue"), first[bound]))

    def _goal_box(self, first: Mapping[str, float]) -> Any:
        box = QtWidgets.QGroupBox(translate("VolfrepSizePanel", "Goal and limits"))
        rows = QtWidgets.QFormLayout(box)
        rows.setContentsMargins(6, 4, 6, 4)
        rows.setRowWrapPolicy(QtWidgets.QFormLayout.WrapLongRows)
        self._goal = QtWidgets.QComboBox()
        self._goal.setObjectName("Goal")
        for goal, text in GOALS.items():
            self._goal.addItem(translate("VolfrepSizePanel", text), goal)
        self._goal.currentIndexChanged.connect(lambda _: self._show_fields())
        rows.addRow(QtWidgets.QLabel(translate("VolfrepSizePanel", "Goal")), self._goal)
        self._prove = _switch(
            "Prove",
            True,
            translate("VolfrepSizePanel", "Check with CalculiX"),
            translate(
                "VolfrepSizePanel",
                "Let CalculiX solve the design, where it is installed, and say how far it agrees; "
                "where it finds more than a limit allows, the struts are made thicker",
            ),
        )
        self._fields: dict[str, tuple[Any, Any]] = {}
        for name, text, unit, tip in FIELDS:
            spin = Gui.UiLoader().createWidget("Gui::QuantitySpinBox")
            spin.setProperty("unit", unit)
            spin.setProperty("minimum", 0.0)
            spin.setProperty("rawValue", first.get(name, 0.0))
            spin.setObjectName(name)
            spin.setToolTip(translate("VolfrepSizePanel", tip))
            spin.setMinimumWidth(number_width(spin))
            label = QtWidgets.QLabel(translate("VolfrepSizePanel", text))
            rows.addRow(label, spin)
            self._fields[name] = label, spin
        self._remove = _switch(
            "Remove",
            False,
            translate("VolfrepSizePanel", "Remove struts that carry little"),
            translate(
                "VolfrepSizePanel",
                "Take away struts that end as thin as the smallest radius and size the rest again; "
                "kept if that is lighter, or stiffer at the same mass",
            ),
        )
        for row in (self._prove, self._remove):
            rows.addRow(row)
        return box

    def _show_fields(self) -> None:
        """Hide what says nothing for the goal."""
        goal = self._goal.currentData()
        hidden = {name for kind, names in ONLY_OF.items() if kind != goal for name in names}
        for name, row in self._fields.items():
            for widget in row:
                widget.setVisible(name not in hidden)

    def _numbers(self) -> dict[str, float]:
        return {name: float(spin.property("rawValue")) for name, (_, spin) in self._fields.items()}

    def _show_steps(self) -> None:
        """Bring the table up to the steps that were made."""
        if self._table.rowCount() > len(self._steps):
            self._table.setRowCount(0)
        for row in range(self._table.rowCount(), len(self._steps)):
            self._table.insertRow(row)
            for column, text in enumerate(_step_in_words(self._steps[row])):
                self._table.setItem(row, column, QtWidgets.QTableWidgetItem(text))
        self._table.resizeColumnsToContents()
        self._table.scrollToBottom()

    def _say(self, text: str, wrong: bool = False) -> None:
        self._said.say(text, wrong)
        if text:
            # OK is far above, and the table below: nobody would see it.
            QtCore.QTimer.singleShot(0, self._show_said)

    def _show_said(self) -> None:
        if self._is_open:
            bring_into_sight(self._said)

    def slotDeletedDocument(self, doc: App.Document) -> None:  # noqa: N802
        """Called by FreeCAD: the panel goes with its document, once FreeCAD is done with that."""
        if doc == self._doc and self._is_open:
            self._loads.forget()
            self._end()
            QtCore.QTimer.singleShot(0, self._leave)

    def _close(self) -> None:
        self._end()
        App.removeDocumentObserver(self)
        close_panel(self._doc)

    def _leave(self) -> None:
        App.removeDocumentObserver(self)
        Gui.Control.closeDialog()

    def _end(self) -> None:
        self._is_open = False
        self._ahead.cancel()
        self._timer.stop()


def _step_in_words(step: tuple[str, ...]) -> tuple[str, ...]:
    """A row of the table of steps in the user's language."""
    *figures, used = step
    limit, _, share = used.rpartition(" ")
    most = f"{translate('VolfrepSizePanel', limit)} {share}" if limit else used
    return (*map(spoken, figures), most)


def _switch(name: str, is_on: bool, text: str, tip: str) -> Any:
    """A box to tick, by its object's name."""
    result = QtWidgets.QCheckBox(text)
    result.setObjectName(name)
    result.setChecked(is_on)
    result.setToolTip(tip)
    return result

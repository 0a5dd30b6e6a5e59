# SPDX-License-Identifier: LGPL-2.1-or-later
"""Load cases in the panel: what is held and what loads it, picked in the view, drawn by arrows."""

from __future__ import annotations

from typing import Any

import FreeCAD as App
import FreeCADGui as Gui

from freecad_volfrep.bridge.fem_loads import constraints_of, has_heat_alone, has_loads, is_analysis
from freecad_volfrep.features.sizing.document_loads import (
    DIRECTIONS,
    FLOW,
    FORCE,
    HELD,
    KINDS,
    PRESSURE,
    SIZES,
    WARM,
    WEIGHT,
    add_load,
    direction_of,
    load_kind,
    make_case,
    remove_load,
    said_load,
    set_direction,
    set_size,
    size_of,
    toggle_face,
)
from freecad_volfrep.gui.panel.property_fields import PlainNumber
from freecad_volfrep.gui.qt import QtCore, QtWidgets
from freecad_volfrep.gui.widgets.controls import push_button
from freecad_volfrep.gui.widgets.panel_manners import fits_any_width, keep_height, narrow
from freecad_volfrep.translation import QT_TRANSLATE_NOOP, translate

#: Most height of the lists, and least width of a field, px.
CASES, LOADS, FIELD = 48, 78, 60
LARGEST = 1e9
#: Lines of text that say what is picked.
HINT = 3
TIPS = {
    HELD: QT_TRANSLATE_NOOP(
        "VolfrepLoads",
        "Click at faces in the view that do not move; Ctrl takes all alike",
    ),
    FORCE: QT_TRANSLATE_NOOP(
        "VolfrepLoads",
        "Click at faces in the view that carry the force; Ctrl takes all alike",
    ),
    PRESSURE: QT_TRANSLATE_NOOP(
        "VolfrepLoads",
        "Click at faces in the view under pressure; Ctrl takes all alike",
    ),
    WEIGHT: QT_TRANSLATE_NOOP("VolfrepLoads", "The part's own weight, downwards"),
    WARM: QT_TRANSLATE_NOOP(
        "VolfrepLoads",
        "Click at faces in the view that have this temperature; Ctrl takes all alike",
    ),
    FLOW: QT_TRANSLATE_NOOP(
        "VolfrepLoads",
        "Click at faces in the view through which this heat flows in; below 0, out",
    ),
}


class LoadsBox(QtWidgets.QGroupBox):
    """The document's analyses, each a load case, and what is in the one that is chosen.

    Its signal `changed` is sent when there is another load, or one has another size.

    Args:
        obj: the infill.
    """

    changed = QtCore.Signal()

    def __init__(self, obj: App.DocumentObject) -> None:
        super().__init__(translate("VolfrepSizePanel", "Load cases"))
        self._obj, self._doc = obj, obj.Document
        self._kind = ""
        self._picked: App.DocumentObject | None = None
        self._shown: dict[App.DocumentObject, bool] = {}
        self._made: list[App.DocumentObject] = []
        self._takes_alike = False
        self._cases = QtWidgets.QListWidget()
        self._cases.setObjectName("Cases")
        self._cases.setMaximumHeight(CASES)
        self._cases.setToolTip(
            translate("VolfrepSizePanel", "Analyses of the FEM workbench: each is a load case")
        )
        tip = translate("VolfrepLoads", "Another case, held as this one is")
        text = translate("VolfrepLoads", "New case")
        self._new = push_button("NewCase", text, self._add_case, tip)
        self._hint = QtWidgets.QLabel()
        self._hint.setObjectName("Hint")
        fits_any_width(self._hint)
        keep_height(self._hint, HINT)
        self._loads = QtWidgets.QListWidget()
        self._loads.setObjectName("Loads")
        self._loads.setMaximumHeight(LOADS)
        text = translate("VolfrepLoads", "Remove")
        self._remove = push_button("RemoveLoad", text, self._take_away)
        self.size = PlainNumber()
        self.size.setObjectName("LoadSize")
        self.size.setAccessibleName(translate("VolfrepLoads", "Size"))
        self.size.setRange(-LARGEST, LARGEST)
        self.size.setDecimals(3)
        self.size.setMinimumWidth(FIELD)
        self.direction = QtWidgets.QComboBox()
        self.direction.setObjectName("LoadDirection")
        self.direction.setAccessibleName(translate("VolfrepLoads", "Direction"))
        narrow(self.direction)
        for name in DIRECTIONS:
            self.direction.addItem(translate("VolfrepLoads", name), name)
        self._buttons = {kind: self._kind_button(kind) for kind in KINDS}
        column = QtWidgets.QVBoxLayout(self)
        column.setContentsMargins(6, 4, 6, 4)
        column.addWidget(self._cases)
        grid = QtWidgets.QGridLayout()
        for number, button in enumerate(self._buttons.values()):
            grid.addWidget(button, number // 2, number % 2)
        column.addLayout(grid)
        column.addWidget(self._hint)
        column.addWidget(self._loads)
        for widgets in ((self.size, self.direction), (self._new, self._remove)):
            line = QtWidgets.QHBoxLayout()
            for widget in widgets:
                line.addWidget(widget, 1)
            column.addLayout(line)
        for case in self._doc.Objects:
            if is_analysis(case) and has_loads(case):
                self._add_row(case)
        self._cases.setCurrentRow(0)
        self._cases.currentRowChanged.connect(lambda _: self._show_loads())
        self._cases.itemChanged.connect(lambda _: self.changed.emit())
        self._loads.currentRowChanged.connect(lambda _: self._show_load())
        self.size.valueChanged.connect(self._set_size)
        self.direction.currentIndexChanged.connect(lambda _: self._set_direction())
        self._show_loads()

    def chosen(self) -> list[App.DocumentObject]:
        """The cases that are ticked."""
        rows = [self._cases.item(k) for k in range(self._cases.count())]
        return [self._case_of(row) for row in rows if row.checkState() == QtCore.Qt.Checked]

    def has_heat_alone(self) -> bool:
        """Whether the cases that are ticked say nothing but what is warm."""
        cases = self.chosen()
        return bool(cases) and all(has_heat_alone(case) for case in cases)

    def begin(self) -> None:
        """Where nothing says yet what the part carries: pick what is held."""
        if not self._cases.count():
            self._pick(HELD)

    def end(self, is_kept: bool) -> None:
        """Pick no more; symbols of what was made here go out of the view.

        Args:
            is_kept: whether what was made stays in the document.
        """
        self.end_picking()
        for load in self._made if is_kept else ():
            load.ViewObject.Visibility = False

    def end_picking(self) -> None:
        """Clicks in the view pick no more, and it shows what it did before; again: nothing."""
        if self._kind:
            self._pick("")

    def forget(self) -> None:
        """Pick no more, and leave the document alone, which is gone."""
        if self._kind:
            Gui.Selection.removeObserver(self)
            self._kind = ""

    def addSelection(self, *_: Any) -> None:  # noqa: N802
        """Called by FreeCAD, which is not done with it yet."""
        held_down = QtWidgets.QApplication.keyboardModifiers()
        self._takes_alike = bool(held_down & QtCore.Qt.ControlModifier)
        QtCore.QTimer.singleShot(0, self._take)

    def _kind_button(self, kind: str) -> Any:
        button = QtWidgets.QPushButton(translate("VolfrepLoads", kind))
        button.setObjectName(f"Add{kind}")
        button.setToolTip(translate("VolfrepLoads", TIPS[kind]))
        button.setCheckable(kind != WEIGHT)
        if kind == WEIGHT:
            button.clicked.connect(lambda _=False: self._weigh())
        else:
            button.clicked.connect(lambda is_on=False: self._pick(kind if is_on else ""))
        return button

    def _add_row(self, case: App.DocumentObject) -> None:
        item = QtWidgets.QListWidgetItem(case.Label, self._cases)
        item.setData(QtCore.Qt.UserRole, case.Name)
        item.setFlags(item.flags() | QtCore.Qt.ItemIsUserCheckable)
        item.setCheckState(QtCore.Qt.Checked)

    def _case_of(self, row: Any) -> App.DocumentObject:
        return self._doc.getObject(row.data(QtCore.Qt.UserRole))

    def _case(self) -> App.DocumentObject | None:
        """The case that is chosen, or None where there is none."""
        row = self._cases.currentItem()
        return None if row is None else self._case_of(row)

    def _add_case(self) -> App.DocumentObject:
        before = self._case()
        case = make_case(self._doc, before)
        self._made += constraints_of(case)
        self._add_row(case)
        self._picked = None
        self._cases.setCurrentRow(self._cases.count() - 1)
        return case

    def _load(self) -> App.DocumentObject | None:
        """The support or load that is chosen."""
        case, row = self._case(), self._loads.currentRow()
        loads = [] if case is None else constraints_of(case)
        return loads[row] if 0 <= row < len(loads) else None

    def _show_loads(self, chosen: App.DocumentObject | None = None) -> None:
        """The rows of the case that is chosen; another case's symbols go out of the view."""
        case = self._case()
        loads = [] if case is None else constraints_of(case)
        self._loads.blockSignals(True)
        self._loads.clear()
        self._loads.addItems([said_load(load) for load in loads])
        if loads:
            row = loads.index(chosen) if chosen in loads else len(loads) - 1
            self._loads.setCurrentRow(row)
        self._loads.blockSignals(False)
        for load in self._made:
            load.ViewObject.Visibility = load in loads
        self._show_load()
        self.changed.emit()

    def _show_load(self) -> None:
        """The size and direction of the one that is chosen."""
        load = self._load()
        kind = "" if load is None else load_kind(load)
        self._remove.setEnabled(load is not None)
        self.size.setEnabled(kind in SIZES)
        self.direction.setEnabled(kind == FORCE)
        for field in (self.size, self.direction):
            field.blockSignals(True)
        if load is not None and kind in SIZES:
            self.size.setSuffix(f" {SIZES[kind][1]}")
            self.size.setValue(size_of(load))
        if kind == FORCE:
            self.direction.setCurrentIndex(self.direction.findData(direction_of(load)))
        for field in (self.size, self.direction):
            field.blockSignals(False)

    def _pick(self, kind: str) -> None:
        """Let clicks in the view pick faces for a kind; an empty text ends it."""
        if self._kind:
            Gui.Selection.removeObserver(self)
        else:
            self._shown = {
                one: one.ViewObject.Visibility for one in (self._obj, self._obj.Base) if one
            }
        self._kind, self._picked = kind, None
        for name, button in self._buttons.items():
            button.setChecked(name == kind)
        Gui.Selection.clearSelection()
        if kind:
            Gui.Selection.addObserver(self)
        for one, was_shown in self._shown.items():
            one.ViewObject.Visibility = one == self._obj.Base if kind else was_shown
        self._hint.setText(translate("VolfrepLoads", TIPS[kind]) if kind else "")

    def _take(self) -> None:
        """Put the faces that are selected to what is picked."""
        chosen = [
            (item.Object, name)
            for item in Gui.Selection.getSelectionEx()
            for name in item.SubElementNames
            if name.startswith("Face")
        ]
        if not self._kind or not chosen:
            return
        Gui.Selection.clearSelection()
        if self._picked is None:
            self._picked = self._begin(self._kind)
        for owner, name in chosen:
            toggle_face(self._picked, owner, name, self._takes_alike)
        self._show_loads(self._picked)
        if self._kind in SIZES:
            self.size.setFocus()
            self.size.selectAll()

    def _begin(self, kind: str) -> App.DocumentObject:
        """A new support or load of the case that is chosen, or of a first one."""
        case = self._case() or self._add_case()
        load = add_load(case, kind)
        self._made.append(load)
        return load

    def _weigh(self) -> None:
        self.end_picking()
        self._show_loads(self._begin(WEIGHT))

    def _take_away(self) -> None:
        load = self._load()
        if load is None:
            return
        self.end_picking()
        self._made = [one for one in self._made if one != load]
        remove_load(load)
        self._show_loads()

    def _set_size(self, value: float) -> None:
        load = self._load()
        if load is not None and load_kind(load) in SIZES:
            set_size(load, value)
            self._loads.currentItem().setText(said_load(load))
            self.changed.emit()

    def _set_direction(self) -> None:
        load, name = self._load(), self.direction.currentData()
        if load is not None and load_kind(load) == FORCE and name:
            set_direction(load, name)
            self._loads.currentItem().setText(said_load(load))

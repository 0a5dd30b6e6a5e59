# SPDX-License-Identifier: LGPL-2.1-or-later
"""The window of unit cells: pictures and figures, cells of one's own, and a cell for an infill."""

from __future__ import annotations

import html
from pathlib import Path
from typing import Any

from freecad_volfrep.features.export.input_files import refuse_inputs_of_all
from freecad_volfrep.gui.messages import file_name
from freecad_volfrep.gui.qt import QtCore, QtWidgets
from freecad_volfrep.gui.selection import selected_infill, selected_with_edges
from freecad_volfrep.gui.undo import undo_step
from freecad_volfrep.gui.widgets.controls import push_button
from freecad_volfrep.sentences import localise
from freecad_volfrep.translation import QT_TRANSLATE_NOOP, translate
from volfrep.design.cells import LIBRARY, load_cell
from volfrep.design.parameters.table import CUSTOM_CELL
from volfrep.design.tpms import SURFACES
from volfrep.util.errors import VolfrepError

from .cell_entry import USES, Entry, entry_of
from .cell_finder import show_cell_finder
from .cell_properties import CellProperties
from .cell_window import CellWindow, show_one

#: Of the list's pictures and of the large one, px.
SMALL, LARGE = 84, 220
#: Least width of what is said beside the pictures, px.
BESIDE = 410
#: Height of the sentences on a cell, px.
NOTES = 56
_CONTEXT = "VolfrepCells"
FILTER = QT_TRANSLATE_NOOP("VolfrepCells", "Unit cell (*.json)")
_ENTRY = QtCore.Qt.UserRole


class CellLibrary(CellWindow):
    """Browse cells, load one, make one of what is drawn, save it, apply it."""

    def __init__(self) -> None:
        super().__init__("VolfrepCellLibrary", translate("VOLFREP_CellLibrary", "Cell Library"))
        self._list = self._picker()
        self._use = self._chooser()
        self._picture, self._figures = QtWidgets.QLabel(), QtWidgets.QLabel()
        self._does = CellProperties()
        self._picture.setFixedSize(LARGE, LARGE)
        self._figures.setObjectName("Figures")
        # Many sentences are scrolled: they would push the pictures under each other.
        self._notes = QtWidgets.QScrollArea()
        self._notes.setWidget(self._note)
        self._notes.setWidgetResizable(True)
        self._notes.setFrameShape(QtWidgets.QFrame.NoFrame)
        self._notes.setFixedHeight(NOTES)
        self._buttons = {
            name: push_button(name, translate(_CONTEXT, name), act, translate(_CONTEXT, tip))
            for name, tip, act in (
                (
                    QT_TRANSLATE_NOOP("VolfrepCells", "Load..."),
                    QT_TRANSLATE_NOOP("VolfrepCells", "Read a cell of your own from a JSON file"),
                    self._ask_and_load,
                ),
                (
                    QT_TRANSLATE_NOOP("VolfrepCells", "From Selection"),
                    QT_TRANSLATE_NOOP(
                        "VolfrepCells",
                        "Make a cell of the straight edges of the selected sketches, wires or "
                        "shapes; the cube about them is the cell",
                    ),
                    self.make_from_selection,
                ),
                (
                    QT_TRANSLATE_NOOP("VolfrepCells", "Save As..."),
                    QT_TRANSLATE_NOOP("VolfrepCells", "Write the picked cell to a JSON file"),
                    self._ask_and_save,
                ),
                (
                    QT_TRANSLATE_NOOP("VolfrepCells", "Apply"),
                    QT_TRANSLATE_NOOP(
                        "VolfrepCells", "Give the picked cell to the selected lattice infill"
                    ),
                    self.apply,
                ),
                (
                    QT_TRANSLATE_NOOP("VolfrepCells", "Find..."),
                    QT_TRANSLATE_NOOP(
                        "VolfrepCells", "Find cells by their stiffness and density, in a chart"
                    ),
                    show_cell_finder,
                ),
                (QT_TRANSLATE_NOOP("VolfrepCells", "Close"), "", self.close),
            )
        }
        self._lay_out()
        for cell in (*LIBRARY.values(), *SURFACES.values()):
            self._add(entry_of(cell))
        self._list.currentItemChanged.connect(lambda *_: self._show())
        self._list.setCurrentRow(0)
        self._pick_that_of(selected_infill())
        self.follow_selection()

    def load(self, path: str) -> None:
        """Add the cell of a JSON file and pick it; says here what is wrong with it."""
        try:
            cell = load_cell(path)
        except VolfrepError as error:
            self._note.say(str(error), wrong=True)
            return
        self._add(entry_of(cell, str(Path(path).resolve())), pick=True)

    def make_from_selection(self) -> None:
        """Add the cell that the selected edges draw and pick it; says what cannot be a strut."""
        from freecad_volfrep.bridge.drawn_lines import drawn_lines
        from volfrep.design.drawn_cell import cell_from_lines

        objects = selected_with_edges() or []
        try:
            drawn = cell_from_lines(self._free_name(objects), drawn_lines(objects))
        except VolfrepError as error:
            self._note.say(str(error), wrong=True)
            return
        size = translate(
            _CONTEXT, "Drawn with L = {size:g} mm; every L can be given to an infill."
        ).format(size=drawn.size)
        self._add(entry_of(drawn.cell, notes=(size, *drawn.warnings)), pick=True)

    def save(self, path: str) -> bool:
        """Write the picked cell; returns whether that was done, says here why not."""
        from volfrep.design.drawn_cell import save_cell

        entry = self._entry()
        assert entry.has_file, "the button is off"
        try:
            refuse_inputs_of_all(path, but=("CellFile",))  # a cell may replace a cell
            save_cell(entry.cell, path)
        except VolfrepError as error:
            self._note.say(str(error), wrong=True)
            return False
        if entry.is_own:
            entry.path = str(Path(path).resolve())
        self._show()
        self._note.say(translate("VolfrepMessages", "{path} written").format(path=path))
        return True

    def apply(self) -> None:
        """Give the picked cell to the selected infill; one that has no file yet is saved first."""
        infill, entry = selected_infill(), self._entry()
        if infill is None or (entry.is_own and entry.path is None and not self._ask_and_save()):
            return
        with undo_step(infill.Document, translate(_CONTEXT, "Set Unit Cell")):
            if entry.is_own:
                infill.CellFile = entry.path
                infill.CellType = CUSTOM_CELL
            else:
                infill.CellType = entry.cell.name
            infill.Document.recompute()
        self._note.say(f"{infill.Label}: {localise(infill.Status)}", wrong=not infill.isValid())

    def _picker(self) -> Any:
        picker = QtWidgets.QListWidget()
        picker.setObjectName("Cells")
        picker.setViewMode(QtWidgets.QListView.IconMode)
        picker.setIconSize(QtCore.QSize(SMALL, SMALL))
        picker.setMovement(QtWidgets.QListView.Static)
        picker.setResizeMode(QtWidgets.QListView.Adjust)
        picker.setGridSize(QtCore.QSize(SMALL + 32, SMALL + 46))
        picker.setWordWrap(True)
        picker.setMinimumSize(3 * (SMALL + 28), 2 * (SMALL + 44))
        return picker

    def _chooser(self) -> Any:
        """What the shown cells are for."""
        chooser = QtWidgets.QComboBox()
        chooser.setObjectName("Use")
        chooser.addItem(translate(_CONTEXT, "All cells"), "")
        for use, text in USES.items():
            chooser.addItem(translate(_CONTEXT, text), use)
        chooser.currentIndexChanged.connect(lambda _: self._filter())
        return chooser

    def _filter(self) -> None:
        """Show the library's cells for the chosen use, and all of one's own."""
        use = self._use.currentData()
        for row in range(self._list.count()):
            item = self._list.item(row)
            entry: Entry = item.data(_ENTRY)
            item.setHidden(bool(use) and not entry.is_own and entry.use != use)
        if self._list.currentItem() is not None and self._list.currentItem().isHidden():
            shown = (self._list.item(row) for row in range(self._list.count()))
            self._list.setCurrentItem(next(item for item in shown if not item.isHidden()))

    def _lay_out(self) -> None:
        beside = QtWidgets.QWidget()
        right = QtWidgets.QVBoxLayout(beside)
        right.setContentsMargins(0, 0, 0, 0)
        right.addWidget(self._picture)
        right.addWidget(self._figures)
        right.addWidget(self._does)
        right.addStretch()
        left = QtWidgets.QVBoxLayout()
        left.addWidget(self._use)
        left.addWidget(self._list, 1)
        both = QtWidgets.QHBoxLayout()
        both.addLayout(left, 1)
        # Scrolled, too, where the screen is low.
        scrolled = QtWidgets.QScrollArea()
        scrolled.setWidget(beside)
        scrolled.setWidgetResizable(True)
        scrolled.setFrameShape(QtWidgets.QFrame.NoFrame)
        scrolled.setMinimumWidth(BESIDE)
        both.addWidget(scrolled)
        line = QtWidgets.QHBoxLayout()
        for button in self._buttons.values():
            line.addWidget(button)
        column = QtWidgets.QVBoxLayout(self)
        column.addLayout(both, 1)
        column.addWidget(self._notes)
        column.addLayout(line)
        self.resize(880, 720)

    def _add(self, entry: Entry, pick: bool = False) -> None:
        item = QtWidgets.QListWidgetItem(entry.icon(SMALL), entry.cell.name, self._list)
        item.setData(_ENTRY, entry)
        if pick:
            self._list.setCurrentItem(item)

    def _pick_that_of(self, infill: Any) -> None:
        """Pick the cell that an infill has; one from a file is added."""
        if infill is not None:
            self._does.begin_with(infill)
        name = "CVC" if infill is None else infill.CellType
        if name == CUSTOM_CELL and infill.CellFile:
            self.load(infill.CellFile)
            return
        for item in self._list.findItems(name, QtCore.Qt.MatchExactly):
            self._list.setCurrentItem(item)
            self._list.scrollToItem(item)

    def _entry(self) -> Entry:
        entry: Entry = self._list.currentItem().data(_ENTRY)
        return entry

    def _show(self) -> None:
        entry = self._entry()
        cell = entry.cell
        self._picture.setPixmap(entry.icon(LARGE).pixmap(LARGE, LARGE))
        lines = "".join(
            "<tr><td>{}&nbsp;&nbsp;</td><td>{}</td></tr>".format(
                name, html.escape(str(value)).replace("\n", "<br>")
            )
            for name, value in entry.rows()
        )
        self._figures.setText(f"<b>{html.escape(cell.name)}</b><table>{lines}</table>")
        self._does.show_cell(cell)
        self._note.say("\n".join(entry.notes))
        self._enable()

    def _enable(self) -> None:
        self._enable_apply(self._buttons["Apply"])
        self._buttons["From Selection"].setEnabled(bool(selected_with_edges()))
        self._buttons["Save As..."].setEnabled(self._entry().has_file)

    def _free_name(self, objects: list[Any]) -> str:
        taken = {self._list.item(row).text() for row in range(self._list.count())}
        name, number = objects[0].Label, 2
        while name in taken:
            name, number = f"{objects[0].Label} {number}", number + 1
        return str(name)

    def _ask_and_load(self) -> None:
        path, _ = QtWidgets.QFileDialog.getOpenFileName(
            self,
            translate(_CONTEXT, "Load Cell"),
            str(Path.home()),
            cell_files(),
        )
        if path:
            self.load(path)

    def _ask_and_save(self) -> bool:
        proposed = Path.home() / f"{file_name(self._entry().cell.name)}.json"
        path, _ = QtWidgets.QFileDialog.getSaveFileName(
            self, translate(_CONTEXT, "Save Cell"), str(proposed), cell_files()
        )
        if not path:
            return False
        return self.save(path if Path(path).suffix else f"{path}.json")


def cell_files() -> str:
    """The kinds of files that hold a cell, as Qt's file dialog takes them."""
    return str(translate(_CONTEXT, FILTER))


def show_cell_library() -> CellLibrary:
    """Open the window, or bring the one that is open to the front."""
    window: CellLibrary = show_one("VolfrepCellLibrary", CellLibrary)
    return window

# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the lattice consists of, chosen by its picture: unit cells, TPMS or networks."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import FreeCAD as App

from freecad_volfrep.gui.cells.cell_entry import icon_of
from freecad_volfrep.gui.cells.cell_picture import cell_icon, graph_icon
from freecad_volfrep.gui.qt import QtCore, QtWidgets
from freecad_volfrep.translation import QT_TRANSLATE_NOOP, translate
from volfrep.design.cells import load_cell, measure_of
from volfrep.design.parameters.table import CUSTOM_CELL
from volfrep.util.errors import VolfrepError

#: Size of a picture, px.
PICTURE = 48
TABS = (
    QT_TRANSLATE_NOOP("VolfrepTaskPanel", "Unit cells"),
    QT_TRANSLATE_NOOP("VolfrepTaskPanel", "TPMS"),
    QT_TRANSLATE_NOOP("VolfrepTaskPanel", "Networks"),
)
#: The tab of a cell, by the parameter that says how thick a lattice of it is.
TAB_OF = {"strut_radius": 0, "wall_thickness": 1}
#: Values of the property `Network`: no network, the others by what they are called here, and
#: those that cells are laid into.
CELLS = "Cells"
NETWORKS = {
    "Voronoi": "Voronoi",
    "Delaunay": "Delaunay",
    "File": QT_TRANSLATE_NOOP("VolfrepTaskPanel", "Graph file"),
    "Faces": QT_TRANSLATE_NOOP("VolfrepTaskPanel", "Along faces"),
}
TAKE_CELLS = ("File", "Faces")
#: What a network begins with where the cell has no struts.
FIRST_CELL = "CVC"


class LatticePicker(QtWidgets.QWidget):
    """Three tabs of pictures that set `CellType` and `Network`; to turn to a tab sets nothing.

    Args:
        obj: the infill.
        set_value: sets a property to what the user has chosen, and tells of it.
    """

    def __init__(self, obj: App.DocumentObject, set_value: Callable[[str, Any], None]) -> None:
        super().__init__()
        self._obj, self._set_value = obj, set_value
        self.tabs = QtWidgets.QTabBar()
        self.tabs.setObjectName("LatticeTabs")
        self.tabs.setAccessibleName(translate("VolfrepTaskPanel", "Kind of lattice"))
        self.tabs.setExpanding(True)
        self.tabs.setUsesScrollButtons(False)
        for text in TABS:
            self.tabs.addTab(translate("VolfrepTaskPanel", text))
        self.list = QtWidgets.QListWidget()
        self.list.setObjectName("CellType")
        self.list.setAccessibleName(translate("VolfrepTaskPanel", "Kind of lattice"))
        self.list.setViewMode(QtWidgets.QListView.IconMode)
        self.list.setIconSize(QtCore.QSize(PICTURE, PICTURE))
        self.list.setMovement(QtWidgets.QListView.Static)
        self.list.setResizeMode(QtWidgets.QListView.Adjust)
        self.list.setMinimumWidth(4 * PICTURE)
        self.cell = QtWidgets.QComboBox()
        self.cell.setObjectName("CellOfNetwork")
        self.cell.setAccessibleName(translate("VolfrepTaskPanel", "Cell that is laid in"))
        self.cell.setToolTip(self.cell.accessibleName())
        for name in self._names(0):
            self.cell.addItem(name)
        column = QtWidgets.QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        for widget in (self.tabs, self.list, self.cell):
            column.addWidget(widget)
        # Of one height in every tab, so that nothing below moves.
        self.setFixedHeight(2 * PICTURE + 60 + self.tabs.sizeHint().height())
        self.tabs.setCurrentIndex(self._tab())
        self._fill()
        self.tabs.currentChanged.connect(lambda _: self._fill())
        self.list.currentItemChanged.connect(lambda item, _: self._choose(item))
        self.cell.currentTextChanged.connect(lambda text: self._set_value("CellType", text))

    def show_present(self) -> None:
        """Turn to what the properties are, which were set elsewhere."""
        self.tabs.setCurrentIndex(self._tab())
        self._fill()

    def draw_own_cell(self) -> None:
        """Show the cell of the object's file, or an empty cube; the figures say what is wrong."""
        for item in self.list.findItems(CUSTOM_CELL, QtCore.Qt.MatchExactly):
            item.setIcon(self._icon(CUSTOM_CELL))

    def _tab(self) -> int:
        """The tab of the present values."""
        if self._obj.Network != CELLS:
            return 2
        return TAB_OF[measure_of(self._obj.CellType)]

    def _names(self, tab: int) -> list[str]:
        """What is chosen from in a tab: values of `CellType`, or of `Network`."""
        if tab == 2:
            return list(NETWORKS)
        names = self._obj.getEnumerationsOfProperty("CellType")
        return [name for name in names if TAB_OF[measure_of(name)] == tab]

    def _fill(self) -> None:
        """Show the pictures of the tab in front."""
        tab = self.tabs.currentIndex()
        is_there = tab == self._tab()
        present = self._obj.Network if tab == 2 else self._obj.CellType
        self.list.blockSignals(True)
        self.list.clear()
        for name in self._names(tab):
            text = translate("VolfrepTaskPanel", NETWORKS[name]) if tab == 2 else name
            item = QtWidgets.QListWidgetItem(text, self.list)
            item.setData(QtCore.Qt.UserRole, name)
            item.setIcon(graph_icon(name, PICTURE) if tab == 2 else self._icon(name))
            if is_there and name == present:
                self.list.setCurrentItem(item)
                self.list.scrollToItem(item)
        self.list.blockSignals(False)
        self._show_cell()

    def _show_cell(self) -> None:
        """Ask for a cell where a network takes one."""
        takes = self.tabs.currentIndex() == 2 and self._obj.Network in TAKE_CELLS
        self.cell.setVisible(takes)
        self.cell.blockSignals(True)
        self.cell.setCurrentIndex(self.cell.findText(self._obj.CellType))
        self.cell.blockSignals(False)

    def _icon(self, name: str) -> Any:
        """The picture of a cell of the library, of walls, or of the object's file."""
        if name != CUSTOM_CELL:
            return icon_of(name, PICTURE)
        try:
            cell = load_cell(self._obj.CellFile) if self._obj.CellFile else None
        except VolfrepError:
            cell = None
        return cell_icon(cell, PICTURE)

    def _choose(self, item: Any) -> None:
        """Set what a picture stands for."""
        if item is None:
            return
        name = item.data(QtCore.Qt.UserRole)
        if self.tabs.currentIndex() == 2:
            if self._obj.CellType not in self._names(0):
                self._set_value("CellType", FIRST_CELL)
            self._set_value("Network", name)
        else:
            self._set_value("Network", CELLS)
            self._set_value("CellType", name)
        self._show_cell()

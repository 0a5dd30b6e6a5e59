# SPDX-License-Identifier: LGPL-2.1-or-later
"""A choice of how struts come out of a printer: as drawn, by a published table, or by one's own."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from freecad_volfrep.gui.qt import QtWidgets
from freecad_volfrep.translation import QT_TRANSLATE_NOOP, translate

from .file_field import FileField
from .panel_manners import narrow

if TYPE_CHECKING:
    from volfrep.design.as_printed import PrintedTable

_CONTEXT = "VolfrepPrinterFile"
_TABLE_FILES = QT_TRANSLATE_NOOP("VolfrepPrinterFile", "Measured diameters (*.csv)")
#: What the choice of an own table is kept as.
_OWN = "own"


class PrintedTableFields:
    """A list of tables, and a field for a file of measurements; who asks lays them out.

    Args:
        changed: called when either was changed.
    """

    def __init__(self, changed: Callable[[], None]) -> None:
        from volfrep.design.as_printed import TABLES

        self._tables = TABLES
        self.choice, self._changed = QtWidgets.QComboBox(), changed
        narrow(self.choice)
        self.file = FileField("", translate(_CONTEXT, _TABLE_FILES), lambda _: changed())
        self.offer(None)
        self.choice.currentIndexChanged.connect(lambda _: changed())

    def offer(self, process: str | None) -> None:
        """Offer the tables of a printing process, or all; what is chosen stays where it may."""
        chosen = self.choice.currentData()
        self.choice.blockSignals(True)
        self.choice.clear()
        self.choice.addItem(translate(_CONTEXT, "As drawn"), "")
        for key, table in self._tables.items():
            if process is None or table.name.startswith(f"{process}-"):
                self.choice.addItem(f"{table.name}: {table.title}", key)
        self.choice.addItem(translate(_CONTEXT, "My own measurements"), _OWN)
        self.choice.setCurrentIndex(max(self.choice.findData(chosen), 0))
        self.choice.blockSignals(False)
        if self.choice.currentData() != chosen and chosen is not None:
            self._changed()

    def show(self, table: str) -> None:
        """Choose a table by its name, or by its file; an empty text for as drawn."""
        row = self.choice.findData(table.lower())
        if row < 0:
            row = self.choice.findData(_OWN)
            self.file.show_path(table)
        self.choice.setCurrentIndex(row)

    @property
    def wanted(self) -> str:
        """The table's name or file; empty for as drawn, and for a file that is not named yet."""
        chosen: str = self.choice.currentData()
        return self.file.path if chosen == _OWN else chosen

    @property
    def is_own(self) -> bool:
        """Whether a file is to be named."""
        return bool(self.choice.currentData() == _OWN)

    @property
    def published(self) -> PrintedTable | None:
        """The table that is chosen, unless it is the user's own."""
        return self._tables.get(self.choice.currentData())

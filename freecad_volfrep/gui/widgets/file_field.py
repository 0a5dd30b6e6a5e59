# SPDX-License-Identifier: LGPL-2.1-or-later
"""A field for the name of a file, with a button that looks for one."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from freecad_volfrep.gui.qt import QtWidgets
from freecad_volfrep.translation import translate


class FileField(QtWidgets.QWidget):
    """Tells of every file that is typed or chosen.

    Args:
        path: to begin with; empty for none.
        kinds: of files that the button offers, as Qt's file dialog takes them.
        chosen: called with the path; empty where there is to be none.
    """

    def __init__(self, path: str, kinds: str, chosen: Callable[[str], None]) -> None:
        super().__init__()
        self._kinds, self._chosen = kinds, chosen
        self._line = QtWidgets.QLineEdit(path)
        self._line.editingFinished.connect(lambda: chosen(self._line.text().strip()))
        button = QtWidgets.QToolButton()
        button.setText("...")
        button.setToolTip(translate("VolfrepTaskPanel", "Look for a file"))
        button.clicked.connect(lambda _=False: self._ask())
        row = QtWidgets.QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.addWidget(self._line, 1)
        row.addWidget(button)
        self.setFocusProxy(self._line)

    def setAccessibleName(self, name: str) -> None:  # noqa: N802
        """Tell who cannot see the field what its line is for."""
        super().setAccessibleName(name)
        self._line.setAccessibleName(name)

    @property
    def path(self) -> str:
        """What is typed."""
        text: str = self._line.text().strip()
        return text

    def show_path(self, path: str) -> None:
        """Show another file; nothing is told."""
        self._line.setText(path)

    def _ask(self) -> None:
        present = self._line.text().strip()
        begin = str(Path(present).parent) if present else str(Path.home())
        path, _ = QtWidgets.QFileDialog.getOpenFileName(
            self, translate("VolfrepTaskPanel", "Look for a file"), begin, self._kinds
        )
        if path:
            self._line.setText(path)
            self._chosen(path)

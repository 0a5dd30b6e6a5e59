# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the windows share that give a picked cell to the selected lattice infill."""

from __future__ import annotations

from typing import Any

import FreeCADGui as Gui

from freecad_volfrep.gui.qt import QtCore, QtWidgets
from freecad_volfrep.gui.selection import selected_infill
from freecad_volfrep.gui.widgets.controls import Message
from freecad_volfrep.translation import translate


class CellWindow(QtWidgets.QDialog):
    """A window that follows the selection, once it is told to.

    Args:
        name: that it is found by.
        title: of the window.
    """

    def __init__(self, name: str, title: str) -> None:
        super().__init__(Gui.getMainWindow())
        self.setObjectName(name)
        self.setWindowTitle(title)
        self.setAttribute(QtCore.Qt.WA_DeleteOnClose)
        self._note = Message("Note")

    def follow_selection(self) -> None:
        """Hear of the selection until the window closes."""
        Gui.Selection.addObserver(self)

    # FreeCAD's selection tells its observers by these names.
    def addSelection(self, *_: Any) -> None:  # noqa: N802
        """Something more is selected."""
        self._enable()

    def removeSelection(self, *_: Any) -> None:  # noqa: N802
        """Something is selected no more."""
        self._enable()

    def setSelection(self, *_: Any) -> None:  # noqa: N802
        """Something else is selected."""
        self._enable()

    def clearSelection(self, *_: Any) -> None:  # noqa: N802
        """Nothing is selected."""
        self._enable()

    def done(self, result: int) -> None:
        """Close, and hear no more of the selection."""
        Gui.Selection.removeObserver(self)
        super().done(result)

    def closeEvent(self, event: Any) -> None:  # noqa: N802
        """The window's own cross closes as the button does."""
        self.done(0)

    def _enable(self) -> None:
        """Enable what the selection allows."""
        raise NotImplementedError

    def _enable_apply(self, button: Any, is_picked: bool = True) -> None:
        """Name the infill on the button that gives it the picked cell."""
        infill = selected_infill()
        button.setEnabled(infill is not None and is_picked)
        text = translate("VolfrepCells", "Apply")
        if infill is not None:
            text = translate("VolfrepCells", "Apply to {label}").format(label=infill.Label)
        button.setText(text)


def show_one(name: str, make: Any) -> Any:
    """Open a window, or bring the one of that name that is open to the front."""
    for window in Gui.getMainWindow().findChildren(QtWidgets.QDialog, name):
        if window.isVisible():
            window.raise_()
            window.activateWindow()
            return window
    window = make()
    window.show()
    return window

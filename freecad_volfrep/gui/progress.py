# SPDX-License-Identifier: LGPL-2.1-or-later
"""A progress window with a Cancel button; the Escape key cancels too."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import FreeCADGui as Gui

from volfrep.progress import ProgressCallback

from .qt import QtCore, QtGui, QtWidgets

#: Quicker jobs show no window, in ms.
SHOW_AFTER = 700
_STEPS = 1000


class _CancelWatch(QtCore.QObject):
    """Sees Escape, and clicks on the Cancel button, before FreeCAD does.

    While a document is recomputed, FreeCAD's own filter swallows every key and click before it
    reaches a window. Of the filters of an application the one installed last is asked first.
    """

    def __init__(self, button: QtWidgets.QPushButton) -> None:
        super().__init__()
        self._button = button
        self.cancelled = False

    def eventFilter(self, target: QtCore.QObject, event: QtCore.QEvent) -> bool:  # noqa: N802
        kind = event.type()
        # A key first comes as ShortcutOverride; where a shortcut takes it, nothing follows.
        pressed = kind in (QtCore.QEvent.KeyPress, QtCore.QEvent.ShortcutOverride)
        escape = pressed and event.key() == QtCore.Qt.Key_Escape
        clicked = kind == QtCore.QEvent.MouseButtonPress and target is self._button
        if escape or clicked:
            self.cancelled = True
            return True
        return False


@contextmanager
def progress_dialog(title: str) -> Iterator[ProgressCallback]:
    """A callback for one job; returns False once the user has pressed Cancel or Escape.

    The window is modal: while events are handled nothing else in FreeCAD can be started.
    """
    dialog = QtWidgets.QProgressDialog(title, "", 0, _STEPS, Gui.getMainWindow())
    dialog.setObjectName("VolfrepProgress")
    dialog.setWindowTitle("VOLFREP")
    button = QtWidgets.QPushButton("Cancel", dialog)
    dialog.setCancelButton(button)
    dialog.setWindowModality(QtCore.Qt.ApplicationModal)
    dialog.setMinimumDuration(SHOW_AFTER)
    dialog.setMinimumWidth(360)
    dialog.setAutoClose(False)
    dialog.setAutoReset(False)
    watch = _CancelWatch(button)
    application = QtWidgets.QApplication.instance()
    application.installEventFilter(watch)
    application.setOverrideCursor(QtGui.QCursor(QtCore.Qt.WaitCursor))

    def report(fraction: float, stage: str) -> bool:
        # The window closes itself at its maximum: stay below.
        dialog.setLabelText(f"{title}: {stage}")
        dialog.setValue(min(int(fraction * _STEPS), _STEPS - 1))
        application.processEvents()
        return not (watch.cancelled or dialog.wasCanceled())

    try:
        yield report
    finally:
        application.removeEventFilter(watch)
        application.restoreOverrideCursor()
        dialog.close()
        dialog.deleteLater()

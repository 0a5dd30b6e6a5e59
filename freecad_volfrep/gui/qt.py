# SPDX-License-Identifier: LGPL-2.1-or-later
"""Qt, the way that works with PySide2 in FreeCAD 0.20 and with PySide6 in 1.1.

FreeCAD's own PySide module stands for either, and its QtGui has the widgets too; asking it for
QtWidgets fails on 0.20.
"""

from PySide import QtCore, QtGui, QtSvg

QtWidgets = QtGui

#: OK and Cancel, as a task panel names them to FreeCAD.
_BUTTON = QtWidgets.QDialogButtonBox
OK_CANCEL = (
    int(_BUTTON.Ok.value | _BUTTON.Cancel.value)
    if hasattr(_BUTTON.Ok, "value")
    else int(_BUTTON.Ok | _BUTTON.Cancel)
)

CLOSE = int(getattr(_BUTTON.Close, "value", _BUTTON.Close))

__all__ = ["CLOSE", "OK_CANCEL", "QtCore", "QtGui", "QtSvg", "QtWidgets"]

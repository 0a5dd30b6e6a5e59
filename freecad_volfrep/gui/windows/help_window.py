# SPDX-License-Identifier: LGPL-2.1-or-later
"""The project's documentation in a window of FreeCAD's."""

from __future__ import annotations

import FreeCADGui as Gui

from freecad_volfrep import DOCS
from freecad_volfrep.gui.qt import QtCore, QtWidgets
from freecad_volfrep.gui.widgets.controls import push_button
from freecad_volfrep.translation import translate

#: A page for each command, by the command's name, and one that lists them.
PAGES = DOCS / "commands"
INDEX = PAGES / "README.md"
#: Of the window, px: as wide as the pages' pictures and their margins.
SIZE = (860, 780)


def page_address(command: str) -> str:
    """Where the help page of a command is, as an address that FreeCAD's What's This opens."""
    return (PAGES / f"{command}.md").as_uri()


def show_help() -> QtWidgets.QDialog:
    """Open a window that shows the index; links lead to the others."""
    window = QtWidgets.QDialog(Gui.getMainWindow())
    window.setObjectName("VolfrepHelp")
    window.setWindowTitle(translate("VOLFREP_Help", "VOLFREP Help"))
    window.setAttribute(QtCore.Qt.WA_DeleteOnClose)
    window.resize(*SIZE)
    text = QtWidgets.QTextBrowser()
    text.setOpenExternalLinks(False)
    text.setSource(QtCore.QUrl.fromLocalFile(str(INDEX)))
    column = QtWidgets.QVBoxLayout(window)
    line = QtWidgets.QHBoxLayout()
    for name, label, act in (
        ("Back", translate("VolfrepHelp", "Back"), text.backward),
        ("Contents", translate("VolfrepHelp", "Contents"), text.home),
    ):
        line.addWidget(push_button(name, label, act))
    line.addStretch()
    column.addLayout(line)
    column.addWidget(text)
    window.show()
    return window

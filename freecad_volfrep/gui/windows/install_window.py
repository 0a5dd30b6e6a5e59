# SPDX-License-Identifier: LGPL-2.1-or-later
"""Installs the packages that are missing into FreeCAD's own folder, with what pip says shown."""

from __future__ import annotations

import FreeCADGui as Gui

from freecad_volfrep.compat import package_folder
from freecad_volfrep.deps import (
    find_installed,
    install_arguments,
    install_command,
    missing_optional,
)
from freecad_volfrep.gui.qt import QtCore, QtGui, QtWidgets
from freecad_volfrep.gui.widgets.controls import push_button
from freecad_volfrep.gui.widgets.panel_manners import fits_any_width
from freecad_volfrep.translation import translate

#: Of the window, px.
SIZE = (640, 420)


class InstallWindow(QtWidgets.QDialog):
    """Says what is missing; installs it at a click, or leaves the command on the clipboard.

    Args:
        packages: names to install by, all on FreeCAD's list of allowed packages. What is not on it
            is in the command only.
    """

    def __init__(self, packages: list[str]) -> None:
        super().__init__(Gui.getMainWindow())
        self.setObjectName("VolfrepInstall")
        self.setWindowTitle(translate("VolfrepInstall", "Packages for VOLFREP"))
        self.setAttribute(QtCore.Qt.WA_DeleteOnClose)
        self.resize(*SIZE)
        self._packages = packages
        optional = missing_optional()
        self._command = install_command([*packages, *optional])
        text = str(
            translate(
                "VolfrepInstall",
                "VOLFREP needs the Python packages {names}. Install puts them into FreeCAD's own "
                "folder {folder}, and nowhere else; it takes a connection to the internet and "
                "about a minute.",
            ).format(names=", ".join(packages), folder=package_folder())
        )
        if optional:
            text += " " + translate(
                "VolfrepInstall",
                "{names} is not on FreeCAD's list of allowed packages, so Install leaves it out; "
                "the command below has it. Some parts cannot be made without it.",
            ).format(names=", ".join(optional))
        self._say = QtWidgets.QLabel(text)
        self._say.setObjectName("Said")
        fits_any_width(self._say)
        self._output = QtWidgets.QPlainTextEdit(self._command)
        self._output.setObjectName("Output")
        self._output.setReadOnly(True)
        self._output.setAccessibleName(translate("VolfrepInstall", "What the installation says"))
        self._output.setFont(QtGui.QFontDatabase.systemFont(QtGui.QFontDatabase.FixedFont))
        column = QtWidgets.QVBoxLayout(self)
        column.addWidget(self._say)
        column.addWidget(self._output)
        line = QtWidgets.QHBoxLayout()
        line.addStretch()
        text = translate("VolfrepInstall", "&Install")
        self._install = push_button("Install", text, self.install)
        self._install.setDefault(True)
        copy = push_button("Copy", translate("VolfrepInstall", "&Copy Command"), self.copy)
        close = push_button("Close", translate("VolfrepInstall", "C&lose"), self.close)
        for button in (self._install, copy, close):
            line.addWidget(button)
        column.addLayout(line)
        self._process = QtCore.QProcess(self)
        self._process.setProcessChannelMode(QtCore.QProcess.MergedChannels)
        self._process.readyRead.connect(self._show_output)
        self._process.finished.connect(lambda *_: self._end())
        self._process.errorOccurred.connect(self._fail)

    def install(self) -> None:
        """Run pip; the window lives meanwhile."""
        program, *arguments = install_arguments(self._packages)
        self._install.setEnabled(False)
        self._say.setText(translate("VolfrepInstall", "Installing..."))
        self._process.start(program, arguments)

    def copy(self) -> None:
        """Put the command on the clipboard."""
        QtWidgets.QApplication.clipboard().setText(self._command)
        self._say.setText(
            translate(
                "VolfrepInstall", "The command is on the clipboard: run it, then restart FreeCAD."
            )
        )

    def closeEvent(self, event: QtGui.QCloseEvent) -> None:  # noqa: N802
        """An installation that runs is ended: pip moves the packages to their folder at its end."""
        self._process.finished.disconnect()
        self._process.kill()
        self._process.waitForFinished()
        super().closeEvent(event)

    def _show_output(self) -> None:
        text = bytes(self._process.readAll().data()).decode("utf-8", "replace")
        self._output.appendPlainText(text.rstrip())

    def _fail(self, error: QtCore.QProcess.ProcessError) -> None:
        """Where the program could not even be started, `finish` never comes."""
        if error == QtCore.QProcess.FailedToStart:
            self._output.appendPlainText(self._process.errorString())
            self._end()

    def _end(self) -> None:
        self._show_output()
        missing, restart = find_installed(self._packages)
        if missing:
            self._say.setText(
                translate(
                    "VolfrepInstall",
                    "{names} could not be installed: read below why. The command can be copied "
                    "and run elsewhere.",
                ).format(names=", ".join(missing))
            )
            self._install.setEnabled(True)
        elif restart:
            self._say.setText(
                translate("VolfrepInstall", "All packages are there: restart FreeCAD.")
            )
        else:
            self._say.setText(translate("VolfrepInstall", "All packages are there: go on."))


def offer_packages(packages: list[str]) -> InstallWindow:
    """Open a window that installs what is missing."""
    window = InstallWindow(packages)
    window.show()
    return window

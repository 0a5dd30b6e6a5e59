# SPDX-License-Identifier: LGPL-2.1-or-later
"""A window with a plot, which can be saved."""

from __future__ import annotations

from pathlib import Path

import FreeCADGui as Gui

from freecad_volfrep.gui.messages import show_error
from freecad_volfrep.gui.qt import QtCore, QtGui, QtSvg, QtWidgets
from freecad_volfrep.gui.widgets.controls import push_button
from freecad_volfrep.gui.widgets.plot_colours import in_theme, plot_colours
from freecad_volfrep.translation import translate
from volfrep.util.errors import VolfrepError
from volfrep.util.files import replacing

_SVG = "SVG (*.svg)"


class PlotWindow(QtWidgets.QDialog):
    """An SVG picture in the window's colours, and a button that saves it on white.

    Args:
        title: of the window.
        svg: the picture.
    """

    def __init__(self, title: str, svg: str) -> None:
        super().__init__(Gui.getMainWindow())
        self.setObjectName("VolfrepPlot")
        self.setAttribute(QtCore.Qt.WA_DeleteOnClose)
        self.setWindowTitle(title)
        self._svg = svg
        # By Qt's own renderer: its images' plugin for SVG is not there in every distribution.
        self.ensurePolished()
        drawn = QtSvg.QSvgRenderer(QtCore.QByteArray(in_theme(svg, self).encode()))
        picture = QtGui.QPixmap(drawn.defaultSize())
        picture.fill(plot_colours(self).paper)
        painter = QtGui.QPainter(picture)
        drawn.render(painter)
        painter.end()
        shown = QtWidgets.QLabel()
        shown.setObjectName("Plot")
        shown.setPixmap(picture)
        save = push_button("Save", translate("VolfrepReport", "Save..."), self._save)
        column = QtWidgets.QVBoxLayout(self)
        column.addWidget(shown)
        column.addWidget(save, 0, QtCore.Qt.AlignRight)

    def _save(self) -> None:
        path = QtWidgets.QFileDialog.getSaveFileName(self, self.windowTitle(), "convergence", _SVG)[
            0
        ]
        if not path:
            return
        try:
            with replacing(Path(path).with_suffix(".svg")) as file:
                file.write(self._svg.encode())
        except VolfrepError as error:
            show_error(str(error))


def show_plot(title: str, svg: str) -> PlotWindow:
    """Show a plot in a window of its own."""
    window = PlotWindow(title, svg)
    window.show()
    return window

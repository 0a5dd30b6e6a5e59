# SPDX-License-Identifier: LGPL-2.1-or-later
"""A window of tables that stays open beside the work: to read, copy and save."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import FreeCADGui as Gui

from freecad_volfrep.features.export.input_files import refuse_inputs_of_all
from freecad_volfrep.gui.messages import errors_shown, file_name, tell, tell_written
from freecad_volfrep.gui.qt import QtCore, QtWidgets
from freecad_volfrep.gui.widgets.controls import push_button
from freecad_volfrep.sentences import localise_cell
from freecad_volfrep.translation import QT_TRANSLATE_NOOP, marked, translate
from volfrep.reports.sizing_page import is_page
from volfrep.reports.tables import Table, as_csv, as_html
from volfrep.util.files import replacing

#: Of the window, px.
SIZE = (560, 620)
CSV, HTML = "CSV (*.csv)", "HTML (*.html)"
#: The buttons, in their order.
COPY, SAVE, CLOSE = (
    QT_TRANSLATE_NOOP("VolfrepReport", "Copy"),
    QT_TRANSLATE_NOOP("VolfrepReport", "Save..."),
    QT_TRANSLATE_NOOP("VolfrepReport", "Close"),
)
#: What stands in tables, marked for translation; saved tables stay English.
WORDS = marked(
    "VolfrepReport",
    "Inputs", "Result of the last update", "Seconds by stage",
    "Peak memory at the end of each stage, MB",
    "Triangles and the file's single precision", "Surfaces that run through each other",
    "FreeCAD's own checks",
    "cell", "cell size, mm", "strut radius, mm", "skin, mm", "density, g/cm3", "output", "status",
    "active cells", "cells of the grid", "struts", "joints", "shortest and longest strut, mm",
    "smallest and largest radius, mm", "relative density, %", "volume, mm3", "area, mm2",
    "mass, g", "triangles", "vertices", "bodies", "closed voids", "through-holes", "watertight",
    "struts removed, free end", "short stubs removed", "thin struts removed",
    "loose pieces removed", "all", "most",
    "Part", "Lattice", "Domain",
    "shell", "voxels", "tile", "lattice", "trim", "check", "yes", "no", "none", "found",
    "closed", "manifold", "voids", "genus", "volume", "area", "box", "from", "smallest angle",
    "as a file holds it", "step of its numbers", "shortest edge", "mean radius ratio",
    "smallest radius ratio", "along lines through it", "every place inside is enclosed once",
    "every triangle keeps its corners", "non-manifold edges or points",
    "wrongly oriented triangles", "corrupted triangles", "invalid points", "wrong neighbours",
    "a solid", "triangles that cross",
    "Struts", "sized", "one radius, same mass", "one radius, same limits",
    "one radius, as near as it gets", "mass of the struts, g", "smallest radius, mm",
    "largest radius, mm", "stress, % of its limit", "displacement, % of its limit",
    "buckling, % of its limit", "frequency, % of its limit", "work of the loads, N mm",
    "largest displacement, mm", "largest stress, MPa", "buckling safety",
    "frame buckling, % of its limit", "load before struts buckle together, times",
    "most stressed strut, at x, y, z", "The same beams in CalculiX", "confirmed",
    "displacements differ by, %",
    "largest stress, CalculiX / VOLFREP", "lowest frequency, CalculiX / VOLFREP",
    "Limits", "limit", "governed by", "radius list", "radius, mm", "one radius, one skin",
    "with the struts removed", "same mass, times as stiff as one radius",
    "beams say the most, solids may say the least", "largest stress of the skin, MPa",
    "on all but 0.1% of its area", "on 90% of its area", "not compared in CalculiX",
    "with the skin", "it has not solved this design", "does not hold the limits",
    "For printing", "build direction", "builds without support from, degrees",
    "flatter struts removed", "flatter parts of the outside, mm2",
    "flatter ceilings within the skin, mm2",
    "Notes", "Steps", "step", "Mass", "Skin", "mass of the skin, g", "of that solid, g",
    "smallest thickness, mm", "mean thickness, mm", "largest thickness, mm",
    "skin stress, % of its limit", "thickness there, % of what was asked",
    "mass, g", "most used limit",
    "What the lattice does", "relative density", "density", "E along [100]",
    "E along [110]", "E along [111]", "shear modulus", "bulk modulus", "Poisson's ratio",
    "Zener anisotropy", "strength", "shear strength", "conductivity", "E along x", "E along y",
    "E along z", "strength along x", "strength along y", "strength along z",
    "least strength along x, y, z",
)  # fmt: skip


def _said(text: str) -> str:
    """A word, a figure or a sentence of a table in the user's language."""
    return localise_cell(str(translate("VolfrepReport", text)))


class ReportWindow(QtWidgets.QDialog):
    """Shows tables without keeping FreeCAD waiting.

    Args:
        title: of the window.
        name: proposed for the file, without a suffix.
        tables: what it shows.
        page: what is saved as HTML; None for the tables.
    """

    def __init__(
        self, title: str, name: str, tables: list[Table], page: Callable[[], str] | None = None
    ) -> None:
        super().__init__(Gui.getMainWindow())
        self.setObjectName("VolfrepReport")
        self.setWindowTitle(title)
        self.resize(*SIZE)
        self._name, self._tables = name, tables
        self._page = page or (lambda: as_html(tables))
        self.text = QtWidgets.QTextBrowser()
        self.text.setHtml(as_html(tables, _said))
        column = QtWidgets.QVBoxLayout(self)
        column.addWidget(self.text)
        line = QtWidgets.QHBoxLayout()
        line.addStretch()
        for label, act in ((COPY, self.copy), (SAVE, self.ask_and_save), (CLOSE, self.close)):
            line.addWidget(push_button(label, translate("VolfrepReport", label), act))
        column.addLayout(line)

    def copy(self) -> None:
        """Put the tables on the clipboard, for a text editor and for a spreadsheet."""
        cursor = self.text.textCursor()
        self.text.selectAll()
        self.text.copy()
        self.text.setTextCursor(cursor)
        tell(translate("VolfrepReport", "The tables are on the clipboard."))

    def ask_and_save(self) -> None:
        """Ask for the file's name and write it."""
        path, chosen = QtWidgets.QFileDialog.getSaveFileName(
            self,
            translate("VolfrepReport", "Save Report"),
            str(Path.home() / f"{file_name(self._name)}.csv"),
            f"{CSV};;{HTML}",
        )
        if not path:
            return
        if not Path(path).suffix:
            path += ".html" if chosen == HTML else ".csv"
        with errors_shown(box=True):
            self.save(path)

    def save(self, path: str) -> None:
        """Write the page where the name ends in .html, else the tables as CSV.

        Raises:
            VolfrepError: the file cannot be written, or an open document reads it; it stays.
        """
        refuse_inputs_of_all(path)
        text = self._page() if is_page(path) else as_csv(self._tables)
        with replacing(path) as file:
            file.write(text.encode())
        tell_written(path)


def show_report(
    title: str, name: str, tables: list[Table], page: Callable[[], str] | None = None
) -> ReportWindow:
    """Open a window of tables (see `ReportWindow`); it goes when it is closed."""
    window = ReportWindow(title, name, tables, page)
    window.setAttribute(QtCore.Qt.WA_DeleteOnClose)
    window.show()
    return window

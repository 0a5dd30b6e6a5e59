# SPDX-License-Identifier: LGPL-2.1-or-later
"""Drives what is there for those who print, with real clicks and keys; see tools/run_gui.sh.

Writes pictures and ``print.json`` to GUI_OUT and leaves with 0 when every check held.
"""

import sys
import tempfile
import zipfile
from pathlib import Path

import FreeCADGui as Gui
from PySide import QtGui

sys.path.insert(0, str(Path(__file__).resolve().parent))
import new_infill
from driving import (
    answer_file_dialog,
    answer_panel,
    check,
    click,
    click_in_tree,
    picture,
    run_checks,
    select,
    settle,
    slow,
    toolbar_button,
    wait_until,
    when_dialog,
    xdotool,
)


def boxed():
    """A document with a box."""
    return new_infill.boxed("Print")


def form(name):
    """An open panel or window of that name, or None."""
    found = Gui.getMainWindow().findChildren(QtGui.QWidget, name)
    return next((widget for widget in found if widget.isVisible()), None)


def part(name, of="VolfrepSlicerPanel"):
    """A widget of a panel."""
    return form(of).findChild(QtGui.QWidget, name)


def type_into(widget, text):
    """Really type over what is in a field."""
    click(widget)
    xdotool("key", "ctrl+a")
    xdotool("type", text)
    xdotool("key", "Tab")
    settle()


def choose_word(box, text):
    """Pick an entry of a list by the keyboard, as who tabs through a panel does."""
    click(box)
    row = box.findText(text)
    check(f"there is {text}", row >= 0)
    xdotool("key", "Home")
    for _ in range(row):
        xdotool("key", "Down")
    xdotool("key", "Return")
    wait_until(lambda: box.currentText() == text)
    settle()


def bands_that_follow(doc, box):
    """Make bands of a solid in the panel, change the solid, save, undo; write a project."""
    select(box)
    click(toolbar_button("Slicer Infill"))
    check("the panel opens", wait_until(lambda: form("VolfrepSlicerPanel") is not None, 10))
    click(part("ShowBands"))
    made = doc.getObject("SlicerInfill")
    check("bands are cut", wait_until(lambda: len(made.BandDensities) >= 3, 60), made.Status)
    check("what they take is told", "Filament" in part("BandTable").text())
    picture("slicer_infill_panel")
    type_into(part("Bands"), "3")
    answer_panel("OK")
    check("the panel closes", wait_until(lambda: form("VolfrepSlicerPanel") is None, 60))
    check("there are three bands", len(made.BandDensities) == 3, made.BandDensities)
    check("in place of the solid", made.Visibility and not box.Visibility)
    check("all that is one undo step", doc.UndoCount == 1, doc.UndoNames)
    before = made.FilamentVolume.Value
    box.Length = 60
    doc.recompute()
    settle()
    check("bands follow the solid", made.FilamentVolume.Value > 1.2 * before)
    Gui.SendMsgToActiveView("ViewFit")
    picture("slicer_infill")
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "block.3mf"
        select(made)
        answer_file_dialog(path, "slicer_infill_export")
        click(toolbar_button("Export Lattice"))
        check("a project is written", wait_until(path.exists, 20))
        with zipfile.ZipFile(path) as package:
            check("for PrusaSlicer", "Metadata/Slic3r_PE_model.config" in package.namelist())


@slow
def change_bands(doc, box):
    """A double click opens the panel; a formula, a refusal, Cancel, undo and redo."""
    from freecad_volfrep import make_slicer_infill

    doc.openTransaction("Slicer Infill")
    made = make_slicer_infill(doc, box, Bands=3)
    doc.recompute()
    doc.commitTransaction()
    settle()
    click_in_tree(made.Label)
    xdotool("click", "--repeat", 2, "--delay", 60, 1)
    check("a double click opens it", wait_until(lambda: form("VolfrepSlicerPanel") is not None))
    choose_word(part("Follows"), "Formula")
    check("depth is not asked for", not part("Reach").isVisible())
    click(part("ShowBands"))
    check("a formula is missed", "formula" in part("Said").text(), part("Said").text())
    type_into(part("Formula"), "10 + x")
    click(part("ShowBands"))
    wait_until(lambda: made.Status == "Up to date", 60)
    picture("slicer_infill_formula")
    answer_panel("Cancel")
    wait_until(lambda: form("VolfrepSlicerPanel") is None)
    settle()
    check("Cancel leaves it as it was", made.Follows == "Depth, dense skin", made.Follows)
    check("with its bands", len(made.BandDensities) == 3 and made.isValid(), made.Status)
    densities = list(made.BandDensities)
    doc.openTransaction("Denser")
    made.DensityEnd = 80
    doc.recompute()
    doc.commitTransaction()
    doc.undo()
    settle()
    check("undo brings the bands back", list(made.BandDensities) == densities)
    doc.redo()
    settle()
    check("redo too", max(made.BandDensities) > max(densities))


@slow
def within_limits(doc, box):
    """A file within limits, drawn for a printer, by the kind of file in Export Lattice."""
    from freecad_volfrep import make_lattice_infill

    obj = make_lattice_infill(doc, box, CellSize=10, StrutRadius=1, ShellThickness=1, Resolution=20)
    doc.recompute()
    box.Visibility = False
    settle()
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "small.stl"

        def choose_kind(dialog):
            kinds = dialog.findChild(QtGui.QComboBox, "fileTypeCombo")
            row = next(k for k in range(kinds.count()) if "STL, within" in kinds.itemText(k))
            kinds.setFocus()
            kinds.setCurrentIndex(row)
            dialog.filterSelected.emit(kinds.itemText(row))
            edit = dialog.findChild(QtGui.QLineEdit, "fileNameEdit")
            edit.setFocus()
            xdotool("windowfocus", int(dialog.winId()))
            wait_until(edit.hasFocus)
            xdotool("key", "ctrl+a")
            xdotool("type", str(path))
            wait_until(lambda: edit.text() == str(path))
            when_dialog(QtGui.QDialog, fill_in)
            picture("printer_file_kind")
            xdotool("key", "Return")

        def fill_in(dialog):
            if dialog.objectName() != "VolfrepPrinterBox":
                when_dialog(QtGui.QDialog, fill_in)
                return
            ok = dialog.findChild(QtGui.QDialogButtonBox).button(QtGui.QDialogButtonBox.Ok)
            check("nothing is asked for yet", not ok.isEnabled())
            limit = obj.Mesh.CountFacets // 2
            spin = dialog.findChild(QtGui.QSpinBox, "Triangles")
            spin.setFocus()
            xdotool("windowfocus", int(dialog.winId()))
            wait_until(spin.hasFocus)
            xdotool("key", "ctrl+a")
            xdotool("type", str(limit))
            wait_until(lambda: spin.value() == limit)
            printer = dialog.findChild(QtGui.QComboBox, "Printer")
            printer.setFocus()
            xdotool("key", "Down")
            wait_until(lambda: printer.currentIndex() == 1)
            wait_until(ok.isEnabled)
            picture("printer_file")
            ok.setFocus()
            xdotool("key", "Return")

        select(obj)
        when_dialog(QtGui.QFileDialog, choose_kind)
        click(toolbar_button("Export Lattice"))
        check("a file is written", wait_until(path.exists, 120))
        settle()
        import Mesh

        written = Mesh.Mesh(str(path))
        check("within its limit", 0 < written.CountFacets <= obj.Mesh.CountFacets // 2)
        check("with thinner struts", written.Volume < 0.995 * obj.Mesh.Volume, written.Volume)


run_checks(
    "print",
    {
        bands_that_follow: boxed,
        change_bands: boxed,
        within_limits: boxed,
    },
)

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Drives what is there for those who print, with real clicks and keys; see tools/run_gui.sh.

Writes pictures and ``print.json`` to GUI_OUT and leaves with 0 when every check held.
"""

import sys
import tempfile
import zipfile
from pathlib import Path

import FreeCAD as App
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
    costly,
    move_mouse,
    picture,
    press_button,
    red_share,
    run_checks,
    select,
    settle,
    show_tasks,
    slow,
    toolbar_button,
    wait_until,
    when_dialog,
    xdotool,
)


def boxed():
    """A document with a box."""
    return new_infill.boxed("Print")


def a_lattice(doc, box):
    """A lattice in the box."""
    from freecad_volfrep import make_lattice_infill

    doc.openTransaction("Fill")
    obj = make_lattice_infill(doc, box, CellSize=10, StrutRadius=1, ShellThickness=1, Resolution=10)
    doc.recompute()
    doc.commitTransaction()
    box.Visibility = False
    settle()
    return obj


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


@costly
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


def bent(doc):
    """The stress that a solver would leave of a beam along x that is held at x = 0."""
    import Fem
    import ObjectsFem

    places = [(x, y, z) for x in range(0, 41, 5) for y in (0, 30) for z in (0, 10, 20)]
    mesh = Fem.FemMesh()
    for number, place in enumerate(places, 1):
        mesh.addNode(*place, number)
    holder = doc.addObject("Fem::FemMeshObject", "ResultMesh")
    holder.FemMesh = mesh
    holder.Visibility = False
    result = ObjectsFem.makeResultMechanical(doc, "CCX_Results")
    result.Mesh, result.NodeNumbers = holder, list(range(1, len(places) + 1))
    result.vonMises = [(40.0 - x) * abs(z - 10) / 4.0 for x, _, z in places]
    doc.recompute()
    return result


@slow
def follow_a_result(doc, box):
    """Bands of a FEM result: clicked in the tree with the solid, alone, and from the open panel."""
    result = bent(doc)
    click_in_tree(box.Label)
    xdotool("keydown", "ctrl")
    try:
        click_in_tree(result.Label)
    finally:
        xdotool("keyup", "ctrl")
    check("both are selected", len(Gui.Selection.getSelection()) == 2)
    click(toolbar_button("Slicer Infill"))
    check("the panel opens", wait_until(lambda: form("VolfrepSlicerPanel") is not None, 10))
    made = doc.getObject("SlicerInfill")
    check("of the solid", made.Base == box, made.Base.Label)
    check("it follows the result", part("Follows").currentText() == "FEM result")
    check("that was clicked", part("FieldObject").currentText() == result.Label)
    check("and offers nothing else", part("FieldObject").count() == 1)
    picture("slicer_result_panel")
    click(part("ShowBands"))
    check("bands are cut", wait_until(lambda: len(made.BandDensities) >= 3, 60), made.Status)
    picture("slicer_result_bands")
    type_into(part("FieldColumn"), "Temperature")
    click(part("ShowBands"))
    said = wait_until(lambda: "choose vonMises" in part("Said").text(), 20)
    check("another quantity is told by its field", said, part("Said").text())
    answer_panel("Cancel")
    wait_until(lambda: form("VolfrepSlicerPanel") is None)
    settle()
    check("Cancel leaves nothing", doc.getObject("SlicerInfill") is None)
    click_in_tree(result.Label)
    click(toolbar_button("Slicer Infill"))
    wait_until(lambda: form("VolfrepSlicerPanel") is not None)
    made = doc.getObject("SlicerInfill")
    check("alone it means the only solid", (made.Base, made.FieldObject) == (box, result))
    answer_panel("Cancel")
    wait_until(lambda: form("VolfrepSlicerPanel") is None)
    select(box)
    click(toolbar_button("Slicer Infill"))
    wait_until(lambda: form("VolfrepSlicerPanel") is not None)
    check("without it the depth counts", not part("FieldObject").isVisible())
    click_in_tree(result.Label)
    made = doc.getObject("SlicerInfill")
    picture("slicer_result_tree")
    show_tasks()
    check("a click in the tree chooses it", part("Follows").currentText() == "FEM result")
    answer_panel("OK")
    check("the panel closes", wait_until(lambda: form("VolfrepSlicerPanel") is None, 60))
    check("the bands follow it", made.FieldObject == result and len(made.BandDensities) >= 3)
    picture("slicer_result")


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


@slow
def find_a_cell(doc, box):
    """Ask for a density and a modulus, pick in the chart, give the cell to an infill."""
    obj = a_lattice(doc, box)
    select(obj)
    click(toolbar_button("Cell Library"))
    wait_until(lambda: form("VolfrepCellLibrary") is not None)
    click(part("Find...", "VolfrepCellLibrary"))
    check("the window opens", wait_until(lambda: form("VolfrepCellFinder") is not None))
    window = form("VolfrepCellFinder")
    table = part("Answers", "VolfrepCellFinder")
    check("cells are told at once", table.rowCount() > 15, table.rowCount())
    picture("find_cells")
    click(part("ModulusAsks", "VolfrepCellFinder"))
    click(part("DensityAsks", "VolfrepCellFinder"))
    type_into(part("Modulus", "VolfrepCellFinder"), "50")
    wait_until(lambda: table.item(0, 3).text().startswith("50"), 10)
    check("the lightest first", float(table.item(0, 2).text()) < float(table.item(5, 2).text()))
    chart = part("CellChart", "VolfrepCellFinder")
    move_mouse(chart.mapToGlobal(chart.place_of(3).toPoint()))
    press_button()
    settle()
    check("a click in the chart picks", table.currentRow() == 3, table.currentRow())
    picture("find_cells_of_a_modulus")
    name, radius = table.item(3, 0).text(), float(table.item(3, 1).text())
    undo = doc.UndoCount
    click(part("Apply", "VolfrepCellFinder"))
    settle()
    check("the infill has the cell", obj.CellType == name, obj.CellType)
    check("and its radius", abs(obj.StrutRadius.Value - radius) < 0.01, obj.StrutRadius)
    check("that is one undo step", doc.UndoCount == undo + 1)
    choose_word(part("Direction", "VolfrepCellFinder"), "111")
    click(part("ModulusSlider", "VolfrepCellFinder"))
    xdotool("key", "End")
    settle()
    wait_until(lambda: table.rowCount() == 0, 10)
    check("nothing is so stiff", "No cell" in part("Note", "VolfrepCellFinder").text())
    window.close()
    form("VolfrepCellLibrary").close()


@slow
def turn_a_part(doc, box):
    """A plate that stands on its edge is laid down: the directions, their figures, undo."""
    box.Length, box.Width, box.Height = 40, 30, 5
    box.Placement = App.Placement(App.Vector(), App.Rotation(App.Vector(1, 0.2, 0), 70))
    doc.recompute()
    Gui.SendMsgToActiveView("ViewFit")
    select(box)
    click(toolbar_button("Build Direction"))
    check("the panel opens", wait_until(lambda: form("VolfrepOrientPanel") is not None, 10))
    table = part("Directions", "VolfrepOrientPanel")
    check("directions are told", wait_until(lambda: table.rowCount() > 1, 60))
    check("the best is picked", table.currentRow() == 1, table.currentRow())
    check("a solid has no print checks", not part("Check", "VolfrepOrientPanel").isVisible())
    costs = [float(table.item(row, 0).text()) for row in range(1, table.rowCount())]
    check("in the order of the cost that is shown", costs == sorted(costs), costs)
    picture("orient")
    table.selectRow(0)
    settle()
    picture("orient_as_it_is")
    check("what hangs over is red", red_share("orient_as_it_is") > 0.004)
    table.selectRow(1)
    click(part("Turn", "VolfrepOrientPanel"))
    lies = wait_until(lambda: abs(box.Shape.BoundBox.ZLength - 5) < 1e-3, 60)
    check("the plate lies", lies, box.Shape.BoundBox)
    settle()
    picture("orient_turned")
    answer_panel("Close")
    wait_until(lambda: form("VolfrepOrientPanel") is None)
    doc.undo()
    settle()
    check("undo takes it back", box.Shape.BoundBox.ZLength > 20)


@slow
def build_direction_of_an_infill(doc, box):
    """Its print check looks along the direction that was picked."""
    obj = a_lattice(doc, box)
    select(obj)
    click(toolbar_button("Build Direction"))
    wait_until(lambda: form("VolfrepOrientPanel") is not None)
    table = part("Directions", "VolfrepOrientPanel")
    wait_until(lambda: table.rowCount() > 2, 60)
    table.selectRow(2)
    settle()
    told = part("Figures", "VolfrepOrientPanel").text()
    wanted = tuple(float(word) for word in told.splitlines()[0].removeprefix("up: ").split("; "))
    bar = table.horizontalScrollBar()
    check("no column of the table is cut off", bar.maximum() == 0, bar.maximum())
    click(part("Check", "VolfrepOrientPanel"))
    made = wait_until(lambda: doc.getObject("PrintCheck") is not None, 60)
    check("there is a print check", made)
    found = doc.getObject("PrintCheck").BuildDirection
    check("of that direction", (found - App.Vector(*wanted)).Length < 0.02, found)
    picture("orient_infill")
    answer_panel("Close")
    wait_until(lambda: form("VolfrepOrientPanel") is None)


@slow
def coupons(doc, box):
    """Coupons of an infill's lattice: two of the kinds, into the document and a folder."""
    obj = a_lattice(doc, box)
    with tempfile.TemporaryDirectory() as folder:

        def fill_in(dialog):
            for kind in ("tension", "bending"):
                dialog.findChild(QtGui.QCheckBox, kind).click()
            cells = dialog.findChild(QtGui.QSpinBox, "Cells")
            cells.setFocus()
            xdotool("windowfocus", int(dialog.winId()))
            wait_until(cells.hasFocus)
            xdotool("key", "ctrl+a")
            xdotool("type", "2")
            wait_until(lambda: cells.value() == 2)
            dialog.findChild(QtGui.QLineEdit, "Folder").setText(folder)
            picture("coupons_box")
            ok = dialog.findChild(QtGui.QDialogButtonBox).button(QtGui.QDialogButtonBox.Ok)
            ok.setFocus()
            xdotool("key", "Return")

        select(obj)
        when_dialog(QtGui.QDialog, fill_in)
        click(toolbar_button("Coupons"))
        made = wait_until(lambda: doc.getObject("Coupons") is not None, 60)
        check("coupons are there", made)
        settle()
        group = doc.getObject("Coupons").Group
        check("two of them", [one.Label for one in group] == ["1 cube", "2 ladder"])
        picture("coupons")
        written = sorted(path.name for path in Path(folder).iterdir())
        check("and files", written == ["1_cube.stl", "2_ladder.csv", "2_ladder.stl"], written)
    doc.undo()
    settle()
    check("undo takes them away", doc.getObject("Coupons") is None)


run_checks(
    "print",
    {
        turn_a_part: boxed,
        build_direction_of_an_infill: boxed,
        coupons: boxed,
        find_a_cell: boxed,
        bands_that_follow: boxed,
        change_bands: boxed,
        follow_a_result: boxed,
        within_limits: boxed,
    },
)

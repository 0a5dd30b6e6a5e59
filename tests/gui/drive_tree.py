# SPDX-License-Identifier: LGPL-2.1-or-later
"""An infill in the tree and the property editor: its solid under it, its groups, its deletion."""

import sys
from pathlib import Path

import FreeCAD as App
import FreeCADGui as Gui
from PySide import QtCore, QtGui

sys.path.insert(0, str(Path(__file__).resolve().parent))
from driving import (
    check,
    click_in_tree,
    infills,
    move_mouse,
    picture,
    press_button,
    run_checks,
    said,
    select,
    settle,
    show_model,
    slow,
    start_by_click,
    tree,
    tree_item,
    wait_until,
    when_dialog,
    xdotool,
)

#: Groups of the property editor that an infill has, in their order there: that of use.
GROUPS = ("1 Lattice", "2 Skin", "3 Grading", "4 Print", "5 Result", "6 Advanced")


def editors():
    """The property editor's views that are seen."""
    views = Gui.getMainWindow().findChildren(QtGui.QTreeView)
    names = [view.metaObject().className() for view in views]
    return [v for v, n in zip(views, names, strict=True) if v.isVisible() and "PropertyEditor" in n]


def editor_groups():
    """The titles in the property editor's Data tab, in their order there."""
    models = [view.model() for view in editors()]
    return [model.index(k, 0).data() for model in models for k in range(model.rowCount())]


def lies_under(child, parent):
    """Wait until the tree shows an object under another one."""
    return wait_until(lambda: tree_item(child).parent() is tree_item(parent))


def light():
    """A document with a box and an infill of it that has something in every group."""
    from freecad_volfrep import make_lattice_infill

    doc = App.newDocument("Tree")
    doc.UndoMode = 1
    box = doc.addObject("Part::Box", "Block")
    box.Length, box.Width, box.Height = 40, 20, 20
    infill = make_lattice_infill(
        doc, box, Label="Light", CellSize=10, Resolution=10, SizeGrading="Linear", LambdaEnd=1.2,
        Orientation=App.Placement(App.Vector(), App.Rotation(App.Vector(0, 0, 1), 30)),
    )  # fmt: skip
    doc.recompute()
    box.Visibility = False
    Gui.activeDocument().activeView().viewAxonometric()
    Gui.SendMsgToActiveView("ViewFit")
    settle()
    return doc, box, infill


def lie_in_the_tree(doc, box, infill):
    """The infill's solid lies under it, its properties are in groups by use, none is the report."""
    check("it is computed", infill.isValid(), infill.Status)
    check("it has its own view", type(infill.ViewObject.Proxy).__name__ == "LatticeInfillView")
    show_model()
    check("the solid lies under it", lies_under("Block", "Light"))
    select(infill)
    found = wait_until(lambda: [n for n in editor_groups() if n in GROUPS] == list(GROUPS))
    check("the groups are in the editor, in the order of use", found, editor_groups())
    picture("tree_1_properties")
    for view in editors():
        rows = [view.model().index(k, 0) for k in range(view.model().rowCount())]
        for row in rows:
            if row.data() == "6 Advanced":
                view.scrollTo(row, QtGui.QAbstractItemView.PositionAtTop)
    picture("tree_2_properties_below")


def be_deleted(doc, box, infill):
    """The Delete key takes it away; the last one's solid is shown again; undo brings it back."""
    other = doc.copyObject(infill, False)
    other.Label = "Second"
    doc.recompute()
    delete("Light")
    check("it is deleted", wait_until(lambda: len(doc.Objects) == 2), len(doc.Objects))
    check("another infill still stands for the solid", not box.Visibility)
    delete("Second")
    check("so is the other", wait_until(lambda: doc.Objects == [box]), len(doc.Objects))
    check("the solid is shown again", box.Visibility)
    picture("tree_3_deleted")
    xdotool("key", "ctrl+z")
    check("undo brings it back", wait_until(lambda: len(doc.Objects) == 2))
    check("with its solid under it", lies_under("Block", "Second"))
    back = doc.getObjectsByLabel("Second")[0]
    back.touch()
    doc.recompute()
    check("and alive", back.isValid(), back.getStatusString())


def lose_its_solid(doc, box, infill):
    """The Delete key takes the solid away, and the infill says so; undo mends both by itself."""

    def agree(dialog):
        start_by_click(dialog.button(QtGui.QMessageBox.Yes))

    facets = infill.Mesh.CountFacets
    when_dialog(QtGui.QMessageBox, agree)  # FreeCAD asks whether what needs it may break
    delete("Block")
    check("the solid is deleted", wait_until(lambda: doc.Objects == [infill]), len(doc.Objects))
    check("the infill says so", wait_until(lambda: not infill.isValid()), infill.Status)
    picture("tree_5_without_its_solid")
    check("and the report view", "no solid to fill: choose one as Base" in said(), said())
    Gui.getMainWindow().findChild(QtGui.QTextEdit, "Report view").clear()  # of FreeCAD's traceback
    return_focus()
    xdotool("key", "ctrl+z")
    check("undo brings it back", wait_until(lambda: len(doc.Objects) == 2))
    check("the infill is valid again", wait_until(infill.isValid), infill.State)
    check("without a refresh", wait_until(lambda: infill.Status == "Up to date"), infill.Status)
    check("with its mesh", infill.Mesh.CountFacets == facets, infill.Mesh.CountFacets)
    check("with its solid under it", lies_under("Block", "Light"))
    picture("tree_6_with_it_again")
    check("redo can follow", doc.RedoCount == 1, (doc.UndoNames, doc.RedoNames))
    doc.redo()
    check("and takes it away", wait_until(lambda: doc.Objects == [infill]))
    settle()
    doc.undo()
    check("and back", wait_until(lambda: len(doc.Objects) == 2 and infill.isValid()), infill.State)


@slow
def be_copied_and_renamed(doc, box, infill):
    """Copied with its solid and pasted it is another infill; F2 renames, and undo takes it back."""

    def take_all(dialog):
        buttons = dialog.findChildren(QtGui.QPushButton)
        start_by_click(next(b for b in buttons if b.text().replace("&", "") == "OK"))

    click_in_tree("Light")
    when_dialog(QtGui.QDialog, take_all)  # FreeCAD asks whether the solid comes along
    tree().setFocus()
    xdotool("key", "ctrl+c")
    wait_until(lambda: Gui.Command.get("Std_Paste").isActive())
    settle()
    return_focus()
    xdotool("key", "ctrl+v")
    check("there are two and their solids", wait_until(lambda: len(doc.Objects) == 4))
    copy = next(obj for obj in infills(doc) if obj is not infill and obj.Name != infill.Name)
    check("the copy has the copied solid", copy.Base.Name != box.Name, copy.Base.Name)
    check("and its mesh", copy.isValid() and copy.Status == "Up to date", copy.Status)
    copy.StrutRadius = 0.8
    doc.recompute()
    changed = wait_until(lambda: copy.Status == "Up to date" and copy.StrutRadii[1] < 0.9)
    check("it follows its own values", changed, (copy.Status, copy.StrutRadii))
    check("the first one stays", infill.StrutRadii[1] > 0.95, infill.StrutRadii)
    name = tree().visualItemRect(tree_item("Light"))
    # At the name itself: the column beside it is of notes.
    move_mouse(tree().viewport().mapToGlobal(QtCore.QPoint(name.left() + 40, name.center().y())))
    press_button()
    settle()
    xdotool("key", "F2")
    wait_until(lambda: isinstance(QtGui.QApplication.focusWidget(), QtGui.QLineEdit))
    xdotool("key", "ctrl+a")
    xdotool("type", "Heavy")
    xdotool("key", "Return")
    check("it has another name", wait_until(lambda: infill.Label == "Heavy"), infill.Label)
    picture("tree_4_copied")
    doc.undo()
    check("undo takes that back", wait_until(lambda: infill.Label == "Light"), infill.Label)


def return_focus():
    """Let FreeCAD have the keys again after a box: here is no window manager that does."""
    xdotool("windowfocus", int(Gui.getMainWindow().winId()))
    wait_until(lambda: QtGui.QApplication.activeWindow() is Gui.getMainWindow())
    tree().setFocus()


def delete(label):
    """Really click the item in the tree and press Delete."""
    Gui.Selection.clearSelection()
    click_in_tree(label)
    wait_until(lambda: [obj.Label for obj in Gui.Selection.getSelection()] == [label])
    settle()
    xdotool("key", "Delete")


run_checks(
    "tree",
    {
        lie_in_the_tree: light,
        be_deleted: light,
        lose_its_solid: light,
        be_copied_and_renamed: light,
    },
)

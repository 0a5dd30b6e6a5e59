# SPDX-License-Identifier: LGPL-2.1-or-later
"""An infill in the tree and the property editor: its solid under it, its groups, its deletion."""

import sys
from pathlib import Path

import FreeCAD as App
import FreeCADGui as Gui
from PySide import QtCore, QtGui

sys.path.insert(0, str(Path(__file__).resolve().parent))
from driving import check, click_item, picture, run, select, wait, wait_until, xdotool

#: Groups of the property editor that an infill has, in their order there.
GROUPS = (
    "Boundary", "Cell map", "Cell size", "Lattice", "Material", "Mesh", "Openings", "Orientation",
    "Result", "Solid", "Strut radius",
)  # fmt: skip


def tree():
    """The model tree."""
    return Gui.getMainWindow().findChild(QtGui.QTreeWidget)


def item(text):
    """An item of the model tree by its text."""
    return tree().findItems(text, QtCore.Qt.MatchExactly | QtCore.Qt.MatchRecursive)[0]


def editors():
    """The property editor's views that are seen."""
    views = Gui.getMainWindow().findChildren(QtGui.QTreeView)
    names = [view.metaObject().className() for view in views]
    return [v for v, n in zip(views, names, strict=True) if v.isVisible() and "PropertyEditor" in n]


def editor_groups():
    """The titles in the property editor's Data tab: they span both columns."""
    models = [view.model() for view in editors()]
    return [model.index(k, 0).data() for model in models for k in range(model.rowCount())]


def the_tree(doc, box):
    from freecad_volfrep import make_lattice_infill

    infill = make_lattice_infill(
        doc, box, Label="Light", CellSize=10, Resolution=10, SizeGrading="Linear", LambdaEnd=1.2,
        Orientation=App.Placement(App.Vector(), App.Rotation(App.Vector(0, 0, 1), 30)),
    )  # fmt: skip
    doc.recompute()
    box.Visibility = False
    check("it is computed", infill.isValid(), infill.Status)
    check("it has its own view", type(infill.ViewObject.Proxy).__name__ == "LatticeInfillView")
    wait(300)
    check("the solid lies under it", item("Block").parent() is item("Light"))
    select(infill)
    wait(500)
    shown = [name for name in editor_groups() if name in GROUPS]
    check("the groups are in the editor", set(shown) == set(GROUPS), editor_groups())
    picture("tree_1_properties")
    for view in editors():
        rows = [view.model().index(k, 0) for k in range(view.model().rowCount())]
        for row in rows:
            if row.data() == "Orientation":
                view.scrollTo(row, QtGui.QAbstractItemView.PositionAtTop)
    wait(200)
    picture("tree_2_properties_below")
    return infill


def the_deletion(doc, box, infill):
    other = doc.copyObject(infill, False)
    other.Label = "Second"
    doc.recompute()
    wait(300)
    delete("Light")
    check("it is deleted", wait_until(lambda: len(doc.Objects) == 2, 5), len(doc.Objects))
    check("another infill still stands for the solid", not box.Visibility)
    delete("Second")
    check("so is the other", wait_until(lambda: doc.Objects == [box], 5), len(doc.Objects))
    check("the solid is shown again", box.Visibility)
    picture("tree_3_deleted")
    xdotool("key", "ctrl+z")
    check("undo brings it back", wait_until(lambda: len(doc.Objects) == 2, 5))
    wait(300)
    check("with its solid under it", item("Block").parent() is item("Second"))
    back = doc.getObjectsByLabel("Second")[0]
    back.touch()
    doc.recompute()
    check("and alive", back.isValid(), back.getStatusString())


def delete(label):
    """Really click the item in the tree and press Delete."""
    Gui.Selection.clearSelection()
    click_item(tree(), item(label))
    wait(200)
    xdotool("key", "Delete")
    wait(500)


def drive():
    Gui.activateWorkbench("VolfrepWorkbench")
    doc = App.newDocument("Tree")
    doc.UndoMode = 1
    box = doc.addObject("Part::Box", "Block")
    box.Length, box.Width, box.Height = 40, 20, 20
    doc.recompute()
    Gui.activeDocument().activeView().viewAxonometric()
    Gui.SendMsgToActiveView("ViewFit")
    infill = the_tree(doc, box)
    the_deletion(doc, box, infill)


run(drive, "tree")

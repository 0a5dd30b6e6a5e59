# SPDX-License-Identifier: LGPL-2.1-or-later
"""Display modes and the section view in the real FreeCAD window; see tools/run_gui.sh."""

import sys
import time
from pathlib import Path

import FreeCAD as App
import FreeCADGui as Gui
from PySide import QtGui

sys.path.insert(0, str(Path(__file__).resolve().parent))
from driving import (
    OUT,
    check,
    click,
    figures,
    picture,
    run_checks,
    section_docks,
    seen,
    settle,
    toolbar_button,
    view_3d,
)

FIXTURE = Path(__file__).resolve().parents[1] / "freecad" / "fixtures" / "infill-0.1.0.FCStd"
OURS = "Skin and Lattice"
GROUP = "User parameter:BaseApp/Preferences/Mod/VOLFREP"


def node_of(obj, mode):
    """The scene of one of our display modes."""
    return obj.ViewObject.Proxy._modes[mode][0]


def seconds_a_frame(obj, mode):
    """How long the view takes to draw once in a mode."""
    obj.ViewObject.DisplayMode = mode
    view = Gui.activeDocument().activeView()
    settle()
    start = time.perf_counter()
    for _ in range(3):
        view.redraw()
        Gui.updateGui()
    return (time.perf_counter() - start) / 3


def primitives_drawn(obj):
    """How many triangles and lines the view draws of an infill in the mode that it is in."""
    from pivy import coin

    action = coin.SoGetPrimitiveCountAction()
    action.apply(obj.ViewObject.RootNode)
    return action.getTriangleCount() + action.getLineCount()


def made():
    """An infill of a box, shown from a corner."""
    from freecad_volfrep import make_lattice_infill

    doc = App.newDocument("Drive")
    doc.UndoMode = 1
    box = doc.addObject("Part::Box", "Block")
    box.Length, box.Width, box.Height = 40, 30, 20
    obj = make_lattice_infill(doc, box, CellSize=10, StrutRadius=1, ShellThickness=1)
    doc.recompute()
    box.Visibility = False
    Gui.activeDocument().activeView().viewIsometric()
    Gui.SendMsgToActiveView("ViewFit")
    settle()
    return (obj,)


def display_modes(obj):
    """Every mode is there; Simplified is made when it is chosen and dropped with the mesh."""
    view = obj.ViewObject
    modes = view.listDisplayModes()
    check("a new infill shows skin and lattice", view.DisplayMode == OURS, view.DisplayMode)
    for mode in (
        "Shaded", "Flat Lines", "Wireframe", "Points", OURS, "Coarse", "Simplified",
    ):  # fmt: skip
        check(f"there is the mode {mode}", mode in modes, modes)
        view.DisplayMode = mode
        check(f"{mode} can be shown", view.DisplayMode == mode)
        if mode == "Points":
            made = node_of(obj, "Simplified").getNumChildren()
            check("nothing is made before it is chosen", made == 0, made)
    check("Simplified has struts and solid", node_of(obj, "Simplified").getNumChildren() == 2)
    picture("display_1_simplified")
    shown = node_of(obj, "Simplified").getChild(0)
    obj.StrutRadius = 0.95
    obj.Document.recompute()
    again = node_of(obj, "Simplified")
    check("a new mesh has new struts", again.getNumChildren() == 2 and again.getChild(0) != shown)
    check("and stays simplified", view.DisplayMode == "Simplified")
    view.DisplayMode = "Shaded"
    obj.StrutRadius = 0.9
    obj.Document.recompute()
    check("what is not shown is dropped", node_of(obj, "Simplified").getNumChildren() == 0)


def many_struts(obj):
    """Above the preference struts are lines, and a large mesh that is simplified stays so."""
    group = App.ParamGet(GROUP)
    group.SetInt("LargestShownStruts", 10)
    group.SetInt("LargestShownTriangles", 1000)
    obj.ViewObject.DisplayMode = "Simplified"
    obj.StrutRadius = 0.95
    obj.Document.recompute()
    check("a large mesh stays simplified", obj.ViewObject.DisplayMode == "Simplified")
    check("nothing coarse is made for it", node_of(obj, "Coarse").getNumChildren() == 0)
    picture("display_2_lines")
    obj.ViewObject.DisplayMode = "Coarse"
    check("Coarse is made when it is chosen", node_of(obj, "Coarse").getNumChildren() > 0)
    group.RemInt("LargestShownStruts")
    group.RemInt("LargestShownTriangles")
    obj.ViewObject.DisplayMode = "Shaded"


def saved_modes(obj):
    """A document that was saved simplified opens so; one of 0.1.0 as it was."""
    obj.ViewObject.DisplayMode = "Simplified"
    path = OUT / "simplified.FCStd"
    doc = obj.Document
    doc.saveAs(str(path))
    App.closeDocument(doc.Name)
    again = App.openDocument(str(path))
    settle()
    found = again.getObject("LatticeInfill")
    check("opened simplified", found.ViewObject.DisplayMode == "Simplified")
    check("with its struts", node_of(found, "Simplified").getNumChildren() == 2)
    check("without computing", found.State == ["Up-to-date"], found.State)
    old = App.openDocument(str(FIXTURE))
    settle()
    before = [o for o in old.Objects if o.TypeId == "Mesh::FeaturePython"]
    check("0.1.0 opens", before and all(o.Mesh.CountFacets for o in before))
    for infill in before:
        check("shown as new ones are", infill.ViewObject.DisplayMode in (OURS, "Coarse"))
        infill.ViewObject.DisplayMode = "Simplified"
        check("and can be simplified", node_of(infill, "Simplified").getNumChildren() > 0)
    App.closeDocument(old.Name)
    App.setActiveDocument(again.Name)
    return found


def dock():
    """The section's dock, or None."""
    return next(iter(section_docks()), None)


def planes(obj):
    """How many clipping planes hang in the object's scene."""
    root = obj.ViewObject.RootNode
    names = [root.getChild(k).getName().getString() for k in range(root.getNumChildren())]
    return names.count("VolfrepSection")


def background_changes(name):
    """Whether FreeCAD's background goes from one colour to another down the left of the view."""
    border = seen(name, view_3d())[10:-10:10, 4]
    return len({tuple(colour) for colour in border}) > len(border) // 2


def section(obj):
    """The plane appears in the middle, moves, turns, and goes without a trace."""
    doc = obj.Document
    obj.ViewObject.DisplayMode = OURS
    steps, touched = doc.UndoCount, doc.isTouched()
    facets = obj.Mesh.CountFacets
    Gui.activeDocument().activeView().viewIsometric()
    Gui.SendMsgToActiveView("ViewFit")
    Gui.Selection.clearSelection()
    Gui.Selection.addSelection(obj)
    settle()
    picture("section_0_whole")
    before = background_changes("section_0_whole")  # FreeCAD 1.1 begins with a plain one
    click(toolbar_button("Section View"))
    settle()
    check("the section opens", dock() is not None)
    check("one plane is in the scene", planes(obj) == 1, planes(obj))
    axis = dock().findChild(QtGui.QComboBox, "Axis")
    offset = dock().findChild(QtGui.QDoubleSpinBox, "Offset")
    slider = dock().findChild(QtGui.QSlider, "Slider")
    Gui.Selection.clearSelection()
    axis.setCurrentText("Y")
    check("it is in the middle", abs(offset.value() - 15) < 0.01, offset.value())
    picture("section_1_middle")
    slider.setValue(800)
    check("the slider moves it", abs(offset.value() - 24) < 0.1, offset.value())
    flip = dock().findChild(QtGui.QCheckBox, "Flip")
    check("it is open to the user", flip.isChecked())
    flip.click()
    check("and can be turned", not flip.isChecked() and planes(obj) == 1)
    flip.click()
    picture("section_2_moved")
    obj.ViewObject.DisplayMode = "Shaded"
    obj.ViewObject.Transparency = 0
    picture("section_4_shaded")
    obj.ViewObject.DisplayMode = "Simplified"
    axis.setCurrentText("X")
    picture("section_3_simplified")
    for name in ("section_1_middle", "section_2_moved", "section_3_simplified", "section_4_shaded"):
        check(f"{name}: the background is whole", background_changes(name) == before)
    obj.ViewObject.DisplayMode = "Shaded"
    Gui.Selection.addSelection(obj)
    click(toolbar_button("Section View"))
    settle()
    check("a second call takes its place", planes(obj) == 1, planes(obj))
    dock().close()
    settle()
    check("closing removes it", planes(obj) == 0 and dock() is None)
    check("the document is as before", (doc.UndoCount, doc.isTouched()) == (steps, touched))
    check("and so is the mesh", obj.Mesh.CountFacets == facets)
    click(toolbar_button("Section View"))
    settle()
    doc.removeObject(obj.Name)
    settle()
    check("it closes with its object", dock() is None)


def frames():
    """What a frame of a mesh of half a million triangles costs, and of its struts."""
    from freecad_volfrep import make_lattice_infill

    doc = App.newDocument("Frames")
    box = doc.addObject("Part::Box", "Block")
    box.Length, box.Width, box.Height = 40, 30, 30
    obj = make_lattice_infill(doc, box, CellSize=5, StrutRadius=0.5, ShellThickness=1)
    doc.recompute()
    box.Visibility = False
    Gui.activeDocument().activeView().viewIsometric()
    Gui.SendMsgToActiveView("ViewFit")
    figures["triangles"], figures["struts"] = obj.Mesh.CountFacets, obj.Struts
    start = time.perf_counter()
    obj.ViewObject.DisplayMode = "Simplified"
    figures["seconds to simplify"] = round(time.perf_counter() - start, 2)
    drawn = {}
    for mode in ("Shaded", OURS, "Coarse", "Simplified"):
        figures[f"seconds a frame, {mode}"] = round(seconds_a_frame(obj, mode), 3)
        drawn[mode] = primitives_drawn(obj)
    figures["triangles and lines drawn"] = drawn
    check("the mesh is drawn as it is", drawn["Shaded"] >= obj.Mesh.CountFacets, drawn)
    check("simplified draws every strut", drawn["Simplified"] >= obj.Struts, drawn)
    check("simplified draws a quarter at most", drawn["Simplified"] < 0.25 * drawn["Shaded"], drawn)
    picture("display_3_many")
    App.closeDocument(doc.Name)


run_checks(
    "display",
    {display_modes: made, many_struts: made, saved_modes: made, section: made, frames: None},
)

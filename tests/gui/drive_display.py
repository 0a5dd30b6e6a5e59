# SPDX-License-Identifier: LGPL-2.1-or-later
"""Display modes and the section view in the real FreeCAD window; see tools/run_gui.sh."""

import sys
import time
from pathlib import Path

import FreeCAD as App
import FreeCADGui as Gui
import numpy as np
from PySide import QtCore, QtGui

sys.path.insert(0, str(Path(__file__).resolve().parent))
import new_infill
from driving import (
    OUT,
    answer_file_dialog,
    answer_panel,
    check,
    click,
    comes_true,
    costly,
    figures,
    move_mouse,
    panel,
    panel_part,
    picture,
    run_checks,
    section_docks,
    seen,
    select,
    settle,
    slow,
    toolbar_button,
    view_3d,
    wait_until,
    xdotool,
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
    _, _, obj = new_infill.filled()
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


@slow
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


@slow
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
    kept = dock().findChild(QtGui.QComboBox, "Axis").currentText()
    check("along the axis that was left", kept == "X", kept)
    dock().findChild(QtGui.QDoubleSpinBox, "Offset").setValue(12.0)
    dock().close()
    settle()
    check("closing removes it", planes(obj) == 0 and dock() is None)
    check("the document is as before", (doc.UndoCount, doc.isTouched()) == (steps, touched))
    check("and so is the mesh", obj.Mesh.CountFacets == facets)
    click(toolbar_button("Section View"))
    settle()
    kept = dock().findChild(QtGui.QDoubleSpinBox, "Offset").value()
    check("the next one begins where it was left", abs(kept - 12.0) < 1e-6, kept)
    doc.removeObject(obj.Name)
    settle()
    check("it closes with its object", dock() is None)


def solids_beside():
    """How many solids are shown beside their lattices."""
    scene = Gui.activeDocument().activeView().getSceneGraph()
    names = [scene.getChild(k).getName().getString() for k in range(scene.getNumChildren())]
    return names.count("VolfrepSolidBeside")


def beside(obj):
    """A click shows the solid beside its lattice, another takes it away; nothing else changes."""
    doc = obj.Document
    steps = doc.UndoCount
    Gui.Selection.clearSelection()
    Gui.Selection.addSelection(obj)
    settle()
    picture("beside_0")
    click(toolbar_button("Solid Beside"))
    check("the solid is shown", solids_beside() == 1)
    picture("beside_1")
    left, right = (drawn_halves("beside_1")[k] for k in (0, 1))
    check("both are in sight", min(left, right) > 0.1, (left, right))
    check("the document is as before", doc.UndoCount == steps and obj.Visibility)
    click(toolbar_button("Solid Beside"))
    check("once more takes it away", solids_beside() == 0)
    click(toolbar_button("Solid Beside"))
    obj.Base.Height = 22
    settle()
    check("a solid that changes is taken away", solids_beside() == 0)


def drawn_halves(name):
    """Shares of the view's left and right half, in a picture, that are not background."""
    image = seen(name, view_3d()).astype(int)
    drawn = np.abs(image - image[:, :1]).sum(axis=2) > 24
    middle = drawn.shape[1] // 2
    return drawn[:, :middle].mean(), drawn[:, middle:].mean()


def graded():
    """An infill whose radius grows along X, moved from where its solid was made."""
    (obj,) = made()
    obj.RadiusGrading, obj.RadiusDirection = "Direction", App.Vector(1, 0, 0)
    obj.RadiusProfile, obj.RadiusStart, obj.RadiusEnd = "Linear", 0.6, 1.4
    obj.Document.recompute()
    settle()
    return (obj,)


def colours_dock():
    """The dock of Colour By, or None."""
    found = Gui.getMainWindow().findChildren(QtGui.QDockWidget, "VolfrepColourBy")
    return next((dock for dock in found if dock.isVisible()), None)


def legends():
    """How many legends are in the 3D view."""
    scene = Gui.activeDocument().activeView().getSceneGraph()
    names = [scene.getChild(k).getName().getString() for k in range(scene.getNumChildren())]
    return names.count("VolfrepLegend")


def numbers_of(node):
    """How many numbers are beside a legend, whose title is a text, too."""
    from pivy import coin

    search = coin.SoSearchAction()
    search.setType(coin.SoText2.getClassTypeId())
    search.setInterest(coin.SoSearchAction.ALL)
    search.apply(node)
    return search.getPaths().getLength() - 1


def bar_length(image):
    """Of the scale bar in a saved picture, mm, by the view that it is of."""
    rows = range(int(0.9 * image.height()), int(0.96 * image.height()))
    black = [[image.pixelColor(x, y).lightness() < 40 for x in range(image.width() // 4)]
             for y in rows]  # fmt: skip
    view = Gui.activeDocument().activeView()
    a, b = (np.array(view.getPoint(x, 10)) for x in (0, 1000))
    return float(max(map(sum, black)) * np.linalg.norm(b - a) / 1000)


def said_length():
    """What the scale bar of the view says, mm."""
    from pivy import coin

    from freecad_volfrep.gui.draw.coloured_struts import scale_bar

    search = coin.SoSearchAction()
    search.setType(coin.SoText2.getClassTypeId())
    search.apply(scale_bar(Gui.activeDocument().activeView()))
    return float(str(search.getPath().getTail().string[0]).split()[0])


def colourful(name):
    """Share of the 3D view's middle, in a picture, that has the scale's yellow or green."""
    _, green, blue = np.moveaxis(seen(name, view_3d()).astype(int), 2, 0)
    return float(((green > 1.4 * blue) & (green > 90)).mean())


def colours_come(name, plain):
    """Whether the lattice comes to be drawn in more colours than before, in a kept picture."""

    def are_there():
        picture(name)
        return colourful(name) > plain + 0.02

    return wait_until(are_there)


@costly
def colours(obj):
    """Coloured by radius, cell size and overhang, with a legend; the mouse reads off values."""
    from freecad_volfrep.gui.draw.coloured_struts import legend, ticks

    view = obj.ViewObject
    Gui.Selection.clearSelection()
    Gui.Selection.addSelection(obj)
    settle()
    picture("colours_0_none")
    click(toolbar_button("Colour By"))
    check("the dock opens", wait_until(lambda: colours_dock() is not None))
    settle()
    Gui.Selection.clearSelection()
    dock = colours_dock()
    quantity = dock.findChild(QtGui.QComboBox, "Quantity")
    low, high = (dock.findChild(QtGui.QDoubleSpinBox, name) for name in ("From", "To"))
    begins = wait_until(lambda: view.ColourBy == "Radius")
    check("it begins with the radius", begins, view.ColourBy)
    check("there is a legend", wait_until(lambda: legends() == 1), legends())
    wait_until(low.isEnabled)
    reach = wait_until(lambda: np.allclose((low.value(), high.value()), (0.6, 1.4), atol=0.05))
    ends = low.value(), high.value()
    check("from the smallest to the largest", reach, ends)
    plain = colourful("colours_0_none")
    check("the lattice has the colours", colours_come("colours_1_radius", plain), plain)
    said = dock.findChild(QtGui.QLabel, "Said")

    def value_at(x):
        """What is told where the mouse rests on the lattice at a place along X, mm."""
        place = Gui.activeDocument().activeView().getPointOnScreen(App.Vector(x, 15, 10))
        widget = view_3d().findChild(QtGui.QGraphicsView) or view_3d()
        point = widget.mapToGlobal(widget.rect().bottomLeft())
        texts = []
        for step in range(12):
            said.setText("")
            move_mouse(QtCore.QPoint(point.x() + place[0] + 3 * step, point.y() - place[1]))
            # Beside the lattice another sentence comes first, and stays.
            comes_true(lambda: said.text() != "", 10)
            if comes_true(lambda: said.text()[:1].isdigit(), 3):
                return float(said.text().split()[0])
            texts.append(said.text())
        return texts

    values = value_at(6), value_at(34)
    figures["values under the mouse"] = values
    read = all(isinstance(value, float) for value in values)
    check("the mouse reads off radii", read, values)
    check("which grow along X", read and values[0] < values[1], values)
    click(high)
    xdotool("key", "ctrl+a")
    xdotool("type", "1")
    xdotool("key", "Tab")
    check(
        "the scale's end is set", wait_until(lambda: abs(view.ColourTo - 1.0) < 1e-9), high.text()
    )
    settle()
    picture("colours_2_range")
    click(dock.findChild(QtGui.QPushButton, "Automatic"))
    check("and given back", wait_until(lambda: view.ColourFrom == view.ColourTo == 0.0))
    quantity.setCurrentIndex(quantity.findData("Overhang"))
    check("overhangs go to 90 degrees", wait_until(lambda: high.value() == 90.0), high.value())
    picture("colours_3_overhang")
    click(high)
    view.ColourBy = "Radius"
    wait_until(lambda: abs(high.value() - ends[1]) < 1e-9)
    check("the field in use follows, too", high.hasFocus(), high.value())
    view.ColourBy = "Overhang"
    check("and back again", wait_until(lambda: high.value() == 90.0), high.value())
    saved_picture = OUT / "colours_picture.png"
    saved_picture.unlink(missing_ok=True)
    answer_file_dialog(saved_picture, "colours_3_saving")
    click(dock.findChild(QtGui.QPushButton, "Picture"))
    check("a picture is saved", wait_until(saved_picture.exists))
    image = QtGui.QImage(str(saved_picture))
    check("on white", image.pixelColor(2, 2).name() == "#ffffff", image.pixelColor(2, 2).name())
    dark = [image.pixelColor(x, y).lightness() < 60 for x in range(0, image.width() // 4, 2)
            for y in range(image.height() // 4, image.height() * 3 // 4, 2)]  # fmt: skip
    check("with letters in black", sum(dark) > 20, sum(dark))
    said, there = said_length(), bar_length(image)
    check("a scale bar is as long as it says", abs(there / said - 1.0) < 0.1, f"{said}: {there}")
    check("of a constant the legend tells one number", [numbers_of(legend("A", *ends)) for ends in
          ((0.0, 2.0), (1.0, 1.0))] == [5, 1])  # fmt: skip
    texts = [[text for _, text in ticks(*ends)] for ends in ((0.0, 150.43), (100.0, 100.4))]
    check("its numbers are round and told apart", texts == [["0", "50", "100", "150"],
          ["100", "100.1", "100.2", "100.3", "100.4"]], texts)  # fmt: skip
    dock.close()
    settle()
    check("the dock closes", wait_until(lambda: colours_dock() is None))
    check("colours stay without the dock", view.ColourBy == "Overhang" and legends() == 1)
    view.Visibility = False
    check("the legend goes with the infill", wait_until(lambda: legends() == 0), legends())
    view.Visibility = True
    settle()
    saved = OUT / "colours.FCStd"
    obj.Document.saveAs(str(saved))
    name = obj.Name
    App.closeDocument(obj.Document.Name)
    again = App.openDocument(str(saved)).getObject(name)
    settle()
    check("a file keeps them", again.ViewObject.ColourBy == "Overhang")
    check("and shows them", wait_until(lambda: legends() == 1), legends())
    Gui.activeDocument().setEdit(again.Name)
    check("the panel opens", wait_until(lambda: panel() is not None))
    settle()
    choice = panel_part("ColourBy")
    choice.setCurrentIndex(choice.findData("Radius"))
    check("the preview has the colours", colours_come("colours_4_preview", plain))
    check("and a legend", wait_until(lambda: legends() == 1), legends())
    answer_panel("Cancel")
    settle()
    again.ViewObject.ColourBy = "None"
    check("none is none", wait_until(lambda: legends() == 0), legends())


@slow
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


def two_documents():
    """A dock is seen beside its own document only, and is there again with it."""
    first, _, obj = new_infill.filled("First")
    select(obj)
    click(toolbar_button("Section View"))
    wait_until(section_docks)
    second = App.newDocument("Second")
    check("another document's view has none", wait_until(lambda: not section_docks()))
    App.setActiveDocument(first.Name)
    check("its own has it again", wait_until(lambda: len(section_docks()) == 1))
    App.setActiveDocument(second.Name)
    App.closeDocument(first.Name)
    settle()
    check("which goes with it", not section_docks())


run_checks(
    "display",
    {
        display_modes: made,
        many_struts: made,
        saved_modes: made,
        section: made,
        beside: made,
        colours: graded,
        frames: None,
        two_documents: None,
    },
)

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Drives the task panel and the object in the real FreeCAD with real clicks and keys.

See tools/run_gui.sh. Writes pictures and ``result.json`` to GUI_OUT and leaves with 0 when every
check held.
"""

import os
import sys
import time
from pathlib import Path

import FreeCAD as App
import FreeCADGui as Gui
from PySide import QtCore, QtGui

sys.path.insert(0, str(Path(__file__).resolve().parent))
import new_infill
from driving import (
    OUT,
    Watch,
    answer_panel,
    check,
    choose_lattice,
    click,
    click_in_view,
    click_item,
    click_menu,
    comes_true,
    costly,
    drawn_share,
    fail,
    figures,
    infills,
    jobs_that_never_end,
    look_at_all,
    move_mouse,
    panel,
    panel_part,
    picture,
    previews,
    progress_bar,
    red_share,
    run_checks,
    select,
    settle,
    shoot,
    slow,
    told,
    toolbar_button,
    tree_items,
    type_value,
    view_3d,
    wait_until,
    when_dialog,
    xdotool,
)


def boxed():
    """A document with a box, and the button of the command that fills it."""
    return *new_infill.boxed("Drive"), toolbar_button("Lattice Infill")


def filled():
    """A document with a box that has a lattice."""
    doc, _, obj = new_infill.filled("Drive")
    return doc, obj


def coarse():
    """The same of coarse facets."""
    doc, obj = filled()
    obj.Resolution = 5
    doc.recompute()
    return doc, obj


def find_the_workbench(doc, box, fill):
    """It has a menu, and its button can be used when it is clear which solid is meant."""
    check("workbench", Gui.activeWorkbench().name() == "VolfrepWorkbench")
    menus = [action.text() for action in Gui.getMainWindow().menuBar().actions()]
    check("menu", "&VOLFREP" in menus, menus)
    select()
    check("the only solid needs no selection", wait_until(fill.isEnabled))
    doc.addObject("Part::Box", "Other")
    doc.recompute()
    settle()
    check("of two one has to be selected", not fill.isEnabled())
    select(box)
    check("active with a solid selected", fill.isEnabled())
    check("tooltip", "lattice" in fill.toolTip().lower(), fill.toolTip())
    check("icon", not fill.icon().isNull())


def fill_the_box(doc, box, fill):
    """The panel's OK leaves a good object, which undo takes away and redo brings back."""
    select(box)
    undo_before = doc.UndoCount
    use_the_panel(doc, box, fill)
    obj = infills(doc)[0]
    check("valid", obj.isValid(), obj.getStatusString())
    check("a closed mesh", obj.Mesh.isSolid())
    check("in the tree", wait_until(lambda: obj.Label in tree_items()))
    check("the tree shows its icon", not obj.ViewObject.Icon.isNull())
    check("the solid is hidden", not box.ViewObject.isVisible())
    check("the result is selected", Gui.Selection.getSelection() == [obj])
    check("one undo step", doc.UndoCount == undo_before + 1, doc.UndoNames)
    figures["infill"] = {n: getattr(obj, n) for n in ("CellsActive", "Triangles", "Seconds")}
    picture("1_filled")

    obj.Output = "Lattice"
    doc.recompute()
    picture("2_lattice")
    obj.Output = "Part"
    doc.recompute()
    while doc.UndoCount > undo_before + 1:
        doc.undo()

    doc.undo()
    doc.recompute()
    check("undo removes it", infills(doc) == [])
    check("undo shows the solid again", box.ViewObject.isVisible())
    doc.redo()
    doc.recompute()
    check("redo brings it back", len(infills(doc)) == 1 and infills(doc)[0].isValid())
    picture("3_redone")


@slow
def show_coarsely(doc, obj):
    """A mesh above the preference is shown by fewer triangles, and stays what it is."""
    group = App.ParamGet("User parameter:BaseApp/Preferences/Mod/VOLFREP")
    facets = obj.Mesh.CountFacets
    group.SetInt("LargestShownTriangles", facets // 2)
    doc.Block.Visibility = False
    obj.StrutRadius = 0.99
    doc.recompute()
    check("a large mesh is shown coarsely", obj.ViewObject.DisplayMode == "Coarse")
    check("and is not coarse itself", obj.Mesh.CountFacets > 0.9 * facets and obj.Mesh.isSolid())
    picture("6_coarse")
    group.RemInt("LargestShownTriangles")
    obj.StrutRadius = 1
    doc.recompute()
    check("a small one as it is", obj.ViewObject.DisplayMode == "Skin and Lattice")


def open_panel(fill):
    """A real click on the command's button, until the panel is there to be typed into."""
    click(fill)
    return panel_is_there()


def open_to_edit(obj):
    """What a double click does, until the panel is there to be typed into."""
    Gui.activeDocument().setEdit(obj.Name)
    return panel_is_there()


def panel_is_there():
    """Wait for the panel."""
    there = wait_until(lambda: panel() is not None)
    settle()
    return there


def use_the_panel(doc, box, fill):
    """The command opens the panel; Cancel leaves nothing; typing moves the preview; OK computes."""
    undo_before, names = doc.UndoCount, [obj.Name for obj in doc.Objects]
    check("the panel opens", open_panel(fill))
    check("one object appears", len(infills(doc)) == 1)
    check("nothing is computed yet", infills(doc)[0].Mesh.CountFacets == 0)
    check("figures are shown", "active cells" in told())
    check("the preview is in the view", previews() == 1, previews())
    picture("panel_1_open")
    answer_panel("Cancel")
    check("the panel closes", wait_until(lambda: panel() is None))
    check("Cancel leaves nothing behind", [obj.Name for obj in doc.Objects] == names, doc.Objects)
    check("Cancel leaves no undo step", doc.UndoCount == undo_before, doc.UndoNames)
    check("Cancel shows the solid again", box.ViewObject.isVisible())
    check("and no preview", previews() == 0, previews())

    select(box)
    open_panel(fill)
    obj = infills(doc)[0]
    figures_before = told()
    type_value("CellSize", "10 mm")
    check("a typed length is set", abs(obj.CellSize.Value - 10) < 1e-9, obj.CellSize)
    type_value("StrutRadius", "1 mm")
    check("so is the next one", abs(obj.StrutRadius.Value - 1) < 1e-9, obj.StrutRadius)
    check("the figures follow", told() != figures_before)
    click(panel_part("Cells"))
    picture("panel_2_typed")
    type_value("ShellThickness", "12 mm")
    check("what does not fit is said", "inside the skin" in told(),
          told())  # fmt: skip
    picture("panel_3_refused")
    share = drawn_share("panel_3_refused")
    check("and the solid stays to be seen", share > 0.1, share)
    for name, length in (("ShellThickness", "1"), ("CellSize", "8"), ("StrutRadius", "0.8")):
        type_value(name, f"{length} mm")
    click(panel_part("Compute"))
    check("Compute makes the mesh", wait_until(lambda: obj.Mesh.CountFacets > 0))
    check("and stays in the panel", panel() is not None)
    picture("panel_4_computed")
    answer_panel("OK")
    check("OK closes the panel", wait_until(lambda: panel() is None))
    check("and leaves no preview", previews() == 0, previews())


def edit_in_the_panel(doc, obj):
    """A double click opens the panel of an infill; Cancel takes everything back."""
    radius, facets, steps = obj.StrutRadius.Value, obj.Mesh.CountFacets, doc.UndoCount
    check("editing opens the panel", open_to_edit(obj))
    type_value("StrutRadius", "0.6 mm")
    check("editing sets the value", abs(obj.StrutRadius.Value - 0.6) < 1e-9)
    answer_panel("Cancel")
    wait_until(lambda: panel() is None)
    settle()
    check("Cancel takes the value back", abs(obj.StrutRadius.Value - radius) < 1e-9)
    check("and the mesh stays", obj.Mesh.CountFacets == facets)
    check("without an undo step", doc.UndoCount == steps, doc.UndoNames)


def undo_an_edit(doc, obj):
    """A change and the mesh that comes of it are undone, and redone, by one click."""
    before, facets = obj.StrutRadius.Value, obj.Mesh.CountFacets
    steps = doc.UndoCount
    open_to_edit(obj)
    type_value("StrutRadius", "1.3 mm")
    answer_panel("OK")
    check("the mesh comes", wait_until(lambda: obj.Mesh.CountFacets not in (0, facets)))
    settle()
    after = obj.Mesh.CountFacets
    check("it is up to date", obj.Status == "Up to date", obj.Status)
    click_menu("Edit", "Undo")
    check("one click takes both back", wait_until(
        lambda: (obj.StrutRadius.Value, obj.Mesh.CountFacets) == (before, facets)),
        (obj.StrutRadius.Value, obj.Mesh.CountFacets, doc.UndoNames))  # fmt: skip
    settle()
    check("up to date again", obj.Status == "Up to date", obj.Status)
    check("and nothing else", doc.UndoCount == steps, doc.UndoNames)
    click_menu("Edit", "Redo")
    check("one click brings both again", wait_until(
        lambda: (obj.StrutRadius.Value, obj.Mesh.CountFacets) == (1.3, after)),
        (obj.StrutRadius.Value, obj.Mesh.CountFacets))  # fmt: skip
    settle()
    check("up to date once more", obj.Status == "Up to date", obj.Status)


@slow
def give_it_an_own_cell(doc, obj):
    """Custom in the panel asks for a file, of a cell whose picture and struts are then seen."""
    from volfrep.design.cells import LIBRARY
    from volfrep.design.drawn_cell import save_cell

    path = OUT / "own_cell.json"
    save_cell(LIBRARY["Octahedron"], path)
    cell, facets = obj.CellType, obj.Mesh.CountFacets
    open_to_edit(obj)
    check("no file is asked for a known cell", not panel_part("CellFile").isVisible())
    picker = panel_part("CellType")
    custom = picker.findItems("Custom", QtCore.Qt.MatchExactly)[0]
    empty = custom.icon().pixmap(48, 48).toImage()
    click_item(picker, custom)
    check("Custom is chosen", obj.CellType == "Custom", obj.CellType)
    check("it asks for a file", panel_part("CellFile").isVisible())
    check("and says so", "CellFile" in told(), told())
    type_value("CellFile", str(path))
    check("the file is set", obj.CellFile == str(path), obj.CellFile)
    check("the picture is the cell's", custom.icon().pixmap(48, 48).toImage() != empty)
    check("the figures follow", "struts" in told(),
          told())  # fmt: skip
    picture("panel_5_own_cell")
    type_value("CellFile", str(OUT / "not_there.json"))
    check("a file that is not there is said", "not_there" in told(),
          told())  # fmt: skip
    check("and its picture is empty", custom.icon().pixmap(48, 48).toImage() == empty)
    answer_panel("Cancel")
    wait_until(lambda: panel() is None)
    settle()
    check("Cancel gives the cell back", obj.CellType == cell, obj.CellType)
    check("and the mesh", obj.Mesh.CountFacets == facets)


def choose(name, text):
    """Really choose an entry of one of the panel's lists by typing it."""
    field = panel_part(name)
    click(field)
    wait_until(lambda: field.view().isVisible())
    xdotool("type", text)
    xdotool("key", "Return")
    wait_until(lambda: field.currentText().startswith(text))
    settle()


@slow
def drive_the_radius(doc, obj):
    """Density, mass and stiffness in place of the radius: the preview shows the one found."""
    from freecad_volfrep.features.properties.quantities import is_driven, number_of

    open_to_edit(obj)
    shown = panel_part("StrutRadius")
    check("no target is asked for a radius", not panel_part("TargetDensity").isVisible())
    before = obj.StrutRadius.Value
    choose("RadiusDrivenBy", "Relative")
    check("density drives", obj.RadiusDrivenBy == "Relative density", obj.RadiusDrivenBy)
    check("its field is shown", panel_part("TargetDensity").isVisible())
    found = shown.property("rawValue")
    check("it begins with what there is", abs(found / before - 1) < 0.02, (found, before))
    type_value("TargetDensity", "30")
    check("a typed density is set", abs(obj.TargetDensity - 0.3) < 1e-9, obj.TargetDensity)
    found = shown.property("rawValue")
    check("the radius found is shown", found > 1.1 * before, (found, before))
    check("and cannot be typed over", not shown.isEnabled())
    check("the property waits for the mesh", obj.StrutRadius.Value == before)
    figures = told()
    check("the figures are the target's", "relative density 30 %" in figures, figures)
    picture("panel_6_density")
    choose("RadiusDrivenBy", "Stiffness")
    check("a stiffness without a material says what to do", "choose one for the infill" in told(),
          told())  # fmt: skip
    choose("PrintMaterial", "AlSi10Mg")
    begins = panel_part("TargetStiffness").value()
    check("and begins with what there is once it has one", begins > 100, begins)
    check("at the radius that there was", abs(shown.property("rawValue") / found - 1) < 0.02,
          (shown.property("rawValue"), found))  # fmt: skip
    picture("panel_6_material")
    choose("PrintProcess", "LPBF")
    check("a material and a process", (obj.PrintMaterial, obj.PrintProcess) == ("AlSi10Mg", "LPBF"))
    choose("RadiusDrivenBy", "Mass")
    mass = panel_part("TargetMass").value()
    figures = told()
    begun = f"mass {mass:.3g}"[:8] in figures
    check("a mass begins with what there is", begun, (mass, figures))
    field, more = panel_part("TargetMass"), round(1.1 * mass, 3)
    type_value("TargetMass", f"={more}/2 + {more}/2")
    check("an expression says the mass", is_driven(obj, "TargetMass"), obj.ExpressionEngine)
    check("which the field shows", abs(field.value() / more - 1) < 1e-3, (field.value(), more))
    check("and the figures", f"mass {more:.3g}"[:8] in told(),
          told())  # fmt: skip
    type_value("TargetMass", "=2*what")
    check("what is none is said", "=" not in field.text() and "what" in
          told(), told())  # fmt: skip
    check("and changes nothing", is_driven(obj, "TargetMass"), obj.ExpressionEngine)
    type_value("TargetMass", "=")
    check("nothing ends the expression", not is_driven(obj, "TargetMass"), obj.ExpressionEngine)
    type_value("TargetMass", f"{mass:.4g}")
    check("and a number is one again",
          abs(number_of(obj, "TargetMass") / mass - 1) < 1e-3, obj.TargetMass)  # fmt: skip
    choose("RadiusDrivenBy", "Stiffness")
    type_value("StiffnessDirection", "111")
    check("a direction is set", tuple(obj.StiffnessDirection) == (1, 1, 1))
    begins = panel_part("TargetStiffness").value()
    check("a stiffness begins with what there is", begins > 100, begins)
    same = shown.property("rawValue")
    type_value("TargetStiffness", "3000")
    check("a typed stiffness is set", number_of(obj, "TargetStiffness") == 3000)
    stiff = shown.property("rawValue")
    check("a stiffness finds a radius", (stiff > same) == (begins < 3000), (begins, same, stiff))
    check("without an error", "strut radius" in told(),
          told())  # fmt: skip
    picture("panel_7_stiffness")
    type_value("StiffnessDirection", "along")
    check("no direction is said", "no direction" in told())
    choose("RadiusDrivenBy", "Relative")
    type_value("TargetDensity", "30")
    click(panel_part("Compute"))
    met = wait_until(lambda: abs(obj.RelativeDensity - 0.3) < 0.0015)
    check("the mesh is the target's", met, obj.RelativeDensity)
    shown_mm = shown.property("rawValue")
    check("by the radius shown", abs(shown_mm - obj.StrutRadius.Value) < 6e-3,
          (shown_mm, obj.StrutRadius))  # fmt: skip
    picture("panel_8_met")
    answer_panel("Cancel")
    wait_until(lambda: panel() is None)
    settle()
    check("Cancel gives the radius back",
          (obj.RadiusDrivenBy, obj.StrutRadius.Value) == ("Radius", before))  # fmt: skip


def run_a_job():
    """A job has a process of its own, the window lives meanwhile, and what is raised arrives."""
    from freecad_volfrep.features.jobs.progress import run_job

    beats = []
    timer = QtCore.QTimer(Gui.getMainWindow())
    timer.timeout.connect(lambda: beats.append(time.monotonic()))
    timer.start(20)
    other = run_job("A job", os.getpid, has_progress=False)
    check("a job has a process of its own", other != os.getpid(), other)
    beats.clear()
    run_job("A job", time.sleep, 2.0, has_progress=False)
    timer.stop()
    check("the window lives meanwhile", len(beats) > 5, len(beats))
    figures["beats of 20 ms in 2 s"] = len(beats)
    try:
        run_job("A job", float, "no number", has_progress=False)
        check("what it raises arrives", False)
    except ValueError as error:
        check("what it raises arrives", "no number" in str(error), error)


def cancel_soon(pressed, by_click=False):
    """Press Escape or click Cancel, really, once there is a bar; `pressed` gets the time."""
    texts = []

    def look():
        bar = progress_bar()
        if bar is None:
            return False
        texts.append(bar.text.text())
        if len(texts) < 3:  # by then it is drawn
            return False
        point = bar.button.mapToGlobal(bar.button.rect().center())
        shoot("4_progress")
        figures["progress text"] = texts[-1]
        pressed.append(time.monotonic())
        if by_click:
            xdotool("mousemove", point.x(), point.y(), "click", 1)
        else:
            xdotool("key", "a", "ctrl+n")  # which nothing may see
            xdotool("key", "Escape")
        return True

    return Watch(look, "the bar of a job")


@slow
def cancel_an_edit(doc, obj):
    """Escape during a recompute keeps the last mesh and says so."""
    before, documents = obj.Mesh.CountFacets, len(App.listDocuments())
    seen = []
    obj.Resolution, obj.Deviation = 0, 0.002
    obj.CellSize = 2.5
    obj.StrutRadius = 0.25
    obj.ShellThickness = 0.4
    doc.recompute()
    check("a large edit waits for the command", "large job" in obj.Status, obj.Status)
    check("and says what it comes to", "triangles" in obj.Expected, obj.Expected)
    with jobs_that_never_end():
        watch = cancel_soon(seen)
        obj.Proxy.update(obj)
    watch.stop()
    check("a long edit shows its progress", seen)
    if seen:
        figures["seconds from Escape to the end"] = round(time.monotonic() - seen[0], 2)
    check("a cancelled edit is no error", obj.isValid(), obj.getStatusString())
    check("and says so", "Cancelled" in obj.Status, obj.Status)
    check("and keeps the last mesh", obj.Mesh.CountFacets == before)
    check("no key reached FreeCAD", len(App.listDocuments()) == documents)
    check("no bar stays", Gui.getMainWindow().findChild(QtGui.QWidget, "VolfrepCancel") is None)
    check("no wait cursor stays", QtGui.QApplication.overrideCursor() is None)
    obj.Resolution, obj.Deviation = 10, 0
    obj.CellSize = 10
    obj.StrutRadius = 1
    obj.ShellThickness = 1
    doc.recompute()
    check("corrected, it is valid", obj.isValid(), obj.getStatusString())


def cancel_a_creation(doc, box, fill):
    """A click on Cancel after OK leaves an infill without a mesh, and the solid to be seen."""
    select(box)
    names = sorted(o.Name for o in doc.Objects)
    undo_before = doc.UndoCount
    seen = []
    open_panel(fill)
    with jobs_that_never_end():
        watch = cancel_soon(seen, by_click=True)
        answer_panel("OK")
        check("OK closes the panel at once", wait_until(lambda: panel() is None))
        wait_until(lambda: watch.over)
        wait_until(lambda: progress_bar() is None)
    settle()
    check("a long command shows its progress", seen)
    made = infills(doc)[0]
    check("the infill says that it was cancelled", "no mesh yet" in made.Status, made.Status)
    check("no preview stays", previews() == 0, previews())
    check("its solid shows again", box.ViewObject.isVisible())
    doc.undo()
    check("one step back nothing remains", sorted(o.Name for o in doc.Objects) == names)
    check("the undo stack is as before", doc.UndoCount == undo_before, doc.UndoNames)


@costly
def check_the_print(doc, obj):
    """Print Check shows in red, on the infill, what hangs over."""
    obj.Base.Visibility = False
    select(obj)
    click(toolbar_button("Print Check"))
    wait_until(lambda: doc.getObject("PrintCheck") is not None)
    made = doc.getObject("PrintCheck")
    check("it makes a print check", made is not None and made.isValid())
    check("it shows facets", made.Mesh.CountFacets > 0 and made.ViewObject.isVisible())
    check("in red", made.ViewObject.ShapeColor[0] > 2 * made.ViewObject.ShapeColor[1])
    check("the infill stays to be seen", obj.ViewObject.isVisible())
    check("it has figures", "thinnest strut" in made.Text)
    look_at_all(from_below=True)
    picture("5_print_check")
    check("red is seen from below", red_share("5_print_check") > 0.02, red_share("5_print_check"))
    look_at_all()
    Gui.Selection.clearSelection()
    from freecad_volfrep.gui.selection import only_solid

    check("its mesh is no solid to fill", made not in only_solid())
    doc.removeObject(made.Name)


@slow
def open_a_face(doc, obj):
    """Open Faces leaves a picked face of the solid without a skin, in one undo step."""
    obj.Visibility, obj.Base.Visibility = False, True  # to pick a face
    Gui.Selection.clearSelection()
    Gui.Selection.addSelection(obj)
    Gui.Selection.addSelection(obj.Base, "Face6")
    button = toolbar_button("Open Faces")
    wait_until(button.isEnabled)
    check("an infill and a face can be opened", button.isEnabled())
    closed, undo = obj.Volume.Value, doc.UndoCount
    click(button)
    wait_until(lambda: obj.Volume.Value != closed)
    check("the face is open", [tuple(n) for _, n in obj.OpenFaces] == [("Face6",)], obj.Status)
    check("there is less skin", obj.Volume.Value < closed)
    check("the void is open", obj.Voids == 0)
    check("the lattice shows again", obj.Visibility and not obj.Base.Visibility)
    check("it is one step", doc.UndoCount == undo + 1, doc.UndoNames)
    doc.undo()
    doc.recompute()
    check("and can be undone", obj.Volume.Value == closed, obj.Status)


@costly
def pick_in_the_panel(doc, obj):
    """Open faces, a direction and a drain hole by clicks at the solid; Cancel takes them back."""
    look_at_all()
    open_to_edit(obj)
    what, button = panel_part("PickWhat"), panel_part("Pick")
    told = panel_part("Picked")
    offered = [what.itemData(k) for k in range(what.count())]
    check("what applies is offered", {"OpenFaces", "BuildDirection"} <= set(offered), offered)
    check("and nothing else", "NetworkFaces" not in offered, offered)

    def begin(name):
        what.setCurrentIndex(what.findData(name))
        settle()

    begin("OpenFaces")
    click(button)
    check("the solid is shown", wait_until(lambda: obj.Base.Visibility))
    size = [getattr(obj.Base, name).Value for name in ("Length", "Width", "Height")]
    top = (0.5 * size[0], 0.5 * size[1], size[2])
    click_in_view(top, lambda: obj.OpenFaces)
    faces = [tuple(names) for _, names in obj.OpenFaces]
    check("a click opens a face", faces == [("Face6",)], (faces, told.text()))
    check("and it is told", "Face6" in told.text(), told.text())
    picture("10_picked_face")
    click_in_view(top, lambda: not obj.OpenFaces)
    check("another click closes it", obj.OpenFaces == [], obj.OpenFaces)
    click_in_view(top, lambda: obj.OpenFaces)
    begin("DrainPoints")
    length = panel_part("PickLength", QtGui.QDoubleSpinBox)
    check(
        "holes have a first diameter", length.isVisible() and length.value() == 3.0, length.value()
    )
    there = (0.7 * size[0], 0.4 * size[1], size[2])
    click_in_view(there, lambda: obj.DrainPoints)
    holes = [(point - App.Vector(*there)).Length for point in obj.DrainPoints]
    check("a click is a hole there", len(holes) == 1 and holes[0] < 0.2, (holes, told.text()))
    check("of that diameter", obj.DrainDiameter.Value == 3.0, obj.DrainDiameter)
    voids = panel_part("PrintFigures", QtGui.QLabel)
    check("no void is closed then", wait_until(lambda: "closed voids: none" in voids.text()),
          voids.text())  # fmt: skip
    picture("10_picked_hole")
    begin("BuildDirection")
    before = tuple(obj.BuildDirection)
    front = (0.5 * size[0], 0.0, 0.5 * size[2])
    click_in_view(front, lambda: tuple(obj.BuildDirection) != before)
    way = tuple(obj.BuildDirection)
    check("a face gives a direction", way == (0.0, -1.0, 0.0), way)
    check("there is an arrow", scene_has("VolfrepPicked"))
    picture("11_picked_direction")
    begin("Origin")
    check("no origin is said to be there", not any(c.isdigit() for c in told.text()), told.text())
    click_in_view((0.3 * size[0], 0.0, 0.3 * size[2]), lambda: told.text()[:1].isdigit())
    check("a face gives its middle", tuple(obj.Origin) == front, obj.Origin)
    check("which is told", f"{front[0]:g}" in told.text(), told.text())
    click(panel_part("ClearPicked"))
    check("and can be cleared", not any(c.isdigit() for c in told.text()), told.text())
    click(button)
    check("the solid goes again", wait_until(lambda: not obj.Base.Visibility))
    obj.OpenFaces = []
    click(panel_part("Compute"))
    check("a mesh has the hole", wait_until(lambda: len(obj.DrainHoles) == 1), obj.Status)
    check("and so does the arrow", not scene_has("VolfrepPicked"))
    answer_panel("Cancel")
    check("Cancel takes all of it back", obj.OpenFaces == [], obj.OpenFaces)


@slow
def pick_a_skin_in_the_panel(doc, obj):
    """A skin of its own, a bolt's bush and a boss by clicks; an arrow is turned by its end."""
    look_at_all()
    open_to_edit(obj)
    what, button = panel_part("PickWhat"), panel_part("Pick")
    picked, length = panel_part("Picked"), panel_part("PickLength")
    size = [getattr(obj.Base, name).Value for name in ("Length", "Width", "Height")]

    def begin(name):
        what.setCurrentIndex(what.findData(name))
        settle()

    begin("OpenFaces")
    check("an open face has no length", not length.isVisible())
    begin("SkinFaces")
    check("the skin of a face has a thickness", wait_until(length.isVisible))
    mass = told()
    click(button)
    wait_until(lambda: obj.Base.Visibility)
    type_value("PickLength", "6")
    top = (0.5 * size[0], 0.5 * size[1], size[2])
    click_in_view(top, lambda: obj.SkinFaces)
    check("a click gives a face its skin", list(obj.SkinThicknesses) == [6.0], picked.text())
    check("and it is told", "Face6 6 mm" in picked.text(), picked.text())
    check("the preview follows", wait_until(lambda: told() != mass))
    picture("12_picked_skin")
    type_value("PickLength", "4")
    click_in_view(top, lambda: list(obj.SkinThicknesses) == [4.0])
    begin("KeepSolidAround")
    click_in_view((0.5 * size[0], 0.0, 0.5 * size[2]), lambda: obj.KeepSolidAround)
    type_value("PickLength", "7")
    wait_until(lambda: obj.KeepDistance.Value == 7.0)
    picture("13_picked_solid")
    begin("BuildDirection")
    check("the arrow says that it can be turned", "drag" in picked.text(), picked.text())
    picture("14_arrow")
    before = App.Vector(obj.BuildDirection)
    drag_the_arrow(obj, size, "BuildDirection")
    turned = App.Vector(obj.BuildDirection)
    check("the arrow is turned by its end", turned.getAngle(before) > 0.2, turned)
    check("it is of length 1", abs(turned.Length - 1.0) < 1e-3, turned.Length)
    check("and told", f"{turned.x:.4g}" in picked.text(), (picked.text(), turned))
    check("no face was picked with it", turned.getAngle(App.Vector(0, -1, 0)) > 0.01, turned)
    picture("15_arrow_turned")
    click(button)
    answer_panel("OK")
    wait_until(lambda: obj.Status == "Up to date")
    check("the part has its skins", obj.Watertight and obj.Bodies == 1, obj.Status)
    picture("16_skins_made")


def drag_the_arrow(obj, size, name):
    """Really drag the head of a direction's arrow to the right on the screen, until it has turned.

    The head is where the panel draws it: 0.35 diagonals of the solid from its middle.
    """
    before = App.Vector(getattr(obj, name))
    reach = 0.35 * App.Vector(*size).Length
    head = 0.5 * App.Vector(*size) + App.Vector(before) * (reach / before.Length)
    view = view_3d()
    x, y = Gui.activeDocument().activeView().getPointOnScreen(head)
    corner = view.mapToGlobal(view.rect().bottomLeft())
    for _ in range(5):
        move_mouse(QtCore.QPoint(corner.x() + x, corner.y() - y))
        xdotool("mousedown", 1)
        for step in range(1, 9):
            move_mouse(QtCore.QPoint(corner.x() + x + 10 * step, corner.y() - y + 5 * step))
        comes_true(lambda: getattr(obj, name) != before, 5)
        xdotool("mouseup", 1)
        settle()
        if getattr(obj, name) != before:
            return
    fail("the arrow cannot be dragged")


def scene_has(name):
    """Whether something of that name hangs in the view's scene."""
    scene = Gui.activeDocument().activeView().getSceneGraph()
    return name in [scene.getChild(k).getName().getString() for k in range(scene.getNumChildren())]


@slow
def make_a_solid(doc, obj):
    """Lattice To Solid asks, with figures, and makes a Part solid."""
    asked = []

    def answer(box):
        asked.append(box.comboBoxItems())
        shoot("7_to_solid")
        box.accept()

    select(obj)
    when_dialog(QtGui.QInputDialog, answer)
    click(toolbar_button("Lattice To Solid"))
    wait_until(lambda: any(o.Name.endswith("Solid") for o in doc.Objects))
    check("it shows the predicted size first", asked and "plane faces: about" in asked[0][0], asked)
    check("it offers every kind", asked and len(asked[0]) == 4, asked)
    made = [o for o in doc.Objects if o.TypeId == "Part::Feature" and o.Name.endswith("Solid")]
    check("it makes a solid", len(made) == 1 and made[0].Shape.ShapeType == "Solid")
    picture("8_solid")
    for solid in made:
        doc.removeObject(solid.Name)
    obj.Visibility = True


@costly
def make_an_analysis(doc, obj):
    """FEM Analysis asks for the model, with figures, and makes an analysis."""
    asked = []

    def answer(box):
        asked.append(box.comboBoxItems())
        box.accept()

    select(obj)
    before = len(doc.Objects)
    when_dialog(QtGui.QInputDialog, answer)
    click(toolbar_button("FEM Analysis"))
    wait_until(lambda: any(o.TypeId == "Fem::FemMeshObject" for o in doc.Objects))
    check("it offers beams", asked and asked[0][0].startswith("beams: "), asked)
    analyses = [o for o in doc.Objects if o.isDerivedFrom("Fem::FemAnalysis")]
    check("it makes an analysis", len(analyses) == 1 and len(analyses[0].Group) == 5)
    doc.undo()
    check("undo takes it away", len(doc.Objects) == before, len(doc.Objects))


def save_and_reopen(doc, obj):
    """A file opened in the windows shows the lattice without computing."""
    path = OUT / "drive.FCStd"
    facets = obj.Mesh.CountFacets
    doc.saveAs(str(path))
    App.closeDocument(doc.Name)
    again = App.openDocument(str(path))
    wait_until(lambda: Gui.activeDocument() is not None)
    settle()
    found = infills(again)
    check("reopened", len(found) == 1 and found[0].Mesh.CountFacets == facets)
    check("reopened without a recompute", found and found[0].State == ["Up-to-date"])
    view = found[0].ViewObject.Proxy if found else None
    check("reopened with its icon", view is not None and view.getIcon().endswith(".svg"))
    picture("9_reopened")


@slow
def open_an_invalid_one(doc, obj):
    """An infill that could not be computed opens with its solid, and not with nothing."""
    empty = doc.copyObject(obj, False)
    empty.ShellThickness = 50
    doc.recompute()
    check("it has no mesh", not empty.Mesh.CountFacets or not empty.isValid(), empty.Status)
    base, path = obj.Base.Name, OUT / "invalid.FCStd"
    doc.removeObject(obj.Name)
    import Mesh

    empty.Mesh = Mesh.Mesh()
    settle()
    doc.getObject(base).Visibility = False
    doc.saveAs(str(path))
    App.closeDocument(doc.Name)
    again = App.openDocument(str(path))
    check("its solid shows", wait_until(lambda: again.getObject(base).Visibility))
    App.Console.PrintMessage("It was meant to fail.\n")
    Gui.getMainWindow().findChild(QtGui.QTextEdit, "Report view").clear()


@costly
def see_what_suits(doc, obj):
    """Enter closes nothing, without its preview the solid is seen, and first values suit."""
    open_to_edit(obj)
    type_value("CellSize", "8 mm")
    xdotool("key", "Return")
    settle()
    check("Enter keeps the panel", panel() is not None)
    if panel() is None:
        return
    check("the solid hides", not obj.Base.ViewObject.Visibility)
    click(panel_part("Preview"))
    settle()
    check("without a preview it shows", wait_until(lambda: obj.Base.ViewObject.Visibility))
    picture("panel_7_no_preview")
    click(panel_part("Preview"))
    check("and hides again", wait_until(lambda: not obj.Base.ViewObject.Visibility))
    check("a sheet is a tenth of the cell", abs(obj.WallThickness.Value - 0.8) < 1e-9)
    grading = panel_part("RadiusGrading")
    grading.setCurrentIndex(grading.findData("Direction"))
    settle()
    ends = obj.RadiusStart.Value, obj.RadiusEnd.Value
    check("a grading begins with the radius", ends == (obj.StrutRadius.Value,) * 2, ends)
    check("pages of JSON are no property to read", "Hidden" in obj.getEditorMode("Report"))
    answer_panel("Cancel")
    check("Cancel closes the panel", wait_until(lambda: panel() is None))


@slow
def choose_walls(doc, obj):
    """A Gyroid of the panel's list asks for a thickness in place of a radius, and is made."""
    open_to_edit(obj)
    choose_lattice("TPMS", "Gyroid")
    check("Gyroid is chosen", obj.CellType == "Gyroid", obj.CellType)
    check("it asks for a thickness", panel_part("WallThickness").isVisible())
    check("and for no radius", not panel_part("StrutRadius").isVisible())
    words = [w.text().replace("&", "") for kind in (QtGui.QLabel, QtGui.QAbstractButton)
             for w in panel().findChildren(kind) if w.isVisible()]  # fmt: skip
    check("nor says a word of struts", not [w for w in words if "trut" in w or "Radius" in w],
          words)  # fmt: skip
    picture("panel_6_walls")
    type_value("WallThickness", "1.6 mm")
    answer_panel("OK")
    check("OK closes the panel", wait_until(lambda: panel() is None))
    check("the walls are made", wait_until(lambda: obj.Status == "Up to date"), obj.Status)
    check("without struts", obj.Struts == 0 and obj.Bodies == 1, (obj.Struts, obj.Bodies))
    picture("walls_made")


@costly
def choose_networks(doc, obj):
    """The third tab: points of a Voronoi network, cells along faces that are clicked at."""
    open_to_edit(obj)
    height = panel_part("CellSize").mapTo(panel(), QtCore.QPoint()).y()
    choose_lattice("Networks", "Voronoi")
    picture("panel_networks")
    check("Voronoi is chosen", obj.Network == "Voronoi", obj.Network)
    check("it asks for points", panel_part("NetworkPoints").isVisible())
    check("the fields stay where they are", height == panel_part("CellSize").mapTo(
        panel(), QtCore.QPoint()).y())  # fmt: skip
    type_value("NetworkSeed", "5")
    check("a seed is taken", obj.NetworkSeed == 5)
    choose_lattice("Networks", "Along faces")
    check("it asks for faces", panel_part("Pick").isChecked())
    check("of the network", panel_part("PickWhat").currentData() == "NetworkFaces")
    check("and for the cell", panel_part("CellOfNetwork").isVisible())
    choose_lattice("TPMS", "Gyroid")
    check("a TPMS takes its place", (obj.Network, obj.CellType) == ("Cells", "Gyroid"))
    choose_lattice("Networks", "Voronoi")
    check("and a network that of walls", (obj.Network, obj.CellType) == ("Voronoi", "CVC"))
    choose_lattice("Unit cells", "Octet")
    check("and a cell that of both", (obj.Network, obj.CellType) == ("Cells", "Octet"))
    choose_lattice("Networks", "Voronoi")
    answer_panel("OK")
    check("it is made", wait_until(lambda: obj.Status == "Up to date"), obj.Status)
    check("of struts", obj.Struts > 100, obj.Struts)
    picture("network_made")
    open_to_edit(obj)
    check("the panel opens at its tab", panel_part("LatticeTabs").currentIndex() == 2)
    check("and its picture", panel_part("CellType").currentItem().text() == "Voronoi")
    answer_panel("Cancel")
    check("Cancel closes the panel", wait_until(lambda: panel() is None))


run_checks(
    "result",
    {
        find_the_workbench: boxed,
        fill_the_box: boxed,
        edit_in_the_panel: filled,
        undo_an_edit: filled,
        give_it_an_own_cell: filled,
        drive_the_radius: filled,
        see_what_suits: filled,
        choose_walls: filled,
        choose_networks: filled,
        run_a_job: None,
        cancel_an_edit: filled,
        cancel_a_creation: boxed,
        open_a_face: filled,
        pick_in_the_panel: filled,
        pick_a_skin_in_the_panel: filled,
        check_the_print: filled,
        show_coarsely: filled,
        make_a_solid: coarse,
        make_an_analysis: coarse,
        save_and_reopen: filled,
        open_an_invalid_one: filled,
    },
)

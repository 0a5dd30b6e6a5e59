# SPDX-License-Identifier: LGPL-2.1-or-later
"""Loads and Sizing, Strut Results by real clicks: panel, cancel, colours, steps of undo.

Run it with tools/run_gui.sh.
"""

import re
import time

import FreeCAD as App
import FreeCADGui as Gui
from driving import (
    OUT,
    Standstills,
    answer_file_dialog,
    answer_panel,
    check,
    click,
    click_in_tree,
    click_in_view,
    click_menu,
    clicks,
    comes_true,
    costly,
    figures,
    infills,
    move_mouse,
    panel,
    panel_part,
    picture,
    press_button,
    run_checks,
    seen,
    select,
    settle,
    shades,
    shoot,
    slow,
    start_answer,
    toolbar_button,
    type_into,
    type_value,
    view_3d,
    wait_until,
    window,
    xdotool,
)
from new_analysis import loaded
from new_infill import boxed
from new_infill import filled as filled_block
from PySide import QtCore, QtGui

from bench.parts import NO_PARTS, PARTS

#: What the sizing of a real part may take on a busy machine, s.
MINUTES = 800
#: What is said of a strut or a place that no limit is near to.
OTHERS = "thickened with others"


def sizing_panel():
    """The open panel of Loads and Sizing, or None."""
    found = Gui.getMainWindow().findChildren(QtGui.QWidget, "VolfrepSizePanel")
    return next((widget for widget in found if widget.isVisible()), None)


def part(name, kind=QtGui.QWidget):
    return sizing_panel().findChild(kind, name)


def dock():
    """The window of strut results, or None."""
    found = Gui.getMainWindow().findChildren(QtGui.QDockWidget, "VolfrepColourBy")
    return next((widget for widget in found if widget.isVisible()), None)


def reports():
    found = Gui.getMainWindow().findChildren(QtGui.QDialog, "VolfrepReport")
    return [window for window in found if window.isVisible()]


def network():
    """A beam of Voronoi edges, held and loaded as that of cells is."""
    return loaded(
        Network="Voronoi", NetworkPoints=20, StrutRadius=0.8, ShellThickness=0.8, Resolution=10
    )


def open_panel(obj):
    select(obj)
    click(toolbar_button("Loads and Sizing"))
    check("a click opens the panel", wait_until(lambda: sizing_panel() is not None, 10))


@costly
def size_and_take(doc, obj):
    """Size by clicks, look at the struts, take it, undo it."""
    before = obj.Mesh.CountFacets, obj.Volume.Value
    steps = doc.UndoCount
    open_panel(obj)
    picture("sizing_1_panel")
    title = sizing_panel().windowTitle()
    check("its title has the command's whole name", title.startswith("Loads and Sizing: "), title)
    cases = part("Cases", QtGui.QListWidget)
    check("both analyses are offered", [cases.item(k).text() for k in range(cases.count())]
          == ["bend", "light"])  # fmt: skip
    shown = {name: part(name).isVisible() for name in ("safety", "strut_mass")}
    check(
        "the mass is asked for the most stiffness only",
        shown == {"safety": True, "strut_mass": False},
    )
    # So much that the thinnest struts alone do not bear it: else one radius is all that is found.
    click(part("safety"))
    xdotool("key", "ctrl+a")
    xdotool("type", "6")
    xdotool("key", "Tab")
    click(part("Size"))
    check("there are steps", wait_until(lambda: part("Steps").rowCount() > 3, 60))
    found = wait_until(lambda: "hold all limits" in part("Said").text(), 90)
    check("it says what was found", found, part("Said").text())
    figures["said"] = part("Said").text()
    check("the struts are shown", dock() is not None)
    check("the mesh is still the old one", obj.Mesh.CountFacets == before[0])
    picture("sizing_2_sized")
    figures["shades"] = shades("sizing_2_sized", view_3d())
    check("in colours", figures["shades"] > 200, figures["shades"])
    show_what_governs("sizing_2_governs", {"stress, bend", "smallest radius"})
    bar = part("Steps").horizontalScrollBar()
    check("no column of the steps is cut off", bar.maximum() == 0, bar.maximum())
    click(part("Plot"))
    check("the steps have a plot", wait_until(lambda: window("VolfrepPlot") is not None))
    shown = window("VolfrepPlot").findChild(QtGui.QLabel, "Plot").pixmap()
    check("with lines in it", shown.width() > 300 and shown.height() > 200, shown.size())
    picture("sizing_2_plot")
    window("VolfrepPlot").close()
    settle()
    answer_panel("OK")
    check("the panel closes", wait_until(lambda: sizing_panel() is None, 90))
    settle()
    check("it is up to date", obj.Status == "Up to date", obj.Status)
    check("it is graded", obj.RadiusGrading == "Field" and len(obj.SizedRadii) > 10)
    check("it is lighter", obj.Volume.Value < before[1], (obj.Volume.Value, before[1]))
    check("the struts went", dock() is None)
    check("the infill is shown", obj.ViewObject.Visibility)
    check("a report opens", len(reports()) == 1)
    bar = reports()[0].text.horizontalScrollBar()
    check("which is not scrolled sideways", bar.maximum() == 0, bar.maximum())
    picture("sizing_3_taken")
    check("radii and mesh are a step each", doc.UndoCount == steps + 2, (doc.UndoCount, steps))
    reports()[0].close()
    colour_the_preview(obj)
    doc.undo()
    doc.undo()
    doc.recompute()
    check("which is taken back", (obj.Mesh.CountFacets, obj.Volume.Value) == before)


def show_what_governs(name, wanted, quantity="governing"):
    """The dock shows it in few colours and says it in words, the mouse's, too, without a scale."""
    choice = dock().findChild(QtGui.QComboBox, "Quantity")
    choice.setCurrentIndex(choice.findData(quantity))
    scale = dock().findChild(QtGui.QDoubleSpinBox, "To")
    check("names have no scale", wait_until(lambda: not scale.isVisible(), 60))
    pointed, middle = dock().findChild(QtGui.QLabel, "Said"), view_3d().rect().center()
    told = set()
    for aside in range(-140, 141, 28):
        move_mouse(view_3d().mapToGlobal(QtCore.QPoint(middle.x() + aside, middle.y())))
        if comes_true(lambda: pointed.text().endswith(" under the mouse"), 2):
            told.add(pointed.text().removesuffix(" under the mouse"))
    check("the mouse reads what governs", told and told <= wanted, told)
    picture(name)


@slow
def size_as_printed(doc, obj):
    """Struts that count as the printer makes them: by a table of the process, told, remembered."""
    open_panel(obj)
    words = lambda: [table.itemText(k).partition(":")[0] for k in range(table.count())]  # noqa: E731
    table = part("Printed", QtGui.QComboBox)
    check("struts count as drawn", table.currentText() == "As drawn")
    check("all tables are offered", "SLS-PA12" in words(), words())
    choose("PrintProcess", "LPBF", lambda: obj.PrintProcess)
    check("then those of the process", words()
          == ["As drawn", "LPBF-Ti64", "LPBF-316L", "My own measurements"], words())  # fmt: skip
    choose("Printed", "My own measurements", table.currentText)
    check("which want a file", part("Table").isVisible())
    click(part("Size"))
    check("that is asked for", wait_until(lambda: ".csv" in part("Said").text()))
    picture("printed_1_own")
    choose("Printed", "LPBF-Ti64: LPBF, Ti-6Al-4V", table.currentText)
    check("a published one does not", not part("Table").isVisible())
    click(part("Prove"))
    scatter = part("Scatter")
    click(scatter)
    xdotool("key", "ctrl+a")
    xdotool("type", "1")
    xdotool("key", "Tab")
    wait_until(lambda: scatter.value() == 1.0)
    click(part("Size"))
    told = wait_until(lambda: "as printed (LPBF, Ti-6Al-4V)" in part("Said").text(), 90)
    check("what comes out is told", told, part("Said").text())
    figures["said as printed"] = part("Said").text()
    label = dock().findChild(QtGui.QLabel, "Said").text()
    check("the colours say so", "Of struts as printed" in label, label)
    picture("printed_2_sized")
    answer_panel("OK")
    check("the panel closes", wait_until(lambda: sizing_panel() is None, 90))
    check("a report opens", wait_until(lambda: len(reports()) == 1, 60))
    picture("printed_3_report")
    reports()[0].close()
    settle()
    open_panel(obj)
    check("the table is remembered", part("Printed").currentText().startswith("LPBF-Ti64"))
    check("and the deviations", part("Scatter").value() == 1.0)
    answer_panel("Cancel")
    wait_until(lambda: sizing_panel() is None)


def fcc():
    """A beam of FCC cells built along itself, of which those struts lie flat that go across."""
    return loaded(CellType="FCC")


@slow
def size_for_printing(doc, obj):
    """Flat struts go where the box says so, which needs a process; the document remembers it."""
    open_panel(obj)
    tick, said = part("ForPrint", QtGui.QCheckBox), part("Building", QtGui.QLabel)
    check("it needs a process", not tick.isEnabled() and "No process" in said.text(), said.text())
    choose("PrintProcess", "LPBF", lambda: obj.PrintProcess)
    way = part("BuildDirection", QtGui.QLineEdit)
    check("built along z at first", way.text() == "0, 0, 1", way.text())
    for wrong in ("0,0,0", "up"):
        type_into(way, wrong)
        check("what is no direction is said", wait_until(lambda w=wrong: w in part("Said").text()))
        check("and is not taken", wait_until(lambda: way.text() == "0, 0, 1"), way.text())
    click(part("ForPrint"))
    click(part("Prove"))
    click(part("Size"))
    told = lambda: part("Said").text()  # noqa: E731
    better = "Built along x the lattice without flatter struts is"
    check("a better direction is told", wait_until(lambda: better in told(), 90), told())
    check("it begins in sight", not part("Said").visibleRegion().isEmpty())
    picture("for_print_0_across")
    click(part("ForPrint"))
    type_into(way, "1,0,0")
    check("a direction is the infill's", wait_until(lambda: obj.BuildDirection.x == 1.0))
    check("and what was wrong is not said any more", not part("Said").text())
    wanted = "LPBF, built along x: struts from 0.6 mm thick and 45 degrees steep"
    check("whose limits are told", wait_until(lambda: wanted in said.text()), said.text())
    check("and is not asked for by itself", tick.isEnabled() and not tick.isChecked())
    click(tick)
    check("a click asks for it", wait_until(tick.isChecked))
    picture("for_print_1_panel")
    click(part("Size"))
    check("flat struts went", wait_until(lambda: "along x: " in told(), 90), told())
    check("in a line of its own", told().count("\n") >= 1, told())
    figures["said for printing"] = told()
    picture("for_print_2_sized")
    answer_panel("OK")
    check("the panel closes", wait_until(lambda: sizing_panel() is None, 90))
    check("a report opens", wait_until(lambda: len(reports()) == 1, 60))
    shown = reports()[0].text.toPlainText()
    check("which tells it", "For printing" in shown and "flatter struts removed" in shown, shown)
    bar = reports()[0].text.horizontalScrollBar()
    check("which is not scrolled sideways", bar.maximum() == 0, bar.maximum())
    picture("for_print_3_report")
    reports()[0].close()
    settle()
    check("it is up to date", obj.Status == "Up to date", obj.Status)
    check("without flat struts", obj.RemoveFlatter == 45.0, obj.RemoveFlatter)
    open_panel(obj)
    check("it is remembered", part("ForPrint").isChecked())
    answer_panel("Cancel")
    wait_until(lambda: sizing_panel() is None)


@slow
def size_a_network(doc, obj):
    """A random network is sized by clicks as cells are, and its radii stored on its own nodes."""
    struts = obj.Struts
    select(obj)
    picture("network_1_selected")
    open_panel(obj)
    picture("network_2_panel")
    click(part("Prove"))
    click(part("Size"))
    found = wait_until(lambda: part("Said").text() != "", 90)
    figures["least mass of a network"] = part("Said").text()
    check("limits are held", found and "hold all limits" in part("Said").text(),
          part("Said").text())  # fmt: skip
    rows = part("Steps", QtGui.QTableWidget).rowCount()
    check("nothing is sought below the least radius", rows < 30, rows)
    goal = part("Goal", QtGui.QComboBox)
    goal.setCurrentIndex(goal.findData("stiffness"))
    settle()
    click(part("Size"))
    found = wait_until(lambda: "times as stiff" in part("Said").text(), 90)
    check("it says what was found", found, part("Said").text())
    figures["said of a network"] = part("Said").text()
    check("the struts are shown", dock() is not None)
    picture("network_3_sized")
    figures["shades of a network"] = shades("network_3_sized", view_3d())
    check("in colours", figures["shades of a network"] > 200, figures["shades of a network"])
    answer_panel("OK")
    check("the panel closes", wait_until(lambda: sizing_panel() is None, 90))
    settle()
    check("it is up to date", obj.Status == "Up to date", obj.Status)
    check("its struts are the same", obj.Struts == struts, (obj.Struts, struts))
    check("with radii of their own", obj.RadiusGrading == "Field" and len(obj.SizedRadii) > 10)
    check("in one piece", obj.Bodies == 1, obj.Bodies)
    check("a report opens", len(reports()) == 1)
    picture("network_4_taken")
    reports()[0].close()
    settle()
    picture("network_5_mesh")


def colour_the_preview(obj):
    """The infill's panel shows what its struts carry, and greys that once they are others."""
    select(obj)
    click(toolbar_button("Edit Lattice Infill"))
    wait_until(lambda: panel() is not None)
    settle()
    choice = panel_part("ColourBy", QtGui.QComboBox)
    item = choice.model().item(choice.findData("Stress"))
    check("the preview may be coloured by stress", item.isEnabled(), item.toolTip())
    governs = choice.model().item(choice.findData("Governing limit"))
    choice.setCurrentIndex(governs.row())
    check("and by what governs", wait_until(lambda: "VolfrepLegend" in scene_names()))
    picture("sizing_4_preview_governs")
    choice.setCurrentIndex(item.row())
    settle()
    check("a legend says what colours mean", wait_until(lambda: "VolfrepLegend" in scene_names()))
    picture("sizing_5_preview")
    figures["shades of the preview"] = shades("sizing_5_preview", view_3d())
    check("it is in colours", figures["shades of the preview"] > 200)
    type_value("CellSize", "8 mm")
    choice.look()
    check("of another lattice it is not known", not item.isEnabled() and "size it again" in
          item.toolTip(), item.toolTip())  # fmt: skip
    check("and not shown", wait_until(lambda: "VolfrepLegend" not in scene_names()))
    answer_panel("Cancel")
    wait_until(lambda: panel() is None)
    obj.ViewObject.ColourBy = "None"
    settle()


def scene_names():
    """Names of what hangs in the view's scene."""
    scene = Gui.activeDocument().activeView().getSceneGraph()
    return [scene.getChild(k).getName().getString() for k in range(scene.getNumChildren())]


@slow
def cancel_the_panel(doc, obj):
    """Cancel of the panel leaves nothing behind."""
    before = obj.Mesh.CountFacets, obj.RadiusGrading
    steps = doc.UndoCount
    open_panel(obj)
    goal = part("Goal", QtGui.QComboBox)
    goal.setCurrentIndex(goal.findData("stiffness"))
    settle()
    shown = {name: part(name).isVisible() for name in ("safety", "strut_mass")}
    check("limits go with another goal", shown == {"safety": False, "strut_mass": True}, shown)
    click(part("Prove"))
    check("a check by CalculiX may be left out", not part("Prove").isChecked())
    click(part("Size"))
    check("it is stiffer", wait_until(lambda: "times as stiff" in part("Said").text(), 90),
          part("Said").text())  # fmt: skip
    figures["said of stiffness"] = part("Said").text()
    answer_panel("Cancel")
    check("the panel closes", wait_until(lambda: sizing_panel() is None, 10))
    settle()
    check("nothing is left", (obj.Mesh.CountFacets, obj.RadiusGrading) == before)
    check("no step either", doc.UndoCount == steps, (doc.UndoCount, steps))
    check("the struts went", dock() is None)
    check("the infill is shown", obj.ViewObject.Visibility)


@slow
def escape_keeps_the_best(doc, obj):
    """Escape ends a long search, and the best design so far can be taken."""
    open_panel(obj)
    field = part("max_displacement")
    click(field)
    xdotool("key", "ctrl+a")
    xdotool("type", "2")
    xdotool("key", "Tab")
    settle()
    table = part("Steps", QtGui.QTableWidget)

    def press():
        if table.rowCount() >= 3:
            xdotool("key", "Escape")
        else:
            QtCore.QTimer.singleShot(50, press)

    QtCore.QTimer.singleShot(50, press)
    click(part("Size"))
    check("it ended", wait_until(lambda: part("Said").text() != "", 90))
    figures["steps before Escape"] = table.rowCount()
    figures["said after Escape"] = part("Said").text()
    check("early", 3 <= table.rowCount() < 30, table.rowCount())
    check("with a design", dock() is not None, part("Said").text())
    picture("sizing_4_escaped")
    answer_panel("Cancel")
    check("the panel closes", wait_until(lambda: sizing_panel() is None, 10))


@costly
def show_results(doc, obj):
    """Strut Results of a lattice as it is, by the menus; cases, quantities, deformed."""
    select(obj)
    click_menu("VOLFREP", "Strut Results")
    check("the menu opens it", wait_until(lambda: dock() is not None, 60))
    settle()
    check("the infill makes room", not obj.ViewObject.Visibility)
    case = dock().findChild(QtGui.QComboBox, "Case")
    quantity = dock().findChild(QtGui.QComboBox, "Quantity")
    check("both cases", [case.itemText(k) for k in range(case.count())] == ["bend", "light"])
    drawn = {}
    for k in range(quantity.count()):
        quantity.setCurrentIndex(k)
        settle()
        picture(f"results_{quantity.itemData(k)}")
        drawn[quantity.itemData(k)] = shades(f"results_{quantity.itemData(k)}", view_3d())
    figures["shades of results"] = drawn
    check("every quantity is drawn", min(drawn.values()) > 150, drawn)
    click(dock().findChild(QtGui.QCheckBox, "Deformed"))
    factor = dock().findChild(QtGui.QDoubleSpinBox, "Factor")
    said = factor.text()
    check("deformed says how much", re.fullmatch("automatic: \\d+ \u00d7", said), said)
    picture("results_deformed")
    click(factor)
    xdotool("key", "ctrl+a")
    xdotool("type", "1")
    xdotool("key", "Tab")
    settle()
    check("another factor can be typed", factor.value() == 1.0, factor.text())
    picture("results_deformed_once")
    once, fits = (seen(f"results_deformed{name}", view_3d()) for name in ("_once", ""))
    check("and is drawn", (once != fits).any(axis=2).mean() > 0.01)
    high = dock().findChild(QtGui.QDoubleSpinBox, "To")
    most = high.value()
    click(high)
    xdotool("key", "ctrl+a")
    xdotool("type", f"{most / 2:.4g}")
    xdotool("key", "Tab")
    settle()
    case.setCurrentIndex(1)
    settle()
    check("the scale stays with the quantity", abs(high.value() - most / 2) < 1e-3 * most)
    click(dock().findChild(QtGui.QPushButton, "Automatic"))
    settle()
    check("and is given back", abs(high.value() - most) < 1e-3 * most, (high.value(), most))
    pointed = dock().findChild(QtGui.QLabel, "Said")
    middle = view_3d().mapToGlobal(view_3d().rect().center())

    def is_told():
        move_mouse(QtCore.QPoint(middle.x() + next(steps), middle.y()))
        return comes_true(lambda: pointed.text()[:1].isdigit(), 2)

    steps = iter(range(-60, 400, 7))
    check("the mouse reads off a value", wait_until(is_told), pointed.text())
    dock().close()
    settle()
    check("closing shows the infill again", obj.ViewObject.Visibility)
    colour_the_mesh(doc, obj)
    check("and leaves nothing in the view", "VolfrepStrutResults" not in scene_names())


def colour_the_mesh(doc, obj):
    """Colour By shows the stress of the document's cases on the mesh itself."""
    obj.ViewObject.ColourBy = "Stress"
    settle()
    check("with a legend", "VolfrepLegend" in scene_names(), scene_names())
    picture("results_on_the_mesh")
    figures["shades on the mesh"] = shades("results_on_the_mesh", view_3d())
    check("in colours", figures["shades on the mesh"] > 400, figures["shades on the mesh"])
    obj.ViewObject.ColourBy = "None"


def filled():
    """A block with a lattice in a skin, of nothing but that."""
    doc, _, obj = filled_block("Block", CellSize=10, ShellThickness=1, Resolution=8)
    return doc, obj


@costly
def load_by_clicks(doc, obj):
    """From a lattice to the report of its sizing: faces held and loaded by clicks, in one panel."""
    before, steps = [one.Name for one in doc.Objects], doc.UndoCount
    size = [getattr(obj.Base, name).Value for name in ("Length", "Width", "Height")]
    top, front = (0.5 * size[0], 0.5 * size[1], size[2]), (0.5 * size[0], 0.0, 0.5 * size[2])
    clicks.clear()
    click_in_tree(obj.Label)
    click(toolbar_button("Loads and Sizing").button)
    check("a click opens the panel", wait_until(lambda: sizing_panel() is not None, 10))
    picture("loads_1_panel")
    check("faces that are held are picked at once", wait_until(part("AddHeld").isChecked))
    check("the solid is shown", obj.Base.Visibility and not obj.Visibility)
    loads, cases = part("Loads", QtGui.QListWidget), part("Cases", QtGui.QListWidget)
    rows = lambda: [loads.item(k).text() for k in range(loads.count())]  # noqa: E731
    click_in_view(front, lambda: rows() == ["Held: Face3"])
    check("a click makes a case and holds a face", cases.count() == 1, cases.count())
    click(part("AddForce"))
    click_in_view(top, lambda: len(rows()) == 2)
    xdotool("type", "500")
    check("a force is typed in at once", wait_until(
        lambda: rows()[1] == "Force 500 N, -Z: Face6"), rows())  # fmt: skip
    case = next(one for one in doc.Objects if one.isDerivedFrom("Fem::FemAnalysis"))
    force = next(one for one in case.Group if one.TypeId == "Fem::ConstraintForce")
    check("it points down", (force.DirectionVector - App.Vector(0, 0, -1)).Length < 1e-9)
    check("and is drawn", force.ViewObject.Visibility)
    picture("loads_2_force")
    made = part("PrintMaterial", QtGui.QComboBox)
    click(made)
    wait_until(made.view().isVisible)
    xdotool("key", "Home", "Down")
    clicks.append(1)  # at the entry, which the key takes here
    xdotool("key", "Return")
    check("the material is the infill's", wait_until(
        lambda: obj.PrintMaterial == made.itemData(1) != "None"), obj.PrintMaterial)  # fmt: skip
    click(part("Size"))
    said = part("Said")
    check("it is sized", wait_until(lambda: "hold all limits" in said.text(), 90), said.text())
    picture("loads_3_sized")
    answer_panel("OK")
    check("the panel closes", wait_until(lambda: sizing_panel() is None, 90))
    check("and a report opens", wait_until(lambda: len(reports()) == 1, 60))
    settle()
    figures["clicks from a lattice to the report"] = len(clicks)
    check("in ten clicks", len(clicks) <= 10, len(clicks))
    check("the symbols go out of the view", not force.ViewObject.Visibility)
    picture("loads_4_report")
    page = OUT / "sizing.html"
    page.unlink(missing_ok=True)
    answer_file_dialog(page, "save_sizing")
    click(reports()[0].findChild(QtGui.QPushButton, "Save..."))
    check("its page is saved", wait_until(page.is_file))
    check("with a drawing of the loads", page.is_file() and "<svg" in page.read_text())
    reports()[0].close()
    settle()
    while doc.UndoCount > steps:
        doc.undo()
    check("undo takes the loads back", [one.Name for one in doc.Objects] == before)


def seen_face(base, number):
    """A point of a face that is seen where the mouse would be, mm."""
    view = Gui.activeDocument().activeView()
    face = base.Shape.Faces[number - 1]
    points, triangles = face.tessellate(0.5)
    for corners in triangles:
        place = sum((points[k] for k in corners), App.Vector()) / 3.0
        under = view.getObjectInfo(view.getPointOnScreen(place)) or {}
        if under.get("Component") == f"Face{number}":
            return place
    raise LookupError(f"Face{number} is not seen")


def click_alike(place, done):
    """Really click at a point of the part with Ctrl held down."""
    xdotool("keydown", "ctrl")
    try:
        click_in_view(place, done)
    finally:
        xdotool("keyup", "ctrl")


def choose(name, entry, read):
    """Really open a list and click at one of its entries."""
    field = part(name, QtGui.QComboBox)
    click(field)
    view = field.view()
    wait_until(view.isVisible)
    row = view.visualRect(field.model().index(field.findText(entry), 0))
    move_mouse(view.viewport().mapToGlobal(row.center()))
    press_button()
    check(f"{entry} is chosen", wait_until(lambda: read() == entry), read())


@slow
def size_the_skin(doc, obj):
    """The skin's thickness is typed in, found, seen in colours, taken, and undone in one step."""
    before, steps = obj.ShellThickness.Value, doc.UndoCount
    open_panel(obj)
    for name, text in (("safety", "40"), ("skin_thinnest", "0.6"), ("skin_thickest", "3")):
        click(part(name))
        xdotool("key", "ctrl+a")
        xdotool("type", text)
        xdotool("key", "Tab")
    check("they are taken", part("skin_thinnest").property("rawValue") == 0.6)
    click(part("Prove"))
    click(part("Size"))
    found = wait_until(lambda: "a skin of" in part("Said").text(), MINUTES)
    check("it says how thick the skin is", found, part("Said").text())
    figures["said of the skin"] = part("Said").text()
    picture("skin_1_sized")
    start_answer("OK")
    check("a report opens", wait_until(lambda: len(reports()) == 1, MINUTES))
    told = reports()[0].text.toPlainText()
    check("it splits the mass", "mass of the skin, g" in told and "mean thickness, mm" in told)
    picture("skin_2_report")
    reports()[0].close()
    settle(MINUTES)
    check("the lattice is up to date", obj.Status == "Up to date", obj.Status)
    check("its skin is the sized one", obj.SkinFollowsSizing and len(obj.SizedSkin) > 10)
    check("nowhere less than asked", obj.ShellThickness.Value == 0.6, obj.ShellThickness)
    select(obj)
    click(toolbar_button("Colour By"))
    check("colours open", wait_until(lambda: dock() is not None, 20))
    quantity = dock().findChild(QtGui.QComboBox, "Quantity")
    quantity.setCurrentIndex(quantity.findData("Skin"))
    ends = dock().findChild(QtGui.QDoubleSpinBox, "To")
    low = dock().findChild(QtGui.QDoubleSpinBox, "From")
    check("the skin has a scale", wait_until(lambda: ends.value() > low.value() >= 0.59, 60),
          (low.value(), ends.value()))  # fmt: skip
    settle()
    picture("skin_3_colours")
    figures["shades of the skin"] = shades("skin_3_colours", view_3d())
    check("in colours", figures["shades of the skin"] > 150, figures["shades of the skin"])
    wanted = {"smallest thickness", "largest thickness", "skin stress, bend", OTHERS}
    show_what_governs("skin_4_governs", wanted, "Governing limit of the skin")
    wanted = {"stress, bend", "smallest radius", OTHERS}
    show_what_governs("skin_5_governs", wanted, "Governing limit")
    obj.ViewObject.ColourBy = "None"
    dock().close()
    settle()
    while doc.UndoCount > steps:
        doc.undo()
    check("undo gives the skin back", obj.ShellThickness.Value == before, obj.ShellThickness)
    check("and takes what was found", not len(obj.SizedSkin) and not obj.SkinFollowsSizing)


@slow
def size_a_solid(doc, box):
    """Loads and Sizing of a solid makes its lattice, which Cancel takes away and OK shows."""
    steps = doc.UndoCount
    click(toolbar_button("Loads and Sizing").button)
    check("a click opens the panel", wait_until(lambda: sizing_panel() is not None, 20))
    check("the solid is still shown", box.Visibility)
    check("what is held is picked at once", wait_until(part("AddHeld").isChecked))
    answer_panel("Cancel")
    check("the panel closes", wait_until(lambda: sizing_panel() is None, 10))
    check("Cancel takes the lattice away", doc.Objects == [box] and box.Visibility)
    check("without a step", doc.UndoCount == steps)
    click(toolbar_button("Loads and Sizing").button)
    wait_until(lambda: sizing_panel() is not None and part("AddHeld").isChecked())
    obj = infills(doc)[0]
    loads = part("Loads", QtGui.QListWidget)
    click_alike((20, 0, 10), lambda: loads.count() == 1)
    held = next(one for one in doc.Objects if one.TypeId == "Fem::ConstraintFixed")
    check("with Ctrl the face opposite is held, too", held.References[0][1] == ("Face3", "Face4"))
    click(part("AddForce"))
    click_in_view((20, 15, 20), lambda: loads.count() == 2)
    click(part("Prove"))
    answer_panel("OK")
    check("a material is asked for", wait_until(lambda: "aterial" in part("Said").text()))
    picture("solid_1_asked")
    choose("PrintMaterial", "AlSi10Mg", lambda: obj.PrintMaterial)
    answer_panel("OK")
    check("a report opens", wait_until(lambda: len(reports()) == 1, 90))
    reports()[0].close()
    settle(MINUTES)
    check("the lattice is up to date", obj.Status == "Up to date", obj.Status)
    shown = obj.Visibility, box.Visibility
    check("and shown in place of the solid", shown == (True, False), shown)
    picture("solid_2_sized")


@slow
def open_and_size_the_bracket():
    """From File > Open of the GE bracket to the report of its sized lattice: clicks, and seconds.

    Four bolt holes hold it, the lug's two eyes are pulled: a click with Ctrl takes all alike.
    """
    if not PARTS.is_dir():
        print(f"open_and_size_the_bracket is skipped: {NO_PARTS}", flush=True)
        return
    clicks.clear()
    stops = Standstills()
    answer_file_dialog(PARTS / "ge_bracket.step", "bracket_0_open")
    begun = time.monotonic()
    click_menu("File", "Open...")
    clicks.append(1)  # at the dialog's Open, which Return presses here
    wait_until(lambda: App.ActiveDocument is not None and App.ActiveDocument.Objects)
    settle()
    doc = App.ActiveDocument
    base = next(obj for obj in doc.Objects if obj.isDerivedFrom("Part::Feature"))
    xdotool("key", "0")  # FreeCAD's isometric view, in which the bolt holes are seen
    click(toolbar_button("Loads and Sizing").button)
    check("a click opens the panel", wait_until(lambda: sizing_panel() is not None, 20))
    obj = infills(doc)[0]
    wait_until(part("AddHeld").isChecked)
    loads = part("Loads", QtGui.QListWidget)
    rows = lambda: [loads.item(k).text() for k in range(loads.count())]  # noqa: E731
    picture("bracket_1_panel")
    click_alike(seen_face(base, 2), lambda: rows() == ["Held: Face2, Face4, Face46, Face47"])
    picture("bracket_2_held")
    click(part("AddForce"))
    click_alike(seen_face(base, 30), lambda: len(rows()) == 2)
    xdotool("type", "8000")
    check("both eyes are pulled", wait_until(
        lambda: rows()[1] == "Force 8,000 N, -Z: Face30, Face39"), rows())  # fmt: skip
    picture("bracket_3_loaded")
    choose("PrintMaterial", "Ti-6Al-4V", lambda: obj.PrintMaterial)
    stops.tell("from the file to the loads")
    start_answer("OK")
    check("a report opens", wait_until(lambda: len(reports()) == 1, MINUTES))
    stops.tell("while it was sized")
    figures["clicks from File > Open to the report"] = len(clicks)
    figures["seconds from File > Open to the report"] = round(time.monotonic() - begun, 1)
    shoot("bracket_4_report")  # its mesh is still being made
    stops.tell("the report")
    check("its struts are sized", obj.RadiusGrading == "Field" and len(obj.SizedRadii) > 10)
    reports()[0].close()
    settle(MINUTES)
    stops.end()
    stops.tell("until its mesh was there")
    figures["seconds from File > Open to its mesh"] = round(time.monotonic() - begun, 1)
    print({k: v for k, v in figures.items() if "from File" in k}, flush=True)
    check("in ten clicks", len(clicks) <= 10, len(clicks))
    check("it is up to date", obj.Status == "Up to date", obj.Status)
    check("and shown in place of the solid", obj.Visibility and not base.Visibility)
    picture("bracket_5_mesh")


@costly
def end_what_is_made_ahead(doc, obj):
    """What a sizing is given ahead ends with its panel: by Cancel, or with the document."""
    from volfrep.process.engines import Engines

    begin, begun = Engines.begin, []

    def noted(self, call):
        begun.append((getattr(call.function, "__name__", ""), begin(self, call)))
        return begun[-1][1]

    ahead = lambda: [one for name, one in begun if name == "prepare"]  # noqa: E731
    Engines.begin = noted
    try:
        for end in (lambda: answer_panel("Cancel"), lambda: App.closeDocument(doc.Name)):
            begun.clear()
            obj.CellSize = obj.CellSize.Value + 1.0  # nothing of it is kept
            open_panel(obj)
            check("it is begun", wait_until(ahead), begun)
            end()
            check("it is ended", wait_until(lambda: ahead()[0].is_cancelled))
            check("and over", wait_until(lambda: ahead()[0].wait(0.0)))
            check("the panel is gone", wait_until(lambda: sizing_panel() is None))
    finally:
        Engines.begin = begin


def make_more_cases(doc, obj):
    """Another case is held alike; pressure, weight, directions; removed and cancelled."""
    before, steps = [one.Name for one in doc.Objects], doc.UndoCount
    size = [getattr(obj.Base, name).Value for name in ("Length", "Width", "Height")]
    top, front = (0.5 * size[0], 0.5 * size[1], size[2]), (0.5 * size[0], 0.0, 0.5 * size[2])
    open_panel(obj)
    loads, cases = part("Loads", QtGui.QListWidget), part("Cases", QtGui.QListWidget)
    rows = lambda: [loads.item(k).text() for k in range(loads.count())]  # noqa: E731
    click(part("Size"))
    check(
        "without a case it says what to do", wait_until(lambda: "load case" in part("Said").text())
    )
    check("and picks no more", wait_until(lambda: not part("AddHeld").isChecked()))
    click(part("AddHeld"))
    wait_until(part("AddHeld").isChecked)
    click_in_view(front, lambda: len(rows()) == 1)
    click(part("AddPressure"))
    check("the next thing is said", wait_until(lambda: "under pressure" in part("Hint").text()))
    click_in_view(top, lambda: rows()[1:] == ["Pressure 1 MPa: Face6"])
    click(part("NewCase"))
    check("another case is held alike", wait_until(lambda: rows() == ["Held: Face3"]), rows())
    click(part("AddWeight"))
    check("the weight is one click", wait_until(lambda: rows()[1:] == ["Weight"]), rows())
    click(part("AddForce"))
    wait_until(part("AddForce").isChecked)
    click_in_view(top, lambda: len(rows()) == 3)
    direction = part("LoadDirection", QtGui.QComboBox)
    for name, row in (("into the face", "into the face"), ("+X", "+X")):
        direction.setCurrentIndex(direction.findData(name))
        wanted = f"Force 100 N, {row}: Face6"
        goes = wait_until(lambda wanted=wanted: rows()[2:] == [wanted])
        check(f"a force goes {name}", goes, rows())
    picture("loads_5_cases")
    click(part("RemoveLoad"))
    check("what is chosen is removed", wait_until(lambda: len(rows()) == 2), rows())
    check("both are ticked", [cases.item(k).checkState() for k in range(2)]
          == [QtCore.Qt.Checked] * 2)  # fmt: skip
    answer_panel("Cancel")
    check("the panel closes", wait_until(lambda: sizing_panel() is None))
    settle()
    gone = wait_until(lambda: [one.Name for one in doc.Objects] == before)
    check("Cancel takes the cases away", gone, [one.Name for one in doc.Objects])
    check("without a step", doc.UndoCount == steps)
    shown = wait_until(lambda: obj.Visibility and not obj.Base.Visibility)
    check("and shows the infill", shown)


@costly
def warm_by_clicks(doc, obj):
    """A face is cooled, another heated, by clicks: temperatures in colours, told, kept, undone."""
    before, steps = [one.Name for one in doc.Objects], doc.UndoCount
    size = [getattr(obj.Base, name).Value for name in ("Length", "Width", "Height")]
    top, front = (0.5 * size[0], 0.5 * size[1], size[2]), (0.5 * size[0], 0.0, 0.5 * size[2])
    obj.PrintMaterial = "AlSi10Mg"
    open_panel(obj)
    loads = part("Loads", QtGui.QListWidget)
    rows = lambda: [loads.item(k).text() for k in range(loads.count())]  # noqa: E731
    check("heat is asked for where there is some", not part("SolveHeat").isVisible())
    click(part("AddTemperature"))
    click_in_view(front, lambda: rows() == ["Temperature 20 \u00b0C: Face3"])
    click(part("AddHeat flow"))
    click_in_view(top, lambda: len(rows()) == 2)
    xdotool("type", "5")
    check("a heat flow is typed in at once", wait_until(
        lambda: rows()[1] == "Heat flow 5 W: Face6"), rows())  # fmt: skip
    check("then it is", part("SolveHeat").isVisible())
    picture("heat_1_rows")
    said = part("HeatSaid")
    answer_panel("OK")
    check("a conductivity is asked for", wait_until(lambda: "onductivity" in said.text()))
    click(part("Conductivity"))
    xdotool("key", "ctrl+a")
    xdotool("type", "120")
    xdotool("key", "Tab")
    click(part("SolveHeat"))
    told = wait_until(lambda: said.text().startswith("Temperatures are 20 to "), 60)
    check("it is solved", told, said.text())
    figures["said of the heat"] = said.text()
    check("colours open", wait_until(lambda: dock() is not None))
    check("of temperatures", dock().findChild(QtGui.QComboBox, "Quantity").currentText()
          == "Temperature")  # fmt: skip
    check("with a legend", wait_until(lambda: "VolfrepLegend" in scene_names(), 60))
    high = dock().findChild(QtGui.QDoubleSpinBox, "To")
    check("whose scale is what was told", wait_until(
        lambda: f"to {high.value():.4g}" in said.text()), (high.value(), said.text()))  # fmt: skip
    settle()
    picture("heat_2_solved")
    figures["shades of the heat"] = shades("heat_2_solved", view_3d())
    check("in colours", figures["shades of the heat"] > 150, figures["shades of the heat"])
    pointed = dock().findChild(QtGui.QLabel, "Said")
    move_mouse(view_3d().mapToGlobal(view_3d().rect().center()))
    read = wait_until(lambda: pointed.text().endswith("\u00b0C under the mouse"))
    check("the mouse reads degrees", read, pointed.text())
    answer_panel("OK")
    check("the panel closes", wait_until(lambda: sizing_panel() is None, 90))
    check("and a report opens", wait_until(lambda: len(reports()) == 1, 60))
    shown = reports()[0].text.toPlainText()
    check("it has the resistance", "thermal resistance, K/W" in shown, shown)
    picture("heat_3_report")
    reports()[0].close()
    settle()
    kept = sorted({one.TypeId for one in doc.Objects if one.isDerivedFrom("Fem::Constraint")})
    check("the document has the rows", kept == ["Fem::ConstraintTemperature"], kept)
    check("the lattice is the same", not len(obj.SizedRadii) and obj.Status == "Up to date")
    dock().close()
    while doc.UndoCount > steps:
        doc.undo()
    check("undo takes the rows back", [one.Name for one in doc.Objects] == before)
    check("and the colours", obj.ViewObject.ColourBy == "None", obj.ViewObject.ColourBy)


def without_an_analysis(doc, obj):
    """Where nothing says what the part carries, Strut Results says so and changes nothing."""
    for analysis in [one for one in doc.Objects if one.isDerivedFrom("Fem::FemAnalysis")]:
        for member in analysis.Group:
            doc.removeObject(member.Name)
        doc.removeObject(analysis.Name)
    steps = doc.UndoCount
    for name in ("Strut Results",):
        select(obj)
        click(toolbar_button(name))
        check(f"{name} opens nothing", sizing_panel() is None and dock() is None)
    check("no step either", doc.UndoCount == steps and not doc.HasPendingTransaction)
    check("the infill is shown", obj.ViewObject.Visibility)


def close_the_document(doc, obj):
    """What is shown goes with its document, and with its object."""
    select(obj)
    click(toolbar_button("Strut Results"))
    check("a click opens it", wait_until(lambda: dock() is not None, 60))
    App.closeDocument(doc.Name)
    check("it goes with the document", wait_until(lambda: dock() is None, 10))


run_checks(
    "sizing",
    {
        size_and_take: loaded,
        size_as_printed: loaded,
        size_for_printing: fcc,
        size_a_network: network,
        cancel_the_panel: loaded,
        escape_keeps_the_best: lambda: loaded((120, 40, 40)),
        show_results: loaded,
        size_the_skin: lambda: loaded(ShellThickness=1),
        load_by_clicks: filled,
        size_a_solid: boxed,
        open_and_size_the_bracket: None,
        end_what_is_made_ahead: filled,
        make_more_cases: filled,
        warm_by_clicks: filled,
        without_an_analysis: loaded,
        close_the_document: loaded,
    },
)

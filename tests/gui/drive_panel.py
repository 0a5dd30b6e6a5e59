# SPDX-License-Identifier: LGPL-2.1-or-later
"""The task panel's sections, keys, sums, recipes, print figures and curve; why commands are greyed.

In the real FreeCAD window; see tools/run_gui.sh. Leaves with 0 when every check held.
"""

import sys
import threading
from itertools import pairwise
from pathlib import Path

import FreeCAD as App
import FreeCADGui as Gui
import Import
import Part
from PySide import QtCore, QtGui

sys.path.insert(0, str(Path(__file__).resolve().parent))
from driving import (
    PATIENCE,
    Standstills,
    check,
    choose_lattice,
    click,
    costly,
    figures,
    fold_sections,
    in_sight,
    move_mouse,
    panel,
    panel_part,
    picture,
    previews,
    run_checks,
    select,
    settle,
    slow,
    told,
    toolbar_button,
    type_value,
    wait,
    wait_until,
    when_dialog,
    window,
    xdotool,
)
from new_infill import boxed, cancelled, opened

from bench.parts import NO_PARTS, PARTS


def section(name):
    """The title of a section."""
    return panel_part(f"Section {name}", QtGui.QToolButton)


def choose(name, value):
    """An entry of a list of the panel: a click opens it, keys choose."""
    choice = panel_part(name, QtGui.QComboBox)
    wanted = choice.findData(value)
    click(choice)
    wait_until(lambda: choice.view().isVisible())
    xdotool("key", "Home")
    wait_until(lambda: choice.view().currentIndex().row() == 0)
    for row in range(wanted):
        xdotool("key", "Down")
        wait_until(lambda row=row: choice.view().currentIndex().row() == row + 1)
    xdotool("key", "Return")
    wait_until(lambda: not choice.view().isVisible() and choice.currentIndex() == wanted)
    settle()


def see_why_commands_are_grey(doc, box):
    """The tip of every greyed command says what it needs; that of others does not."""
    from freecad_volfrep.gui.commands.table import COMMANDS, PARTS

    select()
    names = [name for _, names in PARTS for name in names]
    greyed = [name for name in names if not COMMANDS[name].IsActive()]
    figures["greyed without a selection"] = len(greyed)
    for name in names:
        button, why = toolbar_button(COMMANDS[name].text), COMMANDS[name].why_not()
        tip, status = button.toolTip(), button.statusTip()
        if name in greyed:
            check(f"{name} says why", why and why in tip and why in status, (why, tip, status))
        else:
            check(f"{name} says nothing", "\u2192" not in tip + status, tip)
    entry = toolbar_button("Colour By")
    check("a drop-down of none that can be used is grey", not entry.button.isEnabled())
    check("and one of another's is not", toolbar_button("Cell Library").button.isEnabled())
    picture("toolbar")
    select(box)
    check("no more once it is there", "\u2192" not in toolbar_button("Lattice Infill").toolTip())
    for label, faces, word in (("Sheet", 5, "open surface"), ("Hull", 6, "closed surface")):
        surface = doc.addObject("Part::Feature", label)
        surface.Shape = Part.makeShell(box.Shape.Faces[:faces])
        doc.recompute()
        select(surface)
        for text in ("Lattice Infill", "Slicer Infill", "Build Direction", "Loads and Sizing"):
            button, named = toolbar_button(text), f"'{label}'"
            # FreeCAD asks its commands anew now and then: a tip follows the selection by that.
            told = wait_until(lambda button=button, named=named: named in button.toolTip())
            tip = button.toolTip()
            check(f"{text} says what is wrong with {label}", told and word in tip, tip)


@slow
def fold_and_find_it_so(doc, box):
    """Sections fold, by mouse and keys, and are found so again; all of them fit a small screen."""
    fold_sections()
    opened(box)
    picture("panel_first_seen")
    in_sight(section("Lattice"))
    check("what is seldom wanted is folded", not panel_part("Boundary").isVisible())
    click(section("Boundary"))
    check("a click opens it", panel_part("Boundary").isVisible())
    click(section("Lattice"))
    check("another click folds", not panel_part("CellSize").isVisible())
    xdotool("key", "space")
    check("a key opens it", wait_until(lambda: panel_part("CellSize").isVisible()))
    xdotool("key", "space")
    check("or folds it", wait_until(lambda: not panel_part("CellSize").isVisible()))
    cancelled()
    opened(box)
    check("opened stays open", panel_part("Boundary").isVisible())
    check("folded stays folded", not panel_part("CellSize").isVisible())
    for title in panel().findChildren(QtGui.QToolButton):
        if title.objectName().startswith("Section ") and title.isVisible() and title.isChecked():
            click(title)
    area = next(a for a in Gui.getMainWindow().findChildren(QtGui.QScrollArea)
                if a.isAncestorOf(panel()))  # fmt: skip
    figures["height of the panel, all folded, and its room"] = panel().height(), area.height()
    check("all folded it fits 900 pixels' height", wait_until(
        lambda: panel().height() <= area.height() <= 900))  # fmt: skip
    picture("panel_folded")
    cancelled()


def go_by_keys(doc, box):
    """Tab reaches every field from the top down, each with a name; Alt and a letter press."""
    opened(box)
    inside = QtGui.QApplication.focusWidget
    check("it begins at the cells", wait_until(lambda: inside() is panel_part("CellType")))
    seen, order = [], []
    for _ in range(80):
        before = inside()
        xdotool("key", "Tab")
        wait_until(lambda before=before: inside() is not before)
        now = inside()
        if not panel().isAncestorOf(now) or now in seen:
            break
        seen.append(now)
        order.append(now.mapTo(panel(), QtCore.QPoint(0, 0)).y())
        name = now.accessibleName() or (now.text() if hasattr(now, "text") else "")
        check("what Tab reaches has a name", bool(name), (now.objectName(), type(now).__name__))
    figures["fields that Tab reaches"] = len(seen)
    for name in ("CellSize", "StrutRadius", "ShellThickness", "Activation", "PrintProcess"):
        field = panel_part(name)
        hit = any(w is field or field.isAncestorOf(w) for w in seen)
        check(f"Tab reaches {name}", hit)
        check(f"{name} is called something", bool(field.accessibleName()))
    check("from the top down", all(a <= b + 12 for a, b in pairwise(order)), order)
    cells = panel_part("Cells", QtGui.QCheckBox)
    letter = cells.text().partition("&")[2][:1].lower()
    check("a letter is underlined", bool(letter), cells.text())
    xdotool("key", f"alt+{letter}")
    check("Alt and it tick the box", wait_until(cells.isChecked))
    wait_until(cells.hasFocus)
    xdotool("key", "space")
    check("Space takes the mark away", wait_until(lambda: not cells.isChecked()))
    cancelled()


def type_a_sum(doc, box):
    """Sums with units are taken as they are typed; what is no value is said."""
    obj = opened(box)
    for text, value in (("2mm+3mm", 5.0), ("1 cm - 2 mm", 8.0), ("3+4", 7.0), ("6 mm", 6.0)):
        type_value("CellSize", text)
        check(f"{text} is {value:g} mm", wait_until(
            lambda value=value: abs(obj.CellSize.Value - value) < 1e-9), obj.CellSize)  # fmt: skip
    type_value("CellSize", "7 abc")
    text = told()
    check("what is no value is said", "7 abc" in text, text)
    picture("panel_no_value")
    type_value("CellSize", "8 mm")
    check("until the next one", "cells" in told())
    type_value("CellSize", "1000 mm")
    type_value("StrutRadius", "1 mm")
    text = told()
    check("cells that are too large are called so", text.startswith("Cells of 1000 mm"), text)
    cancelled()


@slow
def start_from_a_recipe(doc, box):
    """A shipped recipe sets the fields; settings are saved under a name, and applied elsewhere."""
    from freecad_volfrep.features.infill.recipes import known_recipes, recipe_folder

    for file in recipe_folder().glob("*.toml"):
        file.unlink()
    obj = opened(box)
    choose("Recipe", str(known_recipes()["light-bracket-lpbf"]))
    wait_until(lambda: obj.CellType == "FCCz")
    settle()
    check("the properties are the recipe's", (obj.CellSize.Value, obj.DrainCount) == (5.0, 2))
    check("so are the fields", abs(panel_part("StrutRadius").property("rawValue") - 0.4) < 1e-9)
    check("and the cell", panel_part("CellType").currentItem().text() == "FCCz")
    choose("PrintProcess", "LPBF")
    check("LPBF takes it", "\u26a0" not in panel_part("PrintFigures").text(),
          panel_part("PrintFigures").text())  # fmt: skip
    picture("panel_recipe")
    type_value("StrutRadius", "0.45 mm")

    def answer(dialog):
        xdotool("windowfocus", int(dialog.winId()))
        edit = dialog.findChild(QtGui.QLineEdit)
        wait_until(edit.hasFocus)
        xdotool("type", "My bracket")
        wait_until(lambda: edit.text() == "My bracket")
        xdotool("key", "Return")

    when_dialog(QtGui.QInputDialog, answer)
    click(panel_part("SaveRecipe"))
    file = recipe_folder() / "My bracket.toml"
    check("it is saved", wait_until(file.exists))
    settle()
    check("and in the list", panel_part("Recipe").currentText() == "My bracket")
    cancelled()
    obj = opened(box)
    choose("Recipe", str(file))
    check("and applied to another infill", wait_until(
        lambda: obj.CellType == "FCCz" and abs(obj.StrutRadius.Value - 0.45) < 1e-9))  # fmt: skip
    choose("Recipe", str(known_recipes()["heat-sink"]))
    wait_until(lambda: obj.CellType == "Gyroid")
    settle()
    style = panel_part("Figures").styleSheet()
    check("that walls have no preview is no fault", "color" not in style, style)
    picture("panel_heat_sink")
    file.unlink()
    cancelled()


@slow
def see_what_the_printer_minds(doc, box):
    """Figures against the process, red where it does not take them; the mesh's once computed."""
    obj = opened(box)
    type_value("CellSize", "10 mm")
    type_value("StrutRadius", "0.5 mm")
    text = panel_part("PrintFigures", QtGui.QLabel).text
    check("without a process no limits", "at least" not in text() and "Choose" in text(), text())
    choose("PrintProcess", "FFF")
    check("thin struts are marked", "thinnest strut: <span" in text(), text())
    check("with the limit", "at least 2" in text(), text())
    choose("PrintProcess", "SLS")
    check("trapped powder is marked", "closed voids: <span" in text(), text())
    check("no cost without a price", "cost" not in text(), text())
    type_value("MaterialPrice", "60")
    check("a cost with one", wait_until(lambda: "cost of the material" in text()), text())
    in_sight(panel_part("PrintFigures"))
    picture("panel_print")
    click(panel_part("Compute"))
    wait_until(lambda: obj.Mesh.CountFacets > 0)
    settle()
    check("the mesh's own void", "closed voids: <span" in text() and "1, holding" in text(), text())
    cancelled()


@slow
def preview_a_real_part():
    """Kinds of lattice in the GE bracket: for how long the window stands still, and for what."""
    if not PARTS.is_dir():
        print(f"preview_a_real_part is skipped: {NO_PARTS}", flush=True)
        return
    App.newDocument("Real")
    Import.insert(str(PARTS / "ge_bracket.step"), "Real")
    Gui.SendMsgToActiveView("ViewFit")
    base = next(obj for obj in App.ActiveDocument.Objects if obj.isDerivedFrom("Part::Feature"))
    settle()
    stops = Standstills()
    obj = opened(base)
    stops.tell("the panel opens")
    for tab, kind in (("TPMS", "Gyroid"), ("Unit cells", "BCC"), ("Networks", "Voronoi")):
        choose_lattice(tab, kind)
        stops.tell(kind)
        check(f"{kind} is shown", "relative density" in told(), told())
        picture(f"panel_real_{kind}")
        stops.tell("its picture")
    choose_lattice("TPMS", "Gyroid")
    for size in ("12 mm", "11 mm"):
        type_value("CellSize", size)
        stops.tell(f"Gyroid of {size}")
    check("the figures are of the last", f"{obj.CellSize.Value:g}" == "11")
    stops.end()
    cancelled()


def go_on_while_a_preview_is_made(doc, box):
    """The window answers while the engine is at a preview; a later value drops the earlier."""
    from volfrep.jobs import preview as engine

    opened(box)
    before, made, go_on = told(), [], threading.Event()

    def wait_for_the_window(solid, spec, depth):
        made.append(spec.strut_radius)
        if len(made) == 1 and not go_on.wait(PATIENCE):
            raise AssertionError("the window stands still while a preview is made")
        depth.monitor.tick()
        return real(solid, spec, depth)

    real, engine.preview = engine.preview, wait_for_the_window
    try:
        panel_part("StrutRadius").setProperty("rawValue", 0.9)
        check("a preview begins", wait_until(lambda: made))
        check("figures of other values turn grey",
              wait_until(lambda: not panel_part("Figures").isEnabled()))  # fmt: skip
        check("which stay until it is there", told() == before)
        panel_part("StrutRadius").setProperty("rawValue", 1.3)
        wait(100)
        go_on.set()
        settle()
    finally:
        engine.preview = real
        go_on.set()
    check("the last value's is made after it", made[1:] == [1.3], made)
    check("and told", panel_part("Figures").isEnabled() and told() != before, told())
    cancelled()
    check("nothing is left in the view", previews() == 0, previews())


@costly
def drag_a_curve(doc, box):
    """A grading's curve by mouse and keys, beside its formula."""
    obj = opened(box)
    type_value("CellSize", "10 mm")
    choose("RadiusGrading", "Direction")
    fits = f"{0.8 * obj.StrutRadius.Value:g} + {0.4 * obj.StrutRadius.Value:g} * s"
    check("the formula begins with this radius", obj.RadiusFormula == fits, obj.RadiusFormula)
    obj.RadiusFormula = "0.8 + 0.4 * s"
    choose("RadiusProfile", "Formula")
    type_value("RadiusFormula", "0.8 + 0.4 * s + 0")
    curve = panel_part("Curve", QtGui.QWidget)
    curve = next(c for c in panel().findChildren(QtGui.QWidget, "Curve") if c.isVisible())
    in_sight(curve)
    check("the formula is drawn", len(curve._line) > 100 and not curve.points)
    shapes = curve.parentWidget().findChild(QtGui.QComboBox, "Shapes")
    click(shapes)
    wait_until(shapes.view().isVisible)
    xdotool("key", "Down", "Return")
    wait_until(lambda: shapes.currentIndex() == 1)
    check("a shape writes a formula", wait_until(
        lambda: obj.RadiusFormula == "through(s, 0, 0.8, 1, 1.2)"), obj.RadiusFormula)  # fmt: skip
    settle()
    in_sight(curve)
    place = curve.place_of(curve.points[1]).toPoint()
    move_mouse(curve.mapToGlobal(place))
    xdotool("mousedown", 1)
    wait_until(lambda: curve._dragged)
    move_mouse(curve.mapToGlobal(place + QtCore.QPoint(0, 30)))
    wait_until(lambda: curve.points[1][1] < 1.1)
    xdotool("mouseup", 1)
    wait_until(lambda: not curve._dragged)
    settle()
    dragged = curve.points[1][1]
    check("a point is dragged", 0.3 < dragged < 1.1, curve.points)
    check("the formula follows", obj.RadiusFormula == curve.formula, obj.RadiusFormula)
    check("and is in its field", panel_part("RadiusFormula").text() == curve.formula)
    middle_of_it = curve.place_of((0.5, 0.5)).toPoint()
    move_mouse(curve.mapToGlobal(middle_of_it))
    xdotool("click", "--repeat", 2, "--delay", 60, 1)
    check("a double click adds one", wait_until(lambda: len(curve.points) == 3), curve.points)
    xdotool("key", "Up")
    before = curve.points[1][1]
    check("a key moves it", wait_until(lambda: abs(curve.points[1][1] - before) > 0
                                       or curve.points[1][1] > 0.5), curve.points)  # fmt: skip
    settle()
    picture("panel_curve")
    xdotool("key", "Delete")
    check("a key takes it away", wait_until(lambda: len(curve.points) == 2), curve.points)
    settle()
    check("the lattice is graded so", "active cells" in told())
    cancelled()


def install_what_is_missing(doc, box):
    """Where packages are missing, a window installs them, or copies the command."""
    from freecad_volfrep import deps
    from freecad_volfrep.gui.commands import command
    from freecad_volfrep.gui.windows import install_window

    kept = command.missing_packages, install_window.install_arguments, install_window.find_installed
    says = "import sys; print('Collecting trimesh'); sys.exit(0)"
    command.missing_packages = lambda: ["trimesh"]
    install_window.install_arguments = lambda _: [deps.python_executable(), "-c", says]
    install_window.find_installed = lambda _: ([], True)
    try:
        select(box)
        click(toolbar_button("Lattice Infill"))
        check("a window opens", wait_until(lambda: window("VolfrepInstall") is not None))
        there = window("VolfrepInstall")
        picture("panel_install")
        click(there.findChild(QtGui.QPushButton, "Copy"))
        copied = QtGui.QApplication.clipboard().text
        check("the command is copied", wait_until(lambda: "--target" in copied()), copied())
        click(there.findChild(QtGui.QPushButton, "Install"))
        output = there.findChild(QtGui.QPlainTextEdit)
        check("what is said is shown", wait_until(
            lambda: "Collecting trimesh" in output.toPlainText()))  # fmt: skip
        said = there.findChild(QtGui.QLabel, "Said")
        check("and the end", wait_until(lambda: "restart FreeCAD" in said.text()), said.text())
        click(there.findChild(QtGui.QPushButton, "Close"))
        wait_until(lambda: window("VolfrepInstall") is None)
    finally:
        (command.missing_packages, install_window.install_arguments,
         install_window.find_installed) = kept  # fmt: skip


run_checks(
    "panel",
    {
        see_why_commands_are_grey: boxed,
        fold_and_find_it_so: boxed,
        go_by_keys: boxed,
        type_a_sum: boxed,
        start_from_a_recipe: boxed,
        see_what_the_printer_minds: boxed,
        go_on_while_a_preview_is_made: boxed,
        preview_a_real_part: None,
        drag_a_curve: boxed,
        install_what_is_missing: boxed,
    },
)

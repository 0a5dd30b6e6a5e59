# SPDX-License-Identifier: LGPL-2.1-or-later
"""A mesh that is out of date: what uses it asks first, and it shows skin and lattice as before.

In the real FreeCAD window; see tools/run_gui.sh. Leaves with 0 when every check held.
"""

import sys
from pathlib import Path

import FreeCAD as App
import FreeCADGui as Gui
import numpy as np
from PySide import QtGui

sys.path.insert(0, str(Path(__file__).resolve().parent))
from driving import (
    OUT,
    answer_file_dialog,
    answer_panel,
    check,
    click,
    click_in_tree,
    click_menu,
    costly,
    figures,
    look_at_all,
    panel,
    picture,
    run_checks,
    section_docks,
    select,
    settle,
    slow,
    start_by_click,
    toolbar_button,
    type_value,
    wait_until,
    when_dialog,
    xdotool,
)
from new_infill import filled


def reports():
    """The windows with a report that are open."""
    from freecad_volfrep.gui.windows.report_window import ReportWindow

    found = Gui.getMainWindow().findChildren(ReportWindow)
    return [window for window in found if window.isVisible()]


def answered(command, button):
    """Click a command, and that button of the box that comes; what the box says and offers."""
    told = []

    def answer(box):
        told.append((box.text(), [one.text().replace("&", "") for one in box.buttons()]))
        (wanted,) = (b for b in box.buttons() if b.text().replace("&", "") == button)
        start_by_click(wanted)

    watch = when_dialog(QtGui.QMessageBox, answer)
    start_by_click(toolbar_button(command))
    wait_until(lambda: told)
    settle()
    watch.stop()
    return told[0]


@costly
def a_stale_mesh_is_asked_about():
    doc, _, obj = filled("Stale")
    before = obj.Triangles
    obj.AutoUpdate, obj.StrutRadius = False, 1.5
    doc.recompute()
    select(obj)
    text, offered = answered("Check Mesh", "Cancel")
    check("it says why", "out of date" in text and "values or the solid" in text, text)
    check("all answers are there", len(offered) == 3, offered)
    check("Cancel does nothing", not reports() and obj.Triangles == before)
    answered("Check Mesh", "Use it as it is")
    check("as it is: it is checked", wait_until(reports))
    check("and nothing recomputed", obj.Triangles == before)
    for window in reports():
        window.close()
    _, offered = answered("Print Check", "Cancel")
    check("what needs the values is not done as it is", len(offered) == 2, offered)
    answered("Check Mesh", "Recompute first")
    check("recomputed: it is checked", wait_until(reports))
    check("with the new mesh", obj.Status == "Up to date" and obj.Triangles != before, obj.Status)
    for window in reports():
        window.close()
    select(obj)
    start_by_click(toolbar_button("Check Mesh"))
    check("a fresh one is not asked about", wait_until(reports))
    for window in reports():
        window.close()


def stale_bar():
    """The bar over the view that says what is out of date, or None."""
    found = Gui.getMainWindow().findChildren(QtGui.QFrame, "VolfrepStaleBar")
    return next((bar for bar in found if bar.isVisible()), None)


def one_click_updates_what_is_stale():
    """The view says that a mesh is out of date, with a button that makes it anew."""
    doc, _, obj = filled("Outdated")
    check("nothing is said of a fresh mesh", stale_bar() is None)
    before = obj.Triangles
    obj.AutoUpdate, obj.StrutRadius = False, 1.4
    doc.recompute()
    check("the view says it", wait_until(lambda: stale_bar() is not None))
    said = stale_bar().findChild(QtGui.QLabel).text()
    check("of which lattice", said == f"{obj.Label} is out of date", said)
    picture("stale_bar")
    obj.Visibility = False
    settle()
    check("not of one that is hidden", stale_bar() is None)
    obj.Visibility = True
    settle()
    click(stale_bar().findChild(QtGui.QPushButton, "Update"))
    wait_until(lambda: obj.Status == "Up to date")
    settle()
    check("one click makes the mesh", obj.Triangles != before, obj.Triangles)
    check("and the bar goes", stale_bar() is None)
    picture("stale_bar_gone")


@costly
def a_mesh_that_comes_is_waited_for():
    """A command that needs the mesh of values that are being computed comes after them, unasked."""
    _, _, obj = filled("Coming")
    before = obj.Triangles
    click_in_tree(obj.Label)
    xdotool("click", "--repeat", 2, "--delay", 60, 1)
    wait_until(lambda: panel() is not None)
    type_value("CellSize", "5")
    type_value("StrutRadius", "0.5")
    buttons = Gui.getMainWindow().findChildren(QtGui.QPushButton)
    start_by_click(next(b for b in buttons if b.isVisible() and b.text().replace("&", "") == "OK"))
    wait_until(lambda: panel() is None)
    Gui.Selection.clearSelection()
    Gui.Selection.addSelection(obj)
    entry = toolbar_button("Check Mesh")
    wait_until(entry.isEnabled)
    check("it is still being made", obj.Proxy.job.is_under_way)
    start_by_click(entry)
    check("nothing is asked", QtGui.QApplication.activeModalWidget() is None)
    check("it comes with the mesh", wait_until(reports) and obj.Triangles != before)
    check("that is up to date", obj.Status == "Up to date", obj.Status)
    for window in reports():
        window.close()


@slow
def an_undone_mesh_keeps_the_colour_of_its_wall():
    from freecad_volfrep.gui.view.filled_view import mesh_and_kinds
    from volfrep.reports.facet_roles import LATTICE, WALL

    doc, _, obj = filled("Undone")
    shares = [(mesh_and_kinds(obj)[1] == kind).sum() for kind in (WALL, LATTICE)]
    doc.openTransaction("Thicker")
    obj.StrutRadius = 1.5
    doc.recompute()
    doc.commitTransaction()
    doc.undo()
    obj.AutoUpdate, obj.StrutRadius = False, 1.4
    doc.recompute()
    settle()
    after = [(mesh_and_kinds(obj)[1] == kind).sum() for kind in (WALL, LATTICE)]
    picture("undone")
    check("its icon is the stale one", "stale" in obj.ViewObject.Proxy.getIcon(), obj.Status)
    check("the wall is the wall", abs(after[0] - shares[0]) < 0.02 * shares[0], (shares, after))
    obj.Visibility = False
    settle()
    check("hidden, the icon says it still", "stale" in obj.ViewObject.Proxy.getIcon())
    obj.Visibility = obj.AutoUpdate = True
    doc.recompute()
    check("a recompute takes the sign away", "stale" not in obj.ViewObject.Proxy.getIcon())
    check("the lattice is the lattice", abs(after[1] - shares[1]) < 0.02 * shares[1], after)


def colours_dock():
    """The dock of Colour By, or None."""
    found = Gui.getMainWindow().findChildren(QtGui.QDockWidget, "VolfrepColourBy")
    return next((dock for dock in found if dock.isVisible()), None)


def cut_and_coloured(obj):
    """Cut open and coloured by overhangs, by clicks, and looked at."""
    click_in_tree(obj.Label)
    click(toolbar_button("Colour By"))
    wait_until(lambda: colours_dock() is not None)
    if obj.ViewObject.ColourBy != "Overhang":
        quantity = colours_dock().findChild(QtGui.QComboBox, "Quantity")
        wanted = quantity.findData("Overhang")
        click(quantity)
        wait_until(lambda: quantity.view().isVisible())
        xdotool("type", "Over")
        wait_until(lambda: quantity.view().currentIndex().row() == wanted)
        xdotool("key", "Return")
        wait_until(lambda: obj.ViewObject.ColourBy == "Overhang")
    click(toolbar_button("Section View"))
    wait_until(section_docks)


def looks(obj, name, camera):
    """The picture of the window, and the view alone from a camera, with nothing selected."""
    Gui.Selection.clearSelection()
    wait_until(lambda: obj.ViewObject.Proxy.colouring.range is not None)
    picture(name)
    # Of one size, whatever room docks and messages leave the view.
    view = Gui.activeDocument().activeView()
    view.setCamera(camera)
    path = str(OUT / f"{name}_view.png")
    view.saveImage(path, 900, 600, "White")
    image = QtGui.QImage(path).convertToFormat(QtGui.QImage.Format_RGB32)
    return np.frombuffer(image.constBits(), np.uint8).reshape(600, 900, 4)[:, :, :3].astype(int)


def apart(one, other):
    """Share of the pixels of two looks that differ; the background is the most of them."""
    return float((np.abs(one - other).max(axis=2) > 24).mean())


def by_menu(menu, command):
    """Click a command in FreeCAD's menu, under whatever name this FreeCAD gives it."""
    click_menu(menu, Gui.Command.get(command).getInfo()["menuText"].replace("&", ""))


@slow
def its_looks_outlive_undo_and_a_file():
    """Cut open and coloured, undone, refreshed, saved, closed and opened: it looks the same."""
    from freecad_volfrep.gui.view.filled_view import mesh_and_kinds

    _, _, obj = filled("Looked at")
    cut_and_coloured(obj)
    look_at_all()
    camera = Gui.activeDocument().activeView().getCamera()
    before, facets, name = looks(obj, "fresh_before", camera), obj.Mesh.CountFacets, obj.Name
    kinds = np.bincount(mesh_and_kinds(obj)[1], minlength=3)

    click_in_tree(obj.Label)
    xdotool("click", "--repeat", 2, "--delay", 60, 1)
    wait_until(lambda: panel() is not None)
    type_value("StrutRadius", "1.6")
    answer_panel("OK")
    wait_until(lambda: panel() is None and obj.Mesh.CountFacets != facets)
    thick = looks(obj, "fresh_thick", camera)
    figures["thicker"] = apart(before, thick)
    check("thicker struts look otherwise", figures["thicker"] > 0.02, figures["thicker"])

    by_menu("Edit", "Std_Undo")
    check("one step brings mesh and values back", wait_until(
        lambda: (obj.Mesh.CountFacets, obj.StrutRadius.Value) == (facets, 1.0)),
        (obj.Mesh.CountFacets, obj.StrutRadius))  # fmt: skip
    check("its state is told", obj.Status == "Up to date", obj.Status)
    check("and it has its colours", not obj.ViewObject.Proxy.colouring.why)
    undone = looks(obj, "fresh_undone", camera)
    figures["undone"] = apart(before, undone)
    check("undone it looks as before", figures["undone"] < 0.005, figures["undone"])
    by_menu("Edit", "Std_Refresh")
    again = looks(obj, "fresh_refreshed", camera)
    figures["refreshed"] = apart(before, again)
    check("and refreshed", figures["refreshed"] < 0.005, figures["refreshed"])
    check("it is up to date", obj.Status == "Up to date", obj.Status)
    check("and of the same mesh", obj.Mesh.CountFacets == facets, obj.Mesh.CountFacets)

    path = OUT / "fresh.FCStd"
    path.unlink(missing_ok=True)
    answer_file_dialog(path, "fresh_save")
    by_menu("File", "Std_SaveAs")
    check("it is saved", wait_until(path.exists))
    by_menu("File", "Std_CloseActiveWindow")
    check("and closed", wait_until(lambda: not App.listDocuments()), App.listDocuments())
    check("its docks went", colours_dock() is None and not section_docks())
    answer_file_dialog(path, "fresh_open")
    by_menu("File", "Std_Open")
    wait_until(lambda: App.ActiveDocument is not None and not App.ActiveDocument.Restoring)
    settle()
    obj = App.ActiveDocument.getObject(name)
    picture("fresh_opened")
    check("a file keeps what it is coloured by", obj.ViewObject.ColourBy == "Overhang")
    found = np.bincount(mesh_and_kinds(obj)[1], minlength=3)
    check("skin, wall and lattice are the same", np.abs(found - kinds).max() <= 0.01 * kinds.sum(),
          (kinds, found))  # fmt: skip
    cut_and_coloured(obj)
    opened = looks(obj, "fresh_opened_cut", camera)
    figures["opened"] = apart(before, opened)
    check("opened it looks as before", figures["opened"] < 0.005, figures["opened"])
    scale = colours_dock().findChild(QtGui.QDoubleSpinBox, "To")
    check("its scale can be set", wait_until(scale.isEnabled) and scale.value() == 90.0)
    check("nothing is missing", not obj.ViewObject.Proxy.colouring.why)
    by_menu("Edit", "Std_Refresh")
    check("it is up to date still", obj.Status == "Up to date", obj.Status)


run_checks(
    "fresh",
    {
        its_looks_outlive_undo_and_a_file: None,
        a_stale_mesh_is_asked_about: None,
        one_click_updates_what_is_stale: None,
        a_mesh_that_comes_is_waited_for: None,
        an_undone_mesh_keeps_the_colour_of_its_wall: None,
    },
)

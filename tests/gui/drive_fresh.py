# SPDX-License-Identifier: LGPL-2.1-or-later
"""A mesh that is out of date: what uses it asks first, and it shows skin and lattice as before.

In the real FreeCAD window; see tools/run_gui.sh. Leaves with 0 when every check held.
"""

import sys
from pathlib import Path

import FreeCADGui as Gui
from PySide import QtGui

sys.path.insert(0, str(Path(__file__).resolve().parent))
from driving import (
    check,
    picture,
    run_checks,
    select,
    settle,
    start_by_click,
    toolbar_button,
    wait_until,
    when_dialog,
)
from new_infill import filled


def reports():
    """The windows with a report that are open."""
    from freecad_volfrep.gui.report_window import ReportWindow

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


def an_undone_mesh_keeps_the_colour_of_its_wall():
    from freecad_volfrep.gui.filled_view import mesh_and_kinds
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


run_checks(
    "fresh",
    {
        a_stale_mesh_is_asked_about: None,
        an_undone_mesh_keeps_the_colour_of_its_wall: None,
    },
)

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Drives Design Study in the real FreeCAD with real clicks and keys; see tools/run_gui.sh.

Writes pictures and ``study.json`` to GUI_OUT and leaves with 0 when every check held.
"""

import sys
import time
from pathlib import Path

import FreeCADGui as Gui
from PySide import QtGui

sys.path.insert(0, str(Path(__file__).resolve().parent))
import new_infill
from driving import (
    answer_panel,
    check,
    choose_in_context_menu,
    click,
    click_in_tree,
    costly,
    figures,
    move_mouse,
    picture,
    press_button,
    previews,
    run_checks,
    select,
    settle,
    shades,
    slow,
    toolbar_button,
    wait_until,
    xdotool,
)


def filled():
    """A document with a box that has a lattice."""
    doc, _, infill = new_infill.filled("Study", CellType="CVC", ShellThickness=2)
    return doc, infill


def form():
    """The open panel of a study, or None."""
    found = Gui.getMainWindow().findChildren(QtGui.QWidget, "VolfrepStudyPanel")
    return next((widget for widget in found if widget.isVisible()), None)


def part(name):
    """A widget of the panel."""
    return form().findChild(QtGui.QWidget, name)


def type_into(name, text):
    """Really type over what is in a field of the panel."""
    click(part(name))
    xdotool("key", "ctrl+a")
    xdotool("type", text)
    wait_until(lambda: part(name).text() == text, 5)


def click_point(row):
    """Really click on a design's point of the plot."""
    plot = part("StudyPlot")
    move_mouse(plot.mapToGlobal(plot.place_of(row).toPoint()))
    press_button()
    settle()


def study_of(doc):
    """The document's study."""
    return doc.getObject("DesignStudy")


def rows_of(doc):
    """Its designs."""
    from freecad_volfrep.features.study.design_study import designs_of_study

    return designs_of_study(study_of(doc))


@costly
def study_an_infill(doc, infill):
    """Choose what varies, start, pick a point and apply it as one undo step."""
    select(infill)
    click(toolbar_button("Design Study"))
    check("the panel opens", wait_until(lambda: form() is not None, 10))
    check("the study is in the tree", study_of(doc) is not None)
    check("it suggests cells", "BCC" in part("Values1").text(), part("Values1").text())
    type_into("Values1", "BCC, CVC, Octet")
    type_into("Values2", "0.7 to 1.1 in 3")
    type_into("Values3", "1, 2")
    told = part("Count")
    check("it says how many designs", told.text().startswith("18 designs"), told.text())
    check("and how long they take", wait_until(lambda: "about" in told.text(), 10), told.text())
    expected = float(told.text().split("about ")[1].split()[0])
    start = time.monotonic()
    click(part("Start"))
    check(
        "designs come", wait_until(lambda: study_of(doc).Designs == 18, 120), study_of(doc).Status
    )
    figures["seconds told"], figures["seconds taken"] = expected, time.monotonic() - start
    settle()
    axes = [part(name).currentText() for name in ("Across", "Up")]
    words = ["expected mass, g", "stiffness along an edge, of the solid's"]
    check("the plot's axes are in words with units", axes == words, axes)
    picture("study")
    undo = doc.UndoCount
    (row,) = (
        r for r in rows_of(doc) if (r["cell"], r["strut_radius"], r["shell"]) == ("BCC", 0.9, 1.0)
    )
    check("nothing can be applied before a point is picked", not part("Apply").isEnabled())
    click_point(row)
    said = part("Picked").text()
    check(
        "the point's values are told",
        all(
            text in said for text in ("Cell type BCC", "Strut radius 0.9 mm", "Skin thickness 1 mm")
        ),
        said,
    )
    check("its picture is in the view", previews() == 1 and not infill.Visibility, previews())
    picture("study_picked")
    click(part("Apply"))
    wait_until(lambda: infill.CellType == "BCC", 60)
    settle()
    check("the infill has the design", infill.StrutRadius.Value == 0.9, infill.StrutRadius)
    check("all of it", infill.ShellThickness.Value == 1.0, infill.ShellThickness)
    check("which is shown again", previews() == 0 and infill.Visibility)
    check("and is computed", infill.isValid() and infill.Status == "Up to date", infill.Status)
    mass = infill.Mesh.Volume / 1000.0
    check("as heavy as was forecast", abs(mass / row["forecast.mass_g"] - 1.0) < 0.06, mass)
    check("that is one undo step", doc.UndoCount == undo + 1, doc.UndoNames)
    picture("study_applied")
    answer_panel("Close")
    check("the panel closes", wait_until(lambda: form() is None, 10))
    check("the command is there again", wait_until(lambda: not Gui.Control.activeDialog(), 5))
    doc.undo()
    settle()
    check("undo takes it back", infill.CellType == "CVC" and infill.StrutRadius.Value == 1.0)


@slow
def open_it_again(doc, infill):
    """A double click opens the study with its designs; so does the context menu."""
    from freecad_volfrep import make_design_study, run_study

    made = make_design_study(doc, infill, StrutRadius="0.8, 0.9, 1.0")
    run_study(made)
    doc.recompute()
    settle()
    click_in_tree(made.Label)
    xdotool("click", "--repeat", 2, "--delay", 60, 1)
    check("a double click opens it", wait_until(lambda: form() is not None, 10))
    check("with its values", part("Values1").text() == "0.8, 0.9, 1.0", part("Values1").text())
    check("its axes", part("Across").currentText() == "expected mass, g")
    click_point(rows_of(doc)[0])
    check("and its points", part("Apply").isEnabled())
    picture("study_again")
    check("the design is shown", previews() == 1 and not infill.Visibility)
    answer_panel("Close")
    wait_until(lambda: form() is None, 10)
    settle()
    check("and the infill after it", previews() == 0 and infill.Visibility)
    choose_in_context_menu(made, "VOLFREP", "Design Study")
    check("the context menu opens it", wait_until(lambda: form() is not None, 10))
    answer_panel("Close")
    check("and it closes", wait_until(lambda: form() is None, 10))


def tell_what_is_wrong(doc, infill):
    """A value without sense is told in the panel, and the study stays as it was."""
    select(infill)
    click(toolbar_button("Design Study"))
    wait_until(lambda: form() is not None, 10)
    said = part("StudyPlot").said_of_none
    check("an empty plot says what to do", said.startswith("Not run yet") and "Start" in said, said)
    picture("study_empty")
    is_blank = shades("study_empty", part("StudyPlot")) < 3
    check("it is drawn", not is_blank)
    check("there are no axes to choose", not part("Across").isEnabled())
    type_into("Values2", "a few")
    click(part("Start"))
    told = wait_until(lambda: "'a few' is no length" in part("Picked").text(), 10)
    check("what is wrong is told", told, part("Picked").text())
    check("nothing was run", study_of(doc).Designs == 0)
    answer_panel("Close")


run_checks(
    "study",
    {
        study_an_infill: filled,
        open_it_again: filled,
        tell_what_is_wrong: filled,
    },
)

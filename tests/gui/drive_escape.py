# SPDX-License-Identifier: LGPL-2.1-or-later
"""Escape at random times during every long command, in the real FreeCAD; see tools/run_gui.sh.

Each command is clicked once to the end and then ESCAPES times more (an environment variable; once
by default, ten times by ``make test-escape``; the seed is SEED), with a real Escape after a random
part of its time. FreeCAD has to be itself afterwards: nothing waits, no box is open, and the next
click is followed.
"""

import os
import random
import subprocess
import sys
import time
from pathlib import Path

import FreeCAD as App
import FreeCADGui as Gui
from PySide import QtCore, QtGui

sys.path.insert(0, str(Path(__file__).resolve().parent))
from driving import (
    answer_panel,
    check,
    click,
    click_menu,
    failures,
    figures,
    panel,
    picture,
    run,
    select,
    step,
    toolbar_button,
    wait,
    wait_until,
    xdotool,
)

#: Only commands whose names begin so, where it is set.
ONLY = os.environ.get("ONLY", "")
ESCAPES = int(os.environ.get("ESCAPES", "1"))
SEED = int(os.environ.get("SEED", "19"))
#: A cancel waits for the library call that runs: seconds until a command must have ended.
PATIENCE = 40


def drive():
    """The whole session."""
    figures["seed"] = SEED
    Gui.activateWorkbench("VolfrepWorkbench")
    wait(800)
    step(answer_freecads_own_box)
    obj = step(fill_a_bracket)
    doc = obj.Document
    radii = iter(0.8 + 0.01 * k for k in range(1, 10_000))

    def new_radius():
        obj.StrutRadius = next(radii)
        select(obj)

    escape("Check Mesh", lambda: select(obj), lambda: click(toolbar_button("Check Mesh")))
    obj.AutoUpdate = False
    escape("Update", new_radius, lambda: click(toolbar_button("Update Lattice Infill")))
    obj.AutoUpdate = True
    escape("Refresh", new_radius, lambda: click_menu("Edit", "Refresh"))
    obj.Proxy.update(obj)
    escape("Print Check", lambda: select(obj), lambda: click(toolbar_button("Print Check")))
    for made in [o for o in doc.Objects if o.Name.startswith("PrintCheck")]:
        doc.removeObject(made.Name)
    escape("panel", open_panel_of(obj, radii), lambda: answer_panel("OK"), leave_panel)
    obj.Proxy.update(obj)
    small = step(fill_a_small_box)
    for name, kind in (("exact solid", "exact"), ("instances", "link")):
        escape(
            name,
            lambda: select(small),
            lambda kind=kind: choose_after("Lattice To Solid", kind),
            take_away(small),
        )
    escape(
        "tetrahedra",
        lambda: select(small),
        lambda: choose_after("FEM Analysis", "tetrahedra"),
        take_away(small),
    )
    escape("example", lambda: None, lambda: click_menu("VOLFREP", "Examples", "Bracket"), close_new)


def fill_a_bracket():
    """The shipped example."""
    from freecad_volfrep.examples.filled import open_example

    return open_example("Bracket")


def fill_a_small_box():
    """Of exact joints that take seconds."""
    from freecad_volfrep import make_lattice_infill

    doc = App.newDocument("Small")
    box = doc.addObject("Part::Box", "Block")
    box.Length, box.Width, box.Height = 40, 30, 30
    obj = make_lattice_infill(doc, box, CellSize=10, StrutRadius=1, ShellThickness=0)
    doc.recompute()
    box.Visibility = False
    return obj


def bar():
    """Our line in the status bar, if a job runs."""
    return Gui.getMainWindow().findChild(QtGui.QWidget, "VolfrepProgress")


def is_itself():
    """Whether nothing of a job is left."""
    return (
        bar() is None
        and QtGui.QApplication.overrideCursor() is None
        and QtGui.QApplication.activeModalWidget() is None
        and QtGui.QApplication.activePopupWidget() is None
    )


def answers_a_click(name):
    """Really open a window of ours, and close it by its button."""
    click(toolbar_button("Cell Library"))

    def library():
        found = Gui.getMainWindow().findChildren(QtGui.QDialog, "VolfrepCellLibrary")
        return next((window for window in found if window.isVisible()), None)

    opened = wait_until(lambda: library() is not None, 10)
    check(f"{name}: the next click is followed", opened)
    if opened:
        click(library().findChild(QtGui.QPushButton, "Close"))
        wait_until(lambda: library() is None, 5)


def close_reports():
    """Windows that a command has opened."""
    for window in Gui.getMainWindow().findChildren(QtGui.QDialog, "VolfrepReport"):
        if window.isVisible():
            window.close()


def escape(name, prepare, act, tidy=lambda: None):
    """Run a command once, and then with Escape at random parts of its time."""
    if not name.startswith(ONLY):
        return
    chance = random.Random(f"{SEED} {name}")
    prepare()
    start = time.monotonic()
    act()
    wait_until(is_itself, PATIENCE)
    whole = max(time.monotonic() - start, 1.0)
    close_reports()
    tidy()
    moments, last = [], 0.0
    for _ in range(ESCAPES):
        prepare()
        moment = chance.uniform(0.0, 1.1) * whole
        moments.append(round(moment, 2))
        key = subprocess.Popen(["sh", "-c", f"sleep {moment:.3f}; exec xdotool key Escape"])
        start = time.monotonic()
        act()
        ended = wait_until(is_itself, PATIENCE)
        last = max(last, time.monotonic() - start - moment)
        key.wait(timeout=whole * 2 + 10)
        wait(300)
        check(f"{name}: it ends after Escape at {moment:.2f} s", ended and is_itself())
        if not ended:
            picture(f"escape_{name.replace(' ', '_')}")
        close_reports()
        tidy()
    figures[f"{name}: seconds without Escape"] = round(whole, 1)
    figures[f"{name}: Escape after seconds"] = moments
    figures[f"{name}: longest wait after Escape, s"] = round(last, 1)
    answers_a_click(name)
    report = Gui.getMainWindow().findChild(QtGui.QTextEdit, "Report view")
    if report is not None:
        said = report.toPlainText()
        check(f"{name}: no traceback", "Traceback" not in said, said[-2000:])
        check(f"{name}: no failed recompute", "ecompute failed" not in said, said[-2000:])
        report.clear()


def open_panel_of(obj, radii):
    """Opens the panel of an infill and types a radius."""

    def prepare():
        select(obj)
        click(toolbar_button("Edit Lattice Infill"))
        if not wait_until(lambda: panel() is not None, 20):
            failures.append("the panel does not open")
        obj.StrutRadius = next(radii)

    return prepare


def leave_panel():
    """Where the job was cancelled the panel is still open."""
    if panel() is not None:
        answer_panel("Cancel")
        wait_until(lambda: panel() is None, 20)
    wait_until(is_itself, PATIENCE)


def choose_after(button, kind):
    """Click a button, and pick from the list that opens by real keys."""
    done = []

    def answer():
        box = QtGui.QApplication.activeModalWidget()
        if done or not isinstance(box, QtGui.QInputDialog):
            return
        done.append(True)
        items = box.comboBoxItems()
        row = next(k for k, item in enumerate(items) if kind in item.lower())
        xdotool("windowfocus", int(box.winId()))
        wait(300)
        for _ in range(row):
            xdotool("key", "Down")
        wait(100)
        xdotool("key", "Return")

    timer = QtCore.QTimer(Gui.getMainWindow())
    timer.timeout.connect(answer)
    timer.start(300)
    click(toolbar_button(button))
    wait_until(is_itself, PATIENCE)
    timer.stop()


def take_away(obj):
    """Takes away what commands have made beside an infill."""
    kept = {o.Name for o in obj.Document.Objects}

    def tidy():
        for name in [o.Name for o in obj.Document.Objects if o.Name not in kept]:
            if obj.Document.getObject(name) is not None:
                obj.Document.removeObject(name)
        obj.Visibility = True

    return tidy


def close_new():
    """The examples' documents but the first."""
    for name in list(App.listDocuments()):
        if name.startswith("Bracket") and name != "Bracket":
            App.closeDocument(name)
    wait(300)


def answer_freecads_own_box():
    """While a job of ours is on FreeCAD asks whether to abort: the answer reaches it."""
    import Mesh

    from freecad_volfrep.features.progress import progress_of

    mesh = Mesh.createSphere(10.0, 300)
    boxes, timer = [], QtCore.QTimer(Gui.getMainWindow())

    def answer():
        box = QtGui.QApplication.activeModalWidget()
        if not isinstance(box, QtGui.QMessageBox):
            return
        boxes.append(box.text())
        if len(boxes) == 1:
            picture("escape_freecads_box")
        yes = box.button(QtGui.QMessageBox.Yes) or box.buttons()[0]
        place = yes.mapToGlobal(yes.rect().center())
        xdotool("mousemove", place.x(), place.y(), "click", 1)

    timer.timeout.connect(answer)
    timer.start(400)
    key = subprocess.Popen(["sh", "-c", "sleep 1; exec xdotool key Escape"])
    with progress_of("A job"):
        for _ in range(60):
            if boxes:
                break
            try:
                mesh.getSelfIntersections()
            except App.Base.FreeCADAbort:
                figures["FreeCAD's search ends as asked"] = True
    key.wait()
    timer.stop()
    check("FreeCAD has asked", boxes)
    check("and was answered by one click", 0 < len(boxes) <= 2, len(boxes))
    check("no box stays", QtGui.QApplication.activeModalWidget() is None)
    figures["FreeCAD asked"] = boxes[:1]


run(drive, "escape")

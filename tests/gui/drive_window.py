# SPDX-License-Identifier: LGPL-2.1-or-later
"""The window goes on while a mesh is made, in the real FreeCAD; see tools/run_gui.sh."""

import itertools
import os
import signal
import sys
import time
from contextlib import contextmanager
from pathlib import Path

import FreeCAD as App
import FreeCADGui as Gui
from PySide import QtCore, QtGui

sys.path.insert(0, str(Path(__file__).resolve().parent))
import new_infill
from driving import (
    PATIENCE,
    Watch,
    are_there_jobs,
    check,
    click,
    costly,
    figures,
    infills,
    jobs_that_never_end,
    look_at_all,
    move_mouse,
    panel,
    panel_part,
    previews,
    progress_bar,
    run_checks,
    said,
    select,
    settle,
    shoot,
    slow,
    start_by_click,
    toolbar_button,
    tree_items,
    type_value,
    view_3d,
    wait_until,
    when_dialog,
    xdotool,
)


def filled():
    """A document with a box that has a lattice, which waits for the command."""
    doc, _, obj = new_infill.filled("Window")
    obj.AutoUpdate = False
    select(obj)
    return doc, obj


def boxed():
    """A document with two boxes."""
    doc = App.newDocument("Boxes")
    doc.UndoMode = 1
    boxes = [doc.addObject("Part::Box", name) for name in ("One", "Two")]
    boxes[1].Placement.Base.x = 20
    doc.recompute()
    look_at_all()
    return doc, boxes


@contextmanager
def meshes_held_back():
    """Meshes are made, and wait to be installed."""
    from freecad_volfrep.gui.jobs.updating import Update

    is_time, held = Update._is_time, [True]
    Update._is_time = lambda update: not held and is_time(update)
    try:
        yield
    finally:
        held.clear()
        Update._is_time = is_time


def is_being_made(obj):
    """Whether the infill's mesh is on its way."""
    return obj.Proxy.job.is_under_way


def camera():
    """How the view in front looks."""
    return Gui.activeDocument().activeView().getCamera()


def zoom_the_view():
    """Really turn the wheel in the 3D view; whether it moves."""
    view = view_3d()
    move_mouse(view.mapToGlobal(view.rect().center()))
    before = camera()
    xdotool("click", 4)
    return wait_until(lambda: camera() != before)


def turn_the_view():
    """The same, and really drag with the middle button; whether both move it."""
    zoomed = zoom_the_view()
    before, steps = camera(), itertools.count()

    def has_moved():
        xdotool("mousemove_relative", "--", (5, -5)[next(steps) // 8 % 2], 2)
        return camera() != before

    xdotool("mousedown", 2)
    dragged = wait_until(has_moved)
    xdotool("mouseup", 2)
    return zoomed and dragged


def go_on_while_it_is_made(doc, obj):
    """The view turns, other objects are edited and undone, and Cancel ends what is made."""
    before = obj.Mesh.CountFacets
    obj.StrutRadius = 0.9
    with jobs_that_never_end():
        start_by_click(toolbar_button("Update Lattice Infill"))
        check("it is being made", wait_until(lambda: is_being_made(obj)))
        check("it shows itself", wait_until(lambda: progress_bar() is not None))
        check("no wait cursor", QtGui.QApplication.overrideCursor() is None)
        check("the view turns", turn_the_view())
        steps = doc.UndoCount
        doc.openTransaction("Another box")
        doc.addObject("Part::Box", "Other")
        doc.commitTransaction()
        doc.recompute()
        check("another object is made", wait_until(lambda: "Other" in tree_items()))
        check("and computed", doc.Other.Shape.isValid())
        doc.undo()
        check("and undone", doc.getObject("Other") is None and doc.UndoCount == steps)
        check("it is still being made", is_being_made(obj) and "not there yet" in obj.Status)
        shoot("window_1_going_on")
        start_by_click(progress_bar().button)
        check("Cancel ends it", wait_until(lambda: not is_being_made(obj)))
    settle()
    check("and it says so", "Cancelled" in obj.Status, obj.Status)
    check("the mesh is the last one", obj.Mesh.CountFacets == before)
    check("no step is to be undone", doc.UndoCount == steps, doc.UndoNames)
    with jobs_that_never_end():
        start_by_click(toolbar_button("Update Lattice Infill"))
        wait_until(lambda: progress_bar() is not None)
        xdotool("key", "Escape")
        check("so does Escape", wait_until(lambda: not is_being_made(obj)))
    click(toolbar_button("Update Lattice Infill"))
    check("the next one is made", obj.Status == "Up to date", obj.Status)
    check("as one step", doc.UndoCount == steps + 1, doc.UndoNames)
    check("nothing red was said", "ecompute failed" not in said(), said()[-2000:])


@costly
def change_it_while_it_is_made(doc, obj):
    """The mesh is of what was asked for, and the infill waits for a recompute."""
    obj.StrutRadius = 0.9
    with meshes_held_back():
        start_by_click(toolbar_button("Update Lattice Infill"))
        check("it is being made", wait_until(lambda: is_being_made(obj)))
        obj.StrutRadius = 1.2
        doc.recompute()
        check("a recompute does not wait for it", is_being_made(obj), obj.Status)
    settle()
    check("it says that values have changed", "changed since" in obj.Status, obj.Status)
    check("it waits for a recompute", "Touched" in obj.State, obj.State)
    asked_for = obj.Volume.Value
    click(toolbar_button("Update Lattice Infill"))
    check("the next mesh is of the new values", obj.Volume.Value > asked_for)
    check("and up to date", obj.Status == "Up to date" and "Touched" not in obj.State)


def refresh_button():
    """FreeCAD's own, once it can be used: FreeCAD looks from time to time what is touched."""
    name = Gui.Command.get("Std_Refresh").getInfo()["menuText"]
    bars = [bar for bar in Gui.getMainWindow().findChildren(QtGui.QToolBar) if bar.isVisible()]
    found = [bar.widgetForAction(a) for bar in bars for a in bar.actions() if a.text() == name]
    wait_until(found[0].isEnabled)
    return found[0]


@slow
def go_on_after_a_refresh(doc, obj):
    """FreeCAD's Refresh returns at once; the next one asks for the values of then."""
    obj.AutoUpdate = True
    obj.StrutRadius = 0.9
    before = obj.Mesh.CountFacets
    with jobs_that_never_end():
        start_by_click(refresh_button())
        check("the mesh is on its way", wait_until(lambda: is_being_made(obj)))
        check("the last one is there", obj.Mesh.CountFacets == before)
        check("the view turns", turn_the_view())
        first, obj.StrutRadius = obj.Proxy.job, 1.2
        start_by_click(refresh_button())
        check("another takes its place", wait_until(lambda: obj.Proxy.job is not first))
        check("it is on its way", is_being_made(obj) and "not there yet" in obj.Status, obj.Status)
        wait_until(lambda: progress_bar() is not None)
        start_by_click(progress_bar().button)
        wait_until(lambda: not is_being_made(obj))
    obj.StrutRadius = 0.8
    click(refresh_button())
    check("it comes", obj.Status == "Up to date" and obj.StrutRadii[0] == 0.8, obj.Status)


@costly
def lose_the_engine(doc, obj):
    """A process that is killed costs a sentence; the next mesh is made by another one."""
    from freecad_volfrep.engines import engines

    before = obj.Mesh.CountFacets
    obj.StrutRadius = 0.9
    killed = []

    def kill():
        process = next((r._process for r in begun if r._process is not None), None)
        if process is None:
            return False
        killed.append(process.number)
        os.kill(process.number, signal.SIGKILL)
        return True

    begun = []
    with jobs_that_never_end():
        begin = engines().begin
        engines().begin = lambda call: begun.append(begin(call)) or begun[-1]
        watch = Watch(kill, "the engine's process")
        start_by_click(toolbar_button("Update Lattice Infill"))
        wait_until(lambda: watch.over)
        check("its end is seen", wait_until(lambda: not is_being_made(obj)))
        del engines().begin
    settle()
    check("it costs a sentence", "ended by signal 9" in obj.Status, obj.Status)
    check("the mesh is the last one", obj.Mesh.CountFacets == before)
    check("no other traceback", "EOFError" not in said(), said()[-2000:])
    App.Console.PrintMessage("The engine was killed on purpose.\n")
    select(obj)
    click(toolbar_button("Update Lattice Infill"))
    check("the next one is made", obj.Status == "Up to date", obj.Status)
    clear_report()


def clear_report():
    """Empty the report view: FreeCAD says a failed recompute with a traceback there."""
    Gui.getMainWindow().findChild(QtGui.QTextEdit, "Report view").clear()


def while_it_is_waited_for(act, move):
    """Let `act` wait for a job: `move` the view meanwhile, press what nothing may see, and Escape.

    Returns what `move` did.
    """
    moved, documents = [], len(App.listDocuments())

    def look():
        if progress_bar() is None:
            return False
        moved.append(move())
        xdotool("click", 3, "key", "ctrl+n")
        moved.append(move())
        shoot("window_2_waiting")
        xdotool("key", "Escape")
        return True

    watch = Watch(look, "the bar of a job")
    with jobs_that_never_end():
        act()
        wait_until(lambda: watch.over and progress_bar() is None)
    check("the view has moved meanwhile", watch.over and moved == [True, True], moved)
    check("no menu was opened", QtGui.QApplication.activePopupWidget() is None)
    check("no key reached FreeCAD", len(App.listDocuments()) == documents)


@costly
def turn_while_a_check_is_waited_for(doc, obj):
    """Check Mesh waits for the engine's answer: the view turns, and nothing else is done."""
    button = toolbar_button("Check Mesh")
    while_it_is_waited_for(lambda: start_by_click(button), turn_the_view)
    check("Escape ends it", "Cancelled" in said(), said()[-500:])


def zoom_while_a_recompute_waits(doc, obj):
    """So does FreeCAD's own recompute, which swallows what is dragged, but not the wheel."""
    obj.AutoUpdate = True
    obj.StrutRadius = 0.9
    while_it_is_waited_for(doc.recompute, zoom_the_view)
    check("Escape ends it", "Cancelled" in obj.Status, obj.Status)


@costly
def go_on_after_ok(doc, boxes):
    """OK closes the panel at once; the mesh comes as a step that goes with its values."""
    box = boxes[0]
    select(box)
    steps = doc.UndoCount
    click(toolbar_button("Lattice Infill"))
    wait_until(lambda: panel() is not None)
    obj = infills(doc)[0]
    with meshes_held_back():
        answer_by_click("OK")
        check("the panel closes", wait_until(lambda: panel() is None))
        check("the mesh is on its way", is_being_made(obj))
        check("its preview stays meanwhile", previews() == 1, previews())
        check("the values are a step", doc.UndoCount == steps + 1, doc.UndoNames)
        shoot("window_3_after_ok")
    settle()
    check("the mesh is there", obj.Mesh.CountFacets > 0 and obj.Status == "Up to date", obj.Status)
    check("and shown in the solid's place", obj.Visibility and not box.Visibility)
    check("the preview is gone", previews() == 0, previews())
    check("it is a step of its own", doc.UndoCount == steps + 2, doc.UndoNames)
    check("which says what it is", "Mesh of" in doc.UndoNames[0], doc.UndoNames)
    doc.undo()
    check("undone with its values", wait_until(lambda: infills(doc) == []), doc.UndoNames)
    check("the solid shows", wait_until(lambda: box.Visibility))


def answer_by_click(text):
    """Really click a button of the task panel, without waiting for what comes of it."""
    for button in Gui.getMainWindow().findChildren(QtGui.QPushButton):
        is_of_job = button.objectName() == "VolfrepCancel"  # in the status bar
        if button.isVisible() and not is_of_job and button.text().replace("&", "") == text:
            start_by_click(button)
            return
    raise LookupError(f"no button {text}")


def cancel_the_panel_while_it_computes(doc, obj):
    """Cancel of the panel takes back its values, and the mesh that was asked for with them."""
    before, radius = obj.Mesh.CountFacets, obj.StrutRadius.Value
    Gui.activeDocument().setEdit(obj.Name)
    wait_until(lambda: panel() is not None)
    settle()
    type_value("StrutRadius", "1.4 mm")
    with jobs_that_never_end():
        start_by_click(panel_part("Compute"))
        check("it is being made", wait_until(lambda: is_being_made(obj)))
        said_there = panel_part("Figures").text()
        check("the panel says so", "not there yet" in said_there, said_there)
        check("the view turns", turn_the_view())
        answer_by_click("Cancel")
        check("the panel closes", wait_until(lambda: panel() is None))
    settle()
    check("the value is the last one", obj.StrutRadius.Value == radius, obj.StrutRadius)
    check("and so is the mesh", obj.Mesh.CountFacets == before and not is_being_made(obj))
    check("no preview stays", previews() == 0, previews())
    check("the infill shows again", obj.Visibility)


@costly
def close_the_document_while_it_is_made(doc, obj):
    """What nobody wants any more ends without a word."""
    obj.StrutRadius = 0.9
    with jobs_that_never_end():
        start_by_click(toolbar_button("Update Lattice Infill"))
        wait_until(lambda: progress_bar() is not None)
        App.closeDocument(doc.Name)
        check("its bar goes", wait_until(lambda: progress_bar() is None))
    settle()


@slow
def fill_two_at_once(doc, boxes):
    """Two solids are filled after a question, one after the other."""
    asked = []

    def answer(button):
        def act(box):
            asked.append(box.text())
            place = box.button(button)
            point = place.mapToGlobal(place.rect().center())
            xdotool("mousemove", point.x(), point.y(), "click", 1)

        return act

    select(*boxes)
    when_dialog(QtGui.QMessageBox, answer(QtGui.QMessageBox.No))
    click(toolbar_button("Lattice Infill"))
    check("it asks", asked and "Fill 2 solids" in asked[0], asked)
    check("No makes nothing", infills(doc) == [], doc.Objects)
    select(*boxes)
    when_dialog(QtGui.QMessageBox, answer(QtGui.QMessageBox.Yes))
    click(toolbar_button("Lattice Infill"))
    made = infills(doc)
    check("Yes fills both", len(made) == 2 and all(obj.Mesh.CountFacets for obj in made))
    check("and shows them", not any(box.Visibility for box in boxes))


@slow
def answers_meanwhile(doc, obj):
    """Figures: the longest time that Qt's loop stood still while a mesh was made and taken over.

    A large one is first a likeness, and then drawn in pieces; in the end all of it is there.
    """
    from freecad_volfrep.gui.jobs import updating

    beats, likenesses = [], []
    obj.CellSize, obj.StrutRadius = 4, 0.5
    timer = QtCore.QTimer(Gui.getMainWindow())
    timer.timeout.connect(lambda: beats.append(time.monotonic()))
    timer.start(10)
    for name, large in (("of", 10**9), ("of a likeness and", 200_000)):
        largest, updating.LARGE = updating.LARGE, large
        waits = updating.STILL, updating.LONGEST
        updating.STILL = updating.LONGEST = 1000 * PATIENCE  # until its likeness was seen
        obj.StrutRadius = obj.StrutRadius.Value + 0.02
        with meshes_held_back():
            start_by_click(toolbar_button("Update Lattice Infill"))
            wait_until(lambda: is_being_made(obj))
            beats.clear()
            wait_until(lambda: _has_ended())
            figures[f"longest time without an answer, {name} making, s"] = longest(beats)
        beats.clear()
        wait_until(lambda: scene_has("VolfrepLikeness") or not is_being_made(obj))
        likenesses.append(scene_has("VolfrepLikeness"))
        if likenesses[-1]:
            shoot("window_4_likeness")
            beats.clear()
        updating.STILL, updating.LONGEST = waits
        wait_until(lambda: not is_being_made(obj))
        figures[f"longest time without an answer, {name} taking over, s"] = longest(beats)
        beats.clear()
        wait_until(lambda: not are_there_jobs())
        figures[f"longest time without an answer, {name} drawing, s"] = longest(beats)
        updating.LARGE = largest
        check("no likeness is left", not scene_has("VolfrepLikeness"))
    timer.stop()
    settle()
    figures["triangles"] = obj.Mesh.CountFacets
    check("a likeness is shown of large ones only", likenesses == [False, True], likenesses)
    check("it is made", obj.Status == "Up to date", obj.Status)
    check("and closed", obj.Mesh.isSolid() and obj.Watertight)
    check("every triangle is drawn", drawn_triangles(obj) >= obj.Mesh.CountFacets)


def longest(beats):
    """The longest time between two beats, s."""
    return round(max((b - a for a, b in itertools.pairwise(beats)), default=0.0), 3)


def scene_has(name):
    """Whether something of that name hangs in the view's scene."""
    scene = Gui.activeDocument().activeView().getSceneGraph()
    return name in [scene.getChild(k).getName().getString() for k in range(scene.getNumChildren())]


def drawn_triangles(obj):
    """How many triangles the view draws of an infill."""
    from pivy import coin

    count = coin.SoGetPrimitiveCountAction()
    count.apply(obj.ViewObject.RootNode)
    return count.getTriangleCount()


def _has_ended():
    from freecad_volfrep.gui.jobs import background

    jobs = background._jobs[0]._jobs
    return bool(jobs) and jobs[0]._running is not None and jobs[0]._running.wait(0)


run_checks(
    "window",
    {
        go_on_while_it_is_made: filled,
        change_it_while_it_is_made: filled,
        go_on_after_a_refresh: filled,
        lose_the_engine: filled,
        turn_while_a_check_is_waited_for: filled,
        zoom_while_a_recompute_waits: filled,
        go_on_after_ok: boxed,
        cancel_the_panel_while_it_computes: filled,
        close_the_document_while_it_is_made: filled,
        fill_two_at_once: boxed,
        answers_meanwhile: filled,
    },
)

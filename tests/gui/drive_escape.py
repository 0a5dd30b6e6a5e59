# SPDX-License-Identifier: LGPL-2.1-or-later
"""Escape at random times during every long command, in the real FreeCAD; see tools/run_gui.sh.

Each command is clicked once to the end and then ESCAPES times more (an environment variable; once
by default, ten times by ``make test-escape``, then on a larger part; the seed is SEED), with a real
Escape after a random part of its job's time. FreeCAD has to be itself afterwards: nothing waits, no
box is open, the next click is followed, and the document is as it was, or as the command leaves it
where Escape came too late. How long an Escape takes that meets a job is told, in seconds and in the
processor time of FreeCAD and its processes.
"""

import os
import random
import subprocess
import sys
import time
from contextlib import contextmanager
from pathlib import Path

import FreeCAD as App
import FreeCADGui as Gui
from PySide import QtCore, QtGui

sys.path.insert(0, str(Path(__file__).resolve().parent))
from driving import (
    OUT,
    PATIENCE,
    Watch,
    answer_file_dialog,
    answer_panel,
    check,
    click,
    click_menu,
    comes_true,
    costly,
    figures,
    panel,
    panel_part,
    processor_seconds,
    run_checks,
    said,
    select,
    settle,
    shoot,
    slow,
    start_by_click,
    toolbar_button,
    wait_until,
    window,
    xdotool,
)
from new_analysis import loaded

from freecad_volfrep.gui.jobs.background import are_there_jobs
from freecad_volfrep.gui.jobs.progress import _Progress, is_waited_for

ESCAPES = int(os.environ.get("ESCAPES", "1"))
SEED = int(os.environ.get("SEED", "19"))


@contextmanager
def when_a_job_begins(act, each=lambda: None):
    """Call `act` when the first job of what is done meanwhile begins, `each` after every one."""
    from volfrep.process.engines import Engines

    enter, begin, begun = _Progress.__enter__, Engines.begin, []

    def entered(progress):
        if not begun:
            begun.append(act())
        entering = enter(progress)
        each()
        return entering

    def began(engines, call):
        if not begun:
            begun.append(act())
        running = begin(engines, call)
        each()
        return running

    _Progress.__enter__, Engines.begin = entered, began
    try:
        yield begun
    finally:
        _Progress.__enter__, Engines.begin = enter, begin


def filled():
    """An infill whose jobs take a second or more: of a box, or for many escapes of the bracket."""
    from freecad_volfrep import make_lattice_infill
    from freecad_volfrep.examples.filled import open_example

    if ESCAPES > 1:
        return (open_example("Bracket"),)
    doc = App.newDocument("Escape")
    box = doc.addObject("Part::Box", "Block")
    box.Length, box.Width, box.Height = 30, 20, 20
    obj = make_lattice_infill(doc, box, CellSize=5, StrutRadius=0.7, ShellThickness=1)
    doc.recompute()
    box.Visibility = False
    settle()
    return (obj,)


def coarse():
    """One without a skin, whose exact joints and tetrahedra take seconds."""
    from freecad_volfrep import make_lattice_infill

    doc = App.newDocument("Small")
    box = doc.addObject("Part::Box", "Block")
    box.Length, box.Width, box.Height = (40, 30, 30) if ESCAPES > 1 else (20, 20, 10)
    obj = make_lattice_infill(doc, box, CellSize=10, StrutRadius=1, ShellThickness=0)
    doc.recompute()
    box.Visibility = False
    settle()
    return (obj,)


def carrying():
    """One that carries loads, which takes seconds to size."""
    return loaded((120, 40, 40) if ESCAPES > 1 else (60, 20, 20))


def is_itself():
    """Whether nothing of a job is left."""
    return (
        not are_there_jobs()
        and Gui.getMainWindow().findChild(QtGui.QWidget, "VolfrepProgress") is None
        and QtGui.QApplication.overrideCursor() is None
        and QtGui.QApplication.activeModalWidget() is None
        and QtGui.QApplication.activePopupWidget() is None
    )


def answers_a_click():
    """Really open a window of ours, and close it by its button."""
    click(toolbar_button("Cell Library"))
    opened = wait_until(lambda: window("VolfrepCellLibrary") is not None)
    check("the next click is followed", opened)
    if opened:
        click(window("VolfrepCellLibrary").findChild(QtGui.QPushButton, "Close"))
        wait_until(lambda: window("VolfrepCellLibrary") is None)


class Met(QtCore.QObject):
    """Notes when an Escape reaches the window while a job is there, and when that is over."""

    def __init__(self):
        super().__init__()
        self._start = None
        self.seconds = self.processor = None
        self._timer = QtCore.QTimer(self)
        self._timer.timeout.connect(self.has_ended)  # at once, whatever loop is running
        self._timer.start(10)

    def come_first(self):
        """Before what swallows it: the filter that was installed last is asked first."""
        QtGui.QApplication.instance().installEventFilter(self)

    def eventFilter(self, target, event):  # noqa: N802
        """Note it and let it pass."""
        pressed = event.type() in (QtCore.QEvent.KeyPress, QtCore.QEvent.ShortcutOverride)
        escape = pressed and event.key() == QtCore.Qt.Key_Escape and self._start is None
        if escape and (is_waited_for() or are_there_jobs()):
            self._start = time.monotonic(), processor_seconds()
        return False

    def has_ended(self):
        """Whether FreeCAD is itself again."""
        if not is_itself():
            return False
        if self._start is not None and self.seconds is None:
            start, used = self._start
            self.seconds = time.monotonic() - start
            self.processor = processor_seconds() - used
        return True

    def end(self):
        """Look no more."""
        self._timer.stop()
        QtGui.QApplication.instance().removeEventFilter(self)


def document():
    """What a document holds, by names and figures; times of undoing are not looked at."""
    doc = App.ActiveDocument
    if doc is None:
        return None
    meshes = {o.Name: o.Mesh.CountFacets for o in doc.Objects if o.isDerivedFrom("Mesh::Feature")}
    return sorted(o.Name for o in doc.Objects), meshes


def kinds_of(state):
    """A state without the numbers that FreeCAD gives names, and without the triangles' number."""
    return state and sorted(name.rstrip("0123456789") for name in state[0])


def escape(prepare, act, tidy=lambda: None):
    """Run a command once, and then with Escape at random parts of its time."""

    def leave():
        if window("VolfrepReport") is not None:
            window("VolfrepReport").close()
        tidy()
        settle()

    name = sys._getframe(1).f_code.co_name
    chance = random.Random(f"{SEED} {name}")
    prepare()
    with when_a_job_begins(time.monotonic) as begun:
        check("the command is followed", act() is not False)
        wait_until(is_itself)
    check("a job begins", begun)
    whole = max(time.monotonic() - begun[0], 0.5)
    settle()
    done = kinds_of(document())
    leave()
    moments, last, met, used = [], 0.0, [], []
    for _ in range(ESCAPES):
        prepare()
        before = document()
        moment = chance.uniform(0.0, 1.1) * whole
        moments.append(round(moment, 2))
        keys = ["sh", "-c", f"sleep {moment:.3f}; exec xdotool key Escape"]
        meeting = Met()
        with when_a_job_begins(
            lambda keys=keys: (time.monotonic(), subprocess.Popen(keys)), meeting.come_first
        ) as begun:
            act()
            ended = comes_true(meeting.has_ended, PATIENCE)
        if begun:
            start, key = begun[0]
            last = max(last, time.monotonic() - start - moment)
            key.wait()
        settle()
        meeting.end()
        if meeting.seconds is not None:
            met.append(round(meeting.seconds, 2))
            used.append(round(meeting.processor, 2))
        # An Escape after the job may close a panel, whose values are drawn anew.
        ended = ended and comes_true(is_itself, PATIENCE)
        check(f"it ends after Escape at {moment:.2f} s", begun and ended)
        if not ended:
            shoot(f"escape_{name}")
        after = document()
        check(
            f"after Escape at {moment:.2f} s the document is as before, or as it is when done",
            after == before or kinds_of(after) == done,
            (before, after),
        )
        leave()
    figures[f"{name}: seconds without Escape"] = round(whole, 1)
    figures[f"{name}: Escape after seconds"] = moments
    figures[f"{name}: longest wait after Escape, s"] = round(last, 1)
    figures[f"{name}: Escapes that met a job took s"] = met
    figures[f"{name}: and of the processor, s"] = used
    answers_a_click()
    check("no failed recompute", "ecompute failed" not in said(), said()[-2000:])


def new_radii(obj):
    """Gives the infill another radius every time, and selects it."""
    radii = iter(obj.StrutRadius.Value + 0.01 * k for k in range(1, 10_000))

    def prepare():
        obj.StrutRadius = next(radii)
        select(obj)

    return prepare


@slow
def leave_check_mesh(obj):
    """Check Mesh."""
    escape(lambda: select(obj), lambda: click(toolbar_button("Check Mesh")))


@costly
def leave_an_update(obj):
    """Update Lattice Infill."""
    obj.AutoUpdate = False
    escape(new_radii(obj), lambda: click(toolbar_button("Update Lattice Infill")))


@slow
def leave_a_refresh(obj):
    """FreeCAD's own recompute."""
    text = Gui.Command.get("Std_Refresh").getInfo()["menuText"].replace("&", "")
    escape(new_radii(obj), lambda: click_menu("Edit", text))


@slow
def leave_the_print_check(obj):
    """Print Check."""
    kept = {o.Name for o in obj.Document.Objects}
    escape(lambda: select(obj), lambda: click(toolbar_button("Print Check")), take_away(obj, kept))


@slow
def leave_the_panel(obj):
    """The panel's OK, which closes it at once."""
    radius = new_radii(obj)

    def prepare():
        select(obj)
        click(toolbar_button("Edit Lattice Infill"))
        wait_until(lambda: panel() is not None)
        settle()
        radius()

    def tidy():
        if panel() is not None:
            answer_panel("Cancel")
            wait_until(lambda: panel() is None)

    escape(prepare, lambda: answer_panel("OK"), tidy)


@slow
def leave_compute(obj):
    """Compute in the panel: Escape closes it, as it does any panel of FreeCAD."""
    radius = new_radii(obj)

    def prepare():
        select(obj)
        click(toolbar_button("Edit Lattice Infill"))
        wait_until(lambda: panel() is not None)
        settle()
        radius()
        panel().setFocus()

    def act():
        start_by_click(panel_part("Compute"))

    def tidy():
        if panel() is not None:
            answer_panel("Cancel")
            wait_until(lambda: panel() is None)

    escape(prepare, act, tidy)


@slow
def leave_an_export(obj):
    """Export Lattice as STEP with exact surfaces, by a typed name."""
    path = OUT / "escaped.step"

    def act():
        answer_file_dialog(path, "escape_export")
        watch = Watch(answer_yes, "the question of Export Lattice")
        click(toolbar_button("Export Lattice"))
        wait_until(is_itself)
        watch.stop()  # Escape has met the job that tells what the file takes

    def tidy():
        check("no file is left behind", not list(OUT.glob(".escaped*")), list(OUT.glob(".esc*")))
        path.unlink(missing_ok=True)

    escape(lambda: select(obj), act, tidy)


def answer_yes():
    """Really click Yes in a box, once it is there; whether it was."""
    box = QtGui.QApplication.activeModalWidget()
    if not isinstance(box, QtGui.QMessageBox) or not box.isVisible():
        return False
    button = box.button(QtGui.QMessageBox.Yes)
    if button is None or not button.isVisible():
        return False
    place = button.mapToGlobal(button.rect().center())
    xdotool("mousemove", place.x(), place.y(), "click", 1)
    return True


@slow
def leave_the_exact_solid(obj):
    """Lattice To Solid, the one with exact joints."""
    escape(lambda: select(obj), lambda: choose_after("Lattice To Solid", "exact"), take_away(obj))


@slow
def leave_the_instances(obj):
    """Lattice To Solid, the one of links."""
    escape(lambda: select(obj), lambda: choose_after("Lattice To Solid", "link"), take_away(obj))


@slow
def leave_the_tetrahedra(obj):
    """FEM Analysis, the one of tetrahedra."""
    escape(lambda: select(obj), lambda: choose_after("FEM Analysis", "tetrahedra"), take_away(obj))


@slow
def leave_the_plane_faces(obj):
    """Lattice To Solid, the one of plane faces."""
    escape(lambda: select(obj), lambda: choose_after("Lattice To Solid", "plane"), take_away(obj))


@slow
def leave_the_beams(obj):
    """FEM Analysis, the one of beams."""
    escape(lambda: select(obj), lambda: choose_after("FEM Analysis", "beams"), take_away(obj))


@slow
def leave_the_sizing(doc, obj):
    """Loads and Sizing: a cancel keeps the best design so far, in the panel."""

    def prepare():
        select(obj)
        click(toolbar_button("Loads and Sizing"))
        wait_until(lambda: part_of("VolfrepSizePanel", "Size") is not None)
        settle()

    def tidy():
        if part_of("VolfrepSizePanel", "Size") is not None:  # Escape after the end closes it
            answer_panel("Cancel")
            wait_until(lambda: part_of("VolfrepSizePanel", "Size") is None)

    escape(prepare, lambda: click(part_of("VolfrepSizePanel", "Size")), tidy)


@slow
def leave_a_study(obj):
    """Start in the panel of Design Study: what was done stays on record."""
    from freecad_volfrep import make_design_study

    study = make_design_study(obj.Document, obj)
    values = iter(f"0.5 to {1 + 0.01 * k:.2f} in 12" for k in range(10_000))

    def prepare():
        select(study)
        click(toolbar_button("Design Study"))
        wait_until(lambda: part_of("VolfrepStudyPanel", "Start") is not None)
        part_of("VolfrepStudyPanel", "Values2").setText(next(values))
        settle()

    def tidy():
        if part_of("VolfrepStudyPanel", "Start") is not None:
            answer_panel("Close")
            wait_until(lambda: part_of("VolfrepStudyPanel", "Start") is None)

    escape(prepare, lambda: click(part_of("VolfrepStudyPanel", "Start")), tidy)


def part_of(form, name):
    """A widget of an open panel, or None."""
    found = Gui.getMainWindow().findChildren(QtGui.QWidget, form)
    open_one = next((widget for widget in found if widget.isVisible()), None)
    return None if open_one is None else open_one.findChild(QtGui.QWidget, name)


@slow
def leave_an_example():
    """An example, which fills a new document."""

    def close_it():
        for name in list(App.listDocuments()):
            App.closeDocument(name)

    entry = "Bracket" if ESCAPES > 1 else "Piston Rod"
    escape(lambda: None, lambda: click_menu("VOLFREP", "Examples", entry), close_it)


def choose_after(button, kind):
    """Click a button, and pick from the list that opens by real keys; whether it did."""

    def answer():
        box = QtGui.QApplication.activeModalWidget()
        if not isinstance(box, QtGui.QInputDialog) or not box.isVisible():
            return False
        if not box.isActiveWindow():
            xdotool("windowfocus", int(box.winId()))
            return False
        row = next(k for k, item in enumerate(box.comboBoxItems()) if kind in item.lower())
        xdotool("key", *["Down"] * row, "Return")
        return True

    watch = Watch(answer, f"the list of {button}")
    click(toolbar_button(button))
    wait_until(is_itself)
    answered = watch.over
    watch.stop()  # Escape has met the job that tells what the list would offer
    return answered


def take_away(obj, kept=None):
    """Takes away what commands have made beside an infill."""
    kept = kept or {o.Name for o in obj.Document.Objects}

    def tidy():
        for name in [o.Name for o in obj.Document.Objects if o.Name not in kept]:
            if obj.Document.getObject(name) is not None:
                obj.Document.removeObject(name)
        obj.Visibility = True

    return tidy


def answer_freecads_own_box():
    """While a job of ours is on FreeCAD asks whether to abort: the answer reaches it."""
    import Mesh

    mesh = Mesh.createSphere(10.0, 300)
    boxes = []

    def answer():
        box = QtGui.QApplication.activeModalWidget()
        if not isinstance(box, QtGui.QMessageBox) or not box.isVisible():
            return False
        boxes.append(box.text())
        if len(boxes) < 3:  # by then it is drawn
            return False
        shoot("escape_freecads_box")
        yes = box.button(QtGui.QMessageBox.Yes) or box.buttons()[0]
        place = yes.mapToGlobal(yes.rect().center())
        xdotool("mousemove", place.x(), place.y(), "click", 1)
        return True

    Watch(answer, "FreeCAD's question")
    end = time.monotonic() + PATIENCE
    with _Progress("A job"):
        xdotool("key", "Escape")
        while not boxes and time.monotonic() < end:
            try:
                mesh.getSelfIntersections()
            except App.Base.FreeCADAbort:
                figures["FreeCAD's search ends as asked"] = True
    check("FreeCAD has asked", boxes)
    check("one click has answered it", wait_until(is_itself))
    figures["FreeCAD asked"] = boxes[:1]


run_checks(
    "escape",
    {
        answer_freecads_own_box: None,
        leave_check_mesh: filled,
        leave_an_update: filled,
        leave_a_refresh: filled,
        leave_the_print_check: filled,
        leave_the_panel: filled,
        leave_compute: filled,
        leave_an_export: coarse,
        leave_the_exact_solid: coarse,
        leave_the_instances: coarse,
        leave_the_plane_faces: coarse,
        leave_the_tetrahedra: coarse,
        leave_the_beams: coarse,
        leave_the_sizing: carrying,
        leave_a_study: coarse,
        leave_an_example: None,
    },
)

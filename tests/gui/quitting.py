# SPDX-License-Identifier: LGPL-2.1-or-later
"""The FreeCAD that drive_quit.py starts and that is quit by a real key, click or closed window.

What is open then, how it is quit and how the box that asks is answered come as QUIT_OPEN, QUIT_BY
and QUIT_ANSWERS. What fails is said and ends it with 3; else FreeCAD ends itself.
"""

import ctypes
import os
import sys
import threading
import traceback
from contextlib import suppress
from pathlib import Path

import FreeCAD as App
import FreeCADGui as Gui
from PySide import QtCore, QtGui

sys.path.insert(0, str(Path(__file__).resolve().parent))
from driving import (
    Watch,
    comes_true,
    failures,
    jobs_that_never_end,
    middle,
    move_mouse,
    progress_bar,
    select,
    settle,
    start_by_click,
    toolbar_button,
    wait,
    wait_until,
    xdotool,
)
from new_infill import filled

from freecad_volfrep.gui.jobs.background import are_there_jobs
from freecad_volfrep.gui.jobs.progress import is_waited_for

HOME = Path(os.environ["FREECAD_USER_HOME"])
ANSWERS = os.environ["QUIT_ANSWERS"].split()


class _ClientMessage(ctypes.Structure):
    """Xlib's XClientMessageEvent, with room for the largest event."""

    _fields_ = (
        ("type", ctypes.c_int),
        ("serial", ctypes.c_ulong),
        ("send_event", ctypes.c_int),
        ("display", ctypes.c_void_p),
        ("window", ctypes.c_ulong),
        ("message_type", ctypes.c_ulong),
        ("format", ctypes.c_int),
        ("data", ctypes.c_long * 5),
        ("room", ctypes.c_long * 24),
    )


def close_window():
    """What a window manager sends when its cross is clicked; there is none on this screen."""
    x11 = ctypes.CDLL("libX11.so.6")
    x11.XOpenDisplay.restype = ctypes.c_void_p
    x11.XInternAtom.restype = ctypes.c_ulong
    x11.XInternAtom.argtypes = (ctypes.c_void_p, ctypes.c_char_p, ctypes.c_int)
    x11.XSendEvent.argtypes = (
        *(ctypes.c_void_p, ctypes.c_ulong, ctypes.c_int, ctypes.c_long),
        ctypes.POINTER(_ClientMessage),
    )
    x11.XCloseDisplay.argtypes = (ctypes.c_void_p,)
    display = x11.XOpenDisplay(None)
    window = int(Gui.getMainWindow().winId())
    event = _ClientMessage(type=33, window=window, format=32)
    event.message_type = x11.XInternAtom(display, b"WM_PROTOCOLS", 0)
    event.data[0] = x11.XInternAtom(display, b"WM_DELETE_WINDOW", 0)
    x11.XSendEvent(display, window, 0, 0, ctypes.byref(event))
    x11.XCloseDisplay(display)


def press_keys():
    """Ctrl+Q."""
    xdotool("windowfocus", int(Gui.getMainWindow().winId()))
    wait_until(Gui.getMainWindow().isActiveWindow)
    xdotool("key", "ctrl+q")


def click_exit():
    """File, Exit; the last click is not waited for, because FreeCAD ends by it."""
    bar = Gui.getMainWindow().menuBar()
    first = bar.actions()[0]
    move_mouse(bar.mapToGlobal(bar.actionGeometry(first).center()))
    xdotool("click", 1)
    wait_until(lambda: QtGui.QApplication.activePopupWidget() is not None)
    menu = QtGui.QApplication.activePopupWidget()
    last = next(entry for entry in menu.actions() if "Exit" in entry.text().replace("&", ""))
    move_mouse(menu.mapToGlobal(menu.actionGeometry(last).center()))
    xdotool("click", 1)


def saved(doc):
    """Keep a document, so that FreeCAD asks nothing; the view's own changes come late."""
    settle()
    doc.saveAs(str(HOME / f"{doc.Name}.FCStd"))
    with suppress(AttributeError):  # FreeCAD 0.20 asks, and is answered
        Gui.getDocument(doc.Name).Modified = False


def one():
    """A document with an infill."""
    saved(filled("One")[0])


def several():
    """Infills of a box and of an imported mesh, a print check, a mesh read in the console."""
    import Mesh

    from freecad_volfrep import make_lattice_infill, make_print_check

    first, _, infill = filled("First")
    make_print_check(first, infill)
    first.recompute()
    doc = App.newDocument("Second")
    part = doc.addObject("Mesh::Feature", "Part")
    part.Mesh = Mesh.createBox(20, 20, 20)
    make_lattice_infill(doc, part, CellSize=10, StrutRadius=1, ShellThickness=0)
    doc.recompute()
    third = App.newDocument("Third")
    third.addObject("Mesh::Feature", "Bare").Mesh = infill.Mesh
    Gui.doCommand("App.ActiveDocument.Bare.Mesh.CountFacets")
    for each in list(App.listDocuments().values()):
        saved(each)


def job():
    """An infill whose next mesh is being made, beside what the user does."""
    infill = _about_to_change("Job")
    start_by_click(toolbar_button("Update Lattice Infill"))
    wait_until(lambda: progress_bar() is not None)
    if not are_there_jobs() or is_waited_for() or not infill.Proxy.job.is_under_way:
        raise AssertionError("no job runs beside the window")


def picking():
    """Loads are picked, and what no load changes is being made ahead."""
    doc, _, infill = filled("Picking")
    saved(doc)
    select(infill)
    _never.__enter__()
    start_by_click(toolbar_button("Loads and Sizing"))
    calls = lambda: [one for one in threading.enumerate() if one.name == "volfrep-call"]  # noqa: E731
    wait_until(lambda: len(calls()) == 2)  # the process is got ready, and begins


def waited_for():
    """One whose mesh a script's recompute waits for: it is quit while that runs."""
    infill = _about_to_change("Waited")
    # The next one, too, is cancelled: FreeCAD closes nothing while it recomputes.
    infill.Document.copyObject(infill)
    Watch(lambda: progress_bar() is not None and (quit_now() or True), "the bar of a job")
    infill.Document.recompute()
    said = infill.Status
    if not said.startswith("Cancelled"):
        raise AssertionError(f"the recompute ends with {said}")
    return True


def _about_to_change(name):
    """An infill, saved, whose next job never ends."""
    doc, _, infill = filled(name)
    saved(doc)
    select(infill)
    _never.__enter__()
    infill.StrutRadius = 1.2
    return infill


def undone():
    """One infill undone, its mesh gone into the undo stack, and one deleted."""
    doc, _box, infill = filled("Undone")
    infill.Mesh.CountFacets  # noqa: B018
    doc.undo()
    settle()
    if doc.findObjects("Mesh::Feature"):
        raise AssertionError("the infill is still there")
    doc.redo()
    settle()
    doc.openTransaction("Delete")
    doc.removeObject(doc.findObjects("Mesh::Feature")[0].Name)
    doc.commitTransaction()
    settle()


def unsaved():
    """A document that has a file, and an infill that the file has not."""
    doc, _, _ = filled("Unsaved")
    doc.saveAs(str(HOME / "Unsaved.FCStd"))
    doc.openTransaction("Change")
    doc.addObject("App::Annotation", "Later")
    doc.commitTransaction()
    settle()


_never = jobs_that_never_end()
OPEN = {f.__name__: f for f in (one, several, job, picking, waited_for, undone, unsaved)}
BY = {"key": press_keys, "menu": click_exit, "window": close_window}


def quit_now():
    """Quit as it was asked for, and let what FreeCAD asks be answered."""
    if ANSWERS:
        QtCore.QTimer.singleShot(100, answer)
    BY[os.environ["QUIT_BY"]]()


def answer():
    """Really click the next answer; after a Cancel all has to be there, and it is quit again."""
    box = QtGui.QApplication.activeModalWidget()
    if not isinstance(box, QtGui.QMessageBox) or not box.isVisible():
        QtCore.QTimer.singleShot(100, answer)
        return
    text = ANSWERS.pop(0)
    button = next(b for b in box.buttons() if b.text().replace("&", "").startswith(text))
    move_mouse(middle(button))
    xdotool("click", 1)
    if text == "Cancel":
        QtCore.QTimer.singleShot(500, lambda: guarded(again))
    elif ANSWERS:
        QtCore.QTimer.singleShot(500, answer)


def again():
    """Nothing is lost, what was open can be worked with, and it is quit again."""
    if not comes_true(lambda: QtGui.QApplication.activeModalWidget() is None, 20):
        raise AssertionError("the box is still there")
    doc = App.ActiveDocument
    infill = doc.findObjects("Mesh::Feature")[0]
    count = infill.Mesh.CountFacets
    infill.StrutRadius = 1.3
    doc.recompute()
    settle()
    if not count or infill.Mesh.CountFacets in (0, count) or doc.getObject("Later") is None:
        raise AssertionError(f"cancelled, and lost: {count}, {infill.Mesh.CountFacets}")
    quit_now()


def guarded(act):
    """What fails ends FreeCAD by a code of its own."""
    try:
        act()
    except BaseException:
        traceback.print_exc(file=sys.__stderr__)
        sys.__stderr__.flush()
        os._exit(3)
    if failures:
        os._exit(3)


def main():
    """Open, and quit from FreeCAD's own loop."""
    wait_until(Gui.getMainWindow().isVisible)
    Gui.activateWorkbench("VolfrepWorkbench")
    settle()
    has_quit = OPEN[os.environ["QUIT_OPEN"]]()
    if not has_quit:
        wait(300)
        # xdotool is called from here, but what it sends is read when this is through.
        quit_now()


QtCore.QTimer.singleShot(0, lambda: guarded(main))

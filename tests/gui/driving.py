# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the scripts share that drive the workbench in the real FreeCAD; see tools/run_gui.sh.

A script is a table of checks, each a function that stands alone: `run_checks` runs those that were
asked for, a failing one does not hide the others, and FreeCAD is left with 0 when every check held.
Nothing waits for a time that was guessed: `settle` waits until the window has nothing left to do,
`wait_until` for what must come. What comes too late, and what is raised in a slot or on a thread,
fails the check that is running.
"""

import faulthandler
import json
import os
import subprocess
import sys
import threading
import time
import traceback
from contextlib import contextmanager
from pathlib import Path

import FreeCAD as App
import FreeCADGui as Gui
import numpy as np
from PySide import QtCore, QtGui

from freecad_volfrep.gui.jobs.background import are_there_jobs
from freecad_volfrep.gui.latest import are_there_questions

OUT = Path(os.environ["GUI_OUT"])
#: Of what must come, in s: only what never comes takes so long.
PATIENCE = 60
#: How often Return is pressed in a file dialog that stays open.
ANSWERS = 5
#: Of one check, in s: then it hangs, in a box that nobody answers or in FreeCAD.
LONGEST = int(os.environ.get("GUI_LONGEST", "400"))
#: The same of one that is marked as slow.
LONGEST_SLOW = 3 * LONGEST
#: Clicks at a widget that moves away under the mouse.
TRIES = 5
figures = {}
failures = []
#: Of the mouse's buttons, all that were made.
clicks = []


#: The check that is running, by its function's name.
_running = ""


def fail(text):
    """Note that the running check fails, and say so at once: the window may not see its end."""
    failures.append(f"{_running}: {text}".removeprefix(": "))
    print(f"FAILED {failures[-1]}", file=sys.__stdout__, flush=True)


def fail_by(error, where=""):
    """Note that the running check fails by what was raised, and where that was."""
    raised = "".join(traceback.format_exception(type(error), error, error.__traceback__))
    fail(f"{where}{type(error).__name__}: {error}\n{raised}")


def check(name, holds, detail=""):
    """Note whether something holds; go on whatever it says."""
    figures[name] = bool(holds)
    if not holds:
        fail(f"{name} {detail}".strip())


def wait(milliseconds):
    """Let Qt run for a time; only what `wait_until` cannot be asked for needs it."""
    loop = QtCore.QEventLoop()
    QtCore.QTimer.singleShot(milliseconds, loop.quit)
    (loop.exec if hasattr(loop, "exec") else loop.exec_)()


class Standstills:
    """Times for which Qt's loop stood still, and what Python was at then, until they are `told`.

    A thread looks where the main one is whenever the loop's next turn does not come. It takes its
    turn with Python as all threads do: faulthandler's, which takes none, reads calls while they
    change, and FreeCAD may die of it. A call that lets no other thread in is seen at its end.
    """

    #: Not worth a word, s.
    LEAST = 0.1
    #: Between turns of the loop, ms.
    BEAT = 10
    #: Calls that are told, the innermost first.
    DEPTH = 8

    def __init__(self):
        self._main = threading.get_ident()
        self._places, self._found = [], []
        self._last = time.monotonic(), time.thread_time()
        self._over = threading.Event()
        self._timer = QtCore.QTimer(Gui.getMainWindow())
        self._timer.timeout.connect(self._beat)
        self._timer.start(self.BEAT)
        threading.Thread(target=self._look, name="standstills", daemon=True).start()

    def _beat(self):
        now = time.monotonic(), time.thread_time()
        wall, processor = (b - a for a, b in zip(self._last, now, strict=True))
        places, self._places = self._places, []
        self._last = now
        if wall > self.LEAST:
            self._found.append((wall, processor, places))

    def _look(self):
        while not self._over.wait(self.LEAST):
            if time.monotonic() - self._last[0] > self.LEAST:
                self._places.append(self._place())

    def _place(self):
        """Where the main thread is: file:line function, the innermost first."""
        frame, calls = sys._current_frames()[self._main], []
        while frame is not None and len(calls) < self.DEPTH:
            code = frame.f_code
            calls.append(f"{Path(code.co_filename).stem}:{frame.f_lineno} {code.co_name}")
            frame = frame.f_back
        return " < ".join(calls)

    def tell(self, what):
        """Print and note those since the last time, and what the main thread did in them.

        Where the driver itself waits for its tools is left out.
        """
        found, self._found = self._found, []
        kept = []
        for wall, processor, places in found:
            ours = [place for place in places if not place.startswith(("driving", "subprocess"))]
            if ours or not places:
                kept.append((round(wall, 2), round(processor, 2), ours))
        figures[f"stood still, s, of a processor, where: {what}"] = kept
        for wall, processor, places in kept:
            print(f"{what}: {wall} s, {processor} s of a processor", file=sys.__stdout__)
            for place in places:
                print(f"    {place}", file=sys.__stdout__, flush=True)

    def end(self):
        """Look no more."""
        self._over.set()
        self._timer.stop()


def comes_true(condition, seconds):
    """Wait for a condition that may stay false; returns whether it came true."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if condition():
            return True
        wait(20)
    return bool(condition())


def wait_until(condition, seconds=PATIENCE):
    """Wait for a condition that must come true; returns whether it did, and fails otherwise."""
    done = comes_true(condition, seconds)
    if not done:
        caller = sys._getframe(1)
        place = f"{Path(caller.f_code.co_filename).name}:{caller.f_lineno}"
        fail(f"{place}: {caller.f_code.co_name} waits in vain")
    return done


class Watch(QtCore.QObject):
    """Calls `look` from Qt's own loop, whatever box or menu runs it, until it returns true.

    What it raises fails the check, and so does a check's end before it returned true, unless it is
    told to `stop`. It is never called again once it is over.
    """

    _all: "list[Watch]" = []  # noqa: RUF012

    def __init__(self, look, what):
        super().__init__()
        self.look, self.what, self.over = look, what, False
        Watch._all.append(self)
        self._timer = QtCore.QTimer(self)
        self._timer.setSingleShot(True)
        self._timer.timeout.connect(self._tick)
        self._timer.start(50)

    def _tick(self):
        if self.over:
            return
        try:
            done = self.look()
        except Exception as error:
            fail_by(error, f"{self.what}: ")
            done = True
        if done:
            self.stop()
        elif not self.over:
            self._timer.start(50)

    def stop(self):
        """Look no more."""
        self.over = True
        self._timer.stop()
        if self in Watch._all:
            Watch._all.remove(self)

    @staticmethod
    def end_all():
        """The check is over: what it still watches for never came."""
        for watch in list(Watch._all):
            watch.stop()
            fail(f"{watch.what} never came")


def settle(seconds=PATIENCE):
    """Wait until the window has done what was asked for: returns whether it has.

    Nothing is left in Qt's queue, no mesh is being made, no timer of the task panel runs, and every
    button of ours can be used as its command says, which FreeCAD looks at from time to time.
    """
    done = comes_true(lambda: not _unsettled(), seconds)
    if not done:
        fail(f"the window does not settle: {_unsettled()}")
    for _ in range(3):
        QtCore.QCoreApplication.sendPostedEvents()
        QtCore.QCoreApplication.processEvents()
    return done


def _unsettled():
    """What the window has still to do, or an empty text."""
    if are_there_jobs():
        return "a mesh is being made"
    if are_there_questions():
        return "a preview is being made"
    form = panel()
    if form is not None and any(timer.isActive() for timer in form.findChildren(QtCore.QTimer)):
        return "the panel's timer"
    if QtGui.QApplication.activeModalWidget() is not None:
        return ""
    buttons = dict(_toolbar_buttons())
    for name in _our_commands():
        command = Gui.Command.get(name)
        button = buttons.get(command.getInfo()["menuText"].replace("&", ""))
        if button is not None and button.isEnabled() != command.isActive():
            return name
    return ""


def _our_commands(known=[]):  # noqa: B006
    """The workbench's commands, which do not change once they are there."""
    if not known:
        known += [name for name in Gui.Command.listAll() if name.startswith("VOLFREP_")]
    return known


class _Landing(QtCore.QObject):
    """Sees whether a real click has reached the window, and whether it hit a widget."""

    def __init__(self, widget=None):
        super().__init__()
        self.widget = widget
        self.pressed = self.released = self.slipped = False
        QtGui.QApplication.instance().installEventFilter(self)

    def eventFilter(self, target, event):  # noqa: N802
        """Note it and let it pass."""
        kind = event.type()
        if kind in (QtCore.QEvent.MouseButtonPress, QtCore.QEvent.MouseButtonDblClick):
            self.pressed = self.pressed or self._is_ours(target)
        elif kind == QtCore.QEvent.MouseButtonRelease:
            self.released = True
            if isinstance(self.widget, QtGui.QAbstractButton) and target is self.widget:
                # Moved away under the mouse, a button takes its release for none.
                self.slipped = not self.widget.rect().contains(event.pos())
        return False

    def _is_ours(self, target):
        return (
            self.widget is not None
            and isinstance(target, QtGui.QWidget)
            and (target is self.widget or self.widget.isAncestorOf(target))
        )

    def wait(self):
        """For it to come; returns whether the widget was hit."""
        comes_true(lambda: self.released, PATIENCE)
        QtGui.QApplication.instance().removeEventFilter(self)
        if not self.released:
            fail(f"a click at {QtGui.QCursor.pos().toTuple()} is not seen")
        return self.pressed and not self.slipped


def move_mouse(point):
    """Really move the mouse to a point of the screen."""
    if point.x() < 0 or point.y() < 0:
        raise ValueError(f"{point.toTuple()} is not on the screen")
    xdotool("mousemove", point.x(), point.y())
    if not comes_true(lambda: QtGui.QCursor.pos() == point, PATIENCE):
        fail(f"the mouse is at {QtGui.QCursor.pos().toTuple()} instead of {point.toTuple()}")


def press_button(*options, button=1, on=None):
    """A real click where the mouse is; returns whether it hit the widget `on`."""
    landing = _Landing(on)
    clicks.append(button)
    xdotool("click", *options, button)
    return landing.wait()


def xdotool(*arguments):
    """One call of the tool that sends real mouse and key events to the X server."""
    subprocess.run(["xdotool", *map(str, arguments)], check=True)


def click(widget):
    """A real click in the middle of a widget, once it is there to be clicked."""
    start_by_click(widget)
    settle()


def start_by_click(widget):
    """The same, without waiting for what comes of it."""
    if isinstance(widget, Entry):
        widget.open()
        return
    for _ in range(TRIES):
        hover(widget)
        # What is laid out between the look and the click may move it away: a user clicks again.
        if press_button(on=widget):
            break
        print(f"a click misses {type(widget).__name__} '{widget.objectName()}'", flush=True)
    else:
        fail(f"{TRIES} clicks miss {type(widget).__name__} '{widget.objectName()}'")


def hover(widget):
    """Scroll to a widget and move the mouse over its middle, once nothing lies on top of it."""

    def is_on_top():
        _scroll_to(widget)  # again: what is above it may grow
        over = QtGui.QApplication.widgetAt(middle(widget))
        hit = over is widget or (over is not None and widget.isAncestorOf(over))
        return widget.isVisible() and hit

    _scroll_to(widget)
    wait_until(is_on_top)
    move_mouse(middle(widget))


def in_sight(widget):
    """Scroll what a widget is in, so that it is seen: FreeCAD 1.1 leaves panels less room."""
    _scroll_to(widget)
    settle()


def _scroll_to(widget):
    for area in Gui.getMainWindow().findChildren(QtGui.QScrollArea):
        if area.isAncestorOf(widget):
            area.ensureWidgetVisible(widget)


def middle(widget):
    """Where a widget's middle is on the screen; a box to tick is where its mark is."""
    point = widget.rect().center()
    if isinstance(widget, (QtGui.QCheckBox, QtGui.QRadioButton)):
        point.setX(min(point.x(), 10))
    return widget.mapToGlobal(point)


def when_dialog(kind, act):
    """Once a modal dialog of a kind is there, call `act` with it, from Qt's own loop."""

    def look():
        dialog = QtGui.QApplication.activeModalWidget()
        if not isinstance(dialog, kind) or not dialog.isVisible():
            return False
        act(dialog)
        return True

    return Watch(look, f"a {kind.__name__}")


def answer_file_dialog(path, name):
    """Once a file dialog is there, really type a path into it and press Return."""

    def answer(dialog):
        edit = dialog.findChild(QtGui.QLineEdit, "fileNameEdit")
        edit.setFocus()
        xdotool("windowfocus", int(dialog.winId()))
        wait_until(edit.hasFocus)
        xdotool("key", "ctrl+a")
        xdotool("type", str(path))
        wait_until(lambda: edit.text() == str(path))
        picture(name)
        for _ in range(ANSWERS):  # a list of files that begin so may take the first one
            xdotool("key", "Return")
            if comes_true(lambda: QtGui.QApplication.activeModalWidget() is not dialog, 2.0):
                return
        fail(f"the dialog for {path} stays open")
        dialog.reject()

    when_dialog(QtGui.QFileDialog, answer)


def preferences_open(visit, keep=True):
    """Open the preferences at VOLFREP, let `visit` do its work in them, and close them (by OK)."""

    def look():
        dialog = QtGui.QApplication.activeModalWidget()
        if dialog is None or dialog.findChild(QtGui.QWidget, "DisplayPage") is None:
            return False
        try:
            visit(dialog)
        finally:
            (dialog.accept if keep else dialog.reject)()
        return True

    Watch(look, "the preferences' window")
    Gui.showPreferences("VOLFREP", 0)
    settle()


def turn_to(page, dialog):
    """Bring a page of the preferences to the front: behind a tab (0.20) or in a tree (1.0)."""
    for kind in (QtGui.QTabWidget, QtGui.QStackedWidget):
        for holder in dialog.findChildren(kind):
            for number in range(holder.count()):
                if holder.widget(number).isAncestorOf(page):
                    holder.setCurrentIndex(number)
    settle()


def picture(name):
    """The whole screen as a file."""
    settle()
    Gui.updateGui()
    shoot(name)


def shoot(name):
    """The whole screen as it is now, hardly compressed, which would take most of the time."""
    QtGui.QGuiApplication.sync()
    image = QtGui.QGuiApplication.primaryScreen().grabWindow(0)
    if not image.save(str(OUT / f"{name}.png"), "PNG", 85):
        raise OSError(f"the picture {name} cannot be written")


def mark(name, *widgets):
    """Note where the user clicks in a picture; tools/docs_pictures.sh rings it."""
    corners = [(widget, widget.mapToGlobal(QtCore.QPoint(0, 0))) for widget in widgets]
    places = [f"{c.x()},{c.y()} {c.x() + w.width()},{c.y() + w.height()}" for w, c in corners]
    (OUT / f"{name}.marks").write_text("".join(f"{place}\n" for place in places))


def look_at_all(from_below=False):
    """All of the document from above (or below) and the side.

    In FreeCAD's isometric view the struts along the diagonals of cells would hide each other.
    """
    look_along(App.Rotation(25, 0, 118 if from_below else 62))
    Gui.SendMsgToActiveView("ViewFit")
    settle()


def look_along(turn):
    """Turn the camera of the view in front, and see that it has turned."""
    view = Gui.activeDocument().activeView()
    view.setCameraOrientation(turn.Q)
    wait_until(lambda: view.getCameraOrientation().isSame(turn, 1e-5))


def view_3d():
    """The window of the 3D view in front."""
    return Gui.getMainWindow().findChild(QtGui.QMdiArea).currentSubWindow().widget()


def shades(name, widget):
    """How many colours a picture has where a widget is; a blank one has one or two."""
    return len(np.unique(seen(name, widget).reshape(-1, 3), axis=0))


def lightness(name, widget):
    """How light a picture is where a widget is, in the mean, from 0 to 1."""
    return float(seen(name, widget).mean()) / 255


def drawn_share(name):
    """Share of the middle of the 3D view, in a picture, that is not background.

    FreeCAD's background changes from row to row only, and nothing is drawn at its left border.
    """
    image = seen(name, view_3d()).astype(int)
    differs = np.abs(image - image[:, :1]).sum(axis=2) > 24
    return float(_middle_of(differs).mean())


def red_share(name):
    """Share of the middle of the 3D view, in a picture, that is more red than anything else."""
    red, green, blue = np.moveaxis(_middle_of(seen(name, view_3d())), 2, 0)
    return float((red > 1.2 * np.maximum(green, blue)).mean())


def _middle_of(image):
    """A picture without a fifth at every side."""
    rows, columns = image.shape[0] // 5, image.shape[1] // 5
    return image[rows:-rows, columns:-columns]


def seen(name, widget):
    """Colours of a picture where a widget is: rows, columns, and red, green and blue to 255."""
    image = QtGui.QImage(str(OUT / f"{name}.png")).convertToFormat(QtGui.QImage.Format_RGB32)
    rows = np.frombuffer(image.constBits(), np.uint8).reshape(image.height(), -1, 4)
    corner = widget.mapToGlobal(QtCore.QPoint(0, 0))
    top, left = max(corner.y(), 0), max(corner.x(), 0)
    part = rows[top : corner.y() + widget.height(), left : corner.x() + widget.width()]
    return part[:, :, 2::-1].copy()


class Entry:
    """A command in a drop-down of the toolbar, which is clicked at by way of its arrow."""

    def __init__(self, button, action):
        self.button, self._action = button, action
        self.text = action.text().replace("&", "")

    def __getattr__(self, name):
        """Whether it can be used, and its tips, are its own; its place is the button's."""
        holder = self._action if name in ("isEnabled", "toolTip", "statusTip") else self.button
        return getattr(holder, name)

    def open(self):
        """Really open the drop-down, and click at it."""
        wait_until(self.button.isEnabled)
        corner = self.button.rect().topRight() + QtCore.QPoint(-5, self.button.height() // 2)
        move_mouse(self.button.mapToGlobal(corner))

        def look():
            # The menu runs a loop of its own, in which this is called.
            menu = _open_menu(self.text)
            if menu is None:
                return False
            _click_entry(menu, self.text)
            return True

        watch = Watch(look, f"the drop-down with {self.text}")
        xdotool("click", 1)
        comes_true(lambda: watch.over, PATIENCE)  # what never came is told at the check's end


def click_in_view(place, done):
    """Really click at a point of the part, mm, until it has done what it is to do.

    A user whose click is not seen by a busy window clicks again.
    """
    Gui.updateGui()
    view = view_3d()
    x, y = Gui.activeDocument().activeView().getPointOnScreen(App.Vector(*place))
    corner = view.mapToGlobal(view.rect().bottomLeft())
    for _ in range(5):
        move_mouse(QtCore.QPoint(corner.x() + x + 4, corner.y() - y))
        move_mouse(QtCore.QPoint(corner.x() + x, corner.y() - y))
        press_button()
        settle()
        if comes_true(done, 5):
            return
    fail(f"clicks at {place} do nothing")


def _toolbar_buttons():
    """Texts and buttons of the workbench's toolbar, and the entries of its drop-downs."""
    for bar in Gui.getMainWindow().findChildren(QtGui.QToolBar):
        if bar.windowTitle().startswith("VOLFREP") and bar.isVisible():
            for action in bar.actions():
                button = bar.widgetForAction(action)
                if isinstance(button, QtGui.QToolButton) and button.menu() is not None:
                    entries = [Entry(button, one) for one in button.menu().actions()]
                    yield from ((entry.text, entry) for entry in entries)
                else:
                    yield action.text().replace("&", ""), button


def toolbar_button(name):
    """The button of a command in the workbench's toolbar, or its entry in a drop-down."""
    for text, button in _toolbar_buttons():
        if text == name:
            return button
    raise LookupError(f"no button {name}")


def _click_entry(menu, text):
    """Really click an entry of an open menu or of the menu bar."""
    # Asked for anew each time: to ask an entry for its submenu spoils Qt's wrappers of both.
    entry = next(entry for entry in menu.actions() if entry.text().replace("&", "") == text)
    move_mouse(menu.mapToGlobal(menu.actionGeometry(entry).center()))
    press_button()


def _open_menu(text):
    """The menu in front, once it is drawn and has an entry, or None."""
    menu = QtGui.QApplication.activePopupWidget()
    if not isinstance(menu, QtGui.QMenu) or not menu.isVisible():
        return None
    return menu if text in [entry.text().replace("&", "") for entry in menu.actions()] else None


def click_menu(*texts):
    """Really click through FreeCAD's menu bar."""
    _click_entry(Gui.getMainWindow().menuBar(), texts[0])
    for text in texts[1:]:
        if not wait_until(lambda text=text: _open_menu(text) is not None):
            _close_menus()
            return
        _click_entry(_open_menu(text), text)
    settle()


def _close_menus():
    """Menus that are open, from the last to the first."""
    while QtGui.QApplication.activePopupWidget() is not None:
        QtGui.QApplication.activePopupWidget().close()


def context_menu(obj, read):
    """Really right-click an object in the tree; `read` gets the open menu, inside its own loop."""
    click_in_tree(obj.Label)

    def look():
        menu = QtGui.QApplication.activePopupWidget()
        if not isinstance(menu, QtGui.QMenu) or not menu.isVisible():
            return False
        try:
            read(menu)
        finally:
            _close_menus()
        return True

    watch = Watch(look, f"the context menu of {obj.Label}")
    xdotool("click", 3)
    comes_true(lambda: watch.over, PATIENCE)  # what never came is told at the check's end
    settle()


def choose_in_context_menu(obj, *texts):
    """Really click through an object's context menu."""

    def read(menu):
        for text in texts:
            if wait_until(lambda text=text: _open_menu(text) is not None):
                _click_entry(_open_menu(text), text)

    context_menu(obj, read)


def show_model():
    """The tree and the properties in front: FreeCAD 1.0 may leave the empty tasks there."""
    _show_tab("Model")


def show_tasks():
    """The open task panel in front again, where the tree has taken its place."""
    _show_tab("Tasks")


def _show_tab(name):
    for bar in Gui.getMainWindow().findChildren(QtGui.QTabBar):
        for tab in range(bar.count()):
            if bar.tabText(tab) == name:
                bar.setCurrentIndex(tab)
    settle()


def tree():
    """FreeCAD's model tree."""
    trees = Gui.getMainWindow().findChildren(QtGui.QTreeWidget)
    names = [widget.metaObject().className() for widget in trees]
    return next(t for t, n in zip(trees, names, strict=True) if n == "Gui::TreeWidget")


def tree_items():
    """Items of the model tree by their labels."""
    items, iterator = {}, QtGui.QTreeWidgetItemIterator(tree())
    while iterator.value():
        items.setdefault(iterator.value().text(0), iterator.value())
        iterator += 1
    return items


def tree_item(label):
    """An object's item in the model tree, which shows it a moment after the document has it."""
    wait_until(lambda: label in tree_items())
    return tree_items()[label]


def click_in_tree(label):
    """Really click an object's item in the model tree."""
    show_model()
    item = tree_item(label)
    click_item(tree(), item)


def infills(doc):
    """The document's lattice infills."""
    return [obj for obj in doc.Objects if obj.TypeId == "Mesh::FeaturePython"]


def select(*objects):
    """Select these objects only, and let the toolbar notice."""
    Gui.Selection.clearSelection()
    for obj in objects:
        Gui.Selection.addSelection(obj)
    settle()


def panel():
    """The open task panel, or None."""
    found = Gui.getMainWindow().findChildren(QtGui.QWidget, "VolfrepTaskPanel")
    return next((widget for widget in found if widget.isVisible()), None)


def window(name):
    """An open window of ours by its object name, or None."""
    found = Gui.getMainWindow().findChildren(QtGui.QDialog, name)
    return next((w for w in found if w.isVisible()), None)


def section_docks():
    """The open docks of section views."""
    docks = Gui.getMainWindow().findChildren(QtGui.QDockWidget, "VolfrepSectionView")
    return [dock for dock in docks if dock.isVisible()]


def said():
    """All that the report view holds."""
    QtCore.QCoreApplication.sendPostedEvents()
    view = Gui.getMainWindow().findChild(QtGui.QTextEdit, "Report view")
    return "" if view is None else view.toPlainText()


def previews():
    """How many previews are in the 3D view."""
    scene = Gui.activeDocument().activeView().getSceneGraph()
    names = [scene.getChild(k).getName().getString() for k in range(scene.getNumChildren())]
    return names.count("VolfrepPreview")


def panel_part(name, kind=QtGui.QWidget):
    """A widget of the task panel by the name of its property."""
    return panel().findChild(kind, name)


def told():
    """What the task panel says: below the field that it is about, or else with the figures."""
    labels = [label for label in panel().findChildren(QtGui.QLabel, "Wrong") if label.isVisible()]
    return (labels or [panel_part("Figures")])[0].text()


def choose_lattice(tab, name):
    """Really click a tab of the panel's first section, and a picture in it."""
    tabs = panel_part("LatticeTabs", QtGui.QTabBar)
    number = ("Unit cells", "TPMS", "Networks").index(tab)
    if tabs.currentIndex() != number:
        in_sight(tabs)
        move_mouse(tabs.mapToGlobal(tabs.tabRect(number).center()))
        press_button()
        wait_until(lambda: tabs.currentIndex() == number)
    pictures = panel_part("CellType")
    click_item(pictures, pictures.findItems(name, QtCore.Qt.MatchExactly)[0])


def answer_panel(text):
    """Really click OK or Cancel of the task panel."""
    start_answer(text)
    settle()


def start_answer(text):
    """The same, without waiting for what comes of it."""
    for button in Gui.getMainWindow().findChildren(QtGui.QPushButton):
        if button.isVisible() and button.text().replace("&", "") == text:
            start_by_click(button)
            return
    raise LookupError(f"no button {text}")


def click_item(view, item):
    """Really click on an item of a list or a tree."""
    view.scrollToItem(item)
    settle()
    move_mouse(view.viewport().mapToGlobal(view.visualItemRect(item).center()))
    press_button()
    settle()


def type_value(name, text):
    """Really type over what is in one of the panel's fields."""
    type_into(panel_part(name), text)


def type_into(field, text):
    """Really type over what is in a field."""
    click(field)
    holders = [field, *field.findChildren(QtGui.QWidget)]
    wait_until(lambda: QtGui.QApplication.focusWidget() in holders)
    typed_into = QtGui.QApplication.focusWidget()
    xdotool("key", "ctrl+a")
    xdotool("type", text)
    xdotool("key", "Tab")
    wait_until(lambda: QtGui.QApplication.focusWidget() is not typed_into)
    settle()


@contextmanager
def jobs_that_never_end():
    """Calls of the engine sleep in their process until they are cancelled."""
    from volfrep.process.engines import Engines
    from volfrep.process.worker import Call

    begin = Engines.begin
    Engines.begin = lambda self, call: begin(
        self, Call(time.sleep, (10 * PATIENCE,), has_progress=False)
    )
    try:
        yield
    finally:
        Engines.begin = begin


def progress_bar():
    """What a running job shows in the status bar, or None."""
    bar = Gui.getMainWindow().findChild(QtGui.QWidget, "VolfrepProgress")
    return bar if bar is not None and bar.isVisible() else None


class UnexpectedMessages(QtCore.QObject):
    """Closes message boxes that nobody answers within seconds, and notes what they say."""

    def __init__(self):
        super().__init__()
        self.box = None
        timer = QtCore.QTimer(self)
        timer.timeout.connect(self.look)
        timer.start(5000)

    def look(self):
        """Every five seconds: close what was there the last time too."""
        box = QtGui.QApplication.activeModalWidget()
        box = box if isinstance(box, QtGui.QMessageBox) else None
        if box is not None and box is self.box:
            fail(f"unexpected message: {box.text()}")
            box.reject()
        self.box = box


def clear():
    """What a check leaves behind goes: dialogs, the panel, our windows, documents, a selection."""
    _close_menus()
    for _ in range(5):
        dialog = QtGui.QApplication.activeModalWidget()
        if dialog is None:
            break
        dialog.close()
        settle()
    if Gui.Control.activeDialog():
        Gui.Control.closeDialog()
    for name in list(App.listDocuments()):
        App.closeDocument(name)
    for window in Gui.getMainWindow().findChildren(QtGui.QDialog):
        if window.objectName().startswith("Volfrep") and window.isVisible():
            window.close()
    for dock in section_docks():
        dock.close()
    # Where a dock wants more room, the window grows beyond the screen: no window manager holds it.
    Gui.getMainWindow().setGeometry(QtGui.QApplication.primaryScreen().geometry())
    Gui.Selection.clearSelection()
    App.ParamGet("User parameter:BaseApp/Preferences/Mod/VOLFREP").Clear()
    fold_sections(False)
    if Gui.activeWorkbench().name() != "VolfrepWorkbench":
        Gui.activateWorkbench("VolfrepWorkbench")
    settle()
    view = Gui.getMainWindow().findChild(QtGui.QTextEdit, "Report view")
    if view is not None:
        view.clear()


def fold_sections(as_usual=True):
    """The task panel's sections as a new user finds them, or all open: what is folded is not seen.

    Told before the panel is opened.
    """
    from freecad_volfrep.gui.widgets.sections import FOLDED
    from freecad_volfrep.preferences import keep_folded

    for section in FOLDED:
        keep_folded(section, as_usual, usually=True)


_slow = []
_costly = []


def slow(function):
    """Mark a check that waits for `make test-slow`, because others show the same sooner."""
    _slow.append(function)
    return function


def costly(function):
    """Mark a check that `make test` leaves to the windows of later FreeCADs and to `test-slow`."""
    _costly.append(function)
    return function


def is_wanted(function):
    """Whether a check is one of those that GUI_CHECKS names or, without names, that MARK means.

    MARK is pytest's word: slow, costly, either with "not" before it, or several with "and" or "or".
    """
    wanted = os.environ.get("GUI_CHECKS", "").split()
    if wanted:
        return function.__name__ in wanted
    marks = {"slow": function in _slow, "costly": function in _costly}
    return bool(eval(os.environ.get("MARK") or "True", {"__builtins__": {}}, marks))


#: Tables of checks by their names: of one script, or of those that share a window.
_tables = {}


def run_checks(name, checks):
    """Run those of the checks that are wanted, each in a window that was cleared.

    Where several scripts share a window (together.py) they are kept for `run_tables`.

    Args:
        name: of the file of figures.
        checks: functions, each with what makes its arguments (a tuple), or None for none.
    """
    _tables[name] = checks
    if "GUI_SCRIPTS" not in os.environ:
        run_tables()


def run_tables():
    """Run the checks of all tables, one table after the other."""
    wanted = os.environ.get("GUI_CHECKS", "").split()
    known = {function.__name__ for checks in _tables.values() for function in checks}

    def drive(name):
        global _running
        for function, make in _tables[name].items():
            one = function.__name__
            if not is_wanted(function):
                continue
            _running = one
            print(f"check: {one}", file=sys.__stdout__, flush=True)
            longest = LONGEST_SLOW if function in _slow else LONGEST
            hangs = threading.Timer(longest, _give_up, (name, longest))
            hangs.daemon = True
            hangs.start()
            start, used = time.monotonic(), processor_seconds()
            try:
                clear()
                function(*(make() if make is not None else ()))
                settle()
            except Exception as error:
                fail_by(error)
            hangs.cancel()
            Watch.end_all()
            check("nothing is raised in the window", "Traceback" not in said(), said()[-2000:])
            figures[f"seconds: {one}"] = round(time.monotonic() - start, 1)
            figures[f"processor: {one}"] = round(processor_seconds() - used, 1)
        _running = ""
        clear()

    def drive_all():
        for one in sorted(set(wanted) - known):
            fail(f"there is no check '{one}': {', '.join(sorted(known))}")
        for name in _tables:
            try:
                drive(name)
            finally:
                _write(name)

    _run(drive_all)


def processor_seconds():
    """Of this process, of those that it has started, and of those that are over, in s."""
    ticks = 0
    for stat in Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = stat.read_text().rpartition(")")[2].split()
        except OSError:  # it has ended meanwhile
            continue
        if int(fields[1]) == os.getpid():
            ticks += sum(map(int, fields[11:15]))
    return sum(os.times()[:4]) + ticks / os.sysconf("SC_CLK_TCK")


def _give_up(name, longest):
    """The running check does not end: say where it is, and leave."""
    fail(f"does not end within {longest} s; what runs is said above")
    faulthandler.dump_traceback(file=sys.__stderr__, all_threads=True)
    _write(name)
    os._exit(1)


def _write(name):
    """A table's figures and all failures as a file."""
    figures["failures"] = failures
    (OUT / f"{name}.json").write_text(json.dumps(figures, indent=1), encoding="utf-8")
    figures.clear()


def _share_depths():
    """Most checks open a panel on the same box: how deep points lie in it is found once."""
    from freecad_volfrep.engine import require_engine

    require_engine()
    sys.path.append(str(Path(__file__).resolve().parents[1] / "core"))
    import shared_stages

    shared_stages.share_depths()


def _run(drive):
    """Once FreeCAD is up: drive and leave."""
    # PySide tells what a slot or an event's handler raises to this, and goes on.
    sys.excepthook = lambda kind, error, trace: fail_by(error, "in a slot: ")
    threading.excepthook = lambda raised: fail_by(raised.exc_value, "on a thread: ")

    def main():
        watch = UnexpectedMessages()
        try:
            wait_until(Gui.getMainWindow().isVisible)
            # FreeCAD 1.0 turns the camera by and by, and a picture would catch it on its way.
            view = App.ParamGet("User parameter:BaseApp/Preferences/View")
            view.SetBool("UseNavigationAnimations", False)
            Gui.activateWorkbench("VolfrepWorkbench")
            settle()
            _share_depths()
            drive()
        except BaseException as error:  # FreeCAD's abort is no Exception
            fail_by(error)
        watch.deleteLater()
        if not failures:
            print("every check held", file=sys.__stdout__)
        sys.__stdout__.flush()
        os._exit(1 if failures else 0)

    QtCore.QTimer.singleShot(0, main)

# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the scripts share that drive the workbench in the real FreeCAD; see tools/run_gui.sh.

A script is a table of checks, each a function that stands alone: `run_checks` runs those that were
asked for, a failing one does not hide the others, and FreeCAD is left with 0 when every check held.
Nothing waits for a time that was guessed: `settle` waits until the window has nothing left to do.
"""

import json
import os
import subprocess
import sys
import time
import traceback
from pathlib import Path

import FreeCAD as App
import FreeCADGui as Gui
from PySide import QtCore, QtGui

OUT = Path(os.environ["GUI_OUT"])
figures = {}
failures = []


#: The check that is running, by its function's name.
_running = ""


def check(name, holds, detail=""):
    """Note whether something holds; go on whatever it says."""
    figures[name] = bool(holds)
    if not holds:
        failures.append(f"{_running}: {name} {detail}".strip().removeprefix(": "))


def step(function, *arguments):
    """One step of a script: note its seconds; returns what it returns."""
    start = time.monotonic()
    result = function(*arguments)
    figures[f"seconds: {function.__name__}"] = round(time.monotonic() - start, 1)
    return result


def wait(milliseconds):
    """Let Qt run for a time; only what `wait_until` cannot be asked for needs it."""
    loop = QtCore.QEventLoop()
    QtCore.QTimer.singleShot(milliseconds, loop.quit)
    (loop.exec if hasattr(loop, "exec") else loop.exec_)()


def wait_until(condition, seconds):
    """Wait for a condition; returns whether it came true."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if condition():
            return True
        wait(20)
    return bool(condition())


def settle(seconds=10):
    """Wait until the window has done what was asked for: returns whether it has.

    Nothing is left in Qt's queue, no timer of the task panel runs, and every button of ours can be
    used as its command says, which FreeCAD looks at from time to time.
    """
    done = wait_until(_is_settled, seconds)
    if not done:
        figures["not settled"] = [*figures.get("not settled", ()), _running]
    for _ in range(3):
        QtCore.QCoreApplication.sendPostedEvents()
        QtCore.QCoreApplication.processEvents()
    return done


def _is_settled():
    form = panel()
    if form is not None and any(timer.isActive() for timer in form.findChildren(QtCore.QTimer)):
        return False
    if QtGui.QApplication.activeModalWidget() is not None:
        return True
    for name in Gui.Command.listAll():
        if name.startswith("VOLFREP_"):
            command = Gui.Command.get(name)
            text = command.getInfo()["menuText"].replace("&", "")
            button = next((b for t, b in _toolbar_buttons() if t == text), None)
            if button is not None and button.isEnabled() != command.isActive():
                return False
    return True


class _Arrived(QtCore.QObject):
    """Sees whether a real event of the mouse has reached the window."""

    def __init__(self, kind):
        super().__init__()
        self.kind, self.seen = kind, False
        QtGui.QApplication.instance().installEventFilter(self)

    def eventFilter(self, widget, event):  # noqa: N802
        """Note it and let it pass."""
        if event.type() == self.kind:
            self.seen = True
        return False

    def wait(self):
        """For it to come, a few seconds at most: a menu or a dialog may keep it for itself."""
        if not wait_until(lambda: self.seen, 3):
            figures["clicks not seen"] = [*figures.get("clicks not seen", ()), _running]
        QtGui.QApplication.instance().removeEventFilter(self)


def move_mouse(point):
    """Really move the mouse to a point of the screen."""
    xdotool("mousemove", point.x(), point.y())
    wait_until(lambda: QtGui.QCursor.pos() == point, 3)


def press_button(*options):
    """A real click where the mouse is."""
    arrived = _Arrived(QtCore.QEvent.MouseButtonRelease)
    xdotool("click", *options, 1)
    arrived.wait()


def xdotool(*arguments):
    """One call of the tool that sends real mouse and key events to the X server."""
    subprocess.run(["xdotool", *map(str, arguments)], check=True)


def click(widget):
    """A real click in the middle of a widget."""
    point = widget.mapToGlobal(widget.rect().center())
    move_mouse(point)
    press_button()
    settle()


def when_dialog(kind, act, seconds=30):
    """Once a modal dialog of a kind is there, call `act` with it, from Qt's own loop."""
    end = time.monotonic() + seconds

    def look():
        dialog = QtGui.QApplication.activeModalWidget()
        if isinstance(dialog, kind):
            act(dialog)
        elif time.monotonic() < end:
            QtCore.QTimer.singleShot(50, look)

    QtCore.QTimer.singleShot(50, look)


def picture(name):
    """The whole screen as a file."""
    settle()
    Gui.updateGui()
    QtGui.QGuiApplication.sync()
    subprocess.run(["import", "-window", "root", str(OUT / f"{name}.png")], check=True)


def look_at_all(from_below=False):
    """All of the document from above (or below) and the side.

    In FreeCAD's isometric view the struts along the diagonals of cells would hide each other.
    """
    turn = App.Rotation(25, 0, 118 if from_below else 62)
    Gui.activeDocument().activeView().setCameraOrientation(turn.Q)
    Gui.SendMsgToActiveView("ViewFit")
    settle()


def view_3d():
    """The window of the 3D view in front."""
    return Gui.getMainWindow().findChild(QtGui.QMdiArea).currentSubWindow().widget()


def shades(name, widget):
    """How many colours a picture has where a widget is; a blank one has one or two."""
    return len(set(_sampled(name, widget, 0.0).values()))


def lightness(name, widget):
    """How light a picture is where a widget is, in the mean, from 0 to 1."""
    colours = [_channels(colour) for colour in _sampled(name, widget, 0.0).values()]
    return sum(map(sum, colours)) / (3 * 255 * len(colours))


def drawn_share(name):
    """Share of the middle of the 3D view, in a picture, that is not background.

    FreeCAD's background changes from row to row only, and nothing is drawn at its left border.
    """
    pixels = _sampled(name, view_3d(), 0.2)
    border = _sampled(name, view_3d(), 0.0)
    background = {y: colour for (x, y), colour in sorted(border.items(), reverse=True)}
    differs = [_distance(colour, background[y]) > 24 for (_, y), colour in pixels.items()]
    return sum(differs) / len(differs)


def red_share(name):
    """Share of the middle of the 3D view, in a picture, that is more red than anything else."""
    pixels = [_channels(colour) for colour in _sampled(name, view_3d(), 0.2).values()]
    return sum(red > 1.2 * max(green, blue) for red, green, blue in pixels) / len(pixels)


def _channels(colour):
    """Red, green and blue from 0 to 255."""
    return colour >> 16 & 255, colour >> 8 & 255, colour & 255


def _sampled(name, widget, margin, step=4):
    """Colours by place on the screen, within a widget without a margin of its size."""
    image = QtGui.QImage(str(OUT / f"{name}.png"))
    corner = widget.mapToGlobal(QtCore.QPoint(0, 0))
    places = []
    for low, size, most in (
        (corner.x(), widget.width(), image.width()),
        (corner.y(), widget.height(), image.height()),
    ):
        first, last = low + int(margin * size), low + int((1.0 - margin) * size)
        places.append([k for k in range(low + 2, low + size, step) if first <= k < min(last, most)])
    return {(x, y): image.pixel(x, y) & 0xFFFFFF for x in places[0] for y in places[1]}


def _distance(one, two):
    """Sum of the differences of red, green and blue."""
    return sum(abs(a - b) for a, b in zip(_channels(one), _channels(two), strict=True))


def _toolbar_buttons():
    """Texts and buttons of the workbench's toolbars."""
    for bar in Gui.getMainWindow().findChildren(QtGui.QToolBar):
        if bar.windowTitle().startswith("VOLFREP") and bar.isVisible():
            for action in bar.actions():
                yield action.text().replace("&", ""), bar.widgetForAction(action)


def toolbar_button(name):
    """The button of a command in the workbench's toolbars."""
    for text, button in _toolbar_buttons():
        if text == name:
            return button
    raise LookupError(f"no button {name}")


def click_place(place):
    """A real click at a place of the screen."""
    xdotool("mousemove", place.x(), place.y())
    wait(250)
    xdotool("click", 1)
    wait(400)


def _click_entries(texts):
    """Really click through the entries of the open menu and of the submenus that open then."""
    for text in texts:
        # Asked for anew each time: to ask an entry for its submenu spoils Qt's wrappers of both.
        menu = QtGui.QApplication.activePopupWidget()
        entries = menu.actions()
        found = [entry for entry in entries if entry.text().replace("&", "") == text]
        if not found:
            failures.append(f"no entry {text} in {[entry.text() for entry in entries]}")
            menu.close()
            return
        click_place(menu.mapToGlobal(menu.actionGeometry(found[0]).center()))


def click_menu(*texts):
    """Really click through FreeCAD's menu bar."""
    bar = Gui.getMainWindow().menuBar()
    entries = bar.actions()
    entry = next(a for a in entries if a.text().replace("&", "") == texts[0])
    click_place(bar.mapToGlobal(bar.actionGeometry(entry).center()))
    _click_entries(texts[1:])


def context_menu(obj, *texts):
    """Really right-click an object in the tree, and click through what opens."""
    tree = next(t for t in Gui.getMainWindow().findChildren(QtGui.QTreeWidget) if t.isVisible())
    item = tree.findItems(obj.Label, QtCore.Qt.MatchExactly | QtCore.Qt.MatchRecursive)[0]
    click_item(tree, item)
    # The menu has a loop of its own: what is done in it is done from inside.
    QtCore.QTimer.singleShot(700, lambda: _click_entries(texts))
    xdotool("click", 3)
    wait(3000)


def tree_texts():
    """Labels of all the items of the model tree."""
    texts = set()
    for tree in Gui.getMainWindow().findChildren(QtGui.QTreeWidget):
        iterator = QtGui.QTreeWidgetItemIterator(tree)
        while iterator.value():
            texts.add(iterator.value().text(0))
            iterator += 1
    return texts


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


def previews():
    """How many previews are in the 3D view."""
    scene = Gui.activeDocument().activeView().getSceneGraph()
    names = [scene.getChild(k).getName().getString() for k in range(scene.getNumChildren())]
    return names.count("VolfrepPreview")


def panel_part(name, kind=QtGui.QWidget):
    """A widget of the task panel by the name of its property."""
    return panel().findChild(kind, name)


def answer_panel(text):
    """Really click OK or Cancel of the task panel."""
    for button in Gui.getMainWindow().findChildren(QtGui.QPushButton):
        if button.isVisible() and button.text().replace("&", "") == text:
            click(button)
            return
    raise LookupError(f"no button {text}")


def click_item(view, item):
    """Really click on an item of a list or a tree."""
    view.scrollToItem(item)
    point = view.viewport().mapToGlobal(view.visualItemRect(item).center())
    move_mouse(point)
    press_button()
    settle()


def type_value(name, text):
    """Really type over what is in one of the panel's fields."""
    field = panel_part(name)
    click(field)
    xdotool("key", "ctrl+a")
    xdotool("type", text)
    xdotool("key", "Tab")
    holders = [field, *field.findChildren(QtGui.QWidget)]
    wait_until(lambda: QtGui.QApplication.focusWidget() not in holders, 5)
    settle()


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
            failures.append(f"unexpected message: {box.text()}")
            box.reject()
        self.box = box


def clear():
    """What a check leaves behind goes: dialogs, the panel, our windows, documents, a selection."""
    for _ in range(5):
        dialog = QtGui.QApplication.activeModalWidget()
        if dialog is None:
            break
        dialog.close()
        settle(1)
    if Gui.Control.activeDialog():
        Gui.Control.closeDialog()
    for name in list(App.listDocuments()):
        App.closeDocument(name)
    for window in Gui.getMainWindow().findChildren(QtGui.QDialog):
        if window.objectName().startswith("Volfrep") and window.isVisible():
            window.close()
    Gui.Selection.clearSelection()
    App.ParamGet("User parameter:BaseApp/Preferences/Mod/VOLFREP").Clear()
    if Gui.activeWorkbench().name() != "VolfrepWorkbench":
        Gui.activateWorkbench("VolfrepWorkbench")
    settle()


def run_checks(name, checks):
    """Run checks, or those of them that GUI_CHECKS names, each in a window that was cleared.

    Args:
        name: of the file of figures.
        checks: functions, each with what makes its arguments (a tuple), or None for none.
    """
    wanted = os.environ.get("GUI_CHECKS", "").split()
    known = {function.__name__: (function, make) for function, make in checks.items()}

    def drive():
        global _running
        failures.extend(f"there is no check '{one}': {', '.join(known)}"
                        for one in wanted if one not in known)  # fmt: skip
        for one, (function, make) in known.items():
            if wanted and one not in wanted:
                continue
            _running = one
            print(f"check: {one}", file=sys.__stdout__, flush=True)
            try:
                clear()
                step(function, *(make() if make is not None else ()))
            except Exception:
                failures.append(f"{one}: {traceback.format_exc()}")
        _running = ""
        clear()

    run(drive, name)


def run(drive, name):
    """Once FreeCAD is up: drive, write down to ``name.json`` in GUI_OUT, leave."""

    def main():
        wait_until(Gui.getMainWindow().isVisible, 60)
        settle()
        code = 1
        watch = UnexpectedMessages()
        try:
            drive()
            code = 1 if failures else 0
        except BaseException:  # FreeCAD's abort is no Exception
            failures.append(traceback.format_exc())
            code = 1
        watch.deleteLater()
        figures["failures"] = failures
        (OUT / f"{name}.json").write_text(json.dumps(figures, indent=1), encoding="utf-8")
        print("\n".join(failures) or "every check held")
        sys.stdout.flush()
        os._exit(code)

    QtCore.QTimer.singleShot(0, main)

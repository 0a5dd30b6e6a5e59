# SPDX-License-Identifier: LGPL-2.1-or-later
"""A running job in the status bar: a bar, a Cancel button, and the Escape key.

While a job runs nothing else in FreeCAD can be started. A modal window would see to that, and take
the eye off the part; so all keys and clicks but those that cancel are taken out of the
application's events instead, which is what FreeCAD itself does while a document is recomputed.
FreeCAD's own progress indicator is not used: it cannot be cancelled by a click, its Escape asks a
question, and a recompute holds it already.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor, wait
from contextlib import contextmanager
from typing import TypeVar

import FreeCADGui as Gui

from freecad_volfrep.translation import marked, translate
from volfrep.util.errors import Cancelled, VolfrepError
from volfrep.util.progress import ProgressCallback

from .qt import QtCore, QtGui, QtWidgets

#: Quicker jobs show nothing, in ms.
SHOW_AFTER = 700
#: How often the window lives while a job runs on its thread, in s.
BREATH = 0.02
_STEPS = 1000
#: The engine's names of its stages, marked for translation.
STAGES = marked(
    "VolfrepProgress",
    "shell",
    "voxels",
    "tile",
    "lattice",
    "trim",
    "check",
    "crossings",
    "write",
    "skin",
    "sizing",
    "proof",
)
_EVENT = QtCore.QEvent
#: What a user does, none of which may reach FreeCAD while a job runs.
_INPUT = (
    _EVENT.KeyPress, _EVENT.KeyRelease, _EVENT.ShortcutOverride, _EVENT.Shortcut,
    _EVENT.MouseButtonPress, _EVENT.MouseButtonRelease, _EVENT.MouseButtonDblClick,
    _EVENT.MouseMove, _EVENT.Wheel, _EVENT.ContextMenu, _EVENT.DragEnter, _EVENT.Drop,
    _EVENT.NativeGesture, _EVENT.TouchBegin, _EVENT.TabletPress,
)  # fmt: skip

T = TypeVar("T")


class _Bar(QtWidgets.QWidget):
    """What is in the status bar: a text, a bar and a button."""

    def __init__(self, title: str) -> None:
        super().__init__(Gui.getMainWindow())
        self.setObjectName("VolfrepProgress")
        self._title = title
        self.text = QtWidgets.QLabel(title)
        self._bar = QtWidgets.QProgressBar()
        self._bar.setRange(0, _STEPS)
        self._bar.setFixedWidth(180)
        self._bar.setMaximumHeight(18)
        self.button = QtWidgets.QPushButton(translate("VolfrepProgress", "Cancel"))
        self.button.setObjectName("VolfrepCancel")
        self.button.setToolTip(translate("VolfrepProgress", "Stop this job (Esc)"))
        line = QtWidgets.QHBoxLayout(self)
        line.setContentsMargins(0, 0, 0, 0)
        for widget in (self.text, self._bar, self.button):
            line.addWidget(widget)

    def show_state(self, fraction: float, stage: str) -> None:
        """Show how far the job is, and what it does."""
        self.text.setText(f"{self._title}: {translate('VolfrepProgress', stage)}")
        self._bar.setValue(int(fraction * _STEPS))

    def under_pointer(self) -> bool:
        """Whether the pointer is on the button; a click is first the window's, not the button's."""
        place = self.button.mapFromGlobal(QtGui.QCursor.pos())
        return self.button.isVisible() and self.button.rect().contains(place)

    def show_cancelling(self) -> None:
        """Say that the click has arrived: what runs in a library must come to its end."""
        self.text.setText(translate("VolfrepProgress", "Cancelling..."))
        self.button.setEnabled(False)


class _Guard(QtCore.QObject):
    """Takes keys and clicks out of the application's events; Escape and Cancel set `cancelled`.

    Of the filters of an application the one installed last is asked first: this one sees events
    before FreeCAD's own, which swallows them during a recompute.

    A modal window gets all of its input, whoever opened it: FreeCAD asks whether to abort, or a
    recovery that failed wants an answer, and who cannot give it can do nothing but kill FreeCAD.
    Qt itself keeps the other windows' input away meanwhile.
    """

    def __init__(self, bar: _Bar) -> None:
        super().__init__()
        self._bar = bar
        self.cancelled = False

    def eventFilter(self, target: QtCore.QObject, event: QtCore.QEvent) -> bool:  # noqa: N802
        kind = event.type()
        if kind == _EVENT.Close and target is Gui.getMainWindow():
            event.ignore()  # FreeCAD stays until the job ends
            return True
        if kind not in _INPUT or QtWidgets.QApplication.activeModalWidget() is not None:
            return False
        # A key first comes as ShortcutOverride; where a shortcut takes it, nothing follows.
        pressed = kind in (_EVENT.KeyPress, _EVENT.ShortcutOverride)
        escape = pressed and event.key() == QtCore.Qt.Key_Escape
        clicked = kind == _EVENT.MouseButtonPress and self._bar.under_pointer()
        if (escape or clicked) and not self.cancelled:
            self.cancelled = True
            self._bar.show_cancelling()
        return True


class _Progress:
    """One job in the status bar; `report` may be called on any thread, `refresh` on Qt's only."""

    def __init__(self, title: str) -> None:
        self._bar = _Bar(title)
        self._guard = _Guard(self._bar)
        self._state = 0.0, ""
        self._since = QtCore.QElapsedTimer()

    def __enter__(self) -> _Progress:
        application = QtWidgets.QApplication.instance()
        application.installEventFilter(self._guard)
        application.setOverrideCursor(QtGui.QCursor(QtCore.Qt.WaitCursor))
        self._bar.hide()
        self._since.start()
        return self

    def __exit__(self, *_: object) -> None:
        application = QtWidgets.QApplication.instance()
        application.removeEventFilter(self._guard)
        application.restoreOverrideCursor()
        Gui.getMainWindow().statusBar().removeWidget(self._bar)
        self._bar.setParent(None)  # at once: deleteLater waits for the outermost loop of events
        self._bar.deleteLater()

    def report(self, fraction: float, stage: str) -> bool:
        """Note how far the job is; False once the user has cancelled it."""
        self._state = fraction, stage
        return not self._guard.cancelled

    def refuse_if_cancelled(self) -> None:
        """After the work's last look.

        Raises:
            Cancelled: the user has cancelled it meanwhile.
        """
        if self._guard.cancelled:
            raise Cancelled("cancelled at the end")

    def refresh(self) -> None:
        """Show what was reported, and let the window live for a moment."""
        if self._since.elapsed() > SHOW_AFTER and self._bar.isHidden():
            Gui.getMainWindow().statusBar().addPermanentWidget(self._bar)
            self._bar.show()
        if not self._guard.cancelled:
            self._bar.show_state(*self._state)
        QtWidgets.QApplication.processEvents()


@contextmanager
def progress_bar(title: str) -> Iterator[ProgressCallback]:
    """A callback for a job on Qt's thread; returns False once the user has cancelled."""
    with _Progress(title) as progress:

        def report(fraction: float, stage: str) -> bool:
            progress.report(fraction, stage)
            progress.refresh()
            return progress.report(fraction, stage)

        yield report


#: Held while a job has a thread: Qt's thread waits there, and its events must not start another.
_one_job = threading.Lock()


def run_on_thread(title: str, work: Callable[[ProgressCallback], T], keeps_best: bool = False) -> T:
    """What `work` returns or raises, run on a thread of its own while the window lives.

    `work` must touch nothing of FreeCAD or Qt; it gets the callback for its progress. After a
    cancel only work that keeps its best may return something.

    Raises:
        VolfrepError: another such job is running.
        Cancelled: by the user, be it while the work came to its end: what it made is dropped.
    """
    if not _one_job.acquire(blocking=False):
        raise VolfrepError("Another lattice is being computed: wait for its end, or cancel it.")
    try:
        with _Progress(title) as progress, ThreadPoolExecutor(1, "volfrep-job") as pool:
            job = pool.submit(work, progress.report)
            while not wait([job], timeout=BREATH).done:
                progress.refresh()
            result = job.result()
            if not keeps_best:
                progress.refuse_if_cancelled()
            return result
    finally:
        _one_job.release()

# SPDX-License-Identifier: LGPL-2.1-or-later
"""A job that is waited for, in the status bar: a bar, a Cancel button, and the Escape key.

That is a job inside a recompute or a command, which cannot go on before. The engine makes it in a
process of its own (`freecad_volfrep.engines`), so that the window lives and the part can be turned,
but nothing else in FreeCAD can be started. A modal window would see to that, and take the eye off
the part; so all other keys and clicks but those that cancel are taken out of the application's
events instead, which is what FreeCAD itself does while a document is recomputed. FreeCAD's own
progress indicator is not used: it cannot be cancelled by a click, its Escape asks a question, and a
recompute holds it already.

A modal window gets its input, whoever opens it: swallowing the answer to FreeCAD's question would
hang it. A user who closes FreeCAD's window means it: the job is cancelled, and the window is closed
again once nothing waits for a job any more.
"""

from __future__ import annotations

from collections.abc import Generator
from typing import TYPE_CHECKING, Any

import FreeCAD as App
import FreeCADGui as Gui

from freecad_volfrep.engines import engines, freecads
from freecad_volfrep.gui.qt import QtCore, QtGui, QtWidgets
from freecad_volfrep.translation import marked, translate
from volfrep.util.errors import Cancelled

if TYPE_CHECKING:
    from volfrep.process.engines import Running
    from volfrep.process.worker import Call

#: Quicker jobs show nothing, in ms.
SHOW_AFTER = 700
#: How often the window lives while a job is waited for, in s.
BREATH = 0.02
#: How often it is looked whether a window that was closed meanwhile can be closed now, in ms.
CLOSING = 50
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
#: What turns the view, where the pointer is on one.
_TURNING = (
    _EVENT.MouseButtonPress, _EVENT.MouseButtonRelease, _EVENT.MouseMove, _EVENT.Wheel,
    _EVENT.NativeGesture, _EVENT.TouchBegin,
)  # fmt: skip


class Bar(QtWidgets.QWidget):
    """What is in the status bar: a text, a bar and a button."""

    def __init__(self, title: str) -> None:
        super().__init__(Gui.getMainWindow())
        self.setObjectName("VolfrepProgress")
        self.hide()
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
        done = f": {translate('VolfrepProgress', stage)}" if stage else ""
        self.text.setText(self._title + done)
        self._bar.setValue(int(fraction * _STEPS))

    def appear(self) -> None:
        """Be in the status bar, to be seen."""
        Gui.getMainWindow().statusBar().addPermanentWidget(self)
        self.show()

    def leave(self) -> None:
        """Be gone."""
        Gui.getMainWindow().statusBar().removeWidget(self)
        self.setParent(None)  # at once: deleteLater waits for the outermost loop of events
        self.deleteLater()

    def under_pointer(self) -> bool:
        """Whether the pointer is on the button; a click is first the window's, not the button's."""
        place = self.button.mapFromGlobal(QtGui.QCursor.pos())
        return self.button.isVisible() and self.button.rect().contains(place)

    def show_cancelling(self) -> None:
        """Say that the click has arrived."""
        self.text.setText(translate("VolfrepProgress", "Cancelling..."))
        self.button.setEnabled(False)


class _Guard(QtCore.QObject):
    """Takes keys and clicks out of the application's events; Escape and Cancel are counted.

    What turns a 3D view passes: the wheel, and the mouse without its right button, which would open
    a menu. With a panel open the left one may belong to what that panel has begun. Inside a
    recompute FreeCAD itself swallows the buttons, and leaves the wheel.

    Of the filters of an application the one installed last is asked first: this one sees events
    before FreeCAD's own, which swallows them during a recompute.

    A modal window gets all of its input, whoever opened it: FreeCAD asks whether to abort, or a
    recovery that failed wants an answer, and who cannot give it can do nothing but kill FreeCAD.
    Qt itself keeps the other windows' input away meanwhile.
    """

    def __init__(self, bar: Bar) -> None:
        super().__init__()
        self._bar = bar
        self._is_turning = False
        self.cancels = 0

    def eventFilter(self, target: QtCore.QObject, event: QtCore.QEvent) -> bool:  # noqa: N802
        kind = event.type()
        if kind == _EVENT.Close and target is Gui.getMainWindow():
            event.ignore()  # FreeCAD cannot go before what waits for the job has come to its end
            _close_later()
            return True
        if kind not in _INPUT or QtWidgets.QApplication.activeModalWidget() is not None:
            return False
        if kind in _TURNING and self._turns(event):
            return False
        # A key first comes as ShortcutOverride; where a shortcut takes it, nothing follows.
        pressed = kind in (_EVENT.KeyPress, _EVENT.ShortcutOverride)
        escape = pressed and event.key() == QtCore.Qt.Key_Escape
        clicked = kind == _EVENT.MouseButtonPress and self._bar.under_pointer()
        if escape or clicked:
            self.cancel()
        return True

    def cancel(self) -> None:
        """Count it, and say that it has arrived."""
        self.cancels += 1
        self._bar.show_cancelling()

    def _turns(self, event: QtCore.QEvent) -> bool:
        """Whether an event is for a 3D view to turn what it shows."""
        kind = event.type()
        if kind == _EVENT.MouseButtonPress:
            left = event.button() == QtCore.Qt.LeftButton and Gui.Control.activeDialog()
            if left or event.button() == QtCore.Qt.RightButton or not _over_a_view():
                return False
            self._is_turning = True
            return True
        if kind == _EVENT.MouseButtonRelease:
            was_turning = self._is_turning and event.button() != QtCore.Qt.RightButton
            self._is_turning = self._is_turning and bool(event.buttons())
            return was_turning
        return self._is_turning or _over_a_view()


def _over_a_view() -> bool:
    """Whether the pointer is on a 3D view."""
    widget = QtWidgets.QApplication.widgetAt(QtGui.QCursor.pos())
    while widget is not None and widget.metaObject().className() != "Gui::View3DInventor":
        widget = widget.parentWidget()
    return widget is not None


#: The jobs that are waited for now; one inside another.
_waited_for: list[_Progress] = []


def is_waited_for() -> bool:
    """Whether a job is, inside a recompute or a command."""
    return bool(_waited_for)


_is_closing = False


def _close_later() -> None:
    """End all that is waited for, and close FreeCAD's window then, as the user has."""
    global _is_closing
    if not _is_closing:
        _is_closing = True
        _close_if_free()


def _close_if_free() -> None:
    """A command or a recompute may wait for one job after the other, or ask about the last.

    One that gives the best that it has when it is cancelled ends when it is cancelled again.
    """
    global _is_closing
    for progress in _waited_for:
        progress.cancel()
    asks = QtWidgets.QApplication.activeModalWidget() is not None
    if _waited_for or asks or any(doc.Recomputing for doc in App.listDocuments().values()):
        QtCore.QTimer.singleShot(CLOSING, _close_if_free)
        return
    _is_closing = False
    # By Qt's own loop: FreeCAD asks, and closes its documents, with no call of ours around it.
    queued = QtCore.Qt.QueuedConnection
    QtCore.QMetaObject.invokeMethod(Gui.getMainWindow(), "close", queued)


class _Progress:
    """One job that is waited for in the status bar."""

    def __init__(self, title: str) -> None:
        self._bar = Bar(title)
        self._guard = _Guard(self._bar)
        self._since = QtCore.QElapsedTimer()

    def __enter__(self) -> _Progress:
        application = QtWidgets.QApplication.instance()
        application.installEventFilter(self._guard)
        application.setOverrideCursor(QtGui.QCursor(QtCore.Qt.WaitCursor))
        self._since.start()
        _waited_for.append(self)
        return self

    def __exit__(self, *_: object) -> None:
        _waited_for.remove(self)
        application = QtWidgets.QApplication.instance()
        application.removeEventFilter(self._guard)
        application.restoreOverrideCursor()
        self._bar.leave()

    @property
    def cancels(self) -> int:
        """How often the user has."""
        return self._guard.cancels

    def cancel(self) -> None:
        """Cancel it, as the user can."""
        self._guard.cancel()

    def refresh(self, fraction: float, stage: str) -> None:
        """Show how far the job is, and let the window live for a moment."""
        if self._since.elapsed() > SHOW_AFTER and self._bar.isHidden():
            self._bar.appear()
        if not self._guard.cancels:
            self._bar.show_state(fraction, stage)
        QtWidgets.QApplication.processEvents()


def wait_for(title: str, call: Call, in_freecad: bool = False) -> Any:
    """What a call of the engine returns or raises; the window lives meanwhile.

    Args:
        title: in the status bar.
        call: of the engine, or of the workbench.
        in_freecad: whether it needs FreeCAD in its process.

    Raises:
        Cancelled: by the user, be it while the work came to its end: what it made is dropped.
        VolfrepError: as the call says, or its process has died.
    """
    running: Running = (freecads() if in_freecad else engines()).begin(call)
    cancels = 0
    try:
        with _Progress(title) as progress:
            while not running.wait(BREATH):
                progress.refresh(*running.state)
                if progress.cancels > cancels:
                    cancels = progress.cancels
                    running.cancel()
    except BaseException:  # raised while the window lived
        running.cancel()
        raise
    return running.result()


def go_through(title: str, steps: Generator[float, None, Any]) -> Any:
    """Work on Qt's thread in steps, between which the view can be turned.

    Args:
        title: in the status bar.
        steps: yields the share that is done; what it returns is returned. A cancel is raised where
            it stands.
    """
    lived = QtCore.QElapsedTimer()
    lived.start()
    with _Progress(title) as progress:
        while True:
            try:
                done = steps.throw(Cancelled()) if progress.cancels else next(steps)
            except StopIteration as end:
                return end.value
            if lived.elapsed() >= 1000 * BREATH:
                progress.refresh(done, "")
                lived.restart()

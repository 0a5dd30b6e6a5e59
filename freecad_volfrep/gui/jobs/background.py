# SPDX-License-Identifier: LGPL-2.1-or-later
"""Jobs of the engine beside which the user goes on: a bar each in the status bar, one at a time."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any

import FreeCADGui as Gui

from freecad_volfrep.engines import engines
from freecad_volfrep.features.jobs.job import Job, State
from freecad_volfrep.gui.in_steps import are_there_steps
from freecad_volfrep.gui.qt import QtCore, QtWidgets
from freecad_volfrep.translation import QT_TRANSLATE_NOOP
from volfrep.util.errors import Cancelled

from .progress import SHOW_AFTER, Bar, is_waited_for

if TYPE_CHECKING:
    from volfrep.process.engines import Running

#: Jobs are looked at so often, ms.
TICK = 40
WAITING = QT_TRANSLATE_NOOP("VolfrepProgress", "waiting")
TAKING_OVER = QT_TRANSLATE_NOOP("VolfrepProgress", "into the document when you pause")
_EVENT = QtCore.QEvent

#: What is to be done with a call's result or its error.
Then = Callable[[Any, "BaseException | None"], None]
#: What is to be done with a call's result before, in steps.
Prepare = Callable[[Any], Iterator[None]]


class Run:
    """A job on its way: begun in its turn, looked at, its result handed on.

    Args:
        job: what is made.
        then: is given the result, or the error.
        prepare: what is done with the result before, in steps: one each time it is looked at.
        is_wanted: asked all the time; without it the call is ended, and `then` not called.
        is_time: whether `then` may be called now.
        dropped: called where it is not wanted any more.
    """

    def __init__(
        self,
        job: Job,
        then: Then,
        prepare: Prepare,
        is_wanted: Callable[[], bool],
        is_time: Callable[[], bool],
        dropped: Callable[[], None],
    ) -> None:
        self._job, self._then, self._dropped = job, then, dropped
        self._prepare = prepare
        self._steps: Iterator[None] | None = None
        self._is_wanted, self._is_time = is_wanted, is_time
        self._running: Running | None = None
        self._bar = Bar(job.title)
        self._bar.button.clicked.connect(self.cancel)
        self._since = QtCore.QElapsedTimer()
        self._since.start()

    def cancel(self) -> None:
        """End it; `then` is given the error."""
        if self._job.is_under_way and self._job.state is not State.CANCELLING:
            self._job.go(State.CANCELLING)
        self._bar.show_cancelling()
        if self._running is not None:
            self._running.cancel()

    def go_on(self) -> bool:
        """Look at it; whether it is over."""
        job = self._job
        if not (job.is_under_way and self._is_wanted()):
            if self._running is not None:
                self._running.cancel()
            self._steps = None
            self._end(State.IDLE)
            self._dropped()
            return True
        if self._running is None:
            self._running = engines().begin(job.call)
            if job.state is State.CANCELLING:
                self._running.cancel()
            else:
                job.go(State.RUNNING)
        if not self._running.wait(0.0):
            self._show(*self._running.state)
            return False
        if not (_is_quiet() and self._is_time()):
            return False
        try:
            result = self._running.result()
            if job.state is State.CANCELLING and self._steps is not None:
                raise Cancelled("cancelled while it was taken over")
            self._steps = self._prepare(result) if self._steps is None else self._steps
            if next(self._steps, self) is not self:
                self._show(1.0, TAKING_OVER)
                return False
        except Exception as error:
            self._bar.leave()
            self._then(None, error)
            self._end(State.CANCELLED if isinstance(error, Cancelled) else State.FAILED)
        else:
            self._bar.leave()
            self._then(result, None)
            self._end(State.IDLE)
        return True

    def _end(self, state: State) -> None:
        """Be in a last state, unless whoever took the result has said so."""
        self._bar.leave()
        if self._job.is_under_way:
            self._job.go(state)

    def show_waiting(self) -> None:
        """Say that others come first."""
        self._show(0.0, WAITING)

    def _show(self, fraction: float, stage: str) -> None:
        if self._bar.isHidden() and self._since.elapsed() > SHOW_AFTER:
            self._bar.appear()
        if self._job.state is not State.CANCELLING:
            self._bar.show_state(fraction, stage)


class _Jobs(QtCore.QObject):
    """All jobs; the first one runs."""

    def __init__(self) -> None:
        super().__init__()
        self._jobs: list[Run] = []
        self._timer = QtCore.QTimer(self)
        self._timer.timeout.connect(self._look)

    @property
    def are_there(self) -> bool:
        return bool(self._jobs)

    def add(self, job: Run) -> None:
        if not self._jobs:
            QtWidgets.QApplication.instance().installEventFilter(self)
            self._timer.start(TICK)
        self._jobs.append(job)

    def eventFilter(self, target: QtCore.QObject, event: QtCore.QEvent) -> bool:  # noqa: N802
        """Escape cancels the job that runs, where it does not mean anything else."""
        if event.type() not in (_EVENT.KeyPress, _EVENT.ShortcutOverride):
            return False
        if event.key() != QtCore.Qt.Key_Escape or not _is_quiet() or Gui.Control.activeDialog():
            return False
        if self._jobs:
            self._jobs[0].cancel()
        return True

    def _look(self) -> None:
        if not self._jobs:
            return
        first, *others = self._jobs
        self._timer.stop()  # what is done then may run a loop of its own
        try:
            for job in others:
                job.show_waiting()
            if first.go_on():
                self._jobs.remove(first)
        except BaseException:
            self._jobs.remove(first)
            raise
        finally:
            if self._jobs:
                self._timer.start(TICK)
            else:
                QtWidgets.QApplication.instance().removeEventFilter(self)


_jobs: list[_Jobs] = []


def begin(
    job: Job,
    then: Then,
    *,
    prepare: Prepare = lambda _: iter(()),
    is_wanted: Callable[[], bool] = lambda: True,
    is_time: Callable[[], bool] = lambda: True,
    dropped: Callable[[], None] = lambda: None,
) -> None:
    """Make a job of the engine, after those that were asked for before, and return at once.

    Args:
        job: what is made; once it is idle, it is ended without a word.
        then: is given the result, or the error, by Qt's loop: when nothing is open that waits for
            an answer.
        prepare: done with the result before, a step at a time, between which the window answers.
        is_wanted: once it says no, the call is ended without a word.
        is_time: whether `then` may be called now.
        dropped: called in place of `then` where it is not wanted any more.
    """
    if not _jobs:
        _jobs.append(_Jobs())
    _jobs[0].add(Run(job, then, prepare, is_wanted, is_time, dropped))


def are_there_jobs() -> bool:
    """Whether anything is being made or drawn, or waits for its turn."""
    return are_there_steps() or (bool(_jobs) and _jobs[0].are_there)


def _is_quiet() -> bool:
    """Whether the user is not in the middle of something that a change would disturb."""
    application = QtWidgets.QApplication
    return (
        not is_waited_for()
        and application.activeModalWidget() is None
        and application.activePopupWidget() is None
        and application.mouseButtons() == QtCore.Qt.NoButton
    )

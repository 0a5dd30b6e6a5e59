# SPDX-License-Identifier: LGPL-2.1-or-later
"""Work on Qt's thread in steps, between which the window answers."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from freecad_volfrep.gui.qt import QtCore

#: Steps are made for so long at a time, and then the window has that long for itself, ms.
BUSY, REST = 20, 20


class _Steps(QtCore.QObject):
    """All that is being worked on, one after the other."""

    def __init__(self) -> None:
        super().__init__()
        self._works: list[Iterator[None]] = []
        self._timer = QtCore.QTimer(self)
        self._timer.setSingleShot(True)
        self._timer.timeout.connect(self._go_on)

    @property
    def are_there(self) -> bool:
        return bool(self._works)

    def add(self, work: Iterator[None]) -> None:
        self._works.append(work)
        self._timer.start(0)

    def drop(self, work: Iterator[None]) -> None:
        self._works = [other for other in self._works if other is not work]

    def _go_on(self) -> None:
        clock = QtCore.QElapsedTimer()
        clock.start()
        try:
            while self._works and clock.elapsed() < BUSY:
                work = self._works[0]
                try:
                    next(work)
                except StopIteration:
                    self.drop(work)
                except BaseException:
                    self.drop(work)
                    raise
        finally:
            if self._works:
                self._timer.start(REST)


_steps: list[_Steps] = []


def do_in_steps(work: Iterator[None]) -> None:
    """Go through a generator, a step at a time, after those that were given before."""
    if not _steps:
        _steps.append(_Steps())
    _steps[0].add(work)


def drop_steps(work: Iterator[None] | None) -> None:
    """Leave the rest of it undone."""
    if _steps and work is not None:
        _steps[0].drop(work)


def are_there_steps() -> bool:
    """Whether anything is being worked on."""
    return bool(_steps) and _steps[0].are_there


class Stillness(QtCore.QObject):
    """Notes when the user has done something last: no key, click, wheel or move for a while."""

    _DONE = (
        QtCore.QEvent.KeyPress, QtCore.QEvent.MouseButtonPress, QtCore.QEvent.MouseMove,
        QtCore.QEvent.MouseButtonRelease, QtCore.QEvent.Wheel, QtCore.QEvent.TouchUpdate,
    )  # fmt: skip

    def __init__(self, application: Any) -> None:
        super().__init__()
        self._application = application
        self._whole, self._since = QtCore.QElapsedTimer(), QtCore.QElapsedTimer()
        self._whole.start()
        self._since.start()
        application.installEventFilter(self)

    def eventFilter(self, target: QtCore.QObject, event: QtCore.QEvent) -> bool:  # noqa: N802
        """Note it and let it pass."""
        if event.type() in self._DONE:
            self._since.restart()
        return False

    def is_there(self, still: int, longest: int) -> bool:
        """Whether nothing was done for `still` ms; or this has been looked for `longest` ms."""
        return self._since.elapsed() >= still or self._whole.elapsed() >= longest

    def end(self) -> None:
        """Look no more."""
        self._application.removeEventFilter(self)

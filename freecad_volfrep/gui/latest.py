# SPDX-License-Identifier: LGPL-2.1-or-later
"""What is asked again at every change of a value: answered on a thread, the last question only."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any, TypeVar
from weakref import WeakSet

from freecad_volfrep.gui.qt import QtCore
from volfrep.util.errors import Cancelled
from volfrep.util.progress import Monitor

T = TypeVar("T")
#: Answers are looked for so often, ms.
TICK = 15

#: Makes an answer on the thread, of arrays and specifications alone; ends where the monitor says.
Make = Callable[[Monitor], T]
#: Is given the answer, or the error, on Qt's thread.
Then = Callable[["T | None", "BaseException | None"], None]

#: Those that have asked something and are not answered yet.
_waiting: WeakSet[Latest] = WeakSet()


class Latest(QtCore.QObject):
    """One thread after another, each with a question; a later question drops those before it.

    Args:
        parent: with which it goes: then nothing is answered any more.
    """

    def __init__(self, parent: QtCore.QObject | None = None) -> None:
        super().__init__(parent)
        self._timer = QtCore.QTimer(self)
        self._timer.timeout.connect(self._look)
        self._asked: _Question | None = None
        self._next: _Question | None = None

    def ask(self, make: Make[T], then: Then[T]) -> None:
        """Have an answer made; what was asked before is not answered any more."""
        self.drop()
        self._next = _Question(make, then)
        self._timer.start(TICK)
        _waiting.add(self)
        self._look()

    def drop(self) -> None:
        """Want no answer."""
        self._next = None
        self._timer.stop()
        _waiting.discard(self)
        if self._asked is not None:
            self._asked.is_dropped = True

    def _look(self) -> None:
        """Hand an answer on; begin with the next question once the thread is free."""
        answered = self._asked
        if answered is not None and answered.thread.is_alive():
            return
        self._asked, self._next = self._next, None
        if self._asked is not None:
            self._asked.thread.start()
        else:
            self._timer.stop()
            _waiting.discard(self)
        if answered is not None and not answered.is_dropped:
            answered.then(answered.answer, answered.error)


def are_there_questions() -> bool:
    """Whether an answer is still to come."""
    return bool(_waiting)


class _Question:
    def __init__(self, make: Make[Any], then: Then[Any]) -> None:
        self._make, self.then = make, then
        self.answer: Any = None
        self.error: BaseException | None = None
        self.is_dropped = False
        self.thread = threading.Thread(target=self._run, name="volfrep-latest")

    def _run(self) -> None:
        try:
            self.answer = self._make(Monitor(lambda *_: not self.is_dropped))
        except Cancelled:
            self.is_dropped = True
        except BaseException as error:
            self.error = error

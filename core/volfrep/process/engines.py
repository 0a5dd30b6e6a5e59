# SPDX-License-Identifier: LGPL-2.1-or-later
"""Calls of the engine that go on while this process does something else.

They are made in processes that are kept for the next call: one, and more while calls overlap. Where
no process can be started, a call is made on a thread of this one.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence
from importlib import import_module
from typing import Any

from ..util.errors import Cancelled, VolfrepError
from .worker import LAST_WORDS, Call, Ending, OnItsWay, Program, Worker, WorkerLost

#: A call that is asked to end has so long for it, s; then its process is ended.
GRACE = 0.05
#: A call that another one waits for is looked at so often, s.
TICK = 0.05


class Engines:
    """Processes that make calls.

    Args:
        programs: to try, the best first; one that does not greet is not tried again.
        missed: called, on any thread, with a sentence for each that does not serve.
    """

    def __init__(
        self, programs: Sequence[Program], missed: Callable[[str], None] = lambda _: None
    ) -> None:
        self._programs, self._missed = list(programs), missed
        self._choosing = threading.Lock()
        self._idle: list[Worker] = []

    def begin(self, call: Call) -> Running:
        """Make a call; it begins when there is a process for it."""
        return Running(self, call)

    def warm(self, *modules: str) -> Running:
        """See to it that a process waits for the next call, with these modules imported."""
        return self.begin(Call(_load, modules, has_progress=False))

    def end(self) -> None:
        """End the processes that make no call."""
        with self._choosing:
            while self._idle:
                self._idle.pop().end()

    def take(self) -> Worker | None:
        """A process that makes no call, started if need be; None where none can be."""
        with self._choosing:
            while self._idle:
                process = self._idle.pop()
                if process.is_alive:
                    return process
                process.end()
            while self._programs:
                try:
                    process = Worker(self._programs[0])
                except OSError as error:
                    said = str(error)
                else:
                    if process.greets():
                        return process
                    said = _sentence(process.end(LAST_WORDS))
                self._missed(f"{self._programs[0].command[0]}: {said}")
                del self._programs[0]
            return None

    def give_back(self, process: Worker) -> None:
        """A call is over: keep its process for the next one, in place of one that waits."""
        with self._choosing:
            if not process.is_alive:
                process.end()
                return
            while self._idle:
                self._idle.pop().end()
            self._idle.append(process)


class Running:
    """A call on its way. `state` is the fraction done and the stage that were told last."""

    def __init__(self, engines: Engines, call: Call) -> None:
        self._engines, self._call, self._keeps_best = engines, call, call.keeps_best
        self._process: Worker | None = None
        self._changing = threading.Lock()
        self._ended = threading.Event()
        self._cancels = 0
        self._result: Any = None
        self._error: BaseException | None = None
        self.state: tuple[float, str] = (0.0, "")
        threading.Thread(target=self._follow, name="volfrep-call", daemon=True).start()

    @property
    def is_cancelled(self) -> bool:
        """Whether `cancel` was called."""
        return self._cancels > 0

    def wait(self, seconds: float) -> bool:
        """Whether it has ended within that time."""
        return self._ended.wait(seconds)

    def cancel(self) -> None:
        """Ask it to end, and see to it; one that keeps its best is ended when asked twice."""
        with self._changing:
            self._cancels += 1
            process = self._process
            if process is None:
                return
            process.ask_to_end()
            if not self._keeps_best or self._cancels > 1:
                after = threading.Timer(GRACE, self._kill, (process,))
                after.daemon = True
                after.start()

    def result(self) -> Any:
        """What the call has returned; wait for it.

        Raises:
            Cancelled: it was cancelled.
            VolfrepError: as the call says, or its process has ended by itself.
            BaseException: whatever else the call has raised.
        """
        self._ended.wait()
        if self._error is not None:
            raise self._error
        return self._result

    def _follow(self) -> None:
        try:
            result = self._made()
            if self._cancels and not self._keeps_best:
                raise Cancelled("cancelled at the end")
            self._result = result
        except BaseException as error:
            self._error = error
        self._call = Call(_load)  # let go of what it was given
        self._ended.set()

    def _wait_for(self, other: OnItsWay | None) -> None:
        while other is not None and not other.wait(TICK):
            self.state = other.state
            if self._cancels:
                other.cancel()
                raise Cancelled("cancelled before it began")

    def _made(self) -> Any:
        self._wait_for(self._call.after)
        process = self._engines.take()
        if process is None:
            return self._call.here(self._tick)
        try:
            with self._changing:
                if self._cancels:
                    raise Cancelled("cancelled before it began")
                self._process = process
            return process.answer(self._call, self._take_progress)
        except WorkerLost as lost:
            if self._cancels:
                raise Cancelled("its process was ended") from lost
            raise VolfrepError(_sentence(lost.ending)) from lost
        finally:
            with self._changing:
                self._process = None
            self._engines.give_back(process)

    def _kill(self, process: Worker) -> None:
        with self._changing:
            if self._process is process:
                process.kill()

    def _take_progress(self, fraction: float, stage: str) -> None:
        self.state = fraction, stage

    def _tick(self, fraction: float, stage: str) -> bool:
        self.state = fraction, stage
        return not self._cancels


def _sentence(ending: Ending) -> str:
    return (
        f"The engine's process has ended {ending}: if there was not enough memory, choose "
        "larger cells or a coarser deviation; the document is as it was."
    )


def _load(*modules: str) -> None:
    """What a process does to be there."""
    for name in modules:
        import_module(name)

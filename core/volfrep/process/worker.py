# SPDX-License-Identifier: LGPL-2.1-or-later
"""A Python beside this one that makes calls of the engine, one at a time.

It may be ended at any moment, run out of memory or crash: that costs the call, and nothing else.
What its calls keep in a `StageCache` stays there for the next one with the same cache.

A Python of its own and no `multiprocessing`: one that dies takes no other with it, it may be
another program than this one, such as FreeCAD without windows, and a script that uses it needs no
main guard. Nothing of it is forked, so that it is the same on every system.
"""

from __future__ import annotations

import shutil
import sys
import tempfile
import threading
import weakref
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, Protocol

from ..util.cache import StageCache
from ..util.errors import VolfrepError
from ..util.progress import ProgressCallback
from .child import NO_LIMITS, Child, Limits, how_ended
from .server import GREETING, UNKNOWN
from .wire import receive, send

#: One that is gone has so long, s, until the system knows how it has ended.
LAST_WORDS = 5.0
#: What the process runs: where the engine lies goes first, packages that it needs last.
#: Temporary files go when the process does, however it ends. FreeCAD would run a script that
#: raises a second time, and then end with 0.
_SCRIPT = """import os, sys, tempfile, traceback
try:
    tempfile.tempdir = {folder!r}
    sys.path[:0] = {front!r}
    sys.path += {back!r}
    from volfrep.util.threads import one_for_matrices
    one_for_matrices()
    {prelude}
    from volfrep.process.worker import Program, python_beside
    python_beside({program!r})
    from volfrep.process.server import serve
    serve({folder!r}, {threads!r}, {warm!r})
except BaseException:
    traceback.print_exc()
    sys.stderr.flush()
    os._exit(1)
"""


class OnItsWay(Protocol):
    """A call that was begun (`engines.Running`)."""

    state: tuple[float, str]

    def wait(self, seconds: float) -> bool:
        """Whether it has ended within that time."""

    def cancel(self) -> None:
        """Ask it to end, and see to it."""


@dataclass(frozen=True)
class Call:
    """A function of the engine and what it is given.

    Attributes:
        function: of a module that the process can import; ``module:name`` where this process
            cannot import it, or need not.
        arguments: that pickle; a `StageCache` stands for one that the process keeps.
        keywords: the same.
        heard: by the name of a parameter of the function, a callback of this process: it is called
            on another thread, and what it returns is not looked at.
        keeps_best: whether the function returns something after a cancel.
        has_progress: whether it has a parameter ``progress`` for a callback, which returns False
            after a cancel.
        after: a call on its way whose process makes this one once it has ended, however it has,
            with what it keeps; cancelled with this one while that waits. None for no such call.
    """

    function: Callable[..., Any] | str
    arguments: tuple[Any, ...] = ()
    keywords: Mapping[str, Any] = field(default_factory=dict)
    heard: Mapping[str, Callable[..., Any]] = field(default_factory=dict)
    keeps_best: bool = False
    has_progress: bool = True
    after: OnItsWay | None = None

    def here(self, progress: ProgressCallback | None = None) -> Any:
        """Make it in this process."""
        assert callable(self.function)
        progress_keyword = {"progress": progress} if self.has_progress else {}
        return self.function(*self.arguments, **self.keywords, **self.heard, **progress_keyword)


class Failed(Exception):
    """The traceback in the other process of what it has raised."""


class WorkerLost(Exception):
    """The process that made a call has ended: see `ending`."""

    def __init__(self, ending: Ending) -> None:
        super().__init__(str(ending))
        self.ending = ending


@dataclass(frozen=True)
class Program:
    """What the process is.

    Attributes:
        command: Python, or a program that runs a script of Python's as it does, such as FreeCAD's
            without windows.
        front: folders that come first where modules are looked for.
        back: folders that come last.
        prelude: a line for the process before it imports the engine.
        warm: modules that it imports before it greets.
        threads: that its calls may use; 0 for one on each core.
    """

    command: tuple[str, ...]
    front: tuple[str, ...]
    back: tuple[str, ...] = ()
    prelude: str = "pass"
    warm: tuple[str, ...] = ()
    threads: int = 0

    def runs(self, version: str) -> bool:
        """Whether it finds the engine in that version, what that needs, and what is warm."""
        try:
            worker = Worker(self)
        except OSError:
            return False
        called = Call("volfrep.process.cluster:version", has_progress=False)
        try:
            return bool(worker.answer(called) == version)
        except (WorkerLost, ImportError, AttributeError):
            return False
        finally:
            worker.end()


#: What makes calls beside this process, once that was said.
_beside: list[Program] = []


def python_beside(program: Program) -> None:
    """Say what makes calls beside this process: of a worker what it is itself.

    A program that has a Python built in is none, and says which one is.
    """
    _beside[:] = [program]


def this_python(threads: int = 0, *warm: str) -> Program:
    """The Python that runs this process, with what it finds; or what was said to be beside it."""
    if _beside:
        return replace(_beside[0], threads=threads, warm=warm)
    return Program((sys.executable,), tuple(filter(None, sys.path)), warm=warm, threads=threads)


def has_python() -> bool:
    """Whether `this_python` is one: other programs with a Python in them would open a window."""
    name = Path(sys.executable or "").name.lower()
    return bool(_beside) or name.startswith(("python", "pypy"))


class Worker:
    """The process, from its start to its end.

    Raises:
        OSError: the program cannot be started.
    """

    def __init__(self, program: Program) -> None:
        self._folder = Path(tempfile.mkdtemp(prefix="volfrep-engine-"))
        self._gone = weakref.finalize(self, shutil.rmtree, self._folder, ignore_errors=True)
        script = self._folder / "engine.py"
        script.write_text(
            _SCRIPT.format(
                front=list(program.front),
                back=list(program.back),
                prelude=program.prelude,
                folder=str(self._folder),
                threads=program.threads,
                warm=program.warm,
                program=program,
            ),
            encoding="utf-8",
        )
        limits = Limits(threads=program.threads)
        try:
            with (self._folder / "said").open("wb") as said:
                command = [*program.command, str(script)]
                self._child = Child(command, limits=limits, speaks=True, errors=said)
        except OSError:
            self._gone()
            raise
        self._sending = threading.Lock()
        self._numbers: dict[int, int] = {}
        self._number = self._known = 0
        self._greeted = False

    @property
    def number(self) -> int:
        """The system's of the process."""
        return self._child.number

    @property
    def is_alive(self) -> bool:
        """Whether it can be given a call."""
        return self._child.is_alive

    def greets(self) -> bool:
        """Wait for its first word; False where it ends without one: then it is no engine."""
        seen = b""
        while not self._greeted:
            byte = self._child.output.read(1)
            if not byte:
                return False
            seen = (seen + byte)[-len(GREETING) :]
            self._greeted = seen == GREETING
        return True

    def answer(
        self,
        call: Call,
        callback: ProgressCallback = lambda fraction, stage: None,
        limits: Limits = NO_LIMITS,
        ask: Callable[[], object] | None = None,
    ) -> Any:
        """Make a call there, after those before it; what it returns.

        Args:
            call: the function and what it is given.
            callback: hears of the progress; what it returns is not looked at.
            limits: of the call's time, and of the process's memory.
            ask: called again and again on this thread; what it raises ends the process.

        Raises:
            WorkerLost: the process has ended.
            OverLimit: it has been ended for a limit.
            BaseException: what the call has raised, with the other side's traceback as its cause.
        """
        kind, value = self._child.guarded(lambda: self._exchange(call, callback), limits, ask)
        if kind == "failed":
            error, trace = value
            raise error from Failed(f"\n{trace}")
        return value

    def _exchange(self, call: Call, callback: ProgressCallback) -> tuple[str, Any]:
        """Send a call, and listen until it has ended; how, and with what."""
        self._number += 1
        if not self.greets() or not self._send((None, self._number, _Sent.of(call))):
            raise WorkerLost(self.end(LAST_WORDS))
        while True:
            try:
                kind, about, value = receive(self._child.output, self._folder, _no_cache)
            except (EOFError, OSError) as error:
                raise WorkerLost(self.end(LAST_WORDS)) from error
            if about not in (self._number, UNKNOWN):
                continue
            if kind == "progress":
                callback(*value)
            elif kind == "heard":
                call.heard[value[0]](*value[1])
            else:
                return kind, value

    def ask_to_end(self) -> None:
        """Tell the process that the call that it makes is not wanted any more."""
        self._send(("cancel", self._number, None))

    def kill(self) -> None:
        """End the process; whoever waits for a call's answer sees to the rest."""
        self._child.kill()

    def disown(self) -> None:
        """In a process forked from the one whose it is: that one sees to its end and its files."""
        self._gone.detach()
        self._child.disown()

    def end(self, patience: float = 0.0) -> Ending:
        """End the process, whatever it does, and its files; how it has ended.

        Args:
            patience: wait so long, s, for it to end by itself.
        """
        code, ended_itself = self._child.wait(patience)
        last = self._last_words() if ended_itself else ""
        self._child.output.close()
        self._gone()
        return Ending(how_ended(code), last)

    def _send(self, message: object) -> bool:
        """Whether there is still somebody who was told."""
        stream = self._child.input
        assert stream is not None
        try:
            with self._sending:
                send(stream, message, self._folder, self._number_of)
        except (OSError, ValueError):
            return False
        return True

    def _number_of(self, cache: StageCache) -> int:
        """The number under which the process keeps this cache's counterpart."""
        if id(cache) not in self._numbers:
            self._known += 1
            self._numbers[id(cache)] = self._known
            weakref.finalize(cache, _forget, weakref.ref(self), id(cache)).atexit = False
        return self._numbers[id(cache)]

    def forget(self, name: int) -> None:
        """Let go of a cache's counterpart: on a thread, because a cache may end at any moment."""
        number = self._numbers.pop(name)
        if self.is_alive:
            threading.Thread(target=self._send, args=(("forget", number, None),)).start()

    def _last_words(self) -> str:
        """The end of what it has said on its way, such as an error of its start."""
        try:
            lines = (self._folder / "said").read_text("utf-8", "replace").split("\n")
        except OSError:
            return ""
        said = [line.strip() for line in lines if line.strip()]
        return said[-1].rstrip(".") if said else ""


@dataclass(frozen=True)
class Ending:
    """How a worker has ended.

    Attributes:
        how: by which signal, or with which code.
        last_words: the last line that it has said; empty where we have ended it.
    """

    how: str
    last_words: str = ""

    def __str__(self) -> str:
        """Both in words."""
        return f"{self.how} ({self.last_words})" if self.last_words else self.how


@dataclass(frozen=True)
class _Sent:
    """A call as it is sent: without this process's callbacks."""

    function: Callable[..., Any] | str
    arguments: tuple[Any, ...]
    keywords: dict[str, Any]
    heard: tuple[str, ...]
    has_progress: bool

    @classmethod
    def of(cls, call: Call) -> _Sent:
        heard = tuple(call.heard)
        return cls(call.function, call.arguments, dict(call.keywords), heard, call.has_progress)


def _forget(worker: weakref.ref[Worker], name: int) -> None:
    there = worker()
    if there is not None:
        there.forget(name)


def _no_cache(number: int) -> StageCache:
    raise VolfrepError("A cache does not leave the process that it is in.")

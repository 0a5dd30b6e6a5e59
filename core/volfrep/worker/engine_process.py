# SPDX-License-Identifier: LGPL-2.1-or-later
"""A Python beside this one that makes calls of the engine, one at a time.

It may be ended at any moment, run out of memory or crash: that costs the call, and nothing else.
What its calls keep in a `StageCache` stays there for the next one with the same cache.
"""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import tempfile
import threading
import weakref
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from ..util.cache import StageCache
from ..util.errors import VolfrepError
from ..util.progress import ProgressCallback
from ..util.subprocesses import NO_WINDOW
from .server import GREETING, UNKNOWN
from .wire import receive, send

#: Whether a process can be ended with those it has started.
_HAS_GROUPS = hasattr(os, "killpg")
#: What the process runs: where the engine lies goes first, packages that it needs last.
#: Temporary files go when the process does, however it ends.
_PROGRAM = """import sys, tempfile
tempfile.tempdir = {folder!r}
sys.path[:0] = {front!r}
sys.path += {back!r}
{prelude}
from volfrep.worker.server import serve
serve({folder!r}, {warm!r})
"""


@dataclass(frozen=True)
class Call:
    """A function of the engine and what it is given.

    Attributes:
        function: of a module that the process can import.
        arguments: that pickle; a `StageCache` stands for one that the process keeps.
        keywords: the same.
        heard: by the name of a parameter of the function, a callback of this process: it is called
            on another thread, and what it returns is not looked at.
        keeps_best: whether the function returns something after a cancel.
        has_progress: whether it has a parameter ``progress`` for a callback, which returns False
            after a cancel.
    """

    function: Callable[..., Any]
    arguments: tuple[Any, ...] = ()
    keywords: Mapping[str, Any] = field(default_factory=dict)
    heard: Mapping[str, Callable[..., Any]] = field(default_factory=dict)
    keeps_best: bool = False
    has_progress: bool = True

    def here(self, progress: ProgressCallback | None = None) -> Any:
        """Make it in this process."""
        told = {"progress": progress} if self.has_progress else {}
        return self.function(*self.arguments, **self.keywords, **self.heard, **told)


class Failed(Exception):
    """The traceback in the other process of what it has raised."""


@dataclass(frozen=True)
class Program:
    """What the process is.

    Attributes:
        command: Python, or a program that runs a script of Python's as it does, such as FreeCAD's
            without windows.
        front: folders that come first where modules are looked for.
        back: folders that come last.
        prelude: lines for the process before it imports the engine.
        warm: modules that it imports before it greets.
    """

    command: tuple[str, ...]
    front: tuple[str, ...]
    back: tuple[str, ...] = ()
    prelude: str = ""
    warm: tuple[str, ...] = ()


class EngineProcess:
    """The process, from its start to its end.

    Raises:
        OSError: the program cannot be started.
    """

    def __init__(self, program: Program) -> None:
        self._folder = Path(tempfile.mkdtemp(prefix="volfrep-engine-"))
        self._gone = weakref.finalize(self, shutil.rmtree, self._folder, ignore_errors=True)
        script = self._folder / "engine.py"
        script.write_text(
            _PROGRAM.format(
                front=list(program.front),
                back=list(program.back),
                prelude=program.prelude,
                folder=str(self._folder),
                warm=program.warm,
            ),
            encoding="utf-8",
        )
        try:
            with (self._folder / "said").open("wb") as said:
                self._child = subprocess.Popen(
                    [*program.command, str(script)],
                    stdin=subprocess.PIPE,
                    stdout=subprocess.PIPE,
                    stderr=said,
                    creationflags=NO_WINDOW,
                    start_new_session=_HAS_GROUPS,
                )
        except OSError:
            self._gone()
            raise
        self._sending = threading.Lock()
        self._numbers: dict[int, int] = {}
        self._number = self._known = 0
        self._asked_to_end = False

    @property
    def number(self) -> int:
        """The system's of the process."""
        return self._child.pid

    @property
    def is_alive(self) -> bool:
        """Whether it can be given a call."""
        return self._child.poll() is None and not self._asked_to_end

    def greets(self) -> bool:
        """Wait for its first word; False where it ends without one: then it is no engine."""
        out = self._child.stdout
        assert out is not None
        seen = b""
        while not seen.endswith(GREETING):
            byte = out.read(1)
            if not byte:
                return False
            seen = (seen + byte)[-len(GREETING) :]
        return True

    def answer(self, call: Call, told: Callable[[float, str], None]) -> Any:
        """Make a call there, after those before it; what it returns.

        Args:
            call: the function and what it is given.
            told: hears of the progress.

        Raises:
            EOFError: the process is gone.
            BaseException: what the call has raised, with the other side's traceback as its cause.
        """
        out = self._child.stdout
        assert out is not None
        self._number += 1
        if not self._send((None, self._number, _Sent.of(call))):
            raise EOFError
        while True:
            kind, about, value = receive(out, self._folder, _no_cache)
            if about not in (self._number, UNKNOWN):
                continue
            if kind == "progress":
                told(*value)
            elif kind == "heard":
                call.heard[value[0]](*value[1])
            elif kind == "failed":
                error, trace = value
                raise error from Failed(f"\n{trace}")
            else:
                return value

    def ask_to_end(self) -> None:
        """Tell the process that the call that it makes is not wanted any more."""
        self._send(("cancel", self._number, None))

    def kill(self) -> None:
        """End the process; whoever waits for a call's answer sees to the rest."""
        self._asked_to_end = True
        self._kill_all()

    def end(self, patience: float = 0.0) -> str:
        """End the process, whatever it does, and its files; a sentence on how it has ended.

        Args:
            patience: wait so long, s, for it to end by itself.
        """
        self._asked_to_end, ended_itself = True, True
        try:
            code = self._child.wait(patience)
        except subprocess.TimeoutExpired:
            ended_itself = False
            self._kill_all()
            code = self._child.wait()
        last = self._last_words() if ended_itself else ""
        self._gone()
        how = f"by signal {-code}" if code < 0 else f"with code {code}"
        return (
            f"The engine's process has ended {how}{last}: if there was not enough memory, choose "
            "larger cells or a coarser deviation; the document is as it was."
        )

    def _kill_all(self) -> None:
        """The process and the programs that it runs, such as Gmsh, where the system has groups."""
        if not _HAS_GROUPS:
            self._child.kill()
        elif self._child.poll() is None:
            with suppress(ProcessLookupError):
                os.killpg(self._child.pid, signal.SIGKILL)

    def _send(self, message: object) -> bool:
        """Whether there is still somebody who was told."""
        stream = self._child.stdin
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
        return f" ({said[-1].rstrip('.')})" if said else ""


@dataclass(frozen=True)
class _Sent:
    """A call as it is sent: without this process's callbacks."""

    function: Callable[..., Any]
    arguments: tuple[Any, ...]
    keywords: dict[str, Any]
    heard: tuple[str, ...]
    has_progress: bool

    @classmethod
    def of(cls, call: Call) -> _Sent:
        heard = tuple(call.heard)
        return cls(call.function, call.arguments, dict(call.keywords), heard, call.has_progress)


def _forget(process: weakref.ref[EngineProcess], name: int) -> None:
    there = process()
    if there is not None:
        there.forget(name)


def _no_cache(number: int) -> StageCache:
    raise VolfrepError("A cache does not leave the process that it is in.")

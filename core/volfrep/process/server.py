# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the process does that calls are made in; `worker` starts it, nobody else."""

from __future__ import annotations

import os
import queue
import shutil
import signal
import sys
import threading
import time
import traceback
from importlib import import_module
from pathlib import Path
from typing import IO, Any

from ..util.cache import StageCache
from ..util.errors import VolfrepError
from ..util.freed_memory import keep_freed_memory
from ..util.threads import use_threads
from .wire import receive, send

#: The first that is written: what a host program has said before is none of ours.
GREETING = b"\x00volfrep engine\x00"
#: In the place of a call's number, where that could not be read.
UNKNOWN = -1
#: Progress is told so often, s.
OFTEN = 0.03


class _Server:
    """One call after the other, until the pipe closes."""

    def __init__(self, answers: IO[bytes], folder: Path) -> None:
        self._answers, self._folder = answers, folder
        self._writing = threading.Lock()
        self._caches: dict[int, StageCache] = {}
        self._asked: queue.SimpleQueue[Any] = queue.SimpleQueue()
        self._cancelled = self._number = UNKNOWN

    def listen(self, stream: IO[bytes]) -> None:
        """Take in what is asked; end this process when nobody is there any more."""
        while True:
            try:
                kind, number, value = receive(stream, self._folder, self._cache)
            except (EOFError, OSError):
                self._leave()
            except Exception as error:  # such as a module that is not found here
                self._asked.put((UNKNOWN, error))
                continue
            if kind == "cancel":
                self._cancelled = number
            elif kind == "forget":
                self._caches.pop(number, None)
            else:
                self._asked.put((number, value))
            del value

    def _leave(self) -> None:
        """End at once; the programs that a call runs see it, and end as well."""
        shutil.rmtree(self._folder, ignore_errors=True)
        os._exit(0)

    def serve(self) -> None:
        """Make the calls."""
        while True:
            self._number, call = self._asked.get()
            try:
                answer = "done", self._made(call)
            except BaseException as error:
                error.__traceback__, trace = None, traceback.format_exc()
                answer = "failed", (error, trace)
            del call
            try:
                self._send(*answer)
            except Exception as error:  # what cannot be sent; a full disk, say
                self._send("failed", (_unsent(error), traceback.format_exc()))
            del answer

    def _made(self, call: Any) -> Any:
        if isinstance(call, Exception):
            raise call
        known = dict(call.keywords)
        if call.has_progress:
            last_time, last_stage = 0.0, ""

            def progress(fraction: float, stage: str) -> bool:
                nonlocal last_time, last_stage
                now = time.monotonic()
                if stage != last_stage or now - last_time > OFTEN:
                    last_time, last_stage = now, stage
                    self._send("progress", (fraction, stage))
                return self._cancelled != self._number

            known["progress"] = progress
        for name in call.heard:
            known[name] = self._stub(name)
        function = call.function
        if isinstance(function, str):
            module, _, name = function.partition(":")
            function = getattr(import_module(module), name)
        return function(*call.arguments, **known)

    def _stub(self, name: str) -> Any:
        def tell(*arguments: object) -> bool:
            self._send("heard", (name, arguments))
            return self._cancelled != self._number

        return tell

    def _cache(self, number: int) -> StageCache:
        return self._caches.setdefault(number, StageCache())

    def _send(self, kind: str, value: object) -> None:
        with self._writing:
            send(self._answers, (kind, self._number, value), self._folder, lambda _: -1)


def _unsent(error: Exception) -> Exception:
    if isinstance(error, OSError):
        return VolfrepError(
            f"The engine's result could not be handed over ({error.strerror}): make room in the "
            "folder for temporary files."
        )
    return error


def serve(folder: str, threads: int, warm: tuple[str, ...]) -> None:
    """Make calls until the pipe closes.

    Args:
        folder: where large arrays lie on their way.
        threads: that calls may use; 0 for one on each core.
        warm: modules to import before it greets.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # whoever started us decides
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # what libraries print is no answer
    use_threads(threads)
    keep_freed_memory()
    for name in warm:
        import_module(name)
    answers.write(GREETING)
    answers.flush()
    server = _Server(answers, Path(folder))
    threading.Thread(target=server.listen, args=(sys.stdin.buffer,), daemon=True).start()
    server.serve()

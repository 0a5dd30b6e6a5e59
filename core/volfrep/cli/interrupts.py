# SPDX-License-Identifier: LGPL-2.1-or-later
"""The command as a process: its streams may be closed or full, and Ctrl-C may come at any time.

Nothing but the standard library is imported here: it is in force before anything else is read.

As it ends Python would look in all that there is for objects that hold each other; the system takes
a process's memory as a whole.
"""

from __future__ import annotations

import gc
import io
import os
import signal
import sys
import warnings
from types import FrameType
from typing import Any

EXIT_INTERRUPTED = 130
_SAID = "volfrep: Interrupted, no file was left half-written."

#: Set by the first Ctrl-C: a compiled module that it meets while it is imported may turn it into
#: another error.
_interrupted = False


def is_interrupted() -> bool:
    """Whether Ctrl-C was pressed."""
    return _interrupted


def prepare() -> None:
    """Make Ctrl-C, the standard streams and libraries' warnings those of a command."""
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, _on_interrupt)
    if not sys.warnoptions:
        warnings.simplefilter("ignore")  # of numpy, to whoever programs with it
    while (spare := os.open(os.devnull, os.O_RDWR)) <= 2:
        pass  # a closed stream's number would be that of the next file
    os.close(spare)
    for name in ("stdout", "stderr"):
        stream = getattr(sys, name)
        if stream is None:
            setattr(sys, name, open(os.devnull, "w", encoding="utf-8"))  # noqa: SIM115
        elif isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")  # a file's name may be any bytes
            setattr(sys, name, Stream(stream))


def leave(code: int) -> None:
    """End the process with that exit code, or 2 where text was lost that should have been shown."""
    for stream in (sys.stdout, sys.stderr):
        stream.flush()
    lost = getattr(sys.stdout, "error", None)
    if lost is not None and not isinstance(lost, BrokenPipeError):
        reason = lost.strerror or lost
        print(f"volfrep: Standard output took no more text ({reason}).", file=sys.stderr)
        sys.stderr.flush()
        code = code or 2
    if code == EXIT_INTERRUPTED:
        # A compiled call may still be busy on a thread: an ordinary exit would wait for it.
        os._exit(code)
    gc.freeze()  # so that it is not looked through for objects that hold each other
    sys.exit(code)


class Stream:
    """A text stream that goes on into nothing when it cannot be written any more.

    A full disk, or a reader such as `head` that has had enough, ends no job.

    Attributes:
        error: what happened; None for nothing.
    """

    def __init__(self, stream: io.TextIOWrapper) -> None:
        self._stream = stream
        self.error: OSError | None = None

    def __getattr__(self, name: str) -> Any:
        return getattr(self._stream, name)

    def write(self, text: str) -> int:
        """As of a file."""
        try:
            return self._stream.write(text)
        except OSError as error:
            self._turn_away(error)
            return len(text)

    def flush(self) -> None:
        """As of a file."""
        try:
            self._stream.flush()
        except OSError as error:
            self._turn_away(error)

    def _turn_away(self, error: OSError) -> None:
        self.error = self.error or error
        nothing = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nothing, self._stream.fileno())
        os.close(nothing)
        self._stream.flush()  # what waits in it


def _on_interrupt(number: int, frame: FrameType | None) -> None:
    global _interrupted
    _interrupted = True
    raise KeyboardInterrupt


def say_interrupted() -> int:
    """Tell it; the exit code."""
    print(_SAID, file=sys.stderr)
    return EXIT_INTERRUPTED

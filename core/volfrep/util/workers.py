# SPDX-License-Identifier: LGPL-2.1-or-later
"""Workers for calls that hold Python's lock: processes, as many as there may be threads."""

from __future__ import annotations

import multiprocessing
import signal
from collections.abc import Iterator
from concurrent.futures import Executor, ProcessPoolExecutor
from contextlib import contextmanager

from .threads import threads


@contextmanager
def processes() -> Iterator[Executor | None]:
    """An executor of as many processes as `threads` says; None where that is one.

    They start when they are first given something, as new interpreters: a script that uses them
    needs its `if __name__ == "__main__":`.
    """
    if threads() == 1:
        yield None
        return
    context = multiprocessing.get_context("spawn")
    pool = ProcessPoolExecutor(threads(), context, _ignore_interrupts)
    try:
        yield pool
    finally:
        pool.shutdown(cancel_futures=True)


def _ignore_interrupts() -> None:
    """Leave Ctrl-C, which a terminal sends to all its processes, to the one that is asked."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Progress as a bar, in terminals and notebooks; where neither looks, nothing is written."""

from __future__ import annotations

import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TextIO

from .errors import VolfrepError, brief
from .progress import ProgressCallback

WIDTH = 30
#: Seconds between two looks of the bar.
EVERY = 0.1


class ProgressBar:
    """A callback that draws how far a job is, over itself.

    Args:
        file: where.
    """

    def __init__(self, file: TextIO) -> None:
        self._file, self._last, self._longest = file, 0.0, 0

    def __call__(self, fraction: float, stage: str) -> None:
        """Draw it, but not more often than every tenth of a second."""
        now = time.monotonic()
        if now - self._last < EVERY:
            return
        self._last = now
        done = round(WIDTH * fraction)
        text = f"{'#' * done}{'.' * (WIDTH - done)} {100.0 * fraction:3.0f} % {stage}"
        self._file.write("\r" + text.ljust(self._longest))
        self._longest = len(text)
        self._file.flush()

    def close(self) -> None:
        """Wipe it."""
        if self._longest:
            self._file.write("\r" + " " * self._longest + "\r")
            self._file.flush()


@contextmanager
def shown(progress: ProgressCallback | bool | None) -> Iterator[ProgressCallback | None]:
    """The callback that a call's `progress` stands for, while it works.

    Args:
        progress: a callback; True for a bar on standard error where that is a terminal or a
            notebook; False or None for nothing.

    Raises:
        VolfrepError: it is none of these.
    """
    if progress is None or progress is False:
        yield None
    elif callable(progress):
        yield progress
    elif progress is not True:
        raise VolfrepError(
            f"'progress' is True for a bar, or a function of a fraction and a stage, not "
            f"{brief(progress)}."
        )
    elif sys.stderr is None or not (sys.stderr.isatty() or _in_notebook()):
        yield None
    else:
        bar = ProgressBar(sys.stderr)
        try:
            yield bar
        finally:
            bar.close()


def _in_notebook() -> bool:
    """Whether a Jupyter kernel runs this program."""
    return "ipykernel" in sys.modules

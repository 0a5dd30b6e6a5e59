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
        file: where; None draws nothing.
    """

    def __init__(self, file: TextIO | None) -> None:
        self._file, self._last, self._longest = file, 0.0, 0

    @property
    def is_drawn(self) -> bool:
        """Whether anybody sees it."""
        return self._file is not None

    def __call__(self, fraction: float, stage: str) -> None:
        """Draw it, but not more often than every tenth of a second."""
        now = time.monotonic()
        if self._file is None or now - self._last < EVERY:
            return
        self._last = now
        done = round(WIDTH * fraction)
        text = f"{'#' * done}{'.' * (WIDTH - done)} {100.0 * fraction:3.0f} % {stage}"
        self._file.write("\r" + text.ljust(self._longest))
        self._longest = len(text)
        self._file.flush()

    def close(self) -> None:
        """Wipe it."""
        if self._file is not None and self._longest:
            self._file.write("\r" + " " * self._longest + "\r")
            self._file.flush()


@contextmanager
def drawn(quiet: bool = False) -> Iterator[ProgressBar]:
    """A bar on standard error, where that is a terminal or a notebook and nobody wants it quiet.

    Always a callback, drawn or not: with one, long compiled calls run beside the main thread, which
    can then be interrupted.
    """
    seen = not quiet and sys.stderr is not None and (sys.stderr.isatty() or _in_notebook())
    bar = ProgressBar(sys.stderr if seen else None)
    try:
        yield bar
    finally:
        bar.close()


@contextmanager
def shown(progress: ProgressCallback | bool | None) -> Iterator[ProgressCallback | None]:
    """The callback that a call's `progress` stands for, while it works.

    Args:
        progress: a callback; True for a bar as `drawn`; False or None for nothing.

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
    else:
        with drawn() as bar:
            yield bar


def _in_notebook() -> bool:
    """Whether a Jupyter kernel runs this program."""
    return "ipykernel" in sys.modules

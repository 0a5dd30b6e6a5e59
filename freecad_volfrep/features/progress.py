# SPDX-License-Identifier: LGPL-2.1-or-later
"""How a job of the engine is run: with its progress in the window, or at once without a screen."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TypeVar

import FreeCAD as App

from freecad_volfrep.translation import translate
from volfrep.util.progress import ProgressCallback

from .screen import screen

T = TypeVar("T")


def job_title(text: str, obj: App.DocumentObject) -> str:
    """What a job is called in the window: `text` in the user's language, with the object's label.

    ``make translations`` looks for calls of this too: `text` must be literal.
    """
    return str(translate("VolfrepJobs", text)).format(label=obj.Label)


def run_job(
    title: str, work: Callable[[ProgressCallback | None], T], *, keeps_best: bool = False
) -> T:
    """What `work` returns or raises, called with a callback for its progress.

    In the window it runs on a thread of its own, so that the window lives meanwhile: it must
    touch nothing of FreeCAD. Without a screen it is simply called, with None. What it returns after
    a cancel is dropped, unless it is known to keep the best that it has (`keeps_best`).
    """
    window = screen()
    return work(None) if window is None else window.run_on_thread(title, work, keeps_best)


@contextmanager
def progress_of(title: str) -> Iterator[ProgressCallback | None]:
    """A callback for a job that touches FreeCAD, and stays on its thread; None without a screen."""
    window = screen()
    if window is None:
        yield None
        return
    with window.progress_bar(title) as callback:
        yield callback

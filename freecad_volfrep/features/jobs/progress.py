# SPDX-License-Identifier: LGPL-2.1-or-later
"""How a job of the engine is run: beside the window, or at once without a screen.

What only this FreeCAD can do goes through a generator, between whose steps the window answers; a
cancel is thrown into it, and what was added to the document goes.
"""

from __future__ import annotations

from collections.abc import Callable, Generator, Iterator, Mapping
from contextlib import contextmanager
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, TypeVar

import FreeCAD as App

from freecad_volfrep.translation import translate

from .screen import screen

if TYPE_CHECKING:
    from volfrep.process.worker import Call, OnItsWay

T = TypeVar("T")


def job_title(text: str, obj: App.DocumentObject) -> str:
    """What a job is called in the window: `text` in the user's language, with the object's label.

    ``make translations`` looks for calls of this too: `text` must be literal.
    """
    return str(translate("VolfrepJobs", text)).format(label=obj.Label)


def run_job(
    title: str,
    function: Callable[..., Any],
    *arguments: Any,
    in_freecad: bool = False,
    has_progress: bool = True,
    keeps_best: bool = False,
    heard: Mapping[str, Callable[..., Any]] = MappingProxyType({}),
    after: OnItsWay | None = None,
    **keywords: Any,
) -> Any:
    """What a function of the engine, or of the workbench, returns or raises.

    With a window it is called in a process of its own, and the window lives meanwhile. Without a
    screen it is simply called, here.

    Args:
        title: in the window.
        function: what is called.
        *arguments: that it is given.
        in_freecad: whether it needs FreeCAD in that process, for OpenCASCADE.
        has_progress: as of `Call`.
        keeps_best: as of `Call`.
        heard: as of `Call`.
        after: as of `Call`.
        **keywords: that it is given, too.

    Raises:
        Cancelled: in the window, by the user.
    """
    from volfrep.process.worker import Call

    call = Call(function, arguments, keywords, heard, keeps_best, has_progress, after)
    return run_call(title, call, in_freecad)


def run_call(title: str, call: Call, in_freecad: bool = False) -> Any:
    """As `run_job`, of a call that is made up already."""
    window = screen()
    return call.here() if window is None else window.wait_for(title, call, in_freecad)


def go_through(title: str, steps: Generator[float, None, T]) -> T:
    """Do work that only this FreeCAD can do; what the generator returns.

    With a window the view can be turned between its steps, and a cancel is thrown into it.

    Args:
        title: in the window.
        steps: yields after every step the share that is done, from 0 to 1.

    Raises:
        Cancelled: in the window, by the user.
    """
    window = screen()
    if window is not None:
        result: T = window.go_through(title, steps)
        return result
    while True:
        try:
            next(steps)
        except StopIteration as end:
            result = end.value
            return result


@contextmanager
def all_or_nothing(doc: App.Document) -> Iterator[None]:
    """Take away what was added to a document inside, where that fails or is cancelled."""
    before = {obj.Name for obj in doc.Objects}
    try:
        yield
    except BaseException:
        for name in [obj.Name for obj in doc.Objects if obj.Name not in before]:
            if doc.getObject(name) is not None:  # gone with another one
                doc.removeObject(name)
        raise

# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a window does for document objects: nothing, until a window is registered.

Objects know nothing of windows: whoever has one says here how it shows jobs and objects
(`freecad_volfrep.window`).
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import AbstractContextManager
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import FreeCAD as App

from volfrep.util.progress import ProgressCallback

if TYPE_CHECKING:
    from volfrep.apart.engine_process import Call


@dataclass(frozen=True)
class Screen:
    """How a window shows things.

    Attributes:
        wait_for: makes a call of the engine under a title, in a process of its own, and returns
            what it does; nothing but turning the view can be done meanwhile.
        progress_bar: gives the callback of a job under a title that stays on its thread.
        attach_view: gives an object of ours its view provider.
        revive_view: does so where FreeCAD has lost it.
    """

    wait_for: Callable[[str, Call], Any]
    progress_bar: Callable[[str], AbstractContextManager[ProgressCallback]]
    attach_view: Callable[[Any], None]
    revive_view: Callable[[Any], None]


_screens: list[Screen] = []


def register_screen(screen: Screen) -> None:
    """From now on, this is the window."""
    _screens[:] = [screen]


def screen() -> Screen | None:
    """The window, or None where there is none."""
    return _screens[0] if _screens and App.GuiUp else None


def attach_view(obj: App.DocumentObject) -> None:
    """Give an object its view provider, unless it has one; does nothing without a window."""
    window = screen()
    if window is not None and obj.ViewObject.Proxy is None:
        window.attach_view(obj)


def revive_view(obj: App.DocumentObject) -> None:
    """Give an object back the view provider that FreeCAD has lost; nothing without a window."""
    window = screen()
    if window is not None:
        window.revive_view(obj)

# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a window does for document objects: nothing, until a window is registered.

Objects know nothing of windows: whoever has one says here how it shows jobs and objects
(`freecad_volfrep.window`).
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import FreeCAD as App

if TYPE_CHECKING:
    from volfrep.process.worker import Call


@dataclass(frozen=True)
class Screen:
    """How a window shows things.

    Attributes:
        update: has an infill's mesh made that its recompute has asked for, beside what is done.
        wait_for: makes a call of the engine under a title, in a process of its own, which is
            FreeCAD's where that is wanted, and returns what it does; nothing but turning the view
            can be done meanwhile.
        go_through: does work under a title that only this FreeCAD can do, a step at a time, and
            lets the view be turned between the steps.
        attach_view: gives an object of ours its view provider.
        revive_view: does so where FreeCAD has lost it.
    """

    update: Callable[[Any, Any], None]
    wait_for: Callable[[str, Call, bool], Any]
    go_through: Callable[[str, Iterator[float]], Any]
    attach_view: Callable[[Any], None]
    revive_view: Callable[[Any], None]


#: What Python calls the source of a line that one of FreeCAD's own commands runs.
_COMMAND = "<string>"
_screens: list[Screen] = []


def register_screen(screen: Screen) -> None:
    """From now on, this is the window."""
    _screens[:] = [screen]


def screen() -> Screen | None:
    """The window, or None where there is none."""
    return _screens[0] if _screens and App.GuiUp else None


def is_asked_by_user() -> bool:
    """Whether a recompute, whose `execute` calls this, is the user's and no script's.

    FreeCAD's Refresh runs a line of Python, its property editor none at all; a script that
    recomputes stands behind `execute`, and wants the mesh before it goes on.
    """
    caller = sys._getframe(1).f_back
    return caller is None or caller.f_code.co_filename == _COMMAND


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

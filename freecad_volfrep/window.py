# SPDX-License-Identifier: LGPL-2.1-or-later
"""Joins the document objects and the windows, neither of which imports this module."""

from __future__ import annotations

from typing import Any

import FreeCAD as App

from .features.jobs.screen import Screen, register_screen


def register() -> None:
    """Say how this FreeCAD's window shows jobs and objects; does nothing without a window.

    What shows them is imported when it is used first.
    """
    if App.GuiUp:
        register_screen(Screen(_update, _wait_for, _go_through, _attach_view, _revive_view))


def _update(obj: App.DocumentObject, asked: Any) -> None:
    from .gui.jobs.updating import Update

    Update(obj, asked)


def _wait_for(title: str, call: Any, in_freecad: bool) -> Any:
    from .gui.jobs.progress import wait_for

    return wait_for(title, call, in_freecad)


def _go_through(title: str, steps: Any) -> Any:
    from .gui.jobs.progress import go_through

    return go_through(title, steps)


def _attach_view(obj: App.DocumentObject) -> None:
    from .gui.revived_view import view_of

    view_of(obj)(obj.ViewObject)


def _revive_view(obj: App.DocumentObject) -> None:
    from .gui.revived_view import revive_view

    revive_view(obj)

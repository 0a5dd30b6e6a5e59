# SPDX-License-Identifier: LGPL-2.1-or-later
"""View providers of objects that a FreeCAD without the workbench has saved."""

from __future__ import annotations

from typing import Any

from . import view_provider


def view_of(obj: Any) -> Any:
    """The class of view providers of an object of ours."""
    return getattr(view_provider, f"{type(obj.Proxy).__name__}View")


def revive_view(obj: Any) -> None:
    """Give an object its icon, its panel and its display modes back; colours stay as saved.

    FreeCAD calls `attach` once for each view, and has done so with the number that it puts in the
    place of a lost proxy: the modes are added here, and the list of them is made anew.
    """
    view, kind = obj.ViewObject, view_of(obj)
    if isinstance(view.Proxy, kind):
        return
    proxy = kind.__new__(kind)
    if hasattr(kind, "attach"):
        proxy.attach(view)
    view.Proxy = proxy
    if hasattr(kind, "getDisplayModes"):
        is_infill = kind is view_provider.LatticeInfillView
        shown = view.DisplayMode if is_infill else proxy.getDefaultDisplayMode()
        view.DisplayMode = view.listDisplayModes()
        view.DisplayMode = shown

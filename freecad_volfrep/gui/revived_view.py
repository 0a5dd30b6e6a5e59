# SPDX-License-Identifier: LGPL-2.1-or-later
"""View providers of objects that a FreeCAD without the workbench has saved."""

from __future__ import annotations

from typing import Any

from .view_provider import (
    DesignStudyView,
    LatticeInfillView,
    PrintCheckView,
    SlicerInfillView,
)


def revive_infill_view(view: Any) -> None:
    """Give a lattice infill its icon, its panel and its display modes back; colours stay as saved.

    FreeCAD calls `attach` once for each view, and has done so with the number that it puts in the
    place of a lost proxy: the modes are added here, and the list of them is made anew.
    """
    if isinstance(view.Proxy, LatticeInfillView):
        return
    proxy = LatticeInfillView.__new__(LatticeInfillView)
    proxy.attach(view)
    view.Proxy = proxy
    shown = view.DisplayMode
    view.DisplayMode = view.listDisplayModes()
    view.DisplayMode = shown


def revive_print_check_view(view: Any) -> None:
    """Give a print check its icon back; its colour stays as saved."""
    if not isinstance(view.Proxy, PrintCheckView):
        view.Proxy = PrintCheckView.__new__(PrintCheckView)


def revive_study_view(view: Any) -> None:
    """Give a design study its icon and its panel back."""
    if not isinstance(view.Proxy, DesignStudyView):
        proxy = DesignStudyView.__new__(DesignStudyView)
        proxy.attach(view)
        view.Proxy = proxy


def revive_slicer_infill_view(view: Any) -> None:
    """Give a slicer infill its icon, its panel and its bands back."""
    if isinstance(view.Proxy, SlicerInfillView):
        return
    proxy = SlicerInfillView.__new__(SlicerInfillView)
    proxy.attach(view)
    view.Proxy = proxy
    view.DisplayMode = view.listDisplayModes()
    view.DisplayMode = proxy.getDefaultDisplayMode()

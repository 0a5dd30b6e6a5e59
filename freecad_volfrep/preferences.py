# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a user sets once for all documents, in FreeCAD's parameters (Tools > Edit parameters)."""

from __future__ import annotations

import math

import FreeCAD as App

GROUP = "User parameter:BaseApp/Preferences/Mod/VOLFREP"


def largest_automatic() -> float:
    """Expected triangles above which a change waits for Update Lattice Infill, in the window.

    Without a window nobody waits: a recompute computes.
    """
    if not App.GuiUp:
        return math.inf
    return float(App.ParamGet(GROUP).GetInt("LargestAutomaticTriangles", 3_000_000))


def largest_shown() -> int:
    """Triangles above which a mesh is coarsened for the screen."""
    return int(App.ParamGet(GROUP).GetInt("LargestShownTriangles", 1_000_000))

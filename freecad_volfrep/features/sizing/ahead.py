# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a sizing of an infill needs and no load changes, asked for before its loads are known."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING

import FreeCAD as App

from .as_built import building_of, printing_by

if TYPE_CHECKING:
    from volfrep.jobs.sizing import Goal


def goal_ahead(
    obj: App.DocumentObject,
    numbers: Mapping[str, float],
    as_printed: str,
    scatter: float,
    for_print: bool,
) -> Callable[[], Goal]:
    """What of a goal counts before loads and material are known; arguments as of `size_struts`.

    Returns:
        What makes it, on any thread: the engine's modules take a while to load.

    Raises:
        VolfrepError: as `size_struts`.
    """
    least, most, buckling = (numbers[name] or None for name in ("thinnest", "thickest", "buckling"))
    printing = printing_by(obj, as_printed, scatter)
    building = building_of(obj) if for_print else None

    def goal() -> Goal:
        from volfrep.jobs.sizing import Goal
        from volfrep.sizing.analysis import Limits

        return Goal(
            Limits(buckling=buckling),
            thinnest=least,
            thickest=most,
            printing=printing,
            building=building,
        )

    return goal

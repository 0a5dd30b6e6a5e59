# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a sizing of an infill needs and no load changes, asked for before its loads are known."""

from __future__ import annotations

from collections.abc import Mapping
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
) -> Goal:
    """What of a goal counts before loads and material are known; arguments as of `size_struts`.

    Raises:
        VolfrepError: as `size_struts`.
    """
    from volfrep.jobs.sizing import Goal
    from volfrep.sizing.analysis import Limits

    return Goal(
        limits=Limits(buckling=numbers["buckling"] or None),
        thinnest=numbers["thinnest"] or None,
        thickest=numbers["thickest"] or None,
        printing=printing_by(obj, as_printed, scatter),
        building=building_of(obj) if for_print else None,
    )

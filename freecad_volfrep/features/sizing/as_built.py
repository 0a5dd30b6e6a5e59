# SPDX-License-Identifier: LGPL-2.1-or-later
"""How an infill that is sized is built: by which process, and how its struts come out."""

from __future__ import annotations

import json
from dataclasses import replace
from typing import TYPE_CHECKING

import FreeCAD as App

from freecad_volfrep.features.infill.materials import process_of
from freecad_volfrep.translation import spoken, translate
from volfrep.util.errors import VolfrepError

if TYPE_CHECKING:
    from volfrep.design.spec import LatticeSpec
    from volfrep.jobs.sizing import Building, Printing


def sized_as_printed(obj: App.DocumentObject) -> tuple[str, float]:
    """By which table, and how many standard deviations thinner, an infill was sized as printed.

    The table is empty where the infill was sized as drawn, or not at all.
    """
    report = json.loads(obj.SizingReport) if obj.SizingReport else {}
    printed = report.get("as_printed") or {}
    return printed.get("name", ""), float(printed.get("scatters", 0.0))


def is_sized_for_print(obj: App.DocumentObject) -> bool:
    """Whether an infill was sized for what its process builds."""
    return bool(obj.SizingReport) and "building" in json.loads(obj.SizingReport)


def spec_to_size(obj: App.DocumentObject, spec: LatticeSpec, for_print: bool) -> LatticeSpec:
    """An infill's specification to size: which flat struts go is decided anew."""
    anew = for_print or is_sized_for_print(obj)
    return replace(spec, flat_struts=None) if anew else spec


def building_of(obj: App.DocumentObject) -> Building:
    """How an infill is built: by its process, or the usual one of its material.

    Raises:
        VolfrepError: neither is chosen.
    """
    process = process_of(obj)
    if process is None:
        raise VolfrepError("No process is chosen to build for: choose one for the infill.")
    from volfrep.jobs.sizing import Building
    from volfrep.reports.processes import find_process

    return Building(find_process(process), tuple(obj.BuildDirection))


def building_in_words(building: Building) -> str:
    """By which process, along which direction, and what it asks of struts and skin."""
    from volfrep.reports.sizing_results import along_text

    process = building.process
    said = translate(
        "VolfrepSizePanel",
        "{process}, built along {direction}: struts from {strut} mm thick, walls from {wall} mm",
    )
    if process.inclination:
        said = translate(
            "VolfrepSizePanel",
            "{process}, built along {direction}: struts from {strut} mm thick and {degrees} "
            "degrees steep, walls from {wall} mm",
        )
    return said.format(
        process=process.name,
        direction=along_text(building.build_direction),
        strut=spoken(f"{process.strut:g}"),
        degrees=f"{process.inclination:g}",
        wall=spoken(f"{process.wall:g}"),
    )


def printing_of(obj: App.DocumentObject) -> Printing | None:
    """How an infill's struts come out by which it was sized; None where as drawn.

    Raises:
        VolfrepError: the table was the user's own, and its file is gone.
    """
    return printing_by(obj, *sized_as_printed(obj))


def printing_by(obj: App.DocumentObject, table: str, scatter: float) -> Printing | None:
    """How an infill's struts come out; None where they are taken as drawn.

    Raises:
        VolfrepError: there is no such table, or it does not say how far diameters scatter.
    """
    if not table:
        return None
    from volfrep.design.as_printed import find_printed_table
    from volfrep.jobs.sizing import Printing

    return Printing(find_printed_table(table), tuple(obj.BuildDirection), scatter)

# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a preview's part will be to print, as rows for the panel: held against the process."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import FreeCAD as App

from freecad_volfrep.features.infill.materials import process_of
from freecad_volfrep.features.properties.quantities import mass_of
from freecad_volfrep.translation import figure, grouped, translate

if TYPE_CHECKING:
    from freecad_volfrep.features.infill.live_preview import Shown
    from volfrep.reports.processes import Process


#: A share of the struts' length that is not worth a word.
_HARDLY = 1e-3


@dataclass(frozen=True)
class Row:
    """A figure: its name, its value with the unit, and whether the process takes it."""

    name: str
    value: str
    is_kept: bool = True


def print_rows(obj: App.DocumentObject, shown: Shown) -> list[Row]:
    """The figures of what is shown; those of the mesh where it is made of these values.

    Raises:
        VolfrepError: the build direction is none, or the material cannot be read.
    """
    from volfrep.reports.clearance import WIDEST_GAP
    from volfrep.reports.printability import print_forecast
    from volfrep.reports.processes import find_process

    name = process_of(obj)
    process = None if name is None else find_process(name)
    lines = shown.preview
    forecast = print_forecast(
        lines.spec,
        (lines.start, lines.end, lines.radii),
        (shown.solid.volume, lines.volume),
        process,
        tuple(obj.BuildDirection),
    )
    rows = []
    if forecast.thinnest_strut_mm is not None:
        thinnest = translate("VolfrepFigures", "thinnest strut")
        least = process and process.strut
        rows.append(_against(thinnest, forecast.thinnest_strut_mm, least, is_least=True))
    gap = translate("VolfrepFigures", "narrowest gap")
    if forecast.narrowest_gap_mm is not None:
        rows.append(
            _against(gap, forecast.narrowest_gap_mm, process and process.gap, is_least=True)
        )
    elif not lines.spec.kind.has_struts:
        pass  # gaps are those between struts
    elif forecast.is_gap_known:
        wide = figure(WIDEST_GAP * lines.spec.cell_size)
        rows.append(Row(gap, translate("VolfrepFigures", "over {width} mm").format(width=wide)))
    else:
        rows.append(Row(gap, translate("VolfrepFigures", "varies: see Print Check")))
    if process is not None and process.inclination:
        rows.append(
            Row(
                translate("VolfrepFigures", "struts below {angle}\u00b0").format(
                    angle=figure(process.inclination)
                ),
                f"{figure(100 * forecast.overhanging_share)} %",
                forecast.overhanging_share < _HARDLY,
            )
        )
    if forecast.longest_flat_mm > 0.0:
        rows.append(
            _against(
                translate("VolfrepFigures", "longest flat strut"),
                forecast.longest_flat_mm,
                process and process.bridge,
                is_least=False,
            )
        )
    rows.append(_held(obj, shown, forecast.void_mm3, process))
    mass = mass_of(obj) if shown.is_made else forecast.mass_g
    saved = forecast.saved_g + forecast.mass_g - mass
    rows.append(
        Row(
            translate("VolfrepFigures", "saved against the solid"),
            f"{figure(saved, 3)} g, {figure(100 * saved / max(saved + mass, 1e-300))} %",
        )
    )
    if obj.MaterialPrice > 0.0:
        rows.append(
            Row(
                translate("VolfrepFigures", "cost of the material"),
                figure(obj.MaterialPrice * mass / 1000.0, 3),
            )
        )
    return rows


def _held(obj: App.DocumentObject, shown: Shown, void: float, process: Process | None) -> Row:
    """What stays in closed voids: of the mesh where there is one, else of a closed skin."""
    voids = obj.Voids if shown.is_made else int(void > 0.0)
    name = translate("VolfrepFigures", "closed voids")
    if not voids:
        return Row(name, translate("VolfrepFigures", "none"))
    value = grouped(voids) if shown.is_made else translate("VolfrepFigures", "a closed skin")
    if void > 0.0:
        value = translate("VolfrepFigures", "{voids}, holding {volume} cm\u00b3").format(
            voids=value, volume=figure(void / 1000.0)
        )
    return Row(name, value, process is None or process.escape_hole is None)


def _against(name: str, value: float, limit: float | None, is_least: bool) -> Row:
    """A length beside a limit that it must not be below, or not above."""
    text = f"{figure(value, 3)} mm"
    if limit is None:
        return Row(name, text)
    wanted = (
        translate("VolfrepFigures", "at least {limit}")
        if is_least
        else translate("VolfrepFigures", "at most {limit}")
    ).format(limit=figure(limit, 3))
    kept = value >= limit - 1e-9 if is_least else value <= limit + 1e-9
    return Row(name, f"{text} ({wanted})", kept)

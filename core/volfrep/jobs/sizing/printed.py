# SPDX-License-Identifier: LGPL-2.1-or-later
"""Struts sized as they come out of a printer: what is varied is drawn, what carries comes out.

Each strut gets what the table adds at its inclination, the volume at a node the mean of its
struts. The skin is taken as it is drawn: tables are of struts.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ...design.as_printed import PrintedTable
from ...grid.inclination import inclinations, unit_direction
from ...grid.strut_graph import Wireframe
from ...sizing.analysis import Analysis
from ...sizing.model import SizingModel
from ...sizing.node_radii import ComesOut
from ...util.errors import VolfrepError


@dataclass(frozen=True)
class Printing:
    """How struts come out.

    Attributes:
        table: of diameters.
        build_direction: from the build plate up, of any length.
        scatters: stress and buckling are those of struts that are thinner by so many standard
            deviations of the table.
    """

    table: PrintedTable
    build_direction: tuple[float, float, float] = (0.0, 0.0, 1.0)
    scatters: float = 0.0

    def __post_init__(self) -> None:
        if not (np.isfinite(self.scatters) and self.scatters >= 0.0):
            raise VolfrepError(
                f"The number of standard deviations must be 0 or more, not {self.scatters}."
            )
        if self.scatters and not any(row.scatter for row in self.table.rows):
            raise VolfrepError(
                f"The table of {self.table.title} does not say how far diameters scatter: measure "
                "several struts of each diameter and inclination, or leave the scatter out."
            )


def comes_out(printing: Printing, wireframe: Wireframe, least: float) -> ComesOut:
    """What is printed of a lattice's struts, whatever their radii.

    Args:
        printing: how.
        wireframe: whole, in the part's coordinates.
        least: mm, the smallest radius that is drawn.

    Raises:
        VolfrepError: the direction is none, or the thinnest struts do not come out.
    """
    angle = inclinations(wireframe, unit_direction(printing.build_direction))
    offset, share, scatter = printing.table.at(angle)
    factor, added = 1.0 + share, 0.5 * offset
    thinner = 0.5 * printing.scatters * scatter
    left = factor * least + added - thinner
    if (left <= 0.0).any():
        worst = int(left.argmin())
        raise VolfrepError(
            f"Struts of {2.0 * least:.3g} mm at {angle[worst]:.0f} degrees may not come out at all "
            f"({printing.table.title}): allow thicker ones only, or fewer standard deviations."
        )
    ends = wireframe.nodes[wireframe.struts]
    length = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    count = len(wireframe.nodes)
    total = np.zeros((3, count))
    for side in (0, 1):
        node = wireframe.struts[:, side]
        for row, value in zip(total, (length, length * factor, length * added), strict=True):
            row += np.bincount(node, value, count)
    whole = np.maximum(total[0], 1e-300)
    return ComesOut(factor, added, thinner, total[1] / whole, total[2] / whole)


def printed_figures(
    printing: Printing, model: SizingModel, design: Analysis, density: float
) -> dict[str, Any]:
    """What comes out of a design, for its report: mm and g.

    Args:
        printing: how.
        model: what was solved.
        design: whose radii are drawn.
        density: g/cm3.
    """
    shape = model.problem.radii
    out = 2.0 * shape.of_struts(design.radii)
    drawn = 2.0 * shape.drawn(design.radii)
    figures = {
        "name": printing.table.name,
        "table": printing.table.title,
        "build_direction": [float(value) for value in printing.build_direction],
        "diameters_mm": [float(out.min()), float(out.max())],
        "drawn_diameters_mm": [float(drawn.min()), float(drawn.max())],
        "drawn_strut_mass_g": shape.filled.at(design.radii) * density / 1000.0,
        "scatters": printing.scatters,
    }
    return {**figures, "note": _in_words(figures)}


def _in_words(figures: dict[str, Any]) -> str:
    (thin, thick), (least, most) = figures["diameters_mm"], figures["drawn_diameters_mm"]
    scatter = ""
    if figures["scatters"]:
        scatter = (
            f"; stress and buckling are of struts thinner by {figures['scatters']:g} standard "
            "deviations"
        )
    return (
        f"All figures are of struts as printed ({figures['table']}), {thin:.3f} to {thick:.3f} mm "
        f"thick; drawn are {least:.3f} to {most:.3f} mm, {figures['drawn_strut_mass_g']:.4g} "
        f"g{scatter}."
    )

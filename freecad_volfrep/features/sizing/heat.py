# SPDX-License-Identifier: LGPL-2.1-or-later
"""The steady heat of an infill, of its document's analyses: solved, and told."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import FreeCAD as App

from freecad_volfrep.features.infill.materials import material_of
from freecad_volfrep.features.jobs.progress import job_title, run_job
from freecad_volfrep.translation import figure, translate
from volfrep.reports.tables import Table
from volfrep.util.errors import VolfrepError

if TYPE_CHECKING:
    from volfrep.jobs.heat import SteadyHeat
    from volfrep.loads.load_cases import LoadCases

#: What the figures leave out.
LIMITS = (
    "Heat enters and leaves through the faces named here only: none is lost to air, and none is "
    "radiated.",
    "The lattice is a solid of its cells' conductivity: what lies within a cell is not seen.",
    "The part's stress and growth by heat are not looked at here: volfrep homogenise tells them.",
)


@dataclass(frozen=True, eq=False)
class HeatOutcome:
    """What came of it.

    Attributes:
        found: temperatures, in degrees C, and what flows.
        conductivity: of the solid, W/(m K).
    """

    found: SteadyHeat
    conductivity: float

    def summary(self) -> str:
        """Sentences for the panel."""
        low, high = (figure(value, 4) for value in self.found.ends)
        flow = sum(max(face["power_w"], 0.0) for face in self.found.faces)
        said = translate(
            "VolfrepSizePanel", "Temperatures are {low} to {high} \u00b0C, {flow} W flow through."
        ).format(low=low, high=high, flow=figure(flow, 4))
        if self.found.resistance is None:
            return str(said)
        more = translate("VolfrepSizePanel", "Thermal resistance: {resistance} K/W.")
        return f"{said} {more.format(resistance=figure(self.found.resistance, 4))}"

    def tables(self) -> list[Table]:
        """Figures of the whole and of each face: English, as saved tables are."""
        low, high = self.found.ends
        rows: list[tuple[Any, ...]] = [
            ("least temperature, \u00b0C", low),
            ("largest temperature, \u00b0C", high),
        ]
        if self.found.resistance is not None:
            rows.append(("thermal resistance, K/W", self.found.resistance))
        rows += [
            ("conductivity of the solid, W/(m K)", self.conductivity),
            ("cells across where it is thickest", self.found.cells_across),
        ]
        faces = tuple(
            (face["name"], face["temperature"], face["power_w"]) for face in self.found.faces
        )
        header = ("", "mean temperature, \u00b0C", "heat into the part, W")
        return [
            Table("Steady heat", tuple(rows)),
            Table("Heat through faces", faces, header),
            Table("What the heat leaves out", tuple((text,) for text in LIMITS)),
        ]


def heat_loads(obj: App.DocumentObject, analyses: Sequence[App.DocumentObject]) -> LoadCases:
    """What analyses say of an infill's heat.

    Raises:
        VolfrepError: its conductivity is not known, there is no heat, or it makes no sense.
    """
    from freecad_volfrep.bridge.fem_loads import heat_of
    from freecad_volfrep.bridge.solids import parent_placement

    if not obj.Conductivity > 0.0:
        raise VolfrepError(
            "The solid's conductivity is not known: type it in Loads and Sizing, W/(m K)."
        )
    return heat_of(analyses, parent_placement(obj), obj.Conductivity, material_of(obj))


def solve_heat(obj: App.DocumentObject, analyses: Sequence[App.DocumentObject]) -> HeatOutcome:
    """Solve the steady heat of an infill as it is.

    Args:
        obj: a lattice infill.
        analyses: of the FEM workbench; one of them has heat.

    Raises:
        VolfrepError: as `heat_loads`, or the lattice is none of cells that repeat.
        Cancelled: in the window, by the user.
    """
    from volfrep.jobs.heat import solve_heat

    loads = heat_loads(obj, analyses)
    solid, spec, cache = obj.Proxy.wanted(obj)
    title = job_title("Heat in {label}", obj)
    found = run_job(title, solve_heat, solid, spec, loads, cache=cache)
    return HeatOutcome(found, obj.Conductivity)

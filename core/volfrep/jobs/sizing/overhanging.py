# SPDX-License-Identifier: LGPL-2.1-or-later
"""What of a design hangs over when it is built: of its outside, and within its skin."""

from __future__ import annotations

from typing import Any

import numpy as np

from ...grid.inclination import unit_direction
from ...mesh.triangle_mesh import TriangleMesh, compact
from ...reports.printability import overhanging_facets
from ..infill import Infill
from .building import Building


def building_figures(building: Building, infill: Infill) -> dict[str, Any]:
    """What is to be known of a design that is built so, for its report: mm, mm2.

    Ceilings are what hangs over within the skin, where only struts hold it.
    """
    up, inclination = unit_direction(building.build_direction), building.process.inclination
    pruned = infill.pruned
    figures: dict[str, Any] = {
        "process": building.process.name,
        "build_direction": [float(value) for value in building.build_direction],
        "inclination_degrees": inclination,
        "removed": 0 if pruned is None else pruned.left.flat,
    }
    surfaces = {"outside": infill.solid}
    if infill.spec.with_skin:
        domain = infill.domain.mesh
        surfaces["ceilings"] = TriangleMesh(domain.vertices, domain.triangles[:, ::-1])
    for name, mesh in surfaces.items():
        hanging = overhanging_facets(mesh, up, inclination)
        part = compact(TriangleMesh(mesh.vertices, mesh.triangles[hanging]))
        figures[name] = {"area_mm2": part.area, "middle_mm": None}
        if hanging.any():
            figures[name]["middle_mm"] = _largest(part)
    return figures


def _largest(mesh: TriangleMesh) -> list[float]:
    """(3,) mm, the middle of the largest triangle."""
    largest = mesh.vertices[mesh.triangles[int(np.argmax(mesh.areas()))]]
    return [float(value) for value in largest.mean(axis=0)]


def overhanging_skin(figures: dict[str, Any]) -> list[str]:
    """Sentences on the skin that hangs over, of `building_figures`; none where none does."""
    said = []
    for name, what in (
        ("outside", "the part's outside"),
        ("ceilings", "ceilings within its skin, which only struts hold,"),
    ):
        found = figures.get(name)
        if found is not None and found["area_mm2"] > 0.0:
            x, y, z = found["middle_mm"]
            said.append(
                f"{figures['process']} builds {figures['inclination_degrees']:g} degrees and more "
                f"without support, and {found['area_mm2']:,.0f} mm2 of {what} are flatter, as at "
                f"({x:.4g}, {y:.4g}, {z:.4g}): another build direction may have less."
            )
    return said

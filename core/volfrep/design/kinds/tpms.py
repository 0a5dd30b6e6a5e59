# SPDX-License-Identifier: LGPL-2.1-or-later
"""Sheets about triply periodic surfaces, or all on one side of them, meshed as octants."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from numpy.typing import NDArray

from ...util.errors import VolfrepError
from ...util.types import Floats
from .. import costs
from ..cells import UnitCell
from ..spec_fields import Kind
from ..spec_parts import MAX_RESOLUTION
from ..tpms import PeriodicSurface
from ..tpms.measures import strongest_curvature, surface_area
from ..tpms.sheet import BOW, wanted_facets

#: Facets on one side of a wall, for each area of a facet's edge squared.
TRIANGLES_OF_SIDE = 2.5
#: Walls reach this far into a bend at most, in its radii: beyond, their sides meet in creases.
MOST_INSIDE = 0.5


class Tpms(Kind):
    """Walls along a triply periodic surface."""

    has_struts = False
    is_judged_by_preview = False

    @property
    def surface(self) -> PeriodicSurface:
        """The surface that the walls follow."""
        assert isinstance(self.spec.cell, PeriodicSurface)
        return self.spec.cell

    @property
    def endless(self) -> Mapping[str, Any]:
        """The surface, and what is solid beside it."""
        sheet = {"wall_kind": self.spec.wall.kind, self.measure: self.thickness}
        return {"cell": self.surface, "cell_size": self.spec.cell_size, **sheet}

    def content_of_0_1_0(self) -> Sequence[NDArray[Any]]:
        """Nothing."""
        return ()

    @property
    def thicknesses(self) -> tuple[float, float]:
        """The smallest and the largest thickness of a sheet, mm; 0 for one side of a surface."""
        if not self.spec.wall.is_sheet:
            return 0.0, 0.0
        if self.spec.radius_grading is not None:
            return self.spec.radius_grading.extremes
        return self.spec.wall.thickness, self.spec.wall.thickness

    def refuse(self) -> None:
        """Refuse what is about struts, of which walls have none."""
        spec = self.spec
        given = {
            "fillet": spec.fillet > 0.0,
            "removal of struts": spec.ending.removes_struts,
            "radius grading": spec.radius_grading is not None and not spec.wall.is_sheet,
        }
        for what, is_given in given.items():
            if is_given:
                kind = "walls" if what != "radius grading" else f"a {spec.wall.kind}"
                raise VolfrepError(f"A {what} is not for {kind}: leave it out.")
        if spec.boundary != "trim" or spec.activation != "touching":
            raise VolfrepError(
                "Walls are cut at the wall of what they fill: choose the boundary trim and the "
                "activation touching."
            )
        if self.thicknesses[1] >= spec.cell_size:
            raise VolfrepError(
                f"Walls of {self.thicknesses[1]:g} mm are too thick for a cell of "
                f"{spec.cell_size:g} mm: reduce the thickness or enlarge the cell."
            )
        _ = self.facets_along_cell

    @property
    def measure(self) -> str:  # type: ignore[override]
        """The thickness of a sheet, or the offset of a side."""
        return "wall_thickness" if self.spec.wall.is_sheet else "wall_offset"

    @property
    def thickness(self) -> float:
        """The thickness of a sheet, or the offset of a side, mm."""
        return self.spec.wall.thickness if self.spec.wall.is_sheet else self.spec.wall.offset

    def of_thickness(self, value: float) -> dict[str, Any]:
        """The field of walls of such a thickness, or offset, in mm."""
        sheet = self.spec.wall
        if sheet.is_sheet:
            return {"wall": replace(sheet, thickness=value)}
        return {"wall": replace(sheet, offset=value)}

    @property
    def mean_radius(self) -> float:
        """Half the thickness of a sheet, of a graded one a mean, mm; 0 for a side."""
        return 0.25 * sum(self.thicknesses)

    @property
    def without_effect(self) -> dict[str, Any]:
        """Nothing."""
        return {}

    def as_json(self) -> dict[str, Any]:
        """The wall and the surface's formula."""
        return {"wall": {"formula": self.surface.formula, **self.spec.wall.as_json()}}

    def unit_cell(self) -> UnitCell:
        """None.

        Raises:
            VolfrepError: always.
        """
        raise VolfrepError(
            f"This is done with struts and not with a TPMS ({self.spec.cell_name}): choose "
            "another cell."
        )

    @property
    def coarsest_resolution(self) -> int:
        """Facets along L below which sheets would lose their thickness."""
        curvature = strongest_curvature(self.surface)
        return self.spec.wall.coarsest(self.spec.cell_size, self.thicknesses[0], curvature)

    @property
    def facets_along_cell(self) -> int:
        """How many facet edges fit along L: the resolution, or what the deviation asks for.

        Raises:
            VolfrepError: there would be too many.
        """
        spec = self.spec
        wanted = spec.resolution or wanted_facets(
            spec.cell_size, spec.detail.deviation, self._strongest_curvature
        )
        facets = max(wanted, self.coarsest_resolution)
        if facets > MAX_RESOLUTION:
            raise VolfrepError(
                f"Such walls need {facets} facets along a cell: the limit is {MAX_RESOLUTION}; "
                "make them thicker, the cells smaller or the deviation larger."
            )
        return facets

    def deviation_of(self, facets: int) -> float:
        """As of `Kind`, by the surface's curvature."""
        return BOW * self._strongest_curvature * self.spec.cell_size / facets**2

    @property
    def _strongest_curvature(self) -> float:
        """Of the walls' own surface, over L: on the inside of a bend stronger than the middle's."""
        middle, wall = strongest_curvature(self.surface), self.spec.wall
        away = 0.5 * self.thicknesses[1] if wall.is_sheet else abs(wall.offset)
        return middle / (1.0 - min(middle * away / self.spec.cell_size, MOST_INSIDE))

    @property
    def too_coarse(self) -> str:
        """Sheets, which would lose their thickness."""
        return f"walls of {self.thicknesses[0]:.3g} mm, which would lose their thickness"

    def triangles_of_cell(self, shares: Floats) -> float:
        """Triangles of the walls in one cell, about."""
        sides = TRIANGLES_OF_SIDE * (1 + self.spec.wall.is_sheet) * surface_area(self.surface)
        return sides * self.facets_along_cell**2

    def meshing_seconds(self, sets: float) -> float:
        """As of `Kind`: one period, however many cells."""
        return costs.SECONDS_PER_PERIOD_TRIANGLE * self.triangles_of_cell(self.strut_shares())

    @property
    def meshing_bytes(self) -> float:
        """As of `Kind`."""
        return costs.BYTES_PER_PERIOD_TRIANGLE * self.triangles_of_cell(self.strut_shares())

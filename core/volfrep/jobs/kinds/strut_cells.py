# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cubic cells of struts: octants that are meshed once for each kind of joint.

What a method needs is loaded with it: a block takes nothing that fills parts or homogenises.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from ...design.cells import UnitCell
from ...design.spec import LatticeSpec
from ...design.target import Target
from ...mesh.triangle_mesh import TriangleMesh
from ...util.errors import VolfrepError
from ...util.numbers import number
from ...util.types import Floats
from .kind import UNDRAWN, EndlessRequest, Expected, LatticeKind

if TYPE_CHECKING:
    from ...mechanics.summary import CellProperties
    from ..part_depth import PartDepth, Preview
    from ..part_domain import PartDomain
    from .strut_block import StrutBlock
    from .strut_lattice import StrutLattice


class StrutCellKind(LatticeKind):
    """Cubic cells with struts of one radius."""

    foretells_target = True

    def fill(self, part: PartDomain) -> StrutLattice:
        """The struts of a part's cells."""
        from .strut_lattice import StrutLattice

        return StrutLattice(part)

    def block(self, count: Sequence[int]) -> StrutBlock:
        """The struts of a block of cells."""
        from .strut_block import StrutBlock

        return StrutBlock(self, count)

    def refuse(self, solid: TriangleMesh) -> None:
        """Refuse cells that are larger than the part."""
        from ..octant_guard import refuse_large_cells

        refuse_large_cells(solid, self.spec.cell_size)

    def modulus(self, target: Target) -> float:
        """Young's modulus of the endless lattice along a target's direction."""
        from ..stiffness_target import modulus

        spec, size = self.spec, self.spec.cell_size
        ratio, fillet = spec.strut_radius / size, spec.fillet / size
        return modulus(spec.unit_cell(), ratio, target, fillet)

    def stiffened(self, target: Target) -> LatticeSpec:
        """The specification with the radius of a stiffness."""
        from ..stiffness_target import ratio_of_stiffness

        spec, size = self.spec, self.spec.cell_size
        ratio = ratio_of_stiffness(spec.unit_cell(), target, spec.fillet / size)
        return replace(spec, strut_radius=ratio * size)

    def roughly_solved(self, solid: TriangleMesh) -> LatticeSpec:
        """The specification with about the radius of its target."""
        if self.spec.target is None:
            return self.spec
        from ..rough_radius import solve_target_roughly  # slow to load

        return solve_target_roughly(solid, self.spec)

    def preview(self, solid: TriangleMesh, depth: PartDepth) -> Preview:
        """The struts of the active cells."""
        from ...grid.placement import graded_wireframe
        from ...grid.strut_graph import cell_graph
        from ...lattice.padded_grid import least_width
        from ..preview import MOST_STRUTS, place_lattice, show_cells, show_struts
        from ..rough_radius import lattice_volume, radius_of_target

        spec, cell = self.spec, self.spec.unit_cell()
        placement = place_lattice(solid, spec, depth.monitor)
        least = least_width(cell, spec.cell_size, spec.struts)
        cells = show_cells(solid, spec, depth, placement, least)
        count = int(cells.active.sum())
        if count * len(cell.struts) > MOST_STRUTS:
            raise VolfrepError(
                f"{count:,} cells are too many to be shown as lines: enlarge the cells."
            )
        grid = cells.grid
        graph = cell_graph(cell, cells.active, spec.cell_size, grid.origin, grid.periodic)
        frame = graded_wireframe(graph, spec.struts, placement)

        def volume(bare: float, domain: float, skin: float) -> tuple[LatticeSpec, float]:
            made = spec
            if spec.target is not None:
                made = replace(spec, strut_radius=radius_of_target(spec, bare, domain, skin))
            # Struts that reach from a narrow domain into the skin are counted as a whole.
            return made, min(lattice_volume(made, bare, made.template_radius), domain)

        none = (
            f"No strut of cells of {spec.cell_size:g} mm lies inside the skin: reduce the cell "
            "size or the skin thickness."
        )
        return show_struts(solid, spec, depth, frame, volume, none, cells)

    def expected(self, solid: TriangleMesh, depth: PartDepth) -> Expected:
        """By the density of the endless lattice; where cells or radii vary, by the preview."""
        from ..rough_radius import endless_bare, endless_density, radius_of_target

        spec = self.spec
        inside = depth.volume_below(spec.shell)
        skin = spec.skin_volume(solid.volume, inside)
        if spec.target is not None and spec.output != "domain":
            radius = radius_of_target(spec, endless_bare(spec, inside), inside, skin)
            spec = replace(spec, strut_radius=radius, target=None)
        if spec.is_graded and spec.output != "domain":
            share = type(self)(spec).preview(solid, depth).relative_density
        else:
            size = spec.cell_size
            share = endless_density(spec.unit_cell(), spec.strut_radius / size, spec.fillet / size)
        return Expected(spec, share, skin + share * inside)

    def largest_ball(self) -> float | None:
        """Of equal cells; a fillet makes windows narrower still."""
        from ...reports.largest_ball import largest_ball

        spec, size = self.spec, self.spec.cell_size
        if spec.varies:
            return None
        return max(largest_ball(spec.unit_cell(), spec.strut_radius / size) * size, 0.0)

    @staticmethod
    def properties(cell: UnitCell, cell_size: float, request: EndlessRequest) -> CellProperties:
        """Off the catalogue where it has the cell, else homogenised."""
        from ...mechanics.catalogue import known_cell, known_properties
        from ...mechanics.summary import cell_properties

        radius = request.strut_radius
        numbers = {
            "strut radius": (radius, "mm"), "relative density": (request.relative_density, ""),
            "joint fillet": (request.fillet, "mm"),
        }  # fmt: skip
        for name, (value, unit) in numbers.items():
            if value is not None:
                number(name, value, unit, positive=None)
        of_tpms = request.wall_kind or request.wall_formula
        if request.given not in (["strut radius"], ["relative density"]) or of_tpms:
            raise VolfrepError("Of struts give either a strut radius or a relative density.")
        if request.as_printed is not None:
            from ...design.as_printed import find_printed_table
            from ..as_printed import printed_radius

            if radius is None:
                raise VolfrepError(UNDRAWN)
            table = find_printed_table(request.as_printed)
            radius, said = printed_radius(cell, cell_size, radius, table, request.build_direction)
            request.note(said)
        if not (request.exact or request.fillet or request.along):
            listed, near = known_cell(cell), radius
            if request.relative_density is not None and listed is not None:
                near = listed.radius_of_density(request.relative_density, cell_size)
            known = None
            if near is not None:
                known = known_properties(cell, cell_size, near, request.material)
            if known is not None:
                return known
        return cell_properties(
            cell, cell_size, radius,
            relative_density=request.relative_density, fillet=request.fillet,
            material=request.material, along=request.along, on_estimate=request.on_estimate,
        )  # fmt: skip

    @staticmethod
    def radii_of_densities(cell: UnitCell, densities: Floats, fillet: float) -> Floats:
        """Off the catalogue where it has the cell, else between a few that are measured."""
        from ...mechanics.catalogue import known_cell
        from ...mechanics.density import radii_of_densities

        known, low, high = known_cell(cell), float(densities.min()), float(densities.max())
        if known is None or fillet or not known.values[0, 0] <= low <= high <= known.values[-1, 0]:
            return radii_of_densities(cell, densities, fillet)
        places = np.linspace(low, high, 65)
        return np.interp(densities, places, [known.ratio_of_density(place) for place in places])

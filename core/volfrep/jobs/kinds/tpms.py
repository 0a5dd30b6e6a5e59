# SPDX-License-Identifier: LGPL-2.1-or-later
"""TPMS sheets and skeletons: the octants of one period, placed wherever cells are active."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from ...design.spec import LatticeSpec
from ...design.target import Target
from ...design.tpms import KINDS, PeriodicSurface, TpmsSheet
from ...grid.coordinate_map import identity_map
from ...grid.strut_graph import NO_STRUTS, Wireframe
from ...lattice.assembly import Layout, lay_out
from ...lattice.deform import Deformed
from ...lattice.padded_grid import LEAST_WIDTH_STRETCHED
from ...lattice.strut_volume import FINE, VolumeByRadius, points_inside
from ...mechanics.summary import CellProperties
from ...mesh.triangle_mesh import TriangleMesh
from ...octants.octant import Octant, OctantKey
from ...octants.octant_spec import OctantSpec
from ...reports.largest_ball import PLACES as BALL_PLACES
from ...reports.largest_ball import ball_through
from ...spatial.even_points import even_points
from ...tpms.deform import part_levels
from ...tpms.octants import closed_octants, endless_octants, octants_of_cells
from ...tpms.solid import TpmsSolid
from ...tpms.widths import measure_widths
from ...trim.culling import KeptOctants, OctantRoles, cull, keep_all
from ...util.errors import VolfrepError
from ...util.progress import Monitor
from ...util.types import Floats
from .. import octant_guard as guard
from ..finer import until_sound
from ..part_depth import PartDepth, Preview
from ..part_domain import PartDomain
from ..target_search import WantedVolume
from ..tpms.level_table import level_table, with_volume
from ..tpms.octants import (
    keeps_places,
    mesh_tpms,
    place_tpms,
    solid_of,
    surface_of,
    tpms_meshing,
    tpms_of,
)
from ..tpms.stiffness import solve_tpms_stiffness, tpms_modulus
from ..tpms.symmetry import is_mirror_symmetric
from ..tpms.voxels import tpms_density
from .kind import UNDRAWN, EndlessRequest, LatticeKind
from .octant_block import OctantBlock, PlacedBlock
from .octant_lattice import OctantLattice

#: Points for the table, as a power of 2.
POINTS = FINE - 3
#: Thicknesses of which the density is computed, for those between.
KNOWN = 5


class TpmsKind(LatticeKind):
    """Walls along a triply periodic surface."""

    def fill(self, part: PartDomain) -> TpmsLattice:
        """The walls in a part."""
        return TpmsLattice(part)

    def densities(self, thickness: Floats) -> Floats:
        """As of `LatticeKind`, straight between known ones."""
        spec = self.spec
        known = np.linspace(thickness.min(), max(thickness.max(), 1.05 * thickness.min()), KNOWN)
        values = []
        for value in known.tolist():
            wall = replace(spec.wall, thickness=value)
            solid = TpmsSolid.of(surface_of(spec), wall, spec.cell_size)
            values.append(tpms_density(solid, octant=is_mirror_symmetric(solid))[0])
        return np.asarray(np.interp(thickness, known, values))

    def block(self, count: Sequence[int]) -> TpmsBlock:
        """The walls of a block of cells."""
        return TpmsBlock(self, count)

    def refuse(self, solid: TriangleMesh) -> None:
        """Refuse cells that are larger than the part."""
        guard.refuse_large_cells(solid, self.spec.cell_size)

    def refuse_beams(self) -> None:
        """Refuse: there are no struts."""
        raise VolfrepError(
            "Walls have no struts that could be beams or axes: choose a mesh, or a cell of struts."
        )

    def preview(self, solid: TriangleMesh, depth: PartDepth) -> Preview:
        """The walls' surface, as coarse as it is quick."""
        from ..preview import place_lattice, show_cells
        from ..tpms.preview import preview_tpms

        spec = self.spec
        placement = place_lattice(solid, spec, depth.monitor)
        cells = show_cells(solid, spec, depth, placement, LEAST_WIDTH_STRETCHED)
        return preview_tpms(solid, spec, depth, placement, cells)

    def largest_ball(self) -> float | None:
        """On one side of a sheet, which is closed to the other."""
        spec = self.spec
        if spec.varies:
            return None
        solid = TpmsSolid.of(surface_of(spec), spec.wall, spec.cell_size)
        samples = solid.samples(BALL_PLACES, 1.0)[:-1, :-1, :-1]
        return ball_through(samples) * spec.cell_size

    def sheet_and_gap(self) -> tuple[float | None, float | None]:
        """A sheet has its thickness wherever it is.

        Gaps, and what a side of a surface has, are those of the endless wall, and not known where
        cells are stretched or walls graded.
        """
        spec = self.spec
        if spec.varies:
            return (tpms_of(spec).thicknesses[0] if spec.wall.is_sheet else None), None
        found = measure_widths(TpmsSolid.of(surface_of(spec), spec.wall, spec.cell_size))
        return found.thickness * spec.cell_size, found.gap * spec.cell_size

    @staticmethod
    def properties(
        cell: PeriodicSurface, cell_size: float, request: EndlessRequest
    ) -> CellProperties:
        """Homogenised."""
        from ..tpms.properties import tpms_properties

        if request.as_printed is not None:
            raise VolfrepError(UNDRAWN)
        if request.cell_values:
            raise VolfrepError(
                "Surfaces have no values of their own: they are for cells of struts."
            )
        kind = request.wall_kind or KINDS[0]
        sheet = TpmsSheet(
            kind,
            1.0 if request.wall_thickness is None else request.wall_thickness,
            0.0 if request.wall_offset is None else request.wall_offset,
        )
        if request.given not in ([sheet.called], ["relative density"]) or request.fillet:
            raise VolfrepError(
                f"Of a {kind} give the {sheet.called} or the relative density alone."
            )
        return tpms_properties(
            cell, cell_size, sheet, relative_density=request.relative_density,
            material=request.material, along=request.along,
        )  # fmt: skip

    def modulus(self, target: Target) -> float:
        """Young's modulus of the endless TPMS along a target's direction."""
        return tpms_modulus(self.spec, target)

    def stiffened(self, target: Target) -> LatticeSpec:
        """The specification with the thickness of a stiffness."""
        return solve_tpms_stiffness(self.spec, target)


class TpmsLattice(OctantLattice):
    """Walls in a part; they have no struts."""

    @property
    def struts(self) -> Wireframe:
        """None."""
        return NO_STRUTS

    def wanted_meshing(self) -> OctantSpec:
        """What octants are to be meshed for."""
        return tpms_meshing(self.spec)

    def least_width(self) -> float:
        """Width of the narrowest cell that holds walls, in units of L."""
        return LEAST_WIDTH_STRETCHED

    @cached_property
    def is_deformed(self) -> bool:
        """Whether the vertices of octants are moved in lattice space."""
        return not keeps_places(self.spec, self.part.placement)

    def octants(self, roles: OctantRoles | None) -> tuple[KeptOctants, dict[OctantKey, Octant]]:
        """Which octants there are, and their meshes."""
        padded = self.cells.padded
        cells = padded.cells
        grid = endless_octants(cells.shape, cells.cell_size, cells.origin, cells.periodic)
        if (usable := padded.octants_usable) is not None:
            grid.kind[~usable] = -1
        kept = keep_all(grid) if roles is None else cull(grid, roles)
        solid, watch = solid_of(self.spec), self.monitor

        def meshed(wanted: OctantSpec) -> dict[OctantKey, Octant]:
            return mesh_tpms(solid, wanted, watch)

        octants, self.meshing, notes = until_sound(self.meshing, meshed)
        self._notes += notes
        return kept, octants

    def place_vertices(self, layout: Layout) -> Deformed:
        """Where the vertices of numbered octants are in the part."""
        return place_tpms(layout, self.spec, self.part.placement, self.monitor)

    def search(self, target: Target) -> LevelSearch:
        """The thickness for which the walls have the density or the mass of a target.

        A point is solid from one level on; the levels of many points, sorted, are the volume at
        each.
        """
        spec, part, placement = self.spec, self.part, self.part.placement
        domain = part.domain.mesh
        with self.monitor.stage("target", 0.4, 0.4):
            points, weights = points_inside(domain, POINTS, self.monitor)
            mapping = placement.mapping or identity_map(spec.cell_size)
            inside = mapping.to_lattice(points - placement.nudged(np.zeros(3)))
            start = self.cells.padded.cells.origin
            solid = solid_of(spec)
            if mapping.is_rigid:
                levels = solid.levels((inside - start) / spec.cell_size) * spec.cell_size
            else:
                levels = part_levels(inside, start, solid, spec.cell_size, mapping)
            table = level_table(levels, weights)
        wanted = WantedVolume(target, spec.density, domain.volume, part.skin_volume)
        return LevelSearch(spec, wanted, table)


@dataclass(frozen=True, eq=False)
class LevelSearch:
    """Thicknesses of volumes of walls."""

    spec: LatticeSpec
    wanted: WantedVolume
    table: VolumeByRadius

    def specification(self, volume: float) -> LatticeSpec:
        """With the thickness of a volume of the walls, mm3."""
        wanted = self.wanted
        return with_volume(self.spec, wanted.target, self.table, volume, wanted.domain)


class TpmsBlock(OctantBlock):
    """The walls of a block of cells, closed on its outside."""

    bodies = 1

    @property
    def frame(self) -> Wireframe:
        """None."""
        return NO_STRUTS

    @property
    def is_deformed(self) -> bool:
        """Whether vertices are elsewhere than they were meshed."""
        return not keeps_places(self.spec, self.placement)

    def wireframe(self) -> Wireframe:
        """None.

        Raises:
            VolfrepError: always.
        """
        self.spec.unit_cell()
        return self.frame

    def lay(self, monitor: Monitor) -> PlacedBlock:
        """Mesh and lay the octants."""
        cells, size = self.cells, self.spec.cell_size
        with monitor.stage("tile", 0.0, 0.4):
            grid = octants_of_cells(self.active, size, cells.origin, cells.periodic)
            solid = solid_of(self.spec)
            octants, used, notes = until_sound(
                tpms_meshing(self.spec), lambda wanted: mesh_tpms(solid, wanted, monitor)
            )
            guard.refuse_solid_cells(octants, used)
            closed = closed_octants(octants, grid.keys, 0.5 * size)
            layout = lay_out(grid, closed.octants)
        pairs = zip(grid.keys, layout.places, strict=True)
        loose = sum(len(closed.loose[key]) * len(place) for key, place in pairs)
        return PlacedBlock(layout, used, notes, loose)

    def place_vertices(self, placed: PlacedBlock, monitor: Monitor) -> Deformed:
        """Where the vertices of placed octants are."""
        return place_tpms(placed.layout, self.spec, self.placement, monitor)

    def search(self, target: Target) -> LevelSearch:
        """The thickness for which the walls have the density or the mass of a target.

        Each of equal cells holds the same share of solid.

        Raises:
            VolfrepError: the cells are graded.
        """
        spec = self.spec
        if spec.size_grading is not None or spec.cell_map is not None:
            raise VolfrepError(
                f"A target of {target.called} is for blocks of equal cells of walls: give the "
                "thickness, or leave the cells equal."
            )
        points = even_points(3, POINTS)
        levels = solid_of(spec).levels(points) * spec.cell_size
        table = level_table(levels, np.full(len(points), self.volume / len(points)))
        return LevelSearch(spec, WantedVolume(target, spec.density, self.volume), table)

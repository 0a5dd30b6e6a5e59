# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cubic cells of struts: octants that are meshed once for each kind of joint."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import cached_property

import numpy as np

from ...design.cells import UnitCell
from ...design.memory_guard import BYTES_PER_STRUT, refuse_block
from ...design.spec import LatticeSpec
from ...design.target import Target, volume_out_of_reach
from ...grid.placement import graded_wireframe
from ...grid.strut_graph import CellGraph, Wireframe, cell_graph
from ...lattice.assembly import Layout, lay_out
from ...lattice.deform import Deformed
from ...lattice.padded_grid import keeps_places, least_width, vertices_of
from ...lattice.strut_volume import (
    FINE,
    ROUGH,
    VolumeByRadius,
    points_about,
    points_inside,
    volume_by_radius,
)
from ...mechanics.density import relative_density
from ...mesh.triangle_mesh import TriangleMesh
from ...octants.octant import Octant, OctantKey, octant_grid
from ...octants.octant_mesh import mesh_octants, octant_spec
from ...octants.octant_spec import OctantSpec
from ...trim.culling import KeptOctants, OctantRoles
from ...trim.prune import Pruned, prune
from ...trim.stage import chosen_octants
from ...util.errors import VolfrepError
from ...util.progress import Monitor
from ...util.search import Rising
from .. import octant_guard as guard
from ..finer import until_sound
from ..part_domain import PartDomain
from ..rough_radius import radius_range
from ..stiffness_target import modulus, ratio_of_stiffness
from ..target_search import REACH, WantedVolume
from .kind import LatticeKind
from .octant_block import LaidBlock, OctantBlock
from .octant_lattice import OctantLattice

#: The first guess is this near, relative; a radius is sought up to so much above it.
_ROUGHLY = 1.12
#: Fewer points than these tell a first guess so badly that the radius is sought farther above it.
_SURE = 200
#: A radius with fillets is found when its volume is this near, relative.
_CLOSE = 1e-5


class StrutCellKind(LatticeKind):
    """Cubic cells with struts of one radius."""

    def fill(self, part: PartDomain) -> StrutLattice:
        """The struts of a part's cells."""
        return StrutLattice(part)

    def block(self, count: Sequence[int]) -> StrutBlock:
        """The struts of a block of cells."""
        return StrutBlock(self, count)

    def refuse(self, solid: TriangleMesh) -> None:
        """Refuse cells that are larger than the part."""
        guard.refuse_large_cells(solid, self.spec.cell_size)

    def modulus(self, target: Target) -> float:
        """Young's modulus of the endless lattice along a target's direction."""
        spec, size = self.spec, self.spec.cell_size
        ratio, fillet = spec.strut_radius / size, spec.fillet / size
        return modulus(spec.unit_cell(), ratio, target, fillet)

    def stiffened(self, target: Target, *, rough: bool = False) -> LatticeSpec:
        """The specification with the radius of a stiffness."""
        spec, size = self.spec, self.spec.cell_size
        ratio = ratio_of_stiffness(spec.unit_cell(), target, spec.fillet / size, rough=rough)
        return replace(spec, strut_radius=ratio * size)


class StrutLattice(OctantLattice):
    """The struts of a part's cells."""

    def wanted_meshing(self) -> OctantSpec:
        """What octants are to be meshed for."""
        return octant_spec(self.spec.cell_size, self.spec.struts, self.spec.detail)

    def least_width(self) -> float:
        """Width of the narrowest cell that leaves its struts room, in units of L."""
        size, struts = self.spec.cell_size, self.spec.struts
        return self.part.cache.run("width", least_width, self._cell, size, struts).value

    @property
    def _cell(self) -> UnitCell:
        return self.spec.unit_cell()

    @cached_property
    def is_moved(self) -> bool:
        """Whether the vertices of octants are moved in lattice space."""
        return not keeps_places(self.spec.struts, self.part.placement)

    @cached_property
    def pruned(self) -> Pruned | None:
        """What is left when struts with a free end are taken away; None where none are."""
        spec, part = self.spec, self.part
        if not spec.ending.removes_struts:
            return None
        return prune(
            self.cells.padded, self._cell, self.cells.active, spec.struts, spec.ending,
            part.placement, part.domain, spec.skin is not None,
        )  # fmt: skip

    @cached_property
    def struts(self) -> Wireframe:
        """The nodes and struts of the active cells, whole, where the lattice's mesh has them."""
        pruned = self.pruned
        if pruned is not None:
            frame = pruned.frame
        else:
            cells = self.cells.padded.cells
            graph = cell_graph(
                self._cell, self.cells.active, cells.cell_size, cells.origin, cells.periodic
            )
            frame = graded_wireframe(graph, self.spec.struts, self.part.placement)
        guard.refuse_no_struts(frame)
        return frame

    def octants(self, roles: OctantRoles | None) -> tuple[KeptOctants, dict[OctantKey, Octant]]:
        """Which octants there are, and their meshes."""
        cells, part = self.cells, self.part
        grid = cells.padded.octants(self._cell, cells.active, self.spec.ending.is_endless)

        def meshed(wanted: OctantSpec) -> tuple[KeptOctants, dict[OctantKey, Octant]]:
            kept = chosen_octants(
                grid, roles, self._cell, self.pruned, wanted, joined=self.is_moved
            )
            keys = tuple(kept.grid.keys)
            made = part.cache.run("tile", mesh_octants, self._cell, wanted, keys, part.watch)
            return kept, made.value

        (kept, octants), self.meshing, notes = until_sound(self.meshing, meshed)
        self._notes = notes + guard.deviation_warnings(octants, self.meshing)
        return kept, octants

    def placed(self, layout: Layout) -> Deformed:
        """Where the vertices of numbered octants are in the part."""
        return vertices_of(
            layout, self._graph, self._cell, self.spec.struts,
            self.meshing, self.part.placement, self.monitor,
        )  # fmt: skip

    def _graph(self) -> CellGraph:
        """The nodes and struts that the octants are bound to."""
        if self.pruned is not None:
            return self.pruned.left_graph
        cells, is_endless = self.cells, self.spec.ending.is_endless
        return cells.padded.graph(self._cell, cells.active, is_endless)

    def search(self, target: Target) -> RadiusSearch:
        """The radius for which the struts have the density or the mass of a target."""
        spec, part, frame = self.spec, self.part, self.struts
        domain = part.domain.mesh
        with self.monitor.stage("target", 0.4, 0.4):

            def table(fineness: int, largest: float) -> VolumeByRadius:
                if spec.is_cut:
                    points, weights = points_inside(domain, fineness, self.monitor)
                else:
                    points, weights = points_about(frame, REACH * largest, fineness)
                return volume_by_radius(
                    frame, spec.strut_radius, spec.cell_size, points, weights, largest
                )

            wanted = WantedVolume(target, spec.density, domain.volume, part.skin_volume)
            return RadiusSearch(spec, wanted, table)


class StrutBlock(OctantBlock):
    """The struts of a block of cells, round on its outside."""

    @cached_property
    def graph(self) -> CellGraph:
        """Its nodes and struts in lattice space."""
        cells = self.cells
        return cell_graph(
            self.spec.unit_cell(), self.active, cells.cell_size, cells.origin, cells.periodic
        )

    @cached_property
    def frame(self) -> Wireframe:
        """Its nodes and struts."""
        return graded_wireframe(self.graph, self.spec.struts, self.placement)

    @property
    def is_moved(self) -> bool:
        """Whether vertices are elsewhere than they were meshed."""
        return not keeps_places(self.spec.struts, self.placement)

    def wireframe(self) -> Wireframe:
        """Its nodes and struts."""
        refuse_block(self.cells.shape, BYTES_PER_STRUT * len(self.spec.unit_cell().struts))
        return self.frame

    def lay(self, monitor: Monitor) -> LaidBlock:
        """Mesh and lay the octants."""
        spec, cells = self.spec, self.cells
        spec.kind.refuse_crossing()
        cell = spec.unit_cell()
        with monitor.stage("tile", 0.0, 0.4):
            grid = octant_grid(cell, self.active, spec.cell_size, cells.origin, cells.periodic)
            octants, used, notes = until_sound(
                octant_spec(spec.cell_size, spec.struts, spec.detail),
                lambda wanted: mesh_octants(cell, wanted, grid.keys, monitor),
            )
            guard.refuse_solid_cells(octants, used)
            notes += guard.deviation_warnings(octants, used)
            return LaidBlock(lay_out(grid, octants), used, notes)

    def placed(self, laid: LaidBlock, monitor: Monitor) -> Deformed:
        """Where the vertices of laid octants are."""
        spec = self.spec
        return vertices_of(
            laid.layout, lambda: self.graph, spec.unit_cell(), spec.struts, laid.octant_spec,
            self.placement, monitor,
        )  # fmt: skip

    def search(self, target: Target) -> RadiusSearch:
        """The radius for which the struts have the density or the mass of a target."""
        spec, size, count = self.spec, self.spec.cell_size, np.array(self.count)
        self.wireframe()  # it fits into memory
        repeats = not spec.is_graded
        # The volume of equal cells grows by the same with every further layer.
        shape = np.minimum(count, 2).tolist() if repeats else self.count
        frame = StrutBlock(self.kind, shape).wireframe()

        def table(fineness: int, largest: float) -> VolumeByRadius:
            points, weights = points_about(frame, REACH * largest, fineness)
            if repeats:
                inner = points - np.array(spec.origin or (0.0, 0.0, 0.0)) - size / 2.0
                middle = (inner >= 0.0) & (inner < size)
                times = np.where(middle & (count > 1), count - 1.0, 1.0)
                weights = weights * times.prod(axis=1)
            return volume_by_radius(frame, spec.strut_radius, size, points, weights, largest)

        return RadiusSearch(spec, WantedVolume(target, spec.density, self.volume), table)


#: A table as exact as 2^k points, up to a radius.
_Table = Callable[[int, float], VolumeByRadius]


class RadiusSearch:
    """Radii of volumes, within what can be made."""

    def __init__(self, spec: LatticeSpec, wanted: WantedVolume, table: _Table) -> None:
        self._spec, self.wanted = spec, wanted
        self._low, self._high = radius_range(spec)
        self._table = table(ROUGH, self._high)
        most = self._volume(self._high)
        if most <= 0.0:
            raise VolfrepError(
                f"No strut of cells '{spec.unit_cell().name}' of {spec.cell_size:g} mm reaches "
                f"the {wanted.domain:.4g} mm3 that there are for the lattice, however thick, so "
                f"that no {wanted.target.called} can be met: reduce the cell size or the skin, or "
                "move the origin."
            )
        if wanted.lattice <= most:
            found = self._radius(wanted.lattice)
            points = self._table.points_in(wanted.lattice)
            slack = _ROUGHLY if points >= _SURE else 1.0 + 3.0 / math.sqrt(points + 1.0)
            self._high = min(self._high, slack * found)
            self._table = table(FINE, self._high)
        # Of the thinnest struts the rough table has hardly a point.
        least = self._volume(self._low)
        if not least <= wanted.lattice <= most:
            cells = f"cells '{spec.unit_cell().name}' of {spec.cell_size:g} mm"
            raise volume_out_of_reach(
                wanted.target, cells, spec.density, wanted.domain, wanted.skin, (least, most)
            )

    def specification(self, volume: float) -> LatticeSpec:
        """With the radius of a volume of the lattice, mm3."""
        return replace(self._spec, strut_radius=self._radius(volume))

    def _radius(self, volume: float) -> float:
        low, high = self._low, self._high
        if not self._spec.fillet:
            return float(np.clip(self._table.radius_of(volume), low, high))
        known = Rising(self._volume, low, high, close=_CLOSE)
        least, most = known.span
        return known.level_of(min(max(volume, least), most))

    def _volume(self, radius: float) -> float:
        """The lattice's, with its fillets as the endless lattice has them."""
        volume = self._table.at(radius)
        if not self._spec.fillet:
            return volume
        cell, size = self._spec.unit_cell(), self._spec.cell_size
        plain = relative_density(cell, radius / size).value
        return (
            volume * relative_density(cell, radius / size, self._spec.fillet / size).value / plain
        )

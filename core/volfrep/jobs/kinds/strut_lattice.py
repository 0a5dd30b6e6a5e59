# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cubic cells of struts in a part: octants that are meshed once for each kind of joint."""

from __future__ import annotations

import math
from collections.abc import Callable
from concurrent.futures import Future
from functools import cached_property

import numpy as np

from ...design.cells import UnitCell
from ...design.spec_parts import largest_radius
from ...design.target import Target
from ...grid.placement import graded_wireframe
from ...grid.strut_graph import NO_STRUTS, CellGraph, Wireframe, cell_graph
from ...lattice.assembly import Layout
from ...lattice.deform import Deformed
from ...lattice.padded_grid import endless_kinds, keeps_places, least_width, vertices_of
from ...lattice.strut_volume import VolumeByRadius, points_about, points_inside, volume_by_radius
from ...octants.octant import Octant, OctantKey
from ...octants.octant_mesh import mesh_elsewhere, mesh_octants, octant_spec
from ...octants.octant_spec import OctantSpec
from ...process.pool import awaited, on_this_machine
from ...trim.culling import KeptOctants, OctantRoles
from ...trim.prune import Pruned, prune
from ...trim.stage import chosen_octants
from ...util.progress import Monitor
from .. import octant_guard as guard
from ..finer import until_sound
from ..target_search import REACH, WantedVolume
from .kind import RadiiBorne
from .octant_lattice import OctantLattice
from .radius_search import RadiusSearch

#: Octants that a worker meshes, and what it does, counted.
_Meshed = Future[tuple[dict[OctantKey, Octant], dict[str, int]]]


class StrutLattice(OctantLattice):
    """The struts of a part's cells."""

    #: What octants were to be meshed by a worker, and these.
    _asked: tuple[tuple[object, ...], _Meshed] | None = None

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
    def is_deformed(self) -> bool:
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
        guard.refuse_no_struts(frame, 0 if pruned is None else pruned.left.flat)
        return frame

    def octants(self, roles: OctantRoles | None) -> tuple[KeptOctants, dict[OctantKey, Octant]]:
        """Which octants there are, and their meshes."""
        cells, part = self.cells, self.part
        grid = cells.padded.octants(self._cell, cells.active, self.spec.ending.is_endless)

        def meshed(wanted: OctantSpec) -> tuple[KeptOctants, dict[OctantKey, Octant]]:
            kept = chosen_octants(
                grid, roles, self._cell, self.pruned, wanted, joined=self.is_deformed
            )
            keys = tuple(kept.grid.keys)
            made = part.cache.run("tile", self._mesh_octants, self._cell, wanted, keys, part.watch)
            return kept, made.value

        (kept, octants), self.meshing, notes = until_sound(self.meshing, meshed)
        self._notes = notes + guard.deviation_warnings(octants, self.meshing)
        return kept, octants

    def ask_ahead(self) -> None:
        """Let a worker mesh octants while this process looks for the wall.

        In a part these are mostly those of a lattice without end.
        """
        executor = on_this_machine(self.part.executor)
        if executor is None or not self.spec.ending.is_endless or self.part.has_domain:
            return
        given = self._cell, self.meshing, tuple(endless_kinds(self._cell))
        self._asked = given, executor.elsewhere(mesh_elsewhere, *given)

    def _mesh_octants(
        self, cell: UnitCell, spec: OctantSpec, keys: tuple[OctantKey, ...], monitor: Monitor
    ) -> dict[OctantKey, Octant]:
        """As the function of that name, or what a worker has made of the same."""
        asked, self._asked = self._asked, None
        if asked is not None and not asked[1].cancel() and asked[0] == (cell, spec, keys):
            made = awaited(asked[1], lambda: None, monitor)
            if made is not None:
                octants, work = made
                for name, amount in work.items():
                    monitor.count(name, amount)
                return octants
        return mesh_octants(cell, spec, keys, monitor)

    def place_vertices(self, layout: Layout) -> Deformed:
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

    def radii_borne(self, own: float) -> RadiiBorne:
        """As thick as leaves joints room in a cell."""
        most = 0.98 * largest_radius(self.spec.cell_size, self.spec.fillet)
        return RadiiBorne(most, most)

    def slabs(self) -> Callable[[float, float], Wireframe]:
        """Gives the struts of the cells that reach between two z."""
        spec, cells, placement = self.spec, self.cells, self.part.placement
        grid, size = cells.padded.cells, spec.cell_size
        index = np.argwhere(cells.active)
        centres = grid.origin + size * (index + 0.5)
        if placement.mapping is not None:
            centres = placement.mapping.to_part(centres)
        height = placement.nudged(centres)[:, 2]
        reach = size * (0.5 * math.sqrt(3.0) + 0.5)  # half a diagonal, and no joint reaches L / 2

        def between(bottom: float, top: float) -> Wireframe:
            near = index[(height > bottom - reach) & (height < top + reach)]
            if not len(near):
                return NO_STRUTS
            low = near.min(axis=0)
            some = np.zeros(near.max(axis=0) - low + 1, bool)
            some[tuple((near - low).T)] = True
            graph = cell_graph(self._cell, some, size, grid.origin + size * low)
            return graded_wireframe(graph, spec.struts, placement)

        return between

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

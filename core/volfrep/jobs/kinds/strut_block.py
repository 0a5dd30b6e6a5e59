# SPDX-License-Identifier: LGPL-2.1-or-later
"""Free-standing blocks of cubic cells of struts."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from ...design.costs import BYTES_PER_STRUT
from ...design.memory_guard import refuse_block
from ...design.target import Target
from ...grid.placement import graded_wireframe
from ...grid.strut_graph import CellGraph, Wireframe, cell_graph
from ...lattice.assembly import lay_out
from ...octants.octant import octant_grid
from ...octants.octant_mesh import mesh_octants, octant_spec
from ...util.progress import Monitor
from .. import octant_guard as guard
from ..finer import until_sound
from .octant_block import OctantBlock, PlacedBlock

if TYPE_CHECKING:
    from ...lattice.deform import Deformed
    from ...lattice.strut_volume import VolumeByRadius
    from .radius_search import RadiusSearch


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
    def is_deformed(self) -> bool:
        """Whether vertices are elsewhere than they were meshed."""
        from ...lattice.padded_grid import keeps_places

        return not keeps_places(self.spec.struts, self.placement)

    def wireframe(self) -> Wireframe:
        """Its nodes and struts."""
        refuse_block(self.cells.shape, BYTES_PER_STRUT * len(self.spec.unit_cell().struts))
        return self.frame

    def lay(self, monitor: Monitor) -> PlacedBlock:
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
            return PlacedBlock(lay_out(grid, octants), used, notes)

    def place_vertices(self, placed: PlacedBlock, monitor: Monitor) -> Deformed:
        """Where the vertices of placed octants are."""
        from ...lattice.padded_grid import vertices_of

        spec = self.spec
        return vertices_of(
            placed.layout, lambda: self.graph, spec.unit_cell(), spec.struts, placed.octant_spec,
            self.placement, monitor,
        )  # fmt: skip

    def search(self, target: Target) -> RadiusSearch:
        """The radius for which the struts have the density or the mass of a target."""
        from ...lattice.strut_volume import points_about, volume_by_radius
        from ..target_search import REACH, WantedVolume
        from .radius_search import RadiusSearch

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

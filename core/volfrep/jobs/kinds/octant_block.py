# SPDX-License-Identifier: LGPL-2.1-or-later
"""Free-standing blocks of octants: placed, closed on their outside, proved and written."""

from __future__ import annotations

import math
import os
from abc import abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from ...design.costs import BYTES_PER_STREAMED_CELL
from ...design.memory_guard import refuse_block, refuse_expected
from ...grid.placement import block_placement
from ...grid.size_ranges import mapped_volume
from ...grid.strut_graph import Wireframe
from ...io.write.stl import refuse_facets
from ...io.write.stl_octants import write_octants_stl
from ...lattice.assembly import Layout, facets
from ...lattice.certificate import agree_on_faces, certify, keeps_corners
from ...mesh.quality import Quality, measure, refuse_no_solid
from ...mesh.triangle_mesh import TriangleMesh
from ...octants.octant_spec import OctantSpec
from ...reports.report import Report, with_warnings
from ...reports.result import NOTHING_REMOVED, Result, report_of
from ...util.progress import Monitor
from ...util.types import Bools
from ..octant_guard import refuse_too_large
from .kind import BlockLattice, LatticeKind, write_whole

if TYPE_CHECKING:
    from ...lattice.deform import Deformed


@dataclass(frozen=True, eq=False)
class PlacedBlock:
    """The octants of a block, placed.

    Attributes:
        layout: they.
        octant_spec: what they were meshed for.
        notes: sentences on how.
        loose: how many pieces its outside cut off, which are not of it.
    """

    layout: Layout
    octant_spec: OctantSpec
    notes: tuple[str, ...]
    loose: int = 0


class OctantBlock(BlockLattice):
    """A block of octants.

    Attributes:
        bodies: how many pieces of it stay, the largest ones; 0: all that are no specks.
    """

    bodies = 0

    def __init__(self, kind: LatticeKind, count: Sequence[int]) -> None:
        super().__init__(kind, count)
        self.cells, self.placement = block_placement(self.spec.grid, self.count)
        self._placed: PlacedBlock | None = None

    @abstractmethod
    def lay(self, monitor: Monitor) -> PlacedBlock:
        """Mesh and lay the octants."""

    def _place_once(self, monitor: Monitor) -> PlacedBlock:
        if self._placed is None:
            self._placed = self.lay(monitor)
        return self._placed

    @abstractmethod
    def place_vertices(self, placed: PlacedBlock, monitor: Monitor) -> Deformed:
        """Where the vertices of placed octants are."""

    @property
    @abstractmethod
    def is_deformed(self) -> bool:
        """Whether vertices are elsewhere than they were meshed."""

    @property
    @abstractmethod
    def frame(self) -> Wireframe:
        """The struts; of walls none."""

    @property
    def active(self) -> Bools:
        """(nx, ny, nz) all the cells."""
        return np.ones(self.cells.shape, bool)

    @property
    def volume(self) -> float:
        """Volume of the cells, mm3."""
        mapping, cells = self.placement.mapping, self.cells
        if mapping is not None and not mapping.is_rigid:
            return float(mapped_volume(cells, mapping))
        return float(np.prod(cells.shape, dtype=float)) * cells.cell_size**3

    def result(self, monitor: Monitor) -> Result:
        """The block, as a mesh."""
        spec, shape = self.spec, self.cells.shape
        refuse_expected(spec, math.prod(shape) * spec.cell_size**3, shape)
        placed = self._place_once(monitor)
        refuse_too_large(spec, placed.layout.grid, placed.layout.octants, None, shape)
        return self._mesh_whole(placed, monitor)

    def _mesh_whole(self, placed: PlacedBlock, monitor: Monitor) -> Result:
        """It as a whole, without its specks."""
        # Of no use to a block that goes straight into a file, and slow to import.
        from ...trim.finish import finish
        from ...trim.trimmed_surface import TrimmedSurface

        layout, spec = placed.layout, self.spec
        with monitor.stage("lattice", 0.4, 0.8):
            given = self.place_vertices(placed, monitor)
            surface = TrimmedSurface(TriangleMesh(given.vertices, facets(layout, monitor)))
        removed = _count_removed(placed)
        with monitor.stage("check", 0.8, 1.0):
            measured = measure(surface.mesh, monitor) if spec.is_graded else certify(layout)
            if measured.shells > 1 or measured.degenerate_triangles:
                from ...trim.loose_pieces import clear, smallest_shell

                smallest = smallest_shell(placed.octant_spec)
                cleared = clear(surface, smallest, monitor, bodies=self.bodies)
                surface, measured = cleared.surface, cleared.quality
                removed["pieces_removed"] += cleared.pieces_removed
                removed["specks_removed"] = cleared.specks_removed
                proved = False
            else:
                proved = not spec.is_graded and _fits_a_file(layout, measured)
            notes: tuple[str, ...] = ()
            if proved:
                refuse_no_solid(measured)
            else:
                surface, measured, notes = finish(
                    surface, measured, monitor, self.is_deformed, cut=False
                )
        report = self._report(placed, measured, monitor, removed)
        return Result(surface, self.frame, with_warnings(report, notes))

    def write_stl(self, path: str | os.PathLike[str], monitor: Monitor) -> Report:
        """It straight into a binary STL: equal cells octant by octant."""
        if self.spec.is_graded:
            return write_whole(self.result(monitor), path)
        refuse_block(self.cells.shape, BYTES_PER_STREAMED_CELL)
        placed = self._place_once(monitor)
        refuse_facets(placed.layout.triangles, path)  # before the proof, which takes longer
        with monitor.stage("check", 0.4, 0.5):
            measured = certify(placed.layout)
            refuse_no_solid(measured)
            streams = measured.shells == 1 and _fits_a_file(placed.layout, measured)
        if streams:
            monitor.count("triangles laid", placed.layout.triangles)
            with monitor.stage("write", 0.5, 1.0):
                write_octants_stl(placed.layout, path, monitor)
            return self._report(placed, measured, monitor, _count_removed(placed))
        refuse_too_large(
            self.spec, placed.layout.grid, placed.layout.octants, None, self.cells.shape
        )
        return write_whole(self._mesh_whole(placed, monitor), path)

    def measured(self, monitor: Monitor) -> Report:
        """Its figures; of equal cells it is not meshed as a whole for them."""
        if self.spec.is_graded:
            return super().measured(monitor)
        placed = self._place_once(monitor)
        return self._report(placed, certify(placed.layout), monitor, _count_removed(placed))

    def _report(
        self, placed: PlacedBlock, measured: Quality, monitor: Monitor, removed: Mapping[str, Any]
    ) -> Report:
        report = report_of(
            measured, self.frame, self.cells, self.active, self.placement, self.spec, monitor,
            domain_volume=self.volume, removed=removed, warnings=placed.notes,
        )  # fmt: skip
        return self.kind.with_target(report)


def _fits_a_file(layout: Layout, measured: Quality) -> bool:
    """Whether its octants prove that a file of single precision holds a block as it is."""
    kinds, edge = layout.octants.values(), 0.5 * layout.grid.cell_size
    return agree_on_faces(layout) and keeps_corners(kinds, edge, measured.bounds)


def _count_removed(placed: PlacedBlock) -> dict[str, Any]:
    """What a block is without."""
    return {**NOTHING_REMOVED, "pieces_removed": placed.loose}

# SPDX-License-Identifier: LGPL-2.1-or-later
"""A solid filled with a network in place of cells: the stages of `Infill`, with other struts."""

from __future__ import annotations

from functools import cached_property

import numpy as np

from ...graphs.surface import GraphSurface
from ...grid.cell_grid import CellGrid
from ...grid.strut_graph import Wireframe
from ...lattice.padded_grid import PaddedGrid
from ...reports.result import Result
from ...trim.boolean_trim import Trimmed
from ...trim.group_cut import cut_mesh
from ...trim.loose_pieces import Cleared
from ...trim.stage import cleared_cut, drained_part
from ...trim.trimmed_surface import TrimmedSurface
from ...util.errors import VolfrepError
from ..active_cells import ActiveCells
from ..infill import Infill
from .frame import graph_struts
from .free_space import mesh_graph, overlap_warnings, uncut


class GraphInfill(Infill):
    """A solid filled with a network, stage by stage; see `Infill`.

    There are no cells: `cells` is an empty grid.
    """

    @cached_property
    def cells(self) -> ActiveCells:
        """None."""
        none = CellGrid(np.zeros(3), self.spec.cell_size, (0, 0, 0))
        return ActiveCells(PaddedGrid(none, (0, 0, 0), None), np.zeros((0, 0, 0), bool))

    @cached_property
    def struts(self) -> Wireframe:
        """The network's nodes and struts, whole, where its mesh has them."""
        with self.monitor.stage("network", 0.3, 0.4):
            return graph_struts(self.spec, self.placement, lambda: self.domain.mesh, self.monitor)

    @cached_property
    def surface(self) -> GraphSurface:
        """The network's own surface, nothing cut."""
        frame = self.struts
        with self.monitor.stage("lattice", 0.4, 0.6):
            return mesh_graph(frame, self.spec, self.monitor)

    @cached_property
    def lattice(self) -> Result:
        """The network without the skin: trimmed to its domain, or whole."""
        made = self.surface
        with self.monitor.stage("trim", 0.6, 1.0):
            if self.spec.ending.is_trimmed:
                cleared = self._cut_surface(with_skin=False)
            else:
                cleared = uncut(made, self._smallest, self.monitor)
        return self._reported("lattice", cleared)

    @cached_property
    def part(self) -> Result:
        """Skin and network in one; without a skin, the network trimmed at the part's surface."""
        skin = self.spec.skin
        if skin is None:
            return self.lattice
        _, drained = self.surface, None
        with self.monitor.stage("trim", 0.6, 1.0):
            cleared = self._cut_surface(with_skin=True)
            if self.spec.drains is not None:
                cleared, drained = drained_part(
                    cleared, self.solid, self.domain, self.struts, skin, self.spec.drains,
                    self._smallest, self.monitor,
                )  # fmt: skip
        return self._reported("part", cleared, drained)

    @property
    def warnings(self) -> tuple[str, ...]:
        """What is to be said of the solid, of its skin, and of struts that overlap."""
        said = super().warnings
        if "surface" in self.__dict__:
            said += overlap_warnings(self.surface, self.struts)
        return said

    @property
    def _smallest(self) -> float:
        """Volume below which a shell is no piece of a network, mm3."""
        return float((0.2 * np.median(self.struts.radii)) ** 3)

    def _cut_surface(self, *, with_skin: bool) -> Cleared:
        full = VolfrepError(
            "The struts fill the whole part: make them thinner, or take fewer of them."
        )
        mesh, on_wall = cut_mesh(
            self.domain.wall, self.surface.mesh, cavity=with_skin, monitor=self.monitor
        )
        trimmed = Trimmed(TrimmedSurface(mesh), on_wall)
        return cleared_cut(
            trimmed, self.solid, self.domain, self._smallest, full, self.monitor,
            has_skin=self.spec.skin is not None, with_skin=with_skin,
            keep_pieces=self.spec.keep_pieces,
        )  # fmt: skip

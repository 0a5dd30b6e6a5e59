# SPDX-License-Identifier: LGPL-2.1-or-later
"""A solid filled with walls in place of struts: the stages of `Infill`, with other octants."""

from __future__ import annotations

from functools import cached_property

from ...grid.strut_graph import BeamModel, Wireframe
from ...lattice.assembly import Layout
from ...lattice.deform import Deformed
from ...lattice.padded_grid import LEAST_WIDTH_STRETCHED
from ...octants.octant import Octant, OctantKey
from ...octants.octant_spec import OctantSpec
from ...tpms.octants import endless_octants
from ...trim.clip_struts import Clipped
from ...trim.culling import KeptOctants, cull, keep_all
from ...util.errors import VolfrepError
from ..finer import until_sound
from ..infill import Infill
from ..octant_guard import refuse_solid_cells, refuse_too_large
from .octants import keeps_places, mesh_tpms, no_struts, place_tpms, solid_of, tpms_meshing


class TpmsInfill(Infill):
    """A solid filled with walls, stage by stage; see `Infill`.

    There are no struts: `struts` is empty, and nothing can be had as beams or axes.
    """

    @cached_property
    def struts(self) -> Wireframe:
        """None."""
        return no_struts()

    @property
    def part_beams(self) -> BeamModel:
        """None.

        Raises:
            VolfrepError: always.
        """
        raise _no_beams()

    @property
    def lattice_beams(self) -> BeamModel:
        """None.

        Raises:
            VolfrepError: always.
        """
        raise _no_beams()

    @property
    def axes(self) -> Clipped:
        """None.

        Raises:
            VolfrepError: always.
        """
        raise _no_beams()

    def _least_width(self) -> float:
        return LEAST_WIDTH_STRETCHED

    def _wanted_meshing(self) -> OctantSpec:
        return tpms_meshing(self.spec)

    @cached_property
    def _keeps_places(self) -> bool:
        return keeps_places(self.spec, self.placement)

    def _octants(self, is_cut: bool, margin: float) -> tuple[KeptOctants, dict[OctantKey, Octant]]:
        padded, roles = self.cells.padded, self._roles(margin) if is_cut else None
        cells = padded.cells
        grid = endless_octants(cells.shape, cells.cell_size, cells.origin, cells.periodic)
        if (usable := padded.octants_usable) is not None:
            grid.kind[~usable] = -1
        kept = keep_all(grid) if roles is None else cull(grid, roles)
        solid, watch = solid_of(self.spec), self.monitor

        def meshed(wanted: OctantSpec) -> dict[OctantKey, Octant]:
            return mesh_tpms(solid, wanted, watch)

        octants, self._meshing, notes = until_sound(self._meshing, meshed)
        self._notes += notes
        refuse_solid_cells(octants, self._meshing)
        refuse_too_large(self.spec, kept.grid, octants, kept.border, streamed=self._streamed)
        return kept, octants

    def _placed(self, layout: Layout) -> Deformed:
        return place_tpms(layout, self.spec, self.placement, self.monitor)


def _no_beams() -> VolfrepError:
    return VolfrepError(
        "Walls have no struts that could be beams or axes: choose a mesh, or a cell of struts."
    )

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Lattices of octants in a part: active cells, each kind of octant meshed once, placed and cut."""

from __future__ import annotations

from abc import abstractmethod
from functools import cached_property, partial

import numpy as np

from ...design.memory_guard import refuse_expected
from ...lattice.assembly import Layout
from ...lattice.deform import Deformed
from ...octants.octant import Octant, OctantKey
from ...octants.octant_spec import OctantSpec
from ...trim.boolean_trim import Ahead
from ...trim.culling import KeptOctants, OctantRoles
from ...trim.loose_pieces import Cleared, smallest_shell
from ...trim.placed_lattice import FIRST_MARGIN, PlacedLattice, in_place, lay
from ...trim.stage import cut_lattice, uncut_lattice
from ...util.cache import Kept
from .. import octant_guard as guard
from ..active_cells import ActiveCells, find_active_cells, refuse_grid, roles_of
from ..part_domain import PartDomain
from .kind import PartLattice


class OctantLattice(PartLattice):
    """A lattice of octants in a part."""

    def __init__(self, part: PartDomain) -> None:
        super().__init__(part)
        self.meshing = self.wanted_meshing()
        self._notes: tuple[str, ...] = ()
        self._placed: dict[bool, PlacedLattice] = {}

    @abstractmethod
    def wanted_meshing(self) -> OctantSpec:
        """What octants are to be meshed for."""

    @abstractmethod
    def least_width(self) -> float:
        """Width of the narrowest cell about an axis that can hold a lattice, in units of L."""

    @abstractmethod
    def octants(self, roles: OctantRoles | None) -> tuple[KeptOctants, dict[OctantKey, Octant]]:
        """Which octants there are, and their meshes; sets `meshing` and `_notes`.

        Args:
            roles: where octants lie with respect to the wall; None where none cuts the lattice.
        """

    def ask_ahead(self) -> None:
        """Let workers begin with what needs no wall, while this process looks for it."""

    @abstractmethod
    def place_vertices(self, layout: Layout) -> Deformed:
        """Where the vertices of numbered octants are in the part."""

    @property
    def spacing(self) -> float:
        """L, mm."""
        return self.spec.cell_size

    @property
    def smallest(self) -> float:
        """Volume below which a shell is no piece of the lattice, mm3."""
        return smallest_shell(self.meshing)

    @property
    def notes(self) -> tuple[str, ...]:
        """Sentences on facets that are finer, or stray farther, than was asked for."""
        return self._notes

    @property
    def cells(self) -> ActiveCells:
        """The cells, and which of them hold a lattice."""
        return self._cells.value

    @cached_property
    def _cells(self) -> Kept[ActiveCells]:
        part, rule, least = self.part, self.spec.ending.activation, 0.0
        grid = self.spec.grid
        refuse_grid(part.solid, grid)  # before the skin is made
        domain = part.kept_domain
        with self.monitor.stage("voxels", 0.3, 0.4):
            if grid.cell_map is not None:
                least = self.least_width()
            found = part.cache.run(
                "voxels", find_active_cells, part.kept_solid, domain, grid, rule, least, part.watch
            )
        guard.refuse_no_cells(found.value.active, grid.size, rule)
        return found

    def mesh(self, *, is_cut: bool) -> None:
        """Mesh the octants and lay them in the part, as of a lattice that a wall cuts or not."""
        if is_cut in self._placed:
            return
        spec, part = self.spec, self.part
        spec.kind.refuse_crossing()
        refuse_grid(part.solid, spec.grid)  # before the skin is made
        if is_cut:
            guard.refuse_before_skin(spec, part.solid, streamed=part.streamed)
        self.ask_ahead()
        refuse_expected(spec, 0.0 if part.streamed else part.domain.mesh.volume)
        _ = self.struts  # refused before anything is meshed
        motion = None if self.is_deformed else part.placement.motion
        # Where nothing is cut there is no wall that an octant could reach.
        margin = np.inf if not is_cut else FIRST_MARGIN if self.is_deformed else 0.0
        with self.monitor.stage("tile", 0.4, 0.5):
            within = partial(self._within, is_cut)
            first = within(margin)
        with self.monitor.stage("lattice", 0.5, 0.6):
            self._placed[is_cut] = (
                in_place(*first, motion)
                if motion is not None
                else lay(first, margin, within, self.place_vertices, self.monitor)
            )

    def _within(self, is_cut: bool, margin: float) -> tuple[KeptOctants, dict[OctantKey, Octant]]:
        kept, octants = self.octants(self._roles(margin) if is_cut else None)
        guard.refuse_solid_cells(octants, self.meshing)
        guard.refuse_too_large(
            self.spec, kept.grid, octants, kept.border, streamed=self.part.streamed
        )
        return kept, octants

    def _roles(self, margin: float) -> OctantRoles:
        part = self.part
        on = part.kept_solid, part.kept_domain, self._cells, self.spec.grid
        return part.cache.run("octants", roles_of, *on, margin, part.watch).value

    def trim(self, *, with_skin: bool, ahead: Ahead | None) -> Cleared:
        """What the wall leaves of the octants, joined to the skin or not."""
        spec, part, keep = self.spec, self.part, self.spec.keep_pieces
        if not (with_skin or spec.ending.is_trimmed):
            placed = self._placed[False]
            return uncut_lattice(placed, part.solid, self.meshing, self.monitor, keep_pieces=keep)
        return cut_lattice(
            self._placed[True], part.solid, part.domain, self.meshing, self.monitor,
            keep_pieces=keep, has_skin=spec.skin is not None, with_skin=with_skin,
            executor=part.executor, ahead=ahead,
        )  # fmt: skip

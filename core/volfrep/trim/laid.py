# SPDX-License-Identifier: LGPL-2.1-or-later
"""Octants laid where their struts are: numbered at once, with coordinates for those asked for."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from ..grid.motion import Motion
from ..lattice.assembly import Layout, lay_out
from ..lattice.certificate import agree_on_faces
from ..lattice.deform import Deformed
from ..lattice.placed_octants import Placed
from ..octants.octant import Octant, OctantKey
from ..util.errors import VolfrepError
from ..util.types import Bools, Periodic
from .culling import CROSSING_MARGIN, KeptOctants

#: Octants on moved struts mostly reach no farther out of their places than this, in units of
#: their edges. Where they do, they are looked for so many times as far as the last ones reached.
FIRST_MARGIN = 0.05
SPARE_MARGIN = 1.05
#: How often they are looked for farther out. From the second time on it is at least twice as far,
#: so that the last time is more than the `SUPPORT` of three cells about an octant: a vertex hangs
#: on the struts of its own cell, and none reaches there.
MOST_WIDENINGS = 9


@dataclass(frozen=True, eq=False)
class Laid(Placed):
    """All the octants of a lattice where their struts are.

    Attributes:
        kept: which octants there are.
        octants: their meshes, without corners.
    """

    kept: KeptOctants
    octants: dict[OctantKey, Octant]

    def alone(self, where: Bools) -> Layout:
        """Some of the octants without their corners, numbered as among all; their own count."""
        grid = self.layout.grid
        some = replace(grid, kind=np.where(where, grid.kind, np.int16(-1)))
        return replace(lay_out(some, self.octants), base=self.layout.base)

    @cached_property
    def is_proved_by_kind(self) -> bool:
        """Whether what holds for kinds of octants holds for all of them, where they lie.

        They keep their places, octants that share a vertex give it the same coordinates, and the
        wall stays clear of those that it does not cross.
        """
        return self.points is None and agree_on_faces(self.layout)

    @property
    def periodic(self) -> Periodic:
        """Along which axes the octants close upon themselves."""
        return self.layout.grid.periodic

    @property
    def clearance(self) -> float:
        """How near the wall may come to octants that it does not cross, mm."""
        return 0.25 * CROSSING_MARGIN * self.layout.grid.cell_size


def in_place(kept: KeptOctants, octants: dict[OctantKey, Octant], motion: Motion) -> Laid:
    """Octants that keep their places but for a motion."""
    return Laid(kept.lay_out(octants), None, motion, kept, octants)


def lay(
    first: tuple[KeptOctants, dict[OctantKey, Octant]],
    margin: float,
    within: Callable[[float], tuple[KeptOctants, dict[OctantKey, Octant]]],
    place: Callable[[Layout], Deformed],
) -> Laid:
    """The octants laid where the struts are; with more of them, where struts reach far out.

    Args:
        first: the octants within the margin, and their meshes.
        margin: how far out of their places octants may reach, in units of their edges.
        within: gives the octants within a wider one.
        place: gives where the vertices of numbered octants are.

    Raises:
        VolfrepError: octants reach out farther than `MOST_WIDENINGS` find.
    """
    kept, octants = first
    for widening in range(MOST_WIDENINGS + 1):
        layout = kept.lay_out(octants)
        placed = place(layout)
        if placed.excess <= margin + 1e-9:
            return Laid(layout, placed.vertices, Motion(np.zeros(3)), kept, octants)
        if widening < MOST_WIDENINGS:
            margin = max(SPARE_MARGIN * placed.excess, 2.0 * margin if widening else 0.0)
            kept, octants = within(margin)
    raise VolfrepError(
        f"Struts reach {placed.excess / 2.0:.1f} cells out of their places: grade the cells or "
        "their radii less steeply."
    )

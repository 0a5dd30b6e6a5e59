# SPDX-License-Identifier: LGPL-2.1-or-later
"""Octants laid where their struts are: numbered at once, with coordinates for those asked for."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..grid.placement import Motion
from ..lattice.assembly import Layout, coordinates_of, facets, lay_out, numbers, placed_octants
from ..lattice.certificate import agree_on_faces
from ..lattice.deform import Deformed
from ..mesh.triangle_mesh import TriangleMesh
from ..octants.octant import OctantKey, used_kinds
from ..octants.octant_mesh import Octant
from ..util.errors import VolfrepError
from ..util.progress import Monitor
from ..util.types import Bools, Floats, Ints, Periodic
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
class Placed:
    """Numbered octants where their struts are.

    Attributes:
        layout: the octants, numbered, with corners for caps.
        points: (n, 3) where their vertices are, mm; None where they keep their places in lattice
            space but for the motion.
        motion: of all that keep their places.
    """

    layout: Layout
    points: Floats | None
    motion: Motion

    def coordinates(self, wanted: NDArray[np.int32], where: Bools, monitor: Monitor) -> Floats:
        """(k, 3) where some vertices are, mm.

        Args:
            wanted: (k,) their numbers, ascending.
            where: octants that have all of them.
            monitor: for cancel.
        """
        if self.points is not None:
            return self.points[wanted]
        return self.motion(coordinates_of(self.layout, wanted, where, monitor))

    def mesh(
        self, triangles: NDArray[np.int32], where: Bools, monitor: Monitor
    ) -> tuple[TriangleMesh, NDArray[np.int32]]:
        """Triangles of numbered vertices as a mesh, and the number of each of its vertices.

        Args:
            triangles: (m, 3) of numbers.
            where: octants that have all their vertices.
            monitor: for cancel.
        """
        used = np.zeros(self.layout.count, bool)
        used[triangles] = True
        wanted = np.flatnonzero(used).astype(np.int32)
        local = np.cumsum(used, dtype=np.int32)[triangles] - np.int32(1)
        return TriangleMesh(self.coordinates(wanted, where, monitor), local), wanted

    def facets(self, where: Bools, monitor: Monitor) -> NDArray[np.int32]:
        """(m, 3) the surface in some octants, of numbered vertices."""
        return facets(self.layout, monitor, where)

    def boxes(self, where: Bools, monitor: Monitor) -> tuple[Ints, Floats, Floats]:
        """(k, 3) places of some octants with vertices, and (k, 3) corners of their boxes, mm.

        All that a struts' solid has in an octant lies in the box of its vertices and corners.
        """
        some = [place[where[tuple(place.T)]] for place in self.layout.places]
        low, high = [np.zeros((0, 3))], [np.zeros((0, 3))]
        for number, points in placed_octants(self.layout, where, monitor):
            own = self.motion(points) if self.points is None else self.points[number]
            low.append(own.min(axis=1))
            high.append(own.max(axis=1))
        pairs = zip(self.layout.grid.keys, some, strict=True)
        places = [place for key, place in pairs if len(self.layout.octants[key].vertices)]
        return np.concatenate([np.zeros((0, 3), np.int64), *places]), *map(
            np.concatenate, (low, high)
        )

    def cutting(self, index: Ints) -> tuple[Placed, tuple[slice, ...]]:
        """Octants at some places, (k, 3), and the part of the grid that they are laid on."""
        grid, box, low = self.layout.grid, [], np.zeros(3, np.int64)
        for axis, closed in enumerate(grid.periodic):
            if closed:
                box.append(slice(None))
                continue
            # One more on every side, for their neighbours; frames alternate: an even one first.
            low[axis] = max(int(index[:, axis].min()) - 1, 0) // 2 * 2
            box.append(slice(int(low[axis]), int(index[:, axis].max()) + 2))
        kind = np.full_like(grid.kind[tuple(box)], -1)
        kind[tuple((index - low).T)] = grid.kind[tuple(index.T)]
        some = used_kinds(replace(grid, kind=kind))
        octants = {key: self.layout.octants[key] for key in some.keys}
        layout = replace(lay_out(some, octants), first=self.layout.first + low // 2)
        if self.points is None:
            return Placed(layout, None, self.motion), tuple(box)
        points = np.empty((layout.count, 3))
        for key, place in zip(some.keys, layout.places, strict=True):
            theirs = numbers(self.layout, octants[key], place + low)
            points[numbers(layout, octants[key], place)] = self.points[theirs]
        return Placed(layout, points, self.motion), tuple(box)


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

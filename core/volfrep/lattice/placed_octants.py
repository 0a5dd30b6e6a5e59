# SPDX-License-Identifier: LGPL-2.1-or-later
"""Numbered octants where their struts are, with coordinates for those that are asked for."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ..grid.motion import Motion
from ..mesh.triangle_mesh import TriangleMesh
from ..octants.octant import used_kinds
from ..util.progress import Monitor
from ..util.types import Bools, Floats, Ints
from .assembly import (
    FEW,
    Layout,
    coordinates_of,
    facets,
    in_steps,
    lay_out,
    numbers,
    placed,
    placed_octants,
)

#: Vertices of octants whose boxes are found at a time: they should stay in the processor's cache.
BLOCK_VERTICES = 1 << 14


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

    def coordinates(
        self,
        wanted: NDArray[np.int32],
        where: Bools,
        monitor: Monitor,
        *,
        shared: bool = False,
    ) -> Floats:
        """(k, 3) where some vertices are, mm.

        Args:
            wanted: (k,) their numbers, ascending.
            where: octants that have all of them.
            monitor: for cancel.
            shared: whether all of them lie on faces of octants.
        """
        if self.points is not None:
            return self.points[wanted]
        return self.motion(coordinates_of(self.layout, wanted, where, monitor, shared=shared))

    def mesh(
        self, triangles: NDArray[np.int32], where: Bools, monitor: Monitor
    ) -> tuple[TriangleMesh, NDArray[np.int32]]:
        """Triangles of numbered vertices as a mesh, and the number of each of its vertices.

        Args:
            triangles: (m, 3) of numbers.
            where: octants that have all their vertices.
            monitor: for cancel.
        """
        if triangles.size < self.layout.count // FEW:
            wanted, local = np.unique(triangles, return_inverse=True)
            local = local.reshape(-1, 3).astype(np.int32)
            return TriangleMesh(self.coordinates(wanted, where, monitor), local), wanted
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
        if self.points is None and self.motion.frame is None:
            # An octant's box is its kind's, mirrored and moved.
            for key, place in zip(self.layout.grid.keys, some, strict=True):
                octant = self.layout.octants[key]
                if not len(octant.vertices):
                    continue
                steps = in_steps(self.layout.grid, octant)
                corner, sign = self.layout.frames(place)
                ends = sign * steps.min(axis=0), sign * steps.max(axis=0)
                for every, end in ((low, np.minimum(*ends)), (high, np.maximum(*ends))):
                    every.append(self.motion(placed(self.layout.grid, corner, end)))
        else:
            for own in self._octants(where, monitor):
                # Axis by axis, and an octant's numbers beside each other, which numpy takes faster.
                columns = np.ascontiguousarray(own.transpose(2, 0, 1))
                low.append(columns.min(axis=2).T)
                high.append(columns.max(axis=2).T)
        pairs = zip(self.layout.grid.keys, some, strict=True)
        places = [place for key, place in pairs if len(self.layout.octants[key].vertices)]
        return np.concatenate([np.zeros((0, 3), np.int64), *places]), *map(
            np.concatenate, (low, high)
        )

    def _octants(self, where: Bools, monitor: Monitor) -> Iterator[Floats]:
        """(k, n, 3) the vertices of some octants of one kind after the other, mm."""
        if self.points is None:
            for _, points in placed_octants(self.layout, where, monitor):
                yield self.motion(points)
            return
        for key, place in zip(self.layout.grid.keys, self.layout.places, strict=True):
            octant, some = self.layout.octants[key], place[where[tuple(place.T)]]
            size = max(1, BLOCK_VERTICES // max(1, len(octant.vertices)))
            for begin in range(0, len(some) if len(octant.vertices) else 0, size):
                monitor.tick()
                yield self.points[numbers(self.layout, octant, some[begin : begin + size])]

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

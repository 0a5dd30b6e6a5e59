# SPDX-License-Identifier: LGPL-2.1-or-later
"""Which octants the wall crosses, which lie inside, and which are left out."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ..grid.activation import boundary_corners, crossed_cells, inside_cells
from ..grid.cell_grid import CellGrid
from ..grid.coordinate_map import STRAIGHT, CoordinateMap
from ..lattice.assembly import Layout, lay_out
from ..mesh.triangle_mesh import TriangleMesh
from ..octants.caps import with_corners
from ..octants.octant import Octant, OctantGrid, OctantKey, used_kinds, wrapped
from ..util.progress import Monitor
from ..util.types import Periodic

#: An octant counts as crossed by the wall when the wall comes this near, in units of its edge:
#: a wall that lies in an octant's face must cut the lattice on both sides of it.
CROSSING_MARGIN = 1e-3


@dataclass(frozen=True, eq=False)
class OctantRoles:
    """Where the octants lie with respect to the domain; both (nx, ny, nz) bool.

    Attributes:
        border: the wall crosses the octant.
        inside: the octant lies wholly inside.
    """

    border: NDArray[np.bool_]
    inside: NDArray[np.bool_]


def octant_roles(
    domain: TriangleMesh,
    cells: CellGrid,
    monitor: Monitor,
    mapping: CoordinateMap | None = None,
    margin: float = 0.0,
) -> OctantRoles:
    """Classify the octants of a grid of cells, and of the half cells about it.

    Args:
        domain: closed mesh of what the lattice fills.
        cells: the grid.
        monitor: for progress and cancel.
        mapping: from lattice space to the part, where they differ.
        margin: how near the wall may come to an octant that is not of the border, in units of its
            edge: octants on struts that were moved reach beyond their places.
    """
    half = 0.5 * cells.cell_size
    shape = [
        2 * n + (0 if closed else 2) for n, closed in zip(cells.shape, cells.periodic, strict=True)
    ]
    grid = CellGrid(cells.origin - half, half, (shape[0], shape[1], shape[2]), cells.periodic)
    if mapping is not None and not mapping.is_rigid:
        margin += STRAIGHT * cells.cell_size / half  # where the wall is known no better
    # The margin is on either side, the cell is enlarged by both.
    border = crossed_cells(
        grid, boundary_corners(domain, mapping), monitor, CROSSING_MARGIN + 2.0 * margin
    )
    return OctantRoles(border, inside_cells(grid, domain, monitor, mapping) & ~border)


@dataclass(frozen=True, eq=False)
class KeptOctants:
    """Culled octants: what is left of a lattice without those outside.

    Attributes:
        grid: the octants that are left.
        border: (nx, ny, nz) bool, octants that go into the Boolean.
        inside: octants that are put back afterwards.
    """

    grid: OctantGrid
    border: NDArray[np.bool_]
    inside: NDArray[np.bool_]

    def lay_out(self, octants: dict[OctantKey, Octant]) -> Layout:
        """The octants numbered, with corners for caps."""
        half = 0.5 * self.grid.cell_size
        capped = {key: with_corners(octants[key], half) for key in self.grid.keys}
        return lay_out(self.grid, capped)


def cull(grid: OctantGrid, roles: OctantRoles) -> KeptOctants:
    """Cull the octants outside; `roles` is shaped as the grid."""
    present = grid.kind >= 0
    border, inside = roles.border & present, roles.inside & present
    border = without_pinches(border, present, grid.periodic)
    inside = inside & ~border
    kind = np.where(border | inside, grid.kind, np.int16(-1))
    return KeptOctants(used_kinds(replace(grid, kind=kind)), border, inside)


def keep_all(grid: OctantGrid) -> KeptOctants:
    """A lattice that nothing cuts."""
    return KeptOctants(used_kinds(grid), np.zeros(grid.kind.shape, bool), grid.kind >= 0)


def without_pinches(
    border: NDArray[np.bool_], present: NDArray[np.bool_], periodic: Periodic
) -> NDArray[np.bool_]:
    """The border, grown until no two of its octants touch along an edge or a corner only.

    The caps of two such octants would share an edge between four triangles.
    """
    current = border.copy()
    while True:
        padded = wrapped(current, periodic)
        add = np.zeros_like(padded)
        # Of two octants along each axis: as views, and how many of them are of the border.
        windows = {place: _window(padded, place) for place in np.ndindex(2, 2, 2)}
        grows = {place: _window(add, place) for place in windows}
        every = sum(window.view(np.int8) for window in windows.values())
        for places in (*_faces(), tuple(windows)):
            taken = every
            if len(places) == 4:
                taken = sum(windows[place].view(np.int8) for place in places)
            for place, other in zip(places, places[::-1], strict=True):
                if place > other:
                    break
                # Only those two, that lie opposite to each other.
                pinch = (taken == 2) & windows[place] & windows[other]
                if pinch.any():
                    for between in places:
                        grows[between] |= pinch
        grown = current | (add[1:-1, 1:-1, 1:-1] & present)
        if (grown == current).all():
            return current
        current = grown


def _window(padded: NDArray[np.bool_], place: tuple[int, ...]) -> NDArray[np.bool_]:
    """All but the last octants along each axis (0), or all but the first (1): a view."""
    ends = zip(place, padded.shape, strict=True)
    return padded[tuple(slice(step, size - 1 + step) for step, size in ends)]


def _faces() -> Iterator[tuple[tuple[int, ...], ...]]:
    """The places of two by two octants about an edge along each axis, opposite ones in turn."""
    for axis in range(3):
        yield tuple(place for place in np.ndindex(2, 2, 2) if not place[axis])

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Activation of cells in a part, and their octants sorted: inside, across or outside its wall."""

from __future__ import annotations

from dataclasses import dataclass

from ..design.memory_guard import refuse_cells
from ..design.spec_parts import Grid
from ..grid.activation import active_cells, inside_cells, make_grid, mapped_grid
from ..grid.placement import part_map
from ..lattice.padded_grid import PaddedGrid, padded_grid
from ..mesh.triangle_mesh import TriangleMesh, box_of, concatenate
from ..shell.domain import Domain
from ..trim.culling import OctantRoles, octant_roles
from ..util.progress import Monitor
from ..util.types import Bools


@dataclass(frozen=True, eq=False)
class ActiveCells:
    """The cells that hold a lattice.

    Attributes:
        padded: the part's grid, and the cells about it that the lattice may be laid on.
        active: (nx, ny, nz) bool, those of the part's grid that hold one.
        narrow: how many, with their centres in what the lattice fills, hold none, because next to
            an axis or a pole they leave their struts no room.
    """

    padded: PaddedGrid
    active: Bools
    narrow: int = 0

    @property
    def warnings(self) -> tuple[str, ...]:
        """A sentence on cells that are too narrow for their struts."""
        if not self.narrow:
            return ()
        cells = "cell is" if self.narrow == 1 else "cells are"
        return (
            f"{self.narrow:,} {cells} too narrow for struts, next to the axis or the poles that "
            "cells lie about, and left hollow there: thinner struts or fewer cells around leave "
            "less.",
        )


def refuse_grid(solid: TriangleMesh, grid: Grid) -> None:
    """Refuse more cells about a part than fit, as `find_active_cells`, before there is a domain.

    Raises:
        VolfrepError: the grid would have too many cells.
    """
    if part_map(grid, solid.bounds) is None:
        refuse_cells(make_grid(solid.bounds, grid.size, grid.origin).cells, grid.size)


def find_active_cells(
    solid: TriangleMesh,
    domain: Domain,
    grid: Grid,
    activation: str,
    least: float,
    monitor: Monitor,
) -> ActiveCells:
    """The cells of a part, and which of them are active.

    Args:
        solid: the part, mm.
        domain: what the lattice fills.
        grid: where the cells lie.
        activation: which of them are active.
        least: width of the narrowest one about an axis that can hold a lattice, in units of L.
        monitor: for progress and cancel.
    """
    mapping = part_map(grid, solid.bounds)
    whole, origin = solid, grid.origin
    if domain.is_open:  # octants are wanted beyond the part, too; the cells still begin at it
        whole = concatenate(solid, domain.boundary)
        x, y, z = solid.bounds[0]
        origin = origin or (float(x), float(y), float(z))
    if mapping is None:
        cells = make_grid(box_of(whole.vertices), grid.size, origin)
    else:
        cells = mapped_grid(whole, mapping, grid.size, grid.origin, monitor)
    refuse_cells(cells.cells, grid.size)
    padded = padded_grid(cells, mapping, least)
    usable, narrow = padded.inner_usable, 0
    if usable is not None and not usable.all():
        narrow = int((inside_cells(cells, domain.mesh, monitor, mapping) & ~usable).sum())
    return ActiveCells(
        padded, active_cells(cells, domain.mesh, activation, monitor, mapping, usable), narrow
    )


def roles_of(
    solid: TriangleMesh,
    domain: Domain,
    cells: ActiveCells,
    grid: Grid,
    margin: float,
    monitor: Monitor,
) -> OctantRoles:
    """Where the octants of a part's cells lie with respect to its wall."""
    mapping = part_map(grid, solid.bounds)
    return octant_roles(domain.boundary, cells.padded.cells, monitor, mapping, margin)

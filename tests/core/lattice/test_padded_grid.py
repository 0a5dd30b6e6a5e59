# SPDX-License-Identifier: LGPL-2.1-or-later
"""Lattices without end: octants of the active cells, and the struts of all cells about these."""

import numpy as np

from volfrep.design.cells import LIBRARY
from volfrep.grid.cell_grid import CellGrid
from volfrep.lattice.padded_grid import SUPPORT, PaddedGrid
from volfrep.octants.octant import NEIGHBOURS, frames


def test_no_octant_lies_where_the_graph_has_no_struts() -> None:
    """About an axis narrow cells hold none, and beyond them the wall may be near others again."""
    around = 9
    cells = CellGrid(np.zeros(3), 1.0, (3, 4, around), (False, False, True))
    usable = np.zeros((9, 10, around), bool)
    usable[5:] = True
    active = np.zeros(cells.shape, bool)
    active[2, 1, 2:4] = True
    padded = PaddedGrid(cells, (SUPPORT, SUPPORT, 0), usable)
    grid = padded.octants(LIBRARY["BCC"], active, True)
    row = padded.graph(LIBRARY["BCC"], active, True).row
    assert (grid.kind >= 0).any()
    for number, key in enumerate(grid.keys):
        place = np.argwhere(grid.kind == number)
        seen = ((place - 1) // 2 + padded.first)[:, None]
        seen = seen + frames(place)[1][:, None] * NEIGHBOURS[key.active]
        seen[:, :, 2] %= around
        assert (row[tuple(np.moveaxis(seen, -1, 0))] >= 0).all()

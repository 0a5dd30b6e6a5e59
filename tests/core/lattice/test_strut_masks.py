# SPDX-License-Identifier: LGPL-2.1-or-later
"""Which nodes of the whole an octant's own are, and octants that lack some of their struts."""

import numpy as np
import pytest

from samples import SKEW
from volfrep.design.cells import LIBRARY, PAPERS, find_cell
from volfrep.grid.strut_graph import cell_graph
from volfrep.lattice.strut_masks import NodeLookup, cells_of_nodes, without_struts
from volfrep.octants.octant import NEIGHBOURS, cell_copies, frames, octant_grid

SIZE, ORIGIN = 10.0, np.array([3.0, -2.0, 1.0])
CELLS = [*map(find_cell, PAPERS), SKEW]


def grid_and_graph(cell, active):
    """The octants of active cells, and the graph of these and of empty ones around."""
    grid = octant_grid(cell, active, SIZE, ORIGIN)
    wide = np.pad(active, 1)
    return grid, cell_graph(cell, wide, SIZE, ORIGIN - SIZE, first=(1, 1, 1))


@pytest.fixture(params=CELLS, ids=lambda cell: cell.name)
def cell(request):
    return request.param


def test_a_node_is_of_a_cell_that_has_it(cell):
    grid, _ = grid_and_graph(cell, np.random.default_rng(1).random((3, 3, 2)) < 0.6)
    for key in grid.keys:
        nodes, _ = cell_copies(cell, NEIGHBOURS[key.active], key.mirror)
        found = cells_of_nodes(cell, key, nodes)
        assert np.isin(found, key.active).all()
        place = nodes - NEIGHBOURS[found]
        assert (place > -1e-9).all()
        assert (place < 1 + 1e-9).all()


@pytest.mark.slow_but("CVC", "Box")
def test_the_nodes_of_the_whole_lie_where_the_octants_are(cell):
    grid, graph = grid_and_graph(cell, np.random.default_rng(4).random((3, 2, 3)) < 0.7)
    seen = 0
    for number, key in enumerate(grid.keys):
        nodes, _ = cell_copies(cell, NEIGHBOURS[key.active], key.mirror)
        copy = cells_of_nodes(cell, key, nodes)
        lookup = NodeLookup.of(cell, key, copy, nodes - NEIGHBOURS[copy])
        place = np.argwhere(grid.kind == number)
        rows = lookup.rows(graph, place, grid.periodic)
        corner, sign = frames(place)
        there = ORIGIN + SIZE * (corner[:, None] + sign[:, None] * nodes)
        np.testing.assert_allclose(graph.nodes[rows], there, atol=1e-9)
        seen += len(place)
    assert seen == (grid.kind >= 0).sum() > 100


def test_with_all_struts_kept_nothing_changes(cell):
    grid, graph = grid_and_graph(cell, np.ones((3, 3, 3), bool))
    kept = np.ones(len(graph.struts), bool)
    found = without_struts(grid, cell, graph, kept, 2.0, joined=True)
    np.testing.assert_array_equal(found.kind, grid.kind)
    assert found.keys == grid.keys


@pytest.mark.slow_but("CVC-True", "Box-False")
@pytest.mark.parametrize("joined", [False, True])
def test_octants_lack_the_struts_that_reach_them(cell, joined):
    """Those that lack one lie by the strut; farther ones stay what they were."""
    grid, graph = grid_and_graph(cell, np.ones((3, 3, 3), bool))
    middle = graph.nodes[graph.struts].mean(axis=1)
    gone = int(np.linalg.norm(middle - (ORIGIN + 1.5 * SIZE), axis=1).argmin())
    kept = np.arange(len(graph.struts)) != gone
    radius = 1.0
    found = without_struts(grid, cell, graph, kept, radius, joined=joined)
    lacks = np.array([key.missing != 0 for key in found.keys])[found.kind] & (found.kind >= 0)
    assert lacks.any()
    # Octant (i, j, k) is the cube of half a cell that begins at (i, j, k) / 2 - 1 / 2 cells.
    low = ORIGIN + 0.5 * SIZE * (np.argwhere(lacks) - 1)
    a, b = graph.nodes[graph.struts[gone]]
    beyond = np.maximum(low - np.maximum(a, b), np.minimum(a, b) - low - 0.5 * SIZE)
    reach = radius + (SIZE if joined else 0.0)
    assert beyond.max() <= reach + 1e-9
    # Every octant that the strut runs through lacks it.
    along = a + np.linspace(0.01, 0.99, 99)[:, None] * (b - a)
    through = np.floor((along - ORIGIN) / (0.5 * SIZE) + 1e-7).astype(int) + 1
    assert lacks[tuple(through.T)].all()
    same = ~lacks & (grid.kind >= 0)
    before = np.array(grid.keys, object)[grid.kind[same]]
    after = np.array(found.keys, object)[found.kind[same]]
    assert (before == after).all()


def test_one_missing_strut_of_a_box_is_one_bit():
    grid, graph = grid_and_graph(LIBRARY["Box"], np.ones((3, 3, 3), bool))
    kept = np.ones(len(graph.struts), bool)
    kept[40] = False
    found = without_struts(grid, LIBRARY["Box"], graph, kept, 1.0, joined=False)
    new = [key for key in found.keys if key.missing]
    assert new
    assert all(key.missing.bit_count() == 1 for key in new)

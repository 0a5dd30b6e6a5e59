# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where the nodes of a lattice are to lie, and what their struts are like there."""

import numpy as np
import pytest

from samples import SKEW
from volfrep.design.cells import LIBRARY, PAPERS, find_cell
from volfrep.grid.node_frames import node_frames, shortest
from volfrep.grid.strut_graph import cell_graph

SIZE = 10.0


def graph_of(cell=LIBRARY["CVC"], shape=(2, 2, 2)):
    return cell_graph(cell, np.ones(shape, bool), SIZE, np.zeros(3))


def rotation():
    x, y = np.cos(0.7), np.sin(0.7)
    return np.array([[x, -y, 0], [y, x, 0], [0, 0, 1.0]]) @ np.array(
        [[1.0, 0, 0], [0, x, -y], [0, y, x]]
    )


@pytest.mark.parametrize("cell", [*map(find_cell, PAPERS), SKEW], ids=lambda cell: cell.name)
def test_every_strut_is_seen_from_both_its_ends(cell):
    graph = graph_of(cell)
    made = node_frames(graph, graph.nodes, np.ones(len(graph.nodes)), SIZE)
    node, column = np.nonzero(made.neighbours >= 0)
    seen = np.stack([node, made.neighbours[node, column]], axis=1)
    expected = np.concatenate([graph.struts, graph.struts[:, ::-1]])
    np.testing.assert_array_equal(np.unique(seen, axis=0), np.unique(expected, axis=0))
    span = graph.nodes[seen[:, 1]] - graph.nodes[seen[:, 0]]
    length = np.linalg.norm(span, axis=1)
    np.testing.assert_allclose(made.directions[node, column], span / length[:, None])


def test_radii_grow_evenly_along_a_strut():
    graph = graph_of(LIBRARY["Box"])
    radius = 0.5 + 0.02 * graph.nodes[:, 0]
    made = node_frames(graph, graph.nodes, radius, SIZE)
    node, column = np.nonzero(made.neighbours >= 0)
    along_x = made.directions[node, column, 0]
    np.testing.assert_allclose(made.slopes[node, column], 0.02 * along_x, atol=1e-12)
    np.testing.assert_allclose(made.joint, radius * (1.0 + radius / SIZE))
    assert made.rotation is None


def test_a_turned_lattice_knows_its_rotation():
    graph, turn = graph_of(), rotation()
    there = graph.nodes @ turn.T
    bends = np.tile(turn, (len(there), 1, 1))
    made = node_frames(graph, there, np.ones(len(there)), SIZE, bends)
    np.testing.assert_allclose(made.rotation, bends, atol=1e-12)
    turned = np.einsum("nij,nkj->nki", made.rotation, made.were)
    some = made.neighbours >= 0
    np.testing.assert_allclose(made.directions[some], turned[some], atol=1e-12)


def test_a_stretch_is_left_out_of_the_rotation():
    graph, turn = graph_of(), rotation()
    bend = turn @ np.diag([1.0, 1.5, 2.0])
    made = node_frames(
        graph, graph.nodes @ bend.T, np.ones(len(graph.nodes)), SIZE,
        np.tile(bend, (len(graph.nodes), 1, 1)),
    )  # fmt: skip
    np.testing.assert_allclose(made.rotation, np.tile(turn, (len(graph.nodes), 1, 1)), atol=1e-12)


def test_the_shortest_way_between_nodes_that_repeat():
    spans = np.array([[9.0, 9.0, 0.0], [-6.0, 1.0, 0.0], [20.0, -20.0, 3.0]])
    found = shortest(spans.copy(), np.array([10.0, np.inf, np.inf]))
    np.testing.assert_allclose(found, [[-1.0, 9.0, 0.0], [4.0, 1.0, 0.0], [0.0, -20.0, 3.0]])


def test_in_a_ring_the_last_node_is_beside_the_first():
    graph = cell_graph(
        LIBRARY["Box"], np.ones((4, 1, 1), bool), SIZE, np.zeros(3), (True, False, False)
    )
    period = np.array([4 * SIZE, np.inf, np.inf])
    made = node_frames(graph, graph.nodes, np.ones(len(graph.nodes)), SIZE, None, period)
    some = made.neighbours >= 0
    assert np.abs(made.directions[some]).max() == pytest.approx(1.0)
    along = np.abs(made.directions[..., 0]) > 0.5
    assert (along & some).sum() == 2 * len(graph.nodes)

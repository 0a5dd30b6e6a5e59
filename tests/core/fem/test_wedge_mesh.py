# SPDX-License-Identifier: LGPL-2.1-or-later
"""A skin of wedges: its volume, its pads, and loads that are spread over it."""

import numpy as np
import pytest

from volfrep.fem.wedge_mesh import pad_shares, wedge_mesh

THICK = 1.5


def slab(pads=None, lifted=0.0):
    """A square of 4 x 4 squares of 5 mm, each two triangles; (n, 3) above and below."""
    x, y = np.meshgrid(np.arange(5) * 5.0, np.arange(5) * 5.0, indexing="ij")
    above = np.stack([x.ravel(), y.ravel(), lifted * np.sin(x.ravel())], axis=1)
    i, j = np.meshgrid(np.arange(4), np.arange(4), indexing="ij")
    a = (5 * i + j).ravel()
    triangles = np.concatenate(
        [np.stack([a, a + 5, a + 6], axis=1), np.stack([a, a + 6, a + 1], axis=1)]
    )
    pads = np.zeros(25) if pads is None else pads
    return above, above - [0.0, 0.0, THICK], triangles, pads


def padded():
    pads = np.zeros(25)
    pads[[12, 13, 3]] = 1.2, 3.0, 0.7
    return pads


def volume(mesh):
    """Of wedges with straight edges between two planes."""
    a, b, c = mesh.nodes[mesh.elements[:, 3:6]].swapaxes(0, 1)
    return 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() * THICK


@pytest.mark.parametrize("pads", [None, padded()])
def test_wedges_fill_the_skin(pads):
    mesh = wedge_mesh(*slab(pads))
    assert volume(mesh) == pytest.approx(20 * 20 * THICK)
    assert (mesh.nodes[mesh.elements[:, 3:6], 2] == 0.0).all()
    assert mesh.nodes[mesh.elements[:, :3], 2] == pytest.approx(-THICK)
    assert mesh.nodes[mesh.elements[:, 12:], 2] == pytest.approx(-THICK / 2)
    for middle, (one, two) in zip((6, 7, 8), ((0, 1), (1, 2), (2, 0)), strict=True):
        ends = mesh.nodes[mesh.elements[:, [one, two]]].mean(axis=1)
        assert mesh.nodes[mesh.elements[:, middle]] == pytest.approx(ends)
    assert len(np.unique(mesh.nodes.round(6), axis=0)) == len(mesh.nodes)


def test_a_pads_border_is_as_far_from_its_vertex_as_edges_allow():
    pads = padded()
    mesh = wedge_mesh(*slab(pads))
    above = slab()[1]
    away = np.linalg.norm(mesh.nodes[mesh.ring[:, 1]] - above[mesh.ring[:, 0]], axis=1)
    assert set(mesh.ring[:, 0]) == {12, 13, 3}
    assert away[mesh.ring[:, 0] == 3] == pytest.approx(0.7)
    between = np.sort(away[mesh.ring[:, 0] == 12])
    assert between[0] == pytest.approx(0.8 * 5.0 * 1.2 / 4.2)  # towards its neighbour
    assert between[1:] == pytest.approx(1.2)
    assert mesh.is_pad.sum() == 6 + 6 + 3


def test_pads_share_an_edge_that_is_too_short_for_both():
    first, second = pad_shares(np.array([10.0, 5.0]), np.array([2.0, 2.0]), np.array([0.0, 6.0]))
    assert first == pytest.approx([0.2, 0.2])
    assert second == pytest.approx([0.0, 0.6])


@pytest.mark.parametrize("pads", [None, padded()])
def test_loads_that_are_spread_keep_their_force_and_moment(pads):
    above, below, triangles, pads = slab(pads, lifted=0.5)
    mesh = wedge_mesh(above, below, triangles, pads)
    loads = np.random.default_rng(3).normal(size=(25, 3))
    loads[[0, 1, 5]] = 0.0
    loads[20:] = 0.0
    felt = mesh.spread(loads)
    assert felt.sum(axis=0) == pytest.approx(loads.sum(axis=0))
    moment = np.cross(above, loads).sum(axis=0)
    assert np.cross(mesh.nodes, felt).sum(axis=0) == pytest.approx(moment)


def test_where_the_inner_side_would_turn_over_it_goes_as_its_neighbours_do():
    above, below, triangles, pads = slab()
    below[12, :2] += 9.0
    mesh = wedge_mesh(above, below, triangles, pads)
    assert len(mesh.elements) == len(triangles)
    a, b, c = mesh.nodes[mesh.elements[:, :3]].swapaxes(0, 1)
    assert (np.cross(b - a, c - a)[:, 2] > 0.0).all()


@pytest.mark.parametrize("pads", [None, padded()])
def test_every_node_outside_lies_in_a_triangle_of_the_surface(pads):
    above, below, triangles, pads = slab(pads, lifted=0.5)
    mesh = wedge_mesh(above, below, triangles, pads)
    nodes, rows, shares = mesh.on_outside()
    assert set(nodes) == set(mesh.elements[:, [3, 4, 5, 9, 10, 11]].ravel())
    assert shares.sum(axis=1) == pytest.approx(1.0)
    assert shares.min() > -1e-9
    assert np.einsum("kc,kci->ki", shares, above[rows]) == pytest.approx(mesh.nodes[nodes])

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Gaps between struts, against closed forms and points strewn over their surfaces."""

import numpy as np
import pytest
from scipy.spatial import cKDTree

from volfrep import LatticeSpec
from volfrep.grid.strut_graph import Wireframe
from volfrep.jobs.beam_part import block_beams
from volfrep.reports import clearance
from volfrep.reports.clearance import narrowest_gap


def lattice(*struts, radii=0.5, joints=0.5):
    """Struts between points, each with nodes of its own."""
    ends = np.array(struts, float)
    count = len(ends)
    return Wireframe(
        ends.reshape(-1, 3),
        np.arange(2 * count, dtype=np.int32).reshape(-1, 2),
        np.broadcast_to(np.asarray(radii, float), (count, 2)),
        np.broadcast_to(np.asarray(joints, float), 2 * count),
    )


def gap_of(wireframe, widest=10.0):
    return narrowest_gap(wireframe, np.arange(len(wireframe.struts)), widest)


def test_struts_that_cross_square_to_each_other():
    found = gap_of(lattice([[-5, 0, 0], [5, 0, 0]], [[0, -5, 2], [0, 5, 2]]))
    assert found[0] == pytest.approx(2 - 0.5 - 0.5)
    np.testing.assert_allclose(found[1], [0, 0, 1])


def test_parallel_struts_with_thick_joints():
    pair = [[0, 0, 0], [10, 0, 0]], [[0, 3, 0], [10, 3, 0]]
    assert gap_of(lattice(*pair))[0] == pytest.approx(2)
    assert gap_of(lattice(*pair, joints=0.7))[0] == pytest.approx(3 - 1.4)


def test_the_end_of_a_strut_over_the_middle_of_a_cone():
    pair = [[0, 0, 0], [10, 0, 0]], [[5, 4, 0], [5, 9, 0]]
    found = gap_of(lattice(*pair, radii=[[1, 2], [0.5, 0.5]], joints=[1, 2, 0.6, 0.6]))
    assert found[0] == pytest.approx(4 - 1.5 - 0.6)


def test_struts_that_meet_or_overlap_have_no_gap():
    nodes = np.array([[0, 0, 0], [5, 0, 0], [0, 5, 0]], float)
    corner = Wireframe(
        nodes, np.array([[0, 1], [0, 2]], np.int32), np.full((2, 2), 0.5), np.full(3, 0.5)
    )
    assert gap_of(corner) is None
    assert gap_of(lattice([[-5, 0, 0], [5, 0, 0]], [[0, -5, 0.9], [0, 5, 0.9]])) is None
    assert gap_of(lattice([[0, 0, 0], [5, 0, 0]])) is None


def test_wider_gaps_than_asked_for_are_not_told():
    pair = lattice([[-5, 0, 0], [5, 0, 0]], [[0, -5, 2], [0, 5, 2]])
    assert gap_of(pair, 0.9) is None
    assert gap_of(pair, 1.1)[0] == pytest.approx(1)
    assert narrowest_gap(pair, np.array([0]), 9.0) is None


def test_random_struts_against_points_on_their_axes(monkeypatch):
    monkeypatch.setattr(clearance, "STRUTS_PER_STEP", 7)
    random = np.random.default_rng(3)
    start = random.uniform(0, 60, (40, 3))
    ends = np.stack([start, start + random.normal(size=(40, 3)) * 6], axis=1)
    share = np.linspace(0, 1, 400)[:, None, None]
    clouds = ((1 - share) * ends[:, 0] + share * ends[:, 1]).transpose(1, 0, 2)
    trees = [cKDTree(cloud) for cloud in clouds]
    nearest = min(trees[i].query(clouds[j])[0].min() for i in range(len(trees)) for j in range(i))
    thin = lattice(*ends, radii=nearest / 10, joints=nearest / 10)
    assert gap_of(thin, 60.0)[0] == pytest.approx(0.8 * nearest, rel=0.01)


def test_opposite_edges_of_an_octets_tetrahedra():
    octet = block_beams(LatticeSpec(cell="Octet", cell_size=10, strut_radius=0.5), (2, 2, 2))
    # The edges are L / sqrt(2) long, and opposite ones of a tetrahedron L / 2 apart.
    assert gap_of(octet.lattice)[0] == pytest.approx(5.0 - 2 * 0.5)

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Collapses, flips and splits keep a surface what it is."""

import numpy as np

import samples
from volfrep.mesh import quality, remesh
from volfrep.mesh.triangle_mesh import TriangleMesh


def _anything(one, two):
    return np.ones(len(one), bool)


def _nothing(one, two):
    return np.zeros(len(one), bool)


def rules(count, rank=None):
    rank = np.zeros(count, np.int64) if rank is None else rank
    return remesh.Rules(rank, _anything, _nothing, remesh.stays_good)


def test_every_edge_of_a_closed_mesh_has_two_triangles():
    ball = samples.sphere(10.0, 2)
    table = remesh.edges(ball.triangles.astype(np.int64), len(ball.vertices))
    assert len(table.ends) == 3 * len(ball.triangles) // 2
    assert (table.triangles >= 0).all()
    corners = ball.triangles[table.triangles[:, 0]]
    assert (corners == table.opposite[:, :1]).any(axis=1).all()
    assert (corners == table.ends[:, :1]).any(axis=1).all()


def test_collapsing_keeps_the_surface_closed_and_where_it_was():
    ball = samples.sphere(10.0, 3)
    vertices, triangles = ball.vertices, ball.triangles.astype(np.int64)
    for _ in range(15):
        vertices, triangles, _ = remesh.collapse(
            vertices, triangles, rules(len(vertices)), 2.0, 4.0
        )
    mesh = TriangleMesh(vertices, triangles.astype(np.int32))
    found = quality.measure(mesh)
    assert found.watertight
    assert found.genus == 0
    assert found.triangles < 0.7 * len(ball.triangles)
    assert abs(found.volume / ball.volume - 1) < 0.05
    assert np.abs(np.linalg.norm(vertices, axis=1) - 10.0).max() < 0.7


def test_a_vertex_of_higher_rank_stays():
    ball = samples.sphere(10.0, 2)
    rank = np.zeros(len(ball.vertices), np.int64)
    rank[::3] = 1
    vertices, _, renumber = remesh.collapse(
        ball.vertices, ball.triangles.astype(np.int64), rules(len(rank), rank), 3.5, 9.0
    )
    pinned = np.flatnonzero((rank == 1) & (renumber >= 0))
    np.testing.assert_array_equal(vertices[renumber[pinned]], ball.vertices[pinned])
    assert (renumber < 0).any()


def test_forbidden_edges_are_not_made():
    ball = samples.sphere(10.0, 2)
    triangles = ball.triangles.astype(np.int64)
    never = remesh.Rules(
        np.zeros(len(ball.vertices), np.int64), _anything, _anything, remesh.stays_good
    )
    _, same, _ = remesh.collapse(ball.vertices, triangles, never, 9.0, 99.0)
    assert len(same) == len(triangles)
    _, flipped = remesh.flip(
        ball.vertices, triangles, lambda ends, corners: np.ones(len(ends)), _anything
    )
    assert flipped == 0


def test_flipping_mends_a_strip_of_needles():
    x = np.linspace(0.0, 8.0, 9)
    low = np.stack([x, np.zeros(9), np.zeros(9)], axis=1)
    high = np.stack([x, np.ones(9), np.zeros(9)], axis=1)
    vertices = np.concatenate([low, high])
    # Each quad is cut, then sheared so that the other diagonal is the shorter one.
    quads = np.array([[[k, k + 1, k + 10], [k, k + 10, k + 9]] for k in range(8)])
    triangles = quads.reshape(-1, 3).astype(np.int64)
    vertices[9:, 0] += 0.9

    def gain(ends, corners):
        old = np.linalg.norm(vertices[ends[:, 0]] - vertices[ends[:, 1]], axis=1)
        new = np.linalg.norm(vertices[corners[:, 0]] - vertices[corners[:, 1]], axis=1)
        return old - new

    before = remesh.qualities(vertices[triangles]).min()
    result, count = remesh.flip(vertices, triangles, gain, _nothing)
    assert count == 8
    assert remesh.qualities(vertices[result]).min() > before + 0.2


def test_splitting_edges_adds_their_middles_and_keeps_the_surface_closed():
    ball = samples.sphere(10.0, 2)
    wanted = lambda one, two: (one + two) % 3 == 0  # noqa: E731
    vertices, triangles = remesh.split(ball.vertices, ball.triangles.astype(np.int64), wanted)
    found = quality.measure(TriangleMesh(vertices, triangles.astype(np.int32)))
    assert found.watertight
    assert len(vertices) > len(ball.vertices)
    assert abs(found.volume - ball.volume) < 1e-9 * ball.volume


def test_where_splits_and_flips_are_wanted_is_all_that_has_to_be_looked_at():
    ball = samples.sphere(10.0, 2)
    triangles, cap = ball.triangles.astype(np.int64), ball.vertices[:, 2] > 4.0
    wanted = lambda one, two: cap[one] & cap[two]  # noqa: E731
    beside = cap[triangles].sum(axis=1) >= 2
    assert 10 < beside.sum() < 0.5 * len(beside)
    every = remesh.split(ball.vertices, triangles, wanted)
    some = remesh.split(ball.vertices, triangles, wanted, np.flatnonzero(beside))
    for one, two in zip(every, some, strict=True):
        np.testing.assert_array_equal(one, two)

    def gain(ends, corners):
        return np.where(cap[ends].all(axis=1), 1.0 + corners[:, 0], -1.0)

    every, some = (
        remesh.flip(ball.vertices, triangles, gain, _nothing, among) for among in (None, beside)
    )
    assert every[1] == some[1] > 5
    np.testing.assert_array_equal(every[0], some[0])


def test_an_equilateral_triangle_has_quality_one():
    corners = np.array([[[0.0, 0, 0], [1, 0, 0], [0.5, np.sqrt(0.75), 0]]])
    np.testing.assert_allclose(remesh.qualities(corners), 1.0)

# SPDX-License-Identifier: LGPL-2.1-or-later
import numpy as np
import pytest
import trimesh

import samples
from volfrep.mesh.closest import closest_on_triangles
from volfrep.mesh.triangle_mesh import empty_mesh
from volfrep.spatial.proximity import (
    POINTS_PER_WALK,
    NearestTriangles,
    are_nearer,
    closest_points,
    index_surface,
    neighbours,
    neighbours_together,
)
from volfrep.util.errors import VolfrepError
from volfrep.util.threads import use_threads


@pytest.mark.parametrize(
    "part",
    [samples.box(), samples.sphere(subdivisions=2), samples.plate(48), samples.bracket(33.0)],
    ids=["box", "sphere", "plate", "bracket"],
)
def test_exact_distances_agree_with_trimesh(part):
    random = np.random.default_rng(1)
    low, high = part.bounds
    points = low - 10.0 + random.random((400, 3)) * (high - low + 20.0)
    closest, distance, triangle = closest_points(part, points)
    theirs = trimesh.Trimesh(part.vertices, part.triangles, process=False)
    _, expected, _ = trimesh.proximity.closest_point_naive(theirs, points)
    np.testing.assert_allclose(distance, expected, atol=1e-9)
    np.testing.assert_allclose(np.linalg.norm(points - closest, axis=1), distance, atol=1e-12)
    corners = part.vertices[part.triangles[triangle]]
    np.testing.assert_allclose(closest_on_triangles(corners, points)[0], closest, atol=1e-12)
    reach = random.choice([0.1, 3.0, 12.0], len(points))
    np.testing.assert_array_equal(are_nearer(part, points, reach), expected < reach)
    # The farthest of all and of some.
    for spacing in (1.0, 30.0):
        surface = NearestTriangles(part, spacing)
        for some in (points, points[:200]):
            far = distance[: len(some)].max()
            assert surface.farthest(some) == pytest.approx(far, abs=1e-9)
            assert surface.farthest(some, far + 1.0) == far + 1.0
            assert surface.farthest(some[:0], 2.0) == 2.0


@pytest.mark.slow
def test_the_centre_of_a_sphere_is_equally_near_to_all():
    part = samples.sphere(20.0, 4)
    _, distance, _ = closest_points(part, np.zeros((300, 3)))
    assert np.ptp(distance) == 0.0
    assert distance[0] == pytest.approx(20.0, rel=0.003)


def test_slivers_and_points_have_distances_too():
    corners = np.array(
        [
            [[0.0, 0.0, 0.0], [10.0, 0.0, 0.0], [5.0, 0.0, 0.0]],
            [[0.0, 0.0, 0.0], [10.0, 0.0, 0.0], [5.0, 1e-12, 0.0]],
            [[1.0, 1.0, 1.0]] * 3,
        ]
    )
    points = np.array([[7.0, 3.0, 4.0], [7.0, 3.0, 4.0], [1.0, 1.0, 3.0]])
    closest, edge = closest_on_triangles(corners, points)
    np.testing.assert_allclose(np.linalg.norm(points - closest, axis=1), [5.0, 5.0, 2.0])
    assert (edge >= 0).all()


@pytest.mark.slow_cases("plate")
@pytest.mark.parametrize(
    ("part", "inside"),
    [
        (samples.plate(), samples.inside_plate),
        (samples.bracket(33.0), lambda p: samples.inside_bracket(p, 33.0)),
    ],
    ids=["plate", "bracket"],
)
def test_the_fast_distance_keeps_its_bound(part, inside):
    spacing = 1.0
    index = index_surface(part, spacing)
    random = np.random.default_rng(2)
    low, high = part.bounds
    points = low + random.random((20_000, 3)) * (high - low)
    points = points[inside(points)]
    exact = closest_points(part, points)[1]
    closest, distance = index.near(points)
    error = distance - exact
    assert error.min() > -1e-9
    bound = (0.75 * spacing) ** 2 / (2.0 * np.maximum(exact, 1e-9)) + 0.1 * spacing
    assert (error <= np.minimum(bound, spacing)).all()
    assert np.mean(error < 1e-9) > 0.99
    on_surface = closest_points(part, closest)[1]
    assert on_surface.max() < 1e-6


def test_the_fast_distance_of_a_point_depends_on_no_other_and_on_no_threads():
    part = samples.bracket(13.0)
    index = index_surface(part, 1.0)
    random = np.random.default_rng(4)
    low, high = part.bounds
    points = low + random.random((3 * POINTS_PER_WALK, 3)) * (high - low)
    order = random.permutation(len(points))
    use_threads(1)
    try:
        closest, distance = index.near(points)
        use_threads(2)
        again, shuffled = index.near(points[order])
    finally:
        use_threads(0)
    assert np.array_equal(again, closest[order])
    assert np.array_equal(shuffled, distance[order])
    assert index.near(points[:0])[0].shape == (0, 3)


def test_neighbours_come_together_and_equal_points_in_their_order():
    points = np.random.default_rng(2).random((4000, 3))
    order = neighbours_together(points)
    np.testing.assert_array_equal(np.sort(order), np.arange(4000))
    steps = np.linalg.norm(np.diff(points[order], axis=0), axis=1)
    assert steps.mean() < 0.12, "two of them at random are 0.66 apart"
    np.testing.assert_array_equal(neighbours_together(np.ones((9, 3))), np.arange(9))


def test_distances_within_a_reach_are_those_of_any_reach():
    part = samples.box((20, 12, 8))
    index = index_surface(part, 0.8)
    points = np.random.default_rng(5).uniform(-16, 16, (9_000, 3))
    distance, reach = index.near(points)[1], 3.0
    within = index.distances_within(points, reach)
    found = np.isfinite(within)
    assert (within[found] == distance[found]).all()
    assert found[distance <= reach - 0.75 * index.spacing].all()
    assert not found[distance > reach].any()
    assert 0 < found.sum() < len(points)


def test_samples_cover_slivers_too():
    part = samples.plate()
    index = index_surface(part, 1.0)
    theirs = trimesh.Trimesh(part.vertices, part.triangles, process=False)
    points = trimesh.sample.sample_surface(theirs, 50_000, seed=3)[0]
    assert index.tree.query(points)[0].max() <= 0.751


def test_neighbours_share_the_edge():
    part = samples.plate(24)
    across = neighbours(part)
    t = part.triangles
    for edge in range(3):
        other = t[across[:, edge]]
        for end in (t[:, edge], t[:, (edge + 1) % 3]):
            assert (other == end[:, None]).any(axis=1).all()
    assert (across != np.arange(len(t))[:, None]).all()


def test_the_farthest_of_many_points_is_found_though_few_are_looked_into(monkeypatch):
    ball = samples.sphere(5.0, 2)
    points = np.random.default_rng(2).normal(size=(9000, 3))
    points *= (5.0 + np.arange(9000) / 9000.0)[:, None] / np.linalg.norm(points, axis=1)[:, None]
    surface, asked, closest = NearestTriangles(ball, 1.0), [], NearestTriangles.closest

    def count(self, places):
        asked.append(len(places))
        return closest(self, places)

    monkeypatch.setattr(NearestTriangles, "closest", count)
    assert surface.farthest(points) == closest_points(ball, points)[1].max()
    assert asked.pop() == 9000
    assert asked[0] == 2000
    assert sum(asked) < 5000


def test_what_has_no_distance_is_refused():
    with pytest.raises(VolfrepError, match="empty mesh"):
        closest_points(empty_mesh(), np.zeros((1, 3)))
    with pytest.raises(VolfrepError, match="thicker shell"):
        index_surface(samples.box(), 1e-4)
    with pytest.raises(VolfrepError, match="give their spacing"):
        NearestTriangles(samples.box()).farthest(np.zeros((1, 3)))

# SPDX-License-Identifier: LGPL-2.1-or-later
"""A mesh over an implicit surface: its vertices come onto the surface and stay in their faces."""

from dataclasses import replace

import numpy as np
import pytest

from implicit import surface_of
from volfrep.octants import constrained_mesh as surface
from volfrep.octants import sdf as frep

BALL = frep.spheres(np.zeros((1, 3)), 5.0)
#: Two balls of radius 5, whose surfaces meet in the circle of radius 4 about the x axis at x = 0.
TWO_BALLS = frep.spheres(np.array([[-3.0, 0.0, 0.0], [3.0, 0.0, 0.0]]), 5.0)


@pytest.fixture(autouse=True)
def no_octant_about_these_shapes(monkeypatch):
    """The shapes lie about the origin, and an octant would hold their vertices in its box."""
    monkeypatch.setattr(surface, "FACE_MARGIN", -1e6)


def near_the_ball(count=200):
    random = np.random.default_rng(3)
    points = random.normal(size=(count, 3))
    return points / np.linalg.norm(points, axis=1)[:, None] * random.uniform(4.8, 5.2, (count, 1))


def test_projected_vertices_lie_on_the_surface():
    start = surface_of(near_the_ball(), [], BALL)
    found = surface.project(start).vertices
    np.testing.assert_allclose(np.linalg.norm(found, axis=1), 5.0, atol=1e-12)
    # They moved along the radius, the shortest way.
    turn = np.linalg.norm(np.cross(start.vertices, found), axis=1)
    np.testing.assert_allclose(turn, 0.0, atol=1e-12)


def test_a_vertex_on_a_face_moves_in_the_face():
    points = near_the_ball()
    points = points[np.abs(points[:, 2]) < 4.0]
    place = np.ones((len(points), 3))
    place[:, 2] = 0
    found = surface.project(surface_of(points, [], BALL, place=place), passes=8).vertices
    np.testing.assert_array_equal(found[:, 2], points[:, 2])
    np.testing.assert_allclose(np.linalg.norm(found, axis=1), 5.0, atol=1e-6)


def test_a_vertex_on_an_octants_edge_is_left_alone():
    points = near_the_ball(20)
    place = np.tile([0, 2, 1], (20, 1))
    found = surface.project(surface_of(points, [], BALL, place=place)).vertices
    np.testing.assert_array_equal(found, points)


def test_no_step_is_longer_than_half_an_edge():
    far = surface_of([[9.0, 0.0, 0.0]], [], BALL, edge=1.0)
    found = surface.project(far, passes=3).vertices
    np.testing.assert_allclose(found, [[7.5, 0.0, 0.0]], atol=1e-12)


def test_what_is_held_by_two_primitives_goes_to_their_crease():
    random = np.random.default_rng(5)
    angle = random.uniform(0, 2 * np.pi, 50)
    circle = np.stack([np.zeros(50), 4 * np.cos(angle), 4 * np.sin(angle)], axis=1)
    start = surface_of(circle + random.uniform(-0.2, 0.2, (50, 3)), [], TWO_BALLS)
    held = np.tile([0, 1, -1], (50, 1))
    found = surface.project(replace(start, held=held), passes=6).vertices
    np.testing.assert_allclose(found[:, 0], 0.0, atol=1e-6)
    np.testing.assert_allclose(np.linalg.norm(found, axis=1), 4.0, atol=1e-6)


def test_a_step_to_primitives_may_stop_at_a_level():
    start = surface_of([[6.0, 0.0, 0.0]], [], BALL)
    held, loose = np.array([[0, -1, -1]]), np.ones((1, 3), bool)
    step = surface.step_to_primitives(start, start.vertices, held, loose, 0.25)
    np.testing.assert_allclose(step, [[-0.75, 0.0, 0.0]], atol=1e-5)


def test_steps_are_shortened_in_their_direction():
    found = surface.shorten_steps(
        np.array([[3.0, 4.0, 0.0], [0.3, 0.4, 0.0], [0.0, 0.0, 0.0]]), 1.0
    )
    np.testing.assert_allclose(found, [[0.6, 0.8, 0.0], [0.3, 0.4, 0.0], [0.0, 0.0, 0.0]])


def test_the_mean_of_the_neighbours_of_a_path():
    line = np.arange(4.0)[:, None] * [1.0, 2.0, 0.0]
    pairs = np.array([[0, 1], [1, 2], [2, 3]])
    mean, enough = surface.neighbour_mean(5, pairs, np.vstack([line, [[9.0, 9.0, 9.0]]]), 2)
    np.testing.assert_array_equal(enough, [False, True, True, False, False])
    np.testing.assert_allclose(mean[1:3], line[1:3])
    np.testing.assert_allclose(mean[0], line[1])


def test_ranks_and_common_faces():
    place = [[1, 1, 1], [1, 1, 1], [1, 1, 1], [0, 1, 1], [0, 2, 1], [2, 1, 1]]
    made = surface_of(near_the_ball(6), [], TWO_BALLS, place=place)
    held = made.held.copy()
    held[1, :2] = held[2, :2] = (0, 1)
    held[2, 2] = 0
    made = replace(made, held=held)
    np.testing.assert_array_equal(made.rank, [0, 1, 2, 3, 3, 3])
    one, two = np.array([3, 3, 0, 4]), np.array([4, 5, 1, 5])
    np.testing.assert_array_equal(made.share_face(one, two), [True, False, False, False])


def test_a_vertex_on_an_edge_stays_between_its_samples():
    made = surface_of([[0.0, 0.0, 1.3]], [], BALL, edge=1.0, place=[[0, 0, 1]])
    low, high = surface.between_samples(made, np.array([0]))
    np.testing.assert_allclose(low, [[0.0, 0.0, 1.0]], atol=1e-3)
    np.testing.assert_allclose(high, [[0.0, 0.0, 1.5]], atol=1e-3)
    assert low[0, 2] > 1.0
    assert high[0, 2] < 1.5


def test_a_vertex_stays_in_its_octant_and_off_its_faces(monkeypatch):
    monkeypatch.setattr(surface, "FACE_MARGIN", 0.01)
    inside = surface_of([[1.0, 2.0, 3.0]], [], BALL, size=5.0)
    kept = surface.move_vertices(inside, np.array([[-1.0, 2.5, 7.0]])).vertices
    margin = 0.01 * inside.step
    np.testing.assert_allclose(kept, [[margin, 2.5, 5.0 - margin]])

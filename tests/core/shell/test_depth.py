# SPDX-License-Identifier: LGPL-2.1-or-later
"""How deep points lie in a box, where the nearest face tells it, and in a ball."""

import numpy as np
import pytest

import samples
from volfrep.shell.depth import POINTS_PER_STEP
from volfrep.util.errors import Cancelled
from volfrep.util.progress import Monitor
from walled import depth_of

SIZE, THICKNESS = np.array([40.0, 30.0, 20.0]), 2.0


def inside(count, margin=0.5):
    return np.random.default_rng(7).uniform(margin, SIZE - margin, (count, 3))


def depth_in_the_box(points):
    return np.minimum(points, SIZE - points).min(axis=1)


@pytest.fixture(scope="module")
def box():
    return depth_of(samples.box(SIZE), THICKNESS)


def test_the_nearest_points_lie_on_the_surface(box):
    points = inside(3000)
    closest, distance = box.nearest(points)
    np.testing.assert_allclose(np.linalg.norm(closest - points, axis=1), distance, rtol=1e-12)
    np.testing.assert_allclose(depth_in_the_box(closest), 0.0, atol=1e-9)


def test_distances_are_exact_near_the_wall_and_never_too_short(box):
    points = inside(20_000)
    exact, found = depth_in_the_box(points), box.nearest(points)[1]
    assert (found >= exact - 1e-9).all()
    near = np.abs(exact - THICKNESS) < 0.2 * THICKNESS
    assert near.sum() > 1000
    assert (found - exact)[near].max() <= box.error


def test_values_are_below_0_inside_the_inner_wall_and_rise_outward(box):
    points = np.array([[20.0, 15.0, 1.0], [20.0, 15.0, 3.0], [38.5, 15.0, 10.0]])
    value, gradient = box.values(points)
    np.testing.assert_allclose(value, [1.0, -1.0, 0.5], atol=1e-9)
    np.testing.assert_allclose(gradient, [[0, 0, -1], [0, 0, -1], [1, 0, 0]], atol=1e-9)


def test_outside_the_solid_the_depth_is_below_0(box):
    value, gradient = box.values(np.array([[20.0, 15.0, -1.5]]), np.array([False]))
    np.testing.assert_allclose(value, [THICKNESS + 1.5])
    np.testing.assert_allclose(gradient, [[0.0, 0.0, -1.0]], atol=1e-9)


def test_planes_touch_the_wall(box):
    points = inside(2000, 2.0)
    anchor, normal = box.planes(points)
    np.testing.assert_allclose(np.linalg.norm(normal, axis=1), 1.0, rtol=1e-12)
    on_a_face = np.abs(normal).max(axis=1) > 1.0 - 1e-9
    assert on_a_face.mean() > 0.95
    np.testing.assert_allclose(
        np.minimum(anchor, SIZE - anchor).min(axis=1)[on_a_face], THICKNESS, atol=1e-6
    )


def test_strays_are_relative_to_the_thickness(box):
    points = np.array([[20.0, 15.0, 2.0], [20.0, 15.0, 2.2], [20.0, 15.0, 1.8]])
    np.testing.assert_allclose(box.deviation(points), [0.0, 0.1, -0.1], atol=1e-9)


def test_the_planes_of_a_ball_touch_the_smaller_ball():
    ball = depth_of(samples.sphere(20.0, 5), THICKNESS)
    direction = np.random.default_rng(1).normal(size=(500, 3))
    direction /= np.linalg.norm(direction, axis=1)[:, None]
    anchor, normal = ball.planes(18.2 * direction)
    # The icosphere's facets lie up to 20 (1 - cos 1.1 degrees) = 4e-3 mm inside the ball.
    np.testing.assert_allclose(np.linalg.norm(anchor, axis=1), 18.0, atol=6e-3)
    assert (np.einsum("ij,ij->i", normal, direction) > 0.999).all()


@pytest.mark.costly
def test_a_cancel_is_asked_for_between_steps():
    asked = []

    def callback(fraction, stage):
        asked.append(fraction)
        return len(asked) < 3

    depth = depth_of(samples.box(SIZE), THICKNESS)
    watched = type(depth)(depth.index, THICKNESS, Monitor(callback))
    with pytest.raises(Cancelled):
        watched.nearest(inside(4 * POINTS_PER_STEP))
    assert len(asked) == 3


def test_no_points_have_no_depth(box):
    closest, distance = box.nearest(np.zeros((0, 3)))
    assert closest.shape == (0, 3)
    assert distance.shape == (0,)

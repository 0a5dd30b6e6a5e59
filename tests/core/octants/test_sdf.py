# SPDX-License-Identifier: LGPL-2.1-or-later
"""The distance functions against what they are distances to."""

import numpy as np
import pytest

from implicit import field_of
from volfrep.octants import sdf


def _capped_cylinder_distance(points, start, end, radius):
    """By brute force: the nearest of many points on the cylinder's surface."""
    axis = (end - start) / np.linalg.norm(end - start)
    across = np.linalg.svd(axis[None])[2][1:]
    angle = np.linspace(0, 2 * np.pi, 200, endpoint=False)
    ring = np.cos(angle)[:, None] * across[0] + np.sin(angle)[:, None] * across[1]
    along = np.linspace(0, 1, 150)
    side = (start + along[:, None] * (end - start))[:, None] + radius * ring
    rim = np.linspace(0, 1, 40)[:, None, None] * radius * ring
    surface = np.concatenate(
        [side.reshape(-1, 3), (start + rim).reshape(-1, 3), (end + rim).reshape(-1, 3)]
    )
    return np.array([np.linalg.norm(surface - p, axis=1).min() for p in points])


def test_a_strut_is_a_capped_cylinder_with_true_distances():
    start, end, radius = np.array([1.0, 2.0, 3.0]), np.array([5.0, 3.0, 7.0]), 1.2
    points = np.random.default_rng(1).uniform(-2, 9, (200, 3))
    strut = sdf.struts(start[None], end[None], radius)
    found = sdf.distances(points, strut.take(np.zeros(200, int)))
    axial = (points - start) @ (end - start) / np.linalg.norm(end - start)
    off_axis = np.linalg.norm(np.cross(points - start, (end - start)), axis=1)
    inside = (
        (axial > 0)
        & (axial < np.linalg.norm(end - start))
        & (off_axis / np.linalg.norm(end - start) < radius)
    )
    assert (np.sign(found) == np.where(inside, -1, 1)).all()
    exact = _capped_cylinder_distance(points, start, end, radius)
    np.testing.assert_allclose(np.abs(found), exact, atol=0.03)


def test_the_caps_close_the_strut_at_both_ends():
    strut = sdf.struts(np.zeros((1, 3)), np.array([[10.0, 0, 0]]), 1.0)
    points = np.array([[-0.5, 0, 0], [0.5, 0, 0], [9.5, 0, 0], [10.5, 0, 0]])
    found = sdf.distances(points[:, None], strut)[:, 0]
    np.testing.assert_allclose(found, [0.5, -0.5, -0.5, 0.5])


def test_a_joint_sphere_is_a_sphere():
    ball = sdf.spheres(np.array([[1.0, 1, 1]]), 2.0)
    points = np.random.default_rng(2).normal(size=(50, 3)) * 3
    found = sdf.distances(points[:, None], ball)[:, 0]
    np.testing.assert_allclose(found, np.linalg.norm(points - 1, axis=1) - 2.0, atol=1e-12)


@pytest.mark.parametrize("fillet", [0.0, 0.7])
def test_gradients_are_those_of_the_values(fillet):
    rng = np.random.default_rng(3)
    start, end = rng.uniform(-4, 4, (6, 3)), rng.uniform(-4, 4, (6, 3))
    primitives = sdf.join(sdf.struts(start, end, 0.8), sdf.spheres(start, 1.0))
    points = rng.uniform(-5, 5, (300, 3))
    count = len(primitives)
    field = sdf.Field(primitives, np.arange(301) * count, np.tile(np.arange(count), 300), fillet)
    value, gradient = field.values_and_gradients(points)
    np.testing.assert_allclose(value, field.values(points), atol=1e-12)
    step = 1e-6
    numeric = np.stack(
        [
            (field.values(points + step * e) - field.values(points - step * e)) / (2 * step)
            for e in np.eye(3)
        ],
        axis=1,
    )
    # Off the creases, where the nearest primitive changes, the two agree.
    agree = np.linalg.norm(numeric - gradient, axis=1) < 1e-4
    assert agree.mean() > 0.97
    assert (agree | (np.linalg.norm(numeric, axis=1) < 0.999)).mean() > 0.97


def test_the_union_is_the_least_distance():
    values = np.array([[1.0, -0.5, 2.0]])
    assert sdf.union(values)[0] == -0.5


def test_a_fillet_rounds_a_right_angle_with_its_radius():
    # Two walls x < 0 and y < 0 (material) meet in a concave edge; the fillet's centre is (k, k).
    k = 0.8
    angle = np.linspace(np.pi, 1.5 * np.pi, 20)
    x, y = k + k * np.cos(angle), k + k * np.sin(angle)
    np.testing.assert_allclose(sdf.union(np.stack([x, y], axis=1), k), 0.0, atol=1e-12)


def test_a_fillet_leaves_a_lone_primitive_alone():
    values = np.array([[0.3, 2.0], [-0.7, 1.0], [0.9, 1.1]])
    np.testing.assert_allclose(sdf.union(values, 1.0), values.min(axis=1))


@pytest.mark.parametrize("taper", [1.0, 2.0])
@pytest.mark.parametrize("fillet", [0.0, 0.7])
def test_anchors_spare_no_primitive_that_matters(fillet, taper):
    rng = np.random.default_rng(8)
    start, end = rng.uniform(-6, 6, (30, 3)), rng.uniform(-6, 6, (30, 3))
    ends = np.tile([0.4, 0.4 * taper], (30, 1))
    primitives = sdf.join(sdf.struts(start, end, ends), sdf.spheres(start, 0.9))
    places = rng.uniform(-6, 6, (200, 3))
    plain = field_of(primitives, len(places), fillet)
    anchored = plain.anchored(places)
    points = places + rng.normal(size=places.shape) * rng.choice([0.0, 0.1, 1.0], (200, 1))
    assert len(anchored._pairs(points)[0]) < 0.6 * len(plain._pairs(points)[0])
    np.testing.assert_allclose(anchored.values(points), plain.values(points), atol=1e-13)
    for one, two in zip(anchored.nearest(points), plain.nearest(points), strict=True):
        np.testing.assert_array_equal(one, two)
    np.testing.assert_array_equal(anchored.touching(points, 0.3), plain.touching(points, 0.3))
    pairs = zip(
        anchored.values_and_gradients(points), plain.values_and_gradients(points), strict=True
    )
    for one, two in pairs:
        np.testing.assert_allclose(one, two, atol=1e-12)
    group = points[:, None] + rng.uniform(-0.4, 0.4, (200, 5, 3))
    np.testing.assert_allclose(
        anchored.values_of_groups(group), plain.values_of_groups(group), atol=1e-13
    )
    some = rng.integers(0, 200, 50)
    joined = anchored.rows(some).joined(anchored.rows(some))
    assert joined.anchors is not None
    np.testing.assert_allclose(
        joined.values(np.tile(points[some], (2, 1))),
        np.tile(plain.rows(some).values(points[some]), 2),
        atol=1e-13,
    )

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Large facets near small ones are divided, on the same surface."""

import numpy as np
import pytest

import samples
from volfrep.fem.facet_grading import GRADIENT, LONGEST, grade_facets
from volfrep.mesh.quality import measure
from volfrep.mesh.triangle_mesh import TriangleMesh, concatenate
from volfrep.mesh.well_shaped import angles_of

#: The ball's middle, its radius, and the plate's upper side, mm.
HEIGHT, RADIUS, TOP = 6.0, 2.0, 2.0


@pytest.fixture(scope="module")
def ball_over_a_plate():
    ball = samples.sphere(RADIUS, 3)
    ball = TriangleMesh(ball.vertices + np.array((20.0, 20.0, HEIGHT)), ball.triangles)
    return concatenate(samples.box((40.0, 40.0, TOP)), ball)


@pytest.fixture(scope="module")
def result(ball_over_a_plate):
    return grade_facets(ball_over_a_plate)


def lengths(mesh):
    corners = mesh.vertices[mesh.triangles]
    return np.linalg.norm(corners - np.roll(corners, -1, axis=1), axis=2)


def test_facets_are_small_beside_small_ones_and_large_away_from_them(ball_over_a_plate, result):
    small = lengths(ball_over_a_plate)[12:].mean()
    plate = result.vertices[result.triangles].mean(axis=1)[:, 2] <= TOP
    longest = lengths(result)[plate].max(axis=1)
    corners = result.vertices[result.triangles[plate]]
    apart = np.linalg.norm(corners - (20.0, 20.0, HEIGHT), axis=2).max(axis=1) - RADIUS
    assert (longest <= 1.3 * LONGEST * (small + GRADIENT * apart)).all()
    assert longest.min() < 4.0
    assert longest.max() > 10.0


def test_the_surface_is_the_same(ball_over_a_plate, result):
    was, now = measure(ball_over_a_plate), measure(result)
    assert now.watertight
    assert (now.bodies, now.genus) == (was.bodies, was.genus)
    assert now.volume == pytest.approx(was.volume, rel=1e-12)
    assert now.area == pytest.approx(was.area, rel=1e-12)
    count = len(ball_over_a_plate.vertices)
    assert np.array_equal(result.vertices[:count], ball_over_a_plate.vertices)


def test_it_makes_no_needles_and_few_facets(ball_over_a_plate, result):
    corners = result.vertices[result.triangles]
    before = angles_of(ball_over_a_plate.vertices[ball_over_a_plate.triangles])
    # Longest edges halved never give less than half of the least angle there was.
    assert angles_of(corners).min() >= 0.5 * before.min()
    assert len(result.triangles) < len(ball_over_a_plate.triangles) + 1500


def test_facets_of_like_size_stay():
    """Of equal edges, too: all of them are the longest there."""
    ball = samples.sphere(10.0, 3)
    assert np.array_equal(grade_facets(ball).triangles, ball.triangles)
    box = samples.box((10.0, 10.0, 10.0))
    assert np.array_equal(grade_facets(box).triangles, box.triangles)
    empty = TriangleMesh(np.zeros((0, 3)), np.zeros((0, 3), np.int32))
    assert grade_facets(empty) is empty

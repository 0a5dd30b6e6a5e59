# SPDX-License-Identifier: LGPL-2.1-or-later
"""Large cubes where a surface is plain, and no smaller detail is lost between their corners."""

import math

import numpy as np
import pytest

import samples
from volfrep.shell.offset import find_cavity
from volfrep.shell.sampled_depth import cube_grid
from volfrep.shell.smooth_regions import find_smooth_regions
from volfrep.spatial.proximity import closest_points, index_surface, sample_triangles
from volfrep.spatial.rays import inside_points
from volfrep.spatial.self_intersection import crossing_triangles
from volfrep.util.progress import Monitor
from walls import wall_errors

SKIN = 0.3


def found(solid, skin=SKIN):
    cube = 0.8 * skin
    low, high = solid.bounds
    start, _, top = cube_grid(low, high, skin, cube)
    return find_smooth_regions(solid, start, cube, top, skin, 0.3 * skin, math.inf, Monitor()), cube


@pytest.mark.slow
def test_a_sheet_needs_few_cubes_and_few_samples():
    solid = samples.sheet()
    plain, cube = found(solid)
    assert plain.cubes < 0.5 * solid.area / cube**2
    everywhere = sample_triangles(np.stack(solid.corners(), axis=1), 0.3 * SKIN)[0]
    assert len(plain.samples) < 0.8 * len(everywhere)
    distance = closest_points(solid, plain.samples[::50])[1]
    assert distance.max() < 1e-4  # needles of the triangulation cost digits


@pytest.mark.slow
def test_the_distance_to_a_surface_with_fewer_samples_is_right_where_the_wall_is():
    solid = samples.sheet((28.0, 28.0, 3.0))
    plain, _ = found(solid)
    index = index_surface(solid, 0.3 * SKIN, (plain.samples, plain.owner))
    wall = find_cavity(solid, SKIN, Monitor()).mesh
    random = np.random.default_rng(3)
    at = wall.vertices[wall.triangles].mean(axis=1)[random.integers(0, len(wall.triangles), 4000)]
    at += random.normal(0.0, 0.3 * SKIN, at.shape)
    exact = closest_points(solid, at)[1]
    near = index.near(at)[1]
    assert np.abs(near - exact).max() < 0.03 * SKIN
    assert np.mean(near - exact > 1e-9) < 0.02


@pytest.mark.slow_cases("0.3")
@pytest.mark.parametrize("skin", [pytest.param(0.15, marks=pytest.mark.slow), 0.3])
def test_the_wall_of_a_sheet_is_right_round_a_small_hole_too(skin):
    solid = samples.sheet((30.0, 30.0, 3.0))
    wall = find_cavity(solid, skin, Monitor())
    errors = np.abs(wall_errors(solid, wall.mesh, skin))
    assert errors.max() < 0.05
    assert np.quantile(errors, 0.99) < 0.02
    assert not crossing_triangles(
        wall.mesh, np.ones(len(wall.mesh.triangles), bool), 1e-5 * skin
    ).any()
    # Closed form: a box with rounded edges round two holes grown by the skin.
    around = sum(math.pi * (radius + skin) ** 2 for radius in (4.0, 0.6))
    inner = (30.0 - 2 * skin) ** 2 - around
    assert wall.mesh.volume == pytest.approx(inner * (3.0 - 2 * skin), rel=1e-3)


def test_signs_by_the_surface_are_those_by_lines():
    solid = samples.bracket(13.0)
    index = index_surface(solid, 0.5)
    low, high = solid.bounds
    points = np.random.default_rng(5).uniform(low - 5.0, high + 5.0, (20_000, 3))
    assert np.array_equal(index.below(points), inside_points(solid, points, Monitor()))

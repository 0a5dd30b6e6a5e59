# SPDX-License-Identifier: LGPL-2.1-or-later
"""Walls with fewer facets: flat faces in a few, nothing moved, nothing that runs through itself."""

import numpy as np
import pytest
import trimesh

import samples
from volfrep.shell import decimation as simplify
from volfrep.shell.adaptive_contour import find_offset_surface
from volfrep.spatial.self_intersection import crossing_triangles
from walled import field_of

SIZE = np.array([40.0, 30.0, 20.0])


def made(part, thickness):
    field = field_of(part, thickness)
    wall = find_offset_surface(field)
    return wall.facets.mesh, simplify.simplify(wall, field)


def as_trimesh(mesh):
    return trimesh.Trimesh(mesh.vertices, mesh.triangles, process=False)


def test_a_box_needs_hardly_more_than_twelve_facets():
    before, after = made(samples.box(SIZE), 2.0)
    assert len(before.triangles) > 2000
    assert len(after.triangles) < 40
    found = as_trimesh(after)
    assert found.is_watertight
    assert found.volume == pytest.approx(np.prod(SIZE - 4.0), rel=1e-6)


@pytest.mark.costly
@pytest.mark.slow_but("17.0")
@pytest.mark.parametrize("turn", [0.0, 17.0])
def test_a_bracket_keeps_its_wall(turn):
    before, after = made(samples.bracket(turn), 1.5)
    found = as_trimesh(after)
    assert found.is_watertight
    assert len(after.triangles) < 0.2 * len(before.triangles)
    assert found.volume == pytest.approx(before.volume, rel=2e-3)
    assert not crossing_triangles(after, np.ones(len(after.triangles), bool), 1e-4).any()


def test_a_ball_is_not_moved_further_than_it_may():
    thickness = 2.0
    before, after = made(samples.sphere(20.0, 5), thickness)
    assert len(after.triangles) < len(before.triangles)
    reach = np.linalg.norm(after.vertices, axis=1)
    may = simplify.TOLERANCE * thickness
    first = np.linalg.norm(before.vertices, axis=1)
    assert first.min() - may < reach.min()
    assert reach.max() < first.max() + may
    assert as_trimesh(after).euler_number == 2

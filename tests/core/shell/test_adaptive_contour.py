# SPDX-License-Identifier: LGPL-2.1-or-later
"""The wall of solids whose inner wall is known: cubes are halved until it is where it should be."""

import manifold3d
import numpy as np
import pytest
import trimesh

import samples
from volfrep.mesh.booleans import as_mesh
from volfrep.shell import adaptive_contour as refine
from volfrep.shell.sampled_depth import COARSEST
from walled import field_of

SIZE = np.array([40.0, 30.0, 20.0])


def as_trimesh(wall):
    mesh = wall.facets.mesh
    return trimesh.Trimesh(mesh.vertices, mesh.triangles, process=False)


@pytest.mark.parametrize("thickness", [1.5, 4.0])
def test_the_wall_of_a_box_is_the_smaller_box(thickness):
    found = as_trimesh(refine.find_offset_surface(field_of(samples.box(SIZE), thickness)))
    assert found.is_watertight
    assert found.volume == pytest.approx(np.prod(SIZE - 2 * thickness), rel=1e-4)
    np.testing.assert_allclose(found.bounds, [[thickness] * 3, SIZE - thickness], atol=1e-3)


def test_the_wall_of_a_ball_strays_no_further_than_it_may():
    field = field_of(samples.sphere(20.0, 5), 2.0)
    wall = refine.find_offset_surface(field)
    found = as_trimesh(wall)
    assert found.is_watertight
    assert found.euler_number == 2
    points = found.triangles_center
    assert np.abs(np.linalg.norm(points, axis=1) - 18.0).max() < refine.DEVIATION_SMALL * 2.0
    assert np.abs(field.depth.deviation(found.vertices)).max() < refine.DEVIATION_SMALL


@pytest.mark.slow
def test_the_wall_about_a_cone_strays_no_further_where_halved_cubes_lie_beside_smaller_ones():
    """Such cubes may have no edge of their own that was not looked at before."""
    cone = manifold3d.Manifold.cylinder(20.0, 6.0, 3.0, 24).translate((0.0, 0.0, -3.0))
    solid = as_mesh(manifold3d.Manifold.cube((14.0, 14.0, 14.0), True) - cone)
    field = field_of(solid, 0.8, cube=0.64)
    vertices = refine.find_offset_surface(field).facets.mesh.vertices
    assert np.abs(field.depth.deviation(vertices)).max() < refine.DEVIATION_SMALL


@pytest.mark.costly
def test_cubes_are_halved_where_the_wall_is_bent_and_not_where_it_is_flat():
    """In a box at the edges only, in a plate with holes along these as well."""
    for part, bent in ((samples.box(SIZE), 0.15), (samples.plate(128), 0.4)):
        field = field_of(part, 2.0)
        edges = refine.find_offset_surface(field).crossings.edges
        fine = edges.size < COARSEST
        assert 0 < fine.mean() < bent
        low, high = part.bounds[0] + 2.0, part.bounds[1] - 2.0
        ends = field.point(edges.low[~fine])
        flat = np.minimum(np.abs(ends - low), np.abs(high - ends)) > 2 * COARSEST * field.unit
        assert (flat.sum(axis=1) == 2).mean() > 0.6


def test_a_cavity_thinner_than_a_cube_is_found():
    plate = samples.box((30.0, 30.0, 4.3))
    found = as_trimesh(refine.find_offset_surface(field_of(plate, 2.0, cube=1.7)))
    assert found.is_watertight
    assert found.volume == pytest.approx(26.0 * 26.0 * 0.3, rel=1e-3)


def test_where_nothing_is_so_deep_there_is_no_wall():
    wall = refine.find_offset_surface(field_of(samples.box((30.0, 30.0, 3.0)), 2.0))
    assert len(wall.facets.mesh.triangles) == 0
    assert len(wall.crossings.edges.axis) == 0

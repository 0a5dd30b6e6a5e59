# SPDX-License-Identifier: LGPL-2.1-or-later
"""Of a solid of few plane faces the inner wall is exact: closed forms, and distances at it."""

import manifold3d
import numpy as np
import pytest
import trimesh

import samples
from volfrep.design.skins.plane_faces import (
    PLANE,
    few_plane_faces,
    find_plane_faces,
    least_faces,
)
from volfrep.mesh.booleans import as_mesh
from volfrep.mesh.triangle_mesh import TriangleMesh
from volfrep.shell.moved_faces import move_faces
from volfrep.shell.offset import find_cavity
from volfrep.spatial.proximity import closest_points, neighbours
from volfrep.util.progress import Monitor
from walls import wall_errors


def moved(solid, thickness):
    faces = find_plane_faces(solid, thickness)
    return move_faces(faces, thickness, Monitor())


def check_wall(solid, wall, thickness):
    """Closed, and as deep at random points and at every vertex as it should be."""
    mesh = trimesh.Trimesh(wall.vertices, wall.triangles, process=False)
    assert mesh.is_watertight
    assert mesh.is_winding_consistent
    assert np.abs(wall_errors(solid, wall, thickness, 4000)).max() < 0.011
    at_corners = closest_points(solid, wall.vertices)[1] / thickness
    np.testing.assert_allclose(at_corners, 1.0, atol=0.011)
    return mesh


def pocketed(size, pocket, turn=(0.0, 0.0, 0.0)):
    """A box with a pocket of some length, width and depth in the middle of its top."""
    solid = manifold3d.Manifold.cube(size)
    corner = [(size[0] - pocket[0]) / 2, (size[1] - pocket[1]) / 2, size[2] - pocket[2]]
    solid -= manifold3d.Manifold.cube((*pocket[:2], 2 * pocket[2])).translate(corner)
    return as_mesh(solid.rotate(turn))


@pytest.mark.parametrize("turn", [(0.0, 0.0, 0.0), (10.0, 20.0, 30.0)])
def test_a_pocket_has_its_edges_and_corners_rounded_below(turn):
    (a, b, c), (p, q, d), t = (40.0, 30.0, 20.0), (14.0, 10.0, 8.0), 2.0
    solid = pocketed((a, b, c), (p, q, d), turn)
    wall = moved(solid, t)
    assert check_wall(solid, wall, t).euler_number == 2
    low = d - t
    around = (p * q + 2 * (p + q) * t + np.pi * t**2) * low
    below = p * q * t + 2 * (p + q) * np.pi * t**2 / 4 + 2.0 / 3.0 * np.pi * t**3
    inner = (a - 2 * t) * (b - 2 * t) * (c - 2 * t)
    assert wall.volume == pytest.approx(inner - around - below, rel=2e-4)


def test_facets_of_one_face_count_as_one():
    """However a flat face was cut into facets, needles or not, one prism goes below it."""
    solid = pocketed((40.0, 30.0, 20.0), (14.0, 10.0, 8.0))
    faces = find_plane_faces(solid, 1.0)
    assert len(faces.normal) == 11
    assert len(faces.edges) == 8
    assert len(faces.corners) == 4
    divided = trimesh.Trimesh(solid.vertices, solid.triangles, process=False).subdivide()
    finer = TriangleMesh(np.asarray(divided.vertices), np.asarray(divided.faces, np.int32))
    assert len(finer.triangles) == 4 * len(solid.triangles)
    assert len(find_plane_faces(finer, 1.0).normal) == 11


def test_what_is_thin_everywhere_leaves_nothing():
    assert not len(moved(samples.box((20.0, 20.0, 4.0)), 2.1).triangles)


@pytest.mark.costly
def test_a_thin_skin_of_a_large_sheet_has_its_faces_moved():
    size, t = (60.0, 70.0, 3.0), 0.1
    solid, monitor = samples.sheet(size), Monitor()
    wall = find_cavity(solid, t, monitor)
    assert monitor.work["bodies that a wall was cut with"] < 300
    assert wall.worst < 0.005
    assert check_wall(solid, wall.mesh, t).euler_number == 2 - 2 * 2
    around = sum(np.pi * (radius + t) ** 2 for radius in (4.0, 0.6))
    inner = ((size[0] - 2 * t) * (size[1] - 2 * t) - around) * (size[2] - 2 * t)
    assert wall.mesh.volume == pytest.approx(inner, rel=1e-4)
    a, b, c = wall.mesh.corners()
    longest = np.linalg.norm(np.stack([b - a, c - b, a - c]), axis=2).max()
    assert longest < np.linalg.norm(np.ptp(solid.bounds, axis=0)) / 15, "no needles along the sheet"
    assert len(wall.mesh.triangles) < 30_000


def test_a_plate_has_its_faces_moved_where_cubes_would_take_longer():
    """Cubes had errors of 1.9 % beside the holes; and of the box, whose wall is exact now."""
    plate = manifold3d.Manifold.cube((108.0, 108.0, 6.4))
    for x in (20.0, 88.0):
        plate -= manifold3d.Manifold.cylinder(20.0, 6.0, 6.0, 30).translate((x, 54.0, -5.0))
    plate, t, monitor = as_mesh(plate), 0.5, Monitor()
    wall = find_cavity(plate, t, monitor)
    assert monitor.work["bodies that a wall was cut with"] < 200
    assert wall.worst < 0.002
    assert check_wall(plate, wall.mesh, t).euler_number == 2 - 2 * 2
    assert few_plane_faces(samples.box((100.0, 100.0, 3.0)), 0.5).bodies == 6


def test_of_a_round_solid_it_is_known_early_that_it_has_many_faces():
    ball = samples.sphere(20.0, 4)
    assert few_plane_faces(ball, 0.1) is None
    assert find_plane_faces(ball, 0.1, most=100) is None
    assert len(find_plane_faces(ball, 0.1, most=20_000).normal) > 1000
    assert least_faces(ball, neighbours(ball), PLANE * 0.1) > 1000


@pytest.mark.parametrize("thickness", [0.1, 3.0, 50.0])
def test_no_more_faces_are_foretold_than_there_are(thickness):
    ball, some = samples.sphere(20.0, 3), np.random.default_rng(3)
    rough = TriangleMesh(
        ball.vertices + some.normal(0.0, 0.02, ball.vertices.shape), ball.triangles
    )
    for solid in (ball, rough, samples.bracket(17.0), samples.box((20.0, 30.0, 5.0))):
        faces = find_plane_faces(solid, thickness, 10**6)
        least = least_faces(solid, neighbours(solid), PLANE * thickness)
        assert 1 <= least <= len(faces.normal)


def test_an_ordinary_skin_is_found_by_cubes():
    monitor = Monitor()
    find_cavity(samples.box(), 2.0, monitor)
    assert "bodies that a wall was cut with" not in monitor.work

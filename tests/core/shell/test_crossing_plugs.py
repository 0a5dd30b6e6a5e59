# SPDX-License-Identifier: LGPL-2.1-or-later
"""No facets of a wall run through each other, after a number of rounds that is known beforehand."""

import manifold3d
import numpy as np
import pytest
import trimesh

import samples
from volfrep.mesh.triangle_mesh import TriangleMesh, concatenate
from volfrep.shell import crossing_plugs
from volfrep.shell.crossing_plugs import crossed_along, find_new_crossings, without_crossings
from volfrep.shell.offset import find_cavity
from volfrep.spatial.piercing import piercing_pairs
from volfrep.util.progress import Monitor
from walls import wall_errors


def overlapping_spheres(shift=19.6):
    """Two spheres that share a lens of 0.4, as one mesh."""
    one = samples.sphere(10.0, 3)
    two = TriangleMesh(one.vertices + np.array([shift, 0.013, 0.027]), one.triangles)
    return concatenate(one, two)


def is_manifold(mesh):
    solid = manifold3d.Mesh64(mesh.vertices, mesh.triangles.astype(np.uint64))
    return manifold3d.Manifold(solid).status() == manifold3d.Error.NoError


@pytest.mark.slow
def test_a_housing_whose_walls_are_hardly_thicker_than_two_skins():
    solid, thickness = samples.housing(), 5.0
    monitor = Monitor()
    wall = find_cavity(solid, thickness, monitor)
    assert not len(piercing_pairs(wall.mesh))
    assert trimesh.Trimesh(wall.mesh.vertices, wall.mesh.triangles, process=False).is_watertight
    assert np.abs(wall_errors(solid, wall.mesh, thickness)).max() < 0.05
    assert wall.worst < 0.05
    assert 1 <= monitor.work["times the wall was drawn apart"] <= crossing_plugs.ROUNDS


def test_rounds_that_change_nothing_end_all_the_same(monkeypatch):
    mesh, monitor = overlapping_spheres(), Monitor()
    monkeypatch.setattr(
        crossing_plugs, "resolve_fold_crossings", lambda mesh, monitor, folded: (mesh, None)
    )
    monkeypatch.setattr(crossing_plugs, "_less", lambda mesh, sizes, places: mesh)
    assert without_crossings(mesh, 10.0, monitor) is mesh
    assert monitor.work["times the wall was drawn apart"] == crossing_plugs.ROUNDS


def test_what_is_known_of_a_mesh_is_enough_to_judge_one_that_differs_little():
    mesh = overlapping_spheres()
    before = find_new_crossings(mesh, Monitor())
    moved = mesh.vertices.copy()
    moved[np.argmax(moved[:, 0])] += [0.3, 0.2, 0.1]
    other = TriangleMesh(moved, mesh.triangles[::-1])
    again = find_new_crossings(other, Monitor(), before)
    assert len(before.pairs)
    assert np.array_equal(again.pairs, piercing_pairs(other))


def test_two_triangles_cross_along_what_their_planes_have_in_common():
    """One stands upright on x = 0.5 to 3 in the other's plane, which reaches to x = 2 there."""
    corners = [[0, -2, 0], [4, -2, 0], [0, 2, 0], [-0.5, 0, -1], [4, 0, -1], [1.75, 0, 1]]
    mesh = TriangleMesh(np.array(corners, float), np.array([[0, 1, 2], [3, 4, 5]], np.int32))
    ends = np.stack(crossed_along(mesh, np.array([[0, 1]])))[:, 0]
    expected = [[0.625, 0.0, 0.0], [2.0, 0.0, 0.0]]
    np.testing.assert_allclose(sorted(ends.tolist()), expected, atol=1e-12)


def test_spheres_that_overlap_by_a_hair_are_drawn_apart():
    mesh = overlapping_spheres(19.99)
    apart = without_crossings(mesh, 10.0, Monitor())
    assert len(piercing_pairs(mesh))
    assert not len(piercing_pairs(apart))
    assert len(apart.vertices) == len(mesh.vertices)
    assert np.abs(apart.vertices - mesh.vertices).max() < 0.3


def test_what_cannot_be_drawn_apart_goes_with_a_little_of_the_room_about_it(monkeypatch):
    monkeypatch.setattr(
        crossing_plugs, "resolve_fold_crossings", lambda mesh, monitor, folded: (mesh, None)
    )
    mesh = overlapping_spheres()
    plugged = without_crossings(mesh, 10.0, Monitor())
    assert len(piercing_pairs(mesh))
    assert not len(piercing_pairs(plugged))
    assert is_manifold(plugged)
    # One flat box about the lens of 5.6 across and 0.4 thick.
    assert plugged.volume == pytest.approx(mesh.volume, rel=3e-3)
    assert plugged.volume < mesh.volume

# SPDX-License-Identifier: LGPL-2.1-or-later
"""A wall gets fewer facets, none of which cross, in a number of tries that is known beforehand."""

import manifold3d
import numpy as np
import pytest
import trimesh

import samples
from volfrep.mesh.triangle_mesh import TriangleMesh
from volfrep.shell import wall_decimation as simplify
from volfrep.shell.crossing_plugs import without_crossings
from volfrep.shell.offset import inner_wall
from volfrep.shell.wall_crossings import judged
from volfrep.spatial.self_intersection import crossing_triangles
from volfrep.util.progress import Monitor
from walls import wall_errors

DEPTH = 1e-5


def crossing(mesh):
    return crossing_triangles(mesh, np.ones(len(mesh.triangles), bool), DEPTH)


def overlapping_spheres():
    """Two spheres that share a lens of 0.4, as one mesh."""
    one = samples.sphere(10.0, 3)
    return TriangleMesh(
        np.concatenate([one.vertices, one.vertices + np.array([19.6, 0.013, 0.027])]),
        np.concatenate([one.triangles, one.triangles + len(one.vertices)]),
    )


@pytest.mark.slow
def test_a_housing_whose_walls_are_hardly_thicker_than_two_skins():
    solid, thickness = samples.housing(), 5.0
    monitor = Monitor()
    wall = inner_wall(solid, thickness, monitor)
    assert not crossing(wall.mesh).any()
    assert trimesh.Trimesh(wall.mesh.vertices, wall.mesh.triangles, process=False).is_watertight
    assert np.abs(wall_errors(solid, wall.mesh, thickness)).max() < 0.05
    assert wall.worst < 0.05
    assert 1 < monitor.work["simplifications of the wall"] <= simplify.TRIES


def test_tries_that_each_leave_one_crossing_less_end_all_the_same(monkeypatch):
    """The case that did not end: 10,000 tries would go by, each a little better than the last."""
    left = iter(range(10_000, 0, -1))

    def one_less(mesh, depth, before):
        found = judged(mesh, depth, before)
        crossed = np.zeros(len(mesh.triangles), bool)
        crossed[: min(next(left), len(crossed))] = True
        return type(found)(found.names, crossed, found.edge_of, found.through, found.points)

    monkeypatch.setattr(simplify, "judged", one_less)
    monkeypatch.setattr(simplify, "without_crossings", lambda mesh, known, thickness: mesh)
    monitor = Monitor()
    inner_wall(samples.plate(32), 2.0, monitor)
    assert monitor.work["simplifications of the wall"] <= simplify.TRIES


def test_what_is_known_of_a_mesh_is_enough_to_judge_one_that_differs_little():
    mesh = overlapping_spheres()
    before = judged(mesh, DEPTH)
    moved = mesh.vertices.copy()
    moved[np.argmax(moved[:, 0])] += [0.3, 0.2, 0.1]
    other = TriangleMesh(moved, mesh.triangles[::-1])
    again = judged(other, DEPTH, before)
    assert before.crossed.any()
    assert np.array_equal(again.crossed, crossing(other))


def test_crossing_facets_go_with_a_little_of_the_room_about_them():
    mesh = overlapping_spheres()
    thickness = 10.0
    plugged = without_crossings(mesh, judged(mesh, DEPTH), thickness)
    assert crossing(mesh).any()
    assert not crossing(plugged).any()
    solid = manifold3d.Mesh64(plugged.vertices, plugged.triangles.astype(np.uint64))
    assert manifold3d.Manifold(solid).status() == manifold3d.Error.NoError
    # The ring in which they cross is 5.6 across: boxes of a few tenths along it.
    assert plugged.volume == pytest.approx(mesh.volume, rel=2e-3)
    assert plugged.volume < mesh.volume

# SPDX-License-Identifier: LGPL-2.1-or-later
import numpy as np
import pytest

import samples
from volfrep.mesh.triangle_mesh import TriangleMesh, concatenate
from volfrep.spatial import self_intersection
from volfrep.spatial.piercing import piercing_pairs
from volfrep.spatial.self_intersection import about, close_pairs, crossing_triangles
from volfrep.util.parallel import ParallelBackend


def everywhere(mesh):
    return np.ones(len(mesh.triangles), bool)


def test_clean_surfaces_do_not_cross():
    for part in (samples.plate(48), samples.sphere(subdivisions=3), samples.bracket(33.0)):
        assert not crossing_triangles(part, everywhere(part), 1e-9).any()


def test_two_boxes_that_overlap_cross_where_they_meet():
    a, b = samples.box(), samples.box((40.0, 30.0, 20.0), (20.0, 5.0, 7.0))
    both = concatenate(a, b)
    crossing = crossing_triangles(both, everywhere(both), 1e-9)
    assert crossing[: len(a.triangles)].any()
    assert crossing[len(a.triangles) :].any()
    # The far end faces of either box touch nothing of the other.
    for plane in (0.0, 60.0):
        far = (both.vertices[both.triangles][:, :, 0] == plane).all(axis=1)
        assert far.any()
        assert not crossing[far].any()


def test_a_spike_through_the_other_side_is_found_from_its_own_triangles():
    part = samples.sphere(20.0, 3)
    vertices = part.vertices.copy()
    top = int(vertices[:, 2].argmax())
    vertices[top] = [0.3, 0.2, -25.0]
    bent = TriangleMesh(vertices, part.triangles)
    spike = (bent.triangles == top).any(axis=1)
    crossing = crossing_triangles(bent, spike, 1e-6)
    assert crossing[spike].any()
    assert crossing[~spike].any()
    np.testing.assert_array_equal(crossing, crossing_triangles(bent, everywhere(bent), 1e-6))
    assert not crossing_triangles(bent, ~everywhere(bent), 1e-6).any()


def scattered(count):
    """Triangles of very different sizes all over a cube, and which of them have boxes that meet."""
    random = np.random.default_rng(0)
    size = np.exp(1.2 * random.normal(size=(count, 1, 1)) - 3.0)
    corners = random.random((count, 1, 3)) + size * random.normal(size=(count, 3, 3))
    low, high = corners.min(axis=1), corners.max(axis=1)
    meets = ((low[:, None] <= high[None]) & (low[None] <= high[:, None])).all(axis=2)
    return corners, meets & ~np.eye(count, dtype=bool)


@pytest.mark.parametrize("share", [0.02, 0.4, 1.0])
def test_pairs_whose_boxes_meet_and_that_have_a_chosen_triangle_come_once(share):
    corners, meets = scattered(400)
    chosen = np.random.default_rng(1).random(len(corners)) < share
    found = np.zeros(meets.shape, int)
    for one, other in close_pairs(corners, chosen):
        np.add.at(found, (one, other), 1)
        np.add.at(found, (other, one), 1)
    np.fill_diagonal(found, 0)
    assert chosen.any()
    np.testing.assert_array_equal(found, meets & (chosen[:, None] | chosen[None]))


@pytest.mark.parametrize("which", [slice(0, 5), slice(-5, None), slice(190, 195)])
def test_what_lies_about_a_few_triangles_holds_all_that_cross_them(which):
    corners, _ = scattered(400)
    mesh = TriangleMesh(corners.reshape(-1, 3), np.arange(1200, dtype=np.int32).reshape(-1, 3))
    chosen = np.zeros(len(corners), bool)
    chosen[np.ptp(corners, axis=1).max(axis=1).argsort()[which]] = True
    near = about(mesh, chosen)
    assert near[chosen].all()
    pairs = piercing_pairs(mesh)
    crossing = chosen[pairs].any(axis=1)
    assert crossing.any() or which == slice(0, 5)
    assert near[pairs[crossing]].all()
    assert not near.all()


def test_processes_that_look_at_a_few_triangles_each_find_all_that_cross_the_chosen(monkeypatch):
    monkeypatch.setattr(self_intersection, "CALL_TRIANGLES", 150)
    corners, _ = scattered(400)
    mesh = TriangleMesh(corners.reshape(-1, 3), np.arange(1200, dtype=np.int32).reshape(-1, 3))
    chosen = np.zeros(len(corners), bool)
    chosen[np.ptp(corners, axis=1).max(axis=1).argsort()[-3:]] = True
    calls = []

    class Processes(ParallelBackend):
        uses_processes = True

        def starmap(self, function, given):
            calls.extend(given)
            return (function(*each) for each in calls)

    near = about(mesh, chosen, Processes())
    assert len(calls) == 3
    assert near[chosen].all()
    pairs = piercing_pairs(mesh)
    crossing = chosen[pairs].any(axis=1)
    assert crossing.any()
    assert near[pairs[crossing]].all()
    assert not near.all()


def test_a_large_triangle_is_near_what_is_at_its_plane_and_not_what_is_in_its_box():
    small = samples.sphere(1.0, 1)
    places = np.array([[20.0, 20.0, 60.0], [40.0, 40.0, 20.0], [90.0, 90.0, 95.0]])
    balls = concatenate(*(TriangleMesh(small.vertices + at, small.triangles) for at in places))
    large = TriangleMesh(np.diag([100.0, 100.0, 100.0]), np.array([[0, 1, 2]], np.int32))
    mesh = concatenate(balls, large)
    chosen = np.arange(len(mesh.triangles)) == len(mesh.triangles) - 1
    for flat in (False, True):  # without a plane all of its box is near
        if flat:
            mesh.vertices[-1] = mesh.vertices[-3:-1].mean(axis=0)
        near = about(mesh, chosen)[:-1].reshape(3, -1)
        assert near[0].any() != flat
        assert not near[2].any()
        assert not near[1].any() or not flat

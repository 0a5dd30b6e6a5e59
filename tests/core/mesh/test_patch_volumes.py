"""The volume of patches: given back where points may go, by heights that are known."""

import numpy as np
import pytest

import samples
from volfrep.mesh.patch_volumes import with_volumes
from volfrep.mesh.triangle_mesh import TriangleMesh

DEPTH = 0.1


def dented(chosen):
    """A ball, a point below the middle of each of some of its facets, and the facets to it."""
    ball = samples.sphere(5.0, 2)
    corners = ball.vertices[ball.triangles[chosen]]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    points = np.concatenate([ball.vertices, corners.mean(axis=1) - DEPTH * normal])
    new = len(ball.vertices) + np.arange(len(chosen))
    a, b, c = ball.triangles[chosen].T
    sides = [np.stack([one, two, new], axis=1) for one, two in ((a, b), (b, c), (c, a))]
    after = np.concatenate([np.delete(ball.triangles, chosen, axis=0), *sides])
    free = np.arange(len(points)) >= len(ball.vertices)
    return ball, points, after.astype(np.int64), free


def restored(chosen, most=1.0, faulty=(), asked=None):
    ball, points, after, free = dented(chosen)

    def find_faults(mesh, new):
        if asked is not None:
            asked.append(new.copy())
        # Its points are faulty as long as they move.
        gone = (mesh.vertices != points).any(axis=1)
        gone[np.setdiff1d(np.arange(len(points)), len(ball.vertices) + np.array(faulty, int))] = 0
        return gone[mesh.triangles].any(axis=1)

    before = ball.triangles.astype(np.int64)
    moved = with_volumes(
        points, before, after, free, lambda places: np.full(len(places), most), find_faults
    )
    assert np.array_equal(moved[~free], points[~free])
    return ball, TriangleMesh(moved, after.astype(np.int32)), np.linalg.norm(moved - points, axis=1)


def test_dents_are_lifted_by_their_depth():
    ball, mesh, far = restored([3, 40, 77])
    assert far[-3:] == pytest.approx(DEPTH)
    assert mesh.volume == pytest.approx(ball.volume, rel=1e-12)


def test_no_point_goes_farther_than_it_may():
    assert restored([3, 40], most=0.4 * DEPTH)[2][-2:] == pytest.approx(0.4 * DEPTH)


def test_where_it_has_a_fault_a_point_stays_and_others_go():
    asked = []
    _, _, far = restored([3, 40, 77], faulty=[1], asked=asked)
    assert far[-3:] == pytest.approx([DEPTH, 0.0, DEPTH])
    # Only what has moved is looked at: three facets about each point.
    assert [new.sum() for new in asked] == [9, 6]


def test_what_has_not_changed_stays():
    ball = samples.sphere(5.0, 1)
    triangles = ball.triangles.astype(np.int64)
    everywhere = np.ones(len(ball.vertices), bool)

    def refuse(*_):
        raise AssertionError("nothing has moved")

    moved = with_volumes(ball.vertices, triangles, triangles, everywhere, len, refuse)
    assert moved is ball.vertices

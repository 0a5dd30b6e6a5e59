"""A surface changed in two places: each is a patch, and that with a fault is taken back."""

import numpy as np

import samples
from volfrep.mesh.patches import changed_patches, without_faults
from volfrep.mesh.quality import measure
from volfrep.mesh.triangle_mesh import TriangleMesh


def divided(mesh: TriangleMesh, rows: list[int]) -> tuple[TriangleMesh, np.ndarray]:
    """The mesh with points in the middles of some facets, and which facets of it these changed."""
    fans, points = [], [mesh.vertices]
    for k, row in enumerate(rows):
        corners = mesh.triangles[row]
        points.append(mesh.vertices[corners].mean(axis=0)[None])
        fans += [[a, b, len(mesh.vertices) + k] for a, b in zip(corners, np.roll(corners, -1),
                                                                strict=True)]  # fmt: skip
    facets = np.concatenate([np.delete(mesh.triangles, rows, axis=0), fans])
    return TriangleMesh(np.concatenate(points), facets.astype(np.int32)), np.array(rows)


def test_patches_are_what_changed_between_the_same_borders():
    ball = samples.sphere(5.0, 2)
    after, rows = divided(ball, [3, 200])
    # The order of facets, and with which corner they begin, change nothing.
    facets = np.roll(after.triangles[::-1], 1, axis=1).astype(np.int64)
    was, now = changed_patches(ball.triangles.astype(np.int64), facets, len(after.vertices))
    assert set(np.flatnonzero(was >= 0)) == set(rows)
    assert (now >= 0).sum() == 6
    for k, row in enumerate(rows):
        patch = now == was[row]
        assert patch.sum() == 3
        assert (facets[patch] == len(ball.vertices) + k).any(axis=1).all()


def test_a_patch_around_a_point_that_goes_is_one():
    """All edges at it go: what lies about it before and after is one patch."""
    ball = samples.sphere(5.0, 2)
    after, (row,) = divided(ball, [7])
    was, now = changed_patches(
        after.triangles.astype(np.int64), ball.triangles.astype(np.int64), len(after.vertices)
    )
    assert (was >= 0).sum() == 3
    assert set(was[was >= 0]) == set(now[now >= 0])
    assert now[row] >= 0


def test_patches_with_a_fault_are_taken_back_and_what_that_makes_faulty():
    ball = samples.sphere(5.0, 2)
    after, _ = divided(ball, [3, 100, 200])
    first = len(ball.vertices)
    asked = []

    def find_faults(mesh, new):
        """The first new point may not be; the second not without the first."""
        asked.append(int(new.sum()))
        gone = not (mesh.triangles == first).any()
        return (mesh.triangles == (first + 1 if gone else first)).any(axis=1)

    rest, before = ball.triangles[:0], ball.triangles.astype(np.int64)
    facets, places = without_faults(
        after.vertices, rest, before, after.triangles.astype(np.int64), find_faults
    )
    assert asked == [9, 1, 1]
    assert {first, first + 1} <= set(places)
    assert first + 2 not in places
    result = TriangleMesh(after.vertices, facets.astype(np.int32))
    assert len(facets) == len(ball.triangles) + 2
    assert measure(result).watertight


def test_faults_that_were_there_stay():
    ball = samples.sphere(5.0, 2)
    after, _ = divided(ball, [3])
    facets, places = without_faults(
        after.vertices, ball.triangles[:0], ball.triangles.astype(np.int64),
        after.triangles.astype(np.int64), lambda mesh, _: (mesh.triangles < 12).any(axis=1),
    )  # fmt: skip
    assert len(facets) in (len(ball.triangles), len(ball.triangles) + 2)
    assert set(places) <= set(after.triangles[-3:].ravel())

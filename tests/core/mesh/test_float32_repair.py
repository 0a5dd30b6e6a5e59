# SPDX-License-Identifier: LGPL-2.1-or-later
"""Slivers that single precision would lose."""

import numpy as np
import pytest

import samples
from volfrep.io.write.stl import as_read
from volfrep.mesh import quality
from volfrep.mesh.float32_repair import remove_slivers, separate_vertices, shortest_edge
from volfrep.mesh.triangle_mesh import TriangleMesh, concatenate


def with_a_needle(length):
    """A ball one of whose edges is split at `length` from its end."""
    ball = samples.sphere(10.0, 3)
    a, b, c = ball.triangles[0]
    other = next(k for k, t in enumerate(ball.triangles) if k and {a, b} <= set(t.tolist()))
    d = next(v for v in ball.triangles[other] if v not in (a, b))
    along = ball.vertices[b] - ball.vertices[a]
    point = ball.vertices[a] + length * along / np.linalg.norm(along)
    new = len(ball.vertices)
    rest = np.delete(ball.triangles, [0, other], axis=0)
    split = np.array([[a, new, c], [new, b, c], [b, new, d], [new, a, d]], np.int32)
    return TriangleMesh(np.concatenate([ball.vertices, point[None]]), np.concatenate([rest, split]))


def test_a_short_edge_is_collapsed():
    mesh = with_a_needle(1e-6)
    assert quality.measure(mesh).watertight
    clean = remove_slivers(mesh, 1e-4)
    assert len(clean.triangles) == len(mesh.triangles) - 2
    assert quality.measure(clean).watertight
    assert quality.measure(as_read(clean)).watertight
    assert clean.volume == pytest.approx(mesh.volume, rel=1e-6)


def test_a_flat_triangle_is_flipped_away():
    ball = samples.sphere(10.0, 3)
    a, b, c = ball.triangles[0]
    middle = 0.5 * (ball.vertices[a] + ball.vertices[b]) + 1e-7 * ball.vertices[c]
    new = len(ball.vertices)
    split = np.array([[a, new, c], [new, b, c], [a, b, new]], np.int32)
    mesh = TriangleMesh(
        np.concatenate([ball.vertices, middle[None]]), np.concatenate([ball.triangles[1:], split])
    )
    clean = remove_slivers(mesh, 1e-4)
    found = quality.measure(clean)
    assert found.watertight
    assert quality.shape_statistics(clean).smallest_angle > 1.0


def with_a_sliver_in_a_row():
    """A prism with a sliver at a sharp edge, the facets on both sides of which are slender, too."""
    outline = np.array([[0, 0], [0.004, -1e-5], [0.88, 0], [0.8844, 9e-5], [1, 1], [0, 1]])
    count = len(outline)
    at = np.arange(count)
    fan = np.array([[0, k, k + 1] for k in range(1, count - 1)])
    after = np.roll(at, -1)
    sides = [[at, at + count, after], [after, at + count, after + count]]
    triangles = [fan[:, ::-1], fan + count, *(np.stack(side, axis=1)[:, ::-1] for side in sides)]
    points = np.concatenate([np.column_stack([outline, np.full(count, z)]) for z in (0.0, 1.0)])
    return TriangleMesh(points, np.concatenate(triangles).astype(np.int32))


def smallest_height(mesh):
    corners = mesh.vertices[mesh.triangles]
    sides = corners - np.roll(corners, 1, axis=1)
    twice = np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1)
    return (twice / np.linalg.norm(sides, axis=2).max(axis=1)).min()


def test_a_sliver_that_no_flip_helps_is_closed_along_its_edge():
    mesh = with_a_sliver_in_a_row()
    assert quality.measure(mesh).watertight
    assert mesh.volume > 0
    assert smallest_height(mesh) < 2e-5
    clean = remove_slivers(mesh, 6e-5)
    found = quality.measure(clean)
    assert found.watertight
    assert found.genus == 0
    assert smallest_height(clean) > 6e-5
    assert len(clean.vertices) == len(mesh.vertices) - 2
    assert clean.volume == pytest.approx(mesh.volume, abs=1e-5)


def test_a_sliver_stays_where_closing_it_would_move_the_surface():
    mesh = with_a_sliver_in_a_row()
    # A ridge begins at the sliver's middle, and not at an end.
    ridge = mesh.vertices.copy()
    ridge[7, 1] = -0.5
    bent = TriangleMesh(ridge, mesh.triangles)
    clean = remove_slivers(bent, 6e-5)
    assert quality.measure(clean).watertight
    assert clean.volume == pytest.approx(bent.volume, abs=1e-5)
    assert clean.bounds == pytest.approx(bent.bounds, abs=1e-9)


def test_a_good_mesh_is_left_as_it_is():
    mesh = samples.sphere(10.0, 3)
    assert remove_slivers(mesh, 1e-4) is mesh


def test_the_tolerance_follows_the_steps_of_single_precision():
    far = TriangleMesh(np.full((1, 3), 4000.0), np.zeros((0, 3), np.int32))
    assert shortest_edge(far) == 16 * np.spacing(np.float32(4000.0))


def test_sheets_that_touch_are_moved_apart():
    """Two boxes with a common face: a reader would merge its corners to edges of four triangles."""
    touching = concatenate(samples.box(), samples.box(corner=(40.0, 0.0, 0.0)))
    assert not quality.measure(as_read(touching)).watertight
    apart = separate_vertices(touching, shortest_edge(touching))
    found = quality.measure(as_read(apart))
    assert found.watertight
    assert found.bodies == 2
    np.testing.assert_allclose(apart.vertices, touching.vertices, atol=2e-4)


def test_vertices_that_differ_stay_where_they_are():
    mesh = samples.sphere(10.0, 3)
    assert separate_vertices(mesh, 1e-4) is mesh

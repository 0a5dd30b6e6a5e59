# SPDX-License-Identifier: LGPL-2.1-or-later
"""Dual contouring of planes and of a ball: sharp edges, closed, vertices in their cubes."""

import numpy as np
import pytest
import trimesh

from volfrep.shell import dual_contouring as contour
from volfrep.shell import octree

CUBES, SIZE = 12, 8


def leaves(halve=None):
    """A grid of cubes; some of them halved."""
    corner = SIZE * np.indices((CUBES,) * 3).reshape(3, -1).T
    whole = octree.Leaves(corner, np.full(len(corner), SIZE))
    if halve is None:
        return whole
    which = halve(corner + SIZE / 2)
    return whole.chosen(~which).joined(whole.chosen(which).halved())


def contoured(cubes, value, plane):
    """The crossings of a field, its patches' vertices, and the facets.

    Args:
        cubes: the leaves.
        value: of points (..., 3): signed distances.
        plane: of points (n, 3) near the surface: points of its planes, and normals.
    """
    negative = value(cubes.nodes().astype(float)) < 0
    crossings = octree.patches(cubes, *octree.crossed_edges(cubes, negative))
    low, high = (end.astype(float) for end in (crossings.edges.low, crossings.edges.high))
    a, b = value(low), value(high)
    points = low + (a / (a - b))[:, None] * (high - low)
    anchor, normal = plane(points)
    corner = cubes.corner[crossings.leaf_of_patch].astype(float)
    top = corner + cubes.size[crossings.leaf_of_patch][:, None]
    everywhere = np.ones(len(corner), bool)
    vertices = contour.place_vertices(crossings, everywhere, points, anchor, normal, corner, top)
    made = contour.facets(crossings, vertices, anchor, normal)
    return crossings, points, (corner, top), made


BOX = np.array([[20.3, 17.1, 26.9], [70.7, 61.3, 83.1]])
MIDDLE, RADIUS = np.array([47.3, 48.1, 46.2]), 30.0


def box_value(points):
    return np.maximum(BOX[0] - points, points - BOX[1]).max(axis=-1)


def box_plane(points):
    """Of the face that a point lies on."""
    gaps = np.concatenate([np.abs(points - BOX[0]), np.abs(points - BOX[1])], axis=1)
    face = gaps.argmin(axis=1)
    normal = np.concatenate([-np.eye(3), np.eye(3)])[face]
    anchor = points.copy()
    anchor[np.arange(len(points)), face % 3] = BOX.ravel()[face]
    return anchor, normal


def ball_value(points):
    return np.linalg.norm(points - MIDDLE, axis=-1) - RADIUS


def ball_plane(points):
    normal = (points - MIDDLE) / np.linalg.norm(points - MIDDLE, axis=1)[:, None]
    return MIDDLE + RADIUS * normal, normal


def near_a_corner(middle):
    return (middle > 44).all(axis=1)


def as_trimesh(mesh):
    return trimesh.Trimesh(mesh.vertices, mesh.triangles, process=False)


@pytest.mark.parametrize("halve", [None, near_a_corner], ids=["equal cubes", "some halved"])
def test_a_box_is_found_exactly_edges_and_corners_included(halve):
    _, _, _, made = contoured(leaves(halve), box_value, box_plane)
    found = as_trimesh(made.mesh)
    assert found.is_watertight
    assert found.volume == pytest.approx(np.prod(BOX[1] - BOX[0]), rel=1e-9)
    np.testing.assert_allclose(box_value(made.mesh.vertices), 0.0, atol=1e-9)
    corners = BOX[np.indices((2, 2, 2)).reshape(3, -1).T, np.arange(3)]
    gap = np.linalg.norm(made.mesh.vertices[:, None] - corners, axis=2).min(axis=0)
    np.testing.assert_allclose(gap, 0.0, atol=1e-9)
    np.testing.assert_allclose(made.off, 0.0, atol=1e-9)


@pytest.mark.parametrize("halve", [None, near_a_corner], ids=["equal cubes", "some halved"])
def test_a_ball_is_closed_and_turned_outward(halve):
    _, _, (low, high), made = contoured(leaves(halve), ball_value, ball_plane)
    found = as_trimesh(made.mesh)
    assert found.is_watertight
    assert found.is_winding_consistent
    assert found.euler_number == 2
    assert found.volume == pytest.approx(4 / 3 * np.pi * RADIUS**3, rel=0.02)
    vertices = made.mesh.vertices
    assert ((vertices > low) & (vertices < high)).all()
    assert np.abs(ball_value(vertices)).max() < 0.2 * SIZE


def test_the_vertices_of_some_patches_are_those_that_all_would_have():
    crossings, points, (low, high), made = contoured(leaves(near_a_corner), ball_value, ball_plane)
    some = low[:, 0] > MIDDLE[0]
    assert 0 < some.sum() < len(some)
    found = contour.place_vertices(
        crossings, some, points, *ball_plane(points), low[some], high[some]
    )
    np.testing.assert_array_equal(found, made.mesh.vertices[some])


def test_once_cubes_are_halved_the_edges_crossed_are_those_of_all_cubes_looked_at_anew():
    """Some of the halves are halved again, so that smaller ones divide their neighbours' edges."""

    def value(nodes):
        return ball_value(nodes / 2.0)

    before = leaves(near_a_corner)
    before = octree.Leaves(2 * before.corner, 2 * before.size)  # their eighths have whole middles
    edges, leaf = octree.crossed_edges(before, value(before.nodes()) < 0)
    halved = np.abs(value(before.corner + before.size[:, None] / 2)) < SIZE
    halved &= before.corner[:, 1] / 2 > MIDDLE[1]
    halves = before.chosen(halved).halved()
    again = halves.corner[:, 2] / 2 > MIDDLE[2]
    halves = halves.chosen(~again).joined(halves.chosen(again).halved())
    after = before.chosen(~halved).joined(halves)
    number = np.where(halved, -1, np.cumsum(~halved) - 1)
    found, found_round = octree.crossed_anew(edges, leaf, number, after, value(halves.nodes()) < 0)
    wanted, leaves_round = octree.crossed_edges(after, value(after.nodes()) < 0)
    assert len(np.unique(wanted.size)) == 4
    for part in ("low", "axis", "size", "rising"):
        np.testing.assert_array_equal(getattr(found, part), getattr(wanted, part))
    np.testing.assert_array_equal(found_round, leaves_round)


def test_facets_know_the_edge_they_lie_round():
    crossings, points, _, made = contoured(leaves(), ball_value, ball_plane)
    middle = made.mesh.vertices[made.mesh.triangles].mean(axis=1)
    assert np.linalg.norm(middle - points[made.edge], axis=1).max() < 2 * SIZE
    np.testing.assert_array_equal(np.unique(made.edge), np.arange(len(crossings.edges.axis)))


@pytest.mark.parametrize("share", [0.05, 1.0])
def test_fans_close_as_well(share):
    crossings, points, _, made = contoured(leaves(near_a_corner), ball_value, ball_plane)
    cut = np.random.default_rng(3).random(len(crossings.patches_of_segment)) < share
    edges = contour.fan_edges(crossings, cut)
    assert 0 < len(edges) <= len(points)
    fanned = contour.with_fans(crossings, made, cut, points[edges])
    found = as_trimesh(fanned.mesh)
    assert found.is_watertight
    assert found.euler_number == 2
    assert len(fanned.mesh.triangles) > len(made.mesh.triangles)
    assert found.volume == pytest.approx(as_trimesh(made.mesh).volume, rel=0.02)
    assert len(fanned.edge) == len(fanned.mesh.triangles)
    # The middles of the fans lie where the edges are crossed, on the ball.
    hubs = fanned.mesh.vertices[len(made.mesh.vertices) :][: len(edges)]
    np.testing.assert_allclose(ball_value(hubs), 0.0, atol=0.3)


def test_without_cuts_there_are_no_fans():
    crossings, points, _, made = contoured(leaves(), ball_value, ball_plane)
    none = np.zeros(len(crossings.patches_of_segment), bool)
    assert len(contour.fan_edges(crossings, none)) == 0
    fanned = contour.with_fans(crossings, made, none, points[:0])
    np.testing.assert_array_equal(fanned.mesh.triangles, made.mesh.triangles)

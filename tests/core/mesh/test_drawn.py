# SPDX-License-Identifier: LGPL-2.1-or-later
"""What is drawn in pieces is the mesh itself; neighbours are those that others find."""

import numpy as np
import pytest
import trimesh

import samples
from volfrep.mesh.display_parts import (
    AT_ONCE,
    NOTHING,
    drawn_parts,
    facets_with_neighbours,
    finer,
    in_pieces,
)
from volfrep.mesh.shading import shade
from volfrep.mesh.triangle_mesh import TriangleMesh


def test_pieces_are_the_same_triangles_in_their_order():
    drawn = shade(samples.sphere(20.0, 4))
    pieces = in_pieces(drawn, 700)
    assert len(pieces) == -(-len(drawn.triangles) // 700)
    corners = np.concatenate([points[index[:, :3]] for points, _, index in pieces])
    normals = np.concatenate([normals[index[:, :3]] for _, normals, index in pieces])
    assert (corners == drawn.points[drawn.triangles]).all()
    assert (normals == drawn.normals[drawn.triangles]).all()
    assert all((index[:, 3] == -1).all() and len(index) <= 700 for *_, index in pieces)


@pytest.mark.costly
def test_a_large_part_has_a_likeness_and_a_small_one_has_none():
    ball = samples.sphere(20.0, 4)
    kinds = (np.arange(len(ball.triangles)) % 2).astype(np.uint8)
    small = drawn_parts(ball, kinds, 10**6, (1,))
    assert [part.kind for part in small] == [0, 1]
    assert all(part.first is None for part in small)
    assert len(small[0].edges) == 0 < len(small[1].edges)  # half a ball's triangles have open ends
    fine = samples.sphere(20.0, 7)
    assert len(fine.triangles) > AT_ONCE
    (part,) = drawn_parts(fine, np.zeros(len(fine.triangles), np.uint8), 10**6, ())
    assert len(part.pieces.index) == len(fine.triangles)
    assert part.first is not None
    assert 0 < len(part.first.index) <= AT_ONCE
    likeness = part.first.points
    assert np.abs(np.linalg.norm(likeness, axis=1) - 20.0).max() < 0.5


def test_neighbours_are_those_that_trimesh_finds():
    ball = samples.sphere(20.0, 3)
    facets = facets_with_neighbours(ball)
    pairs = np.stack([np.repeat(np.arange(len(facets)), 3), facets[:, 3:].ravel()], axis=1)
    theirs = trimesh.Trimesh(ball.vertices, ball.triangles, process=False).face_adjacency
    assert np.array_equal(
        np.unique(np.sort(pairs, axis=1), axis=0), np.unique(np.sort(theirs, axis=1), axis=0)
    )
    # Across side k, from corner k to the next, lies a triangle with both corners.
    across = ball.triangles[facets[:, 3:]]
    for k in range(3):
        for corner in (ball.triangles[:, k], ball.triangles[:, (k + 1) % 3]):
            assert (across[:, k] == corner[:, None]).any(axis=1).all()


def test_at_an_open_side_there_is_nothing():
    one = TriangleMesh(np.eye(3), np.array([[0, 1, 2]], np.int32))
    assert facets_with_neighbours(one).tolist() == [[0, 1, 2, NOTHING, NOTHING, NOTHING]]


def test_finer_pieces_are_the_same_surface_without_long_sides():
    solid = samples.box((30.0, 20.0, 10.0))
    pieces = finer(in_pieces(shade(solid), 5), 2.0)
    corners = np.concatenate([points[index[:, :3]] for points, _, index in pieces])
    turns = np.concatenate([normals[index[:, :3]] for _, normals, index in pieces])
    sides = np.linalg.norm(np.roll(corners, -1, axis=1) - corners, axis=2)
    assert sides.max() <= 2.0
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    assert 0.5 * np.linalg.norm(across, axis=1).sum() == pytest.approx(solid.area, rel=1e-5)
    middles = corners.mean(axis=1)
    assert (np.einsum("ti,ti->t", middles, across) / 6.0).sum() == pytest.approx(
        solid.volume, rel=1e-5
    )
    flat = across / np.linalg.norm(across, axis=1)[:, None]
    assert np.einsum("ti,tci->tc", flat, turns).min() > 0.999

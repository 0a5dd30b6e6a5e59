# SPDX-License-Identifier: LGPL-2.1-or-later
"""Squares on flat faces: the same solid, however its facets lay; judged by trimesh."""

import manifold3d
import numpy as np
import pytest
import trimesh

import samples
from volfrep.mesh import quality
from volfrep.mesh.booleans import as_mesh
from volfrep.spatial.rays import inside_points
from volfrep.trim import flat_walls
from volfrep.trim.flat_walls import ABOUT, TILES, tile, with_squares
from volfrep.util.progress import Monitor

CORNER, EDGE = np.array([-1.3, 0.21, -0.7]), 1.1


@pytest.fixture
def tiles_welcome(monkeypatch):
    """However little of a wall they are."""
    monkeypatch.setattr(flat_walls, "LEAST_SHARE", 0.0)


def plate():
    """A plate with a round hole, a pocket that leaves a thin web, and needles on its faces."""
    solid = manifold3d.Manifold.cube((45.0, 38.0, 9.0))
    solid -= manifold3d.Manifold.cylinder(20.0, 5.0, 5.0, 24).translate((15.0, 19.0, -5.0))
    return as_mesh(solid - manifold3d.Manifold.cube((8.0, 30.0, 4.0)).translate((36.5, 4.0, 6.0)))


def judged(mesh):
    result = trimesh.Trimesh(mesh.vertices, mesh.triangles, process=False)
    assert result.is_watertight
    assert result.is_winding_consistent
    return result


def test_a_wall_with_squares_is_the_same_wall(tiles_welcome):
    solid = plate()
    wall = with_squares(solid, CORNER, EDGE)
    before, after = judged(solid), judged(wall.mesh)
    assert after.volume == pytest.approx(before.volume, rel=1e-12)
    assert after.area == pytest.approx(before.area, rel=1e-12)
    assert after.euler_number == before.euler_number
    assert after.area_faces.min() > 1e-9
    # Halves of squares look the way that their face does, and are as large.
    own = wall.face >= 0
    np.testing.assert_allclose(after.area_faces[own], 0.5 * EDGE**2, rtol=1e-9)
    axis = np.array([face.axes[0] for face in wall.faces])[wall.face[own]]
    across = after.face_normals[own]
    np.testing.assert_allclose(np.abs(across[np.arange(len(axis)), axis]), 1.0)
    middle = after.triangles_center[own]
    assert inside_points(solid, middle - 1e-3 * across, Monitor()).all()
    assert not inside_points(solid, middle + 1e-3 * across, Monitor()).any()


def test_a_tile_has_squares_all_about_it(tiles_welcome):
    wall = with_squares(plate(), CORNER, EDGE)
    places = np.stack(np.meshgrid(*(np.arange(-1, 50),) * 3, indexing="ij"), axis=-1).reshape(-1, 3)
    low = CORNER + EDGE * places
    tiles = tile(wall, places, low, low + EDGE)
    assert tiles.count > 10
    own = wall.face >= 0
    assert len(tiles.triangle) == own.sum()
    for number in range(tiles.count):
        rows = np.flatnonzero(tiles.triangle == number)
        squares = wall.square[rows]
        size = squares.max(axis=0) - squares.min(axis=0) + 1
        assert size[0] == size[1]
        assert size[0] in TILES
        assert (squares.min(axis=0) % size[0] == 0).all()
        assert len(rows) == 2 * size[0] ** 2
        face = wall.square[wall.face == wall.face[rows[0]]][::2]
        near = (face >= squares.min(axis=0) - ABOUT) & (face <= squares.max(axis=0) + ABOUT)
        assert near.all(axis=1).sum() == (size[0] + 2 * ABOUT) ** 2
        # Its octants lie at the plane, in the same columns.
        axis, *along = wall.faces[wall.face[rows[0]]].axes
        mine = places[tiles.octant == number]
        np.testing.assert_array_equal(np.unique(mine[:, along], axis=0), np.unique(squares, axis=0))
        height = (wall.faces[wall.face[rows[0]]].height - CORNER[axis]) / EDGE
        assert (np.abs(mine[:, axis] + 0.5 - height) < 0.51).all()


def test_round_and_turned_walls_have_none(tiles_welcome):
    assert with_squares(samples.sphere(20.0), CORNER, EDGE) is None
    turned = as_mesh(manifold3d.Manifold.cube((40.0, 40.0, 40.0)).rotate((10.0, 20.0, 30.0)))
    assert with_squares(turned, CORNER, EDGE) is None
    assert with_squares(samples.box((6.0, 6.0, 6.0)), CORNER, EDGE) is None


def test_a_wall_that_would_hardly_repeat_stays_as_it_is():
    """A seventh of a small plate's area is in tiles, more than half of a large one's."""
    assert with_squares(plate(), CORNER, EDGE) is None
    large = with_squares(samples.box((120.0, 100.0, 9.0)), CORNER, EDGE)
    tiled = sum((face.tile >= 0).sum() for face in large.faces)
    assert tiled * EDGE**2 > 0.5 * quality.measure(large.mesh).area

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pixels are set where their middles lie in a polygon, and nowhere else."""

import numpy as np
from skimage.measure import points_in_poly

from volfrep.slicing.raster import PixelGrid, fill_pixels, pixel_grid

GRID = PixelGrid((0.0, 0.0), 0.25, (40, 60))


def middles(grid):
    rows, columns = grid.shape
    x = grid.origin[0] + grid.pixel * (np.arange(columns) + 0.5)
    y = grid.origin[1] + grid.pixel * (np.arange(rows) + 0.5)
    return np.stack(np.broadcast_arrays(x[None, :], y[:, None]), axis=-1).reshape(-1, 2)


def test_a_polygon_holds_the_middles_that_lie_in_it():
    polygon = np.array([[1.03, 0.9], [13.1, 2.2], [9.4, 8.8], [6.2, 4.1], [2.7, 9.3]])
    found = fill_pixels([[polygon[None]]], lambda held: held[0], GRID)
    expected = points_in_poly(middles(GRID), polygon).reshape(GRID.shape)
    assert (found == expected).all()
    assert found.any()


def test_holes_are_left_out_and_overlaps_count_once():
    square = np.array([[1.0, 1], [9, 1], [9, 9], [1, 9]])
    hole = np.array([[3.0, 3], [3, 7], [7, 7], [7, 3]])
    one = fill_pixels([[square[None], hole[None]]], lambda held: held[0], GRID)
    assert one.sum() == (8 * 8 - 4 * 4) / 0.25**2
    twice = fill_pixels([[square[None], square[None] + 0.5]], lambda held: held[0], GRID)
    assert twice.sum() == (8 * 8 * 2 - 7.5 * 7.5) / 0.25**2


def test_groups_are_put_together_by_the_rule():
    square = np.array([[[1.0, 1], [9, 1], [9, 9], [1, 9]]])
    both = fill_pixels([[square], [square + 4]], lambda held: held[0] & held[1], GRID)
    assert both.sum() == 4 * 4 / 0.25**2


def test_what_reaches_beyond_the_picture_is_cut_off():
    square = np.array([[[-5.0, -5], [50, -5], [50, 50], [-5, 50]]])
    found = fill_pixels([[square]], lambda held: held[0], GRID)
    assert found[:, :-1].all()
    assert fill_pixels([[square - 200]], lambda held: held[0], GRID).sum() == 0
    assert fill_pixels([[]], lambda held: held[0], GRID).sum() == 0


def test_the_grid_has_a_pixel_to_spare_on_every_side():
    grid = pixel_grid(np.array([[-0.3, 0.0, 0.0], [1.0, 0.5, 2.0]]), 0.1)
    assert grid.shape == (7, 15)
    np.testing.assert_allclose(grid.origin, (-0.4, -0.1))

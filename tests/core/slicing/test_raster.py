# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pixels tell what share of them polygons hold, so that together they have the polygons' area."""

import numpy as np
import pytest
from skimage.measure import points_in_poly

from volfrep.slicing.raster import PixelGrid, pixel_grid, pixel_shares

GRID = PixelGrid((0.0, 0.0), 0.25, (40, 60))
SQUARE = np.array([[1.0, 1], [9, 1], [9, 9], [1, 9]])


def held_share(polygon, grid, times=10):
    """Of each pixel the share of so many points squared that lie in a polygon."""
    rows, columns = grid.shape
    x = grid.origin[0] + grid.pixel / times * (np.arange(columns * times) + 0.5)
    y = grid.origin[1] + grid.pixel / times * (np.arange(rows * times) + 0.5)
    points = np.stack(np.broadcast_arrays(x[None, :], y[:, None]), axis=-1).reshape(-1, 2)
    inside = points_in_poly(points, polygon).reshape(rows, times, columns, times)
    return inside.mean(axis=(1, 3))


def area_of(polygon):
    x, y = polygon.T
    return 0.5 * abs(x @ np.roll(y, -1) - y @ np.roll(x, -1))


def test_pixels_tell_the_share_that_a_polygon_holds():
    polygon = np.array([[1.03, 0.9], [13.1, 2.2], [9.4, 8.8], [6.2, 4.1], [2.7, 9.3]])
    pixels, area = pixel_shares([[polygon[None]]], lambda held: held[0], GRID)
    share = held_share(polygon, GRID)
    assert ((pixels == 255) == (share == 1)).mean() > 0.99
    assert ((pixels == 0) == (share == 0)).mean() > 0.99
    # A row has two lines: where an edge lies flat between them, a quarter of a pixel is missed.
    assert np.abs(pixels / 255 - share).max() < 0.3
    assert area == pytest.approx(area_of(polygon), rel=1e-3)
    assert pixels.sum() / 255 * GRID.pixel**2 == pytest.approx(area, rel=1e-4)


def test_struts_that_lie_alike_among_the_pixels_are_not_all_wrong_alike():
    """Circles about pixels' corners, of five pixels' radius: on or off they would have 80."""
    angle = np.arange(400) * (2 * np.pi / 400)
    circle = 10 + 5 * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    pixels, area = pixel_shares(
        [[circle[None]]], lambda held: held[0], PixelGrid((0, 0), 1, (20, 20))
    )
    assert (pixels > 127).sum() == 80
    assert area == pytest.approx(np.pi * 25, rel=0.004)


def test_holes_are_left_out_and_overlaps_count_once():
    hole = np.array([[3.0, 3], [3, 7], [7, 7], [7, 3]])
    _, one = pixel_shares([[SQUARE[None], hole[None]]], lambda held: held[0], GRID)
    assert one == 8 * 8 - 4 * 4
    _, twice = pixel_shares([[SQUARE[None], SQUARE[None] + 0.5]], lambda held: held[0], GRID)
    assert twice == 8 * 8 * 2 - 7.5 * 7.5


def test_groups_are_put_together_by_the_rule():
    square = SQUARE[None]
    _, both = pixel_shares([[square], [square + 4]], lambda held: held[0] & held[1], GRID)
    assert both == 4 * 4


def test_what_reaches_beyond_the_picture_is_cut_off():
    square = np.array([[[-5.0, -5], [50, -5], [50, 50], [-5, 50]]])
    found, _ = pixel_shares([[square]], lambda held: held[0], GRID)
    assert (found[:, :-1] == 255).all()
    assert pixel_shares([[square - 200]], lambda held: held[0], GRID)[1] == 0
    assert not pixel_shares([[]], lambda held: held[0], GRID)[0].any()


def test_the_grid_has_a_pixel_to_spare_on_every_side():
    grid = pixel_grid(np.array([[-0.3, 0.0, 0.0], [1.0, 0.5, 2.0]]), 0.1)
    assert grid.shape == (7, 15)
    np.testing.assert_allclose(grid.origin, (-0.4, -0.1))

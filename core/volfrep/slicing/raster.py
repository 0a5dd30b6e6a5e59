# SPDX-License-Identifier: LGPL-2.1-or-later
"""Polygons to pixels: which pixels' middles they wind about.

Only the places where the winding changes are sorted, so that a layer costs by its outlines and not
by its pixels.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from ..util.ragged import spread
from ..util.types import Bools, Floats, Ints


@dataclass(frozen=True)
class PixelGrid:
    """A picture of layers: where its pixels lie.

    Attributes:
        origin: x and y of the outer corner of the first pixel, mm.
        pixel: edge of a pixel, mm.
        shape: rows along y, and columns along x.
    """

    origin: tuple[float, float]
    pixel: float
    shape: tuple[int, int]


def pixel_grid(bounds: Floats, pixel: float) -> PixelGrid:
    """The smallest grid of pixels about a box, with one pixel to spare on every side.

    Args:
        bounds: (2, 3) box, mm.
        pixel: edge of a pixel, mm.
    """
    low = np.floor(bounds[0, :2] / pixel) - 1
    high = np.ceil(bounds[1, :2] / pixel) + 1
    columns, rows = (int(count) for count in high - low)
    return PixelGrid((float(low[0] * pixel), float(low[1] * pixel)), pixel, (rows, columns))


def crossings(starts: Floats, ends: Floats, grid: PixelGrid) -> tuple[Ints, Bools]:
    """Where directed edges cross the middles of a grid's rows.

    Args:
        starts: (n, 2) of edges that have what they enclose on their left, mm.
        ends: (n, 2) of the same.
        grid: of the pixels.

    Returns:
        (k,) int64 pixels, counted row by row, from which on the edges wind once more or once less
        about a pixel's middle, and (k,) bool which of the two.
    """
    rows, columns = grid.shape
    start, end = ((points - grid.origin) / grid.pixel - 0.5 for points in (starts, ends))
    down = start[:, 1] > end[:, 1]
    low, high = np.where(down[:, None], end, start), np.where(down[:, None], start, end)
    # An edge has the rows from its lower end, which counts, to its upper one, which does not.
    first = np.clip(np.ceil(low[:, 1]), 0, rows).astype(np.int64)
    past = np.clip(np.ceil(high[:, 1]), 0, rows).astype(np.int64)
    edge, place = spread(past - first)
    row = first[edge] + place
    with np.errstate(divide="ignore", invalid="ignore"):
        lean = (high[:, 0] - low[:, 0]) / (high[:, 1] - low[:, 1])
    x = low[edge, 0] + (row - low[edge, 1]) * lean[edge]
    column = np.clip(np.ceil(x), 0, columns - 1).astype(np.int64)
    return row * columns + column, down[edge]


def fill_pixels(
    groups: Sequence[Sequence[Floats]],
    rule: Callable[[list[Bools]], Bools],
    grid: PixelGrid,
) -> Bools:
    """The pixels whose middles some groups of polygons hold.

    Args:
        groups: of each, arrays (k, c, 2) of k polygons, mm, counter-clockwise about what they
            hold; those of a group may overlap, holes in it run clockwise.
        rule: takes, for each group, where it holds something, and tells where there is material.
        grid: of the pixels.

    Returns:
        (rows, columns) bool, the rows from low y to high y.
    """
    found = []
    for number, group in enumerate(groups):
        for polygons in group:
            pixels, more = crossings(
                polygons.reshape(-1, 2), np.roll(polygons, -1, axis=1).reshape(-1, 2), grid
            )
            found.append((pixels * len(groups) + number) * 2 + more)
    # Between two changes all pixels are alike, so only the changes are sorted and counted.
    changes = np.sort(np.concatenate(found)) if found else np.zeros(0, np.int64)
    step = np.where(changes % 2, 1, -1)
    of_group = changes // 2 % len(groups)
    held = [np.cumsum(np.where(of_group == k, step, 0)) > 0 for k in range(len(groups))]
    rows, columns = grid.shape
    pixels = np.concatenate([[0], changes // (2 * len(groups)), [rows * columns]])
    solid = np.concatenate([[False], rule(held)])
    return np.repeat(solid, np.diff(pixels)).reshape(rows, columns)

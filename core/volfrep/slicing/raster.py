# SPDX-License-Identifier: LGPL-2.1-or-later
"""Polygons to pixels: what share of each they hold.

Lines through a row of pixels are cut at the places where the winding changes, which counts in full
along x. Only these are sorted, so that a layer costs by its outlines and not by its pixels.

Shares, as pixels that are set or not would all be wrong alike where cells are as long as some whole
pixels: struts of a radius of five pixels would be 2 % too thick.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..util.ragged import spread
from ..util.types import Bools, Floats, Ints

#: Places along a row within a pixel, and lines in a row.
PLACES, LINES = 64, 2


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
    """Where directed edges cross the lines of a grid's rows.

    Args:
        starts: (n, 2) of edges that have what they enclose on their left, mm.
        ends: (n, 2) of the same.
        grid: of the pixels.

    Returns:
        (k,) int64 places, counted line by line, `PLACES` a pixel, from which on the edges wind once
        more or once less, and (k,) bool which of the two.
    """
    rows, columns = grid.shape
    scale = np.array([PLACES, LINES]) / grid.pixel
    start, end = ((points - grid.origin) * scale - (0.0, 0.5) for points in (starts, ends))
    down = start[:, 1] > end[:, 1]
    low, high = np.where(down[:, None], end, start), np.where(down[:, None], start, end)
    # An edge has the lines from its lower end, which counts, to its upper one, which does not.
    first = np.clip(np.ceil(low[:, 1]), 0, rows * LINES).astype(np.int64)
    past = np.clip(np.ceil(high[:, 1]), 0, rows * LINES).astype(np.int64)
    edge, place = spread(past - first)
    line = first[edge] + place
    with np.errstate(divide="ignore", invalid="ignore"):
        lean = (high[:, 0] - low[:, 0]) / (high[:, 1] - low[:, 1])
    x = low[edge, 0] + (line - low[edge, 1]) * lean[edge]
    # Never into the last pixel, so that a line's changes end before the next line.
    along = np.clip(np.rint(x), 0, (columns - 1) * PLACES).astype(np.int64)
    return line * (columns * PLACES) + along, down[edge]


def pixel_shares(
    groups: Sequence[Sequence[Floats]],
    rule: Callable[[list[Bools]], Bools],
    grid: PixelGrid,
) -> tuple[NDArray[np.uint8], float]:
    """What share of each pixel some groups of polygons hold.

    Args:
        groups: of each, arrays (k, c, 2) of k polygons, mm, counter-clockwise about what they
            hold; those of a group may overlap, holes in it run clockwise.
        rule: takes, for each group, where it holds something, and tells where there is material.
        grid: of the pixels; its last column stays empty.

    Returns:
        (rows, columns) uint8, 0 for none to 255 for all of a pixel, the rows from low y to high y;
        and the area of all shares, mm2.
    """
    found = []
    for number, group in enumerate(groups):
        for polygons in group:
            places, more = crossings(
                polygons.reshape(-1, 2), np.roll(polygons, -1, axis=1).reshape(-1, 2), grid
            )
            found.append((places * len(groups) + number) * 2 + more)
    # Between two changes all places are alike, so only the changes are sorted and counted.
    changes = np.sort(np.concatenate(found)) if found else np.zeros(0, np.int64)
    step = np.where(changes % 2, 1, -1)
    of_group = changes // 2 % len(groups)
    within = [np.cumsum(np.where(of_group == k, step, 0)) > 0 for k in range(len(groups))]
    solid = np.diff(np.concatenate([[False], rule(within)]).astype(np.int64))
    turns = np.flatnonzero(solid)
    return _sum_shares(changes[turns] // (2 * len(groups)), solid[turns], grid)


def _sum_shares(at: Ints, steps: Ints, grid: PixelGrid) -> tuple[NDArray[np.uint8], float]:
    """The shares of pixels, of the places where material begins (1) and ends (-1) on each line."""
    rows, columns = grid.shape
    line, along = np.divmod(at, columns * PLACES)
    pixel, place = np.divmod(along, PLACES)
    pixel += line // LINES * columns
    # A pixel has what is left of it after the place, the next one and all others the whole.
    where = np.concatenate([[0], pixel, pixel + 1])
    by = np.concatenate([[0], steps * (PLACES - place), steps * place])
    where, inverse = np.unique(where, return_inverse=True)
    share = np.cumsum(np.bincount(inverse, by, len(where)).astype(np.int64))
    length = np.diff(np.concatenate([where, [rows * columns]]))
    whole = PLACES * LINES
    grey = np.rint(share * (255 / whole)).astype(np.uint8)
    area = float((share * length).sum()) / whole * grid.pixel**2
    return np.repeat(grey, length).reshape(rows, columns), area

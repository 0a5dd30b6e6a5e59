# SPDX-License-Identifier: LGPL-2.1-or-later
"""The largest ball that passes through a lattice."""

from __future__ import annotations

import itertools
from functools import lru_cache

import numpy as np
from scipy import ndimage

from ..design.cells import UnitCell
from ..util.types import Bools, Floats

#: Places along a cell's edge. Windows of symmetric cells have their middles at whole numbers of
#: twelfths, so that they are met exactly; the others are told too narrow by a step at most.
PLACES = 48
#: How near the clearance at which the way closes is looked for, in units of L.
CLOSE = 1e-4
CHUNK = 4096


def largest_ball(cell: UnitCell, ratio: float) -> float:
    """Diameter of the largest ball that gets through an endless lattice, in units of L.

    It passes from a cell to the next, and so on without end, in one direction at least; 0 where
    nothing does.

    Args:
        cell: the unit cell.
        ratio: radius of the struts over L.

    >>> from volfrep.design.cells import find_cell
    >>> round(largest_ball(find_cell("Box"), 0.1), 3)  # through a square window of 1 - 0.2
    0.8
    """
    return ball_through(_distances(cell, ratio))


def ball_through(distance: Floats) -> float:
    """Diameter of the largest ball that gets on through a periodic cell of distances."""
    low, high = 0.0, float(distance.max())
    if high <= 0.0 or not _passes(distance > 0.0):
        return 0.0
    while high - low > CLOSE:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if _passes(distance >= middle) else (low, middle)
    # At the window's own place the distance is one of those that were computed.
    return 2.0 * float(distance[distance >= low].min())


def _passes(free: Bools) -> bool:
    """Whether a periodic cell's free places reach from one of its copies to another."""
    # Over corners, too: a way through a slanting window leaves its middle along a diagonal.
    number = ndimage.label(np.tile(free, (2, 2, 2)), np.ones((3, 3, 3)))[0]
    # What leaves the doubled cell by a side enters it by the opposite one.
    size = int(number.max()) + 1
    first = number[: len(free), : len(free), : len(free)]
    for shift in itertools.product((0, 1), repeat=3):
        if any(shift):
            there = np.roll(number, [-len(free) * k for k in shift], (0, 1, 2))
            same = (first > 0) & (first == there[: len(free), : len(free), : len(free)])
            if size > 1 and same.any():
                return True
    return False


@lru_cache(maxsize=16)
def _distances(cell: UnitCell, ratio: float) -> Floats:
    """(n, n, n) from places of a cell to the nearest strut or joint, in units of L."""
    steps = np.arange(PLACES) / PLACES
    points = np.stack(np.meshgrid(steps, steps, steps, indexing="ij"), axis=-1).reshape(-1, 3)
    shifts = np.array(list(itertools.product((-1.0, 0.0, 1.0), repeat=3)))
    ends = (shifts[:, None, None] + cell.nodes[cell.struts]).reshape(-1, 2, 3)
    nodes = np.unique((shifts[:, None] + cell.nodes).reshape(-1, 3), axis=0)
    # Struts of the copies about a cell that come nearer than its middle is to itself.
    near = (ends.min(axis=1) < 1.5).all(axis=1) & (ends.max(axis=1) > -0.5).all(axis=1)
    start, end = ends[near].swapaxes(0, 1)
    way = end - start
    nodes = nodes[((nodes < 1.5) & (nodes > -0.5)).all(axis=1)]
    joint = ratio * (1.0 + ratio)
    result = np.empty(len(points))
    for begin in range(0, len(points), CHUNK):
        p = points[begin : begin + CHUNK, None]
        share = np.einsum("nmi,mi->nm", p - start, way) / (way * way).sum(axis=1)
        off = p - start - np.clip(share, 0.0, 1.0)[:, :, None] * way
        least = np.sqrt((off * off).sum(axis=2)).min(axis=1) - ratio
        ball = np.sqrt(((p - nodes) ** 2).sum(axis=2)).min(axis=1) - joint
        result[begin : begin + CHUNK] = np.minimum(least, ball)
    return result.reshape(PLACES, PLACES, PLACES)

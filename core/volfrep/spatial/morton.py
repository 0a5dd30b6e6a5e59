# SPDX-License-Identifier: LGPL-2.1-or-later
"""An order in which neighbours in space mostly follow one another (G. M. Morton, 1966)."""

from __future__ import annotations

import numpy as np

from ..util.types import Floats, Ints

#: Steps along the longest side of a box in which points are told apart.
STEPS = 1023


def interleaved(nodes: Ints) -> Ints:
    """(n,) Morton codes of (n, 3) whole numbers below 2^21: the bits of x, y, z in turn."""
    result = np.zeros(len(nodes), np.int64)
    for axis in range(3):
        bits = nodes[:, axis].copy()
        for shift, mask in (
            (32, 0x1F00000000FFFF),
            (16, 0x1F0000FF0000FF),
            (8, 0x100F00F00F00F00F),
            (4, 0x10C30C30C30C30C3),
            (2, 0x1249249249249249),
        ):
            bits = (bits | (bits << shift)) & mask
        result |= bits << (2 - axis)
    return result


def neighbours_together(points: Floats) -> Ints:
    """(n,) an order of (n, 3) points in which what asks the same places comes together."""
    low = points.min(axis=0)
    size = max(float((points.max(axis=0) - low).max()), 1e-300) / STEPS
    return np.argsort(interleaved(((points - low) / size).astype(np.int64)), kind="stable")

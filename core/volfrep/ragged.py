# SPDX-License-Identifier: LGPL-2.1-or-later
"""Rows of different lengths laid end to end, without a loop over the rows."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Ints = NDArray[np.int64]


def spread(counts: Ints) -> tuple[Ints, Ints]:
    """For counts (2, 3): owners (0, 0, 1, 1, 1) and places (0, 1, 0, 1, 2)."""
    owner = np.repeat(np.arange(len(counts)), counts)
    place = np.arange(len(owner)) - np.repeat(np.cumsum(counts) - counts, counts)
    return owner, place


def rows_of(start: Ints, index: Ints) -> tuple[Ints, Ints]:
    """Positions of the rows `index`, and which of `index` each belongs to.

    `start` (n + 1,) holds the offsets of n rows that lie end to end.
    """
    first = start[index]
    owner, place = spread(start[index + 1] - first)
    return first[owner] + place, owner

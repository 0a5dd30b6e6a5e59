# SPDX-License-Identifier: LGPL-2.1-or-later
"""A colour for each limit that governs: told apart, not ordered."""

from __future__ import annotations

import numpy as np

from ..util.types import Floats, Ints

#: P. Tol's, told apart by all eyes and on both backgrounds; the last is that of all others.
COLOURS = (
    "#4477aa", "#ee6677", "#228833", "#ccbb44", "#66ccee", "#aa3377", "#ee7733", "#44aa99",
    "#882255", "#999933", "#ddcc77", "#bbbbbb",
)  # fmt: skip


def limit_colour(row: int) -> str:
    """The colour of a limit by its row."""
    return COLOURS[min(row, len(COLOURS) - 1)]


def limit_colours(rows: Floats | Ints) -> Floats:
    """(n, 3) red, green and blue from 0 to 1, of (n,) rows of limits."""
    table = np.array([[int(name[k : k + 2], 16) for k in (1, 3, 5)] for name in COLOURS]) / 255.0
    return np.asarray(table[np.minimum(np.rint(rows).astype(np.int64), len(table) - 1)])

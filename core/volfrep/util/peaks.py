# SPDX-License-Identifier: LGPL-2.1-or-later
"""The largest value but for peaks on next to nothing, as in a corner of a support."""

from __future__ import annotations

import numpy as np

from .types import Floats

#: Peaks on so much of an area or a volume do not count.
PEAKS = 0.001


def row_of_most(values: Floats, weights: Floats) -> int:
    """The row of the value that no more than `PEAKS` of the weights goes beyond, of one or more."""
    order = np.argsort(values)
    total = np.cumsum(weights[order])
    return int(order[np.searchsorted(total, (1.0 - PEAKS) * total[-1])])


def most_but_peaks(values: Floats, weights: Floats) -> float:
    """The value that no more than `PEAKS` of the weights goes beyond, of one or more."""
    return float(values[row_of_most(values, weights)])

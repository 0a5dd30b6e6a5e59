# SPDX-License-Identifier: LGPL-2.1-or-later
"""Rows of different lengths laid end to end, without a loop over the rows."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from .types import Ints


def spread(counts: Ints) -> tuple[Ints, Ints]:
    """The owner of each entry of rows laid end to end, and its place in the owner's row.

    >>> owner, place = spread(np.array([2, 3]))
    >>> owner.tolist(), place.tolist()
    ([0, 0, 1, 1, 1], [0, 1, 0, 1, 2])
    """
    owner = np.repeat(np.arange(len(counts)), counts)
    place = np.arange(len(owner)) - np.repeat(np.cumsum(counts) - counts, counts)
    return owner, place


def table_of(owner: Ints, count: int) -> Ints:
    """(count, k) the entries of every owner in their order; -1 where it has fewer than k.

    >>> table_of(np.array([1, 0, 1]), 2).tolist()
    [[1, -1], [0, 2]]
    """
    order = np.argsort(owner, kind="stable")
    number = np.bincount(owner, minlength=count)
    table = np.full((count, int(number.max(initial=0))), -1, np.int64)
    table[owner[order], spread(number)[1]] = order
    return table


def rows_of(start: Ints, index: Ints) -> tuple[Ints, Ints]:
    """Positions of the rows `index`, and which of `index` each belongs to.

    `start` (n + 1,) holds the offsets of n rows that lie end to end.
    """
    first = start[index]
    owner, place = spread(start[index + 1] - first)
    return first[owner] + place, owner


#: Pairs of a triangle and a cell (or a column) that one vectorised step takes at a time: few enough
#: that what it computes of them stays in the cache of a processor.
PAIRS_PER_STEP = 1 << 15


def pairs_in_steps(counts: Ints) -> Iterator[tuple[Ints, Ints]]:
    """All (owner, place) pairs in steps of about `PAIRS_PER_STEP`."""
    total = np.cumsum(counts)
    start = 0
    while start < len(counts):
        base = total[start - 1] if start else 0
        stop = max(int(np.searchsorted(total, base + PAIRS_PER_STEP, "right")), start + 1)
        owner, place = spread(counts[start:stop])
        if len(owner):
            yield owner + start, place
        start = stop

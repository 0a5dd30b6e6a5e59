# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pareto fronts: designs that no other one beats in one figure without losing in another.

Fronts behind the first, and the choice by where designs lie far apart, are the ranks and crowding
distances of Deb et al., IEEE Trans. Evol. Comput. 6 (2002).
"""

from __future__ import annotations

import numpy as np

from ..util.types import Floats, Ints


def ranks(figures: Floats) -> Ints:
    """The front that each design lies on: 0 for the Pareto front, 1 for what is next, ...

    Args:
        figures: (n, k), less is better; a row that is not finite lies behind all others.

    Returns:
        (n,) fronts; equal rows share one.

    >>> ranks(np.array([[1.0, 2.0], [2.0, 1.0], [2.0, 2.0], [np.nan, 0.0]])).tolist()
    [0, 0, 1, 2]
    """
    result = np.full(len(figures), -1)
    finite = np.isfinite(figures).all(axis=1)
    rank = 0
    while (left := np.flatnonzero((result < 0) & finite)).size:
        rows = figures[left]
        # Sorted, a row is beaten by rows before it only: one pass over the front so far.
        order = np.lexsort(rows.T[::-1])
        front: list[int] = []
        for row in order.tolist():
            chosen = rows[front]
            beaten = (chosen <= rows[row]).all(axis=1) & (chosen < rows[row]).any(axis=1)
            if not beaten.any():
                front.append(row)
        result[left[front]] = rank
        rank += 1
    result[~finite] = rank
    return result


def spread(figures: Floats) -> Floats:
    """(n,) how far apart each design of one front lies from its neighbours; infinite at the ends.

    Args:
        figures: (n, k), finite.
    """
    result = np.zeros(len(figures))
    for column in figures.T:
        order = np.argsort(column, kind="stable")
        span = column[order[-1]] - column[order[0]]
        gap = np.full(len(column), np.inf)
        if span > 0.0:
            gap[1:-1] = (column[order[2:]] - column[order[:-2]]) / span
        else:
            gap[1:-1] = 0.0
        result[order] += gap
    return result


def choose(figures: Floats, count: int | None) -> Ints:
    """Rows of the Pareto front; or so many of the best.

    Args:
        figures: (n, k), less is better.
        count: None for the front as it is; else whole fronts as long as they fit, and of the next
            one those that lie farthest apart.

    Returns:
        Rows in ascending order; none of them not finite.

    >>> choose(np.array([[1.0, 2.0], [2.0, 1.0], [2.0, 2.0]]), 3).tolist()
    [0, 1, 2]
    """
    finite = np.isfinite(figures).all(axis=1)
    rank = ranks(figures)
    if count is None:
        return np.flatnonzero((rank == 0) & finite)
    taken: list[int] = []
    for front in range(int(rank.max(initial=-1)) + 1):
        rows = np.flatnonzero((rank == front) & finite)
        free = count - len(taken)
        if len(rows) > free:
            apart = np.argsort(-spread(figures[rows]), kind="stable")
            rows = rows[apart[:free]]
        taken += rows.tolist()
    return np.sort(np.array(taken, np.int64))

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pareto fronts, against what comparing every pair gives."""

from __future__ import annotations

import numpy as np
import pytest

from volfrep.studies.pareto import choose, ranks, spread


def beaten_by_pairs(figures):
    """Fronts by their definition: take away what nothing left beats, again and again."""
    left, result, rank = set(range(len(figures))), {}, 0
    while left:
        front = {
            i
            for i in left
            if not any(
                (figures[j] <= figures[i]).all() and (figures[j] < figures[i]).any() for j in left
            )
        }
        result |= dict.fromkeys(front, rank)
        left, rank = left - front, rank + 1
    return [result[i] for i in range(len(figures))]


@pytest.mark.parametrize("goals", [1, 2, 3])
def test_fronts_are_those_of_comparing_every_pair(goals: int) -> None:
    random = np.random.default_rng(goals)
    figures = random.integers(0, 7, (60, goals)).astype(float)  # with many ties
    assert ranks(figures).tolist() == beaten_by_pairs(figures)


def test_a_design_without_figures_is_never_chosen() -> None:
    figures = np.array([[1.0, np.nan], [2.0, 2.0], [3.0, 3.0]])
    assert choose(figures, None).tolist() == [1]
    assert choose(figures, 5).tolist() == [1, 2]


def test_of_a_front_that_is_too_long_its_ends_stay_and_a_cluster_is_thinned() -> None:
    across = np.array([0.0, 0.5, 0.51, 0.52, 1.0])
    figures = np.stack([across, 1.0 - across], axis=1)
    assert choose(figures, 3).tolist() in ([0, 1, 4], [0, 3, 4])
    assert np.isinf(spread(figures)[[0, 4]]).all()


def test_a_front_that_is_too_short_is_filled_from_the_next() -> None:
    figures = np.array([[0.0, 1.0], [1.0, 0.0], [1.0, 1.0], [2.0, 2.0]])
    assert choose(figures, None).tolist() == [0, 1]
    assert choose(figures, 3).tolist() == [0, 1, 2]

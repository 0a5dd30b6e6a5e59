# SPDX-License-Identifier: LGPL-2.1-or-later
"""Round numbers along a scale."""

import pytest

from volfrep.util.numbers import round_values


@pytest.mark.parametrize(
    ("low", "high", "expected"),
    [
        (0.0, 150.43, [0, 50, 100, 150]),
        (-0.031, 0.052, [-0.02, 0, 0.02, 0.04]),
        (100.0, 100.4, [100.0, 100.1, 100.2, 100.3, 100.4]),
        (2.5e5, 6.1e6, [1e6, 2e6, 3e6, 4e6, 5e6, 6e6]),
    ],
)
def test_values_are_multiples_of_a_round_step_within_the_scale(low, high, expected):
    assert round_values(low, high, 4) == pytest.approx(expected)

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Points that a file of single precision would take for one."""

import numpy as np
import pytest

from volfrep.mesh.precision import merging
from volfrep.util.threads import use_threads


@pytest.mark.parametrize("count", [1, 3])
def test_twins_among_many_points_are_found_on_any_threads(count: int) -> None:
    points = np.random.default_rng(0).uniform(-50.0, 50.0, (100_000, 3))
    points[[99_000, 40_000, 7]] = points[[12, 40_001, 70_007]]
    points[12] += 1e-9  # less than a step of single precision
    use_threads(count)
    try:
        twins = merging(points, 1e-6).reshape(-1, 2)
    finally:
        use_threads(0)
    assert {tuple(sorted(pair)) for pair in twins.tolist()} == {
        (12, 99_000), (40_000, 40_001), (7, 70_007),
    }  # fmt: skip

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Points that a file of single precision would take for one."""

import numpy as np
import pytest
from scipy.spatial import cKDTree

from volfrep.mesh.precision import CUBE, merging, near_others
from volfrep.process.pool import backend_of, processes
from volfrep.util.parallel import ParallelBackend
from volfrep.util.threads import use_threads


def found_twins(backend: ParallelBackend) -> set[tuple[int, int]]:
    points = np.random.default_rng(0).uniform(-50.0, 50.0, (100_000, 3))
    points[[99_000, 40_000, 7]] = points[[12, 40_001, 70_007]]
    points[12] += 1e-9  # less than a step of single precision
    pairs = merging(points, 1e-6, backend).reshape(-1, 2)
    return {(min(pair), max(pair)) for pair in pairs.tolist()}


TWINS = {(12, 99_000), (40_000, 40_001), (7, 70_007)}


@pytest.mark.parametrize("count", [1, 3])
def test_twins_among_many_points_are_found_on_any_threads(count: int) -> None:
    use_threads(count)
    try:
        assert found_twins(ParallelBackend()) == TWINS
    finally:
        use_threads(0)


@pytest.mark.costly
def test_workers_find_them_too() -> None:
    with processes(2) as executor:
        assert found_twins(backend_of(executor)) == TWINS


def test_all_points_near_others_are_found_and_few_more() -> None:
    rng, reach = np.random.default_rng(3), 1e-5
    points = rng.uniform(-50.0, 50.0, (200_000, 3))
    # Beside faces of cubes, too, where two that are near lie in different ones.
    points[:1000] = np.round(points[:1000] / (CUBE * reach)) * (CUBE * reach)
    points[:4000] += rng.uniform(-0.5, 0.5, (4000, 3)) * reach
    points[100_000:104_000] = points[:4000] + rng.uniform(-0.9, 0.9, (4000, 3)) * reach
    pairs = cKDTree(points).query_pairs(reach, p=np.inf, output_type="ndarray")
    assert len(pairs) >= 4000
    found = near_others(points, reach)
    assert np.isin(pairs, found).all()
    assert len(found) < 8000 + 0.05 * len(points)


@pytest.mark.parametrize("count", [0, 1])
def test_too_few_points_to_be_near_others(count: int) -> None:
    assert not len(near_others(np.full((count, 3), 0.3), 1e-5))

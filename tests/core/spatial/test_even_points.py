"""Points that fill a square or a cube evenly, and what is not loaded for them."""

from __future__ import annotations

import itertools
import subprocess
import sys

import numpy as np
import pytest
from scipy.stats import qmc

from volfrep.spatial.even_points import even_directions, even_points


@pytest.mark.parametrize("seed", [1, 5])
@pytest.mark.parametrize("dimensions", [1, 2, 3])
def test_points_are_those_of_scipy(dimensions: int, seed: int) -> None:
    for points_log2 in (0, 1, 11):
        theirs = qmc.Sobol(dimensions, seed=seed).random_base2(points_log2)
        assert np.array_equal(even_points(dimensions, points_log2, seed), theirs)


@pytest.mark.parametrize(("dimensions", "in_each"), [(1, 1), (2, 1), (3, 2)])
def test_every_dyadic_box_holds_as_many(dimensions: int, in_each: int) -> None:
    points = even_points(dimensions, 9)
    halvings = 9 - (in_each - 1)
    for sides in itertools.product(range(halvings + 1), repeat=dimensions):
        if sum(sides) == halvings:
            box = np.floor(points * 2.0 ** np.array(sides)).astype(np.int64)
            count = np.unique(box, axis=0, return_counts=True)[1]
            assert len(count) == 2**halvings
            assert (count == in_each).all()


def test_scipy_stats_is_not_loaded_for_them() -> None:
    code = (
        "import sys; from volfrep.spatial.even_points import even_points; even_points(3, 4); "
        "import volfrep.jobs.infill, volfrep.design.forecast; "
        "sys.exit('scipy.stats' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


def test_directions_lie_evenly_over_a_sphere() -> None:
    ways = even_directions(500)
    assert np.allclose(np.linalg.norm(ways, axis=1), 1.0)
    # As many lie in every cap as its share of the sphere, about whichever axis.
    for axis in (*np.eye(3), np.full(3, 3.0**-0.5)):
        for height in (-0.5, 0.0, 0.7):
            inside = np.mean(ways @ axis > height)
            assert inside == pytest.approx(0.5 * (1.0 - height), abs=0.01)

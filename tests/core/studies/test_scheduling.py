# SPDX-License-Identifier: LGPL-2.1-or-later
"""Who does which run, and when: long ones first, what shares a wall together, nobody waits long."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

import samples
from volfrep import Study
from volfrep.io.solid import check_solid
from volfrep.studies.designs import Design, designs_of, named_part
from volfrep.studies.running.scheduling import group_designs

PART = named_part("", check_solid(samples.box((60.0, 60.0, 60.0)), "box"))
RADII = tuple(0.5 + 0.02 * k for k in range(20))


def designs(shells: tuple[float, ...] = (1.0,)) -> tuple[Design, ...]:
    vary = {"cell": ("BCC", "CVC"), "strut_radius": RADII, "shell": shells}
    solid = check_solid(samples.box((60.0, 60.0, 60.0)), "box")
    study = Study(parts=(solid,), vary=vary, fixed={"cell_size": 12.0})
    return designs_of(study, (PART,)).designs


def ends(groups: list[list[Design]], seconds: dict[str, float], workers: int) -> list[float]:
    """When each worker has done its last run, where whoever is free takes the next batch."""
    times = [0.0] * workers
    for group in groups:
        first = times.index(min(times))
        times[first] += sum(seconds[design.key] for design in group)
    return times


@pytest.mark.parametrize("workers", [2, 3, 8])
def test_no_worker_waits_longer_than_for_a_long_run_though_forecasts_are_wrong(
    workers: int,
) -> None:
    found = designs()
    random = np.random.default_rng(1)
    for _ in range(50):
        told = {d.key: float(random.uniform(1.0, 3.0)) for d in found}
        taken = {key: value * float(random.uniform(0.7, 1.5)) for key, value in told.items()}
        done = ends(group_designs(found, told, workers, True), taken, workers)
        assert max(done) - min(done) <= 1.5 * max(taken.values())


def test_every_design_is_in_one_batch_and_batches_get_shorter() -> None:
    found = designs((1.0, 2.0))
    for meshed in (False, True):
        groups = group_designs(found, {design.key: 1.0 for design in found}, 2, meshed)
        keys = [design.key for group in groups for design in group]
        assert sorted(keys) == sorted(design.key for design in found)
        sizes = [len(group) for group in groups]
        assert sizes == sorted(sizes, reverse=True)
        assert sizes[-1] == 1


def test_what_shares_a_wall_is_side_by_side_the_longest_first() -> None:
    found = designs((1.0, 2.0))
    weights = {design.key: design.spec.strut_radius for design in found}
    order = [design for group in group_designs(found, weights, 2, True) for design in group]
    shells = [design.spec.shell for design in order]
    assert shells == sorted(shells)
    for shell in (1.0, 2.0):
        along = [weights[design.key] for design in order if design.spec.shell == shell]
        assert along == sorted(along, reverse=True)


def test_without_meshes_the_same_lattice_is_looked_at_once() -> None:
    found = designs((1.0, 2.0))
    groups = group_designs(found, {design.key: 1.0 for design in found}, 1, False)
    lattices = [(d.spec.unit_cell().name, d.spec.strut_radius) for group in groups for d in group]
    assert sum(a != b for a, b in pairwise(lattices)) + 1 == len(set(lattices))

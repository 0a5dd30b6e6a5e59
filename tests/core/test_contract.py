# SPDX-License-Identifier: LGPL-2.1-or-later
"""Whatever is asked for, what comes out is one closed surface, also as a reader sees it."""

import numpy as np
import pytest

import samples
from contract import check_contract
from samples import SKEW
from volfrep import LatticeSpec
from volfrep.design.cells import PAPERS, find_cell

SOLIDS = (
    lambda: samples.box(),
    lambda: samples.sphere(),
    lambda: samples.plate(),
    lambda: samples.bracket(0.0),
    lambda: samples.bracket(17.0),
)


def random_case(seed):
    random = np.random.default_rng(seed)
    solid = SOLIDS[random.integers(len(SOLIDS))]()
    size = np.sort(np.ptp(solid.bounds, axis=0))
    cell_size = float(np.round(random.uniform(0.15, 0.6) * size[1], random.integers(0, 3)))
    return solid, LatticeSpec(
        cell=random.choice([*map(find_cell, PAPERS), SKEW]),
        cell_size=cell_size,
        strut_radius=cell_size * float(np.round(random.uniform(0.05, 0.2), random.integers(2, 4))),
        shell=float(random.choice([0.0, 0.05, 0.08, 0.15]) * size[0]),
        activation=str(random.choice(["touching", "centre"])),
        output=str(random.choice(["part", "lattice"])),
        fillet=0.03 * cell_size * float(random.integers(2)),
        origin=None if random.random() < 0.5 else tuple(np.round(random.uniform(-9, 9, 3), 1)),
        resolution=int(random.integers(8, 22)),
    )


@pytest.mark.slow_but("0", "1")
@pytest.mark.parametrize(
    "seed",
    [pytest.param(s, marks=pytest.mark.slow if s >= 12 or s in (6, 9) else ()) for s in range(80)],
)
def test_random_specifications_hold_the_contract(seed):
    solid, spec = random_case(seed)
    check_contract(solid, spec, refusals=("reduce",))  # a sentence that says what to do

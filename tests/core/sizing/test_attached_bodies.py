# SPDX-License-Identifier: LGPL-2.1-or-later
"""Bodies that hang on a part: its frequencies, and what accelerations do to them."""

import numpy as np
import pytest

import samples
from volfrep import LatticeSpec
from volfrep.fem.calculix import find_calculix
from volfrep.jobs.infill import Infill
from volfrep.jobs.sizing import Goal, size
from volfrep.jobs.sizing.part_model import part_model
from volfrep.loads.load_cases import with_weights
from volfrep.loads.load_file import load_cases_of
from volfrep.sizing.analysis import Limits, analyse
from volfrep.util.cache import StageCache
from volfrep.util.errors import VolfrepError
from volfrep.util.progress import Monitor

END = {"point": [40, 0, 0], "normal": [1, 0, 0]}


def loads(*masses, force=(0, 0, -100), pull=(0, 0, 0)):
    return load_cases_of(
        {
            "material": "Ti-6Al-4V",
            "support": [{"plane": {"point": [0, 0, 0], "normal": [1, 0, 0]}, "fixed": True}],
            "mass": [{"plane": END, "mass": mass} for mass in masses],
            "case": [{"load": [{"plane": END, "force": list(force)}], "acceleration": list(pull)}],
        }
    )


def model_of(given, shell):
    spec = LatticeSpec("CVC", cell_size=10.0, strut_radius=0.8, shell=shell)
    if not shell:
        spec = LatticeSpec("CVC", cell_size=10.0, strut_radius=0.8, shell=0.0, boundary="whole")
    infill = Infill(samples.box((40.0, 20.0, 10.0)), spec, monitor=Monitor(), cache=StageCache())
    problem = part_model(infill, given, Goal(thinnest=0.4), StageCache()).problem
    return problem, np.clip(np.full(len(problem.low), 0.8), problem.low, problem.high)


@pytest.mark.costly_cases("skinned")
@pytest.mark.parametrize("shell", [0.0, 1.0], ids=["bare", "skinned"])
def test_a_heavy_body_swings_as_on_a_spring(shell):
    """Of the part's stiffness across at its end, sqrt(k / m) / 2 pi; the softer way is lowest."""
    mass = 50.0  # kg, beside which the part weighs nothing
    problem, radii = model_of(loads(f"{mass} kg"), shell)
    assert problem.structure.attached.sum() == pytest.approx(mass * 1e-3)
    found = analyse(problem, radii, Limits(frequency=1.0))[0]
    softest = max(
        analyse(model_of(loads(force=way), shell)[0], radii, Limits())[0].compliance[0] / 1e4
        for way in ((0, 0, -100), (0, 100, 0), (0, 70.7106781, 70.7106781))
    )
    expected = np.sqrt(1.0 / softest / (mass * 1e-3)) / (2.0 * np.pi)
    # Its end plane may also give way unevenly.
    assert found.frequency == pytest.approx(expected, rel=0.04)
    assert found.frequency <= expected * 1.0001


def test_an_acceleration_pulls_at_it_by_its_weight():
    given = with_weights(loads("2 kg", 500.0, pull=(0, 0, "-1 g")))
    _, one, other = given.cases[0].loads
    assert one.force == pytest.approx((0, 0, -2e-3 * 9806.65))
    assert other.force == pytest.approx((0, 0, -0.5e-3 * 9806.65))
    still = with_weights(loads("2 kg"))
    assert len(still.cases[0].loads) == 1


@pytest.mark.costly
@pytest.mark.skipif(find_calculix() is None, reason="CalculiX is not installed")
@pytest.mark.parametrize("shell", [0.0, 1.0], ids=["bare", "skinned"])
def test_calculix_finds_the_same_frequency(shell):
    spec = LatticeSpec("CVC", cell_size=10.0, strut_radius=0.8, shell=shell)
    if not shell:
        spec = LatticeSpec("CVC", cell_size=10.0, strut_radius=0.8, shell=0.0, boundary="whole")
    goal = Goal(Limits(frequency=200.0 if shell else 60.0), thinnest=0.4)
    made = size(samples.box((40.0, 20.0, 10.0)), spec, loads("1 kg"), goal, most_steps=2)
    assert made.report["lowest_frequency_hz"] < 2_000.0
    assert made.report["calculix"]["lowest_frequency"] == pytest.approx(1.0, abs=0.1)


def test_a_mass_that_makes_no_sense_is_refused():
    with pytest.raises(VolfrepError, match="mass 1"):
        loads("2 N")
    with pytest.raises(VolfrepError, match="must be above 0"):
        loads(-1.0)

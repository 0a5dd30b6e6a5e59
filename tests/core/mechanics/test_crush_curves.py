# SPDX-License-Identifier: LGPL-2.1-or-later
"""Shipped crush curves, and the cells that are found by them."""

import numpy as np
import pytest

from volfrep import VolfrepError
from volfrep.cli.command import run
from volfrep.jobs.crushing import crush
from volfrep.mechanics.crush_curves import find_cushions, known_cushions, mean_stress, work


def test_work_and_mean_stress_of_a_curve():
    strain, stress = np.array([0.0, 0.1, 0.3]), np.array([0.0, 2.0, 4.0])
    assert work(strain, stress, 0.1) == pytest.approx(0.1)
    assert mean_stress(strain, stress, 0.1) == pytest.approx(3.0)
    assert mean_stress(strain[:2], stress[:2], 0.2) is None


def test_denser_lattices_have_a_higher_plateau():
    assert {material for _, material in known_cushions()} == {"PA12", "TPU", "Ti-6Al-4V"}
    for rows in known_cushions().values():
        assert (np.diff([one.plateau for one in rows]) > 0.0).all()


@pytest.mark.costly
def test_a_shipped_curve_is_what_the_engine_computes():
    shipped = known_cushions()["Kelvin", "TPU"][0]
    found = crush("Kelvin", 10, relative_density=shipped.relative_density, material="TPU")
    assert found.plateau == pytest.approx(shipped.plateau, rel=0.01)
    assert found.energy_to(0.3) == pytest.approx(shipped.energy, rel=0.01)


def test_a_cushion_found_by_its_plateau_has_it(capsys: pytest.CaptureFixture[str]):
    low, high = (one.plateau for one in known_cushions()["Kelvin", "TPU"][:2])
    wanted = float(np.sqrt(low * high))
    found = next(one for one in find_cushions(wanted, "tpu") if one.cell == "Kelvin")
    assert 0.1 < found.relative_density < 0.2
    assert run(["find", "--plateau", str(wanted), "--material", "TPU"]) == 0
    assert "Kelvin" in capsys.readouterr().out
    assert run(["find", "--plateau", str(wanted)]) == 2
    with pytest.raises(VolfrepError, match="No crush curves of PETG ship"):
        find_cushions(1.0, "PETG")

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Blocks between plates: squash load, a solid's curve, figures of a curve, the command."""

import json
from pathlib import Path

import numpy as np
import pytest

import volfrep
from volfrep import VolfrepError
from volfrep.cli.command import run
from volfrep.jobs.crushing import CrushCurve, crush
from volfrep.mechanics.materials import MATERIALS, SolidMaterial

PA12 = MATERIALS["pa12"]


def test_upright_struts_are_squashed_at_their_yield_stress():
    found = crush("Box", 10, 1, material="PA12", count=1, strain=0.05)
    columns = 4.0 * np.pi / 100.0
    # Beyond it they harden and widen, by 7 % where they begin to bend.
    squash = columns * PA12.yield_stress
    assert squash < found.peak[1] < 1.1 * squash
    assert found.modulus == pytest.approx(columns * PA12.young, rel=0.12)  # joints stiffen it


def test_a_cell_is_crushed_as_its_tetrahedra_are():
    # CalculiX, C3D10 with NLGEOM: 10,061 nodes, plates at the outer joints' middles, hardening by
    # the yield stress over a plastic strain of 1.
    strain = [0.004, 0.014, 0.023, 0.033, 0.053, 0.073, 0.093, 0.123, 0.153, 0.2]
    stress = [1.082, 3.806, 6.187, 7.181, 7.897, 8.165, 8.297, 8.410, 8.480, 8.553]
    found = crush("BCC", 10, 1, material="PA12", count=1, strain=0.2)
    told = np.interp(strain, found.strain, found.stress)
    assert told == pytest.approx(stress, rel=0.1)  # 9 % too stiff at first
    assert told[3:] == pytest.approx(stress[3:], rel=0.04)
    solid = 0.5 * np.diff([0, *strain]) @ np.convolve([0, *stress], [1, 1], "valid")
    assert found.energy_to(0.2) == pytest.approx(solid, rel=0.03)


@pytest.mark.costly
def test_rubber_comes_back_and_stiff_cells_soften():
    rubber = SolidMaterial("Rubber", 1.2, 60.0, 0.45)
    found = crush("Kelvin", 10, 0.8, material=rubber, count=1, strain=0.2)
    assert (np.diff(found.stress) > 0).all()
    stretched = crush("Octet", 10, 0.5, material="PA12", count=1, strain=0.2)
    assert stretched.stress[-1] < 0.6 * stretched.peak[1]


def test_figures_of_a_curve():
    strain = np.array([0.0, 0.05, 0.1, 0.2, 0.3])
    curve = CrushCurve("any", 10, 1, 3, PA12, 0.2, strain, np.array([0.0, 2.0, 1.0, 1.0, 3.0]))
    assert curve.modulus == pytest.approx(40.0)
    assert curve.peak == pytest.approx((0.05, 2.0))
    assert curve.plateau == pytest.approx(2.0)
    assert curve.energy_to(0.1) == pytest.approx(0.05 + 0.075)
    assert volfrep.crush is crush


def test_the_command_writes_curve_and_figures(tmp_path: Path, capsys: pytest.CaptureFixture[str]):
    curve, figures = tmp_path / "curve.csv", tmp_path / "figures.json"
    asked = ["crush", "BCC", "--cell-size", "10", "--relative-density", "0.05", "--cells", "1"]
    out = ["--material", "PA12", "--strain", "0.01", "-o", str(curve), "--json", str(figures)]
    assert run([*asked, *out]) == 0
    assert "absorbed energy" in capsys.readouterr().out
    rows = np.loadtxt(curve, delimiter=",", skiprows=1)
    told = json.loads(figures.read_text())
    assert rows[:, 1] == pytest.approx(told["stress_MPa"], rel=1e-5)
    assert told["relative_density"] == pytest.approx(0.05, rel=1e-3)


def test_what_cannot_be_crushed_is_said():
    with pytest.raises(VolfrepError, match="with struts and not"):
        crush("Gyroid", 10, 1, material="PA12")
    with pytest.raises(VolfrepError, match=r"at most 0\.5"):
        crush("BCC", 10, 1, material="PA12", strain=0.9)
    with pytest.raises(VolfrepError, match="either a strut radius"):
        crush("BCC", 10, material="PA12")
    with pytest.raises(VolfrepError, match="strut radius"):
        crush("BCC", 10, 0, material="PA12")
    with pytest.raises(volfrep.Cancelled):
        crush("BCC", 10, 1, material="PA12", count=1, progress=lambda done, stage: False)

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cells by what they do, from the catalogue."""

import json

import pytest

import volfrep
from command import run


def test_each_cell_that_is_found_has_the_modulus_and_the_lightest_is_first():
    found = volfrep.find(modulus=40, material="PA12", direction="111")
    assert len(found) > 10
    for one in found:
        assert one.young((1, 1, 1)) == pytest.approx(40, rel=5e-3)
        again = volfrep.properties(one.cell, one.cell_size, one.strut_radius, material="PA12")
        assert again.values == one.values
    densities = [one.relative_density for one in found]
    assert densities == sorted(densities)


def test_of_a_density_the_stiffest_and_with_a_modulus_the_nearest_is_first():
    stiffest = volfrep.find(relative_density=0.1)
    assert all(one.relative_density == pytest.approx(0.1, rel=1e-3) for one in stiffest)
    moduli = [one.values["E100"] for one in stiffest]
    assert moduli == sorted(moduli, reverse=True)
    wanted = moduli[len(moduli) // 2]
    assert volfrep.find(relative_density=0.1, modulus=wanted)[0].values["E100"] == wanted


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({}, "a modulus or a relative density"),
        ({"modulus": "x"}, "modulus must be a number"),
        ({"modulus": 1, "direction": "12"}, "no direction"),
        ({"modulus": 1, "material": 5}, "'material' is"),
    ],
)
def test_what_makes_no_sense_is_refused(given, words):
    with pytest.raises(volfrep.VolfrepError, match=words):
        volfrep.find(**given)


def test_the_command_tells_cells_with_their_errors(tmp_path, capsys):
    out = tmp_path / "found.json"
    wanted = ("--modulus", 50, "--density", 0.2, "--material", "PA12", "--direction", "z")
    assert run("find", *wanted, "--most", 3, "--json", out) == 0
    head, *rows, more = capsys.readouterr().out.splitlines()
    assert "E along z, MPa" in head
    assert len(rows) == 3
    assert more.startswith("and ")
    name, told = rows[0].split()[0], float(rows[0].split(" %")[1].split()[0])
    again = volfrep.find(modulus=50, relative_density=0.2, material="PA12", direction="z")[0]
    assert name == again.cell
    assert told == pytest.approx(again.young((0, 0, 1)), rel=1e-3)
    kept = json.loads(out.read_text())
    assert kept[0]["cell"] == again.cell
    assert run("find", "--modulus", 1e8, "--material", "PA12") == 2
    assert run("find") == 2

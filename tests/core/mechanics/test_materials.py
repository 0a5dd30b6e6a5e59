# SPDX-License-Identifier: LGPL-2.1-or-later
"""Materials by name, from files and as three numbers; what fill and block do with them."""

import json
from functools import partial
from pathlib import Path

import pytest

import command
from volfrep import VolfrepError
from volfrep.mechanics.materials import MATERIALS, SolidMaterial, find_material
from volfrep.reports.processes import PROCESSES

LATTICE = ["--cell", "CVC", "--cell-size", "10", "--strut-radius", "1", "--resolution", "8"]
block = partial(command.block, LATTICE)


def test_the_table_is_complete_and_every_process_is_known():
    names = {
        "Ti-6Al-4V",
        "AlSi10Mg",
        "316L",
        "IN718",
        "PA12",
        "PA11",
        "TPU",
        "PLA",
        "PETG",
        "ABS",
        "Resin",
    }
    assert {material.name for material in MATERIALS.values()} == names
    for material in MATERIALS.values():
        # Of each figure: who says it, or that nobody was asked.
        assert material.source
        for figure in ("density", "modulus", "nu", "yield|strength"):
            told = any(word in material.source for word in figure.split("|"))
            assert told or "not checked" in material.source, (material.name, figure)
        assert material.yield_stress or material.name == "TPU"  # which stays elastic
        assert set(material.processes) <= set(PROCESSES)
        assert material.processes


def test_names_in_any_case_and_three_numbers():
    assert find_material("ti-6al-4v") is MATERIALS["ti-6al-4v"]
    steel = find_material("STEEL,210000,0.3")
    assert (steel.name, steel.young, steel.poisson) == ("STEEL", 210_000.0, 0.3)
    assert find_material("PA12,1700,0.39").density == MATERIALS["pa12"].density


@pytest.mark.parametrize("suffix", [".toml", ".json"])
def test_a_file_of_ones_own(tmp_path: Path, suffix):
    values = {"name": "Mine", "density": 1.02, "young": 1700, "poisson": 0.4, "yield_stress": 45}
    lines = [f"{name} = {json.dumps(value)}" for name, value in values.items()]
    path = tmp_path / f"mine{suffix}"
    path.write_text(json.dumps(values) if suffix == ".json" else "\n".join(lines))
    assert find_material(str(path)) == SolidMaterial(
        "Mine", 1.02, 1700.0, 0.4, 45.0, source=path.name
    )


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("{", "is not valid JSON"),
        ("[]", "must hold names and values"),
        ('{"density": 1, "young": 1}', "has no 'poisson'"),
        ('{"density": 1, "young": 1, "poisson": 0.3, "colour": 1}', "unknown entry 'colour'"),
        ('{"density": "a", "young": 1, "poisson": 0.3}', "must be numbers"),
        ('{"density": 1, "young": -1, "poisson": 0.3}', "above 0"),
        ('{"density": 1, "young": 1, "poisson": 0.5}', "between -1 and 0.5"),
        ('{"name": "a b", "density": 1, "young": 1, "poisson": 0.3}', "must consist of"),
    ],
)
def test_a_file_that_makes_no_sense(tmp_path: Path, text, said):
    path = tmp_path / "m.json"
    path.write_text(text)
    with pytest.raises(VolfrepError, match=said):
        find_material(str(path))


def test_a_file_that_is_not_there(tmp_path: Path):
    with pytest.raises(VolfrepError, match="Cannot read the material file"):
        find_material(str(tmp_path / "none.toml"))
    with pytest.raises(VolfrepError, match="no material 'mud': choose one of Ti-6Al-4V"):
        find_material("mud")


@pytest.mark.costly
def test_a_material_gives_the_mass_and_a_process_its_report(tmp_path: Path, capsys):
    report = tmp_path / "r.json"
    assert block(tmp_path / "a.stl", "--material", "316L", "--report", report) == 0
    figures = json.loads(report.read_text())
    assert figures["mass_g"] == pytest.approx(figures["volume_mm3"] * 7.97e-3)
    assert block(tmp_path / "a.stl", "--material", "316L", "--density", 8, "--report", report) == 0
    assert json.loads(report.read_text())["spec"]["density"] == 8
    capsys.readouterr()
    assert block(tmp_path / "a.stl", "--material", "PLA", "--process", "ebm") == 0
    said = capsys.readouterr()
    assert "PLA is printed by FFF, not by EBM" in said.err
    assert "EBM, metal powder, electron beam" in said.out


def test_a_deck_has_the_materials_modulus(tmp_path: Path):
    deck = tmp_path / "a.inp"
    assert block(deck, "--material", "alsi10mg", "--process", "LPBF", "--quiet") == 0
    text = deck.read_text()
    assert "*MATERIAL,NAME=AlSi10Mg\n*ELASTIC\n70000,0.33\n*DENSITY\n2.67e-09" in text
    assert block(tmp_path / "a.stl", "--material", "STEEL,1,0.3") == 2

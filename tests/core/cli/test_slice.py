# SPDX-License-Identifier: LGPL-2.1-or-later
"""``volfrep slice``: a file in, a folder of layers out."""

import json
from pathlib import Path

import pytest

import samples
from command import run
from volfrep.io.write.stl import write_stl

LATTICE = ("--cell", "BCC", "--cell-size", 8, "--strut-radius", 0.8, "--shell", 1)


@pytest.fixture
def part(tmp_path: Path) -> Path:
    path = tmp_path / "part.stl"
    write_stl(samples.box((20.0, 16.0, 8.0)), path)
    return path


@pytest.mark.parametrize(
    ("form", "first"),
    [("png", "layer_000000.png"), ("svg", "layer_000000.svg"), ("cli", "part.cli")],
)
def test_a_file_becomes_a_folder_of_layers(form, first, part, tmp_path, capsys):
    out = tmp_path / "layers"
    assert run("slice", part, "-o", out, "--layer", 0.5, "--format", form, *LATTICE) == 0
    figures = json.loads((out / "layers.json").read_text())
    assert figures["layers"][0]["file"] == first
    assert (out / first).stat().st_size > 100
    printed = capsys.readouterr().out
    assert "layers  16" in printed
    assert "volume" in printed


def test_the_density_of_a_material_gives_the_mass(part, tmp_path, capsys):
    out = tmp_path / "layers"
    wanted = ("--layer", 2, "--material", "Ti-6Al-4V", "--quiet")
    assert run("slice", part, "-o", out, *wanted, *LATTICE) == 0
    figures = json.loads((out / "layers.json").read_text())
    assert figures["mass_g"] == pytest.approx(4.43e-3 * figures["volume_mm3"], rel=0.01)
    assert capsys.readouterr().out == ""


def test_a_file_in_the_way_is_kept(part, tmp_path, capsys):
    assert run("slice", part, "-o", part, "--layer", 2, *LATTICE) == 2
    assert part.is_file()
    assert capsys.readouterr().err.startswith("volfrep: ")

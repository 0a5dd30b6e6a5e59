# SPDX-License-Identifier: LGPL-2.1-or-later
"""A whole specification from a file and into one: options override the file's entries."""

import json
from pathlib import Path

import pytest

from command import run
from volfrep.cli import command as cli
from volfrep.design.parameters.spec_file import read_spec

GRADED = """
cell = "Box"
cell_size = "1 cm"
strut_radius = 0.7
radius_grading = "direction"
radius_end = 1.1
radius_direction = [0, 0, 2]
resolution = 12
density = "2700 kg/m3"
"""


def made(folder: Path, *options: object) -> dict[str, object]:
    """The specification in the report of a block of one cell."""
    report = folder / "report.json"
    out = folder / "x.stl"
    assert run("block", "-o", out, "--count", "1,1,1", "--report", report, *options) == 0
    return dict(json.loads(report.read_text())["spec"])


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "graded.toml"
    path.write_text(GRADED)
    return path


def test_a_block_needs_nothing_but_its_count(tmp_path: Path) -> None:
    spec = made(tmp_path, "--quiet")
    assert (spec["cell"], spec["cell_size"], spec["strut_radius"]) == ("CVC", 10, 1)


def test_a_file_says_everything(tmp_path: Path, file: Path) -> None:
    spec = made(tmp_path, "--spec", file)
    assert (spec["cell"], spec["cell_size"], spec["density"]) == ("Box", 10, 2.7)
    grading = spec["radius_grading"]
    assert isinstance(grading, dict)
    assert (grading["profile"]["start"], grading["profile"]["end"]) == (0.7, 1.1)
    assert grading["direction"] == [0, 0, 2]


def test_options_override_a_file_and_what_they_leave_idle_goes(tmp_path: Path, file: Path) -> None:
    plain = made(tmp_path, "--spec", file, "--radius-grading", "none", "--cell", "BCC")
    assert (plain["cell"], plain["radius_grading"], plain["cell_size"]) == ("BCC", None, 10)
    other = made(tmp_path, "--spec", file, "--deviation", "0.05")
    assert (other["resolution"], other["deviation"]) == (None, 0.05)


@pytest.mark.costly
def test_what_was_in_force_is_written_and_read_again(tmp_path: Path, file: Path) -> None:
    again = tmp_path / "again.toml"
    spec = made(tmp_path, "--spec", file, "--strut-radius", "0.6", "--write-spec", again)
    assert made(tmp_path, "--spec", again) == spec
    assert read_spec(again).strut_radius == 0.6


def test_what_a_network_was_made_with_is_written_and_read_again(tmp_path: Path) -> None:
    graph, spec = tmp_path / "graph.csv", tmp_path / "spec.toml"
    graph.write_text("0,0,0,9,9,9\n9,9,9,18,0,0\n")
    first, again = tmp_path / "first.stl", tmp_path / "again.stl"
    given = ("--strut-radius", "0.7", "--deviation", "0.05", "--write-spec", spec)
    assert run("network", graph, "-o", first, *given) == 0
    found = read_spec(spec)
    assert (found.strut_radius, found.deviation) == (0.7, 0.05)
    assert run("network", graph, "-o", again, "--spec", spec) == 0
    assert again.read_bytes() == first.read_bytes()


def test_an_entry_without_effect_is_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "idle.toml"
    path.write_text("radius_reach = 4\n")
    block = ["block", "-o", str(tmp_path / "x.stl"), "--count", "1,1,1", "--spec", str(path)]
    assert cli.run(block) == 2
    said = capsys.readouterr().err
    assert f"{path}: radius_reach has no effect without" in said
    assert said.count("\n") == 1


def test_mesh_and_specification_are_two_files(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = str(tmp_path / "x.stl")
    assert cli.run(["block", "-o", out, "--count", "1,1,1", "--write-spec", out]) == 2
    assert "cannot both be written" in capsys.readouterr().err


@pytest.mark.costly
def test_a_recipe_goes_by_its_name(tmp_path: Path) -> None:
    spec = made(tmp_path, "--spec", "cushion", "--cell-size", 9)
    assert (spec["cell"], spec["cell_size"]) == ("Kelvin", 9.0)
    assert run("block", "-o", tmp_path / "x.stl", "--count", "1,1,1", "--spec", "pillow") == 2

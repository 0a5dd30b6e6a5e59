# SPDX-License-Identifier: LGPL-2.1-or-later
"""Designs under load: solved as they are, sized, and what that hangs on."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

import samples
import volfrep
from command import run
from volfrep import Front, Study, VolfrepError
from volfrep.io.solid import check_solid, read_triangles
from volfrep.io.write.stl import write_stl
from volfrep.studies.study import read_study

LOADS = """
material = "Ti-6Al-4V"
yield_stress = 900
[[support]]
plane = { point = [0, 0, 0], normal = [1, 0, 0] }
fixed = true
[[case]]
name = "down"
[[case.load]]
plane = { point = [30, 0, 0], normal = [1, 0, 0] }
force = [0, 0, -FORCE]
[[case]]
name = "aside"
[[case.load]]
plane = { point = [30, 0, 0], normal = [1, 0, 0] }
force = [0, 20, 0]
"""


@pytest.fixture
def beam(tmp_path: Path) -> Study:
    part = check_solid(samples.box((30.0, 20.0, 20.0)), "box")
    write_stl(part, tmp_path / "part.stl")
    (tmp_path / "loads.toml").write_text(LOADS.replace("FORCE", "100"), encoding="utf-8")
    return Study(
        parts=(part,),
        vary={"strut_radius": (0.6, 0.9)},
        fixed={
            "cell": "CVC", "cell_size": 10.0, "shell": 0.0, "boundary": "whole",
            "activation": "inside",
        },
        do=("solve",),
        loads=tmp_path / "loads.toml",
    )  # fmt: skip


def test_thicker_struts_carry_the_same_with_less(beam: Study, tmp_path: Path) -> None:
    made = volfrep.sweep(beam, tmp_path / "runs", workers=1)
    assert made.count("done") == 2, made.table.column("error")
    thin, thick = made.table.dicts()
    assert thin["solve.case"] == thick["solve.case"] == "down"
    # Between slender beams that bend, as the radius cubed and more, and those that are pulled.
    ratio = thin["solve.displacement_mm"] / thick["solve.displacement_mm"]
    assert 1.5**2 < ratio < 1.5**4.5
    assert thin["solve.stress_mpa"] > thick["solve.stress_mpa"]
    assert thin["solve.safety"] == pytest.approx(900.0 / thin["solve.stress_mpa"], rel=1e-5)


def test_twice_the_load_moves_twice_as_far_and_is_a_new_question(
    beam: Study, tmp_path: Path
) -> None:
    once = volfrep.sweep(beam, tmp_path / "runs", workers=1)
    assert volfrep.sweep(beam, tmp_path / "runs", workers=1).runs == 0
    (tmp_path / "loads.toml").write_text(LOADS.replace("FORCE", "200"), encoding="utf-8")
    twice = volfrep.sweep(beam, tmp_path / "runs", workers=1)
    assert twice.runs == 2
    for name in ("solve.displacement_mm", "solve.stress_mpa"):
        assert twice.table.numbers(name) == pytest.approx(2.0 * once.table.numbers(name), rel=1e-5)


@pytest.mark.slow
def test_a_sized_design_is_made_by_its_specification(beam: Study, tmp_path: Path) -> None:
    study = replace(
        beam,
        do=("size", "solve"),
        goal={"safety": 3.0},
        vary={"strut_radius": (0.8,)},
        front=Front({"size.strut_mass_g": "least"}),
    )
    runs = tmp_path / "runs"
    made = volfrep.sweep(study, runs, workers=1)
    assert made.count("done") == 1, made.table.column("error")
    (row,) = made.table.dicts()
    assert row["size.holds"] is True
    assert row["size.stress_mpa"] == pytest.approx(300.0, rel=0.01)
    assert row["size.mass_saved"] > 0.05
    out = tmp_path / "sized.stl"
    spec = runs / row["size.file"]
    assert run("fill", tmp_path / "part.stl", "-o", out, "--spec", spec, "--quiet") == 0
    density = 4.43
    assert read_triangles(out).volume * density / 1000.0 == pytest.approx(
        row["size.strut_mass_g"], rel=0.02
    )
    page = (runs / "index.html").read_text(encoding="utf-8")
    assert f"_sized.stl --spec {spec}" in page
    spec.unlink()
    assert volfrep.sweep(study, runs, workers=1).runs == 1


def test_what_makes_no_sense_is_told_before_any_work(beam: Study, tmp_path: Path) -> None:
    with pytest.raises(VolfrepError, match="'solve' needs what the part carries"):
        replace(beam, loads=None)
    with pytest.raises(VolfrepError, match="no effect without the action 'size'"):
        replace(beam, goal={"safety": 2.0})
    wrong = replace(beam, do=("size",), goal={"safty": 2.0})
    with pytest.raises(VolfrepError, match=r"no goal 'size.safty'"):
        volfrep.sweep(wrong, tmp_path / "runs")
    (tmp_path / "loads.toml").write_text("material = 'Ti-6Al-4V'\n", encoding="utf-8")
    with pytest.raises(VolfrepError, match=r"loads\.toml"):
        volfrep.sweep(beam, tmp_path / "runs")
    assert not list((tmp_path / "runs" / "records").iterdir())


def test_a_file_of_a_study_names_loads_and_goal(tmp_path: Path) -> None:
    file = tmp_path / "study.toml"
    file.write_text(
        "part = 'a.stl'\nloads = 'b.toml'\ndo = ['size']\n[size]\nsafety = 2\n[vary]\n"
        "cell = ['BCC']\n",
        encoding="utf-8",
    )
    study = read_study(file)
    assert (study.loads, study.goal) == (str(tmp_path / "b.toml"), {"safety": 2.0})
    file.write_text(file.read_text(encoding="utf-8").replace("safety = 2", "safety = '2'"))
    with pytest.raises(VolfrepError, match=r"'size.safety' is a number, not '2'"):
        read_study(file)

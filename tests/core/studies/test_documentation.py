# SPDX-License-Identifier: LGPL-2.1-or-later
"""What docs/studies.md shows does what it says."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import samples
from volfrep import read_study
from volfrep.io.write.stl import write_stl
from volfrep.studies.actions import ACTIONS
from volfrep.studies.designs import combinations

TEXT = (Path(__file__).resolve().parents[3] / "docs" / "studies.md").read_text(encoding="utf-8")


def shown(language: str) -> str:
    """The one example in a language."""
    (example,) = re.findall(rf"```{language}\n(.*?)```", TEXT, re.DOTALL)
    return str(example)


def test_the_studys_file_is_one(tmp_path: Path) -> None:
    pytest.importorskip("pyvista", reason="its pictures need the optional package pyvista")
    (tmp_path / "study.toml").write_text(shown("toml"))
    study = read_study(tmp_path / "study.toml")
    assert len(combinations(study)) == 450
    assert study.vary["shell"] == (1.5, 2.0, 3.0)


def test_every_action_has_its_row() -> None:
    table = TEXT.split("## What is done with each")[1].split("##")[0]
    assert re.findall(r"^\| `(\w+)` \|", table, re.MULTILINE) == list(ACTIONS)


def test_an_optimiser_asks_and_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    optuna = pytest.importorskip("optuna", reason="needs the optional package optuna")
    optuna.logging.set_verbosity(optuna.logging.WARNING)
    monkeypatch.chdir(tmp_path)
    write_stl(samples.box(), tmp_path / "bracket.stl")
    names: dict = {}
    exec(shown("python"), names)
    trials = names["search"].trials
    assert len(trials) == 30
    assert {trial.state.name for trial in trials} == {"COMPLETE"}
    assert len(list((tmp_path / "runs" / "records").iterdir())) == 30
    masses = [trial.values[0] for trial in names["best"]]
    assert min(masses) == min(trial.values[0] for trial in trials)

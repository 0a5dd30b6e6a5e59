# SPDX-License-Identifier: LGPL-2.1-or-later
"""What docs/studies.md shows does what it says."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from volfrep import read_study
from volfrep.studies.actions import ACTIONS
from volfrep.studies.designs import combinations

TEXT = (Path(__file__).resolve().parents[3] / "docs" / "studies.md").read_text(encoding="utf-8")


def shown(language: str) -> list[str]:
    """The examples in a language."""
    return re.findall(rf"```{language}\n(.*?)```", TEXT, re.DOTALL)


def test_the_studys_file_is_one(tmp_path: Path) -> None:
    pytest.importorskip("pyvista", reason="its pictures need the optional package pyvista")
    whole, _ = shown("toml")
    (tmp_path / "study.toml").write_text(whole)
    study = read_study(tmp_path / "study.toml")
    assert len(combinations(study)) == 450
    assert study.vary["shell"] == (1.5, 2.0, 3.0)


def test_what_is_said_of_loads_is_a_studys_too(tmp_path: Path) -> None:
    _, loads = shown("toml")
    (tmp_path / "study.toml").write_text(f'part = "bracket.stl"\nvary.cell = ["BCC"]\n{loads}')
    study = read_study(tmp_path / "study.toml")
    assert study.all_actions == ("forecast", "solve", "size")
    assert study.goal == {"safety": 3.0, "thinnest": 0.4}


def test_every_action_has_its_row() -> None:
    table = TEXT.split("## What is done with each")[1].split("##")[0]
    assert re.findall(r"^\| `(\w+)` \|", table, re.MULTILINE) == list(ACTIONS)

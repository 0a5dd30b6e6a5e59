# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a report of a fault says, and what it keeps to itself."""

from __future__ import annotations

import numpy as np
import pytest

from volfrep.cli.bug_report import describe_machine, without_folders
from volfrep.cli.command import run
from volfrep.util.version import VERSION


def test_versions_are_told_of_the_program_and_its_packages(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert run(["report-bug"]) == 0
    said = capsys.readouterr().out
    assert f"- volfrep: {VERSION}" in said
    assert f"- numpy: {np.__version__}" in said


def test_a_specification_keeps_its_values_and_loses_its_folders() -> None:
    text = 'cell = "CVC"\nradius_field = "/home/ann/secret part/stress.csv"\nrotate = "0,0,1,30"'
    told = without_folders(text)
    assert told.splitlines() == [
        'cell = "CVC"',
        'radius_field = "stress.csv"',
        'rotate = "0,0,1,30"',
    ]
    windows = without_folders(r'network_file = "C:\\Users\\Ann\\graph.csv"')
    assert windows == 'network_file = "graph.csv"'
    assert "Ann" not in describe_machine(windows)


def test_formulas_stay_and_what_a_list_or_a_comment_tells_of_folders_goes() -> None:
    text = (
        "# for Ann's bracket\n"
        'strut_radius = "1 + x / 50.5"\n'
        "keep_solid = ['/home/ann/boss.stl', \"C:/Users/Ann/no extension\"]  # /home/ann\n"
        'cell = "ours/kelvin.json"'
    )
    assert without_folders(text).splitlines() == [
        "",
        'strut_radius = "1 + x / 50.5"',
        'keep_solid = ["boss.stl", "no extension"]',
        'cell = "kelvin.json"',
    ]

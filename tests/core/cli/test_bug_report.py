# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a report of a fault says, and what it keeps to itself."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from volfrep.cli.bug_report import without_folders
from volfrep.cli.command import run
from volfrep.util.reading import toml_library
from volfrep.util.version import VERSION


def test_versions_are_told_of_the_program_and_its_packages(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert run(["report-bug"]) == 0
    said = capsys.readouterr().out
    assert f"- volfrep: {VERSION}" in said
    assert f"- numpy: {np.__version__}" in said


def told(text: str) -> list[str]:
    """The lines that are told of a specification."""
    return without_folders(toml_library("specifications").loads(text)).splitlines()


def test_a_specification_keeps_its_values_and_loses_its_folders() -> None:
    text = 'cell = "CVC"\nradius_field = "/home/ann/secret part/stress.csv"\nrotate = "0,0,1,30"'
    assert told(text) == ['cell = "CVC"', 'radius_field = "stress.csv"', 'rotate = "0,0,1,30"']
    assert told(r'network_file = "C:\\Users\\Ann\\graph.csv"') == ['network_file = "graph.csv"']


def test_formulas_stay_and_what_a_list_or_a_comment_tells_of_folders_goes() -> None:
    text = (
        "# for Ann's bracket\n"
        'strut_radius = "1 + x / 50.5"\n'
        "keep_solid = ['/home/ann/boss.stl', \"C:/Users/Ann/no extension\"]  # /home/ann\n"
        'cell = "ours/kelvin.json"\nshell = 2.5\ntrim = true'
    )
    assert told(text) == [
        'strut_radius = "1 + x / 50.5"',
        'keep_solid = ["boss.stl", "no extension"]',
        'cell = "kelvin.json"',
        "shell = 2.5",
        "trim = true",
    ]


@pytest.mark.parametrize(
    "text",
    [
        'cell = """\n/home/ann/customer/kelvin.json"""',
        "cell = '''C:\\Users\\Ann\\customer\\kelvin.json'''",
        'cell = """/home/ann/\\\n   customer/kelvin.json"""  # "of customer',
        'cell = "\\u002fhome\\u002fann\\u002fcustomer\\u002fkelvin.json"',
    ],
    ids=["of lines", "literal", "continued", "escaped"],
)
def test_texts_of_several_lines_lose_their_folders_too(text: str) -> None:
    assert told(text) == ['cell = "kelvin.json"']


def test_tables_are_told_in_line_and_are_read_as_the_same() -> None:
    text = '[goal]\nloads = "/home/ann/loads.toml"\ncases = [{ name = "a", force = [1, 2.5] }]\n'
    assert toml_library("specifications").loads("\n".join(told(text))) == {
        "goal": {"loads": "loads.toml", "cases": [{"name": "a", "force": [1, 2.5]}]}
    }


def test_what_was_printed_loses_folders_and_names_of_people(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    log = tmp_path / "log.txt"
    log.write_text(
        "volfrep fill /home/ann/customer/rod.stl -o customer/out.stl --strut-radius 1\n"
        "Cannot read the mesh '/home/ann/customer part/rod.stl': it is empty.\n"
        '  File "/home/ann/venv/site-packages/volfrep/io/solid.py", line 7, in read_solid\n'
        "in C:\\Users\\Ann Lee\\customer\\rod.stl and /home/ann: 3 N/mm2, 1/2 of 5 / 7\n"
    )
    assert run(["report-bug", "--log", str(log)]) == 0
    assert capsys.readouterr().out.partition("```text\n")[2].splitlines() == [
        "volfrep fill rod.stl -o out.stl --strut-radius 1",
        "Cannot read the mesh 'rod.stl': it is empty.",
        '  File "volfrep/io/solid.py", line 7, in read_solid',
        "in rod.stl and ~: 3 N/mm2, 1/2 of 5 / 7",
        "```",
    ]


def test_what_is_no_toml_is_refused_in_a_sentence(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    spec = tmp_path / "job.toml"
    spec.write_text('cell = "/home/ann')
    assert run(["report-bug", "--spec", str(spec)]) == 2
    said = capsys.readouterr()
    assert "is no TOML" in said.err
    assert "ann" not in said.out

# SPDX-License-Identifier: LGPL-2.1-or-later
"""The pages say what its table of specimens and the engine's predictions say."""

import importlib.util
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def tool():
    """`tools/validate.py`."""
    path = ROOT / "tools" / "validate.py"
    spec = importlib.util.spec_from_file_location(path.stem, path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_page_is_made_of_the_table_and_of_what_was_predicted(tool):
    for path, text in tool.made_pages(tool.kept()).items():
        assert text == path.read_text(encoding="utf-8"), "run make validate"


def test_there_are_specimens_of_several_processes_and_cells(tool):
    rows, _ = tool.specimens()
    assert len(rows) >= 12
    assert len({row["process"] for row in rows}) >= 3
    assert len({row["cell"] for row in rows}) >= 4
    assert {row["read"] for row in rows} == {"text", "quoted"}


def test_what_was_read_in_its_source_stands_apart_from_what_others_quote(tool):
    rows = [
        {"name": "a", "read": "text", "young": 100.0},
        {"name": "b", "read": "quoted", "young": 100.0},
        {"name": "c", "read": "quoted", "young": 100.0},
    ]
    found = {
        name: {"nominal": {"young": e}} for name, e in zip("abc", (120, 200, 400), strict=True)
    }
    _, _, text, quoted = tool.page.error_table(rows, found).splitlines()
    assert text == "| young, text | 1 | +20% | 20% | +20%, +20% | 0.83 |"
    assert quoted == "| young, quoted | 2 | +200% | 200% | +100%, +300% | 0.25 |"


def test_means_are_told_with_and_without_a_suspect_row(tool):
    rows = [
        {"name": "a", "read": "quoted", "plateau": 1.0},
        {"name": "b", "read": "quoted", "plateau": 2.0, "suspect": True},
    ]
    found = {
        name: {"nominal": {"plateau": own}} for name, own in zip("ab", (1.4, 8.0), strict=True)
    }
    _, _, both, sound = tool.page.error_table(rows, found).splitlines()
    assert both == "| plateau, quoted | 2 | +170% | 170% | +40%, +300% | 0.25 |"
    assert sound == "| without the suspect row | 1 | +40% | 40% | +40%, +40% | 0.71 |"


def test_errors_of_one_machine_go_with_one_compliance_in_series(tool):
    rows = [
        {"name": name, "series": "s", "young": 1.0 / (1.0 / own + 3e-4)}
        for name, own in zip("abc", (15000.0, 20000.0, 25000.0), strict=True)
    ]
    found = {
        name: {"nominal": {"young": own}}
        for name, own in zip("abc", (15000.0, 20000.0, 25000.0), strict=True)
    }
    told = tool.page.reasons(rows, found)
    assert "0.30/GPa" in told
    assert "-0% to +0%" in told or "+0% to +0%" in told


@pytest.mark.parametrize("name", ["F-BCC tube", "Diamond 28 %", "BCC 28.1 %"])
def test_what_takes_no_time_is_predicted_as_the_page_says(tool, name):
    row = next(row for row in tool.specimens()[0] if row["name"] == name)
    own = tool.kept()["specimens"][name]["nominal"]
    found = tool.predict(row, row.get("diameter"))
    assert {key: found[key] for key in own} == pytest.approx(own, rel=2e-3)


def test_problems_whose_answer_is_known_are_answered(tool):
    for problem in tool.benchmarks():
        assert abs(problem.error) < problem.within, problem.name


@pytest.mark.slow
def test_everything_is_predicted_as_the_page_says(tool):
    for row in tool.specimens()[0]:
        own = tool.kept()["specimens"][row["name"]]
        for way, diameter in (("nominal", "diameter"), ("measured", "measured_diameter")):
            if way in own:
                found = tool.predict(row, row.get(diameter))
                assert {k: found[k] for k in own[way]} == pytest.approx(own[way], rel=0.02)

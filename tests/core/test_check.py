# SPDX-License-Identifier: LGPL-2.1-or-later
"""`make check`: which tests are near to a change."""

import importlib.util
from pathlib import Path
from types import SimpleNamespace

import pytest

ROOT = Path(__file__).resolve().parents[2]
# All modules are read first.
pytestmark = pytest.mark.costly
_spec = importlib.util.spec_from_file_location("check", ROOT / "tools" / "check.py")
check = importlib.util.module_from_spec(_spec)
_spec.loader.exec_module(check)


@pytest.mark.slow_cases("tests/core/trim/test_prune.py-trim/test_prune.py-0")
@pytest.mark.parametrize(
    ("file", "test", "distance"),
    [
        ("tests/core/trim/test_prune.py", "trim/test_prune.py", 0),
        ("core/volfrep/trim/prune.py", "trim/test_prune.py", 1),
        ("core/volfrep/api/calls.py", "test_api.py", 1),  # by names of the package
        ("core/volfrep/cli/command.py", "cli/test_slice.py", 2),  # by the tests' own command
        ("tests/core/mechanics/anisotropic_lattices.json", "mechanics/test_frame.py", 1),
        ("README.md", "test_layers.py", 1),
        ("core/volfrep/cli/command.py", "trim/test_prune.py", None),
    ],
)
def test_how_near_tests_are_to_a_change(file, test, distance):
    assert check.distances([file]).get(check.CORE / test) == distance


def test_a_change_of_the_workbench_is_near_to_its_tests_in_freecad():
    near = check.distances(["freecad_volfrep/features/infill/materials.py"])
    assert near[check.IN_FREECAD / "test_freecad_targets.py"] == 1
    assert near.get(check.CORE / "jobs" / "test_targets.py") is None
    near = check.distances(["tests/freecad/conftest.py"])
    assert near[check.IN_FREECAD / "test_freecad_print_check.py"] == 1


def test_a_case_begins_after_the_end_only_where_it_holds_the_rules_of_the_house(monkeypatch):
    monkeypatch.setenv(check._UNTIL, "0")
    check.pytest_runtest_setup(SimpleNamespace(path=check.CORE / "test_layers.py"))
    with pytest.raises(pytest.skip.Exception):
        check.pytest_runtest_setup(SimpleNamespace(path=check.CORE / "test_kinds.py"))

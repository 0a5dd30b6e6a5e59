# SPDX-License-Identifier: LGPL-2.1-or-later
"""Random searches: the same ones every time in `make test`, new ones in `make test-random`.

What a new search finds becomes an explicit example of its test. No search is timed.

Also which cases of a parametrised test are slow: those that the mark `slow_cases` names beside it,
or all but those that `slow_but` names.

And the folders in which `make setup` puts pyvista, and what studies take, apart from what FreeCAD
sees. The latter come last: what is Debian's stays so.
"""

import sys
from pathlib import Path

import pytest
from hypothesis import settings

_CACHE = Path(__file__).resolve().parents[2] / ".cache"
sys.path.insert(0, str(_CACHE / "plot"))
sys.path.append(str(_CACHE / "study"))

settings.register_profile("fixed", derandomize=True, database=None, deadline=None)
settings.register_profile("random", deadline=None, print_blob=True, max_examples=300)
settings.load_profile("fixed")


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Mark what `slow_cases` names and `slow_but` does not, before pytest looks at marks.

    Raises:
        pytest.UsageError: a mark names a case that its test does not have.
    """
    cases: dict[str, dict[str, pytest.Item]] = {}
    for item in items:
        if isinstance(item, pytest.Function) and hasattr(item, "callspec"):
            cases.setdefault(item.nodeid.partition("[")[0], {})[item.callspec.id] = item
    are_all_there = not any("::" in argument for argument in config.invocation_params.args)
    for test, of_test in cases.items():
        one = next(iter(of_test.values()))
        for kind in ("slow_cases", "slow_but"):
            for mark in one.iter_markers(kind):
                gone = [name for name in mark.args if name not in of_test]
                if gone and are_all_there:
                    raise pytest.UsageError(f"{kind} of {test} names {gone[0]}, which is no case.")
                for name, item in of_test.items():
                    if (name in mark.args) == (kind == "slow_cases"):
                        item.add_marker("slow")


@pytest.fixture(scope="session", autouse=True)
def _stages_shared() -> None:
    import shared_stages

    shared_stages.share()


@pytest.fixture(autouse=True)
def _shares_stages(request: pytest.FixtureRequest, _stages_shared: None) -> None:
    import shared_stages

    shared_stages.ON[0] = "monkeypatch" not in request.fixturenames

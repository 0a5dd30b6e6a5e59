# SPDX-License-Identifier: LGPL-2.1-or-later
"""Which cases of a parametrised test are slow or costly, of the engine's and of those in FreeCAD.

Those that the mark `slow_cases` names beside it, or all but those that `slow_but` names; likewise
`costly_cases` and `costly_but`.
"""

from __future__ import annotations

import gc

import pytest

KINDS = ("slow_cases", "slow_but", "costly_cases", "costly_but")


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Mark what `..._cases` names and `..._but` does not, before pytest looks at marks.

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
        # What pytest calls the one case of a test whose files are not there: it is skipped.
        has_none = all(name.startswith("NOTSET") for name in of_test)
        for kind in KINDS:
            for mark in one.iter_markers(kind):
                gone = [name for name in mark.args if name not in of_test]
                if gone and are_all_there and not has_none:
                    raise pytest.UsageError(f"{kind} of {test} names {gone[0]}, which is no case.")
                word, _, which = kind.partition("_")
                for name, item in of_test.items():
                    if (name in mark.args) == (which == "cases"):
                        item.add_marker(word)


def pytest_collection_finish() -> None:
    """What was imported and collected stays to the end: Python need not look at it ever again."""
    gc.freeze()

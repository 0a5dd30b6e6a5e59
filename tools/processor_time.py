# SPDX-License-Identifier: LGPL-2.1-or-later
"""A plugin of pytest that tells which files and which cases of the tests take the processor.

    .venv/bin/python -m pytest -p tools.processor_time tests/core [--processor-cases 30]
        [--processor-table FILE]

User and system seconds, of the processes that run the tests and of those that these started and
that have ended. Unlike `--durations` that says the same on a busy machine. Fixtures count to the
case that is the first to ask for them, imports of the test files to collection, which every worker
of pytest-xdist does for itself.
"""

from __future__ import annotations

import os
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

#: The name under which a case's seconds travel with its report.
SPENT = "processor seconds"

#: Seconds of a case, by its id, and of what is no case's, by what it is.
_cases: dict[str, float] = {}
_others: dict[str, float] = defaultdict(float)
#: What this process had spent when its case began.
_began = [0.0]


def _spent() -> float:
    times = os.times()
    return times.user + times.system + times.children_user + times.children_system


def pytest_addoption(parser: pytest.Parser) -> None:
    """How many cases are told beside the files, and where all of them go."""
    parser.addoption("--processor-cases", type=int, default=20)
    parser.addoption("--processor-table", type=Path, help="all cases, one a line, into this file")


def pytest_collection_finish(session: pytest.Session) -> None:
    """What starting and collecting took, in this process."""
    _others["start and collection"] += _spent()


@pytest.hookimpl(tryfirst=True)
def pytest_runtest_logstart() -> None:
    """A case begins, before its fixtures."""
    _began[0] = _spent()


@pytest.hookimpl(hookwrapper=True)
def pytest_runtest_makereport(item: pytest.Item, call: pytest.CallInfo[None]) -> Iterator[None]:
    """The report of a case's end carries what it took, from a worker, too."""
    if call.when == "teardown":
        item.user_properties.append((SPENT, _spent() - _began[0]))
    yield


def pytest_runtest_logreport(report: pytest.TestReport) -> None:
    """Where the reports of all workers come together."""
    if report.when == "teardown":
        _cases[report.nodeid] = dict(report.user_properties)[SPENT]  # type: ignore[assignment]


@pytest.hookimpl(trylast=True)
def pytest_sessionfinish(session: pytest.Session) -> None:
    """A worker tells what it collected."""
    output = getattr(session.config, "workeroutput", None)
    if output is not None:
        output[SPENT] = dict(_others)


@pytest.hookimpl(optionalhook=True)
def pytest_testnodedown(node: Any, error: object | None) -> None:
    """A worker of pytest-xdist has ended."""
    for name, seconds in getattr(node, "workeroutput", {}).get(SPENT, {}).items():
        _others[name] += seconds


def pytest_terminal_summary(
    terminalreporter: pytest.TerminalReporter, config: pytest.Config
) -> None:
    """The sum, the costliest files and the costliest cases."""
    files: dict[str, float] = defaultdict(float, _others)
    for name, seconds in _cases.items():
        files[name.partition("::")[0]] += seconds
    count = config.getoption("--processor-cases")
    write = terminalreporter.write_line
    terminalreporter.section(f"processor: {sum(files.values()):.1f} s, files and cases")
    for table in (files, _cases):
        for name, seconds in sorted(table.items(), key=lambda pair: -pair[1])[:count]:
            write(f"{seconds:7.1f}  {name}")
    table_file = config.getoption("--processor-table")
    if table_file is not None:
        table_file.write_text(
            "".join(
                f"{seconds:.3f}\t{name}\n" for name, seconds in (*_others.items(), *_cases.items())
            )
        )

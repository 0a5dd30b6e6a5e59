# SPDX-License-Identifier: LGPL-2.1-or-later
"""A plugin of pytest that tells which files and which cases of the tests take the processor.

    .venv/bin/python -m pytest -p tools.processor_time tests/core -n 0 [--processor-cases 30]

User and system seconds, of this process and of those that it started and that have ended. Unlike
`--durations` that says the same on a busy machine. Fixtures count to the case that is the first to
ask for them, imports of a test file to the file. With pytest-xdist nothing is told: the seconds
are the workers'.
"""

from __future__ import annotations

import os
from collections import defaultdict
from collections.abc import Iterator

import pytest

#: Seconds of a file, by its path, and of a case, by its id.
_files: dict[str, float] = defaultdict(float)
_cases: dict[str, float] = {}


def _spent() -> float:
    times = os.times()
    return times.user + times.system + times.children_user + times.children_system


def pytest_addoption(parser: pytest.Parser) -> None:
    """How many cases are told beside the files."""
    parser.addoption("--processor-cases", type=int, default=20)


@pytest.hookimpl(hookwrapper=True)
def pytest_make_collect_report(collector: pytest.Collector) -> Iterator[None]:
    """Importing a test file is part of what it costs."""
    before = _spent()
    yield
    if isinstance(collector, pytest.Module):
        _files[collector.nodeid] += _spent() - before


@pytest.hookimpl(hookwrapper=True)
def pytest_runtest_protocol(item: pytest.Item) -> Iterator[None]:
    """A case with its fixtures."""
    before = _spent()
    yield
    _cases[item.nodeid] = _spent() - before
    _files[item.nodeid.partition("::")[0]] += _cases[item.nodeid]


def pytest_terminal_summary(
    terminalreporter: pytest.TerminalReporter, config: pytest.Config
) -> None:
    """All files, and the dearest cases."""
    write = terminalreporter.write_line
    terminalreporter.section(f"processor: {sum(_files.values()):.1f} s")
    for name, seconds in sorted(_files.items(), key=lambda pair: -pair[1]):
        write(f"{seconds:7.1f}  {name}")
    terminalreporter.section("dearest cases")
    for name, seconds in sorted(_cases.items(), key=lambda pair: -pair[1])[
        : config.getoption("--processor-cases")
    ]:
        write(f"{seconds:7.1f}  {name}")

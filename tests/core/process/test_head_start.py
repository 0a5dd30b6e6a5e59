# SPDX-License-Identifier: LGPL-2.1-or-later
"""A worker that starts early is a pool's first one, or ends."""

from __future__ import annotations

import os

import pytest

from volfrep.process import head_start
from volfrep.process.head_start import HeadStart
from volfrep.process.pool import WorkerPool, processes
from volfrep.process.worker import Worker
from volfrep.util import threads


@pytest.fixture
def started(monkeypatch: pytest.MonkeyPatch) -> list[Worker]:
    """Those that start early, of two that there could be."""
    made: list[Worker] = []

    def kept(*given: object) -> Worker:
        made.append(Worker(*given))  # type: ignore[arg-type]
        return made[-1]

    monkeypatch.setattr(head_start, "Worker", kept)
    monkeypatch.setattr(threads, "_wanted", 2)
    return made


def test_it_is_the_first_of_a_pool_which_ends_it(started: list[Worker]) -> None:
    first = HeadStart(["json"])
    first.begin()
    with processes(2, ["json"], with_this=True, first=first) as pool:
        first.end()
        assert isinstance(pool, WorkerPool)
        assert pool.elsewhere(os.getpid).result() == started[0].number
        assert pool.workers == started
        assert started[0].is_alive
    assert len(started) == 1
    assert not started[0].is_alive


@pytest.mark.parametrize(("count", "modules"), [(1, ["json"]), (2, ["json", "csv"])])
def test_it_ends_where_it_is_none_of_a_pool(
    started: list[Worker], count: int, modules: list[str]
) -> None:
    first = HeadStart(["json"])
    first.begin()
    first.begin()
    with processes(count, modules, with_this=True, first=first):
        first.end()
        assert [worker.is_alive for worker in started] == [False]


def test_one_core_has_none_and_one_that_cannot_start_is_done_without(
    started: list[Worker], monkeypatch: pytest.MonkeyPatch
) -> None:
    first = HeadStart([])
    monkeypatch.setattr(threads, "_wanted", 1)
    first.begin()
    assert not started
    monkeypatch.setattr(threads, "_wanted", 2)
    monkeypatch.setattr("sys.executable", "/nowhere/python")
    first.begin()
    first.end()
    assert not started

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Workers side by side: one that dies costs its call, and the rest goes on."""

from __future__ import annotations

import os
import signal
import threading
import time
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, wait
from pathlib import Path

import engine_calls as calls
import pytest

from volfrep.process import pool
from volfrep.process.pool import WorkerPool, backend_of, let_go, processes
from volfrep.process.worker import Ending, Worker, WorkerLost, this_python
from volfrep.util.errors import VolfrepError
from volfrep.util.parallel import ParallelBackend

HERE = Path(__file__).parent


@pytest.fixture
def ended(monkeypatch: pytest.MonkeyPatch) -> list[Ending]:
    monkeypatch.syspath_prepend(str(HERE))
    return []


def test_calls_run_in_other_processes_side_by_side(ended: list[Ending]) -> None:
    with processes(2, lost=ended.append) as workers:
        assert workers is not None
        numbers = {workers.submit(calls.number_after, 0.5).result() for _ in range(2)}
        some = [workers.submit(calls.number_after, 1.0) for _ in range(4)]
        numbers |= {future.result() for future in some}
        assert len(numbers) == 2
        assert os.getpid() not in numbers
    assert not ended


def test_this_process_makes_calls_too_and_waits_for_no_worker_that_starts(
    ended: list[Ending], monkeypatch: pytest.MonkeyPatch
) -> None:
    ready, greets = threading.Event(), Worker.greets
    monkeypatch.setattr(Worker, "greets", lambda self: ready.wait(600.0) and greets(self))
    with processes(2, lost=ended.append, with_this=True) as workers:
        assert isinstance(workers, WorkerPool)
        assert pool.at_once(workers) == 2
        elsewhere, unwanted = workers.elsewhere(os.getpid), workers.elsewhere(os.getpid)
        assert unwanted.cancel()
        made = [workers.submit(os.getpid) for _ in range(4)]
        numbers = {future.result() for future in made}
        assert numbers == {os.getpid()}
        ready.set()
        assert elsewhere.result() != os.getpid()
        while len(numbers) < 2:
            made = [workers.submit(calls.number_after, 0.1) for _ in range(2)]
            numbers |= {future.result() for future in made}
        with pytest.raises(VolfrepError, match="No paper"):
            workers.submit(calls.refuse, "No paper.").result()
    assert not ended


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="Windows ends processes by a code")
def test_a_worker_that_is_killed_is_told_at_once_and_replaced(ended: list[Ending]) -> None:
    with processes(2, lost=ended.append) as workers:
        assert isinstance(workers, WorkerPool)
        number = workers.submit(os.getpid).result()
        held = [workers.submit(calls.sleep, 600.0) for _ in range(2)]
        while not all(future.running() for future in held):
            time.sleep(0.01)
        start = time.monotonic()
        os.kill(number, signal.SIGKILL)
        (lost,), _ = wait(held, return_when=FIRST_COMPLETED)
        assert time.monotonic() - start < 10.0
        assert str(lost.exception()) == str(ended[0]) == "by signal 9"
        assert workers.submit(calls.same, 1).result(timeout=60.0) == 1


def test_a_call_that_is_begun_is_made_meanwhile_or_where_it_is_asked_for(
    ended: list[Ending],
) -> None:
    assert ParallelBackend().begun(os.getpid)() == os.getpid()
    with processes(2, lost=ended.append) as workers:
        backend = backend_of(workers)
        begun = backend.begun(calls.number_after, 0.1)
        assert begun() != os.getpid()
        with pytest.raises(VolfrepError, match="No paper"):
            backend.begun(calls.refuse, "No paper.")()
        let_go(workers)
        assert backend.begun(calls.number_after, 0.0)() == os.getpid()
    assert not ended


def test_where_workers_end_again_and_again_no_other_one_is_started(
    ended: list[Ending], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(pool, "MOST_LOST", 2)
    with processes(2, lost=ended.append) as workers:
        assert workers is not None
        for _ in range(2):
            with pytest.raises(WorkerLost, match=r"with code 3 \(out of paper\)"):
                workers.submit(calls.leave, "out of paper", 3).result()
        with pytest.raises(BrokenExecutor):
            workers.submit(calls.same, 1)
    assert len(ended) == 2


def test_workers_end_when_the_pool_does_whatever_they_do(ended: list[Ending]) -> None:
    workers = WorkerPool(this_python(), 2, ended.append)
    future = workers.submit(calls.sleep, 600.0)
    while not workers.workers:
        time.sleep(0.01)
    workers.shutdown(cancel_futures=True)
    assert isinstance(future.exception(timeout=60.0), WorkerLost)
    assert not any(worker.is_alive for worker in workers.workers)
    assert not ended, "that is no accident"

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Workers that stay for the next job, and go when nobody needs them any more."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import engine_calls as calls
import pytest
from test_worker import runs

from volfrep.process import kept_pool, pool, worker
from volfrep.process.engines import Engines
from volfrep.process.kept_pool import KeptPool
from volfrep.process.pool import WorkerPool
from volfrep.process.worker import Call, Ending, Program, has_python, this_python
from volfrep.util.errors import Cancelled
from volfrep.util.threads import use_threads

HERE = str(Path(__file__).parent)
CORE = str(Path(__file__).parents[3] / "core")


@pytest.fixture
def kept(monkeypatch: pytest.MonkeyPatch) -> Iterator[KeptPool]:
    monkeypatch.syspath_prepend(HERE)
    kept = KeptPool(())
    yield kept
    kept.end()


def job(kept: KeptPool, count: int = 2) -> WorkerPool:
    """The pool that a job was lent, which had a call made by one of its workers."""
    with kept.lent(count) as workers:
        assert workers is not None
        assert workers.elsewhere(os.getpid).result() != os.getpid()
        return workers


def until(is_so: Callable[[], bool]) -> bool:
    """Whether that comes true within a minute."""
    end = time.monotonic() + 60.0
    while not is_so() and time.monotonic() < end:
        time.sleep(0.01)
    return is_so()


def test_the_next_job_has_the_same_workers_unless_it_wants_far_more(kept: KeptPool) -> None:
    first = job(kept)
    (number,) = [each.number for each in first.workers]
    assert job(kept, 3) is first, "one of two is enough for a third"
    more = job(kept, 5)
    assert not first.is_open
    assert number not in {each.number for each in more.workers}
    assert job(kept, 2) is more


def test_one_process_and_a_program_that_is_no_python_have_none(
    kept: KeptPool, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(worker, "_beside", [])
    with kept.lent(1) as workers:
        assert workers is None
    monkeypatch.setattr(sys, "executable", "/usr/bin/freecad")
    assert not has_python()
    with kept.lent(4) as workers:
        assert workers is None


def test_a_job_that_fails_ends_what_its_workers_do(kept: KeptPool) -> None:
    def cancelled_job() -> None:
        with kept.lent(2) as workers:
            assert workers is not None
            lent.append(workers)
            unwanted = workers.elsewhere(calls.sleep, 600.0)
            assert until(unwanted.running)
            raise Cancelled("by the user")

    lent: list[WorkerPool] = []
    with pytest.raises(Cancelled):
        cancelled_job()
    (workers,) = lent
    assert not workers.is_open
    assert not any(each.is_alive for each in workers.workers)
    assert job(kept) is not workers


def test_workers_that_nobody_needs_are_let_go(
    kept: KeptPool, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(kept_pool, "IDLE_SECONDS", 0.2)
    with kept.lent(2) as workers:
        assert workers is not None
        assert workers.elsewhere(calls.number_after, 0.5).result() != os.getpid()
        assert workers.is_open, "a job may take longer"
    assert until(lambda: not workers.is_open)
    assert not any(each.is_alive for each in workers.workers)


def test_jobs_that_overlap_have_workers_of_their_own_and_one_pool_is_kept(kept: KeptPool) -> None:
    with kept.lent(2) as outer:
        inner = job(kept)
        assert inner is not outer
    assert outer is not None
    assert outer.is_open
    assert not inner.is_open


def test_workers_are_those_of_the_threads_that_may_be_used_now(kept: KeptPool) -> None:
    try:
        use_threads(4)
        first = job(kept)
        use_threads(2)
        assert job(kept) is not first
    finally:
        use_threads(0)


def test_where_there_are_many_this_process_only_joins_what_they_make(
    kept: KeptPool, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(pool, "FEW", 2)
    for count, has_this in ((2, True), (3, False)):
        kept.end()
        with kept.lent(count) as workers:
            assert workers is not None
            assert workers.elsewhere(os.getpid).result() != os.getpid()
            made = [workers.submit(calls.number_after, 0.1) for _ in range(4 * count)]
            assert (os.getpid() in {each.result() for each in made}) == has_this
            assert len(workers.workers) == count - has_this


def test_what_a_worker_starts_is_what_it_is_itself(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(HERE)
    program = Program((sys.executable,), (CORE, HERE), prelude="import wave", warm=("csv",))
    engine = Engines([program])
    made: Program = engine.begin(Call(this_python, (3, "json"), has_progress=False)).result()
    engine.end()
    assert made == Program((sys.executable,), (CORE, HERE), (), "import wave", ("json",), 3)


def test_a_program_that_cannot_be_started_is_told_and_this_process_goes_on(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(worker, "_beside", [Program(("/no/such/python",), ())])
    kept, ended = KeptPool(()), list[Ending]()
    with kept.lent(2, ended.append) as workers:
        assert workers is not None
        assert until(lambda: bool(ended))
        made = workers.submit(os.getpid).exception() or workers.submit(os.getpid).result()
        assert made == os.getpid() or "No such file" in str(made)
    assert "No such file" in str(ended[0])
    kept.end()


@pytest.mark.skipif(sys.platform != "linux", reason="asks /proc")
@pytest.mark.parametrize("how", ["kill", "cancel"])
def test_workers_of_a_worker_end_with_it_and_so_do_their_files(
    how: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.syspath_prepend(HERE)
    engine, told = Engines([Program((sys.executable,), (CORE, HERE))]), tmp_path / "told"
    running = engine.begin(Call(calls.number_of_kept, (str(told),)))
    assert until(lambda: running.state[1] == "begun")
    number, folder = told.read_text().rstrip(".").split(" ", 1)
    assert runs(number)
    if how == "cancel":
        running.cancel()
    else:
        assert running._process is not None
        running._process.kill()
    assert running.wait(60.0)
    assert until(lambda: not runs(number))
    assert until(lambda: not Path(folder).exists())
    engine.end()


@pytest.mark.skipif(not hasattr(os, "fork"), reason="nothing is forked here")
def test_a_forked_process_starts_its_own_and_leaves_those_of_the_first_alone(
    tmp_path: Path,
) -> None:
    text = (
        f"import sys, os; sys.path[:0] = [{CORE!r}, {HERE!r}]\n"
        "from volfrep.process.kept_pool import KeptPool\n"
        "kept = KeptPool(())\n"
        "def number():\n"
        "    with kept.lent(2) as workers:\n"
        "        return workers.elsewhere(os.getpid).result(), workers\n"
        "first, workers = number()\n"
        "child = os.fork()\n"
        "if not child:\n"
        "    assert number()[0] not in (first, os.getpid())\n"
        "    sys.exit(0)\n"
        "assert os.waitpid(child, 0)[1] == 0\n"
        "assert number() == (first, workers)\n"
        "assert workers.workers[0]._folder.exists()\n"
    )
    subprocess.run([sys.executable, "-c", text], check=True, timeout=120, cwd=tmp_path)

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Calls in a process of their own: what they return, how they are cancelled, how they die."""

from __future__ import annotations

import gc
import io
import operator
import os
import shutil
import signal
import sys
import tempfile
import threading
import time
from dataclasses import replace
from pathlib import Path
from typing import Any

import engine_calls as calls
import numpy as np
import pytest
import trimesh

from volfrep.design.spec import LatticeSpec
from volfrep.io.solid import check_solid
from volfrep.jobs.pipeline import fill, filled_mesh, triangles_digest
from volfrep.mesh.triangle_mesh import TriangleMesh
from volfrep.process import engines
from volfrep.process.child import Limits, OverLimit
from volfrep.process.engines import Engines, Running
from volfrep.process.wire import LARGE, receive, send
from volfrep.process.worker import Call, Failed, Program, Worker
from volfrep.reports.facet_roles import kinds_of_triangles
from volfrep.util.cache import StageCache
from volfrep.util.errors import Cancelled, VolfrepError
from volfrep.util.threads import MATRIX_THREADS

HERE = str(Path(__file__).parent)
CORE = str(Path(__file__).parents[3] / "core")


PYTHON = Program((sys.executable,), (CORE, HERE))


@pytest.fixture
def engine():
    engines = Engines([PYTHON])
    yield engines
    engines.end()


def idle(engine: Engines) -> Worker:
    """The process that waits for the next call."""
    process = engine.take()
    assert process is not None
    engine.give_back(process)
    return process


def made(engine: Engines, function: Any, *arguments: Any, **keywords: Any) -> Any:
    return engine.begin(Call(function, arguments, keywords, has_progress=False)).result()


def test_a_call_is_made_elsewhere_and_the_process_serves_the_next_one(engine):
    assert made(engine, operator.mul, 6, 7) == 42
    assert made(engine, os.getpid) == made(engine, os.getpid) != os.getpid()


def test_arrays_arrive_as_they_were_sent_whatever_their_size(engine):
    for count in (0, 3, LARGE // 8, LARGE):
        sent = np.random.default_rng(count).standard_normal((count, 2))
        back = made(engine, calls.same, {"array": sent, "turned": sent.T})
        np.testing.assert_array_equal(back["array"], sent)
        np.testing.assert_array_equal(back["turned"], sent.T)
        back["array"] += 1.0  # and can be changed
    left = {path.name for path in idle(engine)._folder.iterdir()}
    assert left == {"engine.py", "said"}


def test_arrays_are_sent_without_the_pickles_of_this_numpy(tmp_path):
    """A FreeCAD may have a numpy that does not know those of this one."""
    sent = [
        np.arange(12.0).reshape(3, 4),
        np.array(7),
        np.array(["a", "bc"]),
        np.zeros((2, 0), bool),
    ]
    stream = io.BytesIO()
    send(stream, sent, tmp_path, lambda _: -1)
    assert b"numpy" not in stream.getvalue()
    stream.seek(0)
    back = receive(stream, tmp_path, StageCache)
    for one, other in zip(sent, back, strict=True):
        np.testing.assert_array_equal(one, other, strict=True)


def test_folders_may_have_spaces_and_any_letters(tmp_path, monkeypatch):
    place = tmp_path / "Größe und 部品 'a'"
    place.mkdir()
    shutil.copy(Path(HERE, "engine_calls.py"), place / "stücke.py")
    monkeypatch.setattr(tempfile, "tempdir", str(place))
    worker = Worker(Program((sys.executable,), (CORE, str(place))))
    assert worker._folder.parent == place
    call = Call("stücke:write_beside", ("é 部", "ö 品.txt"), has_progress=False)
    text, path = worker.answer(call)
    assert text == "é 部"
    assert Path(path).is_relative_to(place)
    array = worker.answer(Call(np.ones, (LARGE,), has_progress=False))
    assert array.sum() == LARGE
    worker.end()
    assert [path.name for path in place.iterdir() if path.is_dir()] in ([], ["__pycache__"])


@pytest.mark.costly
def test_a_call_over_its_limits_is_ended_with_its_process():
    for limits, call, what in (
        (Limits(seconds=1.0), Call(calls.hold, (600.0,)), "time"),
        (Limits(memory_gb=0.4), Call(calls.take_memory, (10**9,), has_progress=False), "memory"),
    ):
        worker = Worker(PYTHON)
        with pytest.raises(OverLimit) as caught:
            worker.answer(call, limits=limits)
        assert caught.value.what == what
        assert not worker.end().last_words
        assert not worker.is_alive


def test_one_that_is_asked_about_while_it_works_ends_when_the_answer_is_no():
    worker = Worker(PYTHON)

    def no() -> None:
        raise Cancelled("no")

    with pytest.raises(Cancelled):
        worker.answer(Call(calls.hold, (600.0,)), ask=no)
    assert not worker.is_alive
    worker.end()


def test_threads_that_it_may_use_are_told_to_it():
    worker = Worker(replace(PYTHON, threads=3))
    assert worker.answer(Call("volfrep.util.threads:threads", has_progress=False)) == 3
    assert worker.answer(Call(os.getenv, ("OMP_NUM_THREADS",), has_progress=False)) == "3"
    worker.end()


def test_its_matrices_have_one_thread_where_nothing_says_how_many(monkeypatch: pytest.MonkeyPatch):
    """Before anything there loads numpy, which counts them then."""
    for name in MATRIX_THREADS:
        monkeypatch.delenv(name, raising=False)
    worker = Worker(PYTHON)
    asked = Call(os.getenv, ("OPENBLAS_NUM_THREADS",), has_progress=False)
    assert worker.answer(asked) == "1"
    worker.end()


@pytest.mark.costly
def test_a_lattice_made_elsewhere_is_the_one_made_here(engine):
    box = trimesh.creation.box((20.0, 20.0, 10.0))
    cube = TriangleMesh(box.vertices.view(np.ndarray), box.faces.view(np.ndarray).astype(np.int32))
    spec = LatticeSpec(cell="BCC", cell_size=5.0, strut_radius=0.5, shell=0.5)
    solid = check_solid(cube, "cube")
    here = fill(solid, spec)
    call = Call(filled_mesh, (cube, "cube", spec), {"cache": StageCache(), "show": (10**6, 10**5)})
    mesh, report, kinds, digest, shown = engine.begin(call).result()
    np.testing.assert_array_equal(mesh.vertices, here.mesh.vertices)
    np.testing.assert_array_equal(mesh.triangles, here.mesh.triangles)
    assert report.volume_mm3 == here.report.volume_mm3
    np.testing.assert_array_equal(kinds, kinds_of_triangles(here.mesh, solid, spec))
    assert digest == triangles_digest(here.mesh)
    assert sum(len(part.pieces.index) for part in shown.parts) == len(mesh.triangles)


def test_a_cache_stays_there_for_the_next_call_until_it_is_dropped_here(engine):
    cache, other = StageCache(), StageCache()
    assert made(engine, calls.note, cache, "first") == ["first"]
    assert made(engine, calls.note, other, "apart") == ["apart"]
    assert made(engine, calls.note, cache, "second") == ["first", "second"]
    del cache
    gc.collect()
    assert made(engine, calls.note, StageCache(), "third") == ["third"]


def test_progress_and_what_is_to_be_heard_arrive(engine):
    heard: list[tuple[object, ...]] = []
    call = Call(calls.tell, (3,), heard={"watch": lambda *told: heard.append(told)})
    running = engine.begin(call)
    assert running.result() == 3
    assert heard == [(0, "step"), (1, "step"), (2, "step")]
    assert running.state == (0.5, "telling")


def test_what_is_raised_arrives_with_its_traceback(engine):
    with pytest.raises(VolfrepError, match="wrong: do it right") as caught:
        made(engine, calls.refuse, "wrong: do it right")
    assert isinstance(caught.value.__cause__, Failed)
    assert "in refuse" in str(caught.value.__cause__)
    with pytest.raises(ZeroDivisionError):
        made(engine, operator.truediv, 1, 0)
    with pytest.raises(VolfrepError, match="nothing keeps the process from its next call"):
        made(engine, calls.refuse, "nothing keeps the process from its next call")


def test_what_cannot_be_found_there_is_said():
    engine = Engines([Program((sys.executable,), (CORE,))])  # where the tests are not
    with pytest.raises(ModuleNotFoundError):
        made(engine, calls.same, 1)
    assert made(engine, operator.add, 1, 1) == 2
    engine.end()


def test_a_call_that_listens_is_cancelled_and_its_process_stays(engine, monkeypatch):
    monkeypatch.setattr(engines, "GRACE", 60.0)
    number = made(engine, os.getpid)
    running = engine.begin(Call(calls.wait_for_a_cancel))
    begun(running)
    running.cancel()
    with pytest.raises(Cancelled):
        running.result()
    assert made(engine, os.getpid) == number


def test_a_call_that_does_not_listen_is_ended_with_its_process(engine):
    process = idle(engine)
    running = engine.begin(Call(calls.hold, (600.0,)))
    begun(running)
    running.cancel()
    with pytest.raises(Cancelled):
        running.result()
    assert not process.is_alive
    assert not process._folder.exists()
    assert made(engine, operator.add, 1, 1) == 2, "another one serves"


@pytest.mark.skipif(sys.platform != "linux", reason="asks /proc")
def test_programs_and_files_of_a_call_end_with_its_process(engine, tmp_path):
    told = tmp_path / "told"
    process = idle(engine)
    running = engine.begin(Call(calls.run_a_program, (str(told),), has_progress=False))
    while not told.is_file() or not told.read_text().endswith("."):
        time.sleep(0.01)
    number, folder = told.read_text().rstrip(".").split(" ", 1)
    assert Path(folder).is_relative_to(process._folder)
    running.cancel()
    with pytest.raises(Cancelled):
        running.result()
    while runs(number):  # the system takes a moment
        time.sleep(0.01)
    assert not Path(folder).exists()


def runs(number: str) -> bool:
    """Whether there is a process of that number that has not ended."""
    try:
        text = Path("/proc", number, "stat").read_text()
    except OSError:
        return False
    return text.rpartition(")")[2].split()[0] != "Z"


def test_one_that_keeps_its_best_is_asked_once_and_ended_when_asked_twice(engine):
    running = engine.begin(Call(calls.best_so_far, keeps_best=True))
    begun(running)
    running.cancel()
    assert running.result() == "the best"
    running = engine.begin(Call(calls.hold, (600.0,), keeps_best=True))
    begun(running)
    running.cancel()
    assert not running.wait(3 * engines.GRACE), "the first only asks"
    running.cancel()
    with pytest.raises(Cancelled):
        running.result()


def test_a_cancel_counts_even_when_the_call_comes_to_its_end(engine, monkeypatch):
    monkeypatch.setattr(engines, "GRACE", 60.0)
    running = engine.begin(Call(calls.best_so_far))
    begun(running)
    running.cancel()
    with pytest.raises(Cancelled):
        running.result()


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="Windows ends processes by a code")
def test_a_process_that_dies_costs_a_sentence(engine):
    number = made(engine, os.getpid)
    running = engine.begin(Call(calls.hold, (600.0,)))
    begun(running)
    os.kill(number, signal.SIGKILL)
    with pytest.raises(VolfrepError, match=r"ended by signal 9: .* the document is as it was"):
        running.result()
    assert made(engine, operator.add, 1, 1) == 2, "another one serves"


def test_one_that_leaves_by_itself_is_told_with_its_last_words(engine):
    with pytest.raises(VolfrepError, match=r"with code 3 \(out of paper\)"):
        made(engine, calls.leave, "out of paper", 3)


def test_calls_that_overlap_have_processes_of_their_own_and_one_is_kept(engine):
    running = [engine.begin(Call(calls.wait_for_a_cancel)) for _ in range(2)]
    for one in running:
        begun(one)
    assert made(engine, operator.add, 1, 1) == 2
    for one in running:
        one.cancel()
        assert one.wait(calls.AT_MOST)
    assert len(engine._idle) == 1


def test_programs_that_are_no_engine_are_told_and_the_next_one_serves():
    told: list[str] = []
    silent = Program((sys.executable, "-c", "raise SystemExit('I am no engine.')"), (CORE,))
    engine = Engines([Program(("/no/such/program",), ()), silent, PYTHON], told.append)
    assert made(engine, os.getpid) != os.getpid()
    assert len(told) == 2
    assert "/no/such/program" in told[0]
    assert "I am no engine" in told[1]
    engine.end()


def test_without_any_a_call_is_made_on_a_thread_here_and_can_be_cancelled():
    engine = Engines([])
    assert made(engine, os.getpid) == os.getpid()
    assert made(engine, threading.get_ident) != threading.get_ident()
    running = engine.begin(Call(calls.wait_for_a_cancel))
    begun(running)
    running.cancel()
    with pytest.raises(Cancelled):
        running.result()


def test_one_that_is_cancelled_before_it_begins_is_not_made(engine, tmp_path):
    with engine._choosing:  # no process yet
        running = engine.begin(Call((tmp_path / "made").touch, has_progress=False))
        running.cancel()
    with pytest.raises(Cancelled):
        running.result()
    assert not (tmp_path / "made").exists()
    assert made(engine, operator.add, 1, 1) == 2


def test_its_files_go_when_it_ends(engine):
    array = made(engine, np.zeros, LARGE)
    assert array.nbytes == 8 * LARGE
    process = idle(engine)
    engine.end()
    assert not process._folder.exists()


@pytest.mark.skipif(not Path("/proc").exists(), reason="looks for it in /proc")
def test_it_ends_with_the_process_that_started_it(tmp_path):
    import subprocess

    text = (
        f"import sys, os, operator; sys.path[:0] = [{CORE!r}]\n"
        "from volfrep.process.worker import Program, Worker\n"
        f"engine = Worker(Program((sys.executable,), ({CORE!r},)))\n"
        "assert engine.greets()\n"
        "print(engine.number, engine._folder, flush=True)\n"
        "os._exit(0)\n"
    )
    done = subprocess.run([sys.executable, "-c", text], capture_output=True, text=True, check=True)
    number, folder = done.stdout.split()
    left = threading.Event()
    for _ in range(600):
        if not Path("/proc", number).exists() and not Path(folder).exists():
            left.set()
            break
        time.sleep(0.1)
    assert left.is_set()


@pytest.mark.skipif(sys.platform != "linux", reason="asks /proc")
def test_a_call_and_its_programs_end_with_the_process_that_started_it(tmp_path):
    import subprocess

    told = tmp_path / "told"
    text = (
        f"import sys, os, time; sys.path[:0] = [{CORE!r}, {HERE!r}]\n"
        "import engine_calls as calls\n"
        "from volfrep.process.worker import Call, Program\n"
        "from volfrep.process.engines import Engines\n"
        f"engines = Engines([Program((sys.executable,), ({CORE!r}, {HERE!r}))])\n"
        f"engines.begin(Call(calls.run_a_program, ({str(told)!r},), has_progress=False))\n"
        f"told = {str(told)!r}\n"
        "while not os.path.isfile(told) or not open(told).read().endswith('.'):\n"
        "    time.sleep(0.01)\n"
        "os._exit(0)\n"
    )
    subprocess.run([sys.executable, "-c", text], check=True, timeout=60)
    number, folder = told.read_text().rstrip(".").split(" ", 1)
    end = time.monotonic() + 60
    while time.monotonic() < end and (runs(number) or Path(folder).exists()):
        time.sleep(0.01)
    still = runs(number)
    if still:
        os.kill(int(number), signal.SIGKILL)
    assert not still
    assert not Path(folder).exists()


def begun(running: Running) -> None:
    """Wait until the call says that it has begun."""
    while running.state[1] != "begun":
        assert not running.wait(0.01), running.result()


def test_a_process_that_is_warm_has_its_modules(engine):
    assert not made(engine, calls.has_imported, "wave")
    engine.warm("wave").result()
    assert made(engine, calls.has_imported, "wave")


def test_a_call_after_another_one_has_its_process_and_what_that_keeps(engine, tmp_path):
    cache, go_on = StageCache(), tmp_path / "go"
    first = engine.begin(Call(calls.note_late, (cache, "one", str(go_on)), has_progress=False))
    second = engine.begin(Call(calls.note, (cache, "two"), has_progress=False, after=first))
    assert not second.wait(0.2)
    go_on.touch()
    assert second.result() == ["one", "two"]


def test_a_call_after_one_that_fails_is_made(engine):
    first = engine.begin(Call("nowhere:nothing", has_progress=False))
    assert engine.begin(Call(calls.same, (1,), has_progress=False, after=first)).result() == 1


def test_a_cancel_ends_the_call_that_another_one_waits_for(engine, tmp_path):
    first = engine.begin(
        Call(calls.note_late, (StageCache(), "", str(tmp_path / "never")), has_progress=False)
    )
    second = engine.begin(Call(calls.same, (1,), has_progress=False, after=first))
    second.cancel()
    for call in (second, first):
        with pytest.raises(Cancelled):
            call.result()


def test_of_processes_that_wait_the_one_of_the_last_call_is_kept(engine, tmp_path):
    cache, go_on = StageCache(), tmp_path / "go"
    late = engine.begin(Call(calls.note_late, (cache, "late", str(go_on)), has_progress=False))
    assert made(engine, calls.same, 1) == 1
    go_on.touch()
    late.result()
    assert made(engine, calls.note, cache, "next") == ["late", "next"]

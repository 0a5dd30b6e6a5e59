# SPDX-License-Identifier: LGPL-2.1-or-later
"""Who cuts the lattice at the wall: processes or a Dask cluster, with the same file from all."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import NoReturn

import numpy as np
import pytest

import command
import samples
import volfrep
from clusters import WORKERS, worker
from clusters import cluster as cluster
from volfrep import LatticeSpec, VolfrepError
from volfrep.design import forecast
from volfrep.io.solid import check_solid, read_solid
from volfrep.io.write.stl import write_stl
from volfrep.jobs import workers as fill_workers
from volfrep.jobs.pipeline import fill as fill_solid
from volfrep.mesh.quality import measure
from volfrep.process import cluster as dask
from volfrep.process import pool
from volfrep.process.head_start import HeadStart
from volfrep.trim import boolean_trim, octant_groups
from volfrep.util import threads

LATTICE = ["--cell", "CVC", "--cell-size", "8", "--strut-radius", "0.8"]
fill = partial(command.fill, LATTICE)
SPEC = LatticeSpec("CVC", cell_size=8.0, strut_radius=0.8, shell=2.0)


def _modules() -> list[str]:
    return list(sys.modules)


@pytest.fixture(autouse=True)
def _small_groups(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(octant_groups, "GROUP_TRIANGLES", 6_000)


@pytest.fixture
def part(tmp_path: Path) -> Path:
    path = tmp_path / "part.stl"
    write_stl(samples.box((32.0, 24.0, 20.0)), path)
    return path


@pytest.mark.costly
def test_the_file_is_the_same_with_any_number_of_workers(tmp_path: Path, part: Path) -> None:
    for count in (1, 3):
        assert fill(part, tmp_path / f"{count}.stl", "--workers", count, "--quiet") == 0
    one, three = ((tmp_path / f"{count}.stl").read_bytes() for count in (1, 3))
    assert one == three


def test_others_help_where_the_job_is_worth_it_or_they_are_asked_for(
    tmp_path: Path, part: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: list[tuple[int, Sequence[str], bool]] = []

    def nobody(
        count: int, modules: Sequence[str], lost: object, *, with_this: bool, first: object
    ) -> NoReturn:
        asked.append((count, modules, with_this))
        raise VolfrepError("Nobody is there.")

    monkeypatch.setattr(pool, "processes", nobody)
    monkeypatch.setattr(threads, "_wanted", 5)
    for worth, given in ((10**9, ()), (10**9, ("--workers", 3)), (1, ()), (1, ("--workers", 3))):
        monkeypatch.setattr(fill_workers, "WORTH_WORKER", worth)
        assert fill(part, tmp_path / "out.stl", "--quiet", "--cell-size", 12, *given) == 2
    modules = fill_workers.MODULES
    told = (3, modules, False)  # whatever it is worth
    assert asked == [(1, (), True), told, (5, modules, True), told]


def test_a_quiet_fill_with_so_many_workers_is_not_foretold(
    tmp_path: Path, part: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def foretold(*given: object, **named: object) -> NoReturn:
        raise VolfrepError("It is foretold.")

    monkeypatch.setattr(forecast, "forecast_fill", foretold)
    monkeypatch.setattr(fill_workers, "FEW_TRIANGLES", 0)
    out = tmp_path / "out.stl"
    assert fill(part, out, "--quiet") == 2
    assert fill(part, out, "--quiet", "--workers", 2) == 0
    assert out.stat().st_size > 10_000


def test_one_starts_early_where_a_part_is_large_enough_and_nothing_else_is_asked_for(
    tmp_path: Path, part: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    began: list[str] = []

    def nobody(*given: object, **named: object) -> NoReturn:
        raise VolfrepError("Nobody is there.")

    monkeypatch.setattr(pool, "processes", nobody)
    monkeypatch.setattr(threads, "_wanted", 5)
    thick, thin = ("--strut-radius", 0.8), ("--relative-density", 0.2)
    for name, worth, given in (
        ("large", 1, thick),
        ("small", 10**9, thick),
        ("so many", 1, (*thick, "--workers", 3)),
        ("a wall", 1, (*thick, "--make", "domain")),
        ("a target", 1, thin),
    ):
        monkeypatch.setattr(fill_workers, "WORTH_WORKER", worth)
        monkeypatch.setattr(HeadStart, "begin", lambda self, name=name: began.append(name))
        lattice = ["--cell", "CVC", "--cell-size", "8"]
        assert command.fill(lattice, part, tmp_path / "out.stl", "--quiet", *given) == 2
        assert "Nobody is there." in capsys.readouterr().err
    assert began == ["large"]


@pytest.mark.costly
def test_as_many_workers_as_are_asked_for(monkeypatch: pytest.MonkeyPatch) -> None:
    with pool.processes(1) as executor:
        assert executor is None, "this process alone"
    with pool.processes(5) as executor:
        assert executor is not None
        assert pool.at_once(executor) == 5
    with pytest.raises(VolfrepError, match="At least 1 worker"), pool.processes(0):
        pass
    with pool.processes(2, ["volfrep.trim.group_cut"]) as executor:
        assert isinstance(executor, pool.WorkerPool)
        assert "volfrep.trim.group_cut" in executor.submit(_modules).result(), "before it is asked"
        assert len(executor.workers) == 2, "both start at once"


@pytest.mark.slow
def test_workers_go_when_all_groups_are_cut_and_groups_are_cut_without_them(
    tmp_path: Path, part: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert fill(part, tmp_path / "one.ply", "--workers", 1, "--quiet") == 0
    made: list[pool.WorkerPool] = []
    join, let_go = boolean_trim.join, pool.let_go

    def kept(executor: object) -> None:
        assert isinstance(executor, pool.WorkerPool)
        made.append(executor)
        let_go(executor)

    def all_loose(*given: object) -> boolean_trim.Joined:
        found = join(*given)
        with pytest.raises(RuntimeError, match="after shutdown"):
            made[0].submit(int)
        monkeypatch.setattr(boolean_trim, "join", join)
        return replace(found, loose=np.arange(2))

    monkeypatch.setattr(pool, "let_go", kept)
    monkeypatch.setattr(boolean_trim, "join", all_loose)
    assert fill(part, tmp_path / "two.ply", "--workers", 2, "--quiet") == 0
    one, two = (measure(read_solid(tmp_path / f"{name}.ply")) for name in ("one", "two"))
    assert (one.bodies, one.genus) == (two.bodies, two.genus)
    assert one.volume == pytest.approx(two.volume, rel=1e-9)


def test_what_does_not_go_together_is_refused(
    tmp_path: Path, part: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    both = ("--workers", 2, "--scheduler", "tcp://127.0.0.1:9")
    assert fill(part, tmp_path / "out.stl", *both) == 2
    assert "not allowed with" in capsys.readouterr().err
    assert fill(part, tmp_path / "out.stl", "--workers", 0, "--quiet") == 2
    assert "At least 1 worker is needed, not 0" in capsys.readouterr().err


def test_a_worker_with_another_version_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    class Cluster:
        def __init__(self, found: object) -> None:
            self.found = found

        def run(self, function: object, on_error: str) -> dict[str, object]:
            return {"tcp://one": dask.VERSION, "tcp://two": self.found}

    dask._refuse_other_versions(Cluster(dask.VERSION))
    with pytest.raises(VolfrepError, match=r"'tcp://two' has another VOLFREP .*: 0\.0\.1"):
        dask._refuse_other_versions(Cluster("0.0.1"))
    with pytest.raises(VolfrepError, match="none that it can import"):
        dask._refuse_other_versions(Cluster(ModuleNotFoundError("volfrep")))


@pytest.mark.costly
def test_a_scheduler_that_is_not_there_is_told(
    tmp_path: Path, part: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    pytest.importorskip("distributed", reason="needs the optional package distributed")
    monkeypatch.setattr(dask, "PATIENCE", 0.3)
    assert fill(part, tmp_path / "out.stl", "--scheduler", "tcp://127.0.0.1:9", "--quiet") == 2
    assert "No Dask scheduler answers at 'tcp://127" in capsys.readouterr().err
    assert not (tmp_path / "out.stl").exists()


@pytest.mark.slow
def test_a_cluster_makes_the_file_that_this_process_makes(
    tmp_path: Path, part: Path, cluster: tuple[str, list[subprocess.Popen]]
) -> None:
    address, _ = cluster
    assert fill(part, tmp_path / "here.stl", "--workers", 1, "--quiet") == 0
    assert fill(part, tmp_path / "there.stl", "--scheduler", address, "--quiet") == 0
    assert (tmp_path / "there.stl").read_bytes() == (tmp_path / "here.stl").read_bytes()


@pytest.mark.slow
@pytest.mark.parametrize("killed", [1, WORKERS], ids=["one", "all, and another comes"])
def test_workers_that_are_killed_cost_time_and_nothing_else(
    killed: int, tmp_path: Path, cluster: tuple[str, list[subprocess.Popen]]
) -> None:
    address, programs = cluster
    solid = check_solid(samples.box((48.0, 36.0, 28.0)), "box")
    later = []

    def kill_when_some_are_cut(fraction: float, stage: str) -> None:
        if stage == "trim" and fraction > 0.68 and not later:
            for program in programs[:killed]:
                os.kill(program.pid, signal.SIGKILL)
                program.wait()
            later.append(worker(address, tmp_path) if killed == WORKERS else None)

    try:
        with dask.dask_workers(address) as executor:
            made = volfrep.fill(solid, SPEC, progress=kill_when_some_are_cut, executor=executor)
    finally:
        for program in filter(None, later):
            program.kill()
            program.wait()
    assert [program.poll() for program in programs[:killed]] == [-signal.SIGKILL] * killed
    alone = fill_solid(solid, SPEC)
    np.testing.assert_array_equal(made.result.mesh.vertices, alone.mesh.vertices)
    np.testing.assert_array_equal(made.result.mesh.triangles, alone.mesh.triangles)


def test_workers_that_have_all_gone_are_told(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of an executor that has a Dask client; no other one is asked."""
    answers: list[dict[str, int] | OSError] = []

    class Client:
        def nthreads(self) -> dict[str, int]:
            answer = answers.pop(0)
            if isinstance(answer, OSError):
                raise answer
            return answer

    class ClientExecutor:
        _client = Client()

    now = iter([0.0, 0.5, 2.0, 15.0, 23.0]).__next__
    monkeypatch.setattr(dask.time, "monotonic", now)
    watch = dask.Watch(ClientExecutor())  # type: ignore[arg-type]
    answers += [{"tcp://one": 1}, {}, OSError("no scheduler")]
    watch()
    assert len(answers) == 3, "not so soon again"
    watch()
    watch()
    with pytest.raises(VolfrepError, match="has had no worker for 20 s"):
        watch()
    assert not answers
    monkeypatch.undo()
    dask.Watch(None)()


@pytest.mark.slow
def test_a_fill_whose_workers_have_all_gone_ends(
    tmp_path: Path,
    part: Path,
    cluster: tuple[str, list[subprocess.Popen]],
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    address, programs = cluster
    start = []

    class Watch(dask.Watch):
        def __init__(self, executor: object) -> None:
            super().__init__(executor)  # type: ignore[arg-type]
            for program in programs:
                os.kill(program.pid, signal.SIGKILL)
                program.wait()
            start.append(time.monotonic())

    monkeypatch.setattr(boolean_trim, "Watch", Watch)
    monkeypatch.setattr(dask, "PATIENCE", 3)
    out = tmp_path / "out.stl"
    assert fill(part, out, "--scheduler", address, "--quiet") == 2
    assert time.monotonic() - start[0] < 15.0
    told = capsys.readouterr().err
    assert "volfrep: The Dask scheduler has had no worker for 3 s" in told
    assert not out.exists()

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs in processes of their own: limits, deaths, and the same table whoever does them."""

from __future__ import annotations

import json
import os
import random
import signal
import subprocess
import sys
import time
from dataclasses import replace
from pathlib import Path

import pytest

import samples
import volfrep
from swept import timeless
from volfrep import Study, VolfrepError
from volfrep.io.solid import check_solid
from volfrep.io.write.stl import write_stl
from volfrep.process.worker import Call, Program, Worker
from volfrep.studies import page
from volfrep.studies.running import child

BOX = check_solid(samples.box((24.0, 16.0, 16.0)), "box")
FILLED = Study(
    parts=(BOX,),
    vary={"cell": ("BCC", "CVC"), "strut_radius": (0.8, 0.9)},
    fixed={"cell_size": 8.0, "shell": 1.0, "resolution": 8},
    do=("forecast", "properties", "fill", "measure"),
)
SLOW = Study(
    parts=(BOX,),
    vary={"cell": ("Octet",)},
    fixed={"cell_size": 1.0, "strut_radius": 0.1, "shell": 0.5},
    do=("fill",),
)


@pytest.fixture(autouse=True)
def _unplotted(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(page, "plots_of", lambda *_: [])


@pytest.fixture(scope="module")
def here(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The runs, as this process makes them."""
    folder = tmp_path_factory.mktemp("here")
    volfrep.sweep(FILLED, folder, workers=1)
    return folder


@pytest.mark.slow
def test_two_processes_make_the_same_table_as_this_one(here: Path, tmp_path: Path) -> None:
    volfrep.sweep(FILLED, tmp_path, workers=2)
    assert timeless(tmp_path) == timeless(here)


def test_a_run_over_its_limits_is_ended_and_told(tmp_path: Path) -> None:
    made = volfrep.sweep(SLOW, tmp_path / "time", limit_hours=1e-4)
    assert made.table.column("error") == [
        "fill: The run took more than the limit of 0.0001 hours, and was ended."
    ]
    made = volfrep.sweep(SLOW, tmp_path / "memory", limit_memory=0.01)
    assert "more than the limit of 0.01 GB" in made.table.column("error")[0]
    with pytest.raises(VolfrepError, match="time must be above 0 hours"):
        volfrep.sweep(SLOW, tmp_path, limit_hours=0.0)


@pytest.mark.slow
def test_limits_that_are_kept_change_nothing(here: Path, tmp_path: Path) -> None:
    volfrep.sweep(FILLED, tmp_path, workers=1, limit_hours=1.0, limit_memory=8.0)
    assert timeless(tmp_path) == timeless(here)


@pytest.mark.slow
def test_a_process_that_dies_gets_its_run_again_and_then_is_at_fault(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    only_filled = replace(FILLED, do=("fill",))
    tried = []

    def deadly(worker: Worker, call: Call, **more: object) -> object:
        tried.append(call)
        if len(tried) in deaths:
            worker._child.kill()
        return answer(worker, call, **more)  # type: ignore[arg-type]

    answer = Worker.answer
    monkeypatch.setattr(Worker, "answer", deadly)
    deaths = (1,)
    made = volfrep.sweep(only_filled, tmp_path / "once", workers=1, limit_hours=1.0)
    assert made.count("done") == 4
    tried.clear()
    deaths = (1, 2)
    made = volfrep.sweep(only_filled, tmp_path / "twice", workers=1, limit_hours=1.0)
    assert made.count("failed") == 1
    (said,) = (text for text in made.table.column("error") if text)
    assert "ended by signal 9, 2 times" in said


@pytest.mark.costly
def test_an_interpreter_is_asked_whether_it_runs_the_engine(tmp_path: Path) -> None:
    assert child.runs_engine(Program((sys.executable,), tuple(filter(None, sys.path))))
    assert not child.runs_engine(Program((str(tmp_path / "python"),), ()))
    (tmp_path / "volfrep").mkdir()
    (tmp_path / "volfrep" / "__init__.py").touch()  # another engine, which has no studies
    assert not child.runs_engine(Program((sys.executable,), (str(tmp_path),)))


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="a shell script stands for the interpreter")
def test_runs_are_done_by_the_interpreter_that_is_named(tmp_path: Path) -> None:
    named = tmp_path / "python"
    named.write_text(f'#!/bin/sh\ntouch "{tmp_path}/called"\nexec "{sys.executable}" "$@"\n')
    named.chmod(0o755)
    python = Program((str(named),), tuple(filter(None, sys.path)))
    told = []
    made = volfrep.sweep(
        FILLED, tmp_path / "runs", workers=2, interpreter=python,
        words=lambda done, runs, _: f"{done}/{runs}", progress=lambda _, text: told.append(text),
    )  # fmt: skip
    assert made.count("done") == 4
    assert (tmp_path / "called").is_file()
    assert told[-1] == "4/4"


def _study_file(folder: Path, count: int, actions: list[str]) -> Path:
    write_stl(samples.box((24.0, 16.0, 16.0)), folder / "box.stl")
    radii = [round(0.6 + 0.3 * k / count, 4) for k in range(count)]
    (folder / "study.toml").write_text(
        f'part = "box.stl"\ndo = {json.dumps(actions)}\n[fixed]\ncell_size = 8\nshell = 1\n'
        f'[vary]\ncell = ["BCC", "CVC"]\nstrut_radius = {radii}\n'
        '[front]\nobjectives = { forecast.mass_g = "least", forecast.struts = "least" }\n'
        'do = ["measure"]\n'
    )
    return folder / "study.toml"


def _started(study: Path, folder: Path) -> subprocess.Popen:
    command = [sys.executable, "-m", "volfrep", "sweep", study, "-o", folder, "--quiet"]
    return subprocess.Popen([*map(str, command), "--workers", "2"], start_new_session=True)


@pytest.mark.slow
def test_a_study_killed_ten_times_makes_the_same_table_as_one_that_ran_through(
    tmp_path: Path,
) -> None:
    study = _study_file(tmp_path, 12, ["forecast", "properties", "fill"])
    start = time.monotonic()
    assert _started(study, tmp_path / "through").wait() == 0
    length = time.monotonic() - start
    chance = random.Random(5)
    kept = []
    for _ in range(10):
        process = _started(study, tmp_path / "killed")
        time.sleep(chance.uniform(0.05, 0.3) * length)
        os.kill(process.pid, signal.SIGKILL)  # its children end by themselves
        process.wait()
        records = tmp_path / "killed" / "records"
        kept.append(len(list(records.glob("*.json"))) if records.is_dir() else 0)
        for path in records.glob("*.json"):
            json.loads(path.read_text())  # whole, or not there
    assert kept == sorted(kept)
    assert kept[-1] > 0
    assert _started(study, tmp_path / "killed").wait() == 0
    assert timeless(tmp_path / "killed") == timeless(tmp_path / "through")

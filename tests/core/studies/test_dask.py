# SPDX-License-Identifier: LGPL-2.1-or-later
"""Studies by Dask's own programs on the loopback: the same table, with a worker killed or not."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest

import samples
import volfrep
from clusters import cluster as cluster
from swept import timeless
from volfrep import Study, VolfrepError
from volfrep.io.solid import check_solid
from volfrep.process import cluster as dask
from volfrep.studies import page

BOX = check_solid(samples.box((24.0, 16.0, 16.0)), "box")
STUDY = Study(
    parts=(BOX,),
    vary={"cell": ("BCC", "CVC"), "strut_radius": (0.7, 0.75, 0.8, 0.85, 0.9, 0.95)},
    fixed={"cell_size": 8.0, "shell": 1.0},
    do=("forecast", "properties", "fill", "measure"),
)


@pytest.fixture(autouse=True)
def _unplotted(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(page, "plots_of", lambda *_: [])


@pytest.mark.slow
def test_a_worker_that_is_killed_costs_its_runs_time_only(
    tmp_path: Path, cluster: tuple[str, list[subprocess.Popen]]
) -> None:
    address, workers = cluster
    folder = tmp_path / "dask"

    def kill_one_at_work() -> None:
        while sum('"fill"' in p.read_text() for p in folder.glob("records/*.json")) < 2:
            time.sleep(0.05)
        os.kill(workers[0].pid, signal.SIGKILL)

    killer = threading.Thread(target=kill_one_at_work)
    killer.start()
    made = volfrep.sweep(STUDY, folder, scheduler=address)
    killer.join()
    assert workers[0].wait() == -signal.SIGKILL
    assert made.count("done") == 12
    volfrep.sweep(STUDY, tmp_path / "here", workers=1)
    assert timeless(folder) == timeless(tmp_path / "here")


@pytest.mark.slow
def test_a_study_goes_on_by_a_scheduler_where_this_machine_stopped(
    tmp_path: Path, cluster: tuple[str, list[subprocess.Popen]]
) -> None:
    address, _ = cluster
    volfrep.sweep(STUDY, tmp_path, workers=1, shard=(1, 2))
    told: list[str] = []
    made = volfrep.sweep(
        STUDY, tmp_path, scheduler=address, progress=lambda _, text: told.append(text)
    )
    assert made.runs == 6, "designs, without a mesh and then with one"
    assert made.count("done") == 12
    assert told[-1].startswith("6 of 6 runs")


def test_a_scheduler_that_is_not_there_is_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pytest.importorskip("distributed", reason="needs the optional package distributed")
    monkeypatch.setattr(dask, "PATIENCE", 0.3)
    with pytest.raises(VolfrepError, match="No Dask scheduler answers at 'tcp://127"):
        volfrep.sweep(STUDY, tmp_path, scheduler="tcp://127.0.0.1:9")


def test_a_missing_package_is_told_with_what_installs_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(VolfrepError, match=r"pip install volfrep\[dask\]"):
        volfrep.sweep(STUDY, tmp_path, scheduler="tcp://127.0.0.1:9")

# SPDX-License-Identifier: LGPL-2.1-or-later
"""A Dask cluster on the loopback, of Dask's own programs."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

WORKERS = 3


def program(*arguments: object) -> subprocess.Popen:
    """One of Dask's programs, in a group of its own."""
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    command = [sys.executable, "-m", "dask", *map(str, arguments)]
    return subprocess.Popen(
        command, env=environment, start_new_session=True,
        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
    )  # fmt: skip


def worker(address: str, folder: Path) -> subprocess.Popen:
    """`dask worker` of one thread, with its files in a folder."""
    return program(
        "worker", address, "--nthreads", "1", "--no-dashboard", "--no-nanny",
        "--local-directory", folder / "scratch",
    )  # fmt: skip


@pytest.fixture
def cluster(tmp_path: Path) -> Iterator[tuple[str, list[subprocess.Popen]]]:
    """`dask scheduler` and `WORKERS` times `dask worker`; its address, and the workers."""
    pytest.importorskip("distributed", reason="needs the optional package distributed")
    known = tmp_path / "scheduler.json"
    started = [
        program("scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard",
                "--scheduler-file", known)
    ]  # fmt: skip
    try:
        while not known.is_file():
            assert started[0].poll() is None, "dask scheduler has ended"
            time.sleep(0.1)
        from distributed import Client

        address = json.loads(known.read_text())["address"]
        started += [worker(address, tmp_path) for _ in range(WORKERS)]
        with Client(address) as client:
            client.wait_for_workers(WORKERS)
        yield address, started[1:]
    finally:
        for process in started:
            process.kill()
            process.wait()

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs in a process of their own, which may be ended, or die, without harm to the study.

The process is this Python's, and `served` is what it does.

Children with a pipe and no `ProcessPoolExecutor`: one that dies takes one run with it and not the
pool, one run can be ended for a limit, and a script needs no main guard.
"""

from __future__ import annotations

import os
import pickle
import subprocess
import sys
import threading
import time
from collections.abc import Iterable
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path

from ...util.errors import Cancelled, VolfrepError
from ...util.progress import ProgressCallback
from ...util.subprocesses import NO_WINDOW
from ...util.version import VERSION
from ..designs import Design
from .batches import DONE, Batch, Ended, Interpreter, Limits, note, record_of

#: How often a run is looked at, s.
LOOK = 0.2
#: A process that dies by itself gets its run again, so often; then the run is at fault.
TRIES = 2
_PROGRAM = "from volfrep.studies.running.served import serve; serve()"
CANCELLED = "cancelled"
#: Variables by which linear algebra is told its threads.
_THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")


def run_in_child(
    batches: Iterable[Batch], ended: Ended | None, progress: ProgressCallback | None
) -> None:
    """Do the runs of batches of one study in a process beside this one, which keeps its caches.

    Raises:
        VolfrepError: as `run_batch`.
        Cancelled: the callback said so; the process has been ended.
    """
    child: _Child | None = None
    try:
        for batch in batches:
            if batch.limits.memory_gb is not None:
                resident_gb(os.getpid())
            for design in batch.designs:
                child = _run(batch, design, child, progress)
                if ended is not None:
                    ended(design.key)
    finally:
        if child is not None:
            child.end()


def _run(
    batch: Batch, design: Design, child: _Child | None, progress: ProgressCallback | None
) -> _Child | None:
    """Do one run, twice where its process dies; the process that is left."""
    for tried in range(1, TRIES + 1):
        if not record_of(batch, design).missing(batch.actions, batch.asked, batch.retry):
            return child
        child = child or _Child(batch)
        try:
            ending = child.run(design, batch.limits, progress)
        except BaseException:
            child.end()
            raise
        if ending is None:
            return child
        child.end()
        child = None
        if ending.limited or tried == TRIES:
            note(batch, design, ending.sentence)
            break
    return child


@dataclass(frozen=True)
class _Ending:
    """Why a process has ended.

    Attributes:
        sentence: for the record.
        limited: whether we have ended it, for a limit.
    """

    sentence: str
    limited: bool


class _Child:
    """A process that does runs, one at a time."""

    def __init__(self, batch: Batch) -> None:
        threads = str(batch.threads or "")
        python = batch.interpreter or _this()
        environment = _environment(python)
        if threads:
            environment.update(dict.fromkeys(_THREADS, threads))
        self._process = subprocess.Popen(
            [python.executable, "-c", _PROGRAM],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            env=environment,
            creationflags=NO_WINDOW,
        )
        self._send(replace(batch, designs=(), apart=False, limits=Limits()))

    def run(
        self, design: Design, limits: Limits, progress: ProgressCallback | None
    ) -> _Ending | None:
        """Do one run; None once it is done, else why the process has ended.

        Raises:
            Cancelled: the callback said so.
            VolfrepError: as the process says; the study cannot go on.
        """
        process, out = self._process, self._process.stdout
        assert out is not None
        stop = threading.Event()
        broken: list[str] = []
        watch = threading.Thread(
            target=_watch, args=(process, limits, progress, stop, broken), daemon=True
        )
        watch.start()
        try:
            self._send(design)
            answer = out.readline()
        except OSError:  # it has died while it was spoken to
            answer = b""
        finally:
            stop.set()
            watch.join()
        if broken == [CANCELLED]:
            raise Cancelled("cancelled between runs")
        if broken:
            return _Ending(broken[0], limited=True)
        if answer == DONE:
            return None
        if answer:
            raise VolfrepError(answer.decode().strip())
        code = process.wait()
        how = f"by signal {-code}" if code < 0 else f"with code {code}"
        return _Ending(
            f"The process of this run ended {how}, {TRIES} times: there may not be enough memory "
            "for it.",
            limited=False,
        )

    def end(self) -> None:
        """End the process, whatever it does."""
        self._process.kill()
        self._process.wait()
        for stream in (self._process.stdin, self._process.stdout):
            if stream is not None:
                with suppress(OSError):  # what was still to be sent has no reader any more
                    stream.close()

    def _send(self, value: object) -> None:
        assert self._process.stdin is not None
        pickle.dump(value, self._process.stdin)
        self._process.stdin.flush()


def runs_engine(python: Interpreter) -> bool:
    """Whether an interpreter finds the engine and all that it needs, and the same version."""
    program = f"{_PROGRAM.partition(';')[0]}, VERSION; assert VERSION == {VERSION!r}"
    try:
        tried = subprocess.run(
            [python.executable, "-c", program], env=_environment(python), creationflags=NO_WINDOW,
            stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
            check=False,
        )  # fmt: skip
    except OSError:
        return False
    return tried.returncode == 0


def _this() -> Interpreter:
    return Interpreter(sys.executable, tuple(filter(None, sys.path)))


def _environment(python: Interpreter) -> dict[str, str]:
    return {**os.environ, "PYTHONPATH": os.pathsep.join(python.path)}


def resident_gb(process: int) -> float:
    """The resident memory of a process, GB.

    Raises:
        VolfrepError: it cannot be told here.
    """
    if Path("/proc/self/statm").exists():
        try:
            pages = Path(f"/proc/{process}/statm").read_text().split()[1]
            return int(pages) * os.sysconf("SC_PAGE_SIZE") / 1e9
        except (OSError, IndexError):  # it has ended meanwhile
            return 0.0
    try:
        import psutil
    except ImportError as error:
        raise VolfrepError(
            "A limit of memory needs the package psutil here, which is not installed: run "
            "'pip install psutil', or leave the limit out."
        ) from error
    try:
        return float(psutil.Process(process).memory_info().rss) / 1e9
    except psutil.NoSuchProcess:
        return 0.0


def _watch(
    process: subprocess.Popen[bytes],
    limits: Limits,
    progress: ProgressCallback | None,
    stop: threading.Event,
    broken: list[str],
) -> None:
    """End a process that breaks a limit, or whose study is cancelled; note which."""
    start = time.monotonic()
    hours, memory = limits.hours, limits.memory_gb
    while not stop.wait(LOOK):
        if hours is not None and time.monotonic() - start > 3600.0 * hours:
            broken.append(f"The run took more than the limit of {hours:g} hours, and was ended.")
        elif memory is not None and resident_gb(process.pid) > memory:
            broken.append(f"The run took more than the limit of {memory:g} GB, and was ended.")
        elif progress is not None and progress(0.0, "") is False:
            broken.append(CANCELLED)
        if broken:
            process.kill()
            return

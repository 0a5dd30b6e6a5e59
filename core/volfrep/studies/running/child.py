# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs in a process of their own, which may be ended, or die, without harm to the study."""

from __future__ import annotations

import os
from collections.abc import Iterable
from dataclasses import replace

from ...process.child import Limits, OverLimit, resident_gb
from ...process.worker import Call, Program, Worker, WorkerLost, this_python
from ...util.errors import Cancelled
from ...util.progress import ProgressCallback
from ...util.version import VERSION
from ..designs import Design
from .batches import Batch, Ended, note, record_of

#: A process that dies by itself gets its run again, so often; then the run is at fault.
TRIES = 2
#: What a process does; this one need not load it.
_RUNS = "volfrep.studies.running.runs"


def run_in_child(
    batches: Iterable[Batch], ended: Ended | None, progress: ProgressCallback | None
) -> None:
    """Do the runs of batches of one study in a process beside this one, which keeps its caches.

    Raises:
        VolfrepError: as `run_batch`.
        Cancelled: the callback said so; the process has been ended.
    """
    worker: Worker | None = None
    try:
        for batch in batches:
            if batch.limits.memory_gb is not None:
                resident_gb(os.getpid())
            for design in batch.designs:
                worker = _run_once(batch, design, worker, progress)
                if ended is not None:
                    ended(design.key)
    finally:
        if worker is not None:
            worker.end()


def _run_once(
    batch: Batch, design: Design, worker: Worker | None, progress: ProgressCallback | None
) -> Worker | None:
    """Do one run, twice where its process dies; the process that is left."""
    given = replace(batch, designs=()), design
    call = Call(f"{_RUNS}:run_alone", given, has_progress=False)

    def ask() -> None:
        if progress is not None and progress(0.0, "") is False:
            raise Cancelled("cancelled between runs")

    sentence = ""
    for _ in range(TRIES):
        if not record_of(batch, design).missing(batch.actions, batch.asked, batch.retry):
            return worker
        worker = worker or Worker(_program(batch))
        try:
            worker.answer(call, limits=batch.limits, ask=ask)
            return worker
        except OverLimit as over:
            sentence = _over(over, batch.limits)
            break
        except WorkerLost as lost:
            sentence = (
                f"The process of this run ended {lost.ending.how}, {TRIES} times: there may not be "
                "enough memory for it."
            )
            worker = None
        except BaseException:
            worker.end()
            raise
    if worker is not None:
        worker.end()
    note(batch, design, sentence)
    return None


def runs_engine(python: Program) -> bool:
    """Whether a Python finds the engine and all that it needs, and the same version."""
    return replace(python, warm=(_RUNS,)).runs(VERSION)


def _program(batch: Batch) -> Program:
    return replace(batch.interpreter or this_python(), threads=batch.threads)


def _over(over: OverLimit, limits: Limits) -> str:
    if over.what == "time":
        most = f"{(limits.seconds or 0.0) / 3600.0:g} hours"
    else:
        most = f"{limits.memory_gb:g} GB"
    return f"The run took more than the limit of {most}, and was ended."

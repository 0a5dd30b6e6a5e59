# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs: what is missing in a design's record is done, and the record written anew."""

from __future__ import annotations

import time
import traceback
from collections.abc import Iterable

from ...design.parameters.table import BY_NAME
from ...util.errors import Cancelled, VolfrepError
from ...util.progress import ProgressCallback
from ..designs import Design
from ..records import kept_part, write_record
from .batches import Batch, Ended, record_of
from .evaluator import FIGURES, Evaluator, Shared

#: What is said of a run whose process ran out of memory.
NO_MEMORY = "There was not enough memory for this run: use larger cells or a coarser resolution."
#: What the runs of a process share.
_shared = Shared()


def run_in_turn(
    batches: Iterable[Batch], ended: Ended | None, progress: ProgressCallback | None
) -> None:
    """Do the runs of batches of one study in this process; `executors.run_batch` says more.

    Raises:
        VolfrepError: the study's folder cannot be used.
        Cancelled: the callback said so; the run that was going on leaves no record.
    """
    shared = Shared()
    for batch in batches:
        for design in batch.designs:
            run_design(batch, design, evaluator_of(batch, design, shared, progress))
            if ended is not None:
                ended(design.key)


def run_alone(batch: Batch, design: Design) -> None:
    """Do one run in a process that does nothing else, and keeps what runs share."""
    run_design(batch, design, evaluator_of(batch, design, _shared))


def run_design(batch: Batch, design: Design, bench: Evaluator) -> None:
    """Do what is missing of one design, and write its record.

    Raises:
        Cancelled: the bench's callback said so; no record is written.
    """
    record = record_of(batch, design)
    missing = record.missing(batch.actions, batch.asked, batch.retry)
    for name in missing:
        start = time.perf_counter()
        record.results.pop(name, None)
        record.errors.pop(name, None)
        record.notes.pop(name, None)
        try:
            record.results[name] = FIGURES[name](bench)
        except VolfrepError as error:
            record.errors[name] = str(error)
        except Cancelled:
            raise
        except MemoryError:
            record.errors[name] = NO_MEMORY
        except Exception as error:  # whatever it is, the study goes on and the user gets a sentence
            record.errors[name] = (
                f"The engine failed with a {type(error).__name__} ({error}), which is a defect of "
                f"VOLFREP: please report it with this record's notes."
            )
            record.notes[name] = [traceback.format_exc()]
        record.keep(name, batch.asked, time.perf_counter() - start)
        if name in bench.notes:
            record.notes[name] = bench.notes[name]
    if missing:
        write_record(batch.asked.folder, record)


def evaluator_of(
    batch: Batch, design: Design, shared: Shared, progress: ProgressCallback | None = None
) -> Evaluator:
    """A design on the bench, its part read from the study's folder."""
    content = design.part.content
    if content not in shared.solids:
        shared.solids[content] = kept_part(batch.asked.folder, content)
    solid = shared.solids[content]
    return Evaluator(design.key, solid, design.spec, _up(design), batch.asked, shared, progress)


def _up(design: Design) -> tuple[float, float, float]:
    x, y, z = design.values.get("build_direction") or BY_NAME["build_direction"].default
    return float(x), float(y), float(z)

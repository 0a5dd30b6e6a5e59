# SPDX-License-Identifier: LGPL-2.1-or-later
"""What one worker gets at a time, and the records of its runs.

A `Batch` holds designs that share a wall or a cell, so that it is made once. It is a plain value
that any `concurrent.futures.Executor` can take to another process or machine, which must see the
study's folder.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from ...process.child import Limits
from ...process.worker import Program
from ...util.errors import VolfrepError
from ..actions import Asked
from ..designs import Design, shown_values
from ..records import Record, read_record, write_record


def limits_of_a_run(hours: float | None, memory_gb: float | None) -> Limits:
    """What one run may take; None for no limit.

    Raises:
        VolfrepError: one is not above 0.
    """
    for name, value, unit in (("time", hours, "hours"), ("memory", memory_gb, "GB")):
        if value is not None and not value > 0.0:
            raise VolfrepError(f"The limit of a run's {name} must be above 0 {unit}, not {value}.")
    return Limits(None if hours is None else 3600.0 * hours, memory_gb)


@dataclass(frozen=True, eq=False)
class Batch:
    """Runs for one worker, one after the other.

    Attributes:
        designs: of the runs.
        actions: to be done with each.
        asked: what the actions take.
        version: of the engine that the study was begun with.
        limits: of each run.
        retry: whether what failed is tried again.
        threads: that each run may use; 0 for all.
        apart: whether runs have a process of their own, which may die without harm.
        interpreter: of these processes; None for the one that starts them.
    """

    designs: tuple[Design, ...]
    actions: tuple[str, ...]
    asked: Asked
    version: str
    limits: Limits
    retry: bool
    threads: int
    apart: bool
    interpreter: Program | None = None


#: Called when a run has ended, with its design's key.
Ended = Callable[[str], None]


def record_of(batch: Batch, design: Design) -> Record:
    """The record of a design, or an empty one."""
    return read_record(batch.asked.folder, design.key) or Record(
        design.key,
        batch.version,
        {"name": design.part.name, "content": design.part.content},
        shown_values(design),
    )


def note(batch: Batch, design: Design, sentence: str) -> None:
    """Write into a design's record why what is missing of it cannot be done."""
    record = record_of(batch, design)
    for name in record.missing(batch.actions, batch.asked, batch.retry):
        record.results.pop(name, None)
        record.errors[name] = sentence
        record.keep(name, batch.asked, 0.0)
    write_record(batch.asked.folder, record)

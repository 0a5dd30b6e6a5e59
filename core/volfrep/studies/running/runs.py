# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs: what is missing in a design's record is done, and the record written anew.

A `Batch` is what one worker gets at a time: designs that share a wall or a cell, so that it is made
once. It is a plain value that any `concurrent.futures.Executor` can take to another process or
machine, which must see the study's folder.
"""

from __future__ import annotations

import time
import traceback
from collections.abc import Callable, Iterable
from dataclasses import dataclass

from ...design.parameters.table import BY_NAME
from ...util.errors import Cancelled, VolfrepError
from ...util.progress import ProgressCallback
from ..actions import Asked
from ..designs import Design, shown_values
from ..records import Record, kept_part, read_record, write_record
from .bench import FIGURES, Bench, Shared

#: What is said of a run whose process ran out of memory.
NO_MEMORY = "There was not enough memory for this run: use larger cells or a coarser resolution."


@dataclass(frozen=True)
class Limits:
    """What one run may take.

    Attributes:
        hours: of time; None for no limit.
        memory_gb: of resident memory; None for no limit.
    """

    hours: float | None = None
    memory_gb: float | None = None

    def __post_init__(self) -> None:
        for name, value, unit in (
            ("time", self.hours, "hours"), ("memory", self.memory_gb, "GB")
        ):  # fmt: skip
            if value is not None and not value > 0.0:
                raise VolfrepError(
                    f"The limit of a run's {name} must be above 0 {unit}, not {value}."
                )

    @property
    def any(self) -> bool:
        """Whether there is one."""
        return self.hours is not None or self.memory_gb is not None


@dataclass(frozen=True)
class Interpreter:
    """A Python that can run the engine in processes.

    Attributes:
        executable: path of the program.
        path: folders in which it finds the engine and what that needs, beside its own.
    """

    executable: str
    path: tuple[str, ...]


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
    interpreter: Interpreter | None = None


#: Called when a run has ended, with its design's key.
Ended = Callable[[str], None]


def run_in_turn(
    batches: Iterable[Batch], ended: Ended | None, progress: ProgressCallback | None
) -> None:
    """Do the runs of batches of one study in this process; `apart.run_batch` says more.

    Raises:
        VolfrepError: the study's folder cannot be used.
        Cancelled: the callback said so; the run that was going on leaves no record.
    """
    shared = Shared()
    for batch in batches:
        for design in batch.designs:
            run_design(batch, design, bench_of(batch, design, shared, progress))
            if ended is not None:
                ended(design.key)


def run_design(batch: Batch, design: Design, bench: Bench) -> None:
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


def record_of(batch: Batch, design: Design) -> Record:
    """The record of a design, or an empty one."""
    return read_record(batch.asked.folder, design.key) or Record(
        design.key,
        batch.version,
        {"name": design.part.name, "content": design.part.content},
        shown_values(design),
    )


def bench_of(
    batch: Batch, design: Design, shared: Shared, progress: ProgressCallback | None = None
) -> Bench:
    """A design on the bench, its part read from the study's folder."""
    content = design.part.content
    if content not in shared.solids:
        shared.solids[content] = kept_part(batch.asked.folder, content)
    solid = shared.solids[content]
    return Bench(design.key, solid, design.spec, _up(design), batch.asked, shared, progress)


def _up(design: Design) -> tuple[float, float, float]:
    x, y, z = design.values.get("build_direction") or BY_NAME["build_direction"].default
    return float(x), float(y), float(z)

# SPDX-License-Identifier: LGPL-2.1-or-later
"""What is missing of a study's designs, cut into batches and given to who does them.

Runs that need no mesh go first; forecasts say how many runs fit side by side, and how long they
take.

Runs that share an offset surface or a cell lie in one batch. Each batch is half of a worker's share
of what is left, down to single runs, so that no worker waits long for the last.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from concurrent.futures import Executor
from contextlib import ExitStack
from dataclasses import dataclass, field
from pathlib import Path

from ...design.spec import LatticeSpec
from ...mechanics.catalogue import known_cell
from ...process.child import Limits
from ...process.cluster import dask_workers
from ...process.pool import at_once
from ...process.worker import Program
from ...util.errors import VolfrepError
from ...util.files import refuse_input
from ...util.progress import ProgressCallback
from ...util.threads import threads
from ...util.version import VERSION
from ..actions import ACTIONS, Asked
from ..designs import Design
from ..expectation import plan
from ..records import Record, kept_part, read_record, record_path
from .batches import Batch
from .executors import (
    Tally,
    Words,
    fitting_workers,
    run_by,
    run_here,
    run_in_background,
    state_text,
)

#: Expected seconds of a run without a mesh, with a cell of the catalogue and with another one.
QUICK, HOMOGENISED = 0.02, 10.0
#: Less work than this is done in this process, s: others take a second to start.
WORTH_A_PROCESS = 5.0
#: A batch is this part of what is left for each worker: long ones first, single runs last, so that
#: nobody waits for more than one run in the end.
SHARE_OF_THE_REST = 0.5
#: Of the actions after a fill, each takes about this part of its time.
AFTER_FILL = 0.2


@dataclass(frozen=True)
class How:
    """How the runs of a study are done.

    Attributes:
        workers: runs side by side; 1 for this process; None for what cores and memory allow.
        executor: that does them in their stead.
        scheduler: of Dask, that does them in their stead.
        shard: i and n: only every n-th design, beginning with the i-th.
        limits: of each run.
        retry: whether what failed is tried again.
        interpreter: of processes beside this one; None for this one's.
        words: say how far the runs are: of runs done, all of them, and seconds left.

    Raises:
        VolfrepError: at construction, where they do not go together.
    """

    workers: int | None = None
    executor: Executor | None = None
    scheduler: str | None = None
    shard: tuple[int, int] = (1, 1)
    limits: Limits = field(default_factory=Limits)
    retry: bool = False
    interpreter: Program | None = None
    words: Words = state_text

    def __post_init__(self) -> None:
        given = [v for v in (self.workers, self.executor, self.scheduler) if v is not None]
        if len(given) > 1:
            raise VolfrepError("Give one of workers, executor and scheduler: each says who works.")
        if not 1 <= self.shard[0] <= self.shard[1]:
            raise VolfrepError(
                f"A shard is one of so many, such as 1/4 or 4/4, not {self.shard[0]}/"
                f"{self.shard[1]}."
            )


class Job:
    """Runs of a study's designs, as they were asked for."""

    def __init__(
        self, folder: Path, asked: Asked, how: How, progress: ProgressCallback | None
    ) -> None:
        self._folder, self._asked, self._how, self._progress = folder, asked, how, progress

    def do(self, designs: Sequence[Design], actions: tuple[str, ...]) -> set[str]:
        """Do what is missing, what needs no mesh first; the keys of the designs it was of."""
        done: set[str] = set()
        for meshed in (False, True):
            names = tuple(name for name in actions if ACTIONS[name].meshed == meshed)
            pending = [design for design in designs if self._is_missing(design, names)]
            if pending:
                self._run(pending, names, meshed)
                done |= {design.key for design in pending}
        return done

    def _is_missing(self, design: Design, names: tuple[str, ...]) -> bool:
        record = read_record(self._folder, design.key) or Record(design.key, "", {}, {})
        return bool(record.missing(names, self._asked, self._how.retry))

    def _run(self, designs: list[Design], names: tuple[str, ...], meshed: bool) -> None:
        for design in designs:
            _refuse_inputs(self._folder, design, names, self._asked)
        solids = {d.part.content: kept_part(self._folder, d.part.content) for d in designs}
        plans = {d.key: plan(solids[d.part.content], d.spec) for d in designs}
        table = dict.fromkeys(names, meshed)
        weights = {d.key: weight(d.spec, plans[d.key].seconds, table) for d in designs}
        memory = max(plan.memory_gb for plan in plans.values()) if meshed else 0.2
        how = self._how
        with ExitStack() as open_until_done:
            executor = how.executor
            if how.scheduler is not None:
                executor = open_until_done.enter_context(dask_workers(how.scheduler))
            if executor is not None:
                workers = at_once(executor)
            elif how.workers is None and sum(weights.values()) < WORTH_A_PROCESS:
                workers = 1
            else:
                workers = min(fitting_workers(memory, how.workers), len(designs))
            beside = executor is None and workers > 1
            batches = [
                self._batch(group, names, workers if beside else 0)
                for group in group_designs(designs, weights, workers, meshed)
            ]
            tally = Tally(weights, workers, self._progress, how.words)
            if executor is not None:
                run_by(executor, batches, tally)
            elif beside:
                run_in_background(batches, tally)
            else:
                run_here(batches, tally)

    def _batch(self, designs: list[Design], names: tuple[str, ...], beside: int) -> Batch:
        how = self._how
        each = max(1, threads() // beside) if beside else 0
        return Batch(
            tuple(designs),
            names,
            self._asked,
            VERSION,
            how.limits,
            how.retry,
            each,
            beside > 0,
            how.interpreter,
        )


def _refuse_inputs(folder: Path, design: Design, names: tuple[str, ...], asked: Asked) -> None:
    """Raise a `VolfrepError` where a run, perhaps in another process, would write over an input."""
    refuse_input(record_path(folder, design.key))
    for name in names:
        if (file := ACTIONS[name].file(asked)) is not None:
            for suffix in {file[1], ".csv"}:  # radii have a table of their own
                refuse_input(folder / file[0] / f"{design.key}{suffix}")


def weight(spec: LatticeSpec, seconds: float, actions: Mapping[str, bool]) -> float:
    """Expected seconds of a design's run with these actions, of which some need the mesh."""
    total = 0.0
    if "properties" in actions:
        kind = spec.kind
        cell = kind.catalogue_cell
        known = kind.endless is None or (cell is not None and known_cell(cell) is not None)
        total += QUICK if known else HOMOGENISED
    meshed = sum(actions.values())
    if meshed:
        total += seconds * (1.0 + AFTER_FILL * (meshed - 1))
    return total + QUICK


def group_designs(
    designs: Sequence[Design], weights: Mapping[str, float], workers: int, meshed: bool
) -> list[list[Design]]:
    """Designs in batches, in the order in which workers take them.

    What shares a wall, or an endless lattice, is side by side, and of what shares a wall the
    longest run comes first. Batches become shorter down to single runs.

    Args:
        designs: to be done.
        weights: expected seconds of each, by its key.
        workers: that take batches.
        meshed: whether they share walls, or endless lattices.
    """

    def order(design: Design) -> tuple[str | float, ...]:
        spec = design.spec
        wall = (design.part.content, f"{spec.shell!r}", repr(spec.skin))
        if meshed:
            return (*wall, -weights[design.key], design.key)
        target = "" if spec.target is None else repr(spec.target)
        ratio = f"{spec.strut_radius / spec.cell_size:.9g}"
        return (spec.cell_name, ratio, target, *wall, design.key)

    left = sum(weights.values())
    groups: list[list[Design]] = []
    load, most = 0.0, 0.0
    for design in sorted(designs, key=order):
        if load >= most:
            groups.append([])
            load, most = 0.0, SHARE_OF_THE_REST * left / workers
        groups[-1].append(design)
        load += weights[design.key]
        left -= weights[design.key]
    return groups

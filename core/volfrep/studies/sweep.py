# SPDX-License-Identifier: LGPL-2.1-or-later
"""A whole study: its runs, its table, its Pareto front, its page.

What is in the folder is not done again, so that a study which was interrupted goes on where it
stopped.
"""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..process.worker import Program
from ..util.arguments import check_kind, check_path
from ..util.errors import VolfrepError
from ..util.files import check_writable, keeping_inputs, refuse_input
from ..util.progress import ProgressCallback
from ..util.progress_bar import shown
from ..util.reading import read_text
from ..util.showing import Shown
from ..util.types import Floats
from ..util.version import VERSION
from . import pareto
from .actions import ACTIONS, Asked, Loads
from .designs import Design, Designs, Part, design_of, designs_of, named_part, read_part
from .expectation import plan
from .page import write_page
from .records import damage_of, keep_part, prepare, read_record, record_path
from .running.batches import limits_of_a_run
from .running.executors import Words, state_text
from .running.scheduling import How, Job, weight
from .study import Front, Study, read_study
from .table import DONE, FAILED, OPEN, Table, table_of, write_csv, write_parquet

if TYPE_CHECKING:
    import pandas

#: The files at the top of a study's folder: tables, and the page.
WRITTEN = ("runs.csv", "runs.parquet", "index.html")


@dataclass(frozen=True, eq=False, repr=False)
class Swept(Shown):
    """What a study came to.

    Attributes:
        table: a row for each design.
        front: the designs that are chosen, in the table's order: by their keys, the front that
            each lies on, 1 for the Pareto front itself; none where no front was asked for, or where
            designs are still open.
        refused: how often a sentence says why a combination makes no sense.
        repeated: combinations that are the same as an earlier one.
        runs: designs of which something was done this time.
        page: the page to look at.
        damaged: a sentence for each record that was damaged, and is done anew.
    """

    table: Table
    front: Mapping[str, int]
    refused: Mapping[str, int]
    repeated: int
    runs: int
    page: Path
    damaged: tuple[str, ...] = ()

    def rows(self) -> list[tuple[str, str]]:
        """Names and values, for people."""
        states = ((state, self.count(state)) for state in (DONE, FAILED, OPEN))
        rows = [(state, str(count)) for state, count in states if count]
        return [*rows, ("on the front", str(len(self.front))), ("page", str(self.page))]

    def count(self, state: str) -> int:
        """Designs in a state: ``done``, ``failed`` or ``open``."""
        return self.table.column("state").count(state)

    def to_frame(self) -> pandas.DataFrame:
        """The table as a frame of pandas, a row for each design.

        Raises:
            VolfrepError: pandas is missing.
        """
        return self.table.to_frame()


def sweep(
    study: Study | str | os.PathLike[str],
    folder: str | os.PathLike[str],
    *,
    workers: int | None = None,
    executor: Executor | None = None,
    scheduler: str | None = None,
    shard: tuple[int, int] = (1, 1),
    limit_hours: float | None = None,
    limit_memory: float | None = None,
    retry_failed: bool = False,
    progress: ProgressCallback | bool | None = None,
    interpreter: Program | None = None,
    words: Words = state_text,
) -> Swept:
    """Make many designs, and a table of them, a page to look at, and their Pareto front.

    Args:
        study: what varies and what is done, or a study's file (docs/studies.md).
        folder: of the records, one a design; what is there is not done again.
        workers: runs side by side, each in a process; 1 for this process; None for as many as
            cores and memory allow by the forecasts.
        executor: any that does the runs in place of processes; its workers must see the folder.
        scheduler: address of a Dask scheduler, in place of either.
        shard: (i, n): only every n-th design, beginning with the i-th, from 1 on.
        limit_hours: for each run, which is ended and told.
        limit_memory: for each run, GB.
        retry_failed: try again what failed.
        progress: True for a bar in a terminal or a notebook; or a function that is called with the
            fraction done, and runs and time left in words, and cancels by returning False.
        interpreter: of the processes, where this program is no Python that can start itself.
        words: say how far the runs are: of runs done, all of them, and seconds left.

    Raises:
        VolfrepError: the study cannot be begun; a run that fails ends nothing.
        Cancelled: the callback said so; what is done is kept.

    >>> import tempfile, trimesh, volfrep
    >>> box = volfrep.as_solid(trimesh.creation.box((30, 20, 20)))
    >>> study = volfrep.Study(parts=(box,), vary={"cell": ("BCC", "CVC"), "shell": (1, 2)})
    >>> with tempfile.TemporaryDirectory() as runs:
    ...     made = volfrep.sweep(study, runs)
    >>> made.count("done"), made.table.column("cell")
    (4, ['BCC', 'BCC', 'CVC', 'CVC'])
    """
    check_kind("study", study, (Study, str, os.PathLike), "a Study, or the path of its file")
    limits = limits_of_a_run(limit_hours, limit_memory)
    how = How(workers, executor, scheduler, shard, limits, retry_failed, interpreter, words)
    with keeping_inputs(), shown(progress) as callback:
        study = study if isinstance(study, Study) else read_study(study)
        return _swept(study, folder, how, callback)


def _swept(
    study: Study, folder: str | os.PathLike[str], how: How, progress: ProgressCallback | None
) -> Swept:
    at, parts, asked = _begun(study, folder)
    found = designs_of(study, parts)
    if not found.designs:
        raise VolfrepError(_nothing_left(found))
    for name in WRITTEN:  # before any work; what else is in the way is found as it is written
        check_writable(at / name)
    job = Job(at, asked, how, progress)
    mine = found.designs[how.shard[0] - 1 :: how.shard[1]]
    damaged = tuple(_damage_text(record_path(at, design.key)) for design in mine)
    runs = job.do(mine, tuple(study.do))
    front: Mapping[str, int] = {}
    if study.front is not None:
        front = _front(at, found.designs, study, asked)
        if study.front.do and front:
            best = [design for design in mine if design.key in front]
            runs |= job.do(best, study.all_actions)
    return replace(
        _summarise(study, at, found, front, len(runs)), damaged=tuple(filter(None, damaged))
    )


def evaluate(
    study: Study,
    designs: Sequence[Mapping[str, Any]],
    folder: str | os.PathLike[str],
    *,
    workers: int | None = None,
    executor: Executor | None = None,
    scheduler: str | None = None,
    progress: ProgressCallback | bool | None = None,
) -> list[dict[str, Any]]:
    """The figures of designs that an optimiser asks for: what it is told then.

    Args:
        study: one part, what is fixed and what is done; its own designs do not matter.
        designs: values by name, on top of those that are fixed.
        folder: as of `sweep`; a design that was asked for before is not made again.
        workers: as of `sweep`.
        executor: as of `sweep`.
        scheduler: as of `sweep`.
        progress: as of `sweep`.

    Returns:
        For each design its figures by the names of the table's columns, such as
        ``forecast.mass_g``, and ``error``: None, or the sentence that says why some are missing.

    Raises:
        VolfrepError: the study cannot be begun; designs that make no sense are told in their
            ``error``.
        Cancelled: the callback said so.

    >>> import tempfile, trimesh, volfrep
    >>> box = volfrep.as_solid(trimesh.creation.box((20, 20, 20)))
    >>> study = volfrep.Study(parts=(box,), fixed={"cell": "BCC"}, do=("forecast",))
    >>> with tempfile.TemporaryDirectory() as runs:
    ...     thin, none = volfrep.evaluate(
    ...         study, [{"strut_radius": 0.5}, {"strut_radius": 9.0}], runs, workers=1
    ...     )
    >>> thin["forecast.mass_g"] > 0, none["error"].startswith("Struts of radius 9 mm")
    (True, True)
    """
    check_kind("study", study, Study, "a Study")
    check_kind("designs", designs, Sequence, "a list of dicts with values by name")
    for row in designs:
        check_kind("designs", row, Mapping, "a list of dicts with values by name")
    at, parts, asked = _begun(study, folder)
    if len(parts) > 1:
        raise VolfrepError(f"An optimiser looks at one part, not at {len(parts)}.")
    made: list[Design | str] = []
    for row in designs:
        values = {**study.fixed, **row}
        try:
            made.append(design_of(parts[0], values, asked.material, VERSION))
        except VolfrepError as error:
            made.append(str(error))
    sound = {one.key: one for one in made if isinstance(one, Design)}
    with shown(progress) as callback:
        job = Job(at, asked, How(workers, executor, scheduler), callback)
        job.do(tuple(sound.values()), tuple(study.do))
    return [_figures(at, one, tuple(study.do)) for one in made]


def _figures(folder: Path, made: Design | str, actions: tuple[str, ...]) -> dict[str, Any]:
    if isinstance(made, str):
        return {"key": None, "error": made}
    record = read_record(folder, made.key)
    assert record is not None, "its run has ended"
    figures: dict[str, Any] = {"key": made.key}
    for name in actions:
        found = record.results.get(name, {})
        figures |= {f"{name}.{figure}": value for figure, value in found.items()}
    errors = [f"{name}: {record.errors[name]}" for name in actions if name in record.errors]
    return {**figures, "error": " ".join(errors) or None}


def _damage_text(path: Path) -> str:
    """A sentence where a record is damaged; empty where it is not."""
    wrong = damage_of(path)
    return f"The record '{path}' is damaged, {wrong}: its run is done anew." if wrong else ""


def _begun(study: Study, folder: str | os.PathLike[str]) -> tuple[Path, tuple[Part, ...], Asked]:
    """A study's folder, with its parts in it."""
    check_path("folder", folder)
    at = Path(folder).resolve()
    read = [read_part(given, study.unit) for given in study.parts]
    for name in WRITTEN:
        refuse_input(at / name)
    prepare(at)
    parts = []
    loads = None
    for source, solid in read:
        parts.append(named_part(source, solid))
        keep_part(at, parts[-1].content, solid)
        if study.loads is not None:
            from ..jobs.sizing.goal import goal_of
            from ..loads.load_file import read_load_cases

            path = Path(study.loads).resolve()
            material = read_load_cases(path, solid).material
            loads = Loads(path, read_text(path, "load file"), material.as_dict())
            goal_of(material, study.goal, lambda name: f"size.{name}")
    asked = Asked(
        study.solid_material(), study.print_process(), study.export, at, loads, study.goal
    )
    return at, tuple(parts), asked


def forecast_study(study: Study) -> tuple[Designs, float, float]:
    """The designs, and the seconds and the largest memory in GB that their runs will take.

    Raises:
        VolfrepError: as `sweep`.
    """
    read = [read_part(part, study.unit) for part in study.parts]
    solids = {named_part(*pair).content: pair[1] for pair in read}
    found = designs_of(study, tuple(named_part(*pair) for pair in read))
    plans = [plan(solids[design.part.content], design.spec) for design in found.designs]
    actions = {name: ACTIONS[name].meshed for name in study.do}
    seconds = sum(
        weight(design.spec, plan.seconds, actions)
        for design, plan in zip(found.designs, plans, strict=True)
    )
    meshed = any(actions.values())
    return found, seconds, max((plan.memory_gb for plan in plans), default=0.0) if meshed else 0.2


def _front(
    folder: Path, designs: Sequence[Design], study: Study, asked: Asked
) -> Mapping[str, int]:
    """The front of each design that is chosen, by its key; none while some are still open."""
    assert study.front is not None
    records = [read_record(folder, design.key) for design in designs]
    if any(r is None or r.missing(tuple(study.do), asked, retry=False) for r in records):
        return {}
    table = table_of(designs, records, tuple(study.do), {}, tuple(study.do))
    figures = losses(table, study.front)
    ranks = pareto.ranks(figures)
    rows = pareto.choose(figures, study.front.designs)
    return {designs[row].key: int(ranks[row]) + 1 for row in rows}


def losses(table: Table, front: Front) -> Floats:
    """(n, k) what the objectives make of a table: less is better; of failed designs no number.

    Figures count to six digits: what differs by rounding is equal.

    Raises:
        VolfrepError: an objective names no column.
    """
    signs = {"least": 1.0, "most": -1.0}
    columns = []
    for name, way in front.objectives.items():
        action = name.partition(".")[0]
        if any(column.partition(".")[0] == action for column in table.columns):
            figures = table.numbers(name)
        else:  # it failed everywhere
            figures = np.full(len(table.rows), np.nan)
        columns.append([signs[way] * float(f"{figure:.6g}") for figure in figures])
    return np.array(columns, float).T


def _summarise(
    study: Study, folder: Path, found: Designs, front: Mapping[str, int], runs: int
) -> Swept:
    """Write table and page of what is known now."""
    records = [read_record(folder, design.key) for design in found.designs]
    table = table_of(found.designs, records, study.all_actions, front, tuple(study.do))
    write_csv(table, folder / WRITTEN[0])
    write_parquet(table, folder / WRITTEN[1])
    page = folder / WRITTEN[2]
    write_page(page, study, found, table, front)
    return Swept(table, front, found.refused, found.repeated, runs, page)


def _nothing_left(found: Designs) -> str:
    sentence, count = max(found.refused.items(), key=lambda item: item[1])
    return f"None of the study's combinations makes sense; {count:,} of them: {sentence}"

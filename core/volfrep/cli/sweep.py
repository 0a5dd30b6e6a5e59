# SPDX-License-Identifier: LGPL-2.1-or-later
"""The command ``volfrep sweep``: many designs, their table, and their Pareto front.

numpy and the engine are imported inside the functions, as in `command`.
"""

from __future__ import annotations

import argparse
from collections.abc import Mapping
from typing import TYPE_CHECKING

from ..util.numbers import plural
from ..util.progress_bar import drawn
from .files import check_files
from .telling import print_rows, print_warnings

if TYPE_CHECKING:
    from ..studies.sweep import Swept

#: Sentences on what makes no sense, or failed, that are told.
_MOST_SENTENCES = 5


def run_sweep(options: argparse.Namespace) -> None:
    """Run ``volfrep sweep``."""
    from ..studies.study import read_study
    from ..studies.sweep import sweep

    check_files(options, folder=True)
    study = read_study(options.study)
    if options.dry_run:
        from ..studies.running.executors import time_text
        from ..studies.sweep import forecast_study

        found, seconds, memory = forecast_study(study)
        _warn("passed over", found.refused)
        print_rows(
            ("designs", f"{len(found.designs):,}" + _twice(found.repeated)),
            ("one after the other", f"about {time_text(seconds)}, up to {memory:.2g} GB of memory"),
        )
        return
    with drawn(options.quiet) as progress:
        made = sweep(
            study,
            options.output,
            workers=options.workers,
            scheduler=options.scheduler,
            shard=options.shard,
            limit_hours=options.limit_hours,
            limit_memory=options.limit_memory,
            retry_failed=options.retry_failed,
            progress=progress,
        )
    _tell(made, options.quiet)


def _tell(made: Swept, quiet: bool) -> None:
    _warn_each(made.damaged)
    _warn("passed over", made.refused)
    failed = [sentence for sentence in made.table.column("error") if sentence]
    _warn("failed", {sentence: failed.count(sentence) for sentence in dict.fromkeys(failed)})
    if quiet:
        return
    rows = [
        ("designs", f"{len(made.table.rows):,}" + _twice(made.repeated)),
        ("done", f"{made.count('done'):,}, {made.count('failed'):,} failed"),
    ]
    if made.count("open"):
        rows.append(("open", f"{made.count('open'):,}: other shards, or the next call, do them"))
    if made.front:
        best = sum(rank == 1 for rank in made.front.values())
        rows.append(("chosen", f"{len(made.front):,}, {best:,} of them on the Pareto front"))
    rows += [("this time", plural(made.runs, "design")), ("page", str(made.page))]
    print_rows(*rows)


def _warn(what: str, sentences: Mapping[str, int]) -> None:
    counted = sorted(sentences.items(), key=lambda item: -item[1])
    print_warnings([f"{count:,} {what}: {text}" for text, count in counted[:_MOST_SENTENCES]])
    if len(counted) > _MOST_SENTENCES:
        rest = sum(count for _, count in counted[_MOST_SENTENCES:])
        print_warnings([f"{rest:,} more {what}, for other reasons: see the page."])


def _warn_each(sentences: tuple[str, ...]) -> None:
    print_warnings(sentences[:_MOST_SENTENCES])
    if len(sentences) > _MOST_SENTENCES:
        print_warnings(
            [f"{len(sentences) - _MOST_SENTENCES:,} more records are damaged the same way."]
        )


def _twice(count: int) -> str:
    return f", {count:,} combinations more are the same as one of them" if count else ""

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where the time that remains is spent."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from ..measuring import Context, answer, bench_job, bracket, run
from ..tables import Row


def measure(context: Context) -> dict[str, Any]:
    """cProfile over a block and over the bracket."""
    jobs = [("block 10 x 10 x 10, CVC", ["CVC"])]
    if not context.quick:
        jobs.append(("GE bracket, FCC", ["FCC", str(bracket())]))
    rows: list[Row] = []
    for name, (cell, *part) in jobs:
        out = context.folder / "profiled.stl"
        done = run(bench_job("profile", cell, str(out), *part))
        out.unlink(missing_ok=True)
        row: Row = {"job": name}
        row |= {"note": done.failure, "failed": True} if done.failure else answer(done)
        rows.append(context.say(row))
    return {"rows": rows, "bars": []}


def render(result: dict[str, Any], images: Path) -> str:
    """No chapter: stages and functions are for who makes it faster, in the experiment's JSON."""
    return ""

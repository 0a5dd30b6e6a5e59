# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where the time that remains is spent."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from ..measuring import Context, answer, bench_job, bracket, run
from ..tables import Column, Row, table


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
    """The stages and the top functions of each job."""
    parts = [
        "## What remains\n\nBy stage (the times of the report) and by function (cProfile, which "
        "slows Python's own calls down and sees one thread only; seconds in the function itself, "
        "and with what it calls)."
    ]
    columns = (
        Column("function", "function", lambda text: f"`{text}`"),
        Column("calls", "calls", ","),
        Column("s itself", "seconds", ".3f"),
        Column("s with callees", "with_callees", ".3f"),
    )
    for row in result["rows"]:
        if row.get("note"):
            parts.append(f"### {row['job']}\n\n{row['note']}")
            continue
        stages = [{"stage": name, "seconds": value} for name, value in row["stages"].items()]
        listed = table((Column("stage", "stage"), Column("s", "seconds", ".3f")), stages)
        top = table(columns, row["functions"])
        parts.append(
            f"### {row['job']}: {row['seconds']:.2f} s under cProfile\n\n{listed}\n\n{top}"
        )
    return "\n\n".join(parts)

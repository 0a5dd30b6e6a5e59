# SPDX-License-Identifier: LGPL-2.1-or-later
"""Who computes while a part is filled, and the time to be expected of more cores and workers."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

from ..in_process import SHELL
from ..measuring import Context, answer, bench_job, bracket, run
from ..tables import Column, Row, bar, table

#: Of each L in mm (r = L / 10) how many runs, whose fastest counts: long ones vary little.
RUNS, QUICK_RUNS = {10.0: 3, 2.5: 3, 1.6: 1}, {5.0: 1}
#: Workers whose time is measured, and those that it is told for.
MEASURED, TOLD = 2, (4, 8, 16)
#: Above this load, of all cores, other jobs take part in the time, and it is left out.
BUSY = 0.5
#: How much one thread may do alone; by how much the measured time may exceed the expected one.
BAR_ALONE, BAR_EXPECTED = 0.12, 1.2


def measure(context: Context) -> dict[str, Any]:
    """One size after the other."""
    sizes = QUICK_RUNS if context.quick else RUNS
    rows = [_shares(context, size, runs) for size, runs in sizes.items()]
    return {"rows": rows, "bars": _bars(rows)}


def _shares(context: Context, size: float, repeated: int) -> Row:
    row: Row = {"size": size}
    out = context.folder / "shared.stl"
    job = bench_job("shares", str(bracket()), "CVC", f"{size:g}", str(MEASURED), str(out))
    is_idle = os.getloadavg()[0] <= BUSY * (os.cpu_count() or 1)
    runs = [run(job) for _ in range(repeated)]
    failed = next((done.failure for done in runs if done.failure), None)
    if failed:
        return context.say({**row, "note": failed, "failed": True})
    done = min(runs, key=lambda done: done.seconds)
    found = answer(done)
    row |= {**found, "alone": found["first_thread"] / found["all"]}
    row["main_share"] = found["main_process"] / found["all"]
    for count in (MEASURED, *TOLD):
        row[f"with_{count}"] = expected_seconds(found["first_thread"], found["all"], count)
    if is_idle:
        row |= {"seconds": done.seconds, "over": done.seconds / row[f"with_{MEASURED}"]}
    out.unlink()
    return context.say(row)


def expected_seconds(alone: float, every: float, count: int) -> float:
    """What a job takes with so many cores (G. M. Amdahl, 1967).

    Args:
        alone: seconds of a processor that one thread computes by itself.
        every: of all.
        count: of cores, and of workers.
    """
    return alone + (every - alone) / count


def _bars(rows: list[Row]) -> list[Row]:
    bars = []
    for row in rows:
        name = f"bracket, L = {row['size']:g}"
        what = f"{name}: what one thread computes alone, of all"
        bars.append(bar(what, row.get("alone"), BAR_ALONE, "", ".2f"))
        what = f"{name}: {MEASURED} workers' time over the expected one"
        bars.append(bar(what, row.get("over"), BAR_EXPECTED, "", ".2f"))
    return bars


def render(result: dict[str, Any], images: Path) -> str:
    """The table."""
    columns = (
        Column("L", "size", "g"),
        Column("CPU s", "all", ".1f"),
        Column("first thread", "alone", ".0%"),
        Column("main process", "main_share", ".0%"),
        Column(f"{MEASURED}: measured", "seconds", ".1f"),
        *(Column(f"{n}: expected", f"with_{n}", ".1f") for n in (MEASURED, *TOLD)),
    )
    return f"""## What more cores bring

The GE bracket, CVC, r = L / 10, skin of {SHELL:g} mm, with {MEASURED} workers, the fastest of up to {max(RUNS.values())} runs: shares of all processors' seconds, then seconds on so many cores (measured on an idle machine only). By Amdahl's law nobody shares what the main process's first thread computes, and n cores, each with a worker, divide the rest by n.

{table(columns, result["rows"])}
"""

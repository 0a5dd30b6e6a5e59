# SPDX-License-Identifier: LGPL-2.1-or-later
"""A trimmed part of ever more cells: time, memory, workers, a radius field, and level sets beside."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from .. import plots
from ..in_process import SHELL
from ..measuring import (
    OPENVDB,
    Context,
    answer,
    bench_job,
    bracket,
    figures,
    lattice_options,
    our_part,
    run,
    time_is_spent,
)
from ..tables import Column, Row, bar, measured, power_law, table, yes_no

#: L in mm; r = L / 10.
SIZES, QUICK_SIZES = (10.0, 5.0, 3.2, 2.5, 1.6), (10.0, 5.0)
#: Those that the other program does, its voxels L / 15.
PEER_SIZES, SAMPLES = (10.0, 5.0, 3.2), 15
SECONDS_BARS = {3.2: 10.0, 2.5: 18.0, 1.6: 80.0}
MEMORY_BARS = {2.5: 1200.0, 1.6: 1500.0}
BAR_TIME, BAR_MEMORY, BAR_WORKERS, BAR_FIELD = 1.05, 0.7, 1.6, 1.5
#: The law is fitted from so many cells on.
LEAST_CELLS = 3000
#: Seconds of the other program; its offset has a band as wide as the skin to fill.
PEER_LIMIT = 240.0
STEPS = ("solid", "offset", "struts", "CSG", "isosurface", "write")
WORKERS_SIZE, FIELD_SIZE, QUICK_SIZE = 2.5, 3.2, 5.0


def measure(context: Context) -> dict[str, Any]:
    """One size after the other; then one worker beside two, and a radius that varies."""
    rows: list[Row] = []
    for size in QUICK_SIZES if context.quick else SIZES:
        rows.append(_ours(context, size))
        if size in PEER_SIZES:
            rows.append(_level_sets(context, size))
    at = QUICK_SIZE if context.quick else WORKERS_SIZE
    crew = [
        _ours(context, at, "--workers", str(count), what=f"{count} worker" + "s" * (count > 1))
        for count in (1, 2)
    ]
    at = QUICK_SIZE if context.quick else FIELD_SIZE
    radii = ("--radius-start", f"{0.11 * at:g}", "--radius-end", f"{0.09 * at:g}")
    varied = [
        _ours(context, at, *options, what=what)
        for what, options in (
            ("one radius", ()),
            ("radius by depth", ("--radius-grading", "skin", *radii)),
        )
    ]
    bars = _bars(rows, crew, varied)
    return {"rows": rows, "crew": crew, "varied": varied, "bars": bars}


def _ours(context: Context, size: float, *options: str, what: str = "this engine") -> Row:
    given = [*lattice_options(size, 0.1 * size), "--shell", f"{SHELL:g}", *options]
    row = our_part(context, bracket(), "CVC", *given, look=False)
    return context.say({**row, "tool": what, "size": size})


def _level_sets(context: Context, size: float) -> Row:
    row: Row = {"tool": "OpenVDB", "size": size}
    if not OPENVDB.exists():
        note = "left out: libopenvdb-dev is not installed, or bench/openvdb_part.cc did not compile"
        return context.say({**row, "note": note})
    if time_is_spent(context):
        return context.say({**row, "note": "left out: the time for other tools was spent"})
    struts, out = context.folder / "struts.bin", context.folder / "level_sets.stl"
    said = run(bench_job("struts", str(bracket()), "CVC", f"{size:g}", str(struts)))
    if said.failure:
        return context.say({**row, "note": said.failure, "failed": True})
    voxel = f"{size / SAMPLES:g}"
    done = run(
        [str(OPENVDB), str(bracket()), str(struts), voxel, f"{SHELL:g}", str(out)],
        limit=PEER_LIMIT,
    )
    struts.unlink()
    if done.failure:
        out.unlink(missing_ok=True)
        return context.say({**row, "note": done.failure})
    found = answer(done)
    row |= figures(done, out) | {"peak_mb": found["peak_mb"], "stages": found["steps"]}
    row["rest"] = done.seconds - found["steps"]["offset"]
    out.unlink()
    return context.say(row)


def _bars(rows: list[Row], crew: list[Row], varied: list[Row]) -> list[Row]:
    by_job = {(row["tool"], row["size"]): row for row in rows}
    bars = []
    for size, limit in SECONDS_BARS.items():
        row = by_job.get(("this engine", size), {})
        bars.append(bar(f"bracket, CVC, L = {size:g}", row.get("seconds"), limit, "s"))
    for size, limit in MEMORY_BARS.items():
        row = by_job.get(("this engine", size), {})
        bars.append(
            bar(f"bracket, CVC, L = {size:g}, memory", row.get("peak_mb"), limit, "MB", ",.0f")
        )
    for key, what, limit in (("seconds", "time", BAR_TIME), ("peak_mb", "memory", BAR_MEMORY)):
        found = _fitted(rows, key)
        law = (
            power_law([r["cells_active"] for r in found], [r[key] for r in found]).exponent
            if (len(found) > 1)
            else None
        )
        name = f"bracket, exponent of {what} against cells, from {LEAST_CELLS:,} on"
        bars.append(bar(name, law, limit, "", ".2f"))
    for size in PEER_SIZES:
        ours, other = (by_job.get((tool, size), {}) for tool in ("this engine", "OpenVDB"))
        for key, than, what in (("seconds", "rest", "time"), ("peak_mb", "peak_mb", "memory")):
            name = f"bracket, L = {size:g}: {what} over OpenVDB's without its offset"
            bars.append(bar(name, _ratio(ours.get(key), other.get(than)), 1.0, "", ".2f"))
    speed = _ratio(crew[0].get("seconds"), crew[1].get("seconds"))
    bars.append(
        {"text": "bracket, two workers over one", "bar": f"{BAR_WORKERS:g} times as fast",
         "measured": "" if speed is None else f"{speed:.2f} times",
         "met": None if speed is None else speed >= BAR_WORKERS}
    )  # fmt: skip
    over = _ratio(varied[1].get("seconds"), varied[0].get("seconds"))
    bars.append(bar("bracket, radius by depth over one radius", over, BAR_FIELD, "", ".2f"))
    return bars


def _ratio(one: float | None, other: float | None) -> float | None:
    return None if one is None or other is None else one / other


def _fitted(rows: list[Row], key: str) -> list[Row]:
    return [row for row in measured(rows, key, "cells_active") if row["cells_active"] > LEAST_CELLS]


def render(result: dict[str, Any], images: Path) -> str:
    """The tables, the plot and the steps of the other program."""
    rows = result["rows"]
    ours = measured(
        [row for row in rows if row["tool"] == "this engine"], "seconds", "cells_active"
    )
    cells = {row["size"]: row["cells_active"] for row in ours}
    data = [plots.Line("this engine", list(cells.values()), [row["seconds"] for row in ours])]
    other = [row for row in measured(rows, "rest") if row["size"] in cells]
    if other:
        of = [cells[row["size"]] for row in other]
        data.append(plots.Line("OpenVDB", of, [row["seconds"] for row in other]))
        data.append(plots.Line("OpenVDB, without its offset", of, [row["rest"] for row in other]))
    plot = plots.lines(
        images / "trimmed.png", "cells", "seconds to the STL file", data,
        title="A trimmed part",
    )  # fmt: skip
    columns = (
        Column("L", "size", "g"),
        Column("tool", "tool"),
        Column("cells", "cells_active", ","),
        Column("s", "seconds", ".2f"),
        Column("without its offset", "rest", ".2f"),
        Column("CPU s", "cpu", ".2f"),
        Column("peak MB", "peak_mb", ",.0f"),
        Column("triangles", "triangles", ","),
        Column("file, MB", "mb", ",.0f"),
        Column("closed", "watertight", yes_no),
        Column("bodies", "bodies"),
    )
    steps = [
        {"size": row["size"], **row["stages"]}
        for row in rows
        if row["tool"] == "OpenVDB" and row.get("stages")
    ]
    names = [Column("L", "size", "g"), *(Column(step, step, ".2f") for step in STEPS)]
    return f"""## A trimmed part of many cells

The GE bracket, CVC, r = L / 10, skin of {SHELL:g} mm, from the start of the process to the STL; single runs. Peak memory is that of the command; each of its workers takes some hundred MB beside it.

{plot}

{table(columns, rows)}

OpenVDB (`bench/openvdb_part.cc`, of OpenVDB's own tools): level sets with voxels of L / {SAMPLES}, offset, struts by their distance, one isosurface. Its skin and cavity have rounded edges, and pieces that hang on nothing stay. The offset is most of its time; one by a wider band of distances would do with less, so that the harder mark is the rest. Seconds of its steps:

{table(names, steps)}

One worker and two, and radii that vary with the depth:

{table(columns, [*result["crew"], *result["varied"]])}
"""

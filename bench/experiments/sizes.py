# SPDX-License-Identifier: LGPL-2.1-or-later
"""Fig. 12a: the GE bracket with smaller and smaller CVC cells, by stage."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from .. import plots
from ..in_process import SHELL
from ..measuring import Context, bracket, lattice_options, our_part
from ..tables import Column, Row, measured, power_law, table, yes_no

SIZES = (14.0, 10.0, 7.0, 5.0, 4.0, 3.2)
QUICK_SIZES = (10.0, 5.0)
STAGES = ("read", "shell", "voxels", "tile", "lattice", "trim", "write")


def measure(context: Context) -> dict[str, Any]:
    """r = L / 10 throughout."""
    rows: list[Row] = []
    for size in QUICK_SIZES if context.quick else SIZES:
        options = [*lattice_options(size, size / 10), "--shell", f"{SHELL:g}"]
        row = our_part(context, bracket(), "CVC", *options, look=False)
        rows.append(context.say({**row, "size": size}))
    return {"rows": rows, "bars": []}


def render(result: dict[str, Any], images: Path) -> str:
    """The table, the plot, and how stages grow."""
    rows = measured(result["rows"], "stages")
    shown = [{**row, **row["stages"]} for row in rows]
    cells = [row["cells_active"] for row in rows]
    data = [
        plots.Line(stage, cells, [max(row[stage], 1e-4) for row in shown]) for stage in STAGES
    ] + [plots.Line("whole process", cells, [row["seconds"] for row in rows], ".--")]
    plot = plots.lines(
        images / "sizes.png", "active cells", "seconds", data, title="Stages against cells"
    )
    growth = ""
    if len(rows) > 1:
        profile = power_law(cells, [row["seconds"] for row in rows])
        growth = (
            f"Whole process: time grows with the {profile.exponent:.2f}th power of the active cells; "
            "trimming is what grows, with the area that the wall cuts through."
        )
    columns = [
        Column("L, mm", "size", "g"),
        Column("active cells", "cells_active", ","),
        Column("s", "seconds", ".2f"),
        Column("MB", "mb", ".1f"),
        Column("peak MB", "peak_mb", ",.0f"),
        Column("closed", "watertight", yes_no),
        Column("bodies", "bodies"),
    ]
    notes = [row for row in result["rows"] if row.get("note")]
    return f"""## Fig. 12a: cost by stage against cell size

The GE bracket with a skin of {SHELL:g} mm, CVC, r = L / 10, one process each; closedness and bodies by the engine's own report.

{plot}

{table(columns, [*shown, *notes])}

{growth}
"""

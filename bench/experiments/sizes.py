# SPDX-License-Identifier: LGPL-2.1-or-later
"""Fig. 12a: the GE bracket with smaller and smaller CVC cells, by stage."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from .. import plots
from ..in_process import SHELL
from ..measuring import Context, bracket, lattice_options, our_part
from ..tables import Row, measured, power_law

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


def _told(row: Row) -> str:
    """A job in a few words."""
    return (
        f"L = {row['size']:g}, {row['cells_active']:,} cells: {row['seconds']:.2f} s, "
        f"{row['mb']:,.1f} MB of file, {row['peak_mb']:,.0f} of memory"
    )


def render(result: dict[str, Any], images: Path) -> str:
    """The jobs, the plot, and how stages grow."""
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
            f" Time grows with the {profile.exponent:.2f}th power of the active cells; "
            "trimming is what grows, with the area that the wall cuts through."
        )
    notes = "".join(
        f" L = {row['size']:g}: {row['note']}." for row in result["rows"] if row.get("note")
    )
    return f"""## Fig. 12a: cost by stage against cell size

The GE bracket with a skin of {SHELL:g} mm, CVC, r = L / 10, one process each.

{plot}

{"; ".join(map(_told, rows[:1] + rows[1:][-1:]))}.{growth}{notes}
"""

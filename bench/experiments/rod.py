# SPDX-License-Identifier: LGPL-2.1-or-later
"""Table 4: the piston rod with cells graded along it, and other graded lattices."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from ..measuring import Context, bracket, lattice_options, our_block, our_part, rod
from ..published import ROD as PUBLISHED
from ..published import ROD_ACTIVE, ROD_GRID
from ..tables import Column, Row, bar, figures_of, table, yes_no

BAR_SECONDS, FIELD_BAR_SECONDS, BLOCK_BAR_SECONDS = 6.0, 12.0, 5.0
ROD_OPTIONS = (
    "--cell-size", "2", "--strut-radius", "0.2", "--shell", "1",
    "--size-grading", "linear", "--lambda-start", "1", "--lambda-end", "2",
)  # fmt: skip
THICKER = ("--radius-start", "0.6", "--radius-end", "1.4")


def measure(context: Context) -> dict[str, Any]:
    """The rod with each cell; a block and the bracket with radii that vary."""
    rows: list[Row] = []
    bars: list[Row] = []
    for cell in ("CVC",) if context.quick else PUBLISHED:
        row = our_part(context, rod(), cell, *ROD_OPTIONS)
        rows.append(context.say({**row, "job": "piston rod"}))
        bars.append(bar(f"piston rod, {cell}", row.get("seconds"), BAR_SECONDS, "s"))
    if context.quick:
        return {"rows": rows, "bars": bars}
    along = ("--radius-grading", "direction", "--resolution", "15", *THICKER)
    row = our_block(context, "CVC", 10, *along, look=False)
    rows.append(context.say({**row, "job": "block 10 x 10 x 10, r from 0.6 to 1.4 along x"}))
    bars.append(bar("block, radius graded", row.get("seconds"), BLOCK_BAR_SECONDS, "s"))
    field = context.folder / "field.csv"
    write_field(field)
    by_field = ("--radius-grading", "field", "--radius-field", str(field), *THICKER)
    row = our_part(context, bracket(), "CVC", *lattice_options(), "--shell", "3", *by_field)
    rows.append(context.say({**row, "job": "GE bracket, skin 3, r from 0.6 to 1.4 by a field"}))
    bars.append(bar("GE bracket, radius by a field", row.get("seconds"), FIELD_BAR_SECONDS, "s"))
    return {"rows": rows, "bars": bars}


def write_field(path: Path) -> None:
    """A smooth made-up field at 20,000 points in the bracket's box."""
    points = np.random.default_rng(0).uniform((0, 0, 0), (180, 65, 110), (20_000, 3))
    values = 100.0 + 40.0 * np.sin(points[:, 0] / 25.0) * np.cos(points[:, 2] / 30.0)
    rows = np.column_stack([points, values])
    np.savetxt(path, rows, "%.4f", ",", header="x,y,z,value", comments="")


def render(result: dict[str, Any], images: Path) -> str:
    """The table."""
    rows = []
    for row in result["rows"]:
        seconds, mb = PUBLISHED[row["cell"]] if row["job"] == "piston rod" else (None, None)
        name = f"{row['job']}, {row['cell']}"
        paper = f"{seconds:g}, {mb:.1f}" if seconds else None
        rows.append({**row, "name": name, "ours": figures_of(row), "paper": paper})
    grid = " x ".join(str(n) for n in ROD_GRID)
    columns = (
        Column("job", "name"),
        Column("s, MB, peak MB", "ours"),
        Column("closed", "watertight", yes_no),
        Column("bodies", "bodies"),
        Column("paper: s, MB", "paper"),
    )
    active = next((row for row in rows if row.get("cells_active")), {})
    ours = " x ".join(str(n) for n in active.get("grid", ()))
    return f"""## Table 4: the piston rod, graded

Skin of 1 mm, L = 2, r = 0.2, cells growing linearly from 1 to 2 times L along x; struts stay round; box 121 x 28 x 11.6 mm. The paper's grid is {grid} with {ROD_ACTIVE} active cells; our stand-in has {ours} with {active.get("cells_active", "no")}, as Eq. 13 gives. The last rows are other graded lattices, which the paper lacks.

{table(columns, rows)}
"""

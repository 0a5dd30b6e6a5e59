# SPDX-License-Identifier: LGPL-2.1-or-later
"""Fig. 12b: blocks of CVC cells as far as the machine goes; time, memory, bytes, and their law."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any

from .. import plots
from ..measuring import Context, lattice_options, our_block, run, volfrep
from ..published import CELLS_IN_AN_HOUR
from ..tables import Column, PowerLaw, Row, bar, figures_of, measured, power_law, table

#: Cells along an edge, by what is asked of the facets.
SERIES: dict[str, tuple[tuple[str, ...], tuple[int, ...]]] = {
    "L / 8": (("--resolution", "8"), (10, 20, 26, 40, 50)),
    "default, L / 15": ((), (10, 20, 26, 40)),
}
QUICK = {"L / 8": (10, 20, 26), "default, L / 15": (10, 20)}
#: Bytes of a file for each cell, generously.
BYTES_PER_CELL = {"L / 8": 60_000, "default, L / 15": 110_000}
MOST_BEAM_CELLS, QUICK_BEAM_CELLS = 100, 46
BAR_26, BAR_EXPONENT, BAR_MEMORY_MB = 12.0, 1.05, 4096.0
#: Below the first the start of the process is most of the time, from the second on little of it.
LEAST_CELLS_FITTED, LARGE = 1000, 8000


def measure(context: Context) -> dict[str, Any]:
    """Blocks as STL, and one of beams."""
    rows: list[Row] = []
    for setting, (options, counts) in SERIES.items():
        for count in QUICK[setting] if context.quick else counts:
            wanted = count**3 * BYTES_PER_CELL[setting]
            row: Row = {"setting": setting, "cells": count**3}
            free = shutil.disk_usage(context.folder).free
            if free < 1.2 * wanted:
                row["note"] = (
                    f"left out: the file may take {wanted / 1e9:.1f} GB, and "
                    f"{free / 1e9:.1f} GB of disk are free"
                )
            else:
                row |= our_block(context, "CVC", count, *options, look=False)
            rows.append(context.say(row))
    beams = context.say(_beams(context))
    return {"rows": rows, "beams": beams, "bars": _bars(context, rows)}


def _bars(context: Context, rows: list[Row]) -> list[Row]:
    bars = []
    for setting in SERIES:
        for least in (LEAST_CELLS_FITTED, LARGE):
            found = _fitted(rows, setting, least)
            exponent = _law(found).exponent if len(found) > 1 else None
            name = f"exponent of time against CVC cells, {setting}, from {least:,} cells on"
            bars.append(bar(name, exponent, BAR_EXPONENT, "", ".3f"))
    if not context.quick:
        by_job = {(row["setting"], row["cells"]): row for row in rows}
        row = by_job["default, L / 15", 26**3]
        bars.append(bar("block 26 x 26 x 26, CVC, L / 15", row.get("seconds"), BAR_26, "s"))
        row = by_job["L / 8", 50**3]
        bars.append(
            bar("block 50 x 50 x 50, CVC, L / 8, memory", row.get("peak_mb"), BAR_MEMORY_MB, "MB",
                ",.0f")
        )  # fmt: skip
    return bars


def _beams(context: Context) -> Row:
    """The axes and radii alone, as a 3MF beam lattice."""
    count = QUICK_BEAM_CELLS if context.quick else MOST_BEAM_CELLS
    out = context.folder / "beams.3mf"
    command = volfrep(
        "block", "-o", str(out), "--3mf", "beams", "--cell", "CVC", "--count", ",".join([str(count)] * 3),
        *lattice_options(),
    )  # fmt: skip
    done = run(["/usr/bin/env", "time", "-f", "%M", *command] if _has_time() else command)
    row: Row = {"setting": "beams, 3MF", "cells": count**3, "seconds": done.seconds}
    if done.failure:
        return {**row, "note": done.failure, "failed": True}
    if _has_time():
        row["peak_mb"] = int(done.said.splitlines()[-1]) / 1024
    row["mb"] = out.stat().st_size / 1e6
    out.unlink()
    return row


def _table(rows: list[Row]) -> str:
    """A row a number of cells, a column a setting."""
    shown: dict[int, Row] = {}
    for row in rows:
        at = shown.setdefault(row["cells"], {"cells": row["cells"]})
        at[row["setting"]] = row.get("note") or figures_of(row)
    columns = [Column("cells", "cells", ",")]
    columns += [Column(setting.replace(" / ", "/"), setting) for setting in SERIES]
    return table(columns, list(shown.values()))


def _sound(rows: list[Row]) -> str:
    """What the engine reports of the blocks."""
    made = [row for row in rows if row.get("mb") is not None]
    sound = sum(row.get("watertight") is True and row.get("bodies") == 1 for row in made)
    return f"By the engine's own report {sound} of {len(made)} are closed and of one body."


def _beams_told(row: Row) -> str:
    """The block of beams in a sentence."""
    told = f"As beams in a 3MF, {row['cells']:,} cells: "
    if row.get("note"):
        return f"{told}{row['note']}."
    memory = f", {row['peak_mb']:,.0f} MB of memory" if "peak_mb" in row else ""
    return f"{told}{row['seconds']:.2f} s{memory}, a file of {row['mb']:.1f} MB."


def _has_time() -> bool:
    return shutil.which("time") is not None


def _fitted(rows: list[Row], setting: str, least: int) -> list[Row]:
    return [
        row
        for row in measured(rows, "seconds", "triangles")
        if row["setting"] == setting and row["cells"] >= least
    ]


def _law(rows: list[Row]) -> PowerLaw:
    return power_law([row["cells"] for row in rows], [row["seconds"] for row in rows])


def render(result: dict[str, Any], images: Path) -> str:
    """The table, the plot and the law."""
    rows = result["rows"]
    laws, data = [], []
    for setting in SERIES:
        found, large = (_fitted(rows, setting, least) for least in (LEAST_CELLS_FITTED, LARGE))
        cells = [row["cells"] for row in found]
        data.append(plots.Line(setting, cells, [row["seconds"] for row in found]))
        if len(large) < 2:
            continue
        law, whole = _law(large), _law(found)
        minute = law.inverse(60.0)
        beyond = "" if minute <= max(cells) else f" (extrapolated from {max(cells):,})"
        laws.append(
            f"{setting.replace(' / ', '/')} **{law.exponent:.3f}** ({whole.exponent:.3f}), {minute:,.0f} cells in one minute{beyond}"
        )
    data.append(plots.Line("paper: one hour (text)", [CELLS_IN_AN_HOUR], [3600.0], "*"))
    plot = plots.lines(
        images / "scale.png", "cells", "seconds to the STL file", data,
        title="Seconds against cells",
    )  # fmt: skip
    return f"""## Fig. 12b: how far it goes

Blocks of n x n x n CVC cells, L = 10, r = 1; single runs: seconds, MB of the file, MB of memory. {_sound(rows)} The paper extrapolates its replication alone, with a cubic in the cells along an edge, to {CELLS_IN_AN_HOUR:,} cells in one hour.

{plot}

{_table(rows)}

Exponent of time against cells from {LARGE:,} on (from {LEAST_CELLS_FITTED:,}, flattened by the start of the process): {"; ".join(laws) or "not measured"}.

{_beams_told(result["beams"])}
"""

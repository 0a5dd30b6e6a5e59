# SPDX-License-Identifier: LGPL-2.1-or-later
"""Fig. 8: all six cells against the number of cells."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from volfrep.design.cells import PAPERS

from .. import plots
from ..measuring import BENCH_PYTHON, Context, our_block, peer_job
from ..published import BLOCK, COARSE
from ..tables import Column, Row, measured, power_law, table

COUNTS = (2, 4, 6, 8, 10, 15, 20)
QUICK_COUNTS = (2, 6, 10)
#: Shown by the plot only.
PLOTTED = (8, 64, 512)
#: The published method's files grow to gigabytes beyond this.
MOST_OF_PEERS = 10
PEERS = (("published", "published method", COARSE), ("skimage", "one field, scikit-image", 15))


def measure(context: Context) -> dict[str, Any]:
    """Seconds to the file, from the start of the process."""
    counts = QUICK_COUNTS if context.quick else COUNTS
    rows: list[Row] = []
    for cell in PAPERS:
        rows += [context.say(our_block(context, cell, count, look=False)) for count in counts]
    out = context.folder / "peer.stl"
    for tool, name, samples in PEERS:
        for count in (count for count in counts if count <= MOST_OF_PEERS):
            command = [str(BENCH_PYTHON), "-m", "bench.peers", "block", tool, "CVC", str(count)]
            row = peer_job(
                context, name, [*command, str(samples), str(out)], out, cell="CVC", cells=count**3
            )
            out.unlink(missing_ok=True)
            rows.append(context.say(row))
    return {"rows": rows, "bars": []}


def render(result: dict[str, Any], images: Path) -> str:
    """The plot, seconds by cell and number, and how they grow."""
    rows = measured(result["rows"], "seconds")
    series: dict[tuple[str, str], list[Row]] = {}
    for row in rows:
        series.setdefault((row["tool"], row["cell"]), []).append(row)
    data = [
        plots.Line(
            cell if tool == "this engine" else f"{tool}, {cell}",
            [row["cells"] for row in found],
            [row["seconds"] for row in found],
            "o-" if tool == "this engine" else "s--",
        )
        for (tool, cell), found in series.items()
    ]
    data.append(
        plots.Line("paper, Table 1", [1000] * 3, [seconds for seconds, _ in BLOCK.values()], "*")
    )
    plot = plots.lines(
        images / "cells.png", "cells", "seconds to the STL file", data,
        title="Seconds against the number of cells",
    )  # fmt: skip
    counts = sorted({row["cells"] for row in rows})
    shown = []
    for (tool, cell), found in series.items():
        line: Row = {"tool": tool, "cell": cell}
        line |= {str(row["cells"]): row["seconds"] for row in found}
        large = [row for row in found if row["cells"] >= 200]
        if len(large) > 1:
            profile = power_law([row["cells"] for row in large], [row["seconds"] for row in large])
            line["exponent"] = profile.exponent
        shown.append(line)
    columns = [Column("tool", "tool"), Column("cell", "cell")]
    columns += [
        Column(f"{count:,} cells", str(count), ".2f") for count in counts if count not in PLOTTED
    ]
    columns.append(Column("exponent", "exponent", ".2f"))
    notes = "".join(
        f"\n{row['tool']}, {row['cell']}, {row['cells']:,} cells: {row['note']}.\n"
        for row in result["rows"]
        if row.get("note")
    )
    return f"""## Fig. 8: the six cells against the number of cells

Blocks of n x n x n cells, L = 10, r = 1, L / 15 (the published method: {COARSE} points a cell); seconds from the start of the process to the STL on disk, single runs. Exponent: of time against cells, from 216 cells on.

{plot}

{table(columns, shown)}
{notes}"""

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Fig. 8: all six cells against the number of cells."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from volfrep.design.cells import PAPERS

from .. import plots
from ..measuring import BENCH_PYTHON, Context, our_block, peer_job
from ..published import BLOCK, COARSE
from ..tables import Row, measured, power_law

COUNTS = (2, 4, 6, 8, 10, 15, 20)
QUICK_COUNTS = (2, 6, 10)
#: In smaller blocks the start of the process is most of the time.
FITTED_FROM = 216
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
    """The plot, and how seconds grow with the cells."""
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
    notes = "".join(
        f"\n{row['tool']}, {row['cell']}, {row['cells']:,} cells: {row['note']}.\n"
        for row in result["rows"]
        if row.get("note")
    )
    return f"""## Fig. 8: the six cells against the number of cells

Blocks of n x n x n cells, L = 10, r = 1, L/15 (the published method: {COARSE} points), single runs.{_growth(series)}

{plot}
{notes}"""


def _growth(series: dict[tuple[str, str], list[Row]]) -> str:
    """What the largest blocks take, and the exponents of time against cells."""
    told = ""
    ours = {cell: rows for (tool, cell), rows in series.items() if tool == "this engine"}
    last = {cell: max(rows, key=lambda row: row["cells"]) for cell, rows in ours.items()}
    most = max((row["cells"] for row in last.values()), default=0)
    seconds = {cell: row["seconds"] for cell, row in last.items() if row["cells"] == most}
    if seconds:
        least, worst = min(seconds, key=seconds.__getitem__), max(seconds, key=seconds.__getitem__)
        told += f" Of ours {most:,} cells take {seconds[least]:.2f} s ({least}) to {seconds[worst]:.2f} s ({worst})."
    exponents: dict[str, list[float]] = {}
    for (tool, _), rows in series.items():
        large = [row for row in rows if row["cells"] >= FITTED_FROM]
        if len(large) > 1:
            law = power_law([row["cells"] for row in large], [row["seconds"] for row in large])
            exponents.setdefault(tool, []).append(law.exponent)
    if exponents:
        ranges = (
            f"{tool} {min(found):.2f}" + (f" to {max(found):.2f}" if len(found) > 1 else "")
            for tool, found in exponents.items()
        )
        told += f" Exponent of time against cells, from {FITTED_FROM} on: {'; '.join(ranges)}."
    return told

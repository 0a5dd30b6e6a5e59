# SPDX-License-Identifier: LGPL-2.1-or-later
"""Table 3 and Fig. 11: the GE bracket, six cells, by stage, with voxelisation and without."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from volfrep import read_solid
from volfrep.grid.activation import active_cells, make_grid
from volfrep.io.solid import read_triangles
from volfrep.util.progress import Monitor

from .. import plots
from ..in_process import RADII, SHELL
from ..measuring import (
    BENCH_PYTHON,
    Context,
    answer,
    bench_job,
    bracket,
    lattice_options,
    look_at,
    our_part,
    peer_job,
    run,
    volfrep,
)
from ..published import (
    BRACKET as PUBLISHED,
)
from ..published import (
    BRACKET_ACTIVE,
    BRACKET_GRID,
    COARSE,
    POINTS,
    SIZE,
    WITH_VOXELS,
    WITHOUT_VOXELS,
)
from ..tables import Column, Row, bar, figures_of, table, yes_no

COLD_BAR, CHANGE_BAR = 6.0, 4.0
#: The published method's cells and points along a cell, and which voxels it replicates.
QUICK_JOBS = (("CVC", COARSE, "voxels"), ("CVC", COARSE, "all"))
JOBS = (
    *QUICK_JOBS,
    ("CVC", POINTS, "voxels"),
    *((cell, COARSE, "voxels") for cell in PUBLISHED if cell != "CVC"),
    ("CVC", POINTS, "all"),
)
STAGES = ("read", "shell", "voxels", "tile", "lattice", "trim", "write")


def measure(context: Context) -> dict[str, Any]:
    """Each cell from cold and with its radius changed, and the published method."""
    rows: list[Row] = []
    bars: list[Row] = []
    for cell in ("CVC",) if context.quick else PUBLISHED:
        options = [*lattice_options(), "--shell", f"{SHELL:g}"]
        row = our_part(context, bracket(), cell, *options)
        out = context.folder / "changed.stl"
        done = run(bench_job("changes", str(bracket()), cell, str(out)))
        out.unlink(missing_ok=True)
        if done.failure:
            row |= {"note": done.failure, "failed": True}
        else:
            runs = answer(done)["runs"]
            row |= {"changes": runs, "change": max(one["seconds"] for one in runs[1:])}
        rows.append(context.say(row))
        bars.append(bar(f"GE bracket, {cell}, from cold", row.get("seconds"), COLD_BAR, "s"))
        bars.append(bar(f"GE bracket, {cell}, r changed", row.get("change"), CHANGE_BAR, "s"))
        if row.get("looked"):
            sound = row["watertight"] and row["bodies"] == 1
            sound = sound and not row["degenerate"] and not row["pinched"]
            bars.append({"text": f"GE bracket, {cell}, one closed body, no degenerate triangle, "
                         "no pinched vertex", "bar": "yes", "measured": yes_no(sound),
                         "met": sound})  # fmt: skip
    out = context.folder / "whole_box.stl"
    done = run(bench_job("unvoxelised", str(bracket()), "CVC", str(out)))
    unvoxelised: Row = {"tool": "this engine", "cell": "CVC"}
    if done.failure:
        unvoxelised |= {"note": done.failure, "failed": True}
    else:
        unvoxelised |= {"seconds": done.seconds, **answer(done), "mb": out.stat().st_size / 1e6}
        out.unlink()
    context.say(unvoxelised)
    return {
        "rows": rows, "bars": bars, "unvoxelised": unvoxelised, **_published(context),
    }  # fmt: skip


def _published(context: Context) -> dict[str, Any]:
    """The published method on the same part, with the cavity that ours finds."""
    domain = context.folder / "domain.stl"
    done = run(
        volfrep("fill", str(bracket()), "-o", str(domain), "--cell", "CVC", *lattice_options(),
                "--shell", f"{SHELL:g}", "--make", "domain", "--quiet")
    )  # fmt: skip
    if done.failure:
        return {"peers": [{"tool": "published method", "note": done.failure, "failed": True}]}
    counts = {}
    solid, cavity = read_solid(bracket()), read_triangles(domain)
    grid = make_grid(solid.bounds, SIZE)
    for name, mesh in (("part", solid), ("cavity", cavity)):
        for rule in ("centre", "touching"):
            active = active_cells(grid, mesh, rule, Monitor())
            counts[f"{rule}, {name}"] = int(np.count_nonzero(active))
    peers: list[Row] = []
    out = context.folder / "published.stl"
    for cell, points, voxels in QUICK_JOBS if context.quick else JOBS:
        command = [str(BENCH_PYTHON), "-m", "bench.peers", "part", cell, str(points)]
        files = [str(bracket()), str(domain), str(out)]
        row = peer_job(
            context, "published method", [*command, *files, voxels], out, cell=cell,
            points=points, voxels=voxels,
        )  # fmt: skip
        if out.exists():
            row |= look_at(context, out)
            out.unlink()
        peers.append(context.say(row))
    domain.unlink()
    return {"peers": peers, "counts": counts, "grid": list(grid.shape)}


def render(result: dict[str, Any], images: Path) -> str:
    """Table 3, a plot of the stages, and what voxelisation saves."""
    rows = [
        {**row, "ours": figures_of(row), **_beside(row["cell"], result["peers"])}
        for row in result["rows"]
    ]
    columns = (
        Column("cell", "cell"),
        Column("from cold: s, MB, peak MB", "ours"),
        Column("s, r changed", "change", ".2f"),
        Column("closed", "watertight", yes_no),
        Column("bodies", "bodies"),
        Column(f"published method, {COARSE} points: s, MB, peak MB, bodies", "published"),
        Column("paper: s, MB", "paper"),
    )
    stages = [row["stages"] for row in rows if "stages" in row]
    names = [row["cell"] for row in rows if "stages" in row]
    plot = plots.stacks(
        images / "bracket.png", "seconds, from cold", names,
        [{stage: one[stage] for stage in STAGES if stage in one} for one in stages],
        title="GE bracket by stage",
    )  # fmt: skip
    counts = ", ".join(f"{number} ({name})" for name, number in result.get("counts", {}).items())
    grid = " x ".join(str(n) for n in BRACKET_GRID)
    files = [row for row in result["peers"] if row.get("mb") is not None]
    closed = sum(row.get("watertight") is True for row in files)
    return f"""## Table 3: the GE bracket

Skin of {SHELL:g} mm, L = 10, r = 1; from the file of the part to the STL of one body. "r changed": the slower of two later runs (r = {RADII[1]:g}, then {RADII[2]:g}) with the stages' results kept. The paper's times begin with the shell already made; ours make it. The published method on the same part is given our cavity and voxels (their time not included), and its cells are cut and joined by trimesh with manifold3d: {closed} of its {len(files)} files are closed.

Box {_box()}, grid {grid} as in the paper, which counts {BRACKET_ACTIVE} active cells; by our rules there are {counts}, of which the last are filled.

{table(columns, rows)}

{plot}

## Fig. 11: with voxelisation and without

CVC, seconds with voxelisation, then without: every cell of the part's box is meshed and goes through the Boolean. The paper's figures are from its text.

{_without(result)}

In this engine only the octants that the wall crosses go through the Boolean. That, more than what replication costs, is what is lost without voxels.
"""


def _beside(cell: str, peers: list[Row]) -> Row:
    """What the paper prints of a cell, and what its method comes to here."""
    seconds, mb = PUBLISHED[cell]
    row = next((row for row in peers if (row.get("cell"), row.get("points"), row.get("voxels"))
                == (cell, COARSE, "voxels")), {})  # fmt: skip
    forms = (("seconds", ".1f"), ("mb", ".1f"), ("peak_mb", ",.0f"), ("bodies", ""))
    figures = [format(row[key], form) for key, form in forms if row.get(key) is not None]
    return {"paper": f"{seconds:g}, {mb:.1f}", "published": row.get("note") or ", ".join(figures)}


def _box() -> str:
    return "178.54 x 62.50 x 108.31 mm"


def _without(result: dict[str, Any]) -> str:
    """With voxels and without: ours, the published method here, and the paper."""
    ours = next((row for row in result["rows"] if row["cell"] == "CVC"), {})
    shown = [
        _case("this engine", _stages(ours, ("tile", "lattice"), ("trim",)),
              _stages(result["unvoxelised"], ("replication",), ("Boolean",)))
    ]  # fmt: skip
    laid = ("isosurface", "replication", "check")
    peers = [row for row in result["peers"] if row.get("cell") == "CVC"]
    for points in dict.fromkeys(row["points"] for row in peers):
        of = {row["voxels"]: _stages(row, laid, ("Boolean",)) for row in peers
              if row["points"] == points}  # fmt: skip
        name = f"published method, {points} points"
        shown.append(_case(name, of.get("voxels", {}), of.get("all", {})))
    paper = [dict(zip(("seconds", "replication"), row, strict=True))
             for row in (WITH_VOXELS, WITHOUT_VOXELS)]  # fmt: skip
    shown.append(_case("paper", *paper))
    columns = (
        Column("tool", "tool"),
        Column("whole job", "seconds"),
        Column("replication", "replication"),
        Column("Boolean", "boolean"),
    )
    return table(columns, shown)


def _stages(row: Row, laid: tuple[str, ...], cut: tuple[str, ...]) -> Row:
    """Seconds of a job and of its two stages, or why there are none."""
    found: Row = {key: row[key] for key in ("seconds", "note") if row.get(key) is not None}
    if row.get("stages"):
        for key, names in (("replication", laid), ("boolean", cut)):
            found[key] = sum(row["stages"].get(name, 0.0) for name in names)
    return found


def _case(tool: str, kept: Row, bare: Row) -> Row:
    """A row of the table: each figure with voxels, and without."""
    case: Row = {"tool": tool, "note": kept.get("note") or bare.get("note")}
    for key in ("seconds", "replication", "boolean"):
        pair = [format(row[key], ".2f") if key in row else "-" for row in (kept, bare)]
        case[key] = ", ".join(pair) if pair != ["-", "-"] else None
    return case

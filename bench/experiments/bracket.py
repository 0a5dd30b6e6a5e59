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
from ..tables import Column, Row, bar, table, yes_no

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
    rows = [{**row, **_paper(row["cell"])} for row in result["rows"]]
    columns = (
        Column("cell", "cell"),
        Column("s, cold", "seconds", ".2f"),
        Column("s, r changed", "change", ".2f"),
        Column("MB", "mb", ".1f"),
        Column("triangles", "triangles", ","),
        Column("peak MB", "peak_mb", ",.0f"),
        Column("closed", "watertight", yes_no),
        Column("bodies", "bodies"),
        Column("paper: s", "paper_seconds", "g"),
        Column("paper: MB", "paper_mb", ".1f"),
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
    return f"""## Table 3: the GE bracket

Skin of {SHELL:g} mm, L = 10, r = 1; from the file of the part to the STL of one body. "r changed": the slower of two later runs (r = {RADII[1]:g}, then {RADII[2]:g}) with the stages' results kept. The paper's times begin with the shell already made; ours make it.

Our part is a public tessellation of the same bracket, not the paper's file: box {_box()}, grid {grid} as in the paper. The paper counts {BRACKET_ACTIVE} active cells; here the rules give {counts}. Ours fills the cells that touch the cavity.

{table(columns, rows)}

Seconds by stage, from cold:

{plot}

The published method on the same files, with our cavity and voxels (their time not included), cut and joined by trimesh with manifold3d:

{_peers(result["peers"])}

## Fig. 11: with voxelisation and without

Without: every cell of the part's box is meshed and goes through the Boolean. CVC; the paper's figures are from its text.

{_without(result)}

In this engine the lattice inside the wall is not cut at all: only the octants that the wall crosses go through the Boolean. That, more than what replication costs, is what is lost without voxels.
"""


def _paper(cell: str) -> Row:
    seconds, mb = PUBLISHED[cell]
    return {"paper_seconds": seconds, "paper_mb": mb}


def _box() -> str:
    return "178.54 x 62.50 x 108.31 mm"


def _peers(peers: list[Row]) -> str:
    columns = (
        Column("cell", "cell"),
        Column("points", "points"),
        Column("s", "seconds", ".1f"),
        Column("MB", "mb", ".1f"),
        Column("peak MB", "peak_mb", ",.0f"),
        Column("closed", "watertight", yes_no),
        Column("bodies", "bodies"),
        Column("active cells", "cells_active"),
    )
    return table(columns, [row for row in peers if row.get("voxels") != "all"])


def _without(result: dict[str, Any]) -> str:
    ours = next((row for row in result["rows"] if row["cell"] == "CVC"), {})
    peers = {
        (row["points"], row["voxels"]): row for row in result["peers"] if row.get("cell") == "CVC"
    }
    bare = result["unvoxelised"]
    shown = [
        _case("this engine", "yes", ours, ("tile", "lattice"), ("trim",)),
        _case("this engine", "no", bare, ("replication",), ("Boolean",)),
    ]
    for (points, voxels), row in peers.items():
        name = f"published method, {points} points, this run"
        word = yes_no(voxels == "voxels")
        shown.append(_case(name, word, row, ("isosurface", "replication", "check"), ("Boolean",)))
    for (seconds, replication), word in ((WITH_VOXELS, "yes"), (WITHOUT_VOXELS, "no")):
        shown.append(
            {"tool": "paper", "voxels": word, "seconds": seconds, "replication": replication}
        )
    columns = (
        Column("tool", "tool"),
        Column("voxelisation", "voxels"),
        Column("whole job, s", "seconds", ".2f"),
        Column("replication, s", "replication", ".2f"),
        Column("Boolean, s", "boolean", ".2f"),
    )
    return table(columns, shown)


def _case(tool: str, voxels: str, row: Row, laid: tuple[str, ...], cut: tuple[str, ...]) -> Row:
    stages = row.get("stages")
    case = {"tool": tool, "voxels": voxels, "seconds": row.get("seconds"), "note": row.get("note")}
    if stages:
        case["replication"] = sum(stages.get(name, 0.0) for name in laid)
        case["boolean"] = sum(stages.get(name, 0.0) for name in cut)
    return case

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tables 1 and 2: a block of 10 x 10 x 10 cells as STL, its time, size and quality, by tool."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from volfrep.design.cells import LIBRARY
from volfrep.grid.strut_graph import cell_graph
from volfrep.io.freecad_process import freecad_program
from volfrep.util.errors import VolfrepError

from ..measuring import (
    BENCH_PYTHON,
    SURFACE_SAMPLES,
    Context,
    look_at_block,
    our_block,
    peer_job,
    run,
    triangles_in,
)
from ..published import BLOCK, COARSE, POINTS, RADIUS, SIZE, TABLE_1, TABLE_2
from ..tables import Column, Row, bar, figures_of, measured, table, yes_no

COUNT = 10
SMALL = 2
BAR_SECONDS, FINE_BAR_SECONDS = 1.0, 4.0
TIMES = 3

LEFT_OUT = (
    "meshlib and OpenVCAD (receiving them counts as agreement to their licences), open3d and "
    "pymeshlab (no lattices, and the same two ways), PicoGK (a .NET library), and those of which "
    "the paper has figures"
)


def measure(context: Context) -> dict[str, Any]:
    """All cells by all tools, the small block, and what it was promised."""
    rows = [context.say(row) for row in _rows(context)]
    ours = {row["cell"]: row for row in rows if row["kind"] == "ours"}
    bars = []
    for cell in ("CVC",) if context.quick else BLOCK:
        row = ours[cell]
        name = f"block {COUNT} x {COUNT} x {COUNT}, {cell}"
        bars.append(bar(f"{name}, to the file", row.get("seconds"), BAR_SECONDS, "s"))
        bars.append(bar(f"{name}, file no larger than published", row.get("mb"), BLOCK[cell][1],
                        "MB", ".1f"))  # fmt: skip
        error = row.get("volume_error")
        bars.append(bar(f"{name}, error of the volume", error and 100 * abs(error), 0.5, "%"))
        bars.append(bar(f"{name}, RMS to the exact surface", row.get("rms"), 0.03, "mm", ".3f"))
        if row.get("looked"):
            bars.append({"text": f"{name}, one closed solid of the right genus", "bar": "yes",
                         "measured": yes_no(row["one_solid"]),
                         "met": row["one_solid"]})  # fmt: skip
    bars += [
        bar(f"the same, {row['cell']}, at L / 30", row.get("seconds"), FINE_BAR_SECONDS, "s")
        for row in rows
        if row["kind"] == "fine"
    ]
    return {"rows": rows, "bars": bars}


def _rows(context: Context) -> Iterator[Row]:
    cells = ("CVC",) if context.quick else tuple(BLOCK)
    for cell in cells:
        row = our_block(context, cell, COUNT, times=TIMES)
        yield {**row, "kind": "ours", "setting": "default, L / 15"}
    for cell in () if context.quick else cells:
        row = our_block(context, cell, COUNT, "--resolution", "30")
        yield {**row, "kind": "fine", "setting": "L / 30"}
    for cell in cells:
        for points in (COARSE, POINTS):
            setting = f"{points} points"
            yield _peer(context, "published", "published method", cell, points, setting)
    for tool, name in (("skimage", "scikit-image"), ("vtk", "VTK")):
        for cell in cells:
            for samples in (15, 30) if cell == "CVC" and not context.quick else (15,):
                yield _peer(context, tool, name, cell, samples, f"one field, L / {samples}")
    for cell in ("Box",) if context.quick else cells:
        yield _peer(context, "manifold", "manifold3d, CSG", cell, 0, "24-gons")
    if not context.quick:
        yield _peer(context, "microgen", "microgen", "CVC", 0, "0.02 mm")
    yield {**our_block(context, "CVC", SMALL), "kind": "small", "setting": "default, L / 15"}
    if not context.quick:
        yield _peer(context, "gmsh", "gmsh, OpenCASCADE fuse", "CVC", 15, "L / 15", SMALL)
        yield freecad_fuse(context, "CVC", 0.02, context.folder / "fused.stl")


def _peer(
    context: Context, tool: str, name: str, cell: str, samples: int, setting: str,
    count: int = COUNT,
) -> Row:  # fmt: skip
    out = context.folder / "peer.stl"
    command = [str(BENCH_PYTHON), "-m", "bench.peers", "block", tool, cell, str(count)]
    row = peer_job(
        context, name, [*command, str(samples), str(out)], out, cell=cell, cells=count**3,
        setting=setting, kind="small" if count == SMALL else "peer",
    )  # fmt: skip
    if out.exists():
        row |= look_at_block(context, out, cell, count)
        out.unlink()
    return row


def freecad_fuse(context: Context, cell: str, deflection: float, out: Path) -> Row:
    """The small block fused by FreeCAD's Part, as facets in `out` (which stays)."""
    graph = cell_graph(LIBRARY[cell], np.ones((SMALL,) * 3, bool), SIZE, np.zeros(3))
    row: Row = {
        "tool": "FreeCAD Part, fuse", "cell": cell, "cells": SMALL**3, "kind": "small",
        "setting": f"facets within {deflection:g} mm",
    }  # fmt: skip
    try:
        program = freecad_program()
    except VolfrepError:
        return {**row, "note": "left out: there is no freecadcmd on the PATH"}
    job, found = context.folder / "job.json", context.folder / "answer.json"
    values = {
        "nodes": graph.nodes.tolist(), "struts": graph.struts.tolist(), "radius": RADIUS,
        "joint": RADIUS * (1 + RADIUS / SIZE), "deflection": deflection, "out": str(out),
        "answer": str(found),
    }  # fmt: skip
    job.write_text(json.dumps(values), encoding="utf-8")
    script = Path(__file__).resolve().parent.parent / "freecad_fuse.py"
    limit = context.seconds_for_peers
    done = run([program, str(script)], limit=limit, env={"BENCH_JOB": str(job)})
    if done.failure:
        return {**row, "note": done.failure}
    return {
        **row, "seconds": done.seconds, "cpu": done.cpu, "mb": out.stat().st_size / 1e6,
        "triangles": triangles_in(out), **json.loads(found.read_text(encoding="utf-8")),
        **look_at_block(context, out, cell, SMALL),
    }  # fmt: skip


COLUMNS = (
    Column("tool", "name"),
    Column("one right solid", "one_solid", yes_no),
    Column("RMS mm", "rms", ".3f"),
)
SHAPES = (
    "area / max side, mean", "area / max side, deviation", "area deviation, mm2",
    "inradius / circumradius, mean", "inradius / circumradius, deviation",
)  # fmt: skip
#: Of these, what the document has.
SHAPES_SHOWN = (SHAPES[0], SHAPES[2], SHAPES[3])


def render(result: dict[str, Any], images: Path) -> str:
    """Tables 1 and 2."""
    rows = [{**row, "name": _name(row)} for row in result["rows"]]
    large = [row for row in rows if row["kind"] != "small"]
    small = [row for row in rows if row["kind"] == "small"]
    return f"""## Table 1: a block of 10 x 10 x 10 cells

L = 10, r = 1: seconds, MB of the file, MB of memory, and the error of the volume by {SURFACE_SAMPLES:,} points; ours are the median of {TIMES} runs. Very large files are not read back.

{_by_cell(large)}

The published method is written here from the paper's text, in numpy. At the text's {POINTS} points its files are four to eight times as large as the printed ones, at {COARSE} within a factor of two. Its closed cells overlap, which counts twice in its volume.

A fuse by OpenCASCADE is out of reach for a thousand cells; time and error of the volume of {SMALL} x {SMALL} x {SMALL} CVC cells: {"; ".join(map(_small, small))}.

Not measured: {LEFT_OUT}.

## Table 2: the CVC block

"One right solid": closed, one body, no void, the right genus. RMS: of the distances to the exact surface. The others are MeshLab's metrics of triangles: area / max side is 2 x area / longest side squared, inradius / circumradius is doubled; equilateral ones have 0.866 and 1.

{_shapes_table([row for row in large if row["cell"] == "CVC"])}
"""


def _small(row: Row) -> str:
    """A small block in a few words."""
    if row.get("note"):
        return f"{row['name']}: {row['note']}"
    sound = "" if row.get("one_solid") else ", not one right solid"
    return f"{row['name']}: {row['seconds']:.2f} s, {row['volume_error']:+.2%}{sound}"


def _name(row: Row) -> str:
    return f"{row['tool']}, {row['setting'].replace(' / ', '/')}"


def _by_cell(rows: list[Row]) -> str:
    """A row a tool, ours, others' and those that the paper has."""
    shown: dict[str, Row] = {}
    for row in rows:
        at = shown.setdefault(row["name"], {"name": row["name"]})
        error = row.get("volume_error")
        told = figures_of(row) + (f", {error:+.2%}" if error is not None else "")
        at[row["cell"]] = row.get("note") or told
    for tool, found in TABLE_1.items():
        name = f"{tool} (paper)"
        shown[name] = {"name": name, **{c: f"{s:g}, {mb:.1f}" for c, (s, mb) in found.items()}}
    return table([Column("tool", "name"), *(Column(c, c) for c in BLOCK)], list(shown.values()))


def _shapes_table(rows: list[Row]) -> str:
    """Soundness, distance and the shape of triangles, by tool."""
    shown = [
        {**row, **dict(zip(SHAPES, row["shape"], strict=True)), "smallest": row["smallest_angle"]}
        for row in measured(rows, "shape")
    ]  # fmt: skip
    shown += [
        {"name": f"{name} (paper)", **dict(zip(SHAPES, values, strict=True))}
        for name, values in TABLE_2.items()
    ]
    columns = [*COLUMNS, *(Column(name, name, ".3f") for name in SHAPES_SHOWN)]
    return table([*columns, Column("smallest angle", "smallest", ".1f")], shown)

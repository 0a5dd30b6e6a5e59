# SPDX-License-Identifier: LGPL-2.1-or-later
"""Fig. 4: how far 2 x 2 x 2 BCC cells lie from the exact surface, against the resolution."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from volfrep.io.solid import read_triangles
from volfrep.io.write.stl import as_read
from volfrep.mesh.triangle_mesh import TriangleMesh
from volfrep.spatial.proximity import closest_points

from .. import plots
from ..exact import sample_surface
from ..measuring import (
    BENCH_PYTHON,
    SURFACE_SAMPLES,
    Context,
    gaps,
    lattice_options,
    peer_job,
    run,
    volfrep,
)
from ..published import POINTS, RMS
from ..tables import Row, measured
from .blocks import freecad_fuse

CELL, COUNT = "BCC", 2
RESOLUTIONS = (8, 10, 15, 20, 30, 45, 60)
QUICK_RESOLUTIONS = (10, 15, 30)
#: Of the facets that stand for the B-rep, mm.
DEFLECTION = 0.001
#: Distances to a mesh take longer than those to the exact surface.
MESH_SAMPLES = 20_000


def measure(context: Context) -> dict[str, Any]:
    """Each resolution by ours, by the published method, and by one field for the whole."""
    out = context.folder / "brep.stl"
    reference: Row = {"tool": "FreeCAD Part, fuse", "note": "left out of the quick run"}
    if not context.quick:
        reference = context.say(freecad_fuse(context, CELL, DEFLECTION, out))
    brep = as_read(read_triangles(out)) if out.exists() else None
    out.unlink(missing_ok=True)
    rows: list[Row] = []
    for resolution in QUICK_RESOLUTIONS if context.quick else RESOLUTIONS:
        made = context.folder / "cells.stl"
        command = volfrep(
            "block", "-o", str(made), "--cell", CELL, "--count", ",".join([str(COUNT)] * 3),
            *lattice_options(), "--resolution", str(resolution), "--quiet",
        )  # fmt: skip
        done = run(command)
        row: Row = {"tool": "this engine", "resolution": resolution, "seconds": done.seconds}
        if done.failure:
            row |= {"note": done.failure, "failed": True}
        else:
            row |= _distances(made, brep)
        rows.append(context.say(row))
        for tool, name in (("published", "published method"), ("skimage", "one field")):
            command = [str(BENCH_PYTHON), "-m", "bench.peers", "block", tool, CELL, str(COUNT)]
            row = peer_job(
                context, name, [*command, str(resolution), str(made)], made, resolution=resolution
            )
            rows.append(context.say({**row, **(_distances(made, brep) if made.exists() else {})}))
    return {"rows": rows, "reference": reference, "bars": []}


def _distances(path: Path, brep: TriangleMesh | None) -> Row:
    """RMS, deviation and extreme of the distances of points on a file's surface; removes it."""
    mesh = as_read(read_triangles(path))
    path.unlink()
    off = gaps(mesh, CELL, COUNT)
    row: Row = {
        "triangles": len(mesh.triangles),
        "rms": float(np.sqrt((off**2).mean())),
        "mean": float(off.mean()),
        "deviation": float(off.std()),
        "farthest": float(np.abs(off).max()),
    }
    if brep is not None:
        distance = closest_points(brep, sample_surface(mesh, MESH_SAMPLES))[1]
        row["rms_brep"] = float(np.sqrt((distance**2).mean()))
    return row


def _to_brep(result: dict[str, Any]) -> str:
    """The distances that the paper measured: to a B-rep, at its resolution."""
    brep = result["reference"]
    told = measured(result["rows"], "rms_brep")
    found = ", ".join(
        f"{row['tool']} {row['rms_brep']:.4f}" for row in told if row["resolution"] == POINTS
    )
    notes = "".join(
        f" {row['tool']}, {row['resolution']}: {row['note']}."
        for row in result["rows"]
        if row.get("note")
    )
    made = brep.get("note") or (
        f"{brep['triangles']:,} facets within {DEFLECTION} mm, fused in {brep['fuse_seconds']:.0f} s"
    )
    return f"At {POINTS} points the paper has {RMS:g}, to a B-rep; to one of FreeCAD's Part ({made}) by {MESH_SAMPLES:,} points: {found or 'not measured'}.{notes}"


def render(result: dict[str, Any], images: Path) -> str:
    """The plot, and the figure that the paper has."""
    rows = result["rows"]
    tools = dict.fromkeys(row["tool"] for row in rows)
    data = [
        plots.Line(
            f"{tool}, this run",
            [row["resolution"] for row in measured(rows, "rms") if row["tool"] == tool],
            [row["rms"] for row in measured(rows, "rms") if row["tool"] == tool],
        )
        for tool in tools
    ]
    data.append(plots.Line("paper, at 30 points (text)", [POINTS], [RMS], "*"))
    plot = plots.lines(
        images / "accuracy.png", "points or facets along L", "RMS distance, mm", data,
        title="RMS distance against resolution",
    )  # fmt: skip
    return f"""## Fig. 4: deviation against resolution

2 x 2 x 2 BCC cells, L = 10, r = 1: RMS in mm of the distances of {SURFACE_SAMPLES:,} points, spread over each surface, to the exact one.

{plot}
{_to_brep(result)}
"""

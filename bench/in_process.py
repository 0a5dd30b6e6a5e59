# SPDX-License-Identifier: LGPL-2.1-or-later
"""What is measured inside one process of its own; each job prints one line of JSON.

python -m bench.in_process changes PART CELL OUT.stl
python -m bench.in_process unvoxelised PART CELL OUT.stl
python -m bench.in_process profile CELL OUT.stl [PART]
python -m bench.in_process struts PART CELL L OUT.bin
python -m bench.in_process shares PART CELL L WORKERS OUT.stl
"""

from __future__ import annotations

import cProfile
import json
import pstats
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from .published import RADIUS, SIZE

SHELL = 3.0
#: Strut radii that one after the other are asked for; the first is from cold.
RADII = (1.0, 1.1, 0.9)
TOP_FUNCTIONS = 12


def changes(part: str, cell: str, out: str) -> dict[str, Any]:
    """A part filled again and again with another strut radius, the stages' results kept.

    Reading the part is not in it, writing the file is.
    """
    from volfrep import LatticeSpec, StageCache, read_solid
    from volfrep.jobs.pipeline import fill
    from volfrep.output.meshes import write_mesh

    solid, cache = read_solid(part), StageCache()
    runs = []
    for radius in RADII:
        start = time.perf_counter()
        spec = LatticeSpec(cell=cell, cell_size=SIZE, strut_radius=radius, shell=SHELL)
        result = fill(solid, spec, cache=cache)
        written = time.perf_counter()
        write_mesh(result.mesh, out)
        end = time.perf_counter()
        stages = {**result.report.stages, "write": end - written}
        runs.append({"radius": radius, "seconds": end - start, "stages": stages})
    return {"runs": runs}


def struts(part: str, cell: str, size: str, out: str) -> dict[str, Any]:
    """The struts of the active cells for another program: see `openvdb_part.cc`."""
    from volfrep import LatticeSpec, read_solid
    from volfrep.jobs.infill import Infill

    length = float(size)
    spec = LatticeSpec(cell=cell, cell_size=length, strut_radius=0.1 * length, shell=SHELL)
    frame = Infill(read_solid(part), spec).struts
    ends = frame.nodes[frame.struts].reshape(-1, 6)
    radii = [frame.radii.max(axis=1), frame.joint_radii[frame.struts].max(axis=1)]
    np.column_stack([ends, *radii]).astype("<f8").tofile(out)
    return {"struts": len(ends)}


def shares(part: str, cell: str, size: str, workers: str, out: str) -> dict[str, Any]:
    """Who computes while a part is filled, in seconds of a processor.

    Returns:
        Of the first thread, which nobody helps; of this process, with its other threads; of all,
        with the workers. The start of the process is in it.
    """
    import resource

    from volfrep.cli.command import run

    lattice = ["--cell", cell, "--cell-size", size, "--strut-radius", f"{0.1 * float(size):g}"]
    skin = ["--shell", f"{SHELL:g}", "--workers", workers]
    code = run(["fill", part, "-o", out, *lattice, *skin, "--quiet"])
    if code:
        raise RuntimeError(f"the command ended with exit code {code}")
    own, others = (
        used.ru_utime + used.ru_stime
        for used in map(resource.getrusage, (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    )
    return {"first_thread": time.thread_time(), "main_process": own, "all": own + others}


def unvoxelised(part: str, cell: str, out: str) -> dict[str, Any]:
    """The same part without looking for active cells: every cell of its box is meshed and cut.

    The whole box's mesh goes through the Boolean, solid - (cavity - lattice). Nothing is cleaned
    or proved afterwards, which favours this way; nor would the engine write what comes of it, where
    vertices merge in the file.
    """
    import trimesh

    from volfrep import LatticeSpec, read_solid
    from volfrep.grid.activation import make_grid
    from volfrep.grid.placement import NUDGE
    from volfrep.jobs.blocks import block
    from volfrep.jobs.infill import Infill
    from volfrep.mesh.booleans import difference
    from volfrep.mesh.triangle_mesh import TriangleMesh

    stages: dict[str, float] = {}
    start = time.perf_counter()

    def lap(name: str) -> None:
        nonlocal start
        now = time.perf_counter()
        stages[name] = now - start
        start = now

    solid = read_solid(part)
    lap("read")
    grid = make_grid(solid.bounds, SIZE)
    low = tuple(float(x) for x in grid.origin)
    spec = LatticeSpec(cell=cell, cell_size=SIZE, strut_radius=RADIUS, shell=SHELL, origin=low)
    cavity = Infill(solid, spec).cavity
    lap("shell")
    lattice = block(spec, grid.shape).mesh
    lattice = TriangleMesh(lattice.vertices + NUDGE * SIZE, lattice.triangles)
    lap("replication")
    whole = difference(solid, difference(cavity, lattice))
    lap("Boolean")
    trimesh.Trimesh(whole.vertices, whole.triangles, process=False).export(out)
    lap("write")
    return {"stages": stages, "cells": grid.cells, "lattice_triangles": len(lattice.triangles)}


def profile(cell: str, out: str, part: str | None = None) -> dict[str, Any]:
    """The command on a part, or on a block of 10 x 10 x 10 cells where there is none, profiled.

    By the functions' own time, without those that they call.
    """
    report = Path(out).with_suffix(".json")
    job = ["block", "--count", "10,10,10"]
    if part is not None:
        job = ["fill", part, "--shell", f"{SHELL:g}"]
    lattice = ["--cell", cell, "--cell-size", f"{SIZE:g}", "--strut-radius", f"{RADIUS:g}"]
    profiler = cProfile.Profile()
    profiler.enable()
    from volfrep.cli import command as cli  # its imports are part of the command

    code = cli.run([*job, "-o", out, *lattice, "--quiet", "--report", str(report)])
    profiler.disable()
    if code:
        raise RuntimeError(f"the command ended with exit code {code}")
    stages = json.loads(report.read_text(encoding="utf-8"))["stages"]
    report.unlink()
    table: Any = pstats.Stats(profiler)
    entries = sorted(table.stats.items(), key=lambda item: -item[1][2])
    top = [
        {"function": _name(where), "calls": calls, "seconds": own, "with_callees": whole}
        for where, (_, calls, own, whole, _) in entries[:TOP_FUNCTIONS]
    ]
    return {"seconds": table.total_tt, "stages": stages, "functions": top}


def _name(where: tuple[str, int, str]) -> str:
    file, line, function = where
    if file == "~":
        return function.strip("<>")
    path = Path(file)
    package = path.parent.name
    return f"{package}/{path.name}:{line} {function}"


def main() -> None:
    """Do the job that the arguments say."""
    job, *given = sys.argv[1:]
    known = (changes, struts, shares, unvoxelised, profile)
    jobs: dict[str, Callable[..., dict[str, Any]]] = {job.__name__: job for job in known}
    found = jobs[job](*given)
    plain = json.dumps(found, default=lambda value: np.asarray(value).tolist())
    print(plain)


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Exact STEP by a FreeCAD of its own: the engine has no OpenCASCADE and never imports FreeCAD."""

from __future__ import annotations

import json
import os
import shutil
import sys
import tempfile
from pathlib import Path
from typing import Any

import numpy as np

from ..grid.strut_graph import Wireframe
from ..mesh.triangle_mesh import TriangleMesh
from ..util.errors import VolfrepError
from ..util.files import replacing
from ..util.progress import Monitor
from ..util.subprocesses import find_freecad, run_program

# freecadcmd runs a script that raises a second time and then exits with 0: leave by os._exit.
_SCRIPT = """import os, sys, traceback
code = 1
try:
    sys.path[:0] = {front!r}
    sys.path += {back!r}
    from freecad_volfrep.exact_job import run
    run({folder!r})
    code = 0
except BaseException:
    traceback.print_exc()
finally:
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(code)
"""


def freecad_program() -> str:
    """FreeCAD without windows, as `programs.find_freecad` finds it.

    Raises:
        VolfrepError: there is none.
    """
    program = find_freecad()
    if program is not None:
        return program
    raise VolfrepError(
        "Exact STEP is made by FreeCAD, and there is no 'freecadcmd' on the PATH: install FreeCAD, "
        "or use --step faceted."
    )


def write_exact_step(
    lattice: Wireframe,
    path: str | os.PathLike[str],
    expected: float | None,
    *,
    inner: TriangleMesh | None = None,
    outer: TriangleMesh | None = None,
    monitor: Monitor | None = None,
) -> float:
    """Write a lattice with exact surfaces as STEP.

    Args:
        lattice: the struts, mm.
        path: of the file; an old file stays if anything goes wrong.
        expected: volume of the same part as a mesh, mm3; None where the two differ on purpose.
        inner: closed mesh at which the lattice is cut; None for one that is not cut.
        outer: closed mesh around `inner`: what is between them is the skin. None for no skin.
        monitor: asked for a cancel while FreeCAD runs.

    Returns:
        The volume of the solids, mm3.

    Raises:
        VolfrepError: there is no FreeCAD, OpenCASCADE does not manage it, or the path cannot be
            written.
        Cancelled: when the monitor says so; no file is left behind.
    """
    program = freecad_program()
    job: dict[str, Any] = {
        "nodes": lattice.nodes,
        "struts": lattice.struts,
        "radii": lattice.radii,
        "joint_radii": lattice.joint_radii,
        "expected": np.nan if expected is None else expected,
    }
    for name, mesh in (("inner", inner), ("outer", outer)):
        if mesh is not None:
            job[f"{name}_vertices"], job[f"{name}_triangles"] = mesh.vertices, mesh.triangles
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        np.savez(folder / "job.npz", **job)
        answer = _run(program, folder, monitor)
        if "error" in answer:
            raise VolfrepError(answer["error"])
        with replacing(path) as file, (folder / "lattice.step").open("rb") as made:
            shutil.copyfileobj(made, file)
    return float(answer["volume"])


def _run(program: str, folder: Path, monitor: Monitor | None) -> dict[str, Any]:
    """Let FreeCAD do the job in the folder; its answer."""
    engine = Path(__file__).resolve().parents[2]
    checkout = engine.parent
    front = [str(checkout)] if (checkout / "freecad_volfrep").is_dir() else []
    script = folder / "job.py"
    # This process's packages come last: FreeCAD's own numpy and scipy go first.
    script.write_text(
        _SCRIPT.format(front=front, back=[str(engine), *sys.path], folder=str(folder)),
        encoding="utf-8",
    )
    done = run_program([program, str(script)], folder, monitor)
    said = done.stdout
    answer = folder / "answer.json"
    if done.returncode or not answer.is_file():
        lines = [line for line in said.splitlines() if line.strip()]
        reason = lines[-1].strip().rstrip(".") if lines else f"exit code {done.returncode}"
        if "No module named 'freecad_volfrep'" in said:
            reason = "the VOLFREP workbench is not installed in it"
        raise VolfrepError(
            f"FreeCAD did not make the exact STEP ({reason}): use --step faceted, or export from "
            "FreeCAD."
        )
    result: dict[str, Any] = json.loads(answer.read_text(encoding="utf-8"))
    return result

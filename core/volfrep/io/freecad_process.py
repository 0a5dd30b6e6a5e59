# SPDX-License-Identifier: LGPL-2.1-or-later
"""Exact STEP by a FreeCAD of its own: the engine has no OpenCASCADE and never imports FreeCAD."""

from __future__ import annotations

import os
import shutil
import sys
import tempfile
from pathlib import Path

from ..grid.strut_graph import Wireframe
from ..mesh.triangle_mesh import TriangleMesh
from ..process.programs import find_freecad
from ..process.worker import Call, Program, Worker, WorkerLost
from ..util.errors import VolfrepError
from ..util.files import replacing
from ..util.progress import Monitor

#: What FreeCAD does: the engine never imports the workbench.
_JOB = "freecad_volfrep.exact_job:run"
_PRELUDE = "from freecad_volfrep.engine import require_engine; require_engine()"


def freecad_program() -> str:
    """FreeCAD without windows.

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
    worker = Worker(_freecad(freecad_program()))
    arrays = {
        "nodes": lattice.nodes,
        "struts": lattice.struts,
        "radii": lattice.radii,
        "joint_radii": lattice.joint_radii,
    }
    for name, mesh in (("inner", inner), ("outer", outer)):
        if mesh is not None:
            arrays[f"{name}_vertices"] = mesh.vertices
            arrays[f"{name}_triangles"] = mesh.triangles
    try:
        with replacing(path) as file, tempfile.TemporaryDirectory() as folder:
            made = Path(folder) / "lattice.step"
            call = Call(_JOB, (arrays, expected, str(made)), has_progress=False)
            volume = worker.answer(call, ask=None if monitor is None else monitor.tick)
            with made.open("rb") as written:
                shutil.copyfileobj(written, file)
    except WorkerLost as lost:
        reason = lost.ending.last_words or lost.ending.how
        if "No module named 'freecad_volfrep'" in reason:
            reason = "the VOLFREP workbench is not installed in it"
        raise VolfrepError(
            f"FreeCAD did not make the exact STEP ({reason}): use --step faceted, or export from "
            "FreeCAD."
        ) from lost
    finally:
        worker.end()
    return float(volume)


def _freecad(program: str) -> Program:
    """FreeCAD with the workbench; its own numpy and scipy go before this process's."""
    engine = Path(__file__).resolve().parents[2]
    checkout = engine.parent
    front = (str(checkout),) if (checkout / "freecad_volfrep").is_dir() else ()
    return Program((program,), front, (str(engine), *sys.path), _PRELUDE)

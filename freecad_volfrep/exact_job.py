# SPDX-License-Identifier: LGPL-2.1-or-later
"""One exact STEP file for the `volfrep` command, which has no OpenCASCADE of its own.

The command leaves `job.npz` in a folder and starts `freecadcmd`, which calls `run`; the answer is
`lattice.step` and `answer.json` in the same folder (see `volfrep.io.freecad_process`).
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np

from .engine import require_engine


def run(folder: str | Path) -> None:
    """Do the job in that folder."""
    place = Path(folder)
    (place / "answer.json").write_text(json.dumps(_answer(place)), encoding="utf-8")


def _answer(place: Path) -> dict[str, Any]:
    """The volume written, or a sentence that says why there is none."""
    from volfrep.util.errors import VolfrepError

    try:
        require_engine()
        return {"volume": _write(place)}
    except VolfrepError as error:
        return {"error": str(error)}


def _write(place: Path) -> float:
    from volfrep.grid.strut_graph import Wireframe
    from volfrep.mesh.triangle_mesh import TriangleMesh

    from .bridge.exact import write_exact
    from .bridge.trimmed import check_volume, exact_part, plane_wall, write_shape

    with np.load(place / "job.npz") as job:
        lattice = Wireframe(job["nodes"], job["struts"], job["radii"], job["joint_radii"])
        meshes = {
            name: TriangleMesh(job[f"{name}_vertices"], job[f"{name}_triangles"])
            for name in ("inner", "outer")
            if f"{name}_vertices" in job
        }
        expected = None if np.isnan(job["expected"]) else float(job["expected"])
    target = place / "lattice.step"
    if "inner" not in meshes:
        volume = write_exact(lattice, target)
        if expected is not None:
            check_volume(volume, expected)
        return volume
    outer = plane_wall(meshes["outer"]) if "outer" in meshes else None
    part = exact_part(lattice, plane_wall(meshes["inner"]), outer, expected)
    write_shape(part, target)
    return float(part.Volume)

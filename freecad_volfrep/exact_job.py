# SPDX-License-Identifier: LGPL-2.1-or-later
"""One exact STEP file for the `volfrep` command, which has no OpenCASCADE of its own.

The command starts `freecadcmd`, which calls `run` (see `volfrep.io.freecad_process`).
"""

from __future__ import annotations

from typing import Any

from volfrep.grid.strut_graph import Wireframe
from volfrep.mesh.triangle_mesh import TriangleMesh

from .bridge.exact import write_exact
from .bridge.trimmed import check_volume, exact_part, faceted_shape, write_shape


def run(arrays: dict[str, Any], expected: float | None, target: str) -> float:
    """Write a lattice as STEP.

    Args:
        arrays: nodes, struts, radii and joint radii; vertices and triangles of the inner and the
            outer wall where it has them.
        expected: its volume, mm3; None for whatever it is.
        target: path of the file.

    Returns:
        The volume written, mm3.

    Raises:
        VolfrepError: OpenCASCADE does not manage it.
    """
    lattice = Wireframe(*(arrays[name] for name in ("nodes", "struts", "radii", "joint_radii")))
    meshes = {
        name: TriangleMesh(arrays[f"{name}_vertices"], arrays[f"{name}_triangles"])
        for name in ("inner", "outer")
        if f"{name}_vertices" in arrays
    }
    if "inner" not in meshes:
        volume = write_exact(lattice, target)
        if expected is not None:
            check_volume(volume, expected)
        return volume
    outer = faceted_shape(meshes["outer"]) if "outer" in meshes else None
    part = exact_part(lattice, faceted_shape(meshes["inner"]), outer, expected)
    write_shape(part, target)
    return float(part.Volume)

# SPDX-License-Identifier: LGPL-2.1-or-later
"""OFF and GLB by trimesh: for other programs' readers, and for viewers in a browser."""

from __future__ import annotations

import os
from typing import cast

import numpy as np
from numpy.typing import NDArray

from ...mesh.precision import refuse_lost_corners, single_precision
from ...mesh.triangle_mesh import TriangleMesh
from ...util.files import replacing
from ...util.linalg import times
from ...util.progress import Monitor
from ..read.exchange import TO_Z_UP

#: Metres in a millimetre.
METRE = 1e-3


def write_off(
    mesh: TriangleMesh, path: str | os.PathLike[str], monitor: Monitor | None = None
) -> None:
    """Write an OFF file, beside the target and then renamed.

    Args:
        mesh: in mm.
        path: of the file; an old file stays if anything goes wrong.
        monitor: asked for a cancel.

    Raises:
        VolfrepError: the mesh is empty, holds coordinates that float32 cannot, or has triangles
            that lose a corner in float32; or the path cannot be written.
        Cancelled: when the monitor says so; no file is left behind.
    """
    vertices = single_precision(mesh, path)
    _write(vertices.astype(np.float64), mesh.triangles, path, "off", monitor)


def write_glb(
    mesh: TriangleMesh, path: str | os.PathLike[str], monitor: Monitor | None = None
) -> None:
    """Write a GLB file, in metres and with y up as glTF has it, beside the target; see `write_off`.

    Args:
        mesh: in mm, z up.
        path: of the file; an old file stays if anything goes wrong.
        monitor: asked for a cancel.

    Raises:
        VolfrepError: as `write_off`.
        Cancelled: when the monitor says so; no file is left behind.
    """
    single_precision(mesh, path)
    _write(METRE * times(mesh.vertices, TO_Z_UP.T), mesh.triangles, path, "glb", monitor)


def _write(
    vertices: NDArray[np.float64],
    triangles: NDArray[np.int32],
    path: str | os.PathLike[str],
    kind: str,
    monitor: Monitor | None,
) -> None:
    import trimesh  # slow to import

    refuse_lost_corners(vertices.astype(np.float32), triangles, path)
    made = trimesh.Trimesh(vertices, triangles, process=False).export(file_type=kind)
    data = cast("str | bytes", made)
    if monitor is not None:
        monitor.tick(0.9)
    with replacing(path) as file:
        file.write(data.encode("ascii") if isinstance(data, str) else data)
    if monitor is not None:
        monitor.tick(1.0)

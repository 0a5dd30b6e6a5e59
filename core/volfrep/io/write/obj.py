# SPDX-License-Identifier: LGPL-2.1-or-later
"""Wavefront OBJ: plain text that nearly every modeller reads."""

from __future__ import annotations

import os
from itertools import chain

import numpy as np

from ...mesh.precision import BLOCK_ROWS, as_text, lines
from ...mesh.triangle_mesh import TriangleMesh
from ...util.files import replacing
from ...util.progress import Monitor


def write_obj(
    mesh: TriangleMesh, path: str | os.PathLike[str], monitor: Monitor | None = None
) -> None:
    """Write an OBJ file, beside the target and then renamed.

    Arguments and errors as of `stl.write_stl`.
    """
    vertices = lines("v %.9g %.9g %.9g\n", as_text(mesh, path))
    faces = lines("f %d %d %d\n", mesh.triangles + np.int32(1))
    rows = len(mesh.vertices) + len(mesh.triangles)
    with replacing(path) as file:
        for count, chunk in enumerate(chain([b"# mm\n"], vertices, faces)):
            file.write(chunk)
            if monitor is not None:
                monitor.tick(count * BLOCK_ROWS / rows)

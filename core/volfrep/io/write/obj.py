# SPDX-License-Identifier: LGPL-2.1-or-later
"""Wavefront OBJ: plain text that nearly every modeller reads."""

from __future__ import annotations

import os
from itertools import chain

import numpy as np

from ...mesh.precision import BLOCK_ROWS, lines
from ...mesh.triangle_mesh import TriangleMesh
from ...trim.trimmed_surface import TrimmedSurface
from ...util.files import replacing
from ...util.progress import Monitor
from .numbered import number_vertices


def write_obj(
    surface: TriangleMesh | TrimmedSurface,
    path: str | os.PathLike[str],
    monitor: Monitor | None = None,
) -> None:
    """Write an OBJ file, beside the target and then renamed.

    Arguments and errors as of `stl.write_stl`; of a surface, octants beside its mesh are written
    as they are placed.
    """
    given = number_vertices(surface, path, as_text=True)
    vertices = lines("v %.9g %.9g %.9g\n", given.decimals())
    faces = lines("f %d %d %d\n", (block + np.int32(1) for block in given.corners()))
    rows = given.vertices + given.triangles
    with replacing(path) as file:
        for count, chunk in enumerate(chain([b"# mm\n"], vertices, faces)):
            file.write(chunk)
            if monitor is not None:
                monitor.tick(count * BLOCK_ROWS / rows)

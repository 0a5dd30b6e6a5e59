# SPDX-License-Identifier: LGPL-2.1-or-later
"""The struts' axes as STEP curves: points that struts share, and a line from one to the other."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np

from ...grid.strut_graph import Wireframe
from ...util.errors import VolfrepError
from ...util.files import replacing
from ...util.text_rows import rows
from .step import CLOSING, CONTEXT, FIRST_FREE, PLACEMENT, POINT, opening, product, references

#: Bytes and seconds of a file, per strut; measured on lattices of 5,000 to 500,000 struts.
BYTES_PER_STRUT = 60
SECONDS_PER_STRUT = 4e-6


def write_step_wireframe(wireframe: Wireframe, path: str | os.PathLike[str]) -> None:
    """Write the struts' axes as STEP (AP214), one line a strut.

    Args:
        wireframe: in mm; its radii are not written.
        path: of the file; an old file stays if anything goes wrong.

    Raises:
        VolfrepError: there are no struts, or the path cannot be written.
    """
    count = len(wireframe.struts)
    if not count:
        raise VolfrepError(f"There is nothing to write to '{path}': the lattice has no struts.")
    name = Path(path).stem
    point = FIRST_FREE + np.arange(len(wireframe.nodes))
    line = point[-1] + 1 + np.arange(count)
    curves, representation = int(line[-1]) + 1, int(line[-1]) + 2
    with replacing(path) as file:
        file.write(opening(name, "axes of struts").encode("ascii"))
        for piece in rows(f"#%d=CARTESIAN_POINT('',{POINT});\n", point, wireframe.nodes):
            file.write(piece)
        for piece in rows("#%d=POLYLINE('',(#%d,#%d));\n", line, point[wireframe.struts]):
            file.write(piece)
        text = (
            f"#{curves}=GEOMETRIC_CURVE_SET('',({references(line)}));\n"
            f"#{representation}=GEOMETRICALLY_BOUNDED_WIREFRAME_SHAPE_REPRESENTATION('',"
            f"(#{PLACEMENT},#{curves}),#{CONTEXT});\n"
        )
        file.write((text + product(representation + 1, name, representation) + CLOSING).encode())


def predict_wireframe(struts: int) -> tuple[float, float]:
    """Seconds and megabytes of the file of so many struts."""
    return SECONDS_PER_STRUT * struts, 1e-6 * BYTES_PER_STRUT * struts

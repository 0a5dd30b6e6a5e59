# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a script's author needs: `fill` a part, make a `block`, mesh a graph, look at it, save it.

>>> import trimesh, volfrep
>>> part = volfrep.fill(
...     trimesh.creation.box((30, 20, 20)), cell="CVC", cell_size=10, strut_radius=1, shell=2
... )
>>> part.report.watertight, part.report.bodies
(True, 1)
>>> bool(0.3 < part.mesh.volume / (30 * 20 * 20) < 0.7)
True
"""

from .calls import (
    as_solid,
    bare_surface,
    block,
    coupons,
    fill,
    homogenise,
    mesh_network,
    orient,
    size,
    slice_layers,
    slicer_infill,
    solve,
)
from .part import Part
from .wanted_spec import accepted, specified

__all__ = [
    "Part",
    "accepted",
    "as_solid",
    "bare_surface",
    "block",
    "coupons",
    "fill",
    "homogenise",
    "mesh_network",
    "orient",
    "size",
    "slice_layers",
    "slicer_infill",
    "solve",
    "specified",
]

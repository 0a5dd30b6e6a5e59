# SPDX-License-Identifier: LGPL-2.1-or-later
"""How thick a solid is below places of its surface: the largest balls that touch it there.

Each ball shrinks until it meets no other side (J. Ma, S. W. Bae & S. Choi, "3D medial axis point
approximation using nearest neighbors and the normal field", The Visual Computer 28, 2012).
"""

from __future__ import annotations

import numpy as np

from ..mesh import remesh
from ..mesh.triangle_mesh import TriangleMesh
from ..util.types import Floats
from .proximity import closest_points

#: A ball may reach out of the solid by this part of its radius, as it does between the facets of
#: what is round.
_OUT = 0.05
#: Steps in which a ball shrinks; most need three.
_SHRINKS = 20


def wall_thickness(solid: TriangleMesh, places: Floats) -> Floats:
    """(n,) mm, diameters of balls within a solid that touch it nearest to places (n, 3).

    Places on an edge have the ball of one of its faces.

    Args:
        solid: closed mesh, facing outwards, mm.
        places: near its surface, mm.
    """
    foot, _, triangle = closest_points(solid, places)
    normal = remesh.unit_normals(solid.vertices[solid.triangles[triangle]])
    radius = np.full(len(places), 0.5 * float(np.linalg.norm(np.ptp(solid.bounds, axis=0))))
    for _ in range(_SHRINKS):
        middle = foot - radius[:, None] * normal
        near, away, other = closest_points(solid, middle)
        way = foot - near
        along = np.einsum("ni,ni->n", way, normal)
        facing = remesh.normals(solid.vertices[solid.triangles[other]])
        beyond = np.einsum("ni,ni->n", middle - near, facing) > 0.0
        meets = beyond | (away < radius * (1.0 - _OUT))
        meets &= (away < radius * (1.0 - 1e-9)) & (along > 1e-9 * radius)
        if not meets.any():
            break
        square = np.einsum("ni,ni->n", way, way)
        radius[meets] = 0.5 * square[meets] / along[meets]
    return 2.0 * radius

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Which triangles of a filled part are its outside, its skin's inner wall, and its lattice.

A mesh does not say what a triangle was made of, and a mesh that was read from a file never will.
But depth tells: the outside lies at no depth below the solid's surface, the inner wall at the
skin's thickness, and only the lattice lies deeper. Where faces are open, depth counts from the
others, as it does for the wall itself.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..design.openings import open_triangles
from ..design.spec import LatticeSpec
from ..mesh.triangle_mesh import TriangleMesh
from ..spatial.proximity import SurfaceIndex, index_surface
from ..util.threads import threads
from ..util.types import Floats

Kinds = NDArray[np.uint8]

#: What a triangle may be.
OUTSIDE, WALL, LATTICE = 0, 1, 2
#: A corner lies on the wall up to this depth, in thicknesses of the skin; on the outside up to
#: that one.
WALL_DEPTH, OUTSIDE_DEPTH = 1.01, 0.25
#: The surface is sampled this often along the diagonal of the part's box, and with no more points.
SAMPLES_ALONG = 150.0
MOST_SAMPLES = 2_000_000
#: Points that one vectorised step takes at a time.
POINTS_PER_STEP = 100_000


def kinds_of_triangles(mesh: TriangleMesh, solid: TriangleMesh, spec: LatticeSpec) -> Kinds:
    """(t,) uint8: `OUTSIDE`, `WALL` or `LATTICE` for each triangle of what `fill` made.

    A triangle is what its deepest corner is, so that a strut's root is lattice to its end. The
    sides of drain holes are wall. Without a skin all is lattice.

    Args:
        mesh: the result, mm.
        solid: checked closed mesh that was filled, mm.
        spec: what was made of it.
    """
    if spec.output == "domain":
        return np.full(len(mesh.triangles), OUTSIDE, np.uint8)
    if spec.output == "lattice" or spec.shell == 0:
        return np.full(len(mesh.triangles), LATTICE, np.uint8)
    diagonal = float(np.linalg.norm(np.ptp(solid.bounds, axis=0)))
    spacing = max(min(diagonal / SAMPLES_ALONG, spec.shell), np.sqrt(solid.area / MOST_SAMPLES))
    surface = index_surface(solid, spacing)
    most = WALL_DEPTH * spec.shell
    below_all = _depth(surface, mesh.vertices, most)
    below_skin = below_all
    if spec.open_faces:
        skinned = surface.without(open_triangles(solid, spec.open_faces))
        below_skin = _depth(skinned, mesh.vertices, most)
    corners = mesh.triangles
    deepest = below_skin[corners].max(axis=1)
    kinds = np.full(len(corners), LATTICE, np.uint8)
    kinds[deepest <= most] = WALL
    outermost = below_all[corners].max(axis=1) <= OUTSIDE_DEPTH * spec.shell
    # Where struts end in an open face, triangles reach from their ends into the skin's rim.
    kinds[outermost & (below_skin[corners].mean(axis=1) <= most)] = OUTSIDE
    return kinds


def _depth(surface: SurfaceIndex, points: Floats, most: float) -> Floats:
    """(n,) distances of (n, 3) points to the surface, mm; infinite for most that are farther off.

    Most points of a lattice are: to see that they have no sample within reach takes little time.
    """
    reach = most + 0.75 * surface.spacing
    depth = np.full(len(points), np.inf)
    for first in range(0, len(points), POINTS_PER_STEP):
        step = points[first : first + POINTS_PER_STEP]
        found = surface.tree.query(step, distance_upper_bound=reach, workers=threads())[0]
        within = np.flatnonzero(np.isfinite(found))
        depth[first + within] = surface.near(step[within])[1]
    return depth

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

from ..design.spec import LatticeSpec
from ..design.spec_parts import Skin
from ..mesh.triangle_mesh import TriangleMesh
from ..spatial.proximity import SurfaceIndex, closest_points, index_surface
from ..util.threads import threads
from ..util.types import Floats

Kinds = NDArray[np.uint8]

#: What a triangle may be.
OUTSIDE, WALL, LATTICE = 0, 1, 2
#: A corner lies on the wall up to this depth, in thicknesses of the skin; on the outside up to
#: that one.
WALL_DEPTH, OUTSIDE_DEPTH = 1.01, 0.25
#: The same where the thickness follows a field, which the wall keeps less closely.
FIELD_DEPTH = 1.05
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
    beyond, thinnest = _beyond_skin(surface, mesh.vertices, solid, spec.skin)
    corners = mesh.triangles
    kinds = np.full(len(corners), LATTICE, np.uint8)
    kinds[beyond[corners].max(axis=1) <= 0.0] = WALL
    most = OUTSIDE_DEPTH * thinnest
    outermost = _depth(surface, mesh.vertices, most)[corners].max(axis=1) <= most
    # Where struts end in an open face, triangles reach from their ends into the skin's rim.
    kinds[outermost & (beyond[corners].mean(axis=1) <= 0.0)] = OUTSIDE
    return kinds


def _beyond_skin(
    surface: SurfaceIndex, points: Floats, solid: TriangleMesh, skin: Skin | None
) -> tuple[Floats, float]:
    """(n,) how far beyond the skin's wall (n, 3) points lie, mm, and its least thickness.

    Infinite for most that are farther off.
    """
    assert skin is not None, "without a skin all is lattice"
    lengths = skin.thicknesses(solid)
    groups = [(lengths.usual, skin.thickness)] if lengths.usual.any() else []
    groups += lengths.others
    beyond = np.full(len(points), np.inf)
    for faces, length in groups:
        index = surface if faces.all() else surface.without(~faces)
        most = WALL_DEPTH * length
        if skin.field is None or faces is not lengths.usual:
            beyond = np.minimum(beyond, _depth(index, points, most) - most)
            continue
        depth = _depth(index, points, FIELD_DEPTH * skin.deepest)
        near = np.flatnonzero(np.isfinite(depth))
        there = FIELD_DEPTH * np.maximum(length, skin.field(points[near]))
        beyond[near] = depth[near] - there
    for body in skin.bodies:
        low, high = body.bounds
        reach = (WALL_DEPTH - 1.0) * skin.thickness
        inside = ((points > low - reach) & (points < high + reach)).all(axis=1)
        near = np.flatnonzero(inside & (beyond > 0.0))
        if len(near):
            beyond[near] = np.minimum(beyond[near], closest_points(body, points[near])[1] - reach)
    return beyond, min(length for _, length in groups)


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

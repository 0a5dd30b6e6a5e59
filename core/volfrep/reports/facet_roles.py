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
from ..mesh.topology import corners_among
from ..mesh.triangle_mesh import TriangleMesh
from ..spatial.proximity import PointCubes, SurfaceIndex, closest_points, index_surface
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
    depths = _Depths(mesh.vertices)
    beyond, thinnest = _beyond_skin(surface, depths, solid, spec.skin)
    corners = mesh.triangles
    kinds = np.full(len(corners), LATTICE, np.uint8)
    kinds[corners_among(beyond <= 0.0, corners) == 3] = WALL
    most = OUTSIDE_DEPTH * thinnest
    outer = depths.below(surface, most) <= most
    outermost = np.flatnonzero(corners_among(outer, corners) == 3)
    # Where struts end in an open face, triangles reach from their ends into the skin's rim.
    kinds[outermost[beyond[corners[outermost]].mean(axis=1) <= 0.0]] = OUTSIDE
    return kinds


def _beyond_skin(
    surface: SurfaceIndex, depths: _Depths, solid: TriangleMesh, skin: Skin | None
) -> tuple[Floats, float]:
    """(n,) how far beyond the skin's wall points lie, mm, and its least thickness.

    Infinite for most that are farther off.
    """
    assert skin is not None, "without a skin all is lattice"
    lengths = skin.thicknesses(solid)
    groups = [(lengths.usual, skin.thickness)] if lengths.usual.any() else []
    groups += lengths.others
    points = depths.points
    beyond = np.full(len(points), np.inf)
    for faces, length in groups:
        index = surface if faces.all() else surface.without(~faces)
        most = WALL_DEPTH * length
        if skin.field is None or faces is not lengths.usual:
            beyond = np.minimum(beyond, depths.below(index, most) - most)
            continue
        depth = depths.below(index, FIELD_DEPTH * skin.deepest)
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


class _Depths:
    """How deep points lie below surfaces.

    Most points of a lattice are too deep to count: whole cubes of them are told so at once.

    Args:
        points: (n, 3) mm.
    """

    def __init__(self, points: Floats) -> None:
        self.points = points
        self._cubes = PointCubes(points)
        self._known: tuple[SurfaceIndex, float, Floats] | None = None

    def below(self, surface: SurfaceIndex, most: float) -> Floats:
        """(n,) distances to a surface, mm; infinite for most points that are farther off."""
        if self._known is not None and self._known[0] is surface and most <= self._known[1]:
            return self._known[2]
        reach = most + 0.75 * surface.spacing
        far = reach + self._cubes.half_diagonal
        near, _ = surface.tree.query(
            self._cubes.middles, distance_upper_bound=far, workers=threads()
        )
        rows = self._cubes.points_in(np.isfinite(near))
        depth = np.full(len(self.points), np.inf)
        depth[rows] = surface.distances_within(self.points[rows], reach)
        self._known = surface, most, depth
        return depth

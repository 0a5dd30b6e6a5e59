# SPDX-License-Identifier: LGPL-2.1-or-later
"""Large facets divided where small ones are near, so that tetrahedra between them are not flat.

The side of a box may be two facets as long as the box, a skin's thickness away from the thousand
small ones of its lattice. A mesher that keeps both can only join them by needles and slivers, and
takes most of its time over these. Dividing facets moves no surface. The size that is wanted at a
place grows from that of the facets about it by a fixed gradient: P.-O. Persson, Mesh size functions
for implicit geometries and PDE-based gradient limiting, Engineering with Computers 22, 2006. Facets
are divided at their longest edge (M. C. Rivara, Int. J. Numer. Meth. Engng. 40, 1997), which makes
no needles of good ones.
"""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from ..mesh import remesh
from ..mesh.topology import edge_keys
from ..mesh.triangle_mesh import TriangleMesh
from ..util.types import Floats, Ints

#: The size of facets may grow by this much for each mm away from smaller ones.
GRADIENT = 1.0
#: Facets are divided where an edge is so many times as long as the size that is wanted there.
LONGEST = 1.5
#: Facets with no edge longer than so many median edges stay as they are.
USUAL = 2.0
#: Each round halves edges: after so many a facet would be a millionth of what it was.
ROUNDS = 40
#: Facets that have to be divided before a longest edge is the longest of both its facets.
PATH = 50


def grade_facets(mesh: TriangleMesh) -> TriangleMesh:
    """The same surface, its facets no larger than those near them in space allow.

    Args:
        mesh: closed, every edge of two facets; mm. Vertices keep their rows, new ones follow.
    """
    points, triangles = mesh.vertices, mesh.triangles.astype(np.int64)
    if not len(triangles):
        return mesh
    length = np.stack(remesh.side_lengths(points[triangles]), axis=1)
    least = USUAL * float(np.median(length))
    wanted = _WantedSize(points[triangles].mean(axis=1), length.mean(axis=1))
    for _ in range(ROUNDS):
        name, longest, middle = _longest_edges(points, triangles)
        large = np.flatnonzero(longest > least)
        large = large[longest[large] > LONGEST * wanted.at(middle[large])]
        if not len(large):
            break
        points, triangles = remesh.halve(points, triangles, name, large, PATH)
    return TriangleMesh(points, triangles.astype(np.int32))


class _WantedSize:
    """The least of the facets' sizes, each grown by the distance from its centre."""

    def __init__(self, centres: Floats, sizes: Floats) -> None:
        # Of facets of nearly one size the nearest decides: a tree for each octave.
        octave = np.floor(np.log2(np.maximum(sizes, 1e-300)))
        groups = [np.flatnonzero(octave == one) for one in np.unique(octave)]
        self._trees = [(cKDTree(centres[own]), sizes[own]) for own in groups]

    def at(self, points: Floats) -> Floats:
        """(n,) mm at points (n, 3)."""
        result = np.full(len(points), np.inf)
        for tree, sizes in self._trees:
            apart, nearest = tree.query(points)
            np.minimum(result, sizes[nearest] + GRADIENT * apart, out=result)
        return result


def _longest_edges(points: Floats, triangles: Ints) -> tuple[Ints, Floats, Floats]:
    """Of each facet's longest edge: its name, its length, its middle."""
    length = np.stack(remesh.side_lengths(points[triangles]), axis=1)
    longest = length.max(axis=1)
    after = np.roll(triangles, -1, axis=1)
    name = edge_keys(triangles, after, len(points))
    # Of equal ones the same is chosen from both sides, so that no path of them runs in a circle.
    row, at = np.arange(len(triangles)), np.where(length == longest[:, None], name, -1).argmax(1)
    middle = 0.5 * (points[triangles[row, at]] + points[after[row, at]])
    return name[row, at], longest, middle

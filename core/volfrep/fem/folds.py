# SPDX-License-Identifier: LGPL-2.1-or-later
"""Facets that lie on one another, as moves of needles may leave them."""

from __future__ import annotations

import numpy as np

from ..mesh import remesh
from ..mesh.topology import adjacent, numbered
from ..mesh.triangle_mesh import TriangleMesh
from ..mesh.well_shaped import are_opposite
from ..util.types import Bools


def folded_facets(mesh: TriangleMesh, among: Bools | None = None) -> Bools:
    """(m,) facets that lie on one that they share an edge with: see `are_opposite`.

    Args:
        mesh: no edge has more than two facets.
        among: (m,) facets to look at; None for all. Pairs of two others are not told for certain.
    """
    triangles, count = mesh.triangles, len(mesh.vertices)
    every = np.ones(len(triangles), bool)
    rows = np.flatnonzero(every if among is None else adjacent(among, triangles, count))
    used, local = numbered(triangles[rows], count)
    pairs = remesh.edges(local, len(used)).triangles
    one, other = rows[pairs[pairs[:, 1] >= 0]].T
    lie = are_opposite(mesh.vertices[triangles[one]], mesh.vertices[triangles[other]])
    found = np.zeros(len(triangles), bool)
    found[one[lie]] = True
    found[other[lie]] = True
    return found

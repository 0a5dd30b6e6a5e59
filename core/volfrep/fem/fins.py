# SPDX-License-Identifier: LGPL-2.1-or-later
"""Facets that lie on one another, as moves of needles may leave them: found, and taken off."""

from __future__ import annotations

import numpy as np

from ..mesh import remesh
from ..mesh.triangle_mesh import TriangleMesh, compact
from ..mesh.well_shaped import are_opposite, around, names
from ..util.types import Bools


def folded_facets(mesh: TriangleMesh) -> Bools:
    """(m,) facets that lie on one that they share an edge with: see `are_opposite`."""
    pairs = remesh.edges(mesh.triangles.astype(np.int64), len(mesh.vertices)).triangles
    one, other = pairs[pairs[:, 1] >= 0].T
    corners = mesh.vertices[mesh.triangles]
    lie = are_opposite(corners[one], corners[other])
    found = np.zeros(len(corners), bool)
    found[one[lie]] = True
    found[other[lie]] = True
    return found


def without_fins(mesh: TriangleMesh, folded: Bools) -> TriangleMesh:
    """The closed mesh without points that only three facets share which lie on one another.

    Such a point sticks out of the surface in a fin of no thickness: one facet takes the place of
    its three, and nothing is lost. The mesh itself where there is none.

    Args:
        mesh: closed.
        folded: (m,) facets that lie on a neighbour.
    """
    triangles = mesh.triangles.astype(np.int64)
    count = len(mesh.vertices)
    tip = np.bincount(triangles.ravel(), minlength=count) == 3
    tip &= np.bincount(triangles[folded].ravel(), minlength=count) == 3
    tip[triangles[tip[triangles].sum(axis=1) > 1]] = False
    rows, facet = around(triangles, tip)
    # Of a tetrahedron the fourth facet would be left with its own back.
    whole = ~np.isin(names(facet, count), names(triangles, count))
    if not whole.any():
        return mesh
    stays = np.ones(len(triangles), bool)
    stays[rows[whole].ravel()] = False
    joined = np.concatenate([triangles[stays], facet[whole]]).astype(np.int32)
    return compact(TriangleMesh(mesh.vertices, joined))

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Outlines of closed meshes at a height: by manifold3d, or from their triangles without it."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ..mesh.booleans import as_manifold
from ..mesh.topology import edge_keys
from ..mesh.triangle_mesh import TriangleMesh
from ..util.manifold import has_manifold
from ..util.types import Floats


def plane_cutter(mesh: TriangleMesh) -> Callable[[float], list[Floats]]:
    """What gives a closed mesh's outlines at a height z, mm: (n, 2) each, holes clockwise.

    Raises:
        VolfrepError: the mesh is no solid that can be cut.
    """
    if not has_manifold():
        return lambda z: plane_loops(mesh, z)
    solid = as_manifold(mesh)
    return lambda z: list(solid.slice(z).to_polygons())


def plane_loops(mesh: TriangleMesh, z: float) -> list[Floats]:
    """Outlines of a closed mesh at a height, from its triangles; a vertex at z counts as below."""
    above = mesh.vertices[:, 2] > z
    state = above[mesh.triangles]
    crossed = mesh.triangles[state.any(axis=1) & ~state.all(axis=1)]
    if not len(crossed):
        return []
    # Every such triangle has one edge that rises through the plane and one that falls: the solid
    # lies to the left of the way from the one to the other.
    ahead = np.roll(crossed, -1, axis=1)
    up, down = ~above[crossed] & above[ahead], above[crossed] & ~above[ahead]
    count = len(mesh.vertices)
    start = edge_keys(crossed[down], ahead[down], count)
    end = edge_keys(crossed[up], ahead[up], count)
    keys, first = np.unique(start, return_index=True)
    a, b = crossed[down][first], ahead[down][first]
    low, high = mesh.vertices[np.minimum(a, b)], mesh.vertices[np.maximum(a, b)]
    share = (z - low[:, 2]) / (high[:, 2] - low[:, 2])
    points = (low + share[:, None] * (high - low))[:, :2]
    following = np.searchsorted(keys, end[first]).tolist()
    loops, waiting = [], np.ones(len(keys), bool)
    for begin in range(len(keys)):
        loop, at = [], begin
        while waiting[at]:
            waiting[at] = False
            loop.append(at)
            at = following[at]
        if loop:
            loops.append(points[loop])
    return loops

# SPDX-License-Identifier: LGPL-2.1-or-later
"""How far a mended surface is from what it was, asked where it changed and nowhere else."""

from __future__ import annotations

import numpy as np

from ..mesh.remesh import side_lengths
from ..mesh.topology import edge_keys
from ..mesh.triangle_mesh import TriangleMesh
from ..spatial.proximity import NearestTriangles
from ..util.types import Floats


def farthest_apart(one: TriangleMesh, other: TriangleMesh) -> float:
    """The farthest that vertices and middles of edges of either surface are from the other, mm.

    Only what one has and the other has not is asked: what both have is 0 away.

    Args:
        one: closed, mm.
        other: the same, whose vertices are equal where it has not changed.
    """
    both = np.concatenate([one.vertices, other.vertices])
    places, name = np.unique(both, axis=0, return_inverse=True)
    name, count = name.ravel(), len(places)
    own = [name[one.triangles], name[len(one.vertices) + other.triangles]]
    edges = [np.unique(edge_keys(rows, np.roll(rows, 1, axis=1), count)) for rows in own]
    result = 0.0
    for asked, at in ((0, other), (1, one)):
        alone = np.setdiff1d(own[asked], own[1 - asked])
        ends = np.divmod(np.setdiff1d(edges[asked], edges[1 - asked]), count)
        middles: Floats = 0.5 * (places[ends[0]] + places[ends[1]])
        spacing = float(np.median(side_lengths(at.vertices[at.triangles])))
        surface = NearestTriangles(at, spacing)
        result = surface.farthest(np.concatenate([places[alone], middles]), result)
    return result

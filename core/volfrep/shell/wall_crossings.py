# SPDX-License-Identifier: LGPL-2.1-or-later
"""Self-intersection of the wall, looked for again only where a mesh has changed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..mesh.triangle_mesh import TriangleMesh
from ..spatial.self_intersection import crossing_edges
from ..util.types import Bools, Floats, Ints

#: Odd numbers that mix the bits of coordinates.
MIX = np.array((0x9E3779B97F4A7C15, 0xC2B2AE3D27D4EB4F, 0x165667B19E3779F9), np.uint64)


@dataclass(frozen=True, eq=False)
class Judged:
    """A mesh that was looked at.

    Attributes:
        names: (m,) of its triangles, by where their corners are.
        crossed: (m,) which of them cross others.
        edge_of: (k,) triangles whose edge runs through another.
        through: (k,) the other triangle.
        points: (k, 3) where, mm.
    """

    names: Ints
    crossed: Bools
    edge_of: Ints
    through: Ints
    points: Floats


_NONE = np.zeros(0, np.int64)
NOTHING_JUDGED = Judged(_NONE, np.zeros(0, bool), _NONE, _NONE, np.zeros((0, 3)))


def judged(mesh: TriangleMesh, depth: float, before: Judged = NOTHING_JUDGED) -> Judged:
    """Where a mesh runs through itself, looked for where it differs from one that is known.

    Two triangles that were there before and did not cross then do not cross now.

    Args:
        mesh: the surface, mm.
        depth: an edge has to stick out on both sides of a triangle by more than this, mm.
        before: what is known of a mesh that shares triangles with it.
    """
    names = _names(mesh)
    same = np.isin(names, before.names) & ~np.isin(names, before.names[before.crossed])
    one, other, points = crossing_edges(mesh, ~same, depth)
    crossed = np.zeros(len(names), bool)
    crossed[one] = True
    crossed[other] = True
    return Judged(names, crossed, one, other, points)


def _names(mesh: TriangleMesh) -> Ints:
    """(m,) a number for each triangle, the same for the same corners in any mesh."""
    vertex = (np.ascontiguousarray(mesh.vertices).view(np.uint64) * MIX).sum(axis=1)
    vertex ^= vertex >> np.uint64(31)
    corners = vertex[mesh.triangles] * MIX[0]
    mixed = (corners ^ (corners >> np.uint64(29))).sum(axis=1)
    return np.asarray(mixed.view(np.int64))

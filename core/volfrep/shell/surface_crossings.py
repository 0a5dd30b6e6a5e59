# SPDX-License-Identifier: LGPL-2.1-or-later
"""Self-intersection of the wall, looked for again only where a mesh has changed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..mesh.remesh import unit_normals
from ..mesh.triangle_mesh import TriangleMesh
from ..spatial.piercing import pairs_at_planes, piercing_among
from ..util.linalg import normalize
from ..util.progress import Monitor
from ..util.types import Floats, Ints

#: Odd numbers that mix the bits of coordinates.
MIX = np.array((0x9E3779B97F4A7C15, 0xC2B2AE3D27D4EB4F, 0x165667B19E3779F9), np.uint64)


@dataclass(frozen=True, eq=False)
class Judged:
    """A mesh that was looked at.

    Attributes:
        names: (m,) of its triangles, by where their corners are.
        pairs: (k, 2) of them that run through each other, exactly.
    """

    names: Ints
    pairs: Ints


def find_new_crossings(
    mesh: TriangleMesh, monitor: Monitor, before: Judged | None = None
) -> Judged:
    """Where a mesh runs through itself, looked for where it differs from one that is known.

    Two triangles that were there before and did not cross then do not cross now.

    Args:
        mesh: the surface, mm.
        monitor: asked for a cancel.
        before: what is known of a mesh that shares triangles with it.

    Raises:
        Cancelled: when the monitor says so.
    """
    names, among = _names(mesh), None
    if before is not None:
        crossed = before.names[before.pairs]
        among = ~np.isin(names, before.names) | np.isin(names, crossed)
    return Judged(names, piercing_among(mesh, pairs_at_planes(mesh, 0.0, monitor, among)))


def crossed_along(mesh: TriangleMesh, pairs: Ints) -> tuple[Floats, Floats]:
    """(k, 3) and (k, 3) mm: both ends of the lines along which pairs (k, 2) of triangles cross."""
    one, other = mesh.vertices[mesh.triangles[pairs.T]]
    way = normalize(np.cross(unit_normals(one), unit_normals(other)))
    ends = [_at_plane(one, other, way), _at_plane(other, one, way)]
    # Both parts of the line lie on it: what they have in common.
    start = np.where((ends[0][0] >= ends[1][0])[:, None], ends[0][2], ends[1][2])
    stop = np.where((ends[0][1] <= ends[1][1])[:, None], ends[0][3], ends[1][3])
    return start, stop


def _at_plane(one: Floats, other: Floats, way: Floats) -> tuple[Floats, Floats, Floats, Floats]:
    """Where planes of triangles cut others, (k, 3, 3): least and most along a way, and points."""
    height = np.einsum("kij,kj->ki", one - other[:, :1], unit_normals(other))
    following = np.roll(height, -1, axis=1)
    cut = (height > 0.0) != (following > 0.0)
    share = np.where(cut, height / np.where(cut, height - following, 1.0), 0.0)
    points = one + np.clip(share, 0.0, 1.0)[:, :, None] * (np.roll(one, -1, axis=1) - one)
    along = np.einsum("kij,kj->ki", points, way)
    rows = np.arange(len(one))
    first = np.where(cut, along, np.inf).argmin(axis=1)
    last = np.where(cut, along, -np.inf).argmax(axis=1)
    return along[rows, first], along[rows, last], points[rows, first], points[rows, last]


def _names(mesh: TriangleMesh) -> Ints:
    """(m,) a number for each triangle, the same for the same corners in any mesh."""
    vertex = (np.ascontiguousarray(mesh.vertices).view(np.uint64) * MIX).sum(axis=1)
    vertex ^= vertex >> np.uint64(31)
    corners = vertex[mesh.triangles] * MIX[0]
    mixed = (corners ^ (corners >> np.uint64(29))).sum(axis=1)
    return np.asarray(mixed.view(np.int64))

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Normals and edges that a mesh is drawn with: smooth where it is round, crisp where it is not."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..util.linalg import cross_columns, dot_columns, normalize
from ..util.types import Floats, Ints
from .topology import edge_keys, pieces_of
from .triangle_mesh import TriangleMesh

#: Two triangles are drawn smooth up to this angle between them, and with an edge from that one.
CREASE_ANGLE, EDGE_ANGLE = np.radians(32.0), np.radians(40.0)


@dataclass(frozen=True, eq=False)
class Shaded:
    """A mesh to draw: a vertex is there once for each normal that it has.

    Attributes:
        points: (n, 3) float32, mm.
        normals: (n, 3) float32, of length 1, outwards.
        triangles: (t, 3) int32 rows of both, in the order of the mesh.
    """

    points: NDArray[np.float32]
    normals: NDArray[np.float32]
    triangles: NDArray[np.int32]


def shade(mesh: TriangleMesh, crease_angle: float = CREASE_ANGLE) -> Shaded:
    """The mesh with the normals that it is drawn with; it may be open.

    The corners of a vertex share a normal, the mean of their triangles by area, as far as one
    comes round the vertex without a crease.
    """
    t = mesh.triangles
    area = _doubled_areas(mesh)
    pair = _pairs(mesh)
    smooth = _cosines(area, pair) >= np.cos(crease_angle)
    one, two = _corners_across(t, pair[smooth])
    count, corner = pieces_of(one, two, t.size)
    vertex = np.empty(count, np.int64)
    vertex[corner] = t.ravel()
    weight = (np.repeat(column, 3) for column in area)
    total = np.stack([np.bincount(corner, each, count) for each in weight], axis=1)
    normals = normalize(total)
    return Shaded(
        mesh.vertices[vertex].astype(np.float32),
        normals.astype(np.float32),
        corner.reshape(-1, 3).astype(np.int32),
    )


def sharp_edges(mesh: TriangleMesh) -> Ints:
    """(e, 2) vertices of the edges where the mesh bends by more than `EDGE_ANGLE`, or ends."""
    ends = _half_edges(mesh.triangles)
    pair = _pairs(mesh)
    sharp = _cosines(_doubled_areas(mesh), pair) < np.cos(EDGE_ANGLE)
    alone = np.ones(len(ends), bool)
    alone[pair.ravel()] = False
    return np.concatenate([ends[pair[sharp, 0]], ends[alone]])


def _half_edges(triangles: NDArray[np.int32]) -> Ints:
    """(3 t, 2) ends of the sides: side k of a triangle goes from its corner k to the next."""
    ends = np.stack([triangles, np.roll(triangles, -1, axis=1)], axis=2)
    return np.asarray(ends.reshape(-1, 2), np.int64)


def _pairs(mesh: TriangleMesh) -> Ints:
    """(p, 2) half edges that lie on each other."""
    ends = _half_edges(mesh.triangles)
    key = edge_keys(ends[:, 0], ends[:, 1], len(mesh.vertices))
    order = np.argsort(key, kind="stable")
    same = np.flatnonzero(key[order[1:]] == key[order[:-1]])
    return np.stack([order[same], order[same + 1]], axis=1)


def _doubled_areas(mesh: TriangleMesh) -> list[Floats]:
    """Three of (t,), x, y and z of normals as long as the triangles are large, twice."""
    columns = [np.ascontiguousarray(column) for column in mesh.vertices.T]
    a, b, c = (np.ascontiguousarray(corner) for corner in mesh.triangles.T)
    first = [column.take(a) for column in columns]
    sides = ([x.take(k) - start for x, start in zip(columns, first, strict=True)] for k in (b, c))
    return cross_columns(*sides)


def _cosines(area: list[Floats], pair: Ints) -> Floats:
    """(p,) of the angles between the two triangles of each pair of half edges."""
    one, two = ([column.take(side // 3) for column in area] for side in pair.T)
    length = np.sqrt(dot_columns(one, one)) * np.sqrt(dot_columns(two, two))
    # A needle has no normal: nothing is sharp there.
    return np.where(length > 0, dot_columns(one, two) / np.maximum(length, 1e-300), 1.0)


def _corners_across(triangles: NDArray[np.int32], pair: Ints) -> tuple[Ints, Ints]:
    """Corners (numbered 3 t + k) of pairs of half edges that have the same vertex."""
    vertex = triangles.ravel()
    start = pair
    end = pair - pair % 3 + (pair + 1) % 3
    opposite = vertex[start[:, 0]] == vertex[end[:, 1]]
    beside_start = np.where(opposite, end[:, 1], start[:, 1])
    beside_end = np.where(opposite, start[:, 1], end[:, 1])
    return np.concatenate([start[:, 0], end[:, 0]]), np.concatenate([beside_start, beside_end])

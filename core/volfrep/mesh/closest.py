# SPDX-License-Identifier: LGPL-2.1-or-later
"""The closest point of one triangle to one point, of many pairs at once."""

from __future__ import annotations

import numpy as np

from ..util.linalg import dot_columns, less_columns
from ..util.types import Floats, Ints


def closest_on_triangles(corners: Floats, points: Floats) -> tuple[Floats, Ints]:
    """The closest point of triangle k to point k.

    By barycentric coordinates (C. Ericson, Real-Time Collision Detection, 2005, 3.4); where these
    lie outside the triangle, or it is a sliver, the closest point of its three edges (5.1.2).

    Args:
        corners: (n, 3, 3) corner coordinates, by triangle and corner; slivers are allowed.
        points: (n, 3).

    Returns:
        (n, 3) points, and (n,) the edge each lies on (edge e runs from corner e to e + 1) or -1
        where it lies inside its triangle.
    """
    # A column for every coordinate: numpy takes rows of three slowly.
    columns = np.ascontiguousarray(corners.reshape(-1, 9).T)
    at = np.ascontiguousarray(points.T)
    a = columns[:3]
    ab, ac, ap = (less_columns(each, a) for each in (columns[3:6], columns[6:], at))
    d00, d01, d11 = dot_columns(ab, ab), dot_columns(ab, ac), dot_columns(ac, ac)
    d20, d21 = dot_columns(ap, ab), dot_columns(ap, ac)
    square = d00 * d11
    denominator = square - d01 * d01
    thin = denominator <= 1e-14 * square
    denominator[thin] = 1.0
    v = (d11 * d20 - d01 * d21) / denominator
    w = (d00 * d21 - d01 * d20) / denominator
    closest = np.empty_like(points)
    for k in range(3):
        closest[:, k] = a[k] + v * ab[k] + w * ac[k]
    edge = np.full(len(points), -1, np.int64)
    out = np.flatnonzero((v < 0) | (w < 0) | (v + w > 1) | thin)
    if len(out):
        (closest[out, 0], closest[out, 1], closest[out, 2]), edge[out] = _closest_on_edges(
            columns[:, out], at[:, out]
        )
    return closest, edge


def _closest_on_edges(columns: Floats, at: Floats) -> tuple[list[Floats], Ints]:
    """As `closest_on_triangles` of (9, n) and (3, n) coordinates, in columns: the edges only."""
    corners = columns[:3], columns[3:6], columns[6:], columns[:3]
    closest, squared = list(at), np.full(at.shape[1], np.inf)
    edge = np.zeros(at.shape[1], np.int64)
    for k in range(3):
        start, along = corners[k], less_columns(corners[k + 1], corners[k])
        way = dot_columns(less_columns(at, start), along)
        way = np.minimum(np.maximum(way / np.maximum(dot_columns(along, along), 1e-300), 0.0), 1.0)
        candidate = [start[i] + way * along[i] for i in range(3)]
        gap = less_columns(at, candidate)
        distance = dot_columns(gap, gap)
        better = distance < squared
        squared = np.where(better, distance, squared)
        closest = [np.where(better, *both) for both in zip(candidate, closest, strict=True)]
        edge[better] = k
    return closest, edge

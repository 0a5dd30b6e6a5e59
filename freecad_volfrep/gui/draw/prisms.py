# SPDX-License-Identifier: LGPL-2.1-or-later
"""Struts as prisms, which are drawn round."""

from __future__ import annotations

import numpy as np

from volfrep.mesh.triangle_mesh import TriangleMesh

#: Of a prism, which is a line where there are very many.
SIDES = 6
#: Prisms are drawn round: their sides meet at a smaller angle, in radians.
CREASE_ANGLE = 1.2


def prisms(start: np.ndarray, end: np.ndarray, radii: np.ndarray) -> TriangleMesh:
    """Closed prisms in the place of struts, (k, 3) starts and ends, (k, 2) radii."""
    axis = end - start
    axis /= np.maximum(np.linalg.norm(axis, axis=1), 1e-12)[:, None]
    helper = np.where(np.abs(axis[:, :1]) < 0.7, [[1.0, 0.0, 0.0]], [[0.0, 1.0, 0.0]])
    one = np.cross(axis, helper)
    one /= np.linalg.norm(one, axis=1)[:, None]
    two = np.cross(axis, one)
    angle = 2.0 * np.pi * np.arange(SIDES) / SIDES
    out = np.cos(angle)[:, None] * one[:, None] + np.sin(angle)[:, None] * two[:, None]
    rings = [
        middle[:, None] + radius[:, None, None] * out
        for middle, radius in ((start, radii[:, 0]), (end, radii[:, 1]))
    ]
    vertices = np.concatenate(rings, axis=1).reshape(-1, 3)
    k = np.arange(SIDES)
    following, inner = (k + 1) % SIDES, k[1:-1]
    sides = np.concatenate(
        [
            np.stack([k, following, following + SIDES], 1),
            np.stack([k, following + SIDES, k + SIDES], 1),
            np.stack([0 * inner, inner + 1, inner], 1),
            np.stack([0 * inner, inner, inner + 1], 1) + SIDES,
        ]
    )
    first = 2 * SIDES * np.arange(len(start))
    triangles = (first[:, None, None] + sides).reshape(-1, 3)
    return TriangleMesh(vertices, triangles.astype(np.int32))

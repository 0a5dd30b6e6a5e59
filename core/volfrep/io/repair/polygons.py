# SPDX-License-Identifier: LGPL-2.1-or-later
"""Polygons in space cut into triangles."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ...mesh.triangulation import triangulate
from ...util.errors import VolfrepError
from ...util.linalg import along, times
from ...util.ragged import spread
from ...util.types import Floats, Ints

#: Concave polygons are cut one by one; files with more of them are refused.
MOST_CONCAVE = 20_000


def cut_polygons(vertices: Floats, corners: Ints, counts: Ints, name: str) -> Ints:
    """(m, 3) triangles of polygons, whose corners lie one after another in one array.

    Triangles stay, convex polygons become fans, others are cut in their mean plane.

    Args:
        vertices: (n, 3).
        corners: (sum of counts,) vertex indices.
        counts: (p,) corners of each polygon, none below three.
        name: of the file, for messages.

    Raises:
        VolfrepError: more than `MOST_CONCAVE` polygons are concave.
    """
    first = np.cumsum(counts) - counts
    fan = np.ones(len(counts), bool)
    many = np.flatnonzero(counts > 3)
    fan[many] = _convex(vertices, corners, first[many], counts[many])
    if len(fan) - np.count_nonzero(fan) > MOST_CONCAVE:
        raise VolfrepError(
            f"'{name}' has more than {MOST_CONCAVE} concave polygons: export it as triangles."
        )
    polygon, place = spread(counts[fan] - 2)
    start = first[fan][polygon]
    triangles = [
        np.stack([corners[start], corners[start + place + 1], corners[start + place + 2]], axis=1)
    ]
    for row in np.flatnonzero(~fan):
        loop = corners[first[row] : first[row] + counts[row]]
        cut = cut_loops(vertices, [loop])
        if cut is None:  # a loop that crosses itself: as every other reader takes it
            cut = np.stack([np.full(len(loop) - 2, loop[0]), loop[1:-1], loop[2:]], axis=1)
        triangles.append(cut)
    return np.concatenate(triangles)


def _convex(vertices: Floats, corners: Ints, first: Ints, counts: Ints) -> NDArray[np.bool_]:
    """Whether the fan from a polygon's first corner has no triangle that faces the other way."""
    polygon, place = spread(counts - 2)
    start = first[polygon]
    a, b, c = (vertices[corners[start + k]] for k in (0 * place, place + 1, place + 2))
    normal = np.cross(b - a, c - a)
    total = np.stack(
        [np.bincount(polygon, weights=normal[:, k], minlength=len(counts)) for k in range(3)], 1
    )
    along = np.einsum("ij,ij->i", normal, total[polygon])
    result = np.ones(len(counts), bool)
    result[polygon[along < 0.0]] = False
    return result


def mean_normal(points: Floats) -> Floats:
    """Twice the area of a closed loop of points as a vector (Newell's formula)."""
    centred = points - points.mean(axis=0)
    normal: Floats = np.cross(centred, np.roll(centred, -1, axis=0)).sum(axis=0)
    return normal


def cut_loops(vertices: Floats, loops: list[Ints]) -> Ints | None:
    """(m, 3) triangles of a face bounded by loops in about one plane.

    The largest loop says which way the face looks; loops that run the other way are its holes.

    Returns:
        None where the loops cross themselves or one another, as seen along the face's normal.
    """
    normals = [mean_normal(vertices[loop]) for loop in loops]
    normal = max(normals, key=lambda n: float(along(n, n)))
    length = float(np.linalg.norm(normal))
    if length == 0.0:
        return None
    normal = normal / length
    u = np.cross(normal, np.eye(3)[np.abs(normal).argmin()])
    u /= np.linalg.norm(u)
    frame = np.stack([u, np.cross(normal, u)], axis=1)
    indices = np.concatenate(loops)
    points = vertices[indices]
    flat = times(points - points.mean(axis=0), frame)
    ends = np.cumsum([len(loop) for loop in loops])[:-1]
    pieces = triangulate(np.split(flat, ends))
    a, b, c = (flat[pieces[:, k]] for k in range(3))
    doubled = (b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]
    expected = sum(float(along(n, normal)) for n in normals)
    spread_out = float(np.ptp(flat, axis=0).max()) ** 2
    holes = sum(float(along(n, normal)) < 0.0 for n in normals)
    if len(pieces) != len(indices) - 2 * (len(loops) - holes) + 2 * holes:
        return None
    if abs(float(np.abs(doubled).sum()) - expected) > 1e-9 * spread_out:
        return None
    triangles: Ints = indices[pieces]
    return triangles

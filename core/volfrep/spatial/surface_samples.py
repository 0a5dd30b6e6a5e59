# SPDX-License-Identifier: LGPL-2.1-or-later
"""Points on a surface, of which every point of it has one near: what distances are looked up by."""

from __future__ import annotations

import numpy as np

from ..util.ragged import spread
from ..util.threads import in_threads
from ..util.types import Floats, Ints

#: Sine of the angle between two faces from which their reentrant edge has samples of its own.
SHARP_BEND = 0.1
#: Triangles that one thread samples at a time.
TRIANGLES_PER_STEP = 2000


def sample_triangles(corners: Floats, spacing: float) -> tuple[Floats, Ints]:
    """Points in rows parallel to each triangle's longest edge, and the triangles they lie on.

    Every point of a triangle (k, 3, 3) has one of them within 0.75 of the spacing.
    """
    starts = range(0, max(len(corners), 1), TRIANGLES_PER_STEP)

    def part(start: int) -> tuple[Floats, Ints]:
        points, owner = _sampled(corners[start : start + TRIANGLES_PER_STEP], spacing)
        return points, owner + start

    points, owners = zip(*in_threads(part, starts), strict=True)
    return np.concatenate(points), np.concatenate(owners)


def _sampled(corners: Floats, spacing: float) -> tuple[Floats, Ints]:
    """As `sample_triangles`, on one thread."""
    lengths = np.linalg.norm(np.roll(corners, -1, axis=1) - corners, axis=2)
    longest = lengths.argmax(axis=1)
    turn = (longest[:, None] + np.arange(3)) % 3
    corners = np.take_along_axis(corners, turn[:, :, None], axis=1)
    base = lengths.max(axis=1)
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    height = np.linalg.norm(normal, axis=1) / np.maximum(base, 1e-300)
    # Both angles at the longest edge are acute: below every point of the triangle, towards that
    # edge, is a point of the next row. The steps make the farthest point 0.75 spacings away.
    rows = np.maximum(np.ceil(height / (0.53 * spacing)), 1).astype(np.int64)
    columns = np.maximum(np.ceil(base / (1.06 * spacing)), 1)
    owner, row = spread(rows)
    up = row / rows[owner]
    across = np.maximum(np.ceil(columns[owner] * (1.0 - up)), 1).astype(np.int64)
    line, column = spread(across)
    up, owner = up[line], owner[line]
    along = (column + 0.5) / across[line] * (1.0 - up)
    a, b, c = corners[owner, 0], corners[owner, 1], corners[owner, 2]
    return a + along[:, None] * (b - a) + up[:, None] * (c - a), owner


def sample_reentrant_edges(
    corners: Floats, normal: Floats, across: Ints, spacing: float
) -> tuple[Floats, Ints]:
    """Points along the edges that point into the solid.

    They are the nearest to many points inside, and the samples on the faces recede from them.

    Args:
        corners: (m, 3, 3) of triangles.
        normal: (m, 3) their unit normals, outward.
        across: (m, 3) the triangle on the other side of each edge.
        spacing: mm.

    Returns:
        (k, 3) points and (k,) a triangle of each.
    """
    triangle, edge = np.nonzero(across > np.arange(len(across))[:, None])
    other = across[triangle, edge]
    start, end = corners[triangle, edge], corners[triangle, (edge + 1) % 3]
    # With both normals outward, the solid is reentrant where the neighbour rises above the face.
    along = end - start
    length = np.linalg.norm(along, axis=1)
    bend = np.einsum("ij,ij->i", np.cross(normal[triangle], normal[other]), along) / np.maximum(
        length, 1e-300
    )
    sharp = bend < -SHARP_BEND
    triangle, start, along, length = triangle[sharp], start[sharp], along[sharp], length[sharp]
    pieces = np.maximum(np.ceil(length / spacing), 1).astype(np.int64)
    owner, place = spread(pieces + 1)
    return start[owner] + (place / pieces[owner])[:, None] * along[owner], triangle[owner]

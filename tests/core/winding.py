# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where a heap of triangles is solid, by solid angles: a judge that knows nothing of edges.

The generalised winding number (Jacobson and others, 2013) sums the solid angles under which a
point sees the triangles. In a closed surface it is a whole number; where triangles are missing it
changes little, so that above one half is inside.
"""

import numpy as np

TRIANGLES_PER_STEP = 2_000_000


def winding_numbers(mesh, points):
    """(k,) the generalised winding number of any triangles round points."""
    corners = np.stack(mesh.corners(), axis=1)
    result = np.empty(len(points))
    step = max(TRIANGLES_PER_STEP // len(corners), 1)
    for start in range(0, len(points), step):
        part = points[start : start + step]
        a, b, c = (corners[None, :, k] - part[:, None] for k in range(3))
        la, lb, lc = (np.sqrt(np.einsum("ijk,ijk->ij", s, s)) for s in (a, b, c))
        above = np.einsum("ijk,ijk->ij", a, np.cross(b, c))
        below = la * lb * lc + sum(
            np.einsum("ijk,ijk->ij", p, q) * r for p, q, r in ((a, b, lc), (b, c, la), (c, a, lb))
        )
        result[start : start + step] = np.arctan2(above, below).sum(axis=1) / (2.0 * np.pi)
    return result


def disagreement(solid, heap, count=300):
    """The share of the box where the solid and the heap of triangles disagree on what is inside.

    Either sense of the heap is taken, since files may be inside out.
    """
    low, high = heap.bounds
    points = np.random.default_rng(2).uniform(low, high, (count, 3))
    inside = winding_numbers(solid, points) > 0.5
    given = winding_numbers(heap, points)
    return min(np.mean(inside != (given > 0.5)), np.mean(inside != (given < -0.5)))

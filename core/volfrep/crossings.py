# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where a surface runs through itself."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .mesh import TriangleMesh
from .ragged import spread

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

#: Pairs of triangles that one vectorised step takes at a time.
PAIRS_PER_STEP = 500_000


def crossing_triangles(
    mesh: TriangleMesh, among: NDArray[np.bool_], depth: float
) -> NDArray[np.bool_]:
    """The triangles that an edge of another triangle runs through.

    Args:
        mesh: the surface, mm.
        among: (m,) bool, triangles to look at; pairs of two others are not tested.
        depth: an edge has to stick out on both sides of a triangle by more than this, mm.

    Returns:
        (m,) bool: both the triangles that are run through and those whose edges do it.
    """
    crossing = np.zeros(len(mesh.triangles), bool)
    if not among.any():
        return crossing
    corners = mesh.vertices[mesh.triangles]
    low, high = corners.min(axis=1), corners.max(axis=1)
    chosen = np.flatnonzero(among)
    # Triangles meet in the bins of a coarse grid; only what reaches the chosen ones is binned.
    size = float(np.percentile((high - low).max(axis=1), 90))
    own, own_bin = boxes_in_bins(low[chosen], high[chosen], low.min(axis=0), size)
    reach = low[chosen].min(axis=0), high[chosen].max(axis=0)
    close = np.flatnonzero((low <= reach[1]).all(axis=1) & (high >= reach[0]).all(axis=1))
    other, other_bin = boxes_in_bins(low[close], high[close], low.min(axis=0), size)
    order = np.argsort(other_bin, kind="stable")
    other, other_bin = close[other[order]], other_bin[order]
    first = np.searchsorted(other_bin, own_bin)
    count = np.searchsorted(other_bin, own_bin, "right") - first
    total = np.cumsum(count)
    steps = np.searchsorted(total, np.arange(0, int(total[-1]), PAIRS_PER_STEP))
    for start, stop in zip(steps, [*steps[1:], len(count)], strict=True):
        row, place = spread(count[start:stop])
        a, b = chosen[own[start + row]], other[first[start + row] + place]
        for axis in range(3):
            lo, hi = low[:, axis], high[:, axis]
            keep = (lo[a] <= hi[b]) & (lo[b] <= hi[a])
            a, b = a[keep], b[keep]
        # A pair of chosen triangles is met from both sides: once is enough.
        once = (a < b) | ~among[b]
        pair = np.unique(a[once] * len(among) + b[once])
        a, b = pair // len(among), pair % len(among)
        hit = _edges_cross(mesh, a, b, depth) | _edges_cross(mesh, b, a, depth)
        crossing[a[hit]] = True
        crossing[b[hit]] = True
    return crossing


def boxes_in_bins(low: Floats, high: Floats, origin: Floats, size: float) -> tuple[Ints, Ints]:
    """Every box with every bin of the grid that it reaches into, as (box, bin) pairs."""
    first = np.floor((low - origin) / size).astype(np.int64)
    span = np.floor((high - origin) / size).astype(np.int64) - first + 1
    box, place = spread(span.prod(axis=1))
    s = span[box]
    steps = [place // (s[:, 1] * s[:, 2]), place // s[:, 2] % s[:, 1], place % s[:, 2]]
    x, y, z = (first[box, k] + steps[k] for k in range(3))
    return box, ((x << 40) + (y << 20) + z)


def _edges_cross(mesh: TriangleMesh, a: Ints, b: Ints, depth: float) -> NDArray[np.bool_]:
    """Whether an edge of triangle a, without a vertex in common with b, runs through b."""
    corner = mesh.vertices[mesh.triangles[b]]
    normal = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
    normal /= np.maximum(np.linalg.norm(normal, axis=1), 1e-300)[:, None]
    ends = mesh.vertices[mesh.triangles[a]]
    height = np.einsum("nij,nj->ni", ends - corner[:, :1], normal)
    crosses = np.zeros(len(a), bool)
    for k in range(3):
        following = (k + 1) % 3
        from_above = (height[:, k] > depth) & (height[:, following] < -depth)
        from_below = (height[:, k] < -depth) & (height[:, following] > depth)
        rows = np.flatnonzero(from_above | from_below)
        edge = mesh.triangles[a[rows]][:, [k, following]]
        shared = (edge[:, :, None] == mesh.triangles[b[rows]][:, None, :]).any(axis=(1, 2))
        rows = rows[~shared]
        p, q = ends[rows, k], ends[rows, following]
        sides = []
        for e in range(3):
            u, v = corner[rows, e], corner[rows, (e + 1) % 3]
            sides.append(np.einsum("ij,ij->i", np.cross(q - p, u - p), v - p))
        one_side = np.all([s > 0 for s in sides], axis=0) | np.all([s < 0 for s in sides], axis=0)
        crosses[rows[one_side]] = True
    return crosses

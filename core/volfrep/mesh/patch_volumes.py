# SPDX-License-Identifier: LGPL-2.1-or-later
"""The volume that a surface had before patches of it were changed, given back to it.

Each change of facets may stay within a tolerance and all of them may take the same way: an edge
that is flipped on a convex surface cuts it off, never adds to it. What a patch has lost on the
whole is less than a tolerance deep, so that its new points make up for it by a small move along
their normals.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ..util.types import Bools, Floats, Ints
from . import remesh
from .patches import FaultFinder, changed_patches
from .topology import adjacent
from .triangle_mesh import TriangleMesh

#: The volume is a cubic of how far points go, and all but a straight line: steps of Newton's.
STEPS = 3


def with_volumes(
    points: Floats,
    before: Ints,
    after: Ints,
    free: Bools,
    most: Callable[[Floats], Floats],
    find_faults: FaultFinder,
) -> Floats:
    """Points in whose places each changed patch has the volume that it had, as far as that goes.

    The points of a patch go equally far, but none farther than it may, and none that has a fault
    then.

    Args:
        points: (n, 3) mm.
        before: (m, 3) a closed surface.
        after: (k, 3) what it became.
        free: (n,) points that may move, which `before` has not.
        most: how far points (l, 3) may move, mm.
        find_faults: tells which facets may not stay.
    """
    old, new = changed_patches(before, after, len(points))
    count = max(int(old.max(initial=-1)), int(new.max(initial=-1))) + 1
    # Of an open patch that is a volume up to one and the same point.
    origin = points.mean(axis=0)
    wanted = _volumes(points - origin, before, old, count)
    # All facets about a new point are in one patch.
    patch = np.full(len(points), -1)
    patch[after[new >= 0]] = new[new >= 0, None]
    rows = np.flatnonzero(free & (patch >= 0))
    # Where a point goes by a vector the volume grows by a sixth of that vector times this.
    facing = np.repeat(remesh.normals(points[after]), 3, axis=0)
    total = [np.bincount(after.ravel(), facing[:, k], len(points))[rows] for k in range(3)]
    size = np.linalg.norm(total, axis=0)
    normal, reach = np.stack(total, axis=1) / np.maximum(size, 1e-300)[:, None], most(points[rows])
    while len(rows):
        far, moved = np.zeros(count), points.copy()
        for _ in range(STEPS):
            lost = wanted - _volumes(moved - origin, after, new, count)
            gained = np.bincount(patch[rows], size / 6.0, count)
            far += np.divide(lost, gained, out=np.zeros(count), where=gained > 0)
            steps = np.clip(far[patch[rows]], -reach, reach)
            moved[rows] = points[rows] + steps[:, None] * normal
        goes = np.zeros(len(points), bool)
        goes[rows] = True
        fresh = goes[after].any(axis=1)
        wrong = find_faults(TriangleMesh(moved, after.astype(np.int32)), fresh) & fresh
        if not wrong.any():
            return moved
        # What is beside a fault stays too, so that facets do not turn there.
        near = np.zeros(len(points), bool)
        near[after[adjacent(wrong, after, len(points))]] = True
        stays = near[rows]
        rows, size, normal, reach = rows[~stays], size[~stays], normal[~stays], reach[~stays]
    return points


def _volumes(points: Floats, triangles: Ints, patch: Ints, count: int) -> Floats:
    """(count,) the volumes between patches and the origin, mm3; of patch -1 none is told."""
    rows = np.flatnonzero(patch >= 0)
    corners = points[triangles[rows]]
    cone = np.einsum("ij,ij->i", np.cross(corners[:, 0], corners[:, 1]), corners[:, 2]) / 6.0
    return np.bincount(patch[rows], cone, count).astype(np.float64, copy=False)

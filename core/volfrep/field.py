# SPDX-License-Identifier: LGPL-2.1-or-later
"""The depth below the surface of a solid, sampled at the corners of cubes where it matters."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .depth import Depth
from .mesh import TriangleMesh
from .octree import CORNERS, Leaves, find, name, named
from .voxels import column_crossings

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]

#: Whole numbers along a cube of the coarsest size: it can be halved three times, and the smallest
#: cubes' edges still have whole middles.
COARSEST = 32
#: So many of the largest cubes to begin the search with.
FIRST_CUBES = 4000
#: Leaves whose corners are sampled between two looks at the cancel button.
LEAVES_PER_STEP = 20_000
#: A cube's edges and diagonals, by their ends in `CORNERS`.
LINES = [(0, 1), (0, 2), (0, 4), (1, 3), (1, 5), (2, 3), (2, 6), (3, 7), (4, 5), (4, 6), (5, 7),
         (6, 7), (0, 7), (1, 6), (2, 5), (3, 4)]  # fmt: skip


class DepthField:
    """Samples of the depth, taken once a node.

    Nodes are whole numbers; `point` says where they are.
    """

    def __init__(self, solid: TriangleMesh, depth: Depth, cube: float) -> None:
        """Prepare for cubes of this size (mm) and its halves."""
        self.depth = depth
        self.unit = cube / COARSEST
        low, high = solid.bounds
        # The first and last nodes lie outside the wall, at no special place of the part.
        self._start = low + depth.inset - 0.3660254 * cube
        cubes = np.ceil((high - depth.inset - self._start) / cube).astype(np.int64) + 1
        self._top = 1
        while (cubes / self._top).prod() > FIRST_CUBES:
            self._top *= 2
        self._cubes = -(-cubes // self._top) * self._top
        self._names = np.zeros(0, np.int64)
        self._value = np.zeros(0)
        self._gradient = np.zeros((0, 3))
        # Which nodes are inside is known by the lines along z through them: the surface's
        # crossings, one after the other and line by line, as whole numbers.
        self._step = COARSEST // 2
        axes = [
            self._start[k] + self._step * self.unit * np.arange(2 * self._cubes[k] + 1)
            for k in range(3)
        ]
        i, j, z, step = column_crossings(solid, axes[0], axes[1], depth.monitor)
        crossing = self._line(i, j) + np.searchsorted(axes[2], z)
        order = depth.monitor.call(lambda: np.argsort(crossing, kind="stable"))
        self._crossing = crossing[order]
        self._winding = np.concatenate([[0], np.cumsum(step[order])])

    def _line(self, i: Ints, j: Ints) -> Ints:
        lines, nodes = 2 * self._cubes[1] + 1, 2 * self._cubes[2] + 2
        return np.asarray((i * lines + j) * nodes, np.int64)

    def _inside(self, nodes: Ints) -> Bools:
        """Which nodes are inside the solid; finer ones than the lines count as inside.

        Finer ones are asked for in cubes that the wall may cross only. These are so small
        that a node of theirs outside the solid is nearer to its surface than the wall.
        """
        lines = (nodes % self._step == 0).all(axis=1)
        i, j, k = (nodes[lines] // self._step).T
        line = self._line(i, j)
        above = self._winding[np.searchsorted(self._crossing, line + k, "right")]
        inside = np.ones(len(nodes), bool)
        inside[lines] = above > self._winding[np.searchsorted(self._crossing, line)]
        return inside

    def point(self, nodes: Floats | Ints) -> Floats:
        """(n, 3) where nodes are, mm."""
        return np.asarray(self._start + self.unit * nodes)

    def sample(self, nodes: Ints) -> tuple[Floats, Floats]:
        """Thickness less depth at nodes (n, 3), mm, and its gradients (n, 3).

        Below 0 inside the inner wall.
        """
        call = self.depth.monitor.call
        wanted = name(nodes)
        new = call(lambda: np.unique(wanted[find(self._names, wanted) < 0]))
        if len(new):
            fresh = named(new)
            value, gradient = self.depth.values(self.point(fresh), self._inside(fresh))
            place = np.searchsorted(self._names, new)
            self._names = np.insert(self._names, place, new)
            self._value = np.insert(self._value, place, value)
            self._gradient = np.insert(self._gradient, place, gradient, axis=0)
        rows = call(lambda: find(self._names, wanted))
        return self._value[rows], self._gradient[rows]

    def negative(self, leaves: Leaves) -> Bools:
        """(n, 8) which corners lie inside the inner wall."""
        parts = [self.sample(part.nodes().reshape(-1, 3))[0] for part in _parts(leaves)]
        return np.concatenate(parts).reshape(-1, 8) < 0

    def coarsest_leaves(self) -> Leaves:
        """The cubes of the coarsest size near the wall: all that it crosses, and neighbours.

        The depth changes by no more than the way, so that a cube is not crossed whose middle is
        farther from the wall than from its corners.
        """
        depth, top = self.depth, self._top
        spacing = depth.index.spacing
        cube = np.indices(self._cubes // top).reshape(3, -1).T * top
        while top > 1:
            middle = (cube + top // 2) * COARSEST
            inside = self._inside(middle)
            value = depth.values(self.point(middle), inside)[0]
            reach = 0.5 * np.sqrt(3.0) * top * COARSEST * self.unit
            # By so much the distance may be too long (`SurfaceIndex.near`).
            error = np.where(inside, depth.error, spacing)
            cube = cube[np.abs(value) <= reach + error]
            top //= 2
            cube = (cube[:, None] + top * CORNERS).reshape(-1, 3)
        return Leaves(cube * COARSEST, np.full(len(cube), COARSEST))

    def hide(self, leaves: Leaves, least: float) -> Bools:
        """(n,) whether a tongue of the cavity may lie in a leaf that its corners do not tell.

        Along an edge or a diagonal the planes below both ends meet at the deepest point. Where it
        lies deeper than the thickness and `least` (mm) and the ends do not, there is one.
        """
        return np.concatenate([self._hide(part, least) for part in _parts(leaves)])

    def _hide(self, leaves: Leaves, least: float) -> Bools:
        value, gradient = self.sample(leaves.nodes().reshape(-1, 3))
        value, gradient = value.reshape(-1, 8), gradient.reshape(-1, 8, 3)
        size = self.unit * leaves.size
        result = np.zeros(len(size), bool)
        for start, end in LINES:
            along = CORNERS[end] - CORNERS[start]
            a, b = value[:, start], value[:, end]
            down, up = size * (gradient[:, start] @ along), size * (gradient[:, end] @ along)
            between = (a >= 0) & (b >= 0) & (down < 0) & (up > 0)
            share = np.clip((b - up - a) / np.where(between, down - up, 1.0), 0.0, 1.0)
            result |= between & (a + share * down < -least)
        return result


def _parts(leaves: Leaves) -> list[Leaves]:
    """The leaves in parts of `LEAVES_PER_STEP`, at least one."""
    starts = range(0, max(len(leaves.size), 1), LEAVES_PER_STEP)
    return [leaves.chosen(slice(start, start + LEAVES_PER_STEP)) for start in starts]

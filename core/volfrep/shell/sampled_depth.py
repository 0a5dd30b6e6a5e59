# SPDX-License-Identifier: LGPL-2.1-or-later
"""The depth below the surface of a solid, sampled at the corners of cubes where it matters."""

from __future__ import annotations

import numpy as np

from ..mesh.triangle_mesh import TriangleMesh
from ..spatial.rays import column_crossings
from ..util.types import Bools, Floats, Ints
from .depth import Depth
from .octree import CORNERS, Leaves, find, name, named
from .smooth_regions import SmoothRegions

#: Whole numbers along a cube of the coarsest size: it can be halved three times, and the smallest
#: cubes' edges still have whole middles.
COARSEST = 32
#: No more lines than this are looked at to know which nodes are inside.
MOST_LINES = 200_000
#: Distances from large cubes' middles are too long by less than this (their edges), where the
#: surface is sampled no more densely than they need.
SAMPLED = 0.1
#: So many of the largest cubes to begin the search with.
FIRST_CUBES = 4000
#: Leaves whose corners are sampled between two looks at the cancel button.
LEAVES_PER_STEP = 20_000
#: A cube's edges and diagonals, by their ends in `CORNERS`.
LINES = [(0, 1), (0, 2), (0, 4), (1, 3), (1, 5), (2, 3), (2, 6), (3, 7), (4, 5), (4, 6), (5, 7),
         (6, 7), (0, 7), (1, 6), (2, 5), (3, 4)]  # fmt: skip


def cube_grid(low: Floats, high: Floats, inset: float, cube: float) -> tuple[Floats, Ints, int]:
    """Where cubes of a size lie in a box.

    Returns:
        (3,) the first one's lowest corner, mm; (3,) how many there are along each axis; and how
        many times as large the cubes are that the search begins with, a power of two.
    """
    # The first and last nodes lie outside the wall, at no special place of the part.
    start = low + inset - 0.3660254 * cube
    cubes = np.ceil((high - inset - start) / cube).astype(np.int64) + 1
    top = 1
    while (cubes / top).prod() > FIRST_CUBES:
        top *= 2
    return start, -(-cubes // top) * top, top


class DepthField:
    """Samples of the depth, taken once a node.

    Nodes are whole numbers; `point` says where they are.
    """

    def __init__(
        self, solid: TriangleMesh, depth: Depth, cube: float, plain: SmoothRegions | None = None
    ) -> None:
        """Prepare for cubes of this size (mm) and its halves; larger ones where it is plain."""
        self.depth = depth
        self.unit = cube / COARSEST
        low, high = solid.bounds
        self._start, self._cubes, self._top = cube_grid(low, high, depth.inset, cube)
        self._plain = plain
        # By rising names, and where the values of each are.
        self._names, self._rows = np.zeros((2, 0), np.int64)
        self._value = np.zeros(0)
        self._gradient = np.zeros((0, 3))
        # Which nodes are inside is known by the lines along z through them: the surface's
        # crossings, one after the other and line by line, as whole numbers.
        self._step = COARSEST // 2
        if plain is not None:
            while (self._cubes[:2] * COARSEST / self._step).prod() > MOST_LINES:
                self._step *= 2
        self._lines = -(-self._cubes * COARSEST // self._step) + 1
        axes = [
            self._start[k] + self._step * self.unit * np.arange(self._lines[k]) for k in range(3)
        ]
        i, j, z, step = column_crossings(solid, axes[0], axes[1], depth.monitor)
        crossing = self._line(i, j) + np.searchsorted(axes[2], z)
        order = depth.monitor.call(lambda: np.argsort(crossing, kind="stable"))
        self._crossing = crossing[order]
        self._winding = np.concatenate([[0], np.cumsum(step[order])])

    def _line(self, i: Ints, j: Ints) -> Ints:
        return np.asarray((i * self._lines[1] + j) * (self._lines[2] + 1), np.int64)

    def _inside(self, nodes: Ints) -> Bools:
        """Which nodes are inside the solid; finer ones than the lines count as inside.

        Finer ones are asked for in cubes that the wall may cross only. Where there is a line
        through each cube's middle, these are so small that a node of theirs outside the solid is
        nearer to its surface than the wall; else see `_values`.
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
        each, row = self.depth.monitor.call(lambda: np.unique(name(nodes), return_inverse=True))
        known = find(self._names, each)
        new = np.flatnonzero(known < 0)
        if len(new):
            value, gradient = self._values(named(each[new]))
            place = np.searchsorted(self._names, each[new])
            self._names = np.insert(self._names, place, each[new])
            self._rows = np.insert(self._rows, place, len(self._value) + np.arange(len(new)))
            self._value = np.concatenate([self._value, value])
            self._gradient = np.concatenate([self._gradient, gradient])
            known = find(self._names, each)
        row = self._rows[known][row.ravel()]
        return self._value[row], self._gradient[row]

    def _values(self, nodes: Ints) -> tuple[Floats, Floats]:
        """As `Depth.values`, at nodes (n, 3)."""
        inside = self._inside(nodes)
        if self._step <= COARSEST // 2:
            return self.depth.values(self.point(nodes), inside)
        off_lines = (nodes % self._step != 0).any(axis=1)
        return self.depth.values(self.point(nodes), inside, off_lines)

    def coarsest_leaves(self) -> Leaves:
        """The cubes of the coarsest size near the wall: all that it crosses, and neighbours.

        Larger ones where the surface is plain.

        The depth changes by no more than the way, so that a cube is not crossed whose middle is
        farther from the wall than from its corners.
        """
        depth, top = self.depth, self._top
        cube = np.indices(tuple((self._cubes // top).tolist())).reshape(3, -1).T * top
        large = [Leaves(np.zeros((0, 3), np.int64), np.zeros(0, np.int64))]
        while top > 1:
            middle = (cube + top // 2) * COARSEST
            size = top * COARSEST * self.unit
            value = self.sample(middle)[0]  # the middles are nodes of smaller cubes
            reach = 0.5 * np.sqrt(3.0) * size * depth.steepest
            # By so much the distance may be too long (`SurfaceIndex.near`).
            error = np.where(self._inside(middle), depth.error, depth.index.spacing)
            if self._plain is not None:
                error = np.maximum(error, SAMPLED * size)
            cube = cube[np.abs(value) <= reach + error]
            if self._plain is not None:
                plain = self._plain.tells(cube, top)
                large.append(Leaves(cube[plain] * COARSEST, np.full(plain.sum(), top * COARSEST)))
                cube = cube[~plain]
            top //= 2
            cube = (cube[:, None] + top * CORNERS).reshape(-1, 3)
        leaves = Leaves(cube * COARSEST, np.full(len(cube), COARSEST))
        for more in large:
            leaves = leaves.joined(more)
        return leaves

    def hide(self, leaves: Leaves, least: float) -> tuple[Bools, Bools]:
        """(n,) whether the surface may enter a leaf unseen; (n, 8) corners inside the inner wall.

        Along an edge or a diagonal the planes below both ends meet at the deepest point. Where it
        lies deeper than the thickness and `least` (mm) and the ends do not, there is one.
        """
        hide, negative = zip(*(self._hide(part, least) for part in _parts(leaves)), strict=True)
        return np.concatenate(hide), np.concatenate(negative)

    def _hide(self, leaves: Leaves, least: float) -> tuple[Bools, Bools]:
        value, gradient = self.sample(leaves.nodes().reshape(-1, 3))
        # A column for every corner: numpy takes rows of a few slowly.
        value = np.ascontiguousarray(value.reshape(-1, 8).T)
        gradient = np.ascontiguousarray(gradient.reshape(-1, 24).T).reshape(8, 3, -1)
        size = self.unit * leaves.size
        result = np.zeros(len(size), bool)
        for start, end in LINES:
            way = CORNERS[end] - CORNERS[start]
            a, b = value[start], value[end]
            down, up = (size * _along(gradient[node], way) for node in (start, end))
            between = (a >= 0) & (b >= 0) & (down < 0) & (up > 0)
            rows = np.flatnonzero(between)
            a, b, down, up = (each[rows] for each in (a, b, down, up))
            share = np.minimum(np.maximum((b - up - a) / (down - up), 0.0), 1.0)
            result[rows] |= a + share * down < -least
        return result, value.T < 0


def _along(columns: Floats, way: Ints) -> Floats:
    """(n,) how far vectors (3, n) go along a way of steps of 1, 0 or -1."""
    total: Floats = np.zeros(columns.shape[1])
    for axis in np.flatnonzero(way):
        total += way[axis] * columns[axis]
    return total


def _parts(leaves: Leaves) -> list[Leaves]:
    """The leaves in parts of `LEAVES_PER_STEP`, at least one."""
    starts = range(0, max(len(leaves.size), 1), LEAVES_PER_STEP)
    return [leaves.chosen(slice(start, start + LEAVES_PER_STEP)) for start in starts]

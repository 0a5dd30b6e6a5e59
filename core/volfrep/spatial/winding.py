# SPDX-License-Identifier: LGPL-2.1-or-later
"""Winding numbers of a closed surface, found along straight lines through it.

A line that crosses the surface goes in where it meets a face from outside and out where it meets
one from inside. Counted along a line, that is the winding number of every place on it, without
any tolerance; and over many lines, how much volume has which winding number. It does not depend
on how the mesh is connected, which makes it a judge of repairs.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..mesh.triangle_mesh import TriangleMesh
from ..util.linalg import frame_about, times
from ..util.threads import in_threads
from ..util.types import Bools, Floats, Ints
from .rays import lines_over

#: Lines on each side of the square grid of lines.
LINES = 64
#: Triangles looked at at once.
TRIANGLES_PER_STEP = 500_000
#: Bins that tell whether there is a line near a triangle are so many times finer.
FINER = 8


def _general_frame() -> Floats:
    """Three generic, perpendicular directions (columns), parallel to no usual face."""
    axis = np.array([0.267, 0.535, 0.802])
    return frame_about(axis)


FRAME = _general_frame()


@dataclass(frozen=True, eq=False)
class Windings:
    """What lines through a closed mesh have met.

    Attributes:
        volume: mm3 by winding number (only numbers that were met, without 0).
        odd: mm3 where the number is neither 0 nor 1.
        place: in the middle of the longest stretch of that kind; None where there is none.
        least, most: the smallest and the largest number met.
        lines: that met the solid; the error of a volume is about one part in their square root.
    """

    volume: dict[int, float]
    odd: float
    place: Floats | None
    least: int
    most: int
    lines: int

    @property
    def solid(self) -> float:
        """Volume with a positive winding number, mm3."""
        return sum(v for number, v in self.volume.items() if number > 0)


def windings(mesh: TriangleMesh, box: Floats | None = None) -> Windings:
    """The winding numbers inside a closed mesh, along a jittered grid of lines.

    Args:
        mesh: as many triangles run along each of its edges one way as the other.
        box: (2, 3) a box over which the lines stand, its own for None. In the same box they are
            the same lines: what two meshes enclose can be compared without a sampling error.
    """
    lines = Lines(mesh.bounds if box is None else box)
    return lines.windings(lines.near(mesh.vertices, mesh_blocks(mesh)))


def mesh_blocks(mesh: TriangleMesh) -> Iterator[NDArray[np.int32]]:
    """The triangles of a mesh, some at a time."""
    for begin in range(0, len(mesh.triangles), TRIANGLES_PER_STEP):
        yield mesh.triangles[begin : begin + TRIANGLES_PER_STEP]


class Lines:
    """A jittered grid of parallel lines over a box.

    Args:
        box: (2, 3) corners, mm.
    """

    def __init__(self, box: Floats) -> None:
        shadow = times(np.stack(np.meshgrid(*box.T), axis=-1).reshape(-1, 3), FRAME)[:, :2]
        low, high = shadow.min(axis=0), shadow.max(axis=0)
        self._low, self._step = low, np.maximum(high - low, 1e-300) / LINES
        jitter = np.random.default_rng(1).uniform(0.0, 1.0, (LINES, LINES, 2))
        grid = np.stack(np.meshgrid(np.arange(LINES), np.arange(LINES), indexing="ij"), axis=2)
        self._points = (low + (grid + jitter) * self._step).reshape(-1, 2)

    def bins(self, points: Floats) -> NDArray[np.int16]:
        """(2, n) the bins over which (n, 3) points lie, for `may_meet`."""
        count = LINES * FINER
        result = np.empty((2, len(points)), np.int16)

        def block(start: int) -> None:
            part = slice(start, start + TRIANGLES_PER_STEP)
            seen = (times(points[part], FRAME[:, :2]) - self._low) / (self._step / FINER)
            result[:, part] = np.clip(seen, 0, count - 1).T

        for _ in in_threads(block, range(0, len(points), TRIANGLES_PER_STEP)):
            pass
        return result

    def may_meet(self, bins: NDArray[np.int16], triangles: NDArray[np.int32]) -> Bools:
        """(m,) which triangles of points in bins a line may meet: few of small ones."""
        found = []
        for own in bins:
            a, b, c = (own[triangles[:, k]] for k in range(3))
            found += [np.minimum(np.minimum(a, b), c), np.maximum(np.maximum(a, b), c) + 1]
        x, right, y, top = found
        below = self._below
        meets: Bools = below[right, top] - below[x, top] - below[right, y] + below[x, y] > 0
        return meets

    @cached_property
    def _below(self) -> NDArray[np.int32]:
        """How many lines stand over the bins before each one, along both sides of the grid."""
        x, y = self._bins_of_lines
        count = np.zeros((LINES * FINER + 1,) * 2, np.int32)
        np.add.at(count, (x + 1, y + 1), 1)
        below: NDArray[np.int32] = count.cumsum(axis=0).cumsum(axis=1).astype(np.int32)
        return below

    @property
    def _bins_of_lines(self) -> Ints:
        """(2, k) the bin of every line."""
        seen = (self._points - self._low) / (self._step / FINER)
        bins: Ints = np.clip(seen, 0, LINES * FINER - 1).astype(np.int64).T
        return bins

    def near(self, points: Floats, blocks: Iterable[NDArray[np.int32]]) -> Iterator[Floats]:
        """(k, 3, 3) the corners of those triangles that a line may meet, some at a time, mm.

        Args:
            points: (n, 3), mm.
            blocks: (m, 3) triangles of them, some at a time.
        """
        bins = self.bins(points)
        waiting: list[NDArray[np.int32]] = []
        for each in blocks:
            waiting.append(each[self.may_meet(bins, each)])
            if sum(map(len, waiting)) > TRIANGLES_PER_STEP:
                yield points[np.concatenate(waiting)]
                waiting = []
        if waiting:
            yield points[np.concatenate(waiting)]

    def windings(self, blocks: Iterable[Floats]) -> Windings:
        """The winding numbers along them of a closed surface.

        Args:
            blocks: (k, 3, 3) corners of triangles, some at a time, mm; equal ones to the last bit
                where triangles share a vertex.
        """

        def met_by(corners: Floats) -> tuple[Ints, Ints, Floats, Ints]:
            return crossings(times(corners.reshape(-1, 3), FRAME).reshape(-1, 3, 3), self._points)

        met = list(in_threads(met_by, blocks))
        return _windings(met, self._points, self._step)


def _windings(met: list[tuple[Ints, Ints, Floats, Ints]], points: Floats, step: Floats) -> Windings:
    """What lines at (k, 2) points, so far apart, have met."""
    line, height, sign = (np.concatenate([found[k] for found in met]) for k in (0, 2, 3))
    # A line through an edge, as far as rounding tells, may have met one of its triangles only.
    whole = np.bincount(line, weights=sign, minlength=len(points)) == 0
    keep = whole[line]
    line, height, sign = line[keep], height[keep], sign[keep]
    order = np.lexsort((height, line))
    line, height = line[order], height[order]
    number = -np.cumsum(sign[order])[:-1]
    length = np.where(np.diff(line) == 0, np.diff(height), 0.0)
    area = float(step.prod()) * len(points) / max(np.count_nonzero(whole), 1)
    long = length > 0.0
    values, index = np.unique(number[long], return_inverse=True)
    totals = np.bincount(index.ravel(), weights=length[long], minlength=len(values)) * area
    volume = {int(v): float(t) for v, t in zip(values, totals, strict=True) if v != 0}
    wrong = np.where((number != 0) & (number != 1), length, 0.0)
    place = None
    if wrong.any():
        k = int(wrong.argmax())
        local = [*points[line[k]], (height[k] + height[k + 1]) / 2.0]
        place = times(np.array(local), FRAME.T)
    odd = float(wrong.sum()) * area
    bounds = [*volume, 0]
    lines = len(np.unique(line[:-1][long]))
    return Windings(volume, odd, place, min(bounds), max(bounds), lines)


def winding_by_shell(mesh: TriangleMesh, shell: Ints, points: Floats) -> tuple[Ints, Ints, Ints]:
    """The winding number of each shell round each point, where it is not 0.

    Args:
        mesh: closed shells.
        shell: (m,) the shell of each triangle.
        points: (k, 3), not on the shells that are to be told about.

    Returns:
        Points, shells and winding numbers, by point and then by shell.
    """
    corners = times(np.stack(mesh.corners(), axis=1), FRAME)
    local = times(points, FRAME)
    point, triangle, height, sign = crossings(corners, local[:, :2])
    above = height > local[point, 2]
    shells = int(shell.max()) + 1
    key = point[above] * shells + shell[triangle[above]]
    keys, index = np.unique(key, return_inverse=True)
    number = np.bincount(index.ravel(), weights=sign[above], minlength=len(keys)).astype(np.int64)
    keys, number = keys[number != 0], number[number != 0]
    return keys // shells, keys % shells, number


def crossings(corners: Floats, points: Floats) -> tuple[Ints, Ints, Floats, Ints]:
    """Where upright lines cross triangles.

    Args:
        corners: (m, 3, 3).
        points: (k, 2) where the lines stand.

    Returns:
        Lines, triangles, heights, and +1 where the line leaves (the triangle looks up), else -1.
    """
    none = np.zeros(0, np.int64)
    found = [(none, none, np.zeros(0), none)]
    found += [_cross(corners, points, *pair) for pair in lines_over(corners, points)]
    line, triangle, height, sign = (np.concatenate(each) for each in zip(*found, strict=True))
    return line, triangle, height, sign


def _cross(
    corners: Floats, points: Floats, triangle: Ints, line: Ints
) -> tuple[Ints, Ints, Floats, Ints]:
    p = points[line]
    a, b, c = (corners[triangle, k, :2] - p for k in range(3))
    # Twice the areas over which the line sees each side, from the line: they have the same value
    # with the opposite sign in the neighbour across.
    wa, wb, wc = (u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0] for u, v in ((b, c), (c, a), (a, b)))
    up = (wa > 0) & (wb > 0) & (wc > 0)
    down = (wa < 0) & (wb < 0) & (wc < 0)
    hit = np.flatnonzero(up | down)
    triangle, line = triangle[hit], line[hit]
    weights = np.stack([wa[hit], wb[hit], wc[hit]], axis=1)
    weights /= weights.sum(axis=1, keepdims=True)
    height = np.einsum("ij,ij->i", weights, corners[triangle, :, 2])
    return line, triangle, height, np.where(up[hit], 1, -1)

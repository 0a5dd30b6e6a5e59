# SPDX-License-Identifier: LGPL-2.1-or-later
"""Which triangles cross in a file, while vertices move.

Who may meet whom is found once, with some room: a look after a move takes only pairs of triangles
that moved; what left its room is searched for anew.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..mesh.precision import decimal_step, rounded
from ..mesh.triangle_mesh import TriangleMesh, compact, triangle_boxes
from ..util.progress import Monitor
from ..util.types import Bools, Floats, Ints
from .piercing import pairs_among, piercing_among
from .self_intersection import close_pairs

#: Triangles may move by so much of the median one's size before they are searched for anew.
ROOM = 0.15
#: The most cells along the longest side of the grid by which triangles near others are picked.
MOST_CELLS = 160


def crossing_in_files(mesh: TriangleMesh, pairs: Ints, step: float) -> Ints:
    """(k, 2) those of some pairs of triangles that cross in a binary file or in one of text.

    Args:
        mesh: any mesh, mm.
        pairs: (n, 2).
        step: of the decimals of the text, mm.
    """
    found = []
    for version in (mesh.vertices, rounded(mesh.vertices, step)):
        single = version.astype(np.float32).astype(np.float64)
        found.append(piercing_among(TriangleMesh(single, mesh.triangles), pairs))
    return np.concatenate(found)


class CrossingWatch:
    """Which triangles of a mesh may meet those that are watched.

    Args:
        mesh: any mesh, mm.
        watched: (m,) bool, triangles whose vertices will move first.
        monitor: asked for a cancel.
    """

    def __init__(self, mesh: TriangleMesh, watched: Bools, monitor: Monitor) -> None:
        self._triangles = mesh.triangles
        self._corners = np.ascontiguousarray(mesh.triangles.T)
        self._step = decimal_step(mesh.vertices)
        self._monitor = monitor
        self._box = _boxes(mesh.vertices, mesh.triangles)
        size = (self._box[:, 1] - self._box[:, 0]).max(axis=1)
        self._room = ROOM * float(np.median(size[watched])) + self._step
        self._watched = watched.copy()
        self._pairs = [self._close(watched)]

    def crossing(self, vertices: Floats, moved: Bools) -> Ints:
        """(k, 2) triangles that cross in a binary file or in one of text, once vertices moved.

        Args:
            vertices: (n, 3) where they are now, mm.
            moved: (n,) bool; at least one of each two triangles has such a vertex.

        Raises:
            Cancelled: when the monitor says so.
        """
        self._monitor.tick()
        a, b, c = (moved[corner] for corner in self._corners)
        among = a | b | c
        rows = np.flatnonzero(among)
        box, room = _boxes(vertices, self._triangles[rows]), self._room - self._step
        left = (box[:, 0] < self._box[rows, 0] - room) | (box[:, 1] > self._box[rows, 1] + room)
        out = left[:, 0] | left[:, 1] | left[:, 2] | ~self._watched[rows]
        if out.any():
            self._box[rows[out]] = box[out]
            gone = np.zeros(len(among), bool)
            gone[rows[out]] = True
            self._watched |= gone
            self._pairs.append(self._close(gone))
        pairs = [some[among[some[:, 0]] | among[some[:, 1]]] for some in self._pairs]
        # Neither rounding moves a coordinate by more than a step: few pairs need an exact look.
        chosen, used = np.concatenate(pairs), np.zeros(len(among), bool)
        used[chosen] = True
        number, some = np.cumsum(used, dtype=np.int32) - np.int32(1), np.flatnonzero(used)
        part = compact(TriangleMesh(vertices, self._triangles[some]))
        close = pairs_among(part, self._step, number[chosen])
        found = crossing_in_files(part, close, self._step)
        result: Ints = np.unique(some[found], axis=0)
        return result

    def _close(self, among: Bools) -> NDArray[np.int32]:
        """(k, 2) triangles whose boxes may meet, at least one of them chosen."""
        rows, found = self._about(among), [np.zeros((0, 2), np.int32)]
        number = rows.astype(np.int32)
        for a, b in close_pairs(self._box[rows], among[rows], self._room):
            self._monitor.tick()
            found.append(np.stack([number[a], number[b]], axis=1))
        return np.concatenate(found)

    def _about(self, among: Bools) -> Ints:
        """The triangles that may reach into cells of a grid that chosen ones reach into."""
        low, high = self._box[:, 0] - self._room, self._box[:, 1] + self._room
        least, most = low.min(axis=0), high.max(axis=0)
        size = max(
            float((high[among] - low[among]).max()), float((most - least).max()) / MOST_CELLS
        )
        first = ((low - least) / size).astype(np.int16)
        taken = np.zeros(((most - least) / size).astype(np.int64) + 2, bool)
        # A box no larger than a cell reaches into its first one and those that follow.
        for step in np.ndindex(2, 2, 2):
            taken[tuple((first[among] + np.array(step)).T)] = True
        near, padded = np.zeros_like(taken), np.pad(taken, ((0, 1),) * 3)
        for i, j, k in np.ndindex(2, 2, 2):
            near |= padded[i:, j:, k:][: near.shape[0], : near.shape[1], : near.shape[2]]
        x, y, z = (high - low).T
        result: Ints = np.flatnonzero(
            near[tuple(first.T)] | among | (x > size) | (y > size) | (z > size)
        )
        return result


def _boxes(vertices: Floats, triangles: NDArray[np.int32]) -> Floats:
    """(m, 2, 3) the lowest and the highest corners of triangles."""
    return np.stack([end.T for end in triangle_boxes(vertices.T, triangles.T)], axis=1)

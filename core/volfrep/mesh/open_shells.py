# SPDX-License-Identifier: LGPL-2.1-or-later
"""Shells of a surface that is made of parts: each part is measured where it is made, once.

What the parts come to is summed when they are joined, and what changes later is looked at alone.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..util.types import Bools, Floats, Ints
from .quality import Inspection, Quality, sizes
from .topology import edge_uses, pieces_of
from .triangle_mesh import TriangleMesh, compact

#: The point that cones are drawn from.
ORIGIN = np.zeros(3)


@dataclass(frozen=True, eq=False)
class OpenShells:
    """Shells of a mesh that uses each edge once each way, or once at all where it is open.

    Attributes:
        shell: (m,) unsigned, which one each triangle belongs to.
        volume: signed volume of each, of cones from the origin of coordinates, mm3.
        area: of all, mm2.
        degenerate: triangles, as of `Quality`.
    """

    shell: NDArray[np.unsignedinteger[Any]]
    volume: Floats
    area: float
    degenerate: int

    def of(self, rows: Ints) -> OpenShells:
        """The same, of the triangles in another order."""
        return replace(self, shell=self.shell[rows])

    def at(self, vertices: Ints, mesh: TriangleMesh) -> Ints:
        """(k,) the shells that some vertices of the mesh belong to."""
        shell = np.zeros(len(mesh.vertices), np.int64)
        for corner in mesh.triangles.T:
            shell[corner] = self.shell
        return shell[vertices]

    def inspection(self, mesh: TriangleMesh, open_edges: int) -> Inspection:
        """As of `inspect`, where it is known how many edges of the mesh, all in use, are open."""
        triangles, vertices = len(mesh.triangles), len(mesh.vertices)
        shells = int(np.count_nonzero(np.bincount(self.shell)))
        closed = not open_edges
        euler = vertices - (triangles + open_edges) // 2
        quality = Quality(
            triangles=triangles,
            vertices=vertices,
            watertight=closed,
            open_edges=open_edges,
            overused_edges=0,
            misoriented_edges=0,
            degenerate_triangles=self.degenerate,
            shells=shells,
            bodies=int(np.count_nonzero(self.volume > 0)),
            voids=int(np.count_nonzero(self.volume < 0)),
            genus=shells - euler // 2 if closed else -1,
            volume=float(self.volume.sum()),
            area=self.area,
            bounds=mesh.bounds,
        )
        return Inspection(quality, self.shell.astype(np.int32), self.volume)

    def rebuilt(
        self,
        before: TriangleMesh,
        after: TriangleMesh,
        origin: Ints,
        new: Bools,
        beside: Ints,
        number: NDArray[np.int32],
    ) -> OpenShells | None:
        """The same, after triangles went and others came.

        Args:
            before: the mesh that the shells are of.
            after: the mesh as it is now.
            origin: (m,) which triangle each was, or is in the place of.
            new: (m,) bool, those that were not there, or elsewhere.
            beside: those that share a vertex with new ones, and these.
            number: of each vertex of the mesh as it was, if it is in use.

        Returns:
            None where the new ones are not joined as those that went were.
        """
        gone = np.ones(len(before.triangles), bool)
        gone[origin[~new]] = False
        size, shell = len(after.vertices), self.shell[origin]
        old, fresh = before.triangles[gone], after.triangles[new]
        others = after.triangles[beside[~new[beside]]]
        border, was_border = _border(_ends(fresh)), _border(_ends(old))
        if border is None or was_border is None:
            return None
        keys = _keys(border, size)
        if not np.array_equal(np.sort(keys), np.sort(_keys(number[was_border], size))):
            return None
        # Where new ones meet each other they meet nothing else, and no two shells.
        inner = np.setdiff1d(_keys(_ends(fresh), size), keys)
        if np.isin(_keys(_ends(others), size), inner).any():
            return None
        if not _agree(after.triangles[beside], shell[beside]):
            return None
        was, now = (
            sizes(compact(TriangleMesh(mesh.vertices, rows)), ORIGIN)
            for mesh, rows in ((before, old), (after, fresh))
        )
        if now[3]:
            return None
        count = len(self.volume)
        volume = self.volume - np.bincount(self.shell[gone], was[0], count)
        volume += np.bincount(shell[new], now[0], count)
        area, degenerate = self.area + now[1] - was[1], self.degenerate + now[2] - was[2]
        return OpenShells(shell, volume, area, degenerate)


def open_shells(mesh: TriangleMesh) -> OpenShells | None:
    """The shells of a mesh, all of whose vertices are in use; None where it is not one of these."""
    if not len(mesh.triangles):
        return OpenShells(np.zeros(0, np.uint8), np.zeros(0), 0.0, 0)
    uses = edge_uses(mesh)
    volumes, area, degenerate, repeated = sizes(mesh, ORIGIN)
    if uses.overused or uses.misoriented or repeated:
        return None
    shell = uses.piece[mesh.triangles[:, 0]]
    volume = np.bincount(shell, volumes, uses.pieces).astype(np.float64)
    return OpenShells(shell.astype(np.min_scalar_type(uses.pieces)), volume, area, degenerate)


def joined_shells(parts: Sequence[OpenShells], first: Ints, second: Ints) -> OpenShells:
    """The shells of parts of a surface, whose edges go together where they are joined.

    Args:
        parts: one after the other.
        first: (k,) shells, counted through all parts.
        second: (k,) those that they are joined to.
    """
    begin = np.cumsum([0] + [len(part.volume) for part in parts])
    pairs = np.unique(first.astype(np.int64) * begin[-1] + second)
    first, second = np.divmod(pairs, max(begin[-1], 1))
    count, label = pieces_of(first, second, int(begin[-1]))
    label = label.astype(np.min_scalar_type(count))
    volume = np.concatenate([np.zeros(0), *(part.volume for part in parts)])
    return OpenShells(
        np.concatenate(
            [label[:0], *(label[k:][part.shell] for part, k in zip(parts, begin, strict=False))]
        ),
        np.bincount(label, volume, count).astype(np.float64),
        sum(part.area for part in parts),
        sum(part.degenerate for part in parts),
    )


def _ends(triangles: NDArray[np.int32]) -> NDArray[np.int32]:
    """(2, 3 m) where the sides of triangles start and end."""
    return np.stack([triangles.ravel(), np.roll(triangles, -1, axis=1).ravel()])


def _keys(ends: NDArray[np.int32], size: int) -> Ints:
    """A number for each side, between two of so many vertices, one way."""
    start, end = ends.astype(np.int64)
    result: Ints = start * size + end
    return result


def _border(ends: NDArray[np.int32]) -> NDArray[np.int32] | None:
    """(2, k) the sides that are run along one way only; None where some are twice the same way."""
    size = int(ends.max(initial=0)) + 1
    keys = _keys(ends, size)
    if len(np.unique(keys)) < len(keys):
        return None
    return ends[:, ~np.isin(keys, _keys(ends[::-1], size))]


def _agree(triangles: NDArray[np.int32], shell: NDArray[Any]) -> bool:
    """Whether triangles that share a vertex are of one shell."""
    _, first, vertex = np.unique(triangles, return_index=True, return_inverse=True)
    each = np.repeat(shell, 3)
    return bool((each == each[first][vertex.ravel()]).all())

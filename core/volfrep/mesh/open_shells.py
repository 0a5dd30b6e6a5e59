# SPDX-License-Identifier: LGPL-2.1-or-later
"""Shells of a surface that is made of parts: each part is measured where it is made, once.

What the parts come to is summed when they are joined, and what changes later is looked at alone.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..util.types import Floats, Ints
from .float32_repair import NO_REPAIR, Repair
from .quality import Inspection, Quality, present_shells, sizes
from .topology import corners_among, edge_uses, pieces_of, touching, vertices_of, ways_along
from .triangle_mesh import TriangleMesh

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
        triangles: how many there are.
        vertices: how many they use.
    """

    shell: NDArray[np.unsignedinteger[Any]]
    volume: Floats
    area: float
    degenerate: int
    triangles: int
    vertices: int

    def at(self, vertices: Ints, mesh: TriangleMesh, rows: Ints) -> Ints:
        """(k,) the shells that some vertices of the mesh belong to, which triangles `rows` have."""
        shell = np.zeros(len(mesh.vertices), np.int64)
        for corner in mesh.triangles[rows].T:
            shell[corner] = self.shell[rows]
        return shell[vertices]

    def inspection(self, mesh: TriangleMesh, open_edges: int) -> Inspection:
        """As of `inspect`, where it is known how many edges of the mesh are open."""
        shells = int(np.count_nonzero(present_shells(self.shell, len(self.volume))))
        closed = not open_edges
        euler = self.vertices - (self.triangles + open_edges) // 2
        quality = Quality(
            triangles=self.triangles,
            vertices=self.vertices,
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

    def repaired(self, mesh: TriangleMesh, repair: Repair, beside: Ints) -> OpenShells | None:
        """The same, measured after a repair; which shell each triangle belongs to is as it was.

        Args:
            mesh: that the shells are of.
            repair: what changes.
            beside: all triangles that stay and share a vertex with new ones.

        Returns:
            None where those that come are not joined as those that went were.
        """
        if not keeps_border(mesh, repair, beside):
            return None
        size, gone, fresh = len(mesh.vertices), repair.gone, repair.piece[repair.new]
        shell = self.shell[repair.old[repair.origin[repair.new]]]
        old, kept = mesh.triangles[gone], np.flatnonzero(~repair.new)
        kept = kept[touching(vertices_of(fresh, size), repair.piece[kept])]
        others = np.concatenate([mesh.triangles[beside], repair.piece[kept]])
        # Nowhere do they meet two shells.
        rows = np.concatenate([beside, repair.old[repair.origin[kept]]])
        if not _agree(np.concatenate([others, fresh]), np.concatenate([self.shell[rows], shell])):
            return None
        volume, area, degenerate = self.volume.copy(), self.area, self.degenerate
        for sign, which, part in (
            (-1, self.shell[gone], NO_REPAIR.some(mesh, old)), (1, shell, repair.some(mesh, fresh)),
        ):  # fmt: skip
            if not len(which):
                continue
            volumes, covered, flat, repeated = sizes(part, ORIGIN)
            if repeated:
                return None
            volume += sign * np.bincount(which, volumes, len(volume))
            area += sign * covered
            degenerate += sign * flat
        return OpenShells(
            self.shell, volume, area, degenerate,
            self.triangles + len(fresh) - len(gone), self.vertices - len(repair.unused),
        )  # fmt: skip


def open_shells(mesh: TriangleMesh) -> OpenShells | None:
    """The shells of a mesh, all of whose vertices are in use; None where it is not one of these."""
    if not len(mesh.triangles):
        return OpenShells(np.zeros(0, np.uint8), np.zeros(0), 0.0, 0, 0, 0)
    uses = edge_uses(mesh)
    volumes, area, degenerate, repeated = sizes(mesh, ORIGIN)
    if uses.overused or uses.misoriented or repeated:
        return None
    shell = uses.piece[mesh.triangles[:, 0]]
    volume = np.bincount(shell, volumes, uses.pieces).astype(np.float64)
    return OpenShells(
        shell.astype(np.min_scalar_type(uses.pieces)), volume, area, degenerate,
        len(mesh.triangles), len(mesh.vertices),
    )  # fmt: skip


def keeps_border(mesh: TriangleMesh, repair: Repair, beside: Ints) -> bool:
    """Whether triangles that come are bounded by the very sides that those that go were.

    And meet nothing else where they meet each other.

    Args:
        mesh: that is repaired.
        repair: what changes.
        beside: all triangles that stay and share a vertex with new ones.
    """
    size, fresh = len(mesh.vertices), repair.piece[repair.new]
    sides, were = _sides(fresh, size), _sides(mesh.triangles[repair.gone], size)
    if sides is None or were is None or not np.array_equal(sides.border, were.border):
        return False
    others = np.concatenate([mesh.triangles[beside], repair.piece[~repair.new]])
    # Most have no side between vertices of these.
    others = others[corners_among(vertices_of(fresh, size), others) > 1]
    return not np.isin(_ways(others, size), sides.inner).any()


def quality_after_repair(
    quality: Quality,
    mesh: TriangleMesh,
    repair: Repair,
    beside: Ints,
    bounds: Floats,
    least: float,
) -> Quality | None:
    """The quality of a surface after a repair of its mesh, by a look at what changes only.

    Args:
        quality: of the surface as it was.
        mesh: the part of it that is repaired; elsewhere it may go on.
        repair: what changes.
        beside: all triangles that stay and share a vertex with new ones.
        bounds: (2, 3) of the surface as it is then, mm.
        least: no shell of it enclosed less, mm3.

    Returns:
        None where those that come are not joined as those that went were, or a shell may have been
        turned inside out.
    """
    rows = np.union1d(repair.old, beside)
    used, local = np.unique(mesh.triangles[rows], return_inverse=True)
    part = TriangleMesh(mesh.vertices[used], local.reshape(-1, 3).astype(np.int32))
    small = Repair(
        np.searchsorted(rows, repair.old), np.searchsorted(used, repair.piece).astype(np.int32),
        repair.origin, repair.new, np.searchsorted(used, repair.moved), repair.places,
        np.searchsorted(used, repair.unused),
    )  # fmt: skip
    before = open_shells(part)
    after = before and before.repaired(part, small, np.searchsorted(rows, beside))
    if before is None or after is None:
        return None
    more, vertices = after.triangles - before.triangles, after.vertices - before.vertices
    swept = after.volume - before.volume
    if more != 2 * vertices or not float(np.abs(swept).sum()) < least:  # a handle has gone, or that
        return None
    return replace(
        quality,
        triangles=quality.triangles + more,
        vertices=quality.vertices + vertices,
        degenerate_triangles=quality.degenerate_triangles + after.degenerate - before.degenerate,
        volume=quality.volume + float(swept.sum()),
        area=quality.area + after.area - before.area,
        bounds=bounds,
    )


def joined_shells(
    parts: Sequence[OpenShells], first: Ints, second: Ints, vertices: int
) -> OpenShells:
    """The shells of parts of a surface, whose edges go together where they are joined.

    Args:
        parts: one after the other.
        first: (k,) shells, counted through all parts.
        second: (k,) those that they are joined to.
        vertices: how many there are together.
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
        sum(part.triangles for part in parts),
        vertices,
    )


class _Sides(NamedTuple):
    """The ways along the edges of some triangles, ascending.

    Attributes:
        border: of edges that are run along one way only.
        inner: of the others.
    """

    border: Ints
    inner: Ints


def _ways(triangles: NDArray[np.int32], size: int) -> Ints:
    """As of `ways_along`, for each side of triangles of so many vertices."""
    a, b, c = (np.ascontiguousarray(triangles[:, k]) for k in range(3))
    return np.concatenate([ways_along(*ends, size) for ends in ((a, b), (b, c), (c, a))])


def _sides(triangles: NDArray[np.int32], size: int) -> _Sides | None:
    """The sides of triangles of so many vertices; None where some are twice along one way."""
    ways = np.sort(_ways(triangles, size))
    if (ways[1:] == ways[:-1]).any():
        return None
    first = np.flatnonzero((ways[1:] ^ ways[:-1]) == 1)
    both = np.zeros(len(ways), bool)
    both[first] = both[first + 1] = True
    return _Sides(ways[~both], ways[both])


def _agree(triangles: NDArray[np.int32], shell: NDArray[Any]) -> bool:
    """Whether triangles that share a vertex are of one shell."""
    last = np.zeros(int(triangles.max(initial=-1)) + 1, shell.dtype)
    for corner in triangles.T:
        last[corner] = shell
    return all(np.array_equal(last[corner], shell) for corner in triangles.T)

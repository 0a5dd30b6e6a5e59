# SPDX-License-Identifier: LGPL-2.1-or-later
"""Strut masks: which struts of the lattice an octant's own are, and octants that lack some.

A kind is then a pattern and the set of struts that it lacks, so that what stays is as exact as
before, at the cost of one more kind for each set.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..design.cells import NODE_TOLERANCE, UnitCell
from ..grid.strut_graph import CellGraph
from ..octants.octant import (
    NEIGHBOURS,
    OctantGrid,
    OctantKey,
    cell_copies,
    corner_patterns,
    frames,
    reaches_octant,
)
from ..util.errors import VolfrepError
from ..util.types import Bools, Floats, Ints, Periodic

#: Octants that are told apart at a time.
CHUNK_OCTANTS = 20_000
#: Kinds of octant that a lattice may have (their numbers are int16).
MOST_KINDS = 30_000


def cells_of_nodes(cell: UnitCell, key: OctantKey, nodes: Floats) -> Ints:
    """(n,) bit number of the first of an octant's cells that each node is one of.

    Args:
        cell: the unit cell.
        key: of the octant.
        nodes: (n, 3) some of its nodes in its frame, in units of L.
    """
    active = key.active
    local = nodes[:, None] - NEIGHBOURS[active]
    reflect = np.array([key.mirror >> axis & 1 for axis in range(3)], bool)
    own = np.where(reflect, 1.0 - cell.nodes, cell.nodes)
    gap = np.abs(local[:, :, None] - own).max(axis=3).min(axis=2)
    result: Ints = active[(gap < NODE_TOLERANCE).argmax(axis=1)]
    return result


@dataclass(frozen=True, eq=False)
class NodeLookup:
    """Finds the nodes of a kind of octant in the whole, wherever it lies.

    Attributes:
        copy: (k,) bit number of the cell of `octant.NEIGHBOURS` that each node is of.
        local: (8, k) its index in the unit cell, by how the octant's frame is reflected.
    """

    copy: Ints
    local: Ints

    @staticmethod
    def of(cell: UnitCell, key: OctantKey, copy: Ints, place: Floats) -> NodeLookup:
        """Of nodes at (k, 3) places in their cells, in units of L, as seen in the frame."""
        steps = round(1.0 / NODE_TOLERANCE)
        names = {
            tuple(n): i for i, n in enumerate(np.round(cell.nodes * steps).astype(int).tolist())
        }
        local = np.zeros((8, len(copy)), np.int64)
        for mirror in range(8):
            if not cell.is_mirror_symmetric and mirror != key.mirror:
                continue
            reflect = np.array([mirror >> axis & 1 for axis in range(3)], bool)
            turned = np.where(reflect, 1.0 - place, place)
            local[mirror] = [names[tuple(n)] for n in np.round(turned * steps).astype(int).tolist()]
        return NodeLookup(copy, local)

    def rows(self, graph: CellGraph, place: Ints, periodic: Periodic) -> Ints:
        """(p, k) the nodes of the whole that the octant's are, where it lies at p places."""
        sign = frames(place)[1]
        cells = (place - 1) // 2 + graph.first
        cells = cells[:, None, :] + sign[:, None, :] * NEIGHBOURS[self.copy]
        for axis in np.flatnonzero(periodic):
            cells[:, :, axis] %= graph.row.shape[axis]
        row = graph.row[tuple(np.moveaxis(cells, -1, 0))]
        if (row < 0).any():
            raise RuntimeError("an octant hangs on a cell that is not in the graph")
        mirror = ((sign < 0) * np.array([1, 2, 4])).sum(axis=1)
        result: Ints = graph.node_of[row, self.local[mirror]].astype(np.int64)
        return result


def without_struts(
    grid: OctantGrid, cell: UnitCell, graph: CellGraph, kept: Bools, radius: float, joined: bool
) -> OctantGrid:
    """The octants of a lattice that lacks some of its struts.

    Args:
        grid: the octants of the whole lattice.
        cell: the unit cell.
        graph: of all the cells that the octants see.
        kept: (m,) which of its struts stay.
        radius: how near a strut must come to an octant to matter to it, mm.
        joined: whether struts that meet those at a joint matter as well.

    Raises:
        VolfrepError: there are too many kinds of octant.
    """
    ends = np.sort(graph.struts.astype(np.int64), axis=1)
    strut_key = ends[:, 0] * len(graph.nodes) + ends[:, 1]
    order = np.argsort(strut_key)
    loses = np.zeros(len(graph.nodes), bool)
    loses[graph.struts[~kept]] = True
    touched = np.zeros(graph.row.shape, bool)
    touched[graph.row >= 0] = loses[graph.node_of].any(axis=1)
    touched = touched[tuple(slice(n, -n or None) for n in graph.first.tolist())]
    near = corner_patterns(touched, grid.periodic) > 0

    kinds = {key: number for number, key in enumerate(grid.keys)}
    kind = grid.kind.copy()
    for number, key in enumerate(grid.keys):
        nodes, own = cell_copies(cell, NEIGHBOURS[key.active], key.mirror)
        matters = reaches_octant(nodes, own, radius / grid.cell_size)
        if joined:
            matters = np.isin(own, own[matters]).any(axis=1)
        index = np.flatnonzero(matters)
        used, local = np.unique(own[index], return_inverse=True)
        copy = cells_of_nodes(cell, key, nodes[used])
        lookup = NodeLookup.of(cell, key, copy, nodes[used] - NEIGHBOURS[copy])
        places = np.argwhere((grid.kind == number) & near)
        for begin in range(0, len(places), CHUNK_OCTANTS):
            part = places[begin : begin + CHUNK_OCTANTS]
            rows = lookup.rows(graph, part, grid.periodic)[:, local.reshape(-1, 2)]
            rows.sort(axis=2)
            wanted = rows[:, :, 0] * len(graph.nodes) + rows[:, :, 1]
            strut = order[np.searchsorted(strut_key, wanted, sorter=order)]
            patterns, of_place = np.unique(~kept[strut], axis=0, return_inverse=True)
            found = [
                kinds.setdefault(
                    replace(key, missing=sum(1 << int(k) for k in index[pattern])), len(kinds)
                )
                for pattern in patterns
            ]
            if len(kinds) > MOST_KINDS:
                raise VolfrepError(
                    f"So many struts go that more than {MOST_KINDS:,} kinds of joint are left: "
                    "enlarge the cells, or keep struts with free ends."
                )
            kind[tuple(part.T)] = np.array(found)[of_place.ravel()]
    return replace(grid, keys=list(kinds), kind=kind)

# SPDX-License-Identifier: LGPL-2.1-or-later
"""The lattice as a graph: the unique nodes and struts of cells."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ..design.cells import NODE_TOLERANCE, UnitCell, joint_radius
from ..mesh.triangle_mesh import TriangleMesh
from ..util.packages import make_frame
from ..util.ragged import table_of
from ..util.types import Bools, Floats, Ints

if TYPE_CHECKING:
    import pandas

#: Struts looked at in one step (bounds the memory).
STRUTS_PER_STEP = 1 << 16


@dataclass(frozen=True, eq=False)
class Graph:
    """Nodes and struts, each once.

    Attributes:
        nodes: (n, 3) float64, mm.
        struts: (m, 2) int32, rows of `nodes`.
    """

    nodes: Floats
    struts: NDArray[np.int32]

    @property
    def genus(self) -> int:
        """Independent loops if the graph is in one piece: struts - nodes + 1."""
        return len(self.struts) - len(self.nodes) + 1

    def lengths(self) -> Floats:
        """(m,) of the struts, mm."""
        result = np.empty(len(self.struts))
        for start in range(0, len(result), STRUTS_PER_STEP):
            part = slice(start, start + STRUTS_PER_STEP)
            ends = self.nodes[self.struts[part]]
            result[part] = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
        return result


@dataclass(frozen=True, eq=False)
class Wireframe(Graph):
    """The lattice in the part: what its nodes and struts are, and how thick.

    Attributes:
        radii: (m, 2) float64, radius of each strut at its two ends, mm: it is a cone where they
            differ.
        joint_radii: (n,) float64, radius of the joint sphere of each node, mm.

    >>> from volfrep.design.cells import find_cell
    >>> graph = cell_graph(find_cell("Box"), np.ones((2, 1, 1), bool), 10.0, np.zeros(3))
    >>> lattice = wireframe(graph, graph.nodes, np.full(len(graph.nodes), 1.0), 10.0)
    >>> lattice.nodes.shape, lattice.struts.shape, lattice.genus
    ((12, 3), (20, 2), 9)
    >>> float(lattice.joint_radii.max())
    1.1
    """

    radii: Floats
    joint_radii: Floats

    def to_frame(self) -> pandas.DataFrame:
        """A row for each strut: nodes, places, length and radii, mm; needs pandas.

        Raises:
            VolfrepError: pandas is missing.

        >>> import volfrep
        >>> part = volfrep.block((1, 1, 1), cell="BCC", cell_size=10, strut_radius=1)
        >>> part.struts.to_frame()["length"].round(2).unique().tolist()  # doctest: +SKIP
        [8.66]
        """
        ends = self.nodes[self.struts]
        columns: dict[str, Any] = {"node": self.struts[:, 0], "other_node": self.struts[:, 1]}
        columns |= {name: ends[:, 0, k] for k, name in enumerate("xyz")}
        columns |= {f"other_{name}": ends[:, 1, k] for k, name in enumerate("xyz")}
        radii = {"radius": self.radii[:, 0], "other_radius": self.radii[:, 1]}
        return make_frame({**columns, "length": self.lengths(), **radii})


#: The struts of what has none.
NO_STRUTS = Wireframe(np.zeros((0, 3)), np.zeros((0, 2), np.int32), np.zeros((0, 2)), np.zeros(0))


@dataclass(frozen=True, eq=False)
class CellGraph(Graph):
    """A graph in lattice space, and which of its nodes is which of a cell's.

    Attributes:
        row: (nx, ny, nz) int32, row of a cell in `node_of`; -1 for one that is not of it.
        node_of: (cells, k) int32, the nodes of each cell in the unit cell's order.
        first: (3,) index in `row` of the first cell of the grid that the lattice is laid on.
    """

    row: NDArray[np.int32]
    node_of: NDArray[np.int32]
    first: NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class BeamModel:
    """A lattice of beams, cut and joined to its skin; mm.

    Attributes:
        lattice: the nodes and struts, with their radii.
        clip: closed mesh; what of the lattice lies outside it is cut off. None: nothing is.
        skin: closed mesh that the lattice is joined to; None for none.
        warnings: sentences for the user.
        loose: what is to be said of pieces that hang on nothing, where no mesh says it.
    """

    lattice: Wireframe
    clip: TriangleMesh | None = None
    skin: TriangleMesh | None = None
    warnings: tuple[str, ...] = ()
    loose: tuple[str, ...] = ()


def cell_graph(
    cell: UnitCell,
    cells: Bools,
    cell_size: float,
    origin: Floats,
    periodic: tuple[bool, bool, bool] = (False, False, False),
    first: tuple[int, int, int] = (0, 0, 0),
) -> CellGraph:
    """The graph of some cells of a grid.

    Args:
        cell: the unit cell.
        cells: (nx, ny, nz) bool, the cells that it consists of.
        cell_size: L in mm.
        origin: (3,) lowest corner of the grid in mm.
        periodic: axes along which the last cell is followed by the first one.
        first: cells that were added to the grid below its first one.
    """
    index = np.argwhere(cells)
    # A node is identified by whole numbers: the cell it begins in and its place there, so that
    # a node on a cell's far side is one on the near side of the next cell.
    steps = round(1.0 / NODE_TOLERANCE)
    local = np.round(cell.nodes * steps).astype(np.int64)
    places, place_of = np.unique(local % steps, axis=0, return_inverse=True)
    whole = index[:, None, :] + (local // steps)[None, :, :]
    for axis in np.flatnonzero(periodic):
        whole[:, :, axis] %= cells.shape[axis]
    shape = np.array(cells.shape) + 1
    packed = np.ravel_multi_index(tuple(np.moveaxis(whole, -1, 0)), tuple(shape))
    del whole
    packed *= len(places)
    packed += place_of.ravel()
    # All places of the grid are few enough for a look at each, which is quicker than to sort.
    used = np.zeros(int(shape.prod()) * len(places), bool)
    used[packed] = True
    unique = np.flatnonzero(used)
    node_of = (np.cumsum(used, dtype=np.int32) - np.int32(1))[packed]
    del packed, used
    corner = np.stack(np.unravel_index(unique // len(places), tuple(shape)), axis=1)
    nodes = origin + cell_size * (corner + places[unique % len(places)] / steps)
    del corner

    a, b = (node_of[:, cell.struts[:, end]].ravel() for end in (0, 1))
    key = np.minimum(a, b).astype(np.int64) * len(unique)
    key += np.maximum(a, b)
    del a, b
    key.sort()
    key = key[np.diff(key, prepend=-1) > 0]
    struts = np.empty((len(key), 2), np.int32)
    struts[:, 0], struts[:, 1] = key // len(unique), key % len(unique)
    row = np.full(cells.shape, -1, np.int32)
    row[cells] = np.arange(len(index))
    return CellGraph(nodes, struts, row, node_of, np.array(first, np.int64))


def struts_of(graph: CellGraph, cell: UnitCell, cells: NDArray[np.int32]) -> Bools:
    """(m,) which struts of a graph belong to one of some cells, given by their rows."""
    count = len(graph.nodes)
    ends = np.sort(graph.node_of[cells][:, cell.struts].reshape(-1, 2).astype(np.int64), axis=1)
    own = np.sort(graph.struts.astype(np.int64), axis=1)
    result: Bools = np.isin(own[:, 0] * count + own[:, 1], ends[:, 0] * count + ends[:, 1])
    return result


def select_struts(lattice: Wireframe, struts: Bools | Ints) -> Wireframe:
    """Some of the struts of a wireframe, (m,) bool or (k,) rows, and their nodes."""
    used, rows = np.unique(lattice.struts[struts], return_inverse=True)
    return Wireframe(
        lattice.nodes[used],
        rows.reshape(-1, 2).astype(np.int32),
        lattice.radii[struts],
        lattice.joint_radii[used],
    )


def wireframe(graph: CellGraph, points: Floats, radius: Floats, cell_size: float) -> Wireframe:
    """The struts and joints of a graph in the part.

    Args:
        graph: its nodes and struts.
        points: (n, 3) where the nodes lie in the part, mm.
        radius: (n,) radius of the struts where they end at each node, mm.
        cell_size: L in mm.
    """
    return Wireframe(points, graph.struts, radius[graph.struts], joint_radius(radius, cell_size))


def neighbour_table(struts: NDArray[np.int32] | Ints, count: int) -> Ints:
    """(count, k) the other ends of the struts at every node; -1 where it has fewer than k."""
    start = np.concatenate([struts[:, 0], struts[:, 1]]).astype(np.int64)
    end = np.concatenate([struts[:, 1], struts[:, 0]]).astype(np.int64)
    half = table_of(start, count)
    return np.where(half < 0, -1, end[half])

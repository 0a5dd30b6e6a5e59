# SPDX-License-Identifier: LGPL-2.1-or-later
"""The sizes that a lattice came out with: of its cells' edges and of its struts."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..util.linalg import determinants
from ..util.types import Bools
from .cell_grid import CellGrid
from .coordinate_map import CoordinateMap
from .strut_graph import Wireframe

Range = tuple[float, float]


@dataclass(frozen=True)
class Sizes:
    """The smallest and the largest of each, in mm.

    Attributes:
        cell_edges: straight distances between neighbouring corners of the active cells.
        strut_lengths: straight distances from node to node, before trimming.
        strut_radii: of the struts at their ends.
    """

    cell_edges: Range
    strut_lengths: Range
    strut_radii: Range


def sizes(
    cell_size: float,
    cells: CellGrid | None,
    active: Bools | None,
    mapping: CoordinateMap | None,
    frame: Wireframe,
) -> Sizes:
    """The sizes of a lattice.

    Args:
        cell_size: L, mm.
        cells: the grid; None: the lattice has no cells.
        active: (nx, ny, nz) bool, those that hold a lattice; at least one.
        mapping: from lattice space to the part; None where they are the same.
        frame: the struts of the active cells, in the part; walls have none, of size 0.
    """
    edges = (cell_size, cell_size)
    if cells is not None and active is not None and not (mapping is None or mapping.is_rigid):
        edges = _cell_edges(cells, active, mapping)
    span = frame.nodes[frame.struts[:, 1]] - frame.nodes[frame.struts[:, 0]]
    return Sizes(edges, _range(np.linalg.norm(span, axis=1)), _range(frame.radii))


def mapped_volume(cells: CellGrid, mapping: CoordinateMap) -> float:
    """Volume of a whole grid in the part, mm3, by two Gauss points along each axis of a cell."""
    places = 0.5 + np.array([-0.5, 0.5]) / np.sqrt(3.0)
    inside = np.stack(np.meshgrid(places, places, places), axis=-1).reshape(-1, 3)
    index = np.argwhere(np.ones(cells.shape, bool))
    points = cells.origin + cells.cell_size * (index[:, None, :] + inside).reshape(-1, 3)
    growth = determinants(mapping.jacobians(points))
    return float(growth.mean() * cells.cells * cells.cell_size**3)


def _cell_edges(cells: CellGrid, active: Bools, mapping: CoordinateMap) -> Range:
    """Every edge of the active cells once, by its two corners in the part."""
    used = _spread(active, (0, 1, 2))
    number = np.full(used.shape, -1, np.int64)
    number[used] = np.arange(np.count_nonzero(used))
    placed = mapping.to_part(cells.origin + cells.cell_size * np.argwhere(used))
    found = []
    for axis in range(3):
        first, second, third = np.nonzero(_spread(active, [k for k in range(3) if k != axis]))
        ends = np.stack([first, second, third])
        start = number[tuple(ends)]
        ends[axis] += 1
        length = np.linalg.norm(placed[number[tuple(ends)]] - placed[start], axis=1)
        found.append(_range(length))
    return min(low for low, _ in found), max(high for _, high in found)


def _spread(cells: Bools, axes: tuple[int, ...] | list[int]) -> Bools:
    """What stands between cells along some axes: true where a cell beside it is."""
    for axis in axes:
        width = [(int(k == axis), int(k == axis)) for k in range(3)]
        padded = np.pad(cells, width)
        count = padded.shape[axis] - 1
        before = np.take(padded, range(count), axis)
        cells = before | np.take(padded, range(1, count + 1), axis)
    return cells


def _range(values: NDArray[np.float64]) -> Range:
    if not values.size:
        return 0.0, 0.0
    return float(values.min()), float(values.max())

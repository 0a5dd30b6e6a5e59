# SPDX-License-Identifier: LGPL-2.1-or-later
"""The lattice as a graph: the unique nodes and struts of the active cells."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .cells import NODE_TOLERANCE, UnitCell
from .frep import joint_radius


@dataclass(frozen=True, eq=False)
class Wireframe:
    """Nodes and struts, each once.

    Attributes:
        nodes: (n, 3) float64, mm.
        struts: (m, 2) int32, rows of `nodes`.
        radii: (m, 2) float64, radius of each strut at its two ends, mm: it is a cone where they
            differ.
        joint_radii: (n,) float64, radius of the joint sphere of each node, mm.
    """

    nodes: NDArray[np.float64]
    struts: NDArray[np.int32]
    radii: NDArray[np.float64]
    joint_radii: NDArray[np.float64]

    @property
    def genus(self) -> int:
        """Independent loops if the graph is in one piece: struts - nodes + 1."""
        return len(self.struts) - len(self.nodes) + 1


def wireframe(
    cell: UnitCell,
    active: NDArray[np.bool_],
    cell_size: float,
    origin: NDArray[np.float64],
    strut_radius: float,
) -> Wireframe:
    """The unique nodes and struts of the active cells.

    Args:
        cell: the unit cell.
        active: (nx, ny, nz) bool, the cells that hold a lattice.
        cell_size: L in mm.
        origin: (3,) lowest corner of the grid in mm.
        strut_radius: r, of every strut, in mm.
    """
    index = np.argwhere(active)
    # A node is identified by whole numbers: the cell it begins in and its place there, so that
    # a node on a cell's far side is one on the near side of the next cell.
    steps = round(1.0 / NODE_TOLERANCE)
    local = np.round(cell.nodes * steps).astype(np.int64)
    places, place_of = np.unique(local % steps, axis=0, return_inverse=True)
    whole = index[:, None, :] + (local // steps)[None, :, :]
    shape = np.array(active.shape) + 1
    packed = np.ravel_multi_index(tuple(np.moveaxis(whole, -1, 0)), tuple(shape))
    packed = packed * len(places) + place_of.ravel()[None, :]
    unique, inverse = np.unique(packed.ravel(), return_inverse=True)
    inverse = inverse.reshape(packed.shape)
    corner = np.stack(np.unravel_index(unique // len(places), tuple(shape)), axis=1)
    nodes = origin + cell_size * (corner + places[unique % len(places)] / steps)

    ends = inverse[:, cell.struts]  # (cells, struts, 2)
    ends = np.sort(ends.reshape(-1, 2), axis=1)
    strut_keys = np.unique(ends[:, 0] * len(unique) + ends[:, 1])
    struts = np.stack([strut_keys // len(unique), strut_keys % len(unique)], axis=1)
    return Wireframe(
        nodes,
        struts.astype(np.int32),
        np.full(struts.shape, float(strut_radius)),
        np.full(len(nodes), joint_radius(strut_radius, cell_size)),
    )

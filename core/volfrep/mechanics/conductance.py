# SPDX-License-Identifier: LGPL-2.1-or-later
"""Heat and electricity through the endless lattice, on the voxels of a stiffness solution."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from ..util.types import Floats
from .assembly import assemble, look_back, solve
from .elements import CORNERS, PARTS, gradients, part_centres
from .homogenise import Grid


def conductance(grid: Grid) -> Floats:
    """(3, 3) conductivity of the lattice over the solid's, on one grid: from above.

    Args:
        grid: a solution of the stiffness, whose voxels are taken.
    """
    voxels, nodes = grid.voxels, grid.nodes
    stiffness, load = _element()
    system = assemble(voxels, nodes, stiffness, load)
    free = np.ones_like(system.loads)
    if voxels.octant:
        # Across a mirror that the gradient points through, the temperature is the mean one.
        free[(nodes.place == 0) | (nodes.place == nodes.last)] = 0.0
    octants = 8 if voxels.octant else 1
    uniform = np.full(3, voxels.relative_density * voxels.along**3 / octants)
    found = solve(system, -system.loads, uniform, free, look_back=look_back(voxels))
    crossed = system.loads.T @ found
    inner = crossed + crossed.T + found.T @ (system.matrix @ found)
    result = np.eye(3) * voxels.relative_density + octants * inner / voxels.along**3
    if voxels.octant:
        result *= np.eye(3)
    return np.asarray(result)


@lru_cache(maxsize=1)
def _element() -> tuple[Floats, Floats]:
    """(parts, 8, 8) conductances of an element's parts and (parts, 8, 3) loads."""
    offsets = (CORNERS - 0.5) / (np.sqrt(3.0) * PARTS)
    points = (part_centres()[:, None] + offsets).reshape(-1, 3)
    slopes = gradients(points).reshape(-1, 8, 8, 3)  # parts, points, nodes, axes
    weight = 1.0 / (8 * PARTS**3)
    return np.einsum("pqia,pqja->pij", slopes, slopes) * weight, slopes.sum(axis=1) * weight

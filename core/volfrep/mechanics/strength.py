# SPDX-License-Identifier: LGPL-2.1-or-later
"""The stress in the solid under a macroscopic stress: when the lattice begins to yield."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..util.types import Floats
from .elements import part_centres, solid_stiffness, strain_matrices, von_mises
from .homogenise import CUBIC_STRAINS, Grid
from .tensor import compliance

#: The names of the six macroscopic stresses, in Voigt's order.
STRESSES = ("xx", "yy", "zz", "yz", "xz", "xy")
#: The share of the solid that may be stressed higher. The sharp edges between struts have no
#: largest stress: it grows as long as voxels become smaller, in ever less of the solid.
EXCEPTED = 0.01
#: A macroscopic stress of which more than this part is missing is not carried.
_LOST = 1e-3


@dataclass(frozen=True, eq=False)
class Stresses:
    """Von Mises stress in the solid per unit of macroscopic stress.

    Attributes:
        names: of the macroscopic stresses.
        largest: (n,) stress that all but `EXCEPTED` of the solid stays below; infinite for a
            macroscopic stress that the lattice does not carry.
        peak: (n,) the largest found at all, which depends on the voxels.
    """

    names: tuple[str, ...]
    largest: Floats
    peak: Floats


def stresses(grid: Grid, poisson: float) -> Stresses:
    """The von Mises stress of the solid under each macroscopic stress.

    At the middle of each voxel's solid part, where a trilinear element is at its best. A cubic
    cell has two stresses that differ: a pull along x and a shear.

    Args:
        grid: a solution.
        poisson: the solid's ratio, as it was solved with.
    """
    soft = compliance(grid.tensor)
    names: tuple[str, ...]
    if len(grid.strains) == 6:
        names, applied = STRESSES, soft
    else:
        names = ("xx", "yz")
        along, across = soft[0, 0], soft[1, 0]
        parts = ((along + 2 * across) / 3, (along - across) / 1.5, 0.0)
        applied = np.array([parts, (0.0, 0.0, soft[3, 3])]).T
    strains = (CUBIC_STRAINS if len(grid.strains) == 3 else np.eye(6)).T @ applied  # (6, n)
    displacement = grid.fluctuation @ applied
    voxels = grid.voxels
    middle = np.full((len(voxels.index), 3), 0.5)
    weight = voxels.shares
    middle[~voxels.full] = (voxels.parts @ part_centres()) / voxels.parts.sum(axis=1)[:, None]
    unknown = (3 * grid.nodes.of_voxels[:, :, None] + np.arange(3)).reshape(-1, 24)
    strain = np.empty((len(middle), 6, strains.shape[1]))
    for first in range(0, len(middle), 20_000):
        rows = slice(first, first + 20_000)
        strain[rows] = strain_matrices(middle[rows]) @ displacement[unknown[rows]]
    stress = solid_stiffness(1.0, poisson) @ (strain + strains)
    mises = von_mises(stress, axis=1)
    largest = np.array([_quantile(column, weight, EXCEPTED) for column in mises.T])
    # What is not carried comes out as a strain without stress.
    row = [STRESSES.index(name) for name in names]
    carried = np.diag((grid.tensor @ strains)[row]) > 1.0 - _LOST
    return Stresses(names, np.where(carried, largest, np.inf), mises.max(axis=0))


def _quantile(values: Floats, weights: Floats, share: float) -> float:
    """The value that a share of the weights lies above."""
    order = np.argsort(values)
    above = np.cumsum(weights[order][::-1])
    place = int(np.searchsorted(above, share * above[-1]))
    return float(values[order[::-1][place]])

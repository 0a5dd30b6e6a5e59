# SPDX-License-Identifier: LGPL-2.1-or-later
"""The brick: eight nodes and nine incompatible modes, with which it bends without locking.

E. L. Wilson, R. L. Taylor and others, in Numerical and Computer Methods in Structural Mechanics,
1973. On bricks with right angles it passes the patch test, and all elements of a grid are one. A
voxel that the surface cuts counts by its filled share.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product

import numpy as np

from ..mechanics.elements import CORNERS, SHEARS, solid_stiffness
from ..util.types import Floats

#: Gauss points of an element, in units of half its edges.
POINTS = np.array(list(product((-1.0, 1.0), repeat=3))) / np.sqrt(3.0)


@dataclass(frozen=True, eq=False)
class Brick:
    """A full element.

    Attributes:
        stiffness: (24, 24) N/mm, of the nodes' displacements x, y, z in the order of `CORNERS`.
        stress: (9, 6, 24) MPa, Voigt with yz, xz, xy, at the eight Gauss points and the middle.
    """

    stiffness: Floats
    stress: Floats


def brick(young: float, poisson: float, edge: Floats) -> Brick:
    """The element of an isotropic solid.

    Args:
        young: MPa.
        poisson: of the solid.
        edge: (3,) mm.
    """
    law = solid_stiffness(young, poisson)
    strain = np.stack([_strain(point, edge) for point in (*POINTS, np.zeros(3))])
    weight = float(np.prod(edge)) / 8.0
    whole = np.einsum("pij,ik,pkl->jl", strain[:8], law, strain[:8]) * weight
    modes = -np.linalg.solve(whole[24:, 24:], whole[24:, :24])
    stiffness = whole[:24, :24] + whole[:24, 24:] @ modes
    stress = np.einsum("ij,pjk->pik", law, strain[:, :, :24] + strain[:, :, 24:] @ modes)
    return Brick(0.5 * (stiffness + stiffness.T), stress)


def _strain(point: Floats, edge: Floats) -> Floats:
    """(6, 33) strains, Voigt, of nodes and modes at a point of [-1, 1]^3."""
    signs = 2 * CORNERS - 1
    factor = 1.0 + signs * point
    others = [factor[:, [1, 2]].prod(1), factor[:, [0, 2]].prod(1), factor[:, [0, 1]].prod(1)]
    slopes = np.concatenate([signs * np.stack(others, axis=1) / 8.0, np.diag(-2.0 * point)])
    slopes *= 2.0 / edge
    strain = np.zeros((6, 11, 3))
    for axis in range(3):
        strain[axis, :, axis] = slopes[:, axis]
    for row, (one, two) in enumerate(SHEARS, 3):
        strain[row, :, one] = slopes[:, two]
        strain[row, :, two] = slopes[:, one]
    return strain.reshape(6, 33)


def von_mises(stress: Floats) -> Floats:
    """(...) MPa, of (..., 6) stresses, Voigt."""
    x, y, z, yz, xz, xy = np.moveaxis(stress, -1, 0)
    squares = (x - y) ** 2 + (y - z) ** 2 + (z - x) ** 2
    result: Floats = np.sqrt(0.5 * squares + 3.0 * (yz**2 + xz**2 + xy**2))
    return result

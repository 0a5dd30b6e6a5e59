# SPDX-License-Identifier: LGPL-2.1-or-later
"""The brick: eight nodes and nine incompatible modes, with which it bends without locking.

E. L. Wilson, R. L. Taylor and others, in Numerical and Computer Methods in Structural Mechanics,
1973. On bricks with right angles it passes the patch test, and all full elements of a grid are one.
A voxel that the surface cuts is integrated over its eight parts, each by its filled share (the
finite cell method); there modes count without their mean, so that the patch test is passed too
(R. L. Taylor, P. J. Beresford and E. L. Wilson, Int. J. Numer. Meth. Eng. 10, 1976). By its share
alone a cut wall of two voxels would bend 20 % too little.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product

import numpy as np

from ..mechanics.elements import CORNERS, SHEARS, gradients, solid_stiffness
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


class CutBricks:
    """Elements that are filled in part.

    Args:
        young: MPa.
        poisson: of the solid.
        edge: (3,) mm.
    """

    def __init__(self, young: float, poisson: float, edge: Floats) -> None:
        self._law = solid_stiffness(young, poisson)
        self._size = float(np.prod(edge)) / 8.0
        whole, nodes, modes = [], [], []
        for corner in CORNERS:
            middle = corner - 0.5
            strain = np.stack([brick_strains(middle + 0.5 * point, edge) for point in POINTS])
            each = np.einsum("pij,ik,pkl->jl", strain, self._law, strain)
            whole.append(each * self._size / 8.0)
            nodes.append(strain[:, :, :24].sum(axis=0) * self._size / 8.0)
            modes.append(brick_strains(middle, edge)[:, 24:])
        self._whole, self._nodes, self._modes = np.stack(whole), np.stack(nodes), np.stack(modes)

    def stiffness(self, parts: Floats) -> Floats:
        """(k, 24, 24) N/mm of elements with (k, 8) shares of their parts, none of them empty."""
        total = parts.sum(axis=1)[:, None, None]
        whole = (parts @ self._whole.reshape(8, -1)).reshape(-1, 33, 33)
        nodes = (parts @ self._nodes.reshape(8, -1)).reshape(-1, 6, 24)
        mean = (parts @ self._modes.reshape(8, -1)).reshape(-1, 6, 9) / total
        stress = np.swapaxes(self._law @ mean, 1, 2)
        inner = whole[:, 24:, 24:] - self._size * total * (stress @ mean)
        across = whole[:, 24:, :24] - stress @ nodes
        result = whole[:, :24, :24] - np.swapaxes(across, 1, 2) @ np.linalg.solve(inner, across)
        symmetric: Floats = 0.5 * (result + np.swapaxes(result, 1, 2))
        return symmetric

    def stress(self, parts: Floats, displacements: Floats, edge: Floats) -> Floats:
        """(k, 6) MPa, Voigt, in the middle of what is filled, where modes say nothing.

        Args:
            parts: (k, 8) shares.
            displacements: (k, 24) mm, of the nodes.
            edge: (3,) mm.
        """
        middle = 0.25 + 0.5 * (parts @ CORNERS) / parts.sum(axis=1)[:, None]
        slopes = gradients(middle) / edge
        turned = np.einsum("kna,knb->kab", slopes, displacements.reshape(-1, 8, 3))
        strain = [turned[:, axis, axis] for axis in range(3)]
        strain += [turned[:, one, two] + turned[:, two, one] for one, two in SHEARS]
        result: Floats = np.stack(strain, axis=1) @ self._law
        return result


def brick(young: float, poisson: float, edge: Floats) -> Brick:
    """The element of an isotropic solid.

    Args:
        young: MPa.
        poisson: of the solid.
        edge: (3,) mm.
    """
    law = solid_stiffness(young, poisson)
    strain = np.stack([brick_strains(point, edge) for point in (*POINTS, np.zeros(3))])
    weight = float(np.prod(edge)) / 8.0
    whole = np.einsum("pij,ik,pkl->jl", strain[:8], law, strain[:8]) * weight
    modes = -np.linalg.solve(whole[24:, 24:], whole[24:, :24])
    stiffness = whole[:24, :24] + whole[:24, 24:] @ modes
    stress = np.einsum("ij,pjk->pik", law, strain[:, :, :24] + strain[:, :, 24:] @ modes)
    return Brick(0.5 * (stiffness + stiffness.T), stress)


def brick_strains(point: Floats, edge: Floats) -> Floats:
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

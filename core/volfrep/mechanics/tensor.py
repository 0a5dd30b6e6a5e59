# SPDX-License-Identifier: LGPL-2.1-or-later
"""What an elastic tensor says: moduli in any direction, and averages.

Tensors are (6, 6) stiffnesses in Voigt's order (xx, yy, zz, yz, xz, xy) with engineering shear
strains; directions are unit vectors along the cell's edges x, y, z.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass

import numpy as np

from ..design.target import Target
from ..util.types import Floats

#: Stiffness of what carries nothing, over the mean.
_NOTHING = 1e-9


@dataclass(frozen=True)
class Moduli:
    """The usual figures of a tensor, in its units where they have any.

    Attributes:
        E100, E110, E111: Young's modulus along [100], [110] and [111].
        G: shear modulus in the planes of the cell's faces, mean of the three.
        nu: Poisson's ratio under a pull along an edge, mean of the six.
        bulk: modulus of volume change under equal strains.
        zener: 2 C44 / (C11 - C12) of the mean diagonal entries; 1 for an isotropic tensor.
    """

    E100: float
    E110: float
    E111: float
    G: float
    nu: float
    bulk: float
    zener: float


def compliance(tensor: Floats) -> Floats:
    """(6, 6) compliance; very large instead of infinite where a lattice carries nothing."""
    least = _NOTHING * np.trace(tensor) / 6.0
    result: Floats = np.linalg.inv(tensor + least * np.eye(6))
    return result


def young(tensor: Floats, directions: Floats) -> Floats:
    """(n,) Young's modulus along (n, 3) directions, of any length."""
    unit = np.asarray(directions, float)
    unit = unit / np.linalg.norm(unit, axis=-1, keepdims=True)
    x, y, z = np.moveaxis(unit, -1, 0)
    # Engineering shear strains: a unit pull has stress n n, without factors.
    direction = np.stack([x * x, y * y, z * z, y * z, x * z, x * y], axis=-1)
    result: Floats = 1.0 / np.einsum("...i,ij,...j->...", direction, compliance(tensor), direction)
    return result


def moduli(tensor: Floats) -> Moduli:
    """The usual figures of a tensor; of one that is not cubic the means over x, y and z.

    `E100`, `E110` and `E111` are along [100], [110] and [111] themselves.
    """
    soft = compliance(tensor)
    along = young(tensor, np.array([[1, 0, 0], [1, 1, 0], [1, 1, 1]], float))
    ratios = [-soft[i, j] / soft[j, j] for i, j in itertools.permutations(range(3), 2)]
    direct = np.trace(tensor[:3, :3]) / 3.0
    across = (tensor[:3, :3].sum() / 3.0 - direct) / 2.0
    return Moduli(
        E100=float(along[0]),
        E110=float(along[1]),
        E111=float(along[2]),
        G=float(np.mean(1.0 / np.diag(soft)[3:])),
        nu=float(np.mean(ratios)),
        bulk=float(tensor[:3, :3].sum() / 9.0),
        zener=float(2.0 * np.trace(tensor[3:, 3:]) / 3.0 / (direct - across)),
    )


def cubic(c11: float, c12: float, c44: float) -> Floats:
    """(6, 6) stiffness of a cubic lattice.

    >>> isotropic = cubic(3.0, 1.0, 1.0)  # its Zener ratio 2 C44 / (C11 - C12) is 1
    >>> young(isotropic, np.array([[1, 0, 0], [1, 1, 1]]) / [[1.0], [3.0**0.5]]).round(6).tolist()
    [2.5, 2.5]
    """
    tensor = np.diag([c11 - c12] * 3 + [c44] * 3).astype(float)
    tensor[:3, :3] += c12
    return tensor


def modulus_along(tensor: Floats, target: Target) -> float:
    """Young's modulus of a (6, 6) stiffness over the solid's E along a target's direction."""
    return target.young * float(young(tensor, np.array([target.direction]))[0])

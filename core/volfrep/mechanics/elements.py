# SPDX-License-Identifier: LGPL-2.1-or-later
"""The trilinear hexahedron, a cube of edge h, integrated over any part of itself.

A voxel that the surface cuts is divided into equal parts, and only the solid ones are integrated
(the finite cell method: Parvizian, Duester & Rank, Comput. Mech. 41, 2007). So the elements are
those of the true body, and stiffness is approached from above as they become smaller.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from ..util.types import Floats

#: The corners of the unit cube in the order of an element's nodes.
CORNERS = np.array([[k >> 2 & 1, k >> 1 & 1, k & 1] for k in range(8)])
#: Parts along the edge of a voxel that is cut.
PARTS = 4
#: Pairs of axes of the shear strains, in Voigt's order yz, xz, xy.
SHEARS = ((1, 2), (0, 2), (0, 1))


@dataclass(frozen=True, eq=False)
class Hexahedron:
    """Integrals over the parts of an element of edge 1; an element of edge h has h times as much.

    Attributes:
        stiffness: (parts, 24, 24) of each part.
        load: (parts, 24, 6) nodal forces of a unit macroscopic strain (h2 times as much).
    """

    stiffness: Floats
    load: Floats


def solid_stiffness(young: float, poisson: float) -> Floats:
    """(6, 6) stiffness of an isotropic solid, Voigt, engineering shear strains."""
    shear = young / (2.0 * (1.0 + poisson))
    stiffness = np.diag([2.0 * shear] * 3 + [shear] * 3)
    stiffness[:3, :3] += young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson))
    return stiffness


def von_mises(stress: Floats, axis: int = -1) -> Floats:
    """Von Mises stress of stresses with six components, the three shears last, along an axis."""
    x, y, z, yz, xz, xy = np.moveaxis(stress, axis, 0)
    squares = (x - y) ** 2 + (y - z) ** 2 + (z - x) ** 2
    result: Floats = np.sqrt(0.5 * squares + 3.0 * (yz**2 + xz**2 + xy**2))
    return result


def gradients(points: Floats) -> Floats:
    """(n, 8, 3) gradients of the eight shape functions at (n, 3) points of the unit cube."""
    factor = np.where(CORNERS[None], points[:, None], 1.0 - points[:, None])
    slope = np.where(CORNERS, 1.0, -1.0)
    others = np.stack([factor[..., 1] * factor[..., 2], factor[..., 0] * factor[..., 2],
                       factor[..., 0] * factor[..., 1]], axis=-1)  # fmt: skip
    result: Floats = slope * others
    return result


def strain_matrices(points: Floats, edge: Floats | float = 1.0) -> Floats:
    """(n, 6, 24) strains, Voigt, of the nodal displacements at (n, 3) points of the unit cube.

    Args:
        points: (n, 3) in the element.
        edge: of it, or (3,) along each axis.
    """
    slopes = gradients(points) / edge
    matrix = np.zeros((len(points), 6, 8, 3))
    for axis in range(3):
        matrix[:, axis, :, axis] = slopes[..., axis]
    for row, (one, two) in enumerate(SHEARS, 3):
        matrix[:, row, :, one] = slopes[..., two]
        matrix[:, row, :, two] = slopes[..., one]
    return matrix.reshape(len(points), 6, 24)


def part_centres() -> Floats:
    """(PARTS^3, 3) the middles of an element's parts, in the unit cube."""
    axis = (np.arange(PARTS) + 0.5) / PARTS
    centres: Floats = np.stack(np.meshgrid(axis, axis, axis, indexing="ij"), axis=-1)
    return centres.reshape(-1, 3)


@lru_cache(maxsize=8)
def hexahedron(poisson: float) -> Hexahedron:
    """The integrals for a solid of Young's modulus 1, exact over each part (2^3 Gauss points)."""
    solid = solid_stiffness(1.0, poisson)
    offsets = (CORNERS - 0.5) / (np.sqrt(3.0) * PARTS)
    points = part_centres()[:, None] + offsets
    strain = strain_matrices(points.reshape(-1, 3)).reshape(-1, 8, 6, 24)
    weight = 1.0 / (8 * PARTS**3)
    stress = np.einsum("ij,pqjk->pqik", solid, strain)
    stiffness = np.einsum("pqji,pqjk->pik", strain, stress) * weight
    load = np.einsum("pqji->pij", stress) * weight
    return Hexahedron(stiffness, load)

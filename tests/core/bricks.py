# SPDX-License-Identifier: LGPL-2.1-or-later
"""A closed mesh as cubes of one size, solved as solid bricks: independent of beams and shells.

Bricks with incompatible modes (E. L. Wilson, R. L. Taylor and others, Numerical and Computer
Methods in Structural Mechanics, 1973), which bend without locking; a mesh becomes the cubes whose
middles it encloses. Conjugate gradients.
"""

from collections.abc import Callable
from itertools import product

import numpy as np
from scipy.sparse import csr_matrix

from volfrep.mesh.triangle_mesh import TriangleMesh

_CORNERS = np.array(list(product((0, 1), repeat=3)))
#: A column through the middles of cubes misses the edges of facets that lie in the grid.
_ASIDE = np.array([1.3e-5, 2.9e-5])


def cubes_of(mesh: TriangleMesh, edge: float) -> tuple[np.ndarray, np.ndarray]:
    """(nx, ny, nz) bool, which cubes' middles are inside; and the grid's lowest corner, mm."""
    low, high = mesh.bounds
    count = np.maximum(np.round((high - low) / edge - 0.01), 1).astype(int)
    a, b, c = (corner - low for corner in mesh.corners())
    place = [(corner[:, :2] - _ASIDE * edge) / edge - 0.5 for corner in (a, b, c)]
    first = np.maximum(np.ceil(np.min(place, axis=0)), 0).astype(int)
    last = np.minimum(np.floor(np.max(place, axis=0)), count[:2] - 1).astype(int)
    wide = np.maximum(last - first + 1, 0)
    number = wide.prod(axis=1)
    owner = np.repeat(np.arange(len(a)), number)
    inside = np.arange(len(owner)) - np.repeat(np.cumsum(number) - number, number)
    column = first[owner] + np.stack(np.divmod(inside, np.maximum(wide[owner, 1], 1)), axis=1)
    p, q, r = (corner[owner] - column for corner in place)

    def cross(u: np.ndarray, v: np.ndarray) -> np.ndarray:
        return u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]

    shares = np.stack([cross(q, r), cross(r, p), cross(p, q)], axis=1)
    total = shares.sum(axis=1)
    hit = ((shares * np.sign(total)[:, None]) >= 0).all(axis=1) & (total != 0)
    column, shares, owner = column[hit], shares[hit] / total[hit, None], owner[hit]
    heights = np.stack([a[owner, 2], b[owner, 2], c[owner, 2]], axis=1)
    level = np.ceil((shares * heights).sum(axis=1) / edge - 0.5).astype(int)
    # Each crossing changes all that lies above it from out to in and back.
    changes = np.zeros((*count[:2], count[2] + 1), np.int64)
    np.add.at(changes, (*column.T, np.clip(level, 0, count[2])), 1)
    return np.cumsum(changes, axis=2)[:, :, :-1] % 2 == 1, low


def brick_stiffness(young: float, poisson: float, edge: float) -> np.ndarray:
    """(24, 24) of a cube with incompatible modes, condensed."""
    shear = young / 2 / (1 + poisson)
    lame = young * poisson / (1 + poisson) / (1 - 2 * poisson)
    law = np.diag([2 * shear] * 3 + [shear] * 3) + np.pad(np.full((3, 3), lame), (0, 3))
    signs = 2 * _CORNERS - 1
    whole = np.zeros((33, 33))
    for place in product((-1, 1), repeat=3):
        xi = np.array(place) / np.sqrt(3)
        factor = 1 + signs * xi
        slopes = (
            signs
            * np.stack(
                [factor[:, [1, 2]].prod(1), factor[:, [0, 2]].prod(1), factor[:, [0, 1]].prod(1)], 1
            )
            / 8
        )
        slopes = np.concatenate([slopes, np.diag(-2 * xi)]) * 2 / edge
        strain = np.zeros((6, 33))
        for k, (x, y, z) in enumerate(slopes):
            strain[:, 3 * k : 3 * k + 3] = [
                [x, 0, 0], [0, y, 0], [0, 0, z], [0, z, y], [z, 0, x], [y, x, 0]
            ]  # fmt: skip
        whole += strain.T @ law @ strain * edge**3 / 8
    kept, gone = slice(0, 24), slice(24, 33)
    result: np.ndarray = whole[kept, kept] - whole[kept, gone] @ np.linalg.solve(
        whole[gone, gone], whole[gone, kept]
    )
    return result


class Bricks:
    """Cubes that are connected.

    Args:
        mesh: closed, mm.
        edge: of a cube, mm.
        young: MPa.
        poisson: of the solid.

    Attributes:
        nodes: (n, 3) mm.
        volume: mm3, of all cubes.
    """

    def __init__(self, mesh: TriangleMesh, edge: float, young: float, poisson: float) -> None:
        filled, low = cubes_of(mesh, edge)
        place = np.argwhere(filled)
        size = np.array(filled.shape) + 1
        corner = (place[:, None] + _CORNERS) @ np.array([size[1] * size[2], size[2], 1])
        used, flat = np.unique(corner, return_inverse=True)
        self.elements = flat.reshape(corner.shape)
        self.nodes = np.stack(np.unravel_index(used, size), axis=1) * edge + low
        self.volume = len(place) * edge**3
        self.edge = edge
        own = (3 * self.elements[:, :, None] + np.arange(3)).reshape(len(place), 24)
        values = np.broadcast_to(brick_stiffness(young, poisson, edge), (len(own), 24, 24))
        rows, columns = np.repeat(own, 24, axis=1), np.tile(own, (1, 24))
        count = 3 * len(self.nodes)
        self._matrix = csr_matrix((values.ravel(), (rows.ravel(), columns.ravel())), (count,) * 2)

    def spread(self, chosen: Callable[[np.ndarray], np.ndarray]) -> np.ndarray:
        """(n,) shares of a traction on the outer faces whose corners are all chosen."""
        where = chosen(self.nodes)
        result = np.zeros(len(self.nodes))
        for axis, side in product(range(3), (0, 1)):
            face = self.elements[:, _CORNERS[:, axis] == side]
            on = face[where[face].all(axis=1)]
            np.add.at(result, on, 1.0)
        return result / result.sum()

    def displacements(
        self, held: np.ndarray, loads: np.ndarray, tolerance: float = 1e-5
    ) -> np.ndarray:
        """(n, 3) mm under loads (n, 3), N, nodes (n,) held."""
        free = np.repeat(~held, 3)
        matrix = self._matrix
        scale = np.where(free, 1.0 / matrix.diagonal(), 0.0)
        right = np.where(free, loads.ravel(), 0.0)
        moved, left = np.zeros_like(right), right.copy()
        step = scale * left
        work, small = left @ step, tolerance * np.linalg.norm(right)
        for _ in range(20_000):
            pulled = np.where(free, matrix @ step, 0.0)
            size = work / (step @ pulled)
            moved += size * step
            left -= size * pulled
            if np.linalg.norm(left) < small:
                return moved.reshape(-1, 3)
            ahead = scale * left
            work, before = left @ ahead, work
            step = ahead + work / before * step
        raise AssertionError("the bricks are not connected")

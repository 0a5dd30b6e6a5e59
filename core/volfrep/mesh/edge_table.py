# SPDX-License-Identifier: LGPL-2.1-or-later
"""Edge table: the edges of any triangles, closed or not, and what lies on their sides."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

from ..util.types import Ints
from .triangle_mesh import TriangleMesh


@dataclass(frozen=True, eq=False)
class Edges:
    """Sides of triangles, numbered triangle by triangle, and the edges they lie on.

    Attributes:
        sides: (3 m, 2) the vertices a side runs from and to.
        number: (3 m,) the edge of each side; an edge is a pair of vertices in either order.
        count: (e,) sides on each edge.
        balance: (e,) sides that run one way less those that run the other.
    """

    sides: Ints
    number: Ints
    count: Ints
    balance: Ints

    @property
    def open_sides(self) -> Ints:
        """Sides without another triangle across."""
        return np.flatnonzero((self.count == 1)[self.number])

    @property
    def is_closed(self) -> bool:
        """Whether as many triangles run along each edge one way as the other."""
        return not self.balance.any()

    @property
    def is_manifold(self) -> bool:
        """Whether two triangles share each edge."""
        return bool((self.count == 2).all())

    def pairs(self) -> tuple[Ints, Ints]:
        """The two sides on every edge that has two."""
        both = np.flatnonzero((self.count == 2)[self.number])
        order = both[np.argsort(self.number[both], kind="stable")]
        return order[0::2], order[1::2]


def edges_of(mesh: TriangleMesh) -> Edges:
    """The edges of a mesh."""
    t = mesh.triangles.astype(np.int64)
    sides = np.stack([t, np.roll(t, -1, axis=1)], axis=2).reshape(-1, 2)
    low, high = sides.min(axis=1), sides.max(axis=1)
    number = np.unique(low * len(mesh.vertices) + high, return_inverse=True)[1].ravel()
    count = np.bincount(number)
    forward = np.bincount(number[sides[:, 0] < sides[:, 1]], minlength=len(count))
    return Edges(sides, number, count, 2 * forward - count)


def pieces_of(first: Ints, second: Ints, count: int) -> tuple[int, Ints]:
    """How many pieces `count` things make that are joined in pairs, and the piece of each."""
    graph = coo_matrix((np.ones(len(first), bool), (first, second)), shape=(count, count))
    pieces, piece = connected_components(graph, directed=False)
    return int(pieces), piece.astype(np.int64)


def areas_of(mesh: TriangleMesh) -> NDArray[np.float64]:
    """(m,) area of each triangle."""
    a, b, c = mesh.corners()
    areas: NDArray[np.float64] = 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1)
    return areas


def place_text(point: NDArray[np.float64]) -> str:
    """A point for a message."""
    return "({:.4g}, {:.4g}, {:.4g})".format(*point)


def plural(count: int, one: str, many: str = "") -> str:
    """The count with its noun, as in '1 hole' and '2 holes'."""
    return f"{count:,} {one if count == 1 else many or one + 's'}"

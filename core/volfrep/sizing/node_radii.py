# SPDX-License-Identifier: LGPL-2.1-or-later
"""Radii at nodes as what is varied: what struts get of them, their volume, their bounds.

Radii and not densities, at nodes, because the mesh is made of these. Volume is the struts' cones
less what they share at a node: a constant of its directions times the radius cubed.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import sparse

from ..lattice.strut_binding import LEAST_ROOM
from ..spatial.even_points import even_points
from ..util.types import Floats, Ints

#: Points (a power of 2) in the cube about a joint by which its struts' overlap is found, and how
#: far that is looked at, in radii.
_POINTS_LOG2 = 12
_FARTHEST = 6.0
#: Of the radius at which the mesh of struts would have no room between their joints.
_SAFE = 0.9
#: Directions of struts that differ by less are the same.
_SAME = 1e-4
_ODD = np.array([0x9E3779B97F4A7C15, 0xC2B2AE3D27D4EB4F, 0x165667B19E3779F9], np.uint64)


@dataclass(frozen=True, eq=False)
class NodeRadii:
    """Struts whose radii are those of nodes, straight in between.

    Attributes:
        ends: (2 m, n) sparse: the radius at each strut's first and second end of those at nodes.
            A strut that was cut has an end between two nodes.
        length: (m,) mm, of the struts.
        overlap: (n,) what the struts at a node count twice, in units of its radius cubed.
    """

    ends: sparse.csr_matrix
    length: Floats
    overlap: Floats

    def of_struts(self, radii: Floats) -> Floats:
        """(m, 2) mm, of (n,) at nodes."""
        return np.asarray(self.ends @ radii).reshape(-1, 2)

    def volume(self, radii: Floats) -> float:
        """mm3, of all struts together, joints counted once."""
        first, second = self.of_struts(radii).T
        cones = np.pi / 3.0 * self.length * (first**2 + first * second + second**2)
        return float(cones.sum() - self.overlap @ radii**3)

    def volume_change(self, radii: Floats) -> Floats:
        """(n,) mm2, derivative of the volume to each radius."""
        first, second = self.of_struts(radii).T
        cones = np.stack([2.0 * first + second, first + 2.0 * second], axis=1)
        cones *= (np.pi / 3.0 * self.length)[:, None]
        return self.to_nodes(cones) - 3.0 * self.overlap * radii**2

    def to_nodes(self, changes: Floats) -> Floats:
        """(n,) derivatives to nodes' radii, of (m, 2) to those of struts' ends."""
        return np.asarray(self.ends.T @ changes.ravel())

    def scaled_to(self, radii: Floats, volume: float, low: Floats, high: Floats) -> Floats:
        """The radii times one factor, within bounds, so that they make a volume (or come near)."""
        small, large = 1e-3, 1e3
        for _ in range(60):
            middle = np.sqrt(small * large)
            if self.volume(np.clip(radii * middle, low, high)) > volume:
                large = middle
            else:
                small = middle
        return np.clip(radii * small, low, high)


def whole_struts(struts: Ints, count: int) -> sparse.csr_matrix:
    """`NodeRadii.ends` of struts that nothing cuts, between so many nodes."""
    entries = struts.ravel()
    shape = (len(entries), count)
    return sparse.csr_matrix((np.ones(len(entries)), (np.arange(len(entries)), entries)), shape)


def joint_overlap(nodes: Floats, struts: Ints, sphere: float) -> Floats:
    """(n,) volume that the struts at each node have in common, over its radius cubed.

    Of straight half cylinders of radius 1 that begin at the node, and the joint's sphere, by
    Sobol points: what they measure one by one, less what they measure together.

    Args:
        nodes: (n, 3) mm.
        struts: (m, 2) rows of `nodes`.
        sphere: radius of the joint's sphere over the struts'.
    """
    stars, of_node = _stars(nodes, struts)
    cube = even_points(3, _POINTS_LOG2) * 2.0 - 1.0
    ball = cube[np.linalg.norm(cube, axis=1) <= 1.0]
    values = np.zeros(len(stars))
    for k, ways in enumerate(stars):
        if not len(ways):
            continue
        reach = 1.5
        if len(ways) > 1:
            cosine = np.clip(np.sort(ways @ ways.T - 3.0 * np.eye(len(ways)), axis=1)[:, -1], -1, 1)
            half = 0.5 * np.arccos(cosine.max())
            reach = min(max(1.05 / np.sin(half), reach), _FARTHEST)
        points = reach * ball
        along = points @ ways.T
        square = (points**2).sum(axis=1)
        inside = (along > 0.0) & (square[:, None] - along**2 < 1.0)
        count = inside.sum(axis=1)
        together = (count > 0) | (square < sphere**2)
        share = (count.sum() - together.sum()) / len(ball)
        values[k] = share * 4.0 / 3.0 * np.pi * reach**3
    return np.asarray(values[of_node])


def largest_radii(nodes: Floats, struts: Ints, most: float) -> Floats:
    """(n,) mm: the largest radius at each node with which its struts part before their middles.

    Two struts that meet at an angle of t part at r / tan(t / 2) from the node; from there to the
    middle the mesh needs a little room.

    Args:
        nodes: (n, 3) mm.
        struts: (m, 2) rows of `nodes`.
        most: no radius is larger, mm.
    """
    stars, of_node = _stars(nodes, struts)
    reach = np.zeros(len(stars))
    for k, ways in enumerate(stars):
        if len(ways) > 1:
            cosine = np.sort(ways @ ways.T - 3.0 * np.eye(len(ways)), axis=1)[:, -1]
            half = 0.5 * np.arccos(np.clip(cosine.max(), -1.0, 1.0))
            reach[k] = 1.0 / np.tan(half)
    length = np.linalg.norm(nodes[struts[:, 1]] - nodes[struts[:, 0]], axis=1)
    shortest = np.full(len(nodes), np.inf)
    for end in (0, 1):
        np.minimum.at(shortest, struts[:, end], length)
    own = _SAFE * 0.5 * shortest / (reach[of_node] + LEAST_ROOM)
    # A node on the outside has few struts, but the octants there are cut from whole cells.
    result = own.copy()
    for end, other in ((0, 1), (1, 0)):
        np.minimum.at(result, struts[:, end], own[struts[:, other]])
    return np.asarray(np.minimum(most, result))


def smoothing(struts: Ints, count: int, share: float) -> sparse.csr_matrix:
    """(n, n) a mean of each node's radius and, with a share, those of its neighbours."""
    both = np.concatenate([struts, struts[:, ::-1]])
    near = sparse.csr_matrix((np.ones(len(both)), (both[:, 0], both[:, 1])), (count, count))
    number = np.maximum(np.asarray(near.sum(axis=1)).ravel(), 1.0)
    mean = sparse.diags(share / number) @ near
    own = 1.0 - np.asarray(mean.sum(axis=1)).ravel()
    return sparse.csr_matrix(mean + sparse.diags(own))


def _stars(nodes: Floats, struts: Ints) -> tuple[list[Floats], Ints]:
    """The directions of struts at each node: every different set once, and each node's."""
    ways = nodes[struts[:, 1]] - nodes[struts[:, 0]]
    ways /= np.linalg.norm(ways, axis=1)[:, None]
    start = np.concatenate([struts[:, 0], struts[:, 1]])
    ways = np.concatenate([ways, -ways])
    # A star's name is the sum of its directions' numbers, each well mixed.
    steps = np.round(ways / _SAME).astype(np.int64).astype(np.uint64)
    mixed = (steps * _ODD).sum(axis=1, dtype=np.uint64)
    mixed = (mixed ^ (mixed >> np.uint64(29))) * _ODD[0]
    mixed ^= mixed >> np.uint64(32)
    name = np.zeros(len(nodes), np.uint64)
    np.add.at(name, start, mixed)
    _, example, of_node = np.unique(name, return_index=True, return_inverse=True)
    order = np.argsort(start, kind="stable")
    first = np.searchsorted(start[order], example)
    last = np.searchsorted(start[order], example, "right")
    stars = [ways[order[low:high]] for low, high in zip(first, last, strict=True)]
    return stars, of_node.ravel()

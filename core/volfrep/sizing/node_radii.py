# SPDX-License-Identifier: LGPL-2.1-or-later
"""Radii at nodes as what is varied: what struts get of them, their volume, their bounds.

Radii and not densities, at nodes, because the mesh is made of these. Volume is the struts' cones
less what they share at a node: a constant of its directions times the radius cubed.

Struts may come out of the printer thicker or thinner than they are drawn: radii at nodes are those
drawn, and all that is computed of them is of those that come out.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import sparse

from ..lattice.strut_binding import LEAST_ROOM
from ..util.types import Floats, Ints
from .union_volume import UnionVolume

#: Of the radius at which the mesh of struts would have no room between their joints.
_SAFE = 0.9
#: A volume is made by one factor for all radii to this part of it, in so many steps at most.
_MADE, _SCALINGS = 1e-8, 60
#: Directions of struts that differ by less are the same.
_SAME = 1e-4
_ODD = np.array([0x9E3779B97F4A7C15, 0xC2B2AE3D27D4EB4F, 0x165667B19E3779F9], np.uint64)


#: What comes out is no thinner than this part of what is drawn, below all bounds.
_LEAST_OUT = 1e-3


@dataclass(frozen=True, eq=False)
class ComesOut:
    """Radii that come out of a printer: ``factor * drawn + added``.

    Attributes:
        factor, added: (m,) of struts, added in mm.
        thinner: (m,) mm, by which struts may be thinner yet, which stress and buckling go by.
        node_factor, node_added: (n,) the same at nodes, for the volume.
    """

    factor: Floats
    added: Floats
    thinner: Floats
    node_factor: Floats
    node_added: Floats

    def of(self, struts: Ints) -> ComesOut:
        """Of pieces of struts: (p,) rows."""
        return ComesOut(
            self.factor[struts], self.added[struts], self.thinner[struts], self.node_factor,
            self.node_added,
        )  # fmt: skip

    def at_nodes(self, radii: Floats) -> Floats:
        """(n,) mm: the mean of what a node's struts come out as."""
        return np.maximum(self.node_factor * radii + self.node_added, _LEAST_OUT * radii)


@dataclass(frozen=True, eq=False)
class NodeRadii:
    """Struts whose radii are those of nodes, straight in between.

    Attributes:
        ends: (2 m, n) sparse: the radius at each strut's first and second end of those at nodes.
            A strut that was cut has an end between two nodes.
        filled: what the whole struts and their joints fill.
        comes_out: of the printer; None where struts are taken as they are drawn.
    """

    ends: sparse.csr_matrix
    filled: UnionVolume
    comes_out: ComesOut | None = None

    def drawn(self, radii: Floats) -> Floats:
        """(m, 2) mm, of (n,) at nodes, whatever comes out."""
        return np.asarray(self.ends @ radii).reshape(-1, 2)

    def of_struts(self, radii: Floats) -> Floats:
        """(m, 2) mm, of (n,) at nodes."""
        drawn, out = self.drawn(radii), self.comes_out
        if out is None:
            return drawn
        return np.maximum(out.factor[:, None] * drawn + out.added[:, None], _LEAST_OUT * drawn)

    def weakest(self, radii: Floats) -> Floats:
        """(m, 2) mm, as thin as struts may come out, which stress and buckling go by."""
        found, out = self.of_struts(radii), self.comes_out
        if out is None:
            return found
        return np.maximum(found - out.thinner[:, None], _LEAST_OUT * found)

    def volume(self, radii: Floats) -> float:
        """mm3, of all struts and joints together, what overlaps counted once."""
        out = self.comes_out
        return self.filled.at(radii if out is None else out.at_nodes(radii))

    def volume_change(self, radii: Floats) -> Floats:
        """(n,) mm2, derivative of the volume to each radius."""
        out = self.comes_out
        if out is None:
            return self.filled.change(radii)
        return self.filled.change(out.at_nodes(radii)) * out.node_factor

    def to_nodes(self, changes: Floats) -> Floats:
        """(n,) derivatives to nodes' radii, of (m, 2) to those of struts' ends."""
        if self.comes_out is not None:
            changes = changes * self.comes_out.factor[:, None]
        return np.asarray(self.ends.T @ changes.ravel())

    def scaled_to(self, radii: Floats, volume: float, low: Floats, high: Floats) -> Floats:
        """The radii times one factor, within bounds, so that they make a volume (or come near)."""

        def beyond(log: float) -> float:
            made = self.volume(np.clip(radii * np.exp(log), low, high))
            return float(np.log(max(made, 1e-300) / volume))

        # From one side to the other in growing steps, then between the two (the Illinois method).
        least, most = float(np.log((low / radii).min())), float(np.log((high / radii).max()))
        one = float(np.clip(0.0, least, most))
        off_one = beyond(one)
        step = -0.5 * off_one
        two, off_two = one, off_one
        for _ in range(_SCALINGS):
            if abs(off_two) <= _MADE:
                break
            if off_one * off_two > 0.0:
                one, off_one = two, off_two
                two = float(np.clip(one + step, least, most))
                if two == one:  # nothing thicker, or thinner, is allowed
                    break
                off_two, step = beyond(two), 2.0 * step
                continue
            between = two - off_two * (two - one) / (off_two - off_one)
            off = beyond(between)
            if off * off_two < 0.0:
                one, off_one = two, off_two
            else:
                off_one *= 0.5
            two, off_two = between, off
        return np.asarray(np.clip(radii * np.exp(two), low, high))


def whole_struts(struts: Ints, count: int) -> sparse.csr_matrix:
    """`NodeRadii.ends` of struts that nothing cuts, between so many nodes."""
    entries = struts.ravel()
    shape = (len(entries), count)
    return sparse.csr_matrix((np.ones(len(entries)), (np.arange(len(entries)), entries)), shape)


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

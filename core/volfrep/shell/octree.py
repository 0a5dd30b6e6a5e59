# SPDX-License-Identifier: LGPL-2.1-or-later
"""Octree leaves, and the patches of a surface that the signs at their corners tell.

Everything is in whole numbers. A surface separates the negative corners from the others. It
crosses the *minimal* edges, those that no smaller leaf subdivides; round each of them lie three or
four leaves. On the face that two leaves share, crossed edges are joined in pairs by segments; the
segments of a leaf close into loops, and each loop bounds one patch. With one vertex a patch and
one polygon a crossed edge the dual is a closed 2-manifold, whatever the sizes of neighbours: a
segment lies in two patches, and joins two edges. (Manifold dual contouring, Schaefer, Ju, Warren
2007, with the loops found on the leaves' own faces.)
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..mesh.topology import edge_keys, pieces_of
from ..spatial.proximity import interleaved
from ..util.types import Bools, Ints

#: Coordinates are whole numbers of this many bits.
BITS = 21
#: The corners of a cube, x slowest.
CORNERS = np.array([[i, j, k] for i in (0, 1) for j in (0, 1) for k in (0, 1)])
#: Quadrants round an edge along axis a, counter-clockwise: steps along a + 1 and a + 2.
QUADRANTS = ((0, 0), (-1, 0), (-1, -1), (0, -1))


@dataclass(frozen=True, eq=False)
class Leaves:
    """Cubes that do not overlap.

    Attributes:
        corner: (n, 3) lowest corners, multiples of the size.
        size: (n,) edges, even powers of two apart: 2, 4, 8 ...
    """

    corner: Ints
    size: Ints

    def nodes(self) -> Ints:
        """(n, 8, 3) corners."""
        return np.asarray(self.corner[:, None] + self.size[:, None, None] * CORNERS)

    def halved(self) -> Leaves:
        """Eight leaves for each."""
        half = np.repeat(self.size // 2, 8)
        corner = np.repeat(self.corner, 8, axis=0)
        return Leaves(corner + half[:, None] * np.tile(CORNERS, (len(self.size), 1)), half)

    def chosen(self, which: Bools | slice) -> Leaves:
        """Some of them."""
        return Leaves(self.corner[which], self.size[which])

    def joined(self, more: Leaves) -> Leaves:
        """With others after them."""
        return Leaves(
            np.concatenate([self.corner, more.corner]), np.concatenate([self.size, more.size])
        )


@dataclass(frozen=True, eq=False)
class CrossedEdges:
    """Edges of cubes that a surface crosses.

    Attributes:
        low: (n, 3) lower ends.
        axis: (n,) directions.
        size: (n,) lengths.
        rising: (n,) whether the lower end is the negative one.
    """

    low: Ints
    axis: Ints
    size: Ints
    rising: Bools

    def at(self, share: int) -> Ints:
        """(n, 3) nodes half the given number of lengths above the lower ends."""
        node = self.low.copy()
        node[np.arange(len(node)), self.axis] += share * self.size // 2
        return node

    @property
    def high(self) -> Ints:
        """(n, 3) upper ends."""
        return self.at(2)

    @property
    def names(self) -> Ints:
        """(n,) the names of the middles: no two edges have the same."""
        return name(self.at(1))

    def chosen(self, which: Bools | Ints) -> CrossedEdges:
        """Some of them."""
        return CrossedEdges(self.low[which], self.axis[which], self.size[which], self.rising[which])

    def joined(self, more: CrossedEdges) -> CrossedEdges:
        """With others after them."""
        return CrossedEdges(
            np.concatenate([self.low, more.low]),
            np.concatenate([self.axis, more.axis]),
            np.concatenate([self.size, more.size]),
            np.concatenate([self.rising, more.rising]),
        )


@dataclass(frozen=True, eq=False)
class Crossings:
    """The crossed minimal edges of some leaves, and the patches round them.

    Attributes:
        edges: n of them.
        leaf: (n, 4) the leaf in each of `QUADRANTS`; of two that follow each other both may be
            the same, then the edge lies in the middle of its face.
        patch: (n, 4) the patch in that leaf.
        segment: (n, 4) the segment between each quadrant and the next one, -1 where there is
            none: both are the same leaf.
        leaf_of_patch: (p,) leaves.
        patches_of_segment: (s, 2) patches.
    """

    edges: CrossedEdges
    leaf: Ints
    patch: Ints
    segment: Ints
    leaf_of_patch: Ints
    patches_of_segment: Ints

    def chosen(self, which: Ints) -> Crossings:
        """Some of the edges, with all patches."""
        return Crossings(
            self.edges.chosen(which), self.leaf[which], self.patch[which], self.segment[which],
            self.leaf_of_patch, self.patches_of_segment,
        )  # fmt: skip

    @property
    def alone(self) -> Bools:
        """(p,) which patches are the only ones in their leaves."""
        return np.asarray((np.bincount(self.leaf_of_patch) == 1)[self.leaf_of_patch])

    def doubled(self) -> Bools:
        """(s,) whether another segment joins the same two patches.

        One vertex a patch is too few for them: four triangles would share the edge between.
        """
        pairs = np.sort(self.patches_of_segment, axis=1)
        pair = pairs[:, 0] * len(self.leaf_of_patch) + pairs[:, 1]
        _, number, count = np.unique(pair, return_inverse=True, return_counts=True)
        return np.asarray(count[number.ravel()] > 1)


def name(nodes: Ints) -> Ints:
    """One number for each node (..., 3)."""
    return np.asarray((nodes[..., 0] << 2 * BITS) | (nodes[..., 1] << BITS) | nodes[..., 2])


def named(names: Ints) -> Ints:
    """The (n, 3) nodes of (n,) names."""
    mask = (1 << BITS) - 1
    return np.stack([names >> 2 * BITS, (names >> BITS) & mask, names & mask], axis=1)


def find(names: Ints, wanted: Ints) -> Ints:
    """Where in sorted names the wanted ones are; -1: nowhere."""
    if not len(names):
        return np.full(wanted.shape, -1)
    place = np.minimum(np.searchsorted(names, wanted), len(names) - 1)
    return np.where(names[place] == wanted, place, -1)


def crossed_edges(leaves: Leaves, negative: Bools) -> tuple[CrossedEdges, Ints]:
    """The minimal edges that are crossed, by rising names, and (n, 4) the leaves round them.

    Args:
        leaves: they fill the neighbourhood of every crossed edge.
        negative: (n, 8) sign at the corners of each leaf, the same wherever leaves meet.

    Raises:
        RuntimeError: the surface reaches a place without leaves.
    """
    edges = _minimal(_edges_of(leaves, negative))
    return edges, _leaves_round(leaves, edges)


def crossed_anew(
    edges: CrossedEdges, leaf: Ints, number: Ints, leaves: Leaves, negative: Bools
) -> tuple[CrossedEdges, Ints]:
    """As `crossed_edges`, once some of the leaves have been halved.

    Where none of these lies round an edge, everything about it is as it was. An edge of one of the
    halves that smaller leaves divide has parts that the halved leaf lay round.

    Args:
        edges: the crossed ones of the leaves of before.
        leaf: (n, 4) these leaves, round them.
        number: (k,) what these are called now; -1: halved.
        leaves: of now, the halves last.
        negative: (h, 8) sign at the corners of these h last ones.

    Raises:
        RuntimeError: as there.
    """
    leaf = number[leaf]
    same = (leaf >= 0).all(axis=1)
    halves = leaves.chosen(slice(len(leaves.size) - len(negative), None))
    anew = _minimal(edges.chosen(~same).joined(_edges_of(halves, negative)))
    edges = edges.chosen(same).joined(anew)
    leaf = np.concatenate([leaf[same], _leaves_round(leaves, anew)])
    order = np.argsort(edges.names)
    return edges.chosen(order), leaf[order]


def patches(leaves: Leaves, edges: CrossedEdges, leaf: Ints) -> Crossings:
    """The patches that crossed edges bound.

    Args:
        leaves: as of `crossed_edges`.
        edges: some of the minimal ones that are crossed. Of a leaf round which not all of its own
            are given the patches are incomplete.
        leaf: (n, 4) the leaves round them.
    """
    first, second, segment = _segments(leaves, edges, leaf)
    patch = _join(leaf, first, second)
    of_patch = np.zeros(int(patch.max(initial=-1)) + 1, np.int64)
    of_patch[patch.ravel()] = leaf.ravel()
    edge, quadrant = first.T
    pairs = np.stack([patch[edge, quadrant], patch[edge, (quadrant + 1) % 4]], axis=1)
    return Crossings(edges, leaf, patch, segment, of_patch, pairs)


def _edges_of(leaves: Leaves, negative: Bools) -> CrossedEdges:
    """The crossed edges of leaves, as often as these have them."""
    mixed = negative.any(axis=1) & ~negative.all(axis=1)
    leaves, negative = leaves.chosen(mixed), negative[mixed]
    nodes = leaves.nodes()
    parts = []
    for axis in range(3):
        for start in np.flatnonzero(CORNERS[:, axis] == 0):
            rows = np.flatnonzero(negative[:, start] != negative[:, start + (4 >> axis)])
            axes = np.full(len(rows), axis)
            parts.append((nodes[rows, start], axes, leaves.size[rows], negative[rows, start]))
    return CrossedEdges(*(np.concatenate(values) for values in zip(*parts, strict=True)))


def _minimal(edges: CrossedEdges) -> CrossedEdges:
    """Each crossed edge that no smaller leaf divides once, by rising names.

    Where a smaller leaf divides a crossed edge, one of its own edges there is crossed.
    """
    names, once = np.unique(edges.names, return_index=True)
    edges = edges.chosen(once)
    return edges.chosen(find(_find_divided(edges), names) < 0)


def _find_divided(edges: CrossedEdges) -> Ints:
    """The names, in ascending order, of all longer edges that some edges are parts of."""
    largest = int(edges.size.max(initial=0))
    found = [np.zeros(0, np.int64)]
    while len(edges.size):
        rows, size = np.arange(len(edges.size)), 2 * edges.size
        low = edges.low.copy()
        low[rows, edges.axis] -= low[rows, edges.axis] % size
        whole = (low % size[:, None] == 0).all(axis=1) & (size <= largest)
        edges = CrossedEdges(low, edges.axis, size, edges.rising).chosen(whole)
        names, once = np.unique(edges.names, return_index=True)
        edges = edges.chosen(once)
        found.append(names)
    return np.unique(np.concatenate(found))


def _leaves_round(leaves: Leaves, edges: CrossedEdges) -> Ints:
    """(n, 4) the leaf in each quadrant round the edges; a `RuntimeError` where there is none."""
    # In the order of interleaved bits the cubes of a leaf follow each other.
    start = interleaved(leaves.corner)
    order = np.argsort(start)
    start = start[order]
    rows = np.arange(len(edges.low))
    result = np.empty((len(rows), 4), np.int64)
    for quadrant, (u, v) in enumerate(QUADRANTS):
        cube = edges.low.copy()
        cube[rows, (edges.axis + 1) % 3] += u
        cube[rows, (edges.axis + 2) % 3] += v
        leaf = order[np.searchsorted(start, interleaved(cube), "right") - 1]
        beside = cube - leaves.corner[leaf]
        inside = ((beside >= 0) & (beside < leaves.size[leaf][:, None])).all(axis=1)
        if not inside.all():
            raise RuntimeError("the wall reaches a place that was not looked at")
        result[:, quadrant] = leaf
    return result


def _segments(leaves: Leaves, edges: CrossedEdges, leaf: Ints) -> tuple[Ints, Ints, Ints]:
    """Crossed edges joined in pairs on the faces between leaves.

    Returns:
        Two arrays (s, 2) with the edges that each segment joins and, for each, the quadrant
        before the face, on the same side of it for both; and (n, 4) the segment between each
        quadrant and the next.
    """
    following = np.roll(leaf, -1, axis=1)
    edge, quadrant = np.nonzero(leaf != following)
    before, after = leaf[edge, quadrant], following[edge, quadrant]
    face = edge_keys(before, after, len(leaves.size))
    order = np.argsort(face, kind="stable")
    face, edge, quadrant = face[order], edge[order], quadrant[order]
    count = np.unique(face, return_counts=True)[1]
    paired = np.repeat(count % 2 == 0, count)  # all of them where no edge is missing
    face, edge, quadrant = face[paired], edge[paired], quadrant[paired]
    count = count[count % 2 == 0]
    several = np.flatnonzero(np.repeat(count > 2, count))
    if len(several):
        turned = _round_the_face(
            leaves, edges, leaf, face[several], edge[several], quadrant[several]
        )
        edge[several], quadrant[several] = edge[several][turned], quadrant[several][turned]
    segment = np.full(leaf.shape, -1)
    segment[edge, quadrant] = np.arange(len(edge)) // 2
    first = np.stack([edge[0::2], quadrant[0::2]], axis=1)
    second = np.stack([edge[1::2], quadrant[1::2]], axis=1)
    return first, second, segment


def _round_the_face(
    leaves: Leaves, edges: CrossedEdges, leaf: Ints, face: Ints, edge: Ints, quadrant: Ints
) -> Ints:
    """The order in which pairs of crossed edges enclose the negative parts of their face."""
    before, after = leaf[edge, quadrant], leaf[edge, (quadrant + 1) % 4]
    smaller = np.where(leaves.size[before] <= leaves.size[after], before, after)
    rows = np.arange(len(edge))
    a = edges.axis[edge]
    normal = (a + 1 + quadrant % 2) % 3
    u, v = (normal + 1) % 3, (normal + 2) % 3
    middle = edges.chosen(edge).at(1) - leaves.corner[smaller] - leaves.size[smaller][:, None] / 2
    x, y = middle[rows, u], middle[rows, v]
    # Counter-clockwise the lower side runs along u, the right side along v.
    forward = np.where(a == u, y < 0, x > 0)
    leaving = edges.rising[edge] == forward
    order = np.lexsort((np.arctan2(y, x), face))
    start = np.flatnonzero(np.concatenate([[True], face[1:] != face[:-1]]))
    count = np.diff(np.concatenate([start, [len(face)]]))
    group = np.repeat(np.arange(len(start)), count)
    place = rows - start[group]
    # Where the walk starts on a negative part, its first edge belongs to the last one.
    shifted = (place + leaving[order][start][group]) % count[group]
    return np.asarray(order[start[group] + shifted])


def _join(leaf: Ints, first: Ints, second: Ints) -> Ints:
    """(n, 4) the loop of segments that each quadrant of each edge belongs to."""
    count = leaf.size
    corner = np.arange(count).reshape(leaf.shape)
    edge, quadrant = np.nonzero(leaf == np.roll(leaf, -1, axis=1))
    links = [(corner[edge, quadrant], corner[edge, (quadrant + 1) % 4])]
    (e, q), (f, r) = first.T, second.T
    same = leaf[e, q] == leaf[f, r]
    links.append((corner[e, q], corner[f, np.where(same, r, (r + 1) % 4)]))
    links.append((corner[e, (q + 1) % 4], corner[f, np.where(same, (r + 1) % 4, r)]))
    start, end = (np.concatenate(ends) for ends in zip(*links, strict=True))
    return pieces_of(start, end, count)[1].reshape(leaf.shape)

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Two surfaces cut at each other: facets divided along the seam, and which side all others lie on.

Only facets at the seam are touched. They become polygons between the seam and their own sides,
which are triangulated; any other facet goes or stays with the vertices that it is joined to.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from ..mesh.topology import edge_keys, pieces_of
from ..mesh.triangle_mesh import TriangleMesh, corners_at, rows_where
from ..mesh.triangulation import triangulate
from ..spatial.rays import inside_points
from ..util.progress import Monitor
from ..util.ragged import spread
from ..util.types import Bools, Floats, Ints
from .seams import Crossings, NotCertain, seam_of

#: Facets that are triangulated in one call: its time grows with the square of what it gets.
FACETS_PER_CALL = 16


@dataclass(frozen=True, eq=False)
class MutualCut:
    """What is left of two surfaces that were cut at each other.

    Attributes:
        vertices: (n, 3) of both, then the seam's; mm.
        first: (m, 3) facets of the first surface that lie behind the second one.
        first_source: (m,) the facet that each was or was part of.
        second: (k, 3) facets of the second surface that lie on the wanted side of the first one.
        second_source: (k,) as of the first.
    """

    vertices: Floats
    first: Ints
    first_source: Ints
    second: Ints
    second_source: Ints


def cut_mutually(
    first: TriangleMesh,
    second: TriangleMesh,
    wanted: tuple[Bools, Bools],
    within: Callable[[Floats], Bools],
    *,
    in_front: bool,
    closed: bool = True,
    monitor: Monitor,
) -> MutualCut:
    """Cut two surfaces at each other.

    Args:
        first: any part of a closed surface.
        second: closed, about all of the first one; or all of that which reaches into its box.
        wanted: (m,) and (k,) bool, facets whose remains are asked for. For those of the second
            surface the first one has to be whole where they are.
        within: tells which of (k, 3) points lie behind the first surface, mm.
        in_front: of the second surface what lies in front of the first one stays, else behind it.
        closed: whether the second surface is.
        monitor: for cancel.

    Raises:
        NotCertain: they touch within rounding, or do not divide space where they meet, or do not
            meet where the second one would have to be closed to tell what lies inside.
    """
    seam = seam_of(first, second)
    points = seam.points
    vertices = np.concatenate([first.vertices, second.vertices, points])
    shift = len(first.vertices)
    fresh = shift + len(second.vertices)
    numbers = np.arange(len(points))
    every, mine = np.ones(len(first.triangles), bool), len(seam.first.edge)
    one = _Side.of(
        first.triangles.astype(np.int64), 0, seam.first, numbers[:mine] + fresh,
        ~seam.first.falls, seam.facets[:, 0], seam.ends + fresh, every,
    )  # fmt: skip
    falls = seam.second.falls
    two = _Side.of(
        second.triangles.astype(np.int64), shift, seam.second, numbers[mine:] + fresh,
        falls if in_front else ~falls, seam.facets[:, 1],
        (seam.ends if in_front else seam.ends[:, ::-1]) + fresh, wanted[1],
    )  # fmt: skip

    def behind(rows: Ints) -> Bools:
        if not closed:
            raise NotCertain
        return inside_points(second, vertices[rows], monitor)

    def wanted_side(rows: Ints) -> Bools:
        result: Bools = within(vertices[rows]) != in_front
        return result

    ours = one.left(vertices, wanted[0], behind)
    theirs = two.left(vertices, wanted[1], wanted_side)
    return MutualCut(vertices, *ours, *theirs)


@dataclass(frozen=True, eq=False)
class _Side:
    """One of the surfaces, with all that the seam does to it; vertices numbered as of both.

    Attributes:
        triangles: (m, 3) facets.
        linked: (m,) bool, those that join vertices on one side of the other surface.
        cut: facets at the seam, ascending.
        edge: (e, 2) their edges, the lower number first.
        sides: (3 c,) the edge of each side of these facets, and `forward`, (3 c,) bool, whether
            it runs as the edge does.
        crossings: (k,) points on edges, in their order along each; `first` (e + 1,) where each
            edge's begin; `leaves` (k,) bool, whether the edge goes there from what stays.
        segments: (s, 2) the seam, what stays on its left, and `owner` (s,) the facet it is in.
    """

    triangles: Ints
    linked: Bools
    cut: Ints
    edge: Ints
    sides: Ints
    forward: Bools
    crossings: Ints
    first: Ints
    leaves: Bools
    segments: Ints
    owner: Ints

    @staticmethod
    def of(
        triangles: Ints, shift: int, found: Crossings, points: Ints, leaves: Bools, of: Ints,
        segments: Ints, linked: Bools,
    ) -> _Side:  # fmt: skip
        triangles = triangles + shift
        size = np.int64(triangles.max(initial=0) + 1)
        segments, of = segments[linked[of]], of[linked[of]]
        cut = np.unique(of)
        start = triangles[cut]
        end = np.roll(start, -1, axis=1)
        key = edge_keys(start, end, size).ravel()
        used, sides = np.unique(key, return_inverse=True)
        key = (found.edge[:, 0] + shift) * size + found.edge[:, 1] + shift
        row = np.minimum(np.searchsorted(used, key), max(len(used) - 1, 0))
        here = np.flatnonzero(used[row] == key) if len(used) else row
        row = row[here]
        order = np.lexsort((found.along[here], row))
        first = np.searchsorted(row[order], np.arange(len(used) + 1))
        return _Side(
            triangles, linked, cut, np.stack(np.divmod(used, size), axis=1), sides.ravel(),
            (start < end).ravel(), points[here][order], first, leaves[here][order], segments, of,
        )  # fmt: skip

    def left(
        self, vertices: Floats, wanted: Bools, stays: Callable[[Ints], Bools]
    ) -> tuple[Ints, Ints]:
        """What is left of wanted facets, and the facets that it was."""
        kept = self._find_kept(len(vertices), stays, wanted)
        uncut = wanted.copy()
        uncut[self.cut] = False
        uncut &= kept.take(self.triangles[:, 0], mode="clip")
        whole = np.flatnonzero(uncut)
        facet, start, end = self._outlines(kept)
        some = wanted[facet]
        pieces, source = _fill_outlines(
            vertices, self.triangles, facet[some], start[some], end[some]
        )
        return (
            np.concatenate([corners_at(self.triangles, whole), pieces]),
            np.concatenate([whole, source]),
        )

    def _find_kept(self, count: int, stays: Callable[[Ints], Bools], wanted: Bools) -> Bools:
        """(count,) bool, which vertices of linked facets stay."""
        open_edges = self.edge[np.diff(self.first) == 0]
        rows = self.linked.copy()
        rows[self.cut] = False
        joins = rows_where(rows, self.triangles)
        start = np.concatenate([joins[:, 0], joins[:, 1], open_edges[:, 0]])
        end = np.concatenate([joins[:, 1], joins[:, 2], open_edges[:, 1]])
        pieces, label = pieces_of(start, end, count)
        met = np.flatnonzero(np.diff(self.first) > 0)
        last = self.first[met + 1] - 1
        at = np.concatenate([self.edge[met, 0], self.edge[met, 1]])
        says = np.concatenate([self.leaves[self.first[met]], ~self.leaves[last]])
        yes = np.bincount(label[at[says]], minlength=pieces) > 0
        no = np.bincount(label[at[~says]], minlength=pieces) > 0
        if (yes & no).any():
            raise NotCertain
        used = np.zeros(pieces, bool)
        corners = rows_where(wanted, self.triangles).ravel()
        used[label.take(corners, mode="clip")] = True
        open_pieces = np.flatnonzero(used & ~(yes | no))
        if len(open_pieces):
            some = np.full(pieces, -1, np.int64)
            some[label[corners]] = corners
            yes[open_pieces] = stays(some[open_pieces])
        result: Bools = yes.take(label, mode="clip")
        return result

    def _outlines(self, kept: Bools) -> tuple[Ints, Ints, Ints]:
        """The facet, start and end of all that bounds what stays of cut facets."""
        # An edge between its ends and its crossings: which stretches stay.
        amount = np.diff(self.first) + 1
        edge, place = spread(amount)
        begin = self.first[edge] + place - 1
        none = np.zeros(1, np.int64)
        points = np.concatenate([self.crossings, none])
        leaves = np.concatenate([self.leaves, none > 0])
        start = np.where(place == 0, self.edge[edge, 0], points[begin])
        is_last = place == amount[edge] - 1
        end = np.where(is_last, self.edge[edge, 1], points[begin + 1])
        stays = np.where(place == 0, kept[self.edge[edge, 0]], ~leaves[begin])
        then = np.where(is_last, kept[self.edge[edge, 1]], leaves[begin + 1])
        if (stays != then).any():
            raise NotCertain
        first = np.cumsum(amount) - amount
        side, place = spread(amount[self.sides])
        row = first[self.sides[side]] + place
        side, row = side[stays[row]], row[stays[row]]
        ahead = self.forward[side]
        return (
            np.concatenate([self.cut[side // 3], self.owner]),
            np.concatenate([np.where(ahead, start[row], end[row]), self.segments[:, 0]]),
            np.concatenate([np.where(ahead, end[row], start[row]), self.segments[:, 1]]),
        )


def _fill_outlines(
    vertices: Floats, triangles: Ints, facet: Ints, start: Ints, end: Ints
) -> tuple[Ints, Ints]:
    """Triangles within outlines in facets, and the facet of each."""
    order, length = _loops(facet, start, end, len(vertices))
    owner = facet[order[np.cumsum(length) - length]]
    if (length < 3).any():
        raise NotCertain
    corner = start[order]
    alone = np.bincount(owner, minlength=len(triangles))[owner] == 1
    begin = np.cumsum(length) - length
    three, four = np.flatnonzero(alone & (length == 3)), np.flatnonzero(alone & (length == 4))
    result = [corner[begin[three][:, None] + np.arange(3)]]
    source = [owner[three]]
    for part in _halves(
        vertices, triangles[owner[four]], corner[begin[four][:, None] + np.arange(4)]
    ):
        result.append(part)
        source.append(owner[four])
    rest = np.flatnonzero(~alone | (length > 4))
    rest = rest[np.argsort(owner[rest], kind="stable")]
    row, place = spread(length[rest])
    more, theirs = _triangulate(
        vertices, triangles, owner[rest], length[rest], corner[begin[rest][row] + place]
    )
    return np.concatenate([*result, more]), np.concatenate([*source, theirs])


def _loops(facet: Ints, start: Ints, end: Ints, count: int) -> tuple[Ints, Ints]:
    """Pieces of outlines in the order in which they follow each other, and each loop's length."""
    key = facet * np.int64(count) + start
    order = np.argsort(key)
    key = key[order]
    wanted = facet * np.int64(count) + end
    place = np.minimum(np.searchsorted(key, wanted), max(len(key) - 1, 0))
    if (key[1:] == key[:-1]).any() or (key[place] != wanted).any():
        raise NotCertain
    following = order[place]
    # The loops, each from its lowest piece on.
    count, label = pieces_of(np.arange(len(facet)), following, len(facet))
    head = np.full(count, len(facet), np.int64)
    np.minimum.at(head, label, np.arange(len(facet)))
    length = np.bincount(label, minlength=count).astype(np.int64)
    first = np.cumsum(length) - length
    result = np.empty(len(facet), np.int64)
    at, going, step = head.copy(), np.arange(count), 0
    while len(going):
        result[first[going] + step] = at
        step += 1
        at = following[at]
        more = step < length[going]
        at, going = at[more], going[more]
    return result, length


def _halves(vertices: Floats, facet: Ints, four: Ints) -> tuple[Ints, Ints]:
    """Polygons of four corners as two triangles each, divided so that the lesser one is better."""
    points = vertices[four]
    corners = vertices[facet]
    up = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    choices = (((0, 1, 2), (0, 2, 3)), ((1, 2, 3), (1, 3, 0)))
    worst = [np.minimum(*(_worth(points[:, list(t)], up) for t in pair)) for pair in choices]
    better = (worst[1] > worst[0])[:, None]
    halves = [[four[:, list(t)] for t in pair] for pair in choices]
    return (
        np.where(better, halves[1][0], halves[0][0]),
        np.where(better, halves[1][1], halves[0][1]),
    )


def _worth(points: Floats, up: Floats) -> Floats:
    """Area over squared sides, negative where a triangle is turned over."""
    normal = np.cross(points[:, 1] - points[:, 0], points[:, 2] - points[:, 0])
    sides = ((points - np.roll(points, 1, axis=1)) ** 2).sum(axis=(1, 2))
    sign = np.sign(np.einsum("ij,ij->i", normal, up))
    result: Floats = sign * np.linalg.norm(normal, axis=1) / np.maximum(sides, 1e-300)
    return result


def _triangulate(
    vertices: Floats, triangles: Ints, owner: Ints, length: Ints, corner: Ints
) -> tuple[Ints, Ints]:
    """Triangles within polygons with holes; outlines of a facet follow each other."""
    if not len(owner):
        return np.zeros((0, 3), np.int64), np.zeros(0, np.int64)
    frame = corners_at(vertices, triangles[owner])
    along = frame[:, 1] - frame[:, 0]
    along /= np.linalg.norm(along, axis=1)[:, None]
    up = np.cross(along, frame[:, 2] - frame[:, 0])
    up /= np.linalg.norm(up, axis=1)[:, None]
    of = np.repeat(np.arange(len(owner)), length)
    away = corners_at(vertices, corner) - corners_at(frame[:, 0], of)
    axes = (corners_at(axis, of) for axis in (along, np.cross(up, along)))
    flat = np.stack([np.einsum("ij,ij->i", away, axis) for axis in axes], axis=1)
    facets, number = np.unique(owner, return_inverse=True)
    number = number.ravel()
    # Side by side, so that few calls do.
    spacing = 4.0 * float(np.abs(flat).max()) if len(flat) else 1.0
    flat[:, 0] += spacing * np.repeat(number % FACETS_PER_CALL, length)
    result, source = [], []
    end = np.cumsum(length)
    cuts = np.searchsorted(number, np.arange(0, len(facets) + FACETS_PER_CALL, FACETS_PER_CALL))
    loops = [flat[a:b] for a, b in zip((end - length).tolist(), end.tolist(), strict=True)]
    for begin, stop in pairwise(cuts):
        found = triangulate(loops[begin:stop]) + (end[begin] - length[begin])
        result.append(corner[found])
        source.append(owner[of[found[:, 0]]])
    return np.concatenate(result), np.concatenate(source)

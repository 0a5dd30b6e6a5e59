# SPDX-License-Identifier: LGPL-2.1-or-later
"""Vectorised remeshing: collapse short edges, flip badly placed ones, split some.

Every operation acts at once on a set of edges that do not touch each other's neighbourhoods, so
that each is safe by itself (link condition, no triangle turned over) and the whole pass is a few
numpy calls. What may be done to a vertex is told by its rank: an edge is collapsed onto the end
of higher rank, and only where the lower end may slide there (see `Rules`).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np

from ..util.linalg import cross_columns, lengths, normalize
from ..util.ragged import rows_of
from ..util.types import Bools, Floats, Ints
from .topology import among_edges, edge_keys
from .triangle_mesh import TriangleMesh, corners_at

#: A triangle may not turn by more than this (cosine) when a neighbour is collapsed or flipped.
MIN_TURN_COSINE = 0.35
#: Nor become worse than this (inradius over circumradius, 1 for an equilateral one).
MIN_QUALITY = 0.25


@dataclass(frozen=True, eq=False)
class Edges:
    """The edges of an oriented mesh.

    Attributes:
        ends: (e, 2) vertices, as the first triangle runs through them.
        triangles: (e, 2) the one or two triangles; -1 for none.
        opposite: (e, 2) the corner of each triangle that is not on the edge; -1 for none.
    """

    ends: Ints
    triangles: Ints
    opposite: Ints


def edges(triangles: Ints, vertex_count: int) -> Edges:
    """The edges of a mesh whose edges have one or two triangles each."""
    count = len(triangles)
    start = triangles.ravel(order="F")
    end = triangles[:, [1, 2, 0]].ravel(order="F")
    opposite = triangles[:, [2, 0, 1]].ravel(order="F")
    owner = np.tile(np.arange(count), 3)
    key = edge_keys(start, end, vertex_count)
    order = np.argsort(key, kind="stable")
    sorted_key = key[order]
    is_first = np.ones(len(key), bool)
    is_first[1:] = sorted_key[1:] != sorted_key[:-1]
    position = np.flatnonzero(is_first)
    one = order[position]
    has_two = np.zeros(len(position), bool)
    inside = position + 1 < len(key)
    has_two[inside] = ~is_first[position[inside] + 1]
    two = order[np.minimum(position + 1, len(key) - 1)]
    return Edges(
        np.stack([start[one], end[one]], axis=1),
        np.stack([owner[one], np.where(has_two, owner[two], -1)], axis=1),
        np.stack([opposite[one], np.where(has_two, opposite[two], -1)], axis=1),
    )


def side_lengths(points: Floats) -> tuple[Floats, Floats, Floats]:
    """(m,) each, of (m, 3, 3) triangles: side k is between corners k and k + 1."""
    one, two, three = points[:, 0], points[:, 1], points[:, 2]
    return lengths(one - two), lengths(two - three), lengths(three - one)


def longest_sides(points: Floats) -> Floats:
    """(m,) of (m, 3, 3) triangles."""
    a, b, c = side_lengths(points)
    return np.asarray(np.maximum(np.maximum(a, b), c))


def qualities(points: Floats) -> Floats:
    """(m,) 2 inradius / circumradius of (m, 3, 3) triangles: 1 equilateral, 0 degenerate."""
    c, a, b = side_lengths(points)
    product = np.maximum(a * b * c, 1e-300)
    result: Floats = (b + c - a) * (c + a - b) * (a + b - c) / product
    return result


def worse_quality(a: Floats, b: Floats, left: Floats, right: Floats) -> Floats:
    """(m,) the worse quality of the two triangles on each edge from a to b, all (m, 3)."""
    one, two = qualities(np.stack([a, b, left], axis=1)), qualities(np.stack([b, a, right], axis=1))
    return np.minimum(one, two)


def normals(points: Floats) -> Floats:
    """(m, 3) vectors of twice the area of (m, 3, 3) triangles."""
    one, two = points[:, 1] - points[:, 0], points[:, 2] - points[:, 0]
    return np.stack(cross_columns(list(one.T), list(two.T)), axis=1)


def unit_normals(points: Floats) -> Floats:
    """(m, 3) unit normals of (m, 3, 3) triangles; zero of those without area."""
    return normalize(normals(points))


def facet_normals(mesh: TriangleMesh) -> Floats:
    """(m, 3) unit normals of a mesh, outwards; zero where a triangle has no area."""
    return unit_normals(corners_at(mesh.vertices, mesh.triangles))


def heights(points: Floats) -> Floats:
    """(m,) the least heights of (m, 3, 3) triangles; zero of those without area."""
    result: Floats = lengths(normals(points)) / np.maximum(longest_sides(points), 1e-300)
    return result


def grouped(rows: Ints, values: Ints, count: int) -> tuple[Ints, Ints]:
    """The values of each of `count` rows laid end to end: (count + 1,) offsets, values."""
    order = np.argsort(rows, kind="stable")
    start = np.concatenate([[0], np.cumsum(np.bincount(rows, minlength=count))])
    return start.astype(np.int64), values[order]


@dataclass(frozen=True, eq=False)
class Rules:
    """What may be collapsed.

    Attributes:
        rank: (n,) 0 for a vertex that is free on a surface, more where it is held (on a crease,
            at a corner, on the mesh's border).
        may_slide: called with (k,) from and to vertices of edges; whether the first may be
            merged into the second, which stays where it is.
        forbidden: called likewise; whether no new edge may join the two. (An edge between two
            vertices of one border would be made again by the piece beyond the border.)
        stays_good: called with the (k, 3, 3) corners of triangles before and after; whether
            they may change like that.
        merge: called with (k,) from and to vertices of edges: the cost of merging them, and the
            place of what they become. The cheapest go first, those of infinite cost stay. None:
            the shortest first, into the middle of two free ends or else where the second one is.
        lastly: as `stays_good`, of edges that all else allows; None: nothing more is asked.
    """

    rank: Ints
    may_slide: Callable[[Ints, Ints], Bools]
    forbidden: Callable[[Ints, Ints], Bools]
    stays_good: Callable[[Floats, Floats], Bools]
    merge: Callable[[Ints, Ints], tuple[Floats, Floats]] | None = None
    lastly: Callable[[Floats, Floats], Bools] | None = None


def collapse(
    vertices: Floats, triangles: Ints, rules: Rules, shortest: float, longest: float
) -> tuple[Floats, Ints, Ints]:
    """One pass of collapsing edges shorter than `shortest`.

    An edge between two free vertices becomes its middle point, any other the vertex of higher
    rank. No edge longer than `longest` and no turned or degenerate triangle is made.

    Returns:
        vertices, triangles, and (n,) the new index of every old vertex. Vertices that stay keep
        their order; one that is gone has ~k, k the new index of what it was merged into.
    """
    count = len(vertices)
    table = edges(triangles, count)
    ends = table.ends
    length = lengths(vertices[ends[:, 0]] - vertices[ends[:, 1]])
    swap = rules.rank[ends[:, 0]] > rules.rank[ends[:, 1]]
    from_to = np.where(swap[:, None], ends[:, ::-1], ends)
    candidate = np.flatnonzero((length < shortest) & (table.triangles[:, 1] >= 0))
    gone, kept = from_to[candidate, 0], from_to[candidate, 1]
    allowed = rules.may_slide(gone, kept)
    candidate, gone, kept = candidate[allowed], gone[allowed], kept[allowed]
    if rules.merge is None:
        cost = length[candidate]
        free = (rules.rank[gone] == 0) & (rules.rank[kept] == 0)
        target = np.where(free[:, None], 0.5 * (vertices[gone] + vertices[kept]), vertices[kept])
    else:
        cost, target = rules.merge(gone, kept)
        free = np.ones(len(gone), bool)
    worth = cost < np.inf
    gone, kept, free = gone[worth], kept[worth], free[worth]
    cost, target = cost[worth], target[worth]
    identity = np.arange(count)
    if not len(gone):
        return vertices, triangles, identity

    corner_start, corner_triangle = grouped(
        triangles.ravel(), np.repeat(np.arange(len(triangles)), 3), count
    )
    both = np.concatenate([ends, ends[:, ::-1]])
    near_start, near = grouped(both[:, 0], both[:, 1], count)
    edge_keys = np.sort(both[:, 0] * np.int64(count) + both[:, 1])

    # Link condition: the ends share exactly the two corners opposite to the edge.
    rows, owner = rows_of(near_start, gone)
    key = kept[owner] * np.int64(count) + near[rows]
    found = edge_keys[np.minimum(np.searchsorted(edge_keys, key), len(edge_keys) - 1)] == key
    good = np.bincount(owner[found], minlength=len(gone)) == 2
    new, other = owner[~found], near[rows[~found]]
    outlawed = rules.forbidden(kept[new], other) & (kept[new] != other)
    good &= np.bincount(new[outlawed], minlength=len(gone)) == 0

    for side, other, moves in ((gone, kept, np.ones(len(gone), bool)), (kept, gone, free)):
        rows, owner = rows_of(corner_start, side)
        corners = triangles[corner_triangle[rows]]
        one, two, three = corners.T
        across = other[owner]
        affected = (one != across) & (two != across) & (three != across) & (moves & good)[owner]
        corners, owner = corners[affected], owner[affected]
        before = corners_at(vertices, corners)
        after = np.where(
            (corners == side[owner][:, None])[:, :, None], target[owner][:, None, :], before
        )
        bad = longest_sides(after) > longest
        # What takes longer is asked only where all else is good.
        for test in (rules.stays_good, rules.lastly):
            if test is None:
                continue
            good &= np.bincount(owner[bad], minlength=len(gone)) == 0
            rest = good[owner]
            before, after, owner = before[rest], after[rest], owner[rest]
            bad = ~test(before, after)
        good &= np.bincount(owner[bad], minlength=len(gone)) == 0
    gone, kept, target, cost = gone[good], kept[good], target[good], cost[good]

    chosen = _independent(np.stack([gone, kept], axis=1), cost, near_start, near, count)
    gone, kept, target = gone[chosen], kept[chosen], target[chosen]
    moved = vertices.copy()
    moved[kept] = target
    identity[gone] = kept
    merged = identity[triangles]
    degenerate = (
        (merged[:, 0] == merged[:, 1])
        | (merged[:, 1] == merged[:, 2])
        | (merged[:, 2] == merged[:, 0])
    )
    stay = np.ones(count, bool)
    stay[gone] = False
    renumber = np.cumsum(stay) - 1
    renumber[gone] = ~renumber[kept]
    return moved[stay], renumber[merged[~degenerate]], renumber


def stays_good(
    before: Floats, after: Floats, turn: float = MIN_TURN_COSINE, worst: float = MIN_QUALITY
) -> Bools:
    """Whether (m, 3, 3) triangles keep their side and a usable shape.

    They turn by no more than the cosine `turn`, and have a quality above `worst` or a better one
    than before.
    """
    old, new = normals(before), normals(after)
    cosine = np.einsum("ij,ij->i", old, new)
    size = lengths(old) * lengths(new)
    quality = qualities(after)
    shape = (quality > worst) | (quality > qualities(before))
    result: Bools = (cosine > turn * size) & (size > 0) & shape
    return result


def _independent(ends: Ints, cost: Floats, near_start: Ints, near: Ints, count: int) -> Bools:
    """Edges that are the cheapest of all that end in or beside their two ends' neighbours."""
    order = np.empty(len(ends), np.int64)
    order[np.argsort(cost, kind="stable")] = np.arange(len(ends))
    best = np.full(count, len(ends), np.int64)
    np.minimum.at(best, ends[:, 0], order)
    np.minimum.at(best, ends[:, 1], order)
    around = np.minimum(best, np.minimum.reduceat(best[near], near_start[:-1]))
    result: Bools = (around[ends[:, 0]] == order) & (around[ends[:, 1]] == order)
    return result


def flip(
    vertices: Floats,
    triangles: Ints,
    gain: Callable[[Ints, Ints], Floats],
    forbidden: Callable[[Ints, Ints], Bools],
    among: Bools | None = None,
) -> tuple[Ints, int]:
    """One pass of edge flips; returns the new triangles and how many edges were flipped.

    Args:
        vertices: (n, 3).
        triangles: (m, 3).
        gain: called with the (k, 2) ends of the edges that could be flipped and the (k, 2)
            corners that the flipped edges would join; positive where a flip is wanted.
        forbidden: called with (k,) corners; whether no new edge may join the two.
        among: (m,) bool, triangles beside which all the flips lie that are wanted; None: any.
    """
    count = len(vertices)
    table = edges(triangles, count)
    is_inner = table.triangles[:, 1] >= 0
    if among is not None:
        is_inner &= among[table.triangles].any(axis=1)
    inner = np.flatnonzero(is_inner)
    ends, corners = table.ends[inner], table.opposite[inner]
    pair = table.triangles[inner]
    keys = np.sort(edge_keys(table.ends[:, 0], table.ends[:, 1], count))
    new_key = edge_keys(corners[:, 0], corners[:, 1], count)
    exists = keys[np.minimum(np.searchsorted(keys, new_key), len(keys) - 1)] == new_key
    # Directed edge u -> v in the first triangle (u, v, a), v -> u in the second (v, u, b): the
    # flipped pair is (a, b, v) and (b, a, u).
    first = np.stack([corners[:, 0], corners[:, 1], ends[:, 1]], axis=1)
    second = np.stack([corners[:, 1], corners[:, 0], ends[:, 0]], axis=1)
    each = normals(corners_at(vertices, triangles))
    old_normal = each[pair[:, 0]] + each[pair[:, 1]]
    size = lengths(old_normal)
    select = np.flatnonzero(~exists & ~forbidden(corners[:, 0], corners[:, 1]))
    for new in (first, second):
        normal = normals(vertices[new[select]])
        cosine = np.einsum("ij,ij->i", normal, old_normal[select])
        longest = size[select] * lengths(normal)
        select = select[cosine > MIN_TURN_COSINE * longest]
    value = gain(ends[select], corners[select])
    select, value = select[value > 0], value[value > 0]
    if not len(select):
        return triangles, 0
    order = np.empty(len(select), np.int64)
    order[np.argsort(-value, kind="stable")] = np.arange(len(select))
    best = np.full(len(triangles), len(select), np.int64)
    for side in (0, 1):
        np.minimum.at(best, pair[select, side], order)
    chosen = (best[pair[select, 0]] == order) & (best[pair[select, 1]] == order)
    select = select[chosen]
    # Two flips elsewhere could make the same edge twice: keep one.
    _, unique = np.unique(new_key[select], return_index=True)
    select = select[unique]
    result = triangles.copy()
    result[pair[select, 0]] = first[select]
    result[pair[select, 1]] = second[select]
    return result, len(select)


def halve(
    vertices: Floats, triangles: Ints, edge: Ints, going: Ints, rounds: int
) -> tuple[Floats, Ints]:
    """Halve chosen edges of triangles, or those that their neighbours chose first.

    A chosen edge is halved if the triangle beyond chose it, too; else that one's is looked at, and
    so on (M. C. Rivara, Int. J. Numer. Meth. Engng. 40, 1997). A path ends at an open edge.

    Args:
        vertices: (n, 3) mm.
        triangles: (m, 3).
        edge: (m,) the edge that each triangle chooses, by its ends: lower * n + higher.
        going: triangles whose edges are to be halved.
        rounds: steps of the longest path.

    Returns:
        Vertices and triangles as of `split`.
    """
    count = len(vertices)
    table = edges(triangles, count)
    inner = table.triangles[:, 1] >= 0
    pair, ends = table.triangles[inner], table.ends[inner]
    name = edge_keys(ends[:, 0], ends[:, 1], count)
    beyond = np.full(len(triangles), -1, np.int64)
    for k in (0, 1):
        mine = edge[pair[:, k]] == name
        beyond[pair[mine, k]] = pair[mine, 1 - k]
    found = [np.zeros(0, np.int64)]
    for _ in range(rounds):
        going = going[beyond[going] >= 0]
        over = beyond[going]
        ends_here = edge[over] == edge[going]
        found.append(edge[going[ends_here]])
        going = np.unique(over[~ends_here])
        if not len(going):
            break
    chosen = np.unique(np.concatenate(found))
    return split(vertices, triangles, partial(among_edges, keys=chosen, count=count))


def split(
    vertices: Floats,
    triangles: Ints,
    wanted: Callable[[Ints, Ints], Bools],
    among: Ints | None = None,
) -> tuple[Floats, Ints]:
    """Split the wanted inner edges at their middles; new vertices follow the old ones.

    Args:
        vertices: (n, 3).
        triangles: (m, 3).
        wanted: called with the (k,) ends of the inner edges; it is not asked about new edges.
        among: ascending, triangles on both sides of all that are wanted; None: all.
    """
    count = len(vertices)
    among = np.arange(len(triangles)) if among is None else among
    table = edges(triangles[among], count)
    inner = np.flatnonzero(table.triangles[:, 1] >= 0)
    ends = table.ends[inner]
    chosen = inner[wanted(ends[:, 0], ends[:, 1])]
    todo, corner = table.ends[chosen], table.opposite[chosen]
    beside = among[table.triangles[chosen]]
    vertices = np.concatenate([vertices, 0.5 * (vertices[todo[:, 0]] + vertices[todo[:, 1]])])
    fresh, after = np.arange(count, len(vertices)), len(triangles)
    triangles = np.concatenate([triangles, np.zeros((2 * len(todo), 3), triangles.dtype)])
    # Which side of each of its two triangles an edge is.
    side = (triangles[beside] == todo[:, :, None]).argmax(axis=2)
    first = np.zeros(len(triangles), np.int64)
    while len(todo):
        # Ends as the triangle runs through them whose side comes first, as in a table of all edges.
        turned = np.flatnonzero(
            (side[:, 1] < side[:, 0]) | ((side[:, 1] == side[:, 0]) & (beside[:, 1] < beside[:, 0]))
        )
        for each in (todo, corner, beside, side):
            each[turned] = each[turned, ::-1]
        # Each triangle takes one split at a time; the others wait for the next round.
        rank = np.arange(len(todo))
        first[beside] = len(todo)
        for k in (0, 1):
            np.minimum.at(first, beside[:, k], rank)
        now = (first[beside] == rank[:, None]).all(axis=1)
        begin, end, other = todo, todo[:, ::-1], after + np.zeros_like(beside)
        other[now] += np.arange(2 * now.sum()).reshape(2, -1).T
        after += 2 * int(now.sum())
        for k in (0, 1):
            cut, half = beside[now, k], other[now, k]
            triangles[cut] = np.stack([begin[now, k], fresh[now], corner[now, k]], axis=1)
            triangles[half] = np.stack([fresh[now], end[now, k], corner[now, k]], axis=1)
        # An edge that waits is a side of what was cut off its triangle where it has that end.
        wait = ~now
        by = first[beside[wait]]
        which = (beside[by, 1] == beside[wait]).astype(np.int64)
        moved = now[by] & (todo[wait][:, :, None] == end[by, which][:, None]).any(axis=1)
        side[wait] = np.where(now[by], np.where(moved, 1, 2), side[wait])
        corner[wait] = np.where(now[by], fresh[by], corner[wait])
        beside[wait] = np.where(moved, other[by, which], beside[wait])
        todo, fresh, corner, beside, side = (
            each[wait] for each in (todo, fresh, corner, beside, side)
        )
    return vertices, triangles

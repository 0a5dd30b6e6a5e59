# SPDX-License-Identifier: LGPL-2.1-or-later
"""Facets as large as the deviation allows, and no larger: fewer along struts, more in crotches.

Even facets are finer than needed along a strut, which is straight, and bridge the creases where
struts meet, where the surface bends within less than their edges. Vertices that nothing needs are
merged into their neighbours; edges are flipped to where both their facets are nearer; facets that
stray are divided. Merging stops early: more rounds with longer edges make fewer but worse facets.

Edges in the faces of octants are divided (`finer_border`) as the octant beyond divides them: what
is done hangs on what is in the face only, and on no choice between things that are equally near.
"""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from ..mesh import remesh
from ..mesh.topology import among_edges, edge_keys
from ..util.ragged import rows_of
from ..util.types import Bools, Floats, Ints
from .constrained_mesh import Surface, crease_points, move_vertices, shorten_steps
from .isotropic_remesh import same_crease
from .sdf import distances_and_gradients
from .untangle import proper_border

#: Where facets are looked at, in barycentric coordinates: at ten points inside, and the middles of
#: their sides.
LOOK_AT = np.array(
    [(i, j, 6 - i - j) for i in range(7) for j in range(7 - i) if i * j * (6 - i - j)]
    + [(3, 3, 0), (0, 3, 3), (3, 0, 3)]
) / 6.0  # fmt: skip
#: Where those are that need a close look: between several struts some one point strays most.
LOOK_CLOSELY = np.array([(i, j, 12 - i - j) for i in range(13) for j in range(13 - i)]) / 12.0
#: And then about the place that strays most, in sixths of those steps.
LOOK_AROUND = np.array(
    [(i, j, -i - j) for i in range(-4, 5) for j in range(-4, 5) if abs(i + j) <= 4]
) / 72.0  # fmt: skip
#: Points that are looked at at a time: cells of many struts would take gigabytes.
POINTS_AT_ONCE = 1 << 17
#: And edges, in shares of their length.
LOOK_ALONG = tuple(k / 12.0 for k in range(1, 12))
#: An edge that strays is divided where it bows by so much of what it may stray; both ends of others
#: are lifted, which facets beside it cause.
BOWED = 0.5
#: Edges shorter than this, in wanted edges, are not divided.
SHORTEST = 0.05
#: A crease nearer to an end of an edge than this, in shares of its length, does not divide it.
NEAR_END = 0.25
#: Merging makes no edge longer than this, in wanted edges, no facet of a worse shape (2 inradius /
#: circumradius), and turns none by more than this cosine.
LONGEST = 1.5
SHAPE = 0.5
TURN = 0.7
#: A flip makes no facet of a worse shape than this.
FLIPPED_SHAPE = 0.05
#: By so much of the deviation a flip has to bring facets nearer, and by so much improve their shape
#: where they are near enough.
GAIN = 0.02
BETTER = 1e-3
FLIP_PASSES = 3
#: Rounds of dividing edges of the border, and steps that bring a new vertex to the surface.
BORDER_ROUNDS = 4
BORDER_STEPS = 5
#: Surfaces that are equally near within this, in wanted edges, draw a vertex together.
TIED = 1e-6


def facet_deviations(surface: Surface, corners: Ints, looks: Floats = LOOK_AT) -> Floats:
    """(k,) how far facets of (k, 3) vertices stray from the exact surface, mm.

    Looked at in the barycentric coordinates `looks`, (q, 3) or (k, q, 3).
    """
    return _farthest(surface, corners, looks)[0]


def _farthest(surface: Surface, corners: Ints, looks: Floats) -> tuple[Floats, Ints]:
    """How far facets stray, as `facet_deviations`, and where: (k,) which of the `looks`."""
    farthest, where = np.zeros(len(corners)), np.zeros(len(corners), np.int64)
    size = POINTS_AT_ONCE // looks.shape[-2]
    for begin in range(0, len(corners), size):
        part = slice(begin, begin + size)
        own = corners[part]
        at = np.broadcast_to(
            looks if looks.ndim == 2 else looks[part], (len(own), *looks.shape[-2:])
        )
        points = np.einsum("mqi,mik->mqk", at, surface.vertices[own])
        values = np.abs(surface.field.rows(own[:, 0]).values_of_groups(points))
        where[part] = values.argmax(axis=1)
        farthest[part] = values.max(axis=1)
    return farthest, where


def surface_deviations(surface: Surface, closely: float = np.inf) -> Floats:
    """(m,) how far the facets stray from the exact surface, mm.

    Looked at closely between several struts, and where that is more than `closely`, mm.
    """
    result = facet_deviations(surface, surface.triangles)
    # The fit lifts vertices off a ball by more than it leaves the facets between them below it.
    at_vertices = np.abs(surface.field.values(surface.vertices))
    result = np.maximum(result, at_vertices[surface.triangles].max(axis=1, initial=0.0))
    if surface.field.fillet > 0.0:  # without creases
        return result
    nearest = surface.field.nearest(surface.vertices)[1][surface.triangles]
    look = np.flatnonzero((nearest != nearest[:, :1]).any(axis=1) | (result > closely))
    result[look], where = _farthest(surface, surface.triangles[look], LOOK_CLOSELY)
    # Over a crease it peaks between the places that were looked at.
    peaked = result[look] > closely
    look, where = look[peaked], where[peaked]
    around = np.maximum(LOOK_CLOSELY[where][:, None] + LOOK_AROUND, 0.0)
    around /= around.sum(axis=2, keepdims=True)
    peaks = facet_deviations(surface, surface.triangles[look], around)
    result[look] = np.maximum(result[look], peaks)
    return result


def edge_deviations(surface: Surface, ends: Ints) -> tuple[Floats, Floats]:
    """(k,) how far edges of (k, 2) vertices stray from the exact surface, and bow to it, mm.

    Those whose ends are equally far from it, and all between, do not bow.
    """
    a, b = surface.vertices[ends[:, 0]], surface.vertices[ends[:, 1]]
    nearer = [surface.field.rows(end) for end in ends.T]
    at_a, at_b = (field.values(end) for field, end in zip(nearer, (a, b), strict=True))
    strays, bows = np.zeros((2, len(ends)))
    for share in LOOK_ALONG:
        value = nearer[share > 0.5].values(a + share * (b - a))
        strays = np.maximum(strays, np.abs(value))
        bows = np.maximum(bows, np.abs(value - at_a - share * (at_b - at_a)))
    return strays, bows


def coarser(surface: Surface, farthest: float) -> tuple[Surface, Ints]:
    """The surface without vertices inside that its facets do without.

    Args:
        surface: fitted.
        farthest: facets that are made by merging stray no farther, mm.

    Returns:
        The surface; which of its vertices before each one was.
    """
    vertices, triangles, rank = surface.vertices, surface.triangles, surface.rank
    start, around = remesh.grouped(
        triangles.ravel(), np.repeat(np.arange(len(triangles)), 3), len(vertices)
    )

    def may_slide(gone: Ints, kept: Ints) -> Bools:
        on_crease = (rank[gone] == 1) & same_crease(surface, np.stack([gone, kept], axis=1))
        result: Bools = (rank[gone] == 0) | on_crease
        return result

    stays_good = partial(remesh.stays_good, turn=TURN, worst=SHAPE)

    def merge(gone: Ints, kept: Ints) -> tuple[Floats, Floats]:
        rows, owner = rows_of(start, gone)
        corners = triangles[around[rows]]
        stays = ~(corners == kept[owner][:, None]).any(axis=1)
        corners, owner = corners[stays], owner[stays]
        after = np.where(corners == gone[owner][:, None], kept[owner][:, None], corners)
        cost = np.zeros(len(gone))
        # How far facets stray costs most to find: only of those whose shape is good.
        cost[owner[~stays_good(vertices[corners], vertices[after])]] = np.inf
        good = cost[owner] < np.inf
        np.maximum.at(cost, owner[good], facet_deviations(surface, after[good]))
        cost[cost > farthest] = np.inf
        return cost, vertices[kept]

    longest = LONGEST * surface.edge
    rules = remesh.Rules(rank, may_slide, surface.share_face, stays_good, merge)
    left, merged, renumber = remesh.collapse(vertices, triangles, rules, longest, longest)
    stay = np.flatnonzero(renumber >= 0)
    smaller = replace(
        surface, vertices=left, triangles=merged, place=surface.place[stay],
        held=surface.held[stay], field=surface.field.rows(stay), piece=surface.piece[stay],
    )  # fmt: skip
    return smaller, stay


def flipped_nearer(surface: Surface, farthest: float) -> Surface:
    """Edges flipped where that brings their facets nearer, or makes those near enough more even."""
    vertices, triangles, count = surface.vertices, surface.triangles, len(surface.vertices)
    deviations = facet_deviations(surface, triangles)

    def gain(ends: Ints, corners: Ints) -> Floats:
        (a, b), (c, d) = ends.T, corners.T
        shape = remesh.worse_quality(vertices[c], vertices[d], vertices[b], vertices[a])
        better = shape - BETTER
        better -= remesh.worse_quality(vertices[a], vertices[b], vertices[c], vertices[d])
        before = deviations[_facets_beside(triangles, ends, count)].max(axis=1)
        look = np.flatnonzero(((better > 0.0) | (before > farthest)) & (shape > FLIPPED_SHAPE))
        (a, b), (c, d) = ends[look].T, corners[look].T
        after = np.full(len(ends), np.inf)
        after[look] = np.maximum(
            facet_deviations(surface, np.stack([c, d, b], axis=1)),
            facet_deviations(surface, np.stack([d, c, a], axis=1)),
        )
        nearer = (before - after) / farthest - GAIN
        return np.where(np.maximum(before, after) > farthest, nearer, better)

    for _ in range(FLIP_PASSES):
        before = triangles
        triangles, flips = remesh.flip(vertices, triangles, gain, surface.share_face)
        if not flips:
            break
        new = (triangles != before).any(axis=1)
        deviations[new] = facet_deviations(surface, triangles[new])
    return replace(surface, triangles=triangles)


def _facets_beside(triangles: Ints, ends: Ints, count: int) -> Ints:
    """(k, 2) the facets on both sides of inner edges with (k, 2) ends."""
    key = (triangles * np.int64(count) + triangles[:, [1, 2, 0]]).ravel()
    order = np.argsort(key)
    wanted = ends * np.int64(count) + ends[:, ::-1]
    result: Ints = order[np.searchsorted(key[order], wanted)] // 3
    return result


def split_where_it_deviates(
    surface: Surface, deviations: Floats, farthest: float
) -> tuple[Surface, Ints]:
    """The surface with its inner edges divided where these, or facets beside them, stray.

    The border stays, since the octant beyond has the same.

    Args:
        surface: fitted.
        deviations: (m,) how far its facets do, mm.
        farthest: facets may stray so far from the exact surface, mm.

    Returns:
        The surface, the same one where nothing strays that can be divided, its vertices still piece
        by piece; (n, 2) which ones of before each of its vertices is, or lies between.
    """
    count = len(surface.vertices)
    same = np.repeat(np.arange(count)[:, None], 2, axis=1)
    table = remesh.edges(surface.triangles, count)
    inner = np.flatnonzero(table.triangles[:, 1] >= 0)
    if not len(inner):
        return surface, same
    ends = table.ends[inner]
    strays, bow = edge_deviations(surface, ends)
    bad = (strays > farthest) & (bow > BOWED * farthest)
    # A facet that strays though none of its edges does is divided at the inner one that bows most:
    # round a strut, not along it.
    a, b = surface.vertices[ends[:, 0]], surface.vertices[ends[:, 1]]
    length = np.linalg.norm(b - a, axis=1)
    touched = np.zeros(len(surface.triangles), bool)
    touched[table.triangles[inner[bad]]] = True
    far = np.flatnonzero(~touched & (deviations > farthest))
    most = np.full(len(touched), -1)
    by_bow = np.argsort(bow, kind="stable")
    for side in (0, 1):
        here = table.triangles[inner[by_bow], side]
        better = np.full(len(touched), -1)
        better[here] = by_bow  # the last one, which bows most, stays
        take = (better >= 0) & ((most < 0) | (bow[better] > bow[most]))
        most[take] = better[take]
    chosen = most[far]
    bad[chosen[chosen >= 0]] = True
    bad &= length > SHORTEST * surface.edge
    if not bad.any():
        return surface, same
    wanted = np.unique(edge_keys(ends[bad][:, 0], ends[bad][:, 1], count))
    parents: list[Ints] = []

    def is_wanted(one: Ints, two: Ints) -> Bools:
        result = among_edges(one, two, wanted, count)
        parents.append(np.stack([one[result], two[result]], axis=1))
        return result

    _, triangles = remesh.split(surface.vertices, surface.triangles, is_wanted)
    inside = np.ones((len(parents[0]), 3), np.int8)
    points = _between(surface, parents[0])
    return with_vertices(surface, triangles, parents[0], points, inside)


def with_vertices(
    surface: Surface, triangles: Ints, ends: Ints, points: Floats, place: NDArray[np.int8]
) -> tuple[Surface, Ints]:
    """The surface with vertices between others, all put to their pieces.

    Args:
        surface: before.
        triangles: (m, 3) whose numbers beyond those of its vertices are the new ones.
        ends: (k, 2) vertices that the new ones are between.
        points: (k, 3) where these lie, mm.
        place: (k, 3) their places, as in `Surface`.

    Returns:
        The surface; (n, 2) which ones of before each of its vertices is, or lies between.
    """
    count = len(surface.vertices)
    parents = np.concatenate([np.repeat(np.arange(count)[:, None], 2, axis=1), ends])
    order = np.argsort(surface.piece[parents[:, 0]], kind="stable")
    rank = np.empty(len(order), np.int64)
    rank[order] = np.arange(len(order))
    parents = parents[order]
    held = np.concatenate([surface.held, np.full((len(ends), 3), -1)])
    finer = replace(
        surface, vertices=np.concatenate([surface.vertices, points])[order],
        triangles=rank[triangles], place=np.concatenate([surface.place, place])[order],
        held=held[order], field=surface.field.rows(parents[:, 0]),
        piece=surface.piece[parents[:, 0]],
    )  # fmt: skip
    return move_vertices(finer, finer.vertices), parents


def _between(surface: Surface, ends: Ints) -> Floats:
    """(k, 3) points of the exact surface between the ends of edges: on a crease that they cross."""
    a, b = surface.vertices[ends[:, 0]], surface.vertices[ends[:, 1]]
    length = np.linalg.norm(b - a, axis=1)
    points: Floats = 0.5 * (a + b)
    field = surface.field.rows(ends[:, 0])
    for _ in range(3):
        value, gradient = field.values_and_gradients(points)
        size = np.maximum(np.einsum("ij,ij->i", gradient, gradient), 0.05)
        points = points - shorten_steps(gradient * (value / size)[:, None], 0.25 * surface.edge)
    if surface.field.fillet > 0.0:
        return points
    nearest = surface.field.nearest(surface.vertices)[1]
    one, two = nearest[ends[:, 0]], nearest[ends[:, 1]]
    across = np.flatnonzero(one != two)
    loose = np.ones((len(across), 3), bool)
    crease, _, good = crease_points(surface, ends[across], one[across], two[across], loose)
    for end in (a, b):
        off = np.linalg.norm(crease - end[across], axis=1)
        good &= (off > NEAR_END * length[across]) & (off < length[across])
    points[across[good]] = crease[good]
    return points


def finer_border(surface: Surface, farthest: float) -> tuple[Surface, Ints]:
    """The surface with edges of its border divided where they stray.

    Args:
        surface: its border fitted.
        farthest: edges may stray so far from the exact surface, mm.

    Returns:
        The surface, its vertices still piece by piece; (n, 2) which ones of before each of its
        vertices is, or lies between.
    """
    parents = np.repeat(np.arange(len(surface.vertices))[:, None], 2, axis=1)
    if not len(surface.triangles):
        return surface, parents
    table = remesh.edges(surface.triangles, len(surface.vertices))
    border = table.triangles[:, 1] < 0
    ends, owner = table.ends[border], table.triangles[border, 0]
    shared = (surface.place[ends[:, 0]] == surface.place[ends[:, 1]]) & surface.pinned[ends[:, 0]]
    length = np.linalg.norm(surface.vertices[ends[:, 1]] - surface.vertices[ends[:, 0]], axis=1)
    bad = (shared.sum(axis=1) == 1) & (length > SHORTEST * surface.edge)
    bad &= edge_deviations(surface, ends)[0] > farthest
    if not bad.any():
        return surface, parents
    ends, owner, shared = ends[bad], owner[bad], shared[bad]
    middles = 0.5 * (surface.vertices[ends[:, 0]] + surface.vertices[ends[:, 1]])
    place = np.where(shared, surface.place[ends[:, 0]], 1).astype(np.int8)
    triangles = _divided(surface.triangles, ends, owner, len(surface.vertices))
    finer, parents = with_vertices(surface, triangles, ends, middles, place)
    fresh = np.flatnonzero(parents[:, 0] != parents[:, 1])
    vertices = finer.vertices.copy()
    vertices[fresh] = _on_surface(finer, fresh)
    return proper_border(finer, replace(finer, vertices=vertices)), parents


def _divided(triangles: Ints, ends: Ints, owner: Ints, count: int) -> Ints:
    """Triangles with edges of theirs divided by new vertices, the first of which is `count`."""
    fresh = count + np.arange(len(ends))
    while len(ends):
        # Of a triangle with several such edges one is divided at a time.
        _, now = np.unique(owner, return_index=True)
        later = np.ones(len(ends), bool)
        later[now] = False
        one, two = ends[now].T
        corners = triangles[owner[now]]
        third = corners.sum(axis=1) - one - two
        triangles = triangles.copy()
        triangles[owner[now]] = np.stack([one, fresh[now], third], axis=1)
        added = len(triangles) + np.arange(len(now))
        triangles = np.concatenate([triangles, np.stack([fresh[now], two, third], axis=1)])
        # What waits may be an edge of the half that was added.
        ends, fresh, waiting = ends[later], fresh[later], owner[later]
        row = np.minimum(np.searchsorted(owner[now], waiting), len(now) - 1)
        moved_on = (ends == two[row][:, None]).any(axis=1)
        owner = np.where(moved_on, added[row], waiting)
    return triangles


def _on_surface(surface: Surface, index: Ints) -> Floats:
    """(k, 3) where vertices of the border come to, each in its face."""
    points, loose = surface.vertices[index], ~surface.pinned[index]
    field = surface.field.rows(index)
    owner = np.repeat(np.arange(len(index)), np.diff(field.start))
    primitives = field.primitives.take(field.near)
    for _ in range(BORDER_STEPS):
        value, gradient = distances_and_gradients(points[owner], primitives)
        least = np.minimum.reduceat(value, field.start[:-1])
        tied = value <= least[owner] + TIED * surface.edge
        mean = np.add.reduceat(gradient * tied[:, None], field.start[:-1], axis=0) * loose
        mean = mean / np.add.reduceat(tied.astype(np.float64), field.start[:-1])[:, None]
        size = np.maximum((mean * mean).sum(axis=1), 0.05)
        points = points - shorten_steps(mean * (least / size)[:, None], 0.25 * surface.edge)
    return points

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Facets divided where they stray from the exact surface: in the crotches where struts meet.

Even facets that are right along a strut bridge the creases between struts, where the surface bends
within less than their edges. There they get more vertices, and the struts between keep theirs.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..mesh import remesh
from ..util.types import Bools, Floats, Ints
from .constrained_mesh import Surface, crease_points, moved, shortened

#: Facets may stray by so many times the deviation that was asked for.
STRAYS = 1.5
#: Where edges are looked at, in shares of their length.
LOOK_AT = (0.25, 0.5, 0.75)
#: Edges shorter than this, in wanted edges, are not divided.
SHORTEST = 0.25
#: A crease nearer to an end of an edge than this, in shares of its length, does not divide it.
NEAR_END = 0.25


def split_where_it_strays(
    surface: Surface, farthest: float, before: Ints | None = None
) -> tuple[Surface, Ints, Ints]:
    """The surface with its inner edges divided where these, or facets beside them, stray.

    The border stays, since the octant beyond has the same.

    Args:
        surface: fitted.
        farthest: facets may stray so far from the exact surface, mm.
        before: (pieces,) how many edges of each piece were found the last time: where it is no
            less now, what strays is not for want of vertices, and the piece stays.

    Returns:
        The surface, the same one where nothing strays, its vertices still piece by piece; (n, 2)
        which ones of before each of its vertices is, or lies between; and (pieces,) how many edges
        were found.
    """
    count = len(surface.vertices)
    same = np.repeat(np.arange(count)[:, None], 2, axis=1)
    if not count:
        return surface, same, np.zeros(0, np.int64)
    table = remesh.edges(surface.triangles, count)
    inner = np.flatnonzero(table.triangles[:, 1] >= 0)
    if not len(inner):
        return surface, same, np.zeros(surface.piece.max() + 1, np.int64)
    ends = table.ends[inner]
    bad = _edges_stray(surface, ends) > farthest
    # A facet that strays though its edges do not is divided at its longest inner one.
    a, b = surface.vertices[ends[:, 0]], surface.vertices[ends[:, 1]]
    length = np.linalg.norm(b - a, axis=1)
    touched = np.zeros(len(surface.triangles), bool)
    touched[table.triangles[inner[bad]]] = True
    strays = np.flatnonzero(~touched & (_middles_stray(surface) > farthest))
    longest = np.full(len(touched), -1)
    by_length = np.argsort(length, kind="stable")
    for side in (0, 1):
        here = table.triangles[inner[by_length], side]
        better = np.full(len(touched), -1)
        better[here] = by_length  # the last one, and so the longest, stays
        take = (better >= 0) & ((longest < 0) | (length[better] > length[longest]))
        longest[take] = better[take]
    chosen = longest[strays]
    bad[chosen[chosen >= 0]] = True
    bad &= length > SHORTEST * surface.edge
    piece = surface.piece[ends[:, 0]]
    found = np.bincount(piece[bad], minlength=surface.piece.max() + 1)
    if before is not None:
        bad &= (found < before)[piece]
    if not bad.any():
        return surface, same, found
    low, high = ends[bad].min(axis=1), ends[bad].max(axis=1)
    wanted = np.unique(low * np.int64(count) + high)
    parents: list[Ints] = []

    def is_wanted(one: Ints, two: Ints) -> Bools:
        key = np.minimum(one, two) * np.int64(count) + np.maximum(one, two)
        result: Bools = np.isin(key, wanted)
        parents.append(np.stack([one[result], two[result]], axis=1))
        return result

    _, triangles = remesh.split(surface.vertices, surface.triangles, is_wanted)
    return *_with_vertices(surface, triangles, parents[0]), found


def _with_vertices(surface: Surface, triangles: Ints, ends: Ints) -> tuple[Surface, Ints]:
    """The surface with vertices between ends, on the exact surface, put to their pieces."""
    count = len(surface.vertices)
    parents = np.concatenate([np.repeat(np.arange(count)[:, None], 2, axis=1), ends])
    order = np.argsort(surface.piece[parents[:, 0]], kind="stable")
    rank = np.empty(len(order), np.int64)
    rank[order] = np.arange(len(order))
    parents = parents[order]
    fresh = np.concatenate([np.zeros(count, bool), np.ones(len(ends), bool)])[order]
    vertices = surface.vertices[parents].mean(axis=1)
    vertices[rank[count:]] = _between(surface, ends)
    place = surface.place[parents[:, 0]].copy()
    place[fresh] = 1
    held = surface.held[parents[:, 0]].copy()
    held[fresh] = -1
    finer = replace(
        surface, vertices=surface.vertices[parents[:, 0]], triangles=rank[triangles], place=place,
        held=held, field=surface.field.rows(parents[:, 0]), piece=surface.piece[parents[:, 0]],
    )  # fmt: skip
    return moved(finer, vertices), parents


def _between(surface: Surface, ends: Ints) -> Floats:
    """(k, 3) points of the exact surface between the ends of edges: on a crease that they cross."""
    a, b = surface.vertices[ends[:, 0]], surface.vertices[ends[:, 1]]
    length = np.linalg.norm(b - a, axis=1)
    points: Floats = 0.5 * (a + b)
    field = surface.field.rows(ends[:, 0])
    for _ in range(3):
        value, gradient = field.values_and_gradients(points)
        size = np.maximum(np.einsum("ij,ij->i", gradient, gradient), 0.05)
        points = points - shortened(gradient * (value / size)[:, None], 0.25 * surface.edge)
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


def _edges_stray(surface: Surface, ends: Ints) -> Floats:
    """(k,) how far edges stray from the exact surface, mm."""
    a, b = surface.vertices[ends[:, 0]], surface.vertices[ends[:, 1]]
    field = surface.field.rows(ends[:, 0])
    result: Floats = np.zeros(len(ends))
    for share in LOOK_AT:
        result = np.maximum(result, np.abs(field.values(a + share * (b - a))))
    return result


def _middles_stray(surface: Surface) -> Floats:
    """(m,) how far the middles of facets stray from the exact surface, mm."""
    middles = surface.vertices[surface.triangles].mean(axis=1)
    result: Floats = np.abs(surface.field.rows(surface.triangles[:, 0]).values(middles))
    return result

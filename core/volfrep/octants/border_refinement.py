# SPDX-License-Identifier: LGPL-2.1-or-later
"""Edges in the faces of octants divided where they stray, as the octant beyond divides them.

What is done hangs on what is in the face only: on the places of vertices, on distances there, and
on no choice between things that are equally near.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..mesh import remesh
from ..util.types import Floats, Ints
from .constrained_mesh import Surface, shorten_steps
from .refinement import SHORTEST, edges_stray, with_vertices
from .sdf import distances_and_gradients
from .untangle import proper_border

#: Rounds of dividing, and steps that bring a new vertex to the surface.
ROUNDS = 4
STEPS = 5
#: Surfaces that are equally near within this, in wanted edges, draw a vertex together.
TIED = 1e-6


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
    bad &= edges_stray(surface, ends) > farthest
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
    for _ in range(STEPS):
        value, gradient = distances_and_gradients(points[owner], primitives)
        least = np.minimum.reduceat(value, field.start[:-1])
        tied = value <= least[owner] + TIED * surface.edge
        mean = np.add.reduceat(gradient * tied[:, None], field.start[:-1], axis=0) * loose
        mean = mean / np.add.reduceat(tied.astype(np.float64), field.start[:-1])[:, None]
        size = np.maximum((mean * mean).sum(axis=1), 0.05)
        points = points - shorten_steps(mean * (least / size)[:, None], 0.25 * surface.edge)
    return points

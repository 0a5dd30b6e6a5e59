# SPDX-License-Identifier: LGPL-2.1-or-later
"""Untangling: octants' facets that run through each other, and borders that do, drawn apart.

Struts that meet at a small angle or leave a narrow window between them have creases nearer to each
other than a facet is long. What evens out facets and fits them to one strut may then fold them
over those of the next.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from ..mesh import remesh
from ..mesh.topology import touching, vertices_of
from ..mesh.triangle_mesh import TriangleMesh
from ..spatial.piercing import piercing_pairs
from ..spatial.self_intersection import close_pairs, crossing_triangles
from ..util.linalg import along
from ..util.types import Bools, Floats, Ints
from .constrained_mesh import Mesh, PinnedMesh, Surface, move_vertices, neighbour_mean
from .octant import STEPS

#: Facets that stick through others by no more than this, in wanted edges, only touch.
TOUCHING = 1e-6
#: Rounds of moving vertices about facets that cross. In the first few they go to the middle of
#: their neighbours, then half-way back to where they came from; every few rounds more of them.
ROUNDS = 24
SMOOTHED = 3
WIDER_AFTER = 4
#: A turn in which no plane along the axes stays one; its rows are at right angles.
TURN = np.array([[2.0, 3.0, 6.0], [6.0, 2.0, -3.0], [-3.0, 6.0, -2.0]]) / 7.0
#: An edge of the border that turns by an angle of a lesser cosine has folded over.
FOLDED = 0.2


def crossing_facets(surface: PinnedMesh, exact: bool = True, pieces: Bools | None = None) -> Bools:
    """(m,) which facets another facet of their own octant runs through.

    `pieces`: (k,) octants that are looked at; None for all.

    Exact, for the vertices as octants have them, in whole steps. Next to a face facets may lie in
    one plane, where those that overlap touch as far as anybody can tell; turned with a lattice, or
    rounded by a file, they cross, and so they are looked at turned and rounded, too. Otherwise
    those that stick through others by more than `TOUCHING`.
    """
    crossing = np.zeros(len(surface.triangles), bool)
    look = np.arange(len(crossing))
    if pieces is not None:
        look = np.flatnonzero(pieces[surface.piece[surface.triangles[:, 0]]])
    triangles = surface.triangles[look].astype(np.int32)
    if not exact:
        everywhere = np.ones(len(triangles), bool)
        mesh = TriangleMesh(_side_by_side(surface), triangles)
        crossing[look] = crossing_triangles(mesh, everywhere, TOUCHING * surface.edge)
        return crossing
    steps = np.rint(surface.vertices * (STEPS / surface.size))
    turned = np.rint(np.stack([along(steps, row) for row in TURN], axis=1))
    for vertices in (steps, turned):
        vertices[:, 0] += 4.0 * STEPS * surface.piece
        crossing[look[piercing_pairs(TriangleMesh(vertices, triangles))]] = True
    return crossing


def untangle(
    surface: Mesh,
    home: Floats,
    exact: bool = True,
    asked: Callable[[], None] = lambda: None,
) -> tuple[Mesh, Bools]:
    """The surface with facets that cross drawn apart, where that is possible.

    A vertex goes to the middle of its neighbours, off the exact surface by a part of a facet; and
    if that does not help, back to where marching cubes found it. Those on the octants' faces stay.

    Args:
        surface: its facets fitted.
        home: (n, 3) where marching cubes found its vertices, mm.
        exact: whether facets that only touch are drawn apart, as `crossing_facets` tells.
        asked: called in every round; what it raises ends the work.

    Returns:
        The surface, and (m,) which facets still cross.
    """
    count, triangles = len(surface.vertices), surface.triangles
    pairs = np.concatenate([triangles[:, :2], triangles[:, 1:], triangles[:, ::2]])
    border = surface.pinned.any(axis=1)
    pieces = np.ones(surface.piece.max(initial=-1) + 1, bool)
    crossed = _wrong(surface, exact, pieces)
    for turn in range(ROUNDS):
        if not crossed.any():
            break
        asked()
        near = vertices_of(triangles[crossed], count)
        pieces[:] = False  # the others stay as they are
        pieces[surface.piece[near]] = True
        for _ in range(turn // WIDER_AFTER):
            near[triangles[touching(near, triangles)]] = True
        goes = (near & ~border)[:, None]
        if turn < SMOOTHED:
            target: Floats = neighbour_mean(count, pairs, surface.vertices)[0]
        else:
            target = 0.5 * (surface.vertices + home)
        surface = move_vertices(surface, np.where(goes, target, surface.vertices))
        crossed = _wrong(surface, exact, pieces)
    return surface, crossed


def _wrong(surface: PinnedMesh, exact: bool, pieces: Bools) -> Bools:
    """(m,) which facets of some of the octants cross, or are as flat as a line.

    Whether such a one beside others that crossed does so, once it is turned and rounded, is chance.
    """
    crossing = crossing_facets(surface, exact, pieces)
    if exact:
        heights = remesh.heights(surface.vertices[surface.triangles])
        crossing |= heights < TOUCHING * surface.edge
    return crossing


def proper_border(before: Surface, after: Surface) -> Surface:
    """`after` with vertices put back where the border in a face folds over or crosses itself.

    No facet inside could mend that. Only what is in the face decides, so that the octant beyond
    comes to the same.

    Args:
        before: the surface, with a proper border.
        after: the same with vertices moved.
    """
    table = remesh.edges(after.triangles, len(after.vertices))
    ends = table.ends[table.triangles[:, 1] < 0]
    may_return = after.pinned.sum(axis=1) == 1
    old = before.vertices[ends[:, 1]] - before.vertices[ends[:, 0]]
    vertices, held = after.vertices.copy(), after.held.copy()
    while True:
        new = vertices[ends[:, 1]] - vertices[ends[:, 0]]
        cosine = np.einsum("ij,ij->i", old, new)
        size = np.linalg.norm(old, axis=1) * np.linalg.norm(new, axis=1)
        wrong = cosine < FOLDED * size
        wrong[_crossing_edges(replace(after, vertices=vertices), ends)] = True
        back = np.zeros(len(vertices), bool)
        back[ends[wrong]] = True
        back &= may_return
        if not back.any():
            return replace(after, vertices=vertices, held=held)
        vertices[back], held[back] = before.vertices[back], before.held[back]
        may_return &= ~back


def _crossing_edges(surface: Surface, ends: Ints) -> Ints:
    """Which edges of the border cross another one of their face."""
    points = _side_by_side(surface)
    corners = points[ends[:, [0, 1, 1]]]
    found = [np.zeros(0, np.int64)]
    place, pinned = surface.place, surface.pinned
    same = (place[ends[:, 0]] == place[ends[:, 1]]) & pinned[ends[:, 0]]
    axis, side = same.argmax(axis=1), place[ends[:, 0]]
    level = side[np.arange(len(ends)), axis]
    # The two axes along each face.
    flat = np.array([[1, 2], [2, 0], [0, 1]])[axis]
    for a, b in close_pairs(corners, np.ones(len(ends), bool)):
        apart = (ends[a][:, :, None] != ends[b][:, None, :]).all(axis=(1, 2))
        apart &= (axis[a] == axis[b]) & (level[a] == level[b])
        a, b = a[apart], b[apart]
        p, q, u, v = (
            np.take_along_axis(points[end], flat[a], axis=1)
            for end in (ends[a, 0], ends[a, 1], ends[b, 0], ends[b, 1])
        )
        touch = TOUCHING * surface.edge
        cross = ~(_on_one_side(p, q, u, v, touch) | _on_one_side(u, v, p, q, touch))
        found += [a[cross], b[cross]]
    return np.unique(np.concatenate(found))


def _on_one_side(a: Floats, b: Floats, c: Floats, d: Floats, touch: float) -> Bools:
    """Whether flat points c and d lie on the same side of the lines through a and b, off them.

    On a line is what is nearer than that: where ends meet, another octant rounds otherwise.
    """
    along = b - a
    away = [along[:, 0] * (p - a)[:, 1] - along[:, 1] * (p - a)[:, 0] for p in (c, d)]
    off = touch * np.linalg.norm(along, axis=1)
    result: Bools = (np.minimum(*away) > off) | (np.maximum(*away) < -off)
    return result


def _side_by_side(surface: PinnedMesh) -> Floats:
    """The vertices with the octants side by side, so that no two of them meet."""
    vertices = surface.vertices.copy()
    vertices[:, 0] += 2.0 * surface.size * surface.piece
    return vertices

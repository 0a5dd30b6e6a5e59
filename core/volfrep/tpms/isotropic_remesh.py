# SPDX-License-Identifier: LGPL-2.1-or-later
"""Even triangles inside the octants of a wall, on its exact surface, of its exact volume."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from ..mesh import remesh
from ..octants.constrained_mesh import PinnedMesh, move_vertices, neighbour_mean, shorten_steps
from ..util.linalg import normalize
from ..util.progress import Monitor
from ..util.types import Bools, Floats, Ints

#: Edges shorter than this are collapsed, none longer than that is made, in wanted edges.
COLLAPSE_BELOW, COLLAPSE_UP_TO = 0.7, 1.5
#: Rounds of collapsing, and of evening out after that.
COLLAPSE_ROUNDS, EVEN_ROUNDS = 3, 2
#: A vertex slides this part of the way to the middle of its neighbours.
SLIDE = 0.8
#: The volume is put right by moving vertices no further than this, in wanted edges.
BALANCE_REACH = 0.1
_QUADRATURE = np.array([[4, 1, 1], [1, 4, 1], [1, 1, 4]]) / 6.0

#: Distances to the wall's surface and their gradients, of (n, 3) points in the frames of (n,)
#: octants, mm.
Distances = Callable[[Floats, Ints], tuple[Floats, Floats]]


def remesh_evenly(
    raw: PinnedMesh, field: Distances, gently: bool, monitor: Monitor
) -> tuple[PinnedMesh, Ints]:
    """Even triangles on the wall's surface, and which of the raw vertices theirs were.

    Args:
        raw: what marching cubes found, with a settled border.
        field: distances to the wall, at points in their octants' frames.
        gently: all its triangles stay.
        monitor: for cancel.
    """
    surface, origin = raw, np.arange(len(raw.vertices))
    if not len(raw.triangles):
        return surface, origin
    for _ in range(0 if gently else COLLAPSE_ROUNDS):
        surface, stay = _collapse(surface)
        origin = origin[stay]
        surface = _even(_flip(surface), field)
        monitor.tick()
    for _ in range(1 if gently else EVEN_ROUNDS):
        surface = _even(surface if gently else _flip(surface), field)
        monitor.tick()
    if not gently:
        surface = _flip(surface)
    return _balance_volume(surface, field), origin


def _even(surface: PinnedMesh, field: Distances) -> PinnedMesh:
    """Inner vertices slid to the middle of their neighbours, on the wall's surface."""
    inner = ~surface.pinned.any(axis=1)
    pairs = remesh.edges(surface.triangles, len(surface.vertices)).ends
    mean, _ = neighbour_mean(len(surface.vertices), pairs, surface.vertices)
    vertices = surface.vertices.copy()
    vertices[inner] += SLIDE * (mean - vertices)[inner]
    value, gradient = field(vertices[inner], surface.piece[inner])
    vertices[inner] -= shorten_steps(gradient * value[:, None], surface.edge)
    return move_vertices(surface, vertices)


def _balance_volume(surface: PinnedMesh, field: Distances) -> PinnedMesh:
    """Inner vertices moved along their normals, all alike, so that the volume is right.

    What facets miss of it is the integral of the distance over them.
    """
    if not len(surface.triangles):
        return surface
    corners = surface.vertices[surface.triangles]
    points = np.einsum("qi,mik->mqk", _QUADRATURE, corners).reshape(-1, 3)
    piece = np.repeat(surface.piece[surface.triangles[:, 0]], len(_QUADRATURE))
    value, _ = field(points, piece)
    normal = remesh.normals(corners)
    area = 0.5 * np.linalg.norm(normal, axis=1)
    inner = ~surface.pinned.any(axis=1)
    swept = float((area * inner[surface.triangles].sum(axis=1)).sum()) / 3.0
    if swept <= 0.0:
        return surface
    limit = BALANCE_REACH * surface.edge
    missed = float((area * value.reshape(len(area), -1).mean(axis=1)).sum())
    amount = float(np.clip(-missed / swept, -limit, limit))
    summed = np.zeros_like(surface.vertices)
    for corner in range(3):
        for k in range(3):
            summed[:, k] += np.bincount(
                surface.triangles[:, corner], normal[:, k], minlength=len(summed)
            )
    summed = normalize(summed)
    return move_vertices(surface, surface.vertices + np.where(inner[:, None], amount * summed, 0.0))


def _collapse(surface: PinnedMesh) -> tuple[PinnedMesh, Ints]:
    def may_slide(gone: Ints, kept: Ints) -> Bools:
        free: Bools = surface.rank[gone] == 0
        return free

    rules = remesh.Rules(surface.rank, may_slide, surface.share_face, remesh.stays_good)
    vertices, triangles, renumber = remesh.collapse(
        surface.vertices, surface.triangles, rules, COLLAPSE_BELOW * surface.edge,
        COLLAPSE_UP_TO * surface.edge,
    )  # fmt: skip
    stay = np.flatnonzero(renumber >= 0)
    smaller = replace(
        surface, vertices=vertices, triangles=triangles, place=surface.place[stay],
        piece=surface.piece[stay],
    )  # fmt: skip
    return smaller, stay


def _flip(surface: PinnedMesh) -> PinnedMesh:
    """Flips that make angles better."""
    v = surface.vertices

    def gain(ends: Ints, corners: Ints) -> Floats:
        a, b, c, d = v[ends[:, 0]], v[ends[:, 1]], v[corners[:, 0]], v[corners[:, 1]]
        return remesh.worse_quality(c, d, b, a) - remesh.worse_quality(a, b, c, d) - 1e-3

    triangles = surface.triangles
    for _ in range(2):
        triangles, flipped = remesh.flip(v, triangles, gain, surface.share_face)
        if not flipped:
            break
    return replace(surface, triangles=triangles)

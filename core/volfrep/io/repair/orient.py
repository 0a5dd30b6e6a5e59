# SPDX-License-Identifier: LGPL-2.1-or-later
"""Neighbours that look to the same side, and edges of many triangles taken apart."""

from __future__ import annotations

import numpy as np

from ...mesh.topology import Sides, pieces_of
from ...mesh.triangle_mesh import TriangleMesh
from ...util.errors import VolfrepError
from ...util.linalg import axes_across, normalize
from ...util.numbers import place_text, plural
from ...util.types import Bools, Ints


def orient(mesh: TriangleMesh, edges: Sides, name: str) -> tuple[TriangleMesh, Bools]:
    """Neighbours over edges of two triangles wound alike, each piece as most of its area was.

    Returns:
        The mesh, and which triangles were turned.

    Raises:
        VolfrepError: a piece has one side only.
    """
    one, other = edges.pairs()
    disagree = edges.sides[one, 0] == edges.sides[other, 0]
    count = len(mesh.triangles)
    if not disagree.any():
        return mesh, np.zeros(count, bool)
    # Two copies of every triangle, as given and turned; an edge joins the copies that agree.
    a, b = one // 3, other // 3
    c, d = np.where(disagree, b + count, b), np.where(disagree, b, b + count)
    _, piece = pieces_of(np.concatenate([a, a + count]), np.concatenate([c, d]), 2 * count)
    as_given, turned_round = piece[:count], piece[count:]
    if (as_given == turned_round).any():
        where = mesh.triangles[np.flatnonzero(as_given == turned_round)[0]]
        raise VolfrepError(
            f"'{name}' has a one-sided surface near "
            f"{place_text(mesh.vertices[where].mean(axis=0))}: it encloses no volume."
        )
    area = np.bincount(as_given, weights=mesh.areas(), minlength=int(piece.max()) + 1)
    mine, its = area[as_given], area[turned_round]
    turned = (mine < its) | ((mine == its) & (as_given > turned_round))
    triangles = np.where(turned[:, None], mesh.triangles[:, ::-1], mesh.triangles)
    return TriangleMesh(mesh.vertices, np.ascontiguousarray(triangles)), turned


def separate(mesh: TriangleMesh, edges: Sides) -> tuple[TriangleMesh, list[str]]:
    """Bodies that touch along an edge or at a vertex, taken apart there.

    Round an edge of four triangles or more, those that bound the same wedge of material are
    neighbours. A vertex where several fans of triangles meet becomes one for each. Places stay.

    Args:
        mesh: with as many triangles along each edge one way as the other.
        edges: of the mesh.
    """
    one, other = edges.pairs()
    many = np.flatnonzero((edges.count > 2)[edges.number])
    if len(many):
        first, second = _round_edges(mesh, edges.sides, edges.number, many)
        one, other = np.concatenate([one, first]), np.concatenate([other, second])
    # A side's start is the other side's end: corners are joined where their triangles are.
    following = np.arange(3 * len(mesh.triangles)).reshape(-1, 3)[:, [1, 2, 0]].ravel()
    joined = np.concatenate([one, following[one]]), np.concatenate([following[other], other])
    count, fan = pieces_of(joined[0], joined[1], 3 * len(mesh.triangles))
    if count == len(mesh.vertices):
        return mesh, []
    corner = np.zeros(count, np.int64)
    corner[fan] = np.arange(len(fan))
    vertices = mesh.vertices[mesh.triangles.ravel()[corner]]
    apart = TriangleMesh(vertices, fan.reshape(-1, 3).astype(np.int32))
    if len(many):
        places = int((edges.count > 2).sum())
        return apart, [f"Surfaces that touch along {plural(places, 'edge')} taken apart there"]
    places = count - len(mesh.vertices)
    return apart, [f"Surfaces that touch at {plural(places, 'vertex', 'vertices')} taken apart"]


def _round_edges(mesh: TriangleMesh, sides: Ints, number: Ints, many: Ints) -> tuple[Ints, Ints]:
    """Pairs of sides on edges of many triangles, that bound the same wedge of material."""
    low, high = sides[many].min(axis=1), sides[many].max(axis=1)
    origin = mesh.vertices[low]
    along = normalize(mesh.vertices[high] - origin)
    u, v = axes_across(along)
    third = mesh.triangles.ravel()[many // 3 * 3 + (many % 3 + 2) % 3]
    to_third = mesh.vertices[third] - origin
    angle = np.arctan2(np.einsum("ij,ij->i", to_third, v), np.einsum("ij,ij->i", to_third, u))
    edge = number[many]
    forward = sides[many, 0] == low
    # Round the edge, against the clock, material begins at a side that runs backward and ends at
    # one that runs forward: brackets that open and close.
    order = np.lexsort((~forward, angle, edge))
    edge, forward, many = edge[order], forward[order], many[order]
    step = np.where(forward, -1, 1)
    level = np.cumsum(step)  # every edge's steps sum to zero
    begins = np.flatnonzero(np.diff(edge, prepend=-1))
    size = np.diff(begins, append=len(edge))
    lowest = np.minimum.reduceat(level, begins)
    base = np.repeat(lowest, size)
    # The brackets match from just behind the lowest place on.
    at_lowest = np.flatnonzero(level == base)
    start = at_lowest[np.unique(edge[at_lowest], return_index=True)[1]]
    own = np.arange(len(edge)) - np.repeat(begins, size)
    shift = np.repeat(start - begins + 1, size)
    turn = (own - shift) % np.repeat(size, size)
    depth = level - base + np.where(forward, 1, 0)
    matched = np.lexsort((turn, depth, edge))
    return many[matched[0::2]], many[matched[1::2]]

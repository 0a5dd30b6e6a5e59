# SPDX-License-Identifier: LGPL-2.1-or-later
"""Isotropic, feature-sensitive remeshing of an octant's surface, all pieces at once.

Marching cubes leaves slivers and cuts the creases where struts meet. Three steps make even
triangles of its own, with edges on the creases, in a few passes each:

1. even out: collapse short edges, flip, slide the vertices along the surface (tangential
   smoothing; the scheme of Botsch and Kobbelt, A remeshing approach to multiresolution modeling,
   2004, without splits);
2. sharpen: where an edge crosses a crease, put its nearer end on the crease, so that edges run
   along it (the idea of Kobbelt et al., Feature sensitive surface extraction, 2001);
3. even out again, the vertices on creases sliding along them.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from ..mesh import remesh
from ..util.types import Bools, Floats, Ints
from .constrained_mesh import (
    ON_SURFACE,
    Surface,
    between_samples,
    crease_points,
    move_vertices,
    neighbour_mean,
    project,
)
from .sdf import distances, distances_and_gradients
from .untangle import proper_border

#: Edges shorter than this, in units of the wanted edge, are collapsed.
COLLAPSE_BELOW = 0.7
#: No collapse makes an edge longer than this, in units of the wanted edge: how far an edge strays
#: from a strut grows with the square of its length.
COLLAPSE_UP_TO = 1.3
#: Passes of flips at a time.
FLIP_PASSES = 2
#: A vertex may move this far, in units of the wanted edge, to reach a crease.
SNAP_REACH = 1.5
#: Both ends of an edge are equally near to a crease within this, in units of the wanted edge.
TIED = 1e-6
#: Halvings that settle a vertex on an octant's edge.
BISECTIONS = 30


def remesh_evenly(
    raw: Surface, gently: bool = False, asked: Callable[[], None] = lambda: None
) -> tuple[Surface, Ints]:
    """Remesh: even triangles with their edges on the creases, vertices on the exact surface.

    Args:
        raw: what marching cubes found.
        gently: inside, all triangles stay, and creases are not looked for; the border comes out
            the same.
        asked: called in every round; what it raises ends the work.

    Returns:
        The surface, and which of the raw vertices its own were.
    """
    origin = np.arange(len(raw.vertices))
    if not len(raw.triangles):
        return raw, origin
    settled = _settle_on_edges(raw)
    # Proper step by step: a vertex of a crease in a narrow corner of a face would return with all
    # its steps, and the border would pass the crease by.
    surface = proper_border(settled, _relax(project(settled), border=True, passes=2))
    surface = _hold_on_edges(surface)
    surface = proper_border(surface, _sharpen_border(surface))
    surface = proper_border(surface, _relax(surface, border=True, passes=3))
    if gently:
        return _relax(surface), origin
    for _ in range(3):
        asked()
        surface, stay = _collapse(surface)
        origin = origin[stay]
        surface = _relax(flip_edges(surface))
    if surface.field.fillet <= 0.0:
        for _ in range(3):
            asked()
            surface = flip_edges(_sharpen(surface))
            surface, stay = _collapse(surface)
            origin = origin[stay]
    for _ in range(3):
        asked()
        surface = _relax(flip_edges(surface))
    return flip_edges(surface), origin


def _relax(surface: Surface, *, border: bool = False, passes: int = 1) -> Surface:
    """Vertices slid to the middle of their neighbours: the border's own, or all the others."""
    count = len(surface.vertices)
    table = remesh.edges(surface.triangles, count)
    pins = surface.pinned.sum(axis=1)
    open_pairs = table.ends[table.triangles[:, 1] < 0]
    rank = surface.rank
    crease_pairs = table.ends[same_crease(surface, table.ends)]
    for _ in range(passes):
        vertices = surface.vertices
        if border:
            target, movable = neighbour_mean(count, open_pairs, vertices, 2)
            movable &= (pins == 1) & (surface.held[:, 0] < 0)
        else:
            target, movable = neighbour_mean(count, table.ends, vertices)
            movable &= rank == 0
            along, has_two = neighbour_mean(count, crease_pairs, vertices, 2)
            has_two &= rank == 1
            target[has_two] = along[has_two]
            movable |= has_two
        step = np.where(movable[:, None], target - vertices, 0.0) * ~surface.pinned
        surface = project(replace(surface, vertices=vertices + 0.8 * step))
    return surface


def same_crease(surface: Surface, ends: Ints) -> Bools:
    """Whether an edge runs along a crease: its ends are held by two common primitives."""
    one, two = surface.held[ends[:, 0]], surface.held[ends[:, 1]]
    common = (one[:, :, None] == two[:, None, :]) & (one[:, :, None] >= 0)
    result: Bools = common.any(axis=2).sum(axis=1) >= 2
    return result


def _collapse(surface: Surface) -> tuple[Surface, Ints]:
    rank = surface.rank

    def may_slide(gone: Ints, kept: Ints) -> Bools:
        free = rank[gone] == 0
        along = (rank[gone] == 1) & same_crease(surface, np.stack([gone, kept], axis=1))
        twins = (rank[gone] == 2) & (surface.held[gone] == surface.held[kept]).all(axis=1)
        result: Bools = free | along | twins
        return result

    rules = remesh.Rules(rank, may_slide, surface.share_face, remesh.stays_good)
    vertices, triangles, renumber = remesh.collapse(
        surface.vertices,
        surface.triangles,
        rules,
        COLLAPSE_BELOW * surface.edge,
        COLLAPSE_UP_TO * surface.edge,
    )
    stay = np.flatnonzero(renumber >= 0)
    smaller = Surface(
        vertices,
        triangles,
        surface.place[stay],
        surface.edge,
        surface.step,
        surface.piece[stay],
        surface.size,
        surface.held[stay],
        surface.field.rows(stay),
    )
    return project(smaller), stay


def flip_edges(surface: Surface) -> Surface:
    """Flips that make angles better, or that take an edge out of the way of a crease."""
    field, v = surface.field, surface.vertices
    nearest = field.nearest(v)[1]
    # How far the middle of an edge may stray over a strut that is round: its sagitta.
    sagitta = 0.25 * surface.edge**2 / field.primitives.radius.min()

    def gain(ends: Ints, corners: Ints) -> Floats:
        a, b, c, d = v[ends[:, 0]], v[ends[:, 1]], v[corners[:, 0]], v[corners[:, 1]]
        better = remesh.worse_quality(c, d, b, a) - remesh.worse_quality(a, b, c, d) - 1e-3
        # Only an edge between two primitives can lie across a crease: no other is looked at
        # unless its flip is wanted.
        look = np.flatnonzero((better > 0.0) | (nearest[ends[:, 0]] != nearest[ends[:, 1]]))
        before = np.abs(field.rows(ends[look, 0]).values(0.5 * (a + b)[look]))
        after = np.abs(field.rows(corners[look, 0]).values(0.5 * (c + d)[look]))
        nearer = np.maximum(before - sagitta, 0.0) - np.maximum(after - sagitta, 0.0)
        better[look] += 4.0 * nearer / surface.edge
        better[look[(after > sagitta) & (after > before)]] = -1.0
        return better

    triangles = surface.triangles
    for _ in range(FLIP_PASSES):
        triangles, count = remesh.flip(v, triangles, gain, surface.share_face)
        if not count:
            break
    return replace(surface, triangles=triangles)


def _settle_on_edges(surface: Surface) -> Surface:
    """Vertices on an octant's edges put where the field is zero, by bisection.

    Each stays between the two samples that it was found between, and so in its place among the
    others on the edge: Newton's method could jump to the other side of a narrow gap.
    """
    index = np.flatnonzero(surface.pinned.sum(axis=1) == 2)
    if not len(index):
        return surface
    field, points = surface.field.rows(index), surface.vertices[index]
    low, high = between_samples(surface, index)
    at_low, at_high = field.values(low), field.values(high)
    positive = at_high > 0.0
    # Where the zero is (nearly) at a sample there may be no change of sign left in between.
    stuck = (at_low > 0.0) == positive
    nearer = np.where((np.abs(at_low) < np.abs(at_high))[:, None], low, high)
    low, high = (np.where(stuck[:, None], nearer, end) for end in (low, high))
    for _ in range(BISECTIONS):
        points = 0.5 * (low + high)
        to_high = (field.values(points) > 0.0) == positive
        low = np.where(to_high[:, None], low, points)
        high = np.where(to_high[:, None], points, high)
    vertices = surface.vertices.copy()
    vertices[index] = points
    return replace(surface, vertices=vertices)


def _hold_on_edges(surface: Surface) -> Surface:
    """Vertices on an octant's edges cannot be moved onto a crease: note which ones are on it."""
    if surface.field.fillet > 0.0:
        return surface
    index = np.flatnonzero(surface.pinned.sum(axis=1) >= 2)
    held = surface.held.copy()
    held[index] = surface.field.rows(index).touching(
        surface.vertices[index], ON_SURFACE * surface.edge
    )
    return replace(surface, held=held)


def _sharpen_border(surface: Surface) -> Surface:
    """On the faces: the nearer end of an edge that crosses a crease moved onto it."""
    if surface.field.fillet > 0.0:
        return surface
    table = remesh.edges(surface.triangles, len(surface.vertices))
    return _snap(surface, table.ends[table.triangles[:, 1] < 0], surface.pinned.sum(axis=1) == 1)


def _sharpen(surface: Surface) -> Surface:
    """Inside: the nearer end of an edge that crosses a crease moved onto it."""
    table = remesh.edges(surface.triangles, len(surface.vertices))
    ends = table.ends[table.triangles[:, 1] >= 0]
    return _snap(surface, ends, surface.rank == 0)


def _snap(surface: Surface, ends: Ints, movable: Bools) -> Surface:
    """Put one end of every edge that crosses a crease on the crease.

    An edge crosses one where its ends lie on different primitives whose surfaces meet at an angle
    between them. Where a third primitive buries the crossing, the corner of the three is taken.
    """
    nearest = surface.field.nearest(surface.vertices)[1]
    held = np.where(surface.held[:, :1] >= 0, surface.held, -1)
    held[held[:, 0] < 0, 0] = nearest[held[:, 0] < 0]
    one, two = held[ends[:, 0]], held[ends[:, 1]]
    apart = ~((one[:, :, None] == two[:, None, :]) & (one[:, :, None] >= 0)).any(axis=(1, 2))
    apart &= movable[ends].any(axis=1)
    ends, one, two = ends[apart], one[apart], two[apart]
    one, two = (
        _toward(surface, held_by, ends[:, end], surface.vertices[ends[:, 1 - end]])
        for end, held_by in enumerate((one, two))
    )
    # An end that touches the other's primitive as well is on the crease already.
    primitives, tolerance = surface.field.primitives, ON_SURFACE * surface.edge
    at_one, _ = distances_and_gradients(surface.vertices[ends[:, 0]], primitives.take(two))
    at_two, _ = distances_and_gradients(surface.vertices[ends[:, 1]], primitives.take(one))
    apart = np.minimum(at_one, at_two) > tolerance
    ends, one, two = ends[apart], one[apart], two[apart]
    if not len(ends):
        return surface
    loose = ~(surface.pinned[ends[:, 0]] & surface.pinned[ends[:, 1]])
    point, held_by, good = crease_points(surface, ends, one, two, loose)

    gap = np.linalg.norm(surface.vertices[ends] - point[:, None], axis=2)
    gap[~movable[ends]] = np.inf
    winner = np.argmin(gap, axis=1)
    even = np.isclose(gap[:, 0], gap[:, 1], rtol=0.0, atol=TIED * surface.edge)
    winner[even] = _first_end(surface, ends[even])
    vertex = ends[np.arange(len(ends)), winner]
    distance = gap.min(axis=1)
    good &= distance < SNAP_REACH * surface.edge
    vertex, point, held_by, distance = vertex[good], point[good], held_by[good], distance[good]
    # Each vertex takes the nearest of the places that its edges propose, corners first; of places
    # that are equally near one that the octant beyond takes, too.
    corner = held_by[:, 2] >= 0
    point_in_order = _in_order(surface, vertex, vertex, point)
    steps = np.round(np.column_stack([point_in_order[:, ::-1], distance]) / (TIED * surface.edge))
    order = np.lexsort((*steps.T, ~corner))
    vertex, first = np.unique(vertex[order], return_index=True)
    pick = order[first]
    vertices, new_held = surface.vertices.copy(), surface.held.copy()
    vertices[vertex], new_held[vertex] = point[pick], held_by[pick]
    return replace(move_vertices(surface, vertices), held=new_held)


def _first_end(surface: Surface, ends: Ints) -> Ints:
    """(k,) 0 or 1, the end of edges that comes first along an axis, whoever numbers them."""
    points = surface.vertices[ends]
    way = _in_order(surface, ends[:, 0], ends[:, 1], points[:, 1] - points[:, 0])
    way[np.abs(way) < TIED * surface.edge] = 0.0
    axis = (way != 0.0).argmax(axis=1)
    result: Ints = (way[np.arange(len(way)), axis] < 0.0).astype(np.int64)
    return result


def _in_order(surface: Surface, one: Ints, two: Ints, vectors: Floats) -> Floats:
    """(k, 3) vectors with the two axes of a face first, the next after the face's own before all.

    So octants are alike, ties and all, whose axes are exchanged in turn.

    Args:
        surface: whose vertices they belong to.
        one: (k,) vertices.
        two: (k,) others that have a face in common with these: where none has, x comes first.
        vectors: (k, 3).
    """
    shared = (surface.place[one] == surface.place[two]) & surface.pinned[one]
    own = np.where(shared.any(axis=1), shared.argmax(axis=1), 2)
    return np.take_along_axis(vectors, (own[:, None] + np.array([1, 2, 3])) % 3, axis=1)


def _toward(surface: Surface, held: Ints, vertex: Ints, others: Floats) -> Ints:
    """(k,) the primitive that vertices lie on, of the (k, 3) that hold them: mostly the first.

    A vertex on an octant's edge may lie on several. Octants beyond name these in another order,
    and take the same one, which is the nearest to the edge's other end.
    """
    result = held[:, 0].copy()
    look = np.flatnonzero((surface.pinned[vertex].sum(axis=1) >= 2) & (held[:, 1] >= 0))
    if len(look):
        points = np.repeat(others[look, None], 3, axis=1)
        away = distances(points, surface.field.primitives.take(held[look]))
        away[held[look] < 0] = np.inf
        result[look] = held[look, np.argmin(away, axis=1)]
    return result

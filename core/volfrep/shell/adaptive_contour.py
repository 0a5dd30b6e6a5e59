# SPDX-License-Identifier: LGPL-2.1-or-later
"""Adaptive dual contouring: cubes are halved until the surface at a depth is where it should be."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..util.types import Bools, Floats, Ints
from .depth import Depth
from .dual_contouring import Facets, facets, place_vertices
from .octree import Crossings, Leaves, cross, find, name, named
from .sampled_depth import COARSEST, DepthField

#: Cubes are halved where a facet strays by more than this, in units of the thickness.
DEVIATION = 0.02
#: But cubes smaller than `SMALL` (thicknesses) only where one strays by more than this: a part of
#: the cavity ends where it gets narrower than twice as much.
DEVIATION_SMALL = 0.035
SMALL = 0.21
#: Parts of the cavity narrower than this (thicknesses) need not be found.
NARROW = 0.1
#: Whole numbers along the smallest cubes: their edges have whole middles.
FINEST = 2
ROUNDS = 16
#: No cubes are halved any more when they or the crossed edges would be more than this: a minute.
MOST_LEAVES = 2_000_000
MOST_EDGES = 1_500_000
#: The facets round a cube depend on what is within so many cubes of the coarsest size.
REACH = 3
#: A polygon is flat when its corners lie off its plane by less than this part of what may stray.
FLAT = 0.5
#: Where facets that are not flat are looked at, in shares of their corners.
LOOK_AT = ((0.5, 0.25, 0.25), (0.25, 0.5, 0.25), (0.25, 0.25, 0.5))


@dataclass(frozen=True, eq=False)
class OffsetSurface:
    """A contoured surface.

    Attributes:
        crossings: the edges it crosses, and its patches.
        facets: its polygons in triangles.
    """

    crossings: Crossings
    facets: Facets


def find_offset_surface(field: DepthField) -> OffsetSurface:
    """The surface at exact depth, as near as cubes of a sixteenth of the coarsest size bring it.

    After the first round only the neighbourhood of the cubes that were halved is contoured and
    looked at again.

    Returns:
        The wall, without crossings and facets where nothing is so deep.
    """
    monitor = field.depth.monitor
    leaves, negative = _refine_leaves(field, field.coarsest_leaves(), 0)
    known = _Known(np.zeros(0, np.int64), *np.zeros((3, 0, 3)))
    changed = np.ones(len(leaves.size), bool)
    for done in range(ROUNDS):
        monitor.tick(0.2 + 0.6 * done / ROUNDS)
        near, known, deviates = _find_negative(field, leaves, negative, changed, known)
        halve = np.zeros(len(leaves.size), bool)
        halve[near] = deviates
        enough = done == ROUNDS - 1 or len(known.names) + 4 * halve.sum() > MOST_EDGES
        if enough or not halve.any():
            break
        stay = leaves.chosen(~halve)
        halves, below = _refine_leaves(field, leaves.chosen(halve).halved(), len(stay.size))
        leaves = stay.joined(halves)
        negative = np.concatenate([negative[~halve], below])
        changed = np.arange(len(leaves.size)) >= len(stay.size)
    crossings = monitor.call(lambda: cross(leaves, negative))
    return monitor.call(lambda: _contour(field, leaves, crossings, known))


def _refine_leaves(field: DepthField, leaves: Leaves, others: int) -> tuple[Leaves, Bools]:
    """Some of all leaves, halved until no cavity wider than `NARROW` thicknesses is missed.

    Returns:
        n leaves, and (n, 8) which of their corners lie inside the inner wall.
    """
    narrow = NARROW * field.depth.thickness
    done, below = leaves.chosen(slice(0)), np.zeros((0, 8), bool)
    while len(leaves.size):
        hide, negative = field.hide(leaves, narrow / 2.0)
        hide &= leaves.size * field.unit > narrow
        if others + len(done.size) + len(leaves.size) + 7 * hide.sum() > MOST_LEAVES:
            hide[:] = False
        done = done.joined(leaves.chosen(~hide))
        below = np.concatenate([below, negative[~hide]])
        leaves = leaves.chosen(hide).halved()
    return done, below


@dataclass(frozen=True, eq=False)
class _Known:
    """What is known of crossed edges: names in ascending order, where they are crossed, planes."""

    names: Ints
    points: Floats
    anchor: Floats
    normal: Floats


def _find_negative(
    field: DepthField, leaves: Leaves, negative: Bools, changed: Bools, known: _Known
) -> tuple[Bools, _Known, Bools]:
    """Contour round the changed leaves.

    Returns:
        (n,) the leaves that were looked at, what is known now, and which of the former are to be
        halved: facets of theirs stray, or several sheets of the wall are in them.
    """
    depth = field.depth
    near = depth.monitor.call(lambda: _near(leaves, changed))
    part = leaves.chosen(near)
    crossings = depth.monitor.call(lambda: cross(part, negative[near], whole=False))
    new = find(known.names, crossings.edges.names) < 0
    known = _with_new(known, field, crossings, new)
    surface = depth.monitor.call(lambda: _contour(field, part, crossings, known))
    leaf = crossings.leaf_of_patch
    small = part.size[leaf] * field.unit < SMALL * depth.thickness
    # A halved leaf beside smaller ones may have none but known edges.
    fresh = changed[near][leaf]
    fresh[crossings.patch[new]] = True
    deviates = _deviations(surface, fresh, depth) > np.where(small, DEVIATION_SMALL, DEVIATION)
    halve = np.bincount(leaf, minlength=len(part.size)) > 1
    halve[leaf[deviates]] = True
    return near, known, halve & (part.size > FINEST)


def _near(leaves: Leaves, changed: Bools) -> Bools:
    """(n,) the leaves in reach of changed ones: so many cubes of their size, or of the coarsest."""
    size = np.maximum(leaves.size, COARSEST)
    result = np.zeros(len(size), bool)
    sizes = np.unique(size)
    for own in np.unique(size[changed]):
        around = name(leaves.corner[changed & (size == own)] // own)
        for one_on in name(np.eye(3, dtype=np.int64)):
            around = np.unique(around[:, None] + one_on * np.arange(-REACH, REACH + 1))
        for other in sizes:
            rows = np.flatnonzero(size == other)
            within = around
            if other > own:
                within = np.unique(name(named(around) // (other // own)))
            cube = name(leaves.corner[rows] // max(own, other))
            result[rows] |= find(within, cube) >= 0
    return result


def _with_new(known: _Known, field: DepthField, crossings: Crossings, new: Bools) -> _Known:
    """With the new edges, crossed where they are if the depth is linear along them."""
    low, high = crossings.edges.low[new], crossings.edges.high[new]
    a, b = field.sample(low)[0], field.sample(high)[0]
    points = field.point(low + (a / (a - b))[:, None] * (high - low))
    anchor, normal = field.depth.planes(points)
    names = crossings.edges.names[new]
    order = np.argsort(names)
    place = np.searchsorted(known.names, names[order])
    return _Known(
        np.insert(known.names, place, names[order]),
        np.insert(known.points, place, points[order], axis=0),
        np.insert(known.anchor, place, anchor[order], axis=0),
        np.insert(known.normal, place, normal[order], axis=0),
    )


def _contour(
    field: DepthField, leaves: Leaves, crossings: Crossings, known: _Known
) -> OffsetSurface:
    rows = find(known.names, crossings.edges.names)
    points, anchor, normal = known.points[rows], known.anchor[rows], known.normal[rows]
    low = leaves.corner[crossings.leaf_of_patch]
    high = low + leaves.size[crossings.leaf_of_patch][:, None]
    vertices = place_vertices(
        crossings, points, anchor, normal, field.point(low), field.point(high)
    )
    return OffsetSurface(crossings, facets(crossings, vertices, anchor, normal))


def _deviations(surface: OffsetSurface, fresh: Bools, depth: Depth) -> Floats:
    """(p,) how far the facets round each patch's vertex stray, if a fresh one (p,) is at them."""
    vertices, triangles = surface.facets.mesh.vertices, surface.facets.mesh.triangles
    result = np.zeros(len(vertices))
    result[fresh] = np.abs(depth.deviation(vertices[fresh]))
    suspect = surface.facets.off[surface.facets.edge] > FLAT * DEVIATION * depth.thickness
    suspect |= (result[triangles] > FLAT * DEVIATION).any(axis=1)
    near = triangles[suspect & fresh[triangles].any(axis=1)]
    for shares in LOOK_AT:
        near = near[(result[near] <= DEVIATION_SMALL).all(axis=1)]
        points = np.einsum("ncx,c->nx", vertices[near], np.array(shares))
        np.maximum.at(result, near, np.abs(depth.deviation(points))[:, None])
    return result

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Adaptive dual contouring: cubes are halved until the surface at a depth is where it should be."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial

import numpy as np

from ..util.linalg import along
from ..util.types import Bools, Floats, Ints
from .depth import Depth
from .dual_contouring import Facets, facets, place_vertices
from .octree import (
    CrossedEdges,
    Crossings,
    Leaves,
    crossed_anew,
    crossed_edges,
    find,
    patches,
)
from .sampled_depth import DepthField

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

    After the first round only what has changed with the cubes that were halved is made and looked
    at again.

    Returns:
        The wall, without crossings and facets where nothing is so deep.
    """
    monitor = field.depth.monitor
    leaves, negative = _refine_leaves(field, field.coarsest_leaves(), 0)
    wall = _Wall.of(field, leaves, negative)
    changed = np.ones(len(leaves.size), bool)
    for done in range(ROUNDS):
        monitor.tick(0.2 + 0.6 * done / ROUNDS)
        halve = _find_deviating(field, wall, changed)
        enough = done == ROUNDS - 1 or len(wall.new) + 4 * halve.sum() > MOST_EDGES
        if enough or not halve.any():
            break
        stay = wall.leaves.chosen(~halve)
        halves, below = _refine_leaves(field, wall.leaves.chosen(halve).halved(), len(stay.size))
        wall = wall.with_halves(field, halve, stay.joined(halves), below)
        changed = np.arange(len(wall.leaves.size)) >= len(stay.size)
    return monitor.call(lambda: _contour(field, wall, np.ones(len(wall.leaves.size), bool)))


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
class _Wall:
    """What is known of the wall in some leaves.

    Attributes:
        leaves: l of them.
        edges: n crossed ones, by rising names.
        leaf: (n, 4) the leaves round them.
        points: (n, 3) where they are crossed, mm.
        anchor: (n, 3) a point of the wall's plane there.
        normal: (n, 3) its normal.
        new: (n,) whether they were not known the round before.
        vertices: (l, 3) the vertices of leaves with one patch, kept as they are made; until then
            not a number, as the next two.
        strays: (l,) by how much the thickness is wrong there (`Depth.deviation`).
        slopes: (l, 3) its gradients.
    """

    leaves: Leaves
    edges: CrossedEdges
    leaf: Ints
    points: Floats
    anchor: Floats
    normal: Floats
    new: Bools
    vertices: Floats
    strays: Floats
    slopes: Floats

    @staticmethod
    def of(field: DepthField, leaves: Leaves, negative: Bools) -> _Wall:
        """Of leaves with (l, 8) which of their corners lie inside the inner wall."""
        edges, leaf = field.depth.monitor.call(lambda: crossed_edges(leaves, negative))
        new = np.ones(len(leaf), bool)
        none = np.full((len(leaves.size), 3), np.nan)
        return _Wall(
            leaves, edges, leaf, *_planes(field, edges), new, none, none[:, 0].copy(), none.copy()
        )

    def with_halves(
        self, field: DepthField, halved: Bools, leaves: Leaves, negative: Bools
    ) -> _Wall:
        """Of the leaves once (l,) some were halved, with the signs at the corners of the halves."""
        number = np.where(halved, -1, np.cumsum(~halved) - 1)
        anew = partial(crossed_anew, self.edges, self.leaf, number, leaves, negative)
        edges, leaf = field.depth.monitor.call(anew)
        row = find(self.edges.names, edges.names)
        new = row < 0
        kept = [_moved(values, ~halved, len(leaves.size))
                for values in (self.vertices, self.strays, self.slopes)]  # fmt: skip
        kept[0][leaf[new]] = np.nan
        points, anchor, normal = self.points[row], self.anchor[row], self.normal[row]
        points[new], anchor[new], normal[new] = _planes(field, edges.chosen(new))
        return _Wall(leaves, edges, leaf, points, anchor, normal, new, *kept)


def _moved(values: Floats, stay: Bools, count: int) -> Floats:
    """The values (l, ...) of those that stay, followed by not a number up to a count."""
    result = np.full((count, *values.shape[1:]), np.nan)
    result[: int(stay.sum())] = values[stay]
    return result


def _planes(field: DepthField, edges: CrossedEdges) -> tuple[Floats, Floats, Floats]:
    """Where edges are crossed if the depth is linear along them, and the wall's planes there."""
    a, b = field.sample(edges.low)[0], field.sample(edges.high)[0]
    points = field.point(edges.low + (a / (a - b))[:, None] * (edges.high - edges.low))
    return points, *field.depth.planes(points)


def _find_deviating(field: DepthField, wall: _Wall, changed: Bools) -> Bools:
    """(l,) leaves to be halved: facets of theirs stray, or several sheets of the wall are in them.

    Only what has changed is looked at: patches in changed leaves or with new edges.
    """
    depth = field.depth
    fresh = changed.copy()
    # A halved leaf beside smaller ones may have none but known edges.
    fresh[wall.leaf[wall.new]] = True
    surface = depth.monitor.call(lambda: _contour(field, wall, fresh))
    leaf = surface.crossings.leaf_of_patch
    small = wall.leaves.size[leaf] * field.unit < SMALL * depth.thickness
    deviates = _deviations(wall, surface, fresh[leaf], depth)
    halve = fresh & (np.bincount(leaf, minlength=len(fresh)) > 1)
    halve[leaf[deviates > np.where(small, DEVIATION_SMALL, DEVIATION)]] = True
    return np.asarray(halve & (wall.leaves.size > FINEST))


def _contour(field: DepthField, wall: _Wall, wanted: Bools) -> OffsetSurface:
    """The facets at the patches of some leaves (l,), and all patches of the leaves beside."""
    near = wanted[wall.leaf].any(axis=1)
    beside = np.zeros_like(wanted)
    beside[wall.leaf[near]] = True
    some = np.flatnonzero(beside[wall.leaf].any(axis=1))
    crossings = patches(wall.leaves, wall.edges.chosen(some), wall.leaf[some])
    points, anchor, normal = wall.points[some], wall.anchor[some], wall.normal[some]
    leaf, alone = crossings.leaf_of_patch, crossings.alone
    vertices = wall.vertices[leaf]
    made = beside[leaf] & (np.isnan(vertices[:, 0]) | ~alone)
    low = wall.leaves.corner[leaf[made]]
    high = low + wall.leaves.size[leaf[made]][:, None]
    vertices[made] = place_vertices(
        crossings, made, points, anchor, normal, field.point(low), field.point(high)
    )
    kept = made & alone
    wall.vertices[leaf[kept]] = vertices[kept]
    rows = np.flatnonzero(near[some])
    crossings = crossings.chosen(rows)
    return OffsetSurface(crossings, facets(crossings, vertices, anchor[rows], normal[rows]))


def _deviations(wall: _Wall, surface: OffsetSurface, fresh: Bools, depth: Depth) -> Floats:
    """(p,) how far the facets round each patch's vertex stray, if a fresh one (p,) is at them."""
    crossings, mesh = surface.crossings, surface.facets.mesh
    vertices, triangles, leaf = mesh.vertices, mesh.triangles, crossings.leaf_of_patch
    strays, slopes = wall.strays[leaf], wall.slopes[leaf]
    strays[fresh], slopes[fresh] = depth.deviation_and_slopes(vertices[fresh])
    kept = fresh & crossings.alone
    wall.strays[leaf[kept]], wall.slopes[leaf[kept]] = strays[kept], slopes[kept]
    result = np.where(fresh, np.abs(strays), 0.0)
    suspect = surface.facets.off[surface.facets.edge] > FLAT * DEVIATION * depth.thickness
    suspect |= (result[triangles] > FLAT * DEVIATION).any(axis=1)
    near = triangles[suspect & fresh[triangles].any(axis=1)]
    near = near[~_are_near(vertices[near], strays[near], slopes[near])]
    for shares in LOOK_AT:
        near = near[(result[near] <= DEVIATION_SMALL).all(axis=1)]
        points = np.einsum("ncx,c->nx", vertices[near], np.array(shares))
        np.maximum.at(result, near, np.abs(depth.deviation(points))[:, None])
    return result


def _are_near(corners: Floats, strays: Floats, slopes: Floats) -> Bools:
    """(n,) whether triangles hardly stray, as what is known of their corners tells.

    The quadratic function that has these values and slopes at the corners is known between them.
    Where twice its bend would not be too much, it is not looked up: of 138,000 points on three
    parts 28 strayed by more than they may, none by as much as `DEVIATION_SMALL` and a tenth.

    Args:
        corners: (n, 3, 3), mm.
        strays: (n, 3) how far they stray.
        slopes: (n, 3, 3) its gradients; not a number: not known.
    """
    result = np.ones(len(corners), bool)
    # What the corner k adds on the way along its edges, before it is weighed by both shares.
    ways = [
        np.einsum("nkx,nkx->nk", slopes, np.roll(corners, -k, axis=1) - corners) for k in (1, 2)
    ]
    for shares in LOOK_AT:
        share = np.array(shares)
        bend = 0.5 * sum(along(ways[k - 1], share * np.roll(share, -k)) for k in (1, 2))
        result &= np.abs(along(strays, share) + bend) + np.abs(bend) < DEVIATION
    return result

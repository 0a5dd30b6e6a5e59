# SPDX-License-Identifier: LGPL-2.1-or-later
"""Deformation of assembled octants onto struts of any radii between nodes at any places.

The octants of a graded lattice have the connectivity of a uniform one. Every vertex keeps its
binding (see `volfrep.lattice.strut_binding`) and finds its place by it on the cones and spheres
that are really there: in closed form, each vertex for itself, all at once. Vertices on creases
stay on creases. What would change the connectivity, struts that meet before their middles, is
refused.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..design.cells import UnitCell
from ..grid.coordinate_map import CoordinateMap
from ..grid.node_frames import NodeFrames, shortest
from ..octants.octant import Octant, OctantKey, frames
from ..octants.sdf import Field, join, spheres, struts
from ..util.errors import VolfrepError
from ..util.linalg import lengths, normalize
from ..util.numbers import place_text
from ..util.progress import Monitor
from ..util.threads import in_threads
from ..util.types import Floats, Ints
from .assembly import Layout, numbers
from .strut_binding import (
    AT_SIDE,
    LEAST_ROOM,
    SPACE,
    SPHERE,
    STRUT,
    StrutBinding,
    angles_to_struts,
    corner_turns,
    counter_clockwise,
    crease,
)
from .strut_masks import NodeLookup

#: Vertices that are placed at a time: what they need should stay in the processor's cache.
CHUNK_VERTICES = 16_000
#: A vertex of a joint sphere keeps this share of its angle from the nearest strut.
KEPT_ANGLE = 0.5
#: Angle from a strut, in radians, within which it draws the sphere's vertices along.
DRAWN = 0.6
#: Newton steps onto rounded joints, and the longest of them in units of the radius.
FILLET_STEPS = 4
LONGEST_STEP = 0.3


@dataclass(frozen=True, eq=False)
class Deformed:
    """The vertices of a layout, deformed onto the struts of a graded lattice.

    Attributes:
        vertices: (n, 3), mm.
        excess: how far vertices lie beyond their octants in lattice space, in units of their edge.
    """

    vertices: Floats
    excess: float


def deform(
    layout: Layout,
    bindings: dict[OctantKey, StrutBinding],
    cell: UnitCell,
    nodes: NodeFrames,
    mapping: CoordinateMap,
    fillet: float,
    monitor: Monitor,
) -> Deformed:
    """Deform the vertices of a layout onto the struts of a graded lattice.

    Args:
        layout: the numbered octants; their grid lies on that of `nodes.graph`.
        bindings: of all its kinds of octant.
        cell: the unit cell.
        nodes: the nodes as they are to be: in the part (round struts), or in lattice space, to be
            mapped into the part as a whole (stretched struts).
        mapping: from lattice space to the part.
        fillet: joint fillet, mm.
        monitor: for progress and cancel.

    Raises:
        VolfrepError: struts meet before their middles; the text says where.
    """
    grid = layout.grid
    in_part = nodes.rotation is not None
    vertices = np.empty((layout.count, 3))
    excess, done = 0.0, 0
    total = sum(len(place) for place in layout.places)
    rounding = _Rounding.of(nodes, fillet) if fillet > 0.0 else None

    def parts() -> Iterator[_Part]:
        for key, place in zip(grid.keys, layout.places, strict=True):
            octant = layout.octants[key]
            if not len(place) or not len(octant.vertices):
                continue
            own = bindings[key]
            lookup = NodeLookup.of(cell, key, own.copy, own.place)
            ends = _StrutEnds.of_kind(own)
            size = max(1, CHUNK_VERTICES // len(own.kind))
            for begin in range(0, len(place), size):
                yield _Part(octant, own, ends, lookup, place[begin : begin + size])

    def moved(part: _Part) -> tuple[NDArray[np.int32], Floats, float]:
        own, octant = part.own, part.octant
        is_corner, on_face = own.kind == SPACE, octant.places != 1
        corner, sign = frames(part.place)
        base = corner * grid.cell_size + grid.origin
        rows = part.lookup.rows(nodes.graph, part.place, grid.periodic)
        found = _place(own, part.ends, rows, sign, nodes)
        if rounding is not None:
            found = rounding.project(found, own, rows)
        before = base[:, None] + sign[:, None] * octant.vertices
        inside = before[:, is_corner]
        if in_part:
            inside = mapping.to_part(inside.reshape(-1, 3)).reshape(inside.shape)
        found = found.reshape(before.shape)
        found[:, is_corner] = inside
        there = found.reshape(-1, 3)
        back = (mapping.to_lattice(there) if in_part else there).reshape(found.shape)
        middle = (base + sign * (0.25 * grid.cell_size))[:, None]
        seen = mapping.unwrapped(np.concatenate([middle, back], axis=1))[:, 1:]
        # What was on a face shared with another octant must stay near it on both sides.
        left = np.abs(seen - before)[:, on_face].max(initial=0.0)
        beyond = np.abs(seen - middle).max() - 0.25 * grid.cell_size
        return numbers(layout, octant, part.place), found, float(max(left, beyond))

    # One after the other into their places: octants that share a vertex differ by rounding.
    for number, found, left in in_threads(moved, parts()):
        vertices[number] = found
        excess = max(excess, left / (0.5 * grid.cell_size))
        done += len(number)
        monitor.tick(done / total)
    there = in_part or mapping.is_identity
    return Deformed(vertices if there else mapping.to_part(vertices), excess)


@dataclass(frozen=True, eq=False)
class _StrutEnds:
    """The ends of struts that vertices of one kind of octant lie on, each with those beside it.

    A few dozen carry hundreds of vertices, for which what hangs on the struts alone is found once.

    Attributes:
        near, far, left, right: (e,) nodes, as of `StrutBinding`.
        corner: (e,) as there.
        of: (v,) the end that each vertex on a strut lies at.
    """

    near: Ints
    far: Ints
    left: Ints
    right: Ints
    corner: Floats
    of: Ints

    @staticmethod
    def of_kind(own: StrutBinding) -> _StrutEnds:
        named = np.stack([own.near, own.far, own.left, own.right], axis=1)
        rows = np.column_stack([named, own.corner])[own.kind == STRUT]
        _, first, of = np.unique(rows, axis=0, return_index=True, return_inverse=True)
        some = np.flatnonzero(own.kind == STRUT)[first]
        near, far, left, right = named[some].T
        return _StrutEnds(near, far, left, right, own.corner[some], of.ravel())


@dataclass(frozen=True, eq=False)
class _Part:
    """Some octants of one kind: it, the binding of its vertices, its nodes, (p, 3) places."""

    octant: Octant
    own: StrutBinding
    ends: _StrutEnds
    lookup: NodeLookup
    place: Ints


def _place(
    own: StrutBinding, ends: _StrutEnds, rows: Ints, sign: Ints, nodes: NodeFrames
) -> Floats:
    """(p n, 3) places of the vertices of some octants of one kind; corners are left out."""
    count = len(rows)
    radial = sign[:, None, :] * own.radial
    found = np.zeros((count, len(own.kind), 3))
    is_strut, is_sphere = own.kind == STRUT, own.kind == SPHERE
    if is_strut.any():
        found[:, is_strut] = _on_struts(
            ends, rows, sign.prod(axis=1),
            np.tile(own.turn[is_strut], count),
            radial[:, is_strut].reshape(-1, 3),
            np.tile(own.along[is_strut], count),
            np.tile(own.share[is_strut], count),
            np.tile(own.scale[is_strut], count),
            nodes,
        ).reshape(count, -1, 3)  # fmt: skip
    if is_sphere.any():
        found[:, is_sphere] = _on_spheres(
            rows[:, own.near[is_sphere]].ravel(),
            radial[:, is_sphere].reshape(-1, 3),
            np.tile(own.share[is_sphere], count),
            np.tile(own.scale[is_sphere], count),
            nodes,
        ).reshape(count, -1, 3)
    return found.reshape(-1, 3)


def _on_struts(
    ends: _StrutEnds,
    rows: Ints,
    sense: Ints,
    turn: Floats,
    radial: Floats,
    along: Floats,
    share: Floats,
    scale: Floats,
    nodes: NodeFrames,
) -> Floats:
    near, far, left, right = (
        rows[:, own].ravel() for own in (ends.near, ends.far, ends.left, ends.right)
    )
    # The end, of those of all the octants, that each vertex lies at.
    at = (len(ends.near) * np.arange(len(rows))[:, None] + ends.of).ravel()
    strut = _struts(near, far, nodes)
    if nodes.rotation is not None:
        turned = (1.0 - along)[:, None, None] * nodes.rotation[near[at]]
        turned += along[:, None, None] * nodes.rotation[far[at]]
        axis = strut.axis[at]
        radial = _across(np.einsum("nij,nj->ni", turned, radial), axis)
        # At the joint a ruling lies between the same struts, and as far between them, as it did;
        # towards the middle it is just turned with the strut.
        beside = left != near
        some = np.flatnonzero(beside)
        off = np.flatnonzero(beside[at])
        own = (np.cumsum(beside) - 1)[at[off]]
        sides = [nodes.points[row[some]] - strut.start[some] for row in (left, right)]
        first, second = (_across(side, strut.axis[some]) for side in sides)
        about = np.repeat(sense, len(ends.near))[some, None] * strut.axis[some]
        angle = counter_clockwise(first, second, about)
        angle[left[some] == right[some]] = 2.0 * np.pi
        corner = np.tile(ends.corner, len(rows))[some]
        angle = angle[own] * _turns(
            turn[off], own, corner, strut.axis[some], sides, about, near[some], nodes
        )
        ahead = np.cross(about, first)
        ruling = np.cos(angle)[:, None] * first[own] + np.sin(angle)[:, None] * ahead[own]
        mixed = np.clip(share[off], 0.0, 1.0)[:, None]
        radial[off] = _across((1.0 - mixed) * ruling + mixed * radial[off], axis[off])
    begin = _crease(strut, radial, near, far, nodes, at)
    strut = strut.take(at)
    room = strut.middle - begin
    tight = int(np.argmin(room / strut.radius))
    if room[tight] < LEAST_ROOM * strut.radius[tight]:
        place = place_text(strut.start[tight] + begin[tight] * strut.axis[tight])
        raise VolfrepError(
            f"Near {place} struts of radius {strut.radius[tight]:.3g} mm and "
            f"length {strut.length[tight]:.3g} mm grow into each other: reduce the radius or let "
            "the cells be larger there."
        )
    return strut.point(begin + share * room, radial, scale)


def _turns(
    turn: Floats,
    own: Ints,
    corner: Floats,
    axis: Floats,
    sides: list[Floats],
    about: Floats,
    near: Ints,
    nodes: NodeFrames,
) -> Floats:
    """(n,) turns from left to right where the creases with both meet elsewhere than they did.

    Where another strut hides that place, the creases are others than they were, and all stays.

    Args:
        turn: (n,) as they were.
        own: (n,) the end of a strut that each is at, which the rest is of.
        corner: (e,) the turns at which the creases met; 0 where they did not.
        axis: (e, 3).
        sides: (e, 3) from the node along the struts on the left and on the right.
        about: (e, 3) as of `corner_turns`.
        near: (e,) nodes.
        nodes: all of them.
    """
    some = np.flatnonzero(corner > 0.0)
    left, right = (side[some] for side in sides)
    near = near[some]
    now = corner.copy()
    now[some] = corner_turns(
        axis[some], left, right, about[some], nodes.directions[near], nodes.neighbours[near] >= 0
    )
    now = np.where(now > 0.0, np.clip(now, AT_SIDE, 1.0 - AT_SIDE), corner)[own]
    result = turn.copy()
    meets = np.flatnonzero(corner[own] > 0.0)
    before, was, now = turn[meets], corner[own[meets]], now[meets]
    result[meets] = np.where(
        before < was, before * now / was, 1.0 - (1.0 - before) * (1.0 - now) / (1.0 - was)
    )
    return result


@dataclass(frozen=True, eq=False)
class _Struts:
    """The struts of some vertices, or of some of their ends, from the nearer node.

    Attributes:
        start, axis: (n, 3) the node, mm, and the unit vector to the other one.
        length, radius, slope: (n,) mm; radius at the node; by which it grows on the way.
        middle: (n,) where the ends of the strut meet, mm: thicker joints reach farther.
    """

    start: Floats
    axis: Floats
    length: Floats
    radius: Floats
    slope: Floats
    middle: Floats

    def take(self, rows: Ints) -> _Struts:
        """Those of the rows."""
        return _Struts(
            self.start[rows], self.axis[rows], self.length[rows],
            self.radius[rows], self.slope[rows], self.middle[rows],
        )  # fmt: skip

    def point(self, t: Floats, radial: Floats, scale: Floats) -> Floats:
        """(n, 3) points at t mm along the struts, off them as the scale says."""
        distance = (self.radius + self.slope * t) * scale
        result: Floats = self.start + t[:, None] * self.axis + distance[:, None] * radial
        return result


def _struts(near: Ints, far: Ints, nodes: NodeFrames) -> _Struts:
    start = nodes.points[near]
    axis = shortest(nodes.points[far] - start, nodes.period)
    length = lengths(axis)
    axis /= length[:, None]
    radius, other = nodes.radius[near], nodes.radius[far]
    middle = length * radius / (radius + other)
    return _Struts(start, axis, length, radius, (other - radius) / length, middle)


def _crease(
    strut: _Struts, radial: Floats, near: Ints, far: Ints, nodes: NodeFrames, at: Ints
) -> Floats:
    ends = nodes.neighbours[near]
    return crease(
        strut.axis,
        radial,
        strut.radius,
        strut.slope,
        nodes.joint[near],
        nodes.directions[near],
        nodes.slopes[near],
        (ends >= 0) & (ends != far[:, None]),
        at,
    )


def _across(vectors: Floats, axis: Floats) -> Floats:
    """Unit vectors along what stands across the axes."""
    off = vectors - np.einsum("ij,ij->i", vectors, axis)[:, None] * axis
    result: Floats = off / lengths(off)[:, None]
    return result


def _on_spheres(
    near: Ints, radial: Floats, share: Floats, scale: Floats, nodes: NodeFrames
) -> Floats:
    directions, others = nodes.directions[near], nodes.neighbours[near] >= 0
    if nodes.rotation is not None:
        # The sphere is turned with the node, and drawn along by the struts that are near.
        weight = np.exp(-((angles_to_struts(radial, nodes.were[near], others) / DRAWN) ** 2))
        weight /= np.maximum(weight.sum(axis=1, keepdims=True), 1.0)
        turned = np.einsum("nij,nkj->nki", nodes.rotation[near], nodes.were[near])
        radial = np.einsum("nij,nj->ni", nodes.rotation[near], radial)
        radial += np.einsum("nk,nkj->nj", weight, directions - turned)
        radial /= lengths(radial)[:, None]
    rows = np.arange(len(near))
    # Struts cover the sphere up to this angle from their axes: keep clear of it.
    cover = np.arcsin(np.minimum(nodes.radius[near] / nodes.joint[near], 1.0))
    for _ in range(2):
        angle = angles_to_struts(radial, directions, others)
        nearest = angle.argmin(axis=1)
        lack = np.maximum(cover + KEPT_ANGLE * share - angle[rows, nearest], 0.0)
        strut = directions[rows, nearest]
        aside = normalize(radial - np.einsum("ij,ij->i", radial, strut)[:, None] * strut)
        turned = np.cos(angle[rows, nearest] + lack)[:, None] * strut
        turned += np.sin(angle[rows, nearest] + lack)[:, None] * aside
        radial = np.where((lack > 0.0)[:, None], turned, radial)
    result: Floats = nodes.points[near] + (scale * nodes.joint[near])[:, None] * radial
    return result


@dataclass(frozen=True, eq=False)
class _Rounding:
    """Rounded joints: every vertex is moved onto the round union of what is at its strut's ends.

    Attributes:
        nodes: of the lattice.
        field: all struts, then all joint spheres; with nobody's neighbourhood in it.
        table: (n, k) the struts at every node; -1 for none.
    """

    nodes: NodeFrames
    field: Field
    table: Ints

    @staticmethod
    def of(nodes: NodeFrames, fillet: float) -> _Rounding:
        ends = nodes.graph.struts.astype(np.int64)
        start = nodes.points[ends[:, 0]]
        end = start + shortest(nodes.points[ends[:, 1]] - start, nodes.period)
        primitives = join(
            struts(start, end, nodes.radius[ends]), spheres(nodes.points, nodes.joint)
        )
        # The strut of each entry of the neighbours' table: both list a node's struts in one order.
        number = np.arange(len(ends))
        by_node = np.argsort(np.concatenate([ends[:, 0], ends[:, 1]]), kind="stable")
        table = np.full(nodes.neighbours.shape, -1, np.int64)
        table[nodes.neighbours >= 0] = np.concatenate([number, number])[by_node]
        none = np.zeros(0, np.int64)
        return _Rounding(nodes, Field(primitives, none, none, fillet), table)

    def project(self, points: Floats, own: StrutBinding, rows: Ints) -> Floats:
        """The points at the distance from the rounded surface that they had on the template."""
        near, far = rows[:, own.near].ravel(), rows[:, own.far].ravel()
        first = len(self.nodes.graph.struts)
        beyond = np.where((far != near)[:, None], self.table[far], -1)
        # The strut itself is at both ends; it counts once.
        beyond[(beyond[:, :, None] == self.table[near][:, None, :]).any(axis=2)] = -1
        ends = np.where(far != near, first + far, -1)
        lists = np.concatenate(
            [self.table[near], beyond, (first + near)[:, None], ends[:, None]], axis=1
        )
        listed = lists >= 0
        begin = np.concatenate([[0], np.cumsum(listed.sum(axis=1))])
        field = Field(self.field.primitives, begin, lists[listed], self.field.fillet)
        radius = self.nodes.radius[near]
        level = np.tile(own.level, len(rows)) * radius
        moved = points
        for _ in range(FILLET_STEPS):
            value, gradient = field.values_and_gradients(moved)
            square = np.maximum(np.einsum("ij,ij->i", gradient, gradient), 0.05)
            step = np.clip((value - level) / square, -LONGEST_STEP * radius, LONGEST_STEP * radius)
            moved = moved - step[:, None] * gradient
        return moved

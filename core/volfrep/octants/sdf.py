# SPDX-License-Identifier: LGPL-2.1-or-later
"""Signed distance of a strut-and-node lattice, its F-rep (section 2.3 of the VOLFREP paper).

A lattice is the union of capped cylinders (Eq. 1-7) and joint spheres (Eq. 8-9), joined by min
(Eq. 10). A strut whose radius differs at its ends is a cone. Where the paper samples squared
distances, these are true signed distances in mm, negative inside: the zero set is the same, and a
fillet, an offset and an interpolation are then exact in mm. A sphere is kept as a cylinder without
direction, so that one expression serves both.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ..util.ragged import rows_of
from ..util.types import Floats, Ints

#: Half length of a primitive that has no caps: a joint sphere.
_NO_CAPS = 1e30
#: No distance changes faster than its place but for rounding, which is far below this.
FASTEST = 1.0 + 1e-9
#: Pairs of a point and a primitive whose distances are measured at a time.
PAIRS_AT_ONCE = 1 << 20


@dataclass(frozen=True, eq=False)
class Primitives:
    """Struts and joint spheres.

    Attributes:
        middle: (k, 3) middle of the strut's axis, or the sphere's centre.
        direction: (k, 3) unit vector of the axis; zero for a sphere.
        half_length: (k,) of the axis; `_NO_CAPS` for a sphere.
        radius: (k,) at the middle.
        slope: (k,) by which the radius grows along the direction; 0 for a cylinder.
    """

    middle: Floats
    direction: Floats
    half_length: Floats
    radius: Floats
    slope: Floats

    def __len__(self) -> int:
        return len(self.radius)

    @property
    def rows(self) -> Floats:
        """(k, 9) all that is known of each."""
        return np.column_stack(
            [self.middle, self.direction, self.half_length, self.radius, self.slope]
        )

    def take(self, index: NDArray[np.generic]) -> Primitives:
        """The primitives of that index or mask, in its order."""
        return Primitives(
            self.middle[index],
            self.direction[index],
            self.half_length[index],
            self.radius[index],
            self.slope[index],
        )


def struts(start: Floats, end: Floats, radius: float | Floats) -> Primitives:
    """Capped cylinders (Eq. 1-7) or cones between (k, 3) points.

    `radius` is one for all, or (k, 2) at their starts and ends, in mm.
    """
    span = end - start
    length = np.linalg.norm(span, axis=1)
    ends = np.broadcast_to(np.asarray(radius, float), (len(length), 2))
    return Primitives(
        0.5 * (start + end),
        span / length[:, None],
        0.5 * length,
        ends.mean(axis=1),
        (ends[:, 1] - ends[:, 0]) / length,
    )


def spheres(centre: Floats, radius: float | Floats) -> Primitives:
    """Joint spheres about (k, 3) points (Eq. 8-9), of one radius or of (k,) radii, mm."""
    count = len(centre)
    return Primitives(
        np.asarray(centre, float),
        np.zeros((count, 3)),
        np.full(count, _NO_CAPS),
        np.broadcast_to(np.asarray(radius, float), count).copy(),
        np.zeros(count),
    )


def join(*parts: Primitives) -> Primitives:
    """All the primitives as one list."""
    return Primitives(
        np.concatenate([p.middle for p in parts]),
        np.concatenate([p.direction for p in parts]),
        np.concatenate([p.half_length for p in parts]),
        np.concatenate([p.radius for p in parts]),
        np.concatenate([p.slope for p in parts]),
    )


def distances(points: Floats, primitives: Primitives) -> Floats:
    """(n,) signed distance of the i-th point to the i-th primitive; shapes broadcast.

    `points` is (…, 3) against the primitives' (…, 3): pass ``points[:, None]`` for all pairs.

    >>> strut = struts(np.array([[0.0, 0.0, 0.0]]), np.array([[10.0, 0.0, 0.0]]), 1.0)
    >>> distances(np.array([[5.0, 3.0, 0.0], [5.0, 0.0, 0.0]]), strut).tolist()
    [2.0, -1.0]
    """
    # A column at a time, and in place: numpy takes rows of three slowly.
    x, y, z = (points[..., k] - primitives.middle[..., k] for k in range(3))
    u, v, w = (primitives.direction[..., k] for k in range(3))
    axial = x * u
    axial += y * v
    axial += z * w
    # The radius from the rejected vector, not from Pythagoras: no cancellation on thin struts.
    x -= axial * u
    y -= axial * v
    z -= axial * w
    x *= x
    y *= y
    z *= z
    x += y
    x += z
    beside = _beside(np.sqrt(x), axial, primitives)
    beyond = np.abs(axial) - primitives.half_length
    result: Floats = np.maximum(beside, beyond)
    # Before both the side and a cap the rim is nearest.
    rim = (beside > 0.0) & (beyond > 0.0)
    result[rim] = np.hypot(beside[rim], beyond[rim])
    return result


def distances_and_gradients(points: Floats, primitives: Primitives) -> tuple[Floats, Floats]:
    """(n,) signed distances of n points to n primitives, and their (n, 3) unit gradients."""
    offset = points - primitives.middle
    axial = np.einsum("...i,...i->...", offset, primitives.direction)
    rejected = offset - axial[..., None] * primitives.direction
    across = np.sqrt(np.einsum("...i,...i->...", rejected, rejected))
    beside = _beside(across, axial, primitives)
    beyond = np.abs(axial) - primitives.half_length
    outer_beside, outer_beyond = np.maximum(beside, 0.0), np.maximum(beyond, 0.0)
    outside = np.hypot(outer_beside, outer_beyond)
    value = outside + np.minimum(np.maximum(beside, beyond), 0.0)
    # Weights of the radial and the axial direction: along the nearer face inside, the true
    # direction outside (which mixes both only beyond a cap's rim).
    with np.errstate(invalid="ignore", divide="ignore"):
        is_out = outside > 0.0
        radial_weight = np.where(is_out, outer_beside / outside, beside >= beyond)
        axial_weight = np.where(is_out, outer_beyond / outside, beside < beyond)
    # The normal of a cone leans back by its slope.
    upright = 1.0 / np.sqrt(1.0 + primitives.slope**2)
    axial_weight = axial_weight * np.sign(axial) - radial_weight * upright * primitives.slope
    radial_weight *= upright / np.maximum(across, 1e-300)
    gradient = radial_weight[..., None] * rejected
    gradient += axial_weight[..., None] * primitives.direction
    return value, gradient


def _beside(across: Floats, axial: Floats, primitives: Primitives) -> Floats:
    """Distance from the side of a cylinder or, along its normal, of a cone."""
    if not primitives.slope.any():
        return across - primitives.radius
    slope = primitives.slope
    result: Floats = (across - primitives.radius - slope * axial) / np.sqrt(1.0 + slope**2)
    return result


def union(values: Floats, fillet: float = 0.0) -> Floats:
    """Union of the last axis' distances: min (Eq. 10), or rounded with radius `fillet`.

    The round union k - |max(k - f_i, 0)| leaves every primitive as it is where no other is
    nearer than k, and meets two perpendicular walls in a circular arc of radius k. It does not
    depend on the order of the primitives.
    """
    least: Floats = values.min(axis=-1)
    if fillet <= 0.0:
        return least
    reach = np.maximum(fillet - values, 0.0)
    rounded = fillet - np.sqrt(np.einsum("...i,...i->...", reach, reach))
    return np.where(least < fillet, rounded, least)


@dataclass(frozen=True, eq=False)
class Anchors:
    """How far primitives are from places, by which those that are too far elsewhere are known.

    Attributes:
        points: (n, 3) a place for each point of a `Field`, mm.
        away: (pairs,) signed distances of the primitives near each point from its place, mm.
        least: (n,) the smallest of them.
    """

    points: Floats
    away: Floats
    least: Floats


@dataclass(frozen=True, eq=False)
class Field:
    """The signed distance at points that each know which primitives can be near them.

    Attributes:
        primitives: of all the points.
        start: (n + 1,) offsets into `near`.
        near: (pairs,) primitives near point 0, then near point 1, …; at least one each.
        fillet: radius of the round union, mm.
        anchors: spare most of the distances, since none changes faster than its place; None where
            nobody measured.
    """

    primitives: Primitives
    start: Ints
    near: Ints
    fillet: float
    anchors: Anchors | None = None

    def rows(self, index: Ints) -> Field:
        """The field at points that take over the neighbourhoods of the points `index`."""
        pairs, _ = rows_of(self.start, index)
        counts = self.start[index + 1] - self.start[index]
        start = np.concatenate([[0], np.cumsum(counts)])
        anchors = self.anchors
        if anchors is not None:
            anchors = Anchors(anchors.points[index], anchors.away[pairs], anchors.least[index])
        return Field(self.primitives, start, self.near[pairs], self.fillet, anchors)

    def anchored(self, points: Floats) -> Field:
        """The same field, its distances measured at (n, 3) points."""
        away = np.zeros(len(self.near))
        owner = np.repeat(np.arange(len(points)), np.diff(self.start))
        for begin in range(0, len(owner), PAIRS_AT_ONCE):
            part = slice(begin, begin + PAIRS_AT_ONCE)
            away[part] = distances(points[owner[part]], self.primitives.take(self.near[part]))
        least = np.minimum.reduceat(away, self.start[:-1]) if len(points) else away
        return replace(self, anchors=Anchors(points, away, least))

    def joined(self, other: Field) -> Field:
        """The points of both, of the same primitives; anchored where both are."""
        start = np.concatenate([self.start, self.start[-1] + other.start[1:]])
        near = np.concatenate([self.near, other.near])
        one, two = self.anchors, other.anchors
        anchors = None
        if one is not None and two is not None:
            anchors = Anchors(
                np.concatenate([one.points, two.points]),
                np.concatenate([one.away, two.away]),
                np.concatenate([one.least, two.least]),
            )
        return Field(self.primitives, start, near, self.fillet, anchors)

    def _pairs(
        self, points: Floats, within: float = 0.0, radius: Floats | float = 0.0
    ) -> tuple[Ints, Ints, Ints]:
        """(pairs,) points and primitives near them, and (n + 1,) where each point's begin.

        Without those that are farther than others and than `within`, everywhere in a radius about
        the points, as their distances at the anchors tell.
        """
        owner = np.repeat(np.arange(len(points)), self.start[1:] - self.start[:-1])
        anchors = self.anchors
        if anchors is None:
            return owner, self.near, self.start
        off = points - anchors.points
        moved = self._fastest * np.sqrt(np.einsum("ij,ij->i", off, off)) + radius
        limit = np.maximum(anchors.least + 2.0 * moved, max(self.fillet, within) + moved)
        limit += (FASTEST - 1.0) * self.primitives.radius.max(initial=0.0)
        seen = np.flatnonzero(anchors.away <= limit[owner])
        owner = owner[seen]
        start = np.concatenate([[0], np.cumsum(np.bincount(owner, minlength=len(points)))])
        return owner, self.near[seen], start

    @property
    def _fastest(self) -> float:
        """How much faster than its place a distance may change: that of a cone's cap does."""
        return FASTEST * (2.0**0.5 if self.primitives.slope.any() else 1.0)

    def nearest(self, points: Floats) -> tuple[Floats, Ints]:
        """(n,) smallest distance and the primitive that has it."""
        owner, near, start = self._pairs(points)
        values = distances(points[owner], self.primitives.take(near))
        least = np.minimum.reduceat(values, start[:-1])
        hits = np.flatnonzero(values == least[owner])
        first = hits[np.searchsorted(owner[hits], np.arange(len(points)))]
        return least, near[first]

    def touching(self, points: Floats, tolerance: float) -> Ints:
        """(n, 3) up to three primitives whose surfaces pass within `tolerance`; -1 for none."""
        owner, near, _ = self._pairs(points, tolerance)
        values = distances(points[owner], self.primitives.take(near))
        hits = np.flatnonzero(np.abs(values) < tolerance)
        place = np.arange(len(hits)) - np.searchsorted(owner[hits], owner[hits])
        hits, place = hits[place < 3], place[place < 3]
        result = np.full((len(points), 3), -1, np.int64)
        result[owner[hits], place] = near[hits]
        return result

    def values(self, points: Floats) -> Floats:
        """(n,) signed distances in mm."""
        owner, near, start = self._pairs(points)
        values = distances(points[owner], self.primitives.take(near))
        least: Floats = np.minimum.reduceat(values, start[:-1])
        if self.fillet <= 0.0:
            return least
        reach = np.maximum(self.fillet - values, 0.0)
        rounded = self.fillet - np.sqrt(np.add.reduceat(reach**2, start[:-1]))
        return np.where(least < self.fillet, rounded, least)

    def values_of_groups(self, points: Floats) -> Floats:
        """(n, q) signed distances in mm of (n, q, 3) points, those of a row near each other.

        Primitives that are farther than others from a whole row are left out.
        """
        middle = points.mean(axis=1)
        offset = points - middle[:, None]
        radius = np.sqrt(np.einsum("nqi,nqi->nq", offset, offset).max(axis=1)) * self._fastest
        owner, near, start = self._pairs(middle, 0.0, radius)
        values = distances(middle[owner], self.primitives.take(near))
        least = np.minimum.reduceat(values, start[:-1])
        seen = values <= np.maximum(least + 2.0 * radius, self.fillet + radius)[owner]
        owner, near = owner[seen], near[seen]
        start = np.searchsorted(owner, np.arange(len(points)))
        values = distances(points[owner], self.primitives.take(near[:, None]))
        nearest: Floats = np.minimum.reduceat(values, start, axis=0)
        if self.fillet <= 0.0:
            return nearest
        reach = np.maximum(self.fillet - values, 0.0)
        rounded = self.fillet - np.sqrt(np.add.reduceat(reach**2, start, axis=0))
        return np.where(nearest < self.fillet, rounded, nearest)

    def values_and_gradients(self, points: Floats) -> tuple[Floats, Floats]:
        """(n,) signed distances in mm and their (n, 3) gradients."""
        if self.fillet <= 0.0:
            _, primitive = self.nearest(points)
            return distances_and_gradients(points, self.primitives.take(primitive))
        owner, near, start = self._pairs(points)
        values, gradients = distances_and_gradients(points[owner], self.primitives.take(near))
        least = np.minimum.reduceat(values, start[:-1])
        reach = np.maximum(self.fillet - values, 0.0)
        # Beyond the fillet's reach only the nearest primitive counts.
        weight = np.where(least[owner] < self.fillet, reach, values == least[owner])
        norm = np.sqrt(np.add.reduceat(weight**2, start[:-1]))
        blended = np.add.reduceat(weight[:, None] * gradients, start[:-1], axis=0)
        rounded = np.where(least < self.fillet, self.fillet - norm, least)
        return rounded, blended / norm[:, None]

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Drain holes: through the skin into the cavity, to let powder or resin out."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..design.openings import DrainHoles
from ..grid.strut_graph import Wireframe
from ..mesh.booleans import as_manifold
from ..mesh.topology import touching
from ..mesh.triangle_mesh import TriangleMesh, compact, random_points
from ..spatial.proximity import closest_points
from ..spatial.rays import segment_crossings
from ..util.errors import VolfrepError
from ..util.linalg import along, axes_across
from ..util.numbers import place_text
from ..util.progress import Monitor
from ..util.types import Bools, Floats, Ints
from .boolean_trim import cut_again
from .trimmed_surface import TrimmedSurface

if TYPE_CHECKING:
    import manifold3d

#: Sides of a hole, and rays along them that feel where the skin is.
SIDES = 48
RAYS = 12
#: A hole goes on into the cavity by this part of its diameter, and so far out of the part.
OVERLAP = 0.05
#: The skin under a hole is looked for up to so many of its thicknesses and diameters deep.
DEEPEST = (2.0, 1.0)
#: A given point may lie this far off the surface, in units of the diagonal of the part's box.
OFF_SURFACE = 0.02
#: Cosine of the angle between a slanting hole and the surface's normal: no hole is steeper.
STEEPEST = 0.3
#: Candidates for holes in each void, and how many of them are looked at closely at first; then
#: twice as many, and so on.
CANDIDATES = 4000
LOOKED_AT = 200
#: Of places that differ in height by less than this, in diameters, that with most room is taken.
SAME_HEIGHT = 0.1
#: Automatic holes keep so many diameters between them.
APART = 2.0
#: What is on the inner wall is nearer to it than this, in thicknesses.
ON_WALL = 1e-3


@dataclass(frozen=True, eq=False)
class Drained:
    """A part with holes.

    Attributes:
        surface: of the part.
        places: of the holes on its surface, mm.
        volume: of the material that they took, mm3.
        warnings: sentences for the user.
    """

    surface: TrimmedSurface
    places: tuple[tuple[float, float, float], ...]
    volume: float
    warnings: tuple[str, ...]


def drain(
    part: TrimmedSurface,
    solid: TriangleMesh,
    domain: TriangleMesh,
    lattice: Wireframe,
    thickness: float,
    wanted: DrainHoles,
    monitor: Monitor,
) -> Drained:
    """A part with holes through its skin.

    Given places come first; then each void that is still closed gets the automatic ones, at the
    lowest places of its wall where there is room.

    Args:
        part: skin and lattice, mm.
        solid: its outside.
        domain: closed mesh of what the lattice fills.
        lattice: its struts.
        thickness: of the skin, mm.
        wanted: the holes.
        monitor: for progress and cancel.

    Raises:
        VolfrepError: a given hole does not reach the cavity; the text says which.
    """
    site = _Site(solid, domain, thickness, 0.5 * wanted.diameter)
    holes = _given_holes(site, wanted)
    drilled = _drill(part, site.cylinders(holes), monitor)
    found = drilled.inspected(monitor).found
    warnings: list[str] = []
    if wanted.count:
        chosen, mesh = [], drilled.mesh
        voids = np.unique(found.shell)  # a void that has none at the wall cannot be reached
        for shell in voids[found.volume[voids] < 0.0]:
            void = compact(TriangleMesh(mesh.vertices, mesh.triangles[found.shell == shell]))
            own = _lowest(site, void, lattice, wanted, holes)
            chosen.append(own)
            holes = holes.joined(own)
            if len(own.start) < wanted.count:
                x, y, z = void.vertices.mean(axis=0)
                warnings.append(
                    f"The void about ({x:.4g}, {y:.4g}, {z:.4g}) has room for {len(own.start)} of "
                    f"its {wanted.count} drain holes: choose a smaller diameter, or give their "
                    "places."
                )
            monitor.tick()
        added = [cylinder for own in chosen for cylinder in site.cylinders(own)]
        drilled = _drill(drilled, added, monitor)
        found = drilled.inspected(monitor).found
    warnings += trapped_warnings(found.quality.voids)
    places = tuple((float(x), float(y), float(z)) for x, y, z in holes.start)
    before = part.inspected(monitor).found.quality.volume
    return Drained(drilled, places, before - found.quality.volume, tuple(warnings))


def _drill(part: TrimmedSurface, cylinders: list[TriangleMesh], monitor: Monitor) -> TrimmedSurface:
    if not cylinders:
        return part

    def less(whole: manifold3d.Manifold) -> manifold3d.Manifold:
        for cylinder in cylinders:
            whole = whole - as_manifold(cylinder)
        return whole

    return cut_again(part, cylinders, less, monitor, keeps=False)


def trapped_warnings(voids: int) -> tuple[str, ...]:
    """A sentence about closed voids, if there are any."""
    if not voids:
        return ()
    what = "void is" if voids == 1 else "voids are"
    return (f"{voids} closed {what} left, which would trap powder or resin.",)


@dataclass(frozen=True, eq=False)
class _Holes:
    """Holes from the part's surface into the cavity.

    Attributes:
        start: (n, 3) on the surface, mm.
        axis: (n, 3) unit vectors inward.
        out: (n,) how far a hole begins before its start, so that its rim is clear, mm.
        depth: (n,) how far it goes, mm.
    """

    start: Floats
    axis: Floats
    out: Floats
    depth: Floats

    @staticmethod
    def none() -> _Holes:
        return _Holes(np.zeros((0, 3)), np.zeros((0, 3)), np.zeros(0), np.zeros(0))

    def chosen(self, rows: Ints | Bools) -> _Holes:
        return _Holes(self.start[rows], self.axis[rows], self.out[rows], self.depth[rows])

    def joined(self, other: _Holes) -> _Holes:
        return _Holes(
            np.concatenate([self.start, other.start]),
            np.concatenate([self.axis, other.axis]),
            np.concatenate([self.out, other.out]),
            np.concatenate([self.depth, other.depth]),
        )


@dataclass(frozen=True, eq=False)
class _Site:
    """Where holes are drilled.

    Attributes:
        solid: the part's outside.
        domain: what the lattice fills.
        thickness: of the skin between, mm.
        radius: of the holes, mm.
    """

    solid: TriangleMesh
    domain: TriangleMesh
    thickness: float
    radius: float

    def feel(self, start: Floats, axis: Floats, inward: Floats) -> tuple[_Holes, Bools]:
        """Holes at (n, 3) points of the surface, and (n,) which go through the skin alone.

        Rays along the hole's sides and its middle tell where the skin begins and ends.

        Args:
            start: on the surface, mm.
            axis: unit vectors along the holes, into the part.
            inward: unit vectors across the surface there.
        """
        count = len(start)
        first, second = axes_across(axis)
        angle = 2.0 * np.pi * np.arange(RAYS) / RAYS
        ring = np.cos(angle)[:, None, None] * first + np.sin(angle)[:, None, None] * second
        aside = self.radius * np.concatenate([np.zeros((1, count, 3)), ring])
        deepest = DEEPEST[0] * self.thickness + DEEPEST[1] * 2.0 * self.radius
        # A slanting hole's sides begin as much above and below its start.
        cosine = np.clip(np.einsum("ij,ij->i", axis, inward), STEEPEST, 1.0)
        above = self.radius * np.sqrt(1.0 / cosine**2 - 1.0)
        origin = (start + aside - above[:, None] * axis).reshape(-1, 3)
        way = np.tile(axis, (RAYS + 1, 1))
        reach = np.tile(above + deepest, RAYS + 1)
        # Inward: where every ray enters the cavity, and where the first one leaves it again.
        enters, leaves = _first_two(self.domain, origin, origin + reach[:, None] * way)
        depth = (reach * enters).reshape(-1, count).max(axis=0) - above
        far = (reach * leaves).reshape(-1, count).min(axis=0) - above
        depth += OVERLAP * 2.0 * self.radius
        # Outward: where every ray has left the part, and where the first meets it again.
        origin = (start + aside + depth[:, None] * axis).reshape(-1, 3)
        reach = np.tile(depth + deepest, RAYS + 1)
        exits, back = _first_two(self.solid, origin, origin - reach[:, None] * way, leaving=True)
        out = (reach * exits).reshape(-1, count).max(axis=0) - depth
        again = (reach * back).reshape(-1, count).min(axis=0) - depth
        out += OVERLAP * 2.0 * self.radius
        good = (depth < np.minimum(far, deepest)) & (out < np.minimum(again, deepest))
        return _Holes(start, axis, out, depth), good

    def cylinders(self, holes: _Holes) -> list[TriangleMesh]:
        """The holes' insides."""
        first, second = axes_across(holes.axis)
        angle = 2.0 * np.pi * np.arange(SIDES) / SIDES
        ring = np.cos(angle)[:, None] * first[:, None] + np.sin(angle)[:, None] * second[:, None]
        # As much area as the circle has.
        radius = self.radius * math.sqrt(2.0 * math.pi / SIDES / math.sin(2.0 * math.pi / SIDES))
        low = holes.start - holes.out[:, None] * holes.axis
        high = holes.start + holes.depth[:, None] * holes.axis
        k = np.arange(SIDES)
        after = (k + 1) % SIDES
        bottom, top = 2 * SIDES, 2 * SIDES + 1
        triangles = np.concatenate(
            [
                np.stack([k, after, SIDES + after], axis=1),
                np.stack([k, SIDES + after, SIDES + k], axis=1),
                np.stack([after, k, np.full(SIDES, bottom)], axis=1),
                np.stack([SIDES + k, SIDES + after, np.full(SIDES, top)], axis=1),
            ]
        ).astype(np.int32)
        return [
            TriangleMesh(
                np.concatenate([a + radius * r, b + radius * r, a[None], b[None]]), triangles
            )
            for a, b, r in zip(low, high, ring, strict=True)
        ]


def _first_two(
    mesh: TriangleMesh, start: Floats, end: Floats, leaving: bool = False
) -> tuple[Floats, Floats]:
    """Shares of segments' lengths at which they first enter a mesh, and leave it again.

    With `leaving`, at which they first leave it and enter it again. What does not happen is 1 for
    the first, twice the length for the second; one that begins with the other counts as neither.
    """
    segment, share, step = segment_crossings(mesh, start, end)
    wanted = 1 if leaving else -1
    first, second = np.ones(len(start)), np.full(len(start), 2.0)
    at = np.flatnonzero(np.diff(segment, prepend=-1) > 0)
    right = at[step[at] == wanted]
    first[segment[right]] = share[right]
    has = right[right + 1 < len(segment)]
    has = has[segment[has + 1] == segment[has]]
    second[segment[has]] = share[has + 1]
    return first, second


def _given_holes(site: _Site, wanted: DrainHoles) -> _Holes:
    """The holes at given places."""
    if not wanted.places:
        return _Holes.none()
    points = np.array([place.point for place in wanted.places], float)
    start, distance, triangle = closest_points(site.solid, points)
    size = float(np.linalg.norm(np.ptp(site.solid.bounds, axis=0)))
    off = int(np.argmax(distance))
    if distance[off] > OFF_SURFACE * size:
        raise VolfrepError(
            f"The drain hole at {place_text(points[off])} is {distance[off]:.3g} mm off the part's "
            "surface: give a point on it."
        )
    a, b, c = (corner[triangle] for corner in site.solid.corners())
    inward = np.cross(c - a, b - a)
    inward /= np.linalg.norm(inward, axis=1)[:, None]
    axis = inward.copy()
    for row, place in enumerate(wanted.places):
        if place.direction is not None:
            axis[row] = np.array(place.direction, float) / np.linalg.norm(place.direction)
    axis *= np.where(np.einsum("ij,ij->i", axis, inward) < 0.0, -1.0, 1.0)[:, None]
    holes, good = site.feel(start, axis, inward)
    if not good.all():
        where = place_text(start[np.argmin(good)])
        raise VolfrepError(
            f"A drain hole of {2.0 * site.radius:g} mm at {where} does not "
            "go through the skin alone into the cavity: move it away from edges and thin places, "
            "or reduce its diameter."
        )
    return holes


def _lowest(
    site: _Site, void: TriangleMesh, lattice: Wireframe, wanted: DrainHoles, others: _Holes
) -> _Holes:
    """Holes into a void, at the lowest places of its wall that have room.

    Args:
        site: where holes are drilled.
        void: its surface.
        lattice: struts that should not be in the way; of walls, the void's surface shows them.
        wanted: how many, and which way is up.
        others: holes to keep away from.
    """
    up = np.array(wanted.build_direction, float)
    up /= np.linalg.norm(up)
    points = _on_boundary(site, void)
    points = points[np.argsort(along(points, up), kind="stable")]
    chosen = _Holes.none()
    begin, size = 0, LOOKED_AT
    while len(chosen.start) < wanted.count and begin < len(points):
        inside = points[begin : begin + size]
        begin, size = begin + size, 2 * size
        start = closest_points(site.solid, inside)[0]
        axis = inside - start
        length = np.linalg.norm(axis, axis=1)
        start, inside, axis = (values[length > 0.0] for values in (start, inside, axis))
        axis /= np.linalg.norm(axis, axis=1)[:, None]
        holes, good = site.feel(start, axis, axis)
        holes, inside = holes.chosen(good), inside[good]
        # Where struts are farthest off, and other holes far enough.
        height = along(inside, up)
        if len(lattice.struts):
            clearance = _clearance(lattice, inside + site.radius * holes.axis)
        else:
            clearance = _void_clearance(site, void, inside)
        while len(chosen.start) < wanted.count:
            taken = np.concatenate([others.start, chosen.start])
            gap = np.linalg.norm(holes.start[:, None] - taken[None], axis=2)
            free = (gap > APART * 2.0 * site.radius).all(axis=1)
            if not free.any():
                break
            low = free & (height <= height[free].min() + SAME_HEIGHT * 2.0 * site.radius)
            best = int(np.argmax(np.where(low, clearance, -np.inf)))
            chosen = chosen.joined(holes.chosen(np.array([best])))
    return chosen


def _on_boundary(site: _Site, void: TriangleMesh) -> Floats:
    """Random points of a void's surface that lie on the inner wall, the same for the same void."""
    points = random_points(void, CANDIDATES)
    near = closest_points(site.domain, points)[1] < ON_WALL * site.thickness
    return np.asarray(points[near])


def _clearance(lattice: Wireframe, points: Floats) -> Floats:
    """(n,) distance from points to the nearest strut's surface, mm."""
    start, end = lattice.nodes[lattice.struts].swapaxes(0, 1)
    radius = lattice.radii.max(axis=1)
    if not len(points):
        return np.zeros(0)
    reach = float(np.linalg.norm(end - start, axis=1).max())
    near = (np.minimum(start, end) < points.max(axis=0) + reach).all(axis=1)
    near &= (np.maximum(start, end) > points.min(axis=0) - reach).all(axis=1)
    start, along, radius = start[near], (end - start)[near], radius[near]
    result = np.full(len(points), reach)
    for k in range(0, len(start), 5000):
        part = slice(k, k + 5000)
        offset = points[:, None] - start[part]
        share = np.einsum("nmi,mi->nm", offset, along[part]) / (along[part] ** 2).sum(axis=1)
        off = offset - np.clip(share, 0.0, 1.0)[:, :, None] * along[part]
        gap = np.linalg.norm(off, axis=2) - radius[part]
        result = np.minimum(result, gap.min(axis=1))
    return result


def _void_clearance(site: _Site, void: TriangleMesh, points: Floats) -> Floats:
    """(n,) distance from points to what of a void's surface is not the inner wall, mm."""
    away = closest_points(site.domain, void.vertices)[1] > ON_WALL * site.thickness
    rows = void.triangles[touching(away, void.triangles)]
    if not len(rows) or not len(points):
        return np.zeros(len(points))
    return np.asarray(closest_points(compact(TriangleMesh(void.vertices, rows)), points)[1])

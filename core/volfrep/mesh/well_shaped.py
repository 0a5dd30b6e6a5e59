# SPDX-License-Identifier: LGPL-2.1-or-later
"""Facets that a solver's mesher can work with: no needles, no caps, the same surface.

What a Boolean leaves along a cut is mended where it is bad and nowhere else, by three moves that
are each safe by themselves: a short edge is collapsed and an edge is flipped where the surface
stays within a tolerance, and a long edge is split, which changes no surface at all. Splitting
the longest edge of a bad facet, where it is the longest of both its facets, is the refinement of
M. C. Rivara, Int. J. Numer. Meth. Engng. 40, 1997.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from ..util.ragged import rows_of
from ..util.types import Bools, Floats, Ints
from . import remesh
from .triangle_mesh import TriangleMesh, compact

#: Facets with angles below or above these, degrees, are bad.
LEAST_ANGLE = 10.0
MOST_ANGLE = 150.0
#: What is changed may have no angle below this, unless it was worse before.
WANTED_ANGLE = 15.0
#: A collapse may take this part of a smaller angle: what it removes is worse than what it leaves.
LOSS = 0.8
#: Facets may not turn by more than this (cosine) when they change.
TURN = 0.7
#: But those lower than this part of the tolerance have no side that would matter.
THIN = 0.2
#: Facets on the way to a longest edge that is the longest of both its facets.
PATH = 20
#: Rounds of all three moves.
ROUNDS = 24
#: Rings of facets about bad ones that may change.
RINGS = 3
#: The tolerance about a place that asks for less of it, in parts of the usual one.
LESS = 0.25


@dataclass(frozen=True, eq=False)
class Tolerance:
    """How far a move may take the surface: less about some places.

    Attributes:
        usual: mm.
        places: arrays (k, 3) of places, mm: about one of each it is `LESS` times as much.
        reach: how far about them, mm.
    """

    usual: float
    places: tuple[Floats, ...] = ()
    reach: float = 0.0

    def at(self, points: Floats) -> Floats:
        """(n,) the tolerance at points (n, 3), mm."""
        result = np.full(len(points), self.usual)
        for places in self.places:
            apart = cKDTree(places).query(points, distance_upper_bound=self.reach)[0]
            result[apart < np.inf] *= LESS
        return result


def angles_of(corners: Floats) -> Floats:
    """(m, 3) angles of (m, 3, 3) facets, degrees; 0 where two corners are one."""
    along = np.roll(corners, -1, axis=1) - corners
    length = np.linalg.norm(along, axis=2)
    back = np.roll(along, 1, axis=1)
    product = np.maximum(length * np.roll(length, 1, axis=1), 1e-300)
    cosine = -np.einsum("mij,mij->mi", along, back) / product
    result: Floats = np.degrees(np.arccos(np.clip(cosine, -1.0, 1.0)))
    return np.where((length > 0) & (np.roll(length, 1, axis=1) > 0), result, 0.0)


def is_bad(corners: Floats) -> Bools:
    """(m,) whether (m, 3, 3) facets have angles beyond the limits."""
    angle = angles_of(corners)
    result: Bools = (angle.min(axis=1) < LEAST_ANGLE) | (angle.max(axis=1) > MOST_ANGLE)
    return result


def well_shaped(mesh: TriangleMesh, tolerance: Tolerance, shortest: float) -> TriangleMesh:
    """The closed mesh without needles and caps, as far as that goes.

    Args:
        mesh: closed, every edge of two facets.
        tolerance: how far a move may take the surface.
        shortest: no edge is split into pieces shorter than that, mm.
    """
    points, triangles = mesh.vertices, mesh.triangles.astype(np.int64)
    for done in range(ROUNDS):
        bad = is_bad(points[triangles])
        if not bad.any():
            break
        near = np.zeros(len(points), bool)
        near[triangles[bad]] = True
        for _ in range(RINGS):
            part = near[triangles].any(axis=1)
            near[triangles[part]] = True
        used, local = np.unique(triangles[part], return_inverse=True)
        moved, piece, kept = _mended(
            points[used], local.reshape(-1, 3), tolerance, shortest, done % 2 == 1
        )
        # Points that went are no longer in use, new ones follow all the others.
        row = np.concatenate([used[kept], len(points) + np.arange(len(moved) - len(kept))])
        points = np.concatenate([points, moved[len(kept) :]])
        points[row[: len(kept)]] = moved[: len(kept)]
        triangles = np.concatenate([triangles[~part], row[piece]])
    return compact(TriangleMesh(points, triangles.astype(np.int32)))


def without_fins(mesh: TriangleMesh, folded: Bools) -> TriangleMesh:
    """The closed mesh without points that only three facets share which lie on one another.

    Such a point sticks out of the surface in a fin of no thickness: one facet takes the place of
    its three, and nothing is lost. The mesh itself where there is none.

    Args:
        mesh: closed.
        folded: (m,) facets that lie on a neighbour.
    """
    triangles = mesh.triangles.astype(np.int64)
    count = len(mesh.vertices)
    tip = np.bincount(triangles.ravel(), minlength=count) == 3
    tip &= np.bincount(triangles[folded].ravel(), minlength=count) == 3
    tip[triangles[tip[triangles].sum(axis=1) > 1]] = False
    rows, facet = _around(triangles, tip)
    # Of a tetrahedron the fourth facet would be left with its own back.
    whole = ~np.isin(_names(facet, count), _names(triangles, count))
    if not whole.any():
        return mesh
    stays = np.ones(len(triangles), bool)
    stays[rows[whole].ravel()] = False
    joined = np.concatenate([triangles[stays], facet[whole]]).astype(np.int32)
    return compact(TriangleMesh(mesh.vertices, joined))


def _around(triangles: Ints, chosen: Bools) -> tuple[Ints, Ints]:
    """Of each chosen point, which has three facets: their rows, and the one facet about them."""
    rows, corner = np.nonzero(chosen[triangles])
    order = np.argsort(triangles[rows, corner], kind="stable")
    rows, corner = rows[order], corner[order]
    begin = triangles[rows, (corner + 1) % 3].reshape(-1, 3)
    end = triangles[rows, (corner + 2) % 3].reshape(-1, 3)
    # Round the point: what the first facet ends with, another begins with.
    third = np.where(begin[:, 1] == end[:, 0], end[:, 1], end[:, 2])
    return rows.reshape(-1, 3), np.stack([begin[:, 0], end[:, 0], third], axis=1)


def _names(triangles: Ints, count: int) -> Ints:
    """A number for the three corners of each facet, whatever their order."""
    result: Ints = (np.sort(triangles, axis=1) * np.array([count**2, count, 1])).sum(axis=1)
    return result


def _mended(
    points: Floats, triangles: Ints, tolerance: Tolerance, shortest: float, dearer: bool
) -> tuple[Floats, Ints, Ints]:
    """An open piece after one round: points, facets, and which points the first ones were."""
    kept, triangles = np.unique(_without_threes(points, triangles, tolerance), return_inverse=True)
    points, triangles = points[kept], triangles.reshape(-1, 3)
    points, triangles, renumber = _collapsed(points, triangles, tolerance, dearer)
    kept = kept[np.flatnonzero(renumber >= 0)]
    for _ in range(3):
        triangles, flipped = _flipped(points, triangles, tolerance)
        if not flipped:
            break
    points, triangles = _split(points, triangles, shortest)
    for _ in range(3):
        triangles, flipped = _flipped(points, triangles, tolerance)
        if not flipped:
            break
    return points, triangles, kept


def _fixed(triangles: Ints, count: int) -> Bools:
    """The vertices at the border of an open piece."""
    table = remesh.edges(triangles, count)
    fixed = np.zeros(count, bool)
    fixed[table.ends[table.triangles[:, 1] < 0]] = True
    return fixed


def _without_threes(points: Floats, triangles: Ints, tolerance: Tolerance) -> Ints:
    """The facets, one in place of three that meet in a point, where it is good or one was bad.

    No edge opposite to such a point can be collapsed. The points stay, without facets.
    """
    bad = is_bad(points[triangles])
    count = np.bincount(triangles.ravel(), minlength=len(points))
    near = np.bincount(triangles[bad].ravel(), minlength=len(points)) > 0
    chosen = (count == 3) & ~_fixed(triangles, len(points))
    # Of points that are neighbours only the first goes.
    several = chosen[triangles].sum(axis=1) > 1
    chosen[triangles[several].max(axis=1)] = False
    chosen[np.sort(triangles[several], axis=1)[:, 1]] = False
    rows, corner = np.nonzero(chosen[triangles])
    point = triangles[rows, corner]
    begin, end = triangles[rows, (corner + 1) % 3], triangles[rows, (corner + 2) % 3]
    order = np.argsort(point, kind="stable")
    rows, point, begin, end = (part[order].reshape(-1, 3) for part in (rows, point, begin, end))
    # Round the point: what the first facet ends with, another begins with.
    third = np.where(begin[:, 1] == end[:, 0], end[:, 1], end[:, 2])
    facet = np.stack([begin[:, 0], end[:, 0], third], axis=1)
    normal = remesh.normals(points[facet])
    size = np.maximum(np.linalg.norm(normal, axis=1), 1e-300)
    corners = points[triangles]
    is_thin = remesh.heights(corners) < THIN * tolerance.at(corners.mean(axis=1))
    away = np.abs(np.einsum("ij,ij->i", normal, points[point[:, 0]] - points[facet[:, 0]])) / size
    sides = remesh.normals(points[triangles[rows.ravel()]]).reshape(-1, 3, 3)
    along = np.einsum("ikj,ij->ik", sides, normal)
    # What is that thin has no side that would matter.
    same = along > TURN * size[:, None] * np.linalg.norm(sides, axis=2)
    same |= is_thin[rows]
    goes = (away <= tolerance.at(points[point[:, 0]])) & same.all(axis=1)
    goes &= near[point[:, 0]] | ~is_bad(points[facet])
    # Of a tetrahedron the fourth facet would be left with its own back.
    shape = np.array([len(points) ** 2, len(points), 1])
    names = [(np.sort(part, axis=1) * shape).sum(axis=1) for part in (facet, triangles)]
    goes &= ~np.isin(*names)
    stays = np.ones(len(triangles), bool)
    stays[rows[goes].ravel()] = False
    return np.concatenate([triangles[stays], facet[goes]])


def _collapsed(
    points: Floats, triangles: Ints, tolerance: Tolerance, dearer: bool
) -> tuple[Floats, Ints, Ints]:
    """Shortest edges of bad facets collapsed: points, facets, the new number of each point.

    Onto the end where that moves the surface less, or else the `dearer` way.
    """
    count = len(points)
    fixed = _fixed(triangles, count)
    corners = points[triangles]
    bad = is_bad(corners)
    sides = np.linalg.norm(corners - np.roll(corners, -1, axis=1), axis=2)
    at = sides.argmin(axis=1)
    rows = np.flatnonzero(bad)
    ends = np.stack([triangles[rows, at[rows]], triangles[rows, (at[rows] + 1) % 3]], axis=1)
    wanted = np.unique(ends.min(axis=1) * np.int64(count) + ends.max(axis=1))
    longest = float(sides[rows, at[rows]].max(initial=0.0)) * (1.0 + 1e-9)
    normal = remesh.unit_normals(corners)
    begin, facet = remesh.grouped(triangles.ravel(), np.repeat(np.arange(len(triangles)), 3), count)

    def away(vertex: Ints, place: Floats) -> Floats:
        """How far from the planes about each vertex a place is."""
        row, owner = rows_of(begin, vertex)
        height = np.einsum("ij,ij->i", normal[facet[row]], (place - points[vertex])[owner])
        result = np.zeros(len(vertex))
        np.maximum.at(result, owner, np.abs(height))
        return np.where(fixed[vertex] & (place != points[vertex]).any(axis=1), np.inf, result)

    def merge(gone: Ints, kept: Ints) -> tuple[Floats, Floats]:
        low, high = np.minimum(gone, kept), np.maximum(gone, kept)
        asked = np.isin(low * np.int64(count) + high, wanted)
        one, two = away(gone, points[kept]), away(kept, points[gone])
        allowed = np.minimum(tolerance.at(points[gone]), tolerance.at(points[kept]))
        # Where both would do, the one that moves the surface less, or the other.
        onto = one <= two
        onto ^= dearer & (np.maximum(one, two) <= allowed)
        cost = np.where(onto, one, two)
        target = np.where(onto[:, None], points[kept], points[gone])
        length = np.linalg.norm(points[gone] - points[kept], axis=1)
        return np.where(asked & (cost <= allowed), length, np.inf), target

    def improves(before: Floats, after: Floats) -> Bools:
        return _improves(before, after, tolerance)

    def always(gone: Ints, _: Ints) -> Bools:
        result: Bools = ~fixed[gone]
        return result

    rules = remesh.Rules(fixed.astype(np.int64), always, _never, improves, merge)
    return remesh.collapse(points, triangles, rules, max(longest, 1e-300), np.inf)


def _improves(before: Floats, after: Floats, tolerance: Tolerance) -> Bools:
    """Whether facets keep their side, and become no worse where they are bad."""
    thin = THIN * tolerance.at(before.mean(axis=1))
    least, was = angles_of(after).min(axis=1), angles_of(before).min(axis=1)
    good = (least > WANTED_ANGLE) | (least >= LOSS * was)
    low = np.maximum(remesh.heights(before), remesh.heights(after)) < thin
    result: Bools = low | (good & _same_side(before, after, thin))
    return result


def _same_side(before: Floats, after: Floats, thin: Floats) -> Bools:
    """Whether facets (m, 3, 3) look the same way; those lower than `thin` before look nowhere."""
    old, new = remesh.normals(before), remesh.normals(after)
    size = np.linalg.norm(old, axis=1) * np.linalg.norm(new, axis=1)
    result: Bools = (np.einsum("ij,ij->i", old, new) > TURN * size) | (
        remesh.heights(before) < thin
    )
    return result


def _flipped(points: Floats, triangles: Ints, tolerance: Tolerance) -> tuple[Ints, int]:
    """Facets with their edges flipped where that makes the least angle larger; how many were."""
    poor = np.zeros(len(points), bool)
    poor[triangles[angles_of(points[triangles]).min(axis=1) < WANTED_ANGLE]] = True

    def gain(ends: Ints, corners: Ints) -> Floats:
        # Most facets are good, and stay: only edges with a poor one are looked at.
        result = np.full(len(ends), -1.0)
        rows = np.flatnonzero(poor[ends].all(axis=1) & poor[corners].any(axis=1))
        result[rows] = gain_of(ends[rows], corners[rows])
        return result

    def gain_of(ends: Ints, corners: Ints) -> Floats:
        u, v = ends.T
        a, b = corners.T
        old = np.stack([[u, v, a], [v, u, b]]).transpose(2, 0, 1).reshape(-1, 3)
        new = np.stack([[a, b, v], [b, a, u]]).transpose(2, 0, 1).reshape(-1, 3)
        was = angles_of(points[old]).min(axis=1).reshape(-1, 2).min(axis=1)
        then = angles_of(points[new]).min(axis=1).reshape(-1, 2).min(axis=1)
        # The two edges are the diagonals of a tetrahedron: how far apart they are.
        p, q = points[v] - points[u], points[b] - points[a]
        across = np.cross(p, q)
        apart = np.abs(np.einsum("ij,ij->i", across, points[a] - points[u]))
        apart /= np.maximum(np.linalg.norm(across, axis=1), 1e-300)
        allowed = (apart <= tolerance.usual) & (was < WANTED_ANGLE) & (then > was)
        rows = np.flatnonzero(allowed)
        most = tolerance.at(0.5 * (points[u[rows]] + points[v[rows]]))
        allowed[rows] = apart[rows] <= most
        # A crease stays where it is, however small.
        pairs = [part.reshape(-1, 2, 3)[rows] for part in (old, new)]
        for k in (0, 1):
            before = points[pairs[0][:, k]]
            for n in (0, 1):
                allowed[rows] &= _same_side(before, points[pairs[1][:, n]], THIN * most)
        return np.where(allowed, then - was - 0.1, -1.0)

    return remesh.flip(points, triangles, gain, _never)


def _split(points: Floats, triangles: Ints, shortest: float) -> tuple[Floats, Ints]:
    """Longest edges of bad facets in two, where they are the longest of both their facets."""
    count = np.int64(len(points))
    corners = points[triangles]
    sides = np.linalg.norm(corners - np.roll(corners, -1, axis=1), axis=2)
    at = sides.argmax(axis=1)
    every = np.arange(len(triangles))
    a, b = triangles[every, at], triangles[every, (at + 1) % 3]
    longest = np.minimum(a, b) * count + np.maximum(a, b)
    # Where a short edge could not go, halves of the others would be as bad.
    some = (sides.max(axis=1) > 2.0 * shortest) & (sides.min(axis=1) > 0.2 * shortest)
    going = np.flatnonzero(is_bad(corners) & some)
    return remesh.halve(points, triangles, longest, going, PATH)


def _never(one: Ints, two: Ints) -> Bools:
    return np.zeros(len(one), bool)

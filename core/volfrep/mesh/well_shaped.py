# SPDX-License-Identifier: LGPL-2.1-or-later
"""Facets that a solver's mesher can work with: no needles, no caps, the same surface.

What a Boolean leaves along a cut is mended where it is bad and nowhere else, by three moves that
are each safe by themselves: a short edge is collapsed and an edge is flipped where the surface
stays within a tolerance, and a long edge is split, which changes no surface at all. Splitting
the longest edge of a bad facet, where it is the longest of both its facets, is the refinement of
M. C. Rivara, Int. J. Numer. Meth. Engng. 40, 1997. On a convex surface each flip takes volume, as
many as they are: points that splits made move outwards in the end, until what changed has its
volume again.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from scipy.spatial import cKDTree

from ..util.ragged import rows_of, spread
from ..util.types import Bools, Floats, Ints
from . import remesh
from .closest import closest_on_triangles
from .patch_volumes import with_volumes
from .patches import FaultFinder, without_faults
from .topology import (
    adjacent,
    among_edges,
    edge_keys,
    numbered,
    open_vertices,
    touching,
    vertices_of,
)
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
#: Facets that turn by less than this (cosine) at a point lie in one plane, but for rounding.
STRAIGHT = 1.0 - 1e-7
#: Facets that meet at an edge at an angle below this, degrees, lie on one another.
OPPOSITE = 0.3
#: Facets on the way to a longest edge that is the longest of both its facets.
PATH = 20
#: Passes of collapses in a round, of which each takes one edge of a neighbourhood: along a strip of
#: needles one in twenty. No other follows one that takes less than this part of the facets.
COLLAPSES = 8
FEW = 0.005
#: Passes of flips after each collapse and each split.
FLIPS = 3
#: Rounds of all three moves at most, and so many in succession that leave no fewer bad facets than
#: there were: splitting needs some before it helps.
ROUNDS = 40
IN_VAIN = 4
#: Rings of facets about bad ones that may change.
RINGS = 3
#: The tolerance about a place that asks for less of it, in parts of the usual one.
LESS = 0.25


@dataclass(frozen=True, eq=False)
class Tolerance:
    """How far a move may take the surface: less about some places.

    Attributes:
        usual: mm.
        reach: how far about a place it is less, mm.
        places: (k, 3) mm.
        times: (k,) how many times it is `LESS` times as much there.
    """

    usual: float
    reach: float = 0.0
    places: Floats = field(default_factory=lambda: np.zeros((0, 3)))
    times: Ints = field(default_factory=lambda: np.zeros(0, np.int64))

    def at(self, points: Floats) -> Floats:
        """(n,) the tolerance at points (n, 3), mm."""
        result: Floats = self.usual * LESS ** self._times_at(points)
        return result

    def with_less(self, places: Floats) -> Tolerance:
        """The same with once less about places (k, 3), mm."""
        if not len(places):
            return self
        times = np.concatenate([self.times, self._times_at(places) + 1])
        return replace(self, places=np.concatenate([self.places, places]), times=times)

    def _times_at(self, points: Floats) -> Ints:
        """(n,) as often as at the nearest place within reach, of the last that was told."""
        if not len(self.places):
            return np.zeros(len(points), np.int64)
        row = self._tree.query(points, distance_upper_bound=self.reach)[1]
        result: Ints = np.append(self.times, 0)[row]
        return result

    @cached_property
    def _tree(self) -> cKDTree:
        return cKDTree(self.places)


def angles_of(corners: Floats) -> Floats:
    """(m, 3) angles of (m, 3, 3) facets, degrees; 0 where two corners are one."""
    # Axis by axis, which numpy takes in faster than rows of three.
    x = [[corners[:, k, axis] for axis in range(3)] for k in range(3)]
    along = [[q - p for p, q in zip(x[k], x[(k + 1) % 3], strict=True)] for k in range(3)]
    length = [np.sqrt(e[0] * e[0] + e[1] * e[1] + e[2] * e[2]) for e in along]
    result = np.zeros((len(corners), 3))
    for k in range(3):
        e, f, product = along[k], along[k - 1], length[k] * length[k - 1]
        cosine = -(e[0] * f[0] + e[1] * f[1] + e[2] * f[2]) / np.maximum(product, 1e-300)
        angle = np.degrees(np.arccos(np.clip(cosine, -1.0, 1.0)))
        result[:, k] = np.where((length[k] > 0) & (length[k - 1] > 0), angle, 0.0)
    return result


def _least_angles(corners: Floats) -> Floats:
    """(m,) the least angles of (m, 3, 3) facets, degrees."""
    a, b, c = angles_of(corners).T
    return np.asarray(np.minimum(np.minimum(a, b), c))


def is_bad(corners: Floats) -> Bools:
    """(m,) whether (m, 3, 3) facets have angles beyond the limits."""
    angle = angles_of(corners)
    return np.asarray((angle.min(axis=1) < LEAST_ANGLE) | (angle.max(axis=1) > MOST_ANGLE))


def mend_bad_facets(
    mesh: TriangleMesh, tolerance: Tolerance, shortest: float, find_faults: FaultFinder
) -> TriangleMesh:
    """The closed mesh without needles and caps, as far as that goes.

    What a round of moves changes is a patch here and there: those that have a fault are taken back,
    and less is moved about them from then on. So the mesh has no faults that it did not have. No
    point that it had is moved.

    Args:
        mesh: closed, every edge of two facets.
        tolerance: how far a move may take the surface.
        shortest: no edge is split into pieces shorter than that, mm.
        find_faults: of a mesh and (m,) facets that are new, (m,) facets that may not stay.
    """
    points, triangles = mesh.vertices, mesh.triangles.astype(np.int64)
    bad = is_bad(points[triangles])
    counts = []
    for done in range(ROUNDS):
        counts.append(int(bad.sum()))
        if not counts[-1] or len(counts) - 1 - int(np.argmin(counts)) == IN_VAIN:
            break
        part = bad
        for _ in range(RINGS):
            part = adjacent(part, triangles, len(points))
        used, local = numbered(triangles[part], len(points))
        moved, piece = _mend(points[used], local, tolerance, shortest, done % 2 == 1)
        row = np.concatenate([used, len(points) + np.arange(len(moved) - len(used))])
        points = np.concatenate([points, moved[len(used) :]])
        rest = triangles[~part]
        changed, places = without_faults(points, rest, triangles[part], row[piece], find_faults)
        tolerance = tolerance.with_less(points[places])
        triangles = np.concatenate([rest, changed])
        bad = np.concatenate([np.zeros(len(rest), bool), is_bad(points[changed])])
    free = _may_move(points, triangles) & (np.arange(len(points)) >= len(mesh.vertices))
    points = with_volumes(
        points, mesh.triangles.astype(np.int64), triangles, free, tolerance.at, find_faults
    )
    return compact(TriangleMesh(points, triangles.astype(np.int32)))


def around(triangles: Ints, chosen: Bools) -> tuple[Ints, Ints]:
    """Of chosen points (n,) with three facets each: their rows (k, 3), the facets about them."""
    rows, corner = np.nonzero(chosen[triangles])
    order = np.argsort(triangles[rows, corner], kind="stable")
    rows, corner = rows[order], corner[order]
    begin = triangles[rows, (corner + 1) % 3].reshape(-1, 3)
    end = triangles[rows, (corner + 2) % 3].reshape(-1, 3)
    # Round the point: what the first facet ends with, another begins with.
    third = np.where(begin[:, 1] == end[:, 0], end[:, 1], end[:, 2])
    return rows.reshape(-1, 3), np.stack([begin[:, 0], end[:, 0], third], axis=1)


def names(triangles: Ints, count: int) -> Ints:
    """A number for the three corners of each facet, whatever their order."""
    result: Ints = (np.sort(triangles, axis=1) * np.array([count**2, count, 1])).sum(axis=1)
    return result


def _mend(
    points: Floats, triangles: Ints, tolerance: Tolerance, shortest: float, dearer: bool
) -> tuple[Floats, Ints]:
    """An open piece after one round: points stay, though not their facets; new ones follow."""
    triangles = _without_threes(points, triangles, tolerance)
    for _ in range(COLLAPSES):
        before, triangles = triangles, _collapse(points, triangles, tolerance, dearer)
        if len(triangles) > (1.0 - FEW) * len(before):
            break
    triangles = _flip(points, triangles, tolerance)
    points, triangles = _split(points, triangles, shortest)
    return points, _flip(points, triangles, tolerance)


def _without_threes(points: Floats, triangles: Ints, tolerance: Tolerance) -> Ints:
    """The facets, one in place of three that meet in a point, where it is good or one was bad.

    No edge opposite to such a point can be collapsed. The points stay, without facets.
    """
    bad = is_bad(points[triangles])
    count = np.bincount(triangles.ravel(), minlength=len(points))
    near = np.bincount(triangles[bad].ravel(), minlength=len(points)) > 0
    chosen = (count == 3) & ~open_vertices(triangles, len(points))
    # Of points that are neighbours only the first goes.
    several = chosen[triangles].sum(axis=1) > 1
    chosen[triangles[several].max(axis=1)] = False
    chosen[np.sort(triangles[several], axis=1)[:, 1]] = False
    rows, facet = around(triangles, chosen)
    point = np.flatnonzero(chosen)
    normal = remesh.normals(points[facet])
    size = np.maximum(np.linalg.norm(normal, axis=1), 1e-300)
    corners = points[triangles[rows.ravel()]]
    is_thin = remesh.heights(corners) < THIN * tolerance.at(corners.mean(axis=1))
    away = np.abs(np.einsum("ij,ij->i", normal, points[point] - points[facet[:, 0]])) / size
    sides = remesh.normals(corners).reshape(-1, 3, 3)
    along = np.einsum("ikj,ij->ik", sides, normal)
    # What is that thin has no side that would matter.
    same = along > TURN * size[:, None] * np.linalg.norm(sides, axis=2)
    same |= is_thin.reshape(-1, 3)
    goes = (away <= tolerance.at(points[point])) & same.all(axis=1)
    goes &= near[point] | ~is_bad(points[facet])
    # Of a tetrahedron the fourth facet would be left with its own back.
    goes &= ~np.isin(names(facet, len(points)), names(triangles, len(points)))
    stays = np.ones(len(triangles), bool)
    stays[rows[goes].ravel()] = False
    return np.concatenate([triangles[stays], facet[goes]])


def _collapse(points: Floats, triangles: Ints, tolerance: Tolerance, dearer: bool) -> Ints:
    """The facets with the shortest edges of bad ones collapsed.

    Onto the end where that moves the surface less, or else the `dearer` way.
    """
    bad = is_bad(points[triangles])
    if not bad.any():
        return triangles
    at_border = open_vertices(triangles, len(points))
    part = adjacent(bad, triangles, len(points))
    used, local = numbered(triangles[part], len(points))
    rules, longest = _rules(points[used], local, bad[part], at_border[used], tolerance, dearer)
    moved, some, renumber = remesh.collapse(points[used], local, rules, longest, np.inf)
    # The end that is left has the other's place, or else its own: that place's row is its name.
    row, gone = used[renumber >= 0], np.flatnonzero(renumber < 0)
    kept = ~renumber[gone]
    onto = (moved[kept] == points[used[gone]]).all(axis=1)
    row[kept[onto]] = used[gone[onto]]
    return np.concatenate([triangles[~part], row[some]])


def _rules(
    points: Floats, triangles: Ints, bad: Bools, fixed: Bools, tolerance: Tolerance, dearer: bool
) -> tuple[remesh.Rules, float]:
    """How the shortest edges of bad facets collapse, and how long the longest of them is."""
    count = len(points)
    corners = points[triangles]
    rows = np.flatnonzero(bad)
    sides = np.linalg.norm(corners[rows] - np.roll(corners[rows], -1, axis=1), axis=2)
    at = sides.argmin(axis=1)
    ends = np.stack([triangles[rows, at], triangles[rows, (at + 1) % 3]], axis=1)
    wanted = np.unique(edge_keys(ends[:, 0], ends[:, 1], count))
    longest = float(sides.min(axis=1).max(initial=0.0)) * (1.0 + 1e-9)
    normal = remesh.unit_normals(corners)
    begin, facet = remesh.grouped(triangles.ravel(), np.repeat(np.arange(len(triangles)), 3), count)
    sharp = _are_sharp(triangles, normal, count)

    def away(vertex: Ints, place: Floats) -> Floats:
        """How far from the planes about each vertex a place is."""
        row, owner = rows_of(begin, vertex)
        height = np.einsum("ij,ij->i", normal[facet[row]], (place - points[vertex])[owner])
        result = np.zeros(len(vertex))
        np.maximum.at(result, owner, np.abs(height))
        return np.where(fixed[vertex] & (place != points[vertex]).any(axis=1), np.inf, result)

    def apart(lost: Ints, left: Ints) -> Floats:
        """How far the facets about each vertex are from those with another in its place."""
        row, owner = rows_of(begin, lost)
        old = triangles[facet[row]]
        at = (old == lost[owner, None]).argmax(axis=1)
        other = points[old[np.arange(len(old)), (at + 1) % 3]]
        new = points[np.where(old == lost[owner, None], left[owner, None], old)]
        result = np.zeros(len(lost))
        for place, facets in (
            (points[lost[owner]], new),
            (0.5 * (points[lost[owner]] + other), new),
            (0.5 * (points[left[owner]] + other), points[old]),
        ):
            np.maximum.at(result, owner, _nearest(place, facets, owner))
        return result

    def merge(gone: Ints, kept: Ints) -> tuple[Floats, Floats]:
        result, target = np.full(len(gone), np.inf), points[kept]
        asked = np.flatnonzero(among_edges(gone, kept, wanted, count))
        result[asked], target[asked] = cost_of(gone[asked], kept[asked])
        return result, target

    def cost_of(gone: Ints, kept: Ints) -> tuple[Floats, Floats]:
        one, two = away(gone, points[kept]), away(kept, points[gone])
        allowed = np.minimum(tolerance.at(points[gone]), tolerance.at(points[kept]))
        # Where both would do, the one that moves the surface less, or the other.
        onto = one <= two
        onto ^= dearer & (np.maximum(one, two) <= allowed)
        cost = np.where(onto, one, two)
        target = np.where(onto[:, None], points[kept], points[gone])
        length = np.linalg.norm(points[gone] - points[kept], axis=1)
        # At the tip of a lip, or the bottom of a slot, all planes are near however far it moves.
        lost, left = (np.where(onto, *ends) for ends in ((gone, kept), (kept, gone)))
        asked = np.flatnonzero((cost <= allowed) & (length > allowed) & sharp[lost])
        cost[asked] = np.maximum(cost[asked], apart(lost[asked], left[asked]))
        return np.where(cost <= allowed, length, np.inf), target

    def improves(before: Floats, after: Floats) -> Bools:
        return _improves(before, after, tolerance)

    def is_free(gone: Ints, _: Ints) -> Bools:
        return np.asarray(~fixed[gone])

    rules = remesh.Rules(fixed.astype(np.int64), is_free, _never, improves, merge)
    return rules, max(longest, 1e-300)


def _may_move(points: Floats, triangles: Ints) -> Bools:
    """(n,) whether a surface is bent at a point, but not sharp: it is on no plane and no crease."""
    corner, turn = _turns(triangles, remesh.unit_normals(points[triangles]), len(points))
    result = np.zeros(len(points), bool)
    result[corner[turn < STRAIGHT]] = True
    result[corner[turn < TURN]] = False
    return result


def _are_sharp(triangles: Ints, normal: Floats, count: int) -> Bools:
    """(n,) whether facets about a point look farther than `TURN` from where they look together."""
    corner, turn = _turns(triangles, normal, count)
    result = np.zeros(count, bool)
    result[corner[turn < TURN]] = True
    return result


def _turns(triangles: Ints, normal: Floats, count: int) -> tuple[Ints, Floats]:
    """(3 m,) each: corners of facets, cosines between where these look and all do about it."""
    corner, facing = triangles.ravel(), np.repeat(normal, 3, axis=0)
    total = np.stack([np.bincount(corner, facing[:, k], count) for k in range(3)], axis=1)
    mean = total / np.maximum(np.linalg.norm(total, axis=1, keepdims=True), 1e-300)
    return corner, np.einsum("ij,ij->i", facing, mean[corner])


def _nearest(places: Floats, facets: Floats, owner: Ints) -> Floats:
    """(k,) how far places are from the nearest of the facets (k, 3, 3) of the same owner."""
    number = np.bincount(owner)
    begin = np.cumsum(number) - number
    one, turn = spread(number[owner])
    other = begin[owner[one]] + turn
    closest = closest_on_triangles(facets[other], places[one])[0]
    result = np.full(len(places), np.inf)
    np.minimum.at(result, one, np.linalg.norm(closest - places[one], axis=1))
    return result


def _improves(before: Floats, after: Floats, tolerance: Tolerance) -> Bools:
    """Whether facets keep their side, and become no worse where they are bad."""
    thin = THIN * tolerance.at(before.mean(axis=1))
    least, was = _least_angles(after), _least_angles(before)
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


def are_opposite(one: Floats, other: Floats) -> Bools:
    """Whether facets (m, 3, 3) look the opposite way of others, within `OPPOSITE` degrees."""
    # Of unit vectors that are nearly opposite the sum is the angle between them.
    sides = remesh.unit_normals(one) + remesh.unit_normals(other)
    return np.asarray(np.linalg.norm(sides, axis=1) < np.radians(OPPOSITE), np.bool_)


def _flip(points: Floats, triangles: Ints, tolerance: Tolerance) -> Ints:
    """Facets with their edges flipped where that makes the least angle larger."""
    poor = _least_angles(points[triangles]) < WANTED_ANGLE
    at_border = open_vertices(triangles, len(points))
    triangles = triangles.copy()
    for _ in range(FLIPS):
        # Most facets are good, and stay: only edges of poor ones are looked at, with all facets
        # about them, and again where others have changed.
        seen = vertices_of(triangles[poor], len(points))
        rows = np.flatnonzero(touching(seen, triangles))
        seen &= ~at_border

        def is_unknown(one: Ints, two: Ints) -> Bools:
            """Whether facets that are not looked at may have an edge between the two already."""
            return np.asarray(~(seen[one] | seen[two]), np.bool_)  # noqa: B023

        gain = _flip_gain(points, tolerance)
        some, flipped = remesh.flip(points, triangles[rows], gain, is_unknown)
        if not flipped:
            break
        poor[:] = False
        poor[rows[(some != triangles[rows]).any(axis=1)]] = True
        triangles[rows] = some
        rows = np.flatnonzero(adjacent(poor, triangles, len(points)))
        poor[:] = False
        poor[rows] = _least_angles(points[triangles[rows]]) < WANTED_ANGLE
    return triangles


def _flip_gain(points: Floats, tolerance: Tolerance) -> Callable[[Ints, Ints], Floats]:
    """What flips of edges win: degrees of the least angle, negative where they are not allowed."""

    def gain(ends: Ints, corners: Ints) -> Floats:
        u, v = ends.T
        a, b = corners.T
        old = np.stack([[u, v, a], [v, u, b]]).transpose(2, 0, 1).reshape(-1, 3)
        new = np.stack([[a, b, v], [b, a, u]]).transpose(2, 0, 1).reshape(-1, 3)
        was = _least_angles(points[old]).reshape(-1, 2).min(axis=1)
        then = _least_angles(points[new]).reshape(-1, 2).min(axis=1)
        # The two edges are the diagonals of a tetrahedron: how far apart they are.
        p, q = points[v] - points[u], points[b] - points[a]
        across = np.cross(p, q)
        apart = np.abs(np.einsum("ij,ij->i", across, points[a] - points[u]))
        apart /= np.maximum(np.linalg.norm(across, axis=1), 1e-300)
        allowed = (apart <= tolerance.usual) & (was < WANTED_ANGLE) & (then > was)
        rows = np.flatnonzero(allowed)
        most = tolerance.at(0.5 * (points[u[rows]] + points[v[rows]]))
        allowed[rows] = apart[rows] <= most
        # A crease stays where it is, however small. But a facet that lies on one higher than it is
        # looks the wrong way: what takes the place of both looks as the other one does.
        pairs = [points[part.reshape(-1, 2, 3)[rows]] for part in (old, new)]
        high = [remesh.heights(pairs[0][:, k]) for k in (0, 1)]
        lies = are_opposite(pairs[0][:, 0], pairs[0][:, 1])
        for k in (0, 1):
            thin = np.where(lies & (high[k] < high[1 - k]), np.inf, THIN * most)
            for n in (0, 1):
                allowed[rows] &= _same_side(pairs[0][:, k], pairs[1][:, n], thin)
        return np.where(allowed, then - was - 0.1, -1.0)

    return gain


def _split(points: Floats, triangles: Ints, shortest: float) -> tuple[Floats, Ints]:
    """Longest edges of bad facets in two, where they are the longest of both their facets."""
    corners = points[triangles]
    sides = np.linalg.norm(corners - np.roll(corners, -1, axis=1), axis=2)
    at = sides.argmax(axis=1)
    every = np.arange(len(triangles))
    a, b = triangles[every, at], triangles[every, (at + 1) % 3]
    longest = edge_keys(a, b, len(points))
    # Where a short edge could not go, halves of the others would be as bad.
    some = (sides.max(axis=1) > 2.0 * shortest) & (sides.min(axis=1) > 0.2 * shortest)
    going = np.flatnonzero(is_bad(corners) & some)
    return remesh.halve(points, triangles, longest, going, PATH)


def _never(one: Ints, two: Ints) -> Bools:
    return np.zeros(len(one), bool)

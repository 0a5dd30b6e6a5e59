# SPDX-License-Identifier: LGPL-2.1-or-later
"""Fewer triangles, within a given deviation: the compact mode of files for the printer.

Edges are collapsed into the point that lies nearest to the planes about them (M. Garland and
P. Heckbert, "Surface simplification using quadric error metrics", SIGGRAPH 1997), as long as that
point stays within reach of every one of these planes. The farthest that the surface has really
moved is then measured, and the work is done again more carefully where that is too far.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial

import numpy as np

from ..mesh import remesh
from ..mesh.float32_repair import merging_vertices, remove_slivers, separate_vertices, shortest_edge
from ..mesh.quality import Quality, measure
from ..mesh.triangle_mesh import TriangleMesh
from ..spatial.proximity import closest_points
from ..util.errors import VolfrepError
from ..util.linalg import solved
from ..util.progress import Monitor
from ..util.ragged import rows_of
from ..util.types import Bools, Floats, Ints

#: Where the user says nothing, mm: less than a printer resolves.
DEFAULT_DEVIATION = 0.02
#: A pass that takes out less than this share of the vertices is the last one.
LEAST_PROGRESS = 0.03
MAX_PASSES = 40
#: Triangles may not become thinner than this (2 inradius / circumradius) unless they were.
MIN_QUALITY = 0.05
#: Nor turn by more than this in one step (cosine: 25 degrees).
MIN_TURN_COSINE = 0.9
#: Places at which the deviation is measured, on either surface.
SAMPLES = 50_000
#: Where the deviation comes out larger than wanted, the next try aims at so much of what would do.
CAUTION = 0.9
TRIES = 5
#: Where the planes leave a direction open, the middle of the edge is as good: its weight.
SPRING = 1e-3
#: Bands of cost within which it does not matter which edge goes first.
BANDS = 8


@dataclass(frozen=True, eq=False)
class Reduced:
    """A mesh with fewer triangles.

    Attributes:
        mesh: the mesh.
        quality: of the mesh.
        deviation: largest distance found between the two surfaces, in mm.
        triangles_before: what the original had.
    """

    mesh: TriangleMesh
    quality: Quality
    deviation: float
    triangles_before: int


def reduce_triangles(
    mesh: TriangleMesh, deviation: float = DEFAULT_DEVIATION, monitor: Monitor | None = None
) -> Reduced:
    """The closed mesh with fewer triangles, nowhere farther than `deviation` from the original.

    Bodies, voids and genus stay as they were, and the file still reads as one that is closed.

    Args:
        mesh: closed, every edge shared by two triangles.
        deviation: mm.
        monitor: for progress and cancel.

    Raises:
        VolfrepError: the deviation is not a length or larger than the mesh allows, or the mesh is
            not closed.
        Cancelled: the monitor said so.

    >>> import trimesh
    >>> ball = trimesh.creation.icosphere(3, 5.0)
    >>> fine = TriangleMesh(ball.vertices, ball.faces.astype(np.int32))
    >>> reduced = reduce_triangles(fine, 0.1)
    >>> len(reduced.mesh.triangles) < 640 < reduced.triangles_before, reduced.deviation <= 0.1
    (True, True)
    """
    if not 0.0 < deviation < np.inf:
        raise VolfrepError(f"The deviation must be a length above 0 mm, not {deviation:g}.")
    monitor = monitor or Monitor()
    before = measure(mesh, monitor)
    if not before.watertight:
        raise VolfrepError("Only a closed mesh can be reduced: this one has open edges.")
    aim, precision = deviation, shortest_edge(mesh)
    for _ in range(TRIES):
        reduced = _reduced(mesh, aim, monitor)
        reduced = separate_vertices(remove_slivers(reduced, precision), precision)
        after = measure(reduced, monitor)
        same = ("watertight", "bodies", "voids", "genus")
        differs = any(getattr(after, name) != getattr(before, name) for name in same)
        if differs or len(merging_vertices(reduced)):
            raise VolfrepError(
                f"Within {deviation:g} mm the triangles cannot be reduced without closing a gap: "
                "give a smaller deviation."
            )
        found = deviation_between(mesh, reduced, SAMPLES, monitor)
        if found <= deviation:
            return Reduced(reduced, after, found, len(mesh.triangles))
        aim *= CAUTION * deviation / found
    return Reduced(mesh, before, 0.0, len(mesh.triangles))


def deviation_between(
    one: TriangleMesh, two: TriangleMesh, samples: int, monitor: Monitor | None = None
) -> float:
    """Largest distance from places on each surface to the other surface, mm.

    The places are vertices, middles of edges and of triangles, evenly chosen from all of them.
    """
    monitor = monitor or Monitor()
    farthest = [
        monitor.call(partial(closest_points, target, _places(source, samples)))[1].max()
        for source, target in ((one, two), (two, one))
    ]
    return float(max(farthest))


def _places(mesh: TriangleMesh, samples: int) -> Floats:
    corners = mesh.vertices[mesh.triangles]
    places = np.concatenate(
        [mesh.vertices, corners.mean(axis=1), 0.5 * (corners[:, 0] + corners[:, 1])]
    )
    chosen: Floats = places[:: max(1, len(places) // samples)]
    return chosen


def _reduced(mesh: TriangleMesh, deviation: float, monitor: Monitor) -> TriangleMesh:
    """One try: edges go until a pass takes out hardly any."""
    vertices, triangles = mesh.vertices, mesh.triangles.astype(np.int64)
    spent, fresh = np.zeros(len(vertices)), np.ones(len(vertices), bool)
    random = np.random.default_rng(1)
    for _ in range(MAX_PASSES):
        monitor.tick()
        count = len(vertices)
        stars = _Stars(vertices, triangles, spent, fresh, deviation, random)
        rules = remesh.Rules(
            np.zeros(count, np.int64), stars.has_changed, _nothing, _stays_good, stars.merge
        )
        vertices, triangles, renumber = remesh.collapse(vertices, triangles, rules, np.inf, np.inf)
        spent, fresh = stars.after(renumber)
        if count - len(vertices) < LEAST_PROGRESS * count:
            break
    return TriangleMesh(vertices, triangles.astype(np.int32))


class _Stars:
    """The triangles about each vertex, and how far the surface has already been moved there."""

    def __init__(
        self,
        vertices: Floats,
        triangles: Ints,
        spent: Floats,
        fresh: Bools,
        deviation: float,
        random: np.random.Generator,
    ) -> None:
        count = len(vertices)
        self._vertices, self._triangles = vertices, triangles
        self._spent, self._fresh = spent, fresh
        self._deviation, self._random = deviation, random
        self._waiting = np.zeros(count, bool)
        normal = remesh.normals(vertices[triangles])
        area = np.linalg.norm(normal, axis=1)
        self._normal = normal / np.maximum(area, 1e-300)[:, None]
        self._start, self._around = remesh.grouped(
            triangles.ravel(), np.repeat(np.arange(len(triangles)), 3), count
        )
        # Sums of n n^T and of n (n . p) by area, p about the vertex itself.
        owner = np.repeat(np.arange(count), np.diff(self._start))
        x, y, z = self._normal.T
        terms = (x * x, x * y, x * z, y * y, y * z, z * z, np.ones_like(x))
        self._planes = np.stack(
            [np.bincount(owner, (area * term)[self._around], minlength=count) for term in terms],
            axis=1,
        )

    def has_changed(self, gone: Ints, kept: Ints) -> Bools:
        """Whether an edge may have another cost than in the last pass, or was not chosen then."""
        result: Bools = self._fresh[gone] | self._fresh[kept]
        return result

    def merge(self, gone: Ints, kept: Ints) -> tuple[Floats, Floats]:
        """A rank among the edges, infinite for those that must stay; and the new vertex."""
        cost, place = self._cost(gone, kept)
        possible = cost <= self._deviation
        self._waiting[gone[possible]] = True
        self._waiting[kept[possible]] = True
        # In bands of cost, by chance within each: a pass then takes more edges, as fewer are
        # beaten by a neighbour.
        band = np.ceil(cost * (BANDS / self._deviation)) + self._random.random(len(cost))
        return np.where(possible, band, np.inf), place

    def _cost(self, gone: Ints, kept: Ints) -> tuple[Floats, Floats]:
        """How far the surface will have been moved, mm, and the new vertex."""
        a, b = self._vertices[gone], self._vertices[kept]
        planes = self._planes[gone] + self._planes[kept]
        middle, half = 0.5 * (a + b), 0.5 * (a - b)
        # Planes of the one end go through middle + half, those of the other through middle - half.
        right = np.einsum("kij,kj->ki", _matrices(self._planes[gone] - self._planes[kept]), half)
        matrix = _matrices(planes) + (SPRING * planes[:, 6])[:, None, None] * np.eye(3)
        place = middle + solved(matrix, right)
        moved = np.zeros(len(gone))
        for end, corner in ((gone, a), (kept, b)):
            rows, owner = rows_of(self._start, end)
            step = (place - corner)[owner]
            height = np.einsum("ij,ij->i", self._normal[self._around[rows]], step)
            first = np.searchsorted(owner, np.arange(len(end)))
            moved = np.maximum(moved, np.maximum.reduceat(np.abs(height), first))
        return np.maximum(self._spent[gone], self._spent[kept]) + moved, place

    def after(self, renumber: Ints) -> tuple[Floats, Bools]:
        """What has been spent at the vertices that stay after a pass, and which to look at."""
        stay = renumber >= 0
        gone = np.flatnonzero(~stay)
        kept = np.flatnonzero(stay)[~renumber[gone]]
        spent, fresh = self._spent.copy(), self._waiting.copy()
        if len(gone):
            spent[kept] = self._cost(gone, kept)[0]
        for end in (gone, kept):
            rows, _ = rows_of(self._start, end)
            fresh[self._triangles[self._around[rows]]] = True
        return spent[stay], fresh[stay]


def _matrices(planes: Floats) -> Floats:
    """(k, 3, 3) sums of n n^T of (k, 7) rows."""
    return planes[:, [0, 1, 2, 1, 3, 4, 2, 4, 5]].reshape(-1, 3, 3)


def _stays_good(before: Floats, after: Floats) -> Bools:
    """Whether triangles keep their side and do not become slivers."""
    old, new = remesh.normals(before), remesh.normals(after)
    areas = np.linalg.norm(old, axis=1) * np.linalg.norm(new, axis=1)
    turned = np.einsum("ij,ij->i", old, new) <= MIN_TURN_COSINE * areas
    quality = remesh.qualities(after)
    result: Bools = ~turned & ((quality > MIN_QUALITY) | (quality > remesh.qualities(before)))
    return result


def _nothing(one: Ints, two: Ints) -> Bools:
    return np.zeros(len(one), bool)

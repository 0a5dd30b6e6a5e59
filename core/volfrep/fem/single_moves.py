# SPDX-License-Identifier: LGPL-2.1-or-later
"""The few folds and needles that are left once a surface is mended, put right one by one.

Gmsh refuses a surface for one facet that lies on its neighbour, and leaves a flat tetrahedron on
each needle. Moves of many facets at once judge a change by planes and turns, which fails where
facets have neither. Here each facet's edges are flipped, or collapsed onto either end, and what
leaves the fewest faults is taken where the surface stays within a tolerance by exact distances, and
no facets of the piece cross that did not.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ..mesh import remesh
from ..mesh.triangle_mesh import TriangleMesh, compact
from ..mesh.well_shaped import angles_of, are_opposite
from ..spatial.proximity import closest_points
from ..spatial.self_intersection import crossing_triangles
from ..util.progress import Monitor
from ..util.types import Bools, Ints
from .folds import folded_facets

#: A surface with more faults than this is not all but mended.
MOST = 1000
#: Rounds over what is at fault: one move may spoil what lies beside it, or let a neighbour move.
ROUNDS = 4


def without_faults(
    mesh: TriangleMesh, tolerance: float, needle: float, monitor: Monitor
) -> TriangleMesh:
    """The closed mesh with fewer folds and needles, or itself where none can go.

    Args:
        mesh: closed, every edge of two facets; mm.
        tolerance: how far a move may take the surface, mm.
        needle: facets with an angle below this are needles, degrees; 0 for folds alone.
        monitor: for cancel.
    """
    triangles = mesh.triangles.astype(np.int64)
    surface = _Facets(triangles, len(mesh.vertices))
    # Points about which something is new: where nothing is, no move does what it did not before.
    fresh, changed = np.ones(len(mesh.vertices), bool), False
    for _ in range(ROUNDS):
        found = TriangleMesh(mesh.vertices, triangles.astype(np.int32))
        wrong = folded_facets(found) | _needles(found, triangles, needle)
        if wrong.sum() > MOST:
            break
        moved = []
        for corners in triangles[wrong & fresh[triangles].any(axis=1)].tolist():
            monitor.tick()
            moved += _do_best_move(mesh, surface, corners, tolerance, needle)
        if not moved:
            break
        fresh[:] = False
        fresh[moved] = changed = True
        triangles = surface.all
    return compact(TriangleMesh(mesh.vertices, triangles.astype(np.int32))) if changed else mesh


class _Facets:
    """Facets that are replaced here and there, and those about each of `count` points."""

    def __init__(self, triangles: Ints, count: int) -> None:
        self._rows = triangles.copy()
        own = np.repeat(np.arange(len(triangles)), 3)
        self._begin, self._facet = remesh.grouped(triangles.ravel(), own, count)
        #: Of points whose facets are others now.
        self._changed: dict[int, list[int]] = {}

    @property
    def all(self) -> Ints:
        """(m, 3) those that there are."""
        result: Ints = self._rows[self._rows[:, 0] >= 0]
        return result

    def about(self, points: list[int]) -> tuple[list[int], Ints]:
        """Rows of the facets that touch points, and their corners."""
        rows = sorted({row for point in points for row in self._at(point)})
        return rows, self._rows[rows]

    def replace(self, rows: list[int], facets: Ints) -> None:
        """Facets in place of at least as many others."""
        around = np.unique(self._rows[rows]).tolist()
        gone = set(rows)
        others = {point: [row for row in self._at(point) if row not in gone] for point in around}
        self._rows[rows] = -1
        self._rows[rows[: len(facets)]] = facets
        for row, corners in zip(rows, facets.tolist(), strict=False):
            for point in corners:
                others[point].append(row)
        self._changed.update(others)

    def _at(self, point: int) -> list[int]:
        if point in self._changed:
            return self._changed[point]
        rows: list[int] = self._facet[self._begin[point] : self._begin[point + 1]].tolist()
        return rows


def _needles(mesh: TriangleMesh, triangles: Ints, needle: float) -> Bools:
    result: Bools = angles_of(mesh.vertices[triangles]).min(axis=1) < needle
    return result


def _do_best_move(
    mesh: TriangleMesh, surface: _Facets, corners: list[int], tolerance: float, needle: float
) -> list[int]:
    """Do the best move about one of the facets: points about what changed; none where none is."""
    _, touching = surface.about(corners)
    if not (np.isin(touching, corners).sum(axis=1) == 3).any():
        return []  # an earlier move took it
    # Two rings: what a move changes, and what lies beside that.
    rows, part = surface.about(np.unique(touching).tolist())
    least, best = _faults(mesh, part, needle), None
    before, crossing = TriangleMesh(mesh.vertices, part.astype(np.int32)), None
    for moved in _moves(part, corners):
        faults = _faults(mesh, moved, needle)
        if faults < least and _is_near(before, moved, tolerance):
            after = TriangleMesh(mesh.vertices, moved.astype(np.int32))
            crossing = _crossing(before) if crossing is None else crossing
            if _crossing(after) <= crossing:
                least, best = faults, moved
    if best is None:
        return []
    surface.replace(rows, best)
    around: list[int] = np.unique(part).tolist()
    return around


def _moves(part: Ints, corners: list[int]) -> Iterator[Ints]:
    """The facets of a piece after each flip and each collapse of an edge of one of them."""
    for k in range(3):
        u, v = corners[k], corners[(k + 1) % 3]
        at_u, at_v = ((part == corner).any(axis=1) for corner in (u, v))
        pair, rest = part[at_u & at_v], part[~(at_u & at_v)]
        if len(pair) != 2:
            continue
        # The facet in which the edge runs from u to v comes first.
        if not any(pair[0, j] == u and pair[0, (j + 1) % 3] == v for j in range(3)):
            pair = pair[::-1]
        a, b = (int(row[(row != u) & (row != v)][0]) for row in pair)
        if not ((part == a).any(axis=1) & (part == b).any(axis=1)).any():
            yield np.concatenate([rest, [[a, b, v], [b, a, u]]])
        # No third facet may become one with another.
        if len(np.intersect1d(part[at_u], part[at_v])) == 4:
            for gone, kept in ((u, v), (v, u)):
                yield np.where(rest == gone, kept, rest)


def _faults(mesh: TriangleMesh, part: Ints, needle: float) -> tuple[int, int]:
    """How many edges of a piece are folded, and how many facets are needles."""
    pairs = remesh.edges(part, len(mesh.vertices)).triangles
    one, other = pairs[pairs[:, 1] >= 0].T
    corners = mesh.vertices[part]
    folds = int(are_opposite(corners[one], corners[other]).sum())
    return folds, int(_needles(mesh, part, needle).sum())


def _crossing(piece: TriangleMesh) -> int:
    """How many facets of a piece others of it run through, by however little."""
    return int(crossing_triangles(piece, np.ones(len(piece.triangles), bool), 0.0).sum())


def _is_near(before: TriangleMesh, moved: Ints, tolerance: float) -> bool:
    """Whether a piece and what it became are near each other, at corners and middles of edges."""
    after = TriangleMesh(before.vertices, moved.astype(np.int32))
    for one, other in ((before, after), (after, before)):
        corners = one.vertices[one.triangles]
        middles = 0.5 * (corners + np.roll(corners, 1, axis=1))
        places = np.concatenate([corners, middles], axis=1).reshape(-1, 3)
        if closest_points(other, places)[1].max() > tolerance:
            return False
    return True

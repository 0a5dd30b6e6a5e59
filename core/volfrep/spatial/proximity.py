# SPDX-License-Identifier: LGPL-2.1-or-later
"""Distances from points to a triangle mesh.

Two ways, both vectorised: `closest_points` descends a tree of boxes; it is exact and meant for
measuring. `SurfaceIndex.near` is many times faster for the millions of points of a distance field,
and its error has a bound: it looks up points sampled on the surface, of which every point of it has
one near. Places in the order of their Morton codes (G. M. Morton, 1966) mostly follow neighbours.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..mesh.closest import closest_on_triangles
from ..mesh.remesh import unit_normals
from ..mesh.triangle_mesh import TriangleMesh
from ..util.errors import VolfrepError
from ..util.linalg import cross_columns, dot_columns, less_columns, squares
from ..util.parallel import ParallelBackend, SharedArray
from ..util.ragged import spread
from ..util.threads import in_threads, threads
from ..util.types import Floats, Ints

#: Points, or pairs of a point and a triangle, that one vectorised step takes at a time.
POINTS_PER_STEP = 50_000
PAIRS_PER_STEP = 2_000_000
#: So many points are asked at a time for the farthest, beginning with those that may be.
FARTHEST_PER_STEP = 2000
#: So many points are told by one cube at first whether they are near at all, were they spread
#: evenly. Of a lattice most cubes hold none, and the others about a dozen times as many.
POINTS_PER_CUBE = 4
#: Points that one thread looks for at a time.
POINTS_PER_WALK = 4096
#: How often the walk from a nearest sample to the nearest triangle may cross an edge.
MAX_EDGE_CROSSINGS = 8
#: No more triangles are walked through round a corner.
MOST_ROUND_A_CORNER = 1000
#: A surface is not sampled with more points than this (100 bytes each, with the search tree).
MAX_SAMPLES = 30_000_000
#: Steps along the longest side of a box in which points are told apart.
MORTON_STEPS = 1023
#: Bits of a point's row, beside the 30 of its place among these steps.
ROW_BITS = 33
#: Sine of the angle between two faces from which their reentrant edge has samples of its own.
SHARP_BEND = 0.1
#: Triangles that one thread samples at a time.
TRIANGLES_PER_STEP = 2000


def closest_points(mesh: TriangleMesh, points: Floats) -> tuple[Floats, Floats, Ints]:
    """The exact closest point of the mesh to every point.

    Descends a binary tree of boxes over the triangles, all points at once, and drops the boxes
    that lie farther off than a triangle already known.

    Args:
        mesh: any triangle mesh, closed or not, with at least one triangle.
        points: (n, 3) float64, mm.

    Returns:
        (n, 3) closest points, (n,) distances in mm (not signed), (n,) their triangles.

    Raises:
        VolfrepError: the mesh is empty.

    >>> corners = np.array([[0, 0, 0], [4, 0, 0], [0, 4, 0]], float)
    >>> facet = TriangleMesh(corners, np.array([[0, 1, 2]], np.int32))
    >>> place, distance, _ = closest_points(facet, np.array([[1.0, 1.0, 3.0], [4.0, 4.0, 0.0]]))
    >>> place.tolist(), distance.round(6).tolist()
    ([[1.0, 1.0, 0.0], [2.0, 2.0, 0.0]], [3.0, 2.828427])
    """
    return NearestTriangles(mesh).closest(points)


def are_nearer(mesh: TriangleMesh, points: Floats, reach: Floats) -> NDArray[np.bool_]:
    """(n,) bool, which points are nearer to the mesh than their reach.

    As `closest_points` tells, without looking for the place: of points far off, as the most of a
    lattice, few boxes are asked.

    Args:
        mesh: as there.
        points: (n, 3) float64, mm.
        reach: (n,) mm.

    Raises:
        VolfrepError: the mesh is empty.

    >>> corners = np.array([[0, 0, 0], [4, 0, 0], [0, 4, 0]], float)
    >>> facet = TriangleMesh(corners, np.array([[0, 1, 2]], np.int32))
    >>> are_nearer(facet, np.array([[1.0, 1.0, 3.0], [4.0, 4.0, 0.0]]), np.full(2, 2.9)).tolist()
    [False, True]
    """
    return NearestTriangles(mesh).are_nearer(points, reach)


class NearestTriangles:
    """A mesh prepared for `closest_points` of many sets of points.

    Args:
        mesh: as there.
        spacing: of points sampled on it, mm, where many of those asked for lie on it or next to
            it: what is nearer than a sample is soon found then. None: it is not sampled.

    Raises:
        VolfrepError: the mesh is empty.
    """

    def __init__(self, mesh: TriangleMesh, spacing: float | None = None) -> None:
        if not len(mesh.triangles):
            raise VolfrepError("The distance to an empty mesh is not defined: give it triangles.")
        from scipy.spatial import cKDTree  # slow to load

        self._corners = np.stack(mesh.corners(), axis=1)
        self._boxes, self._order = _box_tree(self._corners)
        self._seeds = cKDTree(self._corners.mean(axis=1))
        self._samples = None
        if spacing is not None:
            samples, self._owner = sample_triangles(self._corners, spacing)
            self._samples = cKDTree(samples)

    def closest(self, points: Floats) -> tuple[Floats, Floats, Ints]:
        """As `closest_points` of the mesh."""
        points = np.ascontiguousarray(points, np.float64).reshape(-1, 3)
        closest = np.empty_like(points)
        triangle = np.empty(len(points), np.int64)
        pending = [
            np.arange(start, min(start + POINTS_PER_STEP, len(points)))
            for start in range(0, len(points), POINTS_PER_STEP)
        ]
        while pending:
            part = pending.pop()
            here = points[part]
            seed = self._seeds.query(here, workers=threads())[1]
            found = _descend(self._corners, self._boxes, self._order, here, seed, self._reach(here))
            if found is None:  # too many triangles are equally near for one step
                pending.extend(np.array_split(part, 2))
            else:
                closest[part], triangle[part] = found
        return closest, np.linalg.norm(points - closest, axis=1), triangle

    def farthest(self, points: Floats, least: float = 0.0) -> float:
        """The exact distance of the farthest of the points, mm, or `least` if that is more.

        Nearly all points are nearer than that to the facet of a sample: these are not looked into.

        Args:
            points: (n, 3) float64, mm.
            least: mm.

        Raises:
            VolfrepError: the mesh is not sampled.
        """
        reach = self._reach(points)
        if reach is None:
            raise VolfrepError("The farthest point is found by samples: give their spacing.")
        far = np.sqrt(reach)
        order = np.argsort(-far, kind="stable")
        for start in range(0, len(points), FARTHEST_PER_STEP):
            part = order[start : start + FARTHEST_PER_STEP]
            if far[part[0]] <= least:
                break
            least = max(least, float(self.closest(points[part])[1].max()))
        return least

    def are_nearer(self, points: Floats, reach: Floats) -> NDArray[np.bool_]:
        """As the function of this name of the mesh."""
        result = np.zeros(len(points), bool)
        some = self._in_near_cubes(points, float(reach.max(initial=0.0)))
        pending = [
            some[start : start + POINTS_PER_STEP] for start in range(0, len(some), POINTS_PER_STEP)
        ]
        while pending:
            part = pending.pop()
            found = self._find_nearer(points[part], reach[part])
            if found is None:  # too many triangles are near for one step
                pending.extend(np.array_split(part, 2))
            else:
                result[part] = found
        return result

    def _in_near_cubes(self, points: Floats, reach: float) -> Ints:
        """Rows of points in cubes, of several points each, that may be nearer than the reach."""
        if len(points) < POINTS_PER_STEP:
            return np.arange(len(points))
        cubes = PointCubes(points)
        within = (reach + cubes.half_diagonal) ** 2
        near = np.zeros(len(cubes.middles), bool)
        for start in range(0, len(near), POINTS_PER_STEP):
            middles = cubes.middles[start : start + POINTS_PER_STEP]
            found = _near_boxes(self._boxes, middles, np.full(len(middles), within))
            # Where they are near too many boxes to be told here, they are near some.
            near[start + (np.arange(len(middles)) if found is None else found[0])] = True
        return cubes.points_in(near)

    def _find_nearer(self, points: Floats, reach: Floats) -> NDArray[np.bool_] | None:
        """As `are_nearer`; None where that would take too much memory at once."""
        far = float(reach.max(initial=0.0))
        seed = self._seeds.query(points, distance_upper_bound=far, workers=threads())[1]
        result = np.zeros(len(points), bool)
        some = np.flatnonzero(seed < len(self._corners))
        result[some] = self._meet(seed[some], points[some], reach[some])
        asking = np.flatnonzero(~result)
        near = _near_boxes(self._boxes, points[asking], reach[asking] ** 2)
        if near is None:
            return None
        point, triangle = asking[near[0]], self._order[near[1]]
        result[point[self._meet(triangle, points[point], reach[point])]] = True
        return result

    def _meet(self, triangle: Ints, points: Floats, reach: Floats) -> NDArray[np.bool_]:
        """Whether triangle k is nearer to point k than its reach."""
        place = closest_on_triangles(self._corners[triangle], points)[0]
        return np.asarray(np.linalg.norm(points - place, axis=1) < reach)

    def _reach(self, points: Floats) -> Floats | None:
        """(n,) squares of distances, mm^2, within which the nearest triangle is, from samples."""
        if self._samples is None:
            return None
        near = self._owner[self._samples.query(points, workers=threads())[1]]
        closest = closest_on_triangles(self._corners[near], points)[0]
        # Boxes are as far as their triangles but for rounding.
        slack = (1e-12 * np.abs(self._corners).max()) ** 2
        return np.asarray(squares(points - closest) * (1.0 + 1e-9) + slack)


class PointCubes:
    """Points told apart by equal cubes, of several points each, so that many are asked at once.

    Args:
        points: (n, 3) float64, mm, at least one.

    Attributes:
        middles: (c, 3) of the cubes that hold any, mm.
        half_diagonal: no point of a cube is farther from its middle, mm.
    """

    def __init__(self, points: Floats) -> None:
        low = points.min(axis=0)
        span = points.max(axis=0) - low
        size = max(float(span.max()), 1e-300) / max(len(points) / POINTS_PER_CUBE, 1) ** (1 / 3)
        shape = tuple((span / size).astype(np.int64) + 1)
        columns = (((points[:, k] - low[k]) / size).astype(np.int64) for k in range(3))
        self._cube = np.ravel_multi_index(tuple(columns), shape)
        self._held = np.flatnonzero(np.bincount(self._cube))
        self._count = int(np.prod(shape))
        self.middles = low + size * (np.stack(np.unravel_index(self._held, shape), axis=1) + 0.5)
        self.half_diagonal = 0.5 * 1.001 * float(np.sqrt(3.0)) * size

    def points_in(self, chosen: NDArray[np.bool_]) -> Ints:
        """Rows of the points in some of the cubes, (c,) bool."""
        marked = np.zeros(self._count, bool)
        marked[self._held[chosen]] = True
        return np.flatnonzero(marked[self._cube])


def _box_tree(corners: Floats) -> tuple[list[Floats], Ints]:
    """Boxes (k, 2, 3) of a binary tree, root first, and the triangle of each leaf (-1: none).

    The leaves follow the Morton codes (G. M. Morton, 1966) of the triangles' middles.
    """
    low, high = corners.min(axis=1), corners.max(axis=1)
    centre = (low + high) / 2
    span = np.maximum(np.ptp(centre, axis=0), 1e-300)
    grid = ((centre - centre.min(axis=0)) / span * 1023).astype(np.int64)
    code = interleaved(grid[:, ::-1])
    leaves = 1 << max(int(len(code) - 1).bit_length(), 0)
    order = np.full(leaves, -1, np.int64)
    order[: len(code)] = np.argsort(code, kind="stable")
    level = np.empty((leaves, 2, 3))
    level[:, 0], level[:, 1] = np.inf, -np.inf
    level[: len(code), 0], level[: len(code), 1] = low[order[: len(code)]], high[order[: len(code)]]
    boxes = [level]
    while len(level) > 1:
        pairs = level.reshape(-1, 2, 2, 3)
        level = np.stack([pairs[:, :, 0].min(axis=1), pairs[:, :, 1].max(axis=1)], axis=1)
        boxes.append(level)
    return boxes[::-1], order


def _descend(
    corners: Floats,
    boxes: list[Floats],
    order: Ints,
    points: Floats,
    seed: Ints,
    reach: Floats | None,
) -> tuple[Floats, Ints] | None:
    """Closest points and triangles; None where that would take too much memory at once."""
    best = closest_on_triangles(corners[seed], points)[0]
    squared = squares(points - best)
    found = _near_boxes(boxes, points, squared if reach is None else np.minimum(squared, reach))
    if found is None:
        return None
    point, triangle = found[0], order[found[1]]
    candidate = closest_on_triangles(corners[triangle], points[point])[0]
    distance = squares(points[point] - candidate)
    by_distance = np.lexsort((distance, point))
    winner, first = np.unique(point[by_distance], return_index=True)
    rows = by_distance[first]
    better = distance[rows] < squared[winner]
    winner, rows = winner[better], rows[better]
    seed = seed.copy()
    best[winner], seed[winner] = candidate[rows], triangle[rows]
    return best, seed


def _near_boxes(boxes: list[Floats], points: Floats, within: Floats) -> tuple[Ints, Ints] | None:
    """Points, and the leaves of a tree of boxes that are nearer to them than (n,) squares, mm^2.

    None where that would take too much memory at once.
    """
    point, node = np.arange(len(points)), np.zeros(len(points), np.int64)
    for level in boxes[1:]:
        point, node = np.repeat(point, 2), np.repeat(2 * node, 2)
        node[1::2] += 1
        if len(point) > PAIRS_PER_STEP and len(points) > 1:
            return None
        box, p = level[node], points[point]
        gap = np.maximum(np.maximum(box[:, 0] - p, p - box[:, 1]), 0.0)
        keep = squares(gap) < within[point]
        point, node = point[keep], node[keep]
    return point, node


def _dot(a: Floats, b: Floats) -> Floats:
    product: Floats = np.einsum("ij,ij->i", a, b)
    return product


@dataclass(frozen=True, eq=False)
class SurfaceIndex:
    """A surface prepared for many fast distance queries.

    Attributes:
        corners: (m, 3, 3) triangle corners.
        across: (m, 3) the triangle on the other side of each edge.
        tree: search tree over points sampled on the surface.
        triangle_of_sample: (k,) the triangle each sample lies on.
        spacing: every point of the surface has a sample within 0.75 of this, mm.
    """

    corners: Floats
    across: Ints
    tree: Any
    triangle_of_sample: NDArray[np.int32]
    spacing: float

    def without(self, gone: NDArray[np.bool_]) -> SurfaceIndex:
        """The index of the surface less some triangles, (m,) bool: it is open then."""
        triangle, edge = np.nonzero(gone[self.across] & ~gone[:, None])
        across = self.across.copy()
        across[triangle, edge] = triangle  # the walk ends at the border
        # The border may be nearest to points that the samples on the faces recede from.
        start, end = self.corners[triangle, edge], self.corners[triangle, (edge + 1) % 3]
        length = np.linalg.norm(end - start, axis=1)
        pieces = np.maximum(np.ceil(length / self.spacing), 1).astype(np.int64)
        owner, place = spread(pieces + 1)
        border = start[owner] + (place / pieces[owner])[:, None] * (end - start)[owner]
        stay = ~gone[self.triangle_of_sample]
        samples = np.concatenate([self.tree.data[stay], border])
        owners = np.concatenate([self.triangle_of_sample[stay], triangle[owner].astype(np.int32)])
        return SurfaceIndex(self.corners, across, _tree(samples), owners, self.spacing)

    def near(self, points: Floats) -> tuple[Floats, Floats]:
        """The closest surface points, and their distances, by sample and edge walk.

        From the nearest sample's triangle the walk crosses edges while the distance falls. The
        result is a point of the surface, so that its distance d is never too small. For a point
        inside the solid it is too large by at most ``(0.75 spacing)**2 / (2 d) + spacing / 10``,
        and nearly always exact; outside, by at most the spacing.
        """
        closest, distance, _, _ = self._nearest(points)
        return closest, distance

    def distances_within(self, points: Floats, reach: float) -> Floats:
        """(n,) distances as of `near`, mm; infinite where no sample is within reach.

        What lies no farther than the reach less 0.75 of the spacing is never left out.
        """
        return self._nearest(points, reach)[1]

    def below(self, points: Floats) -> NDArray[np.bool_]:
        """(n,) whether points lie below the surface, as its normal next to them tells.

        At an edge that is the sum of both faces' normals, at a corner that of all its faces,
        weighted by their angles (Baerentzen and Aanaes 2005, "Signed distance computation using
        the angle weighted pseudonormal").
        """
        closest, _, triangle, edge = self._nearest(points)
        normal = self._normals(triangle)
        rows = np.flatnonzero(edge >= 0)
        normal[rows] += self._normals(self.across[triangle[rows], edge[rows]])
        for end in (0, 1):
            corner = (edge[rows] + end) % 3
            place = self.corners[triangle[rows], corner]
            at = (np.abs(place - closest[rows]) <= 1e-9 * self.spacing).all(axis=1)
            normal[rows[at]] = self._corner_normals(triangle[rows[at]], corner[at])
        return np.asarray(_dot(points - closest, normal) < 0.0)

    def _normals(self, triangle: Ints) -> Floats:
        return unit_normals(self.corners[triangle])

    def _corner_normals(self, triangle: Ints, corner: Ints) -> Floats:
        """The normals of all triangles round a corner, by walking from one to the next."""
        total = np.zeros((len(triangle), 3))
        place = self.corners[triangle, corner]
        rows, here, first = np.arange(len(triangle)), corner, triangle
        for _ in range(MOST_ROUND_A_CORNER):
            if not len(rows):
                break
            own = self.corners[triangle]
            each = np.arange(len(rows))
            one = own[each, (here + 1) % 3] - place[rows]
            other = own[each, (here + 2) % 3] - place[rows]
            angle = np.arctan2(np.linalg.norm(np.cross(one, other), axis=1), _dot(one, other))
            total[rows] += angle[:, None] * self._normals(triangle)
            triangle = self.across[triangle, (here + 2) % 3]
            here = (self.corners[triangle] == place[rows][:, None]).all(axis=2).argmax(axis=1)
            on = triangle != first[rows]
            rows, triangle, here = rows[on], triangle[on], here[on]
        return total

    def _nearest(self, points: Floats, reach: float = np.inf) -> tuple[Floats, Floats, Ints, Ints]:
        """Closest points, distances, their triangles, and the edges they lie on (-1: none).

        Where no sample is within reach distances are infinite, and the rest means nothing.
        """
        closest, distance = np.empty((len(points), 3)), np.empty(len(points))
        triangle, on_edge = np.empty((2, len(points)), np.int64)
        if not len(points):
            return closest, distance, triangle, on_edge
        # Points that ask the same branches of the tree find them in the processor's cache.
        order = neighbours_together(points)

        def part(start: int) -> None:
            rows = order[start : start + POINTS_PER_WALK]
            sampled, nearest = self.tree.query(points[rows], distance_upper_bound=reach)
            if reach < np.inf:
                met = np.isfinite(sampled)
                distance[rows[~met]] = np.inf
                rows, nearest = rows[met], nearest[met]
            walked = self._walk(points[rows], nearest)
            closest[rows], distance[rows], triangle[rows], on_edge[rows] = walked

        for _ in in_threads(part, range(0, len(points), POINTS_PER_WALK)):
            pass
        return closest, distance, triangle, on_edge

    def _walk(self, points: Floats, nearest: Ints) -> tuple[Floats, Floats, Ints, Ints]:
        """As `_nearest` from each point's nearest sample, on one thread."""
        triangle = self.triangle_of_sample[nearest].astype(np.int64)
        closest, on_edge = closest_on_triangles(self.corners[triangle], points)
        squared = squares(points - closest)
        rows = np.flatnonzero(on_edge >= 0)
        for _ in range(MAX_EDGE_CROSSINGS):
            if not len(rows):
                break
            other = self.across[triangle[rows], on_edge[rows]]
            candidate, candidate_edge = closest_on_triangles(self.corners[other], points[rows])
            distance = squares(points[rows] - candidate)
            better = distance < squared[rows]
            rows = rows[better]
            triangle[rows], on_edge[rows] = other[better], candidate_edge[better]
            closest[rows], squared[rows] = candidate[better], distance[better]
            rows = rows[on_edge[rows] >= 0]
        return closest, np.sqrt(squared), triangle, on_edge


#: Those that this process has made and shares.
_opened: dict[SharedIndex, SurfaceIndex] = {}


@dataclass(frozen=True)
class SharedIndex:
    """A `SurfaceIndex` for other processes, which make its tree anew; attributes as of that."""

    corners: SharedArray
    across: SharedArray
    samples: SharedArray
    triangle_of_sample: SharedArray
    spacing: float


@contextmanager
def sharing_index(index: SurfaceIndex, backend: ParallelBackend) -> Iterator[SharedIndex | None]:
    """An index for the calls of a backend (`near_shared`); None where these are on threads."""
    if not backend.uses_processes:
        yield None
        return
    arrays = index.corners, index.across, index.tree.data, index.triangle_of_sample
    with backend.sharing(*arrays) as (corners, across, samples, triangles):
        shared = SharedIndex(corners, across, samples, triangles, index.spacing)
        _opened[shared] = index  # for calls that this process makes itself
        backend.begun(_open_ahead, shared)
        try:
            yield shared
        finally:
            del _opened[shared]


def near_shared(shared: SharedIndex, points: Floats) -> tuple[Floats, Floats]:
    """As `SurfaceIndex.near`."""
    return _index_of(shared).near(points)


def _index_of(shared: SharedIndex) -> SurfaceIndex:
    return _opened.get(shared) or _open_index(shared)


def _open_ahead(shared: SharedIndex) -> None:
    """Make the index, before points are asked for."""
    _index_of(shared)


@lru_cache(maxsize=1)
def _open_index(shared: SharedIndex) -> SurfaceIndex:
    # Copies, so that the files are closed.
    arrays = shared.corners, shared.across, shared.samples, shared.triangle_of_sample
    corners, across, samples, triangles = (np.array(each.array) for each in arrays)
    return SurfaceIndex(corners, across, _tree(samples), triangles, shared.spacing)


def _tree(samples: Floats) -> Any:
    from scipy.spatial import cKDTree  # slow to load

    return cKDTree(samples, balanced_tree=False, compact_nodes=False, leafsize=32)


def index_surface(
    mesh: TriangleMesh, spacing: float, sampled: tuple[Floats, Ints] | None = None
) -> SurfaceIndex:
    """Prepare a closed manifold mesh for `SurfaceIndex.near`.

    Args:
        mesh: the surface.
        spacing: of the samples, mm.
        sampled: points of the surface and their triangles, where it is sampled already: fewer of
            them where no other part of the surface is near.

    Raises:
        VolfrepError: at this spacing the surface would take more than `MAX_SAMPLES` samples.
    """
    expected = mesh.area / spacing**2 if sampled is None else len(sampled[0])
    if expected > MAX_SAMPLES:
        raise VolfrepError(
            f"Sampling the part's surface every {spacing:.3g} mm would take {expected:.2g} "
            "points: ask for a thicker shell."
        )
    across, corners = neighbours(mesh), np.stack(mesh.corners(), axis=1)
    samples, owner = sample_triangles(corners, spacing) if sampled is None else sampled
    on_edges = sample_reentrant_edges(corners, unit_normals(corners), across, spacing)
    samples = np.concatenate([samples, on_edges[0]])
    triangle = np.concatenate([owner, on_edges[1]]).astype(np.int32)
    return SurfaceIndex(corners, across, _tree(samples), triangle, spacing)


def neighbours(mesh: TriangleMesh) -> Ints:
    """(m, 3) the triangle across each edge of a closed, consistently oriented manifold mesh."""
    t = mesh.triangles.astype(np.int64)
    start, end = t.ravel(), np.roll(t, -1, axis=1).ravel()
    count = len(mesh.vertices)
    forward = np.argsort(start * count + end)
    backward = np.argsort(end * count + start)
    across = np.empty(len(start), np.int64)
    across[forward] = backward // 3
    return across.reshape(-1, 3)


def interleaved(nodes: Ints) -> Ints:
    """(n,) Morton codes of (n, 3) whole numbers below 2^21: the bits of x, y, z in turn."""
    result = np.zeros(len(nodes), np.int64)
    for axis in range(3):
        bits = nodes[:, axis].copy()
        for shift, mask in (
            (32, 0x1F00000000FFFF),
            (16, 0x1F0000FF0000FF),
            (8, 0x100F00F00F00F00F),
            (4, 0x10C30C30C30C30C3),
            (2, 0x1249249249249249),
        ):
            bits = (bits | (bits << shift)) & mask
        result |= bits << (2 - axis)
    return result


def neighbours_together(points: Floats) -> Ints:
    """(n,) an order of (n, 3) points in which what asks the same places comes together."""
    # A column for every coordinate: numpy takes rows of three slowly.
    columns = np.ascontiguousarray(points.T)
    low = columns.min(axis=1)[:, None]
    size = max(float((columns.max(axis=1)[:, None] - low).max()), 1e-300) / MORTON_STEPS
    code = interleaved(((columns - low) / size).astype(np.int64).T)
    # Numbers alone are sorted sooner: each is followed by its row.
    code <<= ROW_BITS
    code |= np.arange(len(code))
    code.sort()
    return np.asarray(code & ((1 << ROW_BITS) - 1))


def sample_triangles(corners: Floats, spacing: float) -> tuple[Floats, Ints]:
    """Points in rows parallel to each triangle's longest edge, and the triangles they lie on.

    Every point of a triangle (k, 3, 3) has one of them within 0.75 of the spacing.
    """
    starts = range(0, max(len(corners), 1), TRIANGLES_PER_STEP)

    def part(start: int) -> tuple[Floats, Ints]:
        points, owner = _sample(corners[start : start + TRIANGLES_PER_STEP], spacing)
        return points, owner + start

    points, owners = zip(*in_threads(part, starts), strict=True)
    return np.concatenate(points), np.concatenate(owners)


def _sample(corners: Floats, spacing: float) -> tuple[Floats, Ints]:
    """As `sample_triangles`, on one thread."""
    # A column for every coordinate: numpy takes rows of three slowly.
    length = edge_lengths(corners)
    turn = (length.argmax(axis=0)[:, None] + np.arange(3)) % 3
    corners = corners[np.arange(len(corners))[:, None], turn]
    columns = np.ascontiguousarray(corners.reshape(-1, 9).T)
    start, side, other = columns[:3], columns[3:6] - columns[:3], columns[6:] - columns[:3]
    base, normal = length.max(axis=0), cross_columns(side, other)
    height = np.sqrt(dot_columns(normal, normal)) / np.maximum(base, 1e-300)
    # Both angles at the longest edge are acute: below every point of the triangle, towards that
    # edge, is a point of the next row. The steps make the farthest point 0.75 spacings away.
    rows = np.maximum(np.ceil(height / (0.53 * spacing)), 1).astype(np.int64)
    most = np.maximum(np.ceil(base / (1.06 * spacing)), 1)
    owner, row = spread(rows)
    up = row / rows[owner]
    across = np.maximum(np.ceil(most[owner] * (1.0 - up)), 1).astype(np.int64)
    line, place = spread(across)
    along = (place + 0.5) / across[line] * (1.0 - up)[line]
    up, owner = up[line], owner[line]
    points = np.empty((len(owner), 3))
    for k in range(3):
        points[:, k] = start[k][owner] + along * side[k][owner] + up * other[k][owner]
    return points, owner


def edge_lengths(corners: Floats) -> Floats:
    """(3, n) the lengths of the edges of triangles (n, 3, 3), from each corner to the next."""
    columns = np.ascontiguousarray(corners.reshape(-1, 9).T)
    at = columns[:3], columns[3:6], columns[6:]
    sides = [less_columns(at[(k + 1) % 3], at[k]) for k in range(3)]
    return np.sqrt(np.stack([dot_columns(side, side) for side in sides]))


def sample_reentrant_edges(
    corners: Floats, normal: Floats, across: Ints, spacing: float
) -> tuple[Floats, Ints]:
    """Points along the edges that point into the solid.

    They are the nearest to many points inside, and the samples on the faces recede from them.

    Args:
        corners: (m, 3, 3) of triangles.
        normal: (m, 3) their unit normals, outward.
        across: (m, 3) the triangle on the other side of each edge.
        spacing: mm.

    Returns:
        (k, 3) points and (k,) a triangle of each.
    """
    triangle, edge = np.nonzero(across > np.arange(len(across))[:, None])
    other = across[triangle, edge]
    start, end = corners[triangle, edge], corners[triangle, (edge + 1) % 3]
    # With both normals outward, the solid is reentrant where the neighbour rises above the face.
    along = end - start
    length = np.linalg.norm(along, axis=1)
    bend = np.einsum("ij,ij->i", np.cross(normal[triangle], normal[other]), along) / np.maximum(
        length, 1e-300
    )
    sharp = bend < -SHARP_BEND
    triangle, start, along, length = triangle[sharp], start[sharp], along[sharp], length[sharp]
    pieces = np.maximum(np.ceil(length / spacing), 1).astype(np.int64)
    owner, place = spread(pieces + 1)
    return start[owner] + (place / pieces[owner])[:, None] * along[owner], triangle[owner]

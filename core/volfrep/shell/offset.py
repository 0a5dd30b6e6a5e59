# SPDX-License-Identifier: LGPL-2.1-or-later
"""Offset surface: the inner wall of a shelled solid, at a given depth below the outer one.

It is the level set of the distance to the outer surface, so it cannot cross itself the way a
surface of moved faces does. `sampled_depth` samples the depth at the corners of cubes, `octree`
tells the patches of surface in them, `dual_contouring` makes facets of these, `adaptive_contour`
halves the cubes whose facets stray, `decimation` takes the facets away that are not needed. Where
a part has few plane faces and cubes would take longer these are moved instead (`moved_faces`).

OpenCASCADE's exact offset fails on real parts and is not used.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..design.skins.plane_faces import few_plane_faces
from ..mesh.topology import pieces_of
from ..mesh.triangle_mesh import TriangleMesh, compact, empty_mesh, random_points
from ..spatial.proximity import (
    NearestTriangles,
    closest_points,
    index_surface,
    sharing_index,
)
from ..spatial.rays import points_within
from ..util.errors import VolfrepError
from ..util.manifold import has_manifold
from ..util.parallel import ParallelBackend
from ..util.progress import Monitor
from ..util.types import Bools, Floats
from .adaptive_contour import find_offset_surface
from .crossing_plugs import find_new_crossings, without_crossings
from .decimation import simplify
from .depth import Depth, open_depth
from .moved_faces import move_faces, with_short_edges
from .sampled_depth import DepthField, cube_grid
from .smooth_regions import SmoothRegions, find_smooth_regions

#: Edge of the coarsest cubes in units of the thickness; and the least number of them along the
#: part's diagonal.
CUBE = 0.8
CUBES_ALONG_DIAGONAL = 50
#: A wall is good when its thickness is within this at so many random points of it.
TOLERANCE = 0.05
MEASURED_POINTS = 20_000
#: Of which so many are measured exactly at a time: facets that are needles are near many.
POINTS_AT_ONCE = 2000
#: Facets of moved faces are divided until about so many edges would lie along the part's diagonal:
#: an octant is cut by all facets that come near it, and needles come near many.
EDGES_ALONG_DIAGONAL = 40
#: Spacing of the samples on the outer surface in units of the thickness.
SAMPLE_SPACING = 0.3
#: Cubes with all that is kept of them need about this much memory, in bytes a coarsest cube that
#: the wall crosses.
BYTES_PER_CROSSED_CUBE = 3000
MEMORY_LIMIT = 6e9
#: Points by which the depth of a part is told in a refusal (a power of 2).
DEPTH_POINTS = 12
#: One worker looks where a wall of no more facets crosses itself; else threads do.
SMALL_WALL = 50_000
#: Pockets smaller than a cube of this edge, in units of the coarsest cubes, are left solid.
SMALLEST_POCKET = 0.75


@dataclass(frozen=True, eq=False)
class Cavity:
    """The closed surface at a depth below the surface of a solid, and how near it came.

    Attributes:
        mesh: oriented outward; empty where no part of the solid is thicker than two walls.
        worst: largest relative error of the wall's thickness at random points of it.
        place: (3,) where that is, mm.
    """

    mesh: TriangleMesh
    worst: float
    place: Floats


def find_cavity(
    solid: TriangleMesh,
    thickness: float,
    monitor: Monitor,
    is_open: Bools | None = None,
    uneven: Callable[[float], Depth] | None = None,
) -> Cavity:
    """The closed surface at depth `thickness` below the surface of a solid.

    Args:
        solid: checked closed solid (`volfrep.io.solid.check_solid`), mm.
        thickness: wall thickness, above 0, mm.
        monitor: for progress and cancel.
        is_open: (m,) triangles of the solid that have no skin below them; None for none.
        uneven: of a wall that is not equally thick everywhere, and has `thickness` where it is
            thinnest: makes its depth with samples of a spacing in mm.

    Returns:
        The boundary of the points of the solid that lie deeper than the thickness, strictly
        inside it; but beyond open triangles, which do not count for the depth, it reaches out of
        the solid (`OpenDepth`). The wall is within `TOLERANCE` of its thickness, as
        long as that does not take too many cubes (`adaptive_contour.MOST_EDGES`). Where the room
        between two walls gets narrower than a tenth of the thickness the cavity may end; where
        facets cross there, they go with a little of the room about them (`crossing_plugs`).

    Raises:
        VolfrepError: the wall is so thin that its cubes would not fit into memory.
    """
    low, high = solid.bounds
    if is_open is None and np.min(high - low) <= 2.0 * thickness:
        return Cavity(empty_mesh(), 0.0, np.zeros(3))
    diagonal = float(np.linalg.norm(high - low))
    depth: Depth
    cube = min(CUBE * thickness, diagonal / CUBES_ALONG_DIAGONAL)
    monitor.tick(0.0)
    if uneven is None and is_open is None and has_manifold():
        moved = _move_few_faces(solid, thickness, (SMALLEST_POCKET * cube) ** 3, monitor)
        if moved is not None and moved.worst <= TOLERANCE:
            return moved
    spacing = SAMPLE_SPACING * thickness
    if uneven is not None:
        _refuse_too_thin(solid, thickness, solid.area / cube**2, cube)
        depth = uneven(spacing)
    elif is_open is None:
        grid = cube_grid(low, high, thickness, cube)
        most = MEMORY_LIMIT / BYTES_PER_CROSSED_CUBE / 2.0
        plain = find_smooth_regions(
            solid, grid[0], cube, grid[2], thickness, spacing, most, monitor
        )
        _refuse_too_thin(solid, thickness, plain.cubes, cube)
        sampled = (plain.samples, plain.owner)
        index = monitor.call(lambda: index_surface(solid, spacing, sampled))
        with sharing_index(index, monitor.backend) as shared:
            depth = Depth(index, thickness, monitor, shared=shared)
            return _find_cavity(solid, depth, cube, plain)
    else:
        _refuse_too_thin(solid, thickness, solid.area / cube**2, cube)
        depth = open_depth(solid, is_open, thickness, spacing, monitor)
    return _find_cavity(solid, depth, cube, None)


def _move_few_faces(
    solid: TriangleMesh, thickness: float, smallest: float, monitor: Monitor
) -> Cavity | None:
    """The wall by moving faces, without rooms of less than a volume in mm3; None of many faces."""
    faces = monitor.call(lambda: few_plane_faces(solid, thickness))
    if faces is None:
        return None
    mesh = without_small(move_faces(faces, thickness, monitor), smallest)
    if not len(mesh.triangles):
        return Cavity(mesh, 0.0, np.zeros(3))
    # At a gap between two bodies the wall would come near the surface: vertices tell it.
    points = np.concatenate([random_points(mesh, MEASURED_POINTS), mesh.vertices])
    nearest, depths = NearestTriangles(solid), []
    for start in range(0, len(points), POINTS_AT_ONCE):
        monitor.tick()
        depths.append(nearest.closest(points[start : start + POINTS_AT_ONCE])[1])
    error = np.abs(np.concatenate(depths) / thickness - 1.0)
    longest = float(np.linalg.norm(np.ptp(solid.bounds, axis=0))) / EDGES_ALONG_DIAGONAL
    mesh = monitor.call(lambda: with_short_edges(mesh, longest))
    return Cavity(mesh, float(error.max()), points[np.argmax(error)])


def _find_cavity(
    solid: TriangleMesh, depth: Depth, cube: float, plain: SmoothRegions | None
) -> Cavity:
    """The wall of a depth, by cubes of an edge in mm."""
    monitor = depth.monitor
    field = DepthField(solid, depth, cube, plain)
    monitor.tick(0.1)
    surface = find_offset_surface(field)
    monitor.tick(0.8)
    simple = simplify(surface, field)
    monitor.tick(0.95)
    # Mostly nothing crosses, so that it is measured while a worker looks.
    backend = monitor.backend if len(simple.triangles) <= SMALL_WALL else ParallelBackend()
    looked = backend.begun(find_new_crossings, simple)
    smallest = (SMALLEST_POCKET * cube) ** 3
    measured = _measure_error(without_small(simple, smallest), depth)
    mesh = without_crossings(simple, depth.thickness, monitor, monitor.call(looked))
    if mesh is simple:
        return measured
    return _measure_error(without_small(mesh, smallest), depth)


def _refuse_too_thin(solid: TriangleMesh, thickness: float, cubes: float, cube: float) -> None:
    """Refuse a wall whose cubes do not fit into memory."""
    if 2.0 * cubes * BYTES_PER_CROSSED_CUBE <= MEMORY_LIMIT:
        return
    # With cubes of one size everywhere this one would fit.
    everywhere = 2.0 * solid.area / cube**2 * BYTES_PER_CROSSED_CUBE
    least = thickness * (everywhere / MEMORY_LIMIT) ** 0.5
    diagonal = float(np.linalg.norm(np.ptp(solid.bounds, axis=0)))
    deepest = _deepest(solid)
    advice = f"make it at least {least:.3g} mm"
    if least >= deepest:
        advice = (
            f"it would have to be {least:.3g} mm, and the part is nowhere deeper than about "
            f"{deepest:.3g} mm: fill it without a skin, or in pieces"
        )
    raise VolfrepError(
        f"A wall of {thickness:g} mm is too thin for a part of {diagonal:.4g} mm: it would "
        f"take more than {MEMORY_LIMIT / 1e9:g} GB; {advice}."
    )


def _deepest(solid: TriangleMesh) -> float:
    """How deep points of a solid lie at most, about, mm: the deepest of some of them."""
    points = points_within(solid, DEPTH_POINTS)
    return float(closest_points(solid, points)[1].max(initial=0.0))


def without_small(mesh: TriangleMesh, volume: float) -> TriangleMesh:
    """Without the closed surfaces that enclose less than the volume."""
    t = mesh.triangles
    links = t[:, [0, 1]].ravel(), t[:, [1, 2]].ravel()
    label = pieces_of(links[0], links[1], len(mesh.vertices))[1][t[:, 0]]
    enclosed = np.bincount(label, weights=mesh.signed_volumes())
    return compact(TriangleMesh(mesh.vertices, t[np.abs(enclosed)[label] >= volume]))


def _measure_error(mesh: TriangleMesh, depth: Depth) -> Cavity:
    """The wall with its largest error at random points, the same for the same wall."""
    if not len(mesh.triangles):
        return Cavity(mesh, 0.0, np.zeros(3))
    points = random_points(mesh, MEASURED_POINTS)
    error = np.abs(depth.deviation(points))
    return Cavity(mesh, float(error.max()), points[np.argmax(error)])

# SPDX-License-Identifier: LGPL-2.1-or-later
"""The inner wall of a solid with few plane faces, by moving these: exact, whatever its size.

What is within a thickness of a solid's surface is, inside the solid, the union of three kinds of
bodies: a prism below every plane face, a sector of a cylinder about every edge that is reentrant,
and a part of a ball about every vertex where three or more of them meet (the nearest point of the
surface is on a face, or on one of these). The cavity is the solid less them. No body reaches
farther than the thickness from the surface, so that none can take too much; each overlaps its
neighbours a little, so that rounding leaves no gaps between them.

Cubes (`octree`) take time by the length of edges over the thickness, this by the number of faces.
"""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np

from ..design.skins.plane_faces import PlaneFaces
from ..mesh.booleans import as_manifold, from_library
from ..mesh.triangle_mesh import TriangleMesh
from ..spatial.even_points import even_directions
from ..util.linalg import along, normalize
from ..util.manifold import manifold_library
from ..util.progress import Monitor
from ..util.types import Floats, Ints
from .crossing_plugs import without_crossings

#: Steps of an arc, radians; the points on a ball by which a part of it is told, and how far from
#: their mean the faces round a vertex may be turned before all of the ball is taken.
ARC = 0.2
BALL_POINTS = 500
WIDE = 1.3
#: Bodies overlap: sectors by so many radians and thicknesses, all reach so far out of the solid.
OVERLAP = 0.02
OUTSIDE = 0.1
#: How far simplifying may move the wall, in thicknesses.
SIMPLER = 0.001


def move_faces(faces: PlaneFaces, thickness: float, monitor: Monitor) -> TriangleMesh:
    """The cavity at a depth below a solid's plane faces.

    Arcs are within 0.5 % of the thickness, parts of balls within 1 %, all else is exact.

    Args:
        faces: of the solid.
        thickness: of the wall, mm.
        monitor: for progress and cancel.

    Returns:
        A closed oriented manifold, outward, in mm; empty where nothing is so deep.
    """
    library = manifold_library("The inner surface of a skin")
    monitor.count("bodies that a wall was cut with", faces.bodies)
    bodies = _prisms(faces, thickness)
    monitor.tick(0.1)
    bodies += [library.Manifold.hull_points(points) for points in _sectors(faces, thickness)]
    bodies += [library.Manifold.hull_points(points) for points in _balls(faces, thickness)]
    monitor.tick(0.2)
    union = monitor.call(partial(library.Manifold.batch_boolean, bodies, library.OpType.Add))
    monitor.tick(0.8)
    cavity: Any = monitor.call(
        lambda: (as_manifold(faces.solid) - union).simplify(SIMPLER * thickness).to_mesh64()
    )
    return without_crossings(from_library(cavity), thickness, monitor)


def with_short_edges(mesh: TriangleMesh, longest: float) -> TriangleMesh:
    """The same closed surface in facets whose sides are divided to a length in mm."""
    return from_library(as_manifold(mesh).refine_to_length(longest).to_mesh64())


def _prisms(faces: PlaneFaces, thickness: float) -> list[Any]:
    """A prism below each face, and a little above it."""
    order = np.argsort(faces.face, kind="stable")
    start = np.searchsorted(faces.face[order], np.arange(len(faces.normal) + 1))
    triangles = faces.solid.triangles.astype(np.int64)[order]
    return [
        _prism(faces.solid.vertices, triangles[start[k] : start[k + 1]], normal, thickness)
        for k, normal in enumerate(faces.normal)
    ]


def _prism(vertices: Floats, triangles: Ints, normal: Floats, thickness: float) -> Any:
    used, top = np.unique(triangles, return_inverse=True)
    count, top = len(used), top.reshape(-1, 3)
    start, end = top.ravel(), np.roll(top, -1, axis=1).ravel()
    border = ~np.isin(start * count + end, end * count + start)
    a, b = start[border], end[border]
    walls = np.concatenate([np.stack([b, a, a + count], 1), np.stack([b, a + count, b + count], 1)])
    upper = vertices[used] + OUTSIDE * thickness * normal
    lower = vertices[used] - thickness * normal
    surface = np.concatenate([top, top[:, ::-1] + count, walls]).astype(np.int32)
    return as_manifold(TriangleMesh(np.concatenate([upper, lower]), surface))


def _sectors(faces: PlaneFaces, thickness: float) -> list[Floats]:
    """The corners of the convex bodies about edges."""
    one, other = faces.normal[faces.beside[:, 0]], faces.normal[faces.beside[:, 1]]
    start, end = faces.solid.vertices[faces.edges.T]
    way = normalize(end - start)
    over = OVERLAP * thickness * way
    result = []
    for k, angle in enumerate(faces.angle.tolist()):
        steps = np.linspace(0.0, angle, max(int(np.ceil(angle / ARC)), 1) + 1)
        turn = np.concatenate([[-OVERLAP], steps, [angle + OVERLAP]])[:, None]
        arc = -np.cos(turn) * one[k] + np.sin(turn) * np.cross(way[k], one[k])
        out = 0.5 * OUTSIDE * (one[k] + other[k])
        ring = thickness * np.concatenate([arc, out[None]])
        result.append(np.concatenate([start[k] - over[k] + ring, end[k] + over[k] + ring]))
    return result


def _balls(faces: PlaneFaces, thickness: float) -> list[Floats]:
    """The corners of the convex bodies about vertices."""
    triangle, corner = np.nonzero(np.isin(faces.solid.triangles, faces.corners))
    at = faces.solid.triangles[triangle, corner].astype(np.int64)
    pairs = np.unique(np.stack([at, faces.face[triangle]], axis=1), axis=0)
    every = even_directions(BALL_POINTS)
    start = np.searchsorted(pairs[:, 0], np.append(faces.corners, len(faces.solid.vertices)))
    result = []
    for k, vertex in enumerate(faces.corners):
        down = -faces.normal[pairs[start[k] : start[k + 1], 1]]
        mean = down.mean(axis=0)
        mean /= max(float(np.linalg.norm(mean)), 1e-300)
        spread = float(np.arccos(np.clip(along(down, mean), -1.0, 1.0)).max())
        least = np.cos(spread + OVERLAP) if spread < WIDE else -1.0
        some = every[along(every, mean) >= least] if spread > 0.5 * ARC else every[:0]
        ways = np.concatenate([down, some, mean[None], -OUTSIDE * mean[None]])
        result.append(faces.solid.vertices[vertex] + thickness * ways)
    return result

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Decimation of a contoured wall, which leaves no facets that run through each other."""

from __future__ import annotations

from functools import partial
from typing import Any

import manifold3d
import numpy as np
from scipy.spatial import cKDTree

from ..mesh.booleans import from_library, to_library
from ..mesh.triangle_mesh import TriangleMesh
from ..spatial.self_intersection import crossing_triangles
from ..util.types import Bools, Floats
from .adaptive_contour import Wall
from .crossing_plugs import CROSSING_DEPTH, without_crossings
from .dual_contouring import Facets, fan_edges, fanned
from .sampled_depth import DepthField
from .wall_crossings import NOTHING_JUDGED, judged

#: How far simplifying may move the wall, in units of the thickness.
TOLERANCE = 0.005
#: Round crossing facets others are not simplified: as far as these reach, but no farther than the
#: one (thicknesses), and the other on top.
LOCKED_FARTHEST = 0.8
LOCKED_AROUND = 0.1
#: So often the wall is simplified, each time with less where it crossed itself.
TRIES = 4
#: Rounds of false position on an edge that is crossed.
SECANTS = 5


def simplified(wall: Wall, field: DepthField) -> TriangleMesh:
    """The wall with fewer facets, none of which run through each other.

    Where they would cross they stay as they were found; where those cross as well they are
    replaced by fans. That is tried `TRIES` times. What crosses even then lies where the room
    between two walls ends, and is filled with small boxes.
    """
    call, thickness = field.depth.monitor.call, field.depth.thickness
    tolerance = TOLERANCE * thickness
    cut = call(wall.crossings.doubled)
    facets = _with_fans(wall, cut, field)
    locked = np.zeros(len(facets.edge), bool)
    balls = np.zeros((0, 4))
    best, fewest = facets.mesh, len(facets.edge) + 1
    best_known = known = NOTHING_JUDGED
    for done in range(TRIES):
        simple = call(partial(_simplify, facets.mesh, locked, tolerance))
        field.depth.monitor.count("simplifications of the wall", 1)
        known = call(partial(judged, simple, CROSSING_DEPTH * thickness, known))
        crossed = known.crossed
        if crossed.sum() < fewest:
            best, best_known, fewest = simple, known, int(crossed.sum())
        if not fewest or done == TRIES - 1:
            break
        balls = np.concatenate([balls, _balls(simple, crossed, thickness)])
        near = call(partial(_within, facets.mesh, balls))
        crossed = call(partial(crossing_triangles, facets.mesh, near, CROSSING_DEPTH * thickness))
        segments = wall.crossings.segment[facets.edge[crossed]]
        segments = segments[segments >= 0]
        if cut[segments].all() and locked[near].all():
            break  # another try would be the same
        cut[segments] = True
        facets = _with_fans(wall, cut, field)
        locked = call(partial(_within, facets.mesh, balls))
    return call(partial(without_crossings, best, best_known, thickness)) if fewest else best


def _balls(mesh: TriangleMesh, crossed: Bools, thickness: float) -> Floats:
    """(k, 4) middles of crossed triangles, and how far round them others are locked."""
    corners = mesh.vertices[mesh.triangles[crossed]]
    middle = corners.mean(axis=1)
    radius = np.linalg.norm(corners - middle[:, None], axis=2).max(axis=1)
    reach = np.minimum(radius, LOCKED_FARTHEST * thickness) + LOCKED_AROUND * thickness
    return np.concatenate([middle, reach[:, None]], axis=1)


def _with_fans(wall: Wall, cut: Bools, field: DepthField) -> Facets:
    """The wall's facets, with fans round the edges whose polygons have a cut segment."""
    call, crossings = field.depth.monitor.call, wall.crossings
    edges = call(lambda: fan_edges(crossings, cut))
    low, high = (
        crossings.edges.low[edges].astype(np.float64),
        crossings.edges.high[edges].astype(np.float64),
    )
    a, b = field.sample(crossings.edges.low[edges])[0], field.sample(crossings.edges.high[edges])[0]
    nodes = low
    for _ in range(SECANTS):
        share = np.clip(a / (a - b), 0.05, 0.95)[:, None]
        nodes = low + share * (high - low)
        value = field.depth.values(field.point(nodes))[0]
        as_low = (value < 0) == (a < 0)
        low, a = np.where(as_low[:, None], nodes, low), np.where(as_low, value, a)
        high, b = np.where(as_low[:, None], high, nodes), np.where(as_low, b, value)
    points = field.point(nodes)
    return call(lambda: fanned(crossings, wall.facets, cut, points))


def _within(mesh: TriangleMesh, balls: Floats) -> Bools:
    """(m,) whether a triangle's middle lies in one of the balls."""
    tree = cKDTree(mesh.vertices[mesh.triangles].mean(axis=1))
    result = np.zeros(len(mesh.triangles), bool)
    for found in tree.query_ball_point(balls[:, :3], balls[:, 3]):
        result[found] = True
    return result


def _simplify(mesh: TriangleMesh, locked: Bools, tolerance: float) -> TriangleMesh:
    """The mesh with fewer triangles, moved by less than the tolerance, as a valid manifold."""
    # Triangles of faces of their own are not merged with others.
    face = np.where(locked, 1 + np.arange(len(locked)), 0).astype(np.uint64)
    solid: Any = manifold3d.Manifold(to_library(mesh, face_id=face))
    if solid.status() != manifold3d.Error.NoError:
        raise RuntimeError(f"the inner wall is not manifold: {solid.status()}")
    return from_library(solid.simplify(tolerance).to_mesh64())

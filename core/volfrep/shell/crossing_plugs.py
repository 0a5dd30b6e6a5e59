# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where a wall still runs through itself, the cavity is filled with boxes a little larger."""

from __future__ import annotations

from typing import Any

import manifold3d
import numpy as np

from ..mesh.booleans import from_library, to_library
from ..mesh.triangle_mesh import TriangleMesh
from ..util.types import Floats
from .wall_crossings import Judged, judged

#: Facets that cross by less than this (thicknesses) only touch.
CROSSING_DEPTH = 1e-5
#: How far the boxes reach beyond the places where facets cross, in thicknesses: at first, and in
#: each further round so many times as far.
BEYOND = 0.004
FARTHER = 2.0
ROUNDS = 5


def without_crossings(mesh: TriangleMesh, known: Judged, thickness: float) -> TriangleMesh:
    """The wall of a cavity less small boxes, so that it does not run through itself.

    Two sides of a cavity pass each other only where the room between them ends; there it ends a
    little sooner now. The Boolean drops what lies in a box, whatever its orientation.

    Args:
        mesh: a closed oriented manifold, outward, mm.
        known: where it crosses itself.
        thickness: of the wall, mm.

    Returns:
        The mesh itself where nothing crosses. After `ROUNDS` a few facets may still cross.
    """
    reach = BEYOND * thickness
    best, fewest = mesh, int(known.crossed.sum())
    for _ in range(ROUNDS):
        if not known.crossed.any():
            break
        mesh = _less(mesh, *_boxes(known, reach))
        known = judged(mesh, CROSSING_DEPTH * thickness, known)
        if known.crossed.sum() < fewest:
            best, fewest = mesh, int(known.crossed.sum())
        reach *= FARTHER
    return best


def _boxes(known: Judged, reach: float) -> tuple[Floats, Floats]:
    """(k, 3) lowest and highest corners of boxes, each about the points of a pair of triangles."""
    pairs = np.sort(np.stack([known.edge_of, known.through], axis=1), axis=1)
    _, pair = np.unique(pairs, axis=0, return_inverse=True)
    pair = pair.ravel()
    low = np.full((int(pair.max()) + 1, 3), np.inf)
    high = -low
    np.minimum.at(low, pair, known.points)
    np.maximum.at(high, pair, known.points)
    return low - reach, high + reach


def _less(mesh: TriangleMesh, low: Floats, high: Floats) -> TriangleMesh:
    solid: Any = manifold3d.Manifold(to_library(mesh))
    boxes = [
        manifold3d.Manifold.cube((b - a).tolist()).translate(a.tolist())
        for a, b in zip(low, high, strict=True)
    ]
    union = manifold3d.Manifold.batch_boolean(boxes, manifold3d.OpType.Add)
    return from_library((solid - union).to_mesh64())

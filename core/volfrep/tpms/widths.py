# SPDX-License-Identifier: LGPL-2.1-or-later
"""How thin walls and the gaps between them are: the smallest balls that touch both their sides.

A ball that touches the surface at a point, and grows until it touches it somewhere else, has the
width there for its diameter, if the two places lie on opposite sides: elsewhere it only tells how
bent the surface is. It is found by shrinking a larger one until no point of the surface is in it
(J. Ma, S. W. Bae and S. Choi, The Visual Computer 28, 2012). All lengths are in units of L.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from ..util.types import Floats
from .solid import TpmsSolid

#: A ball that is no smaller than this, in units of L, is not shrunk further; none is larger.
WIDEST = 0.5
ROUNDS = 12
#: A point is of the solid's surface where its distance is less; others lie where sides meet.
ON_SURFACE = 1e-4
#: Points nearer than this part of the ball's diameter tell of its own place and not of another.
SETTLED = 1e-3
#: Two places are on opposite sides where the cosine between the surface's normals is below this.
OPPOSITE = -0.5


@dataclass(frozen=True)
class TpmsWidths:
    """Widths of walls, of which one period tells all.

    Attributes:
        thickness: of the solid where it is thinnest; no more than `WIDEST`.
        gap: of the room beside it where that is narrowest; no more than `WIDEST`.
    """

    thickness: float
    gap: float


def measure_widths(solid: TpmsSolid) -> TpmsWidths:
    """The least thickness and the least gap of an endless wall, in units of L.

    Both are told up to a fiftieth of a cell too large, for the surface is known at points; a
    sheet's thickness is exact.

    >>> from volfrep.design.tpms import SURFACES, TpmsSheet
    >>> sheet = TpmsSolid.of(SURFACES["Gyroid"], TpmsSheet("sheet", 1.0), 10.0)
    >>> round(measure_widths(sheet).thickness, 2)
    0.1
    """
    middle = solid.surface
    feet = middle.feet(middle.cloud, middle.cloud, 2)
    sides = (1.0, -1.0) if solid.kind == "sheet" else (1.0,)
    out = -1.0 if solid.kind == "complement" else 1.0
    points = np.concatenate([feet.points + side * out * solid.level * feet.normals
                             for side in sides])  # fmt: skip
    normals = np.concatenate([side * out * feet.normals for side in sides])
    there = np.abs(solid.values(points)) < ON_SURFACE
    points, normals = points[there], normals[there]
    if not len(points):
        return TpmsWidths(0.0, 0.0)
    folded = points - np.floor(points)
    folded[folded >= 1.0] = 0.0
    tree = cKDTree(folded, boxsize=1.0)
    inside, outside = (_least_ball(tree, folded, side * normals) for side in (-1.0, 1.0))
    return TpmsWidths(inside, outside)


def _least_ball(tree: object, points: Floats, into: Floats) -> float:
    """The diameter of the smallest ball that touches the surface at two places, on one side."""
    radius = np.full(len(points), 0.5 * WIDEST)
    other = np.arange(len(points))
    going = np.arange(len(points))
    for _ in range(ROUNDS):
        centre = points[going] + radius[going, None] * into[going]
        inner = centre - np.floor(centre)
        inner[inner >= 1.0] = 0.0
        away, near = tree.query(inner)  # type: ignore[attr-defined]
        shrinks = away < radius[going] * (1.0 - SETTLED)
        going, near = going[shrinks], near[shrinks]
        if not len(going):
            break
        gap = points[near] - points[going]
        gap -= np.round(gap)
        across = np.einsum("ij,ij->i", gap, into[going])
        smaller = np.einsum("ij,ij->i", gap, gap) / np.maximum(2.0 * across, 1e-12)
        radius[going] = np.minimum(radius[going], np.maximum(smaller, 1e-6))
        other[going] = near
    cosine = np.einsum("ij,ij->i", into, into[other])
    return 2.0 * float(radius[cosine < OPPOSITE].min(initial=0.5 * WIDEST))

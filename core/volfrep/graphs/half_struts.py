# SPDX-License-Identifier: LGPL-2.1-or-later
"""Struts as seen from their nodes, and the corners of their facets."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from scipy.spatial import ConvexHull

from ..grid.strut_graph import Wireframe
from ..util.linalg import axes_across
from ..util.types import Floats, Ints


@dataclass(frozen=True, eq=False)
class HalfStruts:
    """Struts as seen from their nodes: the first m from their first nodes, then from the second.

    Attributes:
        node: (2 m,) where each begins.
        along: (2 m, 3) unit vector away from it.
        radius: (2 m,) of the corners round it, at the node, mm.
        slope: (2 m,) by which that grows along it.
        length: (2 m,) of the whole strut, mm.
        rays: (2 m, sides, 3) unit vectors from the axis to the corners round it; the same for
            both halves of a strut.
    """

    node: Ints
    along: Floats
    radius: Floats
    slope: Floats
    length: Floats
    rays: Floats


def corner_scale(sides: int) -> float:
    """By what a regular polygon's corners lie outside the circle of the same area."""
    turn = 2.0 * np.pi / sides
    return float(np.sqrt(turn / np.sin(turn)))


def ball_directions(sides: int) -> Floats:
    """(k, 3) unit vectors spread evenly, as far apart as the corners round a strut.

    The sunflower's spiral on the sphere, A. Gonzalez, Math. Geosci. 42, 2010.
    """
    number = max(16, round(4.0 * np.pi / (0.866 * (2.0 * np.pi / sides) ** 2)))
    place = np.arange(number) + 0.5
    height, turn = 1.0 - 2.0 * place / number, place * np.pi * (3.0 - np.sqrt(5.0))
    flat = np.sqrt(1.0 - height**2)
    return np.stack([flat * np.cos(turn), flat * np.sin(turn), height], axis=1)


def hull_of(ways: Floats) -> Ints:
    """(m, 3) triangles of the hull of vectors (k, 3), counter-clockwise from outside."""
    rows: Ints = ConvexHull(ways).simplices.astype(np.int64)
    a, b, c = ways[rows].swapaxes(0, 1)
    inward = (a * np.cross(b, c)).sum(axis=1) < 0.0
    rows[inward] = rows[inward][:, ::-1]
    return rows


@lru_cache
def ball_scale(sides: int) -> float:
    """By what a ball's vertices, on `ball_directions`, lie outside the sphere of its volume."""
    return float(np.cbrt(4.0 / 3.0 * np.pi / ConvexHull(ball_directions(sides)).volume))


def half_struts(frame: Wireframe, sides: int) -> HalfStruts:
    """The struts of a wireframe, with `sides` corners round each."""
    start, end = frame.nodes[frame.struts].swapaxes(0, 1)
    span = end - start
    length = np.linalg.norm(span, axis=1)
    along = span / length[:, None]
    first, second = axes_across(along)  # the same from both ends
    turn = 2.0 * np.pi * np.arange(sides) / sides
    rays = np.cos(turn)[:, None] * first[:, None] + np.sin(turn)[:, None] * second[:, None]
    radii = corner_scale(sides) * frame.radii
    slope = (radii[:, 1] - radii[:, 0]) / length
    return HalfStruts(
        frame.struts.T.ravel().astype(np.int64),
        np.concatenate([along, -along]),
        radii.T.ravel(),
        np.concatenate([slope, -slope]),
        np.concatenate([length, length]),
        np.concatenate([rays, rays]),
    )

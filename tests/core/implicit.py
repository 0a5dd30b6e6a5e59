# SPDX-License-Identifier: LGPL-2.1-or-later
"""Meshes over implicit surfaces of closed form, as the stages after marching cubes get them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from volfrep.octants import constrained_mesh as surface
from volfrep.octants import sdf as frep
from volfrep.octants.octant import (
    ALL_ACTIVE,
    OctantKey,
    octant_primitives,
    raw_octant,
    sample_octant,
)


def field_of(primitives: frep.Primitives, count: int, fillet: float = 0.0) -> frep.Field:
    """The field of all the primitives about each of so many points."""
    near = np.tile(np.arange(len(primitives)), count)
    return frep.Field(primitives, len(primitives) * np.arange(count + 1), near, fillet)


def surface_of(vertices, triangles, primitives, edge=1.0, place=None, size=1e6) -> surface.Surface:
    """A mesh over primitives, none of its vertices held; pinned by `place` where it is given."""
    count = len(vertices)
    return surface.Surface(
        np.asarray(vertices, float),
        np.asarray(triangles, np.int64).reshape(-1, 3),
        np.ones((count, 3), np.int8) if place is None else np.asarray(place, np.int8),
        edge,
        0.5 * edge,
        np.zeros(count, np.int64),
        size,
        np.full((count, 3), -1, np.int64),
        field_of(primitives, count),
    )


def octant_surface(cell, size=10.0, radius=1.0, steps=14) -> surface.Surface:
    """Marching cubes' surface of the octant of a cell that has all its neighbours."""
    primitives = octant_primitives(cell, OctantKey(0, ALL_ACTIVE), size, radius, 2.0)
    raw = raw_octant(sample_octant(primitives, size, steps, 0.0), size)
    step = 0.5 * size / steps
    made = surface_of(raw.vertices, raw.triangles, primitives, 2.0 * step, raw.place, 0.5 * size)
    return replace(made, step=step)

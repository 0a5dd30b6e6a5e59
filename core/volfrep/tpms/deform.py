# SPDX-License-Identifier: LGPL-2.1-or-later
"""Graded walls: the vertices of placed octants where the wall is as thick as wanted in the part.

A vertex hangs on its foot on the surface. The map takes the foot to the part, and the normal with
it; there the vertex stands off by half the thickness that is wanted at that place. So a sheet has
its thickness however the cells are stretched.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..grid.coordinate_map import CoordinateMap
from ..lattice.assembly import CHUNK_VERTICES, Layout, numbers
from ..lattice.deform import Deformed
from ..octants.octant import Octant, OctantKey
from ..util.progress import Monitor
from ..util.types import Bools, Floats
from .solid import TpmsSolid

#: Newton's steps of vertices that stay in a face which closes a block, and the least square of
#: the slope there.
FACE_STEPS = 4
GRAZING = 0.1

#: What gives the level of a wall (half a sheet's thickness, or a side's offset) at points of the
#: part, mm.
Levels = Callable[[Floats], Floats]


@dataclass(frozen=True, eq=False)
class _Binding:
    """An octant's vertices as they hang on the surface, in its frame.

    Attributes:
        feet: (n, 3) on the surface, mm.
        away: (n, 3) the solid's outward direction there.
        is_corner: (n,) corners of the octant, which keep their places.
        on_face: (n, 3) coordinates that are kept: on a face that closes a block.
    """

    feet: Floats
    away: Floats
    is_corner: Bools
    on_face: Bools


def deform_tpms(
    layout: Layout, solid: TpmsSolid, levels: Levels, mapping: CoordinateMap, monitor: Monitor
) -> Deformed:
    """Where the vertices of placed octants are in the part.

    Args:
        layout: the numbered octants of a wall of some middle thickness.
        solid: that wall, in units of L.
        levels: what it is to be instead.
        mapping: from lattice space to the part.
        monitor: for progress and cancel.
    """
    grid, size = layout.grid, layout.grid.cell_size
    vertices, excess = np.empty((layout.count, 3)), 0.0
    for key, place in zip(grid.keys, layout.places, strict=True):
        octant = layout.octants[key]
        if not len(octant.vertices):
            continue
        bound = _bind(octant, key, solid, size)
        step = max(1, CHUNK_VERTICES // len(octant.vertices))
        on_face = octant.places != 1
        for begin in range(0, len(place), step):
            part = place[begin : begin + step]
            corner, sign = layout.frames(part)
            base = corner * size + grid.origin
            before = base[:, None] + sign[:, None] * octant.vertices
            feet = (base[:, None] + sign[:, None] * bound.feet).reshape(-1, 3)
            away = np.broadcast_to(sign[:, None] * bound.away, before.shape).reshape(-1, 3)
            foot, direction, _ = _in_part(feet, away, mapping)
            found = (foot + levels(foot)[:, None] * direction).reshape(before.shape)
            kept = before[:, bound.is_corner]
            found[:, bound.is_corner] = mapping.to_part(kept.reshape(-1, 3)).reshape(kept.shape)
            back = mapping.to_lattice(found.reshape(-1, 3)).reshape(before.shape)
            middle = (base + sign * (0.25 * size))[:, None]
            seen = mapping.unwrapped(np.concatenate([middle, back], axis=1))[:, 1:]
            capped = bound.on_face.any(axis=1) & ~bound.is_corner
            if capped.any():
                fixed = np.broadcast_to(bound.on_face[capped], (len(part), int(capped.sum()), 3))
                seen[:, capped] = _in_faces(
                    np.where(fixed, before[:, capped], seen[:, capped]), fixed, base, solid, size,
                    levels, mapping,
                )  # fmt: skip
                there = mapping.to_part(seen[:, capped].reshape(-1, 3))
                found[:, capped] = there.reshape(len(part), -1, 3)
            left = np.abs(seen - before)[:, on_face].max(initial=0.0)
            beyond = np.abs(seen - middle).max() - 0.25 * size
            excess = max(excess, float(max(left, beyond)) / (0.5 * size))
            vertices[numbers(layout, octant, part)] = found
            monitor.tick()
    return Deformed(vertices, excess)


def part_levels(
    points: Floats, start: Floats, solid: TpmsSolid, size: float, mapping: CoordinateMap
) -> Floats:
    """(n,) the levels, mm, from which on points of lattice space, mm, are solid in the part.

    Distances in the part are those in lattice space over how the map stretches them there.
    `start` is a corner of the cells.
    """
    feet = solid.surface.feet((points - start) / size)
    scale = _in_part(start + feet.points * size, feet.normals, mapping)[2]
    result: Floats = solid.outward(feet) * feet.distances * size / scale
    return result


def _bind(octant: Octant, key: OctantKey, solid: TpmsSolid, size: float) -> _Binding:
    sign = np.where([key.mirror >> axis & 1 for axis in range(3)], -1.0, 1.0)
    feet = solid.surface.feet(sign * octant.vertices / size)
    # A vertex on a face that counts as inside it is on one that closes a block.
    on_face = (octant.places == 1) & (octant.vertices == 0.0)
    ends = (octant.vertices == 0.0) | (octant.vertices == 0.5 * size)
    return _Binding(
        sign * feet.points * size,
        sign * solid.outward(feet)[:, None] * feet.normals,
        ends.all(axis=1),
        on_face,
    )


def _in_part(
    points: Floats, normals: Floats, mapping: CoordinateMap
) -> tuple[Floats, Floats, Floats]:
    """Points and unit normals of a surface taken to the part, and the inverse of the stretch."""
    jacobian = mapping.jacobians(points)
    a, b, c = (jacobian[:, :, k] for k in range(3))
    volume = np.einsum("ij,ij->i", a, np.cross(b, c))
    taken = normals[:, :1] * np.cross(b, c) + normals[:, 1:2] * np.cross(c, a)
    taken = (taken + normals[:, 2:] * np.cross(a, b)) / volume[:, None]
    size = np.linalg.norm(taken, axis=1)
    return mapping.to_part(points), taken / size[:, None], size


def _in_faces(
    points: Floats,
    fixed: Bools,
    base: Floats,
    solid: TpmsSolid,
    size: float,
    levels: Levels,
    mapping: CoordinateMap,
) -> Floats:
    """Vertices that a face holds, in lattice space, where the wall's surface meets it.

    Args:
        points: (k, n, 3) of each of k octants, mm.
        fixed: (k, n, 3) coordinates that are kept.
        base: (k, 3) the grid corners that the octants lie about, mm.
        solid: as of `deform_tpms`.
        size: L, mm.
        levels: as of `deform_tpms`.
        mapping: as of `deform_tpms`.
    """
    shape = points.shape
    start = np.broadcast_to(base[:, None], shape).reshape(-1, 3)
    at, loose = points.reshape(-1, 3), ~fixed.reshape(-1, 3)
    for _ in range(FACE_STEPS):
        feet = solid.surface.feet((at - start) / size)
        out = solid.outward(feet)
        foot, _, scale = _in_part(start + feet.points * size, feet.normals, mapping)
        value = out * feet.distances * size - levels(foot) / scale
        gradient = out[:, None] * feet.normals * loose
        slope = np.maximum(np.einsum("ij,ij->i", gradient, gradient), GRAZING)
        at = at - gradient * (value / slope)[:, None]
    return at.reshape(shape)

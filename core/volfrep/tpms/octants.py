# SPDX-License-Identifier: LGPL-2.1-or-later
"""Which octant of a wall lies where, endless or in some cells only, and the faces that close it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ..mesh.remesh import edges
from ..mesh.topology import pieces_of
from ..mesh.triangle_mesh import TriangleMesh
from ..octants.batch import ranked_octant
from ..octants.caps import cap, with_corners
from ..octants.octant import (
    ALL_ACTIVE,
    Octant,
    OctantGrid,
    OctantKey,
    corner_patterns,
    octant_mirrors,
    used_kinds,
)
from ..util.types import Bools, Floats, Ints, Periodic


def endless_octants(
    shape: tuple[int, int, int], cell_size: float, origin: Floats, periodic: Periodic
) -> OctantGrid:
    """The octants of all of space about so many cells, and half a cell beyond them.

    Arguments as of `volfrep.octants.octant.octant_grid`.
    """
    ends = zip(shape, periodic, strict=True)
    x, y, z = (2 * n + (0 if closed else 2) for n, closed in ends)
    keys = [OctantKey(mirror, ALL_ACTIVE) for mirror in range(8)]
    kind = octant_mirrors((x, y, z)).astype(np.int16)
    return OctantGrid(keys, kind, np.asarray(origin, float), cell_size, False, periodic)


def octants_of_cells(
    active: Bools, cell_size: float, origin: Floats, periodic: Periodic
) -> OctantGrid:
    """The octants of some cells only; their keys tell which of their faces no cell follows."""
    pattern = corner_patterns(active, periodic).astype(np.int64)
    mirror = octant_mirrors(pattern.shape).astype(np.int64)  # type: ignore[arg-type]
    # Of the cells about the corner only the own one counts, and those beyond the octant's faces.
    faces = sum(1 << (1 << axis) for axis in range(3))
    code = (mirror << 8) | (pattern & faces) | (ALL_ACTIVE & ~faces)
    code[pattern & 1 == 0] = -1
    values, inverse = np.unique(code, return_inverse=True)
    kind = inverse.reshape(code.shape).astype(np.int16)
    if values[0] < 0:
        values, kind = values[1:], kind - np.int16(1)
    keys = [OctantKey(int(v) >> 8, int(v) & 0xFF) for v in values]
    grid = OctantGrid(keys, kind, np.asarray(origin, float), cell_size, False, periodic)
    return used_kinds(grid)


@dataclass(frozen=True, eq=False)
class ClosedOctants:
    """The octants of a block.

    Attributes:
        octants: with caps where nothing follows, without the pieces that these leave hanging.
        loose: by key, the volumes of the pieces of one octant that hang on nothing, mm3.
    """

    octants: dict[OctantKey, Octant]
    loose: dict[OctantKey, Floats]


def closed_octants(
    octants: Mapping[OctantKey, Octant], keys: Sequence[OctantKey], half_size: float
) -> ClosedOctants:
    """Octants with flat caps on the faces that no cell follows.

    What lies on such a face is shared by none beyond it: its vertices count as lying inside, or
    on the faces beside it, whose octants are closed on the same side. At a block's corners a cap
    may cut a piece off, which is left out: it hangs on nothing.

    Args:
        octants: of the endless wall.
        keys: what to make, as `octants_of_cells` of a block has them.
        half_size: the octants' edge, mm.
    """
    made, loose = {}, {}
    for key in keys:
        octant = _close(octants[OctantKey(key.mirror, ALL_ACTIVE)], key, half_size)
        made[key], loose[key] = _without_loose(octant)
    return ClosedOctants(made, loose)


def _without_loose(octant: Octant) -> tuple[Octant, Floats]:
    """An octant without the bodies that are closed within it, and the volumes of these."""
    if not len(octant.triangles):
        return octant, np.zeros(0)
    table = edges(octant.triangles.astype(np.int64), len(octant.vertices))
    count, piece = pieces_of(table.ends[:, 0], table.ends[:, 1], len(octant.vertices))
    owner = piece[octant.triangles[:, 0]]
    volumes = TriangleMesh(octant.vertices, octant.triangles).signed_volumes()
    volume: Floats = np.bincount(owner, volumes).astype(np.float64)
    goes_on = np.zeros(count, bool)
    goes_on[piece[table.ends[table.triangles[:, 1] < 0, 0]]] = True
    loose = ~goes_on & (volume > 0.0)
    if not loose.any():
        return octant, np.zeros(0)
    stays = ~loose[piece]
    number = np.cumsum(stays) - 1
    left = ranked_octant(
        octant.vertices[stays], number[octant.triangles[~loose[owner]]],
        octant.places[stays].astype(np.int8), octant.rank[stays].astype(np.int64),
        octant.solid_corners,
    )  # fmt: skip
    return left, volume[loose]


def _close(octant: Octant, key: OctantKey, half_size: float) -> Octant:
    axes = [axis for axis in range(3) if not key.pattern >> (1 << axis) & 1]
    if not axes:
        return octant
    whole = with_corners(octant, half_size)
    triangles = np.concatenate([whole.triangles, *(cap(whole, axis, False) for axis in axes)])
    used, rows = np.unique(triangles, return_inverse=True)
    place = whole.places[used].astype(np.int8)
    # One order for what comes together from an entity and from its edge.
    order: Ints = (whole.entity[used].astype(np.int64) << 32) | whole.rank[used]
    place[:, axes] = np.where(place[:, axes] == 0, 1, place[:, axes])
    return ranked_octant(
        whole.vertices[used], rows.reshape(triangles.shape), place, order, whole.solid_corners
    )

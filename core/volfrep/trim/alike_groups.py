# SPDX-License-Identifier: LGPL-2.1-or-later
"""Groups of octants that are cut alike: one of them is cut, the others are copies of what it left.

Groups are alike where they have the same kinds of octants, and the same wall in the same place,
whatever facets the part had there: that is compared, not supposed. Vertices that octants have at a
rim are placed as octants place them, to the last bit; all others are moved, and rounded otherwise
than if they had been computed, which `join` allows for. Along the axis across a wall that is level
nothing is moved: what lies in one plane stays in it to the last bit.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import chain

import numpy as np

from ..lattice.assembly import INSIDE, in_steps, placed
from ..lattice.placed_octants import Placed
from ..mesh import remesh
from ..mesh.open_shells import OpenShells
from ..mesh.triangle_mesh import TriangleMesh, corners_at
from ..util.content import content_of
from ..util.linalg import along
from ..util.parallel import ParallelBackend, SharedValue
from ..util.types import Bools, Floats, Ints
from .group_cut import Group, Piece
from .octant_groups import Groups
from .trimmed_surface import equal_rows

#: Walls are alike that differ by less than this, in units of L: rounding.
ALIKE = 1e-8
#: Groups that are looked at in one call.
CALL_GROUPS = 8


@dataclass(frozen=True, eq=False)
class Alike:
    """A group, and others that are cut as it is.

    Attributes:
        placed: its octants.
        both: (nx, ny, nz) bool, those that are cut.
        others: numbers of the others, and the corner of the grid that each begins at.
    """

    placed: Placed
    both: Bools
    others: list[tuple[int, Ints]]

    def copies(self, piece: Piece) -> list[tuple[int, Piece]]:
        """What is left of the others, by their numbers, where this is left of the group."""
        layout, motion, mesh = self.placed.layout, self.placed.motion, piece.mesh
        corner, steps = self._on_faces()
        row = equal_rows(mesh.vertices[piece.rim], motion(placed(layout.grid, corner, steps)))
        rim, row = piece.rim[row >= 0], row[row >= 0]
        corner, steps = corner[row], steps[row]
        normal = None if piece.shells is None else _normals(mesh, piece.shells)
        copies = []
        for other, first in self.others:
            shift = (first - layout.first) * layout.grid.cell_size
            vertices = mesh.vertices + shift
            vertices[rim] = motion(placed(layout.grid, corner + (first - layout.first), steps))
            shells = piece.shells
            if shells is not None and normal is not None:
                shells = replace(shells, volume=shells.volume + along(normal, shift) / 3.0)
            moved = TriangleMesh(vertices, mesh.triangles)
            copies.append((other, replace(piece, mesh=moved, work={}, shells=shells)))
        if piece.looks is None:
            return copies
        looks = piece.looks.elsewhere([copy.mesh for _, copy in copies])
        return [
            (other, replace(copy, looks=known))
            for (other, copy), known in zip(copies, looks, strict=True)
        ]

    def _on_faces(self) -> tuple[Ints, Floats]:
        """(n, 3) corners of the grid, and (n, 3) steps from these to vertices on octants' faces."""
        layout, every = self.placed.layout, []
        for key, place in zip(layout.grid.keys, layout.places, strict=True):
            octant, place = layout.octants[key], place[self.both[tuple(place.T)]]
            steps = in_steps(layout.grid, octant)[octant.entity != INSIDE]
            corner, sign = layout.frames(place)
            every.append(
                (np.repeat(corner, len(steps), axis=0), (sign[:, None] * steps).reshape(-1, 3))
            )
        corners, steps = (np.concatenate(each) for each in zip(*every, strict=True))
        return corners, steps


def find_alike(
    groups: Groups,
    which: Ints,
    cavity: bool,
    shared: SharedValue[Groups],
    backend: ParallelBackend,
) -> dict[int, Alike]:
    """The first ones of groups that are cut alike, by their numbers.

    Args:
        groups: all of them.
        which: those that are to be cut.
        cavity: as of a `Group`.
        shared: the same groups, for calls.
        backend: makes these.
    """
    some = which[groups.repeats[which]]
    calls = ((shared, some[k : k + CALL_GROUPS], cavity) for k in range(0, len(some), CALL_GROUPS))
    found: dict[bytes, list[tuple[int, Ints]]] = {}
    keys = chain.from_iterable(backend.starmap(alike_keys, calls))
    for number, (key, first) in zip(some.tolist(), keys, strict=True):
        found.setdefault(key, []).append((number, first))
    result = {}
    for (number, _), *others in found.values():
        if others:
            group = groups.group(number, cavity)
            result[number] = Alike(group.placed, group.own | group.adjacent, others)
    return result


def alike_keys(groups: SharedValue[Groups], which: Ints, cavity: bool) -> list[tuple[bytes, Ints]]:
    """Of some groups, what is the same for those that are cut alike; and where they begin."""
    result = []
    for number in which.tolist():
        group = groups.value.group(number, cavity)
        result.append((_key(group), group.placed.layout.first))
    return result


def _key(group: Group) -> bytes:
    """The same for groups that are cut alike, in a few bytes."""
    layout = group.placed.layout
    grid, length = layout.grid, layout.grid.cell_size
    corner = group.placed.motion(grid.origin + layout.first * length)
    at = np.rint((group.boundary.vertices - corner) / (ALIKE * length)).astype(np.int64)
    corners = corners_at(group.boundary.vertices, group.boundary.triangles)
    level = corners.max(axis=1) == corners.min(axis=1)
    heights = [np.unique(corners[level[:, axis], 0, axis]) for axis in range(3)]
    keys = np.array(repr(grid.keys).encode())
    return content_of(
        keys, *heights, grid.kind, group.own, group.adjacent, group.follow, at,
        group.boundary.triangles, group.own_boundary,
    )  # fmt: skip


def _normals(mesh: TriangleMesh, shells: OpenShells) -> Floats:
    """(shells, 3) the integral of the normal over each shell, mm2."""
    normal = 0.5 * remesh.normals(corners_at(mesh.vertices, mesh.triangles))
    count = len(shells.volume)
    return np.stack([np.bincount(shells.shell, axis, count) for axis in normal.T], axis=1)

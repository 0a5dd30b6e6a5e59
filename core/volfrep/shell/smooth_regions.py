# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where the surface of a solid is plain, so that large cubes will do to find the wall below it.

A cube of the size h is plain when all of the surface that the depth in it can come from turns by
little. With h at least `LEAST_SIZE` thicknesses, that surface lies in the cube and in its 26
neighbours of the same size: there the wall is a nearly flat sheet, which the corners of the cube
cannot miss. The surface is sampled as densely as the cubes below it need.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ..mesh.triangle_mesh import TriangleMesh
from ..spatial.proximity import edge_lengths, sample_triangles
from ..util.progress import Monitor
from ..util.types import Bools, Floats, Ints
from .octree import find, name

#: Plain cubes have edges of at least so many thicknesses.
LEAST_SIZE = 1.59
#: A surface is plain when the components of its unit normals differ by no more than this.
TURN = 0.25
#: Spacing of the samples below plain cubes, in units of their edges. From a point in such a cube
#: there is a sample within 0.77 edges, and all other surface is at least one away.
SPACING = 0.6
#: Triangles are cut into pieces of no more than so many cubes' edges before they are looked at.
LONGEST_PIECE = 2.0
#: Added to the whole numbers of bins: the surface lies outside the cubes.
BEFORE = 16
#: So often triangles are halved, at most, until they are short enough.
HALVINGS = 60


@dataclass(frozen=True, eq=False)
class _Bins:
    """The unit normals of the surface in some cubes of one size.

    Attributes:
        names: (n,) of the cubes, in ascending order.
        normals: (n, 6) the least and, with the other sign, the largest of their components.
    """

    names: Ints
    normals: Floats

    def grown(self) -> _Bins:
        """Every cube, and every neighbour of one, with the normals of its neighbours, too."""
        names, normals = self.names, self.normals
        for axis in np.eye(3, dtype=np.int64):
            step = name(axis)
            names, normals = _least(
                np.concatenate([names - step, names, names + step]), np.tile(normals, (3, 1))
            )
        return _Bins(names, normals)

    def turn(self, wanted: Ints) -> Floats:
        """(n,) by how much the normals differ in the cubes of these names; no surface: inf."""
        rows = find(self.names, wanted)
        spread = (-self.normals[:, 3:] - self.normals[:, :3]).max(axis=1, initial=0.0)
        return np.where(rows >= 0, spread[rows] if len(spread) else np.inf, np.inf)


@dataclass(eq=False)
class SmoothRegions:
    """The surface of a solid, sampled as densely as its cubes need.

    Attributes:
        start: (3,) corner of the cubes' grid, mm.
        cube: edge of the cubes that are not plain, mm.
        samples: (k, 3) points of the surface.
        owner: (k,) their triangles.
        cubes: about how many of them the surface passes through.
    """

    start: Floats
    cube: float
    samples: Floats
    owner: Ints
    cubes: float
    _bins: dict[int, _Bins] = field(default_factory=dict)

    def tells(self, cubes: Ints, top: int) -> Bools:
        """(n,) which cubes of `top` times the smallest size are plain.

        Args:
            cubes: (n, 3) lowest corners, in units of the smallest size.
            top: a power of two.
        """
        bins = self._bins.get(top)
        if bins is None:
            return np.zeros(len(cubes), bool)
        return np.asarray(bins.turn(name(cubes // top + BEFORE)) <= TURN)


def find_smooth_regions(
    solid: TriangleMesh,
    start: Floats,
    cube: float,
    top: int,
    thickness: float,
    spacing: float,
    most: float,
    monitor: Monitor,
) -> SmoothRegions:
    """Look for the plain parts of a surface, from large cubes to small ones.

    Args:
        solid: closed, mm.
        start: (3,) corner of the cubes' grid.
        cube: edge of the smallest cubes, mm.
        top: the largest ones are so many times as large: a power of two.
        thickness: of the wall, mm.
        spacing: of the samples where the surface is not plain, mm.
        most: the search ends when the surface passes through more cubes than this.
        monitor: asked for a cancel.

    Returns:
        The plain parts; without samples where there would be too many cubes.
    """
    corners = np.stack(solid.corners(), axis=1)
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.linalg.norm(normal, axis=1)
    normal /= np.maximum(length, 1e-300)[:, None]
    owner = np.arange(len(corners))
    found = SmoothRegions(np.asarray(start), cube, np.zeros((0, 3)), np.zeros(0, np.int64), 0.0)
    parts: list[tuple[Floats, Ints]] = []
    while top > 1 and top * cube >= LEAST_SIZE * thickness:
        size = top * cube
        monitor.tick()
        if found.cubes + _area(corners) / size**2 > most:
            found.cubes += _area(corners) / size**2
            return found
        corners, owner = _cut(corners, owner, LONGEST_PIECE * size)
        points, piece = sample_triangles(corners, SPACING * size)
        names = name(np.floor((points - start) / size).astype(np.int64) + BEFORE)
        flat = length[owner[piece]] > 0.0
        both = np.concatenate([normal, -normal], axis=1)[owner[piece]]
        bins = _Bins(*_least(names[flat], both[flat])).grown()
        found._bins[top] = bins
        # Finer cubes look for the surface near the cubes that are not plain.
        turned = bins.names[bins.turn(bins.names) > TURN]
        near = _Bins(turned, np.zeros((len(turned), 6))).grown().names
        stays = np.zeros(len(corners), bool)
        stays[piece[(find(near, names) >= 0) | ~flat]] = True
        parts.append((points[~stays[piece]], owner[piece[~stays[piece]]]))
        found.cubes += _area(corners[~stays]) / size**2
        corners, owner = corners[stays], owner[stays]
        top //= 2
    found.cubes += _area(corners) / cube**2
    if found.cubes > most:
        return found
    points, piece = sample_triangles(corners, spacing)
    parts.append((points, owner[piece]))
    found.samples, found.owner = (np.concatenate(column) for column in zip(*parts, strict=True))
    return found


def _area(corners: Floats) -> float:
    sides = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    return 0.5 * float(np.linalg.norm(sides, axis=1).sum())


def _cut(corners: Floats, owner: Ints, longest: float) -> tuple[Floats, Ints]:
    """Triangles halved at their longest edges until none is longer."""
    done = []
    for _ in range(HALVINGS):
        edge = edge_lengths(corners)
        long = edge.max(axis=0) > longest
        done.append((corners[~long], owner[~long]))
        if not long.any():
            break
        turn = (edge[:, long].argmax(axis=0)[:, None] + np.arange(3)) % 3
        a, b, c = corners[np.flatnonzero(long)[:, None], turn].transpose(1, 0, 2)
        middle = 0.5 * (a + b)
        corners = np.concatenate([np.stack([a, middle, c], 1), np.stack([middle, b, c], 1)])
        owner = np.tile(owner[long], 2)
    else:
        done.append((corners, owner))
    all_corners, all_owners = zip(*done, strict=True)
    return np.concatenate(all_corners), np.concatenate(all_owners)


def _least(names: Ints, values: Floats) -> tuple[Ints, Floats]:
    """Each name once, in ascending order, with the least of its values in every column."""
    order = np.argsort(names, kind="stable")
    names, values = names[order], values[order]
    first = np.flatnonzero(np.concatenate([[True], names[1:] != names[:-1]]))[: len(names)]
    return names[first], np.minimum.reduceat(values, first, axis=0) if len(first) else values

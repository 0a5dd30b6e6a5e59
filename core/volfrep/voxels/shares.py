# SPDX-License-Identifier: LGPL-2.1-or-later
"""How much of each voxel of a grid, and of its eight parts, a closed mesh fills.

Lines along z through `LINES` x `LINES` places of each column of parts cross the mesh; where a line
enters and leaves is exact, so that a share is exact along z and sampled along x and y. Each place
is somewhere in its own part of the column, elsewhere from row to row: faces across x and y count
by where they are, not by the nearest line.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..mechanics.elements import CORNERS
from ..mesh.triangle_mesh import TriangleMesh
from ..util.progress import Monitor
from ..util.ragged import spread
from ..util.types import Floats, Ints

#: Lines along each edge of a column of parts.
LINES = 2
#: The golden section, by multiples of which the places of lines are spread.
_GOLDEN = 0.6180339887498949
#: Shares nearer to nothing or all are that.
ROUNDING = 1e-6
#: Triangle times line that are looked at in one go.
_AT_ONCE = 2_000_000


@dataclass(frozen=True, eq=False)
class VoxelGrid:
    """A grid that a mesh fills in part.

    Attributes:
        low: (3,) its lowest corner, mm.
        edge: (3,) of a voxel, mm: nearly the same along all axes, and a whole number of them fits
            the mesh's box.
        shares: (nx, ny, nz) float64 in [0, 1].
        parts: (2 nx, 2 ny, 2 nz) float32 in [0, 1], of halves of voxels along each axis.
    """

    low: Floats
    edge: Floats
    shares: Floats
    parts: NDArray[np.float32]

    def parts_of(self, place: Ints) -> Floats:
        """(k, 8) shares of the parts of voxels at (k, 3) places, in the order of `CORNERS`."""
        at = [tuple((2 * place + corner).T) for corner in CORNERS]
        result: Floats = np.stack([self.parts[one] for one in at], axis=1).astype(float)
        return result


def grid_of(bounds: Floats, voxel: float) -> tuple[Ints, Floats]:
    """(3,) int64 voxels along each axis, and (3,) their edges, mm, of a box (2, 3)."""
    size = bounds[1] - bounds[0]
    count = np.maximum(np.round(size / voxel), 1).astype(np.int64)
    edge: Floats = size / count
    return count, edge


def voxel_grid(mesh: TriangleMesh, voxel: float, monitor: Monitor | None = None) -> VoxelGrid:
    """Fill a grid with a closed mesh.

    Args:
        mesh: closed, wound as seen from outside, mm.
        voxel: the edge that is wanted, mm.
        monitor: asked for a cancel.
    """
    whole, edge = grid_of(mesh.bounds, voxel)
    low = mesh.bounds[0]
    parts = fill_grid(mesh, low, 2 * whole, 0.5 * edge, monitor)
    split = parts.reshape(whole[0], 2, whole[1], 2, whole[2], 2)
    return VoxelGrid(low, edge, split.mean(axis=(1, 3, 5), dtype=float), parts)


def fill_grid(
    mesh: TriangleMesh, low: Floats, count: Ints, edge: Floats, monitor: Monitor | None = None
) -> NDArray[np.float32]:
    """(nx, ny, nz) in [0, 1], how much of each part of a grid a closed mesh fills.

    Args:
        mesh: closed, wound as seen from outside, mm.
        low: (3,) the grid's lowest corner, mm.
        count: (3,) its parts along each axis.
        edge: (3,) of a part, mm.
        monitor: asked for a cancel.
    """
    monitor = monitor or Monitor()
    lines = count[:2] * LINES
    # In spacings of lines along x and y; along z in voxels.
    scale = np.array([LINES / edge[0], LINES / edge[1], 1.0 / edge[2]])
    corners = [(corner - low) * scale for corner in mesh.corners()]
    flat = np.stack(corners, axis=1)[:, :, :2]
    first = np.maximum(np.floor(flat.min(axis=1)), 0).astype(np.int64)
    last = np.minimum(np.floor(flat.max(axis=1)), lines - 1).astype(np.int64)
    wide = np.maximum(last - first + 1, 0)
    number = wide.prod(axis=1)
    rows = np.flatnonzero(number)
    steps = np.arange(1, number.sum() // _AT_ONCE + 2) * _AT_ONCE
    ends = np.searchsorted(np.cumsum(number[rows]), steps)
    size = (*count[:2], count[2] + 2)
    # What begins within a part, and what is filled in all parts above.
    total = np.zeros(int(np.prod(size)))
    begin = 0
    for end in np.minimum(ends + 1, len(rows)):
        monitor.tick()
        part = rows[begin:end]
        begin = int(end)
        if not len(part):
            continue
        chosen = [corner[part] for corner in corners]
        place, height, sense = _crossings(chosen, first[part], wide[part])
        height = np.clip(height, 0.0, count[2])
        level = np.floor(height).astype(np.int64)
        column = place // LINES
        index = (column[:, 0] * count[1] + column[:, 1]) * size[2] + level
        rest = 1.0 - (height - level)
        total += np.bincount(index, sense * rest, len(total))
        total += np.bincount(index + 1, sense * (1.0 - rest), len(total))
    total = total.reshape(size)
    np.cumsum(total, axis=2, out=total)
    parts = (total[:, :, : count[2]] / LINES**2).astype(np.float32)
    del total
    np.clip(parts, 0.0, 1.0, out=parts)
    parts[parts < ROUNDING] = 0.0
    parts[parts > 1.0 - ROUNDING] = 1.0
    return parts


def _crossings(corners: list[Floats], first: Ints, wide: Ints) -> tuple[Ints, Floats, Floats]:
    """(k, 2) which line crosses a triangle, (k,) at what height, (k,) 1 into and -1 out of it."""
    owner, inside = spread(wide.prod(axis=1))
    line = first[owner] + np.stack(np.divmod(inside, wide[owner, 1]), axis=1)
    place = line + _spread(line[:, ::-1])
    p, q, r = (corner[owner, :2] - place for corner in corners)
    shares = np.stack([_cross(q, r), _cross(r, p), _cross(p, q)])
    area = shares.sum(axis=0)
    hit = (area != 0.0) & ((shares * np.sign(area)) >= 0.0).all(axis=0)
    shares, area, owner = shares[:, hit], area[hit], owner[hit]
    heights = np.stack([corner[owner, 2] for corner in corners])
    # Seen from below a triangle turns clockwise where the line enters.
    return line[hit], (shares * heights).sum(axis=0) / area, -np.sign(area)


def _spread(row: Ints) -> Floats:
    """Where in its part of a column a line lies, by the number of its row: from 0.01 to 0.99."""
    result: Floats = 0.01 + 0.98 * np.modf((row + 1) * _GOLDEN)[0]
    return result


def _cross(u: Floats, v: Floats) -> Floats:
    result: Floats = u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]
    return result

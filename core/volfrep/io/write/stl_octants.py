# SPDX-License-Identifier: LGPL-2.1-or-later
"""A laid lattice as a binary STL, octant by octant: the whole is never in memory.

Each kind of octant is prepared once, its facets with their normals; a copy of it in the file costs
an addition. `write_stl` writes the same facets from a mesh, in another order.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from ...lattice.assembly import Layout, in_steps, placed
from ...octants.octant import OctantGrid, frames
from ...octants.octant_mesh import Octant
from ...util.linalg import along
from ...util.progress import Monitor
from .stl import BLOCK_FACETS, FACET, Facets, write_facets

#: A facet of the file whose numbers are moved at once.
_RECORD = np.dtype([("numbers", "V48"), ("attribute", "<u2")])
#: Facets whose heights are all above so many steps of single precision keep their corners in it.
SAFE_STEPS = 4.0
#: A direction, of length 1, in which few vertices of a regular mesh share a place.
GENERIC = np.array([0.26740, 0.53480, 0.80153])


def keeps_corners(layout: Layout, bounds: NDArray[np.float64]) -> bool:
    """Whether no facet can lose a corner when its coordinates become single precision.

    Nor can two vertices become one: they lie farther apart within an octant, and those that are
    not on its faces lie farther from these, and so from the vertices of its neighbours.

    `bounds` are the layout's, (2, 3), mm.
    """
    farthest = float(np.abs(bounds).max())
    if not farthest < np.finfo(np.float32).max:
        return False
    safe = SAFE_STEPS * float(np.spacing(np.float32(farthest)))
    return all(
        _least_height(octant.vertices[octant.triangles]) > safe
        and _keeps_apart(octant, 0.5 * layout.grid.cell_size, safe)
        for octant in layout.octants.values()
        if len(octant.triangles)
    )


def _keeps_apart(octant: Octant, size: float, safe: float) -> bool:
    """Whether vertices are farther than `safe` from each other and from faces they are not on."""
    points = octant.vertices
    inner = points[octant.places == 1]
    if min(inner.min(initial=size), (size - inner).min(initial=size)) <= safe:
        return False
    # Along a line on which few of them share a place, only the next ones can be that near.
    place = along(points, GENERIC)
    order = np.argsort(place)
    points, place = points[order], place[order]
    for ahead in range(1, len(points)):
        near = np.flatnonzero(place[ahead:] - place[:-ahead] <= safe)
        if not len(near):
            break
        gap = points[near + ahead] - points[near]
        if (np.einsum("ij,ij->i", gap, gap) <= safe * safe).any():
            return False
    return True


def write_octants_stl(
    layout: Layout, path: str | os.PathLike[str], monitor: Monitor | None = None
) -> None:
    """Write the surface of a laid lattice.

    Args:
        layout: the octants, of which `keeps_corners` is true.
        path: of the file; an old file stays if anything goes wrong.
        monitor: told the progress, asked for a cancel.

    Raises:
        VolfrepError: there are more facets than the format can count, or the path cannot be
            written.
        Cancelled: when the monitor says so; no file is left behind.
    """
    write_facets(path, layout.triangles, _blocks(layout), monitor)


def _blocks(layout: Layout) -> Iterator[Callable[[], Facets]]:
    grid = layout.grid
    for key, place in zip(grid.keys, layout.places, strict=True):
        octant = layout.octants[key]
        if not len(octant.triangles):
            continue
        steps = in_steps(grid, octant)
        normals = _normals(octant.vertices[octant.triangles])
        corner, sign = frames(place)
        # Octants of one frame together: their facets are the same but for where they lie.
        for frame in np.unique(sign, axis=0):
            own = corner[(sign == frame).all(axis=1)]
            order = octant.triangles if frame.prod() > 0 else octant.triangles[:, ::-1]
            pattern = _Pattern(frame * steps, order.ravel(), (frame * normals).astype(np.float32))
            size = max(1, BLOCK_FACETS // len(order))
            for begin in range(0, len(own), size):
                yield partial(_facets, grid, own[begin : begin + size], pattern)


@dataclass(frozen=True, eq=False)
class _Pattern:
    """An octant in the direction of the grid: what all its copies share.

    Attributes:
        steps: (n, 3) its vertices from the grid corner that it lies about, in whole steps.
        corners: (3 m,) the vertices of its facets.
        normals: (m, 3) float32.
    """

    steps: NDArray[np.float64]
    corners: NDArray[np.int32]
    normals: NDArray[np.float32]


def _facets(grid: OctantGrid, corner: NDArray[np.int64], pattern: _Pattern) -> Facets:
    copies, facets = len(corner), len(pattern.normals)
    vertices = placed(grid, corner[:, None, :], pattern.steps).astype(np.float32)
    numbers = np.empty((copies, facets, 12), np.float32)
    numbers[:, :, :3] = pattern.normals
    taken = np.take(vertices, pattern.corners, axis=1, mode="clip")
    numbers[:, :, 3:] = taken.reshape(copies, facets, 9)
    # As one item a facet: numpy is slow at filling records number by number.
    records = np.zeros((copies, facets), _RECORD)
    records["numbers"] = numbers.view(_RECORD["numbers"])[:, :, 0]
    return records.view(FACET).ravel()


def _normals(corners: NDArray[np.float64]) -> NDArray[np.float64]:
    twice = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals: NDArray[np.float64] = twice / np.linalg.norm(twice, axis=1, keepdims=True)
    return normals


def _least_height(corners: NDArray[np.float64]) -> float:
    """The least height of (m, 3, 3) triangles, mm."""
    sides = corners - np.roll(corners, 1, axis=1)
    longest = np.linalg.norm(sides, axis=2).max(axis=1)
    twice = np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1)
    return float((twice / longest).min())

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
from itertools import chain

import numpy as np
from numpy.typing import NDArray

from ...grid.motion import Motion
from ...lattice.assembly import Layout, facet_blocks, in_steps, placed
from ...octants.octant import OctantGrid
from ...trim.trimmed_surface import TrimmedSurface
from ...util.progress import Monitor
from ...util.types import Floats
from .stl import BLOCK_FACETS, FACET, Facets, facets_at, mesh_blocks, write_facets

#: A facet of the file whose numbers are moved some at once: numpy is slow at filling records number
#: by number.
_RECORD = np.dtype([("normal", "V12"), ("corners", "V36"), ("attribute", "<u2")])


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
    write_facets(path, layout.triangles, _blocks(layout, Motion(np.zeros(3))), monitor)


def write_surface_stl(
    surface: TrimmedSurface, path: str | os.PathLike[str], monitor: Monitor | None = None
) -> None:
    """Write a surface: what is in its mesh, then the octants beside it, as they are laid.

    Args:
        surface: in mm.
        path: of the file; an old file stays if anything goes wrong.
        monitor: told the progress, asked for a cancel.

    Raises:
        VolfrepError: as `write_stl` and `write_octants_stl`.
        Cancelled: when the monitor says so; no file is left behind.
    """
    blocks = mesh_blocks(surface.mesh, path)
    if surface.octants is not None:
        beside, points = surface.octants, surface.octants.laid.points
        blocks = chain(
            blocks,
            _blocks(beside.layout, beside.laid.motion)
            if points is None
            else _moved_blocks(beside.layout, points, path),
        )
    write_facets(path, surface.triangles, blocks, monitor)


def _blocks(layout: Layout, motion: Motion) -> Iterator[Callable[[], Facets]]:
    grid = layout.grid
    for key, place in zip(grid.keys, layout.places, strict=True):
        octant = layout.octants[key]
        if not len(octant.triangles) or not len(place):
            continue
        steps = in_steps(grid, octant)
        normals = _normals(octant.vertices[octant.triangles])
        corner, sign = layout.frames(place)
        # Octants of one frame together: their facets are the same but for where they lie.
        for frame in np.unique(sign, axis=0):
            own = corner[(sign == frame).all(axis=1)]
            order = octant.triangles if frame.prod() > 0 else octant.triangles[:, ::-1]
            directions = motion.turned(frame * normals).astype(np.float32)
            pattern = _Pattern(frame * steps, motion, order.ravel(), directions)
            size = max(1, BLOCK_FACETS // len(order))
            for begin in range(0, len(own), size):
                yield partial(_facets, grid, own[begin : begin + size], pattern)


def _moved_blocks(
    layout: Layout, points: Floats, path: str | os.PathLike[str]
) -> Iterator[Callable[[], Facets]]:
    """Octants whose numbered vertices were moved to (n, 3) points, mm."""
    for corners in facet_blocks(layout):
        for begin in range(0, len(corners), BLOCK_FACETS):
            yield partial(facets_at, points, corners[begin : begin + BLOCK_FACETS], path)


@dataclass(frozen=True, eq=False)
class _Pattern:
    """An octant in the direction of the grid: what all its copies share.

    Attributes:
        steps: (n, 3) its vertices from the grid corner that it lies about, in whole steps.
        motion: of all copies.
        corners: (3 m,) the vertices of its facets.
        normals: (m, 3) float32.
    """

    steps: Floats
    motion: Motion
    corners: NDArray[np.int32]
    normals: NDArray[np.float32]


def _facets(grid: OctantGrid, corner: NDArray[np.int64], pattern: _Pattern) -> Facets:
    copies, facets = len(corner), len(pattern.normals)
    places = placed(grid, corner[:, None, :], pattern.steps)
    vertices = pattern.motion(places).astype(np.float32)
    taken = np.take(vertices, pattern.corners, axis=1, mode="clip").reshape(copies, facets, 9)
    records = np.zeros((copies, facets), _RECORD)
    records["normal"] = pattern.normals.view(_RECORD["normal"])[:, 0]
    records["corners"] = taken.view(_RECORD["corners"])[:, :, 0]
    return records.view(FACET).ravel()


def _normals(corners: NDArray[np.float64]) -> NDArray[np.float64]:
    twice = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals: NDArray[np.float64] = twice / np.linalg.norm(twice, axis=1, keepdims=True)
    return normals

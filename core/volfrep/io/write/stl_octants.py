# SPDX-License-Identifier: LGPL-2.1-or-later
"""A placed lattice as a binary STL, octant by octant: the whole is never in memory.

Each kind of octant is prepared once, its facets with their normals; a copy of it in the file costs
an addition. `write_stl` writes the same facets from a mesh, in another order.

Vertices lie at whole steps of an octant's edge (`octants.octant.STEPS`) and are added exactly, so
that octants which share a vertex write the same float32 without knowing of each other.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from functools import partial
from itertools import chain
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ...grid.motion import Motion
from ...lattice.assembly import Layout, in_steps, numbers, placed
from ...octants.octant import Octant, OctantGrid
from ...util.progress import Monitor
from ...util.types import Bools, Floats, Ints
from .stl import (
    BLOCK_FACETS,
    CALL_FACETS,
    FACET,
    Block,
    Facets,
    blocks_for,
    facets_at,
    write_facets,
)

if TYPE_CHECKING:
    from ...trim.placed_lattice import InnerOctants
    from ...trim.trimmed_surface import TrimmedSurface

#: A facet of the file whose numbers are moved some at once: numpy is slow at filling records number
#: by number.
_RECORD = np.dtype([("normal", "V12"), ("corners", "V36"), ("attribute", "<u2")])


def write_octants_stl(
    layout: Layout, path: str | os.PathLike[str], monitor: Monitor | None = None
) -> None:
    """Write the surface of a placed lattice.

    Args:
        layout: the octants, of which `keeps_corners` is true.
        path: of the file; an old file stays if anything goes wrong.
        monitor: told the progress, asked for a cancel.

    Raises:
        VolfrepError: there are more facets than the format can count, or the path cannot be
            written.
        Cancelled: when the monitor says so; no file is left behind.
    """
    copies = _copies(layout, Motion(np.zeros(3)))
    write_facets(path, layout.triangles, (some.block(some.facets) for some in copies), monitor)


def write_surface_stl(
    surface: TrimmedSurface,
    path: str | os.PathLike[str],
    monitor: Monitor | None = None,
    executor: Executor | None = None,
) -> None:
    """Write a surface: the octants inside, as they are placed, then what is in its mesh.

    An octant inside that is in the mesh leaves its place in the file to facets of the mesh.

    Args:
        surface: in mm.
        path: of the file; an old file stays if anything goes wrong.
        monitor: told the progress, asked for a cancel.
        executor: as of `write_facets`.

    Raises:
        VolfrepError: as `write_stl` and `write_octants_stl`.
        Cancelled: when the monitor says so; no file is left behind.
    """
    with blocks_for(surface.mesh, path, executor) as mesh_blocks:
        rest = mesh_blocks(0)
        inner = places_of(surface)
        if inner is not None:
            filled = filled_places(surface, inner, path)
            octants = (some.block(facets) for some, facets in filled)
            rest = chain(octants, mesh_blocks(left_over(surface, inner)))
        write_facets(path, surface.triangles, rest, monitor, executor)


def places_of(surface: TrimmedSurface) -> InnerOctants | None:
    """The octants that have a place in the file of a surface; None where there are none beside it.

    All sound ones that the wall does not cross; or only those beside the mesh, where this could not
    fill the places of the others.
    """
    beside = surface.octants
    if beside is None:
        return None
    from ...trim.placed_lattice import InnerOctants  # of no use to blocks, and slow to import

    inner = InnerOctants(beside.lattice, beside.lattice.kept.inside).sound
    if np.array_equal(beside.where, inner.where):
        return beside
    return inner if left_over(surface, inner) <= len(surface.mesh.triangles) else beside


def left_over(surface: TrimmedSurface, inner: InnerOctants) -> int:
    """How many triangles of a surface's mesh lie in the places of octants."""
    return inner.layout.triangles + len(surface.mesh.triangles) - surface.triangles


def filled_places(
    surface: TrimmedSurface, inner: InnerOctants, path: str | os.PathLike[str]
) -> Iterator[tuple[Copies, Callable[[], Facets]]]:
    """Octants that have a place in the file, some at a time, and what is to stand there.

    Raises:
        VolfrepError: as `write_stl`.
    """
    beside, mesh, first = surface.octants, surface.mesh, 0
    goes = inner.where if beside is None else inner.where & ~beside.where
    for copies in octant_copies(inner, path):
        gone = goes[tuple(copies.places.T)]
        after = first + int(gone.sum()) * copies.each
        facets = copies.facets
        if after > first:
            facets = partial(copies.without, gone, mesh.vertices, mesh.triangles[first:after], path)
        yield copies, facets
        first = after


@dataclass(frozen=True, eq=False)
class Copies:
    """Octants of one kind and frame that follow each other in a file.

    Attributes:
        places: (k, 3) where they lie.
        each: facets of each.
        facets: makes those of all of them.
        goes: whether any process may make them, as of `Block`.
    """

    places: Ints
    each: int
    facets: Callable[[], Facets]
    goes: bool = False

    def block(self, facets: Callable[[], Facets]) -> Block:
        """In the file, as they are or with others in their places."""
        return Block(len(self.places) * self.each, facets, self.goes and facets is self.facets)

    def without(
        self, gone: Bools, vertices: Floats, triangles: NDArray[np.int32],
        path: str | os.PathLike[str],
    ) -> Facets:  # fmt: skip
        """The facets, with as many triangles of a mesh in place of some of the octants."""
        result = self.facets()
        others = facets_at(vertices, triangles, path)
        result.reshape(-1, self.each)[gone] = others.reshape(-1, self.each)
        return result


def octant_copies(inner: InnerOctants, path: str | os.PathLike[str]) -> Iterator[Copies]:
    """Octants inside a wall, some at a time, for the file at the path."""
    points = inner.lattice.points
    if points is None:
        return _copies(inner.layout, inner.lattice.motion)
    return _copy_deformed(inner.layout, points, path)


def _copies(layout: Layout, motion: Motion) -> Iterator[Copies]:
    grid = layout.grid
    where = replace(grid, kind=grid.kind[:0], keys=[])  # all that places them: little to be sent
    for key, place in zip(grid.keys, layout.places, strict=True):
        octant = layout.octants[key]
        if not len(octant.triangles) or not len(place):
            continue
        steps = in_steps(grid, octant)
        normals = _normals(octant.vertices[octant.triangles])
        # Octants of one frame together, which parity tells: their facets are the same but for where
        # they lie.
        parity = 4 * (place[:, 0] & 1) + 2 * (place[:, 1] & 1) + (place[:, 2] & 1)
        for one in np.flatnonzero(np.bincount(parity)):
            at = place[parity == one]
            frame = layout.frames(at[:1])[1][0]
            order = octant.triangles if frame.prod() > 0 else octant.triangles[:, ::-1]
            directions = motion.turned(frame * normals).astype(np.float32)
            pattern = _Pattern(frame * steps, motion, order.ravel(), directions)
            size = max(1, CALL_FACETS // len(order))
            for begin in range(0, len(at), size):
                part = at[begin : begin + size]
                some = partial(_facets, where, layout.frames(part)[0], pattern)
                yield Copies(part, len(order), some, goes=True)


def _copy_deformed(
    layout: Layout, points: Floats, path: str | os.PathLike[str]
) -> Iterator[Copies]:
    """Octants whose numbered vertices were moved to (n, 3) points, mm."""

    def facets(octant: Octant, order: NDArray[np.int32], at: Ints) -> Facets:
        corners = np.take(numbers(layout, octant, at), order, axis=1, mode="clip")
        return facets_at(points, corners.reshape(-1, 3), path)

    for key, place in zip(layout.grid.keys, layout.places, strict=True):
        octant = layout.octants[key]
        if not len(octant.triangles) or not len(place):
            continue
        each = len(octant.triangles)
        size = max(1, BLOCK_FACETS // each)
        ahead = layout.frames(place)[1].prod(axis=1) > 0
        for chosen, order in ((ahead, octant.triangles), (~ahead, octant.triangles[:, ::-1])):
            own = place[chosen]
            for begin in range(0, len(own), size):
                at = own[begin : begin + size]
                yield Copies(at, each, partial(facets, octant, order.ravel(), at))


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
    facets = len(pattern.normals)
    records = np.zeros((len(corner), facets), _RECORD)
    records["normal"] = pattern.normals.view(_RECORD["normal"])[:, 0]
    size = max(1, BLOCK_FACETS // facets)
    for begin in range(0, len(corner), size):
        places = placed(grid, corner[begin : begin + size, None, :], pattern.steps)
        vertices = pattern.motion(places).astype(np.float32)
        taken = np.take(vertices, pattern.corners, axis=1, mode="clip").reshape(-1, facets, 9)
        records["corners"][begin : begin + size] = taken.view(_RECORD["corners"])[:, :, 0]
    return records.view(FACET).ravel()


def _normals(corners: NDArray[np.float64]) -> NDArray[np.float64]:
    twice = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals: NDArray[np.float64] = twice / np.linalg.norm(twice, axis=1, keepdims=True)
    return normals

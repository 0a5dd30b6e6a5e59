# SPDX-License-Identifier: LGPL-2.1-or-later
"""A surface as files want it whose triangles name vertices by their numbers: block by block.

Octants beside the mesh come first, numbered as they are placed, so that none of their corners has
to be looked up; those vertices that the mesh shares with them are the octants'.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from ...grid.motion import Motion
from ...lattice.assembly import Layout, coordinate_blocks, facet_blocks
from ...mesh.precision import BLOCK_ROWS, decimal_step, refuse_lost_corners, rounded
from ...mesh.precision import single_precision as in_single
from ...mesh.triangle_mesh import TriangleMesh
from ...trim.trimmed_surface import TrimmedSurface
from ...util.types import Floats, Ints

Number = TypeVar("Number", np.float64, np.int32, np.int64)


@dataclass(frozen=True, eq=False)
class Numbered:
    """A surface whose vertices are numbered from 0 on.

    Attributes:
        mesh: a part of it, its vertices after those of the octants, its triangles of all.
        octants: placed, with a number for each vertex; None for none.
        motion: of the octants.
        deformed: where the vertices of octants are that do not keep their places: points (n, 3),
            mm, and which of them theirs are; None where they keep them but for the motion.
        bounds: (2, 3) of the whole, mm.
    """

    mesh: TriangleMesh
    octants: Layout | None
    motion: Motion
    bounds: Floats
    deformed: tuple[Floats, Ints] | None = None

    @property
    def vertices(self) -> int:
        """How many there are."""
        return len(self.mesh.vertices) + (0 if self.octants is None else self.octants.count)

    @property
    def triangles(self) -> int:
        """How many there are."""
        own = len(self.mesh.triangles)
        return own + (0 if self.octants is None else self.octants.triangles)

    def points(self) -> Iterator[Floats]:
        """(k, 3) vertices in their order, mm."""
        if self.deformed is not None:
            points, rows = self.deformed
            for some in _blocks(rows):
                yield points[some]
        elif self.octants is not None:
            for block in coordinate_blocks(self.octants):
                yield self.motion(block)
        yield from _blocks(self.mesh.vertices)

    def decimals(self) -> Iterator[Floats]:
        """The same, rounded to the step of single precision, so that their text is short."""
        step = decimal_step(self.bounds)
        return (rounded(block, step) for block in self.points())

    def corners(self) -> Iterator[NDArray[np.int32]]:
        """(k, 3) numbers of triangles' vertices."""
        if self.octants is not None:
            yield from facet_blocks(self.octants)
        yield from _blocks(self.mesh.triangles)


def number_vertices(
    surface: TrimmedSurface | TriangleMesh, path: str | os.PathLike[str], *, as_text: bool
) -> Numbered:
    """The vertices and triangles of a surface, for a file of single precision.

    Args:
        surface: in mm.
        path: of the file, to be named.
        as_text: whether its numbers are rounded to decimals.

    Raises:
        VolfrepError: it is empty, holds coordinates that float32 cannot, or has triangles that
            lose a corner in float32.
    """
    given = TrimmedSurface(surface) if isinstance(surface, TriangleMesh) else surface
    mesh, inner = given.mesh, given.octants
    if inner is None or len(mesh.triangles):
        own = in_single(mesh, path)
        if as_text:
            own = rounded(mesh.vertices, decimal_step(given.bounds)).astype(np.float32)
        refuse_lost_corners(own, mesh.triangles, path)
    if inner is None:
        return Numbered(mesh, None, Motion(np.zeros(3)), mesh.bounds)
    layout, theirs = inner.numbered_alone
    row = given.rim_rows
    number = np.full(len(mesh.vertices), -1, np.int64)
    number[row] = theirs
    fresh = number < 0
    number[fresh] = layout.count + np.arange(int(fresh.sum()))
    rest = TriangleMesh(mesh.vertices[fresh], number.astype(np.int32)[mesh.triangles])
    return Numbered(rest, layout, inner.lattice.motion, given.bounds, inner.deformed_vertices)


def _blocks(rows: NDArray[Number]) -> Iterator[NDArray[Number]]:
    for start in range(0, len(rows), BLOCK_ROWS):
        yield rows[start : start + BLOCK_ROWS]

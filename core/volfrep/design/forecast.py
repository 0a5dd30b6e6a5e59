# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a job will come to, known before any work starts: cells, triangles, memory, file, time.

Good to about a third for triangles and a factor of two for the rest: enough to see whether a job
takes a second or an hour. The constants were measured on two cores of 2020s servers.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..mesh.triangle_mesh import TriangleMesh
from ..util.types import Floats
from .cells import UnitCell
from .networks import CellNetwork, RandomNetwork
from .spec import LatticeSpec

#: At a joint a strut's surface is buried in the others up to so many radii from the node.
BURIED = 1.4
#: The least share of the solid that is left within a skin, where twice the skin exceeds it.
LEAST_INSIDE = 0.05
#: Facets are no longer than this, in radii: thin struts are sampled finely, so that none is lost.
LONGEST_EDGE = 0.85
#: Triangles that the cut leaves on each area of a facet's edge squared of the wall.
WALL_TRIANGLES = 1.1
#: Fixed cost, s; cost per (wall area / thickness squared), s; per triangle of a part, s; and of a
#: block, s.
SECONDS = 0.5
SECONDS_PER_WALL = 2.5e-4
SECONDS_PER_TRIANGLE = 4.5e-6
SECONDS_PER_BLOCK_TRIANGLE = 4e-7
#: Struts for each point of a random network once short ones are drawn together, and facets of each.
STRUTS_PER_POINT = {"voronoi": 9.0, "delaunay": 7.5}
TRIANGLES_PER_STRUT = 110.0
SECONDS_PER_NETWORK_TRIANGLE = 1e-5
#: Facets on one side of a wall in a cell, for each facet along its edge squared.
TRIANGLES_OF_SIDE = 8.0
#: Bytes at the peak: of every job, and for each triangle of a part and of a block.
BYTES = 1.5e8
BYTES_PER_TRIANGLE = 200.0
BYTES_PER_BLOCK_TRIANGLE = 150.0
#: How thick the layer of octants at the wall is, in units of L; bytes for each of its triangles,
#: where the others go straight into the file.
CUT_LAYER = 0.85
BYTES_PER_CUT_TRIANGLE = 220.0
#: Bytes that a cell of a block takes whose octants are written as they are laid.
BYTES_PER_STREAMED_CELL = 5000
#: Bytes of a triangle in a binary STL file.
STL_BYTES = 50.0


@dataclass(frozen=True)
class Forecast:
    """What a job will come to, about.

    Attributes:
        cells: active unit cells.
        struts: of the lattice.
        triangles: of the mesh.
        memory_gb: at the peak.
        stl_mb: size of a binary STL file.
        seconds: on two cores.
    """

    cells: int
    struts: int
    triangles: int
    memory_gb: float
    stl_mb: float
    seconds: float

    @property
    def of_axes(self) -> str:
        """Where nothing is meshed: the struts, and no triangles, memory and file of a mesh."""
        struts = f", {_rounded(self.struts)} struts" if self.struts else ""
        return f"about {_rounded(self.cells)} cells{struts}"

    def __str__(self) -> str:
        return (
            f"{self.of_axes}, {_rounded(self.triangles)} triangles, "
            f"{_rounded(self.memory_gb)} GB of memory, an STL file of {_rounded(self.stl_mb)} MB "
            f"and {_duration(self.seconds)}"
        )


def forecast_fill(solid: TriangleMesh, spec: LatticeSpec, *, streamed: bool = False) -> Forecast:
    """What `pipeline.fill` will come to; takes no longer than to add up the solid's triangles.

    `streamed`: where the result goes straight into an STL file.
    """
    volume = abs(solid.volume)
    area = solid.area
    inside = max(volume - area * spec.shell, LEAST_INSIDE * volume)
    if spec.network is not None:
        return _forecast_network(solid, spec, inside)
    one, edge = cell_volume(spec), spec.cell_size / spec.facets_along_cell
    triangles = expected_triangles(spec, inside) + WALL_TRIANGLES * area / edge**2
    if spec.output == "domain":
        triangles = area / max(spec.shell, edge) ** 2
    triangles += len(solid.triangles)
    wall = SECONDS_PER_WALL * area / spec.shell**2 if spec.shell > 0 else 0.0
    # A cell that the wall merely touches is active too: half a cell on either side of it.
    cells = (inside + 0.5 * area * spec.cell_size) / one
    grid = np.ceil(np.ptp(solid.bounds, axis=0) / spec.cell_size - 1e-6).prod()
    cells = min(cells, float(grid) * spec.cell_size**3 / one)
    seconds = SECONDS + wall + SECONDS_PER_TRIANGLE * triangles
    held = BYTES_PER_TRIANGLE * triangles
    if streamed and spec.streams:
        at_wall = expected_triangles(spec, min(inside, CUT_LAYER * spec.cell_size * area))
        held = min(held, BYTES_PER_CUT_TRIANGLE * at_wall)
    return _forecast(cells, _shares_of(spec), triangles, held / triangles, seconds)


def _forecast_network(solid: TriangleMesh, spec: LatticeSpec, inside: float) -> Forecast:
    wanted = spec.network
    if isinstance(wanted, RandomNetwork):
        points = wanted.points or max(1.0, inside / spec.cell_size**3)
        struts = points * STRUTS_PER_POINT[wanted.kind]
    elif isinstance(wanted, CellNetwork):
        cell = spec.unit_cell()
        edges = spec.cell_size * np.array(cell.edges)
        # A cell that the wall merely touches is there too.
        reached = inside + 0.5 * solid.area * float(edges.mean())
        points = max(1.0, reached / float(edges.prod()))
        struts = points * float(strut_shares(cell).sum())
    else:
        assert wanted is not None
        points, struts = 1.0, float(len(wanted.struts))
    triangles = TRIANGLES_PER_STRUT * struts + len(solid.triangles)
    wall = SECONDS_PER_WALL * solid.area / spec.shell**2 if spec.shell > 0 else 0.0
    seconds = SECONDS + wall + SECONDS_PER_NETWORK_TRIANGLE * triangles
    share = np.array([struts / points])
    return _forecast(points, share, triangles, BYTES_PER_TRIANGLE, seconds)


def forecast_block(spec: LatticeSpec, count: Sequence[int], *, streamed: bool = False) -> Forecast:
    """What `blocks.block` will come to, for so many cells along x, y, z.

    `streamed`: what `blocks.write_block_stl` will.
    """
    layers = np.asarray(count, np.float64)
    cells = float(layers.prod())
    # Outside the block there is nobody to share a strut with.
    shares = _shares_of(spec, 0.5 * (1.0 + 1.0 / layers))
    triangles = cells * _triangles_of_cell(spec, shares)
    in_pieces = streamed and not spec.is_graded
    seconds = SECONDS + SECONDS_PER_BLOCK_TRIANGLE * triangles * (0.5 if in_pieces else 1.0)
    if in_pieces:
        per_triangle = BYTES_PER_STREAMED_CELL * cells / triangles
    else:
        per_triangle = BYTES_PER_BLOCK_TRIANGLE
    return _forecast(cells, shares, triangles, per_triangle, seconds)


def expected_triangles(spec: LatticeSpec, volume: float) -> float:
    """Triangles of the lattice in a volume of mm3, about."""
    return volume / cell_volume(spec) * _triangles_of_cell(spec, _shares_of(spec))


def _shares_of(spec: LatticeSpec, on_face: Floats | float = 0.5) -> Floats:
    """`strut_shares` of a lattice; of walls, which have no struts, nothing."""
    return strut_shares(spec.unit_cell(), on_face) if spec.surface is None else np.zeros(0)


def _triangles_of_cell(spec: LatticeSpec, shares: Floats) -> float:
    if spec.surface is not None:
        return TRIANGLES_OF_SIDE * (1 + spec.wall.is_sheet) * spec.facets_along_cell**2
    return float(_facets(spec) @ shares)


def _facets(spec: LatticeSpec) -> Floats:
    """(m,) equilateral facets on the surface of each strut of a cell, between its joints."""
    cell, radius = spec.unit_cell(), spec.template_radius
    ends = cell.nodes[cell.struts]
    length = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1) * spec.cell_size
    bare = np.maximum(length - 2.0 * BURIED * radius, 0.3 * length)
    edge = min(spec.cell_size / spec.facets_along_cell, LONGEST_EDGE * radius)
    facets: Floats = bare * (2.0 * np.pi * radius / (np.sqrt(3.0) / 4.0 * edge**2))
    return facets


def strut_shares(cell: UnitCell, on_face: Floats | float = 0.5) -> Floats:
    """(m,) how much of each strut belongs to one cell: others share it on a face or an edge.

    `on_face` is the share of what lies on a face across x, y and z.
    """
    ends = cell.nodes[cell.struts]
    lies = (np.abs(ends - np.round(ends)) < 1e-9).all(axis=1) & (ends[:, 0] == ends[:, 1])
    shares: Floats = np.where(lies, on_face, 1.0).prod(axis=1)
    return shares


def cell_volume(spec: LatticeSpec) -> float:
    """Mean volume of a cell, mm3.

    The grading stretches cells by lambda + s lambda', whose mean is lambda at the far end.
    """
    stretch = 1.0 if spec.size_grading is None else float(spec.size_grading.profile(np.ones(1))[0])
    return spec.cell_size**3 * stretch


def _forecast(
    cells: float, shares: Floats, triangles: float, bytes_per_triangle: float, seconds: float
) -> Forecast:
    return Forecast(
        cells=max(1, round(cells)),
        struts=max(1, round(cells * float(shares.sum()))) if len(shares) else 0,
        triangles=round(triangles),
        memory_gb=(BYTES + bytes_per_triangle * triangles) / 1e9,
        stl_mb=STL_BYTES * triangles / 1e6,
        seconds=seconds,
    )


def _rounded(value: float) -> str:
    """Two significant figures, written out."""
    return f"{float(f'{value:.2g}'):,.15g}"


def _duration(seconds: float) -> str:
    if seconds < 90.0:
        return f"{_rounded(max(1.0, seconds))} s"
    if seconds < 5400.0:
        return f"{_rounded(seconds / 60.0)} min"
    return f"{_rounded(seconds / 3600.0)} h"

# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a job will come to, known before any work starts: cells, triangles, memory, file, time.

Good to about a third for triangles and a factor of two for the rest: enough to see whether a job
takes a second or an hour. What each triangle, strut and bend takes is in `costs`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from ..mesh.triangle_mesh import TriangleMesh
from ..spatial.even_points import even_points
from ..util.linalg import frame_about, times
from ..util.numbers import duration, round_off
from ..util.types import Floats
from . import costs
from .spec import LatticeSpec

#: How far a depth is changed to see how much room that leaves: a share of it, or of V / A.
AROUND, AT_LEAST = 0.25, 0.05
#: Lines into the solid by which narrow rooms are told; rooms as wide as the skin are not narrow,
#: and the cubes are no finer than for a room of the least width (thicknesses).
NARROW_LINES = 2048
NARROWEST = 0.05
#: About so many points of a solid tell what lies within its skin; in its box there are no more than
#: this power of 2. Of ten parts, each with a thin skin and one of 42 % of 3 V / A, triangles came
#: out within a third in 18 of 20 runs (0.40 to 1.29 told over made).
DEPTH_POINTS = 1024
MOST_POINTS = 14
#: Points by which the cells about an axis or a centre are counted (a power of 2), and how wide a
#: cell is at least that holds a lattice, in radii.
MAP_POINTS = 12
LEAST_WIDTH = 4.0


@dataclass(frozen=True)
class Forecast:
    """What a job will come to, about.

    Attributes:
        cells: active unit cells; 0 for a graph, which has none.
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
        return _counted(self.cells, self.struts)

    def __str__(self) -> str:
        return (
            f"{self.of_axes}, {round_off(self.triangles)} triangles, "
            f"{round_off(self.memory_gb)} GB of memory, an STL file of {round_off(self.stl_mb)} MB "
            f"and {duration(self.seconds)}"
        )


@dataclass(frozen=True)
class BeamForecast:
    """What a lattice as beams in a 3MF file will come to, about.

    Attributes:
        cells: active unit cells; 0 for a graph.
        struts: of the lattice.
        memory_gb: at the peak.
        file_mb: size of the file.
        seconds: on two cores.
    """

    cells: int
    struts: int
    memory_gb: float
    file_mb: float
    seconds: float

    def __str__(self) -> str:
        return (
            f"{_counted(self.cells, self.struts)}, {round_off(self.memory_gb)} GB of memory, a 3MF "
            f"file of {round_off(self.file_mb)} MB and {duration(self.seconds)}"
        )


def _counted(cells: int, struts: int) -> str:
    counts = {"cells": cells, "struts": struts}
    parts = (f"{round_off(count)} {what}" for what, count in counts.items() if count)
    return f"about {', '.join(parts)}"


def forecast_fill(solid: TriangleMesh, spec: LatticeSpec, *, streamed: bool = False) -> Forecast:
    """What `pipeline.fill` will come to; takes no longer than to look at the solid's edges.

    `streamed`: where the result goes straight into an STL file.
    """
    volume = abs(solid.volume)
    area = solid.area
    skin = 0.0 if spec.skin is None else spec.skin.rough_volume(solid)
    depth = skin / area
    inside = volume * (share_deeper(solid, depth) if skin else 1.0)
    graph = spec.kind.graph_in(inside, area)
    if graph is not None:
        return _forecast_graph(solid, spec, *graph)
    one, edge = cell_volume(spec), spec.cell_size / spec.facets_along_cell
    wall = wall_area(solid, depth)
    dense = _density(solid, spec)
    shelling = _skin_work(solid, spec)
    triangles = len(solid.triangles) + shelling.facets * wall / area
    cut = dense * costs.SEAM_TRIANGLES * expected_triangles(spec, wall * edge)
    if spec.output != "domain":
        triangles += dense * expected_triangles(spec, inside) + cut
    # A cell that the wall merely touches is active too: more than half a cell beyond it.
    cells = dense * (inside + 0.62 * wall * spec.cell_size) / one
    if spec.cell_map is None:
        grid = np.ceil(np.ptp(solid.bounds, axis=0) / spec.cell_size - 1e-6).prod()
        cells = min(cells, float(grid) * spec.cell_size**3 / one)
    seconds = costs.SECONDS + shelling.seconds + costs.SECONDS_PER_TRIANGLE * triangles
    if spec.output != "domain":
        # Octants that the wall crosses are cut whole, with what they have beyond it; those that it
        # does not come near are placed and written, and no more.
        layer, far = 0.5 * costs.CUT_LAYER * spec.cell_size, 0.0
        if spec.streams:
            far = min(volume * share_deeper(solid, depth + layer), inside)
        at_wall = dense * expected_triangles(spec, inside + layer * wall - far)
        seconds += costs.SECONDS_PER_CUT_TRIANGLE * at_wall
        # Within a part all cells are there: those of the octants that are not lie outside.
        seconds += spec.kind.meshing_seconds(1.0)
    held = costs.BYTES_PER_TRIANGLE * triangles
    if spec.streams:
        beyond = volume * share_deeper(solid, depth + costs.LEFT_LAYER * spec.cell_size)
        cut += dense * expected_triangles(spec, max(inside - beyond, 0.0))
        each = costs.BYTES_PER_PLACED_TRIANGLE if spec.varies else 0.0
        each += 0.0 if streamed else costs.BYTES_PER_MESH_TRIANGLE
        beside = costs.BYTES_OF_GROUPS + each * triangles
        held = min(held, costs.BYTES_PER_CUT_TRIANGLE * cut + beside)
    held = max(held, shelling.held)
    held += costs.BYTES_GRADED if spec.is_graded else 0.0
    return _forecast(cells, spec.kind.strut_shares(), triangles, held / triangles, seconds)


def forecast_fill_beams(solid: TriangleMesh, spec: LatticeSpec) -> BeamForecast:
    """What `infill.Infill.beams` and its file will come to; as quick as `forecast_fill`."""
    told = forecast_fill(solid, spec)
    seconds = costs.SECONDS + _skin_work(solid, spec).seconds
    seconds += costs.SECONDS_PER_BEAM * told.struts
    held = costs.BYTES_OF_A_PART + costs.BYTES_PER_BEAM * told.struts
    return _forecast_beams(told, held, seconds)


@dataclass(frozen=True)
class _SkinWork:
    """What a skin's wall takes: seconds on two cores, bytes, facets of the whole wall."""

    seconds: float
    held: float
    facets: float


def _skin_work(solid: TriangleMesh, spec: LatticeSpec) -> _SkinWork:
    skin = spec.skin
    if skin is not None and skin.is_even and not skin.open_faces:
        from .skins.plane_faces import few_plane_faces  # of no use to blocks, and slow to import

        faces = few_plane_faces(solid, skin.thickness)
        if faces is not None:
            each = costs.SECONDS_PER_BODY, costs.BYTES_PER_BODY, costs.FACETS_PER_BODY
            return _SkinWork(*(faces.bodies * one for one in each))
    bends, narrow = skin_bends(solid, spec), narrow_gaps(solid, spec)
    return _SkinWork(
        costs.SECONDS_PER_BEND * bends + costs.SECONDS_PER_NARROW * narrow,
        costs.BYTES_PER_BEND * bends + costs.BYTES_PER_NARROW * narrow,
        costs.FACETS_PER_BEND * bends,
    )


def share_deeper(solid: TriangleMesh, depth: float) -> float:
    """The share of a solid that lies deeper below its surface than a depth in mm; never nothing.

    By points spread evenly, whose depths are kept: another depth asks about the same ones.
    """
    depths = _depths(solid)
    deeper = len(depths) - int(np.searchsorted(depths, depth))
    return max(float(deeper), 0.5) / max(len(depths), 1)


def wall_area(solid: TriangleMesh, depth: float) -> float:
    """About the area of the offset surface at a depth in mm: how fast the room within it grows."""
    volume, area = abs(solid.volume), solid.area
    if depth <= 0.0:
        return area
    far = max(AROUND * depth, AT_LEAST * volume / area)
    low, high = max(depth - far, 0.0), depth + far
    return volume * (share_deeper(solid, low) - share_deeper(solid, high)) / (high - low)


@lru_cache(maxsize=4)
def _depths(solid: TriangleMesh) -> Floats:
    """How deep points lie that are spread evenly over a solid, mm; ascending."""
    from ..spatial.proximity import closest_points  # of no use to blocks, and slow to import
    from ..spatial.rays import points_within

    low, high = solid.bounds
    # As many in the box as give about the wanted number inside.
    power = np.log2(DEPTH_POINTS * float((high - low).prod()) / max(abs(solid.volume), 1e-300))
    points = points_within(solid, round(min(max(power, 1.0), MOST_POINTS)))
    result: Floats = np.sort(closest_points(solid, points)[1])
    return result


def skin_bends(solid: TriangleMesh, spec: LatticeSpec) -> float:
    """How much a surface bends along its edges, in angles times lengths over the skin's thickness.

    That is what the wall of the skin takes to be found, and its facets: where the surface is flat
    large cubes do. 0 without a skin.
    """
    from .skins.plane_faces import bending  # of no use to blocks, and slow to import

    return bending(solid) / spec.shell if spec.shell > 0.0 else 0.0


def narrow_gaps(solid: TriangleMesh, spec: LatticeSpec) -> float:
    """How much room narrower than the skin there is between two skins, in squares of its width.

    The area of the solid's surface over the square of the room's width below it, beyond what a
    room as wide as the skin has: as many cubes as wide as the room would lie along it. Told by
    `NARROW_LINES` straight into the solid. 0 without a skin.
    """
    return _narrow_gaps(solid, spec.shell) if spec.shell > 0.0 else 0.0


@lru_cache(maxsize=8)
def _narrow_gaps(solid: TriangleMesh, skin: float) -> float:
    """As `narrow_gaps`, of a skin of one thickness, mm."""
    from ..spatial.rays import segment_crossings  # as above

    a, b, c = solid.corners()
    normal = np.cross(b - a, c - a)
    twice = np.linalg.norm(normal, axis=1)
    even = even_points(3, NARROW_LINES.bit_length() - 1)
    pick = np.searchsorted(np.cumsum(twice), even[:, 0] * twice.sum()).clip(0, len(twice) - 1)
    # Evenly over a triangle: the square root goes from its first corner to the far side.
    far, along = np.sqrt(even[:, 1:2]), even[:, 2:]
    a, b, c = a[pick], b[pick], c[pick]
    start = (1.0 - far) * a + far * ((1.0 - along) * b + along * c)
    way = -3.0 * skin * normal[pick] / np.maximum(twice[pick], 1e-300)[:, None]
    line, share, sense = segment_crossings(solid, start + 1e-3 * way, start + way)
    leaves = sense > 0
    thick = np.full(len(start), np.inf)
    np.minimum.at(thick, line[leaves], 3.0 * (1e-3 + (1.0 - 1e-3) * share[leaves]))
    gap = thick - 2.0
    narrow = np.maximum(gap[(gap > 0.0) & (gap < 1.0)], NARROWEST)
    return float(0.5 * twice.sum() / skin**2 * (narrow**-2.0 - 1.0).sum() / len(start))


def _density(solid: TriangleMesh, spec: LatticeSpec) -> float:
    """How many cells there are for each volume of a cell: about an axis or a centre it varies."""
    cells = spec.cell_map
    if cells is None:
        return 1.0
    from ..spatial.rays import points_within  # as above

    low, high = solid.bounds
    middle = 0.5 * (low + high)
    points = points_within(solid, MAP_POINTS)
    if not len(points):
        return 1.0
    centre = middle if cells.centre is None else np.array(cells.centre, float)
    frame = frame_about(np.array(cells.axis, float))
    if spec.orientation is not None:
        frame = times(spec.orientation.matrix, frame)
    size = spec.cell_size
    scale = size * cells.cells_around(size, solid.bounds, centre, frame) / (2.0 * np.pi)
    local = times(points - centre, frame)
    least = LEAST_WIDTH * spec.template_radius / size
    across = np.hypot(local[:, 0], local[:, 1])
    if cells.kind == "cylindrical":
        # A cell is narrowest at its inner side.
        usable = (across - 0.5 * size) / scale >= least
        count = scale / np.maximum(across, 1e-9 * size)
    else:
        out = np.hypot(across, local[:, 2])
        inner = np.maximum(out - 0.5 * size, 0.0)
        angle = np.arctan2(across, np.abs(local[:, 2])) - 0.5 * size / scale
        usable = inner * np.sin(np.maximum(angle, 0.0)) / scale >= least
        count = scale**2 / np.maximum(out * across, 1e-9 * size**2)
    return float(np.where(usable, count, 0.0).mean())


def _forecast_graph(
    solid: TriangleMesh, spec: LatticeSpec, points: float, struts: float
) -> Forecast:
    triangles = costs.TRIANGLES_PER_STRUT * struts + len(solid.triangles)
    shelling = _skin_work(solid, spec)
    seconds = costs.SECONDS + shelling.seconds + costs.SECONDS_PER_NETWORK_TRIANGLE * triangles
    share = np.array([struts / points])
    held = max(costs.BYTES_PER_NETWORK_TRIANGLE * triangles, shelling.held)
    found = _forecast(points, share, triangles, held / triangles, seconds)
    return replace(found, cells=0)


def forecast_block(spec: LatticeSpec, count: Sequence[int], *, streamed: bool = False) -> Forecast:
    """What `blocks.block` will come to, for so many cells along x, y, z.

    `streamed`: what `blocks.write_block_stl` will.
    """
    layers = np.asarray(count, np.float64)
    cells = float(layers.prod())
    # Outside the block there is nobody to share a strut with.
    shares = spec.kind.strut_shares(0.5 * (1.0 + 1.0 / layers))
    triangles = cells * spec.kind.triangles_of_cell(shares)
    in_pieces = streamed and not spec.is_graded
    each = costs.SECONDS_PER_BLOCK_TRIANGLE
    if in_pieces:
        each = costs.SECONDS_PER_STREAMED_TRIANGLE
    seconds = costs.SECONDS + each * triangles
    seconds += spec.kind.meshing_seconds(float(np.minimum(layers, 2.0).prod()))
    held = costs.BYTES_PER_STREAMED_CELL * cells
    if not in_pieces:
        held = costs.BYTES_PER_BLOCK_TRIANGLE * triangles
    held = max(held, spec.kind.meshing_bytes)
    if spec.target is not None:
        seconds, held = seconds + costs.SECONDS_FOR_TARGET, held + costs.BYTES_FOR_TARGET
    return _forecast(cells, shares, triangles, held / triangles, seconds)


def forecast_block_beams(spec: LatticeSpec, count: Sequence[int]) -> BeamForecast:
    """What `beam_part.block_beams` and its file will come to, for so many cells along x, y, z."""
    told = forecast_block(spec, count)
    seconds = costs.SECONDS + costs.SECONDS_PER_BLOCK_BEAM * told.struts
    return _forecast_beams(told, costs.BYTES_PER_STRUT * told.struts, seconds)


def _forecast_beams(told: Forecast, held: float, seconds: float) -> BeamForecast:
    return BeamForecast(
        cells=told.cells,
        struts=told.struts,
        memory_gb=(costs.BYTES + held) / 1e9,
        file_mb=costs.FILE_BYTES_PER_BEAM * told.struts / 1e6,
        seconds=seconds,
    )


def expected_triangles(spec: LatticeSpec, volume: float) -> float:
    """Triangles of the lattice in a volume of mm3, about."""
    return volume / cell_volume(spec) * spec.kind.triangles_of_cell(spec.kind.strut_shares())


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
        memory_gb=(costs.BYTES + bytes_per_triangle * triangles) / 1e9,
        stl_mb=costs.FILE_BYTES["stl"] * triangles / 1e6,
        seconds=seconds,
    )

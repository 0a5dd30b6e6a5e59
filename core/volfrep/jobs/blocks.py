# SPDX-License-Identifier: LGPL-2.1-or-later
"""Free-standing blocks of whole cells, with full round struts on their outside."""

from __future__ import annotations

import math
import os
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ..design.forecast import BYTES_PER_STREAMED_CELL, refuse_crossing
from ..design.graphs import StretchedCells
from ..design.memory_guard import BYTES_PER_STRUT, refuse_block, refuse_expected
from ..design.spec import LatticeSpec
from ..grid.cell_grid import CellGrid
from ..grid.placement import Placement, block_placement, graded_wireframe
from ..grid.sizes import mapped_volume
from ..grid.strut_graph import CellGraph, Wireframe, cell_graph
from ..io.write.stl import write_stl
from ..io.write.stl_octants import write_octants_stl
from ..lattice.assembly import Layout, facets, lay_out
from ..lattice.certificate import agree_on_faces, certify, keeps_corners
from ..lattice.padded_grid import keeps_places, vertices_of
from ..mesh.quality import Quality, measure
from ..mesh.triangle_mesh import TriangleMesh
from ..octants.octant import octant_grid
from ..octants.octant_mesh import mesh_octants, octant_spec
from ..octants.octant_spec import OctantSpec
from ..reports.report import Report, with_warnings
from ..reports.result import NOTHING_REMOVED, Result, report_of
from ..tpms.octants import closed_octants, octants_of_cells
from ..trim.finish import finish, refuse_no_solid
from ..trim.trimmed_surface import TrimmedSurface
from ..util.errors import VolfrepError
from ..util.numbers import whole
from ..util.progress import Monitor, ProgressCallback, peak_memory_mb
from .finer import until_sound
from .octant_guard import deviation_warnings, refuse_solid_cells, refuse_too_large
from .target_report import report_target
from .tpms.octants import keeps_places as keeps_wall_places
from .tpms.octants import mesh_tpms, no_graph, no_struts, place_tpms, solid_of, tpms_meshing

#: Cells along one axis of a block.
MOST_CELLS = 1_000_000


@dataclass(frozen=True, eq=False)
class _Laid:
    """The octants of a block, laid, and what they stand on.

    `loose` counts the pieces that its outside cut off, which are not of it.
    """

    cells: CellGrid
    placement: Placement
    layout: Layout
    graph: CellGraph
    octant_spec: OctantSpec
    notes: tuple[str, ...]
    loose: int = 0


def block(
    spec: LatticeSpec,
    count: Sequence[int],
    *,
    progress: ProgressCallback | None = None,
) -> Result:
    """A free-standing block of whole cells.

    Args:
        spec: what to make; only cell, sizes, grading, fillet, resolution, origin and density
            count.
        count: cells along x, y, z.
        progress: called with the fraction done and the stage; returning False cancels.

    Raises:
        VolfrepError: the counts make no sense or the block would not fit into memory.
        Cancelled: the callback said so.
    """
    if spec.network is not None:
        return _beside(spec, count, progress)
    monitor = Monitor(progress)
    cells, placement = _block_placement(spec, count)
    refuse_expected(spec, math.prod(cells.shape) * spec.cell_size**3, cells.shape)
    laid = _lay(spec, cells, placement, monitor)
    refuse_too_large(spec, laid.layout.grid, laid.layout.octants, None, cells.shape)
    return _meshed(laid, spec, monitor)


def _meshed(laid: _Laid, spec: LatticeSpec, monitor: Monitor) -> Result:
    """A block as a whole, without its specks."""
    layout, placement = laid.layout, laid.placement
    with monitor.stage("lattice", 0.4, 0.8):
        if spec.surface is None:
            given = vertices_of(
                layout, lambda: laid.graph, spec.unit_cell(), spec.struts, laid.octant_spec,
                placement, monitor,
            )  # fmt: skip
        else:
            given = place_tpms(layout, spec, placement, monitor)
        surface = TrimmedSurface(TriangleMesh(given.vertices, facets(layout, monitor)))
    removed = _removed(laid)
    with monitor.stage("check", 0.8, 1.0):
        measured = measure(surface.mesh, monitor) if spec.is_graded else certify(layout)
        if measured.shells > 1 or measured.degenerate_triangles:
            # of no use to most blocks, and slow to import
            from ..trim.loose_pieces import clear, smallest_shell

            bodies = 0 if spec.surface is None else 1
            cleared = clear(surface, smallest_shell(laid.octant_spec), monitor, bodies=bodies)
            surface, measured = cleared.surface, cleared.quality
            removed["pieces_removed"] += cleared.pieces_removed
            removed["specks_removed"] = cleared.specks_removed
            proved = False
        else:
            proved = not spec.is_graded and _fits_a_file(layout, measured)
        notes: tuple[str, ...] = ()
        if proved:
            refuse_no_solid(measured)
        else:
            moved = _is_moved(spec, placement)
            surface, measured, notes = finish(surface, measured, monitor, moved, cut=False)
    frame = _frame(laid, spec)
    report = _report(laid, measured, frame, spec, monitor, removed)
    return Result(surface, frame, with_warnings(report, notes))


def _fits_a_file(layout: Layout, measured: Quality) -> bool:
    """Whether its octants prove that a file of single precision holds a block as it is."""
    kinds, edge = layout.octants.values(), 0.5 * layout.grid.cell_size
    return agree_on_faces(layout) and keeps_corners(kinds, edge, measured.bounds)


def write_block_stl(
    spec: LatticeSpec,
    count: Sequence[int],
    path: str | os.PathLike[str],
    *,
    progress: ProgressCallback | None = None,
) -> Report:
    """A free-standing block straight into a binary STL.

    Equal cells are written octant by octant, so that the memory does not grow with the triangles;
    graded ones, whose octants all differ, are meshed as a whole first.

    Args:
        spec: what to make, as for `block`.
        count: cells along x, y, z.
        path: of the file; an old file stays if anything goes wrong.
        progress: called with the fraction done and the stage; returning False cancels.

    Raises:
        VolfrepError: the counts make no sense, the block would not fit into memory or onto the
            disk, or the path cannot be written.
        Cancelled: the callback said so; no file is left behind.
    """
    if spec.is_graded or spec.network is not None:
        result = block(spec, count, progress=progress)
    else:
        cells, placement = _block_placement(spec, count)
        refuse_block(cells.shape, BYTES_PER_STREAMED_CELL)
        monitor = Monitor(progress)
        laid = _lay(spec, cells, placement, monitor)
        with monitor.stage("check", 0.4, 0.5):
            measured = certify(laid.layout)
            refuse_no_solid(measured)
            streams = measured.shells == 1 and _fits_a_file(laid.layout, measured)
        if streams:
            monitor.count("triangles laid", laid.layout.triangles)
            with monitor.stage("write", 0.5, 1.0):
                write_octants_stl(laid.layout, path, monitor)
            frame = _frame(laid, spec)
            return _report(laid, measured, frame, spec, monitor, _removed(laid))
        refuse_too_large(spec, laid.layout.grid, laid.layout.octants, None, cells.shape)
        result = _meshed(laid, spec, monitor)
    start = time.perf_counter()
    write_stl(result.mesh, path)
    stages = {**result.report.stages, "write": time.perf_counter() - start}
    return replace(result.report, stages=stages, peak_memory_mb=peak_memory_mb())


def measured_block(
    spec: LatticeSpec, count: Sequence[int], *, progress: ProgressCallback | None = None
) -> Report:
    """The figures of a block; one of equal cells is not meshed as a whole for them.

    Raises:
        VolfrepError: as `block`.
        Cancelled: the callback said so.
    """
    if spec.is_graded or spec.network is not None:
        return block(spec, count, progress=progress).report
    cells, placement = _block_placement(spec, count)
    monitor = Monitor(progress)
    laid = _lay(spec, cells, placement, monitor)
    frame = _frame(laid, spec)
    return _report(laid, certify(laid.layout), frame, spec, monitor, _removed(laid))


def block_volume(spec: LatticeSpec, count: Sequence[int]) -> float:
    """The volume of a block's cells, mm3."""
    cells, placement = _block_placement(spec, count)
    return _volume_of(cells, placement)


def block_wireframe(spec: LatticeSpec, count: Sequence[int]) -> Wireframe:
    """The nodes and struts of a free-standing block.

    Raises:
        VolfrepError: the counts make no sense, or the block would not fit into memory.
    """
    if spec.network is not None:
        return _beside(spec, count, None).wireframe
    cells, placement = _block_placement(spec, count)
    cell = spec.unit_cell()
    refuse_block(cells.shape, BYTES_PER_STRUT * len(cell.struts))
    active = np.ones(cells.shape, bool)
    graph = cell_graph(cell, active, spec.cell_size, cells.origin, cells.periodic)
    return graded_wireframe(graph, spec.struts, placement)


def _beside(spec: LatticeSpec, count: Sequence[int], progress: ProgressCallback | None) -> Result:
    """A block of cells that are no cubes, or whose struts differ.

    Raises:
        VolfrepError: the specification is of another network.
    """
    # of no use to most blocks, and slow to import
    from .graphs.free_space import cells_beside, mesh_graph_alone

    if not isinstance(spec.network, StretchedCells):
        raise VolfrepError("A block is of cells and not of a network: choose 'network' or 'fill'.")
    shape = [whole("count", n, 1, MOST_CELLS) for n in count]
    corner = np.zeros(3) if spec.origin is None else np.array(spec.origin, float)
    laid = cells_beside(spec, (shape[0], shape[1], shape[2]), corner)
    return mesh_graph_alone(replace(spec, network=laid), progress=progress)


def _block_placement(spec: LatticeSpec, count: Sequence[int]) -> tuple[CellGrid, Placement]:
    """The grid and the placement of a free-standing block, with its counts checked."""
    if len(count) != 3:
        raise VolfrepError(f"The count must be three whole numbers, not {list(count)}.")
    shape = [whole("count", n, 1, MOST_CELLS) for n in count]
    return block_placement(spec.grid, (shape[0], shape[1], shape[2]))


def _lay(spec: LatticeSpec, cells: CellGrid, placement: Placement, monitor: Monitor) -> _Laid:
    """The octants of a block."""
    active = np.ones(cells.shape, bool)
    if spec.surface is not None:
        return _lay_walls(spec, cells, placement, monitor)
    refuse_crossing(spec)
    cell = spec.unit_cell()
    with monitor.stage("tile", 0.0, 0.4):
        grid = octant_grid(cell, active, spec.cell_size, cells.origin, cells.periodic)
        octants, used, notes = until_sound(
            octant_spec(spec.cell_size, spec.struts, spec.detail),
            lambda wanted: mesh_octants(cell, wanted, grid.keys, monitor),
        )
        refuse_solid_cells(octants, used)
        notes += deviation_warnings(octants, used)
        layout = lay_out(grid, octants)
    graph = cell_graph(cell, active, spec.cell_size, cells.origin, cells.periodic)
    return _Laid(cells, placement, layout, graph, used, notes)


def _lay_walls(spec: LatticeSpec, cells: CellGrid, placement: Placement, monitor: Monitor) -> _Laid:
    """The octants of a block of walls, closed on its outside."""
    with monitor.stage("tile", 0.0, 0.4):
        active, size = np.ones(cells.shape, bool), spec.cell_size
        grid = octants_of_cells(active, size, cells.origin, cells.periodic)
        solid = solid_of(spec)
        octants, used, notes = until_sound(
            tpms_meshing(spec), lambda wanted: mesh_tpms(solid, wanted, monitor)
        )
        refuse_solid_cells(octants, used)
        closed = closed_octants(octants, grid.keys, 0.5 * size)
        layout = lay_out(grid, closed.octants)
    pairs = zip(grid.keys, layout.places, strict=True)
    loose = sum(len(closed.loose[key]) * len(place) for key, place in pairs)
    return _Laid(cells, placement, layout, no_graph(), used, notes, loose)


def _frame(laid: _Laid, spec: LatticeSpec) -> Wireframe:
    """The struts of a block; of walls none."""
    if spec.surface is not None:
        return no_struts()
    return graded_wireframe(laid.graph, spec.struts, laid.placement)


def _removed(laid: _Laid) -> dict[str, Any]:
    """What a block is without."""
    return {**NOTHING_REMOVED, "pieces_removed": laid.loose}


def _is_moved(spec: LatticeSpec, placement: Placement) -> bool:
    """Whether vertices are elsewhere than they were meshed."""
    if spec.surface is not None:
        return not keeps_wall_places(spec, placement)
    return not keeps_places(spec.struts, placement)


def _report(
    laid: _Laid,
    measured: Quality,
    frame: Wireframe,
    spec: LatticeSpec,
    monitor: Monitor,
    removed: Mapping[str, Any],
) -> Report:
    cells = laid.cells
    volume = _volume_of(cells, laid.placement)
    active = np.ones(cells.shape, bool)
    report = report_of(
        measured, frame, cells, active, laid.placement, spec, monitor,
        domain_volume=volume, removed=removed, warnings=laid.notes,
    )  # fmt: skip
    return report_target(report, spec)


def _volume_of(cells: CellGrid, placement: Placement) -> float:
    mapping = placement.mapping
    if mapping is not None and not mapping.is_rigid:
        return float(mapped_volume(cells, mapping))
    return float(np.prod(cells.shape, dtype=float)) * cells.cell_size**3

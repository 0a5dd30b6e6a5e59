# SPDX-License-Identifier: LGPL-2.1-or-later
"""The one way through: solid, domain, active cells, tile, trimmed lattice, part."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .cache import StageCache
from .cells import UnitCell
from .clean import remove_slivers, separate_vertices, shortest_edge
from .dangling import Thinned, thinned
from .domain import Domain, find_domain
from .drains import trapped
from .errors import VolfrepError
from .graded import (
    Ground,
    Setting,
    block_setting,
    graded_wireframe,
    ground,
    keeps_places,
    setting,
    vertices_of,
)
from .lattice import facets, lay_out, octant_grid
from .limits import BYTES_PER_CELL, refuse_expected, refuse_memory, refuse_too_large
from .mesh import TriangleMesh, box_of, concatenate
from .progress import Monitor, ProgressCallback, peak_memory_mb
from .quality import inspect, measure
from .report import Report
from .sizes import mapped_volume, sizes
from .solid import Solid
from .spec import LatticeSpec
from .survey import survey
from .tile import mesh_octants
from .trim import Cleared, clear
from .trimming import (
    FIRST_MARGIN,
    Output,
    Trimming,
    cell_key,
    refuse_solid_cells,
    smallest_shell,
    tile_spec,
)
from .voxels import CellGrid, active_cells, make_grid, mapped_grid
from .wireframe import Wireframe, cell_graph

__all__ = ["Result", "StageCache", "block", "block_wireframe", "fill"]

Bools = NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class Result:
    """What a run made.

    Attributes:
        mesh: the part, the lattice or the domain, as asked for.
        wireframe: the unique nodes and struts of the active cells.
        report: the figures.
    """

    mesh: TriangleMesh
    wireframe: Wireframe
    report: Report


def fill(
    solid: TriangleMesh,
    spec: LatticeSpec,
    *,
    progress: ProgressCallback | None = None,
    cache: StageCache | None = None,
) -> Result:
    """Fill a solid with a lattice.

    Args:
        solid: checked closed mesh (from `volfrep.solid.read_solid` or `check_solid`), mm;
            what they repaired goes into the report's warnings.
        spec: what to make.
        progress: called with the fraction done and the stage; returning False cancels.
        cache: keeps the stages' results between runs.

    Raises:
        VolfrepError: the specification does not fit the solid; the text says what to change.
        Cancelled: the callback said so.
    """
    cache = cache or StageCache()
    monitor = Monitor(progress)
    cell = spec.unit_cell()
    size = solid.bounds[1] - solid.bounds[0]
    if spec.cell_size > size.max():
        raise VolfrepError(
            f"Cells of {spec.cell_size:g} mm are larger than the part, which measures "
            f"{size[0]:.4g} x {size[1]:.4g} x {size[2]:.4g} mm: reduce the cell size, "
            "or see whether the part is in another unit."
        )
    solid_key = _fingerprint(solid)
    with monitor.stage("shell", 0.0, 0.3):
        domain, warnings, wall_key = find_domain(solid, solid_key, spec, cache, monitor)
    if isinstance(solid, Solid):
        warnings = solid.notes + warnings
    room = domain.mesh
    if not len(room.triangles):
        raise VolfrepError(
            f"The part is nowhere thicker than two walls of {spec.shell:g} mm, so that nothing "
            "is left to fill: reduce the shell thickness."
        )

    if spec.output != "domain":
        refuse_expected(spec, room.volume)
    where = setting(solid, spec, monitor)
    voxel_key = (wall_key, *_cells_key(cell, spec))
    with monitor.stage("voxels", 0.3, 0.4):
        floor, active = cache.get(
            "voxels", voxel_key, lambda: _voxels(solid, domain, cell, spec, where, monitor)
        )
    if not active.any():
        where_not = "has its centre" if spec.activation == "centre" else "lies wholly"
        raise VolfrepError(
            f"No cell of {spec.cell_size:g} mm {where_not} inside the domain: reduce the cell "
            "size or choose the activation 'touching'."
        )
    thin = None
    if spec.removes_struts:
        thin = thinned(floor, cell, active, spec, where, domain)
        frame = thin.frame
    else:
        graph = cell_graph(cell, active, spec.cell_size, floor.cells.origin, floor.cells.periodic)
        frame = graded_wireframe(graph, spec, where)
    if not len(frame.struts):
        raise VolfrepError(
            "Every strut has a free end, so that none is left: keep dangling struts, reduce the "
            "cell size or choose the activation 'touching'."
        )

    if spec.output == "domain":
        precision = shortest_edge(solid)
        clean = separate_vertices(remove_slivers(room, precision), precision)
        made = Output(Cleared(clean, 0, 0), measure(clean), None)
    else:
        trimming = Trimming(solid, domain, cell, spec, where, floor, active, thin, voxel_key)
        with monitor.stage("tile", 0.4, 0.5):
            margin = 0.0 if keeps_places(spec, where) else FIRST_MARGIN
            if not spec.is_cut:
                margin = np.inf  # no wall that an octant could reach
            kept, octants = trimming.octants(margin, cache, monitor)
        with monitor.stage("lattice", 0.5, 0.6):
            kept, layout, points = trimming.lay(kept, octants, margin, cache, monitor)
        with monitor.stage("trim", 0.6, 1.0):
            made = trimming.output(kept, layout, points, frame, monitor)
    skin_volume = solid.volume - room.volume if spec.output == "part" else 0.0
    return _result(
        made, frame, floor.cells, active, where, room.volume, spec, monitor,
        skin_volume, warnings, thin,
    )  # fmt: skip


def block(
    spec: LatticeSpec,
    count: Sequence[int],
    *,
    progress: ProgressCallback | None = None,
) -> Result:
    """A free-standing block of whole cells, with full round struts on its outside.

    Args:
        spec: what to make; only cell, sizes, fillet, resolution, origin and density count.
        count: cells along x, y, z.
        progress: called with the fraction done and the stage; returning False cancels.

    Raises:
        VolfrepError: the counts make no sense or the block would not fit into memory.
        Cancelled: the callback said so.
    """
    cells, where = _block_setting(spec, count)
    monitor = Monitor(progress)
    cell = spec.unit_cell()
    volume = float(np.prod(cells.shape, dtype=float)) * spec.cell_size**3
    refuse_expected(spec, volume)
    if where.chart is not None and not where.chart.is_rigid:
        volume = mapped_volume(cells, where.chart)
    active = np.ones(cells.shape, bool)
    tile = tile_spec(spec)
    with monitor.stage("tile", 0.0, 0.4):
        grid = octant_grid(cell, active, spec.cell_size, cells.origin, cells.periodic)
        octants = mesh_octants(cell, tile, grid.keys, monitor)
    refuse_solid_cells(octants, spec)
    refuse_too_large(spec, grid, octants, None)
    graph = cell_graph(cell, active, spec.cell_size, cells.origin, cells.periodic)
    with monitor.stage("lattice", 0.4, 0.8):
        layout = lay_out(grid, octants)
        placed = vertices_of(layout, lambda: graph, cell, spec, tile, where, monitor)
        mesh = TriangleMesh(placed.vertices, facets(layout, monitor))
    frame = graded_wireframe(graph, spec, where)
    with monitor.stage("check", 0.8, 1.0):
        measured = measure(mesh, monitor) if spec.is_graded else survey(layout, mesh.vertices)
        cleared = Cleared(mesh, 0, 0)
        if measured.shells > 1:
            cleared = clear(mesh, inspect(mesh, monitor), smallest_shell(spec))
            measured = measure(cleared.mesh, monitor)
    made = Output(cleared, measured, None)
    return _result(made, frame, cells, active, where, volume, spec, monitor)


def block_wireframe(spec: LatticeSpec, count: Sequence[int]) -> Wireframe:
    """The nodes and struts of a free-standing block.

    Raises:
        VolfrepError: the counts make no sense.
    """
    cells, where = _block_setting(spec, count)
    active = np.ones(cells.shape, bool)
    graph = cell_graph(spec.unit_cell(), active, spec.cell_size, cells.origin, cells.periodic)
    return graded_wireframe(graph, spec, where)


def _block_setting(spec: LatticeSpec, count: Sequence[int]) -> tuple[CellGrid, Setting]:
    """The grid and the setting of a free-standing block, with its counts checked."""
    shape = tuple(int(n) for n in count)
    if len(shape) != 3 or min(shape) < 1 or any(n != m for n, m in zip(shape, count, strict=True)):
        raise VolfrepError(f"The count must be three whole numbers above 0, not {list(count)}.")
    return block_setting(spec, (shape[0], shape[1], shape[2]))


def _voxels(
    solid: TriangleMesh,
    domain: Domain,
    cell: UnitCell,
    spec: LatticeSpec,
    where: Setting,
    monitor: Monitor,
) -> tuple[Ground, Bools]:
    whole, origin = solid, spec.origin
    if domain.is_open:  # octants are wanted beyond the part, too; the cells still begin at it
        whole = concatenate(solid, domain.wall)
        x, y, z = solid.bounds[0]
        origin = origin or (float(x), float(y), float(z))
    if where.chart is None:
        cells = make_grid(box_of(whole.vertices), spec.cell_size, origin)
    else:
        cells = mapped_grid(whole, where.chart, spec.cell_size, spec.origin, monitor)
    refuse_memory(spec, 0, other=cells.cells * BYTES_PER_CELL)
    floor = ground(cells, cell, spec, where)
    usable = floor.inner_usable
    return floor, active_cells(cells, domain.mesh, spec.activation, monitor, where.chart, usable)


def _cells_key(cell: UnitCell, spec: LatticeSpec) -> tuple[object, ...]:
    """What the cells of the grid, and which of them are active, depend on besides the wall."""
    width: tuple[object, ...] = ()
    if spec.cell_map is not None:
        width = (cell_key(cell), spec.keep_radius, spec.radius_extremes[1])
    return (
        spec.cell_size, spec.origin, spec.activation,
        spec.size_grading, spec.cell_map, spec.orientation, *width,
    )  # fmt: skip


def _result(
    made: Output,
    graph: Wireframe,
    cells: CellGrid,
    active: NDArray[np.bool_],
    where: Setting,
    domain_volume: float,
    spec: LatticeSpec,
    monitor: Monitor,
    skin_volume: float = 0.0,
    warnings: tuple[str, ...] = (),
    thin: Thinned | None = None,
) -> Result:
    cleared, measured, drained = made.cleared, made.measured, made.drained
    if drained is not None:
        warnings += drained.warnings
        skin_volume -= drained.volume
    elif spec.open_faces:
        warnings += trapped(measured.voids)
    size = sizes(cells, active, where.chart, graph)
    report = Report(
        cells_total=cells.cells,
        cells_active=int(active.sum()),
        grid=cells.shape,
        nodes=len(graph.nodes),
        struts=len(graph.struts),
        cell_edges_mm=size.cell_edges,
        strut_lengths_mm=size.strut_lengths,
        strut_radii_mm=size.strut_radii,
        triangles=measured.triangles,
        vertices=measured.vertices,
        bodies=measured.bodies,
        voids=measured.voids,
        genus=measured.genus,
        volume_mm3=measured.volume,
        area_mm2=measured.area,
        domain_volume_mm3=domain_volume,
        relative_density=(measured.volume - skin_volume) / domain_volume,
        mass_g=measured.volume * spec.density / 1000.0,
        watertight=measured.watertight,
        struts_dangling_removed=thin.left.dangling if thin is not None else 0,
        stubs_removed=thin.left.stubs if thin is not None else 0,
        pieces_removed=cleared.pieces_removed,
        specks_removed=cleared.specks_removed,
        drain_holes=drained.places if drained is not None else (),
        stages=dict(monitor.stages),
        stage_memory_mb=dict(monitor.memory_mb),
        peak_memory_mb=peak_memory_mb(),
        spec=spec.as_dict(),
        warnings=warnings,
    )
    return Result(cleared.mesh, graph, report)


def _fingerprint(mesh: TriangleMesh) -> str:
    digest = hashlib.blake2b(digest_size=16)
    digest.update(mesh.vertices.tobytes())
    digest.update(mesh.triangles.tobytes())
    return digest.hexdigest()

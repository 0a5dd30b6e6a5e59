# SPDX-License-Identifier: LGPL-2.1-or-later
"""The one way through: solid, domain, active cells, tile, trimmed lattice, part."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from .cells import UnitCell
from .clean import remove_slivers, separate_vertices, shortest_edge
from .errors import VolfrepError
from .lattice import OctantGrid, lay, lay_out, octant_grid
from .mesh import TriangleMesh, concatenate
from .octant import ALL_ACTIVE, OctantKey, octant_mirrors
from .progress import Monitor, ProgressCallback, peak_memory_mb
from .quality import Quality, combined, inspect, measure
from .report import Report
from .shell import TOLERANCE, inner_wall
from .spec import LatticeSpec
from .survey import survey
from .tile import Octant, TileSpec, mesh_octants
from .trim import Cleared, OctantRoles, clear, octant_roles, trim
from .voxels import CellGrid, active_cells, make_grid
from .wireframe import Wireframe, wireframe

T = TypeVar("T")

#: Bytes that a triangle takes at the peak: laid out and checked, or in the Boolean as well.
BYTES_PER_TRIANGLE = 150
BYTES_PER_BOOLEAN_TRIANGLE = 900
#: Bytes that a cell of the grid takes while cells and octants are told apart.
BYTES_PER_CELL = 500
#: Taken for free memory where the system does not tell.
ASSUMED_MEMORY = 8e9


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


@dataclass
class StageCache:
    """The last result of every stage, reused as long as what went into it is the same.

    Give the same cache to run after run: a new strut radius then repeats neither the shelling
    nor the voxelisation. It holds meshes; drop it to free them.
    """

    _entries: dict[str, tuple[Any, Any]] = field(default_factory=dict)

    def get(self, stage: str, key: object, compute: Callable[[], T]) -> T:
        """The stage's last value if it was made for an equal key, else a new one."""
        entry = self._entries.get(stage)
        if entry is not None and entry[0] == key:
            value: T = entry[1]
            return value
        value = compute()
        self._entries[stage] = (key, value)
        return value


def fill(
    solid: TriangleMesh,
    spec: LatticeSpec,
    *,
    progress: ProgressCallback | None = None,
    cache: StageCache | None = None,
) -> Result:
    """Fill a solid with a lattice.

    Args:
        solid: checked closed mesh (from `volfrep.solid.read_solid` or `check_solid`), mm.
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
            f"{size[0]:.4g} x {size[1]:.4g} x {size[2]:.4g} mm: reduce the cell size."
        )
    solid_key = _fingerprint(solid)
    wall_key = (solid_key, spec.shell)
    warnings: tuple[str, ...] = ()
    domain = solid
    with monitor.stage("shell", 0.0, 0.3):
        if spec.shell > 0:
            wall = cache.get("shell", wall_key, lambda: inner_wall(solid, spec.shell, monitor))
            domain = wall.mesh
            if wall.worst > TOLERANCE:
                x, y, z = wall.place
                warnings = (
                    f"The skin is up to {wall.worst:.0%} off its thickness near ({x:.4g}, {y:.4g}, "
                    f"{z:.4g}), where the room between two skins is narrow.",
                )
    if not len(domain.triangles):
        raise VolfrepError(
            f"The part is nowhere thicker than two walls of {spec.shell:g} mm, so that nothing "
            "is left to fill: reduce the shell thickness."
        )

    if spec.output != "domain":
        _refuse_memory(_expected_triangles(cell, spec, domain.volume), 0)
    voxel_key = (wall_key, spec.cell_size, spec.origin, spec.activation)
    with monitor.stage("voxels", 0.3, 0.4):
        cells, active, roles = cache.get(
            "voxels", voxel_key, lambda: _voxels(solid, domain, spec, monitor)
        )
    if not active.any():
        raise VolfrepError(
            f"No cell of {spec.cell_size:g} mm has its centre inside the domain: reduce the cell "
            "size or choose the activation 'touching'."
        )
    graph = wireframe(cell, active, spec.cell_size, cells.origin, spec.strut_radius)

    tile_spec = TileSpec(spec.cell_size, spec.strut_radius, spec.fillet, spec.facets_along_cell)
    if spec.output == "domain":
        precision = shortest_edge(solid)
        clean = separate_vertices(remove_slivers(domain, precision), precision)
        cleared, measured = Cleared(clean, 0, 0), measure(clean)
    else:
        grid = _octants(cell, cells, active, spec)
        with monitor.stage("tile", 0.4, 0.5):
            octants = cache.get(
                "tile",
                (_cell_key(cell), tile_spec, tuple(grid.keys)),
                lambda: mesh_octants(cell, tile_spec, grid.keys, monitor),
            )
        _refuse_solid_cells(octants, spec)
        _refuse_too_large(grid, octants, roles)
        with monitor.stage("trim", 0.5, 1.0):
            cleared, measured = _trimmed_output(solid, domain, grid, octants, roles, spec, monitor)
    skin_volume = solid.volume - domain.volume if spec.output == "part" else 0.0
    return _result(
        cleared, measured, graph, cells, active, domain.volume, spec, monitor, skin_volume, warnings
    )


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
    cells = block_cells(spec, count)
    shape, origin = cells.shape, cells.origin
    monitor = Monitor(progress)
    cell = spec.unit_cell()
    tile_spec = TileSpec(spec.cell_size, spec.strut_radius, spec.fillet, spec.facets_along_cell)
    volume = float(np.prod(shape, dtype=float)) * spec.cell_size**3
    _refuse_memory(_expected_triangles(cell, spec, volume), 0)
    active = np.ones(shape, bool)
    with monitor.stage("tile", 0.0, 0.4):
        grid = octant_grid(cell, active, spec.cell_size, origin)
        octants = mesh_octants(cell, tile_spec, grid.keys, monitor)
    _refuse_solid_cells(octants, spec)
    _refuse_too_large(grid, octants, None)
    with monitor.stage("lattice", 0.4, 0.8):
        layout = lay_out(grid, octants)
        mesh = lay(layout, monitor)
    graph = wireframe(cell, active, spec.cell_size, origin, spec.strut_radius)
    with monitor.stage("check", 0.8, 1.0):
        measured = survey(layout, mesh.vertices)
        cleared = Cleared(mesh, 0, 0)
        if measured.shells > 1:
            cleared = clear(mesh, inspect(mesh, monitor), _smallest_shell(spec))
            measured = measure(cleared.mesh, monitor)
    return _result(cleared, measured, graph, cells, active, volume, spec, monitor)


def block_cells(spec: LatticeSpec, count: Sequence[int]) -> CellGrid:
    """The grid of a free-standing block.

    Raises:
        VolfrepError: the counts are not three whole numbers above 0.
    """
    shape = tuple(int(n) for n in count)
    if len(shape) != 3 or min(shape) < 1 or any(n != m for n, m in zip(shape, count, strict=True)):
        raise VolfrepError(f"The count must be three whole numbers above 0, not {list(count)}.")
    origin = np.array(spec.origin or (0.0, 0.0, 0.0), float)
    return CellGrid(origin, spec.cell_size, (shape[0], shape[1], shape[2]))


def _voxels(
    solid: TriangleMesh, domain: TriangleMesh, spec: LatticeSpec, monitor: Monitor
) -> tuple[CellGrid, NDArray[np.bool_], OctantRoles]:
    cells = make_grid(solid.bounds, spec.cell_size, spec.origin)
    _refuse_memory(0, 0, cells.cells * BYTES_PER_CELL)
    active = active_cells(cells, domain, spec.activation, monitor)
    return cells, active, octant_roles(domain, cells, 1, monitor)


def _octants(
    cell: UnitCell, cells: CellGrid, active: NDArray[np.bool_], spec: LatticeSpec
) -> OctantGrid:
    """The octants of the active cells.

    Where every cell that touches the domain is active, those of a lattice without end: what lies
    outside is cut off anyway.
    """
    if spec.activation == "centre":
        return octant_grid(cell, active, cells.cell_size, cells.origin)
    shape = (2 * active.shape[0] + 2, 2 * active.shape[1] + 2, 2 * active.shape[2] + 2)
    if cell.is_mirror_symmetric:
        kind, keys = np.zeros(shape, np.int16), [OctantKey(0, ALL_ACTIVE)]
    else:
        kind = octant_mirrors(shape).astype(np.int16)
        keys = [OctantKey(mirror, ALL_ACTIVE) for mirror in range(8)]
    return OctantGrid(keys, kind, cells.origin, cells.cell_size, cell.is_mirror_symmetric)


def _trimmed_output(
    solid: TriangleMesh,
    domain: TriangleMesh,
    grid: OctantGrid,
    octants: dict[OctantKey, Octant],
    roles: OctantRoles,
    spec: LatticeSpec,
    monitor: Monitor,
) -> tuple[Cleared, Quality]:
    """The part or the lattice, without loose pieces and slivers, and its quality."""
    with_skin = spec.output == "part" and spec.shell > 0
    trimmed = trim(domain, grid, octants, roles, cavity=with_skin, monitor=monitor)
    mesh, cut, removed = trimmed.mesh, trimmed.cut, 0
    smallest, precision = _smallest_shell(spec), shortest_edge(solid)
    if spec.output == "lattice" and spec.shell > 0:
        on_wall = np.flatnonzero(trimmed.on_wall)
        held = clear(mesh, inspect(mesh, monitor), smallest, keep=on_wall)
        mesh, cut, removed = held.mesh, len(held.mesh.triangles), held.pieces_removed
    mesh = separate_vertices(remove_slivers(mesh, precision, cut), precision)
    found = inspect(mesh, monitor)
    bodies = 0
    if spec.shell == 0:
        bodies = max(1, inspect(solid).quality.bodies)
    cleared = clear(mesh, found, smallest, floating=with_skin, bodies=bodies)
    if not len(cleared.mesh.triangles):
        if with_skin:
            raise _cells_are_full(spec)
        raise VolfrepError(
            "No strut lies inside the part: reduce the cell size or move the origin."
        )
    measured = found.quality
    if cleared.mesh is not mesh:
        measured = measure(cleared.mesh, monitor)
    cleared = replace(cleared, pieces_removed=cleared.pieces_removed + removed)
    if not with_skin:
        return cleared, measured
    return replace(cleared, mesh=concatenate(solid, cleared.mesh)), combined(
        measure(solid), measured
    )


def _smallest_shell(spec: LatticeSpec) -> float:
    """Volume of half a facet's edge cubed, mm3: no shell smaller than that is meant."""
    return (0.5 * spec.cell_size / spec.facets_along_cell) ** 3


def _result(
    cleared: Cleared,
    measured: Quality,
    graph: Wireframe,
    cells: CellGrid,
    active: NDArray[np.bool_],
    domain_volume: float,
    spec: LatticeSpec,
    monitor: Monitor,
    skin_volume: float = 0.0,
    warnings: tuple[str, ...] = (),
) -> Result:
    report = Report(
        cells_total=cells.cells,
        cells_active=int(active.sum()),
        grid=cells.shape,
        nodes=len(graph.nodes),
        struts=len(graph.struts),
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
        pieces_removed=cleared.pieces_removed,
        specks_removed=cleared.specks_removed,
        stages=dict(monitor.stages),
        stage_memory_mb=dict(monitor.memory_mb),
        peak_memory_mb=peak_memory_mb(),
        spec=spec.as_dict(),
        warnings=warnings,
    )
    return Result(cleared.mesh, graph, report)


def _refuse_solid_cells(octants: dict[OctantKey, Octant], spec: LatticeSpec) -> None:
    if not any(len(octant.triangles) for octant in octants.values()):
        raise _cells_are_full(spec)


def _cells_are_full(spec: LatticeSpec) -> VolfrepError:
    return VolfrepError(
        f"Struts of radius {spec.strut_radius:g} mm fill cells of {spec.cell_size:g} mm "
        "completely: reduce the radius or enlarge the cells."
    )


def _refuse_too_large(
    grid: OctantGrid, octants: dict[OctantKey, Octant], roles: OctantRoles | None
) -> None:
    per_kind = np.array([len(octants[key].triangles) for key in grid.keys])
    present = grid.kind >= 0
    if roles is not None:
        present &= roles.border | roles.inside
    triangles = int(per_kind[grid.kind[present]].sum())
    in_boolean = 0
    if roles is not None:
        in_boolean = int(per_kind[grid.kind[present & roles.border]].sum())
    _refuse_memory(triangles, in_boolean)


def _expected_triangles(cell: UnitCell, spec: LatticeSpec, volume: float) -> float:
    """Triangles of the lattice in a volume, rather too few: known before any work starts.

    A strut on a cell's edge is shared by four cells; facets are equilateral triangles; about
    half of the struts' surface is lost to one another at the joints at the worst.
    """
    ends = cell.nodes[cell.struts]
    length = float(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).sum()) / 4.0
    surface = 0.5 * length * spec.cell_size * 2.0 * np.pi * spec.strut_radius
    facet = np.sqrt(3.0) / 4.0 * (spec.cell_size / spec.facets_along_cell) ** 2
    return float(volume / spec.cell_size**3 * surface / facet)


def _refuse_memory(triangles: float, in_boolean: float, other: float = 0.0) -> None:
    needed = triangles * BYTES_PER_TRIANGLE + in_boolean * BYTES_PER_BOOLEAN_TRIANGLE + other
    free = _free_memory()
    if needed > free or triangles > np.iinfo(np.int32).max // 3:
        what = f"have about {triangles / 1e6:.3g} million triangles and " if triangles else ""
        raise VolfrepError(
            f"This lattice would {what}take {needed / 1e9:.3g} GB of the {free / 1e9:.3g} GB of "
            "free memory: enlarge the cells, or choose a coarser resolution or fewer cells."
        )


def _free_memory() -> float:
    """Bytes of memory that are free, as far as the system tells."""
    try:
        with open("/proc/meminfo", encoding="ascii") as file:
            for line in file:
                if line.startswith("MemAvailable:"):
                    return float(line.split()[1]) * 1024.0
    except OSError:
        pass
    if hasattr(os, "sysconf") and "SC_AVPHYS_PAGES" in os.sysconf_names:
        return float(os.sysconf("SC_AVPHYS_PAGES")) * os.sysconf("SC_PAGE_SIZE")
    return ASSUMED_MEMORY


def _fingerprint(mesh: TriangleMesh) -> str:
    digest = hashlib.blake2b(digest_size=16)
    digest.update(mesh.vertices.tobytes())
    digest.update(mesh.triangles.tobytes())
    return digest.hexdigest()


def _cell_key(cell: UnitCell) -> tuple[bytes, bytes]:
    return cell.nodes.tobytes(), cell.struts.tobytes()

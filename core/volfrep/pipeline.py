# SPDX-License-Identifier: LGPL-2.1-or-later
"""The one way through: solid, domain, active cells, tile, trimmed lattice, part."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from .cells import UnitCell
from .clean import remove_slivers, separate_vertices, shortest_edge
from .dangling import Thinned, thinned
from .errors import VolfrepError
from .frep import Floats
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
from .incidence import without_struts
from .lattice import Layout, facets, lay_out, octant_grid, used_kinds
from .limits import BYTES_PER_CELL, refuse_expected, refuse_memory, refuse_too_large
from .mesh import TriangleMesh, compact, concatenate
from .octant import OctantKey
from .progress import Monitor, ProgressCallback, peak_memory_mb
from .quality import Quality, combined, inspect, measure
from .report import Report
from .shell import TOLERANCE, inner_wall
from .sizes import mapped_volume, sizes
from .solid import Solid
from .spec import LatticeSpec
from .survey import survey
from .tile import Octant, TileSpec, mesh_octants
from .trim import Cleared, Kept, clear, keep, keep_all, octant_roles, trim
from .voxels import CellGrid, active_cells, make_grid, mapped_grid
from .wireframe import CellGraph, Wireframe, cell_graph

Bools = NDArray[np.bool_]
T = TypeVar("T")


#: Octants on moved struts mostly reach no farther out of their places than this, in units of
#: their edges. Where they do, they are looked for so many times as far as the last ones reached.
FIRST_MARGIN = 0.05
SPARE_MARGIN = 1.05
#: Less of a domain than this is no lattice.
NO_LATTICE = 1e-6


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
    wall_key = (solid_key, spec.shell)
    warnings = solid.notes if isinstance(solid, Solid) else ()
    domain = solid
    with monitor.stage("shell", 0.0, 0.3):
        if spec.shell > 0:
            wall = cache.get("shell", wall_key, lambda: inner_wall(solid, spec.shell, monitor))
            domain = wall.mesh
            if wall.worst > TOLERANCE:
                x, y, z = wall.place
                warnings += (
                    f"The skin is up to {wall.worst:.0%} off its thickness near ({x:.4g}, {y:.4g}, "
                    f"{z:.4g}), where the room between two skins is narrow.",
                )
    if not len(domain.triangles):
        raise VolfrepError(
            f"The part is nowhere thicker than two walls of {spec.shell:g} mm, so that nothing "
            "is left to fill: reduce the shell thickness."
        )

    if spec.output != "domain":
        refuse_expected(spec, domain.volume)
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
        clean = separate_vertices(remove_slivers(domain, precision), precision)
        cleared, measured = Cleared(clean, 0, 0), measure(clean)
    else:
        trimming = _Trimming(solid, domain, cell, spec, where, floor, active, thin, voxel_key)
        with monitor.stage("tile", 0.4, 0.5):
            margin = 0.0 if keeps_places(spec, where) else FIRST_MARGIN
            if not spec.is_cut:
                margin = np.inf  # no wall that an octant could reach
            kept, octants = trimming.octants(margin, cache, monitor)
        with monitor.stage("lattice", 0.5, 0.6):
            kept, layout, points = trimming.lay(kept, octants, margin, cache, monitor)
        with monitor.stage("trim", 0.6, 1.0):
            cleared, measured = trimming.output(kept, layout, points, monitor)
    skin_volume = solid.volume - domain.volume if spec.output == "part" else 0.0
    return _result(
        cleared, measured, frame, floor.cells, active, where, domain.volume, spec, monitor,
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
    _refuse_solid_cells(octants, spec)
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
            cleared = clear(mesh, inspect(mesh, monitor), _smallest_shell(spec))
            measured = measure(cleared.mesh, monitor)
    return _result(cleared, measured, frame, cells, active, where, volume, spec, monitor)


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
    domain: TriangleMesh,
    cell: UnitCell,
    spec: LatticeSpec,
    where: Setting,
    monitor: Monitor,
) -> tuple[Ground, Bools]:
    if where.chart is None:
        cells = make_grid(solid.bounds, spec.cell_size, spec.origin)
    else:
        cells = mapped_grid(solid, where.chart, spec.cell_size, spec.origin, monitor)
    refuse_memory(spec, 0, other=cells.cells * BYTES_PER_CELL)
    floor = ground(cells, cell, spec, where)
    usable = floor.inner_usable
    return floor, active_cells(cells, domain, spec.activation, monitor, where.chart, usable)


def _cells_key(cell: UnitCell, spec: LatticeSpec) -> tuple[object, ...]:
    """What the cells of the grid, and which of them are active, depend on besides the wall."""
    width: tuple[object, ...] = ()
    if spec.cell_map is not None:
        width = (_cell_key(cell), spec.keep_radius, spec.radius_extremes[1])
    return (
        spec.cell_size, spec.origin, spec.activation,
        spec.size_grading, spec.cell_map, spec.orientation, *width,
    )  # fmt: skip


@dataclass(frozen=True, eq=False)
class _Trimming:
    """From active cells to the trimmed lattice."""

    solid: TriangleMesh
    domain: TriangleMesh
    cell: UnitCell
    spec: LatticeSpec
    where: Setting
    floor: Ground
    active: Bools
    thin: Thinned | None
    key: object

    def octants(
        self, margin: float, cache: StageCache, monitor: Monitor
    ) -> tuple[Kept, dict[OctantKey, Octant]]:
        """Which octants there are, and their meshes."""
        spec, cells = self.spec, self.floor.cells
        tile = tile_spec(spec)
        grid = self.floor.octants(self.cell, self.active, spec.is_endless)
        if spec.is_cut:
            roles = cache.get(
                "octants",
                (self.key, margin),
                lambda: octant_roles(self.domain, cells, monitor, self.where.chart, margin),
            )
            kept = keep(grid, roles)
        else:
            kept = keep_all(grid)
        if self.thin is not None:
            fewer = without_struts(
                kept.grid, self.cell, self.thin.graph, self.thin.left.kept, tile.influence,
                joined=not keeps_places(spec, self.where),
            )  # fmt: skip
            kept = replace(kept, grid=used_kinds(fewer))
        keys = kept.grid.keys
        octants = cache.get(
            "tile",
            (_cell_key(self.cell), tile, tuple(keys)),
            lambda: mesh_octants(self.cell, tile, keys, monitor),
        )
        _refuse_solid_cells(octants, spec)
        refuse_too_large(spec, kept.grid, octants, kept.border)
        return kept, octants

    def lay(
        self,
        kept: Kept,
        octants: dict[OctantKey, Octant],
        margin: float,
        cache: StageCache,
        monitor: Monitor,
    ) -> tuple[Kept, Layout, Floats]:
        """The octants laid where the struts are; with more of them, where struts reach far out."""
        while True:
            layout = kept.lay_out(octants)
            placed = vertices_of(
                layout, self._graph,
                self.cell, self.spec, tile_spec(self.spec), self.where, monitor,
            )  # fmt: skip
            if placed.excess <= margin + 1e-9:
                return kept, layout, placed.vertices
            margin = SPARE_MARGIN * placed.excess
            kept, octants = self.octants(margin, cache, monitor)

    def _graph(self) -> CellGraph:
        """The nodes and struts that the octants hang on."""
        if self.thin is not None:
            return self.thin.left_graph
        return self.floor.graph(self.cell, self.active, self.spec.is_endless)

    def output(
        self, kept: Kept, layout: Layout, points: Floats, monitor: Monitor
    ) -> tuple[Cleared, Quality]:
        """The part or the lattice, without loose pieces and slivers, and its quality."""
        if not self.spec.is_cut:
            return self._uncut(layout, points, monitor)
        spec, solid, domain = self.spec, self.solid, self.domain
        with_skin = spec.output == "part" and spec.shell > 0
        trimmed = trim(domain, kept, layout, points, cavity=with_skin, monitor=monitor)
        mesh, cut, removed = trimmed.mesh, trimmed.cut, 0
        smallest, precision = _smallest_shell(spec), shortest_edge(solid)
        if spec.output == "lattice" and spec.shell > 0:
            on_wall = np.flatnonzero(trimmed.on_wall)
            held = clear(mesh, inspect(mesh, monitor), smallest, keep=on_wall)
            mesh, cut, removed = held.mesh, len(held.mesh.triangles), held.pieces_removed
            if removed and not len(mesh.triangles):
                raise _nothing_holds()
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
            # The cavity's surface counts as negative: what is left is its wall only.
            if with_skin and domain.volume + measured.volume < NO_LATTICE * domain.volume:
                raise _nothing_holds()
        cleared = replace(cleared, pieces_removed=cleared.pieces_removed + removed)
        if not with_skin:
            return cleared, measured
        return replace(cleared, mesh=concatenate(solid, cleared.mesh)), combined(
            measure(solid), measured
        )

    def _uncut(self, layout: Layout, points: Floats, monitor: Monitor) -> tuple[Cleared, Quality]:
        """The lattice of whole cells as it is, without loose pieces, and its quality."""
        mesh = compact(TriangleMesh(points, facets(layout, monitor)))
        found = inspect(mesh, monitor)
        bodies = max(1, inspect(self.solid).quality.bodies)
        cleared = clear(mesh, found, _smallest_shell(self.spec), bodies=bodies)
        if cleared.mesh is mesh:
            return cleared, found.quality
        return cleared, measure(cleared.mesh, monitor)


def tile_spec(spec: LatticeSpec) -> TileSpec:
    """What the octants of a lattice are meshed for."""
    return TileSpec(spec.cell_size, spec.template_radius, spec.fillet, spec.facets_along_cell)


def _smallest_shell(spec: LatticeSpec) -> float:
    """Volume of half a facet's edge cubed, mm3: no shell smaller than that is meant."""
    return (0.5 * spec.cell_size / spec.facets_along_cell) ** 3


def _result(
    cleared: Cleared,
    measured: Quality,
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


def _nothing_holds() -> VolfrepError:
    return VolfrepError(
        "No strut reaches the skin, so that nothing would hold the lattice: reduce the cell size "
        "or choose the activation 'touching'."
    )


def _cells_are_full(spec: LatticeSpec) -> VolfrepError:
    return VolfrepError(
        f"Struts of radius {spec.strut_radius:g} mm fill cells of {spec.cell_size:g} mm "
        "completely: reduce the radius or enlarge the cells."
    )


def _fingerprint(mesh: TriangleMesh) -> str:
    digest = hashlib.blake2b(digest_size=16)
    digest.update(mesh.vertices.tobytes())
    digest.update(mesh.triangles.tobytes())
    return digest.hexdigest()


def _cell_key(cell: UnitCell) -> tuple[bytes, bytes]:
    return cell.nodes.tobytes(), cell.struts.tobytes()

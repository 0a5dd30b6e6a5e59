# SPDX-License-Identifier: LGPL-2.1-or-later
"""The one way through: solid, domain, active cells, tile, trimmed lattice, part."""

from __future__ import annotations

import hashlib
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from .cache import StageCache
from .cells import UnitCell
from .clean import shortest_edge
from .dangling import thinned
from .domain import Domain, find_domain
from .drains import trapped
from .errors import VolfrepError
from .finer import until_sound
from .finish import finished, pieces_told, tidied
from .graded import Ground, Setting, graded_wireframe, ground, keeps_places, setting
from .limits import BYTES_PER_CELL, refuse_expected, refuse_memory
from .mesh import TriangleMesh, box_of, concatenate
from .progress import Monitor, ProgressCallback
from .quality import measure
from .report import told
from .result import Result, report_of
from .solid import Solid
from .spec import LatticeSpec
from .trim import Cleared
from .trimming import FIRST_MARGIN, Output, Trimming, cell_key
from .voxels import active_cells, make_grid, mapped_grid
from .wireframe import cell_graph

Bools = NDArray[np.bool_]


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
    made, notes = until_sound(spec, lambda finer: _fill(solid, finer, Monitor(progress), cache))
    return replace(made, report=told(made.report, notes))


def _fill(solid: TriangleMesh, spec: LatticeSpec, monitor: Monitor, cache: StageCache) -> Result:
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
        clean = tidied(room, precision, monitor)
        made = Output(Cleared(clean, measure(clean), 0, 0), None)
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
    moved = spec.output != "domain" and not keeps_places(spec, where)
    mesh, quality, notes = finished(made.cleared.mesh, made.cleared.quality, monitor, moved)
    cleared, drained = made.cleared, made.drained
    warnings += notes
    warnings += pieces_told(spec, quality, cleared.pieces_removed, cleared.volume_removed)
    skin_volume = solid.volume - room.volume if spec.output == "part" else 0.0
    if drained is not None:
        warnings += drained.warnings
        skin_volume -= drained.volume
    elif spec.open_faces:
        warnings += trapped(quality.voids)
    removed = {
        "struts_dangling_removed": thin.left.dangling if thin is not None else 0,
        "stubs_removed": thin.left.stubs if thin is not None else 0,
        "pieces_removed": cleared.pieces_removed,
        "specks_removed": cleared.specks_removed,
        "drain_holes": drained.places if drained is not None else (),
    }
    report = report_of(
        quality, frame, floor.cells, active, where, spec, monitor,
        domain_volume=room.volume, skin_volume=skin_volume, warnings=warnings, removed=removed,
    )  # fmt: skip
    return Result(mesh, frame, report)


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


def _fingerprint(mesh: TriangleMesh) -> str:
    digest = hashlib.blake2b(digest_size=16)
    digest.update(mesh.vertices.tobytes())
    digest.update(mesh.triangles.tobytes())
    return digest.hexdigest()

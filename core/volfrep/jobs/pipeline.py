# SPDX-License-Identifier: LGPL-2.1-or-later
"""The one way through: solid, domain, active cells, tile, trimmed lattice, part."""

from __future__ import annotations

import hashlib
from dataclasses import replace

import numpy as np

from ..design.cells import UnitCell
from ..design.memory_guard import BYTES_PER_CELL, refuse_expected, refuse_memory
from ..design.spec import LatticeSpec
from ..grid.activation import active_cells, make_grid, mapped_grid
from ..grid.placement import Placement, graded_wireframe, placement_in
from ..grid.strut_graph import cell_graph
from ..io.solid import Solid
from ..lattice.padded_grid import PaddedGrid, keeps_places, padded_grid
from ..mesh.float32_repair import shortest_edge
from ..mesh.quality import measure
from ..mesh.triangle_mesh import TriangleMesh, box_of, concatenate
from ..reports.report import told
from ..reports.result import Result, report_of
from ..shell.domain import Domain, find_domain
from ..trim.boolean_trim import Cleared
from ..trim.drains import trapped
from ..trim.finish import finished, pieces_told, tidied
from ..trim.prune import prune
from ..trim.stage import FIRST_MARGIN, Output, TrimStage, cell_key
from ..util.cache import StageCache
from ..util.errors import VolfrepError
from ..util.progress import Monitor, ProgressCallback
from ..util.types import Bools
from .finer import until_sound


def fill(
    solid: TriangleMesh,
    spec: LatticeSpec,
    *,
    progress: ProgressCallback | None = None,
    cache: StageCache | None = None,
) -> Result:
    """Fill a solid with a lattice.

    Args:
        solid: checked closed mesh (from `volfrep.io.solid.read_solid` or `check_solid`), mm;
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
    cavity = domain.mesh
    if not len(cavity.triangles):
        raise VolfrepError(
            f"The part is nowhere thicker than two walls of {spec.shell:g} mm, so that nothing "
            "is left to fill: reduce the shell thickness."
        )

    if spec.output != "domain":
        refuse_expected(spec, cavity.volume)
    placement = placement_in(solid, spec, monitor)
    voxel_key = (wall_key, *_cells_key(cell, spec))
    with monitor.stage("voxels", 0.3, 0.4):
        padded, active = cache.get(
            "voxels", voxel_key, lambda: _voxels(solid, domain, cell, spec, placement, monitor)
        )
    if not active.any():
        where_not = "has its centre" if spec.activation == "centre" else "lies wholly"
        raise VolfrepError(
            f"No cell of {spec.cell_size:g} mm {where_not} inside the domain: reduce the cell "
            "size or choose the activation 'touching'."
        )
    pruned = None
    if spec.removes_struts:
        pruned = prune(padded, cell, active, spec, placement, domain)
        frame = pruned.frame
    else:
        graph = cell_graph(cell, active, spec.cell_size, padded.cells.origin, padded.cells.periodic)
        frame = graded_wireframe(graph, spec, placement)
    if not len(frame.struts):
        raise VolfrepError(
            "Every strut has a free end, so that none is left: keep dangling struts, reduce the "
            "cell size or choose the activation 'touching'."
        )

    if spec.output == "domain":
        precision = shortest_edge(solid)
        clean = tidied(cavity, precision, monitor)
        made = Output(Cleared(clean, measure(clean), 0, 0), None)
    else:
        trimming = TrimStage(
            solid, domain, cell, spec, placement, padded, active, pruned, voxel_key
        )
        with monitor.stage("tile", 0.4, 0.5):
            margin = 0.0 if keeps_places(spec, placement) else FIRST_MARGIN
            if not spec.is_cut:
                margin = np.inf  # no wall that an octant could reach
            kept, octants = trimming.octants(margin, cache, monitor)
        with monitor.stage("lattice", 0.5, 0.6):
            kept, layout, points = trimming.lay(kept, octants, margin, cache, monitor)
        with monitor.stage("trim", 0.6, 1.0):
            made = trimming.output(kept, layout, points, frame, monitor)
    moved = spec.output != "domain" and not keeps_places(spec, placement)
    mesh, quality, notes = finished(made.cleared.mesh, made.cleared.quality, monitor, moved)
    cleared, drained = made.cleared, made.drained
    warnings += notes
    warnings += pieces_told(spec, quality, cleared.pieces_removed, cleared.volume_removed)
    skin_volume = solid.volume - cavity.volume if spec.output == "part" else 0.0
    if drained is not None:
        warnings += drained.warnings
        skin_volume -= drained.volume
    elif spec.open_faces:
        warnings += trapped(quality.voids)
    removed = {
        "struts_dangling_removed": pruned.left.dangling if pruned is not None else 0,
        "stubs_removed": pruned.left.stubs if pruned is not None else 0,
        "pieces_removed": cleared.pieces_removed,
        "specks_removed": cleared.specks_removed,
        "drain_holes": drained.places if drained is not None else (),
    }
    report = report_of(
        quality, frame, padded.cells, active, placement, spec, monitor,
        domain_volume=cavity.volume, skin_volume=skin_volume, warnings=warnings, removed=removed,
    )  # fmt: skip
    return Result(mesh, frame, report)


def _voxels(
    solid: TriangleMesh,
    domain: Domain,
    cell: UnitCell,
    spec: LatticeSpec,
    placement: Placement,
    monitor: Monitor,
) -> tuple[PaddedGrid, Bools]:
    whole, origin = solid, spec.origin
    if domain.is_open:  # octants are wanted beyond the part, too; the cells still begin at it
        whole = concatenate(solid, domain.wall)
        x, y, z = solid.bounds[0]
        origin = origin or (float(x), float(y), float(z))
    if placement.mapping is None:
        cells = make_grid(box_of(whole.vertices), spec.cell_size, origin)
    else:
        cells = mapped_grid(whole, placement.mapping, spec.cell_size, spec.origin, monitor)
    refuse_memory(spec, 0, other=cells.cells * BYTES_PER_CELL)
    padded = padded_grid(cells, cell, spec, placement)
    usable = padded.inner_usable
    return padded, active_cells(
        cells, domain.mesh, spec.activation, monitor, placement.mapping, usable
    )


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

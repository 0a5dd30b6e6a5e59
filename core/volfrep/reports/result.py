# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a run hands out: a surface, its wireframe, and its figures."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ..design.spec import LatticeSpec
from ..grid.cell_grid import CellGrid
from ..grid.placement import Placement
from ..grid.size_ranges import sizes
from ..grid.strut_graph import Wireframe
from ..mesh.quality import Quality
from ..mesh.triangle_mesh import TriangleMesh
from ..util.progress import Monitor, peak_memory_mb
from .report import Report

if TYPE_CHECKING:
    from ..trim.trimmed_surface import TrimmedSurface

#: Figures that a run without trimming has none of.
NOTHING_REMOVED: Mapping[str, Any] = {
    "struts_dangling_removed": 0,
    "stubs_removed": 0,
    "thin_struts_removed": 0,
    "flat_struts_removed": 0,
    "pieces_removed": 0,
    "specks_removed": 0,
    "drain_holes": (),
}


@dataclass(frozen=True, eq=False)
class Result:
    """What a run made.

    Attributes:
        surface: of the part, the lattice or the domain, as asked for.
        wireframe: the unique nodes and struts of the active cells.
        report: the figures.

    >>> import volfrep
    >>> part = volfrep.block((1, 1, 1), cell="BCC", cell_size=10, strut_radius=1)
    >>> part.result.report.triangles == len(part.result.mesh.triangles)
    True
    """

    surface: TrimmedSurface
    wireframe: Wireframe
    report: Report

    @cached_property
    def mesh(self) -> TriangleMesh:
        """The surface as one mesh, made when it is first asked for; its arrays can be written."""
        whole = self.surface.whole(Monitor())
        return TriangleMesh(
            np.require(whole.vertices, requirements="W"),
            np.require(whole.triangles, requirements="W"),
        )


def report_of(
    measured: Quality,
    frame: Wireframe,
    cells: CellGrid | None,
    active: NDArray[np.bool_] | None,
    placement: Placement,
    spec: LatticeSpec,
    monitor: Monitor,
    *,
    domain_volume: float,
    skin_volume: float = 0.0,
    warnings: tuple[str, ...] = (),
    removed: Mapping[str, Any] = NOTHING_REMOVED,
) -> Report:
    """The figures of a run.

    Args:
        measured: of the mesh that is handed out.
        frame: the struts of the active cells, in the part.
        cells: the grid; None: the lattice has no cells.
        active: (nx, ny, nz) bool, those that hold a lattice.
        placement: of the lattice in the part.
        spec: what was wanted.
        monitor: of the run.
        domain_volume: of what the lattice fills, mm3.
        skin_volume: of what in the mesh is not lattice, mm3.
        warnings: sentences for the user.
        removed: the figures named in `NOTHING_REMOVED`.
    """
    size = sizes(spec.cell_size, cells, active, placement.mapping, frame)
    return Report(
        cells_total=0 if cells is None else cells.cells,
        cells_active=0 if active is None else int(active.sum()),
        grid=(0, 0, 0) if cells is None else cells.shape,
        nodes=len(frame.nodes),
        struts=len(frame.struts),
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
        stages=dict(monitor.stages),
        stage_memory_mb=dict(monitor.memory_mb),
        work=dict(monitor.work),
        peak_memory_mb=peak_memory_mb(),
        workers_memory_mb=monitor.backend.memory_mb,
        spec=spec.as_dict(),
        warnings=spec.notes + warnings,
        **removed,
    )

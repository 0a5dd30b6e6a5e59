# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a run made, in figures: shown to the user and serialised to JSON."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass, field, replace
from typing import Any


@dataclass(frozen=True)
class Report:
    """Figures of one result, all measured on the mesh that is handed out.

    Attributes:
        cells_total: cells in the grid.
        cells_active: cells that hold a lattice.
        grid: cells along x, y, z.
        nodes, struts: of the unique wireframe of the active cells (before trimming, without what
            was removed).
        cell_edges_mm: the shortest and the longest edge of an active cell.
        strut_lengths_mm: the shortest and the longest strut, from node to node (before trimming).
        strut_radii_mm: the smallest and the largest radius of a strut.
        triangles, vertices: of the mesh.
        bodies: separate pieces of material (surfaces that enclose material).
        voids: closed cavities (surfaces that enclose emptiness).
        genus: through-holes, summed over all the surfaces.
        volume_mm3, area_mm2: of the mesh.
        domain_volume_mm3: of what the lattice fills.
        relative_density: volume of the lattice over the volume of its domain.
        mass_g: of the mesh at the given density.
        watertight: every edge shared by exactly two triangles, oriented oppositely.
        struts_dangling_removed: struts that were taken away because they had a free end.
        stubs_removed: struts that were taken away because they were short and had a free end.
        thin_struts_removed: struts that were taken away because they were nowhere thick enough.
        flat_struts_removed: struts that were taken away because they lay too flat to be built.
        pieces_removed: lattice fragments that hung on nothing and were dropped.
        specks_removed: shells smaller than a facet that were dropped.
        drain_holes: where holes go through the skin, on the part's surface, mm.
        stages: seconds by stage.
        stage_memory_mb: peak resident memory at the end of each stage, MB.
        work: what was done, counted: walls found, kinds of octants meshed, triangles laid,
            triangles into the Boolean, bytes written; what was not done is not there.
        peak_memory_mb: of the process.
        workers_memory_mb: of its workers, each at its own peak, together; 0 where there are none,
            or the system does not tell.
        spec: the specification, as plain values.
        target: what the radius was chosen for, what was reached, and `strut_radius_mm`; None
            where the radius was given.
        warnings: sentences for the user.

    >>> import volfrep
    >>> report = volfrep.block((2, 1, 1), cell="CVC", cell_size=10, strut_radius=1).report
    >>> report.cells_active, report.nodes, report.struts, report.bodies, report.genus
    (2, 14, 16, 1, 3)
    >>> report.as_dict()["watertight"]
    True
    """

    cells_total: int
    cells_active: int
    grid: tuple[int, int, int]
    nodes: int
    struts: int
    cell_edges_mm: tuple[float, float]
    strut_lengths_mm: tuple[float, float]
    strut_radii_mm: tuple[float, float]
    triangles: int
    vertices: int
    bodies: int
    voids: int
    genus: int
    volume_mm3: float
    area_mm2: float
    domain_volume_mm3: float
    relative_density: float
    mass_g: float
    watertight: bool
    struts_dangling_removed: int
    stubs_removed: int
    thin_struts_removed: int
    flat_struts_removed: int
    pieces_removed: int
    specks_removed: int
    drain_holes: tuple[tuple[float, float, float], ...]
    stages: dict[str, float]
    stage_memory_mb: dict[str, float]
    work: dict[str, int]
    peak_memory_mb: float
    spec: dict[str, Any] = field(default_factory=dict)
    warnings: tuple[str, ...] = ()
    target: dict[str, Any] | None = None
    workers_memory_mb: float = 0.0

    @property
    def lattice(self) -> str:
        """What the lattice is called: its cell, or the graph that is there in place of cells.

        >>> import volfrep
        >>> corner = ([[0, 0, 0], [9, 0, 0], [0, 9, 0]], [(0, 1), (0, 2)])
        >>> volfrep.mesh_network(corner, strut_radius=1).report.lattice
        'Strut graph'
        """
        network = self.spec.get("network")
        if self.cells_total or network is None:
            return str(self.spec.get("cell", "Lattice"))
        kind = network.get("kind") if isinstance(network, dict) else None
        return f"{kind.capitalize()} graph" if kind else "Strut graph"

    @property
    def figures(self) -> dict[str, str]:
        """What a file of the part may keep: the same for the same part, whenever it was made."""
        bodies = f"{self.bodies:,} {'body' if self.bodies == 1 else 'bodies'}"
        cells = f"{self.cells_active:,} cells, " * bool(self.cells_total)
        return {
            "Description": (
                f"{self.lattice}{' lattice' * bool(self.cells_total)}: {cells}"
                f"{self.struts:,} struts, {bodies}, {self.volume_mm3:,.1f} mm3, "
                f"{self.area_mm2:,.1f} mm2, relative density {self.relative_density:.2%}, "
                f"{self.mass_g:,.2f} g"
            ),
            "Cells": str(self.cells_active),
            "Struts": str(self.struts),
            "Nodes": str(self.nodes),
            "Triangles": str(self.triangles),
            "Bodies": str(self.bodies),
            "Voids": str(self.voids),
            "VolumeMm3": f"{self.volume_mm3:.6g}",
            "AreaMm2": f"{self.area_mm2:.6g}",
            "RelativeDensity": f"{self.relative_density:.6g}",
            "MassG": f"{self.mass_g:.6g}",
            "Specification": json.dumps(self.spec, sort_keys=True),
        }

    def as_dict(self) -> dict[str, Any]:
        """The figures as plain JSON values."""
        return asdict(self)

    def to_json(self) -> str:
        """The figures as a JSON text."""
        return json.dumps(self.as_dict(), indent=2)


def with_warnings(report: Report, sentences: tuple[str, ...]) -> Report:
    """The report with further sentences for the user."""
    return replace(report, warnings=report.warnings + sentences) if sentences else report

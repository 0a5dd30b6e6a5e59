# SPDX-License-Identifier: LGPL-2.1-or-later
"""Decks for CalculiX: struts as beams with stiff ends, or the part as tetrahedra."""

from __future__ import annotations

import os

from ..fem.beam_mesh import beam_model, fitted_beams
from ..fem.deck import write_beams, write_tetrahedra
from ..fem.joint_loads import side_joints
from ..fem.tet_mesh import TetrahedralMesh, nodes_on, tetrahedra
from ..reports.estimate import (
    Estimate,
    estimate_beams,
    estimate_lattice_tetrahedra,
    estimate_tetrahedra,
)
from ..trim.beam_model import deformed_struts
from .writer import Settings, Source, Writer, Written


class BeamDeckWriter(Writer):
    """Beams along the struts' axes."""

    def estimate(self, source: Source) -> Estimate:
        """As of `Writer`."""
        axes = source.axes
        return estimate_beams(beam_model(axes.wireframe, axes.on_boundary), source.choice)

    def write(self, source: Source, path: str | os.PathLike[str], settings: Settings) -> Written:
        """As of `Writer`."""
        spec, axes = source.spec, source.axes
        frame = axes.wireframe
        model, warnings = fitted_beams(frame, axes.on_boundary, spec.kind.cube, spec.cell_size)
        settings.tell(estimate_beams(model, source.choice))
        write_beams(model, path, settings.material, on_boundary=axes.on_boundary)
        warnings = axes.warnings + warnings + deformed_struts(spec.grid, spec.struts)
        row = ("struts", f"{len(frame.struts):,} between {len(frame.nodes):,} nodes, as beams")
        return Written(warnings, (row,))


class TetrahedraWriter(Writer):
    """Second-order tetrahedra by Gmsh."""

    def estimate(self, source: Source) -> Estimate:
        """As of `Writer`."""
        return estimate_tetrahedra(source.triangles, source.choice)

    def write(self, source: Source, path: str | os.PathLike[str], settings: Settings) -> Written:
        """As of `Writer`."""
        settings.tell(self.estimate(source))

        def tell(count: int) -> None:
            settings.tell(estimate_lattice_tetrahedra(count))

        deviation = source.spec.deviation
        filled = tetrahedra(source.mesh, source.monitor, tell, deviation)
        sides, outside, sets = source.sides, source.outside, {}
        if sides is not None:
            sets = side_joints(filled, sides)
        if outside is not None:
            sets["SKIN"] = nodes_on(filled, outside)
        write_tetrahedra(filled, path, settings.material, sets=sets)
        return Written(*_told(filled, deviation))


def _told(
    filled: TetrahedralMesh, deviation: float | None
) -> tuple[tuple[str, ...], tuple[tuple[str, str], ...]]:
    """Warnings and rows: how far the tetrahedra's surface is from the mesh's, where mended."""
    if not filled.strayed:
        return filled.warnings, ()
    away = f"{filled.strayed:.2g} mm"
    warnings = filled.warnings
    if deviation is not None and filled.strayed > deviation:
        warnings = (
            *warnings,
            f"The tetrahedra's surface is up to {away} from the mesh's, which is more than the "
            f"deviation of {deviation:.3g} mm: smaller facets keep it nearer.",
        )
    return warnings, (("surface", f"within {away} of the mesh's, its needles mended"),)

# SPDX-License-Identifier: LGPL-2.1-or-later
"""A lattice infill's mesh and figures: what is made, and how it comes into the document."""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import FreeCAD as App

from freecad_volfrep.features.jobs.job import Job
from freecad_volfrep.features.properties.quantities import is_driven, number_of, set_value
from freecad_volfrep.sentences import report_line
from volfrep.design.parameters.table import BY_NAME

from .properties import PROPERTIES, RESULT

if TYPE_CHECKING:
    import Mesh

    from volfrep import LatticeSpec
    from volfrep.jobs.pipeline import FilledMesh
    from volfrep.process.worker import Call
    from volfrep.reports.report import Report


class MeshJob(Job):
    """An infill's mesh that is made.

    Args:
        title: of the job.
        call: of the engine, for what `volfrep.jobs.pipeline.forecast_and_fill` returns.
        spec: how it is made.
        fingerprint: of all that it depends on.
        said: `Status` of the infill meanwhile.
    """

    #: Whether a recompute of the user's has asked for it, so that the next one may replace it.
    follows = False

    def __init__(
        self, title: str, call: Call, spec: LatticeSpec, fingerprint: str, said: str
    ) -> None:
        super().__init__(title, call)
        self.spec, self.fingerprint, self.said = spec, fingerprint, said


def loaded(filled: FilledMesh) -> Mesh.Mesh:
    """FreeCAD's mesh of what has come.

    Raises:
        VolfrepError: FreeCAD did not take every triangle.
    """
    from freecad_volfrep.bridge.meshes import to_freecad, with_neighbours

    if filled.shown is None:
        return to_freecad(filled.mesh)
    return with_neighbours(filled.mesh.vertices, filled.shown.facets)


def loaded_in_steps(filled: FilledMesh) -> Generator[None, None, Mesh.Mesh]:
    """As `loaded`, between whose steps the window answers."""
    from freecad_volfrep.bridge.meshes import neighbours_in_steps, to_freecad

    if filled.shown is None:
        return to_freecad(filled.mesh)
    return (yield from neighbours_in_steps(filled.mesh.vertices, filled.shown.facets))


def install(obj: App.DocumentObject, job: MeshJob, filled: FilledMesh, mesh: Mesh.Mesh) -> None:
    """Give an infill the mesh that was asked for, and its figures."""
    from .skin import made_of

    made = with_radius(job.spec, filled.report.target)
    obj.Proxy.made = made_of(filled)
    _write_results(obj, filled.report)
    if job.spec.target is not None:
        tell_driven(obj, *_thickness(made))
    obj.Fingerprint = job.fingerprint
    # Last: whatever follows a new mesh, as its colours do, asks what it is of.
    placement = obj.Placement
    obj.Mesh = mesh
    obj.Placement = placement  # assigning a mesh also assigns the mesh's placement


def with_radius(spec: LatticeSpec, found: dict[str, Any] | None) -> LatticeSpec:
    """The specification with the radius that a report says was found, in place of its target."""
    if spec.target is None or found is None:
        return spec
    return replace(spec, target=None).with_thickness(found[f"{spec.kind.measure}_mm"])


def _thickness(spec: LatticeSpec) -> tuple[str, float]:
    """The property that says how thick struts or walls are, and what it is."""
    return BY_NAME[spec.kind.measure].property_name, spec.kind.thickness


def tell_driven(obj: App.DocumentObject, name: str, value: float) -> None:
    """Show in a property what drives it has come to; what an expression drives stays."""
    plain = name in ("Density", "WallOffset")
    before = number_of(obj, name) if plain else getattr(obj, name).Value
    if not is_driven(obj, name) and before != value:
        set_value(obj, name, value)


def _write_results(obj: App.DocumentObject, report: Report) -> None:
    values = {
        "CellsTotal": report.cells_total,
        "CellsActive": report.cells_active,
        "Nodes": report.nodes,
        "Struts": report.struts,
        "CellEdges": report.cell_edges_mm,
        "StrutLengths": report.strut_lengths_mm,
        "StrutRadii": report.strut_radii_mm,
        "Triangles": report.triangles,
        "Bodies": report.bodies,
        "Voids": report.voids,
        "DrainHoles": [App.Vector(*hole) for hole in report.drain_holes],
        "Genus": report.genus,
        "Volume": report.volume_mm3,
        "RelativeDensity": report.relative_density,
        "Mass": report.mass_g,
        "DanglingRemoved": report.struts_dangling_removed,
        "StubsRemoved": report.stubs_removed,
        "PiecesRemoved": report.pieces_removed,
        "Watertight": report.watertight,
        "Seconds": sum(report.stages.values()),
        "Report": report.to_json(),
        "Warnings": list(report.warnings),
    }
    results = {prop.name for prop in PROPERTIES if prop.group == RESULT} - {"Status", "Expected"}
    assert values.keys() == results, "the table of properties and the report have drifted apart"
    for name, value in values.items():
        set_value(obj, name, value)
    for sentence in report.warnings:
        App.Console.PrintWarning(report_line(obj.Label, sentence))
    made = (
        f"{report.cells_active} of {report.cells_total} cells, "
        f"{report.triangles} triangles, {report.mass_g:.4g} g in {obj.Seconds:.1f} s"
    )
    App.Console.PrintMessage(report_line(obj.Label, made))

# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a reader of its file will see of a mesh object, and what FreeCAD's own checks say."""

from __future__ import annotations

from typing import TYPE_CHECKING

import FreeCAD as App

from freecad_volfrep.engine import require_engine
from freecad_volfrep.features.infill.freshness import tell_stale
from freecad_volfrep.features.jobs.progress import job_title, run_job
from volfrep.reports.tables import Table
from volfrep.util.errors import VolfrepError
from volfrep.util.numbers import place_text, plural

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from volfrep.reports.mesh_report import MeshReport


def check_mesh(obj: App.DocumentObject) -> list[Table]:
    """The figures of any mesh object, where it lies in the document.

    Raises:
        VolfrepError: it has no mesh.
        Cancelled: in the window, by the user.
    """
    require_engine()
    from freecad_volfrep.bridge.solids import mesh_in_document
    from volfrep.reports.mesh_report import checked_mesh

    if not obj.isDerivedFrom("Mesh::Feature") or not obj.Mesh.CountFacets:
        raise VolfrepError(f"'{obj.Label}' has no mesh to check: update it first.")
    said = tell_stale(obj)
    mesh = mesh_in_document(obj)
    report, crossing = run_job(job_title("Checking {label}", obj), checked_mesh, mesh)
    return [
        Table(f"{obj.Label}: {_verdict(report, crossing)}", (*_stale(said), *report.rows())),
        Table("Triangles and the file's single precision", tuple(_precision(report))),
        Table("Surfaces that run through each other", tuple(_crossings(report, crossing))),
        Table("FreeCAD's own checks", tuple(_freecads_own(obj))),
    ]


def _stale(said: tuple[str, ...]) -> list[tuple[str, str]]:
    return [("out of date", sentence) for sentence in said]


def _verdict(report: MeshReport, crossing: NDArray[np.float64]) -> str:
    if report.printable and not len(crossing):
        return "closed and without defects"
    if not report.closed:
        return "not closed"
    return "has defects"


def _precision(report: MeshReport) -> list[tuple[str, str]]:
    shapes = report.shapes
    lost = report.quality.degenerate_triangles
    kept = f"{lost:,} triangles collapse" if lost else "every triangle keeps its corners"
    return [
        ("as a file holds it", kept),
        ("step of its numbers", f"{report.step:.2g} mm"),
        ("shortest edge", f"{report.shortest_edge:.3g} mm"),
        ("mean radius ratio", f"{shapes.radius_ratio_mean:.3f} (1 is equilateral)"),
        ("smallest radius ratio", f"{shapes.radius_ratio_min:.2g}"),
    ]


def _crossings(report: MeshReport, crossing: NDArray[np.float64]) -> list[tuple[str, str]]:
    if report.overlap is None:
        lines = "not looked for: the mesh is not closed"
    elif report.overlaps:
        lines = f"about {report.overlap:,.3g} mm3 enclosed more than once or the wrong way round"
    else:
        lines = "every place inside is enclosed once"
    triangles = "none"
    if len(crossing):
        triangles = f"{plural(len(crossing), 'pair')}, first near {place_text(crossing[0])}"
    return [("along lines through it", lines), ("triangles that cross", triangles)]


def _freecads_own(obj: App.DocumentObject) -> list[tuple[str, str]]:
    mesh = obj.Mesh
    return [
        ("non-manifold edges or points", _found(mesh.hasNonManifolds())),
        ("wrongly oriented triangles", _found(mesh.hasNonUniformOrientedFacets())),
        ("corrupted triangles", _found(mesh.hasCorruptedFacets())),
        ("invalid points", _found(mesh.hasInvalidPoints())),
        ("wrong neighbours", _found(mesh.hasInvalidNeighbourhood())),
        ("a solid", "yes" if mesh.isSolid() else "no"),
    ]


def _found(found: bool) -> str:
    return "found" if found else "none"

# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a reader of its file will see of a mesh object, and what FreeCAD's own checks say."""

from __future__ import annotations

from typing import TYPE_CHECKING

import FreeCAD as App

from freecad_volfrep.engine import require_engine
from volfrep.errors import VolfrepError

from .progress import job_title, progress_of
from .tables import Table

if TYPE_CHECKING:
    from volfrep.mesh_report import MeshReport

#: FreeCAD's search for triangles that run through each other takes 3 s per million on a fast
#: machine and cannot be cancelled: it is left out above so many triangles.
MOST_FOR_FREECAD = 1_000_000


def check_mesh(obj: App.DocumentObject) -> list[Table]:
    """The figures of any mesh object, where it lies in the document.

    Raises:
        VolfrepError: it has no mesh.
        Cancelled: in the window, by the user.
    """
    require_engine()
    from freecad_volfrep.bridge.solids import mesh_in_document
    from volfrep.mesh_report import mesh_report
    from volfrep.progress import Monitor

    if not obj.isDerivedFrom("Mesh::Feature") or not obj.Mesh.CountFacets:
        raise VolfrepError(f"'{obj.Label}' has no mesh to check: update it first.")
    with progress_of(job_title("Checking {label}", obj)) as progress:
        monitor = Monitor(progress)
        report = mesh_report(mesh_in_document(obj), monitor, look_for_overlaps=True)
        own = _freecads_own(obj)
    return [
        Table(f"{obj.Label}: {_verdict(report)}", tuple(report.rows())),
        Table("Triangles and the file's single precision", tuple(_precision(report))),
        Table("Surfaces that run through each other", tuple(_crossings(report, own))),
        Table("FreeCAD's own checks", tuple(own)),
    ]


def _verdict(report: MeshReport) -> str:
    if report.printable:
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


def _crossings(report: MeshReport, own: list[tuple[str, str]]) -> list[tuple[str, str]]:
    if report.overlap is None:
        lines = "not looked for: the mesh is not closed"
    elif report.overlaps:
        lines = f"about {report.overlap:,.3g} mm3 enclosed more than once or the wrong way round"
    else:
        lines = "every place inside is enclosed once"
    return [("along lines through it", lines), own.pop()]


def _freecads_own(obj: App.DocumentObject) -> list[tuple[str, str]]:
    """FreeCAD's checks; the last row is that for triangles that cross."""
    mesh = obj.Mesh
    rows = [
        ("non-manifold edges or points", _found(mesh.hasNonManifolds())),
        ("wrongly oriented triangles", _found(mesh.hasNonUniformOrientedFacets())),
        ("corrupted triangles", _found(mesh.hasCorruptedFacets())),
        ("invalid points", _found(mesh.hasInvalidPoints())),
        ("wrong neighbours", _found(mesh.hasInvalidNeighbourhood())),
        ("a solid", "yes" if mesh.isSolid() else "no"),
    ]
    what = "triangles that cross (FreeCAD)"
    if mesh.CountFacets > MOST_FOR_FREECAD:
        return [*rows, (what, f"not looked for above {MOST_FOR_FREECAD:,} triangles")]
    # FreeCAD 0.20 finds the places before the placement, 1.0 behind it: here there is none.
    unplaced = mesh.copy()
    unplaced.Placement = App.Placement()
    pairs = unplaced.getSelfIntersections()
    if not pairs:
        return [*rows, (what, "none")]
    place = obj.Placement.multVec(pairs[0][2])
    near = f"({place.x:.3g}, {place.y:.3g}, {place.z:.3g})"
    return [*rows, (what, f"{len(pairs):,} pairs, first near {near}")]


def _found(found: bool) -> str:
    return "found" if found else "none"

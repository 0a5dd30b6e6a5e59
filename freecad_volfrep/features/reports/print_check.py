# SPDX-License-Identifier: LGPL-2.1-or-later
"""A lattice infill held against a printing process: the facets that hang over, and figures."""

from __future__ import annotations

from typing import TYPE_CHECKING

import FreeCAD as App

from freecad_volfrep.engine import require_engine
from freecad_volfrep.features.infill.lattice_infill import check_infill, is_infill
from freecad_volfrep.features.infill.materials import process_of
from freecad_volfrep.features.jobs.job import State
from freecad_volfrep.features.jobs.progress import job_title, run_job
from freecad_volfrep.features.jobs.screen import attach_view
from freecad_volfrep.features.properties.property_table import Property, add_missing, result
from freecad_volfrep.features.properties.quantities import set_value
from freecad_volfrep.saved_names import SavesNothing, saved_module
from freecad_volfrep.sentences import report_line
from freecad_volfrep.translation import translate
from volfrep.util.errors import Cancelled, VolfrepError

if TYPE_CHECKING:
    from volfrep.reports.printability import PrintReport

CANCELLED = "Cancelled: other figures are those of the last finished check, if there was one."

PROPERTIES = (
    Property("App::PropertyLink", "Infill", "Print", "The lattice infill to look at"),
    Property("App::PropertyEnumeration", "Process", "Print", "How it will be printed", "FFF"),
    Property(
        "App::PropertyVector",
        "BuildDirection",
        "Print",
        "From the build plate up, in the document's coordinates",
        App.Vector(0, 0, 1),
    ),
    result("App::PropertyStringList", "Findings", "What does not suit the process"),
    result("App::PropertyString", "Limits", "Of the process, and their source"),
    result("App::PropertyFloat", "ThinnestStrut", "Smallest diameter of a strut, mm"),
    result("App::PropertyFloat", "ThinnestWall", "Least thickness of walls, mm"),
    result("App::PropertyString", "NarrowestGap", "Between struts that do not meet, mm"),
    result("App::PropertyString", "LargestBall", "That gets out of the lattice, mm; for powder"),
    result("App::PropertyPercent", "OverhangShare", "Of the struts' length, too flat"),
    result("App::PropertyLength", "LongestOverhang", "Length of the longest strut of these"),
    result("App::PropertyArea", "OverhangArea", "Of the facets that hang over: this object's mesh"),
    result("App::PropertyInteger", "Voids", "Closed cavities"),
    result("App::PropertyVolume", "VoidVolume", "Their volume"),
    result("App::PropertyArea", "SurfaceArea", "Of the part"),
    result("App::PropertyMass", "Mass", "Of the part, g"),
    result("App::PropertyString", "Text", "All figures, for people"),
    result("App::PropertyString", "Report", "All figures, as JSON"),
)


class PrintCheck(SavesNothing):
    """Proxy of a ``Mesh::FeaturePython`` that shows how a lattice infill suits a process.

    Its mesh is what of the infill's hangs over: red on the infill, which is translucent.
    """

    state = State.IDLE

    def __init__(self, obj: App.DocumentObject) -> None:
        obj.Proxy = self
        self._ensure_properties(obj)

    def execute(self, obj: App.DocumentObject) -> None:
        """Bring mesh and figures up to date; called by FreeCAD's recompute.

        A cancelled check is no error: the last figures stay, and `Text` says so.

        Raises:
            VolfrepError: one sentence; the object turns Invalid.
        """
        self.state = State.RUNNING
        try:
            self._run(obj)
        except VolfrepError as error:
            self.state = State.FAILED
            App.Console.PrintError(report_line(obj.Label, str(error)))
            raise
        except Cancelled:
            self.state = State.CANCELLED
            obj.Text = CANCELLED
            App.Console.PrintMessage(report_line(obj.Label, CANCELLED))
        else:
            self.state = State.IDLE

    def onDocumentRestored(self, obj: App.DocumentObject) -> None:  # noqa: N802
        """Bring an object of an older file up to the present table of properties."""
        self._ensure_properties(obj)

    def _ensure_properties(self, obj: App.DocumentObject) -> None:
        from volfrep.reports.processes import PROCESSES

        add_missing(obj, PROPERTIES, {"Process": list(PROCESSES)})

    def _run(self, obj: App.DocumentObject) -> None:
        infill = obj.Infill
        if infill is None or not is_infill(infill):
            raise VolfrepError("There is nothing to look at: choose a lattice infill as Infill.")
        require_engine()
        from freecad_volfrep.bridge.beams import place_in_document, placed_lattice
        from freecad_volfrep.bridge.meshes import to_freecad
        from freecad_volfrep.bridge.solids import mesh_in_document, placed
        from volfrep.jobs.beam_part import struts_and_cavity
        from volfrep.jobs.figures.print_check import print_check
        from volfrep.reports.processes import find_process

        solid, spec, cache = infill.Proxy.inputs(infill)
        if spec.output == "domain":
            raise VolfrepError(f"'{infill.Label}' holds no lattice: set its Output to part.")

        title = job_title("Print check of {label}", infill)
        struts, cavity = run_job(title, struts_and_cavity, solid, spec, cache=cache)
        place = place_in_document(infill)
        report, hanging = run_job(
            title,
            print_check,
            mesh_in_document(infill),
            placed_lattice(struts, place),
            placed(cavity, place),
            spec,
            find_process(obj.Process),
            tuple(obj.BuildDirection),
            has_progress=False,
        )
        obj.Mesh = to_freecad(hanging)
        _write_results(obj, report)


# Saved files find the class under this name.
PrintCheck.__module__ = saved_module("features")


def make_print_check(
    doc: App.Document,
    infill: App.DocumentObject,
    process: str | None = None,
    build_direction: tuple[float, float, float] | None = None,
) -> App.DocumentObject:
    """Add a print check of a lattice infill; ``doc.recompute()`` then computes it.

    Args:
        doc: the document that holds the infill.
        infill: a lattice infill.
        process: FFF, SLA, SLS, MJF, LPBF or EBM; None for the infill's, else FFF.
        build_direction: from the build plate up, in the document's coordinates; None for the
            infill's.

    Raises:
        VolfrepError: there is no such process, or that is no lattice infill; nothing is added.
    """
    from freecad_volfrep.bridge.beams import place_in_document
    from volfrep.grid.inclination import unit_direction
    from volfrep.reports.processes import find_process

    check_infill(infill)
    name = find_process(process or process_of(infill) or "FFF").name
    if build_direction is None:
        turn = place_in_document(infill).Rotation
        build_direction = tuple(turn.multVec(infill.BuildDirection))
    unit_direction(build_direction)
    obj = doc.addObject("Mesh::FeaturePython", "PrintCheck")
    PrintCheck(obj)
    obj.Infill = infill
    obj.Label = translate("VolfrepLabels", "{label} print check").format(label=infill.Label)
    obj.Process = name
    obj.BuildDirection = App.Vector(*build_direction)
    attach_view(obj)
    return obj


def _write_results(obj: App.DocumentObject, report: PrintReport) -> None:
    rows = dict(report.rows())
    obj.Findings = list(report.findings)
    obj.Limits = (
        f"strut {report.process.strut:g} mm, wall {report.process.wall:g} mm, "
        f"gap {report.process.gap:g} mm, inclination "
        f"{report.process.inclination:g} degrees ({report.process.source})"
    )
    obj.ThinnestStrut = report.thinnest_strut_mm or 0.0
    obj.ThinnestWall = report.thinnest_wall_mm or 0.0
    obj.NarrowestGap = rows["narrowest gap"]
    obj.LargestBall = rows.get("largest ball that gets out", "differs from cell to cell")
    obj.OverhangShare = round(100 * report.overhanging_share)
    obj.LongestOverhang = report.longest_overhang_mm
    obj.OverhangArea = report.overhang_area_mm2
    obj.Voids = report.voids
    obj.VoidVolume = report.void_volume_mm3
    obj.SurfaceArea = report.area_mm2
    set_value(obj, "Mass", report.mass_g)
    obj.Text = report.to_text()
    obj.Report = report.to_json()
    for sentence in report.findings:
        App.Console.PrintWarning(report_line(obj.Label, sentence))

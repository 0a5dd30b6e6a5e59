# SPDX-License-Identifier: LGPL-2.1-or-later
"""A design on the bench, and what the actions of `actions` do with it."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

from ...design.field_files import write_points
from ...design.parameters.spec_file import write_values
from ...design.spec import LatticeSpec
from ...io.solid import Solid
from ...jobs.figures.print_check import check_print
from ...jobs.figures.properties import lattice_properties
from ...jobs.infill import Infill
from ...jobs.kinds import lattice_kind
from ...jobs.preview import PartDepth
from ...jobs.result_files import values_with_radii
from ...jobs.sizing import size, solve_struts
from ...jobs.sizing.goal import goal_of
from ...jobs.targets import solve_target
from ...loads.load_cases import LoadCases
from ...loads.load_file import read_load_cases
from ...mechanics.materials import Material
from ...mechanics.summary import MODULI, RATIOS, CellProperties
from ...output.form import find_form
from ...output.sources import FilledPart
from ...output.writer import Settings, writer_of
from ...reports.mesh_report import mesh_report
from ...reports.picture import picture
from ...sizing.analysis import Analysis
from ...util.cache import StageCache
from ...util.errors import Cancelled, VolfrepError
from ...util.progress import ProgressCallback
from ..actions import Asked, Figure
from ..expectation import Expectation, expect

#: Figures of the endless lattice, beside the moduli and ratios.
LIMITS = ("strength", "shear_strength", "conductivity")
#: Pixels of a study's pictures.
PICTURE_SIZE = (900, 600)


@dataclass
class Shared:
    """What the runs of one batch share, so that it is made once.

    Attributes:
        solids: the parts, by their content.
        cache: the stages of the fill before, such as the wall of the same skin.
        depths: of the parts, by their content and open faces.
        properties: of endless lattices, by what they hang on.
    """

    solids: dict[str, Solid] = field(default_factory=dict)
    cache: StageCache = field(default_factory=StageCache)
    depths: dict[Any, PartDepth] = field(default_factory=dict)
    properties: dict[Any, dict[str, Figure]] = field(default_factory=dict)


@dataclass(eq=False)
class Evaluator:
    """A design on the bench: what its actions see, made when first looked at.

    Attributes:
        key: of the design.
        solid: the part.
        spec: what is made.
        up: the build direction.
        asked: by the study.
        shared: with other runs.
        progress: asked for a cancel.
        notes: sentences for the user, by the names of actions.
    """

    key: str
    solid: Solid
    spec: LatticeSpec
    up: tuple[float, float, float]
    asked: Asked
    shared: Shared
    progress: ProgressCallback | None = None
    notes: dict[str, list[str]] = field(default_factory=dict)

    @cached_property
    def expectation(self) -> Expectation:
        """What it will come to."""
        spec = self.spec
        faces = (spec.open_faces, spec.face_skins, spec.keep_solid)
        place = (id(self.solid), faces)
        if place not in self.shared.depths:
            self.shared.depths[place] = PartDepth(self.solid, *faces)
        return expect(self.solid, self.spec, self.shared.depths[place])

    @cached_property
    def _infill(self) -> Infill | VolfrepError:
        try:
            made = solve_target(
                self.solid, self.spec, progress=self.progress, cache=self.shared.cache
            )
            _ = made.result
        except VolfrepError as error:
            return error
        return made

    @property
    def infill(self) -> Infill:
        """The filled part; what hinders it is found once.

        Raises:
            VolfrepError: the specification does not fit the part.
        """
        if isinstance(self._infill, VolfrepError):
            raise self._infill
        return self._infill

    @cached_property
    def loads(self) -> LoadCases:
        """What the part carries."""
        assert self.asked.loads is not None, "the study was checked"
        return read_load_cases(self.asked.loads.path, self.solid)

    def one_radius(self) -> LatticeSpec:
        """The specification with the radius that meets its target, if it has one."""
        if self.spec.target is None:
            return self.spec
        return dataclasses.replace(self.infill.spec, target=None)

    @property
    def endless(self) -> Mapping[str, Any] | None:
        """What the endless lattice's properties are asked for with, as of its target."""
        spec = self.spec
        if spec.target is not None:
            known = lattice_kind(spec).foretells_target
            spec = self.expectation.spec if known else self.infill.spec
        return spec.kind.endless

    def file(self, kind: str, suffix: str) -> Path:
        """Where a file of this design goes, in a folder of its kind."""
        folder = self.asked.folder / kind
        folder.mkdir(exist_ok=True)
        return folder / f"{self.key}{suffix}"


def _forecast(bench: Evaluator) -> dict[str, Figure]:
    found = bench.expectation
    figures = dataclasses.asdict(found.forecast)
    figures["strut_radius_mm"] = found.strut_radius
    figures["relative_density"] = found.relative_density
    figures["volume_mm3"], figures["mass_g"] = found.volume_mm3, found.mass_g
    return figures


def _properties(bench: Evaluator) -> dict[str, Figure]:
    spec, material = bench.spec, bench.asked.material
    if spec.is_graded:
        raise VolfrepError(
            "A lattice that is graded, mapped or turned has no one stiffness: leave 'properties' "
            "out, or the grading."
        )
    if (given := bench.endless) is None:
        raise VolfrepError(
            "A network repeats nowhere, and so has no stiffness of its own: leave 'properties' out."
        )
    # In units of L: sizes of one shape differ in the last digits only.
    size = given["cell_size"]
    shape: dict[str, Any] = {
        name: float(f"{value / size:.9g}") if isinstance(value, (int, float)) else value
        for name, value in given.items()
    }
    place = tuple(shape.items())
    if place not in bench.shared.properties:
        bench.shared.properties[place] = _cell_figures(
            lattice_properties(**shape, material=material)
        )
    return dict(bench.shared.properties[place])


def _cell_figures(found: CellProperties) -> dict[str, Figure]:
    figures: dict[str, Figure] = {"relative_density": found.relative_density}
    figures |= {name: found.values[name] for name in (*MODULI, *RATIOS, *LIMITS)}
    return {**figures, "from": "homogenised" if found.along else "catalogue"}


def _fill(bench: Evaluator) -> dict[str, Figure]:
    report = bench.infill.result.report
    bench.notes["fill"] = list(report.warnings)
    return {
        "strut_radius_mm": bench.infill.spec.strut_radius,
        "relative_density": report.relative_density,
        "volume_mm3": report.volume_mm3,
        "mass_g": report.mass_g,
        "area_mm2": report.area_mm2,
        "cells": report.cells_active,
        "struts": report.struts,
        "triangles": report.triangles,
        "bodies": report.bodies,
        "voids": report.voids,
        "genus": report.genus,
        "watertight": report.watertight,
        "warnings": len(report.warnings),
    }


def _measure(bench: Evaluator) -> dict[str, Figure]:
    report = mesh_report(bench.infill.result.mesh)
    return {
        "printable": report.printable,
        "open_edges": report.quality.open_edges,
        "defects": len(report.defects),
        "smallest_angle_deg": report.shapes.smallest_angle,
        "shortest_edge_mm": report.shortest_edge,
    }


def _print(bench: Evaluator) -> dict[str, Figure]:
    process = bench.asked.process
    assert process is not None, "the study was checked"
    infill = bench.infill
    report = check_print(
        infill.result.mesh, infill.result.wireframe, infill.cavity, bench.spec, process, bench.up
    )
    return {
        "findings": len(report.findings),
        "thinnest_strut_mm": report.thinnest_strut_mm,
        "narrowest_gap_mm": report.narrowest_gap_mm,
        "overhanging_share": report.overhanging_share,
        "longest_overhang_mm": report.longest_overhang_mm,
        "longest_bridge_mm": report.longest_bridge_mm,
        "overhang_area_mm2": report.overhang_area_mm2,
        "voids": report.voids,
        "void_volume_mm3": report.void_volume_mm3,
        "said": " ".join(report.findings),
    }


def _solve(bench: Evaluator) -> dict[str, Figure]:
    loads = bench.loads
    _, found = solve_struts(
        bench.solid, bench.one_radius(), loads, progress=bench.progress, cache=bench.shared.cache
    )
    figures = _largest_figures(found, [case.name for case in loads.cases])
    limit = loads.material.yield_stress
    figures["safety"] = None if limit is None else _round_off(limit / float(found.stress.max()))
    return figures


def _size(bench: Evaluator) -> dict[str, Figure]:
    loads = bench.loads
    goal = goal_of(loads.material, bench.asked.goal, lambda name: f"size.{name}")
    spec = dataclasses.replace(bench.one_radius(), density=loads.material.density)
    made = size(
        bench.solid, spec, loads, goal, prove_it=False, progress=bench.progress,
        cache=bench.shared.cache,
    )  # fmt: skip
    if made.sized.stopped == "cancelled":
        raise Cancelled("the study was cancelled")
    path = bench.file("sized", ".toml")
    radii = path.with_suffix(".csv")
    write_points(radii, made.points, made.radii, "radius")
    write_values(values_with_radii(made.spec, radii), path)
    report = made.report
    bench.notes["size"] = list(report["notes"])
    figures: dict[str, Figure] = {
        "holds": report["holds"],
        "strut_mass_g": _round_off(report["strut_mass_g"]),
        "thinnest_mm": _round_off(report["radii_mm"][0]),
        "thickest_mm": _round_off(report["radii_mm"][1]),
        **_largest_figures(made.sized.analysis, [case.name for case in loads.cases]),
        "stiffer": _round_off(min(report["same_mass"]["stiffer"], default=1.0)),
    }
    if "same_limits" in report:
        figures["mass_saved"] = _round_off(report["same_limits"]["mass_saved"])
    return {**figures, "file": f"sized/{path.name}"}


def _largest_figures(found: Analysis, cases: list[str]) -> dict[str, Figure]:
    """What is largest in any load case, and in which."""
    worst = int(found.largest.argmax())
    return {
        "displacement_mm": _round_off(found.largest[worst]),
        "case": cases[worst],
        "stress_mpa": _round_off(found.stress.max()),
        "buckling": _round_off(found.buckling.max()),
        "compliance_nmm": _round_off(found.compliance.max()),
    }


def _round_off(value: float) -> float:
    """To six digits: the last ones hang on how many threads sum."""
    return float(f"{value:.6g}")


def _export(bench: Evaluator) -> dict[str, Figure]:
    path = bench.file("files", bench.asked.export)
    form, material = find_form(path), bench.asked.material
    deck = Material() if material is None else material.for_solver(bench.spec.density)
    form.refuse(bench.spec)
    part = FilledPart(bench.infill, bench.shared.cache, bench.progress)
    writer, settled = writer_of(form).settle(part)
    written = writer.write(part, path, Settings(material=deck))
    if said := [*settled, *written.warnings]:
        bench.notes["export"] = said
    return {"file": f"files/{path.name}", "bytes": path.stat().st_size}


def _picture(bench: Evaluator) -> dict[str, Figure]:
    path = bench.file("pictures", ".png")
    infill = bench.infill
    picture(infill.result.mesh, infill.spec, path, solid=bench.solid, size=PICTURE_SIZE)
    return {"file": f"pictures/{path.name}"}


#: What gives the figures of each action, by its name; not how long it took.
FIGURES: dict[str, Callable[[Evaluator], dict[str, Figure]]] = {
    "forecast": _forecast,
    "properties": _properties,
    "fill": _fill,
    "measure": _measure,
    "print": _print,
    "solve": _solve,
    "size": _size,
    "export": _export,
    "picture": _picture,
}

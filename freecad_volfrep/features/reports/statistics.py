# SPDX-License-Identifier: LGPL-2.1-or-later
"""The figures of lattice infills beside each other."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any

import FreeCAD as App

from freecad_volfrep.features.infill.freshness import tell_stale
from freecad_volfrep.features.infill.lattice_infill import is_infill
from freecad_volfrep.features.infill.materials import material_of
from freecad_volfrep.features.jobs.progress import job_title, run_job
from freecad_volfrep.features.properties.quantities import density_of, mass_of
from volfrep.reports.tables import Table
from volfrep.util.errors import VolfrepError

#: Name, and where it stands in the object or in its report.
_INPUTS: tuple[tuple[str, Callable[[Any], Any]], ...] = (
    ("cell", lambda obj: obj.CellType),
    ("cell size, mm", lambda obj: obj.CellSize.Value),
    ("strut radius, mm", lambda obj: obj.StrutRadius.Value),
    ("skin, mm", lambda obj: obj.ShellThickness.Value),
    ("density, g/cm3", density_of),
    ("output", lambda obj: obj.Output),
    ("status", lambda obj: obj.Status or "Not computed yet"),
)
_FIGURES: tuple[tuple[str, str], ...] = (
    ("active cells", "cells_active"),
    ("cells of the grid", "cells_total"),
    ("struts", "struts"),
    ("joints", "nodes"),
    ("shortest and longest strut, mm", "strut_lengths_mm"),
    ("smallest and largest radius, mm", "strut_radii_mm"),
    ("relative density, %", "relative_density"),
    ("volume, mm3", "volume_mm3"),
    ("area, mm2", "area_mm2"),
    ("mass, g", "mass_g"),
    ("triangles", "triangles"),
    ("vertices", "vertices"),
    ("bodies", "bodies"),
    ("closed voids", "voids"),
    ("through-holes", "genus"),
    ("watertight", "watertight"),
    ("struts removed, free end", "struts_dangling_removed"),
    ("short stubs removed", "stubs_removed"),
    ("thin struts removed", "thin_struts_removed"),
    ("loose pieces removed", "pieces_removed"),
)


def infills_of(doc: App.Document) -> list[App.DocumentObject]:
    """The lattice infills of a document, in the order in which they were made."""
    return [obj for obj in doc.Objects if is_infill(obj)]


def statistics(infills: list[App.DocumentObject]) -> list[Table]:
    """Inputs, figures, times and memory, a column for each infill.

    Figures are those of the last finished update; None where there was none.

    Raises:
        VolfrepError: there is no infill.
    """
    if not infills:
        raise VolfrepError("There is no lattice infill: make one of a solid first.")
    reports = [json.loads(obj.Report) if obj.Report else {} for obj in infills]
    header = ("", *(obj.Label for obj in infills))
    masses = [
        mass_of(obj) if report else None for obj, report in zip(infills, reports, strict=True)
    ]
    said = ["; ".join(tell_stale(obj)) for obj in infills]
    figures: list[tuple[Any, ...]] = [("out of date", *said)] if any(said) else []
    for name, key in _FIGURES:
        values = (
            masses
            if key == "mass_g"
            else [_shown_value(key, report.get(key)) for report in reports]
        )
        figures.append((name, *values))
    does = _lattices(infills, reports)
    return [
        Table("Inputs", tuple((name, *map(of, infills)) for name, of in _INPUTS), header),
        Table("Result of the last update", tuple(figures), header),
        Table("What the lattice does", does, header),
        Table("Seconds by stage", _stages("stages", reports, sum), header),
        Table("Peak memory at the end of each stage, MB", _stages("stage_memory_mb", reports, max),
              header),
    ]  # fmt: skip


def _lattices(
    infills: list[App.DocumentObject], reports: list[dict[str, Any]]
) -> tuple[tuple[Any, ...], ...]:
    """Moduli, strength and conductivity of the endless lattice of each infill, with their errors.

    None of an infill whose mesh does not fit its properties, whose cells or radii vary, or which is
    neither of cubes nor of walls.
    """
    columns = [
        _lattice(obj) if report else {} for obj, report in zip(infills, reports, strict=True)
    ]
    names = list(dict.fromkeys(name for column in columns for name in column))
    return tuple((name, *(column.get(name) for column in columns)) for name in names)


def _lattice(obj: App.DocumentObject) -> dict[str, str]:
    from volfrep.jobs.figures.properties import lattice_properties
    from volfrep.mechanics.catalogue import known_properties

    try:
        _, spec, _ = obj.Proxy.inputs(obj)
    except VolfrepError:
        return {}
    if spec.size_grading is not None or spec.struts.is_graded or spec.output == "domain":
        return {}
    given = spec.kind.endless
    if given is None:
        return {}
    material, cell, found = material_of(obj), spec.kind.catalogue_cell, None
    if cell is not None:
        found = known_properties(cell, spec.cell_size, spec.strut_radius, material)
    if found is None:
        title = job_title("Properties of the lattice of {label}", obj)
        found = run_job(title, lattice_properties, material=material, has_progress=False, **given)
    rows = dict(found.rows())
    return {name: rows[name] for name in rows if name not in ("cell", "material")}


def _shown_value(key: str, value: Any) -> Any:
    if value is None:
        return None
    if key == "relative_density":
        return 100.0 * value
    if isinstance(value, list):
        return " to ".join(dict.fromkeys(f"{number:.4g}" for number in value))
    return value


def _stages(key: str, reports: list[dict[str, Any]], whole: Any) -> tuple[tuple[Any, ...], ...]:
    """A row for each stage that any of the reports has, and one for all of them."""
    names = list(dict.fromkeys(name for report in reports for name in report.get(key, {})))
    rows = [(name, *(report.get(key, {}).get(name) for report in reports)) for name in names]
    total = [whole(report[key].values()) if report.get(key) else None for report in reports]
    return (*rows, ("all" if whole is sum else "most", *total))

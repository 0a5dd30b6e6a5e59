# SPDX-License-Identifier: LGPL-2.1-or-later
"""An infill as a file for a printer or a service: within its limits, and drawn so as to come out.

The infill of the document stays as it is: coarser facets and other diameters are the file's.
"""

from __future__ import annotations

import os
from pathlib import Path

import FreeCAD as App

from freecad_volfrep.features.jobs.progress import job_title, run_job
from freecad_volfrep.sentences import report_line
from volfrep.util.errors import VolfrepError

from .exact import infill_made_of
from .input_files import refuse_inputs


def export_for_printer(
    obj: App.DocumentObject,
    path: str | os.PathLike[str],
    *,
    service: str | None = None,
    max_triangles: int | None = None,
    max_size: float | None = None,
    compensate: str | None = None,
    build_direction: tuple[float, float, float] = (0.0, 0.0, 1.0),
) -> tuple[str, ...]:
    """Write an infill's mesh with the finest facets that keep within limits, and compensated.

    Args:
        obj: a lattice infill that is up to date.
        path: of a mesh format.
        service: whose limits count, by its name in the engine's table.
        max_triangles: in place of the service's.
        max_size: the same in megabytes.
        compensate: name of a table of printed diameters, or a .csv file of one's own.
        build_direction: from the build plate up, in the document's coordinates.

    Returns:
        What that has cost, for the user.

    Raises:
        VolfrepError: neither is asked for, the limits cannot be kept, or the path cannot be
            written.
        Cancelled: in the window, by the user.
    """
    from freecad_volfrep.bridge.beams import place_in_document
    from freecad_volfrep.bridge.solids import placed
    from volfrep.design.file_limits import limits_of
    from volfrep.output.meshes import mesh_form, write_mesh
    from volfrep.output.printed_file import fill_for_printer

    limits = limits_of(service, max_triangles, max_size)
    if not limits and compensate is None:
        raise VolfrepError("Choose limits, a printer whose struts are known, or both.")
    refuse_inputs(path, obj)
    mesh_form(path)
    solid, spec, cache = infill_made_of(obj)
    place = place_in_document(obj)
    up = place.inverse().Rotation.multVec(App.Vector(*build_direction))
    made = run_job(
        job_title("File of {label}", obj), fill_for_printer, solid, spec, limits,
        Path(path).suffix.lower(), compensate=compensate, build_direction=tuple(up), cache=cache,
    )  # fmt: skip
    write_mesh(placed(made.mesh, place), path)
    for sentence in made.notes:
        App.Console.PrintMessage(report_line(obj.Label, sentence))
    notes: tuple[str, ...] = made.notes
    return notes

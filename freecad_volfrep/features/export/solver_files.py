# SPDX-License-Identifier: LGPL-2.1-or-later
"""An infill in the engine's forms of output, where it lies in the document.

Exact surfaces are made here, of the base's own shape; joints as instances are FreeCAD's alone.
"""

from __future__ import annotations

import json
import os
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import FreeCAD as App

from freecad_volfrep.features.infill.lattice_infill import is_infill
from freecad_volfrep.features.infill.materials import for_solver
from freecad_volfrep.features.jobs.progress import job_title, run_job
from freecad_volfrep.sentences import report_line
from volfrep.output.form import AXES, BEAMS, EXACT, MESH, TETRAHEDRA, Form, files, find_form
from volfrep.util.errors import VolfrepError, listed
from volfrep.util.files import staged

from .exact import (
    checked_ingredients,
    estimate_of,
    exact_job,
    exact_title,
    ingredients_of,
    inputs_of,
    warn,
)
from .input_files import refuse_inputs
from .instances import estimate_instances, write_instances

if TYPE_CHECKING:
    import numpy as np

    from volfrep.fem.beam_mesh import BeamMesh
    from volfrep.fem.tet_mesh import TetrahedralMesh
    from volfrep.grid.strut_graph import BeamModel
    from volfrep.output.sources import Given
    from volfrep.trim.clip_struts import Clipped

#: Forms of a 3MF file, as scripts call them; and what else than the engine's forms there is.
IN_3MF, INSTANCES = ("beams", "both"), "instances"
#: What scripts call a form whose word alone says too little here.
_CALLED = {"inp": "beam deck"}


def axes_of(obj: App.DocumentObject) -> Clipped:
    """The infill's struts cut at its wall, in the document's coordinates.

    Raises:
        VolfrepError: as `inputs_of`, or no strut lies inside.
        Cancelled: in the window, by the user.
    """
    solid, spec, cache = inputs_of(obj)
    from freecad_volfrep.bridge.beams import place_in_document, placed_lattice
    from volfrep.jobs.beam_part import clipped_infill

    title = job_title("Struts of {label}", obj)
    clipped = run_job(title, clipped_infill, solid, spec, cache=cache)
    warn(obj, clipped.warnings)
    return replace(clipped, wireframe=placed_lattice(clipped.wireframe, place_in_document(obj)))


def content_of(row: Form) -> str:
    """What a script calls a form: mesh, layers, or its word."""
    if row.is_folder:
        return "layers"
    return "mesh" if row.bytes_by else _CALLED.get(row.name, row.word)


def _contents() -> dict[str, tuple[str, ...]]:
    rows = {content_of(row): row.suffixes for row in files() if not row.bytes_by}
    found = {name: rows[name] for name in rows if name not in IN_3MF}
    return {**found, INSTANCES: find_form("a.step").suffixes}


#: What a script calls the forms of struts and solid elements, and their extensions.
CONTENTS = _contents()


def row_of(path: str | os.PathLike[str], content: str) -> Form:
    """The form of a path's extension that a script calls so.

    Raises:
        VolfrepError: there is none.
    """
    from volfrep.output.meshes import mesh_form

    suffix = Path(path).suffix.lower()
    for row in files():
        if suffix in row.suffixes and content_of(row) == content:
            return row
    if content == "mesh":
        return mesh_form(path)
    known = [row for row in files() if content_of(row) == content and content not in IN_3MF]
    if not known:
        raise VolfrepError(f"'{path}' cannot hold {content}: only a 3MF file holds beams or both.")
    raise VolfrepError(
        f"'{path}' cannot hold {content}: give it the extension {known[0].suffixes[0]}."
    )


def pieces_of(obj: App.DocumentObject, row: Form) -> Given:
    """What a form is made of, where the object lies in the document.

    Raises:
        VolfrepError: the object does not have it, or it is out of date.
        Cancelled: in the window, by the user.
    """
    from freecad_volfrep.bridge.beams import place_in_document
    from freecad_volfrep.bridge.solids import mesh_in_document, placed
    from volfrep.output.sources import Given
    from volfrep.output.writer import Axes
    from volfrep.reports.estimate import ExportChoice

    made = Given(triangles=obj.Mesh.CountFacets, figures=figures_of(obj))
    if row.meshed:
        made = replace(made, mesh=mesh_in_document(obj))
    if BEAMS in row.needs:
        made = replace(made, beams=beams_in_document(obj))
    if row.bare or TETRAHEDRA in row.needs:
        solid, spec, _ = inputs_of(obj)
        made = replace(made, spec=spec, choice=ExportChoice(spec))
        if TETRAHEDRA in row.needs:
            made = replace(made, outside=placed(solid, place_in_document(obj)))
    if AXES in row.needs:
        cut = axes_of(obj)  # which says what is to be said of it
        made = replace(made, axes=Axes(cut.wireframe, cut.on_boundary))
    return made


def beams_in_document(obj: App.DocumentObject) -> BeamModel:
    """The infill with its lattice as beams, in the document's coordinates.

    Raises:
        VolfrepError: that is no lattice infill, or it has no beams.
        Cancelled: in the window, by the user.
    """
    from freecad_volfrep.bridge.beams import place_in_document, placed_beams
    from volfrep.jobs.beam_part import beam_model

    if not is_infill(obj):
        raise VolfrepError(f"'{obj.Label}' is a mesh without beams: export its mesh.")
    solid, spec, cache = obj.Proxy.inputs(obj)
    model = run_job(job_title("Beams of {label}", obj), beam_model, solid, spec, cache=cache)
    return placed_beams(model, place_in_document(obj))


def write_pieces(obj: App.DocumentObject, path: str | os.PathLike[str], row: Form) -> None:
    """Write an object in a form through the engine, and say what is to be said of the file.

    Raises:
        VolfrepError: as `pieces_of`, or the path cannot hold it or cannot be written.
        Cancelled: in the window, by the user; no file is left behind.
    """
    from volfrep.output.sources import write_given

    made = pieces_of(obj, row)
    deck = for_solver(obj) if "material" in row.takes else None
    title = job_title("Writing {label}", obj)
    if TETRAHEDRA in row.needs:
        title = job_title("Tetrahedra of {label}", obj)
    with staged(path) as unfinished:
        written = run_job(title, write_given, row.name, made, str(unfinished), deck)
    warn(obj, written.warnings)


def figures_of(obj: App.DocumentObject) -> dict[str, str]:
    """The figures of the run that made an infill's mesh; nothing for another mesh, or an older
    version's report.
    """
    from dataclasses import fields

    from volfrep.reports.report import Report

    kept = json.loads(getattr(obj, "Report", "") or "{}")
    if kept.keys() != {field.name for field in fields(Report)}:
        return {}
    return Report(**kept).figures


def estimate_file(obj: App.DocumentObject, content: str) -> str:
    """What a file of that content will take, as a sentence without its full stop.

    Raises:
        VolfrepError: there is no such content, or it would be absurdly much; the text names the
            nearest setting that fits.
    """
    if content not in CONTENTS:
        raise VolfrepError(f"There is no content '{content}': choose {listed(CONTENTS)}.")
    from volfrep.output.writer import writer_of

    if content == INSTANCES:
        return str(estimate_instances(obj))
    row = row_of(f"file{CONTENTS[content][0]}", content)
    if EXACT in row.needs:
        return str(estimate_of(ingredients_of(obj)))
    unmeshed = replace(row, needs=tuple(need for need in row.needs if need != MESH))
    return str(writer_of(row).estimate(pieces_of(obj, unmeshed)))


def write_solver_file(obj: App.DocumentObject, path: str | os.PathLike[str], content: str) -> None:
    """Write a lattice infill for CAD or for CalculiX.

    Where OpenCASCADE does not manage the exact form, the file holds plane faces, and the report
    view says why.

    Args:
        obj: the infill.
        path: of the file, .step or .inp.
        content: one of `CONTENTS`.

    Raises:
        VolfrepError: the infill does not have it, the path cannot hold it or cannot be written,
            or it would be absurdly large.
        Cancelled: in the window, by the user; no file is left behind.
    """
    suffixes = CONTENTS[content]
    if Path(path).suffix.lower() not in suffixes:
        raise VolfrepError(f"'{path}' cannot hold {content}: give it the extension {suffixes[0]}.")
    refuse_inputs(path, obj)
    if content == INSTANCES:
        write_instances(obj, path)
    elif content == "exact":
        _write_exact(obj, path)  # of the very shape, which only this FreeCAD has
    else:
        write_pieces(obj, path, row_of(path, content))


def _write_exact(obj: App.DocumentObject, path: str | os.PathLike[str]) -> None:
    from freecad_volfrep.bridge.beams import place_in_document, placed_lattice
    from freecad_volfrep.bridge.solids import mesh_in_document
    from freecad_volfrep.bridge.trimmed import check_volume
    from freecad_volfrep.bridge.worker_calls import write_exact_lattice, write_exact_part
    from volfrep.io.write.step_faceted import write_step_faceted
    from volfrep.reports.estimate import estimate_faceted

    made_of = checked_ingredients(obj)
    place, title = place_in_document(obj), exact_title(obj)
    try:
        with staged(path) as unfinished:
            job = exact_job(obj, made_of)
            if made_of.domain is None:
                # Never built as a shape: its text is laid at every place.
                lattice = placed_lattice(made_of.lattice, place)
                file = str(unfinished)
                volume = run_job(title, write_exact_lattice, lattice, file, in_freecad=True)
                if job.expected is not None:
                    check_volume(volume, job.expected)
            else:
                move = tuple(place.toMatrix().A)
                run_job(title, write_exact_part, job, str(unfinished), move, in_freecad=True)
        warn(obj, made_of.warnings)
    except VolfrepError as error:
        mesh = mesh_in_document(obj)
        estimate_faceted(len(mesh.triangles))
        title = job_title("Plane faces of {label}", obj)
        with staged(path) as unfinished:
            run_job(title, write_step_faceted, mesh, str(unfinished), has_progress=False)
        warn(obj, (f"{error} The file holds plane faces instead of exact surfaces.",))


def beams_of(obj: App.DocumentObject, **options: Any) -> tuple[BeamMesh, np.ndarray]:
    """The infill as beams with fitted ends, in the document's coordinates, and what is on the wall.

    Args:
        obj: the infill.
        options: of `volfrep.fem.beam_mesh.fitted_beams`.

    Raises:
        VolfrepError: as `axes_of`.
        Cancelled: in the window, by the user.
    """
    from volfrep.fem.beam_mesh import fitted_beams
    from volfrep.trim.beam_model import deformed_struts

    clipped = axes_of(obj)
    spec = inputs_of(obj)[1]
    model, said = run_job(
        job_title("Beams of {label}", obj), fitted_beams, clipped.wireframe, clipped.on_boundary,
        spec.kind.cube, spec.cell_size, has_progress=False, **options,
    )  # fmt: skip
    warn(obj, said + deformed_struts(spec.grid, spec.struts))
    return model, clipped.on_boundary


def tetrahedra_of(obj: App.DocumentObject) -> TetrahedralMesh:
    """The infill filled with tetrahedra, in the document's coordinates.

    Raises:
        VolfrepError: Gmsh is missing, or neither way fills it.
        Cancelled: in the window, by the user.
    """
    from freecad_volfrep.bridge.solids import mesh_in_document
    from volfrep.jobs.beam_part import tetrahedra_of as made

    title = job_title("Tetrahedra of {label}", obj)
    filled: TetrahedralMesh = run_job(title, made, mesh_in_document(obj))
    for sentence in filled.warnings:
        App.Console.PrintWarning(report_line(obj.Label, sentence))
    return filled

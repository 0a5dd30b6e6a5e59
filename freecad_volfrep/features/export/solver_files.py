# SPDX-License-Identifier: LGPL-2.1-or-later
"""A lattice infill as a file for CAD or for a solver, where it lies in the document."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import FreeCAD as App

from freecad_volfrep.features.infill.materials import for_solver
from freecad_volfrep.features.jobs.progress import job_title, run_job
from volfrep.util.errors import VolfrepError
from volfrep.util.files import beside

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
    from volfrep.trim.clip_struts import Clipped

STEP_SUFFIXES = (".step", ".stp")
DECK_SUFFIXES = (".inp",)


def axes_of(obj: App.DocumentObject) -> Clipped:
    """The infill's struts cut at its wall, in the document's coordinates.

    Raises:
        VolfrepError: as `inputs_of`, or no strut lies inside.
        Cancelled: in the window, by the user.
    """
    solid, spec, cache = inputs_of(obj)
    from freecad_volfrep.bridge.beams import place_in_document, placed_lattice
    from volfrep.jobs.beam_part import clipped_infill
    from volfrep.process.worker import Call

    clipped = run_job(
        job_title("Struts of {label}", obj),
        Call(clipped_infill, (solid, spec), {"cache": cache}),
    )
    warn(obj, clipped.warnings)
    return replace(clipped, wireframe=placed_lattice(clipped.wireframe, place_in_document(obj)))


def estimate_file(obj: App.DocumentObject, content: str) -> str:
    """What a file of that content will take, as a sentence without its full stop.

    Raises:
        VolfrepError: there is no such content, or it would be absurdly much; the text names the
            nearest setting that fits.
    """
    if content not in CONTENTS:
        raise VolfrepError(f"There is no content '{content}': choose {' or '.join(CONTENTS)}.")
    _, spec, _ = inputs_of(obj)
    from volfrep.fem.beam_mesh import beam_model
    from volfrep.reports.estimate import (
        ExportChoice,
        estimate_axes,
        estimate_beams,
        estimate_tetrahedra,
    )

    asked = ExportChoice(spec)
    if content == "tetrahedra":
        return str(estimate_tetrahedra(obj.Mesh.CountFacets, asked))
    if content == "instances":
        return str(estimate_instances(obj))
    if content == "exact":
        return str(estimate_of(ingredients_of(obj)))
    clipped = axes_of(obj)
    if content == "wireframe":
        return str(estimate_axes(len(clipped.wireframe.struts), asked))
    return str(estimate_beams(beam_model(clipped.wireframe, clipped.on_wall), asked))


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
    suffixes, write = CONTENTS[content]
    if Path(path).suffix.lower() not in suffixes:
        raise VolfrepError(f"'{path}' cannot hold {content}: give it the extension {suffixes[0]}.")
    refuse_inputs(path, obj)
    write(obj, path)


def _write_exact(obj: App.DocumentObject, path: str | os.PathLike[str]) -> None:
    from freecad_volfrep.bridge.beams import place_in_document, placed_lattice
    from freecad_volfrep.bridge.solids import mesh_in_document
    from freecad_volfrep.bridge.trimmed import check_volume
    from freecad_volfrep.bridge.worker_calls import write_exact_lattice, write_exact_part
    from volfrep.io.write.step_faceted import write_step_faceted
    from volfrep.process.worker import Call
    from volfrep.reports.estimate import estimate_faceted

    made_of = checked_ingredients(obj)
    place, title = place_in_document(obj), exact_title(obj)
    try:
        with beside(path) as unfinished:
            job = exact_job(obj, made_of)
            if made_of.domain is None:
                # Never built as a shape: its text is laid at every place.
                lattice = placed_lattice(made_of.lattice, place)
                call = Call(write_exact_lattice, (lattice, str(unfinished)))
                volume = run_job(title, call, in_freecad=True)
                if job.expected is not None:
                    check_volume(volume, job.expected)
            else:
                move = tuple(place.toMatrix().A)
                call = Call(write_exact_part, (job, str(unfinished), move))
                run_job(title, call, in_freecad=True)
        warn(obj, made_of.warnings)
    except VolfrepError as error:
        mesh = mesh_in_document(obj)
        estimate_faceted(len(mesh.triangles))
        with beside(path) as unfinished:
            call = Call(write_step_faceted, (mesh, str(unfinished)), has_progress=False)
            run_job(job_title("Plane faces of {label}", obj), call)
        warn(obj, (f"{error} The file holds plane faces instead of exact surfaces.",))


def _write_axes(obj: App.DocumentObject, path: str | os.PathLike[str]) -> None:
    from volfrep.io.write.step_wireframe import write_step_wireframe

    write_step_wireframe(axes_of(obj).wireframe, path)


def _write_beams(obj: App.DocumentObject, path: str | os.PathLike[str]) -> None:
    from volfrep.fem.deck import write_beams
    from volfrep.reports.estimate import estimate_beams

    model, on_wall = beams_of(obj)
    estimate_beams(model)
    write_beams(model, path, for_solver(obj), on_wall=on_wall)


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
    from volfrep.process.worker import Call
    from volfrep.trim.beam_model import deformed_struts

    clipped = axes_of(obj)
    spec = inputs_of(obj)[1]
    call = Call(
        fitted_beams,
        (clipped.wireframe, clipped.on_wall, spec.fitted_cell, spec.cell_size),
        options,
        has_progress=False,
    )
    model, said = run_job(job_title("Beams of {label}", obj), call)
    warn(obj, said + deformed_struts(spec.grid, spec.struts))
    return model, clipped.on_wall


def _write_tetrahedra(obj: App.DocumentObject, path: str | os.PathLike[str]) -> None:
    from freecad_volfrep.bridge.beams import place_in_document
    from freecad_volfrep.bridge.solids import placed
    from volfrep.fem.deck import write_tetrahedra
    from volfrep.fem.tet_mesh import nodes_on
    from volfrep.process.worker import Call

    solid = placed(inputs_of(obj)[0], place_in_document(obj))
    filled = tetrahedra_of(obj)
    sets = {"SKIN": nodes_on(filled, solid)}
    with beside(path) as unfinished:
        call = Call(
            write_tetrahedra, (filled, str(unfinished), for_solver(obj)), {"sets": sets},
            has_progress=False,
        )  # fmt: skip
        run_job(job_title("Tetrahedra of {label}", obj), call)


def tetrahedra_of(obj: App.DocumentObject) -> TetrahedralMesh:
    """The infill filled with tetrahedra, in the document's coordinates.

    Raises:
        VolfrepError: Gmsh is missing, or does not manage it.
        Cancelled: in the window, by the user.
    """
    from freecad_volfrep.bridge.solids import mesh_in_document
    from volfrep.jobs.beam_part import tetrahedra_of as made
    from volfrep.process.worker import Call

    title = job_title("Tetrahedra of {label}", obj)
    filled: TetrahedralMesh = run_job(title, Call(made, (mesh_in_document(obj),)))
    for sentence in filled.warnings:
        App.Console.PrintWarning(f"VOLFREP, {obj.Label}: {sentence}\n")
    return filled


#: By content: the extensions that can hold it, and what writes it.
CONTENTS: dict[
    str, tuple[tuple[str, ...], Callable[[App.DocumentObject, str | os.PathLike[str]], None]]
] = {
    "exact": (STEP_SUFFIXES, _write_exact),
    "wireframe": (STEP_SUFFIXES, _write_axes),
    "instances": (STEP_SUFFIXES, write_instances),
    "beam deck": (DECK_SUFFIXES, _write_beams),
    "tetrahedra": (DECK_SUFFIXES, _write_tetrahedra),
}

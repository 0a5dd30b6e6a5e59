# SPDX-License-Identifier: LGPL-2.1-or-later
"""A lattice infill as a file for CAD or for a solver, where it lies in the document."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import FreeCAD as App

from volfrep.util.errors import VolfrepError

from .exact import (
    checked_ingredients,
    estimate_of,
    exact_shape,
    expected_volume,
    ingredients_of,
    inputs_of,
    warn,
)
from .input_files import refuse_inputs
from .instances import estimate_instances, write_instances
from .materials import for_solver
from .progress import job_title, progress_of, run_job

if TYPE_CHECKING:
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
    from volfrep.apart.engine_process import Call
    from volfrep.jobs.beam_part import clipped_infill

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
    from volfrep.reports.estimate import Asked, estimate_axes, estimate_beams, estimate_tetrahedra

    asked = Asked(spec)
    if content == "tetrahedra":
        return str(estimate_tetrahedra(obj.Mesh.CountFacets, asked))
    if content == "instances":
        return str(estimate_instances(obj))
    if content == "exact":
        with progress_of(job_title("Struts of {label}", obj)) as progress:
            return str(estimate_of(ingredients_of(obj, progress)))
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
    from freecad_volfrep.bridge.exact import write_exact
    from freecad_volfrep.bridge.solids import mesh_in_document
    from freecad_volfrep.bridge.trimmed import check_volume, write_shape
    from volfrep.io.write.step_faceted import write_step_faceted
    from volfrep.reports.estimate import estimate_faceted
    from volfrep.util.files import check_writable
    from volfrep.util.progress import Monitor

    check_writable(path)
    made_of = checked_ingredients(obj)
    expected = expected_volume(obj, made_of)
    try:
        if made_of.domain is None:
            # Never built as a shape: its text is laid at every place.
            lattice = placed_lattice(made_of.lattice, place_in_document(obj))
            with progress_of(job_title("Exact surfaces of {label}", obj)) as progress:
                volume = write_exact(lattice, path, Monitor(progress))
            if expected is not None:
                check_volume(volume, expected)
            warn(obj, made_of.warnings)
            return
        shape = exact_shape(obj, made_of)
    except VolfrepError as error:
        mesh = mesh_in_document(obj)
        estimate_faceted(len(mesh.triangles))
        write_step_faceted(mesh, path)
        warn(obj, (f"{error} The file holds plane faces instead of exact surfaces.",))
        return
    write_shape(shape, path)


def _write_axes(obj: App.DocumentObject, path: str | os.PathLike[str]) -> None:
    from volfrep.io.write.step_wireframe import write_step_wireframe

    write_step_wireframe(axes_of(obj).wireframe, path)


def _write_beams(obj: App.DocumentObject, path: str | os.PathLike[str]) -> None:
    from volfrep.fem.beam_mesh import fitted_beams
    from volfrep.io.write.calculix import write_beams
    from volfrep.reports.estimate import estimate_beams
    from volfrep.trim.beam_model import deformed_struts

    clipped = axes_of(obj)
    spec = inputs_of(obj)[1]
    model, said = fitted_beams(clipped.wireframe, clipped.on_wall, spec.fitted_cell, spec.cell_size)
    estimate_beams(model)
    write_beams(model, path, for_solver(obj), on_wall=clipped.on_wall)
    warn(obj, said + deformed_struts(spec.grid, spec.struts))


def _write_tetrahedra(obj: App.DocumentObject, path: str | os.PathLike[str]) -> None:
    from freecad_volfrep.bridge.beams import place_in_document
    from freecad_volfrep.bridge.solids import mesh_in_document, placed
    from volfrep.fem.tet_mesh import nodes_on, tetrahedra
    from volfrep.io.write.calculix import write_tetrahedra
    from volfrep.util.progress import Monitor

    solid = placed(inputs_of(obj)[0], place_in_document(obj))
    with progress_of(job_title("Tetrahedra of {label}", obj)) as progress:
        filled = tetrahedra(mesh_in_document(obj), Monitor(progress))
    sets = {"SKIN": nodes_on(filled, solid)}
    write_tetrahedra(filled, path, for_solver(obj), sets=sets)


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

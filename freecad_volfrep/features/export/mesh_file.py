# SPDX-License-Identifier: LGPL-2.1-or-later
"""Writes a mesh object to a file through the engine, which checks what a reader will see."""

from __future__ import annotations

import os
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import FreeCAD as App

from freecad_volfrep.engine import require_engine
from freecad_volfrep.features.infill.freshness import tell_stale
from freecad_volfrep.features.infill.lattice_infill import is_infill
from freecad_volfrep.translation import translate
from volfrep.output.form import FORMS, unknown
from volfrep.util.errors import VolfrepError

from .input_files import refuse_inputs
from .slicer_infill import SlicerInfill, save_project
from .solver_files import (
    CONTENTS,
    INSTANCES,
    content_of,
    estimate_file,
    row_of,
    write_pieces,
    write_solver_file,
)


@dataclass(frozen=True)
class Format:
    """One way to write a file.

    Attributes:
        title: for the file dialog.
        suffix: of the file.
        content: ``mesh``; ``beams``, ``both``, ``layers`` or `FITTED`, which are for lattice
            infills, as are those of `solver_files.CONTENTS`. Layers are a folder of that name. Of a
            slicer infill the slicer, ``prusa`` or ``orca``.
    """

    title: str
    suffix: str
    content: str = "mesh"

    @property
    def filter(self) -> str:
        """The entry of the file dialog's list."""
        return f"{translate('VolfrepFormats', self.title)} (*{self.suffix})"


#: A mesh within limits, or compensated for the printer (`printer_file.export_for_printer`).
FITTED = "fitted"


def _formats() -> Iterator[Format]:
    for row in FORMS:
        yield Format(row.title, row.suffixes[0], content_of(row))
        if row.name == "step-wireframe":
            yield Format("STEP, instances of joints", row.suffixes[0], INSTANCES)
    yield Format("STL, within limits or compensated", ".stl", FITTED)
    yield Format("3MF, within limits or compensated", ".3mf", FITTED)


#: In the order of the file dialog's list: the engine's forms of output, and one of FreeCAD's own.
FORMATS = tuple(_formats())
#: Those of a slicer infill, by what it calls the slicer.
PROJECTS = {
    "PrusaSlicer": Format("3MF, project for PrusaSlicer", ".3mf", "prusa"),
    "OrcaSlicer, Bambu Studio": Format(
        "3MF, project for OrcaSlicer and Bambu Studio", ".3mf", "orca"
    ),
}


def formats_of(obj: App.DocumentObject) -> list[Format]:
    """The formats in which this mesh object can be written; of a slicer infill its own first."""
    if isinstance(getattr(obj, "Proxy", None), SlicerInfill):
        own = PROJECTS[obj.Slicer]
        return [own, *(form for form in PROJECTS.values() if form is not own)]
    infill = is_infill(obj)
    return [form for form in FORMATS if infill or form.content == "mesh"]


def chosen_format(path: str, chosen: Format, formats: list[Format]) -> tuple[str, Format]:
    """What to write and where, of what a file dialog gives: its name and its kind of file.

    An extension that was typed says more than the kind that the dialog stood at; but the one that
    it proposes, STL's, is there in any case.

    Raises:
        VolfrepError: there is no such extension; naming those of all formats.
    """
    suffix = Path(path).suffix.lower()
    typed = [form for form in formats if form.suffix == suffix]
    if typed and suffix not in (chosen.suffix, FORMATS[0].suffix):
        return path, typed[0]
    if not suffix or typed:
        return str(Path(path).with_suffix(chosen.suffix)), chosen
    known = tuple(dict.fromkeys(form.suffix for form in formats))
    raise VolfrepError(f"Cannot write '{path}': {unknown(path, known)}")


def estimate_export(obj: App.DocumentObject, form: Format) -> str:
    """What a file will take, as a sentence without its full stop; nothing for plain meshes.

    Raises:
        VolfrepError: there is no such content, or it would be absurdly much.
    """
    if form.content in CONTENTS:
        return estimate_file(obj, form.content)
    if form.content != "mesh":
        return ""
    from volfrep.output.sources import Given
    from volfrep.output.writer import writer_of

    made = Given(triangles=obj.Mesh.CountFacets)
    estimate = writer_of(row_of(f"file{form.suffix}", "mesh")).estimate(made)
    return "" if estimate is None else str(estimate)


def export_mesh(
    obj: App.DocumentObject, path: str | os.PathLike[str], content: str = "mesh"
) -> tuple[str, ...]:
    """Write the object's mesh, where it lies in the document, in the format of the extension.

    Args:
        obj: a lattice infill, or any mesh object.
        path: the file to write; one that exists is replaced only when the new one is complete.
        content: ``mesh``, which of a slicer infill is its project, or ``prusa`` or ``orca``; in
            a 3MF file of a lattice infill ``beams`` (of the beam lattice extension) or
            ``both``. Of a lattice infill in .step or .inp, too: one of `solver_files.CONTENTS`.

    Returns:
        What is to be said of the file: that its mesh is out of date.

    Raises:
        VolfrepError: there is no mesh, the file cannot be written, cannot hold that content, or is
            one that the object is made of.
        Cancelled: in the window, by the user.
    """
    require_engine()
    if not obj.isDerivedFrom("Mesh::Feature") or not obj.Mesh.CountFacets:
        raise VolfrepError(f"'{obj.Label}' has no mesh to export: update it first.")
    if isinstance(getattr(obj, "Proxy", None), SlicerInfill):
        save_project(obj, path, "" if content == "mesh" else content)
        return ()
    refuse_inputs(path, obj)
    if content in CONTENTS:
        write_solver_file(obj, path, content)
        return ()
    row = row_of(path, content)
    said = tell_stale(obj) if content == "mesh" else ()
    write_pieces(obj, path, row)
    return said

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Writes a mesh object to a file through the engine, which checks what a reader will see."""

from __future__ import annotations

import json
import os
from dataclasses import dataclass
from pathlib import Path

import FreeCAD as App

from freecad_volfrep.engine import require_engine
from freecad_volfrep.features.infill.freshness import tell_stale
from freecad_volfrep.features.infill.lattice_infill import LatticeInfill
from freecad_volfrep.features.jobs.progress import job_title, run_job
from freecad_volfrep.translation import translate
from volfrep.util.errors import VolfrepError

from .input_files import refuse_inputs
from .solver_files import CONTENTS, STEP_SUFFIXES, estimate_file, write_solver_file


@dataclass(frozen=True)
class Format:
    """One way to write a file.

    Attributes:
        title: for the file dialog.
        suffix: of the file.
        content: ``mesh``; ``beams``, ``both`` or ``layers``, which are for lattice infills, as are
            those of `solver_files.CONTENTS`. Layers are a folder of that name.
    """

    title: str
    suffix: str
    content: str = "mesh"

    @property
    def filter(self) -> str:
        """The entry of the file dialog's list."""
        return f"{translate('VolfrepFormats', self.title)} (*{self.suffix})"


#: In the order of the file dialog's list.
FORMATS = (
    Format("STL", ".stl"),
    Format("3MF", ".3mf"),
    Format("3MF, mesh and beams", ".3mf", "both"),
    Format("3MF, beams only", ".3mf", "beams"),
    Format("PLY", ".ply"),
    Format("OBJ", ".obj"),
    Format("OFF", ".off"),
    Format("GLB, for viewers", ".glb"),
    Format("STEP, plane faces", ".step"),
    Format("STEP, exact surfaces", ".step", "exact"),
    Format("STEP, axes of the struts", ".step", "wireframe"),
    Format("STEP, instances of joints", ".step", "instances"),
    Format("CalculiX, beams", ".inp", "beam deck"),
    Format("CalculiX, tetrahedra", ".inp", "tetrahedra"),
    Format("Layers, pictures for resin printers", ".png", "layers"),
    Format("Layers, drawings", ".svg", "layers"),
    Format("Layers, common layer interface", ".cli", "layers"),
)


def formats_of(obj: App.DocumentObject) -> list[Format]:
    """The formats in which this mesh object can be written."""
    infill = isinstance(getattr(obj, "Proxy", None), LatticeInfill)
    return [form for form in FORMATS if infill or form.content == "mesh"]


def chosen_format(path: str, chosen: Format, formats: list[Format]) -> tuple[str, Format]:
    """What to write and where, of what a file dialog gives: its name and its kind of file.

    An extension that was typed says more than the kind that the dialog stood at; but the one that
    it proposes, STL's, is there in any case.
    """
    suffix = Path(path).suffix.lower()
    typed = [form for form in formats if form.suffix == suffix]
    if typed and suffix not in (chosen.suffix, FORMATS[0].suffix):
        return path, typed[0]
    if not suffix or typed:
        return str(Path(path).with_suffix(chosen.suffix)), chosen
    return path, chosen  # an extension that there is not: whoever writes says so


def estimate_export(obj: App.DocumentObject, form: Format) -> str:
    """What a file will take, as a sentence without its full stop; nothing for plain meshes.

    Raises:
        VolfrepError: there is no such content, or it would be absurdly much.
    """
    from volfrep.reports.estimate import estimate_faceted

    if form.content in CONTENTS:
        return estimate_file(obj, form.content)
    return str(estimate_faceted(obj.Mesh.CountFacets)) if form.suffix in STEP_SUFFIXES else ""


def export_mesh(
    obj: App.DocumentObject, path: str | os.PathLike[str], content: str = "mesh"
) -> tuple[str, ...]:
    """Write the object's mesh, where it lies in the document, in the format of the extension.

    Args:
        obj: a lattice infill, or any mesh object.
        path: the file to write; one that exists is replaced only when the new one is complete.
        content: ``mesh``; and in a 3MF file of a lattice infill ``beams`` (of the beam lattice
            extension) or ``both``. Of a lattice infill in .step or .inp, too: one of
            `solver_files.CONTENTS`.

    Returns:
        What is to be said of the file: that its mesh is out of date.

    Raises:
        VolfrepError: there is no mesh, the file cannot be written, cannot hold that content, or is
            one that the object is made of.
        Cancelled: in the window, by the user.
    """
    require_engine()
    from freecad_volfrep.bridge.solids import mesh_in_document
    from volfrep.io.write.threemf import BEAMS_ONLY, write_3mf_beams
    from volfrep.output.meshes import write_mesh
    from volfrep.process.worker import Call
    from volfrep.util.files import beside

    if not obj.isDerivedFrom("Mesh::Feature") or not obj.Mesh.CountFacets:
        raise VolfrepError(f"'{obj.Label}' has no mesh to export: update it first.")
    refuse_inputs(path, obj)
    if content == "mesh":
        said = tell_stale(obj)
        mesh, figures = mesh_in_document(obj), _figures(obj)
        with beside(path) as unfinished:
            call = Call(
                write_mesh, (mesh, str(unfinished)), {"figures": figures}, has_progress=False
            )
            run_job(job_title("Writing {label}", obj), call)
        return said
    if content in CONTENTS:
        write_solver_file(obj, path, content)
        return ()
    if Path(path).suffix.lower() != ".3mf" or content not in ("beams", "both"):
        raise VolfrepError(f"'{path}' cannot hold {content}: only a 3MF file holds beams or both.")
    from freecad_volfrep.bridge.beams import place_in_document, placed_beams
    from volfrep.jobs.beam_part import beam_model

    if not isinstance(getattr(obj, "Proxy", None), LatticeInfill):
        raise VolfrepError(f"'{obj.Label}' is a mesh without beams: export its mesh.")
    solid, spec, cache = obj.Proxy.inputs(obj)
    model = run_job(
        job_title("Beams of {label}", obj),
        Call(beam_model, (solid, spec), {"cache": cache}),
    )
    for sentence in model.warnings + ((*model.loose, BEAMS_ONLY) if content == "beams" else ()):
        App.Console.PrintWarning(f"VOLFREP, {obj.Label}: {sentence}\n")
    model = placed_beams(model, place_in_document(obj))
    mesh = mesh_in_document(obj) if content == "both" else None
    write_3mf_beams(model, path, mesh, figures=_figures(obj))
    return ()


def _figures(obj: App.DocumentObject) -> dict[str, str]:
    """The figures of the run that made an infill's mesh; nothing for another mesh, or an older
    version's report.
    """
    from dataclasses import fields

    from volfrep.reports.report import Report

    kept = json.loads(getattr(obj, "Report", "") or "{}")
    if kept.keys() != {field.name for field in fields(Report)}:
        return {}
    return Report(**kept).figures

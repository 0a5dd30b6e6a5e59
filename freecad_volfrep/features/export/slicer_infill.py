# SPDX-License-Identifier: LGPL-2.1-or-later
"""A solid with a slicer's own infill, denser where a field says: an object whose bands follow it.

Its mesh is the solid and, one after the other, the bands, as they lie in the document: what a
slicer's project is written from. A slicer's up is the document's z.
"""

from __future__ import annotations

import os
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import FreeCAD as App
import numpy as np

from freecad_volfrep.engine import require_engine
from freecad_volfrep.features.jobs.job import State
from freecad_volfrep.features.jobs.progress import job_title, run_job
from freecad_volfrep.features.jobs.screen import attach_view
from freecad_volfrep.features.properties.property_table import Property, add_missing, result
from freecad_volfrep.features.properties.quantities import set_value
from freecad_volfrep.saved_names import SavesNothing, saved_module
from freecad_volfrep.sentences import localise, report_line
from freecad_volfrep.translation import QT_TRANSLATE_NOOP, translate
from volfrep.util.errors import Cancelled, VolfrepError

from .input_files import refuse_inputs

if TYPE_CHECKING:
    from volfrep.design.banded_infill import BandedInfill
    from volfrep.design.scattered_field import PointField
    from volfrep.jobs.slicer_infill import SlicerInfill as Bands
    from volfrep.mesh.triangle_mesh import TriangleMesh

UP_TO_DATE = "Up to date"
CANCELLED = "Cancelled: the bands are those of the last recompute, if there was one."
FAILED = "Failed: see the report view"
#: Of the choices, what the engine calls them.
FOLLOWS = {
    QT_TRANSLATE_NOOP("VolfrepSlicer", "Depth, dense skin"): "skin",
    QT_TRANSLATE_NOOP("VolfrepSlicer", "Depth, dense core"): "core",
    QT_TRANSLATE_NOOP("VolfrepSlicer", "Direction"): "direction",
    QT_TRANSLATE_NOOP("VolfrepSlicer", "Formula"): "formula",
    QT_TRANSLATE_NOOP("VolfrepSlicer", "Field file"): "field",
    QT_TRANSLATE_NOOP("VolfrepSlicer", "FEM result"): "result",
    QT_TRANSLATE_NOOP("VolfrepSlicer", "Sized lattice"): "sized",
}
SLICERS = {"PrusaSlicer": "prusa", "OrcaSlicer, Bambu Studio": "orca"}
MATERIALS = ("PLA", "PETG", "ABS")

_GROUP, _PRINT = "Infill", "Printing"
PROPERTIES = (
    Property("App::PropertyLink", "Base", _GROUP, "The solid that is printed"),
    Property("App::PropertyEnumeration", "Follows", _GROUP, "What the density follows"),
    Property("App::PropertyFloat", "DensityStart", _GROUP,
             "Percent at the start: deep inside, or where the field is smallest", 10.0),
    Property("App::PropertyFloat", "DensityEnd", _GROUP,
             "Percent at the end: at the skin, or where the field is largest", 50.0),
    Property("App::PropertyLength", "Reach", _GROUP,
             "Depth at which the grading ends, for the grading over the depth", 5.0),
    Property("App::PropertyVector", "Direction", _GROUP,
             "Along which the density changes, in the document's coordinates",
             App.Vector(0, 0, 1)),
    Property("App::PropertyString", "Formula", _GROUP,
             "Percent of x, y and z in mm, such as 10 + z"),
    Property("App::PropertyFile", "FieldFile", _GROUP, "CSV or VTK file of points and values"),
    Property("App::PropertyLink", "FieldObject", _GROUP,
             "FEM result, or lattice infill that was sized for loads"),
    Property("App::PropertyString", "FieldColumn", _GROUP,
             "Which values of the file or the FEM result; empty for the usual ones"),
    Property("App::PropertyString", "Curve", _GROUP,
             "value:percent pairs in place of start and end, such as 0:10, 80:60"),
    Property("App::PropertyInteger", "Bands", _GROUP, "2 to 8; empty ones are left out", 5),
    Property("App::PropertyEnumeration", "Pattern", _PRINT, "That the slicer lays", "gyroid"),
    Property("App::PropertyEnumeration", "Slicer", _PRINT, "For which the project is written"),
    Property("App::PropertyInteger", "Walls", _PRINT, "Lines side by side", 3),
    Property("App::PropertyInteger", "TopLayers", _PRINT, "Solid ones below what looks up", 4),
    Property("App::PropertyInteger", "BottomLayers", _PRINT, "Solid ones above what looks down",
             4),
    Property("App::PropertyLength", "LineWidth", _PRINT, "Of an extruded line", 0.45),
    Property("App::PropertyLength", "LayerHeight", _PRINT, "Of a layer", 0.2),
    Property("App::PropertyEnumeration", "Filament", _PRINT, "Its density gives the mass"),
    result("App::PropertyString", "Status", "Whether the bands are those of these values"),
    result("App::PropertyFloatList", "BandDensities", "Mean of the field in each band, percent"),
    result("App::PropertyFloatList", "ToldDensities",
           "What the slicer is told of each, so that it lays as much, percent"),
    result("App::PropertyFloatList", "BandVolumes", "Sparse infill in each band, mm3"),
    result("App::PropertyIntegerList", "Facets", "Of the mesh: the solid's, then each band's"),
    result("App::PropertyVolume", "SolidVolume", "Of walls and solid layers"),
    result("App::PropertyVolume", "FilamentVolume", "Of all that is extruded"),
    result("App::PropertyMass", "Mass", "Of the filament, g"),
    result("App::PropertyFloat", "EvenDensity",
           "The one density everywhere that takes the same filament, percent"),
)  # fmt: skip


class SlicerInfill(SavesNothing):
    """Proxy of a ``Mesh::FeaturePython`` whose bands of density follow a solid and a field."""

    state = State.IDLE
    _reader: Any = None
    _is_made = False

    def __init__(self, obj: App.DocumentObject) -> None:
        obj.Proxy = self
        self._ensure_properties(obj)

    def execute(self, obj: App.DocumentObject) -> None:
        """Bring the bands up to date; called by FreeCAD's recompute.

        A cancel is no error: the last bands stay, and `Status` says so.

        Raises:
            VolfrepError: one sentence; the object turns Invalid, and its last bands stay.
        """
        if not self._is_made:
            self._make(obj)

    def update(self, obj: App.DocumentObject) -> bool:
        """Cut the bands now; whether they are those of the present values. `Status` says why not.

        What is wrong is no error of a recompute: the object stays as it was.
        """
        try:
            self._make(obj)
        except VolfrepError:
            return False
        if self.state is State.IDLE:
            self._is_made = True  # a recompute lets FreeCAD know
            obj.touch()
            obj.recompute()
            self._is_made = False
        return self.state is State.IDLE

    def _make(self, obj: App.DocumentObject) -> None:
        self.state, obj.Status = State.RUNNING, FAILED
        try:
            self._run(obj)
        except VolfrepError as error:
            self.state, obj.Status = State.FAILED, str(error)
            App.Console.PrintError(report_line(obj.Label, str(error)))
            raise
        except Cancelled:
            self.state, obj.Status = State.CANCELLED, CANCELLED
            App.Console.PrintMessage(report_line(obj.Label, CANCELLED))
        else:
            self.state, obj.Status = State.IDLE, UP_TO_DATE

    def onDocumentRestored(self, obj: App.DocumentObject) -> None:  # noqa: N802
        """Bring an object of an older file up to the present table of properties."""
        self._ensure_properties(obj)
        attach_view(obj)

    def _ensure_properties(self, obj: App.DocumentObject) -> None:
        from volfrep.design.banded_words import PATTERNS

        add_missing(
            obj,
            PROPERTIES,
            {
                "Follows": list(FOLLOWS), "Pattern": list(PATTERNS), "Slicer": list(SLICERS),
                "Filament": list(MATERIALS),
            },
        )  # fmt: skip

    def _run(self, obj: App.DocumentObject) -> None:
        from freecad_volfrep.bridge.meshes import to_freecad
        from freecad_volfrep.bridge.solids import SolidReader, parent_placement, placed
        from volfrep.io.solid import check_solid
        from volfrep.jobs.slicer_infill import cut_bands
        from volfrep.mechanics.materials import find_material
        from volfrep.mesh.triangle_mesh import concatenate

        if obj.Base is None:
            raise VolfrepError("There is no solid to print: choose one as Base.")
        require_engine()
        self._reader = self._reader or SolidReader()
        solid = self._reader.read(obj.Base, App.Placement())
        title, part = job_title("Infill bands of {label}", obj.Base), obj.Base.Label
        density = find_material(obj.Filament).density
        solid, wanted = check_solid(solid, part), wanted_of(obj)
        made = run_job(title, cut_bands, solid, wanted, material_density=density)
        pieces = [made.solid, *(band.mesh for band in made.bands[1:])]
        mesh = to_freecad(placed(concatenate(*pieces), parent_placement(obj).inverse()))
        place = obj.Placement
        obj.Mesh = mesh
        obj.Placement = place  # assigning a mesh also assigns the mesh's placement
        obj.Facets = [len(piece.triangles) for piece in pieces]
        _write_results(obj, made)


# Saved files find the class under this name.
SlicerInfill.__module__ = saved_module("features")


def make_slicer_infill(
    doc: App.Document, base: App.DocumentObject, **properties: Any
) -> App.DocumentObject:
    """Add a slicer's infill of a solid; ``doc.recompute()`` then cuts its bands.

    Args:
        doc: the document that holds the solid.
        base: a solid, as of `make_lattice_infill`.
        **properties: of the object by name, such as ``Follows="Formula"``, ``Formula="10 + z"``.

    Raises:
        VolfrepError: that is no solid, or there is no such property, or it does not take that
            value; nothing is added.
    """
    from freecad_volfrep.bridge.solids import is_fillable, resolve_base

    base = resolve_base(base)
    if not is_fillable(base):
        raise VolfrepError(f"'{base.Label}' is no solid: choose one.")
    known = {prop.name for prop in PROPERTIES if prop.group != "Result"} | {"Label"}
    unknown = set(properties) - known
    if unknown:
        raise VolfrepError(
            f"A slicer infill has no property '{min(unknown)}': choose from "
            f"{', '.join(sorted(known))}."
        )
    obj = doc.addObject("Mesh::FeaturePython", "SlicerInfill")
    try:
        SlicerInfill(obj)
        obj.Base = base
        obj.Label = translate("VolfrepLabels", "{label} infill").format(label=base.Label)
        for name, value in properties.items():
            try:
                set_value(obj, name, value)
            except (TypeError, ValueError, App.Base.FreeCADError) as error:
                raise VolfrepError(f"{name} cannot be {value!r}: {error}") from error
    except VolfrepError:
        doc.removeObject(obj.Name)
        raise
    attach_view(obj)
    return obj


def source_of(obj: App.DocumentObject) -> str:
    """Which of `FOLLOWS` a density can follow an object by; empty for none."""
    from freecad_volfrep.bridge.fem_fields import is_result
    from freecad_volfrep.features.infill.lattice_infill import is_infill

    if is_result(obj):
        return "FEM result"
    is_sized = is_infill(obj) and obj.SizedRadii
    return "Sized lattice" if is_sized else ""


def wanted_of(obj: App.DocumentObject) -> BandedInfill:
    """The densities and the print that the object's properties stand for.

    Raises:
        VolfrepError: they make no sense, or a field is missing.
    """
    from volfrep.design.banded_infill import BandedInfill

    follows = FOLLOWS[obj.Follows]
    values: dict[str, Any] = {
        "start": obj.DensityStart, "end": obj.DensityEnd, "reach": obj.Reach.Value,
        "direction": tuple(obj.Direction), "bands": obj.Bands, "pattern": obj.Pattern,
        "walls": obj.Walls, "top_layers": obj.TopLayers, "bottom_layers": obj.BottomLayers,
        "line_width": obj.LineWidth.Value, "layer": obj.LayerHeight.Value,
    }  # fmt: skip
    if follows == "formula":
        if not obj.Formula.strip():
            raise VolfrepError("The density is to follow a formula: write one as Formula.")
        values["formula"] = obj.Formula.strip()
    elif follows in ("field", "result", "sized"):
        follows_field, curve = _field(obj, follows)
        follows, values["field"], values["curve"] = "field", follows_field, curve
    return BandedInfill(grading=follows, **values)


def save_project(obj: App.DocumentObject, path: str | os.PathLike[str], slicer: str = "") -> None:
    """Write a slicer infill as a 3MF project.

    Args:
        obj: a slicer infill that is up to date.
        path: of the file; an old one stays if anything goes wrong.
        slicer: ``prusa`` or ``orca``; empty for the object's.

    Raises:
        VolfrepError: the bands are not those of the present values, or the path cannot be written.
    """
    if obj.Status != UP_TO_DATE or {"Touched", "Invalid"} & set(obj.State):
        raise VolfrepError(f"'{obj.Label}' is out of date: recompute it first.")
    if os.path.splitext(path)[1].lower() != ".3mf":
        raise VolfrepError(f"A slicer's project is a .3mf file, and '{path}' is none.")
    refuse_inputs(path, obj)
    bands_of(obj).save(path, slicer or SLICERS[obj.Slicer])


def bands_of(obj: App.DocumentObject) -> Bands:
    """What a computed slicer infill holds, in the document's coordinates.

    Raises:
        VolfrepError: it is not computed.
    """
    from volfrep.jobs.slicer_infill import Band
    from volfrep.jobs.slicer_infill import SlicerInfill as Bands
    from volfrep.mechanics.materials import find_material

    pieces = pieces_of(obj, is_placed=True)
    if not pieces:
        raise VolfrepError(f"'{obj.Label}' has no bands yet: recompute it first.")
    figures = zip(obj.BandDensities, obj.ToldDensities, obj.BandVolumes, strict=True)
    bands = [
        Band(mean, slicer_density, volume, None if k == 0 else pieces[k])
        for k, (mean, slicer_density, volume) in enumerate(figures)
    ]
    density = find_material(obj.Filament).density
    return Bands(pieces[0], wanted_of(obj), tuple(bands), obj.SolidVolume.Value, density)


def pieces_of(obj: App.DocumentObject, is_placed: bool = False) -> list[TriangleMesh]:
    """The solid and the bands, mm; none where there are none, or a step is half undone.

    Args:
        obj: a slicer infill.
        is_placed: in the document's coordinates; else in those of its view.
    """
    from freecad_volfrep.bridge.meshes import from_freecad
    from freecad_volfrep.bridge.solids import mesh_in_document, placed
    from volfrep.mesh.triangle_mesh import TriangleMesh, compact

    counts = list(obj.Facets)
    if not counts or sum(counts) != obj.Mesh.CountFacets:
        return []
    mesh = mesh_in_document(obj) if is_placed else from_freecad(obj.Mesh)
    if not is_placed:
        mesh = placed(mesh, obj.Placement.inverse())
    ends = np.cumsum([0, *counts])
    return [
        compact(TriangleMesh(mesh.vertices, mesh.triangles[low:high]))
        for low, high in pairwise(ends)
    ]


def _field(obj: App.DocumentObject, follows: str) -> tuple[PointField, str]:
    """The field that the density follows, and its curve."""
    from freecad_volfrep.bridge.fem_fields import field_of_result
    from freecad_volfrep.features.infill.lattice_infill import is_infill
    from volfrep.design.grading import read_point_field

    curve = obj.Curve.strip()
    if follows == "field":
        if not obj.FieldFile:
            raise VolfrepError("The density is to follow a file: choose it as FieldFile.")
        return read_point_field(obj.FieldFile, obj.FieldColumn or None), curve
    source = obj.FieldObject
    if source is None:
        raise VolfrepError(
            "The density is to follow an object: choose a FEM result or a sized lattice infill as "
            "FieldObject."
        )
    if follows == "result":
        named = ("FieldObject", "FieldColumn")
        return field_of_result(source, obj.FieldColumn, App.Placement(), named), curve
    from freecad_volfrep.bridge.solids import parent_placement
    from volfrep.design.scattered_field import PointField
    from volfrep.jobs.figures.sized_density import sized_densities

    if not is_infill(source):
        raise VolfrepError(f"'{source.Label}' is no lattice infill: choose one that was sized.")
    spec, _ = source.Proxy.read(source)
    field, own = sized_densities(spec)
    matrix = np.array(parent_placement(source).toMatrix().A).reshape(4, 4)
    points = field.points @ matrix[:3, :3].T + matrix[:3, 3]
    return PointField(points, field.values, source=field.source), curve or own


def _write_results(obj: App.DocumentObject, made: Bands) -> None:
    obj.BandDensities = [band.mean for band in made.bands]
    obj.ToldDensities = [band.density for band in made.bands]
    obj.BandVolumes = [band.volume for band in made.bands]
    obj.SolidVolume, obj.FilamentVolume = made.solid_volume, made.filament
    set_value(obj, "Mass", made.mass)
    obj.EvenDensity = made.mean_density
    said = "\n".join(f"{name}: {value}" for name, value in made.rows())
    App.Console.PrintMessage(f"VOLFREP, {obj.Label}:\n{localise(said)}\n")

# SPDX-License-Identifier: LGPL-2.1-or-later
"""A `Part` solid of a lattice, made on demand: the way to STEP and to FreeCAD's solid tools."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import FreeCAD as App

from freecad_volfrep.engine import require_engine
from freecad_volfrep.features.infill.freshness import tell_stale
from freecad_volfrep.features.jobs.progress import job_title, run_job
from freecad_volfrep.translation import translate
from volfrep.util.errors import VolfrepError

#: More triangles than this are refused unless the caller raises the limit.
DEFAULT_LIMIT = 100_000

# Measured on FreeCAD 0.20.2 with 40,000 to 250,000 triangles, per triangle.
_BUILD_SECONDS = 3e-5
_STEP_SECONDS = 1.6e-4
_STEP_MEGABYTES = 1.05e-3
_MEMORY_GIGABYTES = 1.6e-5
#: What FreeCAD 0.20 takes to draw a plane face, and one of a cylinder or a sphere, s.
PLANE, CURVED = 6e-5, 4e-4
#: Shapes that take longer are hidden at first, s: the window is to answer.
LONGEST_DRAWING = 0.15


@dataclass(frozen=True)
class Prediction:
    """What a faceted solid will cost: time and memory to make it, and its STEP file."""

    triangles: int
    seconds: float
    memory_gb: float
    step_seconds: float
    step_mb: float

    def __str__(self) -> str:
        return (
            f"{self.triangles:,} plane faces: about {self.seconds:.0f} s and "
            f"{self.memory_gb:.1f} GB to make, {self.step_mb:.1f} MB and "
            f"{self.step_seconds:.0f} s to write as STEP"
        )


def predict_solid(obj: App.DocumentObject) -> Prediction:
    """What `make_solid` of this mesh object will cost.

    Raises:
        VolfrepError: the object has no mesh.
    """
    if not obj.isDerivedFrom("Mesh::Feature") or not obj.Mesh.CountFacets:
        raise VolfrepError(f"'{obj.Label}' has no mesh to make a solid of: update it first.")
    count = obj.Mesh.CountFacets
    return Prediction(
        count,
        max(1.0, count * _BUILD_SECONDS),
        max(0.1, count * _MEMORY_GIGABYTES),
        max(1.0, count * _STEP_SECONDS),
        max(0.1, count * _STEP_MEGABYTES),
    )


def acceptable_solid(obj: App.DocumentObject, limit: int = DEFAULT_LIMIT) -> Prediction:
    """As `predict_solid`, of no more triangles than the limit.

    Raises:
        VolfrepError: the object has no mesh, or more triangles.
    """
    prediction = predict_solid(obj)
    if prediction.triangles > limit:
        raise VolfrepError(
            f"'{obj.Label}' would be a solid of {prediction}; the limit is {limit:,} faces, above "
            "which solid tools hardly move: choose larger cells or a coarser deviation, or export "
            "the mesh itself."
        )
    return prediction


def make_solid(
    doc: App.Document, obj: App.DocumentObject, *, limit: int = DEFAULT_LIMIT
) -> App.DocumentObject:
    """Add a ``Part::Feature`` with a plane face for every triangle of the object's mesh.

    The solid stays as it is when the lattice changes. It is placed where the mesh is.

    Args:
        doc: the document to add it to.
        obj: a lattice infill, or any closed mesh object.
        limit: the most triangles to accept.

    Raises:
        VolfrepError: no mesh, more triangles than the limit, or a mesh that is not closed.
    """
    require_engine()
    from freecad_volfrep.bridge.solids import mesh_in_document
    from freecad_volfrep.bridge.worker_calls import packed_facets, unpack

    acceptable_solid(obj, limit)
    said = tell_stale(obj)
    title, mesh = job_title("Plane faces of {label}", obj), mesh_in_document(obj)
    packed = run_job(title, packed_facets, mesh, has_progress=False, in_freecad=True)
    solid = shape_object(doc, obj, unpack(packed), PLANE)
    solid.Label2 = " ".join(said)
    return solid


def shape_object(
    doc: App.Document, obj: App.DocumentObject, shape: Any, seconds: float
) -> App.DocumentObject:
    """Add a ``Part::Feature`` of what an object was made into, hidden if it has many faces.

    FreeCAD's window stands still while it draws them, twice where a new object is recomputed.

    Args:
        doc: the document to add it to.
        obj: the object.
        shape: what it was made into.
        seconds: that FreeCAD takes to draw one of its faces.
    """
    faces = shape.countElement("Face")
    solid = doc.addObject("Part::Feature", f"{obj.Name}Solid")
    solid.Label = translate("VolfrepLabels", "{label} solid").format(label=obj.Label)
    if faces * seconds > LONGEST_DRAWING:
        solid.Visibility = False  # before it has anything to draw
        App.Console.PrintWarning(
            f"VOLFREP, {solid.Label}: it is there, and hidden behind '{obj.Label}', because "
            f"FreeCAD's window would stand still for about {faces * seconds:.1f} s while it draws "
            f"{faces:,} faces. The space bar shows it.\n"
        )
    solid.Shape = shape
    solid.purgeTouched()
    return solid

# SPDX-License-Identifier: LGPL-2.1-or-later
"""A lattice infill as an assembly: each kind of joint once, and links to it at its places."""

from __future__ import annotations

import os
from collections.abc import Generator
from typing import TYPE_CHECKING, Any

import FreeCAD as App
import numpy as np

from freecad_volfrep.features.jobs.progress import all_or_nothing, go_through, job_title, run_job
from freecad_volfrep.translation import translate
from volfrep.util.errors import VolfrepError
from volfrep.util.files import staged

from .exact import Ingredients, exact_job, ingredients_of, warn

if TYPE_CHECKING:
    from freecad_volfrep.bridge.worker_calls import PackedJoints
    from volfrep.reports.estimate import Estimate

#: Joints that a wall cuts are solids of their own: no more of them than this.
MOST_CUT_JOINTS = 2_000
#: Of a joint that a wall cuts, of a kind of joint, and of a link: bytes in a STEP file, and the
#: seconds of the first; measured on CVC cells in a box and in a cylinder.
BYTES_PER_CUT_JOINT = 20_000
BYTES_PER_KIND = 9_000
BYTES_PER_LINK = 600
SECONDS_PER_CUT_JOINT = 0.03


def make_instances(doc: App.Document, obj: App.DocumentObject) -> App.DocumentObject:
    """Add an ``App::Part`` of links; they touch in the middle of the struts, and are not one solid.

    Joints that a wall cuts, and the skin, are ordinary solids in it. The parts stay as they are
    when the lattice changes.

    Args:
        doc: the document to add it to.
        obj: a lattice infill.

    Returns:
        The ``App::Part``. `Import.export` writes its solids once each, and where they lie.

    Raises:
        VolfrepError: OpenCASCADE does not manage it, or the parts' volume is not the mesh's.
        Cancelled: in the window, by the user; nothing is added.
    """
    from freecad_volfrep.bridge.trimmed import check_volume
    from freecad_volfrep.bridge.worker_calls import packed_joints, unpack

    made_of = ingredients_of(obj)
    job = exact_job(obj, made_of)
    title, sides = job_title("Instances of {label}", obj), _sides(obj, made_of)
    joints = run_job(title, packed_joints, job, *sides, in_freecad=True)
    if job.expected is not None:
        check_volume(joints.volume, job.expected)
    warn(obj, made_of.warnings)
    with all_or_nothing(doc):
        return go_through(
            job_title("Instances of {label}", obj),
            _group_steps(doc, obj, joints, unpack(joints.shapes).childShapes()),
        )


def _group_steps(
    doc: App.Document, obj: App.DocumentObject, joints: PackedJoints, shapes: list[Any]
) -> Generator[float, None, App.DocumentObject]:
    """The assembly: the share that is done after each part, and its group."""
    from freecad_volfrep.bridge.beams import place_in_document

    kinds = len(joints.places)
    group = doc.addObject("App::Part", f"{obj.Name}Instances")
    group.Label = translate("VolfrepLabels", "{label} instances").format(label=obj.Label)
    group.Placement = place_in_document(obj)
    group.Visibility = False  # else the view would be drawn anew with every part
    for number, (shape, places) in enumerate(zip(shapes, joints.places, strict=False), 1):
        kind = doc.addObject("Part::Feature", "Joint")
        kind.Label, kind.Visibility, kind.Shape = f"Joint {number}", False, shape
        link = doc.addObject("App::Link", "Joints")
        link.Label, link.LinkedObject, link.ShowElement = f"Joints {number}", kind, False
        link.ElementCount = len(places)
        link.PlacementList = [App.Placement(App.Vector(*at), App.Rotation()) for at in places]
        group.addObject(link)
        yield number / len(shapes)
    for number, (label, shape) in enumerate(
        zip(joints.labels, shapes[kinds:], strict=True), kinds + 1
    ):
        feature = doc.addObject("Part::Feature", "Single")
        feature.Label, feature.Shape = label, shape
        group.addObject(feature)
        feature.purgeTouched()
        yield number / len(shapes)
    group.Visibility = True
    return group


def estimate_instances(obj: App.DocumentObject) -> Estimate:
    """What the assembly will take.

    Raises:
        VolfrepError: as `inputs_of`, or the wall cuts too many joints.
        Cancelled: in the window, by the user.
    """
    from volfrep.grid.congruent_joints import distinct_joints
    from volfrep.io.write.step_exact import predict_exact
    from volfrep.reports.estimate import Estimate

    made_of = ingredients_of(obj)
    joints = distinct_joints(made_of.lattice)
    whole, cut = (int(np.count_nonzero(side)) for side in _sides(obj, made_of))
    size = BYTES_PER_KIND * len(joints) + BYTES_PER_LINK * whole + BYTES_PER_CUT_JOINT * cut
    return Estimate(
        f"{len(joints):,} kinds of joints at {whole:,} places, {cut:,} joints at the wall",
        predict_exact(made_of.lattice).seconds + SECONDS_PER_CUT_JOINT * cut,
        1e-6 * size,
    )


def write_instances(obj: App.DocumentObject, path: str | os.PathLike[str]) -> None:
    """Write the assembly as STEP, through a document of its own.

    Raises:
        VolfrepError: as `make_instances`, or the path cannot be written.
        Cancelled: in the window, by the user.
    """
    import Import

    from freecad_volfrep.bridge.exact import silence, without_surface_curves

    active = App.ActiveDocument
    # Hidden, so that no window of it opens.
    temporary = App.newDocument("VolfrepInstances", "Instances", True, True)
    try:
        group = make_instances(temporary, obj)
        temporary.recompute()
        with staged(path) as unfinished, without_surface_curves(), silence():
            Import.export([group], str(unfinished))
    finally:
        App.closeDocument(temporary.Name)
        if active is not None:
            App.setActiveDocument(active.Name)


def _sides(obj: App.DocumentObject, made_of: Ingredients) -> tuple[np.ndarray, np.ndarray]:
    """(n,) which nodes' joints lie wholly inside the wall, and which of them it may cut.

    Raises:
        VolfrepError: the wall cuts too many joints.
        Cancelled: in the window, by the user.
    """
    from volfrep.jobs.beam_part import joints_at_boundary

    title = job_title("Struts of {label}", obj)
    whole, cut = run_job(title, joints_at_boundary, made_of.lattice, made_of.domain)
    if np.count_nonzero(cut) > MOST_CUT_JOINTS:
        raise VolfrepError(
            f"The wall cuts {np.count_nonzero(cut):,} joints; the limit is {MOST_CUT_JOINTS:,}: "
            "choose larger cells, or the exact or the faceted form."
        )
    return whole, cut

# SPDX-License-Identifier: LGPL-2.1-or-later
"""A lattice infill as an assembly: each kind of joint once, and links to it at its places."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

import FreeCAD as App
import numpy as np

from volfrep.util.errors import VolfrepError

from .exact import Ingredients, expected_volume, ingredients_of, walls_of, warn
from .progress import job_title, progress_of

if TYPE_CHECKING:
    from volfrep.grid.congruent_joints import Joint
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
    from freecad_volfrep.bridge.beams import place_in_document
    from freecad_volfrep.bridge.trimmed import check_volume
    from volfrep.reports.estimate import refuse_inexact
    from volfrep.util.progress import Monitor

    with progress_of(job_title("Instances of {label}", obj)) as progress:
        made_of = ingredients_of(obj, progress)
        refuse_inexact(made_of.spec)
        copies, single, volume = _solids(obj, made_of, Monitor(progress))
    expected = expected_volume(obj, made_of)
    if expected is not None:
        check_volume(volume, expected)
    warn(obj, made_of.warnings)
    group = doc.addObject("App::Part", f"{obj.Name}Instances")
    group.Label = f"{obj.Label} instances"
    group.Placement = place_in_document(obj)
    for number, (shape, places) in enumerate(copies, 1):
        kind = doc.addObject("Part::Feature", "Joint")
        kind.Label, kind.Shape, kind.Visibility = f"Joint {number}", shape, False
        link = doc.addObject("App::Link", "Joints")
        link.Label, link.LinkedObject, link.ShowElement = f"Joints {number}", kind, False
        link.ElementCount = len(places)
        link.PlacementList = [App.Placement(App.Vector(*at), App.Rotation()) for at in places]
        group.addObject(link)
    for label, shape in single:
        feature = doc.addObject("Part::Feature", "Single")
        feature.Label, feature.Shape = label, shape
        group.addObject(feature)
    return group


def estimate_instances(obj: App.DocumentObject) -> Estimate:
    """What the assembly will take.

    Raises:
        VolfrepError: as `inputs_of`, or the wall cuts too many joints.
        Cancelled: in the window, by the user.
    """
    from volfrep.grid.congruent_joints import distinct_joints
    from volfrep.io.write.step_exact import predicted_exact
    from volfrep.reports.estimate import Estimate

    with progress_of(job_title("Struts of {label}", obj)) as progress:
        made_of = ingredients_of(obj, progress)
    joints = distinct_joints(made_of.lattice)
    whole, cut = (int(np.count_nonzero(side)) for side in _sides(made_of, joints))
    size = BYTES_PER_KIND * len(joints) + BYTES_PER_LINK * whole + BYTES_PER_CUT_JOINT * cut
    return Estimate(
        f"{len(joints):,} kinds of joints at {whole:,} places, {cut:,} joints at the wall",
        predicted_exact(made_of.lattice).seconds + SECONDS_PER_CUT_JOINT * cut,
        1e-6 * size,
    )


def write_instances(obj: App.DocumentObject, path: str | os.PathLike[str]) -> None:
    """Write the assembly as STEP, through a document of its own.

    Raises:
        VolfrepError: as `make_instances`, or the path cannot be written.
        Cancelled: in the window, by the user.
    """
    import Import

    from freecad_volfrep.bridge.exact import plain_curves, silence
    from volfrep.util.files import replacing

    active = App.ActiveDocument
    # Hidden, so that no window of it opens.
    temporary = App.newDocument("VolfrepInstances", "Instances", True, True)
    try:
        group = make_instances(temporary, obj)
        temporary.recompute()
        with replacing(path) as file:
            unfinished = Path(file.name).with_suffix(".step")
            try:
                with plain_curves(), silence():
                    Import.export([group], str(unfinished))
                file.write(unfinished.read_bytes())
            finally:
                unfinished.unlink(missing_ok=True)
    finally:
        App.closeDocument(temporary.Name)
        if active is not None:
            App.setActiveDocument(active.Name)


def _solids(
    obj: App.DocumentObject, made_of: Ingredients, monitor: Any
) -> tuple[list[tuple[Any, np.ndarray]], list[tuple[str, Any]], float]:
    """Shapes with their places, shapes that are there once with their labels, and the volume."""
    from freecad_volfrep.bridge.exact import joint_solid
    from volfrep.grid.congruent_joints import Unsuitable, distinct_joints, refuse_overlaps

    lattice = made_of.lattice
    refuse_overlaps(lattice)
    joints = distinct_joints(lattice)
    whole, cut = _sides(made_of, joints)
    inner = outer = None
    if made_of.domain is not None:
        inner, outer = walls_of(obj, made_of)
    copies, single, volume = [], [], 0.0
    for done, joint in enumerate(joints):
        monitor.tick(done / len(joints))
        near = joint.places[cut[joint.places]]
        inside = joint.places[whole[joint.places]]
        if not len(near) and not len(inside):
            continue
        try:
            solid = joint_solid(joint)
        except Unsuitable as error:
            x, y, z = lattice.nodes[joint.places[0]]
            raise VolfrepError(
                f"The joint near ({x:.4g}, {y:.4g}, {z:.4g}) {error}: make the struts thinner."
            ) from error
        if len(inside):
            copies.append((solid, lattice.nodes[inside]))
            volume += solid.Volume * len(inside)
        for node in near.tolist():
            monitor.tick()
            piece = solid.translated(App.Vector(*lattice.nodes[node])).common(inner)
            if piece.Solids:
                single.append((f"Cut joint {len(single) + 1}", piece))
                volume += piece.Volume
    if outer is not None:
        skin = outer.cut(inner)
        single.append(("Skin", skin))
        volume += skin.Volume
    return copies, single, volume


def _sides(made_of: Ingredients, joints: list[Joint]) -> tuple[np.ndarray, np.ndarray]:
    """(n,) which nodes' joints lie wholly inside the wall, and which of them it may cut."""
    from volfrep.spatial.proximity import closest_points
    from volfrep.spatial.rays import inside_points
    from volfrep.util.progress import Monitor

    nodes = made_of.lattice.nodes
    if made_of.domain is None:
        return np.ones(len(nodes), bool), np.zeros(len(nodes), bool)
    reach = np.zeros(len(nodes))
    for joint in joints:
        length = np.linalg.norm(joint.arms, axis=1) + joint.radii[:, 1]
        reach[joint.places] = max(float(length.max()), joint.ball)
    cut = closest_points(made_of.domain, nodes)[1] < reach
    if np.count_nonzero(cut) > MOST_CUT_JOINTS:
        raise VolfrepError(
            f"The wall cuts {np.count_nonzero(cut):,} joints; the limit is {MOST_CUT_JOINTS:,}: "
            "choose larger cells, or the exact or the faceted form."
        )
    return inside_points(made_of.domain, nodes, Monitor()) & ~cut, cut

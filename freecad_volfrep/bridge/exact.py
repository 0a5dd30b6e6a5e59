# SPDX-License-Identifier: LGPL-2.1-or-later
"""A lattice with exact surfaces: cylinders, cones and spheres, fused joint by joint."""

from __future__ import annotations

import os
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import FreeCAD as App
import numpy as np
import Part
from numpy.typing import NDArray

from volfrep.grid.congruent_joints import (
    Joint,
    Unsuitable,
    distinct_joints,
    joint_volume,
    refuse_overlaps,
)
from volfrep.grid.strut_graph import Wireframe
from volfrep.io.write.step_exact import Shared, joint_text, write_step_exact
from volfrep.util.errors import VolfrepError
from volfrep.util.files import check_writable
from volfrep.util.numbers import place_text
from volfrep.util.progress import Monitor

Floats = NDArray[np.float64]

#: Radii and directions that differ by less are equal, mm or 1.
_EQUAL = 1e-9
#: Directions of the sphere's poles to try.
_SPHERE_AXES = ((0.0, 0.0, 1.0), (0.31, 0.53, 0.79))
#: A solid that is read back may differ in volume by this fraction from what was written.
_READ_TOLERANCE = 1e-4
#: A fused joint's volume may differ from its estimate by this fraction.
_VOLUME_TOLERANCE = 0.02


def write_exact(
    wireframe: Wireframe, path: str | os.PathLike[str], monitor: Monitor | None = None
) -> float:
    """Write a lattice as STEP with exact surfaces, a closed solid for each connected piece.

    Each kind of joint is fused once: a block has few, a lattice whose radii vary everywhere one
    for every node (`predict_exact`).

    Args:
        wireframe: the lattice, mm.
        path: of the file; an old file stays if anything goes wrong.
        monitor: told the progress, asked for a cancel.

    Returns:
        The volume of the solids, mm3.

    Raises:
        VolfrepError: struts overlap away from their joints, a joint cannot be fused, or the path
            cannot be written.
        Cancelled: when the monitor says so; no file is left behind.
    """
    check_writable(path)
    refuse_overlaps(wireframe)
    joints = distinct_joints(wireframe)
    if not joints:
        raise VolfrepError("The lattice has no struts to make a solid of.")
    shared, texts, volume = Shared(), [], 0.0
    work = np.cumsum([len(joint.arms) ** 2 for joint in joints])
    for joint, done in zip(joints, work, strict=True):
        try:
            step, own_volume = joint_step(joint)
            texts.append(joint_text(joint, step, shared))
        except Unsuitable as error:
            place = place_text(wireframe.nodes[joint.places[0]])
            raise VolfrepError(
                f"The joint near {place} {error}: make the struts thinner, "
                "or use the faceted STEP form."
            ) from error
        volume += own_volume * len(joint.places)
        if monitor is not None:
            monitor.tick(0.9 * done / work[-1])
    write_step_exact(wireframe, texts, shared, path)
    return volume


def exact_lattice(wireframe: Wireframe, monitor: Monitor | None = None) -> Part.Shape:
    """A lattice as a solid with exact surfaces, or a compound of them; as `write_exact`."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "lattice.step"
        volume = write_exact(wireframe, path, monitor)
        shape = Part.Shape()
        shape.read(str(path))
    if abs(shape.Volume / volume - 1.0) > _READ_TOLERANCE or not shape.isValid():
        raise VolfrepError(
            "OpenCASCADE does not read the lattice's exact surfaces as a valid solid: use the "
            "faceted STEP form."
        )
    return shape


def joint_solid(joint: Joint) -> Part.Shape:
    """One joint at the origin: half struts and its sphere, fused.

    Raises:
        Unsuitable: OpenCASCADE did not make one closed solid of them.
    """
    expected = joint_volume(joint)
    for axis in _SPHERE_AXES:
        # One after the other, the sphere first: OpenCASCADE's fuse of all at once loses arms of
        # cones, and takes twice as long.
        fused = Part.makeSphere(joint.ball, App.Vector(0, 0, 0), App.Vector(*axis))
        for arm in _arms(joint):
            fused = fused.fuse(arm)
        right = len(fused.Solids) == 1 and fused.isValid() and fused.isClosed()
        # A fuse may lose a piece and call the rest valid.
        if right and abs(fused.Volume / expected - 1.0) < _VOLUME_TOLERANCE:
            return fused.Solids[0]
    raise Unsuitable("cannot be fused by OpenCASCADE")


def joint_step(joint: Joint) -> tuple[str, float]:
    """One joint at the origin as a STEP file's text, and its volume in mm3."""
    solid = joint_solid(joint)
    with tempfile.TemporaryDirectory() as folder, without_surface_curves(), silence():
        path = Path(folder) / "joint.step"
        solid.exportStep(str(path))
        return path.read_text(encoding="ascii"), float(solid.Volume)


@contextmanager
def silence() -> Iterator[None]:
    """Keep OpenCASCADE's account of every file from the standard output, where there is one.

    A window's program on Windows has none.
    """
    sys.stdout.flush()
    try:
        kept = os.dup(1)
    except OSError:
        yield
        return
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 1)
    try:
        yield
    finally:
        os.dup2(kept, 1)
        os.close(nowhere)
        os.close(kept)


@contextmanager
def without_surface_curves() -> Iterator[None]:
    """Have STEP files written without curves in the surfaces' parameters, which readers make anew.

    A fifth of the size and a third of the time of FreeCAD 0.20's own setting.
    """
    mode = "write.surfacecurve.mode"
    before = Part.getStaticValue(mode) if hasattr(Part, "getStaticValue") else None
    Part.setStaticValue(mode, 0)
    try:
        yield
    finally:
        if before is not None:
            Part.setStaticValue(mode, before)


def _arms(joint: Joint) -> Iterator[Part.Shape]:
    length = np.linalg.norm(joint.arms, axis=1)
    # Both halves of a strut are made along one direction, told by its sign, so that their seams
    # lie at the same angle. Rounded, because OpenCASCADE chooses that angle by comparing
    # components that may be equal.
    direction = np.round(joint.arms / length[:, None], 12) + 0.0
    sign = np.array([1.0 if tuple(row) > (0.0, 0.0, 0.0) else -1.0 for row in direction.tolist()])
    direction *= sign[:, None]
    done = np.zeros(len(length), bool)
    for k in range(len(length)):
        if done[k]:
            continue
        low, high = sorted((0.0, float(sign[k] * length[k])))
        at_joint, at_middle = joint.radii[k]
        if abs(at_joint - at_middle) < _EQUAL:
            # A strut that goes straight on is one cylinder through the joint.
            same = (np.abs(direction - direction[k]).max(axis=1) < _EQUAL) & ~done
            same &= (np.abs(joint.radii - at_joint) < _EQUAL).all(axis=1)
            done |= same
            low = float(min(low, *(sign * length)[same]))
            high = float(max(high, *(sign * length)[same]))
            yield Part.makeCylinder(
                at_joint, high - low, App.Vector(*(low * direction[k])), App.Vector(*direction[k])
            )
            continue
        done[k] = True
        radii = (at_joint, at_middle) if sign[k] > 0 else (at_middle, at_joint)
        yield Part.makeCone(
            *radii, high - low, App.Vector(*(low * direction[k])), App.Vector(*direction[k])
        )

# SPDX-License-Identifier: LGPL-2.1-or-later
"""The directions in which a part is built best, and what becomes of one: a turn, a print check."""

from __future__ import annotations

from typing import TYPE_CHECKING

import FreeCAD as App
import numpy as np

from freecad_volfrep.engine import require_engine
from freecad_volfrep.features.infill.lattice_infill import is_infill
from freecad_volfrep.features.infill.materials import process_of
from freecad_volfrep.features.jobs.progress import job_title, run_job
from volfrep.util.errors import VolfrepError

from .print_check import PrintCheck, make_print_check

if TYPE_CHECKING:
    from volfrep.reports.orientation import Orientation, Orientations


def first_inclination(obj: App.DocumentObject) -> float:
    """The least inclination that needs no support, degrees: of the infill's process, or 45."""
    from volfrep.reports.orientation import inclination_of

    return float(inclination_of(process_of(obj) if is_infill(obj) else None, None))


def find_directions(obj: App.DocumentObject, inclination: float) -> Orientations:
    """The best build directions of an infill's mesh, or of a solid, in the document's coordinates.

    Args:
        obj: a lattice infill with a mesh, or a solid.
        inclination: least that needs no support, degrees.

    Raises:
        VolfrepError: there is neither mesh nor solid.
        Cancelled: in the window, by the user.
    """
    require_engine()
    from freecad_volfrep.bridge.solids import SolidReader, mesh_in_document
    from volfrep.reports.orientation import orient

    mesh = mesh_in_document(obj) if is_infill(obj) else SolidReader().read(obj, App.Placement())
    title = job_title("Build direction of {label}", obj)
    found: Orientations = run_job(title, orient, mesh, inclination)
    return found


def turn_part(obj: App.DocumentObject, found: Orientations, chosen: Orientation) -> None:
    """Turn a part so that a direction is z, about its middle, and stand it on z = 0.

    An infill is turned by its own Placement: its lattice turns with it.

    Raises:
        VolfrepError: something else says how the part lies.
    """
    from freecad_volfrep.bridge.solids import parent_placement, resolve_base

    part = obj if is_infill(obj) else resolve_base(obj)
    driven = any(path.strip(".").startswith("Placement") for path, _ in part.ExpressionEngine)
    if driven or "ReadOnly" in part.getEditorMode("Placement"):
        raise VolfrepError(
            f"An expression or another object says how '{part.Label}' lies: turn that instead."
        )
    low, high = found.mesh.bounds
    middle = (low + high) / 2.0
    rotation = App.Rotation(App.Vector(*chosen.axis), chosen.angle)
    turn = App.Placement(App.Vector(), rotation, App.Vector(*middle))
    heights = (found.mesh.vertices - middle) @ np.array(chosen.rotation[2])
    stand = App.Placement(App.Vector(0, 0, -float(heights.min()) - middle[2]), App.Rotation())
    frame = parent_placement(part)
    own = frame.inverse().multiply(stand).multiply(turn).multiply(frame)
    part.Placement = own.multiply(part.Placement)


def set_build_direction(
    infill: App.DocumentObject, up: tuple[float, float, float]
) -> list[App.DocumentObject]:
    """Let an infill and its print checks be built along a direction of the document's coordinates.

    A print check is made where there is none.

    Returns:
        The print checks; ``doc.recompute()`` computes them.

    Raises:
        VolfrepError: that is no lattice infill.
    """
    from freecad_volfrep.bridge.beams import place_in_document

    checks = [
        one
        for one in infill.Document.Objects
        if isinstance(getattr(one, "Proxy", None), PrintCheck) and one.Infill == infill
    ]
    made = [] if checks else [make_print_check(infill.Document, infill, build_direction=up)]
    infill.BuildDirection = place_in_document(infill).Rotation.inverted().multVec(App.Vector(*up))
    for one in checks:
        one.BuildDirection = App.Vector(*up)
    return made or checks

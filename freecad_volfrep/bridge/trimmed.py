# SPDX-License-Identifier: LGPL-2.1-or-later
"""A lattice with exact surfaces cut at a wall, alone or joined to its skin.

OpenCASCADE's Booleans may lose pieces and call the rest valid, so every result is held against
the volume of the same part as a mesh.
"""

from __future__ import annotations

import os

import FreeCAD as App
import Part

from volfrep.grid.strut_graph import Wireframe
from volfrep.mesh.triangle_mesh import TriangleMesh
from volfrep.reports.estimate import refuse_boundary
from volfrep.util.errors import VolfrepError
from volfrep.util.files import staged
from volfrep.util.progress import Monitor

from .exact import exact_lattice, silence, without_surface_curves
from .faceted import faceted_solid
from .solids import parent_placement, resolve_base

#: An exact part may differ in volume by this fraction from its mesh: coarse ones, of 8 facets a
#: cell, are 0.6 % off. So may an offset wall from the mesh's wall.
VOLUME_TOLERANCE = 1e-2
#: Of an offset by OpenCASCADE, mm; its mode "skin", joined by intersection.
_OFFSET_TOLERANCE = 1e-4
_SKIN, _INTERSECTION = 0, 2


def base_shape(base: App.DocumentObject, infill: App.DocumentObject) -> Part.Shape | None:
    """The shape that was filled, in the infill's coordinates; None where there is none."""
    base = resolve_base(base)
    shape = Part.getShape(base)
    if shape.isNull():
        return None
    to_frame = parent_placement(infill).inverse().multiply(parent_placement(base))
    shape.Placement = to_frame.multiply(shape.Placement)
    return shape


def one_solid(shape: Part.Shape, mesh: TriangleMesh) -> Part.Shape | None:
    """The one solid of a shape; None where it is not one, or not what `mesh` is made of."""
    if len(shape.Solids) != 1:
        return None
    solid = shape.Solids[0].copy()
    return solid if abs(solid.Volume / mesh.volume - 1.0) < VOLUME_TOLERANCE else None


def offset_shape(shape: Part.Shape, shell: float, domain: TriangleMesh) -> Part.Shape | None:
    """A solid's inner wall by OpenCASCADE, where that agrees with the mesh's; None elsewhere."""
    try:
        if shell > 0:
            offset = shape.makeOffsetShape(
                -shell, _OFFSET_TOLERANCE, False, False, _SKIN, _INTERSECTION
            )
        else:
            offset = shape
        solid = _one_solid(offset)
    except (Part.OCCError, RuntimeError, ValueError):  # what OpenCASCADE cannot offset
        return None
    near = abs(solid.Volume / domain.volume - 1.0) < VOLUME_TOLERANCE
    return solid if near and solid.isValid() else None


def faceted_shape(mesh: TriangleMesh) -> Part.Shape:
    """A mesh as a solid, its coplanar triangles joined to faces.

    Raises:
        VolfrepError: OpenCASCADE does not cut at so many triangles, or it is not closed.
    """
    refuse_boundary(len(mesh.triangles))
    return faceted_solid(mesh).removeSplitter()


def exact_part(
    lattice: Wireframe,
    inner: Part.Shape,
    outer: Part.Shape | None,
    expected: float | None,
    monitor: Monitor | None = None,
) -> Part.Shape:
    """The lattice inside a wall, with its skin if there is one.

    Args:
        lattice: struts that reach into the wall, mm.
        inner: solid that the lattice fills.
        outer: solid around it, for lattice and skin in one; None for the lattice alone.
        expected: volume of the same part as a mesh, mm3; None where the two differ on purpose.
        monitor: told the progress, asked for a cancel.

    Raises:
        VolfrepError: OpenCASCADE does not make it, or something of another volume.
        Cancelled: when the monitor says so.
    """
    whole = exact_lattice(lattice, monitor)
    try:
        # The cavity less the lattice touches the outside nowhere: a simple Boolean.
        part = whole.common(inner) if outer is None else outer.cut(inner.cut(whole))
        solids = part.Solids
        valid = bool(solids) and all(solid.isValid() and solid.isClosed() for solid in solids)
    except (Part.OCCError, RuntimeError) as error:
        raise VolfrepError(
            f"OpenCASCADE does not cut the lattice at its wall ({error})."
        ) from error
    volume = float(sum(solid.Volume for solid in solids))
    if not valid:
        raise VolfrepError("OpenCASCADE does not cut the lattice at its wall to a valid solid.")
    if expected is not None:
        check_volume(volume, expected)
    return solids[0] if len(solids) == 1 else Part.makeCompound(solids)


def check_volume(volume: float, expected: float) -> None:
    """Refuse an exact part whose volume is not its mesh's.

    Raises:
        VolfrepError: with both volumes.
    """
    if abs(volume / expected - 1.0) > VOLUME_TOLERANCE:
        raise VolfrepError(
            f"OpenCASCADE makes {volume:,.1f} mm3 of what measures {expected:,.1f} mm3 as a mesh."
        )


def write_shape(shape: Part.Shape, path: str | os.PathLike[str]) -> None:
    """Write a shape as STEP without curves in the surfaces' parameters.

    Raises:
        VolfrepError: the path cannot be written.
    """
    with staged(path) as unfinished, without_surface_curves(), silence():
        shape.exportStep(str(unfinished))


def _one_solid(shape: Part.Shape) -> Part.Shape:
    """The solid of a shape of one shell, its inside where material is."""
    solids = shape.Solids or [Part.Solid(shell) for shell in shape.Shells]
    if len(solids) != 1:
        raise ValueError("not one solid")
    solid = solids[0]
    if solid.Volume < 0:
        solid.reverse()
    return solid

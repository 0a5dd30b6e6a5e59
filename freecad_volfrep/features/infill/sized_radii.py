# SPDX-License-Identifier: LGPL-2.1-or-later
"""Radii that an infill's struts were sized to: kept in the document, as a field that they follow.

They are an ordinary graded lattice: RadiusGrading is Field, and RadiusCurve takes each value for a
radius in mm. A file or a FEM result that is chosen later goes before them.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import FreeCAD as App
import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from volfrep.design.scattered_field import PointField

#: Radii are kept to so many decimals of a mm, so that they are the same in text and file.
DECIMALS = 6
SOURCE = "Size Lattice"


def store_radii(
    obj: App.DocumentObject, nodes: NDArray[np.float64], radii: NDArray[np.float64]
) -> None:
    """Let the struts follow radii that they were sized to; the next recompute makes the mesh.

    Args:
        obj: a lattice infill with a Base.
        nodes: (n, 3) mm, in the coordinates of the infill's group.
        radii: (n,) mm, of the struts there.
    """
    kept = np.round(radii, DECIMALS)
    low, high = float(kept.min()), float(kept.max())
    obj.RadiusResult, obj.RadiusField, obj.RadiusColumn = None, "", ""
    obj.RadiusDrivenBy = "Radius"
    if low == high:
        obj.SizedNodes, obj.SizedRadii = [], []
        obj.RadiusGrading, obj.StrutRadius = "None", low
        return
    matrix = np.array(_from_base(obj).inverse().toMatrix().A).reshape(4, 4)
    placed = nodes @ matrix[:3, :3].T + matrix[:3, 3]
    obj.SizedNodes = [App.Vector(*point) for point in placed.tolist()]
    obj.SizedRadii = kept.tolist()
    obj.RadiusCurve = f"{low:g}:{low:g}, {high:g}:{high:g}"
    obj.RadiusGrading = "Field"


def sized_field(obj: App.DocumentObject) -> PointField | None:
    """The stored radii in the coordinates of the infill's group; None where there are none."""
    from volfrep.design.scattered_field import PointField

    if not obj.SizedRadii or obj.Base is None:
        return None
    matrix = np.array(_from_base(obj).toMatrix().A).reshape(4, 4)
    nodes = np.array([tuple(point) for point in obj.SizedNodes], np.float64)
    # What a placement that is undone loses does not count as a change.
    placed = np.round(nodes @ matrix[:3, :3].T + matrix[:3, 3], DECIMALS)
    return PointField(placed, np.array(obj.SizedRadii, np.float64), source=SOURCE)


def _from_base(obj: App.DocumentObject) -> App.Placement:
    """From the base's own coordinates to those of the infill's group: the radii move with it."""
    from freecad_volfrep.bridge.solids import parent_placement, resolve_base

    base = resolve_base(obj.Base)
    place = parent_placement(base).multiply(base.Placement)
    return parent_placement(obj).inverse().multiply(place)

# SPDX-License-Identifier: LGPL-2.1-or-later
"""What an infill was sized to: radii of its struts and thicknesses of its skin, kept as fields.

Radii are an ordinary graded lattice: RadiusGrading is Field, and RadiusCurve takes each value for a
radius in mm. A file or a FEM result that is chosen later goes before them. The skin follows its own
as long as SkinFollowsSizing says so, and a file goes before it, too.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

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
    obj.SizedNodes = _as_base_lies(obj, nodes)
    obj.SizedRadii = kept.tolist()
    obj.RadiusCurve = f"{low:g}:{low:g}, {high:g}:{high:g}"
    obj.RadiusGrading = "Field"


def sized_field(obj: App.DocumentObject) -> PointField | None:
    """The stored radii in the coordinates of the infill's group; None where there are none."""
    return _field(obj, obj.SizedNodes, obj.SizedRadii)


def store_skin(obj: App.DocumentObject, least: float, thickness: PointField) -> None:
    """Let the skin follow a thickness that it was sized to; the next recompute makes the mesh.

    Args:
        obj: a lattice infill with a Base.
        least: mm, that the skin has nowhere less than.
        thickness: mm, in the coordinates of the infill's group.
    """
    obj.ShellThickness, obj.SkinField, obj.SkinFollowsSizing = least, "", True
    obj.SizedSkinPoints = _as_base_lies(obj, thickness.points)
    obj.SizedSkin = np.round(thickness.values, DECIMALS).tolist()


def sized_skin(obj: App.DocumentObject) -> PointField | None:
    """The thickness that the skin follows; None where it follows none that was found."""
    if not obj.SkinFollowsSizing or not obj.ShellThickness.Value:
        return None
    return _field(obj, obj.SizedSkinPoints, obj.SizedSkin)


def _field(obj: App.DocumentObject, points: Any, values: Any) -> PointField | None:
    """Values at points of the base, in the coordinates of the infill's group; None without any."""
    from volfrep.design.scattered_field import PointField

    if not values or obj.Base is None:
        return None
    matrix = np.array(_from_base(obj).toMatrix().A).reshape(4, 4)
    places = np.array([tuple(point) for point in points], np.float64)
    # What a placement that is undone loses does not count as a change.
    placed = np.round(places @ matrix[:3, :3].T + matrix[:3, 3], DECIMALS)
    return PointField(placed, np.array(values, np.float64), source=SOURCE)


def _as_base_lies(obj: App.DocumentObject, points: NDArray[np.float64]) -> list[App.Vector]:
    """Points (n, 3) of the infill's group in the base's own coordinates."""
    matrix = np.array(_from_base(obj).inverse().toMatrix().A).reshape(4, 4)
    placed = points @ matrix[:3, :3].T + matrix[:3, 3]
    return [App.Vector(*point) for point in placed.tolist()]


def _from_base(obj: App.DocumentObject) -> App.Placement:
    """From the base's own coordinates to those of the infill's group: the radii move with it."""
    from freecad_volfrep.bridge.solids import parent_placement, resolve_base

    base = resolve_base(obj.Base)
    place = parent_placement(base).multiply(base.Placement)
    return parent_placement(obj).inverse().multiply(place)

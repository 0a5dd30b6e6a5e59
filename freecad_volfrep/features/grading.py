# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the properties of the group Grading ask the engine for.

Points and directions are in the coordinate system that the object lies in, like `Origin`: the
document's, or that of the App::Part that holds the object.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import FreeCAD as App

if TYPE_CHECKING:
    from volfrep.design.profile import Profile
    from volfrep.design.scattered_field import PointField

#: What a user chooses by name, and the engine's word for it.
PROFILES = {
    "Scalar": "scalar",
    "Linear": "linear",
    "Quadratic": "quadratic",
    "Exponential": "exponential",
    "Formula": "expression",
}
OFF = "None"
CARTESIAN = "Cartesian"
CHOICES = {
    "SizeGrading": [OFF, *PROFILES],
    "RadiusGrading": [OFF, "Direction", "Skin", "Core", "Field"],
    "RadiusLaw": [name for name in PROFILES if name != "Scalar"],
    "CellMap": [CARTESIAN, "Cylindrical", "Spherical"],
}


def gradings_of(obj: App.DocumentObject) -> dict[str, Any]:
    """What the properties ask for, by the names of `LatticeSpec`.

    Raises:
        VolfrepError: naming the first property that makes no sense.
    """
    from volfrep.design.grading import CellMap, Orientation, RadiusGrading, SizeGrading
    from volfrep.design.profile import Profile
    from volfrep.design.scattered_field import read_curve

    size = radius = cell_map = orientation = None
    if obj.SizeGrading != OFF:
        profile = _law(obj.SizeGrading, obj.LambdaMin, obj.LambdaMax, obj.LambdaFormula)
        size = SizeGrading(profile, tuple(obj.GradingDirection))
    if obj.RadiusGrading == "Field":
        curve = read_curve(obj.RadiusCurve) if obj.RadiusCurve.strip() else ()
        radius = RadiusGrading(
            "field",
            Profile() if curve else Profile("linear", *_radii(obj)),  # a curve needs no law
            field=_field(obj),
            column=obj.RadiusColumn or None,
            curve=curve,
        )
    elif obj.RadiusGrading != OFF:
        profile = _law(obj.RadiusLaw, *_radii(obj), obj.RadiusFormula)
        by, direction = obj.RadiusGrading.lower(), tuple(obj.RadiusDirection)
        radius = RadiusGrading(by, profile, direction, obj.RadiusReach.Value)
    if obj.CellMap != CARTESIAN:
        centre = tuple(obj.MapCentre) if obj.UseMapCentre else None
        kind, axis = obj.CellMap.lower(), tuple(obj.MapAxis)
        cell_map = CellMap(kind, centre, axis, obj.MapAround or None)
    if obj.RotationAngle.Value != 0:
        origin = tuple(obj.RotationOrigin) if obj.UseRotationOrigin else None
        orientation = Orientation(tuple(obj.RotationAxis), obj.RotationAngle.Value, origin)
    return {
        "size_grading": size,
        "radius_grading": radius,
        "cell_map": cell_map,
        "orientation": orientation,
        "keep_radius": obj.KeepRadius or (size is None and cell_map is None),
    }


def _law(name: str, start: float, end: float, formula: str = "") -> Profile:
    from volfrep.design.profile import Profile

    kind = PROFILES[name]
    if kind == "expression":
        return Profile(kind, expression=formula)
    return Profile(kind, start, end)


def _radii(obj: App.DocumentObject) -> tuple[float, float]:
    usual = obj.StrutRadius.Value
    return obj.RadiusMin.Value or usual, obj.RadiusMax.Value or usual


def _field(obj: App.DocumentObject) -> PointField | None:
    """The field of the FEM result or of the file; None where neither is chosen."""
    from freecad_volfrep.bridge.fem_fields import field_of_result
    from freecad_volfrep.bridge.solids import parent_placement
    from volfrep.design.scattered_field import read_point_field
    from volfrep.util.errors import VolfrepError

    if obj.RadiusResult is not None:
        if obj.RadiusField:
            raise VolfrepError(
                "The radius is to follow both a file and a FEM result: clear either RadiusField "
                "or RadiusResult."
            )
        return field_of_result(obj.RadiusResult, obj.RadiusColumn, parent_placement(obj))
    if obj.RadiusField:
        return read_point_field(obj.RadiusField, obj.RadiusColumn or None)
    return None

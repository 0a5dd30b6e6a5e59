# SPDX-License-Identifier: LGPL-2.1-or-later
"""The values that an infill's properties stand for, by the names of the table of parameters.

Points and directions are in the coordinate system that the object lies in: the document's, or that
of the App::Part that holds the object.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import FreeCAD as App

from freecad_volfrep.features.properties.quantities import density_of, number_of
from volfrep.design.parameters import BY_NAME, PARAMETERS, Parameter
from volfrep.design.parameters.parameter import effective
from volfrep.design.parameters.table import CUSTOM_CELL
from volfrep.design.target import read_target
from volfrep.util.errors import VolfrepError

from .materials import material_of
from .sized_radii import sized_field, sized_skin

if TYPE_CHECKING:
    from volfrep.design.scattered_field import PointField
    from volfrep.design.spec import LatticeSpec
    from volfrep.design.target import Target
    from volfrep.mechanics.materials import SolidMaterial

#: Kinds whose values have to be looked up in the document.
_LOOKED_UP = ("link", "faces", "points", "lengths")
#: A rotation is read to so many decimals of a degree and of its axis: what a placement's
#: quaternion loses when it is saved does not count as a change.
_DECIMALS = 9


#: What holds the target of what drives the radius.
_DRIVEN_BY = {
    "relative density": "target_density", "mass": "target_mass", "stiffness": "target_stiffness",
}  # fmt: skip

#: The properties that say the values.
SOURCES = frozenset(
    name
    for parameter in PARAMETERS
    if parameter.in_freecad
    for name in (
        *[parameter.property_name] * (not parameter.position_of),
        *[parameter.switch_name] * bool(parameter.switch),
    )
)


def json_values(obj: App.DocumentObject) -> dict[str, Any]:
    """What the properties say, whether or not it has an effect; None for nothing.

    Links, faces and the density are not looked at. Every other property must be there.
    """
    return {
        parameter.name: _json_value(obj, parameter)
        for parameter in PARAMETERS
        if parameter.in_freecad and parameter.kind not in (*_LOOKED_UP, "density")
    }


def specification_of(obj: App.DocumentObject) -> LatticeSpec:
    """The specification that the object's properties stand for.

    Raises:
        VolfrepError: naming the first property that makes no sense.
    """
    from volfrep.design.parameters.specification import specification

    values, target = values_in_effect(obj)
    spec = specification(values, lambda name: BY_NAME[name].property_name)
    return spec if target is None else replace(spec, target=target)


def values_in_effect(obj: App.DocumentObject) -> tuple[dict[str, Any], Target | None]:
    """The values that have an effect, as `specification` takes them, and what the radius is for.

    Raises:
        VolfrepError: naming the first property that makes no sense.
    """
    from volfrep.design.spec_parts import first_radius

    from .graph_faces import cells_along_faces
    from .openings import openings_of

    material = material_of(obj)
    density = density_of(obj) if material is None else material.density
    values = json_values(obj) | {"density": density} | openings_of(obj)
    _, idle = effective(PARAMETERS, values)
    values = {name: value for name, value in values.items() if name not in idle}
    if values["cell"] == CUSTOM_CELL:
        values["cell"] = values.pop("cell_file")
        if not values["cell"].lower().endswith(".json"):
            raise VolfrepError(
                "The cell type Custom needs a cell: choose its .json file as CellFile."
            )
    target = None if values["make"] == "domain" else _target(values, material)
    if target is not None and "strut_radius" in values:
        values["strut_radius"] = first_radius(values["cell_size"], values["fillet"])
    for name in ("radius_start", "radius_end"):
        if name in values:
            usual = "strut_radius" if "strut_radius" in values else "wall_thickness"
            values[name] = values[name] or values[usual]
    if "radius_field" in values:
        values["radius_field"] = _field(obj)
    values["skin_field"] = values["skin_field"] or sized_skin(obj)
    if values.get("network") == "faces":
        values["network_faces"] = cells_along_faces(obj, values)
    return values, target


def _target(values: dict[str, Any], material: SolidMaterial | None) -> Target | None:
    """What the radius is chosen for; None where it is given.

    Raises:
        VolfrepError: it makes no sense, or a stiffness has no material.
    """
    driver = values["radius_driven_by"]
    if driver == "radius":
        return None
    value, young = values[_DRIVEN_BY[driver]], 1.0
    if driver == "stiffness":
        if material is None:
            raise VolfrepError(
                "A stiffness that drives the radius is that of a material: "
                "choose one for the infill."
            )
        value, young = (value, values["stiffness_direction"]), material.young
    return read_target({driver.replace(" ", "_"): value}, young)


def _json_value(obj: App.DocumentObject, parameter: Parameter) -> Any:
    if parameter.switch and not getattr(obj, parameter.switch_name):
        return None
    if parameter.position_of:
        return tuple(getattr(obj, BY_NAME[parameter.position_of].property_name).Base)
    value = getattr(obj, parameter.property_name)
    if parameter.kind == "choice":
        return value.lower()
    if parameter.kind in ("mass", "stress"):
        return number_of(obj, parameter.property_name)
    if parameter.kind == "length":
        return value.Value
    if parameter.kind in ("direction", "point"):
        return tuple(value)
    if parameter.kind == "rotation":
        axis, angle = value.Rotation.Axis, math.degrees(value.Rotation.Angle)
        turn = tuple(round(number, _DECIMALS) + 0.0 for number in (*axis, angle))
        return turn if turn[3] else None
    return value.strip() if parameter.kind == "curve" else value


def _field(obj: App.DocumentObject) -> PointField | None:
    """The field of the FEM result, of the file, or of the sized radii; None where there is none."""
    from freecad_volfrep.bridge.fem_fields import field_of_result
    from freecad_volfrep.bridge.solids import parent_placement
    from volfrep.design.grading import read_point_field

    if obj.RadiusResult is not None:
        if obj.RadiusField:
            raise VolfrepError(
                "The radius is to follow both a file and a FEM result: clear either RadiusField "
                "or RadiusResult."
            )
        return field_of_result(obj.RadiusResult, obj.RadiusColumn, parent_placement(obj))
    if obj.RadiusField:
        return read_point_field(obj.RadiusField, obj.RadiusColumn or None)
    return sized_field(obj)

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Named settings: an infill's values as the engine's specification files, saved and applied.

A recipe says nothing of the solid: its material, picked faces and places of holes stay with their
infill.
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import FreeCAD as App

from freecad_volfrep.features.properties.quantities import is_driven, set_value
from volfrep.design.parameters import BY_NAME, PARAMETERS, Parameter
from volfrep.design.parameters.table import CUSTOM_CELL
from volfrep.design.target import read_target
from volfrep.util.errors import VolfrepError
from volfrep.util.files import make_folder

from .values import specification_of

#: Of a solid and its material: no recipe's.
_OF_A_SOLID = ("build_direction", "density")
#: What of a specification hangs on a solid's own faces.
_NO_PICKED: dict[str, Any] = {"open_faces": (), "face_skins": (), "keep_solid": ()}
#: What a file calls a target, the driver of the radius that it is, and its property.
_TARGETS = {
    "relative_density": ("Relative density", "TargetDensity"),
    "mass": ("Mass", "TargetMass"),
    "stiffness": ("Stiffness", "TargetStiffness"),
}
_PLAIN = ("length", "number", "integer", "flag", "text", "formula", "curve", "file", "density")


def recipe_folder() -> Path:
    """The user's folder of recipes; it may not be there yet."""
    return Path(App.getUserAppDataDir()) / "VOLFREP" / "recipes"


def known_recipes() -> dict[str, Path]:
    """The files by their names: those that come with VOLFREP, then the user's own."""
    from volfrep.design.parameters.recipes import RECIPES

    own = {file.stem: file for file in sorted(recipe_folder().glob("*.toml"))}
    return {**RECIPES, **own}


def save_recipe(obj: App.DocumentObject, name: str) -> Path:
    """Write the values of an infill under a name in the user's folder.

    Raises:
        VolfrepError: they make no sense, no file can say them, or the name is none for a file.
    """
    from volfrep.design.parameters.spec_file import write_spec

    if not name or set(name) & set('/\\:*?"<>|') or name.startswith("."):
        raise VolfrepError(f"'{name}' is no name for a recipe: use letters, digits and blanks.")
    spec = specification_of(obj)
    drains = spec.drains and replace(spec.drains, places=())
    folder = make_folder(recipe_folder())
    file = folder / f"{name}.toml"
    write_spec(replace(spec, **_NO_PICKED, drains=drains, density=1.0), file)
    return file


def apply_recipe(obj: App.DocumentObject, path: str | os.PathLike[str]) -> None:
    """Give an infill the values of a file, and every other one its default; nothing is computed.

    What an expression drives stays as it is.

    Raises:
        VolfrepError: the file cannot be read or makes no sense; nothing is changed.
    """
    from volfrep.design.parameters.spec_file import read_spec, read_values

    values = read_values(path)
    read_spec(path)  # says what makes no sense
    cell = str(values.get("cell", BY_NAME["cell"].default))
    if cell.lower().endswith(".json"):
        values["cell_file"], cell = cell, CUSTOM_CELL
    _set(obj, "CellType", _known_cell(obj, cell))
    target = read_target(values)
    if target is None:
        _set(obj, "RadiusDrivenBy", "Radius")
    else:
        driver, name = _TARGETS[target.aim]
        _set(obj, "RadiusDrivenBy", driver)
        _set(obj, name, target.value)
    if target is not None and target.direction is not None:
        _set(obj, "StiffnessDirection", App.Vector(*target.direction))
    for parameter in PARAMETERS:
        if parameter.in_freecad and (parameter.in_command or parameter.name == "cell_file"):
            _apply(obj, parameter, values)


def _apply(obj: App.DocumentObject, parameter: Parameter, values: Mapping[str, Any]) -> None:
    """Give a property the value of its parameter."""
    name, kind = parameter.property_name, parameter.kind
    if parameter.name in _OF_A_SOLID or kind == "cell":
        return
    value = values.get(parameter.name, parameter.default)
    if parameter.switch:
        _set(obj, parameter.switch_name, value is not None)
    if parameter.position_of:
        turn = BY_NAME[parameter.position_of].property_name
        placement = App.Placement(getattr(obj, turn))
        placement.Base = App.Vector(*(value or (0.0, 0.0, 0.0)))
        _set(obj, turn, placement)
    elif kind == "rotation":
        *axis, angle = value or (0.0, 0.0, 1.0, 0.0)
        _set(obj, name, App.Placement(App.Vector(), App.Rotation(App.Vector(*axis), angle)))
    elif kind in ("direction", "point"):
        if value is not None:
            _set(obj, name, App.Vector(*value))
    elif kind == "choice":
        _set(obj, name, str(value).capitalize())
    elif kind in _PLAIN:
        if value is None:
            value = parameter.initial if parameter.initial is not None else ""
        _set(obj, name, value)


def _set(obj: App.DocumentObject, name: str, value: Any) -> None:
    if not is_driven(obj, name):
        set_value(obj, name, value)


def _known_cell(obj: App.DocumentObject, cell: str) -> str:
    """A cell's name as the property's list has it; files write it in any case."""
    names = {name.lower(): name for name in obj.getEnumerationsOfProperty("CellType")}
    return str(names[cell.lower()])

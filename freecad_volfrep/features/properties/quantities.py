# SPDX-License-Identifier: LGPL-2.1-or-later
"""Densities, masses, stresses: with their unit where FreeCAD has such properties, else numbers.

FreeCAD 0.20 has neither `App::PropertyDensity` nor `App::PropertyMass`, and no other property that
can be given their units: there both are numbers, in g/cm3 and g.
"""

from __future__ import annotations

from typing import Any

import FreeCAD as App

from volfrep.util.errors import VolfrepError

#: The type of property in place of one that this FreeCAD does not have.
FALLBACK = "App::PropertyFloat"
#: The unit of the numbers, by the type of the property that has a unit.
UNITS = {
    "App::PropertyDensity": "g/cm^3",
    "App::PropertyMass": "g",
    "App::PropertyPressure": "MPa",
}
#: The properties of these types.
NAMES = {
    "Density": "App::PropertyDensity",
    "Mass": "App::PropertyMass",
    "TargetMass": "App::PropertyMass",
}
#: No material is so dense, in g/cm3: a number was meant in another unit.
DENSEST = 100.0


#: Asked once: to answer, FreeCAD makes a property of each type, FEM meshes among them, of which
#: it bears some ten thousand.
_supported: set[str] = set()


def supported(obj: App.DocumentObject, type_name: str) -> bool:
    """Whether this FreeCAD has a type of property."""
    if not _supported:
        _supported.update(obj.supportedProperties())
    return type_name in _supported


def set_value(obj: App.DocumentObject, name: str, value: Any) -> None:
    """Set a property; a number for a density is in g/cm3, for a mass in g, a stress in MPa."""
    unit = UNITS.get(obj.getTypeIdOfProperty(name))
    if unit is not None and isinstance(value, (int, float)):
        value = App.Units.Quantity(f"{value!r} {unit}")
    setattr(obj, name, value)


def set_expression(obj: App.DocumentObject, name: str, text: str) -> None:
    """Let an expression say what a property is, now and when the document is recomputed.

    Args:
        obj: that has the property.
        name: of the property.
        text: the expression; one without a unit is in the unit that `set_value` takes. Empty: none
            any more.

    Raises:
        Exception: of FreeCAD's, with its sentence on what is wrong; what was there stays.
    """
    if not text.strip():
        obj.setExpression(name, None)
        return
    value = obj.evalExpression(text)
    unit = UNITS.get(obj.getTypeIdOfProperty(name))
    if unit is not None and isinstance(value, (int, float)):
        text = f"({text}) * 1 {unit}"
    before = getattr(obj, name)
    set_value(obj, name, value)
    try:
        obj.setExpression(name, text)
    except Exception:
        setattr(obj, name, before)
        raise


def is_driven(obj: App.DocumentObject, name: str) -> bool:
    """Whether an expression says what a property is."""
    return any(path.strip(".") == name for path, _ in obj.ExpressionEngine)


def mass_of(obj: App.DocumentObject) -> float:
    """The mass of an object, g."""
    return number_of(obj, "Mass")


def density_of(obj: App.DocumentObject) -> float:
    """The density of an object's material, g/cm3.

    Raises:
        VolfrepError: nothing is so dense.
    """
    density = number_of(obj, "Density")
    if density > DENSEST:
        raise VolfrepError(
            f"A density of {density:g} g/cm3 cannot be meant: give it with its unit, such as "
            "'2.7 g/cm^3'."
        )
    return density


def number_of(obj: App.DocumentObject, name: str) -> float:
    """A property's number in the unit that `set_value` takes it in."""
    value = getattr(obj, name)
    unit = UNITS.get(obj.getTypeIdOfProperty(name))
    return float(value if unit is None else value.getValueAs(unit))

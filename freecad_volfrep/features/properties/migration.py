# SPDX-License-Identifier: LGPL-2.1-or-later
"""Infills of earlier releases: their properties under the present names, types and groups.

Each step looks at what it finds and not at a version, so that all of it may run again.

Old and new properties stand beside each other until values and expressions have moved. A rotation
is read to nine decimals, since a saved quaternion loses its last digits.
"""

from __future__ import annotations

import re

import FreeCAD as App

from .property_table import Property
from .quantities import FALLBACK, NAMES, UNITS, set_value, supported

#: Properties that were called otherwise.
RENAMED = {
    "LambdaMin": "LambdaStart",
    "LambdaMax": "LambdaEnd",
    "RadiusLaw": "RadiusProfile",
    "RadiusMin": "RadiusStart",
    "RadiusMax": "RadiusEnd",
}
#: Where the three properties of a rotation are in its placement.
TURNED = {
    "RotationAngle": "Orientation.Rotation.Angle",
    "RotationAxis": "Orientation.Rotation.Axis",
    "RotationOrigin": "Orientation.Base",
}


def migrate(obj: App.DocumentObject, table: tuple[Property, ...]) -> None:
    """Bring an object of an earlier release up to the table, all of whose properties it has.

    Values and expressions are carried over: those that drive the object's properties, and those of
    other objects and of spreadsheets' cells that name them.
    """
    gone = [name for name in (*RENAMED, *TURNED) if name in obj.PropertiesList]
    expressions = {path.lstrip("."): text for path, text in obj.ExpressionEngine}
    for old in gone:
        for path in [p for p in expressions if re.match(rf"{old}\b", p)]:
            obj.setExpression(path, None)
    if any(old in TURNED for old in gone):
        obj.Orientation = _placement(obj)
    for old, new in RENAMED.items():
        if old in gone:
            value = getattr(obj, old)
            setattr(obj, new, getattr(value, "Value", value))
    for old in gone:
        new = RENAMED.get(old) or TURNED[old]
        for path, text in expressions.items():
            if re.match(rf"{old}\b", path):
                obj.setExpression(path.replace(old, new, 1), text)
        obj.removeProperty(old)
    if gone:
        _follow_on(obj, gone)
    _give_units(obj)
    for prop in table:
        if obj.getGroupOfProperty(prop.name) != prop.group:
            obj.setGroupOfProperty(prop.name, prop.group)
        if obj.getDocumentationOfProperty(prop.name) != prop.description:
            obj.setDocumentationOfProperty(prop.name, prop.description)


def _placement(obj: App.DocumentObject) -> App.Placement:
    """The placement that the properties of a rotation stood for."""
    axis, angle = obj.RotationAxis, obj.RotationAngle.Value
    if axis.Length == 0.0:
        axis = App.Vector(0, 0, 1)
        if angle:
            App.Console.PrintWarning(
                f"VOLFREP, {obj.Label}: the lattice was turned about no axis, which made no "
                "sense: it is turned about Z now.\n"
            )
    return App.Placement(obj.RotationOrigin, App.Rotation(axis, angle))


def _give_units(obj: App.DocumentObject) -> None:
    """Density and mass as properties with a unit, where this FreeCAD has such."""
    for name, wanted in NAMES.items():
        if obj.getTypeIdOfProperty(name) != FALLBACK or not supported(obj, wanted):
            continue
        value, group = getattr(obj, name), obj.getGroupOfProperty(name)
        text, status = obj.getDocumentationOfProperty(name), obj.getPropertyStatus(name)
        driven = dict(obj.ExpressionEngine).get(name)
        obj.setExpression(name, None)
        obj.removeProperty(name)
        obj.addProperty(wanted, name, group, text)
        obj.setPropertyStatus(name, [flag for flag in status if isinstance(flag, str)])
        set_value(obj, name, value)
        if driven is not None:
            obj.setExpression(name, f"({driven}) * 1 {UNITS[wanted]}")


def _follow_on(obj: App.DocumentObject, gone: list[str]) -> None:
    """Bring expressions of other objects, which name what is called otherwise now, up to it."""
    ours = rf"((?<![\w.]){re.escape(obj.Name)}|<<{re.escape(obj.Label)}>>)\.({'|'.join(gone)})\b"

    def renamed(found: re.Match[str]) -> str:
        return f"{found[1]}.{RENAMED.get(found[2]) or TURNED[found[2]]}"

    for other in obj.Document.Objects:
        if other == obj:
            continue
        for path, text in other.ExpressionEngine:
            now = re.sub(ours, renamed, text)
            if now != text:
                other.setExpression(path, now)
        if other.TypeId == "Spreadsheet::Sheet":
            for cell in re.findall('address="([A-Z]+[0-9]+)"', other.cells.Content):
                text = other.getContents(cell)
                now = re.sub(ours, renamed, text)
                if now != text:
                    other.set(cell, now)

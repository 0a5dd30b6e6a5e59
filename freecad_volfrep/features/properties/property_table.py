# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tables of properties: a row says all that FreeCAD wants to know of one."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import FreeCAD as App

from .quantities import FALLBACK, set_value, supported

# Flags of addProperty: Output says that a change does not ask for a recompute.
READ_ONLY, HIDDEN, OUTPUT = 1, 4, 8


@dataclass(frozen=True)
class Property:
    """One property: FreeCAD's type, name, group, description, first value, and its flags."""

    type: str
    name: str
    group: str
    description: str
    default: Any = None
    flags: int = 0


def result(type_name: str, name: str, description: str) -> Property:
    """A property that only we write."""
    return Property(type_name, name, "Result", description, flags=READ_ONLY | OUTPUT)


def add_missing(
    obj: App.DocumentObject, table: tuple[Property, ...], choices: dict[str, list[str]]
) -> None:
    """Add the properties of a table that `obj` lacks; `choices` are those of its enumerations."""
    for prop in table:
        if prop.name in obj.PropertiesList:
            continue
        kind = prop.type if supported(obj, prop.type) else FALLBACK
        obj.addProperty(kind, prop.name, prop.group, prop.description, prop.flags)
        if prop.name in choices:
            setattr(obj, prop.name, choices[prop.name])
        if prop.default is not None:
            set_value(obj, prop.name, prop.default)

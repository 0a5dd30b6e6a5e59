# SPDX-License-Identifier: LGPL-2.1-or-later
"""Which properties of an infill apply: the others are hidden."""

from __future__ import annotations

import FreeCAD as App

from volfrep.design.parameters import BY_NAME, PARAMETERS
from volfrep.design.parameters.parameter import effective
from volfrep.design.parameters.table import NOTHING

from .values import SOURCES, json_values

#: Properties on which it hangs whether others apply.
CONTROLS = tuple(
    {
        BY_NAME[name].property_name: None
        for parameter in PARAMETERS
        for need in parameter.needs
        for name in need.names
    }
    | {p.switch_name: None for p in PARAMETERS if p.switch}
    | {"PrintMaterial": None, "SizedSkin": None}
)
_SHOWN, _READ_ONLY, _HIDDEN = 0, 1, 2
#: Properties that are shown, but written by us, unless another one has this value.
_DRIVEN = {
    "StrutRadius": ("RadiusDrivenBy", "Radius"),
    "WallThickness": ("RadiusDrivenBy", "Radius"),
    "WallOffset": ("RadiusDrivenBy", "Radius"),
    "Density": ("PrintMaterial", NOTHING),
}


def show_applicable(obj: App.DocumentObject) -> None:
    """Hide the properties that have no effect; does nothing while some are still missing."""
    if not SOURCES.issubset(obj.PropertiesList):
        return
    _, idle = effective(PARAMETERS, json_values(obj))
    for parameter in PARAMETERS:
        applies = parameter.name not in idle
        if parameter.switch:
            _show(obj, parameter.switch_name, applies)
            applies = applies and getattr(obj, parameter.switch_name)
        _show(obj, parameter.property_name, applies)
    _show(obj, "SkinFollowsSizing", "SizedSkin" in obj.PropertiesList and bool(obj.SizedSkin))
    for name, (driver, own) in _DRIVEN.items():
        if getattr(obj, driver) != own and "Hidden" not in obj.getEditorMode(name):
            obj.setEditorMode(name, _READ_ONLY)


def _show(obj: App.DocumentObject, name: str, applies: bool) -> None:
    if name in obj.PropertiesList:
        obj.setEditorMode(name, _SHOWN if applies else _HIDDEN)

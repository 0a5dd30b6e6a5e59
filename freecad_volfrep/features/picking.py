# SPDX-License-Identifier: LGPL-2.1-or-later
"""Properties of an infill that are set by picking: faces, directions and points."""

from __future__ import annotations

from typing import Any

import FreeCAD as App

from volfrep.design.parameters import PARAMETERS

#: What is picked for the kinds of parameters.
FACES, DIRECTION, POINT = "faces", "direction", "point"
#: Properties, and what is picked for each, in the panel's order.
PICKED = {
    parameter.property_name: POINT if parameter.kind == "points" else parameter.kind
    for parameter in PARAMETERS
    if parameter.kind in (FACES, DIRECTION, POINT, "points")
    and parameter.in_freecad
    and not parameter.position_of
}
_SWITCHES = {p.property_name: p.switch_name for p in PARAMETERS if p.switch}


def pickable(obj: App.DocumentObject) -> list[str]:
    """Those that have an effect with the other values of an infill, or would once they are set."""
    return [name for name in PICKED if "Hidden" not in obj.getEditorMode(_SWITCHES.get(name, name))]


def pick(obj: App.DocumentObject, name: str, owner: App.DocumentObject, element: str) -> None:
    """Set a property to what was picked.

    A face is added, or taken away where it is there already; points are added; a direction and a
    single point take the place of the last.

    Args:
        obj: the infill.
        name: one of `PICKED`.
        owner: the object that was picked.
        element: its face, edge or vertex, or empty.

    Raises:
        VolfrepError: it has no direction, no point, or is no face.
    """
    from freecad_volfrep.bridge.picked import direction_of, point_of
    from freecad_volfrep.bridge.solids import parent_placement
    from volfrep.util.errors import VolfrepError

    frame = parent_placement(obj)
    if PICKED[name] == FACES:
        if not element.startswith("Face"):
            raise VolfrepError(f"'{element or owner.Label}' is no face: pick faces.")
        setattr(obj, name, _toggled(getattr(obj, name), owner, element))
    elif PICKED[name] == DIRECTION:
        setattr(obj, name, direction_of(owner, element, frame))
    elif obj.getTypeIdOfProperty(name) == "App::PropertyVectorList":
        setattr(obj, name, [*getattr(obj, name), point_of(owner, element, frame)])
    else:
        setattr(obj, name, point_of(owner, element, frame))
    if name in _SWITCHES:
        setattr(obj, _SWITCHES[name], True)


def picked_of(obj: App.DocumentObject, name: str) -> Any:
    """What a property is; an empty list where it is not in use."""
    if name in _SWITCHES and not getattr(obj, _SWITCHES[name]):
        return []
    return getattr(obj, name)


def unpick(obj: App.DocumentObject, name: str) -> None:
    """Give a property its first value again."""
    if name in _SWITCHES:
        setattr(obj, _SWITCHES[name], False)
    elif PICKED[name] == DIRECTION:
        default: Any = next(p.default for p in PARAMETERS if p.property_name == name)
        setattr(obj, name, App.Vector(*default))
    else:
        setattr(obj, name, [])


def _toggled(links: list[Any], owner: App.DocumentObject, element: str) -> list[Any]:
    """Links to elements with this one beside, or without it."""
    faces = {other: list(names) for other, names in links}
    names = faces.setdefault(owner, [])
    if element in names:
        names.remove(element)
    else:
        names.append(element)
    return [(other, tuple(names)) for other, names in faces.items() if names]

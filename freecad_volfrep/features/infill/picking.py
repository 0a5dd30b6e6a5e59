# SPDX-License-Identifier: LGPL-2.1-or-later
"""Properties of an infill that are set by picking: faces, directions and points."""

from __future__ import annotations

from typing import Any

import FreeCAD as App

from volfrep.design.parameters import PARAMETERS
from volfrep.util.errors import VolfrepError

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
#: Of these every face has a length of its own in the property beside.
LENGTHS = {"SkinFaces": "SkinThicknesses"}
#: Of these all faces have one length; solids are picked as well.
DISTANCES = {"KeepSolidAround": "KeepDistance"}
#: Of these all holes have one diameter, which the first one that is picked gets.
DIAMETERS = {"DrainPoints": "DrainDiameter", "DrainFaces": "DrainDiameter"}
#: A hole's first diameter where no process says what empties a void, mm.
HOLE = 3.0
_SWITCHES = {p.property_name: p.switch_name for p in PARAMETERS if p.switch}


def pickable(obj: App.DocumentObject) -> list[str]:
    """Those that have an effect with the other values of an infill, or would once they are set."""
    needed = {**_SWITCHES, **DIAMETERS}
    return [name for name in PICKED if "Hidden" not in obj.getEditorMode(needed.get(name, name))]


def hole_diameter(obj: App.DocumentObject) -> float:
    """The diameter of an infill's drain holes, mm; without any, what its process asks for."""
    from volfrep.reports.processes import find_process

    from .materials import process_of

    if obj.DrainDiameter.Value:
        return float(obj.DrainDiameter.Value)
    process = process_of(obj)
    return (find_process(process).escape_hole if process else None) or HOLE


def pick(
    obj: App.DocumentObject,
    name: str,
    owner: App.DocumentObject,
    element: str,
    length: float | None = None,
    at: App.Vector | None = None,
) -> None:
    """Set a property to what was picked.

    A face is added, or taken away where it is there already, with the same length if faces have
    one; points are added, those of holes where the face was clicked at; a direction and a single
    point take the place of the last. Where solids may be picked, a face that is not one of the
    infill's solid stands for its own.

    Args:
        obj: the infill.
        name: one of `PICKED`.
        owner: the object that was picked.
        element: its face, edge or vertex, or empty.
        length: of one of `LENGTHS`, or of one of `DIAMETERS` where there are no holes yet, mm.
        at: where the mouse has picked it, mm, in the document's coordinates; None elsewhere.

    Raises:
        VolfrepError: it has no direction, no point, or is no face.
    """
    from freecad_volfrep.bridge.picked import direction_of, point_of
    from freecad_volfrep.bridge.solids import parent_placement

    frame = parent_placement(obj)
    if name in DISTANCES:
        element = _part_of(obj, owner, element, frame)
        setattr(obj, name, _toggled(getattr(obj, name), owner, element))
    elif PICKED[name] == FACES:
        if not element.startswith("Face"):
            raise VolfrepError(f"'{element or owner.Label}' is no face: pick faces.")
        if name in LENGTHS:
            _toggle_thick(obj, owner, element, length or 0.0)
        else:
            setattr(obj, name, _toggled(getattr(obj, name), owner, element))
    elif PICKED[name] == DIRECTION:
        setattr(obj, name, direction_of(owner, element, frame))
    elif obj.getTypeIdOfProperty(name) == "App::PropertyVectorList":
        is_at = name in DIAMETERS and element.startswith("Face") and at is not None
        point = frame.inverse().multVec(at) if is_at else point_of(owner, element, frame)
        setattr(obj, name, [*getattr(obj, name), point])
    else:
        setattr(obj, name, point_of(owner, element, frame))
    if name in _SWITCHES:
        setattr(obj, _SWITCHES[name], True)
    if name in DIAMETERS and not obj.DrainDiameter.Value:
        obj.DrainDiameter = length or hole_diameter(obj)


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
        if name in LENGTHS:
            setattr(obj, LENGTHS[name], [])


def _part_of(
    obj: App.DocumentObject, owner: App.DocumentObject, element: str, frame: App.Placement
) -> str:
    """The element of what was picked to be kept solid: a face of the part, or empty for a solid.

    Raises:
        VolfrepError: it is neither.
    """
    from freecad_volfrep.bridge.solids import face_facets, is_fillable, resolve_base
    from volfrep.design.openings import OpenPatch

    if element.startswith("Face"):
        solid = obj.Proxy.read(obj)[1]
        if OpenPatch(face_facets(owner, element, frame)).contains(solid).any():
            return element
    is_base = obj.Base is not None and resolve_base(owner) == resolve_base(obj.Base)
    if not is_base and is_fillable(owner):
        return ""
    raise VolfrepError(
        f"'{element or owner.Label}' is no face of the part: pick faces of it, or another solid."
    )


def _toggle_thick(
    obj: App.DocumentObject, owner: App.DocumentObject, element: str, thickness: float
) -> None:
    """Give a face a skin of its own, another one, or, where it is the same, none."""
    from .openings import thick_faces

    before = thick_faces(obj)
    rows = [row for row in before if row[:2] != (owner, element)]
    if (owner, element, thickness) not in before:
        rows.append((owner, element, thickness))
    groups: dict[App.DocumentObject, list[tuple[str, float]]] = {}
    for one, face, number in rows:
        groups.setdefault(one, []).append((face, number))
    obj.SkinFaces = [(one, tuple(face for face, _ in faces)) for one, faces in groups.items()]
    obj.SkinThicknesses = [number for faces in groups.values() for _, number in faces]


def _toggled(links: list[Any], owner: App.DocumentObject, element: str) -> list[Any]:
    """Links to elements with this one beside, or without it."""
    faces = {other: list(names) for other, names in links}
    names = faces.setdefault(owner, [])
    if element in names:
        names.remove(element)
    else:
        names.append(element)
    return [(other, tuple(names)) for other, names in faces.items() if names]

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Load cases made in the document: analyses of the FEM workbench, with what holds and loads faces.

They are FreeCAD's own objects, so that its FEM workbench draws, edits and solves them too.
"""

from __future__ import annotations

from typing import Any

import FreeCAD as App

from freecad_volfrep.bridge.fem_loads import TEMPERATURE, constraints_of, kind_of
from freecad_volfrep.bridge.picked import faces_alike
from freecad_volfrep.compat import (
    celsius,
    in_unit,
    set_celsius,
    set_in_unit,
    set_watts,
    watts,
)
from freecad_volfrep.translation import QT_TRANSLATE_NOOP, figure, translate

HELD, FORCE, PRESSURE, WEIGHT, WARM, FLOW = (
    QT_TRANSLATE_NOOP("VolfrepLoads", "Held"),
    QT_TRANSLATE_NOOP("VolfrepLoads", "Force"),
    QT_TRANSLATE_NOOP("VolfrepLoads", "Pressure"),
    QT_TRANSLATE_NOOP("VolfrepLoads", "Weight"),
    QT_TRANSLATE_NOOP("VolfrepLoads", "Temperature"),
    QT_TRANSLATE_NOOP("VolfrepLoads", "Heat flow"),
)
#: What can be made, as `kind_of` knows it, and the function of FreeCAD's `ObjectsFem` for it.
KINDS = {
    HELD: ("Fem::ConstraintFixed", "makeConstraintFixed"),
    FORCE: ("Fem::ConstraintForce", "makeConstraintForce"),
    PRESSURE: ("Fem::ConstraintPressure", "makeConstraintPressure"),
    WEIGHT: ("Fem::ConstraintSelfWeight", "makeConstraintSelfWeight"),
    WARM: (TEMPERATURE, "makeConstraintTemperature"),
    FLOW: (TEMPERATURE, "makeConstraintTemperature"),
}
#: What FreeCAD calls the two that are of one kind there.
TYPES = {WARM: "Temperature", FLOW: "CFlux"}
#: Property, unit and first value of those that have a size.
SIZES = {
    FORCE: ("Force", "N", 100.0),
    PRESSURE: ("Pressure", "MPa", 1.0),
    WARM: ("Temperature", "\u00b0C", 20.0),
    FLOW: ("CFlux", "W", 1.0),
}
#: Those that FreeCAD keeps in other units.
_SET = {WARM: set_celsius, FLOW: set_watts}
_READ = {WARM: celsius, FLOW: watts}
#: Directions of a force by name; the first two are those of its faces.
INTO, OUT_OF = (
    QT_TRANSLATE_NOOP("VolfrepLoads", "into the face"),
    QT_TRANSLATE_NOOP("VolfrepLoads", "out of the face"),
)
AXES = {
    "-Z": (0.0, 0.0, -1.0),
    "+Z": (0.0, 0.0, 1.0),
    "-X": (-1.0, 0.0, 0.0),
    "+X": (1.0, 0.0, 0.0),
    "-Y": (0.0, -1.0, 0.0),
    "+Y": (0.0, 1.0, 0.0),
}
DIRECTIONS = ("-Z", INTO, OUT_OF, "+Z", "-X", "+X", "-Y", "+Y")


def make_case(doc: App.Document, like: App.DocumentObject | None = None) -> App.DocumentObject:
    """An analysis without loads.

    Args:
        doc: the document.
        like: a case whose supports the new one has, too.
    """
    import ObjectsFem

    case = ObjectsFem.makeAnalysis(doc, "LoadCase")
    number = sum(1 for other in doc.Objects if other.TypeId == case.TypeId)
    case.Label = translate("VolfrepLoads", "Load case {number}").format(number=number)
    for one in constraints_of(like) if like is not None else ():
        if load_kind(one) == HELD:
            add_load(case, HELD).References = one.References
    return case


def load_kind(load: App.DocumentObject) -> str:
    """Which of `KINDS` it is, or an empty text for another constraint."""
    found = [kind for kind, (named, _) in KINDS.items() if named == kind_of(load)]
    return next((k for k in found if k not in TYPES or TYPES[k] == load.ConstraintType), "")


def add_load(case: App.DocumentObject, kind: str) -> App.DocumentObject:
    """A support or load of a kind, on no face yet; a force points down."""
    import ObjectsFem

    load = getattr(ObjectsFem, KINDS[kind][1])(case.Document, kind)
    case.addObject(load)
    if kind in TYPES:
        load.Label, load.ConstraintType = kind, TYPES[kind]
    if kind in SIZES:
        set_size(load, SIZES[kind][2])
    if kind == FORCE:
        set_direction(load, "-Z")
    return load


def remove_load(load: App.DocumentObject) -> None:
    """Take a support or load away, with what says its direction."""
    doc, line = load.Document, _own_line(load)
    doc.removeObject(load.Name)
    if line is not None:
        doc.removeObject(line.Name)


def toggle_face(
    load: App.DocumentObject, owner: App.DocumentObject, face: str, and_alike: bool = False
) -> None:
    """Put a face to those that a support or load acts on, or take it away from them.

    Args:
        load: the support or load.
        owner: of the face.
        face: its name.
        and_alike: all faces like this one, too.
    """
    faces = {one: list(names) for one, names in load.References}
    names = faces.setdefault(owner, [])
    is_there = face in names
    for one in faces_alike(owner, face) if and_alike else [face]:
        if is_there == (one in names):
            (names.remove if is_there else names.append)(one)
    load.References = [(one, tuple(names)) for one, names in faces.items() if names]
    if load_kind(load) == FORCE and load.References:
        set_direction(load, direction_of(load))  # which the face may say
    load.recompute()


def set_size(load: App.DocumentObject, size: float) -> None:
    """Give a force in N, a pressure in MPa, degrees C or W; a sign is the direction."""
    kind = load_kind(load)
    name, unit, _ = SIZES[kind]
    if kind in _SET:
        _SET[kind](load, name, size)
    else:
        set_in_unit(load, name, size, unit)
    load.recompute()


def size_of(load: App.DocumentObject) -> float | None:
    """A force in N, a pressure in MPa, degrees C, W; None for what has no size."""
    kind = load_kind(load)
    if kind not in SIZES:
        return None
    name, unit, _ = SIZES[kind]
    value = getattr(load, name)
    return _READ[kind](value) if kind in _READ else in_unit(value, unit)


def set_direction(load: App.DocumentObject, name: str) -> None:
    """Point a force along one of `DIRECTIONS`.

    FreeCAD takes a direction from an edge, so one that is not the faces' own has a hidden line.
    """
    line = _own_line(load)
    if name in AXES:
        if line is None:
            line = load.Document.addObject("Part::Line", "Direction")
            load.getParentGroup().addObject(line)
            line.Visibility = False
            line.X1 = line.Y1 = line.Z1 = 0.0
        line.X2, line.Y2, line.Z2 = AXES[name]
        line.recompute()
        load.Direction = (line, ["Edge1"])
        load.Reversed = False
        wanted = App.Vector(*AXES[name])
        load.recompute()
        if load.DirectionVector.dot(wanted) < 0.0:
            load.Reversed = True
    else:
        load.Direction = None
        if line is not None:
            load.Document.removeObject(line.Name)
        load.Reversed = False
        load.recompute()
        is_out = load.DirectionVector.dot(load.NormalDirection) > 0.0
        load.Reversed = is_out == (name == INTO)
    load.recompute()


def direction_of(load: App.DocumentObject) -> str:
    """Which of `DIRECTIONS` a force has; an empty text for another one."""
    if load.Direction is None:
        return INTO if load.DirectionVector.dot(load.NormalDirection) < 0.0 else OUT_OF
    way = load.DirectionVector
    return next((n for n, a in AXES.items() if way.dot(App.Vector(*a)) > 1.0 - 1e-9), "")


def said_load(load: App.DocumentObject) -> str:
    """A support or load as a row of a list: 'Force 100 N, -Z: Face3'."""
    kind = load_kind(load)
    text = translate("VolfrepLoads", kind) if kind else load.Label
    size = size_of(load)
    if size is not None:
        text = f"{text} {figure(size, 4)} {SIZES[kind][1]}"
    if kind == FORCE and direction_of(load):
        text = f"{text}, {translate('VolfrepLoads', direction_of(load))}"
    names = [name for _, names in getattr(load, "References", ()) or () for name in names]
    return f"{text}: {', '.join(names)}" if names else text


def _own_line(load: App.DocumentObject) -> Any:
    """The line that was made for a force's direction, or None."""
    link = getattr(load, "Direction", None)
    is_own = link is not None and link[0].TypeId == "Part::Line" and not link[0].Visibility
    return link[0] if is_own else None

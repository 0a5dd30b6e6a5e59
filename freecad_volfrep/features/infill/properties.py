# SPDX-License-Identifier: LGPL-2.1-or-later
"""The properties of a lattice infill: the inputs from the table of parameters, and the results."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import FreeCAD as App

from freecad_volfrep.features.properties.migration import migrate
from freecad_volfrep.features.properties.property_table import (
    HIDDEN,
    OUTPUT,
    READ_ONLY,
    Property,
    add_missing,
)
from freecad_volfrep.features.properties.quantities import FALLBACK, supported
from freecad_volfrep.translation import marked
from volfrep.design.cells import LIBRARY
from volfrep.design.parameters import BY_NAME, GROUPS, PARAMETERS, Parameter
from volfrep.design.parameters.table import (
    CUSTOM_CELL,
    NOTHING,
    OWN_MATERIAL,
    SOLIDS_MATERIAL,
    WALLS,
)
from volfrep.util.errors import VolfrepError

from .applicable import show_applicable

#: Raised with every change that an older file's objects must be brought up to.
SCHEMA_VERSION = 5

#: FreeCAD's types for the kinds of parameters.
TYPES = {
    "length": "App::PropertyLength",
    "density": "App::PropertyDensity",
    "mass": "App::PropertyMass",
    "stress": "App::PropertyPressure",
    "number": "App::PropertyFloat",
    "integer": "App::PropertyInteger",
    "flag": "App::PropertyBool",
    "choice": "App::PropertyEnumeration",
    "cell": "App::PropertyEnumeration",
    "material": "App::PropertyEnumeration",
    "process": "App::PropertyEnumeration",
    "text": "App::PropertyString",
    "formula": "App::PropertyString",
    "curve": "App::PropertyString",
    "file": "App::PropertyFile",
    "direction": "App::PropertyVector",
    "point": "App::PropertyVectorDistance",
    "points": "App::PropertyVectorList",
    "rotation": "App::PropertyPlacement",
    "link": "App::PropertyLinkGlobal",
    "lengths": "App::PropertyFloatList",
    "faces": "App::PropertyLinkSubListGlobal",
}


LATTICE, SKIN, GRADING, PRINT, RESULT, ADVANCED = marked(
    "App::Property", "1 Lattice", "2 Skin", "3 Grading", "4 Print", "5 Result", "6 Advanced"
)
#: Groups of the property editor, which sorts them by name, for those of the table of parameters.
EDITOR_GROUPS = {
    "Solid": LATTICE,
    "Lattice": LATTICE,
    "Walls": LATTICE,
    "Network": LATTICE,
    "Boundary": ADVANCED,
    "Openings": SKIN,
    "Cell size": GRADING,
    "Strut radius": GRADING,
    "Cell map": ADVANCED,
    "Orientation": ADVANCED,
    "Mesh": ADVANCED,
    "Material": PRINT,
}
#: Properties that are looked for elsewhere, and what is rarely set.
ELSEWHERE = {
    "ShellThickness": SKIN,
    "BuildDirection": PRINT,
    "Output": LATTICE,
    "AutoUpdate": LATTICE,
    **dict.fromkeys(
        (
            "CellValues", "Origin", "NetworkRelax", "NetworkDensity", "NetworkField",
            "NetworkOnWall", "NetworkShortest", "NetworkAngle", "KeepSolidAround", "KeepDistance",
            "KeepRadius", "RemoveBelow",
        ),
        ADVANCED,
    ),
}  # fmt: skip


def editor_group(parameter: Parameter) -> str:
    """The group of the property editor in which a parameter's property is."""
    return ELSEWHERE.get(parameter.property_name, EDITOR_GROUPS[parameter.group])


def _internal(type_name: str, name: str, description: str, default: Any) -> Property:
    return Property(type_name, name, "Internal", description, default, HIDDEN | OUTPUT)


def result(type_name: str, name: str, description: str) -> Property:
    """A property that only we write."""
    return Property(type_name, name, RESULT, description, flags=READ_ONLY | OUTPUT)


def _inputs() -> Iterator[Property]:
    """The properties that the table of parameters stands for, group by group."""
    for group in GROUPS:
        for parameter in PARAMETERS:
            if parameter.group != group or not parameter.in_freecad:
                continue
            if parameter.switch:
                switch = parameter.switch_name
                yield Property(
                    "App::PropertyBool", switch, editor_group(parameter), parameter.switch, False
                )
            if not parameter.position_of:
                yield Property(
                    TYPES[parameter.kind],
                    parameter.property_name,
                    editor_group(parameter),
                    parameter.help,
                    _first_value(parameter),
                )


def _first_value(parameter: Parameter) -> Any:
    value = parameter.initial if parameter.default is None else parameter.default
    if parameter.kind == "direction":
        return App.Vector(*value)
    return value.capitalize() if parameter.choices else value


PROPERTIES = (
    *_inputs(),
    Property(
        "App::PropertyBool",
        "SkinFollowsSizing",
        SKIN,
        "The skin has the thickness that Loads and Sizing has found, and nowhere less than "
        "ShellThickness",
        False,
    ),
    result("App::PropertyString", "Status", "Whether the mesh fits the properties, or why not"),
    result("App::PropertyString", "Expected", "What an update of these properties comes to"),
    result("App::PropertyStringList", "Warnings", "What to know about this result"),
    result("App::PropertyInteger", "CellsTotal", "Cells in the grid"),
    result("App::PropertyInteger", "CellsActive", "Cells that hold a lattice"),
    result("App::PropertyInteger", "Nodes", "Nodes of the lattice before trimming"),
    result("App::PropertyInteger", "Struts", "Struts of the lattice before trimming"),
    result("App::PropertyFloatList", "CellEdges", "Shortest and longest edge of a cell, mm"),
    result("App::PropertyFloatList", "StrutLengths", "Shortest and longest strut, mm"),
    result("App::PropertyFloatList", "StrutRadii", "Smallest and largest strut radius, mm"),
    result("App::PropertyInteger", "Triangles", "Triangles of the mesh"),
    result("App::PropertyInteger", "Bodies", "Separate pieces of material"),
    result("App::PropertyInteger", "Voids", "Closed voids, which would trap powder or resin"),
    result("App::PropertyVectorList", "DrainHoles", "Where holes go through the skin"),
    result("App::PropertyInteger", "Genus", "Through-holes of the mesh"),
    result("App::PropertyVolume", "Volume", "Volume of material"),
    result("App::PropertyFloat", "RelativeDensity", "Volume of the lattice over what it fills"),
    result("App::PropertyMass", "Mass", "Mass in g at the given density"),
    result(
        "App::PropertyInteger", "DanglingRemoved", "Struts with a free end that were taken away"
    ),
    result("App::PropertyInteger", "StubsRemoved", "Short struts with a free end, taken away"),
    result("App::PropertyInteger", "PiecesRemoved", "Loose fragments that were dropped"),
    result("App::PropertyBool", "Watertight", "Every edge is shared by exactly two triangles"),
    result("App::PropertyFloat", "Seconds", "Computing time of the last update"),
    result("App::PropertyString", "Report", "All figures of the last update, as JSON"),
    _internal("App::PropertyString", "Fingerprint", "Of all that the mesh was made from", ""),
    _internal("App::PropertyVectorList", "SizedNodes", "Of SizedRadii, as Base lies", []),
    _internal("App::PropertyFloatList", "SizedRadii", "That struts were sized to, mm", []),
    _internal("App::PropertyVectorList", "SizedSkinPoints", "Of SizedSkin, as Base lies", []),
    _internal("App::PropertyFloatList", "SizedSkin", "That the skin was sized to, mm", []),
    _internal("App::PropertyFloatList", "SizedStates", "What the sized struts carry", []),
    _internal("App::PropertyIntegerList", "SizedLimits", "What governs each sized strut", []),
    _internal("App::PropertyIntegerList", "SizedSkinLimits", "What governs SizedSkin", []),
    _internal("App::PropertyString", "SizedFor", "Of all that SizedStates are of", ""),
    _internal("App::PropertyString", "SizedLoads", "Of what the struts were sized for", ""),
    _internal("App::PropertyString", "SizingReport", "What was asked and found, as JSON", ""),
    _internal("App::PropertyFloat", "Conductivity", "Of the solid, W/(m K); 0: not known", 0.0),
    _internal("App::PropertyInteger", "SchemaVersion", "Of this table", SCHEMA_VERSION),
)

#: `Status` where results were of a wrong type, until the next recompute.
SPOILED = "Results were of a wrong type, as another program leaves them: recompute for new ones"
#: What a user sets, by name.
INPUTS = tuple(prop.name for prop in PROPERTIES if not prop.flags)


def ensure_properties(obj: App.DocumentObject) -> None:
    """Give `obj` every property of the table that it lacks; safe to call again at any time.

    Results of a wrong type are ours, and made anew. What a user sets is left as it is, and so is
    the number of a later table: `refuse_spoiled` says so.
    """
    from volfrep.mechanics.materials import MATERIALS
    from volfrep.reports.processes import PROCESSES

    choices = {
        parameter.property_name: list(parameter.labels)
        for parameter in PARAMETERS
        if parameter.choices
    }
    choices[BY_NAME["cell"].property_name] = [*LIBRARY, *WALLS, CUSTOM_CELL]
    choices[BY_NAME["print_material"].property_name] = [
        NOTHING,
        *(material.name for material in MATERIALS.values()),
        OWN_MATERIAL,
        SOLIDS_MATERIAL,
    ]
    choices[BY_NAME["print_process"].property_name] = [NOTHING, *PROCESSES]
    add_missing(obj, PROPERTIES, choices)
    migrate(obj, PROPERTIES)
    spoiled = [name for name in wrong_types(obj) if name not in INPUTS]
    for name in spoiled:
        obj.removeProperty(name)
    add_missing(obj, PROPERTIES, choices)
    if spoiled:
        obj.Fingerprint, obj.Status = "", SPOILED  # their values are gone
    wrong = wrong_types(obj)
    for name, labels in choices.items():  # a cell may have been added since the file was saved
        is_known = name not in wrong and name not in out_of_range(obj)
        if is_known and obj.getEnumerationsOfProperty(name) != labels:
            chosen = {label.lower(): label for label in labels}.get(getattr(obj, name).lower())
            if chosen is not None:
                setattr(obj, name, labels)
                setattr(obj, name, chosen)
    obj.setEditorMode("Report", 2)  # pages of JSON: the commands and scripts read it
    if obj.SchemaVersion < SCHEMA_VERSION:
        obj.SchemaVersion = SCHEMA_VERSION
    if not wrong and not out_of_range(obj):
        show_applicable(obj)


def out_of_range(obj: App.DocumentObject) -> list[str]:
    """Choices that are at none of their values, as a file can say that was changed by hand."""
    present = set(obj.PropertiesList)
    return [
        prop.name
        for prop in PROPERTIES
        if prop.type == "App::PropertyEnumeration"
        and prop.name in present
        and obj.getTypeIdOfProperty(prop.name) == prop.type
        and getattr(obj, prop.name) not in (obj.getEnumerationsOfProperty(prop.name) or [])
    ]


def wrong_types(obj: App.DocumentObject) -> dict[str, Property]:
    """Properties that `obj` has under a name of the table, but of another type."""
    present = set(obj.PropertiesList)
    wanted = {
        prop.name: prop.type if supported(obj, prop.type) else FALLBACK for prop in PROPERTIES
    }
    return {
        prop.name: prop
        for prop in PROPERTIES
        if prop.name in present and obj.getTypeIdOfProperty(prop.name) != wanted[prop.name]
    }


def has_lost_results(obj: App.DocumentObject) -> bool:
    """Whether results were of a wrong type, and no recompute has come since."""
    return bool(obj.Status == SPOILED)


def is_spoiled(obj: App.DocumentObject) -> bool:
    """Whether properties are missing or of a wrong type."""
    return bool(wrong_types(obj)) or not {p.name for p in PROPERTIES} <= set(obj.PropertiesList)


def refuse_spoiled(obj: App.DocumentObject) -> None:
    """Refuse an object of which nobody can tell what it stands for.

    Raises:
        VolfrepError: it was made by a later version, or a property is of a wrong type.
    """
    for name, prop in wrong_types(obj).items():
        raise VolfrepError(
            f"The property {name} is of the type {obj.getTypeIdOfProperty(name)} instead of "
            f"{prop.type}, so that another program has changed it: remove it, and the next "
            "recompute adds it with its first value."
        )
    for name in out_of_range(obj):
        raise VolfrepError(
            f"The property {name} is at none of the values of its list, as after a change of the "
            "file by another program: choose one in the property editor, or, where FreeCAD refuses "
            "that, remove the property, and the next recompute adds it with its first value."
        )
    if obj.SchemaVersion > SCHEMA_VERSION:
        raise VolfrepError(
            f"This object was made by a later version of VOLFREP (its table of properties is "
            f"number {obj.SchemaVersion}, this one knows {SCHEMA_VERSION}): update VOLFREP to "
            "compute it, and until then its mesh stays as it is."
        )

# SPDX-License-Identifier: LGPL-2.1-or-later
"""The properties of a lattice infill, as one table for making new objects and migrating old."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import FreeCAD as App

from volfrep.util.errors import VolfrepError

from .applicable import CUSTOM_CELL, show_applicable
from .grading import CARTESIAN, CHOICES, OFF

#: Raised with every change that an older file's objects must be brought up to.
SCHEMA_VERSION = 3

# Flags of addProperty: Output says that a change does not ask for a recompute.
_READ_ONLY, _HIDDEN, _OUTPUT = 1, 4, 8


@dataclass(frozen=True)
class Property:
    """One property: FreeCAD's type, name, group, description, first value, and its flags."""

    type: str
    name: str
    group: str
    description: str
    default: Any = None
    flags: int = 0


def _grading(type_name: str, name: str, description: str, default: Any = None) -> Property:
    return Property(type_name, name, "Grading", description, default)


def result(type_name: str, name: str, description: str) -> Property:
    """A property that only we write."""
    return Property(type_name, name, "Result", description, flags=_READ_ONLY | _OUTPUT)


def _internal(type_name: str, name: str, description: str, default: Any) -> Property:
    return Property(type_name, name, "Internal", description, default, _HIDDEN | _OUTPUT)


PROPERTIES = (
    Property(
        "App::PropertyLinkGlobal",
        "Base",
        "Solid",
        "The solid to fill: a solid, a Body, a Part, a link to one of these, or a closed mesh",
    ),
    Property(
        "App::PropertyLength",
        "ShellThickness",
        "Solid",
        "Thickness of the closed skin; 0 for none: the lattice is cut at the outer surface",
        2.0,
    ),
    Property(
        "App::PropertyLinkSubListGlobal",
        "OpenFaces",
        "Solid",
        "Faces of the solid that have no skin: the cavity opens there, struts are cut flush",
    ),
    Property(
        "App::PropertyLength",
        "DrainDiameter",
        "Drain",
        "Diameter of the holes that let powder or resin out of the skin; 0 for none",
        0.0,
    ),
    Property("App::PropertyVectorList", "DrainPoints", "Drain", "Points where holes are drilled"),
    Property(
        "App::PropertyLinkSubListGlobal",
        "DrainFaces",
        "Drain",
        "Faces in the middle of which holes are drilled",
    ),
    Property(
        "App::PropertyInteger",
        "DrainCount",
        "Drain",
        "Holes for each void that is still closed, at its lowest places along BuildDirection",
        0,
    ),
    Property(
        "App::PropertyVector",
        "BuildDirection",
        "Drain",
        "From the build plate up",
        App.Vector(0, 0, 1),
    ),
    Property("App::PropertyEnumeration", "CellType", "Lattice", "The unit cell", "CVC"),
    Property(
        "App::PropertyFile",
        "CellFile",
        "Lattice",
        "The .json file of your own unit cell (nodes and struts), for the cell type Custom",
    ),
    Property(
        "App::PropertyLength", "CellSize", "Lattice", "L: edge length of the cubic cell", 10.0
    ),
    Property("App::PropertyLength", "StrutRadius", "Lattice", "r: radius of the struts", 1.0),
    Property(
        "App::PropertyLength",
        "JointFillet",
        "Lattice",
        "Radius of the round between struts where they meet; 0 for none",
        0.0,
    ),
    Property(
        "App::PropertyBool",
        "UseOrigin",
        "Lattice",
        "Put a corner of a cell at Origin; otherwise the cells start at the corner of the solid",
        False,
    ),
    Property(
        "App::PropertyVectorDistance",
        "Origin",
        "Lattice",
        "Where a cell has a corner, if UseOrigin is set",
    ),
    Property(
        "App::PropertyEnumeration",
        "Activation",
        "Lattice",
        "Which cells hold a lattice: those that touch the inside, whose centre lies inside, or "
        "that lie wholly inside",
        "touching",
    ),
    Property(
        "App::PropertyEnumeration",
        "Boundary",
        "Lattice",
        "trim: the lattice is cut at the wall; whole: cells stay whole, and a skin joins what "
        "reaches it",
        "trim",
    ),
    Property(
        "App::PropertyBool",
        "RemoveDangling",
        "Lattice",
        "Take away struts with a free end, again and again until there are none",
        False,
    ),
    Property(
        "App::PropertyLength",
        "ShortestStub",
        "Lattice",
        "Take away struts with a free end that are shorter than this; 0 for none",
        0.0,
    ),
    _grading(
        "App::PropertyEnumeration",
        "SizeGrading",
        "Cells that grow along a direction: the law of lambda (section 2.5 of the method)",
        OFF,
    ),
    _grading("App::PropertyFloat", "LambdaMin", "lambda at the near end, s = 0", 1.0),
    _grading("App::PropertyFloat", "LambdaMax", "lambda at the far end, s = 1", 2.0),
    _grading("App::PropertyString", "LambdaFormula", "lambda as a formula of s", "1 + s"),
    _grading("App::PropertyVector", "GradingDirection", "Cells grow along it", App.Vector(1, 0, 0)),
    _grading(
        "App::PropertyBool",
        "KeepRadius",
        "Where cells are stretched or bent, struts stay straight and round; otherwise they are "
        "deformed with their cells, as published",
        True,
    ),
    _grading(
        "App::PropertyEnumeration",
        "RadiusGrading",
        "Struts whose radius varies: along a direction, by the depth below the skin (s = 1 at the "
        "Skin, or at the Core), or by a field of values",
        OFF,
    ),
    _grading("App::PropertyEnumeration", "RadiusLaw", "Law of the radius over s", "Linear"),
    _grading(
        "App::PropertyLength",
        "RadiusMin",
        "Radius where s = 0 or the field is smallest; 0 for StrutRadius",
        0.0,
    ),
    _grading(
        "App::PropertyLength",
        "RadiusMax",
        "Radius where s = 1 or the field is largest; 0 for StrutRadius",
        0.0,
    ),
    _grading(
        "App::PropertyString", "RadiusFormula", "Radius in mm as a formula of s", "0.8 + 0.4 * s"
    ),
    _grading(
        "App::PropertyVector", "RadiusDirection", "The radius varies along it", App.Vector(1, 0, 0)
    ),
    _grading("App::PropertyLength", "RadiusReach", "Depth at which the law ends", 5.0),
    _grading(
        "App::PropertyFile", "RadiusField", "File of points and values: .csv, .txt, .vtu, .vtk"
    ),
    _grading(
        "App::PropertyLinkGlobal", "RadiusResult", "Result of a FEM solver, instead of a file"
    ),
    _grading(
        "App::PropertyString",
        "RadiusColumn",
        "Which values of the file or the FEM result; empty for the only ones, or for vonMises",
        "",
    ),
    _grading(
        "App::PropertyString",
        "RadiusCurve",
        "Values and their radii in mm, such as '0:0.5, 120:1.2', in place of RadiusMin, RadiusMax",
        "",
    ),
    _grading(
        "App::PropertyEnumeration",
        "CellMap",
        "Cells along straight axes, about an axis, or about a centre",
        CARTESIAN,
    ),
    _grading(
        "App::PropertyBool",
        "UseMapCentre",
        "Put the axis through MapCentre; otherwise through the middle of the solid's box",
        False,
    ),
    _grading(
        "App::PropertyVectorDistance", "MapCentre", "A point of the axis, if UseMapCentre is set"
    ),
    _grading(
        "App::PropertyVector", "MapAxis", "Axis that the cells lie about", App.Vector(0, 0, 1)
    ),
    _grading(
        "App::PropertyInteger",
        "MapAround",
        "Cells around the full turn; 0 for as many as make them CellSize wide half-way out",
        0,
    ),
    _grading("App::PropertyAngle", "RotationAngle", "Turns the lattice, not the solid", 0.0),
    _grading("App::PropertyVector", "RotationAxis", "Axis of the rotation", App.Vector(0, 0, 1)),
    _grading(
        "App::PropertyBool",
        "UseRotationOrigin",
        "Turn about RotationOrigin; otherwise about the middle of the solid's box",
        False,
    ),
    _grading(
        "App::PropertyVectorDistance",
        "RotationOrigin",
        "A point of the rotation's axis, if UseRotationOrigin is set",
    ),
    Property(
        "App::PropertyInteger",
        "Resolution",
        "Mesh",
        "Facets along the edge of a cell; 0 to choose it by Deviation",
        0,
    ),
    Property(
        "App::PropertyLength",
        "Deviation",
        "Mesh",
        "Largest distance between a facet and the exact strut; 0 for a thirty-fifth of the radius",
        0.0,
    ),
    Property(
        "App::PropertyEnumeration",
        "Output",
        "Mesh",
        "part: skin and lattice; lattice: without the skin; domain: what the lattice fills",
        "part",
    ),
    Property(
        "App::PropertyBool",
        "AutoUpdate",
        "Mesh",
        "Compute at every change; switch it off for large jobs and use Update Lattice Infill",
        True,
    ),
    Property("App::PropertyFloat", "Density", "Material", "Density of the material in g/cm3", 1.0),
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
    result("App::PropertyFloat", "Mass", "Mass in g at the given density"),
    result(
        "App::PropertyInteger", "DanglingRemoved", "Struts with a free end that were taken away"
    ),
    result("App::PropertyInteger", "StubsRemoved", "Short struts with a free end, taken away"),
    result("App::PropertyInteger", "PiecesRemoved", "Loose fragments that were dropped"),
    result("App::PropertyBool", "Watertight", "Every edge is shared by exactly two triangles"),
    result("App::PropertyFloat", "Seconds", "Computing time of the last update"),
    result("App::PropertyString", "Report", "All figures of the last update, as JSON"),
    _internal("App::PropertyString", "Fingerprint", "Of all that the mesh was made from", ""),
    _internal("App::PropertyInteger", "SchemaVersion", "Of this table", SCHEMA_VERSION),
)

#: What a user sets, by name.
INPUTS = tuple(prop.name for prop in PROPERTIES if not prop.flags)


def ensure_properties(obj: App.DocumentObject) -> None:
    """Give `obj` every property of the table that it lacks; safe to call again at any time.

    Results of a wrong type are ours, and made anew. What a user sets is left as it is, and so is
    the number of a later table: `refuse_spoiled` says so.
    """
    from volfrep.design.cells import LIBRARY
    from volfrep.design.spec import ACTIVATIONS, BOUNDARIES, OUTPUTS

    choices = {
        "CellType": [*LIBRARY, CUSTOM_CELL],
        "Activation": list(ACTIVATIONS),
        "Boundary": list(BOUNDARIES),
        "Output": list(OUTPUTS),
        **CHOICES,
    }
    for name in wrong_types(obj):
        if name not in INPUTS:
            obj.removeProperty(name)
    add_missing(obj, PROPERTIES, choices)
    wrong = wrong_types(obj)
    for name, values in choices.items():  # a cell may have been added since the file was saved
        if name in wrong:
            continue
        chosen = getattr(obj, name)
        if obj.getEnumerationsOfProperty(name) != values and chosen in values:
            setattr(obj, name, values)
            setattr(obj, name, chosen)
    if obj.SchemaVersion < SCHEMA_VERSION:
        obj.SchemaVersion = SCHEMA_VERSION
    if not wrong:
        show_applicable(obj)


def wrong_types(obj: App.DocumentObject) -> dict[str, Property]:
    """Properties that `obj` has under a name of the table, but of another type."""
    present = set(obj.PropertiesList)
    return {
        prop.name: prop
        for prop in PROPERTIES
        if prop.name in present and obj.getTypeIdOfProperty(prop.name) != prop.type
    }


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
    if obj.SchemaVersion > SCHEMA_VERSION:
        raise VolfrepError(
            f"This object was made by a later version of VOLFREP (its table of properties is "
            f"number {obj.SchemaVersion}, this one knows {SCHEMA_VERSION}): update VOLFREP to "
            "compute it, and until then its mesh stays as it is."
        )


def add_missing(
    obj: App.DocumentObject, table: tuple[Property, ...], choices: dict[str, list[str]]
) -> None:
    """Add the properties of a table that `obj` lacks; `choices` are those of its enumerations."""
    for prop in table:
        if prop.name in obj.PropertiesList:
            continue
        obj.addProperty(prop.type, prop.name, prop.group, prop.description, prop.flags)
        if prop.name in choices:
            setattr(obj, prop.name, choices[prop.name])
        if prop.default is not None:
            setattr(obj, prop.name, prop.default)

# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a parameter is: a row of the table, its kind and unit, and when it has an effect.

What a parameter needs is data (`Need`): one function decides what has no effect, which the command
refuses and a document hides. A parameter without effect counts with its default for others.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from ..tpms.library import surface_name

#: Groups of parameters in the order of every list, and what the command's help calls them.
GROUPS = {
    "Solid": "the solid",
    "Lattice": "the lattice and its skin",
    "Walls": "walls in place of struts",
    "Network": "a network in place of cells",
    "Boundary": "where the lattice ends",
    "Openings": "what is open in the skin",
    "Cell size": "cells that grow along a direction",
    "Strut radius": "struts whose radius varies",
    "Cell map": "cells about an axis or a centre",
    "Orientation": "turned cells",
    "Mesh": "the mesh",
    "Material": "the material",
}

#: The unit of a kind of parameter, where it has one.
UNITS = {"length": "mm", "angle": "degrees", "density": "g/cm3", "point": "mm", "points": "mm",
         "mass": "g", "stress": "MPa", "lengths": "mm"}  # fmt: skip
#: How a value of a kind is written in a command, where its unit does not say it.
SHAPES = {
    "number": "NUMBER", "integer": "N", "text": "TEXT", "formula": "FORMULA", "file": "FILE",
    "cell": "CELL", "direction": "X,Y,Z", "point": "X,Y,Z", "rotation": "X,Y,Z,DEGREES",
    "planes": "X,Y,Z,NX,NY,NZ", "places": "X,Y,Z[,NX,NY,NZ]", "curve": "V:MM,V:MM,...",
    "length": "MM", "angle": "DEGREES", "density": "G_PER_CM3",
    "mass": "G", "stiffness": "E:DIRECTION", "thick_faces": "X,Y,Z[,NX,NY,NZ],MM",
    "solids": "FILE_OR_X,Y,Z[,NX,NY,NZ],MM",
}  # fmt: skip
#: Kinds that may be given several times; their value is a tuple.
REPEATED = ("planes", "places", "thick_faces", "solids")


@dataclass(frozen=True)
class Need:
    """Something that a parameter needs to have an effect.

    Attributes:
        names: parameters of which one is enough.
        values: what that one must be; empty for anything but its default.
        absent: the reverse: all of them must be at their defaults.
    """

    names: tuple[str, ...]
    values: tuple[Any, ...] = ()
    absent: bool = False


@dataclass(frozen=True)
class Parameter:
    """A row of the table.

    Attributes:
        name: in a specification's file; the option is the same with hyphens.
        kind: ``length``, ``angle``, ``density``, ``mass``, ``stiffness``, ``number``,
            ``integer``, ``flag``, ``choice``,
            ``text``, ``formula``, ``file``, ``cell``, ``curve``, ``direction``, ``point``,
            ``rotation`` (axis and degrees), ``planes``, ``places`` or ``thick_faces`` (lists of
            numbers), ``solids`` (files or such lists); of a document only: ``link``, ``faces``,
            ``lengths``, ``points``, ``stress``, ``material``, ``process``.
        group: one of `GROUPS`.
        help: one phrase; the same for the option, the property and the documentation.
        default: what holds where nothing is given; None where `otherwise` says what does.
        otherwise: what a default of None stands for, in words.
        choices: the words of a choice.
        needs: without which it has no effect; all of them.
        instead_of: parameters of a file that this one, given as an option, takes the place of.
        required: must be given where it has an effect.
        initial: what a new document object starts with, where `default` is None.
        freecad_name: of its property; empty for the parameter's in capitals.
        position_of: the rotation in whose placement, in FreeCAD, this point is the position.
        switch: of a point whose default is None: what a second property, ``Use`` and its name,
            chooses between.
        field: where a `LatticeSpec` holds it: one of its fields, or of a part's, as
            ``cell_map.axis``; empty where it takes more than to copy it
            (`volfrep.design.parameters.specification`).
        is_none: whether the field is None where the value is 0 or empty.
        in_command: whether it is an option of the command, and a key of a file.
        in_freecad: whether it is a property in FreeCAD.
        of_block: whether a free-standing block has it too.
        in_panel: whether the task panel shows it.
    """

    name: str
    kind: str
    group: str
    help: str
    default: Any = None
    otherwise: str = ""
    choices: tuple[str, ...] = ()
    needs: tuple[Need, ...] = ()
    instead_of: tuple[str, ...] = ()
    required: bool = False
    initial: Any = None
    freecad_name: str = ""
    position_of: str = ""
    switch: str = ""
    field: str = ""
    is_none: bool = False
    in_command: bool = True
    in_freecad: bool = True
    of_block: bool = True
    in_panel: bool = False

    @property
    def option(self) -> str:
        """The command's option; that of a flag, which is on anyway, switches it off."""
        flag = self.name.replace("_", "-")
        return f"--no-{flag}" if self.kind == "flag" and self.default else f"--{flag}"

    @property
    def property_name(self) -> str:
        """The property in FreeCAD."""
        return self.freecad_name or "".join(word.capitalize() for word in self.name.split("_"))

    @property
    def switch_name(self) -> str:
        """The property in FreeCAD that says whether the point counts."""
        return f"Use{self.property_name}"

    @property
    def labels(self) -> tuple[str, ...]:
        """The choices as FreeCAD shows and stores them."""
        return tuple(word.capitalize() for word in self.choices)

    @property
    def unit(self) -> str:
        """Of its values; empty for none."""
        return UNITS.get(self.kind, "")

    @property
    def default_text(self) -> str:
        """The default as a person reads it; empty for none."""
        if self.default is None:
            return self.otherwise
        if self.kind == "flag":
            return "yes" if self.default else "no"
        if isinstance(self.default, tuple):
            return ",".join(f"{number:g}" for number in self.default)
        if isinstance(self.default, float):
            return f"{self.default:g}"
        return str(self.default)


def effective(
    table: tuple[Parameter, ...], values: Mapping[str, Any]
) -> tuple[dict[str, Any], dict[str, Need]]:
    """The values that count, and what is missing for the others.

    A parameter that has no effect counts with its default, for those that depend on it too.

    Args:
        table: in which a parameter comes after those that it needs.
        values: what is given, by name.

    Returns:
        Every parameter's value by name, and of those without effect the first need that is not
        met.
    """
    result: dict[str, Any] = {}
    idle: dict[str, Need] = {}
    defaults = {parameter.name: parameter.default for parameter in table}
    for parameter in table:
        for need in parameter.needs:
            is_set = [
                result[name] in need.values if need.values else result[name] != defaults[name]
                for name in need.names
            ]
            if any(is_set) == need.absent:
                idle[parameter.name] = need
                break
        given = parameter.default
        if parameter.name not in idle and values.get(parameter.name) is not None:
            given = values[parameter.name]
        if parameter.kind == "cell" and isinstance(given, str):
            given = surface_name(given) or given  # as the needs of others call it
        result[parameter.name] = given
    return result, idle

# SPDX-License-Identifier: LGPL-2.1-or-later
"""The options that the table of parameters stands for, and the specification they ask for.

The engine is imported where it is needed only, so that ``--help`` answers at once.
"""

from __future__ import annotations

import argparse
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from ..design.parameters import BY_NAME, GROUPS, PARAMETERS, Parameter
from ..design.parameters.parameter import REPEATED, SHAPES
from ..design.parameters.values import option_type
from ..util.errors import VolfrepError
from ..util.files import note_input

if TYPE_CHECKING:
    from ..design.spec import LatticeSpec

#: Where an option's value is kept, so that no other option has the same place.
_PLACE = "parameter_"


def add_parameters(
    parser: argparse.ArgumentParser, *, of_block: bool = False, also: tuple[str, ...] = ()
) -> None:
    """Add an option for each parameter, by groups; each is None where the user leaves it out.

    Args:
        parser: of a command.
        of_block: whether the command makes free-standing blocks.
        also: parameters that it has though blocks have not.
    """
    for group, title in GROUPS.items():
        rows = [p for p in PARAMETERS if p.group == group and p.in_command]
        rows = [p for p in rows if p.of_block or not of_block or p.name in also]
        if rows:
            into = parser.add_argument_group(title)
            for parameter in rows:
                _add(into, parameter)


@dataclass(frozen=True)
class Specified:
    """What the options and the file of a specification say.

    Attributes:
        spec: the specification.
        values: of parameters, as they were given.
        build_direction: which the print report wants too.
    """

    spec: LatticeSpec
    values: Mapping[str, Any]
    build_direction: tuple[float, float, float]

    @property
    def files(self) -> dict[str, str]:
        """The files that parameters name, by the names of these."""
        named = ("cell", "radius_field", "network_file", "network_field", "skin_field")
        return {name: self.values[name] for name in named if self.values.get(name) is not None}


def specified(options: argparse.Namespace, fixed: Mapping[str, object] | None = None) -> Specified:
    """The specification of the file and the options.

    Args:
        options: of the command.
        fixed: values of parameters that the command itself gives.

    Raises:
        VolfrepError: a value that makes no sense, or an option that would have no effect.
    """
    from ..design.parameters import specification as made
    from ..design.parameters.spec_file import read_values, with_paths

    given = {
        key.removeprefix(_PLACE): tuple(value) if isinstance(value, list) else value
        for key, value in vars(options).items()
        if key.startswith(_PLACE) and value is not None
    } | dict(fixed or {})
    values = given
    if options.spec is not None:
        file = read_values(options.spec)
        try:
            made.refuse_idle(file)
        except VolfrepError as error:
            raise VolfrepError(f"{options.spec}: {error}") from error
        values = made.merge_values(given, file)
    for name, value in values.items():
        with_paths(name, value, _note_file)
    spec = made.specification(values, option_named)
    spec.kind.refuse_idle_cell(given)
    direction = BY_NAME["build_direction"]
    return Specified(spec, values, values.get(direction.name, direction.default))


def _note_file(file: str) -> str:
    """A file that the specification names, which is read for it and not written over."""
    if isinstance(file, str):
        note_input(file, "file of the specification")
    return file


def values_to_keep(
    spec: LatticeSpec, build_direction: tuple[float, float, float]
) -> dict[str, Any]:
    """What is in force, as a file of a specification says it.

    Raises:
        VolfrepError: it holds what no file can say.
    """
    from ..design.parameters.specification import values_of

    values = values_of(spec)
    if build_direction != BY_NAME["build_direction"].default:
        values["build_direction"] = build_direction
    return values


def option_named(name: str) -> str:
    """The option of a parameter."""
    return BY_NAME[name].option


def _add(group: argparse._ArgumentGroup, parameter: Parameter) -> None:
    name, place = f"--{parameter.name.replace('_', '-')}", _PLACE + parameter.name
    default = parameter.default_text
    text = parameter.help + f" (default: {default})" * bool(default)
    text += " (to be given)" * parameter.required
    text = text.replace("%", "%%")
    if parameter.kind == "flag":
        group.add_argument(
            name, dest=place, action=argparse.BooleanOptionalAction, default=None, help=text
        )
        return
    metavar = SHAPES.get(parameter.kind, "")
    if parameter.choices:
        metavar = "|".join(parameter.choices)
    group.add_argument(
        name,
        dest=place,
        type=option_type(parameter),
        metavar=metavar,
        action="append" if parameter.kind in REPEATED else "store",
        help=text,
    )

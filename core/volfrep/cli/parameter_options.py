# SPDX-License-Identifier: LGPL-2.1-or-later
"""The options that the table of parameters stands for, and the specification they ask for.

The engine is imported where it is needed only, so that ``--help`` answers at once.
"""

from __future__ import annotations

import argparse
from collections.abc import Mapping
from typing import TYPE_CHECKING

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


def set_parameter(options: argparse.Namespace, name: str, value: object) -> None:
    """Give a parameter a value that no option gave it."""
    setattr(options, _PLACE + name, value)


def specification(options: argparse.Namespace) -> LatticeSpec:
    """The specification of the file and the options.

    Sets ``options.build_direction``, which the print report wants too, and, as they were given or
    None, ``options.density``, ``options.cell``, ``options.radius_field``,
    ``options.network_file`` and ``options.network_field``.

    Raises:
        VolfrepError: a value that makes no sense, or an option that would have no effect.
    """
    from ..design.parameters import specification as made
    from ..design.parameters.spec_file import read_values, with_paths

    given = {
        key.removeprefix(_PLACE): tuple(value) if isinstance(value, list) else value
        for key, value in vars(options).items()
        if key.startswith(_PLACE) and value is not None
    }
    values = given
    if options.spec is not None:
        file = read_values(options.spec)
        try:
            made.refuse_idle(file)
        except VolfrepError as error:
            raise VolfrepError(f"{options.spec}: {error}") from error
        values = made.merge_values(given, file)
    for name, value in values.items():
        with_paths(name, value, _noted)
    spec = made.specification(values, option_named)
    _refuse_idle_cell(given, spec)
    direction = BY_NAME["build_direction"]
    options.build_direction = values.get(direction.name, direction.default)
    options.density = values.get("density")
    options.cell, options.radius_field = values.get("cell"), values.get("radius_field")
    options.network_file = values.get("network_file")
    options.network_field = values.get("network_field")
    return spec


def _noted(file: str) -> str:
    """A file that the specification names, which is read for it and not written over."""
    if isinstance(file, str):
        note_input(file, "file of the specification")
    return file


def _refuse_idle_cell(given: Mapping[str, object], spec: LatticeSpec) -> None:
    """Refuse the option of a cell, or of its size, that the network has no use for.

    Files of specifications always hold both, and may keep them.
    """
    from ..design.graphs import GivenGraph, RandomGraph

    if isinstance(spec.network, GivenGraph):
        file = f"'{spec.network.source}'"
        if "cell" in given and not spec.network.cell:
            raise VolfrepError(
                f"--cell has no effect with {file}, which holds struts, and no hexahedra or "
                "quadrilaterals to lay cells into: leave it out."
            )
        counts = spec.network.thickness and not given.get("network_layers")
        if "cell_size" in given and not (counts or spec.resolution):
            raise VolfrepError(
                f"--cell-size has no effect with {file}, which says where every strut lies: leave "
                "it out."
            )
    if not isinstance(spec.network, RandomGraph):
        return
    if "cell" in given:
        raise VolfrepError(
            f"--cell has no effect with --network {spec.network.kind}: leave one of them out."
        )
    if "cell_size" in given and spec.network.points and not spec.resolution:
        raise VolfrepError(
            "--cell-size has no effect with --network-points: each says how many points there are; "
            "leave one of them out."
        )


def keep_specification(options: argparse.Namespace, spec: LatticeSpec) -> None:
    """Keep what is in force, where it is to be written: `write_kept` does so when all is done.

    Raises:
        VolfrepError: it holds what no file can say.
    """
    if options.write_spec is None:
        return
    from ..design.parameters.specification import values_of

    values = values_of(spec)
    if options.build_direction != BY_NAME["build_direction"].default:
        values["build_direction"] = options.build_direction
    options.kept_specification = values


def write_kept(options: argparse.Namespace) -> None:
    """Write the specification of a command that has ended well."""
    values = getattr(options, "kept_specification", None)
    if values is not None:
        from ..design.parameters.spec_file import write_values

        write_values(values, options.write_spec)


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

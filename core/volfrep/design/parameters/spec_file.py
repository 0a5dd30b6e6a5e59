# SPDX-License-Identifier: LGPL-2.1-or-later
"""Whole specifications as TOML files: an entry for each parameter of the table, by its name."""

from __future__ import annotations

import difflib
import json
import os
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from ...util.arguments import check_kind, check_path
from ...util.deprecation import PARAMETERS as PARAMETERS_RENAMED
from ...util.deprecation import current_name
from ...util.errors import VolfrepError
from ...util.files import check_writable, replacing
from ...util.reading import read_toml
from ..spec import LatticeSpec
from .parameter import GROUPS
from .recipes import recipe_or_file
from .specification import specification, values_of
from .table import BY_NAME, PARAMETERS
from .values import value_from_json, value_to_json

#: Keys of a file, in the table's order.
KEYS = tuple(parameter.name for parameter in PARAMETERS if parameter.in_command)
#: Of the files: a later one, which this version cannot read, is named in them as `schema = 2`.
SCHEMA = 1
_HEAD = "# A lattice for VOLFREP. Lengths are in mm, angles in degrees, the density in g/cm3."


def read_spec(path: str | os.PathLike[str]) -> LatticeSpec:
    """The specification of a file, or of a recipe by its name (`recipes.RECIPES`).

    Raises:
        VolfrepError: the file cannot be read, or its specification makes no sense.

    >>> read_spec("cushion").shell
    0.0
    """
    check_path("path", path)
    values = read_values(path)
    try:
        return specification(values)
    except VolfrepError as error:
        raise VolfrepError(f"{Path(path)}: {error}") from error


def write_spec(spec: LatticeSpec, path: str | os.PathLike[str]) -> None:
    """Write a file that `read_spec` reads the same specification of.

    Raises:
        VolfrepError: the file cannot be written, or the specification holds what no file can say.

    >>> import tempfile
    >>> spec = LatticeSpec(cell="Octet", cell_size=8, strut_radius=0.6, shell=1.5)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Path(folder) / "lattice.toml"
    ...     write_spec(spec, file)
    ...     print("cell_size = 8.0" in file.read_text(), read_spec(file) == spec)
    True True
    """
    check_kind("spec", spec, LatticeSpec, "a LatticeSpec")
    check_path("path", path)
    write_values(values_of(spec), path)


def read_values(path: str | os.PathLike[str]) -> dict[str, Any]:
    """The values of a file by name, each of its kind; paths as seen from the present folder.

    Args:
        path: of the file, or the name of a recipe.

    Raises:
        VolfrepError: the file cannot be read, or the first entry that makes no sense.
    """
    path = recipe_or_file(path)
    entries = parse_spec(path)
    schema = entries.pop("schema", 1)
    if schema != SCHEMA:
        raise VolfrepError(
            f"{path} has the schema {schema}, and this version of VOLFREP reads {SCHEMA}: "
            "update it."
        )
    named = {current_name(name, PARAMETERS_RENAMED): value for name, value in entries.items()}
    return {name: _value(path, name, value) for name, value in named.items()}


def write_values(values: Mapping[str, Any], path: str | os.PathLike[str]) -> None:
    """Write a file that `read_values` reads the same values of.

    Raises:
        VolfrepError: the file cannot be written.
    """
    target = check_writable(path)
    with replacing(target) as file:
        file.write(_spec_text(values, target.parent).encode())


def _spec_text(values: Mapping[str, Any], folder: Path) -> str:
    """The text of a file in a folder for these values."""
    lines = [_HEAD]
    for group in GROUPS:
        rows = [p for p in PARAMETERS if p.group == group and p.name in values]
        if rows:
            lines += ["", f"# {GROUPS[group].capitalize()}"]
        for parameter in rows:
            value = value_to_json(parameter, values[parameter.name])
            value = with_paths(parameter.name, value, lambda file: _relative_path(folder, file))
            lines.append(f"{parameter.name} = {_toml(value)}")
    return "\n".join([*lines, ""])


def parse_spec(path: Path, what: str = "specification") -> dict[str, Any]:
    """What a TOML file holds, which should be so called.

    Raises:
        VolfrepError: it cannot be read, or is no TOML.
    """
    return read_toml(path, what)


def _value(path: Path, name: str, value: Any) -> Any:
    if name not in KEYS:
        raise VolfrepError(
            f"{path} has an unknown entry '{name}': the nearest is '{nearest_key(name)}'."
        )
    try:
        result = value_from_json(BY_NAME[name], value)
    except VolfrepError as error:
        raise VolfrepError(f"{path}, {name}: {error}") from error
    return with_paths(name, result, lambda file: os.path.join(path.parent, file))


def nearest_key(name: str) -> str:
    """The key that is written most like a name."""
    return difflib.get_close_matches(name, KEYS, 1, 0.0)[0]


def with_paths(name: str, value: Any, change: Callable[[str], str]) -> Any:
    """A value of a parameter with the files that it names changed."""
    if name == "keep_solid":
        return type(value)(change(one) if isinstance(one, str) else one for one in value)
    return change(value) if is_path(name, value) else value


def is_path(name: str, value: Any) -> bool:
    """Whether a value of a parameter names a file."""
    files = ("radius_field", "network_file", "network_field", "skin_field")
    return name in files or (name == "cell" and str(value).lower().endswith(".json"))


def _relative_path(folder: Path, path: str) -> str:
    """A path relative to a folder where it lies in it or below, absolute elsewhere."""
    absolute = Path(path).resolve()
    below = folder.resolve()
    return (absolute.relative_to(below) if absolute.is_relative_to(below) else absolute).as_posix()


def _toml(value: Any) -> str:
    """A value in TOML's notation; texts are written as in JSON, which TOML reads."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, list):
        return f"[{', '.join(_toml(item) for item in value)}]"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    return repr(value)

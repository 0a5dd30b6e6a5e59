# SPDX-License-Identifier: LGPL-2.1-or-later
"""The files that a command reads and writes: every one in a table, and none of them twice."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..util.errors import VolfrepError
from .run_options import INPUTS, OUTPUTS

if TYPE_CHECKING:
    from ..io.solid import Solid
    from ..mesh.triangle_mesh import TriangleMesh


def check_files(
    options: argparse.Namespace, named: Mapping[str, str] | None = None, *, folder: bool = False
) -> None:
    """Refuse, before any work, files that could not be written or that would replace an input.

    Args:
        options: of the command.
        named: files that parameters name, by the names of these.
        folder: whether the output is a folder, which its writer looks at.

    Raises:
        VolfrepError: naming the file, and what is wrong with it.
    """
    from ..util.files import check_writable, note_input, refuse_input, same_file

    given = vars(options) | dict(named or {})
    inputs, outputs = _given_files(given, INPUTS), _given_files(given, OUTPUTS)
    named_or_file = (
        ("cell file", (".json",)), ("material file", (".toml", ".json")),
        ("table of printed diameters", (".csv",)),
    )  # fmt: skip
    for called, suffixes in named_or_file:
        if not inputs.get(called, "").lower().endswith(suffixes):
            inputs.pop(called, None)  # a name, of the library or the table
    for called, path in inputs.items():
        note_input(path, called)
    for called, path in outputs.items():
        refuse_input(path)
        if not (folder and called == "output"):
            check_writable(path)
    names = list(outputs)
    for k, name in enumerate(names):
        for other in names[:k]:
            if same_file(outputs[name], outputs[other]):
                raise VolfrepError(
                    f"The {name} and the {other} cannot both be written to '{outputs[name]}': "
                    "give another name."
                )


def read_part(
    file: str,
    unit: str | None,
    cell_size: float,
    seen: Callable[[TriangleMesh], None] = lambda mesh: None,
) -> Solid:
    """The solid of a file, proved.

    Args:
        file: its path.
        unit: of its lengths; None for what it says.
        cell_size: L in mm; a part of a file without a unit must be of a size that goes with it.
        seen: as of `read_solid`.

    Raises:
        VolfrepError: it is no solid, or of another size by far.
    """
    from ..io.read.units import refuse_scale
    from ..io.solid import read_solid

    part = Path(file)
    solid = read_solid(part, unit, seen=seen)
    if not solid.states_unit:
        refuse_scale(solid.bounds, cell_size, part.name)
    return solid


def _given_files(options: Mapping[str, Any], table: dict[str, str]) -> dict[str, str]:
    """The files of the options that are there and were given, by what they are called."""
    given = ((called, options.get(name)) for name, called in table.items())
    return {called: str(Path(path)) for called, path in given if path is not None}

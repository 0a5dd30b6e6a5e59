# SPDX-License-Identifier: LGPL-2.1-or-later
"""The command ``volfrep properties``: what the lattice of a cell does.

numpy and the engine are imported inside the functions, as in `command`.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Callable
from typing import Any

from .files import check_files
from .run_options import add_run_options
from .telling import print_rows

_TEXT = "Tell density, stiffness, strength and conductance of a cell's lattice."


def add_command(add: Callable[[str, Callable[[argparse.Namespace], None], str], Any]) -> None:
    """Add the command with `cli`'s own function for that."""
    parser = add("properties", _properties, _TEXT)
    parser.add_argument(
        "cell",
        metavar="CELL",
        help="a library cell, a surface of walls such as Gyroid, or a cell's .json file",
    )
    add_run_options(parser, "properties")


def _properties(options: argparse.Namespace) -> None:
    from ..jobs.properties import lattice_properties
    from ..util.files import replacing

    check_files(options)
    found = lattice_properties(
        options.cell,
        options.cell_size,
        options.strut_radius,
        relative_density=options.relative_density,
        fillet=options.fillet,
        material=options.material,
        along=options.voxels,
        wall_kind=options.wall_kind,
        wall_thickness=options.wall_thickness,
        wall_offset=options.wall_offset,
        wall_formula=options.wall_formula,
    )
    if options.json is not None:
        with replacing(options.json) as file:
            file.write(json.dumps(found.as_dict(), indent=2).encode() + b"\n")
    print_rows(*found.rows())

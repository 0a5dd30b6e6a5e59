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
from .telling import print_rows

_TEXT = "Tell density, stiffness, strength and conductance of a cell's lattice."


def add_command(add: Callable[[str, Callable[[argparse.Namespace], None], str], Any]) -> None:
    """Add the command with `cli`'s own function for that."""
    parser = add("properties", _properties, _TEXT)
    option = parser.add_argument
    option("cell", metavar="CELL", help="a library cell, or a cell's .json file")
    option("--cell-size", type=float, required=True, metavar="MM", help="edge L of a cell")
    size = parser.add_mutually_exclusive_group(required=True)
    size.add_argument("--strut-radius", type=float, metavar="MM", help="radius r of the struts")
    size.add_argument(
        "--relative-density", type=float, metavar="D", help="from 0 to 1, in place of the radius"
    )
    option(
        "--fillet", type=float, default=0.0, metavar="MM", help="round at the joints (default 0)"
    )
    option(
        "--material",
        metavar="M",
        help="of the solid: a name of the table (see docs/cells.md), a .toml or .json file, or "
        "NAME,E,NU; without one, figures are in units of the solid's",
    )
    option("--voxels", type=int, metavar="N", help="along L (default: what the radius asks for)")
    option("--json", metavar="FILE", help="write the figures, and their errors, as JSON")


def _properties(options: argparse.Namespace) -> None:
    from ..mechanics.summary import cell_properties
    from ..util.files import replacing

    check_files(options)
    found = cell_properties(
        options.cell,
        options.cell_size,
        options.strut_radius,
        relative_density=options.relative_density,
        fillet=options.fillet,
        material=options.material,
        along=options.voxels,
    )
    if options.json is not None:
        with replacing(options.json) as file:
            file.write(json.dumps(found.as_dict(), indent=2).encode() + b"\n")
    print_rows(*found.rows())

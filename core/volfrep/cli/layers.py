# SPDX-License-Identifier: LGPL-2.1-or-later
"""The command ``volfrep slice``: a filled part in layers, for the printer, without a mesh.

numpy and the engine are imported inside the functions, as in `command`.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from typing import Any

from . import material
from .files import check_files, read_part
from .parameter_options import add_parameters, write_specification
from .telling import Progress, print_rows, print_warnings

_TEXT = "Write a filled part in layers along z, straight from its struts: no mesh is made."


def add_command(add: Callable[[str, Callable[[argparse.Namespace], None], str], Any]) -> Any:
    """Add the command with `cli`'s own function for that; returns its parser."""
    parser = add("slice", _slice, _TEXT)
    parser.set_defaults(process=None)
    option = parser.add_argument
    option("part", metavar="PART", help="the closed solid, as it stands on the build plate")
    option(
        "-o", "--output", required=True, metavar="FOLDER",
        help="to make; one that holds layers is replaced",
    )  # fmt: skip
    option("--layer", type=float, required=True, metavar="MM", help="height of a layer")
    option(
        "--pixel", type=float, metavar="MM",
        help="edge of a pixel of the pictures (default: the height of a layer)",
    )  # fmt: skip
    option(
        "--format", choices=("png", "svg", "cli"), default="png",
        help="a picture of one bit a pixel a layer, for resin printers (default); a drawing a "
        "layer; or one file of the common layer interface, for metal printers",
    )  # fmt: skip
    option(
        "--material", metavar="M",
        help="a name of the table in docs/cells.md, or a .toml or .json file: its density gives "
        "the mass",
    )  # fmt: skip
    option("--quiet", action="store_true", help="print nothing but errors")
    add_parameters(parser)
    return parser


def _slice(options: argparse.Namespace) -> None:
    spec = material.specified(options)
    check_files(options, folder=True)
    write_specification(options, spec)

    from ..jobs.slices import write_layers

    solid = read_part(options, spec.cell_size)
    with Progress(options.quiet) as progress:
        made = write_layers(
            solid, spec, options.output, layer=options.layer, pixel=options.pixel,
            form=options.format, progress=progress,
        )  # fmt: skip
    print_warnings(made.warnings)
    if not options.quiet:
        print_rows(("folder", options.output), *made.rows())

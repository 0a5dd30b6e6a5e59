# SPDX-License-Identifier: LGPL-2.1-or-later
"""The ``volfrep`` command.

Exit codes: 0 done, 2 bad input (one sentence on standard error), 3 done, but a limit that was asked
for is not held (the files are there), 130 interrupted.
numpy and the engine are imported inside the commands, so that ``--help`` answers at once.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
import traceback
from collections.abc import Callable, Sequence
from importlib import import_module

from ..util import memory_limit
from ..util.errors import VolfrepError
from ..util.files import keeping_inputs
from . import process
from .parser import Parser, Version, refuse_old, with_current_options

#: A command ends with what it returns; None is 0.
Command = Callable[[argparse.Namespace], "int | None"]
STATUS = (
    "The exit status is 0; 2 where the input is wrong, with one sentence that says why; 3 where a "
    "limit of 'size' is not held, with its file written all the same; 130 after Ctrl-C."
)
EXIT_DEFECT = 1
EXIT_BAD_INPUT = 2
#: The module of each command, and what it does. Modules have a function that adds what the command
#: takes, `add_` and its name, and are imported when it is asked for.
COMMANDS = {
    "fill": ("fill", "Fill a solid with a lattice under a closed skin."),
    "block": ("fill", "Make a free-standing block of whole cells with round struts."),
    "network": (
        "fill", "Mesh the nodes and struts of a file, or cells laid into its mesh.",
    ),
    "slice": (
        "slice",
        "Write a filled part in layers along z, straight from its struts: no mesh is made.",
    ),
    "infill": (
        "infill",
        "Write a part with bands of a slicer's own infill, denser where a field says, as a 3MF "
        "project.",
    ),
    "coupon": (
        "coupon",
        "Make specimens of a lattice to print and measure, numbered in relief, in a folder.",
    ),
    "cells": (
        "properties",
        "List the library of unit cells, or those of a catalogue's text; or take one out of it.",
    ),
    "properties": (
        "properties", "Tell density, stiffness, strength and conductance of a cell's lattice.",
    ),
    "crush": (
        "crush", "Crush a block of cells between plates: its plateau, and the energy it takes.",
    ),
    "find": (
        "find",
        "Tell which library cells, at which radius, have a modulus or a relative density; or "
        "both, the nearest first.",
    ),
    "size": (
        "size", "Fill a solid with a lattice whose struts are sized for its load cases.",
    ),
    "solve": (
        "solve",
        "Solve a solid under load cases by voxel finite elements: a filled part or any other.",
    ),
    "homogenise": (
        "homogenise",
        "Solve a filled part, of any number of cells, as a solid of its lattice's stiffness.",
    ),
    "orient": (
        "orient",
        "Find the best build directions of a solid: overhang, closed rooms, height, footprint.",
    ),
    "sweep": (
        "sweep", "Make many designs of a part, and a table, a page and the Pareto front of them.",
    ),
    "check": ("check", "Tell what a reader sees in a mesh file (STL, OBJ, PLY, 3MF)."),
    "report-bug": (
        "bug_report", "Print what a report of a fault needs: versions, and the job.",
    ),
}  # fmt: skip


def run(arguments: Sequence[str]) -> int:
    """Run a command and return its exit code; errors of the user become one sentence."""
    try:
        refuse_old(arguments)
        asked = next((word for word in arguments if not word.startswith("-")), "")
        options = make_parser(asked).parse_args(with_current_options(arguments))
        command: Command = options.command
        memory_limit.keep_within()
        with keeping_inputs():
            return command(options) or 0
    except VolfrepError as error:
        print(f"volfrep: {error}", file=sys.stderr)
        return EXIT_BAD_INPUT
    except KeyboardInterrupt:
        return process.say_interrupted()
    except Exception as error:  # whatever it is, the user gets a sentence
        if process.is_interrupted():
            return process.say_interrupted()
        if memory_limit.is_want_of_memory(error):
            print(f"volfrep: {memory_limit.not_enough()}", file=sys.stderr)
            return EXIT_BAD_INPUT
        print(
            f"volfrep: The engine failed with a {type(error).__name__} ({error}), which is a "
            f"defect of VOLFREP: please report it with the traceback in '{_logged()}'.",
            file=sys.stderr,
        )
        return EXIT_DEFECT


def _logged() -> str:
    """The traceback of the running exception as a new file; its path."""
    with tempfile.NamedTemporaryFile(
        "w", prefix="volfrep-", suffix=".log", delete=False, encoding="utf-8"
    ) as file:
        traceback.print_exc(file=file)
    return file.name


def make_parser(asked: str | None = None) -> argparse.ArgumentParser:
    """The parser of the command line.

    Args:
        asked: the command whose options it knows; None for those of all.
    """
    parser = Parser(
        prog="volfrep",
        description="Fill a solid with a strut lattice. Lengths are in mm.",
        epilog=STATUS,
        allow_abbrev=False,
    )
    parser.add_argument("--version", action=Version, nargs=0, help="show the version and exit")
    commands = parser.add_subparsers(title="commands", metavar="COMMAND", required=True)
    for name, (module, text) in COMMANDS.items():
        of_command = commands.add_parser(name, help=text, description=text, allow_abbrev=False)
        if asked in (None, name):
            add = getattr(import_module(f".{module}", __package__), f"add_{name.replace('-', '_')}")
            add(of_command)
    return parser

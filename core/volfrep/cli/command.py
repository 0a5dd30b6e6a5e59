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
from dataclasses import dataclass
from importlib import import_module

from ..util import memory_limit
from ..util.errors import VolfrepError
from ..util.files import keeping_inputs
from ..util.freed_memory import keep_freed_memory
from ..util.threads import one_for_matrices
from . import interrupts
from .parser import Parser, Version, refuse_old, with_current_options

#: A command ends with what it returns; None is 0.
Command = Callable[[argparse.Namespace], "int | None"]
STATUS = (
    "The exit status is 0; 2 where the input is wrong, with one sentence that says why; 3 where a "
    "limit of 'size' is not held, with its file written all the same; 130 after Ctrl-C."
)
EXIT_DEFECT = 1
EXIT_BAD_INPUT = 2


@dataclass(frozen=True)
class Row:
    """A command: what its ``--help`` begins with, and what it takes beside its options of a run.

    Attributes:
        module: has a function of the command's name after `run_`, and is imported when asked for.
        text: what it does.
        subject: its argument without hyphens: its place, how it is shown, and its help, or the
            parameter whose help it has.
        parameters: of which lattices it has parameters: "solid", "block", or none.
        also: parameters that it has though blocks have not.
        optional: whether the subject may be left out.
        has_small_matrices: whether threads of linear algebra would only wait for each other.
    """

    module: str
    text: str
    subject: tuple[str, str, str] | None = None
    parameters: str = ""
    also: tuple[str, ...] = ()
    optional: bool = False
    has_small_matrices: bool = False


_PART = ("part", "PART", "the closed solid, as for fill")
_ON_PLATE = ("part", "PART", "the closed solid, as it stands on the build plate")
COMMANDS = {
    "fill": Row(
        "fill", "Fill a solid with a lattice under a closed skin.",
        (
            "part", "PART",
            "the closed solid: STL, OBJ, PLY or 3MF, or with FreeCAD at hand STEP, IGES or BREP",
        ),
        "solid",
    ),
    "block": Row(
        "fill", "Make a free-standing block of whole cells with round struts.", None, "block",
    ),
    "network": Row(
        "fill", "Mesh the nodes and struts of a file, or cells laid into its mesh.",
        ("file", "FILE", "network_file"), "block",
        ("origin", "network_thickness", "network_layers", "network_reversed"),
    ),
    "slice": Row(
        "slice",
        "Write a filled part in layers along z, straight from its struts: no mesh is made.",
        _ON_PLATE, "solid",
    ),
    "infill": Row(
        "infill",
        "Write a part with bands of a slicer's own infill, denser where a field says, as a 3MF "
        "project.",
        _ON_PLATE,
    ),
    "coupon": Row(
        "coupon",
        "Make specimens of a lattice to print and measure, numbered in relief, in a folder.",
        None, "block",
    ),
    "cells": Row(
        "properties",
        "List the library of unit cells, or those of a catalogue's text; or take one out of it.",
        (
            "catalogue", "CATALOGUE",
            "a text of cells in the format of Lumpe and Stankovic; without it, the library",
        ),
        optional=True,
    ),
    "properties": Row(
        "properties", "Tell density, stiffness, strength and conductance of a cell's lattice.",
        ("cell", "CELL", "a library cell, a TPMS such as Gyroid, or a cell's .json file"),
    ),
    "crush": Row(
        "crush", "Crush a block of cells between plates: its plateau, and the energy it takes.",
        ("cell", "CELL", "a library cell, or a cell's .json file"),
    ),
    "find": Row(
        "find",
        "Tell which library cells, at which radius, have a modulus or a relative density; or "
        "both, the nearest first.",
    ),
    "size": Row(
        "size", "Fill a solid with a lattice whose struts are sized for its load cases.",
        _PART, "solid", has_small_matrices=True,
    ),
    "solve": Row(
        "solve",
        "Solve a solid under load cases by voxel finite elements: a filled part or any other.",
        _PART,
    ),
    "homogenise": Row(
        "homogenise",
        "Solve a filled part, of any number of cells, as a solid of its lattice's stiffness.",
        _PART, "solid", has_small_matrices=True,
    ),
    "orient": Row(
        "orient",
        "Find the best build directions of a solid: overhang, closed rooms, height, footprint.",
        _PART,
    ),
    "sweep": Row(
        "sweep", "Make many designs of a part, and a table, a page and the Pareto front of them.",
        ("study", "STUDY.toml", "parts, what varies, what is done: docs/studies.md"),
    ),
    "check": Row(
        "check", "Tell what a reader sees in a mesh file (STL, OBJ, PLY, 3MF).",
        ("file", "FILE", ""),
    ),
    "report-bug": Row(
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
        keep_freed_memory()
        if COMMANDS[asked].has_small_matrices:
            one_for_matrices()
        with keeping_inputs():
            return command(options) or 0
    except VolfrepError as error:
        print(f"volfrep: {error}", file=sys.stderr)
        return EXIT_BAD_INPUT
    except KeyboardInterrupt:
        return interrupts.say_interrupted()
    except Exception as error:  # whatever it is, the user gets a sentence
        if interrupts.is_interrupted():
            return interrupts.say_interrupted()
        if memory_limit.is_want_of_memory(error):
            print(f"volfrep: {memory_limit.not_enough()}", file=sys.stderr)
            return EXIT_BAD_INPUT
        print(
            f"volfrep: The engine failed with a {type(error).__name__} ({error}), which is a "
            f"defect of VOLFREP: please report it with the traceback in '{_log_traceback()}'.",
            file=sys.stderr,
        )
        return EXIT_DEFECT


def _log_traceback() -> str:
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
    for name, row in COMMANDS.items():
        of_command = commands.add_parser(
            name, help=row.text, description=row.text, allow_abbrev=False
        )
        if asked in (None, name):
            _add(of_command, name, row)
    return parser


def _add(parser: argparse.ArgumentParser, name: str, row: Row) -> None:
    """Add what a command takes."""
    from ..design.parameters import BY_NAME
    from .parameter_options import add_parameters
    from .run_options import add_run_options

    run_it = f"run_{name.replace('-', '_')}"
    parser.set_defaults(command=getattr(import_module(f".{row.module}", __package__), run_it))
    if row.subject is not None:
        place, shown, text = row.subject
        parser.add_argument(
            place, metavar=shown, nargs="?" if row.optional else None,
            help=BY_NAME[text].help if text in BY_NAME else text or None,
        )  # fmt: skip
    add_run_options(parser, name)
    if row.parameters:
        add_parameters(parser, of_block=row.parameters == "block", also=row.also)

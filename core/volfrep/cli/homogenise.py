# SPDX-License-Identifier: LGPL-2.1-or-later
"""The command ``volfrep homogenise``: a filled part as a solid of its lattice's stiffness.

numpy and the engine are imported inside the functions, as in `command`.
"""

from __future__ import annotations

import argparse

from ..util.progress_bar import drawn
from .files import check_files, read_part
from .parameter_options import add_parameters, specified
from .run_options import add_run_options
from .telling import print_rows, print_warnings


def add_homogenise(parser: argparse.ArgumentParser) -> None:
    """Add what the command takes."""
    parser.set_defaults(command=_homogenise)
    parser.add_argument("part", metavar="PART", help="the closed solid, as for fill")
    add_run_options(parser, "homogenise")
    add_parameters(parser)


def _homogenise(options: argparse.Namespace) -> None:
    from ..jobs.homogenised import check_homogenised_file, homogenise_part
    from ..loads.load_file import read_load_cases

    found = specified(options)
    check_files(options, found.files)
    if options.output is not None:
        check_homogenised_file(options.output)
    solid = read_part(options.part, options.unit, found.spec.cell_size)
    loads = read_load_cases(options.loads, solid)
    with drawn(options.quiet) as progress:
        made = homogenise_part(
            solid, found.spec, loads, element=options.element, frequencies=options.frequencies,
            load_factors=options.load_factors, progress=progress,
        )  # fmt: skip
    if options.output is not None:
        made.save(options.output)
    if options.report is not None:
        made.write_report(options.report)
    print_warnings(made.report["notes"])
    if not options.quiet:
        print_rows(*made.rows())

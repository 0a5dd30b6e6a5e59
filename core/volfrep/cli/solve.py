# SPDX-License-Identifier: LGPL-2.1-or-later
"""The command ``volfrep solve``: any solid under load cases, by voxels.

numpy and the engine are imported inside the functions, as in `command`.
"""

from __future__ import annotations

import argparse
import dataclasses
from collections.abc import Callable
from pathlib import Path

from ..util.progress_bar import drawn
from .files import check_files
from .telling import print_rows, print_warnings


def run_solve(options: argparse.Namespace) -> None:
    """Run ``volfrep solve``."""
    from ..io.solid import read_solid
    from ..jobs.solving import check_result_file, solve_solid
    from ..loads.load_file import read_load_cases
    from ..mechanics.materials import find_material

    check_files(options)
    if options.output is not None:
        check_result_file(options.output)
    material = None if options.material is None else find_material(options.material)
    solid = read_solid(Path(options.part), options.unit)
    loads = read_load_cases(options.loads, solid)
    if material is not None:
        loads = dataclasses.replace(loads, material=material)
    tell = tell_expected(options.quiet)
    with drawn(options.quiet) as progress:
        solved = solve_solid(solid, loads, voxel=options.voxel, progress=progress, tell=tell)
    if options.output is not None:
        solved.save(options.output)
    if options.report is not None:
        solved.write_report(options.report)
    print_warnings(solved.report["notes"])
    if not options.quiet:
        print_rows(*solved.rows())


def tell_expected(quiet: bool) -> Callable[[object], None]:
    """What tells on standard output how much work there is, unless it is to be quiet."""

    def tell(expected: object) -> None:
        if not quiet:
            print(f"Expected: {expected}.", flush=True)

    return tell

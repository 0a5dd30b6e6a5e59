# SPDX-License-Identifier: LGPL-2.1-or-later
"""The command ``volfrep homogenise``: a filled part as a solid of its lattice's stiffness.

numpy and the engine are imported inside the functions, as in `command`.
"""

from __future__ import annotations

import argparse
from pathlib import Path

from ..util.errors import VolfrepError
from ..util.progress_bar import drawn
from .files import check_files, read_part
from .parameter_options import specified
from .size import EXIT_NOT_HELD
from .telling import print_rows, print_warnings


def run_homogenise(options: argparse.Namespace) -> int | None:
    """Run ``volfrep homogenise``."""
    from ..design.parameters.spec_file import write_values
    from ..jobs.homogenised import check_homogenised_file, homogenise_part
    from ..jobs.result_files import values_with_radii, write_field
    from ..jobs.sized_field import (
        FIELD_GOALS,
        field_goal,
        homogenise_sized,
    )
    from ..loads.load_file import read_load_cases

    if options.write_spec is not None and options.radii is None:  # which the specification names
        options.radii = str(Path(options.write_spec).with_suffix(".radii.csv"))
    found = specified(options)
    check_files(options, found.files)
    if options.output is not None:
        check_homogenised_file(options.output)
    solid = read_part(options.part, options.unit, found.spec.cell_size)
    loads = read_load_cases(options.loads, solid)
    goal = field_goal(
        loads, {name: getattr(options, name) for name in FIELD_GOALS},
        lambda name: f"--{name.replace('_', '-')}", stiffest=options.stiffest,
    )  # fmt: skip
    if goal is None and options.radii is not None:
        raise VolfrepError(
            "--radii and --write-spec keep what was sized: give --stiffest, --safety or "
            "--max-displacement."
        )
    modes = {"frequencies": options.frequencies, "load_factors": options.load_factors}
    with drawn(options.quiet) as progress:
        if goal is None:
            made = homogenise_part(
                solid, found.spec, loads, element=options.element, progress=progress, **modes
            )
        else:
            made = homogenise_sized(
                solid, found.spec, loads, goal, most_steps=options.steps, element=options.element,
                progress=progress, **modes,
            )  # fmt: skip
    if options.output is not None:
        made.save(options.output)
    if options.report is not None:
        made.write_report(options.report)
    if options.radii is not None:
        write_field(made.spec, options.radii)
    if options.write_spec is not None:
        write_values(values_with_radii(made.spec, options.radii), options.write_spec)
    print_warnings(made.report["notes"])
    if not options.quiet:
        print_rows(*made.rows())
    return None if goal is None or made.report["field"]["holds"] else EXIT_NOT_HELD

# SPDX-License-Identifier: LGPL-2.1-or-later
"""The command ``volfrep orient``: which way a part is built best.

numpy and the engine are imported inside the functions, as in `command`.
"""

from __future__ import annotations

import argparse
from pathlib import Path

from ..util.errors import VolfrepError
from ..util.progress_bar import drawn
from .files import check_files
from .telling import print_rows


def run_orient(options: argparse.Namespace) -> None:
    """Run ``volfrep orient``."""
    from ..io.solid import read_solid
    from ..output.meshes import mesh_form, write_mesh
    from ..reports.orientation import inclination_of, orient
    from ..util.files import write_json

    check_files(options)
    if options.output is not None:
        mesh_form(options.output)
    if options.take < 1 or options.take > options.best:
        raise VolfrepError(
            f"--take is the number of one of the {options.best} best, not {options.take}."
        )
    inclination = inclination_of(options.process, options.inclination)
    solid = read_solid(Path(options.part), options.unit)
    with drawn(options.quiet) as progress:
        found = orient(solid, inclination, best=options.best, progress=progress)
    if options.output is not None:
        write_mesh(found.turned(min(options.take, len(found.best)) - 1), options.output)
    if options.report is not None:
        write_json(options.report, found.as_dict())
    if not options.quiet:
        print_rows(*found.rows())

# SPDX-License-Identifier: LGPL-2.1-or-later
"""The command ``volfrep crush``: the curve of a block of cells between plates.

numpy and the engine are imported inside the functions, as in `command`.
"""

from __future__ import annotations

import argparse

from ..util.progress_bar import drawn
from .files import check_files
from .telling import print_rows, print_warnings


def run_crush(given: argparse.Namespace) -> None:
    """Run ``volfrep crush``."""
    from ..jobs.crushing import crush
    from ..util.files import replacing, write_json

    check_files(given)
    with drawn(given.quiet) as progress:
        found = crush(
            given.cell, given.cell_size, given.strut_radius,
            relative_density=given.relative_density, material=given.material, count=given.cells,
            strain=given.strain, progress=progress,
        )  # fmt: skip
    if given.output is not None:
        with replacing(given.output) as file:
            file.write(found.table().encode())
    if given.json is not None:
        write_json(given.json, found.as_dict())
    print_warnings(found.notes)
    if not given.quiet:
        print_rows(*found.rows())

# SPDX-License-Identifier: LGPL-2.1-or-later
"""The command ``volfrep slice``: a filled part in layers, for the printer, without a mesh.

numpy and the engine are imported inside the functions, as in `command`.
"""

from __future__ import annotations

import argparse

from ..util.progress_bar import drawn
from .files import read_part
from .options import slice_options
from .telling import print_rows, print_warnings


def run_slice(given: argparse.Namespace) -> None:
    """Run ``volfrep slice``."""
    options = slice_options(given)

    from ..jobs.slices import write_layers

    solid = read_part(options.part, options.unit, options.spec.cell_size)
    with drawn(options.quiet) as progress:
        made = write_layers(
            solid, options.spec, options.output, layer=options.layer, pixel=options.pixel,
            form=options.form.word, progress=progress,
        )  # fmt: skip
    print_warnings(made.warnings)
    if not options.quiet:
        print_rows(("folder", options.output), *made.rows())
    if options.kept is not None:
        options.kept.write()

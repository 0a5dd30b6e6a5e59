# SPDX-License-Identifier: LGPL-2.1-or-later
"""The command ``volfrep infill``: a part for a slicer, whose infill is denser where a field says.

numpy and the engine are imported inside the functions, as in `command`.
"""

from __future__ import annotations

import argparse
from pathlib import Path

from ..util.errors import VolfrepError
from ..util.progress_bar import drawn
from .files import check_files
from .telling import print_rows

#: Options that are fields of `BandedInfill` by the same name.
_FIELDS = (
    "grading", "start", "end", "profile", "reach", "direction", "field", "column", "curve",
    "formula", "bands", "pattern", "walls", "top_layers", "bottom_layers", "line_width", "layer",
)  # fmt: skip


def run_infill(given: argparse.Namespace) -> None:
    """Run ``volfrep infill``."""
    from ..design.banded_infill import BandedInfill
    from ..design.spec import LatticeSpec
    from ..io.solid import read_solid
    from ..jobs.slicer_infill import cut_bands
    from ..mechanics.materials import find_material

    check_files(given)
    if Path(given.output).suffix.lower() != ".3mf":
        raise VolfrepError(f"A slicer's project is a .3mf file, and '{given.output}' is none.")
    density = LatticeSpec.density
    if given.material is not None:
        density = find_material(given.material).density
    values = {name: getattr(given, name) for name in _FIELDS}
    if given.sized is not None:
        from ..design.parameters.spec_file import read_spec
        from ..jobs.figures.sized_density import sized_densities

        values["field"], values["curve"] = sized_densities(read_spec(given.sized))
        values["grading"] = "field"
    wanted = BandedInfill(**values)
    solid = read_solid(given.part, given.unit)
    with drawn(given.quiet) as progress:
        made = cut_bands(solid, wanted, material_density=density, progress=progress)
        if not given.quiet:
            print_rows(*made.rows())
        made.save(given.output, given.slicer)
    if not given.quiet:
        size = Path(given.output).stat().st_size / 1e6
        print_rows(("file", f"{given.output}, {size:.2f} MB"))

# SPDX-License-Identifier: LGPL-2.1-or-later
"""The commands ``volfrep cells`` and ``volfrep properties``: which cells there are, what they do.

numpy and the engine are imported inside the functions, as in `command`.
"""

from __future__ import annotations

import argparse
import sys

from ..util.errors import VolfrepError
from .files import check_files
from .telling import print_rows

#: What takes longer is told before, s.
LONG = 10.0


def run_cells(options: argparse.Namespace) -> None:
    """Run ``volfrep cells``."""
    if options.catalogue is None:
        if options.entry is not None or options.output is not None:
            raise VolfrepError("--entry and --output are for a cell of a catalogue: name its file.")
        _print_library()
        return
    from ..design.cell_files.catalogue_text import catalogue_entry, catalogue_names
    from ..design.cells import make_cell
    from ..design.drawn_cell import save_cell

    check_files(options)
    if options.entry is None:
        if options.output is not None:
            raise VolfrepError("--output needs --entry: which cell of the catalogue?")
        print("\n".join(catalogue_names(options.catalogue)))
        return
    name, edges, nodes, struts = catalogue_entry(options.catalogue, options.entry)
    cell = make_cell(name, nodes, struts, f"cell '{name}' of the catalogue", edges=edges)
    rows = {"cell": name, "nodes": len(nodes), "struts": len(struts)}
    if options.output is not None:
        save_cell(cell, options.output)
        rows["written"] = options.output
    print_rows(*((key, str(value)) for key, value in rows.items()))


def _print_library() -> None:
    from ..design.cells import LIBRARY, USES
    from ..design.tpms import FORMULA, SURFACES
    from ..mechanics.endless import stretched_strains

    print(f"{'name':<25}{'nodes':>6}{'struts':>8}{'Maxwell':>9}  {'carries by':<13}also known as")
    use = None
    for cell in LIBRARY.values():
        if cell.use != use:
            use = cell.use
            print(f"\n{USES[use]}")
        carries = "stretching" if stretched_strains(cell) == 6 else "bending"
        row = (
            f"{cell.name:<25}{len(cell.nodes):>6}{len(cell.struts):>8}"
            f"{cell.maxwell_number:>9}  {carries:<13}{', '.join(cell.also)}"
        )
        print(row.rstrip())
        for one in cell.parameters:
            text = f"{one.name} = {one.usual:g} ({one.least:g} to {one.most:g})"
            print(f"    --cell-values {text}: {one.about}")
    print("\nWalls, along a surface")
    for surface in SURFACES.values():
        print(f"{surface.name:<25}{surface.about}")
    print(f"{FORMULA:<25}a formula of your own, of x, y and z")


def _tell_expected(seconds: float) -> None:
    """Tell how long it will take, where somebody would wonder."""
    if seconds > LONG:
        from ..util.numbers import duration

        print(f"Expected: about {duration(seconds)} more.", file=sys.stderr, flush=True)


def run_properties(options: argparse.Namespace) -> None:
    """Run ``volfrep properties``."""
    from ..jobs.figures.properties import lattice_properties
    from ..util.files import write_json

    check_files(options)
    found = lattice_properties(
        options.cell,
        options.cell_size,
        options.strut_radius,
        relative_density=options.relative_density,
        fillet=options.fillet,
        material=options.material,
        along=options.voxels,
        cell_values=options.cell_values or "",
        wall_kind=options.wall_kind,
        wall_thickness=options.wall_thickness,
        wall_offset=options.wall_offset,
        wall_formula=options.wall_formula,
        exact=True,
        told=_tell_expected,
        as_printed=options.as_printed,
        build_direction=options.build_direction,
        note=print,
    )
    if options.json is not None:
        write_json(options.json, found.as_dict())
    print_rows(*found.rows())

# SPDX-License-Identifier: LGPL-2.1-or-later
"""The command's options for the printer, and what it prints.

numpy and the engine are imported inside the functions, as in `command`.
"""

from __future__ import annotations

import argparse
import time
from pathlib import Path
from typing import TYPE_CHECKING

from ..util.errors import VolfrepError
from .solver_options import is_meshed
from .telling import print_rows, print_warnings

if TYPE_CHECKING:
    from ..design.spec import LatticeSpec
    from ..grid.strut_graph import BeamModel
    from ..mesh.triangle_mesh import TriangleMesh
    from ..reports.printability import PrintReport
    from ..reports.result import Result


def check(options: argparse.Namespace, out: Path) -> None:
    """Refuse options that do not go together, before any work.

    Raises:
        VolfrepError: naming them.
    """
    if options.picture is not None:
        from ..reports.picture import check_picture

        check_picture(options.picture)
        if not is_meshed(options):
            raise VolfrepError(
                "A picture is made of the mesh, which beams do without: leave it out."
            )
    if options.threemf == "beams" and (options.report or options.print_report):
        raise VolfrepError(
            "A report is made of the mesh, which --3mf beams does without: use both."
        )
    if options.print_report is not None:
        from ..reports.printability import unit_direction
        from ..reports.processes import find_process

        find_process(options.print_report)
        unit_direction(options.build_direction)


def report_of(
    result: Result,
    options: argparse.Namespace,
    spec: LatticeSpec,
    domain: TriangleMesh | None,
) -> PrintReport:
    """The print report that the options ask for."""
    from ..reports.passage import ball_of, walls_of
    from ..reports.printability import print_report
    from ..reports.processes import find_process

    return print_report(
        result.mesh,
        result.wireframe,
        find_process(options.print_report),
        build_direction=options.build_direction,
        density=result.report.spec["density"],
        domain=domain,
        ball_mm=ball_of(spec),
        walls_mm=walls_of(spec),
    )


def finish_beams(model: BeamModel, options: argparse.Namespace, start: float) -> None:
    """Write a lattice as beams; say what was made since `start` (of `time.perf_counter`)."""
    from ..io.write.threemf import BEAMS_ONLY, write_3mf_beams

    write_3mf_beams(model, options.output)
    print_warnings((*model.warnings, *model.loose, BEAMS_ONLY))
    if options.quiet:
        return
    lattice = model.lattice
    print_rows(
        ("file", f"{options.output}, {Path(options.output).stat().st_size / 1e6:.1f} MB"),
        ("struts", f"{len(lattice.struts):,} between {len(lattice.nodes):,} nodes, as beams"),
        ("time", f"{time.perf_counter() - start:.2f} s"),
    )

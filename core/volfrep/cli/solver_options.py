# SPDX-License-Identifier: LGPL-2.1-or-later
"""The command's files for CAD and for a solver: STEP in three forms, decks for CalculiX.

numpy and the engine are imported inside the functions, as in `command`.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from ..util.errors import VolfrepError
from .telling import print_rows, print_warnings

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ..design.spec import LatticeSpec
    from ..grid.strut_graph import Wireframe
    from ..jobs.infill import Infill
    from ..mechanics.materials import Material
    from ..reports.estimate import Estimate, ExportChoice
    from ..reports.result import Result
    from ..util.progress import ProgressCallback

    #: Writes a result's file and returns sentences for the user.
    Writer = Callable[[Result], tuple[str, ...]]

STEP_SUFFIXES = (".step", ".stp")
DECK_SUFFIX = ".inp"
PLANE_FACES = "The file holds plane faces instead of exact surfaces."


def is_deck(out: Path) -> bool:
    """Whether the file is one for CalculiX."""
    return out.suffix.lower() == DECK_SUFFIX


def check(options: argparse.Namespace, out: Path, spec: LatticeSpec) -> None:
    """Refuse options that do not go together, before any work; fill in the defaults.

    Raises:
        VolfrepError: naming them.
    """
    suffix = out.suffix.lower()
    if suffix in STEP_SUFFIXES and options.step is None:
        options.step = "faceted"
    if is_deck(out) and options.inp is None:
        options.inp = "beams"
    kind = options.step or options.inp
    asked = f"--step {kind}" if options.step else f"--inp {kind}"
    if kind in ("wireframe", "beams") and (options.report or options.print_report):
        raise VolfrepError(
            f"A report is made of the mesh, which {asked} does without: leave one of them out."
        )
    if kind not in (None, "faceted") and spec.output == "domain":
        raise VolfrepError(
            "The domain holds no lattice to write: make the part or the lattice, or choose --step "
            "faceted."
        )
    if kind in ("exact", "wireframe", "beams") and spec.fillet:
        raise VolfrepError(
            f"The form '{kind}' has no fillets between struts: set the fillet to 0, or choose "
            f"{'tetrahedra' if options.inp else 'faceted'}."
        )
    if kind == "exact":
        from ..io.freecad_process import freecad_program

        freecad_program()


def fill_axes(infill: Infill, options: argparse.Namespace, start: float) -> bool:
    """Write the forms that are made of the struts' axes in a solid; whether it was asked for one.

    `start` is when the job began, of `time.perf_counter`.
    """
    if not needs_axes(options):
        return False
    clipped = infill.axes
    print_warnings(clipped.warnings)
    write_axes(clipped.wireframe, clipped.on_wall, infill.spec, options, start)
    return True


def block_axes(spec: LatticeSpec, options: argparse.Namespace, start: float) -> bool:
    """As `fill_axes`, of a block of whole cells."""
    if not needs_axes(options):
        return False
    from ..jobs.blocks import block_wireframe

    write_axes(block_wireframe(spec, options.count), None, spec, options, start)
    return True


def settle_step(infill: Infill, options: argparse.Namespace) -> None:
    """Before a lattice is meshed: plane faces where its wall is too much for exact surfaces."""
    if options.step != "exact" or not infill.spec.is_cut:
        return
    from ..reports.estimate import refuse_wall

    walls = [infill.cavity, *([infill.solid] if infill.spec.with_skin else [])]
    try:
        refuse_wall(max(len(wall.triangles) for wall in walls))
    except VolfrepError as error:
        options.step = "faceted"
        print_warnings([f"{error} {PLANE_FACES}"])


def writer(
    options: argparse.Namespace,
    spec: LatticeSpec,
    infill: Infill | None,
    progress: ProgressCallback,
) -> Writer | None:
    """What writes the result as the options ask for; None where a mesh format does.

    Args:
        options: of the command.
        spec: what was made.
        infill: whose stages they were; None for a block.
        progress: asked for a cancel.
    """
    if options.step == "exact":
        return lambda result: _write_exact(result, options, spec, infill, progress)
    if options.step == "faceted":
        return lambda result: _write_faceted(result, options, spec)
    if options.inp == "tetrahedra":
        return lambda result: _write_tetrahedra(result, options, spec, infill, progress)
    return None


def needs_axes(options: argparse.Namespace) -> bool:
    """Whether a form is asked for that is made of the struts' axes, without a mesh."""
    deck = options.inp or ("beams" if is_deck(Path(options.output)) else None)
    return bool(options.step == "wireframe" or deck == "beams")


def is_meshed(options: argparse.Namespace) -> bool:
    """Whether a mesh is made at all, of which pictures and reports are."""
    return options.threemf != "beams" and not needs_axes(options)


def write_axes(
    frame: Wireframe,
    on_wall: NDArray[np.bool_] | None,
    spec: LatticeSpec,
    options: argparse.Namespace,
    start: float,
) -> None:
    """Write struts as lines or as beams, as the options ask for.

    Args:
        frame: the struts, mm.
        on_wall: (n,) nodes at which a wall cuts them; None where none does.
        spec: what was made.
        options: of the command.
        start: when the job began, of `time.perf_counter`.
    """
    from ..fem.beam_mesh import fitted_beams
    from ..fem.deck import write_beams
    from ..io.write.step_wireframe import write_step_wireframe
    from ..reports.estimate import estimate_axes, estimate_beams
    from ..trim.beam_model import deformed_struts

    warnings: tuple[str, ...] = ()
    if options.step == "wireframe":
        _announce(estimate_axes(len(frame.struts), _asked(spec, options)), options)
        write_step_wireframe(frame, options.output)
    else:
        model, warnings = fitted_beams(frame, on_wall, spec.fitted_cell, spec.cell_size)
        _announce(estimate_beams(model, _asked(spec, options)), options)
        write_beams(model, options.output, _material_of(options), on_wall=on_wall)
        warnings += deformed_struts(spec.grid, spec.struts)
    print_warnings(warnings)
    if options.quiet:
        return
    what = "lines" if options.step == "wireframe" else "beams"
    print_rows(
        ("file", f"{options.output}, {Path(options.output).stat().st_size / 1e6:.1f} MB"),
        ("struts", f"{len(frame.struts):,} between {len(frame.nodes):,} nodes, as {what}"),
        ("time", f"{time.perf_counter() - start:.2f} s"),
    )


def _write_faceted(
    result: Result, options: argparse.Namespace, spec: LatticeSpec
) -> tuple[str, ...]:
    from ..io.write.step_faceted import write_step_faceted
    from ..reports.estimate import estimate_faceted

    _announce(estimate_faceted(len(result.mesh.triangles), _asked(spec, options)), options)
    write_step_faceted(result.mesh, options.output)
    return ()


def _write_exact(
    result: Result,
    options: argparse.Namespace,
    spec: LatticeSpec,
    infill: Infill | None,
    progress: ProgressCallback,
) -> tuple[str, ...]:
    """Exact surfaces, or plane faces where OpenCASCADE does not manage them."""
    from ..io.freecad_process import write_exact_step
    from ..reports.estimate import estimate_exact, refuse_inexact
    from ..trim.beam_model import deformed_struts
    from ..util.progress import Monitor

    lattice, inner, outer = result.wireframe, None, None
    if infill is not None:
        lattice = infill.lattice_beams.lattice
        if spec.is_cut:
            inner = infill.cavity
            outer = infill.solid if spec.with_skin else None
    estimate = estimate_exact(lattice, _asked(spec, options), trimmed=inner is not None)
    _announce(estimate, options)
    warnings = deformed_struts(spec.grid, spec.struts, "Exact struts")
    measured = result.report.volume_mm3
    expected = None if warnings else measured
    try:
        refuse_inexact(spec)
        volume = write_exact_step(
            lattice, options.output, expected, inner=inner, outer=outer, monitor=Monitor(progress)
        )
    except VolfrepError as error:
        faceted = _write_faceted(result, options, spec)
        return (*faceted, f"{error} {PLANE_FACES}")
    if not options.quiet:
        print_rows(("exact volume", f"{volume:,.1f} mm3 (mesh: {measured:,.1f} mm3)"))
    return warnings


def _write_tetrahedra(
    result: Result,
    options: argparse.Namespace,
    spec: LatticeSpec,
    infill: Infill | None,
    progress: ProgressCallback,
) -> tuple[str, ...]:
    from ..fem.deck import write_tetrahedra
    from ..fem.joint_loads import side_joints
    from ..fem.tet_mesh import nodes_on, tetrahedra
    from ..reports.estimate import estimate_tetrahedra
    from ..util.progress import Monitor

    _announce(estimate_tetrahedra(len(result.mesh.triangles), _asked(spec, options)), options)
    filled = tetrahedra(result.mesh, Monitor(progress))
    sets = {}
    if infill is None or not infill.placement.is_cut:
        sets = side_joints(filled, result.wireframe)
    if infill is not None:
        wall = infill.cavity if spec.output == "lattice" else infill.solid
        sets["SKIN"] = nodes_on(filled, wall)
    write_tetrahedra(filled, options.output, _material_of(options), sets=sets)
    return filled.warnings


def _asked(spec: LatticeSpec, options: argparse.Namespace) -> ExportChoice:
    from ..reports.estimate import ExportChoice

    return ExportChoice(spec, getattr(options, "count", None))


def _announce(estimate: Estimate, options: argparse.Namespace) -> None:
    """Say what a file will take before it is made."""
    if not options.quiet:
        print(f"{options.output}: {estimate}", flush=True)


def _material_of(options: argparse.Namespace) -> Material:
    from ..mechanics.materials import Material

    if options.solid is not None:
        solver: Material = options.solid.for_solver(options.density)
        return solver
    return Material() if options.density is None else Material(density=options.density)

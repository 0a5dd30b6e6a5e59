# SPDX-License-Identifier: LGPL-2.1-or-later
"""The commands ``volfrep fill``, ``block`` and ``network``, which make lattices.

numpy and the engine are imported inside the functions, as in `command`.
"""

from __future__ import annotations

import argparse
import dataclasses
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from ..util.progress_bar import drawn
from .files import read_part
from .options import (
    FillOptions,
    MeshOptions,
    block_options,
    fill_options,
    network_options,
)
from .telling import print_rows, print_summary, print_warnings, write_report

if TYPE_CHECKING:
    from concurrent.futures import Executor

    from ..design.forecast import BeamForecast, Forecast
    from ..design.spec import LatticeSpec
    from ..io.solid import Solid
    from ..mesh.triangle_mesh import TriangleMesh
    from ..output.sources import Block, FilledPart, FreeGraph
    from ..process.head_start import HeadStart
    from ..process.worker import Ending
    from ..reports.estimate import Estimate
    from ..reports.printability import PrintReport
    from ..reports.report import Report


@contextmanager
def _workers(options: FillOptions, worth: int, first: HeadStart) -> Iterator[Executor | None]:
    """Those that the options ask for; where they do not, as many processes as it is worth.

    `first` may have started one of these; it ends where it is none of them.
    """
    from ..jobs.workers import MODULES, lost_worker
    from ..process.cluster import dask_workers
    from ..process.pool import processes

    if options.scheduler is not None:
        with dask_workers(options.scheduler) as executor:
            yield executor
        return
    count = worth if options.workers is None else options.workers
    if options.workers == 1:
        from concurrent.futures import ThreadPoolExecutor

        with ThreadPoolExecutor(1) as alone:  # groups one after the other
            yield alone
        return

    def warn_lost(ending: Ending) -> None:
        print(f"volfrep: {lost_worker(ending)}", file=sys.stderr, flush=True)

    modules = MODULES if worth > 1 else ()  # imported while this process goes on
    with_this = options.workers is None
    with processes(count, modules, warn_lost, with_this=with_this, first=first) as beside:
        first.end()
        yield beside


def run_fill(given: argparse.Namespace) -> None:
    """Run ``volfrep fill``."""
    options = fill_options(given)
    if options.bare_surface:
        _fill_surface(options)
        return

    from ..jobs.workers import MODULES
    from ..process.head_start import HeadStart

    first = HeadStart(MODULES)
    try:
        _fill_part(options, first)
    finally:
        first.end()


def _fill_part(options: FillOptions, first: HeadStart) -> None:
    """Read a part, which `first` may be started for, and fill it."""
    from ..jobs.workers import worth_head_start, worth_processes, worth_untold

    spec, meshed = options.spec, options.form.meshed
    asked = options.workers is not None or options.scheduler is not None or bool(options.limits)

    def seen(mesh: TriangleMesh) -> None:
        if meshed and not asked and worth_head_start(spec, mesh):
            first.begin()

    start = time.perf_counter()
    solid = read_part(options.part, options.unit, spec.cell_size, seen)
    read_seconds = time.perf_counter() - start

    # What follows is loaded while a worker starts.
    from ..design.forecast import forecast_fill, forecast_fill_beams
    from ..jobs.kinds import lattice_kind
    from ..jobs.targets import solve_target
    from ..output.sources import FilledPart
    from ..process.pool import let_go

    if options.limits:
        _fill_within(options, solid, start, {"read": read_seconds})
        return
    rough = lattice_kind(spec).roughly_solved(solid)
    if meshed and spec.output != "domain":
        rough.kind.refuse_crossing()
    is_counted = meshed and not asked
    worth = (options.workers or 1) if meshed else 1
    if options.quiet and is_counted:
        worth = worth_untold(rough, solid, streamed=options.is_file_alone)
    elif not options.quiet:
        expected = forecast_fill(solid, rough, streamed=options.is_file_alone)
        if is_counted:
            worth = worth_processes(spec, expected)
        told = str(expected) if meshed else expected.of_axes
        if options.form.is_beams_alone:
            told = str(forecast_fill_beams(solid, rough))
        print(f"Expected: {told}.", flush=True)
    with _workers(options, worth, first) as executor, drawn(options.quiet) as progress:
        made = solve_target(
            solid, spec, progress=progress, meshed=meshed, executor=executor,
            streamed=options.is_file_alone,
        )  # fmt: skip
        if not options.form.octants_by:  # which they would help to write
            made.ahead = lambda _: let_go(executor)  # all groups are cut
        _make(FilledPart(made, progress=progress), options, start, {"read": read_seconds})


def _fill_surface(options: FillOptions) -> None:
    """Write the surface that a part's sheets follow."""
    from ..output.bare_surface import bare_surface, refuse_solid_form

    start = time.perf_counter()
    refuse_solid_form(options.output)
    solid = read_part(options.part, options.unit, options.spec.cell_size)
    with drawn(options.quiet) as progress:
        made = bare_surface(solid, options.spec, progress=progress)
        made.save(options.output)
    print_warnings(made.warnings)
    if not options.quiet:
        print_rows(
            ("file", f"{options.output}, {Path(options.output).stat().st_size / 1e6:.1f} MB"),
            *made.rows(),
            ("time", f"{time.perf_counter() - start:.2f} s"),
        )
    _keep(options)


def _fill_within(
    options: FillOptions, solid: Solid, start: float, before: dict[str, float]
) -> None:
    """Fill with the finest facets with which the file keeps within its limits."""
    from ..jobs.targets import solve_target
    from ..output.file_size import filled_triangles
    from ..output.sources import FilledPart
    from ..util.cache import StageCache

    cache = StageCache()
    with drawn(options.quiet) as progress:

        def make(spec: LatticeSpec) -> FilledPart:
            made = solve_target(solid, spec, progress=progress, cache=cache)
            return FilledPart(made, progress=progress)

        _make_within(options, filled_triangles(solid), make, start, before)


def _make_within(
    options: MeshOptions,
    expect: Callable[[LatticeSpec], float],
    make: Callable[[LatticeSpec], FilledPart | Block | FreeGraph],
    start: float,
    before: dict[str, float],
) -> None:
    """Make and write what keeps within the limits of the file.

    Args:
        options: of the command.
        expect: triangles of a specification.
        make: makes one.
        start: as of `_make`.
        before: as of `_make`.
    """
    from ..output.file_size import keep_within

    made, notes = keep_within(options.spec, options.limits, options.form, expect, make)
    print_warnings(notes)
    _make(made, options, start, before)


def run_block(given: argparse.Namespace) -> None:
    """Run ``volfrep block``."""
    options = block_options(given)

    from ..design.forecast import forecast_block, forecast_block_beams

    before: dict[str, float]
    start, count, meshed = time.perf_counter(), options.count, options.form.meshed
    if options.limits:
        from ..jobs.targets import solve_block_target
        from ..output.sources import Block

        with drawn(options.quiet) as progress:
            _make_within(
                options,
                lambda spec: forecast_block(spec, count).triangles,
                lambda spec: Block(solve_block_target(spec, count), progress),
                start,
                {},
            )
        return
    streamed = options.is_file_alone and bool(options.form.octants_by)

    def expect(spec: LatticeSpec) -> None:
        if meshed:
            spec.kind.refuse_crossing()
        if not options.quiet:
            told: Forecast | BeamForecast = forecast_block(spec, count, streamed=streamed)
            if options.form.is_beams_alone:
                told = forecast_block_beams(spec, count)
            print(f"Expected: {told}.", flush=True)

    tell = expect if meshed or options.form.is_beams_alone else None
    if options.spec.target is None:
        from ..jobs.kinds import lattice_kind

        block = lattice_kind(options.spec).block(count)
        before = {}
        if tell is not None:
            tell(options.spec)
    else:
        from ..jobs.targets import solve_block_target  # loads what fills parts

        block = solve_block_target(options.spec, count, meshed=meshed, tell=tell)
        before = {"target": time.perf_counter() - start}
    with drawn(options.quiet) as progress:
        if not streamed:
            from ..output.sources import Block

            _make(Block(block, progress), options, start, before)
            return
        from ..util.progress import Monitor

        # Octant by octant, without a surface in between.
        report = block.write_stl(options.output, Monitor(progress))
        _tell(dataclasses.replace(report, stages={**before, **report.stages}), options)


def run_network(given: argparse.Namespace) -> None:
    """Run ``volfrep network``."""
    options = network_options(given)

    from ..output.sources import FreeGraph

    start = time.perf_counter()
    with drawn(options.quiet) as progress:
        if options.limits:
            _make_within(options, lambda _: 0.0, lambda spec: FreeGraph(spec, progress), start, {})
        else:
            _make(FreeGraph(options.spec, progress), options, start, {})


def _make(
    part: FilledPart | Block | FreeGraph,
    options: MeshOptions,
    start: float,
    before: dict[str, float],
) -> None:
    """Write a part in its form; tell what was made.

    Args:
        part: what is written.
        options: of the command.
        start: when the job began, of `time.perf_counter`.
        before: seconds of stages that are over.
    """
    from ..output.writer import Settings, writer_of
    from ..util.progress import peak_memory_mb

    def announce(estimate: Estimate) -> None:
        if not options.quiet:
            print(f"{options.output}: {estimate}", flush=True)

    out, form = options.output, options.form
    settings = Settings(material=options.material, tell=announce)
    writer, notes = writer_of(form).settle(part)
    print_warnings(notes)
    if not form.meshed:
        print_warnings(options.notes)
        written = writer.write(part, out, settings)
        print_warnings(written.warnings)
        if not options.quiet:
            print_rows(
                ("file", f"{out}, {Path(out).stat().st_size / 1e6:.1f} MB"),
                *written.rows,
                ("time", f"{time.perf_counter() - start:.2f} s"),
            )
        _keep(options)
        return
    result = part.result
    start = time.perf_counter()
    written = writer.write(part, out, settings)
    if written.rows and not options.quiet:
        print_rows(*written.rows)
    report = dataclasses.replace(
        result.report,
        stages={**before, **result.report.stages, "write": time.perf_counter() - start},
        peak_memory_mb=peak_memory_mb(),
        warnings=tuple(dict.fromkeys((*result.report.warnings, *written.warnings))),
    )
    report = dataclasses.replace(report, warnings=(*options.notes, *report.warnings))
    printing, struts = None, result.wireframe
    if options.printed is not None:
        from ..jobs.as_printed import as_printed

        printed = as_printed(struts, options.printed, options.build_direction)
        struts, cavity = printed.struts, part.cavity
        room = report.volume_mm3 / report.relative_density if cavity is None else cavity.volume
        lattice = report.relative_density * abs(room)
        if not options.quiet:
            print_rows(printed.row(lattice, report.volume_mm3, part.spec.density))
    if options.process is not None:
        from ..jobs.figures.print_check import check_print

        printing = check_print(
            result.mesh, struts, part.cavity, part.spec, options.process,
            options.build_direction,
        )  # fmt: skip
    _tell(report, options, printing)
    if options.picture is not None:
        from ..reports.picture import picture

        picture(result.mesh, part.spec, options.picture, solid=part.solid)


def _tell(report: Report, options: MeshOptions, printing: PrintReport | None = None) -> None:
    """Say what was made, and write its figures and the specification."""
    if options.report is not None:
        write_report(report, options.report, printing)
    print_summary(report, options.output, printing, quiet=options.quiet)
    _keep(options)


def _keep(options: MeshOptions) -> None:
    if options.kept is not None:
        options.kept.write()

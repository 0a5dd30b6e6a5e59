# SPDX-License-Identifier: LGPL-2.1-or-later
"""The command ``volfrep size``: struts as thick as what the part carries asks for.

numpy and the engine are imported inside the functions, as in `command`.
"""

from __future__ import annotations

import argparse
import signal
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from types import FrameType
from typing import TYPE_CHECKING

from ..util.errors import Cancelled, VolfrepError
from ..util.numbers import duration
from ..util.progress import ProgressCallback
from ..util.progress_bar import ProgressBar, drawn
from .files import read_part
from .options import SizeOptions, size_options
from .solve import tell_expected
from .telling import print_summary, print_warnings

if TYPE_CHECKING:
    from ..design.spec import LatticeSpec
    from ..jobs.sizing import Goal, SizedPart
    from ..output.sources import FilledPart
    from ..reports.printability import PrintReport
    from ..sizing.optimise import Step

#: What a script is told of a part that does not hold a limit, though it is written.
EXIT_NOT_HELD = 3


def run_size(given: argparse.Namespace) -> int | None:
    """Run ``volfrep size``."""
    options = size_options(given)

    from ..design.field_files import write_points
    from ..jobs.infill import Infill
    from ..jobs.result_files import write_thickness
    from ..jobs.sizing import (
        check_file_proof,
        goal_of,
        prove_file,
        size,
    )
    from ..loads.load_file import read_load_cases
    from ..output.file_size import fill_within
    from ..output.sources import FilledPart
    from ..output.writer import Settings, writer_of
    from ..reports.sizing_page import is_page, write_sizing_page
    from ..util.cache import StageCache
    from ..util.files import write_json

    spec = options.spec
    solid = read_part(options.part, options.unit, spec.cell_size)
    loads = read_load_cases(options.loads, solid)
    if spec.density != loads.material.density:
        spec = replace(spec, density=loads.material.density)
    goal = goal_of(
        loads.material, options.goal, lambda name: f"--{name.replace('_', '-')}",
        remove_thin=options.remove_thin, radius_list=options.radius_list,
        symmetry=options.symmetry, printing=options.printing,
        solid_places=options.solid, building=options.building,
    )  # fmt: skip
    if options.prove_file:
        check_file_proof(goal)
    cache = StageCache()
    start = time.perf_counter()
    with drawn(options.quiet) as progress:
        with _stopping(_naming(progress, options.quiet)) as callback:
            made = size(
                solid, spec, loads, goal, most_steps=options.steps, prove_it=options.prove,
                progress=callback, cache=cache, watch=_teller(options.quiet, options.steps, goal),
            )  # fmt: skip
        seconds = time.perf_counter() - start
        # What was found is not lost where the file cannot be made.
        if options.thickness is not None:
            write_thickness(made.spec, options.thickness)
        if options.radii is not None:
            write_points(options.radii, made.points, made.radii, "radius")
            _write_specification(options, made)
        streamed = options.form.streamed and not options.prove_file
        streamed = streamed and made.building is None

        def fill(spec: LatticeSpec) -> FilledPart:
            infill = Infill(solid, spec, progress=progress, cache=cache, streamed=streamed)
            return FilledPart(infill, cache, progress)

        part, kept = fill_within(solid, made.spec, options.limits, options.form, fill)
        report = part.result.report
        writer_of(options.form).write(part, options.output, Settings())
        printing = None if made.building is None else _print_report(part, options, made)
        if options.prove_file:
            prove_file(
                made, part.result.mesh, loads, voxel=options.voxel, progress=progress,
                tell=tell_expected(options.quiet),
            )  # fmt: skip
    if options.report is not None and is_page(options.report):
        write_sizing_page(made.report, solid, loads, Path(options.part).name, options.report)
    elif options.report is not None:
        figures = {"sizing": made.report, "part": report.as_dict()}
        if printing is not None:
            figures["print_report"] = printing.as_dict()
        write_json(options.report, figures)
    if options.plot is not None:
        from ..reports.sizing_plot import write_sizing_plot

        write_sizing_plot(made.report, options.plot)
    if options.picture is not None:
        _picture(options, made)
    print_warnings([*made.report["notes"], *kept])
    print_summary(report, options.output, printing, quiet=options.quiet, before=seconds)
    if not options.quiet:
        from ..reports.sizing_results import result_tables, sizing_results
        from ..reports.tables import as_text

        print(as_text(result_tables(sizing_results(made.report))))
        print(f"Sizing took {seconds:.1f} s of the time.")
    return None if made.sized.holds else EXIT_NOT_HELD


def _print_report(part: FilledPart, options: SizeOptions, made: SizedPart) -> PrintReport:
    """The finished part held against the process that it was sized for."""
    from ..jobs.as_printed import as_printed
    from ..jobs.figures.print_check import check_print

    building, struts = made.building, part.result.wireframe
    assert building is not None
    if options.printing is not None:
        struts = as_printed(struts, options.printing.table, building.build_direction).struts
    return check_print(
        part.result.mesh, struts, part.cavity, part.spec, building.process,
        building.build_direction,
    )  # fmt: skip


@contextmanager
def _stopping(progress: ProgressCallback) -> Iterator[ProgressCallback]:
    """A progress that says stop after Ctrl-C or SIGTERM, so that the best design so far is kept.

    Raises:
        KeyboardInterrupt: there was no design yet, or a signal came again.
    """
    stopped = False

    def stop(number: int, frame: FrameType | None) -> None:
        nonlocal stopped
        if stopped:
            raise KeyboardInterrupt
        del number, frame
        stopped = True

    def callback(fraction: float, stage: str) -> bool | None:
        return False if stopped else progress(fraction, stage)

    if threading.current_thread() is not threading.main_thread():
        yield callback
        return
    before = {number: signal.signal(number, stop) for number in (signal.SIGINT, signal.SIGTERM)}
    try:
        yield callback
    except Cancelled as error:
        raise KeyboardInterrupt from error
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


def _naming(progress: ProgressBar, quiet: bool) -> ProgressCallback:
    """A progress that also names each stage on standard error where no bar is drawn there."""
    if quiet or progress.is_drawn:
        return progress
    before = ""

    def named(fraction: float, stage: str) -> None:
        nonlocal before
        if stage != before:
            print(f"{fraction:.0%}: {stage}", file=sys.stderr, flush=True)
            before = stage
        progress(fraction, stage)

    return named


def _teller(quiet: bool, most_steps: int, goal: Goal) -> Callable[[int, Step], bool] | None:
    """Tells every step on standard error: its figures, and how long the rest takes at most."""
    if quiet:
        return None
    start = time.perf_counter()

    what = "struts"
    if goal.skin_thinnest is not None:
        what, most_steps = "struts and skin", 2 * most_steps

    def tell_step(number: int, step: Step) -> bool:
        nonlocal start
        now = time.perf_counter()
        uses = ", ".join(f"{name} {use:.0%}" for name, use in step.uses.items())
        text = f"step {number + 1}: {what} {step.volume:,.0f} mm3" + f", {uses}" * bool(uses)
        if number:
            each = (now - start) / number
            rest = each * max(most_steps - number - 1, 0)
            one = duration(each) if each >= 1.0 else f"{each:.2g} s"
            text += f", {one} a step, at most {duration(rest)} more"
        else:
            start = now  # the time before the first step is the part's
        if sys.stderr.isatty():  # over the line of the progress
            text = f"\r{text:<79}"
        print(text, file=sys.stderr, flush=True)
        return True

    return tell_step


def _write_specification(options: SizeOptions, made: SizedPart) -> None:
    if options.write_spec is None or options.radii is None:
        return
    from ..design.parameters.spec_file import write_values
    from ..jobs.result_files import values_with_radii

    values = values_with_radii(made.spec, options.radii, options.thickness)
    write_values(values, options.write_spec)


def _picture(options: SizeOptions, made: SizedPart) -> None:
    assert options.picture is not None
    from ..reports.sizing_picture import sizing_picture

    names = [case.name for case in made.model.problem.cases]
    if options.case is not None and options.case not in names:
        raise VolfrepError(
            f"There is no load case '{options.case}': choose one of {', '.join(names)}."
        )
    sizing_picture(
        made.model, made.sized.analysis, options.picture, colour=options.colour,
        case=names.index(options.case) if options.case is not None else 0,
        deformed=options.deformed, governing=(made.governing.rows, made.governing.told),
    )  # fmt: skip

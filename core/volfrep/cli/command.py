# SPDX-License-Identifier: LGPL-2.1-or-later
"""The ``volfrep`` command.

Exit codes: 0 done, 2 bad input (one sentence on standard error), 3 done, but a limit that was asked
for is not held (the files are there), 130 interrupted.
numpy and the engine are imported inside the commands, so that ``--help`` answers at once.
"""

from __future__ import annotations

import argparse
import dataclasses
import sys
import tempfile
import time
import traceback
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from ..design.parameters import BY_NAME
from ..util import memory_limit
from ..util.errors import VolfrepError
from ..util.files import keeping_inputs
from ..util.progress_bar import drawn
from . import (
    bug_report,
    coupon,
    find,
    homogenising,
    infill,
    layers,
    orienting,
    process,
    properties,
    sizing,
    solving,
    sweep,
)
from .files import read_part
from .options import (
    BlockOptions,
    FillOptions,
    MeshOptions,
    block_options,
    fill_options,
    network_options,
)
from .parameter_options import add_parameters
from .parser import Parser, Version, refuse_old, with_current_options
from .run_options import add_run_options
from .telling import print_rows, print_summary, print_warnings, write_report

if TYPE_CHECKING:
    from concurrent.futures import Executor

    from ..design.spec import LatticeSpec
    from ..io.solid import Solid
    from ..output.sources import FilledPart, Free
    from ..process.worker import Ending
    from ..reports.estimate import Estimate
    from ..reports.printability import PrintReport
    from ..reports.report import Report

#: A command ends with what it returns; None is 0.
Command = Callable[[argparse.Namespace], "int | None"]
STATUS = (
    "The exit status is 0; 2 where the input is wrong, with one sentence that says why; 3 where a "
    "limit of 'size' is not held, with its file written all the same; 130 after Ctrl-C."
)
EXIT_DEFECT = 1
EXIT_BAD_INPUT = 2
#: Fewer triangles than these are cut in this process: others take longer to start.
WORTH_WORKERS = 600_000


def run(arguments: Sequence[str]) -> int:
    """Run a command and return its exit code; errors of the user become one sentence."""
    try:
        refuse_old(arguments)
        options = _parser().parse_args(with_current_options(arguments))
        command: Command = options.command
        memory_limit.keep_within()
        with keeping_inputs():
            return command(options) or 0
    except VolfrepError as error:
        print(f"volfrep: {error}", file=sys.stderr)
        return EXIT_BAD_INPUT
    except KeyboardInterrupt:
        return process.say_interrupted()
    except Exception as error:  # whatever it is, the user gets a sentence
        if process.is_interrupted():
            return process.say_interrupted()
        if memory_limit.is_want_of_memory(error):
            print(f"volfrep: {memory_limit.not_enough()}", file=sys.stderr)
            return EXIT_BAD_INPUT
        print(
            f"volfrep: The engine failed with a {type(error).__name__} ({error}), which is a "
            f"defect of VOLFREP: please report it with the traceback in '{_logged()}'.",
            file=sys.stderr,
        )
        return EXIT_DEFECT


def _logged() -> str:
    """The traceback of the running exception as a new file; its path."""
    with tempfile.NamedTemporaryFile(
        "w", prefix="volfrep-", suffix=".log", delete=False, encoding="utf-8"
    ) as file:
        traceback.print_exc(file=file)
    return file.name


def _parser() -> argparse.ArgumentParser:
    parser = Parser(
        prog="volfrep",
        description="Fill a solid with a strut lattice. Lengths are in mm.",
        epilog=STATUS,
        allow_abbrev=False,
    )
    parser.add_argument("--version", action=Version, nargs=0, help="show the version and exit")
    commands = parser.add_subparsers(title="commands", metavar="COMMAND", required=True)

    def add(name: str, command: Command, text: str) -> Parser:
        sub: Parser = commands.add_parser(name, help=text, description=text, allow_abbrev=False)
        sub.set_defaults(command=command)
        return sub

    fill = add("fill", _fill, "Fill a solid with a lattice under a closed skin.")
    fill.add_argument(
        "part",
        metavar="PART",
        help="the closed solid: STL, OBJ, PLY or 3MF, or with FreeCAD at hand STEP, IGES or BREP",
    )
    add_run_options(fill, "fill")
    add_parameters(fill)

    block = add("block", _block, "Make a free-standing block of whole cells with round struts.")
    add_run_options(block, "block")
    add_parameters(block, of_block=True)

    network = add(
        "network", _network, "Mesh the nodes and struts of a file, or cells laid into its mesh."
    )
    network.add_argument("file", metavar="FILE", help=BY_NAME["network_file"].help)
    add_run_options(network, "network")
    laid = ("origin", "network_thickness", "network_layers", "network_reversed")
    add_parameters(network, of_block=True, also=laid)

    layers.add_command(add)
    infill.add_command(add)
    coupon.add_command(add)
    properties.add_command(add)
    find.add_command(add)

    sizing.add_command(add)
    solving.add_command(add)
    homogenising.add_command(add)
    orienting.add_command(add)
    sweep.add_command(add)

    check = add("check", _check, "Tell what a reader sees in a mesh file (STL, OBJ, PLY, 3MF).")
    check.add_argument("file", metavar="FILE")
    add_run_options(check, "check")
    bug_report.add_command(add)
    return parser


@contextmanager
def _workers(options: FillOptions, triangles: int) -> Iterator[Executor | None]:
    """Those that the options ask for; where they do not, as many as so many triangles are worth."""
    from ..process.cluster import dask_workers
    from ..process.pool import processes

    if options.scheduler is not None:
        with dask_workers(options.scheduler) as executor:
            yield executor
        return
    count, module = options.workers, ""
    if count == 1:
        from concurrent.futures import ThreadPoolExecutor

        with ThreadPoolExecutor(1) as executor:  # groups one after the other
            yield executor
        return
    if triangles >= WORTH_WORKERS:  # they start while this process looks for the wall
        module = "volfrep.trim.group_cut"
    elif count is None:
        count = 1
    with processes(count, module, _told_lost) as executor:
        yield executor


def _told_lost(ending: Ending) -> None:
    """Tell at once of a worker that has ended; what it did is done again."""
    print(f"volfrep: A worker has ended {ending}: the others go on.", file=sys.stderr, flush=True)


def _fill(given: argparse.Namespace) -> None:
    options = fill_options(given)

    from ..design.forecast import forecast_fill
    from ..jobs.kinds import lattice_kind
    from ..jobs.targets import solve_target
    from ..output.sources import FilledPart
    from ..process.pool import let_go

    spec, meshed = options.spec, options.form.meshed
    start = time.perf_counter()
    solid = read_part(options.part, options.unit, spec.cell_size)
    read_seconds = time.perf_counter() - start
    if options.limits:
        _fill_within(options, solid, start, {"read": read_seconds})
        return
    rough = lattice_kind(spec).roughly_solved(solid)
    if meshed and spec.output != "domain":
        rough.kind.refuse_crossing()
    expected = forecast_fill(solid, rough, streamed=options.is_plain)
    if not options.quiet:
        print(f"Expected: {expected if meshed else expected.of_axes}.", flush=True)
    is_cut = meshed and spec.kind.is_cut_in_groups and spec.output != "domain"
    cut = expected.triangles if is_cut else 0
    with _workers(options, cut) as executor, drawn(options.quiet) as progress:
        made = solve_target(
            solid, spec, progress=progress, meshed=meshed, executor=executor,
            streamed=options.is_plain,
        )  # fmt: skip
        made.ahead = lambda _: let_go(executor)  # all groups are cut
        _make(FilledPart(made, progress=progress), options, start, {"read": read_seconds})


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
    options: FillOptions | BlockOptions,
    expect: Callable[[LatticeSpec], float],
    make: Callable[[LatticeSpec], FilledPart | Free],
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
    from ..output.file_size import fit_file

    found = fit_file(options.spec, options.limits, options.form, expect, make)
    if found.note:
        print_warnings([found.note])
    _make(found.made, options, start, before)


def _block(given: argparse.Namespace) -> None:
    options = block_options(given)

    from ..design.forecast import forecast_block

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
    if options.spec.target is None:
        from ..jobs.kinds import lattice_kind

        block = lattice_kind(options.spec).block(count)
        before = {}
    else:
        from ..jobs.targets import solve_block_target  # loads what fills parts

        block = solve_block_target(options.spec, count, meshed=meshed)
        before = {"target": time.perf_counter() - start}
    spec = block.spec
    streamed = options.is_plain and options.form.name == "stl"
    if meshed:
        spec.kind.refuse_crossing()
        if not options.quiet:
            expected = forecast_block(spec, count, streamed=streamed)
            print(f"Expected: {expected}.", flush=True)
    with drawn(options.quiet) as progress:
        if not streamed:
            from ..output.sources import Block

            _make(Block(block, progress), options, start, before)
            return
        from ..util.progress import Monitor

        # Octant by octant, without a surface in between.
        report = block.write_stl(options.output, Monitor(progress))
        _tell(dataclasses.replace(report, stages={**before, **report.stages}), options)


def _network(given: argparse.Namespace) -> None:
    options = network_options(given)

    from ..output.sources import FreeGraph

    start = time.perf_counter()
    with drawn(options.quiet) as progress:
        _make(FreeGraph(options.spec, progress), options, start, {})


def _make(
    part: FilledPart | Free, options: MeshOptions, start: float, before: dict[str, float]
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


def _check(options: argparse.Namespace) -> None:
    from ..io.solid import read_triangles
    from ..reports.mesh_report import mesh_report

    report = mesh_report(read_triangles(options.file, options.unit))
    print_rows(("file", str(options.file)), *report.rows())

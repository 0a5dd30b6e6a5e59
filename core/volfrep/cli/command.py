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
from contextlib import AbstractContextManager, contextmanager, nullcontext
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from ..design.parameters import BY_NAME
from ..util import memory_limit
from ..util.errors import VolfrepError
from ..util.files import keeping_inputs
from . import layers, material, printing_options, process, properties, sizing, solver_options, sweep
from .files import check_files, read_part
from .parameter_options import add_parameters, keep_specification, set_parameter, write_kept
from .parser import Parser, Version, refuse_old
from .run_options import add_run_options, refuse_extensions
from .telling import Progress, print_rows, print_summary

if TYPE_CHECKING:
    from concurrent.futures import Executor

    from ..design.spec import LatticeSpec
    from ..grid.strut_graph import BeamModel
    from ..io.write.stl_ahead import StlAhead
    from ..mesh.triangle_mesh import TriangleMesh
    from ..reports.result import Result
    from ..trim.placed_lattice import InnerOctants
    from .solver_options import Writer

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
        options = _parser().parse_args(arguments)
        command: Command = options.command
        memory_limit.keep_within()
        with keeping_inputs():
            status = command(options) or 0
            write_kept(options)
            return status
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
    properties.add_command(add)

    sizing.add_command(add)
    sweep.add_command(add)

    check = add("check", _check, "Tell what a reader sees in a mesh file (STL, OBJ, PLY, 3MF).")
    check.add_argument("file", metavar="FILE")
    add_run_options(check, "check")
    return parser


@contextmanager
def _workers(options: argparse.Namespace, triangles: int) -> Iterator[Executor | None]:
    """Those that the options ask for; where they do not, as many as so many triangles are worth."""
    from ..util.workers import dask_workers, processes

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
    with processes(count, module) as executor:
        yield executor


def _ahead(options: argparse.Namespace) -> AbstractContextManager[StlAhead | None]:
    """The file to write where it may be begun before all of it is known; else None."""
    if Path(options.output).suffix.lower() != ".stl":
        return nullcontext()
    from ..io.write.stl_ahead import stl_ahead  # with what cuts, which no other file needs here

    return stl_ahead(options.output)


def _are_cut(executor: Executor | None, ahead: StlAhead | None, inner: InnerOctants) -> None:
    """All groups are cut: workers may go, and a file may begin."""
    from ..util.workers import let_go

    let_go(executor)
    if ahead is not None:
        ahead.begin(inner)


def _fill(options: argparse.Namespace) -> None:
    spec = material.with_material_density(options)
    _check_targets(options, spec)
    keep_specification(options, spec)

    from ..design.forecast import forecast_fill, refuse_crossing
    from ..jobs.rough_radius import solve_target_roughly
    from ..jobs.targets import solve_target

    start = time.perf_counter()
    solid = read_part(options, spec.cell_size)
    read_seconds = time.perf_counter() - start
    meshed = solver_options.is_meshed(options)
    rough = solve_target_roughly(solid, spec)
    if meshed and spec.output != "domain" and options.threemf != "beams":
        refuse_crossing(rough)
    expected = forecast_fill(solid, rough, streamed=_is_plain(options))
    if not options.quiet:
        print(f"Expected: {expected if meshed else expected.of_axes}.", flush=True)
    is_cut = meshed and spec.network is None and spec.output != "domain"
    cut = expected.triangles if is_cut else 0
    with (
        _workers(options, cut) as executor,
        Progress(options.quiet) as progress,
        _ahead(options) as ahead,
    ):
        infill = solve_target(
            solid, spec, progress=progress, meshed=meshed, executor=executor,
            streamed=_is_plain(options),
        )  # fmt: skip
        spec = infill.spec
        if solver_options.fill_axes(infill, options, start):
            return
        if options.threemf == "beams":
            printing_options.finish_beams(infill.beams, options, start)
            return
        solver_options.settle_step(infill, options)
        beams = infill.beams if options.threemf == "both" else None
        infill.ahead = partial(_are_cut, executor, ahead)
        result = infill.result
        domain = None
        if options.print_report is not None:
            domain = infill.cavity
        write = solver_options.writer(options, spec, infill, progress)
        _finish(result, options, spec, {"read": read_seconds}, beams, domain, write, ahead)
        _picture(result, options, spec, solid)


def _block(options: argparse.Namespace) -> None:
    spec = material.with_material_density(options)
    _check_targets(options, spec)
    keep_specification(options, spec)

    from ..design.forecast import forecast_block, refuse_crossing
    from ..jobs.blocks import block, write_block_stl
    from ..jobs.targets import solve_block_target

    start = time.perf_counter()
    meshed = solver_options.is_meshed(options)
    spec = solve_block_target(spec, options.count, meshed=meshed)
    if solver_options.block_axes(spec, options, start):
        return
    if options.threemf == "beams":
        from ..jobs.beam_part import block_beams

        printing_options.finish_beams(block_beams(spec, options.count), options, start)
        return
    refuse_crossing(spec)
    streamed = _is_plain(options) and Path(options.output).suffix.lower() == ".stl"
    if not options.quiet:
        expected = forecast_block(spec, options.count, streamed=streamed)
        print(f"Expected: {expected}.", flush=True)
    beams = None
    if options.threemf == "both":
        from ..jobs.beam_part import block_beams

        beams = block_beams(spec, options.count)
    with Progress(options.quiet) as progress:
        if streamed:
            print_summary(
                write_block_stl(spec, options.count, options.output, progress=progress), options
            )
            return
        result = block(spec, tuple(options.count), progress=progress)
        write = solver_options.writer(options, spec, None, progress)
        _finish(result, options, spec, {}, beams, write=write)
        _picture(result, options, spec)


def _network(options: argparse.Namespace) -> None:
    from ..grid.strut_graph import BeamModel
    from ..jobs.graphs.free_space import frame_alone, mesh_graph_alone

    set_parameter(options, "network", "file")
    set_parameter(options, "network_file", options.file)
    spec = material.with_material_density(options)
    _check_targets(options, spec)
    keep_specification(options, spec)
    start = time.perf_counter()
    if solver_options.needs_axes(options):
        solver_options.write_axes(frame_alone(spec)[0], None, spec, options, start)
        return
    with Progress(options.quiet) as progress:
        result = mesh_graph_alone(spec, progress=progress)
        beams = None if options.threemf is None else BeamModel(result.wireframe)
        if options.threemf == "beams" and beams is not None:
            printing_options.finish_beams(beams, options, start)
            return
        write = solver_options.writer(options, spec, None, progress)
        _finish(result, options, spec, {}, beams, write=write)
        _picture(result, options, spec)


def _picture(
    result: Result,
    options: argparse.Namespace,
    spec: LatticeSpec,
    solid: TriangleMesh | None = None,
) -> None:
    """Write the picture that was asked for."""
    if options.picture is not None:
        from ..reports.picture import picture

        picture(result.mesh, spec, options.picture, solid=solid)


def _is_plain(options: argparse.Namespace) -> bool:
    """Whether nothing but a file was asked for, which holds a surface without a mesh of it all."""
    from ..io.write import STREAMED

    more = (options.print_report, options.picture)
    plain = all(option is None for option in more)
    return plain and Path(options.output).suffix.lower() in STREAMED


def _check_targets(options: argparse.Namespace, spec: LatticeSpec) -> None:
    """Refuse before the work what could not be written after it."""
    from ..io.write import mesh_writer

    check_files(options)
    out = Path(options.output)
    refuse_extensions(options, "fill", out)
    if not solver_options.is_deck(out):
        mesh_writer(out)
    printing_options.check(options, out)
    solver_options.check(options, out, spec)


def _finish(
    result: Result,
    options: argparse.Namespace,
    spec: LatticeSpec,
    before: dict[str, float],
    beams: BeamModel | None,
    domain: TriangleMesh | None = None,
    write: Writer | None = None,
    ahead: StlAhead | None = None,
) -> None:
    """Write the mesh, with its beams if there are any; tell what was made.

    `domain` is what the lattice fills, for the print report; `write` writes the file where it is
    not a mesh, `ahead` where it is an STL that may be begun.
    """
    from ..io.write import write_surface
    from ..io.write.threemf import write_3mf_beams
    from ..util.progress import peak_memory_mb

    start = time.perf_counter()
    warnings = result.report.warnings
    if beams is not None:
        warnings = tuple(dict.fromkeys((*warnings, *beams.warnings)))
    if write is not None:
        warnings += write(result)
    elif ahead is not None:
        ahead.finish(result.surface)
    elif beams is None:
        write_surface(result.surface, options.output, figures=result.report.figures)
    else:
        figures = result.report.figures
        write_3mf_beams(beams, options.output, result.surface, figures=figures)
    report = dataclasses.replace(
        result.report,
        stages={**before, **result.report.stages, "write": time.perf_counter() - start},
        peak_memory_mb=peak_memory_mb(),
    )
    printing = None
    if options.print_report is not None:
        printing = printing_options.report_of(result, options, spec, domain)
    print_summary(dataclasses.replace(report, warnings=warnings), options, printing)


def _check(options: argparse.Namespace) -> None:
    from ..io.solid import read_triangles
    from ..reports.mesh_report import mesh_report

    report = mesh_report(read_triangles(options.file, options.unit))
    print_rows(("file", str(options.file)), *report.rows())

# SPDX-License-Identifier: LGPL-2.1-or-later
"""The ``volfrep`` command.

Exit codes: 0 done, 2 bad input (one sentence on standard error), 130 interrupted.
numpy and the engine are imported inside the commands, so that ``--help`` answers at once.
"""

from __future__ import annotations

import argparse
import dataclasses
import io
import json
import os
import re
import sys
import tempfile
import time
import traceback
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn

from ..util.errors import VolfrepError
from . import (
    domain_options as domain_options,
)
from . import (
    printing_options as printing_options,
)
from . import (
    solver_options as solver_options,
)
from .files import check_files
from .grading_options import add_grading_options, gradings
from .printing_options import print_rows, print_warnings

if TYPE_CHECKING:
    from ..design.spec import LatticeSpec
    from ..mesh.triangle_mesh import TriangleMesh
    from ..reports.printability import PrintReport
    from ..reports.report import Report
    from ..reports.result import Result
    from ..trim.beam_model import BeamModel
    from ..util.progress import ProgressCallback
    from .solver_options import Writer

EXIT_DEFECT = 1
EXIT_BAD_INPUT = 2
EXIT_INTERRUPTED = 130


def main() -> NoReturn:
    """Run the command of this process's arguments and exit with its code."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")  # a file's name may be any bytes
    try:
        code = run(sys.argv[1:])
        sys.stdout.flush()
    except BrokenPipeError:  # the reader of the text, such as `head`, has had enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        code = 0
    sys.stderr.flush()
    if code == EXIT_INTERRUPTED:
        # A compiled call may still be busy on a thread: an ordinary exit would wait for it.
        os._exit(code)
    sys.exit(code)


def run(arguments: Sequence[str]) -> int:
    """Run a command and return its exit code; errors of the user become one sentence."""
    try:
        options = _parser().parse_args([_plain_number(argument) for argument in arguments])
        command: Callable[[argparse.Namespace], None] = options.command
        command(options)
    except VolfrepError as error:
        print(f"volfrep: {error}", file=sys.stderr)
        return EXIT_BAD_INPUT
    except MemoryError:
        print(
            "volfrep: There is not enough memory for this job: "
            "use a coarser resolution or larger cells.",
            file=sys.stderr,
        )
        return EXIT_BAD_INPUT
    except KeyboardInterrupt:
        print("volfrep: Interrupted, no file was left half-written.", file=sys.stderr)
        return EXIT_INTERRUPTED
    except BrokenPipeError:
        raise
    except Exception as error:  # whatever it is, the user gets a sentence
        print(
            f"volfrep: The engine failed with a {type(error).__name__} ({error}), which is a "
            f"defect of VOLFREP: please report it with the traceback in '{_logged()}'.",
            file=sys.stderr,
        )
        return EXIT_DEFECT
    return 0


def _logged() -> str:
    """The traceback of the running exception as a new file; its path."""
    with tempfile.NamedTemporaryFile(
        "w", prefix="volfrep-", suffix=".log", delete=False, encoding="utf-8"
    ) as file:
        traceback.print_exc(file=file)
    return file.name


class _Parser(argparse.ArgumentParser):
    """An argument parser whose errors are one sentence, without the usage in front."""

    def error(self, message: str) -> NoReturn:
        raise VolfrepError(f"{message[:1].upper()}{message[1:]} (see '{self.prog} --help').")


class _Version(argparse.Action):
    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> None:
        from importlib.metadata import version

        print(f"volfrep {version('volfrep')}")
        parser.exit()


def _plain_number(argument: str) -> str:
    """Negative numbers such as ``-1e3`` as ``-1000.0``: argparse takes them for options.

    So it does pairs such as ``-5:0.4,0:1`` and directions such as ``-1,0,0``, unless they begin
    with a blank.
    """
    if re.match(r"-[\d.]+(e[-+]?\d+)?[:,]", argument, re.IGNORECASE):
        return f" {argument}"
    if not re.fullmatch(r"-(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?", argument):
        return argument
    return argument if re.fullmatch(r"-\d+", argument) else f"{float(argument):.15f}"


def _parser() -> argparse.ArgumentParser:
    parser = _Parser(
        prog="volfrep",
        description="Fill a solid with a strut lattice. Lengths are in mm.",
        allow_abbrev=False,
    )
    parser.add_argument("--version", action=_Version, nargs=0, help="show the version and exit")
    commands = parser.add_subparsers(title="commands", metavar="COMMAND", required=True)

    def add(name: str, command: Callable[[argparse.Namespace], None], text: str) -> _Parser:
        sub: _Parser = commands.add_parser(name, help=text, description=text, allow_abbrev=False)
        sub.set_defaults(command=command)
        return sub

    fill = add("fill", _fill, "Fill a solid with a lattice under a closed skin.")
    fill.add_argument(
        "part",
        metavar="PART",
        help="the closed solid: STL, OBJ, PLY or 3MF, or with FreeCAD at hand STEP, IGES or BREP",
    )
    _add_unit(fill)
    _add_lattice_options(fill)
    fill.add_argument(
        "--shell", type=float, required=True, metavar="MM", help="thickness of the skin, 0 for none"
    )
    domain_options.add_options(fill)
    fill.add_argument(
        "--output",
        metavar="WHAT",
        help="'part' (skin and lattice, default), 'lattice' (trimmed) or 'domain' (what it fills)",
    )
    fill.add_argument(
        "--origin",
        type=float,
        nargs=3,
        metavar=("X", "Y", "Z"),
        help="a point that is to be a corner of a cell (default: the part's box)",
    )

    block = add("block", _block, "Make a free-standing block of whole cells with round struts.")
    block.add_argument(
        "--count", type=int, nargs=3, required=True, metavar=("NX", "NY", "NZ"), help="cells"
    )
    _add_lattice_options(block)

    add("cells", _cells, "List the library of unit cells.")

    check = add("check", _check, "Tell what a reader sees in a mesh file (STL, OBJ, PLY, 3MF).")
    check.add_argument("file", metavar="FILE")
    _add_unit(check)
    return parser


def _add_unit(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--unit",
        help="of the file's lengths: mm, cm, m, inch, ft or um (default: what the file says, else "
        "mm)",
    )


def _add_lattice_options(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add("-o", dest="out", required=True, metavar="OUT", help=".stl, .3mf, .ply, .obj, .step, .inp")
    add("--cell", required=True, help="a library cell (see 'volfrep cells') or a cell's .json file")
    add("--cell-size", type=float, required=True, metavar="MM", help="edge L of a cell")
    add("--strut-radius", type=float, required=True, metavar="MM", help="radius r of the struts")
    detail = parser.add_mutually_exclusive_group()
    detail.add_argument("--resolution", type=int, metavar="N", help="facets along L")
    detail.add_argument(
        "--deviation", type=float, metavar="MM", help="largest distance from the exact surface"
    )
    add("--fillet", type=float, metavar="MM", help="radius of the round at the joints (default 0)")
    add("--density", type=float, metavar="G_PER_CM3", help="of the material (default 1)")
    add("--report", metavar="FILE.json", help="write the figures of the run as JSON")
    printing_options.add_options(parser)
    solver_options.add_options(parser)
    add("--quiet", action="store_true", help="print nothing but errors")
    add_grading_options(parser)


def _fill(options: argparse.Namespace) -> None:
    part = Path(options.part)
    _check_targets(options)
    spec = _spec(
        options,
        "shell",
        "output",
        "origin",
        *domain_options.FIELDS,
        **domain_options.openings(options),
    )

    from ..design.forecast import forecast_fill
    from ..io.read.units import refuse_scale
    from ..io.solid import read_solid
    from ..jobs.beam_part import beam_model
    from ..jobs.pipeline import fill
    from ..util.cache import StageCache

    start = time.perf_counter()
    solid = read_solid(part, options.unit)
    if not solid.states_unit:
        refuse_scale(solid.bounds, spec.cell_size, part.name)
    read_seconds = time.perf_counter() - start
    if not options.quiet:
        print(f"Expected: {forecast_fill(solid, spec)}.", flush=True)
    cache = StageCache()
    with _Progress(options.quiet) as progress:
        if solver_options.fill_axes(solid, spec, options, progress, start):
            return
        if options.threemf == "beams":
            printing_options.finish_beams(
                beam_model(solid, spec, progress=progress), options, start
            )
            return
        both = options.threemf == "both"
        beams = beam_model(solid, spec, progress=progress, cache=cache) if both else None
        result = fill(solid, spec, progress=progress, cache=cache)
        if options.compact is not None:
            result = printing_options.compacted(result, options, progress)
        domain = None
        if options.print_report is not None:
            domain = fill(solid, dataclasses.replace(spec, output="domain"), cache=cache).mesh
        write = solver_options.writer(options, spec, solid, cache, progress)
        _finish(result, options, {"read": read_seconds}, beams, domain, write)


def _block(options: argparse.Namespace) -> None:
    _check_targets(options)
    spec = _spec(options)

    from ..design.forecast import forecast_block
    from ..jobs.blocks import block, write_block_stl

    start = time.perf_counter()
    if solver_options.block_axes(spec, options, start):
        return
    if options.threemf == "beams":
        from ..jobs.beam_part import block_beams

        printing_options.finish_beams(block_beams(spec, options.count), options, start)
        return
    if not options.quiet:
        expected = forecast_block(spec, options.count, streamed=_writes_stl(options))
        print(f"Expected: {expected}.", flush=True)
    beams = None
    if options.threemf == "both":
        from ..jobs.beam_part import block_beams

        beams = block_beams(spec, options.count)
    with _Progress(options.quiet) as progress:
        if _writes_stl(options):
            _tell(write_block_stl(spec, options.count, options.out, progress=progress), options)
            return
        result = block(spec, tuple(options.count), progress=progress)
        if options.compact is not None:
            result = printing_options.compacted(result, options, progress)
        write = solver_options.writer(options, spec, None, None, progress)
        _finish(result, options, {}, beams, write=write)


def _writes_stl(options: argparse.Namespace) -> bool:
    """Whether nothing but an STL file of the mesh as it is was asked for."""
    plain = options.compact is None and options.print_report is None
    return plain and Path(options.out).suffix.lower() == ".stl"


def _check_targets(options: argparse.Namespace) -> None:
    """Refuse before the work what could not be written after it."""
    from ..io.write import mesh_writer

    check_files(options)
    out = Path(options.out)
    if not solver_options.is_deck(out):
        mesh_writer(out)
    printing_options.check(options, out)
    solver_options.check(options, out)


def _spec(options: argparse.Namespace, *more: str, **further: Any) -> LatticeSpec:
    from ..design.spec import LatticeSpec

    names = ("cell", "cell_size", "strut_radius", "resolution", "deviation", "fillet", "density")
    given = {name: getattr(options, name) for name in (*names, *more)}
    if given.get("origin") is not None:
        given["origin"] = tuple(given["origin"])
    given = {name: value for name, value in given.items() if value is not None}
    return LatticeSpec(**given, **further, **gradings(options))


def _finish(
    result: Result,
    options: argparse.Namespace,
    before: dict[str, float],
    beams: BeamModel | None,
    domain: TriangleMesh | None = None,
    write: Writer | None = None,
) -> None:
    """Write the mesh, with its beams if there are any; tell what was made.

    `domain` is what the lattice fills, for the print report; `write` writes the file where it is
    not a mesh.
    """
    from ..io.write import write_mesh
    from ..io.write.threemf import write_3mf_beams
    from ..util.progress import peak_memory_mb

    start = time.perf_counter()
    warnings = result.report.warnings if beams is None else beams.warnings
    if write is not None:
        warnings += write(result)
    elif beams is None:
        write_mesh(result.mesh, options.out)
    else:
        write_3mf_beams(beams, options.out, result.mesh)
    report = dataclasses.replace(
        result.report,
        stages={**before, **result.report.stages, "write": time.perf_counter() - start},
        peak_memory_mb=peak_memory_mb(),
    )
    printing = None
    if options.print_report is not None:
        printing = printing_options.report_of(result, options, domain)
    _tell(dataclasses.replace(report, warnings=warnings), options, printing)


def _tell(report: Report, options: argparse.Namespace, printing: PrintReport | None = None) -> None:
    """Write the report, and say what was made."""
    from ..util.files import replacing

    if options.report is not None:
        figures = report.as_dict()
        if printing is not None:
            figures["print_report"] = printing.as_dict()
        with replacing(options.report) as file:
            file.write(json.dumps(figures, indent=2).encode() + b"\n")
    print_warnings(report.warnings)
    if options.quiet:
        return
    size = Path(options.out).stat().st_size / 1e6
    grid = " x ".join(str(n) for n in report.grid)
    print_rows(
        ("file", f"{options.out}, {size:.1f} MB"),
        ("cells", f"{report.cells_active:,} active of {report.cells_total:,} ({grid})"),
        ("struts", f"{report.struts:,} between {report.nodes:,} nodes"),
        *_sizes(report),
        ("triangles", f"{report.triangles:,}"),
        ("watertight", f"{_yes(report.watertight)}, {_bodies(report.bodies, report.voids)}"),
        ("volume", f"{report.volume_mm3:,.1f} mm3"),
        ("relative density", f"{100 * report.relative_density:.2f} %"),
        ("mass", f"{report.mass_g:,.2f} g"),
        *domain_options.rows(report),
        ("time", f"{sum(report.stages.values()):.2f} s, {report.peak_memory_mb:,.0f} MB of memory"),
        *(printing.rows() if printing is not None else ()),
    )


def _sizes(report: Report) -> list[tuple[str, str]]:
    """What a grading came to; nothing for a lattice that is the same everywhere."""
    gradings = ("size_grading", "radius_grading", "cell_map", "orientation")
    if all(report.spec[name] is None for name in gradings):
        return []
    return [
        (name, f"{least:.4g} to {most:.4g} mm")
        for name, (least, most) in (
            ("cell edges", report.cell_edges_mm),
            ("strut lengths", report.strut_lengths_mm),
            ("strut radii", report.strut_radii_mm),
        )
    ]


def _cells(_: argparse.Namespace) -> None:
    from ..design.cells import LIBRARY

    print(f"{'name':<12}{'nodes':>6}{'struts':>8}{'Maxwell':>9}  deformation")
    for cell in LIBRARY.values():
        print(
            f"{cell.name:<12}{len(cell.nodes):>6}{len(cell.struts):>8}"
            f"{cell.maxwell_number:>9}  {cell.deformation_mode}"
        )


def _check(options: argparse.Namespace) -> None:
    from ..io.solid import read_triangles
    from ..reports.mesh_report import mesh_report

    report = mesh_report(read_triangles(options.file, options.unit))
    print_rows(("file", str(options.file)), *report.rows())


def _yes(value: bool) -> str:
    return "yes" if value else "no"


def _bodies(bodies: int, voids: int) -> str:
    text = f"{bodies:,} " + ("body" if bodies == 1 else "bodies")
    return text + (f", {voids:,} closed " + ("void" if voids == 1 else "voids")) * bool(voids)


class _Progress:
    """Shows the stage and the fraction done on one line of standard error, if it is a terminal."""

    def __init__(self, quiet: bool) -> None:
        self._visible = not quiet and sys.stderr.isatty()
        self._shown = ""

    def __enter__(self) -> ProgressCallback:
        # Always a callback, shown or not: with one, long compiled calls run beside the main
        # thread, which can then be interrupted.
        return self._update

    def __exit__(self, *_: object) -> None:
        if self._shown:
            print("\r" + " " * len(self._shown) + "\r", end="", file=sys.stderr, flush=True)

    def _update(self, fraction: float, stage: str) -> None:
        text = f"{100 * fraction:3.0f} % {stage}"
        if self._visible and text != self._shown:
            padding = " " * (len(self._shown) - len(text))
            print(f"\r{text}{padding}", end="", file=sys.stderr, flush=True)
            self._shown = text

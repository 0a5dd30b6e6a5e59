# SPDX-License-Identifier: LGPL-2.1-or-later
"""The command ``volfrep size``: struts as thick as what the part carries asks for.

numpy and the engine are imported inside the functions, as in `command`.
"""

from __future__ import annotations

import argparse
import json
import signal
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from types import FrameType
from typing import TYPE_CHECKING, Any

from ..util.errors import Cancelled, VolfrepError
from ..util.progress import ProgressCallback
from .files import check_files, read_part
from .parameter_options import add_parameters, specification
from .telling import Progress, print_rows, print_warnings, tell

if TYPE_CHECKING:
    from ..jobs.sizing import Goal, SizedPart
    from ..mechanics.materials import SolidMaterial
    from ..sizing.optimise import Step

_TEXT = "Fill a solid with a lattice whose struts are sized for its load cases."
COLOURS = ("radius", "stress", "buckling", "displacement")


def add_command(add: Callable[[str, Callable[[argparse.Namespace], None], str], Any]) -> None:
    """Add the command with `cli`'s own function for that."""
    parser = add("size", _size, _TEXT)
    option = parser.add_argument
    option("part", metavar="PART", help="the closed solid, as for fill")
    option("--unit", help="of the file's lengths, as for fill")
    option("--loads", required=True, metavar="FILE.toml", help="load cases, see docs/loads.md")
    option(
        "-o", "--output", required=True, metavar="FILE",
        help="the part with its sized lattice: .stl, .3mf, .ply or .obj",
    )  # fmt: skip
    option("--radii", metavar="FILE.csv", help="the radii at the nodes, as --radius-field reads it")
    option("--report", metavar="FILE.json", help="write the figures, before and after")
    option("--plot", metavar="FILE.svg", help="draw mass and limits, step by step")
    option("--quiet", action="store_true", help="print nothing but errors")
    goal = parser.add_argument_group(
        "what is wanted: limits for the least mass, or the most stiffness at a mass"
    ).add_argument
    goal("--max-stress", type=float, metavar="MPA", help="largest von Mises stress in a strut")
    goal("--safety", type=float, metavar="S", help="the same as the material's yield over this")
    goal("--max-displacement", type=float, metavar="MM", help="of any node, in any case")
    goal("--buckling", type=float, metavar="F", help="loads times this buckle no strut")
    goal("--min-frequency", type=float, metavar="HZ", help="lowest natural frequency")
    goal(
        "--strut-mass", type=float, metavar="G",
        help="of the struts, for the most stiffness (default: what the strut radius makes)",
    )  # fmt: skip
    goal("--thinnest", type=float, metavar="MM", help="smallest radius (default: half the radius)")
    goal("--thickest", type=float, metavar="MM", help="largest radius (default: what cells bear)")
    goal(
        "--smooth", type=float, default=0.0, metavar="S",
        help="share of its neighbours in each node's radius, 0 to 0.9 (default 0)",
    )  # fmt: skip
    goal("--steps", type=int, default=60, metavar="N", help="at most (default 60)")
    goal("--no-proof", action="store_true", help="do not let CalculiX solve the final design")
    seen = parser.add_argument_group("a picture of it").add_argument
    seen("--picture", metavar="FILE.png", help="the struts in colour (needs pyvista)")
    seen("--colour", choices=COLOURS, help="what the colour tells (default radius)")
    seen("--case", metavar="NAME", help="of which load case (default: the first)")
    seen("--deformed", type=float, metavar="F", help="displacements drawn so many times as large")
    add_parameters(parser)


def _size(options: argparse.Namespace) -> None:
    spec = specification(options)
    check_files(options)
    out = Path(options.output)

    from ..io.write import mesh_writer, write_mesh

    mesh_writer(out)
    if options.picture is not None:
        from ..reports.picture import check_picture

        check_picture(options.picture)
    elif options.colour or options.case or options.deformed is not None:
        raise VolfrepError("--colour, --case and --deformed say what --picture shows: give it.")
    if options.plot is not None:
        from ..reports.sizing_plot import check_plot

        check_plot(options.plot)
    if options.write_spec is not None and options.radii is None:
        raise VolfrepError("A specification names the file of its radii: give --radii, too.")
    if options.steps < 1:
        raise VolfrepError(f"There must be at least one step, not {options.steps}.")

    from ..jobs.infill import Infill
    from ..jobs.sizing import size, write_radii
    from ..loads.load_file import read_load_cases
    from ..reports.sizing_report import sizing_rows
    from ..util.cache import StageCache
    from ..util.files import replacing

    solid = read_part(options, spec.cell_size)
    loads = read_load_cases(options.loads, solid)
    if spec.density != loads.material.density:
        from dataclasses import replace

        spec = replace(spec, density=loads.material.density)
    goal = _goal(options, loads.material)
    cache = StageCache()
    start = time.perf_counter()
    with Progress(options.quiet) as progress:
        with _stopping(progress) as asked:
            made = size(
                solid, spec, loads, goal, most_steps=options.steps, prove_it=not options.no_proof,
                progress=asked, cache=cache, watch=_teller(options.quiet),
            )  # fmt: skip
        seconds = time.perf_counter() - start
        result = Infill(solid, made.spec, progress=progress, cache=cache).result
    write_mesh(result.mesh, out)
    if options.radii is not None:
        write_radii(made, options.radii)
        _write_specification(options, made)
    if options.report is not None:
        figures = {"sizing": made.report, "part": result.report.as_dict()}
        with replacing(options.report) as file:
            file.write(json.dumps(figures, indent=2).encode() + b"\n")
        options.report = None
    if options.plot is not None:
        from ..reports.sizing_plot import write_sizing_plot

        write_sizing_plot(made.report, options.plot)
    if options.picture is not None:
        _picture(options, made)
    print_warnings(made.report["notes"])
    tell(result.report, options)
    if not options.quiet:
        print_rows(*sizing_rows(made.report), ("sizing time", f"{seconds:.1f} s"))


@contextmanager
def _stopping(progress: ProgressCallback) -> Iterator[ProgressCallback]:
    """A progress that says stop after Ctrl-C, so that the best design so far is kept.

    Raises:
        KeyboardInterrupt: there was no design yet, or Ctrl-C came again.
    """
    stopped = False

    def stop(number: int, frame: FrameType | None) -> None:
        nonlocal stopped
        if stopped:
            raise KeyboardInterrupt
        del number, frame
        stopped = True

    def told(fraction: float, stage: str) -> bool | None:
        return False if stopped else progress(fraction, stage)

    if threading.current_thread() is not threading.main_thread():
        yield told
        return
    before = signal.signal(signal.SIGINT, stop)
    try:
        yield told
    except Cancelled as error:
        raise KeyboardInterrupt from error
    finally:
        signal.signal(signal.SIGINT, before)


def _goal(options: argparse.Namespace, material: SolidMaterial) -> Goal:
    from ..jobs.sizing import Goal
    from ..sizing.analysis import Limits

    stress = options.max_stress
    if options.safety is not None:
        if stress is not None:
            raise VolfrepError("--max-stress and --safety say the same: give one of them.")
        if material.yield_stress is None:
            raise VolfrepError(
                f"The material '{material.name}' has no yield stress for --safety: give "
                "--max-stress, or yield_stress in the load file."
            )
        if not options.safety > 0.0:
            raise VolfrepError(f"--safety must be above 0, not {options.safety:g}.")
        stress = material.yield_stress / options.safety
    limits = Limits(stress, options.max_displacement, options.buckling, options.min_frequency)
    volume = None
    if options.strut_mass is not None:
        if not options.strut_mass > 0.0:
            raise VolfrepError(f"--strut-mass must be above 0 g, not {options.strut_mass:g}.")
        volume = options.strut_mass * 1000.0 / material.density
    return Goal(
        limits, volume, options.thinnest, options.thickest, options.smooth
    )  # fmt: skip


def _teller(quiet: bool) -> Callable[[int, Step], bool] | None:
    """Tells every step on standard error, if it is a terminal."""
    if quiet or not sys.stderr.isatty():
        return None

    def tell_step(number: int, step: Step) -> bool:
        uses = ", ".join(f"{name} {use:.0%}" for name, use in step.uses.items())
        text = f"step {number + 1}: struts {step.volume:,.0f} mm3" + f", {uses}" * bool(uses)
        print(f"\r{text:<79}", file=sys.stderr)
        return True

    return tell_step


def _write_specification(options: argparse.Namespace, made: SizedPart) -> None:
    if options.write_spec is None:
        return
    from dataclasses import replace

    from ..design.parameters.spec_file import write_values
    from ..design.parameters.specification import values_of

    assert made.spec.radius_grading is not None
    grading = replace(made.spec.radius_grading, field=str(options.radii))
    write_values(values_of(replace(made.spec, radius_grading=grading)), options.write_spec)


def _picture(options: argparse.Namespace, made: SizedPart) -> None:
    from ..reports.sizing_picture import sizing_picture

    names = [case.name for case in made.model.problem.cases]
    if options.case is not None and options.case not in names:
        raise VolfrepError(
            f"There is no load case '{options.case}': choose one of {', '.join(names)}."
        )
    sizing_picture(
        made.model, made.sized.analysis, options.picture, colour=options.colour or "radius",
        case=names.index(options.case) if options.case is not None else 0,
        deformed=options.deformed or 0.0,
    )  # fmt: skip

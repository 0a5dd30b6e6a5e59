# SPDX-License-Identifier: LGPL-2.1-or-later
"""A filled part whose struts are sized for what it carries."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from ...design.parameters.specification import values_of
from ...design.spec import LatticeSpec
from ...loads.load_cases import LoadCases
from ...mesh.triangle_mesh import TriangleMesh
from ...reports.sizing_report import sizing_report
from ...sizing.analysis import Analysis, Limits, Problem, analyse
from ...sizing.model import SizingModel
from ...sizing.optimise import Sized, Step, Watch, lightest, stiffest, thicken, uniform
from ...sizing.proof import Proved, correct_problem, prove_design
from ...sizing.strut_state import StrutState, strut_states
from ...util.cache import StageCache
from ...util.errors import Cancelled, VolfrepError
from ...util.files import replacing
from ...util.progress import Monitor, ProgressCallback
from ...util.types import Floats
from ..graphs.frame import fixed_graph
from ..infill import Infill
from ..targets import infill_of, solve_target
from .goal import Goal
from .notes import (
    free_motions,
    hardly_beams,
    left_out,
    limit_not_held,
    not_confirmed,
    stiff_skin,
    stressed_skin,
    too_dense,
    unproved,
)
from .part_model import given_radii, part_model, spacing
from .removal import RADIUS_STEP, SLACK, Thinned, field_points, radius_field, without_thin_struts

#: So many times a design is made thicker because of what CalculiX finds.
CORRECTIONS = 3


@dataclass(frozen=True, eq=False)
class SizedPart:
    """A lattice whose radii follow what the part carries.

    Attributes:
        spec: of an ordinary graded lattice: its radius is a field of those at the nodes.
        points: (n, 3) the nodes, in the part's coordinates as a field has them, mm.
        radii: (n,) mm.
        model: what was solved.
        sized: the design, and how it was come to.
        before: the lattice of one radius with the same volume.
        even: the lattice of one radius that holds the same limits, and whether it does; None
            without limits.
        report: the figures.
    """

    spec: LatticeSpec
    points: Floats
    radii: Floats
    model: SizingModel
    sized: Sized
    before: Analysis
    even: tuple[Analysis, bool] | None
    report: dict[str, Any] = field(repr=False)

    @property
    def states(self) -> tuple[StrutState, ...]:
        """The design's struts in every load case: radius, stress, buckling use, displacement."""
        return strut_states(self.model.problem, self.sized.analysis)


def size(
    solid: TriangleMesh,
    spec: LatticeSpec,
    loads: LoadCases,
    goal: Goal | None = None,
    *,
    most_steps: int = 60,
    prove_it: bool = True,
    progress: ProgressCallback | None = None,
    monitor: Monitor | None = None,
    cache: StageCache | None = None,
    watch: Callable[[int, Step], bool] | None = None,
) -> SizedPart:
    """Size the struts of a part's lattice for its load cases.

    Args:
        solid: checked closed mesh, mm.
        spec: what it is filled with; its radius is what the design begins with, or that of its
            target.
        loads: the material, and what the part carries.
        goal: least mass within limits, or most stiffness at a volume.
        most_steps: of the search.
        prove_it: let CalculiX solve the final design, where it is installed.
        progress: called with the fraction done and the stage; returning False cancels before
            there is a design, and afterwards keeps the best.
        monitor: in place of one of its own.
        cache: keeps the costly stages of the part.
        watch: told of every step; returning False keeps the best so far.

    Raises:
        VolfrepError: the specification does not fit the part, nothing lies where a load acts, the
            part is not held, or the goal cannot be.
        Cancelled: the callback said so before there was a design.
    """
    goal = goal or Goal()
    if goal.limits.frame_buckling is None:  # no struts buckle, neither one nor many together
        limits = replace(goal.limits, frame_buckling=goal.limits.buckling)
        goal = replace(goal, limits=limits)
    monitor = monitor or Monitor(progress)
    if goal.limits.any and goal.volume is not None:
        raise VolfrepError("Give limits for the least mass, or a volume for the most stiffness.")
    if not 0.0 <= goal.smooth <= 0.9:
        raise VolfrepError(f"The smoothing must be from 0 to 0.9, not {goal.smooth:g}.")
    start = time.perf_counter()
    cache = cache or StageCache()
    notes: list[str] = []
    spec = _without_target(solid, spec, goal, cache, progress, notes)
    spec = replace(fixed_graph(spec), remove_below=0.0)  # all are sized; which go is decided anew
    infill = infill_of(solid, spec, monitor=monitor, cache=cache)
    model = part_model(infill, loads, goal, cache)
    problem = model.problem
    shape = problem.radii
    first = np.clip(given_radii(model.wireframe), problem.low, problem.high)
    seconds = {"model": time.perf_counter() - start}
    start = time.perf_counter()

    def told(number: int, step: Step) -> bool:
        try:
            monitor.tick((number + 1) / most_steps / (2 if goal.remove_thin else 1))
        except Cancelled:
            return False  # there is a design: the best so far is kept
        return watch is None or watch(number, step)

    taken: Thinned | None = None
    with monitor.stage("sizing", 0.4, 0.95):
        with _named(problem):
            sized = whole = _designed(problem, goal, first, most_steps, told)
            even = uniform(problem, goal.limits) if goal.limits.any else None
        if even is not None:
            sized = whole = _no_worse(sized, even)
        if goal.remove_thin and sized.stopped != "cancelled":
            taken, sized = _without_thin(
                infill, loads, goal, model, sized, first, most_steps, told, cache, notes
            )
    unthinned = model
    if taken is not None:
        model, problem = taken.model, taken.model.problem
    if not sized.holds:
        notes.append(limit_not_held(problem, sized.analysis))
    notes += stressed_skin(model, sized.analysis, goal.limits)
    notes += free_motions(model.problem)
    notes += left_out(spec) + stiff_skin(model, goal.limits)
    if sized.stopped == "cancelled":
        notes.append("The search was cancelled: this is the best design so far.")
    with _named(problem):
        final = _stored(problem, sized.analysis.radii, goal.limits)

    def solve_again(design: Analysis) -> Proved | None:
        cell, length = spec.fitted_cell, spacing(infill)
        solved_one = replace(model, problem=problem)
        return prove_design(solved_one, cell, length, design, loads.material, notes, monitor)

    proof = None
    if prove_it and sized.stopped != "cancelled":
        try:
            with monitor.stage("proof", 0.95, 1.0):
                proof = solve_again(final)
                for _ in range(CORRECTIONS):
                    if proof is None or proof.holds(goal.limits, final) or not sized.holds:
                        break
                    # Where CalculiX finds more than is allowed, struts become that much thicker.
                    problem, stricter = correct_problem(problem, goal.limits, final, proof)
                    found, holds = thicken(problem, stricter, final.radii)
                    final, proof = _stored(problem, found.radii, goal.limits), None
                    proof = solve_again(final)
                    if not holds:
                        break
                if proof is not None and sized.holds and not proof.holds(goal.limits, final):
                    sized = replace(sized, holds=False)
                    notes.append(unproved(problem, proof.uses(goal.limits, final), final))
        except Cancelled:
            proof = None
            notes.append("CalculiX was cancelled: no other solver has proved this design.")
        except VolfrepError as error:  # minutes of work are not lost to another program
            proof = None
            notes.append(f"{error} No other solver has proved this design.")
    if proof is not None:
        doubts = proof.figures["doubts"]
        doubts += too_dense(infill, model, final.radii)  # beams are no proof of beams there
        proof.figures["confirmed"] = not doubts
        notes += not_confirmed(doubts)
    notes += hardly_beams(infill, model, final.radii, spacing(infill))
    radii = final.radii
    sized = replace(sized, analysis=final)
    full = unthinned.problem
    same = shape.scaled_to(
        np.full(len(first), float(first.mean())),
        final.volume, np.full(len(first), 1e-3 * float(first.min())), full.high,
    )  # fmt: skip
    with _named(full):
        before, _ = analyse(full, same, goal.limits)
    seconds["sizing"] = time.perf_counter() - start
    if taken is not None:
        spec, radii = taken.spec, taken.of_all(radii)
    points = field_points(infill, unthinned)
    graded = replace(
        spec, strut_radius=float(np.median(radii)), radius_grading=radius_field(points, radii)
    )  # fmt: skip
    figures = None
    if proof is not None:
        figures = {**proof.figures, "uses": proof.uses(goal.limits, final)}
    report = sizing_report(
        loads, model, sized, before, even, figures,
        seconds=seconds, notes=tuple(notes),
        unthinned=None if taken is None else (whole.analysis, taken.struts),
    )  # fmt: skip
    return SizedPart(graded, points, radii, model, sized, before, even, report)


def solve_struts(
    solid: TriangleMesh,
    spec: LatticeSpec,
    loads: LoadCases,
    *,
    progress: ProgressCallback | None = None,
    cache: StageCache | None = None,
) -> tuple[SizingModel, Analysis]:
    """What a part's struts do as they are: nothing is sized.

    Args:
        solid: checked closed mesh, mm.
        spec: what it is filled with, graded or not.
        loads: the material, and what the part carries.
        progress: called with the fraction done and the stage; returning False cancels.
        cache: keeps the costly stages of the part.

    Raises:
        VolfrepError: as `size`.
        Cancelled: the callback said so.
    """
    cache = cache or StageCache()
    spec = _without_target(solid, spec, Goal(), cache, progress, [])
    infill = infill_of(solid, spec, monitor=Monitor(progress), cache=cache)
    frame = infill.struts
    radii = np.zeros(len(frame.nodes))
    radii[frame.struts] = frame.radii
    used = radii[radii > 0.0]
    goal = Goal(radius_min=0.999 * float(used.min()), radius_max=1.001 * float(used.max()))
    model = part_model(infill, loads, goal, cache)
    return model, analyse(model.problem, np.maximum(radii, goal.radius_min or 0.0), Limits())[0]


def _stored(problem: Problem, radii: Floats, limits: Limits) -> Analysis:
    """A design as files keep it: radii in whole steps, not thinner than they were."""
    steps = np.ceil(radii / RADIUS_STEP - 1e-6) * RADIUS_STEP
    return analyse(problem, steps, limits)[0]


def write_radii(part: SizedPart, path: str | os.PathLike[str]) -> None:
    """Write the radii as a table that ``--radius-field`` reads: x, y, z and radius, mm."""
    with replacing(path) as file:
        file.write(b"x,y,z,radius\n")
        table = np.column_stack([part.points, part.radii])
        file.writelines(b"%.9g,%.9g,%.9g,%.6f\n" % tuple(row) for row in table.tolist())


def values_with_radii(part: SizedPart, path: str | os.PathLike[str]) -> dict[str, Any]:
    """What a specification's file says of a sized part whose radii are in a file of their own."""
    assert part.spec.radius_grading is not None
    grading = replace(part.spec.radius_grading, field=str(path))
    return values_of(replace(part.spec, radius_grading=grading))


def _without_target(
    solid: TriangleMesh,
    spec: LatticeSpec,
    goal: Goal,
    cache: StageCache,
    progress: ProgressCallback | None,
    notes: list[str],
) -> LatticeSpec:
    """The specification with the radius of its target, and what that means in a sentence."""
    target = spec.target
    if target is None or spec.output == "domain":
        return replace(spec, target=None)
    found = solve_target(solid, spec, progress=progress, cache=cache, meshed=False).spec
    kept = "the limits now say how thick struts are"
    if not goal.limits.any:
        kept = "struts have their mass, distributed anew" if goal.volume is None else "it began so"
    notes.append(
        f"The target, a {target.called} of {target.value:.5g}, asks for struts of "
        f"{found.strut_radius:.4g} mm: {kept}."
    )
    return replace(found, target=None)


def _designed(problem: Problem, goal: Goal, first: Floats, most_steps: int, watch: Watch) -> Sized:
    """The design."""
    if goal.limits.any:
        return lightest(problem, goal.limits, first, most_steps=most_steps, watch=watch)
    volume = problem.radii.volume(first) if goal.volume is None else goal.volume
    weights = None if goal.weights is None else np.array(goal.weights, float)
    if weights is not None and len(weights) != len(problem.cases):
        raise VolfrepError(
            f"There are {len(problem.cases)} load cases and {len(weights)} weights: give one for "
            "each."
        )
    return stiffest(problem, volume, first, weights=weights, most_steps=most_steps, watch=watch)


@contextmanager
def _named(problem: Problem) -> Iterator[None]:
    """Adds to a refusal which way the supports let the part go, if any."""
    try:
        yield
    except Cancelled:
        raise
    except VolfrepError as error:
        free = free_motions(problem)
        if not free:
            raise
        raise VolfrepError(" ".join([str(error), *free])) from error


def _no_worse(sized: Sized, even: tuple[Analysis, bool]) -> Sized:
    """The design, or one radius for all where that holds the limits with less."""
    one, holds = even
    if holds and (not sized.holds or one.volume < sized.analysis.volume):
        return replace(sized, analysis=one, holds=True)
    return sized


def _without_thin(
    infill: Infill,
    loads: LoadCases,
    goal: Goal,
    model: SizingModel,
    sized: Sized,
    first: Floats,
    most_steps: int,
    watch: Watch,
    cache: StageCache,
    notes: list[str],
) -> tuple[Thinned | None, Sized]:
    """The design without its thin struts, where it is better; else the design as it is."""
    whole, before = sized.analysis, len(sized.steps)
    wanted = goal if goal.limits.any else replace(goal, volume=whole.volume)
    reason = "none is as thin as allowed and carries little"
    for slack in SLACK:
        try:
            taken = without_thin_struts(infill, loads, goal, model, whole, slack, first, cache)
            if taken is None:
                continue
            found = _designed(
                taken.model.problem, wanted, taken.radii[taken.rows], most_steps,
                lambda number, step: watch(before + number, step),
            )  # fmt: skip
        except VolfrepError as error:
            reason = str(error).rstrip(".")
            continue
        if goal.limits.any:
            is_better = found.holds and found.analysis.volume < whole.volume
        else:
            is_better = found.analysis.compliance.sum() < whole.compliance.sum()
        if is_better:
            return taken, replace(found, steps=sized.steps + found.steps)
        reason = "the lattice would be no better without them"
        if found.stopped == "cancelled":
            break
    notes.append(f"No struts were taken away: {reason}.")
    return None, sized

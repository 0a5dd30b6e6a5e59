# SPDX-License-Identifier: LGPL-2.1-or-later
"""A filled part whose struts are sized for what it carries."""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from ...design.grading import RadiusGrading
from ...design.networks import CellNetwork
from ...design.parameters.specification import values_of
from ...design.profile import Profile
from ...design.scattered_field import PointField
from ...design.spec import LatticeSpec
from ...design.spec_parts import largest_radius
from ...grid.placement import NUDGE
from ...grid.strut_graph import Wireframe
from ...loads.load_cases import LoadCases
from ...mesh.triangle_mesh import TriangleMesh
from ...reports.sizing_report import sizing_report
from ...sizing.analysis import Analysis, Limits, Problem, analysed
from ...sizing.design_proof import proved, stricter_limits
from ...sizing.model import SizingModel, elastic, feet_of, held_facets, sizing_model
from ...sizing.node_radii import smoothing
from ...sizing.optimise import Sized, Step, Watch, lightest, scaled_to_limits, stiffest, uniform
from ...sizing.skin import skin_model
from ...sizing.strut_state import StrutState, strut_states
from ...spatial.proximity import closest_points
from ...util.cache import StageCache
from ...util.errors import Cancelled, VolfrepError
from ...util.files import replacing
from ...util.progress import Monitor, ProgressCallback
from ...util.types import Floats
from ..infill import Infill
from ..networks.frame import fixed_graph, median_length
from ..networks.radius import THICKEST
from ..targets import aimed, infill_of
from .goal import Goal
from .notes import left_out, not_held, stressed_skin

#: Edges of the skin's triangles over the cell size, and over its thickness at least.
SKIN_EDGE, SKIN_EDGE_LEAST = 0.5, 1.5
#: Struts of a network are made so many times as thick as they are at most, where nothing else is
#: said: those that share no joint run into each other then.
TIMES_THICKER = 2.0
#: So many times a design is made thicker because of what CalculiX finds.
CORRECTIONS = 2
#: Radii are stored in steps of this, mm, as files keep them.
RADIUS_STEP = 1e-6


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
    monitor = monitor or Monitor(progress)
    if goal.limits.any and goal.volume is not None:
        raise VolfrepError("Give limits for the least mass, or a volume for the most stiffness.")
    if not 0.0 <= goal.smooth <= 0.9:
        raise VolfrepError(f"The smoothing must be from 0 to 0.9, not {goal.smooth:g}.")
    start = time.perf_counter()
    cache = cache or StageCache()
    notes: list[str] = []
    spec = _without_target(solid, spec, goal, cache, progress, notes)
    spec = fixed_graph(spec)
    infill = infill_of(solid, spec, monitor=monitor, cache=cache)
    model = _model(infill, loads, goal, cache)
    problem = model.problem
    shape = problem.radii
    first = np.clip(_given_radii(model.wireframe), problem.low, problem.high)
    seconds = {"model": time.perf_counter() - start}
    start = time.perf_counter()

    def told(number: int, step: Step) -> bool:
        try:
            monitor.tick((number + 1) / most_steps)
        except Cancelled:
            return False  # there is a design: the best so far is kept
        return watch is None or watch(number, step)

    with monitor.stage("sizing", 0.4, 0.95):
        sized, even = _designed(problem, goal, first, most_steps, told)
    if not sized.holds:
        notes.append(not_held(problem, sized.analysis))
    notes += stressed_skin(model, sized.analysis, goal.limits)
    notes += left_out(spec)
    if sized.stopped == "cancelled":
        notes.append("The search was cancelled: this is the best design so far.")
    final = _stored(problem, sized.analysis.radii, goal.limits)

    def solve_again(design: Analysis) -> dict[str, Any] | None:
        cell, length = spec.fitted_cell, _length(infill)
        return proved(model, cell, length, design, loads.material, notes, monitor)

    proof = None
    if prove_it and sized.stopped != "cancelled":
        try:
            with monitor.stage("proof", 0.95, 1.0):
                proof = solve_again(final)
                for _ in range(CORRECTIONS):
                    stricter = stricter_limits(goal.limits, final, proof)
                    if proof is None or stricter == goal.limits or not sized.holds:
                        break
                    # Where CalculiX finds more than is allowed, the limits are that much stricter.
                    found, _ = scaled_to_limits(problem, stricter, final.radii)
                    final = _stored(problem, found.radii, goal.limits)
                    proof = solve_again(final)
                if stricter_limits(goal.limits, final, proof) != goal.limits and sized.holds:
                    notes.append(
                        "CalculiX finds more of a limit used than is allowed, even in a thicker "
                        "design: see how far the two are apart."
                    )
        except Cancelled:
            proof = None
            notes.append("CalculiX was cancelled: no other solver has proved this design.")
        except VolfrepError as error:  # minutes of work are not lost to another program
            proof = None
            notes.append(f"{error} No other solver has proved this design.")
    radii = final.radii
    sized = replace(sized, analysis=final)
    same = shape.scaled_to(
        np.full(len(radii), float(first.mean())),
        final.volume, np.full(len(radii), 1e-3 * float(first.min())), problem.high,
    )  # fmt: skip
    before, _ = analysed(problem, same, goal.limits)
    seconds["sizing"] = time.perf_counter() - start
    points = model.wireframe.nodes
    if infill.placement.is_cut:
        points = points - NUDGE * spec.cell_size
    graded = replace(
        spec, strut_radius=float(np.median(radii)), radius_grading=radius_field(points, radii)
    )  # fmt: skip
    report = sizing_report(
        loads, model, sized, before, even, proof, seconds=seconds, notes=tuple(notes)
    )
    return SizedPart(graded, points, radii, model, sized, before, even, report)


def solved(
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
    model = _model(infill, loads, goal, cache)
    return model, analysed(model.problem, np.maximum(radii, goal.radius_min or 0.0), Limits())[0]


def _stored(problem: Problem, radii: Floats, limits: Limits) -> Analysis:
    """A design as files keep it: radii in whole steps, not thinner than they were."""
    steps = np.ceil(radii / RADIUS_STEP - 1e-6) * RADIUS_STEP
    return analysed(problem, steps, limits)[0]


def radius_field(points: Floats, radii: Floats) -> RadiusGrading:
    """Radii at nodes as a grading: a field of mm, each value its own radius."""
    low, high = float(radii.min()), float(radii.max())
    if high - low < RADIUS_STEP:
        high = low + RADIUS_STEP
    return RadiusGrading(
        "field", Profile("linear", low, high), field=PointField(points, radii, "sizing"),
        curve=((low, low), (high, high)),
    )  # fmt: skip


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
    found = aimed(solid, spec, progress=progress, cache=cache, meshed=False).spec
    kept = "the limits now say how thick struts are"
    if not goal.limits.any:
        kept = "struts have their mass, distributed anew" if goal.volume is None else "it began so"
    notes.append(
        f"The target, a {target.called} of {target.value:.5g}, asks for struts of "
        f"{found.strut_radius:.4g} mm: {kept}."
    )
    return replace(found, target=None)


def _model(infill: Infill, loads: LoadCases, goal: Goal, cache: StageCache) -> SizingModel:
    """The part as it is solved."""
    spec, material = infill.spec, loads.material
    if spec.output == "domain":
        raise VolfrepError("The output 'domain' holds no lattice to size: choose part or lattice.")
    if spec.fillet:
        raise VolfrepError("Struts with fillets cannot be sized: set the fillet to 0.")
    widths = getattr(spec.network, "widths", ())
    if isinstance(spec.network, CellNetwork):
        widths = spec.unit_cell().widths
    if len(widths):
        raise VolfrepError(
            "Sizing gives each node one radius, and these struts have widths of their own: choose "
            "a cell without."
        )
    wireframe, clipped = infill.struts, infill.axes
    if spec.radius_grading is not None:
        # Which ends at a wall are too short for a beam goes by the radius: those of the
        # specification's own, so that a design is solved as it was sized.
        plain = infill_of(
            infill.solid, replace(spec, radius_grading=None), monitor=infill.monitor, cache=cache
        )
        if np.array_equal(plain.struts.struts, wireframe.struts):
            clipped = plain.axes
    own = float(np.median(wireframe.radii))
    least = goal.radius_min if goal.radius_min is not None else 0.5 * own
    length, borne = _length(infill), 0.0
    if spec.network is None:
        bears = 0.98 * largest_radius(spec.cell_size, spec.fillet)
    else:
        # Where a network's struts leave each other no room they are united.
        bears = max(THICKEST * length, own)
        borne = own
    usual = bears if spec.network is None else min(bears, TIMES_THICKER * own)
    most = usual if goal.radius_max is None else min(goal.radius_max, bears)
    if not 0.0 < least <= most:
        raise VolfrepError(
            f"Radii from {least:.4g} to {most:.4g} mm make no sense: the smallest must be above 0 "
            "and below the largest, which the cells do not bear beyond "
            f"{bears:.4g} mm."
        )
    skin = None
    if spec.with_skin:
        apart = spec.cell_size if spec.network is None else 2.0 * length
        edge = max(SKIN_EDGE * apart, SKIN_EDGE_LEAST * spec.shell)
        with infill.monitor.stage("skin", 0.3, 0.4):
            skin = skin_model(
                infill.solid, _thickness(infill.solid, spec), edge, elastic(material),
                infill.domain.openings,
                feet_of(wireframe, clipped, infill.domain.mesh, _given_radii(wireframe)),
                infill.monitor, held=held_facets(infill.solid, loads.cases),
            )  # fmt: skip
    model = sizing_model(
        wireframe, clipped, spec.fitted_cell, length, material, loads.cases,
        bounds=(least, most), borne=borne, skin=skin, solid=infill.solid,
    )  # fmt: skip
    if goal.smooth:
        smoother = smoothing(wireframe.struts.astype(np.int64), len(wireframe.nodes), goal.smooth)
        model = replace(model, problem=replace(model.problem, smoother=smoother))
    return model


def _length(infill: Infill) -> float:
    """L, mm: of the cells, or a network's median length of struts, which stands for it."""
    spec = infill.spec
    return spec.cell_size if spec.network is None else median_length(infill.struts)


def _thickness(solid: TriangleMesh, spec: LatticeSpec) -> float | Callable[[Floats], Floats]:
    """A skin's thickness, mm, or at points of the part's surface where it is not even."""
    if spec.skin is None or spec.skin.is_even:
        return spec.shell
    below = spec.skin.below(solid)
    # Where a face is open there are no shells: any thickness will do.
    below = np.where(below > 0.0, below, spec.shell)
    return lambda points: np.asarray(below[closest_points(solid, points)[2]])


def _given_radii(wireframe: Wireframe) -> Floats:
    """(n,) mm, the radii at the nodes that the specification says."""
    result = np.zeros(len(wireframe.nodes))
    result[wireframe.struts] = wireframe.radii
    return result


def _designed(
    problem: Problem, goal: Goal, first: Floats, most_steps: int, watch: Watch
) -> tuple[Sized, tuple[Analysis, bool] | None]:
    """The design, and with limits the lattice of one radius that holds them."""
    if goal.limits.any:
        sized = lightest(problem, goal.limits, first, most_steps=most_steps, watch=watch)
        return sized, uniform(problem, goal.limits)
    volume = problem.radii.volume(first) if goal.volume is None else goal.volume
    weights = None if goal.weights is None else np.array(goal.weights, float)
    if weights is not None and len(weights) != len(problem.cases):
        raise VolfrepError(
            f"There are {len(problem.cases)} load cases and {len(weights)} weights: give one for "
            "each."
        )
    made = stiffest(problem, volume, first, weights=weights, most_steps=most_steps, watch=watch)
    return made, None

# SPDX-License-Identifier: LGPL-2.1-or-later
"""A filled part whose struts are sized for what it carries."""

from __future__ import annotations

import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from ...design.spec import LatticeSpec
from ...loads.load_cases import LoadCases, refuse_heat, with_weights
from ...mesh.triangle_mesh import TriangleMesh
from ...reports.sizing_report import sizing_report
from ...reports.sizing_results import sizing_results
from ...sizing.analysis import Analysis, Limits, Problem, analyse
from ...sizing.discrete_radii import list_figures, of_list
from ...sizing.model import SizingModel
from ...sizing.optimise import HOLDS, Sized, Step, Watch, lightest, stiffest, thicken, uniform
from ...sizing.proof import PROVED, Proved, correct_problem, prove_design
from ...sizing.stress_ratios import StressRatios
from ...sizing.strut_state import StrutState, strut_states
from ...util.cache import StageCache
from ...util.errors import Cancelled, VolfrepError
from ...util.progress import Monitor, ProgressCallback
from ...util.showing import Shown
from ...util.types import Floats
from ..infill import Infill
from .as_it_is import solve_struts
from .buildable import buildable, checked, flat_struts, without_bridges, without_flat_struts
from .building import Building
from .directions import Along, advice, along_directions, directed
from .goal import Goal
from .governing import Governing, governing
from .notes import (
    free_motions,
    hardly_beams,
    hot,
    left_out,
    limit_not_held,
    not_confirmed,
    other_mass,
    small_dimples,
    stressed_skin,
    telling_free_motions,
    too_dense,
    unproved,
)
from .one_radius import no_worse, of_less_volume, of_one_radius
from .overhanging import building_figures, overhanging_skin
from .part_model import all_struts, given_radii, part_model, without_target
from .printed import printed_figures
from .skin_search import (
    SkinDesign,
    design_skin,
    governing_thickness,
    ratios_of,
    skin_peaks,
    thickness_there,
    weighed,
    with_ratios,
    with_solid_stubs,
    with_this_skin,
)
from .solid_places import filled_notes, solid_places
from .thin_struts import (
    RADIUS_STEP,
    SLACK,
    Thinned,
    field_points,
    radius_field,
    without_thin_struts,
)

#: So many times a design is made thicker because of what CalculiX finds.
CORRECTIONS = 3
#: Struts that use no more than this of a limit after that are proved again: what CalculiX says of
#: them then is less than what it said of thinner ones.
NEARLY = 1.1
#: A skin is held to this part of its limit of stress, as its middle moves a little yet; and is
#: chosen so many times. It holds its limit when that is used no more than so.
MARGIN, SKINS, SKIN_HOLDS = 0.98, 2, 1.01
#: So many times with what CalculiX says of stress, where that is beyond the limit; and for so much
#: less then, as it changes with the skin.
PROVED_SKINS, CHANGES = 3, 0.98
#: The part with its skin is made so many times at most, until its mass and solid places are right.
WEIGHINGS, WEIGHED = 4, 0.005


@dataclass(frozen=True, eq=False, repr=False)
class SizedPart(Shown):
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
        governing: which limit, in which load case, says how thick each strut is.
        skin_governing: which says how thick a sized skin is at each point of its thickness; None
            where it was not sized.
        building: how it is built; None where that does not count.
        report: the figures.
    """

    spec: LatticeSpec
    points: Floats
    radii: Floats
    model: SizingModel
    sized: Sized
    before: Analysis
    even: tuple[Analysis, bool] | None
    governing: Governing
    skin_governing: Governing | None
    building: Building | None
    report: dict[str, Any] = field(repr=False)

    def rows(self) -> list[tuple[str, str]]:
        """Names and values, for people."""
        return [one.line for one in sizing_results(self.report)]

    @property
    def states(self) -> tuple[StrutState, ...]:
        """The design's struts in every load case."""
        return strut_states(self.model.problem, self.sized.analysis, self.governing.rows)


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
    monitor, cache = monitor or Monitor(progress), cache or StageCache()
    refuse_heat(loads)
    loads = with_weights(loads)
    wanted, notes = buildable(checked(goal or Goal()), spec)
    seconds = {"model": 0.0, "sizing": 0.0}

    def designed(spec: LatticeSpec) -> _ProvedDesign:
        start = time.perf_counter()
        task = _prepare(solid, spec, loads, wanted, monitor, cache, progress)
        task.notes.extend(notes)
        seconds["model"] += time.perf_counter() - start
        start = time.perf_counter()
        try:
            return _find_proved(task, most_steps, watch, prove_it)
        finally:
            seconds["sizing"] += time.perf_counter() - start

    def solved(steeper: LatticeSpec) -> Analysis:
        return solve_struts(
            solid, steeper, loads, printing=wanted.printing, progress=progress, cache=cache
        )[1]

    def along() -> list[Along]:
        assert wanted.building is not None
        return along_directions(solid, spec, wanted.building, solved)

    built: list[str] = []
    building, found = wanted.building, None
    every = Infill(solid, replace(all_struts(spec), target=None), monitor=monitor, cache=cache)
    flat, hanging = (0, 0) if building is None else flat_struts(building, every)
    if building is None or not hanging:
        made = designed(spec)
        if flat and wanted.limits.any and made.search.sized.stopped != "cancelled":
            made = without_bridges(
                designed, lambda one, other: one.is_wanted and one.rank < other.rank, made, spec,
                wanted,
            )  # fmt: skip
    else:
        if building.is_free and (found := along()):
            wanted, why = directed(wanted, found)
            built.append(why)
        made, stays = without_flat_struts(designed, lambda one: one.is_wanted, spec, wanted)
        built += stays
        if made.search.sized.stopped != "cancelled":
            built += advice(wanted, made.task.infill, found, along, bool(stays))
    made.task.notes.extend(built)
    start = time.perf_counter()
    problem, volume = made.task.model.problem, made.search.sized.analysis.volume
    with telling_free_motions(problem):
        before = of_one_radius(problem, made.task.goal.limits, made.task.first, volume)
    seconds["sizing"] += time.perf_counter() - start
    return _record(made.task, made.search, made.proof, before, seconds, [*notes, *built])


@dataclass(frozen=True, eq=False)
class _Task:
    """What is sized.

    Attributes:
        infill: the part, with the specification's own radius.
        loads: material and cases.
        goal: with all its limits.
        model: as it is solved.
        first: (n,) radii to begin with, mm.
        notes: what the user is told, so far.
        monitor: of the whole job.
        cache: of the part's stages.
        skin: the skin that was chosen; None where it is the specification's.
        ratios: how many times as stressed as they say skin and struts are; None for once.
    """

    infill: Infill
    loads: LoadCases
    goal: Goal
    model: SizingModel
    first: Floats
    notes: list[str]
    monitor: Monitor
    cache: StageCache
    skin: SkinDesign | None = None
    ratios: StressRatios | None = None


@dataclass(frozen=True, eq=False)
class _Search:
    """What a search ended with.

    Attributes:
        model: what was solved last: without the struts that were taken away.
        sized: the design.
        whole: the design with all struts.
        even: one radius for all that holds the limits, and whether it does; None without limits,
            until `_with_even` where it has more volume.
        taken: what is left of the struts; None where none was taken away.
        any_radii: the design before its radii were those of a list; None without a list.
    """

    model: SizingModel
    sized: Sized
    whole: Sized
    even: tuple[Analysis, bool] | None
    taken: Thinned | None
    any_radii: Analysis | None = None

    @property
    def volume(self) -> float:
        """mm3, of struts and skin."""
        return self.sized.analysis.volume + self.model.skin_volume


@dataclass(frozen=True, eq=False)
class _ProvedDesign:
    """A design as files keep it.

    Attributes:
        task: what was sized, with the skin that was chosen.
        search: what ended with the design.
        proof: CalculiX's figures; None where it was not asked.
        ratios: how many times as stressed as they say CalculiX finds struts and skin, where it is
            worth it to choose them anew with that; None where it is not.
    """

    task: _Task
    search: _Search
    proof: dict[str, Any] | None
    ratios: StressRatios | None

    @property
    def is_wanted(self) -> bool:
        """Whether it holds the limits, or is what there was when the user had enough."""
        sized = self.search.sized
        return sized.holds or sized.stopped == "cancelled"

    @property
    def rank(self) -> tuple[float, float]:
        """Least for the best: the lightest that holds, else what is used of a limit the least."""
        sized = self.search.sized
        over = 0.0
        if not sized.holds:
            uses = self.proof["uses"] if self.proof is not None else sized.analysis.uses
            over = max(uses.values(), default=0.0)
        return over, self.search.volume


def _find_proved(
    task: _Task, most_steps: int, watch: Callable[[int, Step], bool] | None, prove_it: bool
) -> _ProvedDesign:
    """The best design of those with which CalculiX's ratios of stress were tried.

    Raises:
        Cancelled: by the monitor, before there was a design.
    """
    best: _ProvedDesign | None = None
    tried = task
    for _ in range(PROVED_SKINS):
        tried = replace(tried, notes=list(task.notes))
        if task.goal.skin_thinnest is not None:
            tried, search = _with_sized_skin(tried, most_steps, watch)
        else:
            search = _search(tried, most_steps, watch)
        tried.notes.extend(_notes_of(tried, search))
        made = _with_even(tried, search, prove_it)
        if best is None or made.rank < best.rank:
            best = made
        if made.ratios is None:
            break
        tried = replace(tried, ratios=made.ratios)
    assert best is not None
    return best


def _prepare(
    solid: TriangleMesh,
    spec: LatticeSpec,
    loads: LoadCases,
    goal: Goal,
    monitor: Monitor,
    cache: StageCache,
    progress: ProgressCallback | None,
) -> _Task:
    """The part's struts and skin as elements, their supports and loads."""
    notes = hot(loads.cases, goal.limits)
    spec = without_target(solid, spec, goal, cache, progress, notes)
    infill = Infill(solid, all_struts(spec), monitor=monitor, cache=cache)
    model = part_model(infill, loads, goal, cache)
    first = np.clip(given_radii(model.wireframe), model.problem.low, model.problem.high)
    return _Task(infill, loads, goal, model, first, notes, monitor, cache)


def _with_sized_skin(
    task: _Task, most_steps: int, watch: Callable[[int, Step], bool] | None
) -> tuple[_Task, _Search]:
    """The part with a skin whose thickness is chosen with the radii, and its design.

    The skin is as it goes into the file; where it is stressed by more than its limit then, it is
    chosen once more for so much less.

    Raises:
        Cancelled: by the monitor, before there was a design; afterwards it ends the search.
    """
    infill, goal = task.infill, task.goal
    design, limit = task.skin, goal.limits.stress
    spec = infill.spec if design is None else design.spec
    watched = _watched(task, 2.5 * most_steps, watch)
    aim = 1.0 if task.ratios is None else CHANGES
    margin, chosen = MARGIN * aim, task
    for _ in range(SKINS):
        with task.monitor.stage("sizing", 0.4, 0.9), telling_free_motions(task.model.problem):
            design = design_skin(
                infill.solid, spec, task.loads, goal, task.monitor, task.cache, design,
                most_steps=most_steps, watch=watched, margin=margin, ratios=task.ratios,
            )  # fmt: skip
        unfilled: _Task | None = None
        for weighing in range(WEIGHINGS):
            part = Infill(infill.solid, design.spec, monitor=task.monitor, cache=task.cache)
            model = with_ratios(part_model(part, task.loads, goal, task.cache), task.ratios)
            first = design.radii_at(model.wireframe.nodes)
            first = np.clip(first, model.problem.low, model.problem.high)
            if weighing == WEIGHINGS - 1:
                break
            if design.volume is None:
                if (more := with_solid_stubs(design, model, goal, infill.solid)) is None:
                    break
                if unfilled is None:
                    unfilled = replace(task, infill=part, model=model, first=first, skin=design)
                design = more
                continue
            volume = model.problem.radii.volume(first) + model.skin_volume
            if abs(volume / design.volume - 1.0) < WEIGHED:
                break
            design = weighed(design, volume, goal.mirrors)
        chosen = replace(task, infill=part, model=model, first=first, skin=design)
        search = _search(chosen, most_steps, watched)
        if unfilled is not None and search.sized.stopped != "cancelled":
            # A strut a little over its limit is borne by less if all become a little thicker.
            other = _search(unfilled, most_steps, watched)
            if other.sized.holds and (not search.sized.holds or other.volume < search.volume):
                chosen, search, design = unfilled, other, unfilled.skin
        if limit is None or search.sized.stopped == "cancelled":
            break
        used = max(skin_peaks(search.model, search.sized.analysis)) / limit
        if used <= HOLDS * aim:
            break
        margin *= 0.995 * aim / used
    return chosen, search


def _watched(
    task: _Task, steps: float, watch: Callable[[int, Step], bool] | None
) -> Callable[[int, Step], bool]:
    """What is told of each step of a search of so many, and ends it where the job is cancelled."""

    def watched(number: int, step: Step) -> bool:
        try:
            task.monitor.tick((number + 1) / steps)
        except Cancelled:
            return False  # there is a design: the best so far is kept
        return watch is None or watch(number, step)

    return watched


def _search(task: _Task, most_steps: int, watch: Callable[[int, Step], bool] | None) -> _Search:
    """The design with all struts, and with those that carry little taken away where that is asked.

    Raises:
        Cancelled: by the monitor, before there was a design; afterwards it ends the search.
    """
    goal, problem = task.goal, task.model.problem
    watched = _watched(task, most_steps * (2 if goal.remove_thin else 1), watch)
    with task.monitor.stage("sizing", 0.4, 0.95):
        with telling_free_motions(problem):
            if task.skin is None:
                whole = _designed(problem, goal, task.first, most_steps, watched)
            else:
                whole = with_this_skin(
                    task.model, goal.limits, task.first, task.skin, most_steps, watched
                )
            even = of_less_volume(problem, goal.limits, whole) if goal.limits.any else None
        if even is not None:
            whole = no_worse(whole, even)
        sized, taken = whole, None
        if goal.remove_thin and whole.stopped != "cancelled":
            taken, sized = _without_thin(task, whole, most_steps, watched)
        model, any_radii = task.model if taken is None else taken.model, None
        if goal.radius_list:
            any_radii = sized.analysis
            found, holds = of_list(
                model.problem, goal.limits, any_radii, np.array(goal.radius_list)
            )
            sized = replace(sized, analysis=found, holds=holds)
    return _Search(model, sized, whole, even, taken, any_radii)


def _notes_of(task: _Task, search: _Search) -> list[str]:
    """What the user is told of a search's end."""
    limits, model, sized = task.goal.limits, search.model, search.sized
    notes = [] if sized.holds else [limit_not_held(model.problem, sized.analysis)]
    if task.skin is not None and task.skin.volume is not None:
        notes += other_mass(search.volume, task.skin.volume, task.loads.material)
    limit, is_sized = limits.stress, task.skin is not None
    if limit is None or not is_sized or max(skin_peaks(model, sized.analysis)) > SKIN_HOLDS * limit:
        notes += stressed_skin(model, sized.analysis, limits, is_sized)
    notes += free_motions(model.problem)
    notes += left_out(task.infill.spec) + small_dimples(model, limits)
    if sized.stopped == "cancelled":
        notes.append("The search was cancelled: this is the best design so far.")
    return notes


def _with_even(task: _Task, search: _Search, prove_it: bool) -> _ProvedDesign:
    """As `_prove`, with the one radius for all to compare with: CalculiX leaves a core free."""
    problem, limits = task.model.problem, task.goal.limits
    if search.even is not None or not limits.any:
        return _prove(task, search, prove_it)
    with ThreadPoolExecutor(1) as beside:
        even = beside.submit(uniform, problem, limits)
        made = _prove(task, search, prove_it)
        return replace(made, search=replace(made.search, even=even.result()))


def _prove(task: _Task, search: _Search, prove_it: bool) -> _ProvedDesign:
    """The design as files keep it, held to its limits by CalculiX; and CalculiX's figures.

    Where CalculiX finds a sized skin or its struts too much stressed, ratios to choose them anew.
    """
    model, sized, limits, notes = search.model, search.sized, task.goal.limits, task.notes
    cell, length = task.infill.spec.kind.cube, task.infill.filling.spacing
    problem, ratios = model.problem, None
    with telling_free_motions(problem):
        final = _stored(problem, sized.analysis.radii, limits)

    def solve_again(problem: Problem, design: Analysis) -> Proved | None:
        solved_one = replace(model, problem=problem)
        return prove_design(
            solved_one, cell, length, design, task.loads.material, notes, task.monitor
        )

    proof = None
    limit = limits.stress if task.skin is not None else None
    if limit is not None and max(skin_peaks(model, final)) > SKIN_HOLDS * limit:
        sized = replace(sized, holds=False)
    if prove_it and sized.stopped != "cancelled":
        try:
            with task.monitor.stage("proof", 0.95, 1.0):
                proof = solve_again(problem, final)
                for _ in range(CORRECTIONS):
                    if proof is None or proof.holds(limits, final) or not sized.holds:
                        break
                    # Where CalculiX finds more than is allowed, struts become that much thicker.
                    problem, stricter = correct_problem(problem, limits, final, proof)
                    found, holds = thicken(problem, stricter, final.radii)
                    if task.goal.radius_list:
                        no_thinner = replace(problem, low=np.maximum(problem.low, final.radii))
                        found, holds = of_list(
                            no_thinner, stricter, found, np.array(task.goal.radius_list)
                        )
                    final, proof = _stored(problem, found.radii, limits), None
                    proof = solve_again(problem, final)
                    if not holds and found.most_used > NEARLY:
                        break
                could, of_skin = sized.holds, 0.0
                if proof is not None and limit is not None:
                    stress = max(proof.skin)
                    of_skin = stress / limit
                    if of_skin > SKIN_HOLDS:
                        sized = replace(sized, holds=False)
                        notes.append(
                            f"The skin's stress is {stress:.4g} MPa in CalculiX, of {limit:.4g} "
                            "MPa allowed: ask for a higher safety."
                        )
                if proof is not None and could and not proof.holds(limits, final):
                    sized = replace(sized, holds=False)
                    notes.append(unproved(problem, proof.uses(limits, final), final))
                if proof is not None and limit is not None and could:
                    of_struts = proof.uses(limits, final).get("stress", 0.0)
                    if of_skin > SKIN_HOLDS or of_struts > PROVED:
                        ratios = ratios_of(model, final, proof, length, task.ratios)
        except Cancelled:
            proof = None
            notes.append("CalculiX was cancelled: no other solver has proved this design.")
        except VolfrepError as error:  # minutes of work are not lost to another program
            proof = None
            notes.append(f"{error} No other solver has proved this design.")
    figures = None
    if proof is not None:
        doubts = proof.figures["doubts"]
        doubts += too_dense(task.infill, model, final.radii)  # beams are no proof of beams there
        proof.figures["confirmed"] = not doubts
        notes += not_confirmed(doubts)
        figures = {**proof.figures, "uses": proof.uses(limits, final)}
        if task.skin is not None:
            figures["skin_stress_mpa"] = list(proof.skin)
            if limit is not None:
                figures["uses"]["skin stress"] = max(proof.skin) / limit
    notes += hardly_beams(task.infill, model, final.radii, length)
    search = replace(search, sized=replace(sized, analysis=final))
    return _ProvedDesign(task, search, figures, ratios)


def _record(
    task: _Task,
    search: _Search,
    proof: dict[str, Any] | None,
    before: Analysis,
    seconds: dict[str, float],
    built: list[str],
) -> SizedPart:
    """The design as a graded lattice, and its report; `built` says what its process asks for."""
    taken, radii = search.taken, search.sized.analysis.radii
    spec = task.infill.spec
    if taken is not None:
        spec, radii = taken.spec, taken.of_all(radii)
    points = field_points(task.infill, task.model)
    graded = replace(
        spec, strut_radius=float(np.median(radii)), radius_grading=radius_field(points, radii)
    )  # fmt: skip
    report = sizing_report(
        task.loads, search.model, search.sized, before, search.even, proof,
        seconds=seconds, notes=tuple(task.notes),
        unthinned=None if taken is None else (search.whole.analysis, taken.struts),
    )  # fmt: skip
    governed = governing(search.model.problem, search.sized.analysis, task.goal.limits)
    report["governed_by"] = governed.of_struts()
    report["limits"] = task.goal.limits.as_dict()
    if taken is not None:
        report["removed"]["places"] = taken.places
    if search.any_radii is not None:
        wanted = np.array(task.goal.radius_list)
        report["radius_list"] = list_figures(wanted, search.any_radii, search.sized.analysis)
    if task.goal.building is not None:
        report["building"] = building_figures(task.goal.building, task.infill)
        hanging = overhanging_skin(report["building"])
        report["notes"] += hanging
        report["building"]["notes"] = [*built, *hanging]
    if task.goal.printing is not None:
        report["as_printed"] = printed_figures(
            task.goal.printing,
            search.model,
            search.sized.analysis,
            task.loads.material.density,
        )
        report["notes"].append(report["as_printed"]["note"])
    skin = None
    if task.skin is not None:
        skin = governing_thickness(task.skin, task.goal.limits)
        _with_skin(report, task, search.model)
        report["skin"] = {
            **thickness_there(search.model, task.infill.domain.mesh),
            "chosen_at": len(task.skin.sized.analysis.radii) - len(task.skin.radii),
            "even": task.skin.even,
            "governed_by": skin.of_skin(),
            "solid": solid_places(
                search.model, task.infill.solid, task.infill.domain.mesh,
                task.loads.material.density, task.skin.solid,
            ),
        }  # fmt: skip
        report["notes"] += filled_notes(report["skin"]["solid"], task.skin.thickest)
        solid = sum(place["mass_g"] for place in report["skin"]["solid"])
        report["masses_g"]["solid"] = solid
    return SizedPart(
        graded, points, radii, search.model, search.sized, before, search.even, governed, skin,
        task.goal.building, report,
    )  # fmt: skip


def _with_skin(report: dict[str, Any], task: _Task, model: SizingModel) -> None:
    """Adds a sized skin to a report: steps and limits are of struts and skin together."""
    last, limit = report["steps"][-1], task.goal.limits.stress
    last["strut_volume_mm3"] += model.skin_volume
    if limit is not None:
        use = {"skin stress": max(report["skin_stress_mpa"]) / limit}
        report["uses"] = {**report["uses"], **use}
        last["uses"] = {**last["uses"], **use}
        report["limits"]["skin stress"] = limit


def _stored(problem: Problem, radii: Floats, limits: Limits) -> Analysis:
    """A design as files keep it: radii in whole steps, not thinner than they were."""
    steps = np.ceil(radii / RADIUS_STEP - 1e-6) * RADIUS_STEP
    return analyse(problem, steps, limits)[0]


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


def _without_thin(
    task: _Task, sized: Sized, most_steps: int, watch: Watch
) -> tuple[Thinned | None, Sized]:
    """The design without its thin struts, where it is better; else the design as it is."""
    goal, whole, before = task.goal, sized.analysis, len(sized.steps)
    wanted = goal if goal.limits.any else replace(goal, volume=whole.volume)
    reason = "none is as thin as allowed and carries little"
    for slack in SLACK:
        try:
            taken = without_thin_struts(
                task.infill, task.loads, goal, task.model, whole, slack, task.first, task.cache
            )
            if taken is None:
                continue
            taken = replace(taken, model=with_ratios(taken.model, task.ratios))
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
    task.notes.append(f"No struts were taken away: {reason}.")
    return None, sized

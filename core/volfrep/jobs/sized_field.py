# SPDX-License-Identifier: LGPL-2.1-or-later
"""A part whose strut radii or wall thicknesses are found for its loads, as a homogenised solid.

What is found is a field of points like any other: the specification with it fills the part, and
homogenised anew it says what the field came to.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from numbers import Real
from typing import Any

import numpy as np

from ..continuum.thickness_field import (
    HOLDS,
    FieldFound,
    FieldLimits,
    FieldProblem,
    FieldStep,
    lightest_field,
    stiffest_field,
)
from ..design.grading import RadiusGrading
from ..design.profile import Profile
from ..design.scattered_field import PointField
from ..design.spec import LatticeSpec
from ..loads.load_cases import LoadCases, with_weights
from ..mesh.triangle_mesh import TriangleMesh
from ..util.arguments import check_kind
from ..util.cache import StageCache
from ..util.errors import VolfrepError
from ..util.numbers import number
from ..util.progress import Monitor, ProgressCallback
from ..util.types import Floats
from .homogenised import HomogenisedPart, homogenise_part, refuse_endless
from .infill import Infill
from .part_bricks import PartBricks, cell_law

#: What a user may want, beside the most stiffness.
FIELD_GOALS = ("safety", "max_displacement", "thinnest", "thickest")
#: Thicknesses are kept in steps of this, mm, and rounded up.
STEP = 1e-4
#: The least and the largest of them over what the specification has, where nothing else is said.
THINNER, THICKER = 0.5, 2.0
#: They vary over so many cells, or bricks where these are larger.
CELLS, BRICKS = 1.0, 1.5


@dataclass(frozen=True)
class FieldGoal:
    """What a field is for: limits for the least mass; without any, stiffness at a mass.

    Attributes:
        limits: none is gone beyond.
        thinnest, thickest: mm; None for half the specification's thickness, and twice.
    """

    limits: FieldLimits = field(default_factory=FieldLimits)
    thinnest: float | None = None
    thickest: float | None = None


def field_goal(
    loads: LoadCases, asked: Mapping[str, float | None], named: Any = str, *, stiffest: bool = False
) -> FieldGoal | None:
    """What a user has written down; None where nothing is to be sized.

    Args:
        loads: their material yields.
        asked: ``safety``, ``max_displacement``, ``thinnest`` and ``thickest``, or None of each.
        named: what the user calls one of them, for messages.
        stiffest: as stiff as the mass allows.

    Raises:
        VolfrepError: a number makes no sense, or one has no effect.
    """
    for name, value in asked.items():
        check_kind(named(name), value, (Real, type(None)), "a number")
    given = {name: float(value) for name, value in asked.items() if value is not None}
    for name, value in given.items():
        number(named(name), value, "", positive=True)
    limited = [name for name in ("safety", "max_displacement") if name in given]
    if not stiffest and not limited:
        for name in given:
            raise VolfrepError(
                f"{named(name)} is a bound of a thickness that is sized: give {named('stiffest')}, "
                f"{named('safety')} or {named('max_displacement')}, or leave it."
            )
        return None
    if stiffest and limited:
        raise VolfrepError(
            f"{named('stiffest')} keeps the mass, {named(limited[0])} asks for the least: give one "
            "of them."
        )
    if "safety" in given and loads.material.yield_stress is None:
        raise VolfrepError(
            f"The material '{loads.material.name}' has no yield stress for {named('safety')}: give "
            "it one (yield_stress in the load file)."
        )
    use = 1.0 / given["safety"] if "safety" in given else None
    limits = FieldLimits(use, given.get("max_displacement"))
    return FieldGoal(limits, given.get("thinnest"), given.get("thickest"))


def homogenise_sized(
    solid: TriangleMesh,
    spec: LatticeSpec,
    loads: LoadCases,
    goal: FieldGoal,
    *,
    most_steps: int = 40,
    element: float | None = None,
    frequencies: int = 0,
    load_factors: int = 0,
    progress: ProgressCallback | None = None,
    cache: StageCache | None = None,
) -> HomogenisedPart:
    """Find how thick struts or walls are to be, and solve the part that is filled so.

    Args:
        solid: checked closed mesh, mm.
        spec: what it is filled with; its radius or thickness, or its target's, is begun with.
        loads: the material, and what the part carries.
        goal: what is wanted.
        most_steps: of the search.
        element: as of `homogenise_part`.
        frequencies: as of `homogenise_part`, of the sized part.
        load_factors: the same.
        progress: called with the fraction done and the stage; returning False cancels.
        cache: keeps the costly stages of the part.

    Returns:
        The part, solved anew: its ``spec`` has the field, its report ``field`` what was found.

    Raises:
        VolfrepError: as of both.
        Cancelled: the callback said so.
    """
    monitor, cache = Monitor(progress), cache or StageCache()
    with monitor.stage("sizing", 0.0, 0.9):
        graded, told = size_field(
            solid, spec, loads, goal, element=element, most_steps=most_steps, monitor=monitor,
            cache=cache,
        )  # fmt: skip
    made = homogenise_part(
        solid, graded, loads, element=element, frequencies=frequencies,
        load_factors=load_factors, monitor=monitor, cache=cache,
    )  # fmt: skip
    made.report["notes"] += _check_limits(told, made, goal)
    made.report["field"] = told
    return made


def size_field(
    solid: TriangleMesh,
    spec: LatticeSpec,
    loads: LoadCases,
    goal: FieldGoal,
    *,
    element: float | None = None,
    most_steps: int = 40,
    monitor: Monitor | None = None,
    cache: StageCache | None = None,
) -> tuple[LatticeSpec, dict[str, Any]]:
    """Find how thick struts or walls are to be.

    Args:
        solid: checked closed mesh, mm.
        spec: what it is filled with; its radius or thickness, or its target's, is begun with.
        loads: the material, and what the part carries.
        goal: what is wanted.
        element: edge of the bricks, mm; None for what suits the part.
        most_steps: of the search.
        monitor: for progress and cancel.
        cache: keeps the costly stages of the part.

    Returns:
        The specification with the field, and what the search came to as plain JSON values.

    Raises:
        VolfrepError: the lattice has no thickness that could be graded, bounds do not fit, a case
            has heat, or as `homogenise_part`.
        Cancelled: when the monitor says so.
    """
    from .targets import solve_target

    refuse_endless(spec)
    monitor, cache = monitor or Monitor(), cache or StageCache()
    if not loads.cases:
        raise VolfrepError("A field is sized for load cases, and there is heat alone: give one.")
    if any(case.heated for case in loads.cases):
        raise VolfrepError(
            "A field is not sized for the temperature of the heat: leave those cases out, and "
            "homogenise the sized part with them."
        )
    if spec.target is not None:
        spec = solve_target(solid, spec, cache=cache, meshed=False).spec
    start, thinnest, thickest = _bounds(spec, goal)
    wanted = replace(spec, target=None, radius_grading=_grading(thinnest, thickest))
    infill = Infill(solid, wanted, monitor=monitor, cache=cache)
    part = PartBricks(infill, loads, cell_law(wanted), element)
    edge = float(part.bricks.edge.max())
    share = part.shares.lattice.mean(axis=1)
    reach = max(CELLS * spec.cell_size, BRICKS * edge)
    first = part.model(lambda at: np.full(len(at), start))
    brick = float(np.prod(part.bricks.edge))
    own = part.density_at(np.full(len(share), start)) * share
    rest = first.loaded.shares - own - part.shares.solid.mean(axis=1)

    def volume_of(thickness: Floats) -> float:
        # Struts of free faces grow by the square of their radius.
        more = part.density_at(thickness) * share + rest * (thickness / start) ** 2
        return float((more + part.shares.solid.mean(axis=1)).sum()) * brick

    problem = FieldProblem(
        lambda thickness: part.model(PointField(part.middles, thickness)), volume_of,
        with_weights(loads).cases, part.middles, thinnest, thickest, reach, monitor,
    )  # fmt: skip
    if goal.limits.any:
        found = lightest_field(problem, goal.limits, start, most_steps)
    else:
        found = stiffest_field(problem, start, most_steps)
    up = np.minimum(np.ceil(found.thickness / STEP - 1e-6) * STEP, thickest)
    source = "radii sized for loads" if spec.kind.has_struts else "thickness sized for loads"
    values = PointField(part.middles, np.maximum(up, thinnest), source)
    graded = replace(wanted, radius_grading=_grading(thinnest, thickest, values))
    return graded, _told(found, goal, values, loads)


def _bounds(spec: LatticeSpec, goal: FieldGoal) -> tuple[float, float, float]:
    """The thickness to begin with, the thinnest and the thickest, mm."""
    grading = spec.radius_grading
    own = spec.kind.thickness if grading is None else float(np.mean(grading.extremes))
    what = "radius" if spec.kind.has_struts else "thickness"
    thinnest = THINNER * own if goal.thinnest is None else goal.thinnest
    thickest = THICKER * own if goal.thickest is None else goal.thickest
    if not thinnest < thickest:
        raise VolfrepError(
            f"The thinnest {what}, {thinnest:g} mm, is not below the thickest, {thickest:g} mm: "
            "give bounds between which it may vary."
        )
    if not thinnest <= own <= thickest:
        raise VolfrepError(
            f"The {what} of the specification, {own:g} mm, lies outside {thinnest:g} to "
            f"{thickest:g} mm, between which it is sized: change it, or a bound."
        )
    return own, thinnest, thickest


def _grading(thinnest: float, thickest: float, values: PointField | None = None) -> RadiusGrading:
    """A grading by a field of thicknesses between bounds, mm; without one, by any."""
    if values is None:
        ends = np.array([thinnest, thickest])
        values = PointField(np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]]), ends)
    curve = ((thinnest, thinnest), (thickest, thickest))
    return RadiusGrading("field", Profile("linear", thinnest, thickest), field=values, curve=curve)


def _told(
    found: FieldFound, goal: FieldGoal, values: PointField, loads: LoadCases
) -> dict[str, Any]:
    """What the search came to."""
    density = loads.material.density / 1000.0

    def row(step: FieldStep) -> dict[str, Any]:
        return {
            "mass_g": step.volume * density, "work_over_first": step.work, "uses": step.uses
        }  # fmt: skip

    low, high = values.range
    return {
        "limits": {
            "lattice_use": goal.limits.use, "displacement_mm": goal.limits.displacement,
        },
        "thinnest_mm": low, "thickest_mm": high, "mean_mm": float(values.values.mean()),
        "steps": [row(step) for step in found.steps],
        "work_over_first": min(step.work for step in found.steps),
        "thicker_helps": found.thicker_helps,
    }  # fmt: skip


def _check_limits(told: dict[str, Any], made: HomogenisedPart, goal: FieldGoal) -> list[str]:
    """Add to what a search came to the uses of the sized part, solved anew; notes on it.

    Args:
        told: of `size_field`; ``uses`` and ``holds`` are set.
        made: the part.
        goal: what was wanted.
    """
    cases, limits, uses = made.report["cases"], goal.limits, {}
    if limits.use is not None:
        case = max(cases, key=lambda one: one["lattice_use"] or 0.0)
        uses["stress"] = (case["lattice_use"] or 0.0) / limits.use
    if limits.displacement is not None:
        uses["displacement"] = max(one["displacement_mm"] for one in cases) / limits.displacement
    told["uses"] = uses
    told["holds"] = max(uses.values(), default=0.0) <= HOLDS
    if told["holds"]:
        return []
    worst = max(uses, key=lambda name: uses[name])
    what = "struts" if made.spec.kind.has_struts else "walls"
    beyond = f"The limit of {worst} is not held: at best {uses[worst]:.1%} of it is used"
    if worst == "stress" and not told["thicker_helps"]:
        at = ", ".join(f"{value:.4g}" for value in case["lattice_use_at"])
        if made.spec.with_skin:
            return [
                f"{beyond}, at ({at}) mm, where the skin strains the lattice and thicker {what} "
                "take no less stress: make the skin thicker."
            ]
        return [
            f"{beyond}, at ({at}) mm, where thicker {what} take no less stress: move the supports "
            "by less, or let the loads enter over larger faces."
        ]
    skin = ", or make the skin thicker" if made.spec.with_skin else ""
    return [f"{beyond}, and what governs is how thick {what} may be: allow thicker ones{skin}."]

# SPDX-License-Identifier: LGPL-2.1-or-later
"""The thickness of a part's skin, found together with the radii of its struts.

Shells have their middle, and struts end, where the skin's thickness puts them. So a search is made
with the skin of the specification, another one with the skin that it found, and what that comes to
is the skin of the part: a field of thicknesses, which its wall follows, as that of any part does.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from scipy.spatial import cKDTree

from ...design.scattered_field import PointField
from ...design.spec import LatticeSpec
from ...loads.load_cases import LoadCases
from ...mesh.triangle_mesh import TriangleMesh
from ...sizing.analysis import Analysis, Limits, Problem, analyse
from ...sizing.model import SizingModel, with_sized_skin
from ...sizing.optimise import HOLDS, Sized, Step, Watch, lightest, stiffest, thicken, uniform
from ...sizing.proof import SHARED, Proved
from ...sizing.skin_thickness import shares_of
from ...sizing.stress_ratios import StressRatios, skin_ratio
from ...sizing.symmetry import Mirrors
from ...spatial.proximity import closest_points
from ...util.cache import StageCache
from ...util.errors import VolfrepError
from ...util.progress import Monitor
from ...util.types import Floats
from ..infill import Infill
from .goal import Goal
from .governing import Governing, governing_skin
from .part_model import given_radii, part_model, thickness_of_skin
from .solid_places import NOWHERE, SolidPlaces, more_solid, solid_stubs

#: Thicknesses are stored in steps of this, mm, as files keep them.
STEP = 1e-6
#: Searches, each with the skin that the one before has found.
_SEARCHES = 2
#: A skin of less than this part of what is below it does not meet itself: half but for rounding, as
#: one of even thickness was looked for no deeper than twice that.
_CLEAR = 0.499
#: Struts that grow by more than this with the skin as it is are searched for once more.
_GROWN = 1.05
#: Between two designs the skin's stress is linear but for this share.
_CURVED = 0.05
#: So many in all, where a part becomes solid in more places.
_MOST_SEARCHES = 4


@dataclass(frozen=True, eq=False)
class SkinDesign:
    """A skin whose thickness was chosen, and the radii that were with it.

    Attributes:
        spec: with the skin.
        nodes: (n, 3) of the wireframe, mm.
        radii: (n,) mm.
        sized: the last search.
        steps: of all.
        even: one radius and one thickness that hold the same limits, their volume in mm3 and
            whether they do hold them; None without limits.
        limit: of stress, MPa, that the skin was held to; None for none.
        problem: of the last search.
        variables: its radii and roots of thicknesses.
        volume: mm3, what the part's struts and skin are to have; None with limits.
        solid: where the part became solid, as its skin would have been thicker than it may be.
    """

    spec: LatticeSpec
    nodes: Floats
    radii: Floats
    sized: Sized
    steps: tuple[Step, ...]
    even: dict[str, Any] | None
    limit: float | None
    problem: Problem
    variables: Floats
    volume: float | None = None
    solid: SolidPlaces = NOWHERE
    thickest: float = np.inf

    def radii_at(self, nodes: Floats) -> Floats:
        """(k,) mm, of the nearest node at (k, 3)."""
        return np.asarray(self.radii[cKDTree(self.nodes).query(nodes)[1]])


def design_skin(
    solid: TriangleMesh,
    spec: LatticeSpec,
    loads: LoadCases,
    goal: Goal,
    monitor: Monitor,
    cache: StageCache,
    design: SkinDesign | None = None,
    *,
    most_steps: int,
    watch: Callable[[int, Step], bool],
    margin: float = 1.0,
    ratios: StressRatios | None = None,
) -> SkinDesign:
    """Choose the thickness of the skin and the radii of struts together.

    Args:
        solid: the part.
        spec: what it is filled with; its skin is what the search begins with.
        loads: the material, and what the part carries.
        goal: with bounds of the skin.
        monitor: of the job.
        cache: keeps the costly stages of the part.
        design: to begin with; None for what the specification says.
        most_steps: of each search.
        watch: told of every step.
        margin: of the limit of stress that the skin is held to.
        ratios: how many times as stressed as they say skin and struts are; None for once.

    Raises:
        VolfrepError: there is no skin, or the bounds make no sense.
    """
    low, high, patch = _bounds(spec, goal)
    spec = replace(spec, shell=float(np.clip(spec.shell, low, high)))
    limits = goal.limits
    if limits.stress is not None:
        limits = replace(limits, skin_stress=margin * limits.stress)
    steps: tuple[Step, ...] = ()
    number, searches, solids = 0, _SEARCHES, NOWHERE
    if design is not None:
        spec, steps, searches, solids = design.spec, design.steps, 1, design.solid
    while number < searches:
        infill = Infill(solid, spec, monitor=monitor, cache=cache)
        model = part_model(infill, loads, goal, cache, thickest=max(high, solids.deepest))
        model = with_ratios(model, ratios)
        radii = given_radii(model.wireframe)
        if design is not None:
            radii = design.radii_at(model.wireframe.nodes)
        thickness = thickness_of_skin(solid, spec)
        varied, roots = with_sized_skin(
            model, thickness if callable(thickness) else _constant(thickness), (low, high), patch,
            goal.mirrors, solids.depth,
        )  # fmt: skip
        fills = goal.solid_places and limits.any and np.isfinite(patch)
        problem = replace(varied.problem, spares_stubs=fills)
        first = np.clip(np.concatenate([radii, roots]), problem.low, problem.high)
        if not goal.limits.any and goal.volume is None:
            goal = replace(goal, volume=problem.radii.volume(first))

        def watched(step: int, taken: Step, done: int = len(steps)) -> bool:
            return watch(done + step, taken)

        sized = _searched(problem, limits, goal, first, most_steps, watched)
        steps += sized.steps
        count = len(model.wireframe.nodes)
        more = solids
        if fills:
            more = more_solid(problem, limits, sized.analysis.radii, solid, solids, high)
        found = sized.analysis.radii
        spec = replace(spec, shell=low, skin_field=_field(problem, found, goal.mirrors, more))
        if more is not solids:
            searches = min(max(searches, number + 2), _MOST_SEARCHES)
        even = None
        if number == searches - 1 and goal.limits.any:
            even = _even(replace(problem, spares_stubs=False), limits)
        design = SkinDesign(
            spec, model.wireframe.nodes, found[:count], sized, steps, even, limits.skin_stress,
            problem, found, goal.volume, more, high,
        )  # fmt: skip
        if sized.stopped == "cancelled":
            break
        number, solids = number + 1, more
    assert design is not None
    return design


def with_ratios(model: SizingModel, ratios: StressRatios | None) -> SizingModel:
    """A model whose skin and struts are so many times as stressed as they say; None for once."""
    if ratios is None or model.skin is None:
        return model
    skin = replace(model.skin, stress_ratio=ratios.skin.at(model.skin.centres))
    factor = ratios.of_struts(middles_of(model))
    return replace(model, skin=skin, problem=replace(model.problem, stress_factor=factor))


def ratios_of(
    model: SizingModel,
    analysis: Analysis,
    proof: Proved,
    apart: float,
    before: StressRatios | None,
) -> StressRatios:
    """How many times as stressed as they say CalculiX finds the skin and struts to be.

    Args:
        model: with the skin.
        analysis: its design.
        proof: what CalculiX says of it.
        apart: how far apart ratios of the skin are chosen, mm.
        before: what was found of a design before: struts count as stressed as in either.
    """  # fmt: skip
    assert model.skin is not None
    assert proof.on_skin is not None
    plain = replace(model.skin, stress_ratio=None)
    own = plain.stresses(analysis.displacements[model.frame_nodes :])
    middles, more = middles_of(model), proof.stress_factor
    struts = np.where(more > 1.0, more / SHARED, 1.0)
    if before is not None:
        struts = np.maximum(struts, before.of_struts(middles))
    return StressRatios(skin_ratio(plain, own, proof.on_skin, apart), middles, struts)


def middles_of(model: SizingModel) -> Floats:
    """(m, 3) mm, of the struts."""
    structure = model.problem.structure
    return np.asarray(structure.nodes[structure.beams.struts].mean(axis=1))


def weighed(design: SkinDesign, volume: float, mirrors: Mirrors | None) -> SkinDesign:
    """A design whose part has a volume of struts and skin, mm3, made to have the wanted one.

    All radii and roots of thicknesses have one factor, as far as bounds allow.
    """
    assert design.volume is not None
    problem = design.problem
    wanted = problem.radii.volume(design.variables) * design.volume / volume
    found = problem.radii.scaled_to(design.variables, wanted, problem.low, problem.high)
    field = _field(problem, found, mirrors, design.solid)
    spec = replace(design.spec, skin_field=field)
    return replace(design, spec=spec, radii=found[: len(design.nodes)], variables=found)


def with_solid_stubs(
    design: SkinDesign, model: SizingModel, goal: Goal, part: TriangleMesh
) -> SkinDesign | None:
    """A design whose part is solid where struts wider than long cannot bear their load.

    Args:
        design: with a skin.
        model: of the part with that skin as it was laid.
        goal: that the design is held to.
        part: the solid.

    Returns:
        None where no place is to become solid.
    """
    skin = design.problem.skin
    assert skin is not None
    if not (goal.solid_places and goal.limits.stress and len(skin.points) > 1):
        return None
    first = design.radii_at(model.wireframe.nodes)
    first = np.clip(first, model.problem.low, model.problem.high)
    found, holds = thicken(model.problem, goal.limits, first, by_one_factor=False)
    if holds:
        return None
    solids = solid_stubs(model, found, goal.limits, part, skin, design.solid, design.thickest)
    if solids is design.solid:
        return None
    field = _field(design.problem, design.variables, goal.mirrors, solids)
    return replace(design, spec=replace(design.spec, skin_field=field), solid=solids)


def _constant(thickness: float) -> Callable[[Floats], Floats]:
    return lambda points: np.full(len(points), thickness)


def _bounds(spec: LatticeSpec, goal: Goal) -> tuple[float, float, float]:
    """The least thickness, the largest, and how far apart it is chosen, mm."""
    assert goal.skin_thinnest is not None
    if not spec.with_skin:
        raise VolfrepError("There is no skin to size: give a skin thickness, and the output part.")
    skin = spec.skin
    assert skin is not None
    if skin.face_skins or skin.keep_solid:
        raise VolfrepError(
            "The thickness of the skin is sized everywhere: leave out faces with their own, and "
            "what is kept solid."
        )
    low = goal.skin_thinnest
    high = 0.5 * spec.cell_size if goal.skin_thickest is None else goal.skin_thickest
    patch = spec.cell_size if goal.skin_patch is None else goal.skin_patch
    if not (0.0 < low <= high and patch > 0.0):
        raise VolfrepError(
            f"A skin from {low:.4g} to {high:.4g} mm, chosen every {patch:.4g} mm, makes no sense: "
            "the least must be above 0 and not above the largest."
        )
    return low, high, patch


def _searched(
    problem: Problem,
    limits: Limits,
    goal: Goal,
    first: Floats,
    most_steps: int,
    watch: Callable[[int, Step], bool],
) -> Sized:
    if limits.any:
        return lightest(problem, limits, first, most_steps=most_steps, watch=watch)
    assert goal.volume is not None
    weights = None if goal.weights is None else np.array(goal.weights, float)
    return stiffest(
        problem, goal.volume, first, weights=weights, most_steps=most_steps, watch=watch
    )


def _field(
    problem: Problem, variables: Floats, mirrors: Mirrors | None, solids: SolidPlaces
) -> PointField:
    """The thickness of a design at the skin's inner side, where its wall is to be."""
    skin = problem.skin
    assert skin is not None
    model, chosen = skin.skin, skin.wanted(variables)
    filled = solids.depth(skin.points)
    chosen = np.where(filled > 0.0, filled, chosen)
    rows = np.unique(model.shells.triangles)
    outside = model.outside.vertices[rows]
    wanted = np.full(len(rows), chosen[0])
    if len(chosen) > 1:
        reach = _reach(skin.points, model.centres)
        wanted = shares_of(skin.points, outside, reach) @ chosen
    wanted = np.ceil(wanted / STEP - 1e-6) * STEP
    depth = np.minimum(wanted, 0.5 * model.thickness_below[rows])
    inwards = model.inside[rows] - outside
    inwards /= np.maximum(np.linalg.norm(inwards, axis=1), 1e-300)[:, None]
    places = outside + depth[:, None] * inwards
    if mirrors is not None:
        places, wanted = mirrors.images(places, wanted)
    return PointField(np.round(places, 6), wanted, "sizing")


def _reach(points: Floats, places: Floats) -> float:
    """How far apart control points lie, mm: no place is farther from one."""
    return float(cKDTree(points).query(places)[0].max()) * 1.05


def _even(problem: Problem, limits: Limits) -> dict[str, Any]:
    found, holds = uniform(problem, limits)
    skin = problem.skin
    assert skin is not None
    return {
        "radius_mm": float(found.radii[: skin.radii].mean()),
        "thickness_mm": float(skin.wanted(found.radii).mean()),
        "volume_mm3": found.volume,
        "holds": holds,
    }


def skin_peaks(model: SizingModel, analysis: Analysis) -> list[float]:
    """The stress of the skin in each case, MPa, on all but a little of its area."""
    assert model.skin is not None
    return model.skin.peaks(analysis.displacements[model.frame_nodes :])


def governing_thickness(design: SkinDesign, limits: Limits) -> Governing:
    """What governs a design's skin, held to limits, at the points of its thickness."""
    limits = replace(limits, skin_stress=design.limit)
    governed = governing_skin(design.problem, design.sized.analysis, limits)
    skin, field = design.problem.skin, design.spec.skin_field
    assert skin is not None
    assert isinstance(field, PointField)
    return replace(governed, rows=governed.at(skin.points, field.points))


def with_this_skin(
    model: SizingModel,
    limits: Limits,
    first: Floats,
    design: SkinDesign,
    most_steps: int,
    watch: Watch,
) -> Sized:
    """The radii that were found with a skin, as they hold the limits with it as it was laid.

    Args:
        model: with the skin as it is.
        limits: that are to be held.
        first: (n,) mm, the radii that were found.
        design: with them.
        most_steps: of a search for lighter ones.
        watch: told of every step.
    """
    if not limits.any:
        found, holds = analyse(model.problem, first, limits)[0], True
    else:
        found, holds = thicken(model.problem, limits, first)
        if holds and found.volume > _GROWN * model.problem.radii.volume(first):
            found = lighter(model, limits, found, most_steps, watch)
    return replace(design.sized, analysis=found, steps=design.steps, holds=holds)


def lighter(
    model: SizingModel, limits: Limits, heavy: Analysis, most_steps: int, watch: Watch
) -> Analysis:
    """A design with less of struts, if the skin bears it: all had become thicker for a few.

    Where the lightest stresses the skin too much, what lies between the two is tried.

    Args:
        model: with the skin as it is.
        limits: that the design holds.
        heavy: it.
        most_steps: of the search.
        watch: told of every step.
    """
    problem, limit = model.problem, limits.stress
    light = lightest(problem, limits, heavy.radii, most_steps=most_steps, watch=watch)
    if not light.holds or light.analysis.volume >= heavy.volume:
        return heavy
    if limit is None:
        return light.analysis
    most, least = (max(skin_peaks(model, one)) for one in (light.analysis, heavy))
    if most <= HOLDS * limit:
        return light.analysis
    if least >= limit:
        return heavy
    share = min((most - limit) / (most - least) + _CURVED, 1.0)
    radii = (1.0 - share) * light.analysis.radii + share * heavy.radii
    between, holds = thicken(problem, limits, radii)
    borne = holds and max(skin_peaks(model, between)) <= HOLDS * limit
    return between if borne and between.volume < heavy.volume else heavy


def thickness_there(model: SizingModel, domain: TriangleMesh) -> dict[str, Any]:
    """The thickness that was asked for, and what came out below the middles of the skin's shells.

    Args:
        model: of the part as it is.
        domain: what lies within its skin.
    """
    skin = model.skin
    assert skin is not None
    shells = skin.shells
    places = skin.outside.vertices[shells.triangles].mean(axis=1)
    asked = shells.thickness
    found = closest_points(domain, places)[1]
    clear = asked < _CLEAR * skin.thickness_below[shells.triangles].min(axis=1)
    share = found[clear] / asked[clear]
    area = shells.area[clear]
    order = np.argsort(share)
    total = np.cumsum(area[order]) / area.sum()
    last = len(order) - 1
    low, middle, high = (
        float(share[order[min(int(np.searchsorted(total, part)), last)]])
        for part in (0.05, 0.5, 0.95)
    )
    return {
        "thickness_mm": [float(asked.min()), float(asked.max())],
        "mean_thickness_mm": float(asked @ shells.area / shells.area.sum()),
        "there_over_asked": {"5%": low, "50%": middle, "95%": high},
        "solid_share": skin.solid_share,
    }

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Radii at nodes for least mass within limits, or for most stiffness at a mass.

Stress and buckling, which each strut has by itself, are met by stress ratios, as in fully stressed
design (R. H. Gallagher, "Fully stressed design", in Optimum Structural Design, 1973); stiffness,
displacement and frequency, which the struts share, by optimality criteria (L. Berke & N. S. Khot,
AGARD LS 70, 1974). Every design on the way is brought to its limits by one factor for all radii,
and the lightest that holds them is kept.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from ..util.errors import VolfrepError
from ..util.types import Floats
from .analysis import Analysis, Changes, Limits, Problem, analyse

#: No radius changes by more than this factor in a step.
_MOVE = 1.25
#: How a use falls with all radii, as a power: stress, displacement, buckling, frequency.
_POWERS = {"stress": 2.6, "displacement": 3.0, "buckling": 4.0, "frequency": 1.0}
_POWERS["frame buckling"] = 4.0
_POWERS["skin stress"] = 2.6
#: Powers of a stress ratio, a buckling ratio and a criterion by which a radius is changed.
_STRESSED, _BUCKLED, _CRITERION = 0.35, 0.22, 0.3
#: A strut's end asks those nodes for a larger radius that have more than this share in its own.
_ASKED = 0.3
#: Where all of these have this part of their largest radius, a strut cannot become thicker: the
#: skin beside it does, by this power of its ratio.
_FULL, _BESIDE = 0.999, 2.0
#: Criteria over a middle one are not looked at beyond these.
_MERITS = 1e-4, 1e4
#: What one factor does to a design is believed when it is nearer to 1 than this.
_NEAR = 1.08
#: Radii are the least that are allowed within this factor.
_LOWEST = 1.0 + 1e-6
#: How a use falls with a node's radius, as it is foreseen; and how far in one step at most.
_POWER, _FALL = 3.0, 0.6
#: A design holds its limits when none is used more than this.
HOLDS = 1.0 + 1e-3
#: Steps without so much improvement end the search.
_PATIENCE, _BETTER, _FEWEST = 8, 2e-3, 15
#: So do so many in which neither the volume nor any radius changes by more than these parts.
_STILL_STEPS, _STILL, _STILL_RADIUS = 2, 1e-4, 5e-3
#: So many of the lightest designs are brought to their limits in the end.
_KEPT = 3
#: Steps in which single struts become thicker; so many more with a skin, for this part of the limit
#: of stress.
_THICKENINGS, _IN_A_SKIN, _BEYOND = 5, 30, 0.98
#: Steps towards the limits by one factor, which ends where it makes less of a difference in volume.
_SCALINGS, _AS_LIGHT = 14, 1e-4


@dataclass(frozen=True)
class Step:
    """A design on the way.

    Attributes:
        volume: of its struts when scaled to the limits (or at the given volume), mm3.
        compliance: the sum over the cases, weighted, N mm.
        uses: of the limits, before scaling.
        near: whether it is so near to its limits that scaling is believed.
    """

    volume: float
    compliance: float
    uses: dict[str, float]
    near: bool


@dataclass(frozen=True, eq=False)
class Sized:
    """A design, and how it was come to.

    Attributes:
        analysis: of the final radii.
        steps: all on the way.
        stopped: why: ``converged``, ``steps`` or ``cancelled``.
        holds: whether it holds all limits.
        weights: (k,) by which the steps' compliances are summed; None for all alike.
    """

    analysis: Analysis
    steps: tuple[Step, ...]
    stopped: str
    holds: bool
    weights: Floats | None = None

    @property
    def last(self) -> Step:
        """The design itself, as the end of the table of steps."""
        final = self.analysis
        weights = np.ones(len(final.compliance)) if self.weights is None else self.weights
        return Step(final.volume, float(weights @ final.compliance), dict(final.uses), True)


#: Told a step's number and the step; returns False to stop, and the best so far is kept.
Watch = Callable[[int, Step], bool]


def _go_on(number: int, step: Step) -> bool:
    del number, step
    return True


def stiffest(
    problem: Problem,
    volume: float,
    start: Floats,
    *,
    weights: Floats | None = None,
    most_steps: int = 60,
    watch: Watch = _go_on,
) -> Sized:
    """The radii that make the weighted sum of the cases' compliances least at a volume.

    Args:
        problem: what carries what.
        volume: of the struts, mm3.
        start: (n,) radii to begin with, mm.
        weights: (k,) of the cases; None for those by which all count alike at the start.
        most_steps: it ends then, or when it has converged.
        watch: told of every step.

    Raises:
        VolfrepError: the volume lies outside what the bounds allow, a case has no forces, or the
            structure moves freely.
    """
    shape, low, high = problem.radii, problem.low, problem.high
    least, most = shape.volume(low), shape.volume(high)
    if not least <= volume <= most:
        raise VolfrepError(
            f"A volume of {volume:.4g} mm3 of struts cannot be reached with radii between "
            f"{low.min():.3g} and {high.max():.3g} mm, which make {least:.4g} to {most:.4g} mm3."
        )
    radii = shape.scaled_to(problem.most_alike(start), volume, low, high)
    none = Limits()
    steps: list[Step] = []
    best: Analysis | None = None
    best_value, since, stopped = np.inf, 0, "steps"
    for number in range(most_steps):
        found, changes = analyse(problem, radii, none, with_changes=True)
        assert changes is not None
        if not (found.compliance > 0.0).all():
            raise VolfrepError(
                "Stiffness is how little a part gives way to forces, and a load case has none: "
                "give limits instead, or forces."
            )
        if weights is None:
            weights = 1.0 / np.maximum(np.abs(found.compliance), 1e-300) / len(found.compliance)
        value = float(weights @ found.compliance)
        steps.append(Step(found.volume, value, {}, True))
        since = 0 if value < best_value * (1.0 - _BETTER) else since + 1
        if value < best_value:
            best, best_value = found, value
        if not watch(number, steps[-1]):
            stopped = "cancelled"
            break
        if since >= _PATIENCE:
            stopped = "converged"
            break
        gain = np.maximum(-problem.mean_alike(changes.compliance @ weights), 0.0)
        cost = np.maximum(problem.mean_alike(shape.volume_change(radii)), 1e-9)
        merit = gain / cost
        # Over a middle one: nodes that lie outside the domain, or nearly so, cost next to nothing.
        merit = np.clip(merit / max(float(np.median(merit)), 1e-300), *_MERITS)
        wanted = merit**_CRITERION
        radii = _stepped(problem, radii, problem.smoothed(radii * wanted) / radii, volume)
    assert best is not None
    return Sized(best, tuple(steps), stopped, True, weights)


def _stepped(problem: Problem, radii: Floats, wanted: Floats, volume: float) -> Floats:
    """Radii times what is wanted times one factor, within bounds and moves, at a volume."""
    low = np.maximum(problem.low, radii / _MOVE)
    high = np.minimum(problem.high, radii * _MOVE)
    return problem.radii.scaled_to(radii * wanted, volume, low, high)


def lightest(
    problem: Problem,
    limits: Limits,
    start: Floats,
    *,
    most_steps: int = 60,
    watch: Watch = _go_on,
) -> Sized:
    """The radii with the least volume that hold all limits.

    Args:
        problem: what carries what.
        limits: at least one.
        start: (n,) radii to begin with, mm.
        most_steps: it ends then, or when it has converged.
        watch: told of every step.

    Raises:
        VolfrepError: there is no limit, or the structure moves freely.
    """
    if not limits.any:
        raise VolfrepError("Least mass needs a limit: stress, displacement, buckling, frequency.")
    radii = np.clip(problem.most_alike(start), problem.low, problem.high)
    everything, limits = limits, replace(limits, frame_buckling=None)
    if not limits.any:
        limits = everything
    steps: list[Step] = []
    best: list[tuple[float, Floats, Floats]] = []
    least, since, still, stopped = np.inf, 0, 0, "steps"
    for number in range(most_steps):
        found, changes = analyse(problem, radii, limits, with_changes=True)
        assert changes is not None
        factor = _factor(found)
        scaled = np.clip(radii * factor, problem.low, problem.high)
        volume = problem.radii.volume(scaled)
        # No struts are thinner than all as thin as they may be.
        least_of_all = bool((radii <= problem.low * _LOWEST).all()) and factor <= 1.0
        near = 1.0 / _NEAR < factor < _NEAR or least_of_all
        steps.append(Step(volume, float(found.compliance.sum()), dict(found.uses), near))
        if near:
            since = 0 if volume < least * (1.0 - _BETTER) else since + 1
            least = min(least, volume)
            best = sorted([*best, (volume, scaled, radii)], key=lambda entry: entry[0])[:_KEPT]
        if not watch(number, steps[-1]):
            stopped = "cancelled"
            break
        following = problem.smoothed(next_radii(problem, found, changes, limits))
        moved = float(np.abs(following / radii - 1.0).max())
        same = number > 0 and abs(volume / steps[-2].volume - 1.0) <= _STILL
        still = still + 1 if near and same and moved <= _STILL_RADIUS else 0
        is_over = since >= _PATIENCE and number >= _FEWEST
        if least_of_all or is_over or still >= _STILL_STEPS:
            stopped = "converged"
            break
        radii = following
    best = best or [(0.0, radii, radii)]
    if still >= _STILL_STEPS:  # the lightest are one design
        best = best[:1]
    tried = [scaled_to_limits(problem, limits, chosen) for _, chosen, _ in best]
    if problem.skin is not None:
        # A skin is most of the mass: it does not become thicker everywhere for a strut or two.
        tried.append(thicken(problem, limits, best[0][2]))
    final, holds = min(tried, key=lambda entry: (not entry[1], entry[0].volume))
    if everything != limits:
        final, holds = thicken(problem, everything, final.radii)
    return Sized(final, tuple(steps), stopped, holds)


def uniform(problem: Problem, limits: Limits) -> tuple[Analysis, bool]:
    """One radius for all nodes, the smallest that holds all limits, and whether it does hold them.

    Nodes whose bounds do not allow it get the nearest that they do.
    """
    start, radii = np.empty(len(problem.low)), len(problem.low)
    if problem.skin is not None:
        radii = problem.skin.radii
    for some in (slice(radii), slice(radii, None)):
        low, high = problem.low[some], problem.high[some]
        if len(low):
            start[some] = float(np.sqrt(low.min() * high.max()))
    return scaled_to_limits(problem, limits, start)


def scaled_to_limits(problem: Problem, limits: Limits, radii: Floats) -> tuple[Analysis, bool]:
    """A design brought to its limits by one factor for all radii, and whether it holds them."""
    radii = np.clip(radii, problem.low, problem.high)

    def at(log: float) -> Analysis:
        scaled = np.clip(radii * np.exp(log), problem.low, problem.high)
        return analyse(problem, scaled, limits)[0]

    def no_lighter(log: float, found: Analysis) -> bool:
        """Whether the factor that is expected to be left makes as good as no difference."""
        scaled = np.clip(radii * np.exp(log) * _factor(found), problem.low, problem.high)
        return problem.radii.volume(scaled) >= (1.0 - _AS_LIGHT) * found.volume

    # From radii that hold, or do not, to the other side in growing steps; then between the two.
    place, found = 0.0, at(0.0)
    most = float(np.log((problem.high / radii).max()))
    least = float(np.log((problem.low / radii).min()))
    light = heavy = None
    for _ in range(_SCALINGS):
        if found.most_used <= 1.0:
            heavy = place, found
        else:
            light = place, found
        if 1.0 - 5e-4 <= found.most_used <= 1.0:
            break
        if heavy is not None and light is None and no_lighter(place, found):
            break
        if light is None:
            if place <= least:
                break
            place = max(least, min(place + np.log(_factor(found)), place - 0.02) - 0.01)
        elif heavy is None:
            if place >= most:
                return found, found.most_used <= HOLDS
            place = min(most, max(place + np.log(_factor(found)), place + 0.02) + 0.01)
        else:
            (low, one), (high, other) = light, heavy
            over, under = np.log(one.most_used), np.log(other.most_used)
            if high - low < 1e-4:
                break
            share = np.clip(over / (over - under), 0.1, 0.9)
            place = low + share * (high - low)
        found = at(place)
    if heavy is not None:
        return heavy[1], True
    return found, found.most_used <= HOLDS


def thicken(
    problem: Problem, limits: Limits, radii: Floats, *, by_one_factor: bool = True
) -> tuple[Analysis, bool]:
    """A design whose struts become thicker where limits ask for it, and whether it holds them.

    Where that is not enough, all become thicker by one factor, if allowed; none becomes thinner.
    What cannot be held so is left as thick as it could be made there, and not everywhere.
    """
    radii = problem.most_alike(radii)
    low = replace(problem, low=np.maximum(problem.low, radii))
    aimed = limits
    if limits.stress is not None:
        aimed = replace(limits, stress=_BEYOND * limits.stress)
    for number in range(_THICKENINGS + (0 if problem.around is None else _IN_A_SKIN)):
        found, changes = analyse(low, radii, limits, with_changes=True)
        if found.most_used <= 1.0:
            return found, True
        assert changes is not None
        # What a skin moves is little less stressed when it is thicker: it is asked for more.
        wanted = limits if number < _THICKENINGS else aimed
        radii = low.smoothed(next_radii(low, found, changes, wanted))
    found = analyse(low, radii, limits)[0]
    if found.most_used <= 1.0 or not by_one_factor:
        return found, found.most_used <= 1.0
    scaled, holds = scaled_to_limits(low, limits, found.radii)
    return (scaled, True) if holds else (found, False)


def _factor(found: Analysis) -> float:
    """That for all radii which is expected to bring the worst use to 1."""
    return float(max(use ** (1.0 / _POWERS[name]) for name, use in found.uses.items()))


def next_radii(problem: Problem, found: Analysis, changes: Changes, limits: Limits) -> Floats:
    """The next design: each node as thick as its struts' stresses and the shared limits ask for."""
    radii, shape = found.radii, problem.radii
    # Radii that go beyond what they may in one step are left for the next one.
    low = np.maximum(problem.low, radii / _MOVE)
    high = np.minimum(problem.high, radii * _MOVE)
    use = np.zeros(found.stress.shape[:2])
    if limits.stress is not None:
        use = np.maximum(use, (found.stress.max(axis=2) / limits.stress) ** _STRESSED)
    if limits.buckling is not None:
        used = (found.buckling.max(axis=1) * limits.buckling) ** _BUCKLED
        use = np.maximum(use, used[:, None])
    entries = shape.ends.tocoo()
    part = entries.data > _ASKED
    ends, nodes = entries.row[part], entries.col[part]
    if use.any():
        needed = np.zeros(len(radii))
        np.maximum.at(needed, nodes, use.ravel()[ends])
        low = np.clip(radii * needed, low, high)
    if limits.skin_stress is not None and problem.skin is not None:
        assert found.skin_stress is not None
        shells = (problem.skin.largest(found.skin_stress) / limits.skin_stress) ** _STRESSED
        needed = np.zeros(len(radii))
        needed[problem.skin.radii :] = problem.skin.largest_near(shells)
        # What a strut that is as thick as it may be cannot bear, the skin about it takes.
        full = np.ones(use.size, bool)
        full[ends[radii[nodes] < _FULL * problem.high[nodes]]] = False
        over = np.flatnonzero(full.reshape(use.shape).all(axis=1) & (use.max(axis=1) > 1.0))
        structure = problem.structure
        near = problem.skin.nearest(structure.nodes[structure.beams.struts[over]].mean(axis=1))
        needed_near = np.repeat(use[over].max(axis=1) ** _BESIDE, near.shape[1])
        np.maximum.at(needed, problem.skin.radii + near.ravel(), needed_near)
        low = np.clip(radii * needed, low, high)
    low = problem.most_alike(low)
    shared, uses = [], []
    if changes.displacement is not None and changes.displacement_uses is not None:
        shared.append(changes.displacement)
        uses.append(changes.displacement_uses)
    if changes.frequency is not None:
        shared.append(changes.frequency[:, None])
        uses.append(np.array([found.uses["frequency"]]))
    if changes.frame_buckling is not None and changes.frame_uses is not None:
        shared.append(changes.frame_buckling)
        uses.append(changes.frame_uses)
    if not shared:
        return low
    cost = np.maximum(problem.mean_alike(shape.volume_change(radii)), 1e-9)
    falls = problem.mean_alike(np.concatenate(shared, axis=1))
    return cheapest(radii, cost, np.concatenate(uses), falls, low, high)


def cheapest(
    radii: Floats, cost: Floats, uses: Floats, changes: Floats, low: Floats, high: Floats
) -> Floats:
    """(n,) radii of least cost that hold shared limits, as far as these are foreseen.

    Each use is taken as a sum over the nodes: of r^-3 where a larger radius lessens it, else of r.
    That is convex and separable, so that prices of the limits, one each, give the radii in closed
    form, and are found where the dual is largest (C. Fleury, Int. J. Num. Meth. Eng. 14, 1979).

    Args:
        radii: (n,) now, mm.
        cost: (n,) of a radius, per mm.
        uses: (c,) of the shared limits, 1 at the limit.
        changes: (n, c) their derivatives to the radii.
        low: (n,) bounds of this step, mm.
        high: (n,) mm.
    """
    from scipy.optimize import minimize  # slow to load, and the window loads this module

    helps = np.maximum(-changes, 0.0) * radii[:, None] / _POWER
    hurts = np.maximum(changes, 0.0)
    scale = float(cost @ radii)
    # A use that cannot be mended in one step is only asked to fall as far as it can.
    asked = np.maximum(1.0, _FALL * uses)

    def chosen(prices: Floats) -> Floats:
        gain = helps @ prices
        share = _POWER * gain / (radii * (cost / scale + hurts @ prices))
        return np.asarray(np.clip(radii * share ** (1.0 / (_POWER + 1.0)), low, high))

    def dual(prices: Floats) -> tuple[float, Floats]:
        at = chosen(prices)
        ratio = at / radii
        left = uses + helps.T @ (ratio**-_POWER - 1.0) + hurts.T @ (at - radii) - asked
        return -float(cost @ (at - radii) / scale + prices @ left), -left

    first = np.full(len(uses), 1.0 / len(uses))
    bounds = [(0.0, 1e6)] * len(uses)
    found = minimize(dual, first, jac=True, bounds=bounds, method="L-BFGS-B")
    return chosen(found.x)

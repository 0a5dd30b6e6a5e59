# SPDX-License-Identifier: LGPL-2.1-or-later
"""How thick struts or walls are to be, brick by brick of a homogenised part.

Least mass within limits by convex approximations (`sizing.optimise.cheapest`), most stiffness at a
mass by optimality criteria (M. P. Bendsoe and O. Sigmund, Topology Optimization, 2003, 1.2.1).
Thicknesses are means of what is chosen about each brick, so that they vary over a cell and more,
as the cell's homogenised stiffness presumes. A largest use of many is followed by its p-norm,
whose derivative an adjoint solution gives (C. Le et al., Struct. Multidisc. Optim. 41, 2010).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.sparse import csr_matrix, diags
from scipy.spatial import cKDTree

from ..loads.load_cases import LoadCase
from ..sizing.optimise import cheapest
from ..util.errors import VolfrepError
from ..util.progress import Monitor
from ..util.types import Floats
from ..voxels.loaded import VoxelCase
from ..voxels.multigrid import Multigrid
from .cell_law import in_cell
from .model import ContinuumModel, multigrid_of, stress_of

#: The power of the norm that stands for the largest of many.
NORM = 12.0
#: Derivatives are differences of models whose thicknesses differ by twice this share.
APART = 0.01
#: No thickness changes by more than this factor in a step, at first and at least.
MOVE, LEAST_MOVE = 1.25, 1.02
#: Power of an optimality criterion; criteria over a middle one are not looked at beyond these.
CRITERION, MERITS = 0.4, (1e-6, 1e6)
#: Logarithm of the largest factor by which all thicknesses are brought to a volume.
SPAN = 12.0
#: Steps without so much improvement end the search.
PATIENCE, BETTER = 6, 2e-3
#: How a use falls with all thicknesses, as a power; and steps towards limits by one factor.
POWER, SCALINGS = 2.0, 10
#: A design holds its limits when none is used more than this.
HOLDS = 1.0 + 1e-3
#: Of the forces that are left, over the loads, on the way.
ROUGH = 1e-5


@dataclass(frozen=True)
class FieldLimits:
    """What no load case goes beyond; None where there is no such limit.

    Attributes:
        use: of the solid's yield stress in the lattice.
        displacement: of any node, mm.
    """

    use: float | None = None
    displacement: float | None = None

    @property
    def any(self) -> bool:
        """Whether there is one."""
        return self.use is not None or self.displacement is not None


@dataclass(frozen=True, eq=False)
class FieldProblem:
    """A part whose struts or walls may be as thick as one likes, within bounds.

    Attributes:
        model_of: the homogenised part of (e,) thicknesses, mm.
        volume_of: about the volume of its lattice and skin, mm3, at once.
        cases: what it carries.
        middles: (e, 3) of the bricks, mm.
        thinnest, thickest: mm.
        reach: mm, over which chosen thicknesses are made even.
        monitor: asked for a cancel.
    """

    model_of: Callable[[Floats], ContinuumModel]
    volume_of: Callable[[Floats], float]
    cases: Sequence[LoadCase]
    middles: Floats
    thinnest: float
    thickest: float
    reach: float
    monitor: Monitor


@dataclass(frozen=True)
class FieldStep:
    """A design on the way.

    Attributes:
        volume: of lattice and skin, mm3.
        work: the sum over the cases of what they are at the start over their number.
        uses: of each limit, the largest over the cases.
    """

    volume: float
    work: float
    uses: dict[str, float]

    @property
    def most_used(self) -> float:
        """The largest use; 0 without limits."""
        return max(self.uses.values(), default=0.0)


@dataclass(frozen=True, eq=False)
class FieldFound:
    """A field, and how it was come to.

    Attributes:
        thickness: (e,) mm.
        steps: all on the way.
        thicker_helps: False where a limit is not held, and thicker all over goes further beyond it.
    """

    thickness: Floats
    steps: tuple[FieldStep, ...]
    thicker_helps: bool = True


def evened(points: Floats, reach: float) -> Any:
    """(n, n) sparse means over what lies within a reach, nearer ones weighing more."""
    pairs = cKDTree(points).query_pairs(reach, output_type="ndarray")
    weights = reach - np.linalg.norm(points[pairs[:, 0]] - points[pairs[:, 1]], axis=1)
    rows = np.concatenate([pairs[:, 0], pairs[:, 1], np.arange(len(points))])
    columns = np.concatenate([pairs[:, 1], pairs[:, 0], np.arange(len(points))])
    entries = np.concatenate([weights, weights, np.full(len(points), reach)])
    matrix = csr_matrix((entries, (rows, columns)), (len(points),) * 2)
    return diags(1.0 / np.asarray(matrix.sum(axis=1)).ravel()) @ matrix


def filled_volume(model: ContinuumModel) -> float:
    """Of lattice and skin, mm3."""
    return float(model.loaded.shares.sum() * np.prod(model.bricks.edge))


@dataclass(frozen=True, eq=False)
class _Solved:
    """A case solved: what `ContinuumState` tells of it, and its equations for adjoint loads."""

    case: LoadCase
    laid: VoxelCase
    displacements: Floats
    own: Floats
    use: Floats
    work: float
    solver: Multigrid


class _Best:
    """The lightest design that holds its limits; where none does, that whose are used least."""

    def __init__(self, chosen: Floats) -> None:
        self.chosen, self._rank = chosen, (np.inf, np.inf)

    def take(self, found: FieldStep, chosen: Floats) -> None:
        """Keep a design if it is better than what is kept."""
        rank = max(found.most_used, HOLDS), found.volume
        if rank < self._rank:
            self.chosen, self._rank = chosen, rank


class _Search:
    """Designs of a problem, analysed."""

    def __init__(self, problem: FieldProblem, limits: FieldLimits) -> None:
        self.problem, self.limits = problem, limits
        self.even = evened(problem.middles, problem.reach)
        self.first: Floats | None = None
        self.steps: list[FieldStep] = []
        self._last: dict[str, Floats] = {}

    def solve(self, model: ContinuumModel) -> list[_Solved]:
        """All load cases."""
        solvers: list[tuple[VoxelCase, Multigrid]] = []
        found = []
        for case in self.problem.cases:
            laid = model.loaded.case(case)
            known = [one for like, one in solvers if np.array_equal(like.fixed, laid.fixed)]
            if not known:
                known = [multigrid_of(model, ~laid.fixed, self.problem.monitor)]
                solvers.append((laid, known[0]))
            solver = known[0]
            displacements, _ = laid.solve(solver, ROUGH, self._last.get(case.name))
            self._last[case.name] = displacements
            own = displacements[model.elements.nodes].reshape(-1, 24)
            use, _ = stress_of(model, own)
            work = float(np.vdot(displacements, laid.loads))
            found.append(_Solved(case, laid, displacements, own, use, work, solver))
        return found

    def step(self, model: ContinuumModel, solved: Sequence[_Solved]) -> FieldStep:
        """What a design comes to; it is kept."""
        works = np.array([one.work for one in solved])
        if self.first is None:
            self.first = np.maximum(np.abs(works), 1e-300)
        uses = {}
        if self.limits.use is not None:
            uses["stress"] = max(float(one.use.max()) for one in solved) / self.limits.use
        if self.limits.displacement is not None:
            most = max(float(np.linalg.norm(one.displacements, axis=1).max()) for one in solved)
            uses["displacement"] = most / self.limits.displacement
        found = FieldStep(filled_volume(model), float((works / self.first).mean()), uses)
        self.steps.append(found)
        return found

    def changes(
        self, thickness: Floats, model: ContinuumModel, solved: Sequence[_Solved]
    ) -> tuple[Floats, Floats, Floats, Floats]:
        """(e,) of the volume and of the work, (c,) uses and (e, c) of these, all to thickness."""
        at = self.problem.model_of
        thin, thick = at(thickness * (1.0 - APART)), at(thickness * (1.0 + APART))
        width = 2.0 * APART * thickness
        size = float(np.prod(model.bricks.edge))
        more = (thick.loaded.shares - thin.loaded.shares) / width
        stiffer = (thick.matrices - thin.matrices).astype(float) / width[:, None, None]
        weight = more * size * model.material.density * 1e-9 / 8.0

        def shared(one: _Solved, by: Floats) -> Floats:
            """(e,) what a displacement field's force of what changes is: adjoint times residual."""
            mine = by[model.elements.nodes].reshape(-1, 24)
            pulled = np.einsum("ea,eab,eb->e", mine, stiffer, one.own, optimize=True)
            own = mine.reshape(-1, 8, 3).sum(axis=1) @ np.asarray(one.case.acceleration)
            return np.asarray(weight * own - pulled)

        assert self.first is not None
        work, uses, columns = np.zeros(len(thickness)), [], []
        for k, one in enumerate(solved):
            if not self.limits.any:
                # The work of forces is their own adjoint; weight counts twice.
                mine = one.displacements[model.elements.nodes]
                own = mine.sum(axis=1) @ np.asarray(one.case.acceleration)
                work += (
                    (shared(one, one.displacements) + weight * own) / self.first[k] / len(solved)
                )
            if self.limits.use is not None:
                most = float(one.use.max())
                slope, near = _norm_slope(one.use)
                load = model.at_nodes(_use_slopes(model, one.own) * (slope * near)[:, None])
                adjoint, _ = one.solver.solve(load, tolerance=10 * ROUGH)
                after, before = (stress_of(other, one.own)[0] for other in (thick, thin))
                direct = slope * near * (after - before) / width
                uses.append(most / self.limits.use)
                columns.append((direct + shared(one, adjoint)) / self.limits.use)
            if self.limits.displacement is not None:
                sizes = np.linalg.norm(one.displacements, axis=1)
                slope, near = _norm_slope(sizes)
                load = (slope * near / np.maximum(sizes, 1e-300))[:, None] * one.displacements
                adjoint, _ = one.solver.solve(load, tolerance=10 * ROUGH)
                uses.append(float(sizes.max()) / self.limits.displacement)
                columns.append(shared(one, adjoint) / self.limits.displacement)
        every = np.stack(columns, axis=1) if columns else np.zeros((len(thickness), 0))
        turn = self.even.T
        return turn @ (more * size), turn @ work, np.array(uses), turn @ every


def _norm_slope(values: Floats) -> tuple[Floats, float]:
    """(n,) derivative of the norm to each value, and the largest over the norm."""
    most = float(values.max())
    share = values / max(most, 1e-300)
    norm = float((share**NORM).sum() ** (1.0 / NORM))
    return (share / norm) ** (NORM - 1.0), 1.0 / norm


def _use_slopes(model: ContinuumModel, own: Floats) -> Floats:
    """(e, 24) derivatives of the lattice's share of yield to its bricks' displacements."""
    frames = np.broadcast_to(model.frames, (len(own), 3, 3))
    limit = model.material.yield_stress or np.nan
    bears = np.repeat(np.broadcast_to(model.strength, (len(own), 2)), 3, axis=1) * limit
    with np.errstate(divide="ignore"):
        rise = np.sign(model.cell_stress(own)) / bears
    local = np.stack(
        [in_cell(np.broadcast_to(one, (len(frames), 6)), frames) for one in np.eye(6)], axis=2
    )
    back = np.einsum("ek,ekj->ej", rise, local)
    result: Floats = (model.whole @ back[:, :, None])[:, :, 0] @ model.middle
    return result


def stiffest_field(problem: FieldProblem, start: float, most_steps: int = 40) -> FieldFound:
    """The field by which forces do the least work, at the volume that one thickness makes.

    Args:
        problem: what carries what; all cases count alike.
        start: mm, that thickness.
        most_steps: it ends then, or when it has converged.

    Raises:
        VolfrepError: forces do no work in a case, or the part is not held.
        Cancelled: when the monitor says so.
    """
    search = _Search(problem, FieldLimits())
    chosen = np.full(len(problem.middles), start)
    volume = problem.volume_of(chosen)
    best, least, since, move = chosen, np.inf, 0, MOVE
    for number in range(most_steps):
        problem.monitor.tick(number / most_steps)
        thickness = search.even @ chosen
        model = problem.model_of(thickness)
        solved = search.solve(model)
        if any(one.work <= 0.0 or one.laid.prescribed.any() for one in solved):
            raise VolfrepError(
                "Stiffness is how little a part gives way to forces, and a load case has none, or "
                "moves a support: give limits instead, or forces."
            )
        found = search.step(model, solved)
        since = 0 if found.work < least * (1.0 - BETTER) else since + 1
        if found.work < least:
            best, least = chosen, found.work
        else:
            move = max(LEAST_MOVE, move**0.5)
        if since >= PATIENCE or number == most_steps - 1:
            break
        cost, change, _, _ = search.changes(thickness, model, solved)
        merit = np.maximum(-change, 0.0) / np.maximum(cost, 1e-300)
        merit /= max(float(np.median(merit)), 1e-300)
        wanted = chosen * np.clip(merit, *MERITS) ** CRITERION
        low = np.maximum(problem.thinnest, chosen / move)
        high = np.minimum(problem.thickest, chosen * move)
        chosen = _at_volume(search, wanted, volume, low, high)
    return FieldFound(search.even @ best, tuple(search.steps))


def _at_volume(search: _Search, wanted: Floats, volume: float, low: Floats, high: Floats) -> Floats:
    """What is wanted times one factor, within bounds, at a volume, mm3."""
    least, most = -SPAN, SPAN
    while True:
        middle = 0.5 * (least + most)
        chosen: Floats = np.clip(wanted * np.exp(middle), low, high)
        if most - least < 1e-6:
            return chosen
        if search.problem.volume_of(search.even @ chosen) > volume:
            most = middle
        else:
            least = middle


def lightest_field(
    problem: FieldProblem, limits: FieldLimits, start: float, most_steps: int = 40
) -> FieldFound:
    """The field of the least volume that goes beyond no limit.

    Args:
        problem: what carries what.
        limits: at least one.
        start: mm, one thickness to begin with.
        most_steps: it ends then, or when it has converged.

    Raises:
        VolfrepError: there is no limit, or the part is not held.
        Cancelled: when the monitor says so.
    """
    if not limits.any:
        raise VolfrepError("Least mass needs a limit: a safety against yield, or a displacement.")
    search = _Search(problem, limits)
    chosen = np.full(len(problem.middles), start)
    best = _Best(chosen)
    least, nearest, since, move = np.inf, np.inf, 0, MOVE
    for number in range(most_steps):
        problem.monitor.tick(number / most_steps)
        thickness = search.even @ chosen
        model = problem.model_of(thickness)
        solved = search.solve(model)
        found = search.step(model, solved)
        # What it would weigh when brought to its limits by one factor for all.
        reached = found.volume * found.most_used ** (1.0 / POWER)
        best.take(found, chosen)
        over = max(found.most_used, 1.0)
        better = reached < least * (1.0 - BETTER) or over < nearest * (1.0 - BETTER)
        since = 0 if better else since + 1
        if not better:
            move = max(LEAST_MOVE, move**0.7)
        least, nearest = min(least, reached), min(nearest, over)
        if since >= PATIENCE or number == most_steps - 1:
            break
        cost, _, uses, changes = search.changes(thickness, model, solved)
        low = np.maximum(problem.thinnest, chosen / move)
        high = np.minimum(problem.thickest, chosen * move)
        chosen = cheapest(chosen, np.maximum(cost, 1e-12), uses, changes, low, high)
    helps = _to_limits(search, chosen, best)
    return FieldFound(search.even @ best.chosen, tuple(search.steps), helps)


def _to_limits(search: _Search, chosen: Floats, best: _Best) -> bool:
    """Bring the last design to its limits by one factor, for the best to take; see `FieldFound`.

    Returns:
        Whether thicker all over helps, where no design on the way holds.
    """
    problem = search.problem
    low = high = None
    log, before = 0.0, np.inf
    for _ in range(SCALINGS):
        scaled = np.clip(chosen * np.exp(log), problem.thinnest, problem.thickest)
        model = problem.model_of(search.even @ scaled)
        found = search.step(model, search.solve(model))
        best.take(found, scaled)
        if found.most_used <= HOLDS:
            high = log, found.most_used
        else:
            low = log, found.most_used
        if high is None and found.most_used > before:
            return False  # What is stiffer takes more.
        before = min(before, found.most_used)
        full = bool((scaled >= problem.thickest * (1.0 - 1e-9)).all())
        if 1.0 - 2e-3 <= found.most_used <= HOLDS or (full and high is None):
            break
        if low is None or high is None:
            log += np.clip(np.log(found.most_used) / POWER, -0.25, 0.25) + 1e-3
        else:
            over, under = np.log(low[1]), np.log(high[1])
            share = np.clip(over / max(over - under, 1e-12), 0.1, 0.9)
            log = low[0] + share * (high[0] - low[0])
            if high[0] - low[0] < 1e-4:
                break
    return True

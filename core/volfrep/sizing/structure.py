# SPDX-License-Identifier: LGPL-2.1-or-later
"""What carries: struts, what else is stiff, and how both are joined; solved for load cases."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from copy import copy
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from scipy import sparse
from scipy.linalg import eigh
from scipy.sparse.linalg import LinearOperator, eigsh

from ..fem.model import Case
from ..util.types import Bools, Floats, Ints
from .block_matrix import BlockPattern, Factored, definite, factorise, mask_fixed
from .strut_results import Columns
from .tapered_beams import Beams

_UNIT = np.eye(6)
#: A load factor is sought from so near below it, and in so many steps at most.
_NEAR_BUCKLING, _SHIFTS = 0.15, 12
#: Accuracy of what a step on the way to it is, relative.
_LOOSE = 1e-3
#: Matrices of no more rows are solved as full ones.
_FEW = 120


@dataclass(frozen=True, eq=False)
class MultiPointConstraints:
    """Nodes that move as others do.

    Attributes:
        nodes: (t,) rows of the structure's nodes.
        leaders: (t, 3) the nodes that each follows.
        blocks: (t, 3, 6, 6) what each leader's displacement and turn give to its own.
    """

    nodes: Ints
    leaders: Ints
    blocks: Floats


NO_CONSTRAINTS = MultiPointConstraints(
    np.empty(0, np.int64), np.empty((0, 3), np.int64), np.empty((0, 3, 6, 6))
)


@dataclass(frozen=True, eq=False)
class Blocks:
    """Blocks of a stiffness or a mass that no radius changes, both halves of it.

    Attributes:
        rows, columns: (c,) nodes.
        stiffness, mass: (c, 6, 6).
    """

    rows: Ints
    columns: Ints
    stiffness: Floats
    mass: Floats


@dataclass(frozen=True, eq=False)
class Structure:
    """Nodes, the struts between them, and what else is there.

    Attributes:
        nodes: (n, 3) mm.
        beams: the struts.
        constraints: nodes that follow others.
        fixed_blocks: of a skin; None for none.
        attached: (n,) t, of bodies that move with the nodes; None for none.
    """

    nodes: Floats
    beams: Beams
    constraints: MultiPointConstraints = NO_CONSTRAINTS
    fixed_blocks: Blocks | None = None
    attached: Floats | None = None
    _pattern: BlockPattern = field(init=False, repr=False)
    _tied: Bools = field(init=False, repr=False)
    _ends: tuple[Ints, Floats] = field(init=False, repr=False)

    def __post_init__(self) -> None:
        struts = self.beams.struts
        leader_of = np.full(len(self.nodes), -1, np.int64)
        leader_of[self.constraints.nodes] = np.arange(len(self.constraints.nodes))
        tied = (leader_of[struts] >= 0).any(axis=1)
        # Struts with an end that follows others have three leaders at each end, where an end
        # of its own counts as one that leads itself.
        ends = struts[tied]
        leaders = np.repeat(ends[:, :, None], 3, axis=2)
        blocks = np.zeros((*ends.shape, 3, 6, 6))
        blocks[:, :, 0] = _UNIT
        follows = leader_of[ends]
        leaders[follows >= 0] = self.constraints.leaders[follows[follows >= 0]]
        blocks[follows >= 0] = self.constraints.blocks[follows[follows >= 0]]
        leaders, blocks = leaders.reshape(-1, 6), blocks.reshape(-1, 6, 6, 6)
        first, second = struts[~tied].T
        rows = [first, first, second, second, np.repeat(leaders, 6, axis=1).ravel()]
        columns = [first, second, first, second, np.tile(leaders, (1, 6)).ravel()]
        changing = sum(map(len, rows))
        if self.fixed_blocks is not None:
            rows.append(self.fixed_blocks.rows)
            columns.append(self.fixed_blocks.columns)
        pattern = BlockPattern(self.nodes, np.concatenate(rows), np.concatenate(columns), changing)
        object.__setattr__(self, "_pattern", pattern)
        object.__setattr__(self, "_tied", tied)
        object.__setattr__(self, "_ends", (leaders, blocks))

    def with_blocks(self, blocks: Blocks) -> Structure:
        """The same with other numbers in its fixed blocks, whose nodes are the same."""
        result = copy(self)
        for name in ("_fixed_stiffness", "_fixed_mass"):
            result.__dict__.pop(name, None)
        object.__setattr__(result, "fixed_blocks", blocks)
        return result

    def factored(self, radii: Floats, fixed: Bools) -> Factored:
        """The stiffness of struts with these radii (m, 2), ready to be solved.

        Raises:
            VolfrepError: a part of the structure can move without resistance.
        """
        parts = self.beams.stiffness(self.beams.flexibility(radii))
        return factorise(self._pattern, self._assembled(parts, self._fixed_stiffness), fixed)

    def mass(self, radii: Floats) -> sparse.csc_matrix:
        """The consistent mass, t and t mm2, in the pattern's order."""
        return self._assembled(self.beams.mass(radii), self._fixed_mass)

    def displacements(self, radii: Floats, cases: Sequence[Case]) -> tuple[Floats, list[Factored]]:
        """How the nodes move in every load case.

        Args:
            radii: (m, 2) of the struts, mm.
            cases: what they carry.

        Returns:
            (n, 6, cases) mm and radians; and each case's factored stiffness, of which cases with
            equal supports share one.

        Raises:
            VolfrepError: a part of the structure can move without resistance.
        """
        factors: list[Factored] = []
        for k, case in enumerate(cases):
            fixed = case.fixed
            same = next((j for j in range(k) if np.array_equal(cases[j].fixed, fixed)), None)
            factors.append(self.factored(radii, fixed) if same is None else factors[same])
        loads = self.all_loads(radii, cases)
        prescribed = None
        if any(case.prescribed is not None for case in cases):
            still = np.zeros((len(self.nodes), 6))
            given = [still if case.prescribed is None else case.prescribed for case in cases]
            prescribed = np.stack(given, axis=-1)
        return self.answers(factors, loads, prescribed), factors

    def answers(
        self, factors: Sequence[Factored], loads: Floats, prescribed: Floats | None = None
    ) -> Floats:
        """(n, 6, k) displacements under loads (n, 6, k), each with its factored stiffness."""
        loads = self.condensed(loads)
        result = np.zeros_like(loads)
        kinds = {id(factor): factor for factor in factors}
        for name, factor in kinds.items():
            own = np.array([id(each) == name for each in factors])
            given = None if prescribed is None else prescribed[:, :, own]
            result[:, :, own] = factor.displacements(loads[:, :, own], given)
        return self.with_dependents(result)

    def all_loads(self, radii: Floats, cases: Sequence[Case]) -> Floats:
        """(n, 6, cases) N and N mm, with what accelerations add."""
        loads = np.stack([case.loads for case in cases], axis=-1)
        if any(any(case.acceleration) for case in cases):
            mass = self.mass(radii)
            for k, case in enumerate(cases):
                acceleration = np.zeros_like(case.loads)
                acceleration[:, :3] = case.acceleration
                # On leaders already: what follows them has no unknowns of its own.
                loads[:, :, k] += self._pattern.restored(mass @ self._pattern.ordered(acceleration))
        return loads

    def forces(self, radii: Floats, displacements: Floats) -> Floats:
        """(m, 6, k) in the struts, see `Beams.forces`, of displacements (n, 6, k)."""
        first, second = self.beams.struts.T
        flexibility = self.beams.flexibility(radii)
        return self.beams.forces(flexibility, displacements[first], displacements[second])

    def with_dependents(self, displacements: Floats) -> Floats:
        """The displacements (n, 6, k) with those of the nodes that follow others."""
        constraints = self.constraints
        if len(constraints.nodes):
            displacements = displacements.copy()
            displacements[constraints.nodes] = np.einsum(
                "tlij,tljk->tik", constraints.blocks, displacements[constraints.leaders]
            )
        return displacements

    def condensed(self, loads: Floats) -> Floats:
        """Loads (n, 6) or (n, 6, k) with those on nodes that follow others at their leaders."""
        constraints = self.constraints
        if not len(constraints.nodes):
            return loads
        given = loads if loads.ndim == 3 else loads[:, :, None]
        result = given.copy()
        result[constraints.nodes] = 0.0
        shares = np.einsum("tlji,tjk->tlik", constraints.blocks, given[constraints.nodes])
        np.add.at(result, constraints.leaders, shares)
        return result if loads.ndim == 3 else result[:, :, 0]

    def modes(
        self,
        radii: Floats,
        fixed: Bools,
        count: int = 6,
        *,
        factor: Factored | None = None,
        tolerance: float = 1e-8,
    ) -> tuple[Floats, Floats]:
        """Natural frequencies and their modes.

        Args:
            radii: (m, 2) of the struts, mm.
            fixed: (n, 6) bool.
            count: how many of the lowest.
            factor: the stiffness of these radii and supports, if it is there.
            tolerance: of the eigenvalues, relative.

        Returns:
            (count,) Hz, and (n, 6, count) modes of unit mass.

        Raises:
            VolfrepError: a part of the structure can move without resistance.
        """
        factor = factor or self.factored(radii, fixed)
        whole = self.mass(radii)
        if self.attached is not None:
            own = np.zeros((len(self.nodes), 6))
            own[:, :3] = self.attached[:, None]
            whole = sparse.csc_matrix(whole + sparse.diags(self._pattern.ordered(own)))
        mass = mask_fixed(whole, factor.free, 0.0)
        size = mass.shape[0]
        inverse = LinearOperator((size, size), lambda b: factor.solve(np.asarray(b, float)))
        start = np.where(factor.free, np.cos(np.arange(size)), 0.0)
        values, vectors = eigsh(
            factor.matrix, count, mass, sigma=0.0, OPinv=inverse, v0=start, tol=tolerance
        )
        order = np.argsort(values)
        modes = self.with_dependents(self._pattern.restored(vectors[:, order]))
        return np.sqrt(np.maximum(values[order], 0.0)) / (2.0 * np.pi), modes

    def buckling(
        self,
        columns: Columns,
        forces: Floats,
        factor: Factored,
        count: int = 1,
        pressed: Floats | None = None,
    ) -> tuple[Floats, Floats]:
        """How many times the forces may be before struts, and the skin, buckle together.

        Struts are columns whose joints move and turn. From a load factor below the lowest, at which
        the stiffness is still positive definite, the next ones are those of a linear problem; so
        near to the lowest that a last step on what bends makes it right.

        Args:
            columns: the struts.
            forces: (m, 6) in them, see `Beams.forces`.
            factor: the stiffness of the same radii.
            count: how many of the lowest.
            pressed: (b, 6, 6) what the forces in a skin add to the first of the fixed blocks; None
                for a skin that is as stiff as without them.

        Returns:
            (count,) load factors, inf where nothing buckles; and (n, 6, count) modes, each scaled
            so that the loads' work in it falls by 1 where the load factor rises by 1.
        """
        free, axial = factor.free, forces[:, 0]
        is_pressed = axial < 0.0
        nothing = np.full(count, np.inf), np.zeros((len(self.nodes), 6, count))
        if pressed is None and not is_pressed.any():
            return nothing
        shares = columns.clamped()[is_pressed] / -axial[is_pressed]
        most = float(shares.min(initial=np.inf))
        fixed, more = self._fixed_stiffness, None
        if pressed is not None and fixed is not None and self.fixed_blocks is not None:
            whole_blocks = np.zeros_like(self.fixed_blocks.stiffness)
            whole_blocks[: len(pressed)] = pressed
            more = self._pattern.constant(whole_blocks)

        def at(place: float) -> tuple[sparse.csc_matrix, sparse.csc_matrix]:
            whole, change = columns.blocks(place, forces)
            stays = fixed if fixed is None or more is None else fixed + place * more
            stiffness = self._assembled(whole, stays)
            return mask_fixed(stiffness, free), mask_fixed(self._assembled(change, more), free, 0.0)

        place, solve, (matrix, change) = 0.0, factor.solve, at(0.0)
        vectors = np.where(free, np.cos(np.arange(len(free))), 0.0)[:, None]
        for _ in range(_SHIFTS):
            steps, vectors = _steps_to_singular(matrix, change, solve, vectors[:, 0], count)
            lowest = min(place + float(steps[0]), most)
            if not np.isfinite(lowest):
                return nothing
            if lowest - place <= _NEAR_BUCKLING * lowest:
                break
            ahead = lowest
            for _ in range(_SHIFTS):
                # Nearer to the lowest, but not beyond it.
                ahead -= (1.0 if ahead < lowest else 0.5) * _NEAR_BUCKLING * (ahead - place)
                matrix, change = at(ahead)
                inverse = definite(matrix)
                if inverse is not None:
                    place, solve = ahead, inverse
                    break
        at_lowest = min(lowest, (1.0 - 1e-6) * most)
        matrix, change = at(at_lowest)
        stiff = np.einsum("ik,ik->k", vectors, matrix @ vectors)
        softer = np.einsum("ik,ik->k", vectors, change @ vectors)
        found = np.where(softer < 0.0, at_lowest - stiff / np.minimum(softer, -1e-300), np.inf)
        vectors = vectors * np.where(softer < 0.0, np.maximum(-softer, 1e-300) ** -0.5, 0.0)
        order = np.argsort(found)
        found = found[order]
        found[0] = min(found[0], most)  # where joints stay, a strut buckles between them
        return found, self.with_dependents(self._pattern.restored(vectors[:, order]))

    @cached_property
    def _fixed_stiffness(self) -> Floats | None:
        fixed = self.fixed_blocks
        return None if fixed is None else self._pattern.constant(fixed.stiffness)

    @cached_property
    def _fixed_mass(self) -> Floats | None:
        fixed = self.fixed_blocks
        return None if fixed is None else self._pattern.constant(fixed.mass)

    def _assembled(
        self, parts: tuple[Floats, Floats, Floats], fixed: Floats | None = None
    ) -> sparse.csc_matrix:
        tied, (_, ends) = self._tied, self._ends
        first, between, second = (part[~tied] for part in parts)
        blocks = [first, between, between.swapaxes(1, 2), second]
        if tied.any():
            of_first, of_second = ends[:, :3], ends[:, 3:]
            first, between, second = (part[tied] for part in parts)
            whole = np.empty((len(first), 6, 6, 6, 6))
            whole[:, :3, :3] = _led(of_first, first, of_first)
            whole[:, :3, 3:] = _led(of_first, between, of_second)
            whole[:, 3:, :3] = _led(of_second, between.swapaxes(1, 2), of_first)
            whole[:, 3:, 3:] = _led(of_second, second, of_second)
            blocks.append(whole.reshape(-1, 6, 6))
        return self._pattern.matrix(np.concatenate(blocks), fixed)


def _led(left: Floats, block: Floats, right: Floats) -> Floats:
    """(t, 3, 3, 6, 6) what a block between two ends is between their leaders."""
    half = block[:, None] @ right  # (t, 3, 6, 6)
    result: Floats = left.swapaxes(2, 3)[:, :, None] @ half[:, None]
    return result


def _steps_to_singular(
    matrix: sparse.csc_matrix,
    change: sparse.csc_matrix,
    solve: Callable[[Floats], Floats],
    start: Floats,
    count: int,
) -> tuple[Floats, Floats]:
    """The smallest steps s > 0 for which a positive definite matrix + s change is singular.

    Args:
        matrix: positive definite.
        change: symmetric.
        solve: of the matrix.
        start: a vector to begin with.
        count: how many.

    Returns:
        (count,) steps, inf where there is none; and (n, count) what the matrix no longer resists.
    """
    size = matrix.shape[0]
    if size <= _FEW:  # too few for Lanczos' vectors
        last = [max(size - count, 0), size - 1]
        values, vectors = eigh(-change.toarray(), matrix.toarray(), subset_by_index=last)
    else:
        inverse = LinearOperator(matrix.shape, lambda b: solve(np.asarray(b, float)))
        values, vectors = eigsh(
            -change, count, matrix, which="LA", Minv=inverse, v0=start, tol=_LOOSE
        )
    order = np.argsort(-values)
    shares = values[order]
    steps = np.where(shares > 0.0, 1.0 / np.where(shares > 0.0, shares, 1.0), np.inf)
    return steps, vectors[:, order]

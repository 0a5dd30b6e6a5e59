# SPDX-License-Identifier: LGPL-2.1-or-later
"""What one set of radii at the nodes does: mass, stiffness, and how much of each limit it uses."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy.sparse import csr_matrix

from ..fem.model import Case
from ..util.errors import VolfrepError
from ..util.types import Bools, Floats, Ints
from .node_radii import NodeRadii
from .shell_elements import Shells
from .skin import SkinModel
from .skin_thickness import SkinThickness
from .structure import Structure
from .strut_results import buckling_loads, columns_of, stresses
from .tapered_beams import energies

#: Nodes that move more than this share of the farthest are looked at where derivatives are asked
#: for, so many of each case at most, no two nearer to each other than this share of the size.
_FAR, _MOVED, _ASIDE = 0.9, 12, 0.02
#: Of each case so many of the lowest load factors are looked at where derivatives are asked for:
#: what makes one larger must not make another one smaller.
_MODES = 4


@dataclass(frozen=True)
class Limits:
    """What a design must not go beyond, in every load case; None for no limit.

    Attributes:
        stress: von Mises in struts and skin, MPa.
        displacement: of any node, mm.
        buckling: how many times the load may be before the first strut buckles by itself.
        frequency: the lowest natural one, Hz, with the first case's supports.
        frame_buckling: how many times it may be before struts and skin buckle together.
        skin_stress: von Mises on both sides of a skin that is varied, MPa, on all but
            `util.peaks.PEAKS` of its area.
    """

    stress: float | None = None
    displacement: float | None = None
    buckling: float | None = None
    frequency: float | None = None
    frame_buckling: float | None = None
    skin_stress: float | None = None

    def __post_init__(self) -> None:
        for name, value in vars(self).items():
            if value is not None and not (np.isfinite(value) and value > 0.0):
                called = name.replace("_", " ")
                raise VolfrepError(f"The limit of {called} must be above 0, not {value}.")

    @property
    def any(self) -> bool:
        """Whether there is a limit at all."""
        return any(value is not None for value in vars(self).values())

    def as_dict(self) -> dict[str, float]:
        """Those that there are, by the names that their uses have."""
        there = {name: value for name, value in vars(self).items() if value is not None}
        return {name.replace("_", " "): value for name, value in there.items()}


@dataclass(frozen=True, eq=False)
class Problem:
    """A structure whose radii are varied.

    Attributes:
        structure: struts, and a skin if there is one.
        cases: what it carries.
        radii: at the nodes, what struts get of them.
        low: (n,) mm, the thinnest that each node's radius may be.
        high: (n,) mm, the thickest.
        watched: (nodes,) bool, where displacements are limited.
        smoother: (n, n) by which each step's radii are evened out with their neighbours'; None for
            not at all.
        stress_factor: (m,) how many times as stressed struts are as their beams say, where
            another solver has found more; None for as they say.
        skin: what of the variables is the skin's; None where it is not varied.
        around: the skin, varied or not, whose nodes are the structure's last ones; None for none.
        groups: (n,) a number that radii have in common which are to be equal, as their bounds are;
            None where each is its own.
        spares_stubs: whether the limit of stress leaves out `stubs`: in a search that fills the
            place of those that cannot bear their load.
    """

    structure: Structure
    cases: tuple[Case, ...]
    radii: NodeRadii
    low: Floats
    high: Floats
    watched: Bools
    smoother: csr_matrix | None = None
    stress_factor: Floats | None = None
    skin: SkinThickness | None = None
    around: SkinModel | None = None
    groups: Ints | None = None
    spares_stubs: bool = False

    @property
    def skin_first(self) -> int:
        """The row of the skin's first node among the structure's."""
        skin = self.around
        return len(self.structure.nodes) - (0 if skin is None else len(skin.outside.vertices))

    def stubs(self, radii: Floats) -> Bools:
        """(m,) struts that are no longer than wide: no radius makes beams of them."""
        of_struts = self.radii.of_struts(radii)
        return np.asarray(self.structure.beams.length <= of_struts.sum(axis=1))

    def shells(self, radii: Floats) -> Shells | None:
        """The skin's shells with the thickness of a design; None without a skin."""
        if self.around is None:
            return None
        own = self.around.shells
        return own if self.skin is None else own.of_thickness(self.skin.of_shells(radii))

    def structure_of(self, radii: Floats) -> Structure:
        """The structure with the skin of a design."""
        if self.skin is None:
            return self.structure
        return self.structure.with_blocks(self.skin.blocks(radii))

    def smoothed(self, radii: Floats) -> Floats:
        """The radii, evened out."""
        if self.smoother is None:
            return radii
        return self.most_alike(np.clip(self.smoother @ radii, self.low, self.high))

    def most_alike(self, values: Floats) -> Floats:
        """(n,) of those that are to be equal, the largest."""
        if self.groups is None:
            return values
        most = np.full(int(self.groups.max()) + 1, -np.inf)
        np.maximum.at(most, self.groups, values)
        return np.asarray(most[self.groups])

    def mean_alike(self, values: Floats) -> Floats:
        """(n,) or (n, c) of those that are to be equal, the mean."""
        if self.groups is None:
            return values
        total = np.zeros((int(self.groups.max()) + 1, *values.shape[1:]))
        np.add.at(total, self.groups, values)
        number = np.bincount(self.groups).reshape(-1, *[1] * (values.ndim - 1))
        return np.asarray((total / number)[self.groups])

    def alike(self, groups: Ints) -> Problem:
        """The same, whose radii with the same number are equal, and so are their bounds."""
        one = replace(self, groups=groups)
        return replace(one, low=one.most_alike(self.low), high=-one.most_alike(-self.high))


@dataclass(frozen=True, eq=False)
class Analysis:
    """What a design does.

    Attributes:
        radii: (n,) at the nodes, mm.
        volume: of the struts, mm3.
        compliance: (k,) N mm, work of the loads of each case.
        displacements: (nodes, 6, k) mm and radians.
        largest: (k,) watched displacement, mm.
        forces: (m, 6, k) in the struts.
        stress: (m, 2, k) von Mises at both ends of every strut, MPa.
        buckling: (m, k) share of its buckling load that every strut carries.
        frequency: lowest, Hz; nan where it was not asked for.
        factors: (k,) how many times each case's load may be before struts and skin buckle
            together, inf where they never do; nan where it was not asked for.
        uses: by the name of each limit that is given, the largest share of it that is used: 1 at
            the limit.
        worst: by the same names, the case (or -1) and the strut, node or shell where that is.
        skin_stress: (t, k) the larger von Mises stress of both sides of the shells of a skin that
            is varied, MPa; None without one.
    """

    radii: Floats
    volume: float
    compliance: Floats
    displacements: Floats
    largest: Floats
    forces: Floats
    stress: Floats
    buckling: Floats
    frequency: float
    factors: Floats
    uses: dict[str, float]
    worst: dict[str, tuple[int, int]]
    skin_stress: Floats | None = None

    @property
    def most_used(self) -> float:
        """The largest share of any limit; 0 where there is none."""
        return max(self.uses.values(), default=0.0)


@dataclass(frozen=True, eq=False)
class Changes:
    """Derivatives to the radii at the nodes.

    Attributes:
        compliance: (n, k) of each case's.
        displacement: (n, c) of the watched displacements over the limit that are near each case's
            largest; None without one.
        displacement_uses: (c,) what they are.
        frequency: (n,) of the limit over the lowest frequency; None without one.
        frame_buckling: (n, c) of the limit over the lowest load factors of each case; None without.
        frame_uses: (c,) what it is over them.
    """

    compliance: Floats
    displacement: Floats | None
    frequency: Floats | None
    frame_buckling: Floats | None = None
    frame_uses: Floats | None = None
    displacement_uses: Floats | None = None


def analyse(
    problem: Problem, radii: Floats, limits: Limits, *, with_changes: bool = False
) -> tuple[Analysis, Changes | None]:
    """Solve a design, and say how much it uses of the limits.

    Args:
        problem: what carries what.
        radii: (n,) at the nodes, mm.
        limits: whose use is asked for.
        with_changes: whether derivatives are, too.

    Raises:
        VolfrepError: a part of the structure can move freely.
    """
    structure, beams, skin = problem.structure_of(radii), problem.structure.beams, problem.skin
    of_struts = problem.radii.of_struts(radii)
    displacements, factors = structure.displacements(of_struts, problem.cases)
    forces = structure.forces(of_struts, displacements)
    loads = structure.all_loads(of_struts, problem.cases)
    compliance = np.einsum("nik,nik->k", loads, displacements)
    weakest = problem.radii.weakest(radii)
    stress = stresses(beams, weakest, forces).mises
    if problem.stress_factor is not None:
        stress = stress * problem.stress_factor[:, None, None]
    critical = buckling_loads(beams, weakest, len(structure.nodes))
    buckling = np.maximum(-forces[:, 0], 0.0) / critical[:, None]
    size = np.where(problem.watched[:, None], np.linalg.norm(displacements[:, :3], axis=1), 0.0)

    uses: dict[str, float] = {}
    worst: dict[str, tuple[int, int]] = {}
    if limits.stress is not None:
        held = stress
        if problem.spares_stubs:
            held = np.where(problem.stubs(radii)[:, None, None], 0.0, stress)
        strut, _, case = np.unravel_index(int(np.argmax(held)), held.shape)
        uses["stress"] = float(held.max()) / limits.stress
        worst["stress"] = int(case), int(strut)
    on_skin = None if skin is None else skin.stresses(radii, displacements)
    if limits.skin_stress is not None and skin is not None and on_skin is not None:
        skin_stress = skin.largest(on_skin)
        worst_shell = int(np.argmax(skin_stress))
        uses["skin stress"] = float(skin_stress[worst_shell]) / limits.skin_stress
        worst["skin stress"] = int(np.argmax(on_skin[worst_shell])), worst_shell
    if limits.buckling is not None:
        strut, case = np.unravel_index(int(np.argmax(buckling)), buckling.shape)
        uses["buckling"] = float(buckling.max()) * limits.buckling
        worst["buckling"] = int(case), int(strut)
    node, case = np.unravel_index(int(np.argmax(size)), size.shape)
    if limits.displacement is not None:
        uses["displacement"] = float(size.max()) / limits.displacement
        worst["displacement"] = int(case), int(node)
    frequency, mode = np.nan, None
    if limits.frequency is not None:
        fixed = problem.cases[0].fixed
        found, modes = structure.modes(of_struts, fixed, 1, factor=factors[0], tolerance=1e-6)
        frequency, mode = float(found[0]), modes
        uses["frequency"] = limits.frequency / frequency
        worst["frequency"] = -1, -1
    together: list[tuple[Floats, Floats]] = []
    if limits.frame_buckling is not None:
        columns, count = columns_of(beams, of_struts), _MODES if with_changes else 1
        for k, factor in enumerate(factors):
            pressed = _pressed(problem, radii, displacements[:, :, k])
            together.append(structure.buckling(columns, forces[:, :, k], factor, count, pressed))
        first = int(np.argmin([found[0] for found, _ in together]))
        uses["frame buckling"] = limits.frame_buckling / float(together[first][0][0])
        bent = structure.forces(of_struts, together[first][1][:, :, :1])
        energy = np.einsum("mfk,mf->m", energies(bent, bent), columns.flexibility)
        worst["frame buckling"] = first, int(np.argmax(energy))
    factor_of = np.array([found[0] for found, _ in together] or [np.nan] * len(factors))
    analysis = Analysis(
        radii, problem.radii.volume(radii), compliance, displacements, size.max(axis=0), forces,
        stress, buckling, frequency, factor_of, uses, worst, on_skin,
    )  # fmt: skip
    if not with_changes:
        return analysis, None

    slopes = beams.flexibility_changes(of_struts)

    def change(one: Floats, other: Floats, first: Floats, second: Floats) -> Floats:
        """(n, k) of the work of forces in the strain of others, which are those of motions."""
        work = energies(one, other)
        result = np.stack(
            [
                problem.radii.to_nodes(np.einsum("mf,mef->me", work[:, :, k], slopes))
                for k in range(work.shape[2])
            ],
            axis=1,
        )
        if skin is not None:
            result -= skin.to_variables(radii, skin.work(radii, first, second))
        return result

    def heavier(other: Floats) -> Floats:
        """(n, k) of the work of what acceleration pulls with in displacements (nodes, 6, k)."""
        result = np.zeros((len(radii), len(problem.cases)))
        for k, case in enumerate(problem.cases):
            if any(case.acceleration):
                acceleration = np.zeros(displacements.shape[:2])
                acceleration[:, :3] = case.acceleration
                result[:, k] = _mass_change(problem, radii, other[:, :, k], acceleration)
        return result

    of_displacement = of_frequency = displacement_uses = None
    if limits.displacement is not None:
        columns_at, far = [], []
        for k in range(len(factors)):
            for node in _far(size[:, k], structure.nodes):
                columns_at.append(k)
                far.append(int(node))
        at, every = np.array(columns_at), np.arange(len(far))
        way = np.zeros((len(displacements), 6, len(far)))
        reach = np.maximum(size[far, at], 1e-300)
        way[far, :3, every] = displacements[far, :3, at] / reach[:, None]
        back = structure.answers([factors[k] for k in at], way)
        virtual = structure.forces(of_struts, back)
        of_displacement = change(virtual, forces[:, :, at], back, displacements[:, :, at])
        for row, k in enumerate(columns_at):
            uniform = np.zeros(displacements.shape[:2])
            uniform[:, :3] = problem.cases[k].acceleration
            if uniform.any():
                of_displacement[:, row] += _mass_change(problem, radii, back[:, :, row], uniform)
        of_displacement = of_displacement / limits.displacement
        displacement_uses = size[far, at] / limits.displacement
    if limits.frequency is not None and mode is not None:
        strained = structure.forces(of_struts, mode)
        rate = (2.0 * np.pi * frequency) ** 2
        # d w2 = mode (dK - w2 dM) mode, and dK is - K dF K.
        stiffer = -change(strained, strained, mode, mode)[:, 0]
        mass = _mass_change(problem, radii, mode[:, :, 0], mode[:, :, 0])
        of_frequency = -0.5 * (stiffer - rate * mass) / rate * limits.frequency / frequency
    of_frame, frame_uses = [], []
    for k, (found, modes) in enumerate(together):
        lowest = np.isfinite(found)
        asked = limits.frame_buckling or np.nan
        frame_uses.append(asked / found[lowest])
        for place, mode in zip(found[lowest], modes.transpose(2, 0, 1)[lowest], strict=True):
            own = forces[:, :, k]
            stiffer = _columns_change(problem, radii, place * own, mode)
            turned_skin, skin_load = _pressed_change(problem, radii, displacements[:, :, k], mode)
            stiffer = stiffer + place * turned_skin
            strain = place * columns.turned_by(place * own, mode)
            way, initial = beams.strained(columns.flexibility, strain)
            nodal = np.zeros(displacements.shape[:2])
            np.add.at(nodal, beams.struts[:, 0], way[:, 0])
            np.add.at(nodal, beams.struts[:, 1], way[:, 1])
            nodal += place * skin_load
            back = structure.answers(factors[k : k + 1], nodal[:, :, None])
            virtual = structure.forces(of_struts, back) - initial[:, :, None]
            only = slice(k, k + 1)
            more = change(virtual, forces[:, :, only], back, displacements[:, :, only])[:, 0]
            if any(problem.cases[k].acceleration):
                everywhere = np.repeat(back, len(problem.cases), axis=2)
                more = more + heavier(everywhere)[:, k]
            of_frame.append(-(stiffer + more) * asked / place**2)
    of_compliance = change(forces, forces, displacements, displacements)
    of_compliance = of_compliance + 2.0 * heavier(displacements)
    return analysis, Changes(
        of_compliance, of_displacement, of_frequency,
        np.stack(of_frame, axis=1) if of_frame else None,
        np.concatenate(frame_uses) if of_frame else None, displacement_uses,
    )  # fmt: skip


def _far(size: Floats, nodes: Floats) -> Ints:
    """The nodes that move farthest, and those that move nearly as far and lie elsewhere.

    Each is given a price of its own: of nodes that move alike, one whose price alone is looked at
    would be held while the others go farther.
    """
    most = float(size.max())
    order = np.argsort(-size, kind="stable")
    order = order[size[order] >= _FAR * most]
    apart = _ASIDE * float(np.linalg.norm(np.ptp(nodes, axis=0)))
    kept: list[int] = []
    for node in order.tolist():
        if len(kept) == _MOVED:
            break
        if not kept or np.linalg.norm(nodes[kept] - nodes[node], axis=1).min() > apart:
            kept.append(node)
    return np.array(kept, np.int64)


def _columns_change(problem: Problem, radii: Floats, forces: Floats, mode: Floats) -> Floats:
    """(n,) derivative of mode K mode to the radii at the nodes, under the same forces (m, 6)."""
    beams, of_struts = problem.structure.beams, problem.radii.of_struts(radii)

    def work(radii: Floats) -> Floats:
        return columns_of(beams, radii).work(forces, mode)

    result = np.empty(of_struts.shape)
    for end in (0, 1):
        step = np.zeros(of_struts.shape)
        step[:, end] = 1e-4 * of_struts[:, end]
        result[:, end] = (work(of_struts + step) - work(of_struts - step)) / (2.0 * step[:, end])
    of_all, skin = problem.radii.to_nodes(result), problem.skin
    if skin is not None:
        bent = mode[:, :, None]
        of_all += skin.to_variables(radii, skin.work(radii, bent, bent))[:, 0]
    return of_all


def _pressed(problem: Problem, radii: Floats, displacements: Floats) -> Floats | None:
    """(c, 6, 6) what the forces in the skin add to its stiffness, of displacements (nodes, 6)."""
    if problem.around is None:
        return None
    return problem.around.pressed(displacements[problem.skin_first :], problem.shells(radii))


def _pressed_change(
    problem: Problem, radii: Floats, displacements: Floats, mode: Floats
) -> tuple[Floats, Floats]:
    """Derivatives of what the skin's forces do in a mode (nodes, 6).

    Returns:
        (n,) to the variables, displacements as they are; and (nodes, 6) to the displacements.
    """
    own, nodal = np.zeros(len(radii)), np.zeros(displacements.shape)
    around, shells = problem.around, problem.shells(radii)
    if around is None or shells is None:
        return own, nodal
    first = problem.skin_first
    work = shells.pressed_work(around.of_middle(mode[first:, :, None])[:, :, 0])
    if problem.skin is not None:
        even = shells.in_plane(around.of_middle(displacements[first:, :, None]))[:, :, 0]
        change = shells.filled * (work * even).sum(axis=1)
        own = problem.skin.to_variables(radii, change[:, None])[:, 0]
    middle = np.zeros((len(around.middle), 6))
    np.add.at(middle, shells.triangles, shells.pressed_gradient(work))
    nodal[first:] = around.to_outside(middle)
    return own, nodal


def _mass_change(problem: Problem, radii: Floats, left: Floats, right: Floats) -> Floats:
    """(n,) derivative of left M right to the radii at the nodes, by a step at each strut's end.

    Of motions (nodes, 6); the mass is that of the struts, and of a skin that is varied.
    """
    beams, of_struts = problem.structure.beams, problem.radii.of_struts(radii)
    first, second = beams.struts.T

    def work(radii: Floats) -> Floats:
        one, between, two = beams.mass(radii)
        return np.asarray(
            np.einsum("mi,mij,mj->m", left[first], one, right[first])
            + np.einsum("mi,mij,mj->m", left[first], between, right[second])
            + np.einsum("mi,mij,mj->m", right[first], between, left[second])
            + np.einsum("mi,mij,mj->m", left[second], two, right[second])
        )

    result = np.empty(of_struts.shape)
    for end in (0, 1):
        step = np.zeros(of_struts.shape)
        step[:, end] = 1e-4 * of_struts[:, end]
        change = work(of_struts + step) - work(of_struts - step)
        result[:, end] = change / (2.0 * step[:, end])
    of_all, skin = problem.radii.to_nodes(result), problem.skin
    if skin is not None:
        of_all += skin.to_variables(radii, skin.mass_work(radii, left, right))[:, 0]
    return of_all

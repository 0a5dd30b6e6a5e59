# SPDX-License-Identifier: LGPL-2.1-or-later
"""The final design proved by CalculiX, and limits by which it holds the given ones there.

The deck has the same struts, joints, supports and loads as the design (`fem/solved_frame`).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ..design.cells import UnitCell
from ..fem.beam_mesh import JOINT_STIFFNESS, BeamMesh, beam_model, ends_law
from ..fem.calculix import find_calculix
from ..fem.model import Case
from ..fem.solved_frame import SolidSkin, SolvedFrame, solve_frame
from ..fem.wedge_mesh import WedgeMesh, beyond_inner, wedge_mesh
from ..grid.strut_graph import Wireframe
from ..mechanics.elements import von_mises
from ..mechanics.frame import Ends
from ..mechanics.materials import SolidMaterial
from ..util.linalg import cross_matrix
from ..util.peaks import most_but_peaks
from ..util.progress import Monitor
from ..util.types import Bools, Floats, Ints
from .analysis import Analysis, Limits, Problem
from .model import SizingModel
from .skin import SkinModel
from .strut_results import stresses
from .tapered_beams import Beams

#: Beams of more struts are not solved by CalculiX unless it is asked for.
MOST_PROVED = 6_000
#: Radius of a rigid arm over its length.
_THIN = 0.1
#: Both sides of what is solid are held together by so many times their thickness' stiffness.
HELD_TOGETHER = 100.0
#: Struts count as more stressed in CalculiX where they have this share there of the largest stress,
#: that of the design itself or that in CalculiX, whichever is less.
TELLING = 0.5
#: Struts that are more stressed there are held to this part of the limit, as others bear then what
#: they bore.
SHARED = 0.98
#: A node has no part of a vertex whose share in it is smaller.
_NOT_BESIDE = 1e-6
#: A limit that CalculiX finds used more than this makes the design a little thicker.
PROVED = 1.003
#: A design is confirmed where nothing that both solutions say differs by more than this part.
AGREES = 0.15


@dataclass(frozen=True, eq=False)
class Proved:
    """What CalculiX says of a design.

    Attributes:
        figures: how far the two agree, as plain JSON values.
        stress_factor: (m,) how many times as stressed as their beams say the struts are there,
            1 or more: of those that are stressed most.
        skin: the skin's stress in each case, MPa, on all but a little of its area; none without.
        on_skin: (t, k) of each of its shells, MPa; nan where there is none. None without a skin.
    """

    figures: dict[str, Any]
    stress_factor: Floats
    skin: tuple[float, ...] = ()
    on_skin: Floats | None = None

    def uses(self, limits: Limits, final: Analysis) -> dict[str, float]:
        """By the name of each limit that CalculiX has a figure for, the share of it used there."""
        result = {}
        ratio = self.figures["largest_stress"]
        if limits.stress is not None and ratio is not None:
            use = final.uses["stress"] * ratio
            # Without the strut that governs it is the least that there may be.
            if self.figures["worst_strut_compared"] or use > PROVED:
                result["stress"] = use
        if limits.displacement is not None:
            there = final.largest * np.array(self.figures["largest_displacement"])
            result["displacement"] = float(there.max()) / limits.displacement
        if limits.frequency is not None:
            result["frequency"] = final.uses["frequency"] / self.figures["lowest_frequency"]
        factors = [one for one in self.figures.get("buckling_factors", ()) if one is not None]
        if limits.frame_buckling is not None and factors:
            result["frame buckling"] = limits.frame_buckling / min(factors)
        return result

    def holds(self, limits: Limits, final: Analysis) -> bool:
        """Whether the design holds the limits in CalculiX, too."""
        return max(self.uses(limits, final).values(), default=0.0) <= PROVED


def correct_problem(
    problem: Problem, limits: Limits, final: Analysis, proof: Proved
) -> tuple[Problem, Limits]:
    """A problem and limits with which a design holds the given ones when CalculiX solves it.

    Stress is a strut's own: each counts as stressed as CalculiX finds it. Displacement, frequency
    and buckling together are all struts', and their limits become that much stricter.

    Args:
        problem: as `final` solved it.
        limits: that are to be held.
        final: the design.
        proof: what CalculiX says of it.
    """
    used, wanted = proof.uses(limits, final), limits
    if used.get("stress", 0.0) > PROVED:
        before = 1.0 if problem.stress_factor is None else problem.stress_factor
        problem = replace(problem, stress_factor=np.maximum(before, proof.stress_factor))
        assert limits.stress is not None
        wanted = replace(wanted, stress=SHARED * limits.stress)
    if limits.displacement is not None and used["displacement"] > PROVED:
        ratio = used["displacement"] / final.uses["displacement"]
        wanted = replace(wanted, displacement=limits.displacement / ratio)
    if limits.frequency is not None and used["frequency"] > PROVED:
        ratio = used["frequency"] / final.uses["frequency"]
        wanted = replace(wanted, frequency=limits.frequency * ratio)
    if limits.frame_buckling is not None and used.get("frame buckling", 0.0) > PROVED:
        ratio = used["frame buckling"] / final.uses["frame buckling"]
        wanted = replace(wanted, frame_buckling=limits.frame_buckling * ratio)
    return problem, wanted


def prove_design(
    model: SizingModel,
    cell: UnitCell | None,
    cell_size: float,
    final: Analysis,
    material: SolidMaterial,
    notes: list[str],
    monitor: Monitor,
) -> Proved | None:
    """How far CalculiX agrees on the final design, with its skin.

    Args:
        model: what was solved.
        cell: the unit cell, whose joints stiffen the beams' ends; None for a network.
        cell_size: L, mm.
        final: the design.
        material: of the struts.
        notes: is added a sentence where CalculiX is not asked.
        monitor: asked for a cancel while CalculiX runs.

    Returns:
        How far displacements are off in each case, and over the design's own the largest
        displacements, stress and lowest frequency; of how many struts' ends the stress is known
        there, and whether of the most stressed one (the largest stress is that of those that are
        known; None where none is); whether CalculiX confirms the design, and if not, why. None
        where CalculiX is not installed, or there are more than `MOST_PROVED` struts.

    Raises:
        VolfrepError: CalculiX does not solve it.
        Cancelled: when the monitor says so.
    """
    problem = model.problem
    beams, count = problem.structure.beams, model.frame_nodes
    if find_calculix() is None:
        notes.append("CalculiX (ccx) is not installed: no other solver has proved this design.")
        return None
    if len(beams.struts) > MOST_PROVED:
        notes.append(
            f"CalculiX was not asked: it takes minutes for more than {MOST_PROVED:,} struts."
        )
        return None
    of_struts = problem.radii.of_struts(final.radii)
    nodes = problem.structure.nodes[:count]
    joints = np.zeros(count)
    for end in (0, 1):
        np.maximum.at(joints, beams.struts[:, end], of_struts[:, end])
    frame = Wireframe(nodes, beams.struts.astype(np.int32), of_struts, joints)
    law = ends_law(cell, cell_size, "square")
    deck = beam_model(
        frame, None if beams.joined.all() else _free_ends(beams.joined, beams.struts, count),
        joint_law=law, elements_per_strut=8 if model.skin is None else 4, radius_tolerance=0.003,
    )  # fmt: skip
    solid, more = None, None
    place, there = np.arange(len(problem.structure.nodes)), problem.watched.copy()
    if model.skin is not None:
        arms = np.flatnonzero(model.on_boundary)
        deck = with_arms(deck, arms, float(of_struts.mean()))
        solid, more = solid_skin(model.skin, deck, arms, material)
        # What is held and loaded is the outside; nodes of struts on a wall follow it.
        place[count:] = len(deck.nodes) + solid.mesh.outer
        there[count:] &= solid.mesh.outer >= 0
    total = len(deck.nodes) + (0 if solid is None else len(solid.mesh.nodes))
    total += 0 if more is None else len(more)
    empty = ~_used(beams.struts, count)
    cases = []
    for case in problem.cases:
        fixed, loads, prescribed = (np.zeros((total, 6), kind) for kind in (bool, float, float))
        fixed[place[there]], loads[place[there]] = case.fixed[there], case.loads[there]
        fixed[:count][empty] = True
        if case.prescribed is not None:
            prescribed[place[there]] = case.prescribed[there]
        if solid is not None:
            _on_solid(solid, len(deck.nodes), fixed, loads, prescribed)
        x, y, z = case.acceleration
        cases.append(Case(fixed, loads, prescribed if prescribed.any() else None, (x, y, z)))
    attached = None
    if problem.structure.attached is not None:
        attached = np.zeros(total)
        attached[place[there]] = problem.structure.attached[there]
    modes = 3 if "frequency" in final.uses else 0
    # What is moved is no load.
    expected = None
    if all(case.prescribed is None for case in cases):
        expected = np.where(np.isfinite(final.factors), final.factors, np.nan)
    found = solve_frame(
        deck, material.for_solver(), cases, skin=solid, more_nodes=more, attached=attached,
        modes=modes,
        expected=expected, monitor=monitor,
    )  # fmt: skip
    mine = final.displacements[:, :3][there]
    theirs = found.displacements[place[there]]
    off = np.linalg.norm(theirs - mine, axis=(0, 1)) / np.linalg.norm(theirs, axis=(0, 1))
    own = stresses(beams, of_struts, final.forces)
    alone = np.abs(own.axial) + own.bending
    summed = (
        alone if problem.stress_factor is None else alone * problem.stress_factor[:, None, None]
    )
    stress = end_stresses(found, deck, beams, of_struts)
    known = np.isfinite(stress)
    there_most = np.where(known, stress, 0.0).max(axis=(1, 2))
    more = there_most / np.maximum(alone.max(axis=(1, 2)), 1e-300)
    telling = TELLING * min(there_most.max(initial=0.0), summed.max(initial=0.0))
    more = np.where(there_most > telling, np.maximum(more, 1.0), 1.0)
    worst = float(stress[known].max() / summed.max()) if known.any() else None
    compared = bool(known.ravel()[int(summed.argmax())])
    result: dict[str, Any] = {
        "displacements_off": [float(value) for value in off],
        "largest_displacement": (
            np.linalg.norm(theirs, axis=1).max(axis=0) / np.linalg.norm(mine, axis=1).max(axis=0)
        ).tolist(),
        "largest_stress": worst,
        "struts_compared": float(known.mean()),
        "worst_strut_compared": compared,
        "with_the_skin": model.skin is not None,
    }
    peaks: tuple[float, ...] = ()
    on_skin = None
    if solid is not None and model.skin is not None:
        shells = len(model.skin.shells.triangles)
        peaks, on_skin = skin_stresses(solid.mesh, found.skin[len(deck.nodes) :], shells)
    if modes:
        result["frequencies_hz"] = found.frequencies.tolist()
        result["lowest_frequency"] = float(found.frequencies[0] / final.frequency)
    if np.isfinite(found.factors).any():
        result["buckling_factors"] = [
            float(factor) if np.isfinite(factor) else None for factor in found.factors
        ]
    result["doubts"] = doubts(result, final, [case.name for case in problem.cases])
    result["confirmed"] = not result["doubts"]
    return Proved(result, more, peaks, on_skin)


def skin_stresses(mesh: WedgeMesh, stress: Floats, shells: int) -> tuple[tuple[float, ...], Floats]:
    """Von Mises on either side of a skin in each case, MPa, on all but a little of its area.

    And (t, k) of each shell, the mean of its wedges.

    Where struts stand on it, wedges are stiffer than the skin, and do not count.

    Args:
        mesh: the wedges.
        stress: (nodes, 6, cases) at their nodes.
        shells: t, how many shells the skin has.
    """
    own, shell = mesh.elements[~mesh.is_pad], mesh.rows[mesh.of[~mesh.is_pad]]
    worst = np.zeros((len(own), stress.shape[2]))
    for side in (own[:, :3], own[:, 3:6]):
        worst = np.maximum(worst, von_mises(stress[side].mean(axis=1), axis=1))
    one, two, three = mesh.nodes[own[:, 3:6]].swapaxes(0, 1)
    area = np.linalg.norm(np.cross(two - one, three - one), axis=1)
    total = np.bincount(shell, area, shells)
    summed = np.stack([np.bincount(shell, area * row, shells) for row in worst.T], axis=1)
    each = np.asarray(summed / np.where(total > 0.0, total, np.nan)[:, None])
    return tuple(most_but_peaks(row, area) for row in worst.T), each


def end_stresses(solved: SolvedFrame, model: BeamMesh, beams: Beams, radii: Floats) -> Floats:
    """(m, 2, cases) MPa, |pull| / A + |M| / W where struts leave their joints; nan where unknown.

    A moment is linear along a strut, and CalculiX's are right between equal elements: so it is
    taken from two such nodes, and drawn on to the ends. Struts of less than three elements have
    none.
    """
    inner = ~model.is_joint
    inner[1:] &= ~model.is_joint[:-1] & (model.strut[1:] == model.strut[:-1])
    inner[0] = False
    before = np.flatnonzero(inner)  # elements that begin between two flexible ones
    strut = model.strut[before]
    result = np.full((len(radii), 2, solved.sections.shape[2]), np.nan)
    edge = np.flatnonzero(np.append(True, strut[1:] != strut[:-1]))
    last = np.append(edge[1:], len(strut)) - 1
    many = last > edge
    first, last = model.elements[before[edge[many]], 0], model.elements[before[last[many]], 0]
    own = strut[edge[many]]
    start = model.nodes[beams.struts[own, 0]]
    near, far = (np.linalg.norm(model.nodes[node] - start, axis=1) for node in (first, last))
    stiff, length = beams.stiff_lengths(radii)[own], beams.length[own]
    for end, place in ((0, stiff[:, 0]), (1, length - stiff[:, 1])):
        share = ((place - near) / (far - near))[:, None, None]
        sections = solved.sections[first] * (1.0 - share) + solved.sections[last] * share
        along = (place / length)[:, None]
        radius = radii[own, :1] * (1.0 - along) + radii[own, 1:] * along
        axial = np.abs(sections[:, 0]) / (np.pi * radius**2)
        result[own, end] = axial + np.hypot(sections[:, 1], sections[:, 2]) / (
            0.25 * np.pi * radius**3
        )
    return result


def doubts(figures: Mapping[str, Any], final: Analysis, names: Sequence[str]) -> list[str]:
    """Why CalculiX does not confirm a design, in parts of a sentence; none where it does.

    Args:
        figures: as `prove_design` has them.
        final: the design.
        names: of its load cases.
    """
    result = []
    ratio, off = figures["largest_displacement"], figures["displacements_off"]
    apart = [max(one, abs(other - 1.0)) for one, other in zip(off, ratio, strict=True)]
    k = int(np.argmax(apart))
    if not apart[k] <= AGREES:
        result.append(
            f"displacements differ by {off[k]:.0%} in case '{names[k]}', where the largest one is "
            f"{ratio[k]:.3g} times the design's own"
        )
    stress_ratio = figures["largest_stress"]
    if "stress" in final.uses:
        if not figures["worst_strut_compared"]:
            result.append(
                "the most stressed strut is too short to be compared, as are "
                f"{1.0 - figures['struts_compared']:.0%} of the struts' ends"
            )
        elif not abs(stress_ratio - 1.0) <= AGREES:
            less = ", so that the part may be heavier than it need be" * (stress_ratio < 1.0)
            result.append(f"its largest stress is {stress_ratio:.3g} times the design's own{less}")
    if "frequency" in final.uses and not abs(figures["lowest_frequency"] - 1.0) <= AGREES:
        times = figures["lowest_frequency"]
        result.append(f"its lowest frequency is {times:.3g} times the design's own")
    factors = zip(figures.get("buckling_factors", ()), final.factors.tolist(), strict=False)
    times = [there / own for there, own in factors if there is not None]
    if times and not max(abs(one - 1.0) for one in times) <= AGREES:
        worst = max(times, key=lambda one: abs(one - 1.0))
        result.append(f"its load factor of buckling together is {worst:.3g} times the design's own")
    return result


def with_arms(model: BeamMesh, nodes: Ints, length: float) -> BeamMesh:
    """Beams with three rigid arms at some nodes, along x, y and z; their tips are the last nodes.

    Whoever moves the tips moves and turns the node: in CalculiX the turn of a beam's node can be
    given about the axes of the beam's section only.
    """
    count, own = len(model.nodes), len(nodes)
    tips = np.repeat(model.nodes[nodes], 3, axis=0) + length * np.tile(np.eye(3), (own, 1))
    elements = np.stack([np.repeat(nodes, 3), count + np.arange(3 * own)], axis=1)
    strut = model.strut.max() + 1 + np.arange(3 * own)
    # Thin, so that they weigh next to nothing, and of something that much stiffer.
    rigid = Ends(1.0, JOINT_STIFFNESS / _THIN**4, JOINT_STIFFNESS / _THIN**4)
    return replace(
        model,
        nodes=np.concatenate([model.nodes, tips]),
        elements=np.concatenate([model.elements, elements]),
        strut=np.concatenate([model.strut, strut]),
        section=np.concatenate([model.section, np.full(3 * own, len(model.radii))]),
        radii=np.append(model.radii, _THIN * length),
        is_joint=np.concatenate([model.is_joint, np.ones(3 * own, bool)]),
        ends=(*model.ends, rigid),
    )


def solid_skin(
    skin: SkinModel, model: BeamMesh, arms: Ints, material: SolidMaterial
) -> tuple[SolidSkin, Floats]:
    """A skin of wedges, on whose pads struts stand; and nodes for what hangs on its other side.

    Args:
        skin: the shells.
        model: the beams, with `arms` at their nodes on the skin.
        arms: those nodes.
        material: of the skin.
    """
    mesh = wedge_mesh(skin.outside.vertices, skin.inside, skin.shells.triangles, skin.pads)
    first = len(model.nodes)
    tips = first - 3 * len(arms) + np.arange(3 * len(arms))
    vertex = np.repeat(skin.pad_of(model.nodes[arms]), 3)
    # A tip moves as the pad's inner border does on the whole: each of its nodes has an equal part
    # of a force, and of a moment what a turn about their middle would give.
    order = np.argsort(mesh.ring[:, 0], kind="stable")
    pad, border = mesh.ring[order].T
    low, high = np.searchsorted(pad, vertex), np.searchsorted(pad, vertex, "right")
    most = int((high - low).max(initial=1))
    column = low[:, None] + np.arange(most)
    is_there = column < high[:, None]
    leaders = border[np.minimum(column, len(border) - 1)]
    number = np.maximum(is_there.sum(axis=1), 1)[:, None]
    places = mesh.nodes[leaders]
    middle = (places * is_there[:, :, None]).sum(axis=1) / number
    arm = np.where(is_there[:, :, None], places - middle[:, None], 0.0)
    inertia = (arm**2).sum(axis=(1, 2))[:, None, None] * np.eye(3)
    inertia -= np.einsum("qwi,qwj->qij", arm, arm)
    lever = cross_matrix(model.nodes[tips] - middle) @ np.linalg.inv(inertia)
    turned = lever[:, None] @ cross_matrix(arm)
    weights = np.where(is_there, 1.0 / number, 0.0)[:, :, None, None] * np.eye(3) - turned

    own = mesh.inner[skin.joined.vertices]
    own = own[own >= 0]
    own, beyond, shares = beyond_inner(mesh, own)
    more = mesh.nodes[own]
    behind = first + len(mesh.nodes) + np.arange(len(more))
    width = max(most, 15)
    led = np.zeros((len(tips) + len(more), width), np.int64)
    led[: len(tips), :most], led[len(tips) :, :15] = leaders, beyond
    by = np.zeros((*led.shape, 3, 3))
    by[: len(tips), :most] = weights
    by[len(tips) :, :15] = shares[:, :, None, None] * np.eye(3)
    solid = SolidSkin(
        mesh,
        np.concatenate([tips, behind]),
        led + first,
        by,
        np.stack([own + first, behind], axis=1),
        HELD_TOGETHER * material.young * float(skin.shells.thickness.mean()),
    )
    return solid, more


def _on_solid(skin: SolidSkin, first: int, fixed: Bools, loads: Floats, prescribed: Floats) -> None:
    """Brings what is held and loaded on the outside to solid elements, in place."""
    mesh = skin.mesh
    used = np.flatnonzero((mesh.outer >= 0) & (mesh.inner >= 0))
    above, below = first + mesh.outer[used], first + mesh.inner[used]
    nodal = np.zeros((len(mesh.outer), 3))
    nodal[used] = loads[above, :3]
    loads[first : first + len(mesh.nodes), :3] = mesh.spread(nodal)
    # A moment becomes a pair of forces across the skin.
    arm = mesh.nodes[mesh.outer[used]] - mesh.nodes[mesh.inner[used]]
    pair = np.cross(loads[above, 3:], arm) / (arm**2).sum(axis=1)[:, None]
    loads[above, :3] += pair
    loads[below, :3] -= pair
    # Between vertices that are held the skin is, too, where pads cut it as well.
    held, moved = np.zeros((len(mesh.outer), 3), bool), np.zeros((len(mesh.outer), 3))
    held[used], moved[used] = fixed[above, :3], prescribed[above, :3]
    nodes, rows, shares = mesh.on_outside()
    between = (held[rows] | (shares < _NOT_BESIDE)[:, :, None]).all(axis=1)
    fixed[first + nodes, :3] = between
    prescribed[first + nodes, :3] = np.einsum("kc,kci->ki", shares, moved[rows]) * between
    fixed[first:, 3:] = False
    loads[first:, 3:] = 0.0


def _used(struts: Ints, count: int) -> Bools:
    """(n,) nodes that have a strut."""
    result = np.zeros(count, bool)
    result[struts.ravel()] = True
    return result


def _free_ends(joined: Bools, struts: Ints, count: int) -> Bools:
    """(n,) nodes at which a strut ends that no joint stiffens."""
    result = np.zeros(count, bool)
    result[struts[~joined]] = True
    return result

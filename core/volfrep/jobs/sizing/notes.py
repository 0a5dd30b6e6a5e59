# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a user is told about a design beside its figures."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager

import numpy as np

from ...design.spec import LatticeSpec
from ...fem.beam_mesh import MEASURED_TO
from ...loads.load_cases import LoadCase
from ...mechanics.materials import SolidMaterial
from ...sizing.analysis import Analysis, Limits, Problem
from ...sizing.model import SizingModel
from ...util.errors import Cancelled, VolfrepError, listed
from ...util.peaks import PEAKS
from ...util.types import Floats
from ..infill import Infill

#: Beyond these shares beams and shells are taken for what they are not: of its space that struts
#: fill, of the struts that are shorter than wide, and of the skin on walls thinner than two skins.
DENSE, SHORT, THIN_WALLS = 0.5, 0.25, 0.05
#: A mass that was asked for is there within this part of it.
MASS = 0.02

#: A motion as one body that supports resist by less than this part of another is free.
_FREE = 1e-9
#: What may help where a limit cannot be held.
_REMEDIES = {
    "stress": "a thicker skin there, a load or support on a larger area, or a lower safety",
    "buckling": "smaller cells, a thicker skin there, or a lower factor",
    "frame buckling": "larger cells, a thicker skin, a stiffer cell, or a lower factor",
    "displacement": "a thicker skin, a cell that is stiffer in that direction, or a higher limit",
    "frequency": "a thicker skin, a stiffer cell, more supports, or a lower limit",
}


def limit_not_held(problem: Problem, analysis: Analysis) -> str:
    """Which limit cannot be held, where, and what to do: of a design as thick as it can be."""
    uses = analysis.uses
    worst = max(uses, key=lambda name: uses[name])
    where = _place(problem, analysis, worst)
    used = f"{uses[worst]:.1%} of it is used{where}"
    return (
        f"The limit of {worst} cannot be held: with the thickest struts that the cells bear and "
        f"that were allowed, {used}. What may help: thicker struts, where --thickest limits them; "
        f"larger cells, which bear thicker ones; {_REMEDIES[worst]}."
    )


def other_mass(volume: float, asked: float, material: SolidMaterial) -> list[str]:
    """A sentence where struts and skin do not have the volume asked for, mm3."""
    if abs(volume / asked - 1.0) <= MASS:
        return []
    return [
        f"Struts and skin have {volume * material.density / 1000.0:.4g} g, of "
        f"{asked * material.density / 1000.0:.4g} g asked for: with radii and thicknesses within "
        "their bounds it comes no nearer."
    ]


def free_motions(problem: Problem) -> list[str]:
    """A sentence for each load case whose supports let the whole part slide or turn.

    Where its loads do not push it that way it can be solved, and nothing else would tell.
    """
    nodes, notes = problem.structure.nodes, []
    middle = nodes.mean(axis=0)
    size = float(np.linalg.norm(np.ptp(nodes, axis=0)))
    for case in problem.cases:
        node, way = np.nonzero(case.fixed)
        # What the part's six motions as one body do to what is held: slides along x, y, z, turns
        # about them by 1 / size.
        turns = np.zeros((len(node), 6, 3))
        arm = nodes[node] - middle
        for k, axis in enumerate(np.eye(3)):
            turns[:, :3, k] = np.cross(axis, arm) / size
            turns[:, 3 + k, k] = 1.0
        motions = np.concatenate([np.eye(6)[way, :3], turns[np.arange(len(node)), way]], axis=1)
        _, values, directions = np.linalg.svd(motions.T @ motions)
        free = directions[values < _FREE * max(float(values[0]), 1e-300)]
        if len(free):
            notes.append(
                f"Nothing keeps the part from {_motion(free, middle, size)} in case '{case.name}', "
                "whether its loads push it there or not: hold it that way, too."
            )
    return notes


def _motion(free: Floats, middle: Floats, size: float) -> str:
    """Motions of a body (f, 6) in words: slides first, which are those without turns."""
    _, values, combined = np.linalg.svd(free[:, 3:].T)
    turning = int((values > 1e-6).sum())
    slides = combined[turning:] @ free[:, :3]
    said = []
    if len(slides) == 3:
        said.append("sliding in any direction")
    elif len(slides) == 2:
        said.append(f"sliding across {_direction(np.cross(*slides))}")
    elif len(slides) == 1:
        said.append(f"sliding along {_direction(slides[0])}")
    for motion in combined[:turning] @ free:
        axis = motion[3:] / np.linalg.norm(motion[3:])
        # The point of the axis nearest to the middle.
        through = middle + np.cross(axis, motion[:3]) * size / np.linalg.norm(motion[3:])
        x, y, z = (through + 0.0).round(6).tolist()
        said.append(f"turning about {_direction(axis)} through ({x:.4g}, {y:.4g}, {z:.4g})")
    return listed(said, "and")


def _direction(way: Floats) -> str:
    """An axis by its name, or a direction."""
    way = way / np.linalg.norm(way)
    for k, name in enumerate("xyz"):
        if abs(way[k]) > 1.0 - 1e-9:
            return name
    x, y, z = (way * np.sign(way[np.argmax(np.abs(way))])).tolist()
    return f"({x:.3g}, {y:.3g}, {z:.3g})"


def left_out(spec: LatticeSpec) -> list[str]:
    """A sentence where bodies are kept solid, which the model does not hold."""
    if spec.skin is None or not spec.skin.bodies:
        return []
    return [
        "Bodies that are kept solid are not in the model that was sized: look at the struts round "
        "them with solid elements."
    ]


def hot(cases: Sequence[LoadCase], limits: Limits) -> list[str]:
    """A sentence on displacements where a case has a temperature.

    Raises:
        VolfrepError: displacements are limited then.
    """
    names = [case.name for case in cases if case.expansion]
    if not names:
        return []
    if limits.displacement is not None:
        raise VolfrepError(
            f"Displacements are told beside free expansion, and case '{names[0]}' has a "
            "temperature: leave out the limit of displacement, or the temperature."
        )
    return [f"Displacements in case '{name}' are told beside free expansion." for name in names]


def small_dimples(model: SizingModel, limits: Limits) -> list[str]:
    """A sentence on what a limit of buckling does not hold; nothing without one or a skin."""
    if limits.buckling is None or model.skin is None:
        return []
    edge = float(np.sqrt(2.0 * np.median(model.skin.shells.area)))
    return [
        "Struts and skin were kept from buckling, alone and together: of the skin between struts "
        f"dimples of {4.0 * edge:.2g} mm and more; smaller ones were not looked at."
    ]


def unproved(problem: Problem, used: Mapping[str, float], analysis: Analysis) -> str:
    """Which limit a design does not hold when CalculiX solves it."""
    worst = max(used, key=lambda name: used[name])
    where = _place(problem, analysis, worst)
    return (
        f"The limit of {worst} is not held in CalculiX, which finds {used[worst]:.1%} of it used, "
        f"even in a thicker design; in the design's own solution it is used most{where}. What may "
        f"help: {_REMEDIES[worst]}."
    )


def _place(problem: Problem, analysis: Analysis, limit: str) -> str:
    """Where and in which case a limit is used most; nothing where that is no one place."""
    case, row = analysis.worst[limit]
    if case < 0:
        return ""
    structure, is_node = problem.structure, limit == "displacement"
    place = structure.nodes[row if is_node else structure.beams.struts[row]].reshape(-1, 3)
    x, y, z = place.mean(axis=0).tolist()
    return (
        f", by the {'node' if is_node else 'strut'} at ({x:.4g}, {y:.4g}, {z:.4g}) in case "
        f"'{problem.cases[case].name}'"
    )


def not_confirmed(doubts: Sequence[str]) -> list[str]:
    """A sentence where CalculiX does not confirm a design."""
    if not doubts:
        return []
    return [
        f"This design is not confirmed by CalculiX: {'; '.join(doubts)}. Look at it with solid "
        "elements before it is made."
    ]


def too_dense(infill: Infill, model: SizingModel, radii: Floats) -> list[str]:
    """A part of a sentence where struts fill most of their space: those of one box of 12 x 12 mm,
    which its skin and struts make solid, were 21 % too stiff as beams, in both solutions alike.
    """
    dense = model.problem.radii.volume(radii) / max(infill.domain.mesh.volume, 1e-300)
    return [f"the struts' volume is {dense:.0%} of the space that they fill"] * (dense > DENSE)


def hardly_beams(infill: Infill, model: SizingModel, radii: Floats, cell_size: float) -> list[str]:
    """A sentence where a design is no longer one of beams and shells.

    Args:
        infill: the part.
        model: what was solved.
        radii: (n,) at the nodes of the model's wireframe, mm.
        cell_size: L, mm; of a network the median length of its struts.
    """
    problem, found = model.problem, []
    beams, of_struts = problem.structure.beams, problem.radii.of_struts(radii)
    thick = of_struts.max(axis=1)
    is_of_cubes = infill.spec.kind.cube is not None  # r / L is told of these
    if is_of_cubes and thick.max() > MEASURED_TO * cell_size:
        place = problem.structure.nodes[beams.struts[int(np.argmax(thick))]].mean(axis=0)
        x, y, z = place.tolist()
        share = float((thick > MEASURED_TO * cell_size).mean())
        found.append(
            f"{share:.0%} of the struts are thicker than r/L = {MEASURED_TO:g}, up to which beams "
            f"were compared with solids (r/L = {thick.max() / cell_size:.2g} at ({x:.4g}, "
            f"{y:.4g}, {z:.4g}))"
        )
    found += too_dense(infill, model, radii)
    short = float((beams.length < of_struts.sum(axis=1)).mean())
    if short > SHORT:
        found.append(f"{short:.0%} of the struts are shorter than their diameter")
    if model.skin is not None and model.skin.solid_share > THIN_WALLS:
        found.append(f"{model.skin.solid_share:.0%} of the skin is on walls thinner than two skins")
    if not found:
        return []
    return [
        f"Beams and shells hardly hold here: {'; '.join(found)}. Displacements and stresses may be "
        "tens of per cent off there: look at such places with solid elements."
    ]


def stressed_skin(
    model: SizingModel, analysis: Analysis, limits: Limits, is_sized: bool
) -> list[str]:
    """A sentence where the skin is stressed by more than the limit."""
    if model.skin is None or limits.stress is None:
        return []
    area = model.skin.shells.area
    stress = model.skin.stresses(analysis.displacements[model.frame_nodes :]).max(axis=1)
    over = float(area[stress > limits.stress].sum() / area.sum())
    if over <= PEAKS:
        return []
    if is_sized:
        return [
            f"The skin is stressed by more than {limits.stress:.4g} MPa on {over:.1%} of its area: "
            "allow a thicker one, or choose its thickness nearer to each other."
        ]
    return [
        f"The skin, which is not sized, is stressed by more than {limits.stress:.4g} "
        f"MPa on {over:.1%} of its area, mostly where it is held and loaded: make it "
        "thicker, or look at those places with solid elements."
    ]


@contextmanager
def telling_free_motions(problem: Problem) -> Iterator[None]:
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

# SPDX-License-Identifier: LGPL-2.1-or-later
"""A final design as CalculiX solves it, and limits by which it holds the given ones there."""

from __future__ import annotations

import shutil
from dataclasses import replace
from typing import Any

import numpy as np

from ..design.cells import UnitCell
from ..fem.beam_mesh import JOINT_STIFFNESS, BeamModel, beam_model
from ..grid.strut_graph import Wireframe
from ..mechanics.catalogue import joint_law
from ..mechanics.frame import Ends
from ..mechanics.materials import SolidMaterial
from ..util.progress import Monitor
from ..util.types import Bools, Ints
from .analysis import Analysis, Limits
from .model import SizingModel
from .proof import end_stresses, prove
from .structure import Case
from .strut_results import stresses

#: Beams of more struts are not solved by CalculiX unless it is asked for.
MOST_PROVED = 6_000
#: A limit that CalculiX finds used more than this makes the design a little thicker.
PROVED = 1.003


def stricter_limits(limits: Limits, final: Analysis, proof: dict[str, Any] | None) -> Limits:
    """Limits with which a design holds the given ones when CalculiX solves it."""
    if proof is None:
        return limits
    wanted = limits
    if limits.stress is not None and final.uses["stress"] * proof["largest_stress"] > PROVED:
        wanted = replace(wanted, stress=limits.stress / proof["largest_stress"])
    if proof["given_the_skin"]:
        return wanted  # the rest is the skin's
    moved = max(proof["largest_displacement"])
    if limits.displacement is not None and final.uses["displacement"] * moved > PROVED:
        wanted = replace(wanted, displacement=limits.displacement / moved)
    if limits.frequency is not None:
        ratio = proof["lowest_frequency"]
        if final.uses["frequency"] / ratio > PROVED:
            wanted = replace(wanted, frequency=limits.frequency / ratio)
    return wanted


def proved(
    model: SizingModel,
    cell: UnitCell,
    cell_size: float,
    final: Analysis,
    material: SolidMaterial,
    notes: list[str],
    monitor: Monitor,
) -> dict[str, Any] | None:
    """How far CalculiX agrees on the final design; with a skin, given how the skin moves.

    Args:
        model: what was solved.
        cell: the unit cell, whose joints stiffen the beams' ends.
        cell_size: L, mm.
        final: the design.
        material: of the struts.
        notes: is added a sentence where CalculiX is not asked.
        monitor: asked for a cancel while CalculiX runs.

    Returns:
        The figures as plain JSON values: how far displacements are off in each case, and over the
        design's own the largest displacements, stress and, without a skin, lowest frequency. None
        where CalculiX is not installed, or there are more than `MOST_PROVED` struts.

    Raises:
        VolfrepError: CalculiX does not solve it.
        Cancelled: when the monitor says so.
    """
    problem = model.problem
    beams, count = problem.structure.beams, model.frame_nodes
    if shutil.which("ccx") is None:
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
    there = np.zeros(count, bool)
    there[beams.struts.ravel()] = True
    law = joint_law(cell, cell_size, "square")
    deck = beam_model(
        frame, None if beams.joined.all() else _free_ends(beams.joined, beams.struts, count),
        joint_law=law, elements_per_strut=8, radius_tolerance=0.003,
    )  # fmt: skip
    arms = np.empty(0, np.int64)
    if model.skin is not None:
        arms = np.flatnonzero(model.on_wall)
        deck = with_arms(deck, arms, float(of_struts.mean()))
    tips = len(deck.nodes) - 3 * len(arms)
    cases = []
    for k, case in enumerate(problem.cases):
        held, loads, moved = (np.zeros((len(deck.nodes), 6), kind) for kind in (bool, float, float))
        held[:count], loads[:count] = case.held[:count], case.loads[:count]
        held[:count][~there] = True
        if case.moved is not None:
            moved[:count] = case.moved[:count]
        if len(arms):
            skin = final.displacements[arms, :, k]
            reach = (deck.nodes[tips:] - np.repeat(deck.nodes[arms], 3, axis=0)).reshape(-1, 3, 3)
            turned = np.cross(skin[:, None, 3:], reach)
            held[tips:, :3] = True
            moved[tips:, :3] = (skin[:, None, :3] + turned).reshape(-1, 3)
        x, y, z = case.acceleration
        cases.append(Case(held, loads, moved if moved.any() else None, (x, y, z)))
    modes = 3 if "frequency" in final.uses and model.skin is None else 0
    found = prove(deck, material.for_solver(), cases, modes=modes, monitor=monitor)
    there[arms] = False
    mine = final.displacements[:count, :3][there]
    theirs = found.displacements[:count][there]
    off = np.linalg.norm(theirs - mine, axis=(0, 1)) / np.linalg.norm(theirs, axis=(0, 1))
    own = stresses(beams, of_struts, final.forces)
    summed = np.abs(own.axial) + own.bending
    felt = end_stresses(found, deck, beams, of_struts)
    known = np.isfinite(felt)
    worst = float(np.where(known, felt, summed).max() / summed.max())
    result: dict[str, Any] = {
        "displacements_off": [float(value) for value in off],
        "largest_displacement": (
            np.linalg.norm(theirs, axis=1).max(axis=0) / np.linalg.norm(mine, axis=1).max(axis=0)
        ).tolist(),
        "largest_stress": worst,
        "struts_compared": float(known.mean()),
        "given_the_skin": model.skin is not None,
    }
    if modes:
        result["frequencies_hz"] = found.frequencies.tolist()
        result["lowest_frequency"] = float(found.frequencies[0] / final.frequency)
    return result


def with_arms(model: BeamModel, nodes: Ints, length: float) -> BeamModel:
    """Beams with three rigid arms at some nodes, along x, y and z; their tips are the last nodes.

    Whoever moves the tips moves and turns the node: CalculiX takes a given turn right about the
    axes of a beam's section only.
    """
    count, own = len(model.nodes), len(nodes)
    tips = np.repeat(model.nodes[nodes], 3, axis=0) + length * np.tile(np.eye(3), (own, 1))
    elements = np.stack([np.repeat(nodes, 3), count + np.arange(3 * own)], axis=1)
    strut = model.strut.max() + 1 + np.arange(3 * own)
    rigid = Ends(1.0, JOINT_STIFFNESS, JOINT_STIFFNESS)
    return replace(
        model,
        nodes=np.concatenate([model.nodes, tips]),
        elements=np.concatenate([model.elements, elements]),
        strut=np.concatenate([model.strut, strut]),
        section=np.concatenate([model.section, np.full(3 * own, len(model.radii))]),
        radii=np.append(model.radii, length),
        is_joint=np.concatenate([model.is_joint, np.ones(3 * own, bool)]),
        ends=(*model.ends, rigid),
    )


def _free_ends(joined: Bools, struts: Ints, count: int) -> Bools:
    """(n,) nodes at which a strut ends that no joint stiffens."""
    result = np.zeros(count, bool)
    result[struts[~joined]] = True
    return result

# SPDX-License-Identifier: LGPL-2.1-or-later
"""What is wanted of a design: whether it makes sense, and what of it its process builds."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TypeVar

from ...design.spec import LatticeSpec
from ...grid.inclination import inclinations, is_below, unit_direction
from ...reports.printability import overhanging_struts
from ...util.errors import Cancelled, VolfrepError
from ..infill import Infill
from .building import Building
from .goal import Goal

_Design = TypeVar("_Design")


def checked(goal: Goal) -> Goal:
    """The goal, whose limit of buckling is one of struts together, too.

    Raises:
        VolfrepError: it asks for two things at once, or its smoothing makes no sense.
    """
    if goal.limits.frame_buckling is None:
        goal = replace(goal, limits=replace(goal.limits, frame_buckling=goal.limits.buckling))
    if goal.limits.any and goal.volume is not None:
        raise VolfrepError("Give limits for the least mass, or a volume for the most stiffness.")
    if not 0.0 <= goal.smooth <= 0.9:
        raise VolfrepError(f"The smoothing must be from 0 to 0.9, not {goal.smooth:g}.")
    return goal


def buildable(goal: Goal, spec: LatticeSpec) -> tuple[Goal, list[str]]:
    """The goal with struts and a sized skin no thinner than its process builds, and what to tell.

    Raises:
        VolfrepError: a list has thinner radii.
    """
    building = goal.building
    if building is None:
        return goal, []
    process, notes = building.process, []
    least = building.least_radius(None if goal.printing is None else goal.printing.table)
    if goal.radius_list:
        if goal.radius_list[0] < least:
            raise VolfrepError(
                f"The list has a radius of {goal.radius_list[0]:.4g} mm, and {process.name} wants "
                f"{least:.4g} mm: leave thinner ones out."
            )
        least = goal.radius_list[0]
    elif goal.thinnest is not None and goal.thinnest < least:
        notes.append(f"Struts are no thinner than {process.name} prints: {least:.4g} mm in radius.")
    thinnest = max(least, 0.5 * spec.strut_radius if goal.thinnest is None else goal.thinnest)
    goal = replace(goal, thinnest=thinnest)
    if goal.skin_thinnest is not None and goal.skin_thinnest < process.wall:
        notes.append(f"The skin is no thinner than {process.name} prints: {process.wall:.4g} mm.")
        goal = replace(goal, skin_thinnest=process.wall)
    return goal, notes


def flat_struts(building: Building, infill: Infill) -> tuple[int, int]:
    """How many of a cell's struts lie too flat for a process, and how many it does not bridge.

    Args:
        building: how the part is built.
        infill: the part with all its struts.
    """
    if building.without_flat_struts(infill.spec) is None:
        return 0, 0
    frame, process = infill.struts, building.process
    angle = inclinations(frame, unit_direction(building.build_direction))
    hanging = overhanging_struts(angle, frame.lengths(), process)
    return int(is_below(angle, process.inclination).sum()), int(hanging.sum())


def without_flat_struts(
    designed: Callable[[LatticeSpec], _Design],
    is_wanted: Callable[[_Design], bool],
    spec: LatticeSpec,
    goal: Goal,
) -> tuple[_Design, list[str]]:
    """The design without struts that its process cannot build; with them where it does not hold.

    Args:
        designed: makes the design of a specification.
        is_wanted: whether a design will do.
        spec: with all struts, of which some hang over.
        goal: what is wanted.

    Returns:
        It, and why flat struts stay where they do.
    """
    building = goal.building
    assert building is not None
    steeper = building.without_flat_struts(spec)
    assert steeper is not None
    try:
        made = designed(steeper)
        if is_wanted(made):
            return made, []
        reason = "without them the limits cannot be held"
    except VolfrepError as error:
        reason = str(error).rstrip(".")
    stays = f"Struts that lie flatter than {building.process.name} builds stay: {reason}."
    return designed(spec), [stays]


def without_bridges(
    designed: Callable[[LatticeSpec], _Design],
    is_better: Callable[[_Design, _Design], bool],
    made: _Design,
    spec: LatticeSpec,
    goal: Goal,
) -> _Design:
    """A design, or where that is better the one without the flat struts that its process bridges.

    Args:
        designed: makes the design of a specification.
        is_better: whether the first of two designs is the better one.
        made: the design with all struts.
        spec: of it.
        goal: what is wanted.
    """
    steeper = None if goal.building is None else goal.building.without_flat_struts(spec)
    if steeper is None:
        return made
    try:
        other = designed(steeper)
    except (VolfrepError, Cancelled):  # there is a design
        return made
    return other if is_better(other, made) else made

# SPDX-License-Identifier: LGPL-2.1-or-later
"""A sized lattice without the struts that ended as thin as they may be and carry little.

What goes is said by the radii at the nodes alone, so that the result is a graded lattice as any
other: struts that are nowhere thicker than a limit are not made (`remove_below`), nor those that
have a free end then. Nodes at which such struts met stay as thin as they are, and all others
thicker than the limit, whatever the rest is sized to.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from scipy.spatial import cKDTree

from ...design.grading import RadiusGrading
from ...design.profile import Profile
from ...design.scattered_field import PointField
from ...design.spec import LatticeSpec
from ...grid.placement import NUDGE
from ...grid.strut_graph import Wireframe
from ...loads.load_cases import LoadCases
from ...mesh.topology import pieces_of
from ...sizing.analysis import Analysis, Problem
from ...sizing.model import SizingModel
from ...util.cache import StageCache
from ...util.types import Bools, Floats, Ints
from ..infill import Infill
from .goal import Goal
from .part_model import part_model

#: Radii are stored in steps of this, mm, as files keep them.
RADIUS_STEP = 1e-6
#: Struts that are stressed by less than this share of the most stressed one may go: what is tried.
SLACK = (0.5, 0.25)
#: Nodes whose radius is so many times the design's smallest, or less, count as thin.
THIN = 1.02
#: All others are at least so many times as thick as that.
_THICKER = 1.0001
#: Struts whose middles lie no farther apart, mm, are the same.
_SAME = 1e-4


@dataclass(frozen=True, eq=False)
class Thinned:
    """A part whose thin struts are gone.

    Attributes:
        spec: of the graded lattice without them.
        points: (n, 3) the nodes of the lattice with them, as a field has them, mm.
        radii: (n,) mm there.
        rows: (k,) which of these nodes are left.
        model: what is solved; thin nodes stay as they are, no other becomes one.
        struts: how many went.
        places: where, the one with most struts first: how many, their middle and box, mm.
    """

    spec: LatticeSpec
    points: Floats
    radii: Floats
    rows: Ints
    model: SizingModel
    struts: int
    places: list[dict[str, Any]]

    def of_all(self, radii: Floats) -> Floats:
        """(n,) radii at all nodes, with (k,) at those that are left."""
        result = self.radii.copy()
        result[self.rows] = radii
        return result


def without_thin_struts(
    infill: Infill,
    loads: LoadCases,
    goal: Goal,
    model: SizingModel,
    design: Analysis,
    slack: float,
    reach: Floats,
    cache: StageCache,
) -> Thinned | None:
    """The part without the struts that a design leaves as thin as they may be.

    Args:
        infill: the part with all struts.
        loads: the material, and what the part carries.
        goal: what is wanted.
        model: of all struts.
        design: of all struts.
        slack: which thin struts may go: those that no case stresses by more than this share of
            its most stressed one.
        reach: (n,) mm, by which struts hold the skin.
        cache: keeps the costly stages of the part.

    Returns:
        None where none may go.

    Raises:
        VolfrepError: what is left cannot be solved.
    """
    problem, spec = model.problem, infill.spec
    # One factor for all radii, at the end of the search, may have lifted the thinnest.
    radii, least = design.radii, float(problem.low.min())
    limit = THIN * float(radii.min())
    thin = (radii <= limit) & ~_needed(problem)
    # Where a strut between two such nodes carries something, they count as others do.
    share = design.stress / np.maximum(design.stress.max(axis=(0, 1)), 1e-300)
    busy = model.wireframe.struts[model.struts[share.max(axis=(1, 2)) > slack]]
    thin[busy[thin[busy].all(axis=1)]] = False
    thin = problem.most_alike(~thin * 1.0) == 0.0
    kept = np.where(thin, least, np.maximum(radii, _THICKER * limit))
    if (kept > problem.high).any():
        return None
    points = field_points(infill, model)
    kept = np.ceil(kept / RADIUS_STEP - 1e-6) * RADIUS_STEP
    smaller = replace(
        spec, radius_grading=radius_field(points, kept), remove_below=limit, remove_dangling=True
    )
    part = Infill(infill.solid, smaller, monitor=infill.monitor, cache=cache)
    gone = len(infill.struts.struts) - len(part.struts.struts)
    if not gone:
        return None
    rows = cKDTree(model.wireframe.nodes).query(part.struts.nodes)[1]
    bounds = replace(goal, thinnest=least, radius_list=())
    left = part_model(part, loads, bounds, cache, reach[rows])
    is_thin, high = thin[rows], left.problem.high
    low = np.where(is_thin, kept[rows], np.minimum(_THICKER * limit, high))
    high = np.where(is_thin, kept[rows], high)
    left = replace(left, problem=replace(left.problem, low=low, high=high))
    places = empty_places(infill.struts, part.struts)
    return Thinned(smaller, points, kept, rows, left, gone, places)


def empty_places(before: Wireframe, after: Wireframe) -> list[dict[str, Any]]:
    """Where a lattice has struts that another one has not: those that are connected are a place."""
    ends = before.nodes[before.struts]
    left = after.nodes[after.struts].mean(axis=1)
    gone = np.flatnonzero(cKDTree(left).query(ends.mean(axis=1))[0] > _SAME)
    struts = before.struts[gone].astype(np.int64)
    piece = pieces_of(struts[:, 0], struts[:, 1], len(before.nodes))[1][struts[:, 0]]
    found = []
    for number in np.unique(piece):
        there = ends[gone[piece == number]]
        found.append(
            {
                "struts": len(there),
                "middle_mm": there.mean(axis=(0, 1)).tolist(),
                "box_mm": [there.min(axis=(0, 1)).tolist(), there.max(axis=(0, 1)).tolist()],
            }
        )
    return sorted(found, key=lambda place: -place["struts"])


def field_points(infill: Infill, model: SizingModel) -> Floats:
    """(n, 3) the nodes where a field is to have the radii of a design, mm."""
    points = model.wireframe.nodes
    return points - NUDGE * infill.spec.cell_size if infill.placement.is_cut else points


def radius_field(points: Floats, radii: Floats) -> RadiusGrading:
    """Radii at nodes as a grading: a field of mm, each value its own radius."""
    low, high = float(radii.min()), float(radii.max())
    if high - low < RADIUS_STEP:
        high = low + RADIUS_STEP
    return RadiusGrading(
        "field", Profile("linear", low, high), field=PointField(points, radii, "sizing"),
        curve=((low, low), (high, high)),
    )  # fmt: skip


def _needed(problem: Problem) -> Bools:
    """(n,) the nodes at whose struts a load or a support acts."""
    struts = problem.structure.beams.struts
    acts = np.zeros(len(problem.structure.nodes), bool)
    for case in problem.cases:
        acts |= case.fixed.any(axis=1) | (case.loads != 0.0).any(axis=1)
    return np.asarray(problem.radii.to_nodes(acts[struts].astype(float)) > 0.0)

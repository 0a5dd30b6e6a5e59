# SPDX-License-Identifier: LGPL-2.1-or-later
"""What governs where: the limit and the load case that say how thick struts and skin are."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from ...sizing.analysis import Analysis, Limits, Problem
from ...util.types import Floats, Ints

#: A strut is governed by a limit of its own from this share of it on; by one that all share where
#: that is used to this.
_NEAR, _SHARED = 0.9, 0.98
#: A radius is at a bound within this factor.
_BOUND = 1.0 + 1e-3
#: One factor for all radii brings a design to its limits: what was as thin as it may be is then
#: thicker by that, and still governed by it up to this factor.
_COMMON = 1.05
#: A node is an end's own with more than this share in its radius.
_OWN = 0.3
THINNEST, THICKEST, STIFFNESS = "smallest radius", "largest radius", "stiffness"
#: No limit is near and no bound: what is thicker so that others hold theirs.
WITH_OTHERS, ONE_RADIUS = "thickened with others", "one radius for all"
THIN_SKIN, THICK_SKIN = "smallest thickness", "largest thickness"


@dataclass(frozen=True, eq=False)
class Governing:
    """What says how thick struts, or the places of a skin, are.

    Attributes:
        names: a limit, a bound, or why it is thicker than these ask for; and the load case, empty
            without one. The first governs the most, and what governs nothing is left out.
        much: (names,) how many struts, or mm2 of the skin, each of them governs.
        rows: (m,) of each strut or place, its row in `names`.
    """

    names: tuple[tuple[str, str], ...]
    much: Floats
    rows: Ints

    @property
    def told(self) -> tuple[str, ...]:
        """The names with their load cases."""
        return tuple(f"{what}{', ' * bool(case)}{case}" for what, case in self.names)

    def of_struts(self) -> list[dict[str, Any]]:
        """The rows of a report on struts."""
        return [
            {"what": what, "case": case, "struts": int(count)}
            for (what, case), count in zip(self.names, self.much, strict=True)
        ]

    def of_skin(self) -> list[dict[str, Any]]:
        """The rows of a report on a skin."""
        whole = float(self.much.sum())
        return [
            {"what": what, "case": case, "share": float(area) / whole}
            for (what, case), area in zip(self.names, self.much, strict=True)
        ]

    def at(self, places: Floats, points: Floats) -> Ints:
        """(k,) the row at points (k, 3): that of the nearest of the places (m, 3)."""
        return np.asarray(self.rows[cKDTree(places).query(points)[1]])


def _by_size(names: list[tuple[str, str]], rows: Ints, sizes: Floats) -> Governing:
    """What governs struts or places of so many mm2, or 1, the most first."""
    much: Floats = np.bincount(rows, sizes, len(names)).astype(np.float64)
    order = np.argsort(-much, kind="stable")
    order = order[np.isin(order, rows)]
    place = np.zeros(len(names), np.int64)
    place[order] = np.arange(len(order))
    return Governing(tuple(names[k] for k in order.tolist()), much[order], place[rows])


def governing(problem: Problem, design: Analysis, limits: Limits) -> Governing:
    """What governs each strut of a design.

    A strut's own limits, stress and buckling, do where it uses nine tenths of one; else those of
    the most used strut that its thicker end is shared with. An end that is as thin as it may be is
    governed by that, and every other one by the limit that all struts share, displacement,
    frequency or buckling together, where that is used up. What is thicker than all of these ask for
    is so because all radii are multiplied by one factor, or are one, so that others hold theirs.

    Args:
        problem: that was solved.
        design: its solution.
        limits: that it is held to; without any it is for stiffness.
    """
    cases = [case.name for case in problem.cases]
    names: list[tuple[str, str]] = []
    shares: list[Floats] = []
    if limits.stress is not None:
        names += [("stress", case) for case in cases]
        shares.append(design.stress.max(axis=1) / limits.stress)
    if limits.buckling is not None:
        names += [("buckling", case) for case in cases]
        shares.append(design.buckling * limits.buckling)
    local = np.concatenate([np.zeros((len(design.stress), 0)), *shares], axis=1)
    most = local.max(axis=1, initial=0.0)
    own = local.argmax(axis=1) if local.shape[1] else np.zeros(len(most), np.int64)

    first = len(names)
    radii, nodes = design.radii, len(design.radii)
    is_even = bool(radii.max() <= radii.min() * _BOUND)
    shared = _shared(design, limits, cases) or (ONE_RADIUS if is_even else WITH_OTHERS, "")
    names += [(THINNEST, ""), (THICKEST, ""), shared]
    entries = problem.radii.ends.tocoo()
    part = entries.data > _OWN
    row, column = entries.row[part], entries.col[part]
    order = np.argsort(most[row // 2], kind="stable")
    busiest = np.zeros(nodes, np.int64)
    busiest[column[order]] = row[order] // 2  # the last one stays
    of_node = np.full(nodes, first + 2)
    near = most[busiest] >= _NEAR
    of_node[near] = own[busiest[near]]
    of_node[_as_thin_as_allowed(radii, problem.low)] = first
    of_node[radii * _BOUND >= problem.high] = first + 1
    thick = problem.radii.of_struts(design.radii).argmax(axis=1)
    ends = problem.radii.ends.tocsr()[2 * np.arange(len(thick)) + thick]
    node = np.asarray(ends.argmax(axis=1)).ravel()
    rows = np.where(most >= _NEAR, own, of_node[node])
    return _by_size(names, rows, np.ones(len(rows)))


def governing_skin(problem: Problem, design: Analysis, limits: Limits) -> Governing:
    """What governs a sized skin at each of its control points.

    Where its thickness is chosen it is as the shells there ask for that are its own: their stress
    where nine tenths of its limit are used; else a bound, or the limit that all share.

    Args:
        problem: of the search, whose skin is varied.
        design: its solution.
        limits: that it was held to, the skin's with them.
    """
    skin = problem.skin
    assert skin is not None
    cases = [case.name for case in problem.cases]
    shared = _shared(design, limits, cases) or (WITH_OTHERS, "")
    names = [(THIN_SKIN, ""), (THICK_SKIN, ""), shared]
    roots = design.radii[skin.radii :]
    low, high = problem.low[skin.radii :], problem.high[skin.radii :]
    governs = np.full(len(roots), 2)
    governs[_as_thin_as_allowed(roots, low)] = 0
    governs[roots * _BOUND >= high] = 1
    if limits.skin_stress is not None:
        assert design.skin_stress is not None
        stress = np.minimum(design.skin_stress, skin.peak(design.skin_stress))
        uses = np.stack([skin.largest_near(row) for row in stress.T], axis=1) / limits.skin_stress
        near = uses.max(axis=1) >= _NEAR
        governs[near] = len(names) + uses[near].argmax(axis=1)
        names += [("skin stress", case) for case in cases]
    return _by_size(names, governs, skin.areas)


def _as_thin_as_allowed(radii: Floats, low: Floats) -> NDArray[np.bool_]:
    """(n,) which are at their bound, but for one factor for all."""
    common = float((radii / low).min(initial=np.inf))
    return np.asarray(radii <= low * (_BOUND * (common if common <= _COMMON else 1.0)))


def _shared(design: Analysis, limits: Limits, cases: list[str]) -> tuple[str, str] | None:
    """The limit that all share and that is used most, with its case; None where none is used up."""
    if not limits.any:
        return STIFFNESS, ""
    shared = {
        name: use
        for name, use in design.uses.items()
        if name in ("displacement", "frequency", "frame buckling") and use >= _SHARED
    }
    if not shared:
        return None
    name = max(shared, key=lambda one: shared[one])
    case = design.worst[name][0]
    return name, cases[case] if case >= 0 else ""

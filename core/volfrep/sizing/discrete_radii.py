# SPDX-License-Identifier: LGPL-2.1-or-later
"""Radii of a list: the lightest design found whose nodes have no others.

A design of any radii is rounded at several shares of a step. Where it does not hold its limits
then, nodes go a step up that the search would make thicker; then nodes go a step down that it
would make at least so much thinner, as long as that ends with less mass.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ..util.errors import VolfrepError
from ..util.types import Floats, Ints
from .analysis import Analysis, Changes, Limits, Problem, analyse
from .optimise import next_radii

#: Radii beyond this share of a step are rounded up: what is tried.
_SHARES = (0.3, 0.6, 0.9)
#: Steps up until the limits hold, and down while mass falls, at most.
_UP, _DOWN = 25, 6
#: Of what nodes are asked to become thicker, those with this part of the most go a step up.
_MOST = 0.5
#: Radii are in the list, and bounds allow them, within this part.
_SAME = 1e-5


def of_list(
    problem: Problem, limits: Limits, design: Analysis, radii: Floats
) -> tuple[Analysis, bool]:
    """A design with radii of a list, and whether it holds the limits.

    Without limits it has no more volume than the design.

    Args:
        problem: whose skin is not varied.
        limits: none is gone beyond.
        design: of any radii.
        radii: (s,) the list, mm.

    Raises:
        VolfrepError: a node may have no radius of the list.
    """
    radii = np.unique(radii)
    low = np.searchsorted(radii, problem.low * (1.0 - _SAME))
    high = np.searchsorted(radii, problem.high * (1.0 + _SAME), "right") - 1
    bad = np.flatnonzero(low > high)
    if len(bad):
        raise VolfrepError(
            f"No radius of the list lies between {problem.low[bad[0]]:.4g} and "
            f"{problem.high[bad[0]]:.4g} mm, which is what a node needs and its struts bear there: "
            "add one."
        )
    steps = _Steps(problem, limits, radii, low, high)
    if not limits.any:
        return steps.of_volume(design), True
    tried = [steps.raised(steps.rounded(design.radii, share)) for share in _SHARES]
    best = min(tried, key=_order)
    for _ in range(_DOWN):
        lower = steps.lowered(best[0])
        if (lower == best[2]).all():
            break
        found = steps.raised(lower)
        if _order(found) >= _order(best):
            break
        best = found
    return best[0], best[1]


_Tried = tuple[Analysis, bool, Ints]


def list_figures(radii: Floats, free: Analysis, final: Analysis) -> dict[str, Any]:
    """How many nodes have each radius of a list, and what the list costs.

    Args:
        radii: (s,) the list, mm.
        free: the design of any radii.
        final: that of the list.
    """
    row = np.abs(final.radii[:, None] - radii).argmin(axis=1)
    return {
        "radii_mm": radii.tolist(),
        "nodes": np.bincount(row, minlength=len(radii)).tolist(),
        "any_radii_strut_volume_mm3": free.volume,
        "volume_over_any_radii": final.volume / free.volume,
        "compliance_over_any_radii": (final.compliance / free.compliance).tolist(),
    }


def _order(found: _Tried) -> tuple[bool, float]:
    return not found[1], found[0].volume


class _Steps:
    """The list, and which of it each node may have: rows from `low` to `high`."""

    def __init__(
        self, problem: Problem, limits: Limits, radii: Floats, low: Ints, high: Ints
    ) -> None:
        self.problem, self.limits, self.radii, self.low, self.high = (
            problem, limits, radii, low, high,
        )  # fmt: skip

    def rounded(self, wanted: Floats, share: float) -> Ints:
        """(n,) rows: the next one up where a radius is beyond this share of the step."""
        above = np.minimum(np.searchsorted(self.radii, wanted * (1.0 - _SAME)), len(self.radii) - 1)
        below = np.maximum(above - 1, 0)
        first, step = self.radii[below], np.maximum(self.radii[above] - self.radii[below], 1e-300)
        up = (wanted - first) / step > share
        return np.asarray(np.clip(np.where(up, above, below), self.low, self.high))

    def solved(self, rows: Ints) -> tuple[Analysis, Changes]:
        found, changes = analyse(self.problem, self.radii[rows], self.limits, with_changes=True)
        assert changes is not None
        return found, changes

    def raised(self, rows: Ints) -> _Tried:
        """A design whose nodes go up until its limits hold, or none can."""
        for _ in range(_UP):
            found, changes = self.solved(rows)
            if found.most_used <= 1.0:
                return found, True, rows
            free = rows < self.high
            if not free.any():
                return found, False, rows
            wanted = next_radii(self.problem, found, changes, self.limits) - found.radii
            step = self.radii[np.minimum(rows + 1, len(self.radii) - 1)] - found.radii
            asked = np.where(free, wanted / np.maximum(step, 1e-300), 0.0)
            most = float(asked.max())
            rows = rows + (free if most <= 1e-3 else asked >= min(_MOST * most, _MOST))
        found, _ = analyse(self.problem, self.radii[rows], self.limits)
        return found, found.most_used <= 1.0, rows

    def lowered(self, found: Analysis) -> Ints:
        """(n,) rows, a step down where the search would go as far or farther."""
        rows = np.searchsorted(self.radii, found.radii * (1.0 - _SAME))
        again, changes = self.solved(rows)
        wanted = next_radii(self.problem, again, changes, self.limits)
        below = self.radii[np.maximum(rows - 1, 0)]
        return np.asarray(np.where((rows > self.low) & (wanted <= below), rows - 1, rows))

    def of_volume(self, design: Analysis) -> Analysis:
        """Rounded at the smallest share with which it has no more volume than the design."""
        low, high = 0.0, 1.0
        shape = self.problem.radii
        for _ in range(30):
            share = 0.5 * (low + high)
            rows = self.rounded(design.radii, share)
            if shape.volume(self.radii[rows]) <= design.volume:
                high = share
            else:
                low = share
        rows = self.rounded(design.radii, high)
        return analyse(self.problem, self.radii[rows], self.limits)[0]

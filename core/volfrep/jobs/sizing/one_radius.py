# SPDX-License-Identifier: LGPL-2.1-or-later
"""One radius for all struts, which a design is compared with."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ...sizing.analysis import Analysis, Limits, Problem, analyse
from ...sizing.optimise import HOLDS, Sized, uniform
from ...util.types import Floats


def of_one_radius(problem: Problem, limits: Limits, first: Floats, volume: float) -> Analysis:
    """All struts of one radius, of a volume, mm3; `first`, (n,) mm, is what a search begins with.

    Raises:
        VolfrepError: a part of the structure can move freely.
    """
    same = problem.radii.scaled_to(
        np.full(len(first), float(first.mean())),
        volume, np.full(len(first), 1e-3 * float(first.min())), problem.high,
    )  # fmt: skip
    return analyse(problem, same, limits)[0]


def of_less_volume(problem: Problem, limits: Limits, sized: Sized) -> tuple[Analysis, bool] | None:
    """As `uniform`; None where one radius of the design's volume is too thin for the limits."""
    if sized.holds:
        same = problem.radii.scaled_to(
            np.full(len(problem.low), float(sized.analysis.radii.mean())),
            sized.analysis.volume, problem.low, problem.high,
        )  # fmt: skip
        if analyse(problem, same, limits)[0].most_used > HOLDS:
            return None
    return uniform(problem, limits)


def no_worse(sized: Sized, even: tuple[Analysis, bool]) -> Sized:
    """The design, or one radius for all where that holds the limits with less."""
    one, holds = even
    if holds and (not sized.holds or one.volume < sized.analysis.volume):
        return replace(sized, analysis=one, holds=True)
    return sized

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Designs as values by name: every combination, or a Latin hypercube.

McKay, Beckman & Conover, Technometrics 21 (1979); SciPy's, with a fixed seed.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from numbers import Real
from typing import Any

import numpy as np
from scipy.stats import qmc

from ..util.arguments import check_kind
from ..util.errors import VolfrepError

SAMPLINGS = ("grid", "list", "latin-hypercube")
#: More designs than this are a slip of the keyboard.
MOST_DESIGNS = 1_000_000


@dataclass(frozen=True)
class Range:
    """Numbers between two.

    Attributes:
        low: the least.
        high: the largest, above it.
        steps: how many values of it a grid has, both ends included; 0 where no grid asks.
        whole: whether only whole numbers are meant.

    >>> Range(0.5, 1.5, 3).values("strut_radius")
    (0.5, 1.0, 1.5)
    """

    low: float
    high: float
    steps: int = 0
    whole: bool = False

    def __post_init__(self) -> None:
        for value in (self.low, self.high):
            check_kind("an end of a range", value, Real, "a number")
            if abs(value) > 1e300:
                raise VolfrepError("The end of a range is too large a number.")
        if not (math.isfinite(self.low) and math.isfinite(self.high) and self.low < self.high):
            raise VolfrepError(
                f"A range goes from a number to a larger one, not from {self.low:g} to "
                f"{self.high:g}."
            )

    def at(self, share: float) -> float | int:
        """The value at a share of the way, rounded to seven figures; whole where that is meant."""
        if self.whole:
            # Every whole number is as wide as the others.
            count = math.floor(self.high) - math.ceil(self.low) + 1
            return math.ceil(self.low) + min(int(share * count), count - 1)
        value = self.low + share * (self.high - self.low)
        return min(max(float(f"{value:.7g}"), self.low), self.high)

    def values(self, name: str) -> tuple[float | int, ...]:
        """Those of a grid, in equal steps.

        Raises:
            VolfrepError: there are no steps.
        """
        if self.steps < 2:
            raise VolfrepError(f"A grid needs the steps of '{name}', 2 or more.")
        _refuse_many(self.steps)  # before they are made
        shares = (k / (self.steps - 1) for k in range(self.steps))
        return tuple(dict.fromkeys(self.at(share) for share in shares))


Variations = Mapping[str, "Sequence[Any] | Range"]


def grid(vary: Variations) -> list[dict[str, Any]]:
    """Every combination; the last parameter varies fastest.

    Raises:
        VolfrepError: a range has no steps, or there are too many combinations.

    >>> grid({"cell": ("BCC", "CVC"), "shell": Range(1, 2, 2)})[:2]
    [{'cell': 'BCC', 'shell': 1.0}, {'cell': 'BCC', 'shell': 2.0}]
    """
    lists = [v.values(n) if isinstance(v, Range) else tuple(v) for n, v in vary.items()]
    _refuse_many(math.prod(len(values) for values in lists))
    return [dict(zip(vary, chosen, strict=True)) for chosen in itertools.product(*lists)]


def latin_hypercube(vary: Variations, samples: int, seed: int) -> list[dict[str, Any]]:
    """So many designs: along every parameter, each of as many equal slices holds one.

    A list of values is cut into slices of equal width, too.

    >>> sorted(row["shell"] for row in latin_hypercube({"shell": ("thin", "thick")}, 2, 0))
    ['thick', 'thin']
    """
    _refuse_many(samples)
    generator = np.random.default_rng(seed)
    shares = qmc.LatinHypercube(len(vary), seed=generator).random(samples).tolist()
    ranges = tuple(vary.values())
    return [
        {
            name: way.at(share) if isinstance(way, Range) else way[int(share * len(way))]
            for name, way, share in zip(vary, ranges, row, strict=True)
        }
        for row in shares
    ]


def _refuse_many(count: int) -> None:
    if count > MOST_DESIGNS:
        raise VolfrepError(
            f"The study has {count:,} designs, more than {MOST_DESIGNS:,}: vary fewer parameters, "
            "or take a Latin hypercube."
        )

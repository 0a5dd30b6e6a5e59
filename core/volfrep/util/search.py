# SPDX-License-Identifier: LGPL-2.1-or-later
"""The level at which a rising quantity has a value: the one search of all targets.

A level is a strut radius, a thickness or an offset; what rises with it is a volume, a density or a
modulus. Such quantities go about as a power of the level, so that the secant of their logarithms
arrives in a few steps, and what was found on the way serves the next value that is asked for.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TypeVar

#: So many values are computed at most for one that is asked for; the bracket is halved where the
#: secant has not arrived after so many.
MOST, SURELY = 40, 8

Made = TypeVar("Made")


class OutOfReachError(Exception):
    """No level has the value.

    Attributes:
        least, most: what can be had.
    """

    def __init__(self, least: float, most: float) -> None:
        super().__init__(f"from {least:g} to {most:g}")
        self.least, self.most = least, most


class Rising:
    """A positive quantity that rises with a level, and is costly to compute.

    Args:
        value_at: the quantity at a level.
        low, high: between which levels it is known; above 0 unless the scale is even.
        close: how near a value has to come, relative.
        start: a level to begin with; None for both ends.
        slope: about the power of the level that it grows by; on an even scale the change of its
            logarithm for each unit.
        even: whether levels count by their differences, and not by their ratios.

    >>> area = Rising(lambda r: 3.0 * r * r, 0.1, 10.0, close=1e-9)
    >>> round(area.level_of(12.0), 6)
    2.0
    """

    def __init__(
        self,
        value_at: Callable[[float], float],
        low: float,
        high: float,
        *,
        close: float,
        start: float | None = None,
        slope: float = 1.0,
        even: bool = False,
    ) -> None:
        self._value_at, self._close, self._slope, self._even = value_at, close, slope, even
        self._low, self._high = self._place(low), self._place(high)
        self._known: dict[float, float] = {}
        for level in (low, high) if start is None else (start,):
            self._find(min(max(self._place(level), self._low), self._high))

    @property
    def span(self) -> tuple[float, float]:
        """The least and the largest value."""
        return math.exp(self._find(self._low)), math.exp(self._find(self._high))

    def level_of(self, value: float) -> float:
        """The level at which the quantity has a value.

        Raises:
            OutOfReachError: none has.
        """
        if value <= 0.0:
            raise OutOfReachError(*self.span)
        wanted = math.log(value)
        for step in range(MOST):
            low, high = self._bracket(wanted)
            ends = [end for end in (low, high) if end in self._known]
            best = min(ends, key=lambda end: abs(self._known[end] - wanted))
            place, missing = self._secant(best, wanted), wanted - self._known[best]
            if abs(missing) < self._close:
                break
            if best == (self._high if missing > 0.0 else self._low):
                raise OutOfReachError(*self.span)
            if math.isnan(place):
                place = high if missing > 0.0 else low
            # An end that is not known yet is looked at.
            place = min(max(place, low), high)
            if place in self._known or (step > SURELY and step % 2 == 0):
                place = 0.5 * (low + high)
            if place in self._known:
                break  # no number lies between
            self._find(place)
        place = best if math.isnan(place) else min(max(place, low), high)
        return place if self._even else math.exp(place)

    def _bracket(self, wanted: float) -> tuple[float, float]:
        """The nearest places on either side of a value; the ends where none is known."""
        below = (place for place, found in self._known.items() if found <= wanted)
        above = (place for place, found in self._known.items() if found >= wanted)
        return max(below, default=self._low), min(above, default=self._high)

    def _secant(self, best: float, wanted: float) -> float:
        """Where the line through a place and the nearest other one has a value; nan for nowhere."""
        others = [place for place in self._known if place != best]
        slope = self._slope
        if others:
            near = min(others, key=lambda place: abs(self._known[place] - wanted))
            slope = (self._known[best] - self._known[near]) / (best - near)
        is_rising = 0.0 < slope < math.inf
        return best + (wanted - self._known[best]) / slope if is_rising else math.nan

    def _find(self, place: float) -> float:
        if place not in self._known:
            value = self._value_at(place if self._even else math.exp(place))
            self._known[place] = math.log(value) if value > 0.0 else -math.inf
        return self._known[place]

    def _place(self, level: float) -> float:
        return level if self._even else math.log(level)


def make_until_met(
    make: Callable[[float], Made],
    missing: Callable[[Made], float],
    wanted: float,
    *,
    enough: float,
    times: int,
) -> Made:
    """What has a value when it is measured, or the last of what was made.

    What it misses by is taken for a share of it; what has less than half is asked for twice.

    Args:
        make: makes what has a value, as far as is known before.
        missing: measures by how much what was made falls short of what is wanted.
        wanted: the value.
        enough: how much may be missing.
        times: how often it is made again, at most.
    """
    asked, made = wanted, make(wanted)
    for _ in range(times):
        lacking = missing(made)
        if abs(lacking) <= enough:
            break
        asked *= wanted / max(wanted - lacking, 0.5 * wanted)
        made = make(asked)
    return made

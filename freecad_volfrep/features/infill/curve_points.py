# SPDX-License-Identifier: LGPL-2.1-or-later
"""A grading's formula as points that a curve goes through, and the formula of such points."""

from __future__ import annotations

import re

from volfrep.design.profile import Profile
from volfrep.util.errors import VolfrepError

#: A point: the place s from 0 to 1, and the value there.
Point = tuple[float, float]
_NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
_THROUGH = re.compile(rf"\s*through\(\s*s\s*((?:,\s*{_NUMBER}\s*)+)\)\s*")
#: Points are no nearer to each other than this.
APART = 0.01
#: Places at which any other formula is taken over.
_TAKEN = (0.0, 0.25, 0.5, 0.75, 1.0)
#: Shapes to start from: places, and the share of the way from the least to the largest value.
PRESETS: dict[str, tuple[Point, ...]] = {
    "Rising": ((0.0, 0.0), (1.0, 1.0)),
    "Falling": ((0.0, 1.0), (1.0, 0.0)),
    "Thick in the middle": ((0.0, 0.0), (0.25, 0.5), (0.5, 1.0), (0.75, 0.5), (1.0, 0.0)),
    "Thick at the ends": ((0.0, 1.0), (0.25, 0.5), (0.5, 0.0), (0.75, 0.5), (1.0, 1.0)),
    "Step": ((0.0, 0.0), (0.45, 0.0), (0.55, 1.0), (1.0, 1.0)),
}


def points_of(formula: str) -> tuple[Point, ...] | None:
    """The points of a formula of the form through(s, s1, v1, ...); None for any other."""
    match = _THROUGH.fullmatch(formula)
    if match is None:
        return None
    numbers = [float(number) for number in re.findall(_NUMBER, match[1])]
    points = tuple(zip(numbers[0::2], numbers[1::2], strict=False))
    places = [place for place, _ in points]
    if len(numbers) % 2 or len(points) < 2 or places != sorted(set(places)):
        return None
    return points


def formula_of(points: tuple[Point, ...]) -> str:
    """The formula whose curve goes straight from point to point."""
    numbers = ", ".join(f"{place:.4g}, {value:.4g}" for place, value in points)
    return f"through(s, {numbers})"


def taken_over(formula: str) -> tuple[Point, ...]:
    """Points on any formula's curve.

    Raises:
        VolfrepError: the formula cannot be read, or is not above 0.
    """
    values = Profile("formula", expression=formula)(list(_TAKEN))
    return tuple((place, float(value)) for place, value in zip(_TAKEN, values, strict=True))


def preset(name: str, formula: str) -> tuple[Point, ...]:
    """The points of a shape of `PRESETS`, between the least and the largest value of a formula.

    A formula that is level, or cannot be read, gives values from 1 to 2.
    """
    try:
        low, high = Profile("formula", expression=formula).extremes()
    except VolfrepError:
        low = high = 1.0
    if high < 1.001 * low:
        low, high = 0.75 * low, 1.5 * low
    return tuple((place, low + share * (high - low)) for place, share in PRESETS[name])


def moved(points: tuple[Point, ...], k: int, place: float, value: float) -> tuple[Point, ...]:
    """A point elsewhere: between its neighbours, the ends at 0 and 1, every value above 0."""
    last = len(points) - 1
    low = points[k - 1][0] + APART if k > 0 else 0.0
    high = points[k + 1][0] - APART if k < last else 1.0
    place = (0.0 if k == 0 else 1.0) if k in (0, last) else min(max(place, low), high)
    least = 0.01 * max(value for _, value in points)
    return (*points[:k], (place, max(value, least)), *points[k + 1 :])


def added(points: tuple[Point, ...], place: float, value: float) -> tuple[tuple[Point, ...], int]:
    """One point more, and which it is; the same points where one lies there already."""
    near = min(range(len(points)), key=lambda k: abs(points[k][0] - place))
    if abs(points[near][0] - place) < APART or not 0.0 < place < 1.0:
        return points, near
    all_of_them = tuple(sorted((*points, (place, value))))
    return all_of_them, all_of_them.index((place, value))


def without(points: tuple[Point, ...], k: int) -> tuple[Point, ...]:
    """One point less; the ends stay."""
    return points if k in (0, len(points) - 1) else (*points[:k], *points[k + 1 :])

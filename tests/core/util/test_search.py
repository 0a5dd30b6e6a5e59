# SPDX-License-Identifier: LGPL-2.1-or-later
"""A target is met at the level that its closed form has: thickness of a sheet, radius of a rod."""

from __future__ import annotations

import math
from collections.abc import Callable

import pytest

from volfrep.util.search import OutOfReachError, Rising, make_until_met


def sheet(thickness: float) -> float:
    """Volume of a sheet of 50 x 40 mm."""
    return 2000.0 * thickness


def rod(radius: float) -> float:
    """Volume of a round rod of 60 mm."""
    return 60.0 * math.pi * radius**2


def rods_in_block(radius: float) -> float:
    """Volume of three rods along x, y and z that cross in the middle of a cube of 10 mm.

    The crossing of three equal cylinders is Archimedes' and Piero's: two share 16/3 r3, all three
    8 (2 - sqrt 2) r3.
    """
    crossing = 3.0 * 16.0 / 3.0 - 8.0 * (2.0 - math.sqrt(2.0))
    return 30.0 * math.pi * radius**2 - crossing * radius**3


def plate(thickness: float) -> float:
    """Stiffness of a plate that bends, which goes with the cube of its thickness."""
    return 0.3 * thickness**3


CLOSED = [
    (sheet, lambda volume: volume / 2000.0, (0.01, 5.0)),
    (rod, lambda volume: math.sqrt(volume / (60.0 * math.pi)), (0.02, 4.0)),
    (plate, lambda stiffness: math.cbrt(stiffness / 0.3) if hasattr(math, "cbrt") else
        (stiffness / 0.3) ** (1.0 / 3.0), (0.01, 5.0)),
]  # fmt: skip


class Counted:
    """A function that counts how often it was asked."""

    def __init__(self, function: Callable[[float], float]) -> None:
        self.function, self.calls = function, 0

    def __call__(self, level: float) -> float:
        self.calls += 1
        return self.function(level)


@pytest.mark.parametrize(("quantity", "inverse", "ends"), CLOSED)
@pytest.mark.parametrize("share", [0.0, 0.1, 0.5, 0.99, 1.0])
def test_a_power_of_the_level_is_found_in_one_step(quantity, inverse, ends, share) -> None:
    value = quantity(ends[0] + share * (ends[1] - ends[0]))
    counted = Counted(quantity)
    found = Rising(counted, *ends, close=1e-10).level_of(value)
    assert found == pytest.approx(inverse(value), rel=1e-9)
    assert counted.calls <= 3


def test_crossing_rods_are_found_from_a_guess_and_again_from_what_is_known() -> None:
    counted = Counted(rods_in_block)
    search = Rising(counted, 0.01, 4.0, close=1e-8, start=1.0, slope=2.0)
    for radius in (1.7, 1.6, 3.9, 0.02):
        before = counted.calls
        assert search.level_of(rods_in_block(radius)) == pytest.approx(radius, rel=1e-7)
        assert counted.calls - before <= 7


def test_levels_below_zero_count_by_their_differences() -> None:
    """As the offset of a skeleton: of a half space in a cube of 2 mm, the share 0.5 + d / 2."""
    search = Rising(lambda d: 0.5 + 0.5 * d, -0.9, 0.9, close=1e-9, start=0.0, even=True)
    assert search.level_of(0.2) == pytest.approx(-0.6)


@pytest.mark.parametrize("start", [None, 1.0])
@pytest.mark.parametrize("volume", [-3.0, 0.0, 1.0, 25000.0])
def test_what_no_level_has_is_refused_with_what_can_be_had(start, volume) -> None:
    with pytest.raises(OutOfReachError) as told:
        Rising(sheet, 0.01, 5.0, close=1e-6, start=start).level_of(volume)
    assert (told.value.least, told.value.most) == pytest.approx((20.0, 10000.0))


def test_a_jump_is_found_between_its_sides() -> None:
    """As of a volume by points: nothing has the value, and the search ends."""
    found = Rising(lambda level: 1.0 if level < 2.0 else 3.0, 0.5, 8.0, close=1e-9).level_of(2.0)
    assert found == pytest.approx(2.0, rel=1e-3)


@pytest.mark.parametrize("error", [0.7, 0.97, 1.0, 1.04, 2.5])
def test_what_misses_is_made_again_with_what_it_missed_by(error) -> None:
    made = []

    def make(volume: float) -> float:
        made.append(volume)
        return error * volume

    last = make_until_met(make, lambda found: 80.0 - found, 80.0, enough=0.2, times=2)
    assert last == pytest.approx(80.0, abs=0.2)
    assert len(made) == (1 if error == 1.0 else 2)


def test_nothing_is_made_again_where_nothing_is_measured() -> None:
    assert make_until_met(lambda value: value, lambda _: 1 / 0, 4.0, enough=0.0, times=0) == 4.0

# SPDX-License-Identifier: LGPL-2.1-or-later
"""The finest facets with which a file keeps within limits: first by forecast, then by the file.

Triangles grow with the square of the facets along a cell, but for those of the skin and where
joints are divided. So after each file that was made the next is as much finer or coarser as its own
size says; where that leaves much of the limits unused, finer ones that were passed over are tried.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Generic, TypeVar

from ..design.file_limits import FileLimits
from ..design.spec import LatticeSpec
from ..graphs.surface import FEWEST_SIDES
from ..util.errors import VolfrepError
from ..util.numbers import round_off
from .kinds.graphs import sides_at

T = TypeVar("T")

#: A file that uses as much of its limits is not made anew to be finer.
ENOUGH = 0.85
#: The next file is made to use so much of them.
AIM = 0.95
#: One that uses less is made anew with finer facets that seemed too many: where joints had to be
#: divided, finer facets may be fewer.
LEAST = 0.7
MOST_FILES = 8
#: A forecast that is so many times too large is believed before there is a file, of so many
#: triangles: of those measured the largest was 1.43 times what was made. Smaller parts, of which
#: forecasts were up to 4 times too large, are quickly made.
SURELY, SLOW = 3.0, 100_000


@dataclass(frozen=True)
class Fitted(Generic[T]):
    """What keeps within limits.

    Attributes:
        made: as `fit_within` was told to make it.
        spec: of it.
        used: of the limits, 0 to 1.
        note: what it costs, for the user; empty where it costs nothing.
    """

    made: T
    spec: LatticeSpec
    used: float
    note: str


def fit_within(
    spec: LatticeSpec,
    limits: FileLimits,
    expect: Callable[[LatticeSpec], float],
    make: Callable[[LatticeSpec], tuple[T, int, float]],
    each: float,
) -> Fitted[T]:
    """Make a file with the finest facets, none finer than asked for, that keeps within limits.

    Args:
        spec: what is wanted.
        limits: of the file.
        expect: about how many triangles a specification has.
        make: makes one; gives it, its triangles and the size of its file in megabytes.
        each: bytes that a triangle takes in the file, about.

    Raises:
        VolfrepError: not even the coarsest facets that keep its struts round, or its walls whole,
            are few enough.
    """
    if not spec.kind.has_grid:
        return _fit_corners(spec, limits, make)
    finest, coarsest = spec.facets_along_cell, spec.kind.coarsest_resolution
    coarsest = min(coarsest, finest)
    told = expect(spec if coarsest == finest else _with(spec, coarsest))
    if told > SLOW and _share_used(limits, told, each * told / 1e6) > SURELY:
        raise _too_many(limits, coarsest, f"would have about {round_off(told)} triangles")
    low, high = coarsest, finest
    facets, best = _first(spec, limits, expect, each, coarsest, finest), None
    left = set(range(coarsest, finest + 1))
    for _ in range(MOST_FILES):
        tried = spec if facets == finest else _with(spec, facets)
        made, triangles, megabytes = make(tried)
        left.discard(facets)
        used = _share_used(limits, triangles, megabytes)
        if used <= 1.0:
            low = max(low, facets + 1)
            if best is None or used > best.used:
                deviation = "" if facets == finest else _note(spec, facets, finest, limits)
                best = Fitted(made, tried, used, deviation)
        else:
            high = min(high, facets - 1)
            if facets == coarsest:
                size = "" if limits.megabytes is None else f" and {megabytes:.3g} MB"
                raise _too_many(limits, coarsest, f"has {triangles:,} triangles{size}")
        if best is not None and best.used >= ENOUGH:
            break
        if low <= high:
            facets = min(max(int(facets * (AIM / used) ** 0.5), low), high)
            continue
        finer = {count for count in left if count >= low}
        if not finer or (best is not None and best.used >= LEAST):
            break
        facets = max(finer)
    if best is None:
        raise VolfrepError(
            f"No facets were found with which the file keeps within {limits} in {MOST_FILES} "
            "tries: give a larger --deviation yourself."
        )
    return best


def _fit_corners(
    spec: LatticeSpec,
    limits: FileLimits,
    make: Callable[[LatticeSpec], tuple[T, int, float]],
) -> Fitted[T]:
    """The same of a graph lattice, which has facets round its struts and no others."""
    made, triangles, megabytes = make(spec)
    used = _share_used(limits, triangles, megabytes)
    if used <= 1.0:
        return Fitted(made, spec, used, "")
    radius = spec.strut_radius
    finest = corners = sides_at(spec, radius)
    for _ in range(MOST_FILES):
        if corners == FEWEST_SIDES:
            break
        corners = max(min(int(corners * AIM / used), corners - 1), FEWEST_SIDES)
        deviation = (2.0 * math.pi / corners) ** 2 / 16.0 * radius
        tried = replace(spec, resolution=None, deviation=deviation * (1.0 + 1e-9))
        made, triangles, megabytes = make(tried)
        used = _share_used(limits, triangles, megabytes)
        if used <= 1.0:
            note = (
                f"To keep within {limits} struts have {corners} corners round in place of "
                f"{finest}: they stray {deviation:.2g} mm from round ones."
            )
            return Fitted(made, tried, used, note)
    size = "" if limits.megabytes is None else f" and {megabytes:.3g} MB"
    raise VolfrepError(
        f"With the fewest corners round its struts ({FEWEST_SIDES}) the file has {triangles:,} "
        f"triangles{size}, more than {limits}: leave struts out or make the part smaller."
    )


def _too_many(limits: FileLimits, coarsest: int, what: str) -> VolfrepError:
    """Says that a file cannot keep within limits."""
    return VolfrepError(
        f"With the coarsest facets at which its lattice keeps its shape ({coarsest} along a cell) "
        f"the file {what}, more than {limits}: make the cells larger or the part smaller."
    )


def _with(spec: LatticeSpec, facets: int) -> LatticeSpec:
    return replace(spec, resolution=facets, deviation=None)


def _share_used(limits: FileLimits, triangles: float, megabytes: float) -> float:
    """The largest share of the limits."""
    shares = [0.0]
    if limits.triangles is not None:
        shares.append(triangles / limits.triangles)
    if limits.megabytes is not None:
        shares.append(megabytes / limits.megabytes)
    return max(shares)


def _first(
    spec: LatticeSpec,
    limits: FileLimits,
    expect: Callable[[LatticeSpec], float],
    each: float,
    coarsest: int,
    finest: int,
) -> int:
    """Facets along a cell that are expected to keep within the limits."""
    low, high = coarsest, finest
    while low < high:
        facets = (low + high + 1) // 2
        triangles = expect(spec if facets == finest else _with(spec, facets))
        if _share_used(limits, triangles, each * triangles / 1e6) <= 1.0:
            low = facets
        else:
            high = facets - 1
    return low


def _note(spec: LatticeSpec, facets: int, finest: int, limits: FileLimits) -> str:
    """What coarser facets cost."""
    return (
        f"To keep within {limits} there are {facets} facets along a cell in place of {finest}: "
        f"they stray {spec.kind.deviation_of(facets):.2g} mm from the lattice in place of "
        f"{spec.kind.deviation_of(finest):.2g} mm."
    )

# SPDX-License-Identifier: LGPL-2.1-or-later
"""The exact relative density of an endless lattice, without a mesh; and the radius of a density.

The volume of a union is the sum over its bodies of the mean of 1 / (bodies that cover a point),
with points in each body by itself (Karp, Luby & Madras, J. Algorithms 10, 1989). Struts cover each
other at their ends only, so most of that is exact; the rest is a smooth integral, done with
Sobol' points (1967), scrambled (Matousek, J. Complexity 14, 1998): several sets tell the error.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from ..design.cells import UnitCell
from ..octants import sdf as frep
from ..octants.sdf import Primitives
from ..spatial.even_points import even_points
from ..util.errors import VolfrepError
from ..util.linalg import axes_across
from ..util.search import OutOfReachError, Rising
from ..util.types import Floats, Ints
from .endless import EndlessCell, endless_cell, own_primitives, refuse_odd

#: Sets of Sobol points, and points of a set in each body (a power of 2).
SETS = 8
POINTS_LOG2 = 11
POINTS = 2**POINTS_LOG2
#: Pairs of a point and a body that are looked at together.
_CHUNK = 2_000_000
#: Standard errors that the error tells.
_SURE = 3.0
#: A radius is found when its density is this near, relative.
_CLOSE = 1e-5


@dataclass(frozen=True)
class Density:
    """A relative density.

    Attributes:
        value: solid volume over the cell's.
        error: by how much it may be off (three standard errors).
    """

    value: float
    error: float


def relative_density(cell: UnitCell, radius: float, fillet: float = 0.0) -> Density:
    """The relative density of the endless lattice, to about 0.01 %.

    Args:
        cell: the unit cell.
        radius: of the struts, in units of L.
        fillet: radius of the round between struts, in units of L.

    Raises:
        VolfrepError: the struts are too thick for the cell.

    >>> from volfrep.design.cells import find_cell
    >>> round(relative_density(find_cell("BCC"), 0.1).value, 3)
    0.243
    """
    if not 0.0 < radius + radius**2 + fillet < 0.5 or fillet < 0.0:
        raise VolfrepError(
            f"Struts of radius {radius:.4g} L with a fillet of {fillet:.4g} L do not fit a cell: "
            "joint and fillet must be below half of it."
        )
    refuse_odd(cell)
    endless = endless_cell(cell)
    sets = _shares(endless, radius, 0.0)
    if fillet:
        sets = sets + _shares(endless, radius, fillet)
    return Density(float(sets.mean()), float(_SURE * sets.std(ddof=1) / np.sqrt(SETS)))


def radius_of_density(cell: UnitCell, density: float, fillet: float = 0.0) -> float:
    """The strut radius, in units of L, whose lattice has a relative density.

    Raises:
        VolfrepError: no radius gives it; the text names the densities that can be had.
    """
    if not 0.0 < density < 1.0:
        raise VolfrepError(f"A relative density must be between 0 and 1, not {density:g}.")
    most = np.sqrt(0.25 + 0.4999 - fillet) - 0.5 if fillet < 0.4999 else 0.0
    if most <= 0.0:
        raise VolfrepError(f"A fillet of {fillet:.4g} L is too large for a cell.")
    rods = np.pi * endless_cell(cell).lengths.sum()
    found = Rising(
        lambda radius: relative_density(cell, radius, fillet).value,
        min(1e-3, most / 10), float(most), close=_CLOSE,
        start=float(np.sqrt(max(density, 1e-12) / rods)), slope=1.9,
    )  # fmt: skip
    try:
        return found.level_of(density)
    except OutOfReachError as reach:
        raise VolfrepError(
            f"No strut radius gives the cell '{cell.name}' a relative density of {density:.4g}: "
            f"choose one from {reach.least:.2g} to {reach.most:.3g}."
        ) from reach


def radii_of_densities(cell: UnitCell, densities: Floats, fillet: float = 0.0) -> Floats:
    """Strut radii, in units of L, of endless lattices of many relative densities.

    Monotone between nine exact ones; where the density varies from cell to cell, each place has
    the radius of the even lattice of its density.

    Args:
        cell: the unit cell.
        densities: of any shape.
        fillet: as of `relative_density`.

    Raises:
        VolfrepError: no radius gives the smallest or the largest of them.

    >>> from volfrep.design.cells import find_cell
    >>> radii_of_densities(find_cell("BCC"), np.array([0.1, 0.243, 0.3])).round(2).tolist()
    [0.06, 0.1, 0.11]
    """
    from scipy.interpolate import PchipInterpolator  # slow to import

    low, high = float(densities.min()), float(densities.max())
    first, last = (radius_of_density(cell, density, fillet) for density in (low, high))
    if not first < last:
        return np.full(densities.shape, first)
    radii = np.linspace(first, last, 9)
    inner = [relative_density(cell, radius, fillet).value for radius in radii[1:-1]]
    curve = PchipInterpolator([low, *inner, high], radii)
    return np.asarray(np.clip(curve(densities), first, last))


def _shares(endless: EndlessCell, radius: float, fillet: float) -> Floats:
    """(SETS,) estimates of the solid share of the cell.

    With a fillet: of what it adds to the union, looked for within its reach of the bodies.
    """
    bodies = own_primitives(endless, radius)
    shifts = np.array(list(itertools.product((-1, 0, 1), repeat=3)), float)
    copies = _copies(bodies, shifts)
    body, near = _neighbours(bodies, copies, fillet)
    volume, points = _points(bodies, fillet)  # (b,), (b, SETS * POINTS, 3)
    start = np.searchsorted(body, np.arange(len(bodies) + 1))
    share = np.empty(points.shape[:2])
    step = max(1, _CHUNK // points.shape[1])
    for row in range(len(bodies)):
        own = near[start[row] : start[row + 1]]
        for first in range(0, points.shape[1], step):
            chunk = points[row, first : first + step]
            values = frep.distances(chunk[:, None], copies.take(own))
            reached = values < fillet if fillet else values <= 0.0
            itself = frep.distances(chunk, bodies.take(np.full(len(chunk), row)))
            solid = itself < fillet if fillet else itself <= 0.0
            if fillet:
                solid &= (values.min(axis=1) > 0.0) & (frep.union(values, fillet) <= 0.0)
            cover = np.maximum(np.count_nonzero(reached, axis=1), 1)
            share[row, first : first + step] = solid / cover
    means = share.reshape(len(bodies), SETS, POINTS).mean(axis=2)
    result: Floats = volume @ means
    return result


def _copies(bodies: Primitives, shifts: Floats) -> Primitives:
    """The bodies of one period, shifted by every row."""
    row = np.tile(np.arange(len(bodies)), len(shifts))
    taken = bodies.take(row)
    shifted = taken.middle + np.repeat(shifts, len(bodies), axis=0)
    return Primitives(shifted, taken.direction, taken.half_length, taken.radius, taken.slope)


def _neighbours(bodies: Primitives, copies: Primitives, fillet: float) -> tuple[Ints, Ints]:
    """Pairs of a body and a copy that may share a point, by body: their axes come that near."""
    gap = _axis_gaps(bodies, copies)
    reach = bodies.radius[:, None] + copies.radius + 2.0 * fillet
    body, copy = np.nonzero(gap <= reach * (1 + 1e-9) + 1e-9)
    return body, copy


def _axis_gaps(one: Primitives, two: Primitives) -> Floats:
    """(n, m) distances between the axes of primitives; a sphere's axis is its centre.

    Ericson, Real-Time Collision Detection (2005), 5.1.9, for all pairs at once.
    """
    half_one = np.where(one.direction.any(axis=1), one.half_length, 0.0)[:, None]
    half_two = np.where(two.direction.any(axis=1), two.half_length, 0.0)[None]
    between = one.middle[:, None] - two.middle
    along = one.direction @ two.direction.T
    first = np.einsum("nmi,ni->nm", between, one.direction)
    second = np.einsum("nmi,mi->nm", between, two.direction)
    with np.errstate(divide="ignore", invalid="ignore"):
        place = (along * second - first) / (1.0 - along**2)
    place = np.clip(np.where(np.abs(along) > 1 - 1e-12, 0.0, place), -half_one, half_one)
    other = np.clip(along * place + second, -half_two, half_two)
    place = np.clip(along * other - first, -half_one, half_one)
    other = np.clip(along * place + second, -half_two, half_two)
    gap = between + place[..., None] * one.direction[:, None] - other[..., None] * two.direction
    parallel = np.abs(along) > 1 - 1e-12
    # Parallel axes: any offset along them up to the sum of the halves is bridged.
    beyond = np.maximum(np.abs(second) - half_one - half_two, 0.0)
    across = between - second[..., None] * two.direction
    side = np.linalg.norm(across, axis=2)
    result: Floats = np.where(parallel, np.hypot(side, beyond), np.linalg.norm(gap, axis=2))
    return result


@lru_cache(maxsize=2)
def _sobol() -> NDArray[np.float64]:
    """(SETS * POINTS, 3) points of the unit cube, the same in every run."""
    return np.concatenate([even_points(3, POINTS_LOG2, seed) for seed in range(SETS)])


def _points(bodies: Primitives, fillet: float) -> tuple[Floats, Floats]:
    """Volumes of the bodies, and equally many points in each.

    With a fillet the bodies are thicker by it, longer too, and spheres and caps are boxed by
    cylinders and balls of the larger radius.
    """
    # Every body its own points: errors at ends that look alike then cancel.
    offset = np.random.default_rng(0).random((len(bodies), SETS, 1, 3))
    unit = (_sobol().reshape(SETS, POINTS, 3) + offset) % 1.0
    first, second, third = np.moveaxis(unit.reshape(len(bodies), -1, 3), -1, 0)
    sphere = ~bodies.direction.any(axis=1)
    radius = bodies.radius + fillet
    half = bodies.half_length + fillet
    angle = 2.0 * np.pi * second
    # Cylinders: across by the root of a share of the area.
    axis = bodies.direction[~sphere]
    aside, upward = axes_across(axis)
    height = (2.0 * first - 1.0)[..., None]
    turn = np.cos(angle)[~sphere, :, None] * aside[:, None]
    turn += np.sin(angle)[~sphere, :, None] * upward[:, None]
    points = np.empty((*first.shape, 3))
    points[~sphere] = height[~sphere] * (half[~sphere, None] * axis)[:, None]
    points[~sphere] += np.sqrt(third)[~sphere, :, None] * radius[~sphere, None, None] * turn
    ring = np.sqrt(1.0 - height**2)
    ball = np.concatenate(
        [ring * np.cos(angle)[..., None], ring * np.sin(angle)[..., None], height], axis=2
    )
    points[sphere] = (np.cbrt(third) * radius[:, None])[sphere][..., None] * ball[sphere]
    points += bodies.middle[:, None]
    volume = np.where(
        sphere, 4.0 / 3.0 * np.pi * radius**3, 2.0 * np.pi * radius**2 * np.where(sphere, 0, half)
    )
    return volume, points

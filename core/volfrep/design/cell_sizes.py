# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cells, and random points, whose size follows a field of places.

Cells grow along one direction (`grading.SizeGrading`), so that they can follow a field that varies
along one direction. Which one is found from the field's samples; what varies across it is refused,
with how much that is. The points of a random graph follow any field.
"""

from __future__ import annotations

import dataclasses
from typing import NamedTuple

import numpy as np

from ..util.errors import VolfrepError
from ..util.linalg import along, symmetric_eigen
from ..util.numbers import number
from ..util.types import Floats
from .grading import Field, SizeGrading
from .profile import SAMPLED, Profile
from .sampled_field import SampledField

#: Samples of a function along the longest side of the part's box, at most.
SAMPLES = 100
#: By how much a size may differ across the direction that cells follow: they have its mean.
LARGEST_SPREAD = 0.05
#: Values of lambda in a profile.
STEPS = 1024
#: Scattered points are held against their neighbours along the direction in groups of so many, in
#: at most so many groups; of fewer points only those that lie side by side are.
_IN_GROUP, _MOST_GROUPS, _FEWEST = 6, 100, 24


def cells_by(field: Field, bounds: Floats) -> tuple[SizeGrading | None, float]:
    """The grading of cells that are as long along one direction as a field says, and L.

    L is their mean length, mm; they measure L across. Along an axis of the box a whole number of
    cells is placed, which makes all of them a little longer or shorter.

    Args:
        field: the length of a cell at places, mm.
        bounds: (2, 3) the part's box, mm.

    Returns:
        None for the grading where the field is the same everywhere.

    Raises:
        VolfrepError: a length is not above 0, or they differ across every direction, by how much.

    >>> field = SampledField([0, 0, 0], [30, 9, 9], [[[4, 4], [4, 4]], [[8, 8], [8, 8]]])
    >>> grading, size = cells_by(field, field.bounds)
    >>> grading.direction, round(size, 2)
    ((1.0, 0.0, 0.0), 5.77)
    """
    _ = _check(field)
    points, sizes = _samples(field)
    if np.ptp(sizes) <= 1e-9 * sizes.max():
        return None, float(sizes.max())
    found = [_along(points, sizes, way, bounds) for way in _directions(field, points, sizes)]
    best = min(found, key=lambda one: (one.spread > LARGEST_SPREAD, one.way))
    direction, length = best.direction, best.length
    if best.spread > LARGEST_SPREAD:
        best = min(found, key=lambda one: one.spread)
        way = ", ".join(f"{x + 0.0:.3g}" for x in best.direction)
        raise VolfrepError(
            f"'cell_size' differs by up to {best.spread:.0%} across the direction ({way}), along "
            "which cells could follow it best, and cells grow along one direction only: let it "
            "depend on the place along one, or choose network='voronoi', whose points follow it "
            "everywhere."
        )
    s = np.linspace(0.0, 1.0, 8 * STEPS + 1)
    wanted = np.interp(s, best.places, best.sizes)
    cells = np.append(0.0, np.cumsum(0.5 / wanted[1:] + 0.5 / wanted[:-1])) * length / (8 * STEPS)
    size = length / float(cells[-1])
    steps = np.linspace(0.0, 1.0, STEPS + 1)
    moved = np.interp(steps, cells / cells[-1], s)
    # What lies at s moves to s lambda(s), so that a cell is L (lambda + s lambda') long.
    values = np.append(wanted[0] / size, moved[1:] / steps[1:])
    x, y, z = direction.tolist()
    return SizeGrading(Profile(SAMPLED, values=tuple(values.tolist())), (x, y, z)), size


def points_by(field: Field, bounds: Floats) -> tuple[Field | None, float]:
    """How dense random points lie that are as far apart as a field says, and how far in the mean.

    Args:
        field: the distance at places, mm.
        bounds: (2, 3) the part's box, over which the mean is, mm.

    Returns:
        Points in a cube as wide as that mean distance; None where they are the same everywhere.

    Raises:
        VolfrepError: a distance is not above 0.

    >>> field = SampledField([0, 0, 0], [9, 9, 9], np.full((2, 2, 2), 3.0))
    >>> points_by(field, field.bounds)
    (None, 3.0)
    """
    least, most = _check(field)
    if most - least <= 1e-9 * most:
        return None, most
    axes = [np.linspace(bounds[0, k], bounds[1, k], 25) for k in range(3)]
    middles = [0.5 * (axis[1:] + axis[:-1]) for axis in axes]
    places = np.stack(np.meshgrid(*middles, indexing="ij"), axis=-1).reshape(-1, 3)
    size = float(np.mean(field(places) ** -3.0) ** (-1.0 / 3.0))
    return dataclasses.replace(field, values=(size / field.values) ** 3), size


def _check(field: Field) -> tuple[float, float]:
    """The smallest and the largest size; both make sense."""
    least, most = field.range
    number("cell size", least, "mm", positive=True)
    return least, number("cell size", most, "mm", positive=True)


def _samples(field: Field) -> tuple[Floats, Floats]:
    """(n, 3) places and (n,) values that a field is known by."""
    if not isinstance(field, SampledField):
        return field.points, field.values
    axes = [field.corner[k] + field.spacing[k] * np.arange(field.values.shape[k]) for k in range(3)]
    return np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3), field.values.ravel()


def _directions(field: Field, points: Floats, sizes: Floats) -> list[Floats]:
    """Unit vectors along which a field may vary: the axes, and where it is steepest in all."""
    if isinstance(field, SampledField):
        slopes = np.stack(np.gradient(field.values, *field.spacing), axis=-1).reshape(-1, 3)
    else:
        slopes = _slope(points - points.mean(axis=0), sizes - sizes.mean())[None]
    steepest = symmetric_eigen(_squares(slopes))[1][0, :, -1] if slopes.any() else np.zeros(3)
    length = float(np.linalg.norm(steepest))
    axes = list(np.eye(3))
    if length == 0.0 or np.abs(steepest).max() > (1.0 - 1e-6) * length:
        return axes
    return [*axes, steepest * np.sign(steepest[np.abs(steepest).argmax()]) / length]


def _squares(rows: Floats) -> Floats:
    """(1, 3, 3) the sum of the squares of (n, 3) rows."""
    return np.asarray(np.einsum("ni,nj->ij", rows, rows)[None])


def _slope(places: Floats, values: Floats) -> Floats:
    """(3,) the slope of the plane that is nearest to values at places, both less their means."""
    squares, ways = symmetric_eigen(_squares(places))
    pulls = np.einsum("nj,jk,n->k", places, ways[0], values)
    known = squares[0] > 1e-12 * squares[0, -1]
    shares = np.divide(pulls, squares[0], out=np.zeros(3), where=known)
    return np.asarray(np.einsum("jk,k->j", ways[0], shares))


class _Along(NamedTuple):
    """What a field does along a direction."""

    direction: Floats
    #: Of the box, mm.
    length: float
    #: Ascending, 0 to 1 along the box, and the mean size at each.
    places: Floats
    sizes: Floats
    #: What the size differs by from that across the direction, over it.
    spread: float
    #: How far it goes up and down from sample to sample, and a quarter more where that is no axis.
    way: float


def _along(points: Floats, sizes: Floats, direction: Floats, bounds: Floats) -> _Along:
    """What sizes at points do along a direction."""
    ends = np.sort(bounds * direction, axis=0).sum(axis=1)
    length = float(ends[1] - ends[0])
    place = (along(points, direction) - ends[0]) / length
    order = np.argsort(np.round(place, 6), kind="stable")
    way = float(np.abs(np.diff(sizes[order])).sum()) * (1.0 + 0.25 * (direction.max() < 1.0))
    levels = np.round(place, 6 if len(sizes) >= _FEWEST else 2)
    kept, group = np.unique(levels, return_inverse=True)
    if len(sizes) >= _FEWEST and len(kept) > len(sizes) / 4:  # scattered, or on a turned grid
        count = min(_MOST_GROUPS, len(sizes) // _IN_GROUP)
        group = np.empty(len(sizes), int)
        group[order] = np.arange(len(sizes)) * count // len(sizes)
    number_in = np.bincount(group)
    middle, mean = (np.bincount(group, what) / number_in for what in (place, sizes))
    # In a group the size may rise along the direction; what is left differs across it.
    aside = place - middle[group]
    square = np.bincount(group, aside * aside)
    rise = np.bincount(group, aside * sizes) / np.where(square > 1e-12, square, np.inf)
    left = np.abs(sizes - mean[group] - rise[group] * aside) / mean[group]
    first, last = float(place.min()), float(place.max())
    outer = mean[[0, -1]] + rise[[0, -1]] * (np.array([first, last]) - middle[[0, -1]])
    places = np.concatenate([[first - 1e-9], middle, [last + 1e-9]])
    mean = np.clip(np.concatenate([outer[:1], mean, outer[1:]]), sizes.min(), sizes.max())
    return _Along(direction, length, places, mean, float(left.max()), way)

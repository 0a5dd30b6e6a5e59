# SPDX-License-Identifier: LGPL-2.1-or-later
"""Scattered-data interpolation of a stress or temperature, and its transfer curve to a radius.

Weights over the 8 nearest points fade to nothing at the ninth (Shepard), because plain weights jump
where neighbours change.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from ..util.content import content_of, freeze
from ..util.errors import VolfrepError
from ..util.threads import threads
from ..util.types import Floats

if TYPE_CHECKING:
    from scipy.spatial import cKDTree


#: How many of the nearest points have a say in the value at a place.
NEIGHBOURS = 8
#: In mm. Squared distances of anything nearer are far from float64's limits.
FARTHEST = 1e9
#: Places evaluated at once.
CHUNK = 200_000


@dataclass(frozen=True)
class PointField:
    """A scalar field interpolated between scattered points; equal to others of the same content.

    The value at a place is the mean of its 8 nearest points weighted by the inverse square of
    their distance (D. Shepard, "A two-dimensional interpolation function for irregularly-spaced
    data", 1968), faded so that a point has no say any more when it becomes the ninth (Franke and
    Little's weights: R. Franke, Math. Comp. 38, 1982): the field is continuous, equals the data
    at the points, and never leaves their range. Among 8 points or fewer all have their say.

    Attributes:
        points: (n, 3) float64, mm; where several coincide there is one, with their mean value.
        values: (n,) float64, in whatever unit.
        source: where they come from, for the report.

    Raises:
        VolfrepError: at construction: no points, or numbers that are not finite.

    >>> field = PointField([[0, 0, 0], [10, 0, 0]], [1, 3])
    >>> field([[0, 0, 0], [5, 0, 0]]).tolist(), field.range
    ([1.0, 2.0], (1.0, 3.0))
    """

    points: Floats = field(compare=False)
    values: Floats = field(compare=False)
    source: str = ""
    _content: bytes = field(init=False, repr=False)
    _tree: cKDTree = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        points = np.asarray(self.points, dtype=np.float64)
        values = np.asarray(self.values, dtype=np.float64)
        if points.ndim != 2 or points.shape[1] != 3 or values.shape != points.shape[:1]:
            raise VolfrepError(
                f"A field needs points (n, 3) and a value for each, not arrays of shapes "
                f"{points.shape} and {values.shape}."
            )
        name = f"The field '{self.source}'" if self.source else "The field"
        if not len(points):
            raise VolfrepError(f"{name} has no points: give at least one.")
        bad = np.flatnonzero(~np.isfinite(points).all(axis=1) | ~np.isfinite(values))
        if len(bad):
            raise VolfrepError(f"{name} holds a number that is not finite, at point {bad[0]}.")
        if np.abs(points).max() > FARTHEST:
            raise VolfrepError(
                f"{name} has points up to {np.abs(points).max():.3g} mm from the origin: "
                f"the limit is {FARTHEST:g} mm."
            )
        points, values = _merge(points, values)
        object.__setattr__(self, "points", freeze(points, np.float64))
        object.__setattr__(self, "values", freeze(values, np.float64))
        object.__setattr__(self, "_content", content_of(points, values))
        from scipy.spatial import cKDTree  # slow to import, and most jobs have no field

        object.__setattr__(self, "_tree", cKDTree(points))

    @property
    def range(self) -> tuple[float, float]:
        """The smallest and the largest value; the field stays between them."""
        return float(self.values.min()), float(self.values.max())

    @property
    def bounds(self) -> Floats:
        """Corners (2, 3) of the points' box, mm."""
        return np.array([self.points.min(axis=0), self.points.max(axis=0)])

    def __call__(self, points: ArrayLike) -> Floats:
        """The field's values (m,) at `points` (m, 3), mm."""
        places = np.asarray(points, dtype=np.float64).reshape(-1, 3)
        values = np.empty(len(places))
        for start in range(0, len(places), CHUNK):
            values[start : start + CHUNK] = self._interpolate(places[start : start + CHUNK])
        return values

    def _interpolate(self, places: Floats) -> Floats:
        count = min(NEIGHBOURS, len(self.points))
        wanted = min(count + 1, len(self.points))
        distance, index = self._tree.query(places, k=list(range(1, wanted + 1)), workers=threads())
        near = distance[:, :count]
        # Relative to the nearest point, so that nothing overflows; on a point, it alone counts.
        ratio = np.where(near > 0.0, near[:, :1] / np.where(near > 0.0, near, 1.0), 1.0)
        if wanted > count:
            rim = np.maximum(distance[:, count:], np.finfo(float).tiny)
            # Not quite to nothing: where all nine are as far, all eight count alike.
            ratio *= np.maximum(1.0 - near / rim, 1e-9)
        weight = ratio * ratio
        weight /= weight.sum(axis=1, keepdims=True)
        values: Floats = (weight * self.values[index[:, :count]]).sum(axis=1)
        return np.clip(values, *self.range)


def _merge(points: Floats, values: Floats) -> tuple[Floats, Floats]:
    """Points in the order of their coordinates, each once, with the mean of its values."""
    order = np.lexsort(points.T)
    points, values = points[order], values[order]
    first = np.append(True, (points[1:] != points[:-1]).any(axis=1))
    start = np.flatnonzero(first)
    count = np.diff(np.append(start, len(points)))
    return points[start], np.add.reduceat(values / np.repeat(count, count), start)


@dataclass(frozen=True)
class TransferCurve:
    """A strut radius for each value of a field: straight between given pairs, level beyond them.

    Attributes:
        values: of the field, ascending.
        radii: mm, one for each value, rising or falling throughout (equal ones may follow each
            other).

    Raises:
        VolfrepError: at construction, naming the first pair that makes no sense.

    >>> TransferCurve((0, 120), (0.5, 1.5))([-10, 60, 120]).tolist()
    [0.5, 1.0, 1.5]
    """

    values: tuple[float, ...]
    radii: tuple[float, ...]

    def __post_init__(self) -> None:
        values, radii = _finite("values", self.values), _finite("radii", self.radii)
        if len(values) != len(radii) or len(values) < 2:
            raise VolfrepError(
                f"A curve needs two or more values and as many radii, not {len(values)} and "
                f"{len(radii)}."
            )
        back = np.flatnonzero(np.diff(values) <= 0.0)
        if len(back):
            raise VolfrepError(
                f"The curve's values must ascend: {values[back[0] + 1]:g} follows "
                f"{values[back[0]]:g}."
            )
        if radii.min() <= 0.0:
            raise VolfrepError(f"The curve's radii must be above 0 mm, not {radii.min():g}.")
        steps = np.diff(radii)
        if (steps > 0.0).any() and (steps < 0.0).any():
            turn = int(np.flatnonzero(steps * steps[np.flatnonzero(steps)[0]] < 0.0)[0])
            raise VolfrepError(
                f"The curve's radii must rise throughout or fall throughout: they turn at the "
                f"value {values[turn]:g}."
            )
        object.__setattr__(self, "values", tuple(values.tolist()))
        object.__setattr__(self, "radii", tuple(radii.tolist()))

    def __call__(self, values: ArrayLike) -> Floats:
        """Radii in mm at `values`, float64 of the same shape."""
        places = np.asarray(values, np.float64)
        x, y = np.asarray(self.values), np.asarray(self.radii)
        with np.errstate(over="ignore"):
            steepest = np.abs(np.diff(y) / np.diff(x)).max()
        if np.isfinite(steepest):
            radii = np.interp(places, x, y)
        else:  # values so near each other that no number tells the slope between them
            k = np.clip(np.searchsorted(x, places, "right") - 1, 0, len(x) - 2)
            share = np.clip((places - x[k]) / (x[k + 1] - x[k]), 0.0, 1.0)
            radii = y[k] + (y[k + 1] - y[k]) * share
        # The line between two values may end a rounding beyond them.
        return np.asarray(np.clip(radii, y.min(), y.max()))


def read_curve(text: str) -> tuple[tuple[float, float], ...]:
    """The pairs (value, radius in mm) of a text such as ``0:0.5, 120:1.2``.

    Raises:
        VolfrepError: the text is no list of pairs; it names the first that is none.

    >>> read_curve("0:0.5, 120:1.2")
    ((0.0, 0.5), (120.0, 1.2))
    """
    pairs = []
    for part in text.split(","):
        value, _, radius = part.partition(":")
        try:
            pairs.append((float(value), float(radius)))
        except ValueError as error:
            raise VolfrepError(
                f"The curve's part '{part.strip()}' is no pair: write values and radii in mm, "
                "such as '0:0.5, 120:1.2'."
            ) from error
    return tuple(pairs)


def default_curve(
    values: ArrayLike, radius_at_least: float, radius_at_most: float
) -> TransferCurve:
    """The straight curve from the field's smallest value to its largest.

    Args:
        values: the field's, of any shape.
        radius_at_least: mm, where the field is smallest.
        radius_at_most: mm, where it is largest; may be the smaller of the two.

    Raises:
        VolfrepError: the field is the same everywhere, or a radius makes no sense.
    """
    found = _finite("values", values).ravel()
    if not len(found):
        raise VolfrepError("The field has no points: give at least one.")
    low, high = float(found.min()), float(found.max())
    if low == high:
        raise VolfrepError(
            f"The field is {low:g} everywhere, so it cannot tell where struts are to be thick: "
            "choose another column, or give the curve's values and radii."
        )
    return TransferCurve((low, high), (radius_at_least, radius_at_most))


def _finite(name: str, values: ArrayLike) -> Floats:
    try:
        numbers = np.atleast_1d(np.asarray(values, dtype=np.float64))
    except (TypeError, ValueError) as error:
        raise VolfrepError(f"The curve's {name} must be numbers.") from error
    if not np.isfinite(numbers).all():
        raise VolfrepError(f"The curve's {name} must be finite numbers.")
    return numbers

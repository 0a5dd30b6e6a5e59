# SPDX-License-Identifier: LGPL-2.1-or-later
"""A field that a function or a formula of points gives, as samples on a grid in a box.

A function has no content that could be compared, kept in a file's key or sent to another process;
its samples have. So these are the field: a function is called once, for all of them, and never
again.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike

from ..util.content import content_of, freeze
from ..util.errors import VolfrepError
from ..util.types import Floats
from .expression import compile_expression

#: A function of (n, 3) points in mm that gives (n,) values.
PointFunction = Callable[[Floats], ArrayLike]

#: Samples along the edge of a cell: nodes of cells that begin at the box's corner lie on some.
SAMPLES_ALONG_CELL = 4
#: Of one field; with more the samples lie farther apart.
MOST_SAMPLES = 250_000


@dataclass(frozen=True)
class SampledField:
    """A scalar field, linear between samples on a grid; equal to others of the same content.

    Beyond the grid it has the value of the nearest place on it.

    Attributes:
        corner: (3,) of the first sample, mm.
        spacing: (3,) from sample to sample, mm.
        values: (nx, ny, nz) float64, two or more along each axis.
        source: what gave them, for the report.

    >>> field = SampledField([0, 0, 0], [10, 10, 10], np.arange(8.0).reshape(2, 2, 2))
    >>> field([[5, 5, 5], [0, 0, 99]]).tolist(), field.range
    ([3.5, 1.0], (0.0, 7.0))
    """

    corner: Floats = field(compare=False)
    spacing: Floats = field(compare=False)
    values: Floats = field(compare=False)
    source: str = field(default="", compare=False)
    _content: bytes = field(init=False, repr=False)

    def __post_init__(self) -> None:
        for name in ("corner", "spacing", "values"):
            object.__setattr__(self, name, freeze(getattr(self, name), np.float64))
        content = content_of(self.corner, self.spacing, self.values)
        object.__setattr__(self, "_content", content)

    @property
    def range(self) -> tuple[float, float]:
        """The smallest and the largest value; the field stays between them."""
        return float(self.values.min()), float(self.values.max())

    @property
    def bounds(self) -> Floats:
        """Corners (2, 3) of the grid, mm."""
        far = self.corner + self.spacing * (np.array(self.values.shape) - 1)
        return np.array([self.corner, far])

    def __call__(self, points: ArrayLike) -> Floats:
        """The field's values (m,) at `points` (m, 3), mm."""
        from scipy.ndimage import map_coordinates  # slow to import

        at = (np.asarray(points, np.float64).reshape(-1, 3) - self.corner) / self.spacing
        found = map_coordinates(self.values, at.T, order=1, mode="nearest")
        return np.clip(np.asarray(found, np.float64), *self.range)

    def as_json(self) -> str:
        """It in a few words."""
        size = " x ".join(str(count) for count in self.values.shape)
        return f"{self.source or 'a function'}, sampled on {size} points"


def sample_function(
    function: PointFunction | str, bounds: ArrayLike, spacing: float, name: str
) -> SampledField:
    """The field of a function, or of a formula of x, y and z, in a box.

    Args:
        function: called once, with (n, 3) float64 points of the box in mm; gives (n,) values.
        bounds: (2, 3) corners of the box, mm.
        spacing: of the samples, mm, at most; more where they would be above `MOST_SAMPLES`.
        name: of the parameter, for errors.

    Raises:
        VolfrepError: it fails, or does not give a finite number for each point.

    >>> field = sample_function("1 + x / 10", [[0, 0, 0], [10, 10, 10]], 2.5, "radius")
    >>> field.values.shape, field([[2.5, 1, 1]]).tolist()
    ((5, 5, 5), [1.25])
    """
    low, high = np.asarray(bounds, np.float64)
    sides = high - low
    while True:
        count = np.maximum(np.ceil(sides / spacing - 1e-9).astype(np.int64), 1) + 1
        if count.prod() <= MOST_SAMPLES:
            break
        spacing *= 1.1
    steps = sides / (count - 1)
    axes = [low[k] + steps[k] * np.arange(count[k]) for k in range(3)]
    points = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    if isinstance(function, str):
        found = compile_expression(function, ("x", "y", "z"))(*points.T)
        source = function
    else:
        try:
            found = np.asarray(function(points.copy()), np.float64)
        except Exception as error:
            raise VolfrepError(
                f"The function given as '{name}' failed for {len(points):,} points: "
                f"{type(error).__name__}: {error}"
            ) from error
        source = getattr(function, "__name__", "a function").replace("<lambda>", "a function")
    if found.shape != (len(points),):
        raise VolfrepError(
            f"The function given as '{name}' takes (n, 3) points and gives (n,) values, not an "
            f"array of the shape {found.shape} for {len(points):,} points."
        )
    bad = np.flatnonzero(~np.isfinite(found))
    if len(bad):
        place = ", ".join(f"{x:.4g}" for x in points[bad[0]])
        raise VolfrepError(
            f"What is given as '{name}' has no finite value at ({place}): it must have one "
            "everywhere in the part's box."
        )
    return SampledField(low, steps, found.reshape(tuple(count)), source)

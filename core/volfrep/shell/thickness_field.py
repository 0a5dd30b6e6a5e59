# SPDX-License-Identifier: LGPL-2.1-or-later
"""A skin's thickness that follows a field: between points of a grid, and nowhere too steep.

The wall is where the depth equals the thickness of that place. Depth changes by one with the way,
and the thickness by less than that everywhere: so the difference has no flat place, and the wall,
one of its level sets, cannot cross itself. Where a field is steeper than that, the thick places
reach out, and none is thinner than the field says at the grid's points.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..design.grading import Field
from ..util.types import Floats

#: The thickness changes along each axis by no more than this part of the way.
SLOPE = 0.4
#: By so much the difference of depth and thickness changes with the way, at most.
STEEPEST = 1.0 + 3.0**0.5 * SLOPE
#: Distance of the grid's points in units of the least thickness, and the most of them.
_SPACING, _MOST_POINTS = 1.5, 2e6


@dataclass(frozen=True, eq=False)
class ThicknessField:
    """Thickness at any place near a solid.

    Attributes:
        low: (3,) the grid's first point, mm.
        spacing: of its points, mm.
        values: (i, j, k) mm.
    """

    low: Floats
    spacing: float
    values: Floats

    def __call__(self, points: Floats) -> Floats:
        """(n,) mm, at (n, 3) points."""
        return self.with_slopes(points)[0]

    def with_slopes(self, points: Floats) -> tuple[Floats, Floats]:
        """(n,) mm, and (n, 3) its gradients."""
        last = np.array(self.values.shape) - 1
        place = np.clip((points - self.low) / self.spacing, 0.0, last)
        first = np.minimum(place.astype(np.int64), last - 1)
        share = place - first
        i, j, k = first.T
        corner = np.empty((len(points), 2, 2, 2))
        for a in (0, 1):
            for b in (0, 1):
                for c in (0, 1):
                    corner[:, a, b, c] = self.values[i + a, j + b, k + c]
        x, y, z = share.T
        of_x = corner[:, 1] - corner[:, 0]
        along_x = corner[:, 0] + x[:, None, None] * of_x
        of_y = along_x[:, 1] - along_x[:, 0]
        along_y = along_x[:, 0] + y[:, None] * of_y
        of_z = along_y[:, 1] - along_y[:, 0]
        slope_x = of_x[:, 0] + y[:, None] * (of_x[:, 1] - of_x[:, 0])
        slopes = np.stack(
            [
                slope_x[:, 0] + z * (slope_x[:, 1] - slope_x[:, 0]),
                of_y[:, 0] + z * (of_y[:, 1] - of_y[:, 0]),
                of_z,
            ],
            axis=1,
        )
        return along_y[:, 0] + z * of_z, slopes / self.spacing


def thickness_field(field: Field, least: float, low: Floats, high: Floats) -> ThicknessField:
    """The thickness that a field says, in a box.

    Args:
        field: thickness at places, mm.
        least: nowhere is it thinner, mm.
        low: (3,) the least corner of the solid's box, mm.
        high: (3,) the other one.
    """
    size = high - low + 4.0 * least
    spacing = max(_SPACING * least, float((size.prod() / _MOST_POINTS) ** (1.0 / 3.0)))
    count = np.ceil(size / spacing).astype(np.int64) + 1
    start = 0.5 * (low + high) - 0.5 * (count - 1) * spacing
    axes = [start[k] + spacing * np.arange(count[k]) for k in range(3)]
    places = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1)
    values = np.maximum(field(places.reshape(-1, 3)).reshape(places.shape[:3]), least)
    # The least function that is nowhere smaller and nowhere steeper: axis by axis, there and back.
    for axis in range(3):
        way = SLOPE * spacing * np.arange(count[axis])
        way = np.expand_dims(way, [other for other in range(3) if other != axis])
        ahead = np.maximum.accumulate(values + way, axis=axis) - way
        back = np.flip(np.maximum.accumulate(np.flip(values - way, axis), axis=axis), axis) + way
        values = np.maximum(ahead, back)
    return ThicknessField(start, spacing, np.asarray(values))

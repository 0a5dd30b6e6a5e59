# SPDX-License-Identifier: LGPL-2.1-or-later
"""Planes of symmetry: what mirrors lay upon each other is varied as one.

The whole part is solved under all its loads, and of a place and its images the one that needs most
governs: loads need not be symmetric.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from ..mesh.topology import pieces_of
from ..util.types import Floats, Ints

#: A point that is nearer to a plane, mm, lies in it.
_IN_PLANE = 1e-9


@dataclass(frozen=True)
class Mirrors:
    """Planes across x, y or z.

    Attributes:
        planes: the axis, 0 to 2, and where each crosses it, mm; one of an axis at most.
    """

    planes: tuple[tuple[int, float], ...]

    def folded(self, points: Floats) -> Floats:
        """(n, 3) the points (n, 3), all on one side of each plane, mm."""
        result = np.array(points, float)
        for axis, value in self.planes:
            result[:, axis] = value + np.abs(result[:, axis] - value)
        return result

    def images(self, points: Floats, values: Floats) -> tuple[Floats, Floats]:
        """The points (n, 3) and their values (n,), followed by those of their images."""
        for axis, value in self.planes:
            beside = np.abs(points[:, axis] - value) > _IN_PLANE
            other = points[beside]
            other[:, axis] = 2.0 * value - other[:, axis]
            points = np.concatenate([points, other])
            values = np.concatenate([values, values[beside]])
        return points, values

    def groups(self, points: Floats, tolerance: float) -> tuple[Ints, float]:
        """(n,) a number that a point has in common with its images, of points (n, 3).

        Args:
            points: mm.
            tolerance: so far apart, mm, points that are each other's image may lie when folded.

        Returns:
            The numbers, and the share of points some image of which is missing.
        """
        folded = self.folded(points)
        pairs = cKDTree(folded).query_pairs(tolerance, output_type="ndarray")
        count, group = pieces_of(pairs[:, 0], pairs[:, 1], len(points))
        wanted = np.ones(len(points), np.int64)
        for axis, value in self.planes:
            wanted *= np.where(np.abs(points[:, axis] - value) > tolerance, 2, 1)
        number = np.bincount(group, minlength=count)[group]
        return np.asarray(group, np.int64), float((number < wanted).mean())

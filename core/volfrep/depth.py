# SPDX-License-Identifier: LGPL-2.1-or-later
"""How deep points lie below the outer surface of a solid, and where its inner wall runs."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .distance import SurfaceIndex
from .progress import Monitor

Floats = NDArray[np.float64]

#: Points of one step between two looks at the cancel button.
POINTS_PER_STEP = 40_000


@dataclass(frozen=True, eq=False)
class Depth:
    """Distance to the outer surface, for points of a solid with a wall.

    Attributes:
        index: the outer surface.
        thickness: of the wall, mm.
        monitor: asked for a cancel between steps.
    """

    index: SurfaceIndex
    thickness: float
    monitor: Monitor

    def nearest(self, points: Floats) -> tuple[Floats, Floats]:
        """(n, 3) closest points of the outer surface and (n,) distances, not signed, mm."""
        parts = []
        for start in range(0, len(points), POINTS_PER_STEP):
            self.monitor.tick()
            parts.append(self.index.near(points[start : start + POINTS_PER_STEP]))
        if not parts:
            return np.zeros((0, 3)), np.zeros(0)
        closest, distance = (np.concatenate(values) for values in zip(*parts, strict=True))
        return closest, distance

    def planes(self, points: Floats) -> tuple[Floats, Floats]:
        """Tangent planes of the wall near points inside: a point at exact depth, and the normal."""
        closest, distance = self.nearest(points)
        normals = (closest - points) / np.maximum(distance, 1e-300)[:, None]
        return closest - self.thickness * normals, normals

    def strays(self, points: Floats) -> Floats:
        """(n,) relative errors of the wall's thickness at points of it: above 0 is too thick."""
        return np.asarray(self.nearest(points)[1] / self.thickness - 1.0)

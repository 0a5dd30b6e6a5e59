# SPDX-License-Identifier: LGPL-2.1-or-later
"""Depth: the distance of points below a solid's surface, and where the offset wall runs."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..spatial.proximity import SurfaceIndex
from ..util.progress import Monitor
from ..util.types import Bools, Floats

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

    @property
    def inset(self) -> float:
        """The wall lies so far inside the box of the solid, at least, mm."""
        return self.thickness

    @property
    def error(self) -> float:
        """By so much the depth of a point inside, about as deep as the wall, may be too large.

        See `SurfaceIndex.near`; mm.
        """
        spacing = self.index.spacing
        return 0.1 * spacing + 0.3 * spacing**2 / self.thickness

    def values(
        self, points: Floats, inside: Bools | None = None, unknown: Bools | None = None
    ) -> tuple[Floats, Floats]:
        """Thickness less depth at points (n, 3), mm, and its gradients (n, 3).

        Below 0 inside the inner wall. `inside` (n,) tells which points are inside the solid;
        None: all. Of the `unknown` ones (n,) the surface next to them tells it; None: of none.
        """
        closest, distance = self.nearest(points)
        if inside is not None and unknown is not None:
            # Nearer than the wall it does not matter.
            asked = np.flatnonzero(unknown & (distance >= 0.99 * self.thickness))
            inside = inside.copy()
            inside[asked] = self.index.below(points[asked])
        sign = np.ones(len(points)) if inside is None else np.where(inside, 1.0, -1.0)
        gradient = (closest - points) * (sign / np.maximum(distance, 1e-300))[:, None]
        return self.thickness - sign * distance, gradient

    def planes(self, points: Floats) -> tuple[Floats, Floats]:
        """Tangent planes of the wall near points inside: a point at exact depth, and the normal."""
        closest, distance = self.nearest(points)
        normals = (closest - points) / np.maximum(distance, 1e-300)[:, None]
        return closest - self.thickness * normals, normals

    def strays(self, points: Floats) -> Floats:
        """(n,) relative errors of the wall's thickness at points of it: above 0 is too thick."""
        return np.asarray(self.nearest(points)[1] / self.thickness - 1.0)

# SPDX-License-Identifier: LGPL-2.1-or-later
"""What is solid beside a surface: signed distances of sheets, skeletons and their complements."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..design.tpms import PeriodicSurface, TpmsSheet
from ..util.types import Bools, Floats
from .midsurface import Feet, Midsurface, midsurface

#: Steps to a foot point for vertices, which lie near the surface.
STEPS = 3


@dataclass(frozen=True, eq=False)
class TpmsSolid:
    """A sheet about a surface, or one of its sides; lengths in units of L.

    Attributes:
        surface: where the sheet has its middle, or the side its end.
        kind: ``sheet``, ``skeleton`` or ``complement``.
        level: half a sheet's thickness; or how far a side reaches beyond the surface.
    """

    surface: Midsurface
    kind: str
    level: float

    @staticmethod
    def of(surface: PeriodicSurface, sheet: TpmsSheet, cell_size: float) -> TpmsSolid:
        """What a wall, in mm, is in cells of a size."""
        length = 0.5 * sheet.thickness if sheet.is_sheet else sheet.offset
        return TpmsSolid(midsurface(surface), sheet.kind, length / cell_size)

    @property
    def sides(self) -> tuple[TpmsSolid, ...]:
        """What it is the common part of, each with one surface: of a sheet two, else itself."""
        if self.kind != "sheet":
            return (self,)
        return replace(self, kind="skeleton"), replace(self, kind="complement")

    def outward(self, feet: Feet) -> Floats:
        """(n,) 1 where the solid's outside lies along the feet's normals, -1 where against."""
        if self.kind == "sheet":
            return np.where(feet.distances < 0.0, -1.0, 1.0)
        return np.full(len(feet.distances), 1.0 if self.kind == "skeleton" else -1.0)

    def values_and_gradients(self, points: Floats, steps: int = STEPS) -> tuple[Floats, Floats]:
        """(n,) signed distances to the solid's surface, negative inside, and (n, 3) gradients."""
        feet = self.surface.feet(points, steps=steps)
        out = self.outward(feet)
        return out * feet.distances - self.level, out[:, None] * feet.normals

    def values(self, points: Floats) -> Floats:
        """(n,) signed distances to the solid's surface, negative inside."""
        return self.values_and_gradients(points)[0]

    def samples(self, steps: int, band: float) -> Floats:
        """(steps + 1)^3 signed distances over one period, the last ones equal to the first.

        Args:
            steps: along the period.
            band: farther than this from the solid's surface only the sign is right.
        """
        axis = np.arange(steps) / steps
        points = np.stack(np.meshgrid(axis, axis, axis, indexing="ij"), axis=-1).reshape(-1, 3)
        reach = abs(self.level) + band + self.surface.spacing
        near, away = self.surface.near(points, reach)
        found = np.isfinite(away)
        values = np.where(self.is_inside(points), -2.0, 2.0) * band
        feet = self.surface.feet(points[found], near[found], STEPS)
        values[found] = self.outward(feet) * feet.distances - self.level
        grid = values.reshape((steps,) * 3)
        return np.pad(grid, (0, 1), mode="wrap")

    def is_inside(self, points: Floats) -> Bools:
        """(n,) whether points far from the surface are in the solid: their side tells."""
        if self.kind == "sheet":
            return np.zeros(len(points), bool)
        negative: Bools = self.surface.values(points) < 0.0
        return negative if self.kind == "skeleton" else ~negative

    def levels(self, points: Floats) -> Floats:
        """(n,) the levels from which on points are solid."""
        feet = self.surface.feet(points)
        result: Floats = self.outward(feet) * feet.distances
        return result

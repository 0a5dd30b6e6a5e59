# SPDX-License-Identifier: LGPL-2.1-or-later
"""The regular grid that cells lie in."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..util.types import Floats


@dataclass(frozen=True, eq=False)
class CellGrid:
    """A regular grid of cubic cells.

    Attributes:
        origin: (3,) float64, lowest corner, mm.
        cell_size: L, mm.
        shape: cells along x, y, z (of lattice space, where that is not the part's own).
        periodic: axes along which the last cell is followed by the first one.
    """

    origin: Floats
    cell_size: float
    shape: tuple[int, int, int]
    periodic: tuple[bool, bool, bool] = (False, False, False)

    @property
    def cells(self) -> int:
        """How many cells the grid has."""
        return self.shape[0] * self.shape[1] * self.shape[2]

    def centres(self, axis: int) -> Floats:
        """Coordinates of the cells' centres along an axis, mm."""
        steps = np.arange(self.shape[axis]) + 0.5
        return np.asarray(self.origin[axis] + self.cell_size * steps, np.float64)

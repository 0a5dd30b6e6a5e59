# SPDX-License-Identifier: LGPL-2.1-or-later
"""Rigid motions that take equal points to equal places, to the last bit."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ..util.types import Floats


@dataclass(frozen=True, eq=False)
class Motion:
    """A rigid motion of lattice space; equal points go to equal places, whoever moves them.

    It takes one number at a time: sums of a library may come in another order for other shapes.

    Attributes:
        shift: (3,) that is added at last, mm.
        frame: (3, 3) the directions that x, y, z turn into, as columns; None: they are not turned.
        centre: (3,) where the origin is turned to, mm.
    """

    shift: Floats
    frame: Floats | None = None
    centre: Floats = field(default_factory=lambda: np.zeros(3))

    def __call__(self, points: Floats) -> Floats:
        """Where (..., 3) points go, mm."""
        if self.frame is None:
            return points + self.shift
        return (self.turned(points) + self.centre) + self.shift

    def turned(self, directions: Floats) -> Floats:
        """What becomes of (..., 3) directions."""
        if self.frame is None:
            return directions
        return self._sums(directions, self.frame)

    def back(self, points: Floats) -> Floats:
        """Where (..., 3) points came from, mm."""
        if self.frame is None:
            return points - self.shift
        return self._sums((points - self.shift) - self.centre, self.frame.T)

    @staticmethod
    def _sums(vectors: Floats, rows: Floats) -> Floats:
        x, y, z = (vectors[..., k] for k in range(3))
        return np.stack([x * a + y * b + z * c for a, b, c in rows], axis=-1)

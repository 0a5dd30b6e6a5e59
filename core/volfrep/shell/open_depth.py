# SPDX-License-Identifier: LGPL-2.1-or-later
"""The depth of a skin that has open faces.

Such a skin's cavity is all that is deep enough below the other faces. It reaches a little beyond
the open ones, so that nothing of it coincides with them: cut at the part's surface, it opens there.

By half a thickness, because nothing outside the part is then in the cavity that is not in front of
an open face.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..mesh.triangle_mesh import TriangleMesh
from ..spatial.proximity import SurfaceIndex, index_surface
from ..spatial.rays import inside_points
from ..util.progress import Monitor
from ..util.types import Bools, Floats
from .depth import Depth

#: How far the cavity reaches beyond the open faces, in thicknesses of the skin.
BEYOND = 0.5


@dataclass(frozen=True, eq=False)
class OpenDepth(Depth):
    """Distance to the faces with a skin, and to where the cavity ends beyond the open ones.

    Outside the solid the cavity ends at a distance of `reach` to the surface: of the two values,
    the larger one holds.

    Attributes:
        solid: the part.
        surface: all of its surface.
        reach: mm; less than the thickness, so that no point outside is in the cavity that is not
            in front of an open face.
    """

    solid: TriangleMesh
    surface: SurfaceIndex
    reach: float

    @property
    def error(self) -> float:
        """Also points inside may now be nearest to a border that has no samples around it."""
        return self.surface.spacing

    @property
    def inset(self) -> float:
        """Beyond open faces the cavity ends outside the solid's box."""
        return -self.reach

    def values(
        self, points: Floats, inside: Bools | None = None, unknown: Bools | None = None
    ) -> tuple[Floats, Floats]:
        """As `Depth.values`; which points are inside is looked up in any case."""
        value, gradient = super().values(points)
        beyond, outward = self._beyond(points)
        ends = beyond > value
        return np.where(ends, beyond, value), np.where(ends[:, None], outward, gradient)

    def planes(self, points: Floats) -> tuple[Floats, Floats]:
        """As `Depth.planes`; beyond the open faces, of where the cavity ends."""
        anchor, normal = super().planes(points)
        skin = self.thickness - self.nearest(points)[1]
        beyond, outward = self._beyond(points)
        ends = (beyond > skin)[:, None]
        end = points - beyond[:, None] * outward
        return np.where(ends, end, anchor), np.where(ends, outward, normal)

    def strays(self, points: Floats) -> Floats:
        """As `Depth.strays`; what lies outside the solid is cut off and has no error."""
        return np.where(self._inside(points), super().strays(points), 0.0)

    def _beyond(self, points: Floats) -> tuple[Floats, Floats]:
        """How far points are beyond the cavity's end, below 0 before it; directions outward."""
        closest, distance = self.surface.near(points)
        sign = np.where(self._inside(points), -1.0, 1.0)
        outward = (points - closest) * (sign / np.maximum(distance, 1e-300))[:, None]
        return sign * distance - self.reach, outward

    def _inside(self, points: Floats) -> Bools:
        return inside_points(self.solid, points, self.monitor)


def open_depth(
    solid: TriangleMesh, is_open: Bools, thickness: float, spacing: float, monitor: Monitor
) -> OpenDepth:
    """The depth below the faces of a solid that are not open.

    Args:
        solid: checked closed solid, mm.
        is_open: (m,) which of its triangles have no skin.
        thickness: of the skin, mm.
        spacing: of the samples on the surface, mm.
        monitor: for progress and cancel.
    """
    surface = monitor.call(lambda: index_surface(solid, spacing))
    return OpenDepth(
        surface.without(is_open), thickness, monitor, solid, surface, BEYOND * thickness
    )

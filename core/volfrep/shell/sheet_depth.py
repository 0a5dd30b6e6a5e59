# SPDX-License-Identifier: LGPL-2.1-or-later
"""The depth of a skin that is not alike everywhere.

Below each group of faces the skin has its thickness: the cavity is what is farther from every
group than that group's length. So the wall is a level set of one function that changes no faster
than one goes, the largest of (length - distance): it cannot cross itself, and where a thick skin
ends beside a thin one it is rounded off by its own thickness, as a ball that rolls along the edge
of the thick faces leaves it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..design.skins.own_faces import Thicknesses
from ..mesh.triangle_mesh import TriangleMesh
from ..spatial.proximity import SurfaceIndex, index_surface
from ..spatial.rays import inside_points
from ..util.progress import Monitor
from ..util.types import Bools, Floats
from .depth import Depth
from .open_depth import BEYOND, OpenDepth


@dataclass(frozen=True, eq=False)
class SheetDepth(Depth):
    """Distance to groups of faces, each with the thickness of its skin; `index` is the thinnest's.

    Attributes:
        thinnest: the depth below the faces of the thinnest skin, and where the cavity ends beyond
            open faces.
        others: the other groups of faces and their thicknesses, mm.
        solid: the part, where it has open faces; else None.
    """

    thinnest: Depth
    others: tuple[tuple[SurfaceIndex, float], ...]
    solid: TriangleMesh | None

    @property
    def error(self) -> float:
        """Points inside may be nearest to a group's border, which has few samples around it."""
        return self.index.spacing

    @property
    def inset(self) -> float:
        """As of the thinnest."""
        return self.thinnest.inset

    def values(
        self, points: Floats, inside: Bools | None = None, unknown: Bools | None = None
    ) -> tuple[Floats, Floats]:
        """As `Depth.values`: the largest of all groups' inside, the least outside."""
        if self.solid is not None:
            inside = None  # the thinnest group looks it up, for where the cavity ends
        value, gradient = self.thinnest.values(points, inside, unknown)
        sign = np.ones(len(points)) if inside is None else np.where(inside, 1.0, -1.0)
        for index, thickness in self.others:
            closest, distance = Depth(index, thickness, self.monitor).nearest(points)
            here = thickness - sign * distance
            nearer = np.where(sign > 0.0, here > value, here < value)
            way = (closest - points) * (sign / np.maximum(distance, 1e-300))[:, None]
            value = np.where(nearer, here, value)
            gradient = np.where(nearer[:, None], way, gradient)
        return value, gradient

    def planes(self, points: Floats) -> tuple[Floats, Floats]:
        """As `Depth.planes`, of the group that the wall belongs to there."""
        value, normals = self.values(points)
        return points - value[:, None] * normals, normals

    def strays(self, points: Floats) -> Floats:
        """As `Depth.strays`, in units of the thinnest skin."""
        result = np.asarray(-self.values(points)[0] / self.thickness)
        if self.solid is not None:
            result[~inside_points(self.solid, points, self.monitor)] = 0.0
        return result


def thinnest_of(thicknesses: Thicknesses, usual: float) -> float:
    """The thinnest of a skin's thicknesses, mm; `usual` is that of all other faces."""
    present = [usual] if thicknesses.usual.any() else []
    return min(*present, *(length for _, length in thicknesses.others), np.inf)


def sheet_depth(
    solid: TriangleMesh, thicknesses: Thicknesses, usual: float, spacing: float, monitor: Monitor
) -> SheetDepth:
    """The depth below the faces of a solid whose skin is not alike everywhere.

    Args:
        solid: checked closed solid, mm.
        thicknesses: of its skin.
        usual: thickness of the skin below all other faces, mm.
        spacing: of the samples on the surface, mm.
        monitor: for progress and cancel.
    """
    surface = monitor.call(lambda: index_surface(solid, spacing))
    groups = [(thicknesses.usual, usual)] if thicknesses.usual.any() else []
    groups = sorted([*groups, *thicknesses.others], key=lambda group: group[1])
    sheets = [
        (surface if faces.all() else surface.without(~faces), length) for faces, length in groups
    ]
    index, thinnest = sheets[0]
    first = Depth(index, thinnest, monitor)
    is_open = thicknesses.is_open
    if is_open is not None:
        first = OpenDepth(index, thinnest, monitor, solid, surface, BEYOND * thinnest)
    part = None if is_open is None else solid
    return SheetDepth(index, thinnest, monitor, first, tuple(sheets[1:]), part)

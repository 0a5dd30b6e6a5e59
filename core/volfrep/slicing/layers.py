# SPDX-License-Identifier: LGPL-2.1-or-later
"""A part in layers: the sections of its lattice and of its walls, put together plane by plane."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeVar

import numpy as np
from numpy.typing import NDArray

from ..grid.strut_graph import Wireframe, select_struts
from ..mesh.triangle_mesh import TriangleMesh
from ..util.manifold import manifold_library
from ..util.progress import Monitor
from ..util.threads import threads
from ..util.types import Floats
from .plane_section import plane_cutter
from .raster import PixelGrid, pixel_shares
from .sections import Bodies, bodies_of, section_polygons

if TYPE_CHECKING:
    import manifold3d

T = TypeVar("T")

#: Layers whose struts are at hand at a time.
_AT_A_TIME = 64


@dataclass(frozen=True, eq=False)
class SolidParts:
    """What a part consists of before any of it is meshed: (struts within clip) and skin; mm.

    Attributes:
        struts_between: gives the struts of the lattice that reach between two z, and perhaps more.
        clip: closed mesh; what of the lattice lies outside it is cut off. None: nothing is.
        skin: closed mesh that the lattice is joined to; None for none.
        bounds: (2, 3) box of the whole.
    """

    struts_between: Callable[[float, float], Wireframe]
    clip: TriangleMesh | None
    skin: TriangleMesh | None
    bounds: Floats


@dataclass(frozen=True, eq=False)
class Section:
    """What a plane cuts of a part, as outlines that hold it; mm.

    Attributes:
        struts: (k, c, 2) polygons, counter-clockwise; they overlap.
        joints: (l, c2, 2) polygons, the same.
        clip: polygons (c, 2), holes clockwise, that struts and joints count in; None: everywhere.
        skin: polygons of the skin, the same way.
    """

    struts: Floats
    joints: Floats
    clip: list[Floats] | None
    skin: list[Floats]

    def pixels(self, grid: PixelGrid) -> tuple[NDArray[np.uint8], float]:
        """What share of each pixel lies in it, as `pixel_shares`, and their area, mm2."""
        groups = [[self.struts, self.joints], [one[None] for one in self.skin]]
        if self.clip is None:
            return pixel_shares(groups, lambda within: within[0] | within[1], grid)
        groups.append([one[None] for one in self.clip])
        return pixel_shares(groups, lambda within: within[0] & within[2] | within[1], grid)

    def outline(self) -> manifold3d.CrossSection:
        """The union as the library's own polygons, without overlaps."""
        library = manifold_library("Outlines of layers")
        rule = library.FillRule.NonZero
        lattice = library.CrossSection([*self.struts, *self.joints], rule)
        if self.clip is not None:
            lattice = lattice ^ library.CrossSection(self.clip, rule)
        # Holes turn the other way, so that their winding number is 0.
        return lattice + library.CrossSection(self.skin, rule)


def layer_heights(bounds: Floats, layer: float) -> Floats:
    """(n,) z of the middles of the layers of a box: at least one, none beyond its top, mm."""
    low, high = bounds[:, 2]
    middles: Floats = low + layer * (np.arange(max(round((high - low) / layer), 1)) + 0.5)
    return middles


def each_section(
    part: SolidParts,
    heights: Floats,
    error: float,
    use: Callable[[Section, float], T],
    monitor: Monitor,
) -> Iterator[T]:
    """What becomes of the sections at some heights, one after the other, on all cores.

    Memory holds the struts of a few layers and the walls, whatever the number of layers.

    Args:
        part: what is cut.
        heights: (n,) ascending, mm.
        error: largest distance of the outlines of struts from the true ones, mm.
        use: of a section and its height; runs on several threads.
        monitor: for progress and cancel.

    Raises:
        VolfrepError: a wall is no solid that can be cut.
    """
    clip = None if part.clip is None else plane_cutter(part.clip)
    skin = None if part.skin is None else plane_cutter(part.skin)

    def cut(bodies: Bodies, z: float) -> T:
        return use(
            Section(
                *section_polygons(bodies, z, error),
                None if clip is None else clip(z),
                [] if skin is None else skin(z),
            ),
            z,
        )

    with ThreadPoolExecutor(threads()) as pool:
        for first in range(0, len(heights), _AT_A_TIME):
            some = heights[first : first + _AT_A_TIME]
            bodies = bodies_of(part.struts_between(some[0], some[-1]))
            running = [pool.submit(cut, bodies, float(z)) for z in some]
            try:
                for number, job in enumerate(running, first + 1):
                    yield job.result()
                    monitor.tick(number / len(heights))
            finally:
                for job in running:
                    job.cancel()


def whole(lattice: Wireframe) -> Callable[[float, float], Wireframe]:
    """The struts of a lattice that is at hand as a whole, by height."""
    ends = lattice.nodes[lattice.struts][:, :, 2]
    reach = lattice.joint_radii[lattice.struts]
    low, high = (ends - reach).min(axis=1), (ends + reach).max(axis=1)

    def between(bottom: float, top: float) -> Wireframe:
        return select_struts(lattice, (low < top) & (high > bottom))

    return between

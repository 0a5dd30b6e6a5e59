# SPDX-License-Identifier: LGPL-2.1-or-later
"""What PrusaSlicer prints of a part with modifiers, layer by layer: walls, solid and sparse infill.

What no layer covers above or below is solid in its layer, widened into the infill, and in the
layers beneath or on it as far as infill of the same band is there (its `LayerRegion` and
`PrintObject::discover_horizontal_shells`, 2.5).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING

import numpy as np

from ..design.banded_infill import BandedInfill
from ..mesh.booleans import as_manifold
from ..mesh.triangle_mesh import TriangleMesh
from ..util.progress import Monitor
from ..util.types import Floats

if TYPE_CHECKING:
    from manifold3d import CrossSection, Manifold

#: Layers that are looked at, at most; evenly chosen.
MOST_LAYERS = 240
#: Infill reaches so far into the walls, in lines: the default of PrusaSlicer and its profiles.
OVERLAP = 0.25
#: What lies open is widened within the infill, mm, for its lines to be held.
MARGIN = 3.0
#: What lies open is widened in the layers beneath or on it, in lines.
GROWN = 1.05
#: Solid infill there that is narrower than twice so many lines is left out.
NARROW = 0.31
#: Lines that are shorter across than this share of their spacing are left out (its `FillGyroid`).
PIECE = 0.2
#: What is open by less than this share of a line is overlooked.
OVERLOOKED = 0.1
#: Outlines are followed as closely, mm: an offset goes wrong where slivers of rounding are in it.
CLOSE = 1e-3


@dataclass(frozen=True, eq=False)
class Printed:
    """What a slicer prints.

    Attributes:
        solid: volume of walls and solid layers, mm3.
        sparse: (k + 1,) volume of the sparse infill in each band, mm3.
        laid: (k + 1,) of it, where a line has room, mm3.
        outlines: k + 1 arrays, (n, 2): lengths along which lines end, mm, of every piece of a
            layer; and the same times the sine of twice their angle with the axes.
        layer: height of these layers, mm.
    """

    solid: float
    sparse: Floats
    laid: Floats
    outlines: tuple[Floats, ...]
    layer: float


def add_up(
    solid: TriangleMesh, wanted: BandedInfill, pieces: list[Manifold], monitor: Monitor
) -> Printed:
    """What is printed of a part with k bands beside its own.

    Args:
        solid: the part, mm, as it stands on the plate.
        wanted: walls, solid layers and lines.
        pieces: each within those before, and counting in their stead.
        monitor: for progress and cancel.
    """
    low, high = solid.bounds[:, 2]
    count = max(1, round((high - low) / wanted.layer))
    layers = _Layers(solid, wanted, pieces, count)
    looked_at = min(count, MOST_LAYERS)
    depth = (high - low) / looked_at
    solid_volume, sparse_volume, laid = 0.0, np.zeros(len(pieces) + 1), np.zeros(len(pieces) + 1)
    outlines: list[list[Floats]] = [[] for _ in laid]
    for number in range(looked_at):
        monitor.tick(number / looked_at)
        layer = int((number + 0.5) * count / looked_at)
        walls = layers.whole(layer) - layers.inset(layer, 0.0)
        solid_volume += depth * float(walls.area())
        for band in range(len(pieces) + 1):
            fill = layers.fill(layer, band)
            if fill.is_empty():
                continue
            sparse = fill - layers.solid(layer, band)
            solid_volume += depth * float(fill.area() - sparse.area())
            sparse_volume[band] += depth * sparse.area()
            reached = _open_section(
                _simple(sparse).offset(-0.5 * wanted.spacing), PIECE * wanted.spacing
            )
            outlines[band] += [_outline(one) for one in reached.decompose() if not one.is_empty()]
            laid[band] += depth * (reached.area() + 0.5 * wanted.spacing * _outline(reached)[0])
    arrays = tuple(np.array(rows).reshape(-1, 2) for rows in outlines)
    return Printed(float(solid_volume), sparse_volume, laid, arrays, float(depth))


class _Layers:
    """Sections of a part's layers, found when they are asked for."""

    def __init__(
        self, solid: TriangleMesh, wanted: BandedInfill, pieces: list[Manifold], count: int
    ) -> None:
        part, (low, high) = as_manifold(solid), solid.bounds[:, 2]
        line = wanted.line_width
        stacks = {1: wanted.top_layers, -1: wanted.bottom_layers}

        def height(layer: int) -> float:
            return float(low + (layer + 0.5) * (high - low) / count)

        @cache
        def whole(layer: int) -> CrossSection:
            return _simple(part.slice(height(layer)))

        @cache
        def inset(layer: int, overlap: float) -> CrossSection:
            if not wanted.walls:
                return whole(layer)
            return whole(layer).offset(overlap - wanted.wall_thickness)

        @cache
        def beyond(layer: int, band: int) -> CrossSection:
            return pieces[band].slice(height(layer))

        def own(section: CrossSection, layer: int, band: int) -> CrossSection:
            if band > 0:
                section = section ^ beyond(layer, band - 1)
            return section - beyond(layer, band) if band < len(pieces) else section

        @cache
        def fill(layer: int, band: int) -> CrossSection:
            return own(inset(layer, OVERLAP * wanted.spacing), layer, band)

        @cache
        def bare(layer: int, way: int) -> CrossSection:
            if not 0 <= layer + way < count:
                return whole(layer)
            return _open_section(whole(layer) - whole(layer + way), OVERLOOKED * line)

        @cache
        def widened(layer: int, band: int, way: int) -> CrossSection:
            room = fill(layer, band)
            return _simple(bare(layer, way) ^ room).offset(MARGIN) ^ room

        @cache
        def outer(layer: int, band: int) -> CrossSection:
            room = fill(layer, band)
            result = room - room
            for way, stack in stacks.items():
                if stack:
                    result = result + widened(layer, band, way)
            return result

        @cache
        def around(layer: int) -> CrossSection:
            bands, kept = range(len(pieces) + 1), inset(layer, OVERLAP * wanted.spacing)
            for way, stack in stacks.items():
                for other in range(layer + way, layer + way * stack, way):
                    if not 0 <= other < count:
                        break
                    kept = kept ^ inset(other, OVERLAP * wanted.spacing)
                    kept = kept - _simple(bare(other, way)).offset(GROWN * wanted.spacing)
                    for band in bands:
                        kept = kept - widened(other, band, way).offset(GROWN * wanted.spacing)
            return kept

        def covered(layer: int, band: int) -> CrossSection:
            room = fill(layer, band) - outer(layer, band)
            return fill(layer, band) - room + _open_section(room - around(layer), NARROW * line)

        self.whole, self.inset, self.fill, self.solid = whole, inset, fill, covered


def _simple(section: CrossSection) -> CrossSection:
    return section.simplify(CLOSE)


def _open_section(section: CrossSection, reach: float) -> CrossSection:
    """What a circle of a radius reaches within a section."""
    return _simple(section).offset(-reach).offset(reach)


def _outline(section: CrossSection) -> Floats:
    """(2,) length of the outlines, mm, and the same times the sine of twice their angle."""
    sides = [np.roll(loop, -1, axis=0) - loop for loop in section.to_polygons()]
    along = np.concatenate([*sides, np.zeros((0, 2))])
    length = np.linalg.norm(along, axis=1)
    slanted = 2.0 * np.abs(along.prod(axis=1)) / np.maximum(length, 1e-12)
    return np.array([length.sum(), slanted.sum()])

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Radii of volumes of cubic cells of struts, read off a table of the distances of many points."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np

from ...design.spec import LatticeSpec
from ...design.target import volume_out_of_reach
from ...lattice.strut_volume import FINE, ROUGH, VolumeByRadius
from ...util.errors import VolfrepError
from ...util.search import Rising
from ..target_search import WantedVolume

#: The first guess is this near, relative; a radius is sought up to so much above it.
_ROUGHLY = 1.12
#: Fewer points than these tell a first guess so badly that the radius is sought farther above it.
_SURE = 200
#: A radius with fillets is found when its volume is this near, relative.
_CLOSE = 1e-5

#: A table as exact as 2^k points, up to a radius.
_Table = Callable[[int, float], VolumeByRadius]


class RadiusSearch:
    """Radii of volumes, within what can be made."""

    def __init__(self, spec: LatticeSpec, wanted: WantedVolume, table: _Table) -> None:
        self._spec, self.wanted = spec, wanted
        from ..rough_radius import radius_range  # slow to load, and most jobs have no target

        self._low, self._high = radius_range(spec)
        self._table = table(ROUGH, self._high)
        most = self._volume(self._high)
        if most <= 0.0:
            raise VolfrepError(
                f"No strut of cells '{spec.unit_cell().name}' of {spec.cell_size:g} mm reaches "
                f"the {wanted.domain:.4g} mm3 that there are for the lattice, however thick, so "
                f"that no {wanted.target.called} can be met: reduce the cell size or the skin, or "
                "move the origin."
            )
        if wanted.lattice <= most:
            found = self._radius(wanted.lattice)
            points = self._table.points_in(wanted.lattice)
            slack = _ROUGHLY if points >= _SURE else 1.0 + 3.0 / math.sqrt(points + 1.0)
            self._high = min(self._high, slack * found)
            self._table = table(FINE, self._high)
        # Of the thinnest struts the rough table has hardly a point.
        least = self._volume(self._low)
        if not least <= wanted.lattice <= most:
            cells = f"cells '{spec.unit_cell().name}' of {spec.cell_size:g} mm"
            raise volume_out_of_reach(
                wanted.target, cells, spec.density, wanted.domain, wanted.skin, (least, most)
            )

    def specification(self, volume: float) -> LatticeSpec:
        """With the radius of a volume of the lattice, mm3."""
        return replace(self._spec, strut_radius=self._radius(volume))

    def _radius(self, volume: float) -> float:
        low, high = self._low, self._high
        if not self._spec.fillet:
            return float(np.clip(self._table.radius_of(volume), low, high))
        known = Rising(self._volume, low, high, close=_CLOSE)
        least, most = known.span
        return known.level_of(min(max(volume, least), most))

    def _volume(self, radius: float) -> float:
        """The lattice's, with its fillets as the endless lattice has them."""
        volume = self._table.at(radius)
        if not self._spec.fillet:
            return volume
        from ...mechanics.density import relative_density

        cell, size = self._spec.unit_cell(), self._spec.cell_size
        plain = relative_density(cell, radius / size).value
        return (
            volume * relative_density(cell, radius / size, self._spec.fillet / size).value / plain
        )

# SPDX-License-Identifier: LGPL-2.1-or-later
"""From the volume that walls are to have to their thickness, by the levels of many points."""

from __future__ import annotations

import numpy as np

from ...design.spec import LatticeSpec
from ...design.target import Target
from ...lattice.strut_volume import VolumeByRadius
from ...util.errors import VolfrepError
from ...util.types import Floats


def level_table(levels: Floats, weights: Floats) -> VolumeByRadius:
    """Volumes of walls over the level up to which points are solid.

    Args:
        levels: (n,) from which on points are solid, mm.
        weights: (n,) the volume that each stands for, mm3.
    """
    order = np.argsort(levels)
    steps = np.cumsum(weights[order])
    return VolumeByRadius(levels[order], steps - 0.5 * weights[order])


def with_volume(
    spec: LatticeSpec, target: Target, table: VolumeByRadius, wanted: float, domain: float
) -> LatticeSpec:
    """The specification with walls of a volume in mm3."""
    low = 0.0 if spec.wall.is_sheet else 0.02 * domain
    if not low < wanted < 0.98 * domain:
        share = wanted / domain
        raise VolfrepError(
            f"No {spec.wall.called} meets the target of {target.called}: the walls would fill "
            f"{100 * share:.3g} % of their room; choose one for which they fill 2 to 98 %."
        )
    level = table.radius_of(wanted)
    return spec.with_thickness(2.0 * level if spec.wall.is_sheet else level)

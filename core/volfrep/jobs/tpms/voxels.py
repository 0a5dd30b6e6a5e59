# SPDX-License-Identifier: LGPL-2.1-or-later
"""The voxels of a wall's cell, and its relative density."""

from __future__ import annotations

import numpy as np

from ...mechanics.elements import PARTS, part_centres
from ...mechanics.voxels import Voxels, voxels_by_distance
from ...spatial.even_points import even_points
from ...tpms.solid import STEPS, TpmsSolid
from ...util.errors import VolfrepError
from ...util.search import Rising

#: Half of a unit cube's diagonal.
_HALF_DIAGONAL = 0.5 * np.sqrt(3.0)
#: Points, as a power of 2, whose distances from the surface tell densities roughly; of a finer
#: density, voxels along L, and of the error, half as many.
_POINTS = 14
_FINE = 48
#: A density is found when it is this near, relative.
_CLOSE = 2e-4
#: Densities that walls can be asked for.
_LEAST, _MOST = 0.02, 0.98


def cut_into_voxels(
    solid: TpmsSolid, along: int, *, octant: bool, density: float | None = None
) -> Voxels:
    """Cut a wall into voxels.

    Args:
        solid: the wall, in units of L.
        along: voxels along L, even where only an octant is wanted.
        octant: the octant [0, 1/2]^3 only (of a wall that is its own mirror image).
        density: the relative density that they are filled to; None: as it comes.
    """
    step = 1.0 / along
    count = along // 2 if octant else along
    index = np.stack(np.meshgrid(*[np.arange(count)] * 3, indexing="ij"), -1).reshape(-1, 3)
    centres = (index + 0.5) * step
    half = _HALF_DIAGONAL * step
    near, away = solid.surface.near(centres, abs(solid.level) + half + solid.surface.spacing)
    found = np.flatnonzero(np.isfinite(away))
    feet = solid.surface.feet(centres[found], near[found], STEPS)
    samples = solid.outward(feet) * feet.distances - solid.level
    full = solid.is_inside(centres)
    full[found] = samples < -half
    is_cut = np.abs(samples) <= half
    cut = found[is_cut]
    inner = part_centres()
    points = (index[cut][:, None] + inner).reshape(-1, 3) * step
    # The feet of parts are beside those of their voxels' middles.
    feet = solid.surface.feet(points, np.repeat(feet.points[is_cut], len(inner), axis=0), steps=1)
    distance = (solid.outward(feet) * feet.distances - solid.level).reshape(len(cut), len(inner))
    return voxels_by_distance(
        index, full, cut, distance * (along * PARTS), along, octant=octant, density=density
    )


def tpms_density(solid: TpmsSolid, *, octant: bool) -> tuple[float, float]:
    """The relative density of a wall, and by how much it may be off."""
    fine, coarse = (
        cut_into_voxels(solid, along, octant=octant).relative_density
        for along in (_FINE, _FINE // 2)
    )
    return fine, abs(fine - coarse) / 2.0 + _CLOSE * fine


def of_density(solid: TpmsSolid, density: float, *, octant: bool) -> TpmsSolid:
    """The wall of a relative density, with whatever level it needs.

    Raises:
        VolfrepError: no level gives it.
    """
    if not _LEAST <= density <= _MOST:
        raise VolfrepError(
            f"Walls can have relative densities from {_LEAST:g} to {_MOST:g}, not {density:.4g}."
        )
    levels = np.sort(solid.levels(even_points(3, _POINTS)))
    shares = (np.arange(len(levels)) + 0.5) / len(levels)
    level = float(np.interp(density, shares, levels))
    # How much there is to gain: from the points within a tenth of what is wanted.
    some = np.clip([0.9 * density, min(1.1 * density, 1.0)], shares[0], shares[-1])
    rate = float(np.diff(some)[0] / np.diff(np.interp(some, shares, levels))[0])
    found = Rising(
        lambda at: tpms_density(TpmsSolid(solid.surface, solid.kind, at), octant=octant)[0],
        float(levels[0]), float(levels[-1]), close=_CLOSE,
        start=level, slope=rate / density, even=True,
    )  # fmt: skip
    return TpmsSolid(solid.surface, solid.kind, found.level_of(density))

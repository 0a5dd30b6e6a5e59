# SPDX-License-Identifier: LGPL-2.1-or-later
"""The strut radius of a stiffness, and the stiffness of a radius.

Library cells are read off the catalogue, whose solid has a Poisson's ratio of 0.3; other cells, and
all with fillets, are homogenised: on coarse grids over a few radii, and finely near the one sought.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache

import numpy as np

from ..design.cells import UnitCell
from ..design.target import Target, modulus_out_of_reach
from ..mechanics.catalogue import CatalogueCell, known_cell
from ..mechanics.endless import endless_cell
from ..mechanics.homogenise import grid_sizes, homogenise
from ..mechanics.tensor import modulus_along
from ..util.errors import VolfrepError
from ..util.search import Rising, make_until_met
from ..util.types import Floats

#: r / L between which a cell that is not in the catalogue is looked at, and at how many radii.
LEAST, MOST = 0.02, 0.2
RADII = 7
#: Voxels along a radius of the coarse grids, and along L at least and, without mirrors and with, at
#: most.
_VOXELS, _FEWEST, _FINEST = 2.5, 20, (32, 64)
#: How near a modulus has to come that is read off a curve.
_EXACT = 1e-10
#: How near the modulus of a homogenised cell has to come, and in how many steps.
_CLOSE = 4e-3
_STEPS = 4
#: The fine grids of a cell with mirrors have this share of the voxels along L that its properties
#: are computed by: moduli within 1 % of those, in a quarter of the time.
_SHARE = 2.0 / 3.0


def modulus(cell: UnitCell, ratio: float, target: Target, fillet: float = 0.0) -> float:
    """Young's modulus along the target's direction at an r / L; fillet in units of L.

    Raises:
        VolfrepError: the ratio lies outside the catalogue, or the cell carries nothing.
    """
    known = known_cell(cell) if not fillet else None
    tensor = known.tensor(ratio) if known else _tensor(cell, ratio, fillet)
    return modulus_along(tensor, target)


def ratio_of_stiffness(
    cell: UnitCell, target: Target, fillet: float = 0.0, *, rough: bool = False
) -> float:
    """The r / L at which the endless lattice has the target's stiffness.

    Args:
        cell: the unit cell.
        target: a stiffness.
        fillet: in units of L.
        rough: whether the coarse grids will do for a cell that is not in the catalogue.

    Raises:
        VolfrepError: no radius does; the text says what can be had.
    """
    known = known_cell(cell) if not fillet else None
    if known:
        ratios, moduli = known.ratios, _catalogue_moduli(known, target)
    else:
        ratios, moduli = coarse_ratios(fillet), _coarse_moduli(cell, target, fillet)
    about = Rising(moduli, float(ratios[0]), float(ratios[-1]), close=_EXACT)
    least, most = about.span
    if not least <= target.value <= most:
        raise modulus_out_of_reach(
            f"strut radius gives the cell '{cell.name}'", target, least, most
        )

    def ratio_of(value: float) -> float:
        # Without the digits that hang on the solver's number of threads.
        return float(f"{about.level_of(min(max(value, least), most)):.6g}")

    if known or rough:
        return ratio_of(target.value)

    def missing(ratio: float) -> float:
        return target.value - modulus(cell, ratio, target, fillet)

    enough = _CLOSE * target.value
    # By how much the fine grids differ from the coarse hardly hangs on the radius.
    return make_until_met(ratio_of, missing, target.value, enough=enough, times=_STEPS)


def coarse_ratios(fillet: float) -> Floats:
    """(n,) r / L at which a cell that is not in the catalogue is looked at."""
    most = min(MOST, 0.98 * (np.sqrt(0.75 - fillet) - 0.5)) if fillet < 0.5 else 0.0
    if most <= LEAST:
        raise VolfrepError(f"A fillet of {fillet:.4g} L is too large for a cell: reduce it.")
    ratios: Floats = np.geomspace(LEAST, most, RADII)
    return ratios


def _catalogue_moduli(known: CatalogueCell, target: Target) -> Callable[[float], float]:
    """The modulus over r / L, by the catalogue."""
    first, last = float(known.ratios[0]), float(known.ratios[-1])
    return lambda ratio: modulus_along(known.tensor(min(max(ratio, first), last)), target)


def _coarse_moduli(cell: UnitCell, target: Target, fillet: float) -> Callable[[float], float]:
    """The modulus over r / L, by the coarse grids."""
    from scipy.interpolate import CubicSpline  # slow to load, and every job loads this module

    ratios = coarse_ratios(fillet)
    found = [modulus_along(_tensor(cell, float(ratio), fillet, True), target) for ratio in ratios]
    spline = CubicSpline(np.log(ratios), np.log(found), bc_type="natural")
    return lambda ratio: float(np.exp(spline(np.log(ratio))))


@lru_cache(maxsize=64)
def _tensor(cell: UnitCell, ratio: float, fillet: float, coarse: bool = False) -> Floats:
    """(6, 6) stiffness of a cell over the solid's E; kept for a few cells."""
    along = None
    if coarse:
        along = _even(np.clip(_VOXELS / ratio, _FEWEST, _FINEST[cell.is_mirror_symmetric]))
    elif cell.is_mirror_symmetric:
        along = _even(_SHARE * grid_sizes(endless_cell(cell), ratio, True)[-1])
    return homogenise(cell, ratio, fillet, along=along).tensor


def _even(number: float) -> int:
    return 2 * round(float(number) / 2.0)

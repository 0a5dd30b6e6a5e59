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
from ..design.target import Target
from ..mechanics.catalogue import CatalogueCell, known_cell
from ..mechanics.endless import endless_cell
from ..mechanics.homogenise import grid_sizes, homogenise
from ..mechanics.tensor import young
from ..util.errors import VolfrepError
from ..util.types import Floats

#: r / L between which a cell that is not in the catalogue is looked at, and at how many radii.
LEAST, MOST = 0.02, 0.2
RADII = 7
#: Voxels along a radius of the coarse grids, and along L at least and, without mirrors and with, at
#: most.
_VOXELS, _FEWEST, _FINEST = 2.5, 20, (32, 64)
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
    return _along(tensor, target)


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
    least, most = float(np.log(ratios[0])), float(np.log(ratios[-1]))
    softest, stiffest = (float(np.exp(moduli(place))) for place in (least, most))
    if not softest <= target.value <= stiffest:
        unit = "of the solid's" if target.young == 1.0 else "MPa"
        raise VolfrepError(
            f"No strut radius gives the cell '{cell.name}' a modulus of {target.value:.4g} {unit} "
            f"along this direction: choose one from {softest:.3g} to {stiffest:.3g} {unit}"
            + (", or name the solid's material." if target.young == 1.0 else ".")
        )

    from scipy.optimize import brentq  # slow to load, and every job loads this module

    def place_of(value: float) -> float:
        wanted = np.clip(np.log(value), moduli(least), moduli(most))
        return float(brentq(lambda place: moduli(place) - wanted, least, most, xtol=1e-9))

    place = place_of(target.value)
    if known or rough:
        return _rounded(place)
    # By how much the fine grids differ from the coarse hardly hangs on the radius.
    for _ in range(_STEPS):
        fine = modulus(cell, float(np.exp(place)), target, fillet)
        if abs(fine / target.value - 1.0) < _CLOSE:
            break
        place = place_of(target.value * float(np.exp(moduli(place))) / fine)
    return _rounded(place)


def coarse_ratios(fillet: float) -> Floats:
    """(n,) r / L at which a cell that is not in the catalogue is looked at."""
    most = min(MOST, 0.98 * (np.sqrt(0.75 - fillet) - 0.5)) if fillet < 0.5 else 0.0
    if most <= LEAST:
        raise VolfrepError(f"A fillet of {fillet:.4g} L is too large for a cell: reduce it.")
    ratios: Floats = np.geomspace(LEAST, most, RADII)
    return ratios


def _catalogue_moduli(known: CatalogueCell, target: Target) -> Callable[[float], float]:
    """The logarithm of the modulus over that of r / L, by the catalogue."""
    return lambda place: float(np.log(_along(known.tensor(float(np.exp(place))), target)))


def _coarse_moduli(cell: UnitCell, target: Target, fillet: float) -> Callable[[float], float]:
    """The logarithm of the modulus over that of r / L, by the coarse grids."""
    from scipy.interpolate import CubicSpline  # slow to load, and every job loads this module

    ratios = coarse_ratios(fillet)
    found = [_along(_tensor(cell, float(ratio), fillet, True), target) for ratio in ratios]
    spline = CubicSpline(np.log(ratios), np.log(found), bc_type="natural")
    return lambda place: float(spline(place))


def _along(tensor: Floats, target: Target) -> float:
    return target.young * float(young(tensor, np.array([target.direction]))[0])


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


def _rounded(place: float) -> float:
    """The ratio at a logarithm, without the digits that hang on the solver's number of threads."""
    return float(f"{np.exp(place):.6g}")

# SPDX-License-Identifier: LGPL-2.1-or-later
"""The strut radius of a stiffness, and the stiffness of a radius.

Library cells are read off the catalogue, whose solid has a Poisson's ratio of 0.3; other cells, and
all with fillets, are homogenised on the way.
"""

from __future__ import annotations

import numpy as np

from ..design.cells import UnitCell
from ..design.target import Target
from ..mechanics.catalogue import known_cell
from ..mechanics.homogenise import homogenise
from ..mechanics.tensor import young
from ..util.errors import VolfrepError

#: r / L between which a cell that is not in the catalogue is looked at.
LEAST, MOST = 0.02, 0.2
#: How near the modulus of a homogenised cell has to come, and in how many steps.
_CLOSE = 2e-3
_STEPS = 8


def modulus(cell: UnitCell, ratio: float, target: Target, fillet: float = 0.0) -> float:
    """Young's modulus along the target's direction at an r / L; fillet in units of L.

    Raises:
        VolfrepError: the ratio lies outside the catalogue, or the cell carries nothing.
    """
    known = known_cell(cell) if not fillet else None
    tensor = known.tensor(ratio) if known else homogenise(cell, ratio, fillet).tensor
    return target.young * float(young(tensor, np.array([target.direction]))[0])


def ratio_of_stiffness(cell: UnitCell, target: Target, fillet: float = 0.0) -> float:
    """The r / L at which the endless lattice has the target's stiffness.

    Raises:
        VolfrepError: no radius does; the text says what can be had.
    """
    known = known_cell(cell) if not fillet else None
    low, high = (known.ratios[0], known.ratios[-1]) if known else (LEAST, MOST)

    def missing(place: float) -> float:
        return float(np.log(modulus(cell, float(np.exp(place)), target, fillet) / target.value))

    least, most = float(np.log(low)), float(np.log(high))
    at_least, at_most = missing(least), missing(most)
    if at_least > 0.0 or at_most < 0.0:
        unit = "of the solid's" if target.young == 1.0 else "MPa"
        softest, stiffest = (target.value * np.exp(m) for m in (at_least, at_most))
        raise VolfrepError(
            f"No strut radius gives the cell '{cell.name}' a modulus of {target.value:.4g} {unit} "
            f"along this direction: choose one from {softest:.3g} to {stiffest:.3g} {unit}"
            + (", or name the solid's material." if target.young == 1.0 else ".")
        )
    if known:
        from scipy.optimize import brentq  # slow to load, and every job loads this module

        return float(np.exp(brentq(missing, least, most, xtol=1e-9)))
    # Nearly a power law: false position in logarithms.
    for _ in range(_STEPS):
        place = least + (most - least) * at_least / (at_least - at_most)
        off = missing(place)
        if abs(off) < _CLOSE:
            break
        if off < 0.0:
            least, at_least = place, off
        else:
            most, at_most = place, off
    return float(np.exp(place))

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Bounds and usual figures of porous bodies, as lines beside those of cells."""

from __future__ import annotations

import numpy as np

from volfrep.util.types import Floats


def hashin_shtrikman(density: Floats, poisson: float = 0.3) -> tuple[Floats, Floats]:
    """Upper bounds of E and G of isotropic porous bodies, for a solid with E = 1.

    Hashin & Shtrikman, J. Mech. Phys. Solids 11 (1963) 127, with voids as the second phase.
    """
    density = np.asarray(density, float)
    solid_bulk = 1.0 / (3.0 * (1.0 - 2.0 * poisson))
    solid_shear = 1.0 / (2.0 * (1.0 + poisson))
    void = 1.0 - density
    shares = 3.0 * density / (3.0 * solid_bulk + 4.0 * solid_shear)
    bulk = solid_bulk + void / (-1.0 / solid_bulk + shares)
    factor = 6.0 * (solid_bulk + 2.0 * solid_shear) * density
    factor = factor / (5.0 * solid_shear * (3.0 * solid_bulk + 4.0 * solid_shear))
    shear = solid_shear + void / (-1.0 / solid_shear + factor)
    return 9.0 * bulk * shear / (3.0 * bulk + shear), shear


def gibson_ashby(density: Floats) -> tuple[Floats, Floats, Floats]:
    """E, G (of the solid's E) and plastic strength (of its yield stress) of open-cell foams.

    Gibson & Ashby, Cellular Solids (1997): density squared, 3/8 of that, 0.3 density^1.5.
    """
    density = np.asarray(density, float)
    return density**2, 0.375 * density**2, 0.3 * density**1.5

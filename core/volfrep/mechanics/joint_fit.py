# SPDX-License-Identifier: LGPL-2.1-or-later
"""How a cell's joints stiffen the ends of its beams, fitted to the cell's own elastic tensor.

No end serves every cell: struts that run straight through a joint are hardly stiffened by it when
pulled, and much when bent. So the length of the ends, and how much stiffer they are when pulled
and when bent, are found for each cell and radius such that a periodic frame of these beams has the
moduli of the homogenised solid. What no frame can have is the solid's bulk modulus: a joint that
is pressed from all sides is stiffer than its struts can tell each other.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..design.cells import UnitCell
from ..util.types import Floats
from .endless import endless_cell, refuse_odd
from .frame import CIRCLE, Ends, PeriodicFrame, Section, frame_tensor
from .tensor import compliance, young

#: No end is longer than this part of its strut.
LONGEST_END = 0.45
#: Bounds of the logarithms of: length in radii, stiffness when pulled, and by how much more the
#: ends are stiffened when bent (the width of the deck's sections goes with the root of that).
_LOW = np.log([0.2, 0.5, 0.25])
_HIGH = np.log([4.0, 1000.0, 16.0])
_FIRST = np.log([1.0, 1.5, 2.0])
#: What the fit draws towards where the moduli leave a choice, and how strongly.
_TOWARDS = np.log([1.0, 1.5, 2.0])
_PULL = 0.01
#: Weights of E along the axes, G in the planes of the faces, E along the diagonals, and the bulk
#: modulus.
_WEIGHTS = np.array([1.0, 0.25, 0.2, 0.05])
_COUNTS = np.array([3, 3, 4, 1])
#: A modulus below this part of the largest is none, and not fitted.
_NOTHING = 1e-6
_DIAGONALS = np.array([[1, 1, 1], [1, 1, -1], [1, -1, 1], [-1, 1, 1]], float)


@dataclass(frozen=True, eq=False)
class JointFit:
    """The fitted ends of a cell's struts.

    Attributes:
        ends: what was found.
        misfit: (4,) largest relative error left in E along the axes, G, E along the diagonals, and
            the bulk modulus.
    """

    ends: Ends
    misfit: Floats


def periodic_frame(cell: UnitCell) -> PeriodicFrame:
    """The frame of a cell, lengths in units of L."""
    refuse_odd(cell)
    endless = endless_cell(cell)
    return PeriodicFrame(len(endless.nodes), endless.struts, endless.start, endless.end)


def fit_joint(
    cell: UnitCell,
    radius: float,
    tensor: Floats,
    *,
    section: Section = CIRCLE,
    widen: bool = True,
    poisson: float = 0.3,
    start: Ends | None = None,
) -> JointFit:
    """The ends with which a frame of the cell comes nearest to a tensor.

    Args:
        cell: the unit cell.
        radius: of the struts, in units of L.
        tensor: (6, 6) the homogenised stiffness of a solid with E = 1.
        section: of the beams that will have these ends.
        widen: whether ends may be stiffened more when bent than when pulled, which takes wider
            sections; else both alike, and E and G cannot both be met.
        poisson: the solid's ratio.
        start: to begin with, such as those of a radius nearby.
    """
    frame = periodic_frame(cell)
    wanted = _moduli(tensor)
    carried = wanted > _NOTHING * wanted.max()

    free = 3 if widen else 2

    def ends_of(place: Floats) -> Ends:
        length, axial, wider = np.exp(place) if widen else (*np.exp(place), 1.0)
        return Ends(float(length), float(axial), float(axial * wider))

    def missed(place: Floats) -> Floats:
        found = frame_tensor(
            frame, radius, ends_of(place), section=section, poisson=poisson, longest=LONGEST_END
        )
        return np.where(carried, np.log(_moduli(found) / np.where(carried, wanted, 1.0)), 0.0)

    def residuals(place: Floats) -> Floats:
        errors = missed(place)
        weights = np.repeat(_WEIGHTS / np.sqrt(_COUNTS), _COUNTS)
        return np.concatenate([weights * errors, _PULL * (place - _TOWARDS[:free])])

    first = _FIRST
    if start is not None:
        first = np.log([start.length, start.axial, start.bending / start.axial])
    low, high = _LOW[:free], _HIGH[:free]
    first = np.clip(first[:free], low + 1e-6, high - 1e-6)
    from scipy.optimize import least_squares  # slow to load, and every job loads this module

    place = least_squares(residuals, first, bounds=(low, high), x_scale=0.3).x
    errors = np.abs(np.expm1(missed(place)))
    parts = np.split(errors, np.cumsum(_COUNTS)[:-1])
    return JointFit(ends_of(place), np.array([part.max() for part in parts]))


def _moduli(tensor: Floats) -> Floats:
    """(11,) E along the axes, G in the planes of the faces, E along the diagonals, bulk modulus."""
    shear = 1.0 / np.diag(compliance(tensor))[3:]
    bulk = [tensor[:3, :3].sum() / 9.0]
    return np.concatenate([young(tensor, np.eye(3)), shear, young(tensor, _DIAGONALS), bulk])

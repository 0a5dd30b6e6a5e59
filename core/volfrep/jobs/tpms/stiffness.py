# SPDX-License-Identifier: LGPL-2.1-or-later
"""The thickness of a stiffness: walls whose endless lattice has a modulus.

Moduli grow about as a power of the relative density, so that few walls have to be homogenised: on
coarse grids until one is met, then on fine ones for what the coarse are off.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import lru_cache

import numpy as np

from ...design.spec import LatticeSpec
from ...design.target import Target
from ...design.tpms import PeriodicSurface, TpmsSheet
from ...mechanics.summary import POISSON
from ...mechanics.tensor import young
from ...tpms.solid import TpmsSolid
from ...util.errors import VolfrepError
from ...util.types import Floats
from .properties import homogenise_tpms, usual_along
from .symmetry import is_mirror_symmetric
from .voxels import of_density, tpms_density

#: Relative densities between which walls are looked for.
LEAST, MOST = 0.05, 0.6
#: Voxels along L of coarse grids, as a share of the usual ones; of fine ones.
_COARSE, _FINE = 0.4, 0.7
#: How near a modulus has to come, relative, and in how many steps.
_CLOSE, _STEPS = 3e-3, 6


def solve_tpms_stiffness(spec: LatticeSpec, target: Target, *, rough: bool = False) -> LatticeSpec:
    """The specification with walls whose endless lattice has the target's stiffness.

    Args:
        spec: with walls.
        target: a stiffness.
        rough: whether the coarse grids will do.

    Raises:
        VolfrepError: no thickness gives it; the text says what can be had.
    """
    assert spec.surface is not None
    surface, kind = spec.surface, spec.wall.kind

    def modulus(share: float, fineness: float) -> float:
        return _along(_of_share(surface, kind, share, fineness), target)

    places = [LEAST, MOST]
    moduli = [modulus(share, _COARSE) for share in places]
    if not moduli[0] <= target.value <= moduli[1]:
        unit = "of the solid's" if target.young == 1.0 else "MPa"
        raise VolfrepError(
            f"No {spec.wall.called} gives '{surface.name}' a modulus of {target.value:.4g} {unit} "
            f"along this direction: choose one from {moduli[0]:.3g} to {moduli[1]:.3g} {unit}"
            + (", or name the solid's material." if target.young == 1.0 else ".")
        )
    share = _met(places, moduli, target.value, lambda at: modulus(at, _COARSE))
    # By how much the fine grids differ hardly hangs on the thickness.
    if not rough:
        off = modulus(share, _FINE) / target.value
        share = _met(places, moduli, target.value / off, lambda at: modulus(at, _COARSE))
    share = float(f"{share:.5g}")  # without what hangs on the solver's number of threads
    level = spec.cell_size * _solid(surface, kind, share).level
    if spec.wall.is_sheet:
        return replace(spec, wall=replace(spec.wall, thickness=2.0 * level))
    return replace(spec, wall=replace(spec.wall, offset=level))


def tpms_modulus(spec: LatticeSpec, target: Target) -> float:
    """Young's modulus along the target's direction of a specification's endless walls.

    Raises:
        VolfrepError: they carry no load.
    """
    assert spec.surface is not None
    tensor = _of_wall(spec.surface, spec.wall, spec.cell_size)
    return _along(tensor, target)


def _met(
    places: list[float], moduli: list[float], wanted: float, find: Callable[[float], float]
) -> float:
    """The density of a modulus, between those that are known; what is found on the way is added."""
    for _ in range(_STEPS):
        order = np.argsort(places)
        x, y = np.log(np.array(places)[order]), np.log(np.array(moduli)[order])
        share = float(np.exp(np.interp(np.log(wanted), y, x)))
        nearest = int(np.abs(y - np.log(wanted)).argmin())
        if abs(y[nearest] - np.log(wanted)) < _CLOSE:
            break
        places.append(share)
        moduli.append(find(share))
    return share


def _along(tensor: Floats, target: Target) -> float:
    return target.young * float(young(tensor, np.array([target.direction]))[0])


@lru_cache(maxsize=64)
def _solid(surface: PeriodicSurface, kind: str, share: float) -> TpmsSolid:
    first = TpmsSolid.of(surface, TpmsSheet(kind), 1.0)
    return of_density(first, share, octant=is_mirror_symmetric(first))


@lru_cache(maxsize=64)
def _of_share(surface: PeriodicSurface, kind: str, share: float, fineness: float) -> Floats:
    """(6, 6) stiffness over the solid's E; kept for a few walls."""
    return _tensor(_solid(surface, kind, share), share, surface.name, fineness)


@lru_cache(maxsize=16)
def _of_wall(surface: PeriodicSurface, wall: TpmsSheet, cell_size: float) -> Floats:
    solid = TpmsSolid.of(surface, wall, cell_size)
    octant = is_mirror_symmetric(solid)
    return _tensor(solid, tpms_density(solid, octant=octant)[0], surface.name, _FINE)


def _tensor(solid: TpmsSolid, share: float, name: str, fineness: float) -> Floats:
    octant = is_mirror_symmetric(solid)
    along = usual_along(solid, share, octant=octant, fineness=fineness)
    found = homogenise_tpms(solid, share, POISSON, octant=octant, along=along, name=name)
    return found.tensor

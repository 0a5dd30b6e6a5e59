# SPDX-License-Identifier: LGPL-2.1-or-later
"""The thickness of a stiffness: walls whose endless lattice has a modulus.

Moduli grow about as a power of the relative density, so that few walls have to be homogenised: on
coarse grids until one is met, then on fine ones for what the coarse are off.
"""

from __future__ import annotations

from functools import lru_cache

from ...design.spec import LatticeSpec
from ...design.target import Target, modulus_out_of_reach
from ...design.tpms import PeriodicSurface, TpmsSheet
from ...mechanics.summary import POISSON
from ...mechanics.tensor import modulus_along
from ...tpms.solid import TpmsSolid
from ...util.search import Rising, make_until_met
from ...util.types import Floats
from .octants import surface_of
from .properties import homogenise_tpms, usual_along
from .symmetry import is_mirror_symmetric
from .voxels import of_density, tpms_density

#: Relative densities between which walls are looked for.
LEAST, MOST = 0.05, 0.6
#: Voxels along L of coarse grids, as a share of the usual ones; of fine ones.
_COARSE, _FINE = 0.4, 0.7
#: How near a modulus has to come, relative.
_CLOSE = 3e-3


def solve_tpms_stiffness(spec: LatticeSpec, target: Target, *, rough: bool = False) -> LatticeSpec:
    """The specification with walls whose endless lattice has the target's stiffness.

    Args:
        spec: with walls.
        target: a stiffness.
        rough: whether the coarse grids will do.

    Raises:
        VolfrepError: no thickness gives it; the text says what can be had.
    """
    surface, kind = surface_of(spec), spec.wall.kind

    def modulus(share: float, fineness: float) -> float:
        return modulus_along(_of_share(surface, kind, share, fineness), target)

    coarse = Rising(lambda share: modulus(share, _COARSE), LEAST, MOST, close=_CLOSE)
    least, most = coarse.span
    if not least <= target.value <= most:
        raise modulus_out_of_reach(
            f"{spec.wall.called} gives '{surface.name}'", target, least, most
        )

    def share_of(value: float) -> float:
        # Without what hangs on the solver's number of threads.
        return float(f"{coarse.level_of(min(max(value, least), most)):.5g}")

    def missing(share: float) -> float:
        return target.value - modulus(share, _FINE)

    # By how much the fine grids differ hardly hangs on the thickness.
    enough, times = _CLOSE * target.value, 0 if rough else 1
    share = make_until_met(share_of, missing, target.value, enough=enough, times=times)
    level = spec.cell_size * _solid(surface, kind, share).level
    return spec.with_thickness(2.0 * level if spec.wall.is_sheet else level)


def tpms_modulus(spec: LatticeSpec, target: Target) -> float:
    """Young's modulus along the target's direction of a specification's endless TPMS.

    Raises:
        VolfrepError: they carry no load.
    """
    return modulus_along(_of_sheet(surface_of(spec), spec.wall, spec.cell_size), target)


@lru_cache(maxsize=64)
def _solid(surface: PeriodicSurface, kind: str, share: float) -> TpmsSolid:
    first = TpmsSolid.of(surface, TpmsSheet(kind), 1.0)
    return of_density(first, share, octant=is_mirror_symmetric(first))


@lru_cache(maxsize=64)
def _of_share(surface: PeriodicSurface, kind: str, share: float, fineness: float) -> Floats:
    """(6, 6) stiffness over the solid's E; kept for a few walls."""
    return _tensor(_solid(surface, kind, share), share, surface.name, fineness)


@lru_cache(maxsize=16)
def _of_sheet(surface: PeriodicSurface, sheet: TpmsSheet, cell_size: float) -> Floats:
    solid = TpmsSolid.of(surface, sheet, cell_size)
    octant = is_mirror_symmetric(solid)
    return _tensor(solid, tpms_density(solid, octant=octant)[0], surface.name, _FINE)


def _tensor(solid: TpmsSolid, share: float, name: str, fineness: float) -> Floats:
    octant = is_mirror_symmetric(solid)
    along = usual_along(solid, share, octant=octant, fineness=fineness)
    found = homogenise_tpms(solid, share, POISSON, octant=octant, along=along, name=name)
    return found.tensor

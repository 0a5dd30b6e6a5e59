# SPDX-License-Identifier: LGPL-2.1-or-later
"""A lattice's volume, and the radius of a target, from the length of its struts: at once.

Good to a few percent: for previews and forecasts. `jobs.targets` finds the radius itself.
"""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

import numpy as np

from ..design.cells import UnitCell
from ..design.forecast import LEAST_INSIDE, cell_volume, strut_shares
from ..design.spec import LatticeSpec
from ..design.spec_parts import MAX_RESOLUTION, largest_radius
from ..mesh.triangle_mesh import TriangleMesh
from ..octants import sdf
from ..octants.octant import ALL_ACTIVE, OctantKey, octant_primitives
from ..spatial.even_points import even_points
from ..util.errors import VolfrepError
from ..util.types import Floats
from .stiffness_target import ratio_of_stiffness

#: Points by which the volume of a cell's struts is measured (a power of 2).
CELL_POINTS = 12


def lattice_volume(spec: LatticeSpec, bare: float, radius: float) -> float:
    """Volume of a lattice, mm3.

    Args:
        spec: its cell, cell size and fillet count.
        bare: volume that its struts would have with a radius of 1 mm if they did not meet, mm3.
        radius: of the struts, mm.
    """
    size = spec.cell_size
    return bare * radius**2 * _joints_share(spec.unit_cell(), radius / size, spec.fillet / size)


def radius_of_volume(spec: LatticeSpec, bare: float, volume: float) -> float:
    """The radius that gives a lattice a volume, mm; see `lattice_volume`.

    Raises:
        VolfrepError: no radius does.
    """
    low, high = radius_range(spec)
    least, most = (lattice_volume(spec, bare, radius) for radius in (low, high))
    if not least <= volume <= most:
        raise VolfrepError(
            f"No strut radius meets the target: the lattice would have to have {volume:.4g} mm3, "
            f"and with cells '{spec.unit_cell().name}' of {spec.cell_size:g} mm it can have about "
            f"{least:.3g} to {most:.3g} mm3."
        )

    def missing(radius: float) -> float:
        return lattice_volume(spec, bare, radius) - volume

    from scipy.optimize import brentq  # slow to load, and every job loads this module

    return float(brentq(missing, low, high, xtol=1e-4 * high))


def radius_range(spec: LatticeSpec) -> tuple[float, float]:
    """The thinnest and the thickest strut that cells of this size can have, mm."""
    size = spec.cell_size
    return size / MAX_RESOLUTION * 1.5, largest_radius(size, spec.fillet) * (1.0 - 1e-6)


def solve_target_roughly(solid: TriangleMesh, spec: LatticeSpec) -> LatticeSpec:
    """A specification with about the radius of its target, for a forecast.

    Walls and networks are as they are.

    Args:
        solid: closed mesh, mm.
        spec: with a target, or without one: then it is returned as it is.

    Raises:
        VolfrepError: no radius meets the target.
    """
    target, size = spec.target, spec.cell_size
    if target is None or spec.output == "domain":
        return spec
    if spec.surface is not None or spec.network is not None:
        return spec
    cell = spec.unit_cell()
    if target.aim == "stiffness":
        ratio = ratio_of_stiffness(cell, target, spec.fillet / size, rough=True)
        return replace(spec, strut_radius=ratio * size)
    whole = abs(solid.volume)
    # Exact for long prisms about a circle; others measured within 2 % of the volume.
    skin = 0.0 if spec.skin is None else spec.skin.rough_volume(solid)
    left = max(1.0 - 0.5 * skin / whole, 0.0) ** 2
    inside = whole * max(left, LEAST_INSIDE)
    ends = cell.nodes[cell.struts]
    length = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1) @ strut_shares(cell) * size
    # Struts that are deformed with their cells keep their share of them.
    one = cell_volume(spec) if spec.keep_radius else size**3
    bare = float(np.pi * length * inside / one)
    skin = spec.skin_volume(whole, inside)
    volume = target.lattice_volume(spec.density, inside, skin)
    low, high = radius_range(spec)
    # What the skin takes is known about only: the forecast refuses nothing.
    least, most = (lattice_volume(spec, bare, radius) for radius in (low, high))
    return replace(
        spec, strut_radius=radius_of_volume(spec, bare, float(np.clip(volume, least, most)))
    )


@lru_cache(maxsize=1024)
def _joints_share(cell: UnitCell, radius: float, fillet: float) -> float:
    """Volume of a cell's struts and joints over that of its struts counted each by itself.

    The radius is in units of L. Struts overlap at the joints, where spheres and fillets add some.
    """
    mirrors = (0,) if cell.is_mirror_symmetric else range(8)
    points = _points()
    filled = []
    for mirror in mirrors:
        key = OctantKey(mirror, ALL_ACTIVE)
        primitives = octant_primitives(cell, key, 1.0, radius, fillet)
        values = sdf.union(sdf.distances(points[:, None], primitives), fillet)
        filled.append(float((values < 0.0).mean()))
    ends = cell.nodes[cell.struts]
    length = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    return float(np.mean(filled) / (np.pi * radius**2 * (length @ strut_shares(cell))))


@lru_cache(maxsize=1)
def _points() -> Floats:
    """(n, 3) points spread evenly over an octant of the unit cell."""
    points: Floats = 0.5 * even_points(3, CELL_POINTS)
    return points

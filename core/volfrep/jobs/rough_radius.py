# SPDX-License-Identifier: LGPL-2.1-or-later
"""A lattice's volume, and the radius of a target, from the length of its struts: at once.

Good to a few percent: for previews and forecasts. `jobs.targets` finds the radius itself.
"""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

import numpy as np

from ..design.cells import UnitCell
from ..design.forecast import cell_volume, share_deeper
from ..design.kinds.strut_cells import strut_shares
from ..design.spec import LatticeSpec
from ..design.spec_parts import MAX_RESOLUTION, largest_radius
from ..design.target import volume_out_of_reach
from ..mechanics.catalogue import known_cell
from ..mesh.triangle_mesh import TriangleMesh
from ..octants import sdf
from ..octants.octant import ALL_ACTIVE, OctantKey, octant_primitives
from ..spatial.even_points import even_points
from ..util.search import OutOfReachError, Rising
from ..util.types import Floats
from .stiffness_target import ratio_of_stiffness

#: Points by which the volume of a cell's struts is measured (a power of 2).
CELL_POINTS = 12
#: A radius is found when its volume is this near, relative.
_CLOSE = 1e-4


def lattice_volume(spec: LatticeSpec, bare: float, radius: float) -> float:
    """Volume of a lattice, mm3.

    Args:
        spec: its cell, cell size and fillet count.
        bare: volume that its struts would have with a radius of 1 mm if they did not meet, mm3.
        radius: of the struts, mm.
    """
    cell, ratio = spec.unit_cell(), radius / spec.cell_size
    alone = np.pi * ratio**2 * _strut_length(cell)
    return bare * radius**2 * endless_density(cell, ratio, spec.fillet / spec.cell_size) / alone


def radius_of_target(
    spec: LatticeSpec, bare: float, inside: float, skin: float, *, clip: bool = False
) -> float:
    """About the radius that meets a specification's target, mm; see `lattice_volume`.

    Args:
        spec: of cells of struts, with a target.
        bare: volume of its struts as of `lattice_volume`, mm3.
        inside: volume of what the lattice fills, mm3.
        skin: volume of the skin, mm3.
        clip: whether the thinnest and the thickest struts stand for what lies beyond them.

    Raises:
        VolfrepError: no radius does.
    """
    target, size = spec.target, spec.cell_size
    assert target is not None
    if target.aim == "stiffness":
        return size * ratio_of_stiffness(spec.unit_cell(), target, spec.fillet / size, rough=True)
    low, high = radius_range(spec)
    volume = target.lattice_volume(spec.density, inside, skin)
    known = Rising(lambda radius: lattice_volume(spec, bare, radius), low, high, close=_CLOSE)
    try:
        return known.level_of(volume)
    except OutOfReachError as reach:
        if clip:
            return low if volume < reach.most else high
        cells = f"cells '{spec.unit_cell().name}' of {size:g} mm"
        span = (reach.least, reach.most)
        raise volume_out_of_reach(target, cells, spec.density, inside, skin, span) from reach


def endless_bare(spec: LatticeSpec, inside: float) -> float:
    """The bare volume, as of `lattice_volume`, of the endless lattice in a volume in mm3."""
    size = spec.cell_size
    # Struts that are deformed with their cells keep their share of them.
    one = cell_volume(spec) if spec.keep_radius else size**3
    return float(np.pi * _strut_length(spec.unit_cell()) * size * inside / one)


def radius_range(spec: LatticeSpec) -> tuple[float, float]:
    """The thinnest and the thickest strut that cells of this size can have, mm."""
    size = spec.cell_size
    return size / MAX_RESOLUTION * 1.5, largest_radius(size, spec.fillet) * (1.0 - 1e-6)


def solve_target_roughly(solid: TriangleMesh, spec: LatticeSpec) -> LatticeSpec:
    """A specification of cells of struts with about the radius of its target, for a forecast.

    Args:
        solid: closed mesh, mm.
        spec: with a target, or without one: then it is returned as it is.

    Raises:
        VolfrepError: no radius meets the target.
    """
    if spec.target is None or spec.output == "domain":
        return spec
    whole = abs(solid.volume)
    skin = 0.0 if spec.skin is None else spec.skin.rough_volume(solid)
    inside = whole * (share_deeper(solid, skin / solid.area) if skin else 1.0)
    bare, skin = endless_bare(spec, inside), spec.skin_volume(whole, inside)
    # What the skin takes is known about only: the forecast refuses nothing.
    return replace(spec, strut_radius=radius_of_target(spec, bare, inside, skin, clip=True))


def endless_density(cell: UnitCell, ratio: float, fillet: float) -> float:
    """The relative density of an endless lattice, at once; r / L, and the fillet in units of L.

    By the catalogue, or, within a percent, by points.
    """
    known = None if fillet else known_cell(cell)
    if known is not None and known.ratios[0] <= ratio <= known.ratios[-1]:
        return known.at(ratio)["relative_density"]
    return _density_by_points(cell, ratio, fillet)


def _strut_length(cell: UnitCell) -> float:
    """Length of the struts of a cell that are its own, in units of L."""
    ends = cell.nodes[cell.struts]
    return float(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1) @ strut_shares(cell))


@lru_cache(maxsize=1024)
def _density_by_points(cell: UnitCell, radius: float, fillet: float) -> float:
    """The relative density by points of its octants; radii in units of L."""
    mirrors = (0,) if cell.is_mirror_symmetric else range(8)
    points = _points()
    filled = []
    for mirror in mirrors:
        key = OctantKey(mirror, ALL_ACTIVE)
        primitives = octant_primitives(cell, key, 1.0, radius, fillet)
        values = sdf.union(sdf.distances(points[:, None], primitives), fillet)
        filled.append(float((values < 0.0).mean()))
    return float(np.mean(filled))


@lru_cache(maxsize=1)
def _points() -> Floats:
    """(n, 3) points spread evenly over an octant of the unit cell."""
    points: Floats = 0.5 * even_points(3, CELL_POINTS)
    return points

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Walls as they will be, coarse and at once: from samples of their distance and of the depth."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from scipy.ndimage import map_coordinates
from skimage.measure import marching_cubes

from ...design.grading import RadiusGrading
from ...design.spec import LatticeSpec
from ...design.tpms import PeriodicSurface
from ...grid.cell_grid import CellGrid
from ...grid.placement import Placement
from ...mesh.triangle_mesh import TriangleMesh
from ...tpms.midsurface import midsurface
from ...util.errors import VolfrepError
from ...util.types import Bools, Floats
from ..part_depth import PartDepth, Preview
from ..preview import ShownCells
from .level_table import level_table, with_volume
from .octants import surface_of
from .stiffness import solve_tpms_stiffness

#: Samples along a cell, of which there are never more than so many in the part's box; fewer than
#: the least along a cell would not show what it is.
ALONG_CELL, MOST_SAMPLES, LEAST_ALONG = 16, 1_000_000, 5
#: Samples along one period of the distance to the surface.
PERIOD = 32
#: Depths are sampled at every so many of these samples, and in between taken as linear.
DEPTH_EVERY = 3
#: So far outside the part's box samples begin, in samples: not where faces and skins often lie.
BEGIN = 0.7
#: A sheet is drawn no thinner than so many samples, or it would show holes.
THINNEST = 1.3
#: Where cells are stretched more than the inverse of this, walls are drawn too thin.
LEAST_SLOPE = 0.2


def preview_tpms(
    solid: TriangleMesh,
    spec: LatticeSpec,
    depth: PartDepth,
    placement: Placement,
    cells: ShownCells,
) -> Preview:
    """The preview of walls in a solid.

    Args:
        solid: closed mesh, mm.
        spec: what to make; the thickness of a target is found as nearly as the figures are.
        depth: of that solid.
        placement: where the lattice lies in it.
        cells: its cells.

    Raises:
        VolfrepError: there are too many cells, or no thickness meets the target.
    """
    points = depth.points_below(spec.shell)
    where = _Where(spec, placement, cells.grid, cells.usable)
    sides = where.sided(points)
    domain = depth.volume_below(spec.shell)
    skin = spec.skin_volume(solid.volume, domain)
    if spec.target is not None and spec.target.aim == "stiffness":
        spec = solve_tpms_stiffness(spec, spec.target, rough=True)
    elif spec.target is not None:
        volume = spec.target.lattice_volume(spec.density, domain, skin)
        table = level_table(sides, np.full(len(points), domain / max(len(points), 1)))
        spec = with_volume(spec, spec.target, table, volume, domain)

    def depths(places: Floats) -> Floats:
        return np.maximum(depth.below_skin(places, 0.0), 0.0)

    filled = sides < _levels(points, spec, placement, depths)
    lattice = float(filled.mean() if len(filled) else 0.0) * domain
    none = np.zeros((0, 3))
    return Preview(
        none, none, np.zeros((0, 2)), cells.count, 0, cells.grid, lattice / domain,
        lattice + skin, (lattice + skin) * spec.density / 1000.0, cells.lines, spec,
        _surface(solid, spec, depth, where),
    )  # fmt: skip


def _surface(
    solid: TriangleMesh, spec: LatticeSpec, depth: PartDepth, where: _Where
) -> TriangleMesh:
    low, high = solid.bounds
    pitch = max(spec.cell_size / ALONG_CELL, float(np.cbrt(np.prod(high - low) / MOST_SAMPLES)))
    if pitch > spec.cell_size / LEAST_ALONG:
        raise VolfrepError(
            f"Walls in so many cells of {spec.cell_size:g} mm are too much to be shown: enlarge "
            "the cells."
        )
    number = np.ceil((high - low) / pitch).astype(int) + 3
    start = low - BEGIN * pitch
    places = np.stack(np.meshgrid(*(np.arange(n) for n in number), indexing="ij"), axis=-1)
    points = (start + pitch * places).reshape(-1, 3)
    coarse = np.ceil(number / DEPTH_EVERY).astype(int) + 1
    few = np.stack(np.meshgrid(*(np.arange(n) for n in coarse), indexing="ij"), axis=-1)
    at = (start + DEPTH_EVERY * pitch * few).reshape(-1, 3)
    below = depth.signed_below_skin(at, spec.shell).reshape(tuple(coarse))
    deep = np.asarray(map_coordinates(below, places.reshape(-1, 3).T / DEPTH_EVERY, order=1))
    levels = _levels(points, spec, where.placement, lambda _: deep + spec.shell)
    if spec.wall.is_sheet:
        levels = np.maximum(levels, 0.5 * THINNEST * pitch)
    sheet = where.sided(points) - levels
    field = np.maximum(sheet, -deep)
    field = np.pad(field.reshape(tuple(number)), 1, constant_values=pitch)
    if field.min() >= 0.0:
        raise VolfrepError("No TPMS lies inside the skin: reduce the skin thickness.")
    found, rows, _, _ = marching_cubes(field.astype(np.float32), 0.0)  # type: ignore[no-untyped-call]
    return TriangleMesh(start + pitch * (found - 1.0), rows.astype(np.int32))


@dataclass(frozen=True, eq=False)
class _Where:
    """Where a TPMS lies in a part; see `preview_tpms`."""

    spec: LatticeSpec
    placement: Placement
    grid: CellGrid
    usable: Bools | None

    def sided(self, points: Floats) -> Floats:
        """(n,) the levels from which on points are solid, mm.

        Where cells are stretched they are those of the endless wall, over what the map makes of
        them.
        """
        mapping, size = self.placement.mapping, self.spec.cell_size
        at = self._cells(points)
        if mapping is None or mapping.is_rigid:
            value = self._values(at) * size
        else:
            step = size / PERIOD
            slope = [
                self._values(self._cells(points + step * axis))
                - self._values(self._cells(points - step * axis))
                for axis in np.eye(3)
            ]
            steep = np.sqrt(sum(one * one for one in slope)) / (2.0 * step)
            value = self._values(at) / np.maximum(steep, LEAST_SLOPE / size)
        if self.spec.wall.is_sheet:
            value = np.abs(value)
        elif self.spec.wall.kind == "complement":
            value = -value
        if self.usable is not None:
            index = np.floor(at).astype(np.int64)
            inside = ((index >= 0) & (index < self.usable.shape)).all(axis=1)
            inside[inside] = self.usable[tuple(index[inside].T)]
            value[~inside] = size
        return value

    def _cells(self, points: Floats) -> Floats:
        """Points in units of cells, from the grid's corner."""
        inside = points - self.placement.nudged(np.zeros(3))
        if self.placement.mapping is not None:
            inside = self.placement.mapping.to_lattice(inside)
        return np.asarray((inside - self.grid.origin) / self.spec.cell_size)

    def _values(self, cells: Floats) -> Floats:
        """Distances from the surface in units of L, positive where its formula is."""
        table = _period(surface_of(self.spec))
        return np.asarray(map_coordinates(table, PERIOD * cells.T, order=1, mode="grid-wrap"))


@lru_cache(maxsize=4)
def _period(surface: PeriodicSurface) -> Floats:
    """Distances from a surface at places of one period, in units of L."""
    steps = np.arange(PERIOD) / PERIOD
    places = np.stack(np.meshgrid(steps, steps, steps, indexing="ij"), axis=-1).reshape(-1, 3)
    return midsurface(surface).feet(places).distances.reshape((PERIOD,) * 3)


def _levels(points: Floats, spec: LatticeSpec, placement: Placement, depth: object) -> Floats:
    """Half the thickness of sheets at points, or the offset of a side, mm."""
    if isinstance(spec.radius_grading, RadiusGrading):
        return 0.5 * spec.radius_grading.radii(points, placement.bounds, depth)  # type: ignore[arg-type]
    level = 0.5 * spec.wall.thickness if spec.wall.is_sheet else spec.wall.offset
    return np.full(len(points), level)

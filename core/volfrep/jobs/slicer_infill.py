# SPDX-License-Identifier: LGPL-2.1-or-later
"""A field of densities cut into nested closed bands for a slicer, and the filament they take.

A band is all of the part, and a little beyond, where the field is at least its threshold; later
ones lie within earlier ones and count in their stead. Thresholds are even steps of density. What a
slicer prints is added up plane by plane: walls, solid layers, and between them each band with the
mean that the field has in it, so that the filament of the bands is that of the field.
"""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from ..design.banded_infill import FEWEST_BANDS, JOINED, MOST, BandedInfill
from ..design.spec import LatticeSpec
from ..mesh.booleans import as_manifold, as_mesh
from ..mesh.triangle_mesh import TriangleMesh
from ..spatial.proximity import index_surface
from ..spatial.rays import inside_grid
from ..util.errors import VolfrepError
from ..util.progress import Monitor, ProgressCallback
from ..util.showing import Shown
from ..util.types import Bools, Floats
from .slicer_layers import Printed, add_up

if TYPE_CHECKING:
    import manifold3d

#: Nodes of the grid that the field is looked at on.
NODES = 200_000
#: Bands reach so many grid steps beyond the part.
BEYOND = 1.2
#: No band that is to hold something is told less, %.
LEAST_DENSITY = 1.0
#: Bands' surfaces may move by this part of a grid step to have fewer triangles.
SIMPLER = 0.1
#: How PrusaSlicer 2.5 lays a pattern: what it lays in the middle over what it is told, at no
#: density, and by how much more at 100 %; how wide a line along all sides the joined ends of close
#: lines come to, as a share of their spacing; and by how much more along sides at 45 degrees with
#: the axes, along which a gyroid's lines run. Of walls 0.8 to 12 mm apart, told 1 to 45 %.
LAID = {
    "gyroid": (0.985, -0.11, 0.24, 0.17),
    "cubic": (1.0, 0.0, 0.28, 0.0),
    "grid": (1.0, 0.0, 0.35, 0.0),
    "triangles": (1.0, 0.0, 0.35, 0.0),
    "line": (1.0, 0.0, 0.17, 0.0),
}
#: Bands are so few that most are so many lines wide: how a pattern's waves meet the sides of narrow
#: ones is chance. Of four boxes at four angles, 10 to 50 % over 4 mm, filament was 2.1 % (rms) and
#: up to 4.7 % off with three bands of 3.3 lines, 4.4 and 12.4 % with five of 2.
NARROWEST = 3.3
#: Where less than this share of a density is told, the user is told why.
JOINED_MUCH = 0.75
_NARROW = " (narrow: joined ends of lines make up the rest)"


@dataclass(frozen=True, eq=False)
class Band:
    """A density, and where it holds.

    Attributes:
        mean: density that is wanted of it, %.
        density: that the slicer is told, %, so that it lays as much.
        volume: of the sparse infill that gets it, mm3.
        mesh: closed surface within which it holds, mm; None for the band of the part itself.
    """

    mean: float
    density: float
    volume: float
    mesh: TriangleMesh | None


@dataclass(frozen=True, eq=False, repr=False)
class SlicerInfill(Shown):
    """A part with its bands, as a slicer's project holds it.

    Attributes:
        solid: the part, mm.
        wanted: densities, pattern, walls, layers.
        bands: the least dense first; each counts within its mesh in place of those before.
        solid_volume: of walls and solid layers, mm3.
        material_density: g/cm3.
    """

    solid: TriangleMesh
    wanted: BandedInfill
    bands: tuple[Band, ...]
    solid_volume: float
    material_density: float = field(default=LatticeSpec.density)

    @property
    def filament(self) -> float:
        """Volume of the filament, mm3."""
        sparse = sum(band.volume * band.mean / 100.0 for band in self.bands)
        return self.solid_volume + sparse

    @property
    def mass(self) -> float:
        """Of the filament, g."""
        return self.filament * self.material_density / 1000.0

    @property
    def mean_density(self) -> float:
        """The one density that takes the same filament, %."""
        volume = sum(band.volume for band in self.bands)
        sparse = sum(band.volume * band.mean for band in self.bands)
        return sparse / volume if volume else 0.0

    def rows(self) -> tuple[tuple[str, str], ...]:
        """Names and values for the user."""
        each = [
            (
                f"band {number}",
                f"{band.mean:.1f} % of {band.volume:,.0f} mm3, told as {band.density:.1f} %"
                f"{_NARROW if band.density < JOINED_MUCH * band.mean else ''}",
            )
            for number, band in enumerate(self.bands, 1)
        ]
        return (
            *each,
            ("solid", f"{self.solid_volume:,.0f} mm3 of walls and solid layers"),
            ("filament", f"{self.filament:,.0f} mm3, {self.mass:,.2f} g"),
            ("as even", f"{self.mean_density:.1f} % everywhere would take the same"),
        )

    def save(self, path: str | os.PathLike[str], slicer: str = "prusa") -> None:
        """Write it as a 3MF project.

        Args:
            path: of the file; an old file stays if anything goes wrong.
            slicer: "prusa" for PrusaSlicer, "orca" for OrcaSlicer and Bambu Studio.

        Raises:
            VolfrepError: there is no such slicer, or the path cannot be written.
        """
        from ..io.write.slicer_project import write_project

        rest = [(band.density, band.mesh) for band in self.bands if band.mesh is not None]
        write_project(path, slicer, self.solid, self.bands[0].density, rest, self.wanted)


def cut_bands(
    solid: TriangleMesh,
    wanted: BandedInfill,
    *,
    material_density: float = LatticeSpec.density,
    progress: ProgressCallback | None = None,
) -> SlicerInfill:
    """Cut a part's infill into bands of density.

    Args:
        solid: checked closed mesh, mm, as it stands on the build plate.
        wanted: what the densities follow.
        material_density: of the filament, g/cm3.
        progress: called with the fraction done and the stage; returning False cancels.

    Raises:
        VolfrepError: the field is no density somewhere, or the part cannot be cut.
        Cancelled: the callback said so.
    """
    monitor = Monitor(progress)
    with monitor.stage("field", 0.0, 0.5):
        grid = _sample(solid, wanted, monitor)
    with monitor.stage("bands", 0.5, 0.7):
        thresholds = _thresholds(grid, wanted)
        cut = [(low, _band(grid, low, monitor)) for low in thresholds]
    with monitor.stage("filament", 0.7, 1.0):
        pieces = [piece for _, piece in cut if piece is not None]
        printed = add_up(solid, wanted, pieces, monitor)
    means = _means(grid, thresholds, wanted)
    there = [None, *pieces]
    of_band = [0, *(k for k, (_, piece) in enumerate(cut, 1) if piece is not None)]
    bands = tuple(
        Band(
            means[of_band[k]], _slicer_density(means[of_band[k]], printed, k, wanted),
            float(printed.sparse[k]), None if piece is None else as_mesh(piece),
        )
        for k, piece in enumerate(there)
        if k == 0 or printed.sparse[k] > 0.0
    )  # fmt: skip
    return SlicerInfill(solid, wanted, bands, printed.solid, material_density)


def _slicer_density(mean: float, printed: Printed, band: int, wanted: BandedInfill) -> float:
    """What a slicer is to be told so that it lays as much as a density wants, %, to a tenth.

    Args:
        mean: the density that is wanted, %.
        printed: the sparse infill, with its sides, along which the ends of lines are joined.
        band: whose.
        wanted: the pattern, and the lines.
    """
    volume = float(printed.sparse[band])
    if not volume or not mean:
        return mean
    bulk, more, *joined = LAID[wanted.pattern]
    share = float(printed.laid[band]) / volume
    outlines = printed.outlines[band][:, 0]
    sides = (printed.outlines[band] * joined).sum(axis=1)
    sides *= 100.0 * wanted.spacing * printed.layer / volume

    def laid(told: float) -> float:
        apart = 100.0 * wanted.spacing / told
        # Lines meet an outline at random: ends that are near enough are joined, but not those of
        # the only line.
        near = 1.4 * JOINED / apart
        lines = outlines / (np.pi * apart)
        ends = (1.0 - np.exp(-near) * (1.0 + near)) * (1.0 + np.expm1(-lines) / lines)
        return float((bulk + more * told / 100.0) * told * share + (sides * ends).sum())

    least, most = LEAST_DENSITY, MOST
    while most - least > 1e-3:  # the more is told, the more is laid
        told = 0.5 * (least + most)
        least, most = (told, most) if laid(told) < mean else (least, told)
    return round(most, 1)


@dataclass(frozen=True, eq=False)
class _Grid:
    """The field on a grid about the part.

    Attributes:
        start: (3,) of the first node, mm.
        step: mm.
        density: (nx, ny, nz) %.
        inside: the same, whether a node is inside the part.
        depth: the same, below the part's surface, mm; negative outside.
    """

    start: Floats
    step: float
    density: Floats
    inside: Bools
    depth: Floats


def _sample(solid: TriangleMesh, wanted: BandedInfill, monitor: Monitor) -> _Grid:
    low, high = solid.bounds
    step = max(float((np.prod(high - low) / NODES) ** (1 / 3)), wanted.line_width)
    # At no special place of the part; two steps beyond it on all sides.
    start = low - 2.3660254 * step
    axes = [
        start[k] + step * np.arange(int(np.ceil((high[k] - start[k]) / step)) + 3) for k in range(3)
    ]
    inside = inside_grid(solid, axes[0], axes[1], axes[2], monitor)
    points = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    depth = monitor.call(lambda: _depth(solid, wanted, inside, step, points))
    density = wanted.densities(points, solid.bounds, lambda _: depth, step)
    shape = inside.shape
    return _Grid(start, step, density.reshape(shape), inside, depth.reshape(shape))


def _depth(
    solid: TriangleMesh, wanted: BandedInfill, inside: Bools, step: float, points: Floats
) -> Floats:
    """(n,) depths of the grid's nodes below the surface, mm: measured where they count.

    Elsewhere, in what lies deeper or outside, by the nodes on the other side.
    """
    from scipy.ndimage import distance_transform_edt  # slow to load

    def across(part: Bools) -> Floats:
        return np.asarray(distance_transform_edt(part, sampling=step)) - 0.5 * step

    depth = np.where(inside, across(inside), -across(~inside)).ravel()
    deepest = max(wanted.reach if wanted.needs_depth else 0.0, wanted.wall_thickness)
    rows = np.flatnonzero(inside.ravel() & (depth < deepest + 2.0 * step))
    depth[rows] = index_surface(solid, step).near(points[rows])[1]
    return depth


def _thresholds(grid: _Grid, wanted: BandedInfill) -> Floats:
    """Least densities of the bands but the first, %; none of an even field.

    Even steps, so few that of half of the bands the width is at least `NARROWEST` lines.
    """
    within = grid.density[grid.inside]
    if not len(within):
        raise VolfrepError("The part is thinner everywhere than the grid that the field is cut on.")
    low, high = float(within.min()), float(within.max())
    if high - low < 0.1:  # a slicer is told tenths of a percent
        return np.zeros(0)
    slope = np.linalg.norm(np.gradient(grid.density, grid.step), axis=0)[grid.inside]
    for bands in range(wanted.bands, FEWEST_BANDS - 1, -1):
        steps = np.linspace(low, high, bands + 1)[1:-1]
        place = np.searchsorted(steps, within, "right")
        count, passed = np.bincount(place), np.bincount(place, slope)
        widths = (high - low) / bands * count[count > 0] / np.maximum(passed[count > 0], 1e-12)
        if np.median(widths) >= NARROWEST * wanted.line_width:
            break
    return np.asarray(steps)


def _means(grid: _Grid, thresholds: Floats, wanted: BandedInfill) -> list[float]:
    """Mean density of each band in what is neither wall nor outside, %, to a tenth."""
    sparse = grid.inside & (grid.depth > wanted.wall_thickness)
    if not sparse.any():
        sparse = grid.inside
    place = np.searchsorted(thresholds, grid.density, "right")
    result = []
    for number in range(len(thresholds) + 1):
        own = grid.density[sparse & (place == number)]
        if not len(own):
            own = grid.density[grid.inside & (place == number)]
        result.append(round(float(own.mean()), 1) if len(own) else 0.0)
    return result


def _band(grid: _Grid, low: float, monitor: Monitor) -> manifold3d.Manifold | None:
    """Where the density is at least so high, near the part; None where nothing is."""
    from skimage.measure import marching_cubes  # slow to import

    # In steps of the grid both: how far within the part's neighbourhood, how far above the least.
    slope = max(float(np.abs(np.diff(grid.density, axis=k)).max(initial=0.0)) for k in range(3))
    value = np.minimum((grid.density - low) / slope, grid.depth / grid.step + BEYOND)
    value[np.abs(value) < 1e-6] = 1e-6  # a surface through a node would be pinched there
    if value.max() <= 0.0 or not (value[grid.inside] > 0.0).any():
        return None
    value = np.pad(value, 1, constant_values=-1.0)

    monitor.tick()
    points, triangles, _, _ = marching_cubes(value, 0.0)  # type: ignore[no-untyped-call]
    vertices = grid.start + grid.step * (np.asarray(points, float) - 1.0)
    mesh = TriangleMesh(vertices, np.ascontiguousarray(triangles, np.int32))
    if mesh.volume < 0.0:
        mesh = mesh.reversed()
    return as_manifold(mesh).simplify(SIMPLER * grid.step)

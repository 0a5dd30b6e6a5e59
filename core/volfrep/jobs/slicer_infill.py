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

from ..design.banded_infill import MOST, BandedInfill
from ..design.spec import LatticeSpec
from ..mesh.booleans import as_manifold, as_mesh
from ..mesh.triangle_mesh import TriangleMesh
from ..spatial.proximity import index_surface
from ..spatial.rays import inside_grid
from ..util.errors import VolfrepError
from ..util.progress import Monitor, ProgressCallback
from ..util.showing import Shown
from ..util.types import Bools, Floats

if TYPE_CHECKING:
    import manifold3d

#: Nodes of the grid that the field is looked at on.
NODES = 200_000
#: Bands reach so many grid steps beyond the part.
BEYOND = 1.2
#: No band that is to hold something is told less, %.
LEAST_DENSITY = 1.0
#: Planes in which the filament is added up, at most.
MOST_PLANES = 240
#: Bands' surfaces may move by this part of a grid step to have fewer triangles.
SIMPLER = 0.1
#: How a slicer lays a pattern, measured in PrusaSlicer 2.5 on boxes and a ball of 10 to 70 %: what
#: it lays in the middle over what it is told, at no density, and by how much more at 100 %; and how
#: wide a line along all sides the joined ends come to, as a share of a line's spacing.
LAID = {
    "gyroid": (0.985, -0.11, 0.25),
    "cubic": (1.0, 0.0, 0.25),
    "grid": (1.0, 0.0, 0.30),
    "triangles": (1.0, 0.0, 0.26),
    "line": (1.0, 0.0, 0.25),
}
#: Where lines lie farther apart than a band is wide, fewer ends are there to be joined: this share
#: where there are hardly any, and all from a width on of `1 - JOINED_APART` lines' distances. Of
#: boxes that leave 1.5 to 8 mm between their walls, told 3 to 40 %.
JOINED_APART = 0.45
#: Where less than this share of a density is told, the user is told why.
JOINED_MUCH = 0.75
_NARROW = " (narrow: joined ends of lines make up the rest)"
#: Slicers widen solid layers on slopes, where they are too narrow to be anchored, by so many lines
#: (PrusaSlicer's `discover_horizontal_shells`).
GROWN = 3.0
#: Shares of a stack of solid layers at which it is looked for the part's end.
_WITHIN_STACK = (0.25, 0.5, 0.75, 1.0)


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
        thresholds = _thresholds(grid, wanted.bands)
        cut = [(low, _band(grid, low, monitor)) for low in thresholds]
    with monitor.stage("filament", 0.7, 1.0):
        pieces = [piece for _, piece in cut if piece is not None]
        printed = _add_up(solid, wanted, pieces, monitor)
    means = _means(grid, thresholds, wanted)
    there = [None, *pieces]
    of_band = [0, *(k for k, (_, piece) in enumerate(cut, 1) if piece is not None)]
    bands = tuple(
        Band(
            means[of_band[k]], _slicer_density(means[of_band[k]], volume, border, wanted),
            volume, None if piece is None else as_mesh(piece),
        )
        for k, (piece, volume, border) in enumerate(
            zip(there, printed.sparse.tolist(), printed.borders.tolist(), strict=True)
        )
        if k == 0 or volume > 0.0
    )  # fmt: skip
    return SlicerInfill(solid, wanted, bands, printed.solid, material_density)


def _slicer_density(mean: float, volume: float, border: float, wanted: BandedInfill) -> float:
    """What a slicer is to be told so that it lays as much as a density wants, %, to a tenth.

    Args:
        mean: the density that is wanted, %.
        volume: of the sparse infill, mm3.
        border: area of its sides, mm2, along which the ends of lines are joined.
        wanted: the pattern, and the lines.
    """
    if not volume or not mean:
        return mean
    bulk, more, joined = LAID[wanted.pattern]
    sides = 100.0 * joined * wanted.spacing * border / volume
    width = 2.0 * volume / border if border else np.inf

    def laid(told: float) -> float:
        apart = JOINED_APART + width * told / 100.0 / wanted.spacing
        return (bulk + more * told / 100.0) * told + sides * min(apart, 1.0)

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


def _thresholds(grid: _Grid, bands: int) -> Floats:
    """(bands - 1,) least densities of the bands but the first, %; none of an even field."""
    within = grid.density[grid.inside]
    if not len(within):
        raise VolfrepError("The part is thinner everywhere than the grid that the field is cut on.")
    low, high = float(within.min()), float(within.max())
    if high - low < 0.1:  # a slicer is told tenths of a percent
        return np.zeros(0)
    return np.asarray(np.linspace(low, high, bands + 1)[1:-1])


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


@dataclass(frozen=True, eq=False)
class _Printed:
    """What a slicer prints.

    Attributes:
        solid: volume of walls and solid layers, mm3.
        sparse: (k + 1,) volume of the sparse infill in each band, mm3.
        borders: (k + 1,) area of the upright sides of each, mm2.
    """

    solid: float
    sparse: Floats
    borders: Floats


def _add_up(
    solid: TriangleMesh, wanted: BandedInfill, pieces: list[manifold3d.Manifold], monitor: Monitor
) -> _Printed:
    """What is printed of a part with k bands beside its own, plane by plane."""
    part = as_manifold(solid)
    low, high = solid.bounds[:, 2]
    layers = max(1, round((high - low) / wanted.layer))
    planes = min(layers, MOST_PLANES)
    depth = (high - low) / planes
    walls, sparse, borders = 0.0, np.zeros(len(pieces) + 1), np.zeros(len(pieces) + 1)
    for number in range(planes):
        monitor.tick(number / planes)
        z = low + depth * (number + 0.5)
        whole = part.slice(z)
        inner = fill = whole.offset(-wanted.wall_thickness) if wanted.walls else whole
        for count, way in ((wanted.top_layers, 1.0), (wanted.bottom_layers, -1.0)):
            for share in _WITHIN_STACK if count else ():
                inner = inner ^ part.slice(z + way * share * count * wanted.layer)
        if wanted.top_layers or wanted.bottom_layers:
            inner = inner - _grown(fill - inner, GROWN * wanted.line_width)
        walls += depth * float((whole - inner).area())
        for k, piece in enumerate([*pieces, None]):
            denser = inner ^ piece.slice(z) if piece is not None else None
            own = inner if denser is None else inner - denser
            sparse[k] += depth * float(own.area())
            borders[k] += depth * _perimeter(own)
            inner = denser
    return _Printed(float(walls), sparse, borders)


def _grown(solid: manifold3d.CrossSection, reach: float) -> manifold3d.CrossSection:
    """Where a slicer widens solid layers that are narrower than twice a reach, by as much."""
    return (solid - solid.offset(-reach).offset(reach)).offset(reach)


def _perimeter(section: manifold3d.CrossSection) -> float:
    """Length of the outlines, mm."""
    loops = section.to_polygons()
    return float(sum(np.linalg.norm(np.roll(p, -1, axis=0) - p, axis=1).sum() for p in loops))

# SPDX-License-Identifier: LGPL-2.1-or-later
"""The grid of cells over a domain, and which of its cells hold a lattice."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from .errors import VolfrepError
from .mapping import LatticeMap, triangles_in_lattice
from .mesh import TriangleMesh
from .progress import Monitor
from .ragged import spread

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

#: A grid of more cells than this would not fit into memory with its lattice.
MAX_CELLS = 200_000_000
#: Pairs of a triangle and a cell (or a column) that one vectorised step takes at a time.
PAIRS_PER_STEP = 1_000_000
_CENTRE = np.zeros((1, 3))
#: A cell that overlaps the domain by less than this, in units of L, only touches it from outside.
TOUCH_TOLERANCE = 1e-6


@dataclass(frozen=True, eq=False)
class CellGrid:
    """A regular grid of cubic cells.

    Attributes:
        origin: (3,) float64, lowest corner, mm.
        cell_size: L, mm.
        shape: cells along x, y, z (of lattice space, where that is not the part's own).
        periodic: axes along which the last cell is followed by the first one.
    """

    origin: Floats
    cell_size: float
    shape: tuple[int, int, int]
    periodic: tuple[bool, bool, bool] = (False, False, False)

    @property
    def cells(self) -> int:
        """How many cells the grid has."""
        return self.shape[0] * self.shape[1] * self.shape[2]

    def centres(self, axis: int) -> Floats:
        """Coordinates of the cells' centres along an axis, mm."""
        steps = np.arange(self.shape[axis]) + 0.5
        return np.asarray(self.origin[axis] + self.cell_size * steps, np.float64)


def make_grid(
    bounds: Floats, cell_size: float, origin: tuple[float, float, float] | Floats | None = None
) -> CellGrid:
    """The smallest grid that covers a box.

    Args:
        bounds: (2, 3) lowest and highest corner of the box, mm.
        cell_size: L, mm.
        origin: a point that is to be a cell's corner; None: the lowest corner of the box.

    Raises:
        VolfrepError: the grid would have more than `MAX_CELLS` cells.
    """
    low, high = np.asarray(bounds, float)
    if origin is not None:
        steps = np.floor((low - np.asarray(origin, float)) / cell_size + 1e-9)
        low = np.asarray(origin, float) + steps * cell_size
    wanted = np.maximum(np.ceil((high - low) / cell_size - 1e-9), 1)
    if wanted.prod() > MAX_CELLS:
        raise VolfrepError(
            f"Cells of {cell_size:g} mm would make a grid of {wanted.prod():.2g} cells: "
            f"the limit is {MAX_CELLS:.0e}; enlarge the cells."
        )
    return CellGrid(low, float(cell_size), (int(wanted[0]), int(wanted[1]), int(wanted[2])))


def mapped_grid(
    part: TriangleMesh,
    chart: LatticeMap,
    cell_size: float,
    origin: tuple[float, float, float] | None,
    monitor: Monitor,
) -> CellGrid:
    """The smallest grid in lattice space that covers a part.

    Args:
        part: closed mesh, mm.
        chart: the map; along its periodic axes the grid is the full turn.
        cell_size: L, mm.
        origin: a point of the part that is to be a cell's corner; None: the part's lowest corner
            in lattice space.
        monitor: for cancel.

    Raises:
        VolfrepError: the grid would have more than `MAX_CELLS` cells.
    """
    corners = triangles_in_lattice(part, chart)
    bounds = np.stack([corners.min(axis=(0, 1)), corners.max(axis=(0, 1))])
    if chart.base.kind != "cartesian" and inside_points(part, chart.to_part(_CENTRE), monitor)[0]:
        # Inside the part, there is no surface that would begin at radius 0.
        bounds[0, 0] = 0.0
    at = None if origin is None else chart.to_lattice(np.array([origin], float))[0]
    for axis in np.flatnonzero(chart.base.periodic):
        bounds[:, axis] = (0.0 if at is None else at[axis]) + np.array([0.0, chart.base.turn])
    grid = make_grid(bounds, cell_size, at)
    return replace(grid, periodic=chart.base.periodic)


def active_cells(
    grid: CellGrid,
    domain: TriangleMesh,
    rule: str,
    monitor: Monitor,
    chart: LatticeMap | None = None,
    usable: NDArray[np.bool_] | None = None,
) -> NDArray[np.bool_]:
    """Which cells of the grid hold a lattice.

    Args:
        grid: the cells.
        domain: closed mesh of what the lattice fills.
        rule: ``touching``: every cell that shares volume with the domain. ``centre``: cells
            whose centre lies inside it, less those without an active cell among their 26
            neighbours (Appendix A.1 of the VOLFREP paper). ``inside``: cells that share all
            their volume with it.
        monitor: for progress and cancel.
        chart: from lattice space to the part, where they differ.
        usable: (nx, ny, nz) bool, cells that may hold a lattice; None: all.

    Returns:
        (nx, ny, nz) bool.
    """
    monitor.tick(0.0)
    active = inside_cells(grid, domain, monitor, chart)
    if usable is not None:
        active &= usable
    if rule == "centre":
        from scipy import ndimage  # slow to import

        modes = ["wrap" if closed else "constant" for closed in grid.periodic]
        around = active.astype(np.int32)
        for axis, mode in enumerate(modes):
            around = ndimage.convolve1d(around, np.ones(3, int), axis=axis, mode=mode)
        return np.asarray(active & (around > 1), np.bool_)
    if rule not in ("touching", "inside"):
        raise VolfrepError(f"There is no activation '{rule}': choose touching, centre or inside.")
    crossed = crossed_cells(grid, wall_corners(domain, chart), monitor)
    if rule == "inside":
        return active & ~crossed
    return active | (crossed if usable is None else crossed & usable)


def wall_corners(mesh: TriangleMesh, chart: LatticeMap | None) -> Floats:
    """(m, 3, 3) corners of a mesh's triangles in lattice space."""
    if chart is None:
        return mesh.vertices[mesh.triangles]
    return triangles_in_lattice(mesh, chart)


def inside_cells(
    grid: CellGrid, domain: TriangleMesh, monitor: Monitor, chart: LatticeMap | None
) -> NDArray[np.bool_]:
    """(nx, ny, nz) bool, the cells whose centres lie inside a closed mesh."""
    x, y, z = (grid.centres(axis) for axis in range(3))
    if chart is None:
        return inside_grid(domain, x, y, z, monitor)
    centres = np.stack(np.meshgrid(x, y, z, indexing="ij"), axis=-1).reshape(-1, 3)
    return inside_points(domain, chart.to_part(centres), monitor).reshape(grid.shape)


def inside_points(mesh: TriangleMesh, points: Floats, monitor: Monitor) -> NDArray[np.bool_]:
    """(n,) bool, which points lie inside a closed, outward oriented mesh, by winding number.

    A line goes up from every point; points and triangles meet in the bins of a grid seen along z.
    Lines through vertices and edges, and points of the surface, count as in `column_crossings`.
    """
    winding = np.zeros(len(points), np.int64)
    corners = mesh.vertices[mesh.triangles]
    low, high = mesh.bounds
    within = np.flatnonzero(((points >= low) & (points < high)).all(axis=1))
    if not len(within):
        return winding > 0
    size = float(np.sqrt((high - low)[0] * (high - low)[1] / len(within)))
    columns = np.ceil((high - low)[:2] / size).astype(np.int64) + 1
    bins = np.floor((points[within, :2] - low[:2]) / size).astype(np.int64)
    number = bins[:, 0] * columns[1] + bins[:, 1]
    order = np.argsort(number, kind="stable")
    within, number = within[order], number[order]
    first = np.floor((corners[:, :, :2].min(axis=1) - low[:2]) / size).astype(np.int64)
    last = np.floor((corners[:, :, :2].max(axis=1) - low[:2]) / size).astype(np.int64)
    extent = last - first + 1
    for owner, place in _pairs(extent.prod(axis=1)):
        monitor.tick()
        own = (first[owner, 0] + place // extent[owner, 1]) * columns[1]
        own += first[owner, 1] + place % extent[owner, 1]
        begin = np.searchsorted(number, own)
        row, among = spread(np.searchsorted(number, own, "right") - begin)
        triangle, point = owner[row], within[begin[row] + among]
        hit, z, step = _crossings(corners[triangle], points[point, 0], points[point, 1])
        above = z > points[point[hit], 2]
        np.add.at(winding, point[hit][above], -step[above])
    return winding > 0


def inside_grid(
    mesh: TriangleMesh, xs: Floats, ys: Floats, zs: Floats, monitor: Monitor
) -> NDArray[np.bool_]:
    """Which nodes of a rectilinear grid lie inside a closed mesh, by winding number.

    Args:
        mesh: closed and outward oriented; its parts may overlap.
        xs: ascending coordinates of the nodes along x, mm.
        ys: the same along y.
        zs: the same along z.
        monitor: for cancel.

    Returns:
        (len(xs), len(ys), len(zs)) bool.
    """
    i, j, z, step = column_crossings(mesh, xs, ys, monitor)
    return fill_columns(i, j, z, step, (len(xs), len(ys)), zs)


def fill_columns(
    i: Ints, j: Ints, z: Floats, step: Ints, columns: tuple[int, int], zs: Floats
) -> NDArray[np.bool_]:
    """Whether the nodes at heights `zs` are inside, from the crossings of their columns."""
    winding = np.zeros((*columns, len(zs) + 1), np.int16)
    np.add.at(winding, (i, j, np.searchsorted(zs, z)), step.astype(np.int16))
    inside: NDArray[np.bool_] = np.cumsum(winding[:, :, :-1], axis=2, dtype=np.int16) > 0
    return inside


def column_crossings(
    mesh: TriangleMesh, xs: Floats, ys: Floats, monitor: Monitor
) -> tuple[Ints, Ints, Floats, Ints]:
    """Where lines along z through the points (xs[i], ys[j]) cross the mesh.

    A line through a vertex or an edge is taken as moved by an infinitely small amount, the same
    for every triangle, so that the crossings of a closed mesh always balance.

    Returns:
        i, j: indices of the column; z: height of the crossing, mm; step: +1 where a line going
        up enters, -1 where it leaves.
    """
    corners = mesh.vertices[mesh.triangles]
    low, high = corners.min(axis=1), corners.max(axis=1)
    first = np.stack([np.searchsorted(xs, low[:, 0]), np.searchsorted(ys, low[:, 1])], axis=1)
    last = np.stack(
        [np.searchsorted(xs, high[:, 0], "right"), np.searchsorted(ys, high[:, 1], "right")], axis=1
    )
    size = np.maximum(last - first, 0)
    found: list[tuple[Ints, Ints, Floats, Ints]] = []
    for owner, place in _pairs(size.prod(axis=1)):
        monitor.tick()
        i = first[owner, 0] + place // size[owner, 1]
        j = first[owner, 1] + place % size[owner, 1]
        hit, z, step = _crossings(corners[owner], xs[i], ys[j])
        found.append((i[hit], j[hit], z, step))
    if not found:
        none = np.zeros(0, np.int64)
        return none, none, np.zeros(0), none
    i, j, z, step = (np.concatenate(values) for values in zip(*found, strict=True))
    return i, j, z, step


def _crossings(corners: Floats, x: Floats, y: Floats) -> tuple[Ints, Floats, Ints]:
    """Which of n triangles (n, 3, 3) the lines through (x, y) cross, where, and in which sense."""
    side = np.empty((3, len(corners)))
    left = np.empty((3, len(corners)), bool)
    for k in range(3):
        side[k], left[k] = _side(corners[:, k], corners[:, (k + 1) % 3], x, y)
    up, down = left.all(axis=0), ~left.any(axis=0)
    hit = np.flatnonzero(up | down)
    weight = np.abs(side[:, hit])
    weight[:, weight.sum(axis=0) == 0] = 1.0
    height = corners[hit, :, 2]
    z = weight[1] * height[:, 0] + weight[2] * height[:, 1] + weight[0] * height[:, 2]
    z /= weight.sum(axis=0)
    return hit, z, np.where(up[hit], -1, 1)


def _side(a: Floats, b: Floats, x: Floats, y: Floats) -> tuple[Floats, NDArray[np.bool_]]:
    """Twice the area (a, b, point) seen along z, and whether the point lies left of a to b.

    Each edge is evaluated from its lesser end, so that the triangles that share it agree exactly;
    a point on the edge counts as moved by (e, e2) with e infinitely small.
    """
    turned = (a[:, 0] > b[:, 0]) | ((a[:, 0] == b[:, 0]) & (a[:, 1] > b[:, 1]))
    low = np.where(turned[:, None], b[:, :2], a[:, :2])
    along = np.where(turned[:, None], a[:, :2], b[:, :2]) - low
    side = along[:, 0] * (y - low[:, 1]) - along[:, 1] * (x - low[:, 0])
    moved = np.where(along[:, 1] != 0, along[:, 1] < 0, along[:, 0] > 0)
    left = (side > 0) | ((side == 0) & moved)
    return np.where(turned, -side, side), left ^ turned


def crossed_cells(
    grid: CellGrid, corners: Floats, monitor: Monitor, margin: float = -TOUCH_TOLERANCE
) -> NDArray[np.bool_]:
    """The cells that a triangle overlaps.

    Args:
        grid: the cells.
        corners: (m, 3, 3) of any triangles.
        monitor: for progress and cancel.
        margin: by which the cells are enlarged (or shrunk, where negative) first, in units of L.

    Returns:
        (nx, ny, nz) bool.
    """
    if any(grid.periodic):
        return _crossed_around(grid, corners, monitor, margin)
    crossed = np.zeros(grid.cells, bool)
    # In units of half a cell, about the first cell's centre.
    half = 0.5 * grid.cell_size * (1.0 + margin)
    pitch = grid.cell_size / half
    corners = (corners - grid.origin - 0.5 * grid.cell_size) / half
    shape = np.array(grid.shape)
    first = np.ceil((corners.min(axis=1) - 1.0) / pitch).astype(np.int64)
    last = np.floor((corners.max(axis=1) + 1.0) / pitch).astype(np.int64)
    first, last = np.maximum(first, 0), np.minimum(last, shape - 1)
    size = np.maximum(last - first + 1, 0)
    counts = size.prod(axis=1)
    total, done = max(int(counts.sum()), 1), 0
    for owner, place in _pairs(counts):
        monitor.tick(done / total)
        done += len(owner)
        box = size[owner]
        cell = first[owner] + np.stack(
            [
                place // (box[:, 1] * box[:, 2]),
                place // box[:, 2] % box[:, 1],
                place % box[:, 2],
            ],
            axis=1,
        )
        index = np.ravel_multi_index(tuple(cell.T), grid.shape)
        open_pairs = np.flatnonzero(~crossed[index])
        owner, cell, index = owner[open_pairs], cell[open_pairs], index[open_pairs]
        crossed[index[_overlap_unit_box(corners[owner] - (cell * pitch)[:, None])]] = True
    return crossed.reshape(grid.shape)


def _crossed_around(
    grid: CellGrid, corners: Floats, monitor: Monitor, margin: float
) -> NDArray[np.bool_]:
    """`crossed_cells` where the grid closes upon itself: three turns of it side by side."""
    shape, corners = list(grid.shape), corners.copy()
    origin = grid.origin.copy()
    for axis in np.flatnonzero(grid.periodic):
        turn = grid.shape[axis] * grid.cell_size
        begin = corners[:, :, axis].min(axis=1) - origin[axis]
        corners[:, :, axis] -= (turn * np.floor(begin / turn))[:, None]
        origin[axis] -= turn
        shape[axis] *= 3
    wide = CellGrid(origin, grid.cell_size, (shape[0], shape[1], shape[2]))
    crossed = crossed_cells(wide, corners, monitor, margin)
    for axis in np.flatnonzero(grid.periodic):
        crossed = np.logical_or.reduce(np.split(crossed, 3, axis=axis))
    return crossed


def _overlap_unit_box(corners: Floats) -> NDArray[np.bool_]:
    """Whether each triangle (n, 3, 3) overlaps the open box from -1 to 1.

    Separating axes: the triangle's plane and the cross products of its edges with the box's; the
    box's own axes were tested when the pair was chosen.
    """
    edges = np.roll(corners, -1, axis=1) - corners
    normal = np.cross(edges[:, 0], edges[:, 1])
    overlap: NDArray[np.bool_] = np.abs(np.einsum("ij,ij->i", normal, corners[:, 0])) < np.abs(
        normal
    ).sum(axis=1)
    flat = ~normal.any(axis=1)
    overlap[flat] = True  # no plane of its own: a segment, told apart by the other axes
    for e in range(3):
        for axis in range(3):
            b, c = (axis + 1) % 3, (axis + 2) % 3
            direction_b, direction_c = -edges[:, e, c], edges[:, e, b]
            reach = (
                corners[:, :, b] * direction_b[:, None] + corners[:, :, c] * direction_c[:, None]
            )
            radius = np.abs(direction_b) + np.abs(direction_c)
            apart = (reach.min(axis=1) >= radius) | (reach.max(axis=1) <= -radius)
            overlap &= ~(apart & (radius > 0))
    return overlap


def _pairs(counts: Ints) -> Iterator[tuple[Ints, Ints]]:
    """All (owner, place) pairs in steps of about `PAIRS_PER_STEP`."""
    total = np.cumsum(counts)
    start = 0
    while start < len(counts):
        base = total[start - 1] if start else 0
        stop = max(int(np.searchsorted(total, base + PAIRS_PER_STEP, "right")), start + 1)
        owner, place = spread(counts[start:stop])
        if len(owner):
            yield owner + start, place
        start = stop

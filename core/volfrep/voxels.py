# SPDX-License-Identifier: LGPL-2.1-or-later
"""The grid of cells over a domain, and which of its cells hold a lattice."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from .errors import VolfrepError
from .mesh import TriangleMesh
from .progress import Monitor
from .ragged import spread

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

#: A grid of more cells than this would not fit into memory with its lattice.
MAX_CELLS = 200_000_000
#: Pairs of a triangle and a cell (or a column) that one vectorised step takes at a time.
PAIRS_PER_STEP = 1_000_000
#: A cell that overlaps the domain by less than this, in units of L, only touches it from outside.
TOUCH_TOLERANCE = 1e-6


@dataclass(frozen=True, eq=False)
class CellGrid:
    """A regular grid of cubic cells.

    Attributes:
        origin: (3,) float64, lowest corner, mm.
        cell_size: L, mm.
        shape: cells along x, y, z.
    """

    origin: Floats
    cell_size: float
    shape: tuple[int, int, int]

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


def active_cells(
    grid: CellGrid, domain: TriangleMesh, rule: str, monitor: Monitor
) -> NDArray[np.bool_]:
    """Which cells of the grid hold a lattice.

    Args:
        grid: the cells.
        domain: closed mesh of what the lattice fills.
        rule: ``touching``: every cell that shares volume with the domain. ``centre``: cells
            whose centre lies inside it, less those without an active cell among their 26
            neighbours (Appendix A.1 of the VOLFREP paper).
        monitor: for progress and cancel.

    Returns:
        (nx, ny, nz) bool.
    """
    monitor.tick(0.0)
    active = inside_grid(domain, grid.centres(0), grid.centres(1), grid.centres(2), monitor)
    if rule == "centre":
        around = ndimage.convolve(active.astype(np.int32), np.ones((3, 3, 3), int), mode="constant")
        return np.asarray(active & (around > 1), np.bool_)
    if rule != "touching":
        raise VolfrepError(f"There is no activation '{rule}': choose touching or centre.")
    active |= crossed_cells(grid, domain, monitor)
    return active


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
        x, y = xs[i], ys[j]
        side = np.empty((3, len(owner)))
        left = np.empty((3, len(owner)), bool)
        for k in range(3):
            side[k], left[k] = _side(corners[owner, k], corners[owner, (k + 1) % 3], x, y)
        up, down = left.all(axis=0), ~left.any(axis=0)
        hit = np.flatnonzero(up | down)
        weight = np.abs(side[:, hit])
        weight[:, weight.sum(axis=0) == 0] = 1.0
        height = corners[owner[hit], :, 2]
        z = weight[1] * height[:, 0] + weight[2] * height[:, 1] + weight[0] * height[:, 2]
        z /= weight.sum(axis=0)
        found.append((i[hit], j[hit], z, np.where(up[hit], -1, 1)))
    if not found:
        none = np.zeros(0, np.int64)
        return none, none, np.zeros(0), none
    i, j, z, step = (np.concatenate(values) for values in zip(*found, strict=True))
    return i, j, z, step


def inside_points(mesh: TriangleMesh, points: Floats) -> NDArray[np.bool_]:
    """Which of (n, 3) scattered points lie inside a closed mesh, by winding number.

    A line up from a point crosses the triangles above it. A point on a line through a vertex or
    an edge counts as in `column_crossings`.
    """
    corners = mesh.vertices[mesh.triangles]
    low, high = corners.min(axis=1)[:, :2], corners.max(axis=1)[:, :2]
    top = corners[:, :, 2].max(axis=1)
    # Square bins seen along z: about as many as triangles, so that few triangles share one.
    origin = low.min(axis=0)
    span = np.maximum(high.max(axis=0) - origin, 1e-300)
    size = float(np.sqrt(span.prod() / len(corners))) or float(span.max())
    shape = np.minimum(np.ceil(span / size).astype(np.int64), len(corners)) + 1
    first = np.minimum(((low - origin) / size).astype(np.int64), shape - 1)
    last = np.minimum(((high - origin) / size).astype(np.int64), shape - 1)
    wide = last - first + 1
    triangle, place = spread(wide.prod(axis=1))
    column = first[triangle] + np.stack(np.divmod(place, wide[triangle, 1]), axis=1)
    bins = column[:, 0] * shape[1] + column[:, 1]
    order = np.argsort(bins, kind="stable")
    triangle = triangle[order]
    start = np.searchsorted(bins[order], np.arange(shape.prod() + 1))

    winding = np.zeros(len(points), np.int64)
    place = ((points[:, :2] - origin) / size).astype(np.int64)
    near = np.flatnonzero(((points[:, :2] >= origin) & (place < shape)).all(axis=1))
    here = place[near] @ np.array([shape[1], 1])
    for owner, step in _pairs(start[here + 1] - start[here]):
        point, facet = near[owner], triangle[start[here[owner]] + step]
        reaches = top[facet] > points[point, 2]
        point, facet = point[reaches], facet[reaches]
        x, y, z = points[point].T
        side, left = (
            np.stack(values)
            for values in zip(
                *(_side(corners[facet, k], corners[facet, (k + 1) % 3], x, y) for k in range(3)),
                strict=True,
            )
        )
        up, down = left.all(axis=0), ~left.any(axis=0)
        weight = np.abs(side)
        weight[:, weight.sum(axis=0) == 0] = 1.0
        height = corners[facet, :, 2]
        crossing = weight[1] * height[:, 0] + weight[2] * height[:, 1] + weight[0] * height[:, 2]
        above = crossing > z * weight.sum(axis=0)
        np.add.at(winding, point, np.where(above, up.astype(np.int64) - down, 0))
    return winding > 0


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
    grid: CellGrid, mesh: TriangleMesh, monitor: Monitor, margin: float = -TOUCH_TOLERANCE
) -> NDArray[np.bool_]:
    """The cells that a triangle of the mesh overlaps.

    Args:
        grid: the cells.
        mesh: any triangles.
        monitor: for progress and cancel.
        margin: by which the cells are enlarged (or shrunk, where negative) first, in units of L.

    Returns:
        (nx, ny, nz) bool.
    """
    crossed = np.zeros(grid.cells, bool)
    # In units of half a cell, about the first cell's centre.
    half = 0.5 * grid.cell_size * (1.0 + margin)
    pitch = grid.cell_size / half
    corners = (mesh.vertices[mesh.triangles] - grid.origin - 0.5 * grid.cell_size) / half
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

# SPDX-License-Identifier: LGPL-2.1-or-later
"""The grid of cells over a domain, and its active cells: those that hold a lattice.

A cell is active when it shares volume with the domain: the lattice inside then does not depend on
where activation ends. The paper's rule (centre inside) is `centre`.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from ..mesh.triangle_mesh import TriangleMesh, corners_at
from ..spatial.rays import inside_grid, inside_points
from ..util.errors import VolfrepError
from ..util.parallel import ParallelBackend
from ..util.progress import Monitor
from ..util.ragged import pairs_in_steps
from ..util.types import Floats, Ints
from .cell_grid import CellGrid
from .coordinate_map import CoordinateMap, triangles_in_lattice

#: A grid of more cells than this would not fit into memory with its lattice.
MAX_CELLS = 200_000_000
_CENTRE = np.zeros((1, 3))
#: A cell that overlaps the domain by less than this, in units of L, only touches it from outside.
TOUCH_TOLERANCE = 1e-6
#: Pairs of triangles and cells that may overlap, about, that a call looks at.
CALL_PAIRS = 1 << 18


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

    >>> grid = make_grid(np.array([[0, 0, 0], [25, 10, 10]], float), 10.0)
    >>> grid.shape, grid.centres(0).tolist()
    ((3, 1, 1), [5.0, 15.0, 25.0])
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
    mapping: CoordinateMap,
    cell_size: float,
    origin: tuple[float, float, float] | None,
    monitor: Monitor,
) -> CellGrid:
    """The smallest grid in lattice space that covers a part.

    Args:
        part: closed mesh, mm.
        mapping: the map; along its periodic axes the grid is the full turn.
        cell_size: L, mm.
        origin: a point of the part that is to be a cell's corner; None: the part's lowest corner
            in lattice space.
        monitor: for cancel.

    Raises:
        VolfrepError: the grid would have more than `MAX_CELLS` cells.
    """
    corners = triangles_in_lattice(part, mapping)
    bounds = np.stack([corners.min(axis=(0, 1)), corners.max(axis=(0, 1))])
    if (
        mapping.base.kind != "cartesian"
        and inside_points(part, mapping.to_part(_CENTRE), monitor)[0]
    ):
        # Inside the part, there is no surface that would begin at radius 0.
        bounds[0, 0] = 0.0
    at = None if origin is None else mapping.to_lattice(np.array([origin], float))[0]
    for axis in np.flatnonzero(mapping.base.periodic):
        bounds[:, axis] = (0.0 if at is None else at[axis]) + np.array([0.0, mapping.base.turn])
    grid = make_grid(bounds, cell_size, at)
    return replace(grid, periodic=mapping.base.periodic)


def active_cells(
    grid: CellGrid,
    domain: TriangleMesh,
    rule: str,
    monitor: Monitor,
    mapping: CoordinateMap | None = None,
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
        mapping: from lattice space to the part, where they differ.
        usable: (nx, ny, nz) bool, cells that may hold a lattice; None: all.

    Returns:
        (nx, ny, nz) bool.
    """
    monitor.tick(0.0)
    active = inside_cells(grid, domain, monitor, mapping)
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
    crossed = crossed_cells(grid, boundary_corners(domain, mapping), monitor)
    if rule == "inside":
        return active & ~crossed
    return active | (crossed if usable is None else crossed & usable)


def boundary_corners(mesh: TriangleMesh, mapping: CoordinateMap | None) -> Floats:
    """(m, 3, 3) corners of a mesh's triangles in lattice space."""
    if mapping is None:
        return corners_at(mesh.vertices, mesh.triangles)
    return triangles_in_lattice(mesh, mapping)


def inside_cells(
    grid: CellGrid, domain: TriangleMesh, monitor: Monitor, mapping: CoordinateMap | None
) -> NDArray[np.bool_]:
    """(nx, ny, nz) bool, the cells whose centres lie inside a closed mesh."""
    x, y, z = (grid.centres(axis) for axis in range(3))
    if mapping is None:
        return inside_grid(domain, x, y, z, monitor)
    centres = np.stack(np.meshgrid(x, y, z, indexing="ij"), axis=-1).reshape(-1, 3)
    return inside_points(domain, mapping.to_part(centres), monitor).reshape(grid.shape)


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
        return _find_crossed_around(grid, corners, monitor, margin)
    crossed = np.zeros(grid.cells, bool)
    # In units of half a cell, about the first cell's centre.
    half = 0.5 * grid.cell_size * (1.0 + margin)
    pitch = grid.cell_size / half
    corners = (corners - grid.origin - 0.5 * grid.cell_size) / half
    first = np.ceil((corners.min(axis=1) - 1.0) / pitch).astype(np.int64)
    last = np.floor((corners.max(axis=1) + 1.0) / pitch).astype(np.int64)
    first, last = np.maximum(first, 0), np.minimum(last, np.array(grid.shape) - 1)
    size = np.maximum(last - first + 1, 0)
    total = np.cumsum(size.prod(axis=1))
    near = int(total[-1]) if len(total) else 0
    cuts = np.unique(np.searchsorted(total, np.arange(0, near, CALL_PAIRS), "right"))
    backend = monitor.backend if near > CALL_PAIRS else ParallelBackend()
    calls = (
        (corners[start:stop], first[start:stop], size[start:stop], pitch, grid.shape)
        for start, stop in pairwise([*cuts.tolist(), len(corners)])
    )
    for done, cells in enumerate(backend.starmap(_crossed_by, calls)):
        crossed[cells] = True
        monitor.tick((done + 1) / len(cuts))
    return crossed.reshape(grid.shape)


def _crossed_by(
    corners: Floats, first: Ints, size: Ints, pitch: float, shape: tuple[int, int, int]
) -> Ints:
    """The cells that triangles overlap, by their places in the flat grid, ascending.

    Args:
        corners: (m, 3, 3) about the first cell's centre, in units of half a cell.
        first: (m, 3) the lowest cell that each may overlap.
        size: (m, 3) how many these are along each axis.
        pitch: from cell to cell.
        shape: of the grid.
    """
    crossed = np.zeros(np.prod(shape), bool)
    for owner, place in pairs_in_steps(size.prod(axis=1)):
        box = size[owner]
        cell = first[owner] + np.stack(
            [
                place // (box[:, 1] * box[:, 2]),
                place // box[:, 2] % box[:, 1],
                place % box[:, 2],
            ],
            axis=1,
        )
        index = np.ravel_multi_index(tuple(cell.T), shape)
        open_pairs = np.flatnonzero(~crossed[index])
        owner, cell, index = owner[open_pairs], cell[open_pairs], index[open_pairs]
        crossed[index[_overlap_unit_box(corners[owner] - (cell * pitch)[:, None])]] = True
    return np.flatnonzero(crossed)


def _find_crossed_around(
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

    Separating axes (T. Akenine-Möller, "Fast 3D triangle-box overlap testing", J. Graphics Tools 6,
    2001): the triangle's plane and the cross products of its edges with the box's; the box's own
    axes were tested when the pair was chosen.
    """
    # A column for every coordinate of every corner: numpy takes rows of three slowly.
    at = [[np.ascontiguousarray(corners[:, k, axis]) for axis in range(3)] for k in range(3)]
    edges = [[q - p for p, q in zip(at[k], at[(k + 1) % 3], strict=True)] for k in range(3)]
    e, f = edges[:2]
    normal = [e[i] * f[j] - e[j] * f[i] for i, j in ((1, 2), (2, 0), (0, 1))]
    away = np.abs(sum(along * x for along, x in zip(normal, at[0], strict=True)))
    reached = sum(np.abs(along) for along in normal)
    # One without a plane of its own is a segment, told apart by the other axes.
    overlap: NDArray[np.bool_] = (away < reached) | (reached == 0.0)
    rows = np.flatnonzero(overlap)
    at = [[column[rows] for column in corner] for corner in at]
    left = np.ones(len(rows), bool)
    for edge in edges:
        edge = [column[rows] for column in edge]
        for axis in range(3):
            b, c = (axis + 1) % 3, (axis + 2) % 3
            reach = [corner[c] * edge[b] - corner[b] * edge[c] for corner in at]
            radius = np.abs(edge[b]) + np.abs(edge[c])
            least = np.minimum(np.minimum(reach[0], reach[1]), reach[2])
            most = np.maximum(np.maximum(reach[0], reach[1]), reach[2])
            left &= ~(((least >= radius) | (most <= -radius)) & (radius > 0))
    overlap[rows] = left
    return overlap

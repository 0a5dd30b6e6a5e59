# SPDX-License-Identifier: LGPL-2.1-or-later
"""Padded cell grid: a graded lattice with cells about the active ones, and its octants deformed.

A lattice that a wall cuts is laid as part of one without end: at its joints, struts of cells beyond
the active ones count, too, and the padding holds these cells.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ..design.cells import UnitCell, joint_radius
from ..design.spec_parts import Struts
from ..grid.cell_grid import CellGrid
from ..grid.coordinate_map import CoordinateMap, identity_map
from ..grid.node_frames import NodeFrames, node_frames
from ..grid.placement import Placement, node_radii
from ..grid.strut_graph import CellGraph, cell_graph
from ..octants.octant import ALL_ACTIVE, OctantGrid, OctantKey, octant_grid, octant_mirrors
from ..octants.octant_spec import OctantSpec
from ..util.linalg import axes_across
from ..util.progress import Monitor
from ..util.types import Bools, Floats
from .assembly import Layout, coordinates
from .deform import Deformed, deform
from .strut_binding import bind, crease

#: Cells about the active ones whose struts may matter at a joint of the lattice.
SUPPORT = 3
#: Cells squeezed to less than this times what leaves their struts room hold no lattice; and
#: where struts are deformed with their cells, to less than that of L.
SPARE = 1.15
LEAST_WIDTH_STRETCHED = 0.25
#: Widths of a cell that are tried in turn, in units of L, and rulings round a strut.
WIDTHS = np.linspace(1.0, 0.15, 18)
RULINGS = 24


def least_width(cell: UnitCell, cell_size: float, struts: Struts) -> float:
    """The width, in units of L, below which a cell that is squeezed holds no lattice."""
    if struts.keep_radius:
        return SPARE * narrowest(cell, cell_size, struts.extremes[1])
    return LEAST_WIDTH_STRETCHED


def endless_kinds(cell: UnitCell) -> list[OctantKey]:
    """The kinds of octant in a lattice without end."""
    mirrors = 1 if cell.is_mirror_symmetric else 8
    return [OctantKey(mirror, ALL_ACTIVE) for mirror in range(mirrors)]


def usable_cells(cells: CellGrid, mapping: CoordinateMap | None, least: float) -> Bools | None:
    """(nx, ny, nz) bool, cells about an axis or centre at least so wide; None: all are."""
    if mapping is None or mapping.base.kind == "cartesian":
        return None
    index = np.stack(np.meshgrid(*(np.arange(n + 1) for n in cells.shape), indexing="ij"), axis=-1)
    inside = cells.origin + cells.cell_size * index
    beyond = inside[..., 0] < -1e-9 * cells.cell_size
    if mapping.base.kind == "spherical":
        slack = 1e-9 * mapping.base.turn
        beyond |= (inside[..., 1] < -slack) | (inside[..., 1] > 0.5 * mapping.base.turn + slack)
    placed = mapping.to_part(inside.reshape(-1, 3)).reshape(inside.shape)
    usable: Bools = np.ones(cells.shape, bool)
    for axis in range(3):
        edge = np.linalg.norm(np.diff(placed, axis=axis), axis=3)
        wide = edge >= least * cells.cell_size
        for other in (k for k in range(3) if k != axis):
            wide = _both(wide, other)
        usable &= wide
        beyond = ~_both(~beyond, axis)
    return np.asarray(usable & ~beyond)


def _both(values: Bools, axis: int) -> Bools:
    """Where an entry and the one after it along an axis are both true."""
    count = values.shape[axis]
    return np.take(values, range(count - 1), axis) & np.take(values, range(1, count), axis)


def narrowest(cell: UnitCell, cell_size: float, radius: float) -> float:
    """The least width, in units of L, that a cell squeezed along one axis leaves its struts room.

    Struts have room where the rulings of every one leave its joints before its middle.
    """
    graph = cell_graph(cell, np.ones((3, 3, 3), bool), cell_size, np.zeros(3))
    middle = graph.node_of[graph.row[1, 1, 1]][cell.struts]
    start, end = middle.ravel(), middle[:, ::-1].ravel()
    angle = 2.0 * np.pi * np.arange(RULINGS) / RULINGS
    least = 1.0
    for width in WIDTHS:
        for axis in range(3):
            squeezed = graph.nodes.copy()
            squeezed[:, axis] *= width
            nodes = node_frames(graph, squeezed, np.full(len(squeezed), radius), cell_size)
            if not _has_room(nodes, start, end, angle, joint_radius(radius, cell_size)):
                return least
        least = float(width)
    return least


def _has_room(
    nodes: NodeFrames, start: NDArray[np.int32], end: NDArray[np.int32], angle: Floats, joint: float
) -> bool:
    span = nodes.points[end] - nodes.points[start]
    length = np.linalg.norm(span, axis=1)
    axis = span / length[:, None]
    first, second = axes_across(axis)
    radial = np.cos(angle)[:, None, None] * first + np.sin(angle)[:, None, None] * second
    count = len(angle)
    ends = np.tile(nodes.neighbours[start], (count, 1))
    begin = crease(
        np.tile(axis, (count, 1)), radial.reshape(-1, 3), np.tile(nodes.radius[start], count),
        np.zeros(count * len(start)), np.full(count * len(start), joint),
        np.tile(nodes.directions[start], (count, 1, 1)), np.zeros(ends.shape),
        (ends >= 0) & (ends != np.tile(end, count)[:, None]),
    )  # fmt: skip
    return bool((begin < 0.5 * np.tile(length, count)).all())


@dataclass(frozen=True, eq=False)
class PaddedGrid:
    """The part's cell grid with `SUPPORT` more cells on every side where it does not close.

    Attributes:
        cells: the part's grid.
        first: (3,) cells that were added before it.
        usable: (nx, ny, nz) bool, all the cells, those added included; None: all can be used.
    """

    cells: CellGrid
    first: tuple[int, int, int]
    usable: Bools | None

    @property
    def inner_usable(self) -> Bools | None:
        """`usable` of the part's grid."""
        return None if self.usable is None else self.usable[self._inner(1)]

    @property
    def octants_usable(self) -> Bools | None:
        """(nx, ny, nz) bool, the octants of the part's grid and half a cell about it that lie in
        usable cells; None: all do.
        """
        return None if self.usable is None else self._octants_in(self.usable)

    def _octants_in(self, whole: Bools) -> Bools:
        """(nx, ny, nz) bool, the octants of the part's grid and half a cell about it that lie in
        some of all the cells.
        """
        for axis, width in enumerate(self.first):
            pad = [(1, 1) if k == axis and not width else (0, 0) for k in range(3)]
            whole = np.pad(whole, pad, mode="wrap")
        twice = whole.repeat(2, axis=0).repeat(2, axis=1).repeat(2, axis=2)
        cut = []
        for axis, width in enumerate(self.first):
            # Octants go in twos about corners: the first one lies before the first cell.
            start = 2 * width - 1 if width else 1
            count = 2 * self.cells.shape[axis] + (2 if width else 0)
            cut.append(slice(start, start + count))
        return twice[tuple(cut)]

    def _inner(self, per_cell: int) -> tuple[slice, ...]:
        return tuple(slice(per_cell * n, -per_cell * n or None) for n in self.first)

    def octants(self, cell: UnitCell, active: Bools, endless: bool) -> OctantGrid:
        """The octants of the active cells; or of all, as of a lattice without end."""
        cells, size = self.cells, self.cells.cell_size
        if not endless:
            return octant_grid(cell, active, size, cells.origin, cells.periodic)
        if self.usable is not None:
            # The grid that reaches beyond, without the octants beyond, nor those on the far side
            # of cells that cannot be used: the graph has none of their struts.
            grid = octant_grid(cell, self.usable, size, cells.origin, cells.periodic)
            near = self._octants_in(self._around(active, SUPPORT - 1))
            kind = np.where(near, grid.kind[self._inner(2)], np.int16(-1))
            return replace(grid, kind=kind)
        open_ends = zip(active.shape, cells.periodic, strict=True)
        nx, ny, nz = (2 * n + (0 if closed else 2) for n, closed in open_ends)
        symmetric, keys = cell.is_mirror_symmetric, endless_kinds(cell)
        kind = np.zeros((nx, ny, nz)) if symmetric else octant_mirrors((nx, ny, nz))
        return OctantGrid(
            keys, kind.astype(np.int16), cells.origin, size, symmetric, cells.periodic
        )

    def graph(self, cell: UnitCell, active: Bools, endless: bool) -> CellGraph:
        """The graph of all the cells whose struts the octants of the active ones are bound to."""
        wide = self._around(active, SUPPORT if endless else 0)
        if endless and self.usable is not None:
            wide &= self.usable
        origin = self.cells.origin - self.cells.cell_size * np.array(self.first)
        return cell_graph(cell, wide, self.cells.cell_size, origin, self.cells.periodic, self.first)

    def _around(self, active: Bools, steps: int) -> Bools:
        """All the cells, true for active ones of the part's grid and so many about them."""
        wide = active
        for axis, added in enumerate(self.first):
            pad = [(SUPPORT, SUPPORT) if k == axis else (0, 0) for k in range(3)]
            wide = np.pad(wide, pad, mode="constant" if added else "wrap")
        if steps:
            from scipy import ndimage  # slow to import

            wide = ndimage.binary_dilation(wide, np.ones((3, 3, 3), bool), steps)
        return wide[tuple(slice(None) if n else slice(SUPPORT, -SUPPORT) for n in self.first)]


def padded_grid(cells: CellGrid, mapping: CoordinateMap | None, least: float) -> PaddedGrid:
    """Pad the cell grid of a part.

    Args:
        cells: the part's grid.
        mapping: from lattice space to the part; None where they are the same.
        least: width in units of L of the narrowest cell that holds a lattice, about an axis or a
            centre (`least_width`).
    """
    x, y, z = (0 if closed else SUPPORT for closed in cells.periodic)
    nx, ny, nz = (n + 2 * extra for n, extra in zip(cells.shape, (x, y, z), strict=True))
    origin = cells.origin - cells.cell_size * np.array([x, y, z])
    wide = CellGrid(origin, cells.cell_size, (nx, ny, nz), cells.periodic)
    return PaddedGrid(cells, (x, y, z), usable_cells(wide, mapping, least))


def keeps_places(struts: Struts, placement: Placement) -> bool:
    """Whether the vertices of octants keep their places in lattice space."""
    rigid = placement.mapping is None or placement.mapping.is_rigid
    return not struts.is_graded and (rigid or not struts.keep_radius)


def vertices_of(
    layout: Layout,
    graph: Callable[[], CellGraph],
    cell: UnitCell,
    struts: Struts,
    octant_spec: OctantSpec,
    placement: Placement,
    monitor: Monitor,
) -> Deformed:
    """Where the vertices of the assembled octants are in the part, nudged as its wireframe is.

    Args:
        layout: the numbered octants.
        graph: gives the nodes and struts that they hang on.
        cell: the unit cell.
        struts: how thick they are.
        octant_spec: what the octants were meshed for.
        placement: where the lattice lies.
        monitor: for progress and cancel.

    Raises:
        VolfrepError: struts grow into each other; the text says where.
    """
    mapping = placement.mapping or identity_map(placement.cell_size)
    if keeps_places(struts, placement):
        inside = coordinates(layout, monitor)
        inside = inside if placement.mapping is None else mapping.to_part(inside)
        return Deformed(placement.nudged(inside), 0.0)
    own = graph()
    placed = mapping.to_part(own.nodes)
    radius = node_radii(struts, placed, placement)
    turn = np.where(mapping.base.periodic, mapping.base.turn, np.inf)
    if struts.keep_radius and not mapping.is_rigid:
        bends = mapping.jacobians(own.nodes)
        nodes = node_frames(own, placed, radius, placement.cell_size, bends, turn)
    else:
        nodes = node_frames(own, own.nodes, radius, placement.cell_size, None, turn)
    bindings = {
        key: bind(cell, octant_spec, key, layout.octants[key])
        for key, place in zip(layout.grid.keys, layout.places, strict=True)
        if len(place) and len(layout.octants[key].vertices)
    }
    moved = deform(layout, bindings, cell, nodes, mapping, struts.fillet, monitor)
    if placement.is_cut:
        for along, step in zip(moved.vertices.T, placement.nudged(np.zeros(3)), strict=True):
            along += step  # where they are: a copy would take as much memory again
    return moved

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where the nodes of a graded lattice lie, how thick its struts are, and its octants laid there."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from .anchors import anchor, crease
from .cells import UnitCell
from .conform import Conformed, conform
from .errors import VolfrepError
from .frep import Floats, joint_radius
from .grading import lattice_map
from .joints import Joints, joints
from .lattice import Layout, OctantGrid, coordinates, octant_grid
from .mapping import LatticeMap, identity_map, mapped_box
from .mesh import TriangleMesh
from .octant import ALL_ACTIVE, OPEN, OctantKey, octant_mirrors
from .progress import Monitor
from .spec import LatticeSpec
from .tile import TileSpec
from .voxels import CellGrid, inside_points
from .wireframe import CellGraph, Wireframe, cell_graph, wireframe

Bools = NDArray[np.bool_]

#: Cells about the active ones whose struts may matter at a joint of the lattice.
SUPPORT = 3
#: Cells squeezed to less than this times what leaves their struts room hold no lattice; and
#: where struts are deformed with their cells, to less than that of L.
SPARE = 1.15
LEAST_WIDTH_STRETCHED = 0.25
#: Widths of a cell that are tried in turn, in units of L, and rulings round a strut.
WIDTHS = np.linspace(1.0, 0.15, 18)
RULINGS = 24


@dataclass(frozen=True, eq=False)
class Setting:
    """What a graded lattice is laid in.

    Attributes:
        chart: from lattice space to the part; None where they are the same.
        bounds: (2, 3) box that directions are measured in, mm.
        depth: gives the depth of (n, 3) points below the part's surface, mm; 0 outside.
    """

    chart: LatticeMap | None
    bounds: Floats
    depth: Callable[[Floats], Floats]


def setting(solid: TriangleMesh, spec: LatticeSpec, monitor: Monitor) -> Setting:
    """The setting of a lattice inside a solid."""

    def depth(points: Floats) -> Floats:
        inside = inside_points(solid, points, monitor)
        result = np.zeros(len(points))
        from .distance import closest_points  # slow to import

        result[inside] = monitor.call(lambda: closest_points(solid, points[inside])[1])
        return result

    return Setting(part_map(spec, solid.bounds), solid.bounds, depth)


def part_map(spec: LatticeSpec, bounds: Floats) -> LatticeMap | None:
    """The map of a lattice that fills a part; None where lattice space is the part's own."""
    chart = lattice_map(spec.cell_size, bounds, spec.size_grading, spec.cell_map, spec.orientation)
    return None if chart.is_identity else chart


def block_setting(spec: LatticeSpec, shape: tuple[int, int, int]) -> tuple[CellGrid, Setting]:
    """The grid and the setting of a free-standing block of so many cells.

    About an axis or a centre, the block is a full turn: as many cells along the angle as the map
    has around, as wide as L half-way out.

    Raises:
        VolfrepError: the block does not close, or is not what a radius can be graded by.
    """
    size, extent = spec.cell_size, np.array(shape) * spec.cell_size
    origin = np.array(spec.origin or (0.0, 0.0, 0.0), float)
    cells, periodic = spec.cell_map, OPEN
    if cells is not None:
        axis = 1 if cells.kind == "cylindrical" else 2
        around = shape[axis] if cells.around is None else cells.around
        if around != shape[axis]:
            raise VolfrepError(
                f"A {cells.kind} block closes upon itself: give as many cells along axis "
                f"{axis + 1} as around, {around} and not {shape[axis]}."
            )
        cells = replace(cells, around=around)
        periodic = (False, axis == 1, axis == 2)
        turn = around * size
        origin = np.array([max(turn / (2.0 * np.pi) - 0.5 * extent[0], 0.5 * size), 0.0, 0.0])
        if axis == 2:
            if 2 * shape[1] > around - 2:
                raise VolfrepError(
                    f"A spherical block of {around} cells around has room for at most "
                    f"{(around - 2) // 2} from pole to pole, not {shape[1]}."
                )
            origin[1] = 0.25 * turn - 0.5 * extent[1]
    bounds = np.stack([origin, origin + extent])
    chart = lattice_map(size, bounds, spec.size_grading, cells, spec.orientation, block=True)
    box = mapped_box(chart.to_part, bounds)

    def depth(points: Floats) -> Floats:
        raise VolfrepError(
            "A block in free space has no skin to grade the radius by: grade it along a direction "
            "or by a field."
        )

    grid = CellGrid(origin, size, shape, periodic)
    return grid, Setting(None if chart.is_identity else chart, box, depth)


def node_radii(spec: LatticeSpec, points: Floats, where: Setting) -> Floats:
    """(n,) radius of the struts at points of the part, mm."""
    if spec.radius_grading is None:
        return np.full(len(points), float(spec.strut_radius))
    return spec.radius_grading.radii(points, where.bounds, where.depth)


def graded_wireframe(graph: CellGraph, spec: LatticeSpec, where: Setting) -> Wireframe:
    """The lattice as a graph in the part.

    Struts that are deformed with their cells are given the radius of a circle of their section.
    """
    chart = where.chart
    points = graph.nodes if chart is None else chart.to_part(graph.nodes)
    radius = node_radii(spec, points, where)
    result = wireframe(graph, points, radius, spec.cell_size)
    if chart is None or chart.is_rigid or spec.keep_radius:
        return result
    jacobian = chart.jacobians(graph.nodes)
    volume = np.linalg.det(jacobian)
    span = graph.nodes[graph.struts[:, 1]] - graph.nodes[graph.struts[:, 0]]
    for axis in np.flatnonzero(chart.base.periodic):
        span[:, axis] -= chart.base.turn * np.round(span[:, axis] / chart.base.turn)
    span /= np.linalg.norm(span, axis=1)[:, None]
    longer = np.linalg.norm(np.einsum("meij,mj->mei", jacobian[graph.struts], span), axis=2)
    radii = result.radii * np.sqrt(volume[graph.struts] / longer)
    joint = result.joint_radii * np.cbrt(volume)
    return Wireframe(points, graph.struts, radii, joint)


def usable_cells(
    cells: CellGrid, cell: UnitCell, spec: LatticeSpec, where: Setting
) -> Bools | None:
    """(nx, ny, nz) bool, cells about an axis or centre that are wide enough; None: all are."""
    chart = where.chart
    if chart is None or chart.base.kind == "cartesian":
        return None
    least = LEAST_WIDTH_STRETCHED
    if spec.keep_radius:
        least = SPARE * narrowest(cell, spec.cell_size, spec.radius_extremes[1])
    index = np.stack(np.meshgrid(*(np.arange(n + 1) for n in cells.shape), indexing="ij"), axis=-1)
    inside = cells.origin + cells.cell_size * index
    beyond = inside[..., 0] < -1e-9 * cells.cell_size
    if chart.base.kind == "spherical":
        slack = 1e-9 * chart.base.turn
        beyond |= (inside[..., 1] < -slack) | (inside[..., 1] > 0.5 * chart.base.turn + slack)
    placed = chart.to_part(inside.reshape(-1, 3)).reshape(inside.shape)
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
            nodes = joints(graph, squeezed, np.full(len(squeezed), radius), cell_size)
            if not _has_room(nodes, start, end, angle, joint_radius(radius, cell_size)):
                return least
        least = float(width)
    return least


def _has_room(
    nodes: Joints, start: NDArray[np.int32], end: NDArray[np.int32], angle: Floats, joint: float
) -> bool:
    span = nodes.points[end] - nodes.points[start]
    length = np.linalg.norm(span, axis=1)
    axis = span / length[:, None]
    aside = np.eye(3)[np.abs(axis).argmin(axis=1)]
    first = np.cross(axis, aside)
    first /= np.linalg.norm(first, axis=1)[:, None]
    second = np.cross(axis, first)
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
class Ground:
    """The cells that a lattice may be laid on, some way beyond the part's.

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

    def _inner(self, per_cell: int) -> tuple[slice, ...]:
        return tuple(slice(per_cell * n, -per_cell * n or None) for n in self.first)

    def octants(self, cell: UnitCell, active: Bools, endless: bool) -> OctantGrid:
        """The octants of the active cells; or of all, as of a lattice without end."""
        cells, size = self.cells, self.cells.cell_size
        if not endless:
            return octant_grid(cell, active, size, cells.origin, cells.periodic)
        if self.usable is not None:
            # The grid that reaches beyond, without the octants beyond.
            grid = octant_grid(cell, self.usable, size, cells.origin, cells.periodic)
            return replace(grid, kind=grid.kind[self._inner(2)])
        open_ends = zip(active.shape, cells.periodic, strict=True)
        nx, ny, nz = (2 * n + (0 if closed else 2) for n, closed in open_ends)
        if cell.is_mirror_symmetric:
            kind, keys = np.zeros((nx, ny, nz), np.int16), [OctantKey(0, ALL_ACTIVE)]
        else:
            kind = octant_mirrors((nx, ny, nz)).astype(np.int16)
            keys = [OctantKey(mirror, ALL_ACTIVE) for mirror in range(8)]
        symmetric = cell.is_mirror_symmetric
        return OctantGrid(keys, kind, cells.origin, size, symmetric, cells.periodic)

    def graph(self, cell: UnitCell, active: Bools, endless: bool) -> CellGraph:
        """The graph of all the cells whose struts the octants of the active ones hang on."""
        around = [(n, n) if n else (SUPPORT, SUPPORT) for n in self.first]
        wide = active
        for axis, width in enumerate(around):
            pad = [width if k == axis else (0, 0) for k in range(3)]
            wide = np.pad(wide, pad, mode="constant" if self.first[axis] else "wrap")
        if endless:
            from scipy import ndimage  # slow to import

            wide = ndimage.binary_dilation(wide, np.ones((3, 3, 3), bool), SUPPORT)
        wide = wide[tuple(slice(None) if n else slice(SUPPORT, -SUPPORT) for n in self.first)]
        if endless and self.usable is not None:
            wide &= self.usable
        origin = self.cells.origin - self.cells.cell_size * np.array(self.first)
        return cell_graph(cell, wide, self.cells.cell_size, origin, self.cells.periodic, self.first)


def ground(cells: CellGrid, cell: UnitCell, spec: LatticeSpec, where: Setting) -> Ground:
    """What a lattice on the cells of a part's grid is laid on."""
    x, y, z = (0 if closed else SUPPORT for closed in cells.periodic)
    nx, ny, nz = (n + 2 * extra for n, extra in zip(cells.shape, (x, y, z), strict=True))
    origin = cells.origin - cells.cell_size * np.array([x, y, z])
    wide = CellGrid(origin, cells.cell_size, (nx, ny, nz), cells.periodic)
    return Ground(cells, (x, y, z), usable_cells(wide, cell, spec, where))


def keeps_places(spec: LatticeSpec, where: Setting) -> bool:
    """Whether the vertices of octants keep their places in lattice space."""
    rigid = where.chart is None or where.chart.is_rigid
    return spec.radius_grading is None and (rigid or not spec.keep_radius)


def vertices_of(
    layout: Layout,
    graph: Callable[[], CellGraph],
    cell: UnitCell,
    spec: LatticeSpec,
    tile: TileSpec,
    where: Setting,
    monitor: Monitor,
) -> Conformed:
    """Where the vertices of the laid octants are in the part.

    Args:
        layout: the numbered octants.
        graph: gives the nodes and struts that they hang on.
        cell: the unit cell.
        spec: what is wanted.
        tile: what the octants were meshed for.
        where: the setting.
        monitor: for progress and cancel.

    Raises:
        VolfrepError: struts grow into each other; the text says where.
    """
    chart = where.chart or identity_map(spec.cell_size)
    if keeps_places(spec, where):
        inside = coordinates(layout, monitor)
        return Conformed(inside if where.chart is None else chart.to_part(inside), 0.0)
    own = graph()
    placed = chart.to_part(own.nodes)
    radius = node_radii(spec, placed, where)
    turn = np.where(chart.base.periodic, chart.base.turn, np.inf)
    if spec.keep_radius and not chart.is_rigid:
        bends = chart.jacobians(own.nodes)
        nodes = joints(own, placed, radius, spec.cell_size, bends, turn)
    else:
        nodes = joints(own, own.nodes, radius, spec.cell_size, None, turn)
    anchors = {
        key: anchor(cell, tile, key, layout.octants[key])
        for key, place in zip(layout.grid.keys, layout.places, strict=True)
        if len(place) and len(layout.octants[key].vertices)
    }
    return conform(layout, anchors, cell, nodes, chart, spec.fillet, monitor)

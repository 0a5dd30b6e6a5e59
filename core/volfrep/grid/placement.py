# SPDX-License-Identifier: LGPL-2.1-or-later
"""Placement of the lattice in the part: coordinate map, box, depth function, nudge.

And what follows from it: the nodes' places in the part, and their radii.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ..design.grading import RadiusGrading
from ..design.spec_parts import Grid, Struts
from ..mesh.triangle_mesh import TriangleMesh
from ..util.errors import VolfrepError
from ..util.linalg import determinants
from ..util.progress import Monitor
from ..util.types import OPEN, Floats
from .cell_grid import CellGrid
from .coordinate_map import CoordinateMap, lattice_map, mapped_box
from .motion import Motion
from .strut_graph import CellGraph, Wireframe, wireframe

#: A lattice that a wall cuts is moved by this, in units of L. Parts and walls like round numbers,
#: and so do cells: where a wall lies in a plane of the cells' own, struts would touch it along
#: lines and leave edges of four triangles. No printer or solver sees two microns in 10 mm.
NUDGE = np.array([2.1e-4, 1.3e-4, 1.7e-4])
#: Points are the same within this part of the solid's size, and depths of no more are kept.
SAME_POINT, MOST_KEPT = 1e-12, 1 << 19


@dataclass(frozen=True, eq=False)
class Placement:
    """Where a lattice lies in its part: what takes a point of lattice space to one of the part.

    Attributes:
        cell_size: L, mm.
        mapping: from lattice space to the part; None where they are the same.
        bounds: (2, 3) box that directions are measured in, mm.
        depth: gives the depth of (n, 3) points below the part's surface, mm; 0 outside.
        is_cut: whether a wall cuts the lattice, which is then moved a little (`NUDGE`).
    """

    cell_size: float
    mapping: CoordinateMap | None
    bounds: Floats
    depth: Callable[[Floats], Floats]
    is_cut: bool = False

    @property
    def motion(self) -> Motion | None:
        """What takes lattice space to the part, if that is a rigid motion."""
        shift = self.nudged(np.zeros(3))
        if self.mapping is None:
            return Motion(shift)
        if not self.mapping.is_rigid:
            return None
        return Motion(shift, self.mapping.base.frame, self.mapping.base.centre)

    def nudged(self, points: Floats) -> Floats:
        """(n, 3) places of vertices or nodes in the part, moved as the whole lattice is, mm."""
        return points + NUDGE * self.cell_size if self.is_cut else points


def placement_in(solid: TriangleMesh, grid: Grid, is_cut: bool, monitor: Monitor) -> Placement:
    """Where a lattice lies inside a solid, whose wall or skin cuts it or not."""
    depth = DepthsBelow(solid, monitor)
    return Placement(grid.size, part_map(grid, solid.bounds), solid.bounds, depth, is_cut)


@dataclass(eq=False)
class DepthsBelow:
    """`depth_below`, which remembers: a lattice's nodes are among those of one without end.

    Attributes:
        solid: the part.
        monitor: for cancel.
    """

    solid: TriangleMesh
    monitor: Monitor
    _known: tuple[Any, Floats] | None = None

    def __call__(self, points: Floats) -> Floats:
        """(n,) depth of (n, 3) points, mm; of those that were asked for last as it was then."""
        from scipy.spatial import cKDTree  # slow to import

        new, result = np.ones(len(points), bool), np.empty(len(points))
        if self._known is not None and len(points) <= MOST_KEPT:
            tree, depths = self._known
            same = SAME_POINT * float(np.ptp(self.solid.bounds, axis=0).max())
            row = tree.query(points, distance_upper_bound=same)[1]
            new = row == len(depths)
            result[~new] = depths[row[~new]]
        if new.any():
            result[new] = depth_below(self.solid, self.monitor, points[new])
            if len(points) <= MOST_KEPT:
                self._known = cKDTree(points), result
        return result


def depth_below(solid: TriangleMesh, monitor: Monitor, points: Floats) -> Floats:
    """(n,) depth of (n, 3) points below a solid's surface, mm; 0 outside."""
    # Of no use to blocks, and slow to import.
    from ..spatial.proximity import closest_points
    from ..spatial.rays import inside_points

    inside = inside_points(solid, points, monitor)
    result = np.zeros(len(points))
    result[inside] = monitor.call(lambda: closest_points(solid, points[inside])[1])
    return result


def part_map(grid: Grid, bounds: Floats) -> CoordinateMap | None:
    """The map of a lattice that fills a part; None where lattice space is the part's own."""
    mapping = lattice_map(grid.size, bounds, grid.size_grading, grid.cell_map, grid.orientation)
    return None if mapping.is_identity else mapping


def block_placement(wanted: Grid, shape: tuple[int, int, int]) -> tuple[CellGrid, Placement]:
    """The grid of a free-standing block of so many cells, and where it lies.

    About an axis or a centre, the block is a full turn: as many cells along the angle as the map
    has around, as wide as L half-way out.

    Raises:
        VolfrepError: the block does not close, or is not what a radius can be graded by.
    """
    size, extent = wanted.size, np.array(shape) * wanted.size
    origin = np.array(wanted.origin or (0.0, 0.0, 0.0), float)
    cells, periodic = wanted.cell_map, OPEN
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
    mapping = lattice_map(size, bounds, wanted.size_grading, cells, wanted.orientation, block=True)
    box = mapped_box(mapping.to_part, bounds)

    def depth(points: Floats) -> Floats:
        raise VolfrepError(
            "A block in free space has no skin to grade the radius by: grade it along a direction "
            "or by a field."
        )

    grid = CellGrid(origin, size, shape, periodic)
    return grid, Placement(size, None if mapping.is_identity else mapping, box, depth)


def node_radii(struts: Struts, points: Floats, placement: Placement) -> Floats:
    """(n,) radius of the struts at points of the part, before they are nudged, mm."""
    if isinstance(struts.radius, RadiusGrading):
        return struts.radius.radii(points, placement.bounds, placement.depth)
    return np.full(len(points), float(struts.radius))


def graded_wireframe(graph: CellGraph, struts: Struts, placement: Placement) -> Wireframe:
    """The lattice as a graph in the part, where its mesh lies, too.

    Struts that are deformed with their cells are given the radius of a circle of their section.
    """
    mapping = placement.mapping
    points = graph.nodes if mapping is None else mapping.to_part(graph.nodes)
    radius = node_radii(struts, points, placement)
    points = placement.nudged(points)
    result = wireframe(graph, points, radius, placement.cell_size)
    if mapping is None or mapping.is_rigid or struts.keep_radius:
        return result
    jacobian = mapping.jacobians(graph.nodes)
    volume = determinants(jacobian)
    span = graph.nodes[graph.struts[:, 1]] - graph.nodes[graph.struts[:, 0]]
    for axis in np.flatnonzero(mapping.base.periodic):
        span[:, axis] -= mapping.base.turn * np.round(span[:, axis] / mapping.base.turn)
    span /= np.linalg.norm(span, axis=1)[:, None]
    longer = np.linalg.norm(np.einsum("meij,mj->mei", jacobian[graph.struts], span), axis=2)
    radii = result.radii * np.sqrt(volume[graph.struts] / longer)
    joint = result.joint_radii * np.cbrt(volume)
    return Wireframe(points, graph.struts, radii, joint)

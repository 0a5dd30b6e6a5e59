# SPDX-License-Identifier: LGPL-2.1-or-later
"""Preview: struts clipped to the domain, or walls, and the density, before anything is meshed.

The skin's inner wall is not looked for: a point lies in the lattice's domain where its depth
below the part's surface is more than the skin. Depths come from `SurfaceIndex.near`, struts are
cut between points along them, and so ends lie within a few hundredths of a cell of the wall.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..design.cells import LIBRARY
from ..design.memory_guard import refuse_cells
from ..design.spec import LatticeSpec
from ..grid.activation import make_grid, mapped_grid
from ..grid.cell_grid import CellGrid
from ..grid.coordinate_map import CoordinateMap
from ..grid.placement import Placement, placement_in
from ..grid.strut_graph import Wireframe, cell_graph
from ..lattice.padded_grid import padded_grid
from ..mesh.triangle_mesh import TriangleMesh
from ..trim.clip_struts import Pieces
from ..trim.kept_struts import largest
from ..util.errors import VolfrepError
from ..util.progress import Monitor
from ..util.types import Bools, Floats, Ints
from .kinds import lattice_kind
from .part_depth import PartDepth, Preview

__all__ = ["PartDepth", "Preview", "preview"]

#: Pieces that a strut near the wall is looked at in.
PIECES = 8
#: A corner of a cell this far outside, in units of L, lies on the wall.
ON_WALL = 1e-6
#: More struts than this are no preview.
MOST_STRUTS = 2_000_000


def preview(solid: TriangleMesh, spec: LatticeSpec, depth: PartDepth) -> Preview:
    """The trimmed wireframe of a solid's lattice, or its surface, and its figures.

    Args:
        solid: checked closed mesh, mm.
        spec: what to make; its drain holes and the removal of struts are not shown. The radius
            of a target is found as nearly as the figures are.
        depth: of that solid, with the open faces of that specification.

    Raises:
        VolfrepError: the specification does not fit the solid, or no radius meets its target.
    """
    return lattice_kind(spec).preview(solid, depth)


@dataclass(frozen=True, eq=False)
class ShownCells:
    """The cells of a preview.

    Attributes:
        grid: where they lie, in lattice space.
        usable: (nx, ny, nz) those that are not too narrow for a lattice; None: all.
        active: (nx, ny, nz) those that struts are taken from.
        count: how many will be active.
        lines: starts and ends of their edges, (l, 3) each.
    """

    grid: CellGrid
    usable: Bools | None
    active: Bools
    count: int
    lines: tuple[Floats, Floats]


def place_lattice(solid: TriangleMesh, spec: LatticeSpec, monitor: Monitor) -> Placement:
    """Where the lattice lies in a solid."""
    return placement_in(solid, spec.grid, spec.ending.cuts_struts(spec.skin), monitor)


def show_cells(
    solid: TriangleMesh, spec: LatticeSpec, depth: PartDepth, placement: Placement, least: float
) -> ShownCells:
    """The cells of a solid's lattice; `least`: width of the narrowest one that holds it, over L.

    Raises:
        VolfrepError: there are too many.
    """
    mapping = placement.mapping
    if mapping is None:
        grid = make_grid(solid.bounds, spec.cell_size, spec.origin)
    else:
        grid = mapped_grid(solid, mapping, spec.cell_size, spec.origin, depth.monitor)
    refuse_cells(grid.cells, grid.cell_size)
    usable = padded_grid(grid, mapping, least).inner_usable
    active, count = _active(grid, spec, mapping, depth, usable)
    return ShownCells(grid, usable, active, count, _edges(active, spec, grid, mapping))


def show_struts(
    solid: TriangleMesh,
    spec: LatticeSpec,
    depth: PartDepth,
    frame: Wireframe,
    volume_of: Callable[[float, float, float], tuple[LatticeSpec, float]],
    none_inside: str,
    cells: ShownCells | None = None,
) -> Preview:
    """The preview of struts.

    Args:
        solid: checked closed mesh, mm.
        spec: what to make.
        depth: of that solid.
        frame: the struts, whole.
        volume_of: gives the specification with the radius of its target, and the volume of the
            lattice, mm3; of the volume that the struts inside would have with a radius of 1 mm if
            they did not meet, that of what is filled, and the skin's.
        none_inside: what to say where no strut lies inside.
        cells: that they are of; None: they have no cells.

    Raises:
        VolfrepError: no strut lies inside, or no radius meets the target.
    """
    owner, low, high = _inside(frame, spec, depth)
    if not len(owner):
        raise VolfrepError(none_inside)
    if spec.skin is None and not spec.keep_pieces:
        stays = largest(Pieces(owner, low, high), frame, depth.bodies)
        owner, low, high = owner[stays], low[stays], high[stays]
    ends = frame.nodes[frame.struts[owner]]
    span = ends[:, 1] - ends[:, 0]
    radii = frame.radii[owner]
    slope = radii[:, 1] - radii[:, 0]
    start, end = ends[:, 0] + low[:, None] * span, ends[:, 0] + high[:, None] * span
    piece_radii = np.stack([radii[:, 0] + low * slope, radii[:, 0] + high * slope], axis=1)
    length = np.linalg.norm(span, axis=1) * (high - low)
    bare = float(np.pi * (length * piece_radii.prod(axis=1)).sum()) / spec.template_radius**2
    domain = depth.volume_below(spec.shell)
    skin = spec.skin_volume(solid.volume, domain)
    made, lattice = volume_of(bare, domain, skin)
    piece_radii *= made.strut_radius / spec.strut_radius
    none = np.zeros((0, 3))
    grid = CellGrid(np.zeros(3), spec.cell_size, (0, 0, 0)) if cells is None else cells.grid
    return Preview(
        start, end, piece_radii, 0 if cells is None else cells.count, len(np.unique(owner)), grid,
        lattice / domain, lattice + skin, (lattice + skin) * spec.density / 1000.0,
        (none, none) if cells is None else cells.lines, made,
    )  # fmt: skip


def _active(
    grid: CellGrid,
    spec: LatticeSpec,
    mapping: CoordinateMap | None,
    depth: PartDepth,
    usable: Bools | None,
) -> tuple[Bools, int]:
    """(nx, ny, nz) the cells that struts are taken from, and how many will be active."""

    def depths(axes: list[Floats]) -> Floats:
        places = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1)
        points = places.reshape(-1, 3)
        below = depth.below_skin(points if mapping is None else mapping.to_part(points), spec.shell)
        return below.reshape(places.shape[:3])

    at_centre = depths([grid.centres(axis) for axis in range(3)])
    every = np.ones(grid.shape, bool) if usable is None else usable
    if spec.activation == "centre":
        active = (at_centre > 0.0) & every
        return active, int(active.sum())
    size, shape = grid.cell_size, grid.shape
    at_corner = depths([grid.origin[k] + size * np.arange(shape[k] + 1) for k in range(3)])
    nx, ny, nz = shape
    corner_of = np.argwhere(np.ones((2, 2, 2), bool))
    around = np.stack([at_corner[i : i + nx, j : j + ny, k : k + nz] for i, j, k in corner_of])
    if spec.activation == "inside":
        least = np.minimum(around.min(axis=0), at_centre)
        active = (least > -ON_WALL * size) & every  # a cell may lie at the wall
        return active, int(active.sum())
    # No point of a cell lies deeper than its centre by more than its corners are away.
    reach = np.maximum(np.abs(around - at_centre).max(axis=0), 0.5 * np.sqrt(3.0) * size)
    touching = np.maximum(around.max(axis=0), at_centre) > 0.0
    inside = depth.points_below(spec.shell)
    inside = inside if mapping is None else mapping.to_lattice(inside)
    index = np.floor((inside - grid.origin) / size).astype(np.int64)
    index = index[((index >= 0) & (index < shape)).all(axis=1)]
    touching[tuple(index.T)] = True
    return (at_centre + reach > 0.0) & every, int((touching & every).sum())


def _inside(frame: Wireframe, spec: LatticeSpec, depth: PartDepth) -> tuple[Ints, Floats, Floats]:
    """(k,) struts, and from where to where they lie inside, as shares of their length."""
    count = len(frame.struts)
    if not spec.is_cut:
        return np.arange(count), np.zeros(count), np.ones(count)
    ends = frame.nodes[frame.struts]
    length = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    at_end = depth.below_skin(frame.nodes, spec.shell)[frame.struts]
    # Depth changes no faster than one goes.
    whole = at_end.sum(axis=1) > length
    near = np.flatnonzero(~whole & (at_end.sum(axis=1) > -length))
    share = np.linspace(0.0, 1.0, PIECES + 1)
    points = ends[near, None, 0] + share[:, None] * (ends[near, 1] - ends[near, 0])[:, None]
    value = np.empty((len(near), PIECES + 1))
    value[:, [0, -1]] = at_end[near]
    inner = depth.below_skin(points[:, 1:-1].reshape(-1, 3), spec.shell)
    value[:, 1:-1] = inner.reshape(len(near), PIECES - 1)
    a, b = value[:, :-1], value[:, 1:]
    with np.errstate(divide="ignore", invalid="ignore"):
        zero = np.clip(a / (a - b), 0.0, 1.0)
    low = share[:-1] + np.where(a > 0, 0.0, zero) / PIECES
    high = share[:-1] + np.where(b > 0, 1.0, zero) / PIECES
    strut, piece = np.nonzero((a > 0) | (b > 0))
    low, high = low[strut, piece], high[strut, piece]
    # Pieces that follow upon each other are one.
    begins = np.ones(len(strut), bool)
    begins[1:] = (strut[1:] != strut[:-1]) | (low[1:] > high[:-1] + 1e-9)
    first = np.flatnonzero(begins)
    last = np.append(first[1:], len(strut)) - 1
    whole_struts = np.flatnonzero(whole)
    return (
        np.concatenate([whole_struts, near[strut[first]]]),
        np.concatenate([np.zeros(len(whole_struts)), low[first]]),
        np.concatenate([np.ones(len(whole_struts)), high[last[last >= 0]]]),
    )


def _edges(
    active: Bools, spec: LatticeSpec, grid: CellGrid, mapping: CoordinateMap | None
) -> tuple[Floats, Floats]:
    """The edges of the cells that struts are taken from, straight from corner to corner."""
    cubes = cell_graph(LIBRARY["Box"], active, spec.cell_size, grid.origin, grid.periodic)
    nodes = cubes.nodes if mapping is None else mapping.to_part(cubes.nodes)
    return nodes[cubes.struts[:, 0]], nodes[cubes.struts[:, 1]]

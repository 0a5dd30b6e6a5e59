# SPDX-License-Identifier: LGPL-2.1-or-later
"""The Boolean that trims the lattice to its domain and joins it to the skin.

part = outer - (inner - lattice). The cavity (inner - lattice) lies strictly inside the part, so
that the outer minus adds a reversed surface and intersects nothing. Only octants that the wall
crosses go into the one Boolean, closed by flat caps where their neighbours are left out; octants
wholly inside are put back afterwards, vertex on vertex: the Boolean hands the caps out untouched,
and what it hands out untouched has exactly the coordinates that went in.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ..grid.activation import CellGrid, crossed_cells, inside_cells, wall_corners
from ..grid.coordinate_map import STRAIGHT, CoordinateMap
from ..lattice.assembly import Layout, facets, lay_out, neighbour_missing
from ..mesh.booleans import from_library, to_library
from ..mesh.triangle_mesh import TriangleMesh, compact
from ..octants.caps import with_corners
from ..octants.octant import OctantGrid, OctantKey, used_kinds, wrapped
from ..octants.octant_mesh import Octant
from ..util.errors import VolfrepError
from ..util.progress import Monitor
from ..util.types import Periodic

if TYPE_CHECKING:
    import manifold3d

#: An octant counts as crossed by the wall when the wall comes this near, in units of its edge:
#: a wall that lies in an octant's face must cut the lattice on both sides of it.
CROSSING_MARGIN = 1e-3


@dataclass(frozen=True, eq=False)
class OctantRoles:
    """Where the octants lie with respect to the domain; both (nx, ny, nz) bool.

    Attributes:
        border: the wall crosses the octant.
        inside: the octant lies wholly inside.
    """

    border: NDArray[np.bool_]
    inside: NDArray[np.bool_]


def octant_roles(
    domain: TriangleMesh,
    cells: CellGrid,
    monitor: Monitor,
    mapping: CoordinateMap | None = None,
    margin: float = 0.0,
) -> OctantRoles:
    """Classify the octants of a grid of cells, and of the half cells about it.

    Args:
        domain: closed mesh of what the lattice fills.
        cells: the grid.
        monitor: for progress and cancel.
        mapping: from lattice space to the part, where they differ.
        margin: how near the wall may come to an octant that is not of the border, in units of its
            edge: octants on struts that were moved reach beyond their places.
    """
    half = 0.5 * cells.cell_size
    shape = [
        2 * n + (0 if closed else 2) for n, closed in zip(cells.shape, cells.periodic, strict=True)
    ]
    grid = CellGrid(cells.origin - half, half, (shape[0], shape[1], shape[2]), cells.periodic)
    if mapping is not None and not mapping.is_rigid:
        margin += STRAIGHT * cells.cell_size / half  # where the wall is known no better
    # The margin is on either side, the cell is enlarged by both.
    border = crossed_cells(
        grid, wall_corners(domain, mapping), monitor, CROSSING_MARGIN + 2.0 * margin
    )
    return OctantRoles(border, inside_cells(grid, domain, monitor, mapping) & ~border)


@dataclass(frozen=True, eq=False)
class Trimmed:
    """The lattice trimmed to its domain.

    Attributes:
        mesh: for a part: the cavity's surface, seen from the material. Otherwise the lattice.
        on_wall: (m,) bool, triangles that lie on the domain's wall.
        cut: how many of the first triangles came out of the Boolean; the others are put back.
        boolean_triangles: triangles that went into the Boolean.
    """

    mesh: TriangleMesh
    on_wall: NDArray[np.bool_]
    cut: int
    boolean_triangles: int


@dataclass(frozen=True, eq=False)
class KeptOctants:
    """Culled octants: what is left of a lattice without those outside.

    Attributes:
        grid: the octants that are left.
        border: (nx, ny, nz) bool, octants that go into the Boolean.
        inside: octants that are put back afterwards.
    """

    grid: OctantGrid
    border: NDArray[np.bool_]
    inside: NDArray[np.bool_]

    def lay_out(self, octants: dict[OctantKey, Octant]) -> Layout:
        """The octants numbered, with corners for caps."""
        half = 0.5 * self.grid.cell_size
        capped = {key: with_corners(octants[key], half) for key in self.grid.keys}
        return lay_out(self.grid, capped)


def cull(grid: OctantGrid, roles: OctantRoles) -> KeptOctants:
    """Cull the octants outside; `roles` is shaped as the grid."""
    present = grid.kind >= 0
    border, inside = roles.border & present, roles.inside & present
    border = _without_pinches(border, present, grid.periodic)
    inside = inside & ~border
    kind = np.where(border | inside, grid.kind, np.int16(-1))
    return KeptOctants(used_kinds(replace(grid, kind=kind)), border, inside)


def keep_all(grid: OctantGrid) -> KeptOctants:
    """A lattice that nothing cuts."""
    return KeptOctants(used_kinds(grid), np.zeros(grid.kind.shape, bool), grid.kind >= 0)


def trim(
    domain: TriangleMesh,
    kept: KeptOctants,
    layout: Layout,
    points: NDArray[np.float64],
    *,
    cavity: bool,
    monitor: Monitor,
) -> Trimmed:
    """Cut the lattice at the domain's wall.

    Args:
        domain: closed mesh of what the lattice fills.
        kept: the octants of the lattice.
        layout: the same, numbered.
        points: (n, 3) where their vertices are, mm.
        cavity: True for domain - lattice turned inside out (the wall with holes where struts
            meet it, and the struts), False for domain & lattice.
        monitor: for progress and cancel.

    Raises:
        VolfrepError: the domain's mesh is not a solid that can be cut.
    """
    monitor.tick(0.1)
    # Caps towards octants inside are taken off again where these are put back. Those on the
    # outside lie beyond the wall; what a wall that grazes them leaves belongs to the surface.
    caps, ends = _caps(layout, kept, monitor)
    surface = np.concatenate([facets(layout, monitor, kept.border), ends])
    inner = facets(layout, monitor, kept.inside)
    monitor.tick(0.2)

    import manifold3d

    wall = _solid(domain, [len(domain.triangles)], monitor)
    if wall.status() != manifold3d.Error.NoError:
        raise VolfrepError(
            f"The domain's surface cannot be cut ({wall.status().name}): repair the part's mesh."
        )
    capped = compact(TriangleMesh(points, np.concatenate([surface, caps])))
    monitor.count("triangles into the Boolean", len(capped.triangles) + len(domain.triangles))
    ids = manifold3d.Manifold.reserve_ids(2)
    cutter = _solid(capped, [len(surface), len(caps)], monitor, ids)
    if cutter.status() != manifold3d.Error.NoError:
        raise RuntimeError(f"the lattice's border is not a manifold: {cutter.status()}")
    monitor.tick(0.5)
    result = monitor.call(lambda: (wall - cutter if cavity else wall ^ cutter).to_mesh64())
    monitor.tick(0.9)
    mesh, origin = _read(result)
    is_cap = origin == ids + 1
    put_back = _put_back(mesh, is_cap, points, caps, inner, cavity)
    if put_back is None:
        # Nothing to weld to: let all the octants go through the Boolean, which takes longer.
        every = KeptOctants(kept.grid, kept.border | kept.inside, np.zeros_like(kept.inside))
        return trim(domain, every, layout, points, cavity=cavity, monitor=monitor)
    joined, from_inner = put_back
    on_wall = np.concatenate([~np.isin(origin[~is_cap], (ids, ids + 1)), from_inner])
    return Trimmed(
        joined, on_wall, int((~is_cap).sum()), len(capped.triangles) + len(domain.triangles)
    )


def trim_mesh(
    domain: TriangleMesh, lattice: TriangleMesh, *, cavity: bool, monitor: Monitor
) -> Trimmed:
    """Cut a lattice that is one closed mesh at the domain's wall; as `trim` does octants.

    Raises:
        VolfrepError: one of the two is not a solid that can be cut.
    """
    import manifold3d

    wall = _solid(domain, [len(domain.triangles)], monitor)
    ids = manifold3d.Manifold.reserve_ids(1)
    cutter = _solid(lattice, [len(lattice.triangles)], monitor, ids)
    for solid, what in ((wall, "domain"), (cutter, "lattice")):
        if solid.status() != manifold3d.Error.NoError:
            raise VolfrepError(
                f"The {what}'s surface cannot be cut ({solid.status().name}): repair the part's "
                "mesh, or make the struts thinner."
            )
    count = len(lattice.triangles) + len(domain.triangles)
    monitor.count("triangles into the Boolean", count)
    result = monitor.call(lambda: (wall - cutter if cavity else wall ^ cutter).to_mesh64())
    mesh, origin = _read(result)
    if cavity:
        mesh = mesh.reversed()
    return Trimmed(mesh, origin != ids, len(mesh.triangles), count)


def _without_pinches(
    border: NDArray[np.bool_], present: NDArray[np.bool_], periodic: Periodic
) -> NDArray[np.bool_]:
    """The border, grown until no two of its octants touch along an edge or a corner only.

    The caps of two such octants would share an edge between four triangles.
    """
    current = border.copy()
    while True:
        padded = wrapped(current, periodic)
        add = np.zeros_like(padded)
        for axis in range(3):
            a, b = (k for k in range(3) if k != axis)
            for sign in (1, -1):
                side_a = np.roll(padded, -1, axis=a)
                side_b = np.roll(padded, -sign, axis=b)
                diagonal = np.roll(side_a, -sign, axis=b)
                pinch = padded & diagonal & ~side_a & ~side_b
                add |= np.roll(pinch, 1, axis=a)
                add |= np.roll(pinch, sign, axis=b)
        for signs in ((1, 1, 1), (1, 1, -1), (1, -1, 1), (-1, 1, 1)):
            opposite = np.roll(padded, [-s for s in signs], axis=(0, 1, 2))
            between = np.zeros_like(padded)
            for k in range(1, 7):
                shift = [-(s if k >> axis & 1 else 0) for axis, s in enumerate(signs)]
                between |= np.roll(padded, shift, axis=(0, 1, 2))
            pinch = padded & opposite & ~between
            for k in range(1, 7):
                shift = [(s if k >> axis & 1 else 0) for axis, s in enumerate(signs)]
                add |= np.roll(pinch, shift, axis=(0, 1, 2))
        grown = current | (add[1:-1, 1:-1, 1:-1] & present)
        if (grown == current).all():
            return current
        current = grown


def _caps(
    layout: Layout, kept: KeptOctants, monitor: Monitor
) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
    """What closes the border's octants towards those inside, and towards nothing."""
    inward, outward = [], []
    for axis in range(3):
        for high in (False, True):
            every = neighbour_missing(layout.grid, kept.border, axis, high)
            last = neighbour_missing(layout.grid, kept.border | kept.inside, axis, high)
            inward.append(facets(layout, monitor, every & ~last, (axis, high)))
            outward.append(facets(layout, monitor, every & last, (axis, high)))
    return np.concatenate(inward), np.concatenate(outward)


def _solid(
    mesh: TriangleMesh,
    runs: list[int],
    monitor: Monitor,
    first_id: int | None = None,
) -> manifold3d.Manifold:
    """A manifold whose runs of triangles can be told apart after a Boolean."""
    import manifold3d as library

    ids = library.Manifold.reserve_ids(len(runs)) if first_id is None else first_id
    source = to_library(
        mesh,
        run_index=np.concatenate([[0], np.cumsum(runs)]).astype(np.uint64) * np.uint64(3),
        run_original_id=np.arange(ids, ids + len(runs), dtype=np.uint32),
    )
    return monitor.call(lambda: library.Manifold(source))


def _read(result: manifold3d.Mesh64) -> tuple[TriangleMesh, NDArray[np.int64]]:
    """The Boolean's result, and the run that each triangle came from."""
    index = np.asarray(result.run_index).astype(np.int64) // 3
    origin = np.repeat(np.asarray(result.run_original_id).astype(np.int64), np.diff(index))
    return from_library(result), origin


def _put_back(
    cut: TriangleMesh,
    is_cap: NDArray[np.bool_],
    points: NDArray[np.float64],
    caps: NDArray[np.int32],
    inner: NDArray[np.int32],
    cavity: bool,
) -> tuple[TriangleMesh, NDArray[np.bool_]] | None:
    """The cut border without its caps, and the octants inside, welded where the caps were.

    None where the Boolean has taken out vertices there, as it may do between tiny triangles.
    """
    rest = cut.triangles[~is_cap]
    if cavity:
        rest = rest[:, ::-1]
    if not len(inner):
        if is_cap.any():
            raise RuntimeError("the Boolean left caps where no octant follows")
        return compact(TriangleMesh(cut.vertices, rest)), np.zeros(0, bool)
    # The rims of the caps are what both sides share; match their coordinates exactly.
    seam_new = _shared(caps, inner, len(points))
    seam_cut = _shared(cut.triangles[is_cap], rest, len(cut.vertices))
    wanted, have = points[seam_new], cut.vertices[seam_cut]
    order_new, order_cut = np.lexsort(wanted.T), np.lexsort(have.T)
    if len(wanted) != len(have) or not np.array_equal(wanted[order_new], have[order_cut]):
        return None
    number = np.arange(len(points), dtype=np.int64) + len(cut.vertices)
    number[seam_new[order_new]] = seam_cut[order_cut]
    joined = TriangleMesh(
        np.concatenate([cut.vertices, points]),
        np.concatenate([rest, number[inner].astype(np.int32)]),
    )
    return compact(joined), np.zeros(len(inner), bool)


def _shared(one: NDArray[np.int32], two: NDArray[np.int32], count: int) -> NDArray[np.int64]:
    """The vertices, ascending, that triangles of both sets have; `count` is of all vertices."""
    in_one, in_two = np.zeros(count, bool), np.zeros(count, bool)
    in_one[one] = True
    in_two[two] = True
    return np.flatnonzero(in_one & in_two)

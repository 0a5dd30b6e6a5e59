# SPDX-License-Identifier: LGPL-2.1-or-later
"""Octants: the pieces that any set of cells is assembled from; their patterns and symmetry.

Every corner of the cell grid has eight octants about it, boxes of edge L / 2; every cell is made
of eight. The lattice inside an octant depends only on which of the eight cells about its corner
are active (its pattern), because no joint reaches further than L / 2. A cell that equals its
mirror images needs one octant a pattern; any other cell needs eight. A piece is described in its
own frame: the corner at the origin, its own cell on [0, L]^3, the octant on [0, L / 2]^3.

Two octants that share a face see the same field there, reflected, so their samples, and with
them the vertices on the face, are the same: pieces are joined by counting, never by searching.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ..design.cells import UnitCell, find_same, joint_radius
from ..mesh import remesh
from ..util.types import OPEN, Floats, Ints, Periodic
from . import sdf
from .sdf import Primitives

#: The eight cells about a corner, in the frame of an octant: bit k of a pattern is cell k,
#: which is shifted by -1 along the axes whose bit is set in k. Cell 0 is the octant's own.
NEIGHBOURS = np.array([[-(k >> axis & 1) for axis in range(3)] for k in range(8)])
ALL_ACTIVE = 0xFF
#: Samples nearer to the surface than this, in units of the step, are moved off it: a zero sample
#: would make marching cubes put several vertices on one grid point. Not a round number, so that
#: a radius that is a multiple of the step cannot meet it.
ZERO_BAND = 1.2345e-3
#: Samples along an edge of the cubes that they are found in: few primitives are nearest in one, and
#: their distances stay in the cache.
CUBE = 8
#: Distances are certain to this part of a cell.
ROUNDING = 1e-9
#: Nodes are taken at whole steps of this part of a cell: their mirror images are exact then, and
#: octants that are alike are known to be, which rounding told apart.
NODE_STEP = 2.0**-40
#: Vertices lie at whole steps of an octant's edge over this, so that octants which share a vertex
#: can give it the very same coordinates.
STEPS = float(1 << 26)


@dataclass(frozen=True, order=True)
class OctantKey:
    """What tells one octant's lattice from another's.

    Attributes:
        mirror: bit per axis along which the octant's frame runs against the grid (0 for a cell
            that is its own mirror image: the frames then need no telling apart).
        pattern: bit per active cell of `NEIGHBOURS`.
        missing: bit per strut of these cells (as `cell_copies` numbers them) that was taken away.
    """

    mirror: int
    pattern: int
    missing: int = 0

    @property
    def active(self) -> Ints:
        """The numbers of the active cells in `NEIGHBOURS`."""
        return np.flatnonzero([self.pattern >> k & 1 for k in range(8)])


def cell_copies(cell: UnitCell, offsets: Ints, mirror: int = 0) -> tuple[Floats, Ints]:
    """Unique struts and nodes of copies of a cell, in units of L.

    Args:
        cell: the unit cell.
        offsets: (k, 3) whole shifts of the copies.
        mirror: bit per axis about whose mid-plane the cell is reflected first.

    Returns:
        nodes (n, 3) float64, each of which carries a joint sphere, and struts (m, 2) of its rows.
    """
    reflect = np.array([mirror >> axis & 1 for axis in range(3)], bool)
    exact = np.round(cell.nodes / NODE_STEP) * NODE_STEP
    local = np.where(reflect, 1.0 - exact, exact)
    nodes = (local[None] + np.asarray(offsets)[:, None, :]).reshape(-1, 3)
    struts = (cell.struts[None] + (np.arange(len(offsets)) * len(local))[:, None, None]).reshape(
        -1, 2
    )
    first, inverse = find_same(nodes)
    ends = np.unique(np.sort(inverse[struts], axis=1), axis=0)
    return nodes[first], ends


def octant_graph(cell: UnitCell, key: OctantKey) -> tuple[Floats, Ints]:
    """The nodes and struts that an octant sees, in its frame, in units of L.

    Without the struts that are missing, and without the nodes that have lost all of theirs.
    """
    nodes, ends = cell_copies(cell, NEIGHBOURS[key.active], key.mirror)
    if not key.missing:
        return nodes, ends
    ends = ends[[not key.missing >> k & 1 for k in range(len(ends))]]
    used, rows = np.unique(ends, return_inverse=True)
    return nodes[used], rows.reshape(-1, 2)


def reaches_octant(nodes: Floats, ends: Ints, radius: float) -> NDArray[np.bool_]:
    """(m,) which struts come nearer to the octant than the radius, all in units of L.

    A segment's box against the octant's: takes in a few too many, leaves out none.
    """
    low = np.minimum(nodes[ends[:, 0]], nodes[ends[:, 1]]) - radius
    high = np.maximum(nodes[ends[:, 0]], nodes[ends[:, 1]]) + radius
    near: NDArray[np.bool_] = (high > 0.0).all(axis=1) & (low < 0.5).all(axis=1)
    return near


def octant_primitives(
    cell: UnitCell, key: OctantKey, cell_size: float, strut_radius: float, reach: float
) -> Primitives:
    """The struts and joint spheres that an octant's lattice can consist of, in its frame, mm.

    `reach` in mm is how far from a strut's surface the field is still wanted.
    """
    nodes, ends = octant_graph(cell, key)
    keep = reaches_octant(nodes, ends, (reach + strut_radius) / cell_size)
    nodes = nodes * cell_size
    all_struts = sdf.struts(nodes[ends[:, 0]], nodes[ends[:, 1]], strut_radius)
    all_joints = sdf.spheres(nodes, joint_radius(strut_radius, cell_size))
    low, high = -reach, 0.5 * cell_size + reach
    radius = all_joints.radius[:, None]
    keep_joints = (all_joints.middle + radius > low).all(1)
    keep_joints &= (all_joints.middle - radius < high).all(1)
    return sdf.join(all_struts.take(keep), all_joints.take(keep_joints))


@dataclass(frozen=True, eq=False)
class RawOctant:
    """Marching cubes' surface of an octant.

    Attributes:
        vertices: (n, 3) float64 in the octant's frame, mm.
        triangles: (m, 3) int64.
        place: (n, 3) int8, per axis 0 on the low face, 2 on the high face, 1 between.
        order: (n,) int64, a number that orders the vertices of a shared face or edge alike in
            every octant that shares it.
    """

    vertices: Floats
    triangles: Ints
    place: NDArray[np.int8]
    order: Ints


def sample_octant(primitives: Primitives, cell_size: float, steps: int, fillet: float) -> Floats:
    """(steps + 1)^3 signed distances over the octant, none of them zero."""
    result: Floats = sample_octants([primitives], cell_size, steps, fillet)[0]
    return result


def sample_octants(
    primitives: Sequence[Primitives], cell_size: float, steps: int, fillet: float
) -> Floats:
    """(k, steps + 1, steps + 1, steps + 1) signed distances over octants, none of them zero.

    Those of a primitive that several octants have are found once, and none where another one is
    nearer whatever the sample: no distance changes faster than its place.
    """
    axis = np.linspace(0.0, 0.5 * cell_size, steps + 1)
    step = axis[1]
    points = np.stack(np.meshgrid(axis, axis, axis, indexing="ij"), axis=-1).reshape(-1, 3)
    values = np.full((len(primitives), len(points)), float(cell_size))
    every = sdf.join(*primitives)
    _, first, number = np.unique(every.rows, axis=0, return_index=True, return_inverse=True)
    shared = every.take(first)
    ends = np.cumsum([0] + [len(own) for own in primitives])
    rows = [number.ravel()[begin:end] for begin, end in itertools.pairwise(ends)]
    for cube in _cubes(steps + 1):
        around = points[cube]
        middle = 0.5 * (around[0] + around[-1])
        apart = 2.0 * float(np.linalg.norm(around[-1] - middle)) + ROUNDING * cell_size
        away = sdf.distances(middle, shared)
        # The round union adds up what all of them reach.
        near = [
            row[away[row] <= away[row].min() + apart] if len(row) and fillet <= 0.0 else row
            for row in rows
        ]
        used = np.unique(np.concatenate(near))
        distances = sdf.distances(around[:, None], shared.take(used)).T.copy()
        for octant, row in enumerate(near):
            if len(row):
                own = distances[np.searchsorted(used, row)]
                values[octant, cube] = sdf.union(own.T, fillet)
    values[np.abs(values) < ZERO_BAND * step] = ZERO_BAND * step
    return values.reshape(-1, *(steps + 1,) * 3)


def _cubes(along: int) -> Iterator[Ints]:
    """The numbers of samples, so many along an octant's edge, cube by cube; corners first, last."""
    number = np.arange(along**3).reshape(along, along, along)
    for begin in itertools.product(range(0, along, CUBE), repeat=3):
        x, y, z = (slice(low, low + CUBE) for low in begin)
        yield number[x, y, z].ravel()


def raw_octant(samples: Floats, cell_size: float) -> RawOctant:
    """The surface inside an octant by marching cubes, open where it crosses the faces.

    W. E. Lorensen and H. E. Cline, SIGGRAPH 1987, with the tables of T. Lewiner et al., J. Graphics
    Tools 8, 2003, as scikit-image has them.
    """
    steps = len(samples) - 1
    step = 0.5 * cell_size / steps
    empty = RawOctant(
        np.zeros((0, 3)), np.zeros((0, 3), np.int64), np.zeros((0, 3), np.int8), np.zeros(0, int)
    )
    if samples.min() > 0.0 or samples.max() < 0.0:
        return empty
    from skimage.measure import marching_cubes

    # In units of the step and as float32: the place on the grid stays exact.
    found, faces, _, _ = marching_cubes(  # type: ignore[no-untyped-call]
        (samples / step).astype(np.float32), 0.0
    )
    found = found.astype(np.float64)
    place = np.where(found == 0.0, 0, np.where(found == steps, 2, 1)).astype(np.int8)
    # A vertex lies on a grid edge: two whole coordinates and the cell along the third. On a
    # shared face or edge that names it in every octant, for their frames agree there.
    cell = np.floor(found).astype(np.int64)
    along = np.argmax(found != cell, axis=1)
    order = along
    for axis in range(3):
        order = order * (steps + 1) + cell[:, axis]
    # An inner edge between two vertices of one face would come again beyond the face, and then
    # belong to four triangles: give it a vertex in the middle.
    old = len(found)

    def on_one_face(one: Ints, two: Ints) -> NDArray[np.bool_]:
        result: NDArray[np.bool_] = ((place[one] == place[two]) & (place[one] != 1)).any(axis=1)
        return result

    found, triangles = remesh.split(found, faces.astype(np.int64), on_one_face)
    added = len(found) - old
    place = np.concatenate([place, np.ones((added, 3), np.int8)])
    order = np.concatenate([order, order.max() + 1 + np.arange(added)])
    return RawOctant(found * step, triangles, place, order)


@dataclass(frozen=True, eq=False)
class Octant:
    """The finished surface inside one octant, in the octant's frame.

    Attributes:
        vertices: (n, 3) float64, mm, in whole steps (`STEPS`).
        triangles: (m, 3) int32, counter-clockwise seen from outside.
        entity: (n,) int8, 9 px + 3 py + pz with p 0 on the low face, 1 between, 2 on the high
            face: which face or edge of the octant the vertex is shared on; 13 inside.
        rank: (n,) int32, number of the vertex among those of its entity; the same number in
            every octant that shares the entity.
        solid_corners: (2, 2, 2) bool, whether the octant's corners are inside the lattice.
        deviation: of its facets from the exact struts at most, mm; 0 where nobody looked.
    """

    vertices: Floats
    triangles: NDArray[np.int32]
    entity: NDArray[np.int8]
    rank: NDArray[np.int32]
    solid_corners: NDArray[np.bool_]
    deviation: float = 0.0

    @property
    def places(self) -> Ints:
        """(n, 3) per axis 0 on the low face, 1 between, 2 on the high face."""
        return np.stack(np.unravel_index(self.entity.astype(np.int64), (3, 3, 3)), axis=1)


def wrapped(values: NDArray[np.bool_], periodic: Periodic) -> NDArray[np.bool_]:
    """The array with one more layer all about: what follows along a periodic axis, else False."""
    for axis, closed in enumerate(periodic):
        width = [(1, 1) if k == axis else (0, 0) for k in range(3)]
        values = np.pad(values, width, mode="wrap" if closed else "constant")
    return values


def corner_patterns(active: NDArray[np.bool_], periodic: Periodic = OPEN) -> NDArray[np.uint8]:
    """(2 nx + 2, 2 ny + 2, 2 nz + 2) pattern of every octant in and about the cells.

    Octant (0, 0, 0) lies half a cell outside the grid's lowest corner: the struts on the outer
    faces of a block are round, so half a cell about the active ones belongs to the lattice.
    Octants that no active cell touches have pattern 0. Along a periodic axis there are just the
    2 n octants, of which the first follows the last.
    """
    padded = wrapped(active, periodic)
    shape = tuple(2 * np.array(active.shape) + 2)
    result = np.zeros(shape, np.uint8)
    for parity in itertools.product((0, 1), repeat=3):
        # Parity 0 is the high half of a cell (in the padded grid cell i // 2), its corner above.
        count = np.array(active.shape) + 1
        own = np.array(parity)
        view = np.zeros(tuple(count), np.uint8)
        for bit, shift in enumerate(NEIGHBOURS):
            # Towards the corner: up for a high half (mirrored frame), down for a low half.
            step = np.where(own == 1, shift, -shift)
            begin = own + step
            part = padded[tuple(slice(b, b + c) for b, c in zip(begin, count, strict=True))]
            view |= part.astype(np.uint8) << np.uint8(bit)
        result[tuple(slice(p, None, 2) for p in parity)] = view
    return result[tuple(slice(None, -2 if closed else None) for closed in periodic)]


def octant_mirrors(shape: tuple[int, int, int]) -> NDArray[np.uint8]:
    """Mirror bits of every octant in an array shaped as by `corner_patterns`."""
    bits = [((np.arange(n) % 2) == 0).astype(np.uint8) << axis for axis, n in enumerate(shape)]
    result: NDArray[np.uint8] = (
        bits[0][:, None, None] | bits[1][None, :, None] | bits[2][None, None, :]
    )
    return result


@dataclass(frozen=True, eq=False)
class OctantGrid:
    """Which octant lies where.

    Attributes:
        keys: the kinds of octant.
        kind: (nx, ny, nz) int16, index into `keys`; -1 where there is none.
        origin: (3,) the grid corner about which octant (0, 0, 0) lies on the low side, mm.
        cell_size: L, mm.
        symmetric: whether octants are described up to reflection.
        periodic: axes along which the last octant is followed by the first one.
    """

    keys: list[OctantKey]
    kind: NDArray[np.int16]
    origin: Floats
    cell_size: float
    symmetric: bool
    periodic: Periodic = OPEN


def used_kinds(grid: OctantGrid) -> OctantGrid:
    """The grid without the kinds of octant that lie nowhere in it."""
    used, kind = np.unique(grid.kind, return_inverse=True)
    first = int((used < 0).any())
    return replace(
        grid,
        keys=[grid.keys[k] for k in used[first:]],
        kind=(kind.reshape(grid.kind.shape) - first).astype(np.int16),
    )


def octant_grid(
    cell: UnitCell,
    active: NDArray[np.bool_],
    cell_size: float,
    origin: Floats,
    periodic: Periodic = OPEN,
) -> OctantGrid:
    """The octants of the active cells, with the half cell about them that their struts reach.

    Args:
        cell: the unit cell.
        active: (nx, ny, nz) bool.
        cell_size: L, mm.
        origin: (3,) lowest corner of the cells, mm.
        periodic: axes along which the last cell is followed by the first one.
    """
    pattern = corner_patterns(active, periodic)
    symmetric = cell.is_mirror_symmetric
    code = pattern.astype(np.int64)
    if not symmetric:
        code += octant_mirrors(pattern.shape).astype(np.int64) << 8  # type: ignore[arg-type]
    code[pattern == 0] = -1
    values, inverse = np.unique(code, return_inverse=True)
    kind = inverse.reshape(code.shape).astype(np.int16)
    if len(values) and values[0] < 0:
        values, kind = values[1:], kind - np.int16(1)
    keys = [OctantKey(int(v) >> 8, int(v) & 0xFF) for v in values]
    return OctantGrid(keys, kind, np.asarray(origin, float), cell_size, symmetric, periodic)


def frames(place: NDArray[np.int64]) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """The grid corner that octants lie about, and the direction of their axes."""
    return place // 2, np.where(place % 2 == 0, -1, 1)

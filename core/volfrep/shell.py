# SPDX-License-Identifier: LGPL-2.1-or-later
"""The inner wall of a shelled solid: the surface at a given depth below the outer one.

It is the level set of the distance to the outer surface, so it cannot cross itself the way a
surface of moved faces does. Dual contouring (Ju, Losasso, Schaefer, Warren 2002, "Dual contouring
of Hermite data") puts one vertex into each crossed voxel, where the planes at exact depth that
were sampled on the voxel's edges meet: edges and corners come out sharp, not chamfered. The
connectivity is the dual of marching cubes, one vertex a patch, so that the mesh is manifold.
Edges that still stray from the exact depth are split, flat regions are simplified; what would
make the surface run through itself is taken back.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import manifold3d
import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from skimage.measure import marching_cubes

from .crossings import crossing_triangles
from .distance import SurfaceIndex, index_surface
from .errors import VolfrepError
from .mesh import TriangleMesh, compact, empty_mesh
from .progress import Monitor
from .voxels import column_crossings, fill_columns

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

#: Voxel edges in units of the thickness, tried in turn until the wall is good; and the least
#: number of voxels along the part's diagonal.
VOXELS = (0.4, 0.28, 0.2)
VOXELS_ALONG_DIAGONAL = 100
#: A wall is good when its thickness is within this at so many random points of it.
TOLERANCE = 0.05
MEASURED_POINTS = 20_000
#: No finer voxels are tried where the wall would cross more of them: minutes instead of seconds.
MOST_CROSSED_AGAIN = 600_000
#: Spacing of the samples on the outer surface in units of the thickness.
SAMPLE_SPACING = 0.24
#: Voxels along the edge of one block, and the cubes it is searched by, coarse to fine.
BLOCK = 64
STRIDES = (8, 4, 2)
#: Blocks of voxels with all that is kept of them need about this much memory, in bytes a voxel
#: crossed by the wall.
BYTES_PER_CROSSED_VOXEL = 2500
MEMORY_LIMIT = 6e9
#: Samples are kept off the level set by this many voxels: marching cubes needs a sign.
OFF_ZERO = 1e-3
#: Directions in which the sampled planes vary by less than this (eigenvalue over the largest)
#: do not move a vertex.
FLAT = 0.02
#: Depths may be wrong by this much, in units of the thickness, before an edge is split.
SPLIT_TOLERANCE = 0.015
SPLIT_ROUNDS = 4
#: Edges shorter than this, in units of the thickness, are not split.
SHORTEST_SPLIT = 0.08
#: Where planes meet, for new points: how sharp a crease may be (as `FLAT`), and how far from the
#: edge that cut it off, in units of half that edge.
SHARPEST = 0.004
CREASE_REACH = 8.0
#: How a point that strays is brought to exact depth: moves, and when it is there (thicknesses).
SETTLE_ROUNDS = 6
SETTLED = 0.002
#: Moves that let the wall run through itself by more than this (thicknesses) are taken back.
CROSSING_DEPTH = 1e-5
TAKE_BACK_ROUNDS = 12
#: Sweeps of the search for the best point inside a voxel.
DESCENT_ROUNDS = 40
#: How far simplifying may move the wall, in units of the thickness.
SIMPLIFY_TOLERANCE = 0.005
#: Points of one step between two looks at the cancel button.
POINTS_PER_STEP = 60_000
#: Pockets smaller than a cube of this many voxels' edge are left solid.
SMALLEST_POCKET = 1.5


@dataclass(frozen=True, eq=False)
class InnerWall:
    """The closed surface at a depth below the surface of a solid, and how near it came.

    Attributes:
        mesh: oriented outward; empty where no part of the solid is thicker than two walls.
        worst: largest relative error of the wall's thickness at random points of it.
        place: (3,) where that is, mm.
    """

    mesh: TriangleMesh
    worst: float
    place: Floats


def inner_wall(solid: TriangleMesh, thickness: float, monitor: Monitor) -> InnerWall:
    """The closed surface at depth `thickness` below the surface of a solid.

    Args:
        solid: checked closed solid (`volfrep.solid.check_solid`), mm.
        thickness: wall thickness, above 0, mm.
        monitor: for progress and cancel.

    Returns:
        The boundary of the points of the solid that lie deeper than the thickness, strictly
        inside it. The wall is within `TOLERANCE` of its thickness, except where the room between
        two walls is narrower than a voxel: there the cavity may end early, the wall is up to a
        quarter thicker, and a few facets may cross. Finer voxels are tried where that happens, as
        long as they are not too many.

    Raises:
        VolfrepError: the wall is so thin that its voxels would not fit into memory.
    """
    low, high = solid.bounds
    nothing = InnerWall(empty_mesh(), 0.0, np.zeros(3))
    if np.min(high - low) <= 2.0 * thickness:
        return nothing
    diagonal = float(np.linalg.norm(high - low))
    coarsest = min(VOXELS[0] * thickness, diagonal / VOXELS_ALONG_DIAGONAL)
    crossed = 2.0 * solid.area / coarsest**2
    if crossed * BYTES_PER_CROSSED_VOXEL > MEMORY_LIMIT:
        least = thickness * (crossed * BYTES_PER_CROSSED_VOXEL / MEMORY_LIMIT) ** 0.5
        raise VolfrepError(
            f"A wall of {thickness:g} mm is too thin for a part of {diagonal:.4g} mm: it would "
            f"take more than {MEMORY_LIMIT / 1e9:g} GB; make it at least {least:.3g} mm."
        )
    monitor.tick(0.0)
    index = monitor.call(lambda: index_surface(solid, SAMPLE_SPACING * thickness))
    depth = _Depth(index, thickness, monitor)
    best = nothing
    for factor in VOXELS:
        voxel = coarsest * factor / VOXELS[0]
        if len(best.mesh.triangles) and 2.0 * solid.area / voxel**2 > MOST_CROSSED_AGAIN:
            break
        wall = _measured(_wall_at(solid, depth, voxel), depth)
        if not len(best.mesh.triangles) or wall.worst < best.worst:
            best = wall
        if best.worst <= TOLERANCE:
            break
    return best


def _measured(mesh: TriangleMesh, depth: _Depth) -> InnerWall:
    """The wall with its largest error at random points, the same for the same wall."""
    if not len(mesh.triangles):
        return InnerWall(mesh, 0.0, np.zeros(3))
    a, b, c = mesh.corners()
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    random = np.random.default_rng(0)
    pick = random.choice(len(area), MEASURED_POINTS, p=area / area.sum())
    weight = random.dirichlet((1.0, 1.0, 1.0), MEASURED_POINTS)
    points = weight[:, :1] * a[pick] + weight[:, 1:2] * b[pick] + weight[:, 2:] * c[pick]
    error = np.abs(depth.nearest(points)[1] / depth.thickness - 1.0)
    return InnerWall(mesh, float(error.max()), points[np.argmax(error)])


def _wall_at(solid: TriangleMesh, depth: _Depth, voxel: float) -> TriangleMesh:
    """The wall as found on voxels of one size."""
    thickness, monitor = depth.thickness, depth.monitor
    low, high = solid.bounds
    # The first and last nodes lie outside the wall, at no special place of the part.
    start = low + thickness - 0.7320508 * voxel
    count = np.ceil((high - thickness - start) / voxel).astype(np.int64) + 1
    count = -(-count // STRIDES[0]) * STRIDES[0]
    crossings = _contour(solid, depth, start, voxel, count, monitor)
    if not len(crossings.triangles):
        return empty_mesh()
    wall = _dual(crossings, depth, start, voxel)
    wall = _settle_suspects(wall, depth)
    monitor.tick(0.85)
    for _ in range(SPLIT_ROUNDS):
        wall = _split_straying_edges(wall, depth)
    monitor.tick(0.95)
    mesh = _simplify_uncrossed(wall.mesh, thickness, monitor)
    return _drop_small(mesh, (SMALLEST_POCKET * voxel) ** 3)


@dataclass(frozen=True, eq=False)
class _Depth:
    """Depth below the outer surface, of points known to be inside or not."""

    index: SurfaceIndex
    thickness: float
    monitor: Monitor

    def nearest(self, points: Floats) -> tuple[Floats, Floats]:
        """Closest points of the outer surface and distances, in steps that can be cancelled."""
        parts = []
        for start in range(0, len(points), POINTS_PER_STEP):
            self.monitor.tick()
            parts.append(self.index.near(points[start : start + POINTS_PER_STEP]))
        if not parts:
            return np.zeros((0, 3)), np.zeros(0)
        closest, distance = (np.concatenate(values) for values in zip(*parts, strict=True))
        return closest, distance

    def planes(self, points: Floats) -> tuple[Floats, Floats]:
        """Tangent planes of the wall near points inside: a point at exact depth, and the normal."""
        closest, distance = self.nearest(points)
        normals = (closest - points) / np.maximum(distance, 1e-300)[:, None]
        return closest - self.thickness * normals, normals


@dataclass(frozen=True, eq=False)
class _Crossings:
    """Marching cubes over all blocks, its vertices named by the grid edges they lie on.

    Attributes:
        points: (n, 3) vertices in voxels from the grid's start.
        node: (n, 3) lower end of each vertex's grid edge; axis: (n,) its direction, -1 for the
            few vertices inside a voxel; rising: (n,) the field grows along the edge.
        triangles: (m, 3) vertices; voxel: (m, 3) the voxel of each triangle.
    """

    points: Floats
    node: Ints
    axis: Ints
    rising: NDArray[np.bool_]
    triangles: Ints
    voxel: Ints


def _contour(
    solid: TriangleMesh, depth: _Depth, start: Floats, voxel: float, count: Ints, monitor: Monitor
) -> _Crossings:
    """March over the blocks of the grid and weld what they share by whole numbers."""
    axes = [start[k] + voxel * np.arange(count[k] + 1) for k in range(3)]
    columns = column_crossings(solid, axes[0], axes[1], monitor)
    corners = [
        np.array([i, j, k])
        for i in range(0, count[0], BLOCK)
        for j in range(0, count[1], BLOCK)
        for k in range(0, count[2], BLOCK)
    ]
    parts: list[tuple[Floats, Ints, Ints, NDArray[np.bool_], Ints, Ints]] = []
    offset = 0
    for done, corner in enumerate(corners):
        monitor.tick(0.1 + 0.55 * done / len(corners))
        size = np.minimum(BLOCK, count - corner)
        field = _sample_block(depth, start, voxel, corner, size, axes, columns)
        if field is None:
            continue
        part = _march(field, corner, offset)
        offset += len(part[0])
        parts.append(part)
    if not parts:
        none = np.zeros((0, 3), np.int64)
        return _Crossings(np.zeros((0, 3)), none, none[:, 0], none[:, 0] > 0, none, none)
    points, node, axis, rising, triangles, voxels = (
        np.concatenate(values) for values in zip(*parts, strict=True)
    )
    key = np.ravel_multi_index(tuple(node.T), tuple(count + 1)) * 4 + axis
    key[axis < 0] = -1 - np.flatnonzero(axis < 0)  # each its own
    _, first, number = np.unique(key, return_index=True, return_inverse=True)
    return _Crossings(
        points[first], node[first], axis[first], rising[first], number.ravel()[triangles], voxels
    )


def _sample_block(
    depth: _Depth,
    start: Floats,
    voxel: float,
    corner: Ints,
    size: Ints,
    axes: list[Floats],
    columns: tuple[Ints, Ints, Floats, Ints],
) -> NDArray[np.float32] | None:
    """Thickness less depth, in voxels, at a block's nodes: negative inside the inner wall.

    Exact near the wall; elsewhere only the sign is right. None where the wall does not cross.
    """
    i, j, z, step = columns
    here = (i >= corner[0]) & (i <= corner[0] + size[0])
    here &= (j >= corner[1]) & (j <= corner[1] + size[1])
    zs = axes[2][corner[2] : corner[2] + size[2] + 1]
    inside = fill_columns(
        i[here] - corner[0], j[here] - corner[1], z[here], step[here],
        (int(size[0]) + 1, int(size[1]) + 1), zs,
    )  # fmt: skip
    if not inside.any():
        return None

    def field(nodes: Ints) -> Floats:
        distance = depth.nearest(start + voxel * (corner + nodes))[1]
        signed = np.where(inside[tuple(nodes.T)], distance, -distance)
        return (depth.thickness - signed) / voxel

    # The field changes by no more than 1 a voxel, so a cube whose centre is farther from zero
    # than half its diagonal is not crossed. The margin covers the error of `near`.
    live = np.ones(tuple(size // STRIDES[0]), bool)
    values = np.zeros(live.shape)
    for stride in STRIDES:
        cubes = np.argwhere(live)
        centre = field(cubes * stride + stride // 2)
        values[live] = centre
        live[live] = np.abs(centre) <= 1.02 * 0.5 * np.sqrt(3.0) * stride
        if not live.any():
            return None
        for axis in range(3):
            if stride > STRIDES[-1]:
                live, values = np.repeat(live, 2, axis), np.repeat(values, 2, axis)
    needed = np.zeros(tuple(size + 1), bool)
    spans = [[slice(a, a + 2 * n - 1, 2) for a in range(3)] for n in live.shape]
    for a in range(3):
        for b in range(3):
            for c in range(3):
                needed[spans[0][a], spans[1][b], spans[2][c]] |= live
    # A cube's centre is the node it was sampled at.
    needed[1::2, 1::2, 1::2] = False
    for axis in range(3):
        values = np.repeat(values, 2, axis)
    values = np.pad(values, ((0, 1),) * 3, mode="edge")
    values[needed] = field(np.argwhere(needed))
    values[np.abs(values) < OFF_ZERO] = OFF_ZERO
    result = values.astype(np.float32)
    return result if (result < 0).any() and (result > 0).any() else None


def _march(
    field: NDArray[np.float32], corner: Ints, offset: int
) -> tuple[Floats, Ints, Ints, NDArray[np.bool_], Ints, Ints]:
    """Marching cubes over one block; see `_Crossings` for what it returns."""
    march: Any = marching_cubes
    points, triangles = march(field, 0.0)[:2]
    points = points.astype(np.float64)
    triangles = triangles.astype(np.int64)
    fraction = points - np.floor(points)
    axis = fraction.argmax(axis=1)
    axis[(fraction > 0).sum(axis=1) != 1] = -1
    node = np.floor(points).astype(np.int64)
    rising = field[tuple(node.T)] < 0
    voxel = np.floor(points[triangles].mean(axis=1)).astype(np.int64)
    voxel = np.minimum(voxel, np.array(field.shape) - 2)
    return points + corner, node + corner, axis, rising, triangles + offset, voxel + corner


@dataclass(frozen=True, eq=False)
class _Wall:
    """The wall while it is made: its mesh, and which triangles may stray from the exact depth."""

    mesh: TriangleMesh
    suspect: NDArray[np.bool_]


def _dual(crossings: _Crossings, depth: _Depth, start: Floats, voxel: float) -> _Wall:
    """One vertex a patch of marching cubes, two triangles a crossed grid edge."""
    patch_of, patches = _patches(crossings)
    on_edge = crossings.axis >= 0
    anchor, normal = np.zeros((2, len(crossings.points), 3))
    anchor[on_edge], normal[on_edge] = depth.planes(start + voxel * crossings.points[on_edge])
    # Incidences of patches with grid edges, as pairs of a quadrant round the edge and a patch.
    edge, quadrant = np.nonzero(patch_of >= 0)
    patch = patch_of[edge, quadrant]
    node, axis = crossings.node[edge], crossings.axis[edge]
    low = node.copy()
    rows = np.arange(len(edge))
    low[rows, (axis + 1) % 3] -= np.isin(quadrant, (0, 3))
    low[rows, (axis + 2) % 3] -= np.isin(quadrant, (0, 1))
    cell = np.zeros((patches, 3))
    cell[patch] = start + voxel * low
    vertices = _place_vertices(anchor[edge], normal[edge], patch, patches, cell, voxel)
    return _quads(patch_of[on_edge], crossings, on_edge, vertices, anchor, normal, depth.thickness)


def _patches(crossings: _Crossings) -> tuple[Ints, int]:
    """(n, 4) the patch in each voxel round a vertex's grid edge, counter-clockwise; and how many.

    A patch is what marching cubes puts into one voxel as one connected piece.
    """
    t, voxel = crossings.triangles, crossings.voxel
    extent = voxel.max(axis=0) + 1
    vertex = t.ravel()
    cell = np.repeat(np.ravel_multi_index(tuple(voxel.T), tuple(extent)), 3)
    pair = cell * len(crossings.points) + vertex
    _, first, number = np.unique(pair, return_index=True, return_inverse=True)
    number = number.ravel()
    graph = coo_matrix(
        (np.ones(len(pair), np.int8), (np.repeat(np.arange(len(t)), 3), len(t) + number)),
        shape=(len(t) + len(first),) * 2,
    )
    patches, label = connected_components(graph, directed=False)
    vertex, label = vertex[first], label[len(t) :].astype(np.int64)
    place = np.repeat(voxel, 3, axis=0)[first]
    axis = crossings.axis[vertex]
    inner = axis < 0
    rows = np.arange(len(vertex))
    node = crossings.node[vertex]
    before_u = (node - place)[rows, (axis + 1) % 3]  # 1: the voxel lies below the edge along u
    before_v = (node - place)[rows, (axis + 2) % 3]
    quadrant = np.array([[2, 1], [3, 0]])[
        np.where(inner, 0, before_u), np.where(inner, 0, before_v)
    ]
    patch_of = np.full((len(crossings.points), 4), -1, np.int64)
    patch_of[vertex[~inner], quadrant[~inner]] = label[~inner]
    return patch_of, int(patches)


def _place_vertices(
    anchor: Floats, normal: Floats, patch: Ints, patches: int, cell: Floats, voxel: float
) -> Floats:
    """The point of each voxel that lies best on all the planes of its patch."""
    count = np.maximum(np.bincount(patch, minlength=patches), 1)[:, None]
    middle = _totals(anchor, patch, patches) / count
    vertices = _meet(anchor, normal, patch, middle)
    # A vertex stays in its voxel: then the facets of neighbouring voxels cannot cross.
    low, high = cell, cell + voxel
    out = np.flatnonzero(((vertices < low) | (vertices > high)).any(axis=1))
    if len(out):
        vertices[out] = _meet_in_box(
            anchor, normal, patch, out,
            np.clip(vertices[out], low[out], high[out]), low[out], high[out],
        )  # fmt: skip
    return vertices


def _totals(values: Floats, group: Ints, groups: int) -> Floats:
    """(groups, k) sums of the rows of each group."""
    sums = [np.bincount(group, weights=column, minlength=groups) for column in values.T]
    return np.stack(sums, axis=1)


def _matrices(normal: Floats, group: Ints, groups: int) -> Floats:
    """(groups, 3, 3) sums of n n^T."""
    upper = normal[:, [0, 0, 0, 1, 1, 2]] * normal[:, [0, 1, 2, 1, 2, 2]]
    return _totals(upper, group, groups)[:, [0, 1, 2, 1, 3, 4, 2, 4, 5]].reshape(-1, 3, 3)


def _meet(
    anchor: Floats, normal: Floats, group: Ints, middle: Floats, flat: float = FLAT
) -> Floats:
    """The point nearest to each group's middle among those that lie best on all its planes."""
    groups = len(middle)
    offset = np.einsum("ij,ij->i", normal, anchor - middle[group])
    right = _totals(normal * offset[:, None], group, groups)
    values, vectors = np.linalg.eigh(_matrices(normal, group, groups))
    keep = values > flat * values[:, 2:]
    inverse = np.where(keep, 1.0 / np.where(keep, values, 1.0), 0.0)
    along = np.einsum("nij,ni->nj", vectors, right) * inverse
    return np.asarray(middle + np.einsum("nij,nj->ni", vectors, along))


def _meet_in_box(
    anchor: Floats, normal: Floats, group: Ints, rows: Ints,
    point: Floats, low: Floats, high: Floats,
) -> Floats:  # fmt: skip
    """The same for some groups, held in a box, by coordinate descent from a point inside."""
    number = np.full(int(group.max()) + 1, -1)
    number[rows] = np.arange(len(rows))
    own = number[group] >= 0
    anchor, normal, group = anchor[own], normal[own], number[group[own]]
    matrix = _matrices(normal, group, len(rows))
    height = np.einsum("ij,ij->i", normal, anchor - point[group])
    right = _totals(normal * height[:, None], group, len(rows))
    move = np.zeros_like(point)
    for _ in range(DESCENT_ROUNDS):
        for k in range(3):
            own_k = np.maximum(matrix[:, k, k], 1e-6)
            slope = right[:, k] - np.einsum("nj,nj->n", matrix[:, k], move)
            move[:, k] = np.clip(
                move[:, k] + slope / own_k, low[:, k] - point[:, k], high[:, k] - point[:, k]
            )
    return point + move


def _quads(
    quads: Ints,
    crossings: _Crossings,
    on_edge: NDArray[np.bool_],
    vertices: Floats,
    anchor: Floats,
    normal: Floats,
    thickness: float,
) -> _Wall:
    """Cut the quadrilateral round each crossed grid edge into two triangles."""
    if (quads < 0).any():
        raise RuntimeError("the wall reaches the edge of its grid")
    axis, rising = crossings.axis[on_edge], crossings.rising[on_edge]
    corners = vertices[quads]
    # Seen along the grid edge the four corners lie in the four quadrants round it: a diagonal
    # that leaves both triangles counter-clockwise exists, and keeps facets from folding over.
    rows = np.arange(len(quads))
    u = corners[rows, :, (axis + 1) % 3]
    v = corners[rows, :, (axis + 2) % 3]

    def turn(a: int, b: int, c: int) -> Floats:
        du, dv = u[:, b] - u[:, a], v[:, b] - v[:, a]
        return np.asarray(du * (v[:, c] - v[:, a]) - dv * (u[:, c] - u[:, a]))

    first = np.minimum(turn(0, 1, 2), turn(0, 2, 3))
    second = np.minimum(turn(0, 1, 3), turn(1, 2, 3))
    # Where both will do, the one whose middle lies nearer to the exact plane.
    n, y = normal[on_edge], anchor[on_edge]
    off = np.einsum("nij,nj->ni", corners - y[:, None], n)
    nearer = np.abs(off[:, 0] + off[:, 2]) <= np.abs(off[:, 1] + off[:, 3])
    use_first = np.where((first > 0) & (second > 0), nearer, first >= second)
    split = np.where(
        use_first[:, None],
        quads[:, [0, 1, 2, 0, 2, 3]],
        quads[:, [0, 1, 3, 1, 2, 3]],
    ).reshape(-1, 2, 3)
    split = np.where(rising[:, None, None], split, split[:, :, ::-1])
    triangles = split.reshape(-1, 3)
    suspect = np.repeat((np.abs(off) > SPLIT_TOLERANCE * thickness).any(axis=1), 2)
    return _Wall(TriangleMesh(vertices, triangles.astype(np.int32)), suspect)


def _settle_suspects(wall: _Wall, depth: _Depth) -> _Wall:
    """The suspect triangles' vertices at exact depth; the triangles round them suspect too."""
    moved = np.zeros(len(wall.mesh.vertices), bool)
    moved[wall.mesh.triangles[wall.suspect].ravel()] = True
    vertices = wall.mesh.vertices.copy()
    vertices[moved] = _settle(vertices[moved], depth)
    round_moved = moved[wall.mesh.triangles].any(axis=1)
    mesh = _take_back(
        TriangleMesh(vertices, wall.mesh.triangles), wall.mesh.vertices, round_moved, depth
    )
    return _Wall(mesh, round_moved)


def _take_back(
    mesh: TriangleMesh, before: Floats, changed: NDArray[np.bool_], depth: _Depth
) -> TriangleMesh:
    """Undo the moves of vertices that made the surface run through itself.

    Args:
        mesh: with moved vertices.
        before: (n, 3) where they were, a surface free of crossings.
        changed: (m,) bool, the triangles with a moved vertex.
        depth: of the wall.
    """
    vertices = mesh.vertices.copy()
    result = TriangleMesh(vertices, mesh.triangles)
    for _ in range(TAKE_BACK_ROUNDS):
        depth.monitor.tick()
        crossing = crossing_triangles(result, changed, CROSSING_DEPTH * depth.thickness)
        back = np.unique(mesh.triangles[crossing])
        if not len(back) or (vertices[back] == before[back]).all():
            break
        vertices[back] = before[back]
        # Only what has just changed can cross anew.
        touched = np.zeros(len(vertices), bool)
        touched[back] = True
        changed = touched[mesh.triangles].any(axis=1)
    return result


def _split_straying_edges(wall: _Wall, depth: _Depth) -> _Wall:
    """Split the suspect triangles' edges whose middles stray, at points of exact depth."""
    mesh, count = wall.mesh, len(wall.mesh.vertices)
    t = mesh.triangles.astype(np.int64)
    ends = np.sort(np.stack([t, np.roll(t, -1, axis=1)], axis=2), axis=2)
    key = ends[:, :, 0] * count + ends[:, :, 1]
    edges = np.unique(key[wall.suspect])
    length = np.linalg.norm(mesh.vertices[edges // count] - mesh.vertices[edges % count], axis=1)
    edges = edges[length > SHORTEST_SPLIT * depth.thickness]
    if not len(edges):
        return wall
    middle = (mesh.vertices[edges // count] + mesh.vertices[edges % count]) / 2.0
    stray = np.abs(depth.nearest(middle)[1] - depth.thickness)
    split = stray > SPLIT_TOLERANCE * depth.thickness
    edges = edges[split]
    ends_of = np.stack([mesh.vertices[edges // count], mesh.vertices[edges % count]], axis=1)
    added = _points_among(ends_of, depth)
    cut = np.isin(key, edges)
    new = np.where(cut, count + np.searchsorted(edges, key), -1)
    # A triangle without a straying edge may still cut off a corner.
    blunt = np.flatnonzero(wall.suspect & ~cut.any(axis=1))
    corners = mesh.vertices[t[blunt]]
    off = np.abs(depth.nearest(corners.mean(axis=1))[1] - depth.thickness)
    off_limit = off > SPLIT_TOLERANCE * depth.thickness
    blunt = blunt[off_limit]
    tips = _points_among(corners[off_limit], depth)
    vertices = np.concatenate([mesh.vertices, added, tips])
    before = np.concatenate([mesh.vertices, ends_of.mean(axis=1), corners[off_limit].mean(axis=1)])
    tip = np.full(len(t), -1)
    tip[blunt] = count + len(added) + np.arange(len(blunt))
    # Turn every triangle so that one pattern a number of cut edges is enough: the first edge is
    # cut, and of two cut edges they are the first two.
    cuts = cut.sum(axis=1)
    cuts[blunt] = 4
    lead = np.where(cuts == 2, (cut.argmin(axis=1) + 1) % 3, cut.argmax(axis=1))
    turn = (lead[:, None] + np.arange(3)) % 3
    t, new = np.take_along_axis(t, turn, axis=1), np.take_along_axis(new, turn, axis=1)
    (a, b, c), (ab, bc, ca) = t.T, new.T
    none = cuts == 0
    pieces, changed = [t[none]], [np.zeros(int(none.sum()), bool)]
    for number, pattern in (
        (1, ((a, ab, c), (ab, b, c))),
        (2, ((ab, b, bc), (a, ab, bc), (a, bc, c))),
        (3, ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))),
        (4, ((a, b, tip), (b, c, tip), (c, a, tip))),
    ):
        rows = cuts == number
        for triangle in pattern:
            pieces.append(np.stack([corner[rows] for corner in triangle], axis=1))
            changed.append(np.ones(int(rows.sum()), bool))
    triangles = np.concatenate(pieces).astype(np.int32)
    suspect = np.concatenate(changed)
    return _Wall(_take_back(TriangleMesh(vertices, triangles), before, suspect, depth), suspect)


def _points_among(corners: Floats, depth: _Depth) -> Floats:
    """Points of the wall near the middles of edges or triangles; on a crease or tip they cross.

    Where the planes below the ends of an edge meet at the right depth, the edge cut off a crease.

    Args:
        corners: (n, 2 or 3, 3) ends of edges or corners of triangles.
        depth: of the wall.
    """
    count = corners.shape[1]
    middle = corners.mean(axis=1)
    samples = [middle, *(0.4 * middle + 0.6 * corners[:, k] for k in range(count))]
    anchors, normals = zip(*(depth.planes(points) for points in samples), strict=True)
    group = np.tile(np.arange(len(middle)), count + 1)
    point = _meet(np.concatenate(anchors), np.concatenate(normals), group, middle, SHARPEST)
    reach = CREASE_REACH * np.linalg.norm(corners - middle[:, None], axis=2).max(axis=1)
    wrong = np.linalg.norm(point - middle, axis=1) > reach
    wrong |= np.abs(depth.nearest(point)[1] - depth.thickness) > SPLIT_TOLERANCE * depth.thickness
    point[wrong] = middle[wrong]
    return _settle(point, depth)


def _settle(points: Floats, depth: _Depth) -> Floats:
    """The points at exact depth: moved along the nearest plane's normal, again where needed.

    Beyond a crease the moves alternate between its two sides and close in on it.
    """
    points = points.copy()
    rows = np.arange(len(points))
    for _ in range(SETTLE_ROUNDS):
        anchor, normal = depth.planes(points[rows])
        off = np.abs(np.einsum("ij,ij->i", points[rows] - anchor, normal))
        keep = off > SETTLED * depth.thickness
        points[rows[keep]] = anchor[keep]
        rows = rows[keep]
        if not len(rows):
            break
    return points


def _simplify_uncrossed(mesh: TriangleMesh, thickness: float, monitor: Monitor) -> TriangleMesh:
    """The simplified mesh; the given one where simplifying makes it run through itself."""
    simple = monitor.call(lambda: _simplify(mesh, SIMPLIFY_TOLERANCE * thickness))
    everywhere = np.ones(len(simple.triangles), bool)
    limit = CROSSING_DEPTH * thickness
    crossed = monitor.call(lambda: crossing_triangles(simple, everywhere, limit).any())
    return mesh if crossed else simple


def _simplify(mesh: TriangleMesh, tolerance: float) -> TriangleMesh:
    """The mesh with fewer triangles, moved by less than the tolerance, as a valid manifold."""
    solid: Any = manifold3d.Manifold(
        manifold3d.Mesh64(
            np.ascontiguousarray(mesh.vertices),
            np.ascontiguousarray(mesh.triangles, dtype=np.uint64),
        )
    )
    if solid.status() != manifold3d.Error.NoError:
        raise RuntimeError(f"the inner wall is not manifold: {solid.status()}")
    result = solid.simplify(tolerance).to_mesh64()
    return TriangleMesh(
        np.array(result.vert_properties[:, :3], np.float64), np.array(result.tri_verts, np.int32)
    )


def _drop_small(mesh: TriangleMesh, volume: float) -> TriangleMesh:
    """Without the closed surfaces that enclose less than the volume."""
    count = len(mesh.vertices)
    t = mesh.triangles
    graph = coo_matrix(
        (np.ones(2 * len(t), np.int8), (t[:, [0, 1]].ravel(), t[:, [1, 2]].ravel())),
        shape=(count, count),
    )
    label = connected_components(graph, directed=False)[1][t[:, 0]]
    enclosed = np.bincount(label, weights=mesh.signed_volumes())
    return compact(TriangleMesh(mesh.vertices, t[np.abs(enclosed)[label] >= volume]))

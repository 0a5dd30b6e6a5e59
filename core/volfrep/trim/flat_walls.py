# SPDX-License-Identifier: LGPL-2.1-or-later
"""Flat faces of a wall that lie along the octants, divided into squares as large as octants.

However a part's facets lie on such a face, the wall then looks the same from every cell that it
crosses there, so that one cut does for many (`alike_groups`). What is left between the squares and
the border of a face is triangulated anew (B. Delaunay, 1934); the border stays where it is.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..mesh import remesh
from ..mesh.topology import among_edges, edge_keys, pieces_of
from ..mesh.triangle_mesh import TriangleMesh, compact, corners_at
from ..util.ragged import pairs_in_steps
from ..util.types import Floats, Ints
from .culling import without_pinches

#: Squares begin so far into octants along both axes of a face, in units of their edge: no round
#: numbers, and two of them, since struts lie along octants, their middles and their diagonals.
SHIFT = (0.3719, 0.2893)
#: A face is flat, and lies along the octants, where it strays by no more than this, in units of an
#: octant's edge: rounding.
FLAT = 1e-9
#: A face has at least so many squares, or it stays as it is.
FEWEST = 64
#: Tiles have at least this part of the wall's area, or it stays as it is: to find out what is alike
#: would take longer than to cut it.
LEAST_SHARE = 1 / 3
#: Borders are sampled at this part of an octant's edge.
SAMPLE = 0.25
#: So many octants along tiles' sides, largest first: each is a whole number of cells, of which
#: octants mirror each other, and divides the one before.
TILES = (16, 8, 4)
#: About a tile there are squares for so many octants more; what is at a plane is that near to it,
#: in units of an octant.
ABOUT, MARGIN = 2, 2e-3
#: Corners of the square about a face lie so many octants out, at least.
FAR = 10.0
#: Triangles with less area than this, in units of a square, are none.
NO_AREA = 1e-9


@dataclass(frozen=True, eq=False)
class Face:
    """A flat face, the squares that fit in, and tiles of these.

    Attributes:
        axes: across it, and those along it, so that they turn as its triangles do.
        height: of its plane, mm.
        squares: (k, 2) that lie well inside, ascending.
        first: (2,) the square that `tile` begins at.
        tile: (nx, ny) the tile that each square belongs to, -1 for none.
    """

    axes: tuple[int, int, int]
    height: float
    squares: Ints
    first: Ints
    tile: Ints


@dataclass(frozen=True, eq=False)
class FlatWall:
    """A wall with squares on its flat faces.

    Attributes:
        mesh: closed, mm.
        faces: those with squares.
        face: (m,) the face of triangles that are halves of squares, -1 of all others.
        square: (m, 2) which square of its face each of these is of, counted as octants are.
    """

    mesh: TriangleMesh
    faces: list[Face]
    face: Ints
    square: Ints


@dataclass(frozen=True, eq=False)
class Tiles:
    """Parts of flat faces with the octants at them, all of one size.

    Attributes:
        octant: (k,) the tile that each octant belongs to, -1 for none.
        triangle: (s,) the tile of each half of a square, -1 for none.
        count: of tiles.
    """

    octant: Ints
    triangle: Ints
    count: int


def with_squares(boundary: TriangleMesh, corner: Floats, edge: float) -> FlatWall | None:
    """A wall with squares on its flat faces; None where little of it has tiles that may be alike.

    Args:
        boundary: closed mesh, mm.
        corner: (3,) the lowest corner of octant (0, 0, 0), mm.
        edge: of octants, mm.
    """
    faces = _flat_faces(boundary, corner, edge)
    if not faces:
        return None
    boundary, label = _with_short_borders(boundary, faces, edge)
    stays = np.ones(len(boundary.triangles), bool)
    points, count = [boundary.vertices], len(boundary.vertices)
    halves, rest, face, square = [], [], [], []
    divided: list[Face] = []
    for number, each in enumerate(faces):
        rows = np.flatnonzero(label == number)
        found = _divided(boundary, rows, each, corner, edge, count)
        if found is None:
            continue
        more, squares, ring = found
        stays[rows] = False
        points.append(more)
        count += len(more)
        halves.append(squares)
        rest.append(ring)
        face.append(np.full(len(squares), len(divided)))
        square.append(np.repeat(each.squares, 2, axis=0))
        divided.append(each)
    if not halves:
        return None
    own = sum(map(len, halves))
    triangles = np.concatenate([*halves, boundary.triangles[stays], *rest]).astype(np.int32)
    others = len(triangles) - own
    return FlatWall(
        compact(TriangleMesh(np.concatenate(points), triangles)),
        divided,
        np.concatenate([*face, np.full(others, -1)]),
        np.concatenate([*square, np.zeros((others, 2), np.int64)]),
    )


def tile(wall: FlatWall, places: Ints, low: Floats, high: Floats) -> Tiles | None:
    """Tiles of flat faces that have squares all about them; None for fewer than two.

    Args:
        wall: with squares.
        places: (k, 3) octants at it.
        low: (k, 3) lowest corners of their boxes, mm.
        high: (k, 3) highest ones, mm.
    """
    octant, triangle = np.full(len(places), -1), np.full(int((wall.face >= 0).sum()), -1)
    near, count = MARGIN * float((high - low).max()), 0
    for number, face in enumerate(wall.faces):
        (axis, *along), height = face.axes, face.height
        label = np.where(face.tile < 0, -1, face.tile + count)
        count = max(count, int(label.max()) + 1)
        mine = np.flatnonzero(wall.face == number)
        triangle[mine] = label[tuple((wall.square[mine] - face.first).T)]
        rows = np.flatnonzero(
            (low[:, axis] <= height + near) & (high[:, axis] >= height - near) & (octant < 0)
        )
        at = places[rows][:, along] - face.first
        inside = ((at >= 0) & (at < label.shape)).all(axis=1)
        octant[rows[inside]] = label[tuple(at[inside].T)]
    # Those without octants of their own are none.
    has = np.zeros(count + 1, bool)
    has[octant] = True
    has[-1] = False
    fresh, left = np.where(has, np.cumsum(has) - 1, -1), int(has.sum())
    return Tiles(fresh[octant], fresh[triangle], left) if left > 1 else None


def _tiles_of(squares: Ints) -> tuple[Ints, Ints]:
    """The first and the tiles of a `Face`, of its squares."""
    first = squares.min(axis=0) // TILES[0] * TILES[0] - TILES[0]
    squares = squares - first
    shape = (squares.max(axis=0) // TILES[0] + 2) * TILES[0]
    there, label = np.zeros(tuple(shape), np.int64), np.full(tuple(shape), -1)
    there[tuple(squares.T)] = 1
    total = np.pad(there, ((1, 0), (1, 0))).cumsum(0).cumsum(1)
    count = 0
    for size in TILES:
        begin = np.stack(
            np.meshgrid(*(np.arange(size, n - size, size) for n in shape), indexing="ij"), axis=-1
        ).reshape(-1, 2)
        begin = begin[label[tuple(begin.T)] < 0]
        (a, b), (c, d) = (begin - ABOUT).T, (begin + size + ABOUT).T
        filled = total[c, d] - total[a, d] - total[c, b] + total[a, b]
        begin = begin[filled == (size + 2 * ABOUT) ** 2]
        if len(begin) < 2:  # there is none that the only one of its size could be like
            continue
        for i, j in begin:
            label[i : i + size, j : j + size] = count
            count += 1
    return first, label


def _flat_faces(mesh: TriangleMesh, corner: Floats, edge: float) -> list[Face]:
    corners = corners_at(mesh.vertices, mesh.triangles)
    normal = remesh.normals(corners)
    area = 0.5 * np.linalg.norm(normal, axis=1)
    result = []
    for axis in range(3):
        height = corners[:, :, axis]
        flat = np.flatnonzero(np.ptp(height, axis=1) <= FLAT * edge)
        order = flat[np.argsort(height[flat, 0], kind="stable")]
        new = np.flatnonzero(np.diff(height[order, 0]) > FLAT * edge) + 1
        for plane in np.split(order, new):
            for turned in (False, True):
                rows = np.sort(plane[(normal[plane, axis] < 0) == turned])
                along = [(axis + 1) % 3, (axis + 2) % 3][:: -1 if turned else 1]
                if area[rows].sum() < FEWEST * edge**2:
                    continue
                squares = _squares_within(mesh, rows, along, corner, edge)
                if len(squares) < FEWEST:
                    continue
                first, label = _tiles_of(squares)
                if (label >= 0).any():
                    # One that there is: a mean of equal numbers may differ from them.
                    level = float(np.sort(height[rows, 0])[len(rows) // 2])
                    result.append(Face((axis, along[0], along[1]), level, squares, first, label))
    tiled = sum(int((face.tile >= 0).sum()) for face in result)
    return result if tiled * edge**2 >= LEAST_SHARE * area.sum() else []


def _open_sides(polygons: NDArray[Any], count: int) -> Ints:
    """(k, 2) the sides of (m, n) polygons, as they run, at which no other one of them follows."""
    start = polygons.astype(np.int64)
    end = np.roll(start, -1, axis=1)
    key, back = start * count + end, end * count + start
    return np.stack(np.divmod(key[~np.isin(key, back)], count), axis=1)


def _squares_within(
    mesh: TriangleMesh, rows: Ints, along: list[int], corner: Floats, edge: float
) -> Ints:
    """(k, 2) squares that lie inside of a flat face, none of them beside its border."""
    ends = mesh.vertices[_open_sides(mesh.triangles[rows], len(mesh.vertices))][:, :, along]
    ends = (ends - corner[along]) / edge - np.array(SHIFT)
    first = np.floor(ends.min(axis=(0, 1))).astype(np.int64) - 1
    ends = ends - first
    shape = np.ceil(ends.max(axis=(0, 1))).astype(np.int64) + 2
    # Rows of squares whose middles a side of the border runs through, and what lies beyond.
    low, high = np.sort(ends[:, :, 1], axis=1).T
    begin = np.ceil(low - 0.5).astype(np.int64)
    crossed = np.zeros(tuple(shape + 1), np.int64)
    for side, step in pairs_in_steps(np.maximum(np.ceil(high - 0.5).astype(np.int64) - begin, 0)):
        row = begin[side] + step
        (a, b), (c, d) = ends[side, 0].T, ends[side, 1].T
        at = a + (c - a) * (row + 0.5 - b) / (d - b)
        np.add.at(crossed, (np.ceil(at - 0.5).astype(np.int64), row), 1)
    inside = np.cumsum(crossed, axis=0)[:-1, :-1] % 2 == 1
    near = np.zeros(tuple(shape), bool)
    length = np.abs(ends[:, 1] - ends[:, 0]).max(axis=1)
    count = np.ceil(length / SAMPLE).astype(np.int64) + 1
    for side, step in pairs_in_steps(count):
        share = (step / (count[side] - 1).clip(1))[:, None]
        at = np.floor(ends[side, 0] * (1 - share) + ends[side, 1] * share).astype(np.int64)
        for i, j in np.ndindex(3, 3):
            place = np.clip(at + np.array([i - 1, j - 1]), 0, shape - 1)
            near[tuple(place.T)] = True
    # What is left out grows until no two squares of it meet in a corner only.
    out = (near | ~inside)[:, :, None]
    out = without_pinches(out, np.ones_like(out), (False, False, False))
    result: Ints = np.argwhere(~out[:, :, 0]) + first
    return result


def _with_short_borders(
    mesh: TriangleMesh, faces: list[Face], edge: float
) -> tuple[TriangleMesh, Ints]:
    """The same surface, no side at flat faces' borders longer than a square's; and their labels."""
    while True:
        label = _labels(mesh, faces, edge)
        count = len(mesh.vertices)
        of = (mesh.triangles[label == number] for number in range(len(faces)))
        ends = np.concatenate([_open_sides(triangles, count) for triangles in of])
        one, other = mesh.vertices[ends[:, 0]], mesh.vertices[ends[:, 1]]
        ends = ends[np.linalg.norm(one - other, axis=1) > edge]
        if not len(ends):
            return mesh, label
        keys = np.unique(edge_keys(ends[:, 0], ends[:, 1], count))
        wanted = partial(among_edges, keys=keys, count=count)
        points, triangles = remesh.split(mesh.vertices, mesh.triangles.astype(np.int64), wanted)
        mesh = TriangleMesh(points, triangles.astype(np.int32))


def _labels(mesh: TriangleMesh, faces: list[Face], edge: float) -> Ints:
    """(m,) the flat face that each triangle lies on; -1 for none."""
    corners = corners_at(mesh.vertices, mesh.triangles)
    normal = remesh.normals(corners)
    result = np.full(len(corners), -1)
    for number, face in enumerate(faces):
        axis, first, second = face.axes
        sign = 1.0 if (first + 1) % 3 == second else -1.0
        flat = (np.abs(corners[:, :, axis] - face.height) <= 2.0 * FLAT * edge).all(axis=1)
        result[flat & (sign * normal[:, axis] > 0)] = number
    return result


def _divided(
    mesh: TriangleMesh, rows: Ints, face: Face, corner: Floats, edge: float, count: int
) -> tuple[Floats, Ints, Ints] | None:
    """A flat face in squares, and triangles about them; None where these do not fit.

    Args:
        mesh: of the wall.
        rows: the face's triangles.
        face: with its squares.
        corner: (3,) the lowest corner of octant (0, 0, 0), mm.
        edge: of octants, mm.
        count: the number of the first new vertex.

    Returns:
        New vertices, mm; the halves of squares, one square after the other; and the others.
    """
    axis, *along = face.axes
    lattice = face.squares[:, None] + np.array([[0, 0], [1, 0], [1, 1], [0, 1]])
    least, size = lattice.min(), np.ptp(lattice) + 1
    key = (lattice[:, :, 0] - least) * size + lattice[:, :, 1] - least
    found, first, number = np.unique(key, return_index=True, return_inverse=True)
    number = number.reshape(-1, 4) + count
    more = np.empty((len(found), 3))
    more[:, axis] = face.height
    places = lattice.reshape(-1, 2)[first] + np.array(SHIFT)
    more[:, along] = corner[along] + edge * places
    halves = number[:, [[0, 1, 2], [0, 2, 3]]].reshape(-1, 3)
    # The ring between: each side of the squares is run along the other way there.
    border = _open_sides(mesh.triangles[rows], count)
    sides = np.concatenate([border, _open_sides(number, count + len(found))[:, ::-1]])
    used, local = np.unique(sides, return_inverse=True)
    points, old = np.empty((len(used), 3)), used < len(mesh.vertices)
    points[old], points[~old] = mesh.vertices[used[old]], more[used[~old] - count]
    flat = (points[:, along] - corner[along]) / edge
    ring = _between(flat - flat.mean(axis=0), local.reshape(-1, 2))
    return None if ring is None else (more, halves, used[ring])


def _between(points: Floats, sides: Ints) -> Ints | None:
    """(m, 3) triangles on the left of directed sides; None where some cross, or are not theirs.

    Args:
        points: (n, 2) all of them ends of sides.
        sides: (k, 2) closed outlines.
    """
    from scipy.spatial import Delaunay  # slow to import

    # Corners far out: what lies along one line is otherwise joined past its middle ones.
    far = np.abs(points).max() + FAR
    points = np.concatenate([points, far * np.array([[1, 1], [1, -1], [-1, 1], [-1, -1]])])
    triangles = Delaunay(points).simplices.astype(np.int64)
    a, b, c = (points[triangles[:, k]] for k in range(3))
    twice = (b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]
    triangles[twice < 0] = triangles[twice < 0][:, ::-1]
    count = np.int64(len(points))
    end = np.roll(triangles, -1, axis=1)
    key, back = triangles * count + end, end * count + triangles
    wanted = sides[:, 0] * count + sides[:, 1]
    on_side = np.isin(key, wanted)
    closed = on_side | np.isin(back, wanted)
    # Triangles that share an edge which is no side lie on the same side of all of them.
    order = np.argsort(key, axis=None)
    ranked = key.ravel()[order]
    place = np.minimum(np.searchsorted(ranked, back.ravel()), len(ranked) - 1)
    meets = (ranked[place] == back.ravel()) & ~closed.ravel()
    pieces, label = pieces_of(np.flatnonzero(meets) // 3, order[place[meets]] // 3, len(triangles))
    inside = np.zeros(pieces, bool)
    inside[label[on_side.any(axis=1)]] = True
    ring, twice = triangles[inside[label]], np.abs(twice)[inside[label]]
    start, end = _open_sides(ring, int(count)).T
    unlike = not np.array_equal(np.sort(start * count + end), np.sort(wanted))
    return None if unlike or (twice <= NO_AREA).any() else ring

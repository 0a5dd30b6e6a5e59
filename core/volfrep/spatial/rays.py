# SPDX-License-Identifier: LGPL-2.1-or-later
"""Ray casting through closed meshes: where lines cross them, and which points lie inside."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from ..mesh.triangle_mesh import TriangleMesh, corners_at
from ..util.progress import Monitor
from ..util.ragged import pairs_in_steps, spread
from ..util.types import Floats, Ints
from .even_points import even_points
from .self_intersection import boxes_in_bins

#: Bins along the longest side of the box of all segments and triangles.
MOST_BINS = 64
#: Segments that are looked for in bins at a time.
SEGMENTS_PER_STEP = 1 << 19
#: Bins that tell whether there is a line near a triangle are so many times finer than those that
#: hold about one each, and no more than so many along each axis.
FINER, MOST_FINE = 8, 4096


def inside_points(mesh: TriangleMesh, points: Floats, monitor: Monitor) -> NDArray[np.bool_]:
    """(n,) bool, which points lie inside a closed, outward oriented mesh, by winding number.

    A line goes up from every point; points and triangles meet in the bins of a grid seen along z.
    Lines through vertices and edges, and points of the surface, count as in `column_crossings`.

    >>> import trimesh
    >>> box = trimesh.creation.box((2, 2, 2))
    >>> mesh = TriangleMesh(box.vertices, box.faces.astype(np.int32))
    >>> inside_points(mesh, np.array([[0.0, 0.0, 0.9], [0.0, 0.0, 1.1]]), Monitor()).tolist()
    [True, False]
    """
    winding = np.zeros(len(points), np.int64)
    low, high = mesh.bounds
    within = np.flatnonzero(((points >= low) & (points < high)).all(axis=1))
    corners, seen = corners_at(mesh.vertices, mesh.triangles), points[within, :2]
    for triangle, line in lines_over(corners, seen):
        monitor.tick()
        hit, z, step = _crossings(corners[triangle], *seen[line].T)
        point = within[line[hit]]
        above = z > points[point, 2]
        np.add.at(winding, point[above], -step[above])
    return winding > 0


def points_within(solid: TriangleMesh, points_log2: int) -> Floats:
    """(n, 3) points spread evenly over a solid: those of 2 ** points_log2 in its box, mm."""
    low, high = solid.bounds
    points = low + even_points(3, points_log2) * (high - low)
    return np.asarray(points[inside_points(solid, points, Monitor())])


def lines_over(corners: Floats, points: Floats) -> Iterator[tuple[Ints, Ints]]:
    """Triangles (m, 3, 3) and upright lines at points (k, 2) that may cross, some at a time."""
    if not len(points):
        return
    flat = corners[:, :, :2]
    low, high = points.min(axis=0), points.max(axis=0)
    bins = max(int(np.sqrt(len(points))), 1)
    size = np.maximum(high - low, 1e-300) / bins
    cell = np.minimum((points - low) / size, bins - 1).astype(np.int64)
    name = cell[:, 0] * bins + cell[:, 1]
    order = np.argsort(name, kind="stable")
    begins = np.searchsorted(name[order], np.arange(bins * bins + 1))
    least, most = flat.min(axis=1), flat.max(axis=1)
    first = np.clip((least - low) / size, 0, bins - 1).astype(np.int64)
    last = np.clip((most - low) / size, 0, bins - 1).astype(np.int64)
    outside = ((most < low) | (least > high)).any(axis=1)
    finer = max(1, min(FINER, MOST_FINE // bins))
    outside |= ~_holds_any(points, low, size / finer, bins * finer, least, most)
    span = last - first + 1
    # Bins hold about one point each: as many pairs as bins.
    for row, place in pairs_in_steps(np.where(outside, 0, span.prod(axis=1))):
        along, across = np.divmod(place, span[row, 1])
        bin_of = (first[row, 0] + along) * bins + first[row, 1] + across
        pair, place = spread(begins[bin_of + 1] - begins[bin_of])
        yield row[pair], order[begins[bin_of[pair]] + place]


def _holds_any(
    points: Floats, low: Floats, size: Floats, bins: int, least: Floats, most: Floats
) -> NDArray[np.bool_]:
    """Which boxes, from `least` to `most`, share a bin with a point."""
    cell = np.minimum((points - low) / size, bins - 1).astype(np.int64)
    count = np.zeros((bins + 1, bins + 1), np.int32)
    np.add.at(count, (cell[:, 0] + 1, cell[:, 1] + 1), 1)
    below = count.cumsum(axis=0, dtype=np.int32).cumsum(axis=1, dtype=np.int32)
    x, y = np.clip((least - low) / size, 0, bins - 1).astype(np.int64).T
    right, top = np.clip((most - low) / size, 0, bins - 1).astype(np.int64).T + 1
    found: NDArray[np.bool_] = below[right, top] - below[x, top] - below[right, y] + below[x, y] > 0
    return found


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
    for every triangle, so that the crossings of a closed mesh always balance: simulation of
    simplicity (H. Edelsbrunner and E. P. Mücke, ACM Trans. Graphics 9, 1990).

    Returns:
        i, j: indices of the column; z: height of the crossing, mm; step: +1 where a line going
        up enters, -1 where it leaves.
    """
    corners = corners_at(mesh.vertices, mesh.triangles)
    low, high = corners.min(axis=1), corners.max(axis=1)
    first = np.stack([np.searchsorted(xs, low[:, 0]), np.searchsorted(ys, low[:, 1])], axis=1)
    last = np.stack(
        [np.searchsorted(xs, high[:, 0], "right"), np.searchsorted(ys, high[:, 1], "right")], axis=1
    )
    size = np.maximum(last - first, 0)
    found: list[tuple[Ints, Ints, Floats, Ints]] = []
    for owner, place in pairs_in_steps(size.prod(axis=1)):
        monitor.tick()
        i = first[owner, 0] + place // size[owner, 1]
        j = first[owner, 1] + place % size[owner, 1]
        hit, z, step = _crossings(corners[owner], xs[i], ys[j])
        found.append((i[hit], j[hit], z, step))
    if not found:
        none = np.zeros(0, np.int64)
        return none, none, np.zeros(0), none
    i, j, z, step = (np.concatenate(values) for values in zip(*found, strict=True))
    return i, j, z, step


def _crossings(corners: Floats, x: Floats, y: Floats) -> tuple[Ints, Floats, Ints]:
    """Which of n triangles (n, 3, 3) the lines through (x, y) cross, where, and in which sense."""
    side = np.empty((3, len(corners)))
    left = np.empty((3, len(corners)), bool)
    for k in range(3):
        side[k], left[k] = _side(corners[:, k], corners[:, (k + 1) % 3], x, y)
    up, down = left.all(axis=0), ~left.any(axis=0)
    hit = np.flatnonzero(up | down)
    weight = np.abs(side[:, hit])
    weight[:, weight.sum(axis=0) == 0] = 1.0
    height = corners[hit, :, 2]
    z = weight[1] * height[:, 0] + weight[2] * height[:, 1] + weight[0] * height[:, 2]
    z /= weight.sum(axis=0)
    return hit, z, np.where(up[hit], -1, 1)


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


def segment_crossings(mesh: TriangleMesh, start: Floats, end: Floats) -> tuple[Ints, Floats, Ints]:
    """Where (n, 3) segments pass through a closed mesh, in order along each.

    Returns:
        (k,) the segment; (k,) the place on it, above 0 and below 1; (k,) +1 where it leaves the
        mesh, -1 where it enters. A line through an edge crosses one of its two triangles.
    """
    corners = corners_at(mesh.vertices, mesh.triangles)
    boxes = corners.min(axis=1), corners.max(axis=1)
    parts = [slice(k, k + SEGMENTS_PER_STEP) for k in range(0, len(start), SEGMENTS_PER_STEP)]
    origin, most, longest = boxes[0].min(axis=0), boxes[1].max(axis=0), 0.0
    for part in parts:
        low, high = np.minimum(start[part], end[part]), np.maximum(start[part], end[part])
        origin, most = np.minimum(origin, low.min(axis=0)), np.maximum(most, high.max(axis=0))
        longest = max(longest, float((high - low).max()))
    size = max(longest / 4.0, float((most - origin).max()) / MOST_BINS)
    triangle, triangle_bin = boxes_in_bins(*boxes, origin, size)
    order = np.argsort(triangle_bin, kind="stable")
    triangle, triangle_bin = triangle[order], triangle_bin[order]
    found = [(np.zeros(0, np.int64), np.zeros(0), np.zeros(0, np.int64))]
    for part in parts:
        low, high = np.minimum(start[part], end[part]), np.maximum(start[part], end[part])
        segment, segment_bin = boxes_in_bins(low, high, origin, size)
        first = np.searchsorted(triangle_bin, segment_bin)
        count = np.searchsorted(triangle_bin, segment_bin, "right") - first
        several = np.flatnonzero(count)
        segment, first = segment[several], first[several]
        pairs = [(np.zeros(0, np.int64), np.zeros(0, np.int64), np.zeros(0), np.zeros(0, np.int64))]
        for row, place in pairs_in_steps(count[several]):
            a, b = segment[row], triangle[first[row] + place]
            touching = (low[a] <= boxes[1][b]).all(axis=1) & (high[a] >= boxes[0][b]).all(axis=1)
            a, b = a[touching] + part.start, b[touching]
            hit, share, way = _cross(mesh, start[a], end[a], b)
            pairs.append((a[hit], b[hit], share, way))
        a, b, share, way = (np.concatenate(column) for column in zip(*pairs, strict=True))
        # A pair may have met in several bins.
        _, once = np.unique(a * len(corners) + b, return_index=True)
        once = once[np.lexsort((share[once], a[once]))]
        found.append((a[once], share[once], way[once]))
    a, share, way = (np.concatenate(column) for column in zip(*found, strict=True))
    return a, share, way


def _cross(
    mesh: TriangleMesh, start: Floats, end: Floats, triangle: Ints
) -> tuple[Ints, Floats, Ints]:
    """Which segments run through their triangle, where, and which way."""
    along = end - start
    corner = mesh.triangles[triangle]
    left = np.empty((3, len(triangle)), bool)
    for k in range(3):
        one, two = corner[:, k], corner[:, (k + 1) % 3]
        # From the lesser index, so that the two triangles of an edge agree on its sides.
        turned = one > two
        low, high = np.where(turned, two, one), np.where(turned, one, two)
        p, q = mesh.vertices[low] - start, mesh.vertices[high] - start
        left[k] = (np.einsum("ij,ij->i", along, np.cross(p, q)) >= 0.0) ^ turned
    hit = np.flatnonzero(left.all(axis=0) | ~left.any(axis=0))
    a, b, c = (mesh.vertices[corner[hit, k]] for k in range(3))
    normal = np.cross(b - a, c - a)
    speed = np.einsum("ij,ij->i", normal, along[hit])
    height = np.einsum("ij,ij->i", normal, a - start[hit])
    share = np.divide(height, speed, out=np.full(len(hit), -1.0), where=speed != 0.0)
    between = (share > 0.0) & (share < 1.0)
    way = np.where(speed > 0.0, 1, -1)
    return hit[between], share[between], way[between]

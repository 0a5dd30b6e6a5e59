# SPDX-License-Identifier: LGPL-2.1-or-later
"""Self-intersection: where a surface runs through itself, by edges against triangles in bins."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from ..mesh.remesh import unit_normals
from ..mesh.triangle_mesh import TriangleMesh, box_of, compact, corners_at, triangle_boxes
from ..util.parallel import ParallelBackend, SharedArray
from ..util.ragged import pairs_in_steps, spread
from ..util.threads import in_threads
from ..util.types import Bools, Floats, Ints

#: Pairs of triangles that one vectorised step takes at a time.
PAIRS_PER_STEP = 500_000
#: The finest grid has no more bins along the largest triangle: their names have 21 bits an axis.
MOST_BINS = 1 << 16
#: Of larger triangles than those of the two finest grids the bins are finer so many times twofold:
#: most are needles or lie along an axis, and their boxes are empty but for a little.
FINER_BINS = 2
#: A box begins in a bin along x (1), y (2) and z (4).
ALONG_ALL = 7
#: The most cells along the longest side of the grid by which triangles near others are picked.
ABOUT_CELLS = 160
#: Triangles that are looked for in the grid at once.
BLOCK_TRIANGLES = 1 << 17
#: And of a mesh of more than so many, that a process looks for at a time.
CALL_TRIANGLES = 1 << 18
#: A plane may be so many of these cells from where rounding puts it.
PLANE_SLACK = 1e-3
#: A triangle with less than this of the area that its sides could have has no plane.
NO_PLANE = 1e-9
#: And so many of the finer cells, a byte each, by which few are picked of those.
MOST_CELLS = 1 << 26
#: The least side of what they divide, as a part of its longest one.
LEAST_REACH = 1e-3


def crossing_triangles(mesh: TriangleMesh, among: Bools, depth: float) -> Bools:
    """The triangles that an edge of another triangle runs through.

    Args:
        mesh: the surface, mm.
        among: (m,) bool, triangles to look at; pairs of two others are not tested.
        depth: an edge has to stick out on both sides of a triangle by more than this, mm.

    Returns:
        (m,) bool: both the triangles that are run through and those whose edges do it.
    """
    one, other, _ = crossing_edges(mesh, among, depth)
    crossing = np.zeros(len(mesh.triangles), bool)
    crossing[one] = True
    crossing[other] = True
    return crossing


def crossing_edges(mesh: TriangleMesh, among: Bools, depth: float) -> tuple[Ints, Ints, Floats]:
    """Where edges of triangles run through other triangles.

    Args:
        mesh: the surface, mm.
        among: (m,) bool, triangles to look at; pairs of two others are not tested.
        depth: an edge has to stick out on both sides of a triangle by more than this, mm.

    Returns:
        (k,) triangles whose edge it is, (k,) those that it runs through, and (k, 3) where, mm.
    """
    found = [(np.zeros(0, np.int64), np.zeros(0, np.int64), np.zeros((0, 3)))]
    if among.any():
        rows = np.flatnonzero(among | about(mesh, among))
        part = TriangleMesh(mesh.vertices, mesh.triangles[rows])
        for one, other, points in _crossing_edges(part, among[rows], depth):
            found.append((rows[one], rows[other], points))
    one, other, points = (np.concatenate(column) for column in zip(*found, strict=True))
    return one, other, points


def _crossing_edges(
    mesh: TriangleMesh, among: Bools, depth: float
) -> Iterator[tuple[Ints, Ints, Floats]]:
    corners = corners_at(mesh.vertices, mesh.triangles)
    normal = unit_normals(corners)
    for a, b in _together(close_pairs(corners, among)):
        # Neighbours over an edge have no edge that could run through the other.
        shared = np.zeros(len(a), np.int8)
        for i in range(3):
            for j in range(3):
                shared += mesh.triangles[a, i] == mesh.triangles[b, j]
        a, b = a[shared < 2], b[shared < 2]
        for _ in range(2):
            cut = _on_both_sides(_heights(corners, normal, a, b), 0.0)
            a, b = b[cut], a[cut]
        for one, other in ((a, b), (b, a)):
            heights = _heights(corners, normal, one, other)
            for hit, points in _edges_cross(mesh, corners, heights, one, other, depth):
                yield one[hit], other[hit], points


def close_pairs(corners: Floats, among: Bools, margin: float = 0.0) -> Iterator[tuple[Ints, Ints]]:
    """Pairs of triangles whose boxes overlap, at least one of them chosen, each once.

    They meet in the bins of several grids, each twice as coarse as the one before: every triangle
    waits in the bins of its own size (`FINER_BINS`), and visits those and all coarser ones.

    Args:
        corners: (m, 3, 3) of the triangles, mm.
        among: (m,) bool, the chosen ones.
        margin: by which each box is larger than its triangle on every side, mm.
    """
    return (portion() for portion in portions_of_pairs(corners, among, margin))


def portions_of_pairs(
    corners: Floats, among: Bools, margin: float = 0.0
) -> Iterator[Callable[[], tuple[Ints, Ints]]]:
    """What finds the pairs of `close_pairs`, portion by portion, on any thread."""
    if not len(corners):
        return
    low, high = corners.min(axis=1) - margin, corners.max(axis=1) + margin
    extent = (high - low).max(axis=1)
    size = max(float(np.percentile(extent, 50)), float(extent.max()) / MOST_BINS)
    level = np.ceil(np.log2(np.maximum(extent / size, 1.0))).astype(np.int64)
    origin = low.min(axis=0)
    for grid in np.unique(level):
        waiting, smaller = np.flatnonzero(level == grid), np.flatnonzero(level < grid)
        cell = size * 2.0 ** (grid if grid < FINER_BINS else grid - FINER_BINS)
        # Chosen ones visit all others; these visit the chosen ones that are larger than they.
        chosen = np.concatenate([waiting[among[waiting]], smaller[among[smaller]]])
        for visiting, visited in ((np.sort(chosen), waiting),
                                  (smaller[~among[smaller]], waiting[among[waiting]])):  # fmt: skip
            if not (len(visiting) and len(visited)):
                continue
            waits, its_bin, begins = _boxes_in_bins(low[visited], high[visited], origin, cell)
            order = np.argsort(its_bin, kind="stable")
            waits, its_bin, begins = visited[waits[order]], its_bin[order], begins[order]
            visits, bins, ours = _boxes_in_bins(low[visiting], high[visiting], origin, cell)
            visits = visiting[visits]
            first = np.searchsorted(its_bin, bins)
            count = np.searchsorted(its_bin, bins, "right") - first
            if not count.any():
                continue
            bins_of = _Bins(waits, begins, visits, ours, first, count)
            total = np.cumsum(count)
            steps = np.searchsorted(total, np.arange(0, int(count.sum()), PAIRS_PER_STEP))
            for begin, end in zip(steps, [*steps[1:], len(count)], strict=True):
                yield partial(
                    _pairs_in, bins_of, int(begin), int(end), low, high, level, grid, among
                )


@dataclass(frozen=True, eq=False)
class _Bins:
    """Triangles in the bins of a grid, and those that visit them there.

    Attributes:
        waits, begins: (w,) triangles, bin by bin, and along which axes they begin in it.
        visits, ours: (v,) the same of those that visit a bin.
        first, count: (v,) where those that wait in it are.
    """

    waits: Ints
    begins: NDArray[np.uint8]
    visits: Ints
    ours: NDArray[np.uint8]
    first: Ints
    count: Ints


def _pairs_in(
    bins: _Bins, begin: int, end: int, low: Floats, high: Floats, level: Ints, grid: int,
    among: Bools,
) -> tuple[Ints, Ints]:  # fmt: skip
    """The pairs that some of the visits find."""
    row, place = spread(bins.count[begin:end])
    row += begin
    place += bins.first.take(row, mode="clip")
    # Boxes overlap in many bins: in the first of these one of the two begins.
    begins = bins.ours.take(row, mode="clip") | bins.begins.take(place, mode="clip")
    here = np.flatnonzero(begins == ALONG_ALL)
    a = bins.visits.take(row.take(here, mode="clip"), mode="clip")
    b = bins.waits.take(place.take(here, mode="clip"), mode="clip")
    # Of two chosen ones of a size both visit: once is enough.
    keep = (a < b) | (level.take(a, mode="clip") < grid) | ~among.take(b, mode="clip")
    a, b = (each.take(np.flatnonzero(keep), mode="clip") for each in (a, b))
    for axis in range(3):
        lo, hi = low[:, axis], high[:, axis]
        keep = lo.take(a, mode="clip") <= hi.take(b, mode="clip")
        keep &= lo.take(b, mode="clip") <= hi.take(a, mode="clip")
        a, b = (each.take(np.flatnonzero(keep), mode="clip") for each in (a, b))
    return a, b


def _together(pairs: Iterator[tuple[Ints, Ints]]) -> Iterator[tuple[Ints, Ints]]:
    """The same pairs in fewer and larger portions."""
    waiting: list[tuple[Ints, Ints]] = []
    for pair in pairs:
        waiting.append(pair)
        if sum(len(a) for a, _ in waiting) > PAIRS_PER_STEP // 4:
            yield np.concatenate([a for a, _ in waiting]), np.concatenate([b for _, b in waiting])
            waiting = []
    if waiting:
        yield np.concatenate([a for a, _ in waiting]), np.concatenate([b for _, b in waiting])


def boxes_in_bins(low: Floats, high: Floats, origin: Floats, size: float) -> tuple[Ints, Ints]:
    """Every box with every bin of a grid that it reaches into, as (box, bin) pairs."""
    return _boxes_in_bins(low, high, origin, size)[:2]


def _boxes_in_bins(
    low: Floats, high: Floats, origin: Floats, size: float
) -> tuple[Ints, Ints, NDArray[np.uint8]]:
    """As `boxes_in_bins`, and along which axes the box begins in the bin: a bit for each."""
    # Axis by axis, which numpy takes in faster than rows of three; most boxes reach into one bin.
    first, span = [], []
    for axis in range(3):
        begin = np.floor((low[:, axis] - origin[axis]) / size).astype(np.int64)
        end = np.floor((high[:, axis] - origin[axis]) / size).astype(np.int64)
        first.append(begin)
        span.append(end - begin + 1)
    count = span[0] * span[1] * span[2]
    row = np.repeat(np.arange(len(count)), count)
    number = ((first[0] << 42) + (first[1] << 21) + first[2])[row]
    begins = np.full(len(row), ALONG_ALL, np.uint8)
    several = count > 1
    some = np.flatnonzero(several[row])
    owner, place = spread(count[several])
    across, up = (each[several][owner] for each in span[1:])
    rest, along_z = np.divmod(place, up)
    along_x, along_y = np.divmod(rest, across)
    number[some] += (along_x << 42) + (along_y << 21) + along_z
    begins[some] = (along_x == 0) | (along_y == 0) << 1 | (along_z == 0) << 2
    return row, number, begins


def meeting_boxes(
    low: Floats, high: Floats, least: Floats, most: Floats, size: float
) -> tuple[Ints, Ints]:
    """Boxes and other boxes that meet, as (box, other) pairs, each once.

    Args:
        low: (n, 3) lowest corners of the boxes.
        high: (n, 3) their highest ones.
        least: (m, 3) lowest corners of the others.
        most: (m, 3) their highest ones.
        size: of the bins in which they are looked for; of no effect on what is found.
    """
    origin = np.minimum(low.min(axis=0), least.min(axis=0))
    box, its_bin, ours = _boxes_in_bins(low, high, origin, size)
    order = np.argsort(its_bin, kind="stable")
    box, its_bin, ours = box[order], its_bin[order], ours[order]
    other, bins, theirs = _boxes_in_bins(least, most, origin, size)
    begin = np.searchsorted(its_bin, bins)
    row, place = spread(np.searchsorted(its_bin, bins, "right") - begin)
    place += begin.take(row, mode="clip")
    # Boxes overlap in many bins: in the first of these one of the two begins.
    begins = ours.take(place, mode="clip") | theirs.take(row, mode="clip")
    here = np.flatnonzero(begins == ALONG_ALL)
    a = box.take(place.take(here, mode="clip"), mode="clip")
    b = other.take(row.take(here, mode="clip"), mode="clip")
    for axis in range(3):
        ends = (np.ascontiguousarray(each[:, axis]) for each in (low, high, least, most))
        lowest, highest, its_least, its_most = ends
        meets = lowest.take(a, mode="clip") <= its_most.take(b, mode="clip")
        meets &= its_least.take(b, mode="clip") <= highest.take(a, mode="clip")
        kept = np.flatnonzero(meets)
        a, b = a.take(kept, mode="clip"), b.take(kept, mode="clip")
    return a, b


def _heights(corners: Floats, normal: Floats, a: Ints, b: Ints) -> Floats:
    """(k, 3) the corners of triangles a above the planes of triangles b."""
    above: Floats = np.einsum("nij,nj->ni", corners[a] - corners[b, :1], normal[b])
    return above


def _on_both_sides(heights: Floats, depth: float) -> Bools:
    x, y, z = heights.T
    above, below = np.maximum(np.maximum(x, y), z), np.minimum(np.minimum(x, y), z)
    return np.asarray((above > depth) & (below < -depth), np.bool_)


def _edges_cross(
    mesh: TriangleMesh, corners: Floats, height: Floats, a: Ints, b: Ints, depth: float
) -> Iterator[tuple[Ints, Floats]]:
    """Where an edge of triangle a, without a vertex in common with b, runs through b."""
    for k in range(3):
        following = (k + 1) % 3
        from_above = (height[:, k] > depth) & (height[:, following] < -depth)
        from_below = (height[:, k] < -depth) & (height[:, following] > depth)
        rows = np.flatnonzero(from_above | from_below)
        edge = mesh.triangles[a[rows]][:, [k, following]]
        shared = (edge[:, :, None] == mesh.triangles[b[rows]][:, None, :]).any(axis=(1, 2))
        rows = rows[~shared]
        p, q = corners[a[rows], k], corners[a[rows], following]
        sides = []
        for e in range(3):
            u, v = corners[b[rows], e], corners[b[rows], (e + 1) % 3]
            sides.append(np.einsum("ij,ij->i", np.cross(q - p, u - p), v - p))
        one_side = np.all([s > 0 for s in sides], axis=0) | np.all([s < 0 for s in sides], axis=0)
        rows, p, q = rows[one_side], p[one_side], q[one_side]
        share = height[rows, k] / (height[rows, k] - height[rows, following])
        yield rows, p + share[:, None] * (q - p)


def about(mesh: TriangleMesh, among: Bools, backend: ParallelBackend | None = None) -> Bools:
    """(m,) which triangles' boxes reach into the cells of a grid that the chosen ones go through.

    Whatever meets a chosen one does so in a cell that this goes through. Processes of a backend
    look at some of the triangles each, in cells of their own.
    """
    if among.all():
        return among
    return near_corners(mesh, corners_at(mesh.vertices, mesh.triangles[among]), backend) | among


def near_corners(
    mesh: TriangleMesh, corners: Floats, backend: ParallelBackend | None = None
) -> Bools:
    """As `about`, of triangles with (k, 3, 3) corners, mm, that are none of the mesh's."""
    count = len(mesh.triangles)
    if backend is not None and backend.uses_processes and count > CALL_TRIANGLES:
        with backend.sharing(mesh.vertices, mesh.triangles, corners) as shared:
            starts = range(0, count, CALL_TRIANGLES)
            calls = ((*shared, start, CALL_TRIANGLES) for start in starts)
            return np.concatenate(list(backend.starmap(_near_some, calls)))
    least, most = box_of(mesh.vertices)
    cells_along = min(ABOUT_CELLS, 8 + int(np.cbrt(len(mesh.triangles))))
    size = max(float((most - least).max()) / cells_along, 1e-300)
    # Cells of every vertex first: there are half as many of them as of triangles.
    cells = [((mesh.vertices[:, k] - low) / size).astype(np.int16) for k, low in enumerate(least)]
    shape = tuple(int(cell.max()) + 1 for cell in cells)
    chosen = corners - least
    covered = _gone_through(chosen / size, shape)
    where = np.zeros(len(mesh.vertices), np.int32)
    for cell, step in zip(cells, (shape[1] * shape[2], shape[2], 1), strict=True):
        where += cell.astype(np.int32) * np.int32(step)
    is_covered = covered.ravel()[where]
    # How many covered cells there are up to each.
    taken = np.pad(covered.astype(np.int32), ((1, 0),) * 3)
    taken = taken.cumsum(0, np.int32).cumsum(1, np.int32).cumsum(2, np.int32)

    def reaching(begin: int) -> Bools:
        corners = np.ascontiguousarray(mesh.triangles[begin : begin + BLOCK_TRIANGLES].T)
        # A triangle with a corner in a covered cell reaches into one; with all of them in one
        # cell that tells all.
        a, b, c = (is_covered.take(row, mode="clip") for row in corners)
        result: Bools = a | b | c
        a, b, c = (where[row] for row in corners)
        rows = np.flatnonzero(~result & ((a != b) | (a != c)))
        result[rows] = _cells_within(taken, *triangle_boxes(cells, corners[:, rows])) > 0
        return result

    starts = range(0, len(mesh.triangles), BLOCK_TRIANGLES)
    result = np.concatenate(list(in_threads(reaching, starts)))
    rows = np.flatnonzero(result)
    if len(rows):
        low, high = triangle_boxes(mesh.vertices.T, mesh.triangles[rows].T)
        result[rows] = _nearer(low - least[:, None], high - least[:, None], chosen)
    return result


def _near_some(
    vertices: SharedArray, triangles: SharedArray, corners: SharedArray, start: int, count: int
) -> Bools:
    """As `near_corners`, of so many of a mesh's triangles."""
    some = triangles.array[start : start + count]
    part = compact(TriangleMesh(vertices.array, some))
    (low, high), every = box_of(part.vertices), corners.array
    here = ((every.max(axis=1) >= low) & (every.min(axis=1) <= high)).all(axis=1)
    return near_corners(part, every[here]) if here.any() else np.zeros(len(some), bool)


def _cells_within(
    taken: NDArray[np.int32], low: NDArray[np.int16], high: NDArray[np.int16]
) -> NDArray[np.int32]:
    """(k,) how many chosen cells lie in boxes from cells to cells.

    Args:
        taken: how many there are before each cell along all axes.
        low: (3, k) the boxes' first cells.
        high: (3, k) their last ones.
    """
    flat, total = taken.ravel(), np.zeros(len(low[0]), np.int32)
    steps = [taken.shape[1] * taken.shape[2], taken.shape[2], 1]
    low_at = [one.astype(np.int32) * step for one, step in zip(low, steps, strict=True)]
    high_at = [(two.astype(np.int32) + 1) * step for two, step in zip(high, steps, strict=True)]
    sides = list(zip(low_at, high_at, strict=True))
    for i, j, k in np.ndindex(2, 2, 2):
        part = flat[sides[0][i] + sides[1][j] + sides[2][k]]
        total += part if (i + j + k) % 2 else -part
    return total


def _nearer(low: Floats, high: Floats, chosen: Floats) -> Bools:
    """As `about`, in finer cells, of boxes, corners (3, k), that are mostly no larger than one.

    Larger ones are not told apart. The corners of the chosen triangles are (c, 3, 3).
    """
    reach = high.max(axis=1)
    reach = np.maximum(reach, max(float(reach.max()) * LEAST_REACH, 1e-300))
    across = float(np.median((high - low).max(axis=0)))
    size = max(float(np.cbrt(reach.prod() / MOST_CELLS)), across)
    covered = _gone_through(chosen / size, tuple((reach / size).astype(np.int64) + 1))
    first, last = ([(each / size).astype(np.int32) for each in end] for end in (low, high))
    result = np.any([b - a > 1 for a, b in zip(first, last, strict=True)], axis=0)
    rows = np.flatnonzero(~result)
    ends = [(a[rows], b[rows]) for a, b in zip(first, last, strict=True)]
    for i, j, k in np.ndindex(2, 2, 2):
        result[rows] |= covered[ends[0][i], ends[1][j], ends[2][k]]
    return np.asarray(result, np.bool_)


def _gone_through(corners: Floats, shape: tuple[int, ...]) -> Bools:
    """Bool of a shape, the cells in the boxes of triangles that their planes go through.

    Args:
        corners: (k, 3, 3) of the triangles, in cells.
        shape: of the grid; what lies beyond it is left out.
    """
    low = np.maximum(np.floor(corners.min(axis=1)).astype(np.int64), 0)
    high = np.minimum(np.floor(corners.max(axis=1)).astype(np.int64), np.array(shape) - 1)
    e, f = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    normal = np.cross(e, f)
    # Along the axis that it faces most the plane goes through a few cells of each column.
    axis = np.abs(normal).argmax(axis=1)
    every = np.arange(len(corners))
    other = np.stack([(axis + 1) % 3, (axis + 2) % 3], axis=1)
    up = normal[every, axis]
    sizes = np.linalg.norm(e, axis=1) * np.linalg.norm(f, axis=1)
    flat = np.abs(up) <= NO_PLANE * sizes
    slope = -normal[every[:, None], other] / np.where(flat, 1.0, up)[:, None]
    slope[flat] = 0.0
    middle = corners[every, 0, axis]
    middle -= (slope * (corners[every[:, None], 0, other] - 0.5)).sum(axis=1)
    span = np.maximum(high - low + 1, 0)
    wide, deep = span[every[:, None], other], span[every, axis]
    # What has no plane may be anywhere in its box.
    half = 0.5 * np.abs(slope).sum(axis=1) + PLANE_SLACK
    deep = np.where(flat, deep, np.minimum(deep, (2.0 * half).astype(np.int64) + 2))
    half[flat] = np.inf
    result = np.zeros(shape, bool)
    steps = np.array([shape[1] * shape[2], shape[2], 1])
    for row, place in pairs_in_steps(wide[:, 0] * wide[:, 1] * deep):
        place, ahead = np.divmod(place, deep[row])
        along = np.stack(np.divmod(place, wide[row, 1]), axis=1)
        along += low[row[:, None], other[row]]
        height = middle[row] + (slope[row] * along).sum(axis=1)
        first = np.maximum(np.floor(height - half[row]), low[row, axis[row]])
        last = np.minimum(np.floor(height + half[row]), high[row, axis[row]])
        at = first.astype(np.int64) + ahead
        inside = at <= last
        flat_at = at * steps[axis[row]] + (along * steps[other[row]]).sum(axis=1)
        result.reshape(-1)[flat_at[inside]] = True
    return result

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Assembly: meshed octants instanced side by side into one welded surface.

Vertices are numbered on the complex of octants: those inside an octant, those on each face and
those on each edge between octants are counted once, and an octant finds the numbers of its own
by where it lies. No coordinates are compared.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from ..mesh.triangle_mesh import TriangleMesh, box_of
from ..octants import caps
from ..octants.octant import STEPS, Octant, OctantGrid, OctantKey, frames
from ..util.progress import Monitor
from ..util.types import Floats

#: Octants are placed in groups of about so many vertices or triangles: a cancel is soon seen.
CHUNK_VERTICES = 200_000
#: With so many times fewer vertices wanted than there are, these are sorted and not counted.
FEW = 32
#: The entity of vertices inside an octant.
INSIDE = 13


@dataclass(frozen=True, eq=False)
class Layout:
    """The octants of a grid with all their vertices numbered.

    Attributes:
        grid: which octant lies where.
        octants: their meshes.
        places: per key of the grid, (k, 3) where it lies.
        base: first vertex number of each vertex, edge, face and cell of the octants' complex, on
            the doubled grid: even places are planes between octants.
        count: of all vertices.
        first: (3,) the corner that octant (0, 0, 0) has on its high side, counted from the grid's
            origin: of a cutting of a larger grid, which keeps its coordinates to the last bit.
    """

    grid: OctantGrid
    octants: dict[OctantKey, Octant]
    places: list[NDArray[np.int64]]
    base: NDArray[np.int32]
    count: int
    first: NDArray[np.int64] = field(default_factory=lambda: np.zeros(3, np.int64))

    def frames(self, place: NDArray[np.int64]) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        """The grid corner that octants lie about, and the direction of their axes."""
        corner, sign = frames(place)
        return corner + self.first, sign

    @property
    def triangles(self) -> int:
        """How many there are on all the octants."""
        pairs = zip(self.grid.keys, self.places, strict=True)
        return sum(len(place) * len(self.octants[key].triangles) for key, place in pairs)


_STEPS = np.stack(np.unravel_index(np.arange(27), (3, 3, 3)), axis=1)


def lay_out(grid: OctantGrid, octants: dict[OctantKey, Octant]) -> Layout:
    """Number the vertices of all the octants of the grid, each once."""
    places, count = _counted(grid, octants)
    total = int(count.sum(dtype=np.int64))
    base = np.cumsum(count, dtype=np.int32)
    base -= count
    return Layout(grid, octants, places, base.reshape(_complex_shape(grid)), total)


def lay_out_some(layout: Layout, where: NDArray[np.bool_]) -> Layout:
    """Some of the octants without their corners, numbered as among all; their own count."""
    grid = replace(layout.grid, kind=np.where(where, layout.grid.kind, np.int16(-1)))
    places, count = _counted(grid, layout.octants)
    return Layout(grid, layout.octants, places, layout.base, int(count.sum(dtype=np.int64)))


def _counted(
    grid: OctantGrid, octants: dict[OctantKey, Octant]
) -> tuple[list[NDArray[np.int64]], NDArray[np.int32]]:
    """Per key of the grid where it lies, and how many vertices all parts of the complex have."""
    count = np.zeros(int(np.prod(_complex_shape(grid))), np.int32)
    places = [np.argwhere(grid.kind == k) for k in range(len(grid.keys))]
    for key, place in zip(grid.keys, places, strict=True):
        number = np.bincount(octants[key].entity, minlength=27)
        x, y, z = _entity_rows(grid, place)
        for entity in np.flatnonzero(number):
            i, j, k = _STEPS[entity]
            count[x[i] + y[j] + z[k]] = number[entity]
    return places, count


def numbers(layout: Layout, octant: Octant, place: NDArray[np.int64]) -> NDArray[np.int32]:
    """(k, n) numbers of the vertices of an octant at k places."""
    return numbers_at(layout, octant.entity, octant.rank, place)


def numbers_at(
    layout: Layout, entity: NDArray[np.int8], rank: NDArray[np.int32], place: NDArray[np.int64]
) -> NDArray[np.int32]:
    """(k, n) numbers of vertices of an octant at k places, by their entities and ranks on these."""
    used, column = np.unique(entity, return_inverse=True)
    first = np.empty((len(place), len(used)), np.int32)
    base, (x, y, z) = layout.base.ravel(), _entity_rows(layout.grid, place)
    for column_of, (i, j, k) in enumerate(_STEPS[used]):
        first[:, column_of] = base[x[i] + y[j] + z[k]]
    result: NDArray[np.int32] = first[:, column.ravel()] + rank
    return result


def coordinates(layout: Layout, monitor: Monitor) -> Floats:
    """(n, 3) coordinates of all the numbered vertices, mm."""
    vertices = np.empty((layout.count, 3))
    for number, points in placed_octants(layout, None, monitor):
        vertices[number] = points
    return vertices


def coordinates_of(
    layout: Layout,
    wanted: NDArray[np.int32],
    where: NDArray[np.bool_],
    monitor: Monitor,
    *,
    shared: bool = False,
) -> Floats:
    """(k, 3) coordinates of some of the numbered vertices, mm.

    Args:
        layout: the numbered octants.
        wanted: (k,) numbers, ascending.
        where: octants that have all of them.
        monitor: for cancel.
        shared: whether all of them lie on faces of octants.
    """
    vertices = np.empty((len(wanted) + 1, 3))
    if FEW * len(wanted) > layout.count:
        # What is not asked for goes to the last row: a place for each is soon found.
        place = np.full(layout.count, len(wanted), np.int32)
        place[wanted] = np.arange(len(wanted))
        for number, points in placed_octants(layout, where, monitor, shared=shared):
            vertices[place.take(number, mode="clip")] = points
        return vertices[:-1]
    for number, points in placed_octants(layout, where, monitor, shared=shared):
        row = np.minimum(np.searchsorted(wanted, number), len(wanted) - 1)
        found = wanted[row] == number
        vertices[row[found]] = points[found]
    return vertices[:-1]


def placed_octants(
    layout: Layout, where: NDArray[np.bool_] | None, monitor: Monitor, *, shared: bool = False
) -> Iterator[tuple[NDArray[np.int32], Floats]]:
    """Octants some at a time: (k, n) numbers of their vertices and (k, n, 3) their coordinates.

    With `shared` those of vertices on their faces only.
    """
    grid = layout.grid
    for key, place in zip(grid.keys, layout.places, strict=True):
        octant = layout.octants[key]
        if where is not None:
            place = place[where[tuple(place.T)]]
        if shared:
            at = octant.entity != INSIDE
            octant = replace(
                octant, vertices=octant.vertices[at], triangles=octant.triangles[:0],
                entity=octant.entity[at], rank=octant.rank[at],
            )  # fmt: skip
        if not len(octant.vertices):
            continue
        steps = in_steps(grid, octant)
        size = max(1, CHUNK_VERTICES // len(octant.vertices))
        for begin in range(0, len(place), size):
            part = place[begin : begin + size]
            corner, sign = layout.frames(part)
            points = placed(grid, corner[:, None, :], sign[:, None, :] * steps)
            yield numbers(layout, octant, part), points
            monitor.tick()


def in_steps(grid: OctantGrid, octant: Octant) -> Floats:
    """(n, 3) the vertices of an octant in its own frame, in whole steps."""
    steps: Floats = np.rint(octant.vertices / (0.5 * grid.cell_size / STEPS))
    return steps


def placed(grid: OctantGrid, corner: NDArray[np.int64], steps: Floats) -> Floats:
    """Coordinates in mm of what lies so many steps from corners of the grid.

    The sum in steps is exact, so that equal places have equal coordinates.
    """
    result = corner * (2.0 * STEPS) + steps
    result *= 0.5 * grid.cell_size / STEPS
    result += grid.origin
    return result


def box(layout: Layout) -> Floats:
    """(2, 3) lowest and highest coordinate of all the vertices, mm; zeros where there are none."""
    grid, boxes = layout.grid, []
    for key, place in zip(grid.keys, layout.places, strict=True):
        octant = layout.octants[key]
        if not len(octant.vertices) or not len(place):
            continue
        steps = in_steps(grid, octant)
        least, most = steps.min(axis=0), steps.max(axis=0)
        # Along each axis, in whole steps, that of octants of either direction.
        corners, signs = layout.frames(place)
        low, high = np.full(3, np.inf), np.full(3, -np.inf)
        for axis, (corner, sign) in enumerate(zip(corners.T, signs.T, strict=True)):
            for chosen, ends in ((sign > 0, (least, most)), (sign < 0, (-most, -least))):
                along = corner[chosen]
                if len(along):
                    low[axis] = min(low[axis], along.min() * (2.0 * STEPS) + ends[0][axis])
                    high[axis] = max(high[axis], along.max() * (2.0 * STEPS) + ends[1][axis])
        boxes.append(placed(grid, np.zeros(3, np.int64), np.stack([low, high])))
    return box_of(np.concatenate(boxes)) if boxes else np.zeros((2, 3))


def facets(
    layout: Layout,
    monitor: Monitor,
    where: NDArray[np.bool_] | None = None,
    cap: tuple[int, bool] | None = None,
) -> NDArray[np.int32]:
    """(m, 3) triangles of numbered vertices.

    Args:
        layout: the numbered octants.
        monitor: for cancel.
        where: octants to take; None: all.
        cap: None for the lattice's surface; or (axis, high) for the flat caps on that face, in
            the octants' own frames.
    """
    pairs = list(zip(layout.grid.keys, layout.places, strict=True))
    if where is not None:
        pairs = [(key, place[where[tuple(place.T)]]) for key, place in pairs]
    pairs = [(key, place) for key, place in pairs if len(place)]
    patterns = {key: _pattern(layout.octants[key], cap) for key, _ in pairs}
    total = sum(len(place) * len(patterns[key]) for key, place in pairs)
    if cap is None:
        monitor.count("triangles laid", total)
    triangles = np.empty((total, 3), np.int32)
    filled = 0
    for key, place in pairs:
        for block in _facets_at(layout, key, place, patterns[key]):
            triangles[filled : filled + len(block)] = block
            filled += len(block)
            monitor.tick()
    return triangles


def _pattern(octant: Octant, cap: tuple[int, bool] | None) -> NDArray[np.int32]:
    return octant.triangles if cap is None else caps.cap(octant, *cap)


def _facets_at(
    layout: Layout, key: OctantKey, place: NDArray[np.int64], pattern: NDArray[np.int32]
) -> Iterator[NDArray[np.int32]]:
    """Triangles of an octant at some places, some at a time."""
    if not len(pattern) or not len(place):
        return
    turned = ((place % 2) == 0).sum(axis=1) % 2 == 1
    size = max(1, CHUNK_VERTICES // len(pattern))
    for chosen, order in ((place[~turned], pattern), (place[turned], pattern[:, ::-1])):
        for begin in range(0, len(chosen), size):
            own = numbers(layout, layout.octants[key], chosen[begin : begin + size])
            yield np.take(own, order, axis=1, mode="clip").reshape(-1, 3)


def facet_blocks(layout: Layout) -> Iterator[NDArray[np.int32]]:
    """The triangles of `facets`, some at a time."""
    for key, place in zip(layout.grid.keys, layout.places, strict=True):
        yield from _facets_at(layout, key, place, layout.octants[key].triangles)


def coordinate_blocks(layout: Layout) -> Iterator[Floats]:
    """The numbered vertices' coordinates in their order, a layer of octants at a time, mm.

    Args:
        layout: the numbered octants, each with a number of its own; the grid does not close upon
            itself along its first axis.
    """
    layers, base = layout.grid.kind.shape[0], layout.base[:, 0, 0].astype(np.int64)
    # Octants of a layer have vertices on three planes of the complex; the last is the next one's
    # first.
    begin = np.append(base, layout.count)
    carried = np.zeros((0, 3))
    for layer in range(layers):
        first, after = begin[2 * layer], begin[2 * layer + 3]
        points = np.empty((after - first, 3))
        points[: len(carried)] = carried
        for key, place in zip(layout.grid.keys, layout.places, strict=True):
            octant = layout.octants[key]
            # They are in the order of the layers.
            low, high = np.searchsorted(place[:, 0], [layer, layer + 1])
            if low == high or not len(octant.vertices):
                continue
            part = place[low:high]
            corner, sign = layout.frames(part)
            steps = sign[:, None, :] * in_steps(layout.grid, octant)
            own = placed(layout.grid, corner[:, None, :], steps)
            points[numbers(layout, octant, part) - first] = own
        carried = points[begin[2 * layer + 2] - first :]
        yield points[: begin[2 * layer + 2] - first]
    yield carried


def lay(layout: Layout, monitor: Monitor) -> TriangleMesh:
    """All the octants of a layout as one welded mesh."""
    return TriangleMesh(coordinates(layout, monitor), facets(layout, monitor))


def _complex_shape(grid: OctantGrid) -> tuple[int, ...]:
    """Entities of the complex of octants along each axis.

    There are as many cells as planes, and one more plane where it does not close upon itself.
    """
    return tuple(
        2 * n + (not closed) for n, closed in zip(grid.kind.shape, grid.periodic, strict=True)
    )


def _entity_rows(grid: OctantGrid, place: NDArray[np.int64]) -> list[list[NDArray[np.int64]]]:
    """By axis and step along it, what sums up to entities' rows on the complex of (k, 3) octants.

    Reflected frames run backwards.
    """
    shape = _complex_shape(grid)
    result = []
    for axis, pitch in enumerate((shape[1] * shape[2], shape[2], 1)):
        column = place[:, axis]
        middle = 2 * column + 1
        way = np.where(column % 2 == 0, -1, 1)
        ends = (middle - way, middle, middle + way)
        result.append([end % shape[axis] * pitch for end in ends])
    return result


def neighbour_missing(
    grid: OctantGrid, where: NDArray[np.bool_], axis: int, high: bool
) -> NDArray[np.bool_]:
    """Octants of `where` whose neighbour across a face, named in their own frame, is not of it."""
    width = [(1, 1) if k == axis else (0, 0) for k in range(3)]
    padded = np.pad(where, width, mode="wrap" if grid.periodic[axis] else "constant")
    index = np.arange(where.shape[axis])
    # Frames run backwards at even places: the high face is then on the grid's low side.
    step = np.where((index % 2 == 0) == high, -1, 1)
    beyond = np.take(padded, index + 1 + step, axis=axis)
    result: NDArray[np.bool_] = where & ~beyond
    return result

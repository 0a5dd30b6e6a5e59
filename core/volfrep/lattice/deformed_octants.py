# SPDX-License-Identifier: LGPL-2.1-or-later
"""Octants whose vertices were moved, looked at some at a time: what each encloses, and its faults.

What holds for the edges of a kind of octant holds wherever its vertices are; their lengths, areas
and volumes, and whether facets fold, are each octant's own. Nothing here holds more than the
vertices and a few numbers an octant.

A facet that has turned by less than half of what the sharpest edge of its kind has left cannot be
at a fold; only octants with others are compared with their neighbours.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

import numpy as np

from ..mesh import remesh
from ..mesh.precision import decimal_step, merging, near_others
from ..mesh.topology import edge_keys
from ..mesh.triangle_mesh import TriangleMesh, compact
from ..octants.octant import Octant
from ..spatial.resolve_crossings import STICKS_OUT, find_folds
from ..util.progress import Monitor
from ..util.threads import in_threads
from ..util.types import Bools, Floats, Ints
from .assembly import CHUNK_VERTICES, Layout, facets, numbers
from .octant_kinds import DeformedOctants, Measured, OctantKind, look_at

#: Vertices of octants that are looked at at a time: they should stay in the processor's cache.
BLOCK_VERTICES = 1 << 14
#: Layers of octants in which vertices that a file would merge are looked for at a time, and so far
#: out of their places, in units of their edges, octants of more layers than the next never meet.
LAYERS, FARTHEST = 4, 0.45


def look_at_deformed(
    layout: Layout,
    octants: list[Octant],
    points: Floats,
    where: Bools,
    safe: float,
    excess: float,
    monitor: Monitor,
) -> DeformedOctants:
    """Measure moved octants, and look for what is wrong with them.

    Args:
        layout: the numbered octants.
        octants: the same kinds of octant without corners for caps.
        points: (n, 3) where the numbered vertices are, mm.
        where: (nx, ny, nz) bool, those to look at.
        safe: heights above this are kept by files, mm.
        excess: how far they reach out of their places, in units of their edges.
        monitor: for cancel.
    """
    twin = np.zeros(len(points), bool)
    twin[_merging(layout, points, excess, monitor)] = True
    row, kinds = np.full(where.shape, -1, np.int64), []
    unsound, bent = np.zeros_like(where), np.zeros_like(where)
    for octant, every in zip(octants, layout.places, strict=True):
        place = every[where[tuple(every.T)]]
        row[tuple(place.T)] = np.arange(len(place))
        found = _measure(layout, octant, place, points, safe, monitor)
        kinds.append(found)
        unsound[tuple(place.T)] = ~found.sound
        bent[tuple(place.T)] = found.turned < _most_turned(octant)
        if twin.any():
            for begin in range(0, len(place), _copies(octant)):
                part = place[begin : begin + _copies(octant)]
                unsound[tuple(part.T)] |= twin[numbers(layout, octant, part)].any(axis=1)
    return DeformedOctants(row, kinds, unsound | _turning_back(layout, points, bent, monitor))


def _copies(octant: Octant) -> int:
    """How many octants of a kind are looked at at a time."""
    return max(1, BLOCK_VERTICES // max(1, len(octant.vertices)))


def _merging(layout: Layout, points: Floats, excess: float, monitor: Monitor) -> Ints:
    """The vertices that a file would take for one with another; ascending."""
    grid, step = layout.grid, decimal_step(points)
    layers = grid.kind.shape[0]
    taken = layers if grid.periodic[0] or excess > FARTHEST else LAYERS
    # Vertices are numbered layer by layer; those of a layer may meet the next one's.
    begin = np.append(layout.base[:, 0, 0].astype(np.int64), layout.count)
    ends = [
        (int(begin[2 * k]), int(begin[min(2 * (k + taken + 1) + 1, len(begin) - 1)]))
        for k in range(0, layers, taken)
    ]

    def in_part(rows: tuple[int, int]) -> Ints:
        own = points[rows[0] : rows[1]]
        near = near_others(own, 2.0 * step)
        result: Ints = near[merging(own[near], step)] + np.int64(rows[0])
        return result

    found = [np.zeros(0, np.int64)]
    for rows in in_threads(in_part, ends):
        monitor.tick()
        found.append(rows)
    result: Ints = np.unique(np.concatenate(found))
    return result


def _measure(
    layout: Layout, octant: Octant, place: Ints, points: Floats, safe: float, monitor: Monitor
) -> Measured:
    kind, count, copies = look_at(octant), len(place), _copies(octant)
    pieces = kind.pieces
    if not len(octant.triangles):
        none = np.zeros((count, 3))
        return Measured(
            none, np.zeros((count, pieces)), np.zeros((count, pieces, 3)), np.zeros(count),
            np.zeros(count, np.int64), none + np.inf, none - np.inf, np.ones(count, bool),
            np.ones(count),
        )  # fmt: skip
    starts = range(0, max(count, 1), copies)
    about = kind, np.ascontiguousarray(_normals(octant).T)
    look = partial(_block, layout, octant, about, points, safe)
    found = []
    for each in in_threads(look, (place[k : k + copies] for k in starts)):
        found.append(each)
        monitor.tick()
    return Measured(*(np.concatenate(column) for column in zip(*found, strict=True)))


def _block(
    layout: Layout,
    octant: Octant,
    about: tuple[OctantKind, Floats],
    points: Floats,
    safe: float,
    place: Ints,
) -> tuple[Floats, Floats, Floats, Floats, Ints, Floats, Floats, Bools, Floats]:
    """The columns of `Measured` for some octants of one kind."""
    (kind, template), sign = about, layout.frames(place)[1]
    # Axis by axis, and an octant's numbers beside each other, which numpy takes in fastest.
    columns = np.ascontiguousarray(points[numbers(layout, octant, place)].transpose(2, 0, 1))
    low, high = columns.min(axis=2).T, columns.max(axis=2).T
    start = columns[:, :, 0].T.copy()
    corners = [np.ascontiguousarray(octant.triangles[:, k]) for k in range(3)]
    sides: list[list[Floats]] = [[], []]
    first = []
    for column in columns:
        a, b, c = (np.take(column, corner, axis=1) for corner in corners)
        first.append(a - column[:, :1])
        sides[0].append(b - a)
        sides[1].append(c - a)
    e, f = sides
    # In a reflected frame the facets run the other way round.
    turn = sign.prod(axis=1)[:, None].astype(np.float64)
    twice = [turn * (e[i] * f[j] - e[j] * f[i]) for i, j in ((1, 2), (2, 0), (0, 1))]
    square = _dot(twice, twice)
    length = np.sqrt(square)
    longest = np.maximum(_dot(e, e), _dot(f, f))
    across = [x - y for x, y in zip(e, f, strict=True)]
    np.maximum(longest, _dot(across, across), out=longest)
    sound = (square > safe**2 * longest).all(axis=1)
    level = [own[:, None] * along for own, along in zip(sign.T, template, strict=True)]
    cosine = _dot(twice, level) / np.maximum(length, 1e-300)
    flux = _dot(first, twice) / 6.0
    owner = kind.piece[octant.triangles[:, 0]]
    volume = np.empty((len(place), kind.pieces))
    normal = np.empty((len(place), kind.pieces, 3))
    for piece in range(kind.pieces):
        mine = slice(None) if kind.pieces == 1 else np.flatnonzero(owner == piece)
        volume[:, piece] = flux[:, mine].sum(axis=1)
        for axis in range(3):
            normal[:, piece, axis] = 0.5 * twice[axis][:, mine].sum(axis=1)
    return (
        start, volume, normal, 0.5 * length.sum(axis=1), (square == 0.0).sum(axis=1), low, high,
        sound, cosine.min(axis=1),
    )  # fmt: skip


def _dot(one: list[Floats], two: list[Floats]) -> Floats:
    x, y, z = (a * b for a, b in zip(one, two, strict=True))
    x += y
    x += z
    return x


def _normals(octant: Octant) -> Floats:
    """(m, 3) the unit normals of an octant's facets in its frame."""
    return remesh.unit_normals(octant.vertices[octant.triangles])


def _most_turned(octant: Octant) -> float:
    """The cosine of the angle by which both facets at any edge may turn without folding there.

    That is half of what the sharpest edge that sticks out has left to `STICKS_OUT`.
    """
    if not len(octant.triangles):
        return -1.0
    triangles, normal = octant.triangles.astype(np.int64), _normals(octant)
    size = len(octant.vertices)
    start, end = triangles.ravel(), np.roll(triangles, -1, axis=1).ravel()
    apex, owner = np.roll(triangles, -2, axis=1).ravel(), np.repeat(np.arange(len(triangles)), 3)
    key = edge_keys(start, end, size)
    order = np.argsort(key, kind="stable")
    same = key[order[1:]] == key[order[:-1]]
    one, two = order[:-1][same], order[1:][same]
    beyond = octant.vertices[apex[two]] - octant.vertices[start[one]]
    cosine = np.einsum("ij,ij->i", normal[owner[one]], normal[owner[two]])
    cosine = cosine[np.einsum("ij,ij->i", normal[owner[one]], beyond) < 0.0]
    # Along the faces facets go on round the same struts, as they do inside.
    sharpest = np.arccos(np.clip(cosine.min(initial=0.5), -1.0, 1.0))
    return float(np.cos(max(0.0, 0.5 * (np.arccos(STICKS_OUT) - sharpest))))


def _turning_back(layout: Layout, points: Floats, bent: Bools, monitor: Monitor) -> Bools:
    """Of octants that were bent much those where the surface turns back on itself, and neighbours.

    Layer by layer, each with what is about it.
    """
    result = np.zeros_like(bent)
    if not bent.any():
        return result
    from scipy import ndimage  # slow to import

    about = ndimage.binary_dilation(bent, np.ones((3, 3, 3), bool)) & (layout.grid.kind >= 0)
    each = [len(layout.octants[key].triangles) for key in layout.grid.keys]
    for part in _slabs(about, each, layout):
        triangles = facets(layout, Monitor(), part)
        low, high = int(triangles.min()), int(triangles.max())  # numbered layer by layer
        mesh = compact(TriangleMesh(points[low : high + 1], triangles - np.int32(low)))
        turned = find_folds(mesh, True)
        if turned.any():
            owner = _owners(layout, part, each)[turned]
            result[tuple(owner.T)] = True
        monitor.tick()
    return result


def _slabs(about: Bools, each: list[int], layout: Layout) -> Iterator[Bools]:
    """Layers of octants with those before and after them, not too many at a time."""
    kind = layout.grid.kind
    weight = np.where(about, np.append(each, 0)[kind], 0).sum(axis=(1, 2))
    layers, begin = len(weight), 0
    while begin < layers:
        total = np.cumsum(weight[begin:])
        end = begin + max(1, int(np.searchsorted(total, CHUNK_VERTICES)))
        chosen = np.arange(begin - 1, end + 1)
        if layout.grid.periodic[0]:
            chosen %= layers
        mask = np.zeros(layers, bool)
        mask[chosen[(chosen >= 0) & (chosen < layers)]] = True
        if weight[begin:end].any():
            yield about & mask[:, None, None]
        begin = end


def _owners(layout: Layout, where: Bools, each: list[int]) -> Ints:
    """(m, 3) the octant of each of the triangles of `facets`."""
    owners = [np.zeros((0, 3), np.int64)]
    for place, count in zip(layout.places, each, strict=True):
        some = place[where[tuple(place.T)]]
        turned = ((some % 2) == 0).sum(axis=1) % 2 == 1
        owners.append(np.repeat(np.concatenate([some[~turned], some[turned]]), count, axis=0))
    return np.concatenate(owners)

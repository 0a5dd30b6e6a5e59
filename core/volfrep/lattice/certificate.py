# SPDX-License-Identifier: LGPL-2.1-or-later
"""Topology certificate of an assembled lattice: proved on its octants, not its triangles.

Many octants are copies of few. Every edge of the whole is shared by two triangles if that holds
inside each kind of octant, and if wherever two kinds meet their open edges on the common face are
the same (the frames of neighbours are each other's reflection, so that the same edge in both
frames runs in opposite directions in space). Connected pieces, volumes and areas add up over the
copies. `volfrep.mesh.quality.measure` finds the same on the triangles, in time that grows with
them.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

from ..mesh.quality import Quality
from ..octants.octant import OctantGrid, frames
from ..octants.octant_mesh import Octant
from ..util.types import Floats, Ints
from .assembly import Layout, box

_NO_EDGES = np.zeros((0, 4), np.int64)


@dataclass(frozen=True, eq=False)
class _Kind:
    """One kind of octant, looked at once.

    Attributes:
        pieces: connected pieces of its surface.
        piece: (n,) which of them each vertex belongs to.
        volume: (pieces,) flux of the position through each, over 3, in the octant's frame, mm3.
        normal: (pieces, 3) integral of the normal over each, mm2.
        area: of all, mm2.
        open: by (axis, side): sorted (k, 4) open edges as entity and rank of start and end.
        degenerate: triangles without an area, as specks have that no sample could follow.
        sound: every other edge is shared by two triangles, none of them joins two vertices of a
            face.
    """

    pieces: int
    piece: Ints
    volume: Floats
    normal: Floats
    area: float
    open: dict[tuple[int, int], Ints]
    degenerate: int
    sound: bool


def certify(layout: Layout) -> Quality:
    """The certificate: topology, volume and size of the surface of a whole layout.

    Args:
        layout: the numbered octants, all of whose facets are the surface.

    Raises:
        RuntimeError: the surface is not closed; the octants do not fit together.
    """
    grid = layout.grid
    kinds = [_look_at(layout.octants[key]) for key in grid.keys]
    first = np.full(grid.kind.shape, -1, np.int64)
    counts = np.array([kind.pieces for kind in kinds])
    present = grid.kind >= 0
    size = counts[grid.kind[present]]
    first[present] = np.cumsum(size) - size
    total = int(size.sum())

    links = _fit_together(layout, kinds, first)
    if not all(kind.sound for kind in kinds):
        raise RuntimeError("an octant of the lattice is not a proper piece of surface")
    bounds = box(layout)
    graph = coo_matrix((np.ones(len(links), bool), links.T), shape=(total, total))
    shells, label = connected_components(graph, directed=False)
    volume = np.zeros(shells)
    triangles, degenerate, area = 0, 0, 0.0
    for kind, key, place in zip(kinds, grid.keys, layout.places, strict=True):
        corner, sign = frames(place)
        offset = corner * grid.cell_size + grid.origin - bounds.mean(axis=0)
        own = kind.volume + np.einsum("ki,pi->kp", offset * sign, kind.normal) / 3.0
        index = first[tuple(place.T)][:, None] + np.arange(kind.pieces)
        volume += np.bincount(label[index.ravel()], own.ravel(), minlength=shells)
        triangles += len(place) * len(layout.octants[key].triangles)
        degenerate += len(place) * kind.degenerate
        area += len(place) * kind.area
    euler = layout.count - triangles // 2
    return Quality(
        triangles=triangles,
        vertices=layout.count,
        watertight=True,
        open_edges=0,
        overused_edges=0,
        misoriented_edges=0,
        degenerate_triangles=degenerate,
        shells=int(shells),
        bodies=int((volume > 0).sum()),
        voids=int((volume < 0).sum()),
        genus=int(shells) - euler // 2,
        volume=float(volume.sum()),
        area=area,
        bounds=bounds,
    )


def _look_at(octant: Octant) -> _Kind:
    triangles, count = octant.triangles.astype(np.int64), len(octant.vertices)
    place = octant.places
    start, end = triangles.ravel(), triangles[:, [1, 2, 0]].ravel()
    forward, backward = start * count + end, end * count + start
    is_open = ~np.isin(forward, backward)
    on_one_face = ((place[start] == place[end]) & (place[start] != 1)).sum(axis=1)
    corners = octant.vertices[triangles]
    twice = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    # An open edge lies on exactly one face, every other one on none.
    sound = len(np.unique(forward)) == len(forward) and bool((on_one_face == is_open).all())
    sound &= len(np.unique(triangles)) == count
    open_edges = {}
    name = np.stack([octant.entity.astype(np.int64), octant.rank.astype(np.int64)], axis=1)
    for axis in range(3):
        for side in (0, 2):
            here = is_open & (place[start, axis] == side) & (place[end, axis] == side)
            edges = np.concatenate([name[start[here]], name[end[here]]], axis=1)
            open_edges[axis, side] = edges[np.lexsort(edges.T)]

    graph = coo_matrix((np.ones(len(start), bool), (start, end)), shape=(count, count))
    pieces, piece = connected_components(graph, directed=False) if count else (0, np.zeros(0, int))
    owner = piece[triangles[:, 0]]
    normal = np.stack(
        [np.bincount(owner, 0.5 * twice[:, k], minlength=pieces) for k in range(3)], axis=1
    )
    flux = np.einsum("ij,ij->i", corners[:, 0], twice) / 6.0
    return _Kind(
        int(pieces),
        piece.astype(np.int64),
        np.bincount(owner, flux, minlength=pieces).astype(np.float64),
        normal.astype(np.float64),
        float(0.5 * np.linalg.norm(twice, axis=1).sum()),
        open_edges,
        int((~twice.any(axis=1)).sum()),
        sound,
    )


@dataclass(frozen=True, eq=False)
class _Meeting:
    """Everywhere that an octant of one kind is followed by one of another kind along an axis.

    Attributes:
        axis: of the common face.
        side: 0 where it is the low face of both octants' frames, 2 where it is the high one.
        kinds: of the octants on its low and high side; -1 for none.
        where: bool on the pairs along the axis.
    """

    axis: int
    side: int
    kinds: tuple[int, int]
    where: NDArray[np.bool_]


def _pairs(values: Ints, axis: int, closed: bool, none: int) -> tuple[Ints, Ints]:
    """Values of octants and of those that follow along an axis.

    There is one octant of emptiness about all, so that the outermost faces are looked at too; or
    the last one before the first.
    """
    width = [(1, not closed) if k == axis else (0, 0) for k in range(3)]
    fill: dict[str, Any] = {"mode": "wrap"} if closed else {"constant_values": none}
    padded = np.moveaxis(np.pad(values, width, **fill), axis, 0)
    return np.moveaxis(padded[:-1], 0, axis), np.moveaxis(padded[1:], 0, axis)


def _meetings(grid: OctantGrid) -> Iterator[_Meeting]:
    count = len(grid.keys) + 1
    for axis in range(3):
        one, two = _pairs(grid.kind.astype(np.int64), axis, grid.periodic[axis], -1)
        # Frames run backwards at even places: a pair shares its high or its low faces in turn.
        index = np.arange(one.shape[axis]).reshape([-1 if k == axis else 1 for k in range(3)])
        side = np.broadcast_to(np.where(index % 2 == 0, 2, 0), one.shape)
        code = ((one + 1) * count + two + 1) * 3 + side
        for value in np.unique(code):
            pair, face = int(value) // 3, int(value) % 3
            yield _Meeting(axis, face, (pair // count - 1, pair % count - 1), code == value)


def _fit_together(layout: Layout, kinds: list[_Kind], first: Ints) -> Ints:
    """(k, 2) links between the pieces of neighbouring octants, after a look at every pair."""
    grid = layout.grid
    links = [np.zeros((0, 2), np.int64)]
    numbers = [_pairs(first, axis, grid.periodic[axis], -1) for axis in range(3)]
    for meeting in _meetings(grid):
        axis, side = meeting.axis, meeting.side
        edges = [kinds[k].open[axis, side] if k >= 0 else _NO_EDGES for k in meeting.kinds]
        if not np.array_equal(edges[0], edges[1]):
            raise RuntimeError("two octants of the lattice do not fit together")
        if min(meeting.kinds) < 0 or not len(edges[0]):
            continue
        on_face = [_on_face(layout.octants[grid.keys[k]], axis, side) for k in meeting.kinds]
        pieces = [kinds[k].piece[own] for k, own in zip(meeting.kinds, on_face, strict=True)]
        pairs = np.unique(np.stack(pieces, axis=1), axis=0)
        low, high = (number[meeting.where][:, None] for number in numbers[axis])
        links.append(np.stack([(low + pairs[:, 0]).ravel(), (high + pairs[:, 1]).ravel()], axis=1))
    return np.concatenate(links)


def agree_on_faces(layout: Layout) -> bool:
    """Whether octants give the vertices that they share the very same places.

    A mesh has each of them once, whoever placed it; octants that are written one by one must
    agree.
    """
    for meeting in _meetings(layout.grid):
        if min(meeting.kinds) < 0:
            continue
        places = []
        for k in meeting.kinds:
            octant = layout.octants[layout.grid.keys[k]]
            places.append(octant.vertices[_on_face(octant, meeting.axis, meeting.side)])
        if not np.array_equal(places[0], places[1]):
            return False
    return True


def _on_face(octant: Octant, axis: int, side: int) -> Ints:
    """The vertices on a face, in the order that both its octants give them."""
    on_face = np.flatnonzero(octant.places[:, axis] == side)
    result: Ints = on_face[np.lexsort((octant.rank[on_face], octant.entity[on_face]))]
    return result

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

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..mesh.quality import Quality
from ..mesh.topology import pieces_of
from ..octants.octant import Octant, OctantGrid
from ..util.linalg import along
from ..util.types import Floats, Ints
from .assembly import Layout, box, numbers_at
from .octant_kinds import GENERIC, DeformedOctants, OctantKind, look_at

_NONE = np.zeros(0, np.int64)
#: Facets whose heights are all above so many steps of single precision keep their corners in it.
SAFE_STEPS = 4.0


def certify(layout: Layout) -> Quality:
    """The certificate: topology, volume and size of the surface of a whole layout.

    Args:
        layout: the numbered octants, all of whose facets are the surface.

    Raises:
        RuntimeError: the surface is not closed; the octants do not fit together.
    """
    bounds = box(layout)
    pieces = certify_pieces(layout, bounds.mean(axis=0))
    if len(pieces.rim):
        raise RuntimeError("two octants of the lattice do not fit together")
    euler = layout.count - pieces.triangles // 2
    shells = len(pieces.volume)
    return Quality(
        triangles=pieces.triangles,
        vertices=layout.count,
        watertight=True,
        open_edges=0,
        overused_edges=0,
        misoriented_edges=0,
        degenerate_triangles=pieces.degenerate,
        shells=shells,
        bodies=int((pieces.volume > 0).sum()),
        voids=int((pieces.volume < 0).sum()),
        genus=shells - euler // 2,
        volume=float(pieces.volume.sum()),
        area=pieces.area,
        bounds=bounds,
    )


@dataclass(frozen=True, eq=False)
class CertifiedPieces:
    """What is proved of the octants of a layout, whose surface may go on elsewhere.

    Attributes:
        centre: (3,) that positions are measured from, mm.
        volume: (pieces,) flux of the position over 3 through each connected piece, mm3: what it
            encloses where it is closed.
        normal: (pieces, 3) integral of the normal over each, mm2; zero where it is closed.
        area: of all, mm2.
        triangles: of all.
        degenerate: triangles without an area.
        rim: (e, 2) numbers of the vertices that each open edge runs from and to. Every other edge
            is shared by two triangles.
        piece_at_rim: (e,) the piece that each open edge belongs to.
    """

    centre: Floats
    volume: Floats
    normal: Floats
    area: float
    triangles: int
    degenerate: int
    rim: Ints
    piece_at_rim: Ints

    def volume_about(self, centre: Floats) -> Floats:
        """(pieces,) `volume` with positions measured from another point."""
        result: Floats = self.volume - along(self.normal, centre - self.centre) / 3.0
        return result


def certify_pieces(
    layout: Layout, centre: Floats, deformed: DeformedOctants | None = None
) -> CertifiedPieces:
    """The certificate of the octants of a layout whose surface may go on where octants are missing.

    Args:
        layout: the numbered octants.
        centre: (3,) that positions are measured from, in lattice space, mm.
        deformed: measures of all of them, in the part, where their vertices were moved.

    Raises:
        RuntimeError: the octants do not fit together.
    """
    grid = layout.grid
    kinds = [look_at(layout.octants[key]) for key in grid.keys]
    first = np.full(grid.kind.shape, -1, np.int64)
    counts = np.array([kind.pieces for kind in kinds], np.int64)
    present = grid.kind >= 0
    size = counts[grid.kind[present]]
    first[present] = np.cumsum(size) - size
    total = int(size.sum())

    links, rim, owner = _fit_together(layout, kinds, first)
    if not all(kind.sound for kind in kinds):
        raise RuntimeError("an octant of the lattice is not a proper piece of surface")
    pieces, label = pieces_of(links[:, 0], links[:, 1], total)
    volume, normal = np.zeros(pieces), np.zeros((pieces, 3))
    triangles, degenerate, area = 0, 0, 0.0
    for number, (kind, place) in enumerate(zip(kinds, layout.places, strict=True)):
        index = first[tuple(place.T)][:, None] + np.arange(kind.pieces)
        index = label[index.ravel()]
        if deformed is None:
            corner, sign = layout.frames(place)
            offset = corner * grid.cell_size + grid.origin - centre
            own = kind.volume + np.einsum("ki,pi->kp", offset * sign, kind.normal) / 3.0
            across = sign[:, None, :] * kind.normal
            degenerate += len(place) * kind.degenerate
            area += len(place) * kind.area
        else:
            own, across, its_area, its_degenerate = deformed.of(number, place, centre)
            degenerate += its_degenerate
            area += its_area
        volume += np.bincount(index, own.ravel(), minlength=pieces)
        for k in range(3):
            normal[:, k] += np.bincount(index, across[:, :, k].ravel(), minlength=pieces)
        triangles += len(place) * len(layout.octants[grid.keys[number]].triangles)
    return CertifiedPieces(
        centre, volume, normal, area, triangles, degenerate, rim,
        label[owner],
    )  # fmt: skip


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

    def places(self, shape: tuple[int, ...], is_low: bool) -> Ints:
        """(k, 3) the octants on the low, or on the high side, as `where` has the pairs."""
        place = np.argwhere(self.where)
        # The first pair is that of the first octant with what is before it.
        place[:, self.axis] -= is_low
        place[:, self.axis] %= shape[self.axis]
        return place


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


def _fit_together(layout: Layout, kinds: list[OctantKind], first: Ints) -> tuple[Ints, Ints, Ints]:
    """How the pieces of neighbouring octants are joined, after a look at every pair.

    Returns:
        (k, 2) links between pieces; (e, 2) open edges towards octants that are missing, as numbers
        of their vertices; (e,) the piece of each.
    """
    grid = layout.grid
    links, rim, owner = [np.zeros((0, 2), np.int64)], [np.zeros((0, 2), np.int64)], [_NONE]
    numbers = [_pairs(first, axis, grid.periodic[axis], -1) for axis in range(3)]
    for meeting in _meetings(grid):
        axis, side = meeting.axis, meeting.side
        low, high = (number[meeting.where] for number in numbers[axis])
        if min(meeting.kinds) < 0:
            alone = max(meeting.kinds)
            if alone < 0 or not len(kinds[alone].open[axis, side]):
                continue
            is_low = meeting.kinds[0] >= 0
            place = meeting.places(grid.kind.shape, is_low)
            rim.append(_rim_edges(layout, kinds[alone].open[axis, side], place))
            piece = kinds[alone].open_piece[axis, side]
            owner.append(((low if is_low else high)[:, None] + piece).ravel())
            continue
        edges = [kinds[k].open[axis, side] for k in meeting.kinds]
        if not np.array_equal(edges[0], edges[1]):
            raise RuntimeError("two octants of the lattice do not fit together")
        if not len(edges[0]):
            continue
        on_face = [_on_face(layout.octants[grid.keys[k]], axis, side) for k in meeting.kinds]
        pieces = [kinds[k].piece[own] for k, own in zip(meeting.kinds, on_face, strict=True)]
        pairs = np.unique(np.stack(pieces, axis=1), axis=0)
        joined = low[:, None] + pairs[:, 0], high[:, None] + pairs[:, 1]
        links.append(np.stack([ends.ravel() for ends in joined], axis=1))
    return np.concatenate(links), np.concatenate(rim), np.concatenate(owner)


def _rim_edges(layout: Layout, edges: Ints, place: Ints) -> Ints:
    """(p k, 2) numbers of the ends of open edges, named by entity and rank, of octants at places.

    They run as the triangles do whose edges they are.
    """
    ends = [
        numbers_at(layout, edges[:, 2 * k].astype(np.int8), edges[:, 2 * k + 1].astype(np.int32),
                   place)
        for k in (0, 1)
    ]  # fmt: skip
    turned = ((place % 2) == 0).sum(axis=1) % 2 == 1
    result = np.stack(ends, axis=2).astype(np.int64)
    result[turned] = result[turned][:, :, ::-1]
    return result.reshape(-1, 2)


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


def keeps_corners(octants: Iterable[Octant], size: float, bounds: Floats) -> bool:
    """Whether no facet can lose a corner when its coordinates become single precision.

    Nor can two vertices become one: they lie farther apart within an octant, and those that are
    not on its faces lie farther from these, and so from the vertices of its neighbours.

    Args:
        octants: the kinds of octant that are placed.
        size: their edge, mm.
        bounds: (2, 3) of all that is placed, mm.
    """
    farthest = float(np.abs(bounds).max())
    if not farthest < np.finfo(np.float32).max:
        return False
    safe = SAFE_STEPS * float(np.spacing(np.float32(farthest)))
    return all(
        _least_height(octant.vertices[octant.triangles]) > safe and _keeps_apart(octant, size, safe)
        for octant in octants
        if len(octant.triangles)
    )


def _keeps_apart(octant: Octant, size: float, safe: float) -> bool:
    """Whether vertices are farther than `safe` from each other and from faces they are not on."""
    points = octant.vertices
    inner = points[octant.places == 1]
    inner = inner[inner != 0.0]  # on a face that is closed, beyond which nothing follows
    if min(inner.min(initial=size), (size - inner).min(initial=size)) <= safe:
        return False
    # Along a line on which few of them share a place, only the next ones can be that near.
    place = along(points, GENERIC)
    order = np.argsort(place)
    points, place = points[order], place[order]
    for ahead in range(1, len(points)):
        near = np.flatnonzero(place[ahead:] - place[:-ahead] <= safe)
        if not len(near):
            break
        gap = points[near + ahead] - points[near]
        if (np.einsum("ij,ij->i", gap, gap) <= safe * safe).any():
            return False
    return True


def _least_height(corners: Floats) -> float:
    """The least height of (m, 3, 3) triangles, mm."""
    sides = corners - np.roll(corners, 1, axis=1)
    longest = np.linalg.norm(sides, axis=2).max(axis=1)
    twice = np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1)
    return float((twice / longest).min())

# SPDX-License-Identifier: LGPL-2.1-or-later
"""What is known of octants: of a kind, and of each where its vertices were moved."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..mesh.topology import pieces_of
from ..octants.octant import Octant
from ..util.types import Bools, Floats, Ints

#: A direction, of length 1, in which few vertices of a regular mesh share a place.
GENERIC = np.array([0.26740, 0.53480, 0.80153])


@dataclass(frozen=True, eq=False)
class OctantKind:
    """One kind of octant, looked at once.

    Attributes:
        pieces: connected pieces of its surface.
        piece: (n,) which of them each vertex belongs to.
        volume: (pieces,) flux of the position through each, over 3, in the octant's frame, mm3.
        normal: (pieces, 3) integral of the normal over each, mm2.
        area: of all, mm2.
        open: by (axis, side): sorted (k, 4) open edges as entity and rank of start and end.
        open_piece: by (axis, side): (k,) the piece of each.
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
    open_piece: dict[tuple[int, int], Ints]
    degenerate: int
    sound: bool


def look_at(octant: Octant) -> OctantKind:
    """Everything that is to be known of a kind of octant."""
    triangles, count = octant.triangles.astype(np.int64), len(octant.vertices)
    place = octant.places
    start, end = triangles.ravel(), triangles[:, [1, 2, 0]].ravel()
    forward, backward = start * count + end, end * count + start
    known = np.sort(forward)
    position = np.minimum(np.searchsorted(known, backward), max(len(known) - 1, 0))
    is_open = known[position] != backward
    on_one_face = ((place[start] == place[end]) & (place[start] != 1)).sum(axis=1)
    corners = octant.vertices[triangles]
    twice = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    # An open edge lies on exactly one face, every other one on none.
    sound = bool((known[1:] > known[:-1]).all()) and bool((on_one_face == is_open).all())
    sound &= bool((np.bincount(start, minlength=count) > 0).all())
    pieces, piece = pieces_of(start, end, count)
    open_edges, open_piece = {}, {}
    name = np.stack([octant.entity.astype(np.int64), octant.rank.astype(np.int64)], axis=1)
    for axis in range(3):
        for side in (0, 2):
            here = is_open & (place[start, axis] == side) & (place[end, axis] == side)
            edges = np.concatenate([name[start[here]], name[end[here]]], axis=1)
            order = np.lexsort(edges.T)
            open_edges[axis, side] = edges[order]
            open_piece[axis, side] = piece[start[here]][order]

    owner = piece[triangles[:, 0]]
    normal = np.stack(
        [np.bincount(owner, 0.5 * twice[:, k], minlength=pieces) for k in range(3)], axis=1
    )
    flux = np.einsum("ij,ij->i", corners[:, 0], twice) / 6.0
    return OctantKind(
        pieces,
        piece,
        np.bincount(owner, flux, minlength=pieces).astype(np.float64),
        normal.astype(np.float64),
        float(0.5 * np.linalg.norm(twice, axis=1).sum()),
        open_edges,
        open_piece,
        int((~twice.any(axis=1)).sum()),
        sound,
    )


@dataclass(frozen=True, eq=False)
class Measured:
    """Octants of one kind.

    Attributes:
        start: (p, 3) a point of each, from which its volume is measured, mm.
        volume: (p, pieces) flux of the position over 3 through each piece of its surface, mm3.
        normal: (p, pieces, 3) integral of the normal over each, mm2.
        area: (p,) mm2.
        degenerate: (p,) triangles without an area.
        low, high: (p, 3) corners of the box about each, mm.
        sound: (p,) bool, no facet is as thin as the steps of a file.
        turned: (p,) the least cosine of the angle by which a facet was turned.
    """

    start: Floats
    volume: Floats
    normal: Floats
    area: Floats
    degenerate: Ints
    low: Floats
    high: Floats
    sound: Bools
    turned: Floats


@dataclass(frozen=True, eq=False)
class DeformedOctants:
    """Measures of octants whose vertices were moved.

    Attributes:
        row: (nx, ny, nz) which of its kind each octant is; -1 where none was looked at.
        kinds: of each kind, as the grid has them.
        unsound: (nx, ny, nz) bool, octants in which files lose a corner or take two vertices for
            one, or where the surface turns back on itself.
    """

    row: Ints
    kinds: list[Measured]
    unsound: Bools

    def of(self, kind: int, place: Ints, centre: Floats) -> tuple[Floats, Floats, float, int]:
        """Of octants of a kind at (k, 3) places: (k, pieces) fluxes of the position about a point
        over 3, (k, pieces, 3) integrals of the normal, their area, and triangles without one.
        """
        own, row = self.kinds[kind], self.row[tuple(place.T)]
        offset, normal = own.start[row] - centre, own.normal[row]
        volume = own.volume[row] + np.einsum("ki,kpi->kp", offset, normal) / 3.0
        return volume, normal, float(own.area[row].sum()), int(own.degenerate[row].sum())

    def boxes(self, kind: int, place: Ints) -> tuple[Floats, Floats]:
        """(k, 3) lowest and highest coordinates of octants of a kind at (k, 3) places, mm."""
        own, row = self.kinds[kind], self.row[tuple(place.T)]
        return own.low[row], own.high[row]

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where a wall runs through itself it is drawn apart, or the cavity is filled a little.

It is looked for again only where the mesh has changed.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from ..mesh.booleans import from_library, to_library
from ..mesh.remesh import unit_normals
from ..mesh.topology import pieces_of
from ..mesh.triangle_mesh import TriangleMesh
from ..spatial.piercing import pairs_at_planes, piercing_among
from ..spatial.resolve_crossings import Folds, resolve_fold_crossings
from ..util.linalg import normalize, symmetric_eigen
from ..util.manifold import manifold_library
from ..util.progress import Monitor
from ..util.types import Floats, Ints

#: So often what crosses is drawn apart, and what is left filled.
ROUNDS = 5
#: How far boxes reach beyond the lines along which facets of a place cross, in thicknesses: at
#: first, and in each further round so many times as far.
BEYOND = 0.004
FARTHER = 2.0
#: Odd numbers that mix the bits of coordinates.
MIX = np.array((0x9E3779B97F4A7C15, 0xC2B2AE3D27D4EB4F, 0x165667B19E3779F9), np.uint64)


def without_crossings(
    mesh: TriangleMesh, thickness: float, monitor: Monitor, known: Judged | None = None
) -> TriangleMesh:
    """The wall of a cavity with no facets that run through each other.

    Two sides of a cavity pass each other only where the room between them ends, or by a hair
    where they were simplified. Their vertices are drawn apart; where that does not do, the room
    ends a little sooner: a Boolean drops what lies in a box about such a place, whatever its
    orientation.

    Args:
        mesh: a closed oriented manifold, outward, mm.
        thickness: of the wall, mm.
        monitor: for progress and cancel.
        known: of the mesh, where it was looked at.

    Returns:
        The mesh itself where nothing crosses. After `ROUNDS` a few facets may still cross.
    """
    reach = BEYOND * thickness
    known = known or find_new_crossings(mesh, monitor)
    best, fewest = mesh, len(known.pairs)
    for _ in range(ROUNDS):
        if not fewest:
            break
        monitor.count("times the wall was drawn apart", 1)
        folded = Folds(np.ones(len(mesh.triangles), bool), known.pairs)
        mesh = resolve_fold_crossings(mesh, monitor, folded=folded)[0]
        known = find_new_crossings(mesh, monitor, known)
        if len(known.pairs):
            mesh = monitor.call(partial(_less, mesh, *_boxes(mesh, known.pairs, reach)))
            known = find_new_crossings(mesh, monitor, known)
            reach *= FARTHER
        if len(known.pairs) < fewest:
            best, fewest = mesh, len(known.pairs)
    return best


def _boxes(mesh: TriangleMesh, pairs: Ints, reach: float) -> tuple[Floats, Floats]:
    """Boxes about places where pairs (n, 2) cross, along the lines there: a room's end is thin.

    Pairs whose triangles have vertices in common lie at one place.

    Returns:
        (k, 3) sizes, mm, and (k, 3, 4) how boxes about the origin are turned and moved.
    """
    corners = mesh.triangles[pairs].reshape(len(pairs), 6)
    links = np.repeat(corners[:, 0], 5), corners[:, 1:].ravel()
    label = pieces_of(links[0], links[1], len(mesh.vertices))[1][corners[:, 0]]
    place = np.tile(np.unique(label, return_inverse=True)[1].ravel(), 2)
    points = np.concatenate(crossed_along(mesh, pairs))
    count = np.bincount(place)
    middle = _sums(points, place) / count[:, None]
    off = points - middle[place]
    squares = _sums((off[:, :, None] * off[:, None]).reshape(-1, 9), place).reshape(-1, 3, 3)
    turn = symmetric_eigen(squares)[1]
    turn[:, :, 2] = np.cross(turn[:, :, 0], turn[:, :, 1])  # right-handed
    along = np.einsum("ni,nij->nj", off, turn[place])
    low = np.full((len(count), 3), np.inf)
    high = -low
    np.minimum.at(low, place, along)
    np.maximum.at(high, place, along)
    middle += np.einsum("kij,kj->ki", turn, 0.5 * (low + high))
    return high - low + 2.0 * reach, np.concatenate([turn, middle[:, :, None]], axis=2)


def _sums(values: Floats, place: Ints) -> Floats:
    """(k, c) sums of the rows (n, c) of each place."""
    return np.stack([np.bincount(place, column) for column in values.T], axis=1)


def _less(mesh: TriangleMesh, sizes: Floats, places: Floats) -> TriangleMesh:
    library = manifold_library("The inner surface of a skin")
    solid: Any = library.Manifold(to_library(mesh))
    boxes = [
        library.Manifold.cube(size.tolist(), True).transform(place)
        for size, place in zip(sizes, places, strict=True)
    ]
    union = library.Manifold.batch_boolean(boxes, library.OpType.Add)
    return from_library((solid - union).to_mesh64())


@dataclass(frozen=True, eq=False)
class Judged:
    """A mesh that was looked at.

    Attributes:
        names: (m,) of its triangles, by where their corners are.
        pairs: (k, 2) of them that run through each other, exactly.
    """

    names: Ints
    pairs: Ints


def find_new_crossings(
    mesh: TriangleMesh, monitor: Monitor | None = None, before: Judged | None = None
) -> Judged:
    """Where a mesh runs through itself, looked for where it differs from one that is known.

    Two triangles that were there before and did not cross then do not cross now.

    Args:
        mesh: the surface, mm.
        monitor: asked for a cancel; None where there is nobody to ask.
        before: what is known of a mesh that shares triangles with it.

    Raises:
        Cancelled: when the monitor says so.
    """
    names, among = _names(mesh), None
    if before is not None:
        crossed = before.names[before.pairs]
        among = ~np.isin(names, before.names) | np.isin(names, crossed)
    return Judged(names, piercing_among(mesh, pairs_at_planes(mesh, 0.0, monitor, among)))


def crossed_along(mesh: TriangleMesh, pairs: Ints) -> tuple[Floats, Floats]:
    """(k, 3) and (k, 3) mm: both ends of the lines along which pairs (k, 2) of triangles cross."""
    one, other = mesh.vertices[mesh.triangles[pairs.T]]
    way = normalize(np.cross(unit_normals(one), unit_normals(other)))
    ends = [_at_plane(one, other, way), _at_plane(other, one, way)]
    # Both parts of the line lie on it: what they have in common.
    start = np.where((ends[0][0] >= ends[1][0])[:, None], ends[0][2], ends[1][2])
    stop = np.where((ends[0][1] <= ends[1][1])[:, None], ends[0][3], ends[1][3])
    return start, stop


def _at_plane(one: Floats, other: Floats, way: Floats) -> tuple[Floats, Floats, Floats, Floats]:
    """Where planes of triangles cut others, (k, 3, 3): least and most along a way, and points."""
    height = np.einsum("kij,kj->ki", one - other[:, :1], unit_normals(other))
    following = np.roll(height, -1, axis=1)
    cut = (height > 0.0) != (following > 0.0)
    share = np.where(cut, height / np.where(cut, height - following, 1.0), 0.0)
    points = one + np.clip(share, 0.0, 1.0)[:, :, None] * (np.roll(one, -1, axis=1) - one)
    along = np.einsum("kij,kj->ki", points, way)
    rows = np.arange(len(one))
    first = np.where(cut, along, np.inf).argmin(axis=1)
    last = np.where(cut, along, -np.inf).argmax(axis=1)
    return along[rows, first], along[rows, last], points[rows, first], points[rows, last]


def _names(mesh: TriangleMesh) -> Ints:
    """(m,) a number for each triangle, the same for the same corners in any mesh."""
    vertex = (np.ascontiguousarray(mesh.vertices).view(np.uint64) * MIX).sum(axis=1)
    vertex ^= vertex >> np.uint64(31)
    corners = vertex[mesh.triangles] * MIX[0]
    mixed = (corners ^ (corners >> np.uint64(29))).sum(axis=1)
    return np.asarray(mixed.view(np.int64))

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where a wall runs through itself it is drawn apart, or the cavity is filled a little."""

from __future__ import annotations

from functools import partial
from typing import Any

import manifold3d
import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

from ..mesh.booleans import from_library, to_library
from ..mesh.triangle_mesh import TriangleMesh
from ..spatial.resolve_crossings import Turns, resolve_fold_crossings
from ..util.linalg import symmetric_eigen
from ..util.progress import Monitor
from ..util.types import Floats, Ints
from .surface_crossings import crossed_along, find_new_crossings

#: So often what crosses is drawn apart, and what is left filled.
ROUNDS = 5
#: How far boxes reach beyond the lines along which facets of a place cross, in thicknesses: at
#: first, and in each further round so many times as far.
BEYOND = 0.004
FARTHER = 2.0


def without_crossings(mesh: TriangleMesh, thickness: float, monitor: Monitor) -> TriangleMesh:
    """The wall of a cavity with no facets that run through each other.

    Two sides of a cavity pass each other only where the room between them ends, or by a hair
    where they were simplified. Their vertices are drawn apart; where that does not do, the room
    ends a little sooner: a Boolean drops what lies in a box about such a place, whatever its
    orientation.

    Args:
        mesh: a closed oriented manifold, outward, mm.
        thickness: of the wall, mm.
        monitor: for progress and cancel.

    Returns:
        The mesh itself where nothing crosses. After `ROUNDS` a few facets may still cross.
    """
    reach = BEYOND * thickness
    known = find_new_crossings(mesh, monitor)
    best, fewest = mesh, len(known.pairs)
    for _ in range(ROUNDS):
        if not fewest:
            break
        monitor.count("times the wall was drawn apart", 1)
        turns = Turns(np.ones(len(mesh.triangles), bool), known.pairs)
        mesh = resolve_fold_crossings(mesh, monitor, turns=turns)[0]
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
    links = (np.repeat(corners[:, 0], 5), corners[:, 1:].ravel())
    size = len(mesh.vertices)
    graph = coo_matrix((np.ones(len(links[0]), np.int8), links), shape=(size, size))
    label = connected_components(graph, directed=False)[1][corners[:, 0]]
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
    solid: Any = manifold3d.Manifold(to_library(mesh))
    boxes = [
        manifold3d.Manifold.cube(size.tolist(), True).transform(place)
        for size, place in zip(sizes, places, strict=True)
    ]
    union = manifold3d.Manifold.batch_boolean(boxes, manifold3d.OpType.Add)
    return from_library((solid - union).to_mesh64())

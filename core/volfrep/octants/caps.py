# SPDX-License-Identifier: LGPL-2.1-or-later
"""Face caps: what closes the lattice where it is cut at the face of an octant."""

from __future__ import annotations

import itertools
from dataclasses import replace
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray

from ..mesh.triangulation import triangulate
from .octant import Octant

_CORNERS = np.array(list(itertools.product((0, 2), repeat=3)))
_WEIGHTS = np.array([9, 3, 1])
#: The caps that are known of octants, by axis and side: gone with the octants, which may be views
#: of far more memory.
_known: WeakKeyDictionary[Octant, dict[tuple[int, bool], NDArray[np.int32]]] = WeakKeyDictionary()


def with_corners(octant: Octant, half_size: float) -> Octant:
    """The octant with the corners that lie inside the lattice as further vertices.

    A cap may need them; they are numbered like the other shared vertices. `half_size` is the
    octant's edge in mm.
    """
    solid = _CORNERS[octant.solid_corners.ravel()]
    return replace(
        octant,
        vertices=np.concatenate([octant.vertices, solid * (0.5 * half_size)]),
        entity=np.concatenate([octant.entity, (solid * _WEIGHTS).sum(axis=1).astype(np.int8)]),
        rank=np.concatenate([octant.rank, np.zeros(len(solid), np.int32)]),
    )


def cap(octant: Octant, axis: int, high: bool) -> NDArray[np.int32]:
    """(k, 3) triangles, of the vertices of an octant with corners, that close one of its faces.

    They are counter-clockwise seen from outside the octant. Groups of octants ask for the same
    ones again and again.
    """
    known = _known.setdefault(octant, {})
    if (axis, high) not in known:
        known[axis, high] = _find_cap(octant, axis, high)
        known[axis, high].setflags(write=False)
    return known[axis, high]


def _find_cap(octant: Octant, axis: int, high: bool) -> NDArray[np.int32]:
    place = octant.places
    side = 2 if high else 0
    on_face = place[:, axis] == side
    following = dict(_border_edges(octant, on_face))
    following.update(_frame_edges(octant, place, on_face, axis, high))
    if not following:
        return np.zeros((0, 3), np.int32)
    loops = []
    while following:
        start, at = following.popitem()
        loop = [start]
        while at != start:
            loop.append(at)
            at = following.pop(at)
        loops.append(np.array(loop))
    # In the face seen from outside, the first axis to the right and the second one up.
    first, second = ((axis + 1) % 3, (axis + 2) % 3) if high else ((axis + 2) % 3, (axis + 1) % 3)
    flat = octant.vertices[:, [first, second]]
    found = triangulate([np.ascontiguousarray(flat[loop]) for loop in loops])
    result: NDArray[np.int32] = np.concatenate(loops)[found].astype(np.int32)
    return result


def _border_edges(octant: Octant, on_face: NDArray[np.bool_]) -> list[tuple[int, int]]:
    """The surface's open edges in the face, against its direction."""
    triangles = octant.triangles.astype(np.int64)
    start, end = triangles.ravel(), triangles[:, [1, 2, 0]].ravel()
    count = len(octant.vertices)
    inside = on_face[start] & on_face[end]
    start, end = start[inside], end[inside]
    is_open = ~np.isin(start * count + end, end * count + start)
    return list(zip(end[is_open].tolist(), start[is_open].tolist(), strict=True))


def _frame_edges(
    octant: Octant,
    place: NDArray[np.int64],
    on_face: NDArray[np.bool_],
    axis: int,
    high: bool,
) -> list[tuple[int, int]]:
    """The stretches of the face's four sides that are inside, counter-clockwise from outside."""
    side = 2 if high else 0
    first, second = ((axis + 1) % 3, (axis + 2) % 3) if high else ((axis + 2) % 3, (axis + 1) % 3)
    result = []
    # Sides in turn: (running axis, runs up?, the other axis' side).
    for run, up, fixed, level in (
        (first, True, second, 0),
        (second, True, first, 2),
        (first, False, second, 2),
        (second, False, first, 0),
    ):
        on_side = np.flatnonzero(on_face & (place[:, fixed] == level))
        along = octant.vertices[on_side, run]
        chain = on_side[np.argsort(along if up else -along)]
        corner = [0, 0, 0]
        corner[axis], corner[fixed], corner[run] = side // 2, level // 2, 0 if up else 1
        inside = bool(octant.solid_corners[tuple(corner)])
        for one, two in itertools.pairwise(chain.tolist()):
            # A corner vertex begins a chain that starts inside; every other one changes sides.
            if not (place[one] != 1).all():
                inside = not inside
            if inside:
                result.append((one, two))
    return result

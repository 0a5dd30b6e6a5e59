# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where a surface was changed, patch by patch, and patches that are taken back.

A patch is what lies within a border that was there before and is there after: its facets of either
time may stand in the same surface.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ..util.types import Bools, Floats, Ints
from .topology import pieces_of
from .triangle_mesh import TriangleMesh

#: Of a mesh and (m,) facets that are new, (m,) facets that may not stay.
FaultFinder = Callable[[TriangleMesh, Bools], Bools]


def without_faults(
    points: Floats, rest: Ints, before: Ints, after: Ints, find_faults: FaultFinder
) -> tuple[Ints, Ints]:
    """What became of some facets of a surface, but for patches that have a fault then.

    Args:
        points: (n, 3) mm.
        rest: (k, 3) the other facets.
        before: (m, 3) those facets.
        after: (l, 3) what they became.
        find_faults: tells which facets may not stay.

    Returns:
        The facets in place of `before`; rows of the points where there were faults.
    """
    old, new = changed_patches(before, after, len(points))
    patch = np.concatenate([np.full(len(rest), -1), new, old])
    facets = np.concatenate([rest, after, before])
    is_old = np.arange(len(facets)) >= len(rest) + len(after)
    stays, fresh, places = ~is_old, ~is_old & (patch >= 0), np.zeros(0, np.int64)
    while True:
        rows = np.flatnonzero(stays)
        mesh = TriangleMesh(points, facets[rows].astype(np.int32))
        wrong = rows[find_faults(mesh, fresh[rows])] if fresh.any() else rows[:0]
        # What was taken back may be run through by what was not.
        wrong = wrong[(patch[wrong] >= 0) & ~is_old[wrong]]
        if not len(wrong):
            break
        places = np.union1d(places, facets[wrong])
        back = np.isin(patch, patch[wrong])
        stays[back] = is_old[back]
        fresh = back & is_old
    return facets[stays & (np.arange(len(facets)) >= len(rest))], places


def changed_patches(before: Ints, after: Ints, count: int) -> tuple[Ints, Ints]:
    """(m,) the patch of each facet before and (k,) after, -1 for those that stayed.

    Args:
        before: (m, 3) closed, or with a border that stays.
        after: (k, 3) the same.
        count: of points.
    """
    turned = (np.take_along_axis(part, _first_least(part), 1) for part in (before, after))
    name, other = ((part * np.array([count**2, count, 1])).sum(axis=1) for part in turned)
    rows = [np.flatnonzero(~np.isin(name, other)), np.flatnonzero(~np.isin(other, name))]
    one, two = before[rows[0]], after[rows[1]]
    facets = np.concatenate([one, two])
    begin, end = facets.ravel(), np.roll(facets, -1, axis=1).ravel()
    owner = np.repeat(np.arange(len(facets)), 3)
    was = owner < len(one)
    side, back = begin * count + end, end * count + begin
    is_kept = np.where(was, np.isin(side, side[~was]), np.isin(side, side[was]))
    # Both facets at an edge that is gone, or new; what was and what is at one that stayed.
    links = [_links(side, back, owner, part & ~is_kept, part) for part in (was, ~was)] + [
        _links(side, side, owner, was & is_kept, ~was)
    ]
    # And all about a point of which no edge stayed.
    settled = np.zeros(count, bool)
    settled[begin[is_kept]] = settled[end[is_kept]] = True
    loose = ~settled[begin]
    links.append(np.stack([owner[loose], len(facets) + begin[loose]], axis=1))
    pairs = np.concatenate(links)
    _, patch = pieces_of(pairs[:, 0], pairs[:, 1], len(facets) + count)
    result = np.full(len(before), -1), np.full(len(after), -1)
    result[0][rows[0]], result[1][rows[1]] = patch[: len(one)], patch[len(one) : len(facets)]
    return result


def _first_least(facets: Ints) -> Ints:
    """(m, 3) places of corners in the order in which facets begin with their least."""
    places: Ints = (facets.argmin(axis=1)[:, None] + np.arange(3)) % 3
    return places


def _links(one: Ints, two: Ints, owner: Ints, of: Bools, among: Bools) -> Ints:
    """(k, 2) owners of sides with equal names: `one` of some, `two` of others."""
    names, rows = two[among], owner[among]
    order = np.argsort(names)
    names, rows = names[order], rows[order]
    at = np.minimum(np.searchsorted(names, one[of]), max(len(names) - 1, 0))
    if not len(names):
        return np.zeros((0, 2), np.int64)
    found = names[at] == one[of]
    return np.stack([owner[of][found], rows[at[found]]], axis=1)

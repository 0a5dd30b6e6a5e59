# SPDX-License-Identifier: LGPL-2.1-or-later
"""Polygons with holes in a plane cut into triangles between their own corners.

manifold3d does it where it is there. Without it ears are clipped here: holes are joined to the
outline by bridges, from the rightmost corner of each to a corner that it sees (D. Eberly,
"Triangulation by ear clipping"); of all ears the one with the widest least angle goes first.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ..util.manifold import has_manifold, manifold_library
from ..util.types import Bools, Floats, Ints


def triangulate(loops: Sequence[NDArray[np.float64]]) -> Ints:
    """(m, 3) corners of triangles, counted through all loops.

    Args:
        loops: (n, 2) each, outlines counter-clockwise, holes clockwise; any number of outlines.
    """
    if has_manifold():
        library = manifold_library("Cutting polygons into triangles")
        return np.asarray(library.triangulate(list(loops)), np.int64).reshape(-1, 3)
    return clip_ears(loops)


def clip_ears(loops: Sequence[NDArray[np.float64]]) -> Ints:
    """The same without manifold3d; loops that cross each other come out as they may."""
    points = np.concatenate(loops)
    ends = np.cumsum([len(loop) for loop in loops])
    rows = [np.arange(end - len(loop), end) for loop, end in zip(loops, ends, strict=True)]
    areas = np.array([_area(points[row]) for row in rows])
    outlines = [k for k in np.argsort(areas) if areas[k] > 0.0]
    of: dict[int, list[Ints]] = {k: [] for k in outlines}
    for k in np.flatnonzero(areas <= 0.0):
        # The least outline about a hole is its own.
        owner = next((o for o in outlines if _encloses(points[rows[o]], points[rows[k]])), None)
        if owner is not None:
            of[owner].append(rows[k])
    found = [_ears(points, _bridge_holes(points, rows[k], of[k])) for k in of]
    return np.concatenate(found) if found else np.zeros((0, 3), np.int64)


def _area(points: Floats) -> float:
    ahead = np.roll(points, -1, axis=0)
    return float((points[:, 0] * ahead[:, 1] - points[:, 1] * ahead[:, 0]).sum()) / 2.0


def _encloses(outline: Floats, hole: Floats) -> bool:
    """Whether most of a hole's corners lie in an outline: they may touch it."""
    x, y = outline.T
    nx, ny = np.roll(outline, -1, axis=0).T
    px, py = hole[:, :1], hole[:, 1:]
    spans = (y > py) != (ny > py)
    rise = np.where(ny == y, 1.0, ny - y)
    crossed = spans & (px < x + (py - y) * (nx - x) / rise)
    return bool((crossed.sum(axis=1) % 2 == 1).mean() > 0.5)


def _bridge_holes(points: Floats, outline: Ints, holes: list[Ints]) -> Ints:
    """One closed way along the outline and all its holes."""
    for hole in sorted(holes, key=lambda rows: -float(points[rows, 0].max())):
        start = int(points[hole, 0].argmax())
        at = points[hole[start]]
        outline_points = points[outline]
        order = np.argsort(((outline_points - at) ** 2).sum(axis=1), kind="stable")
        seen = next((k for k in order.tolist() if _is_free(points, outline, holes, at, k)), None)
        place = int(order[0]) if seen is None else seen
        around = np.concatenate([hole[start:], hole[: start + 1]])
        outline = np.concatenate([outline[: place + 1], around, outline[place:]])
    return outline


def _is_free(points: Floats, outline: Ints, holes: list[Ints], at: Floats, place: int) -> bool:
    """Whether a bridge to the outline's corner stays inside and meets no side."""
    to = points[outline[place]]
    before, after = points[outline[place - 1]], points[outline[(place + 1) % len(outline)]]
    turn = _side(before, to, after)
    within = (_side(before, to, at) > 0.0, _side(to, after, at) > 0.0)
    if not (all(within) if turn > 0.0 else any(within)):
        return False
    ways = [outline, *holes]
    a = np.concatenate([points[way] for way in ways])
    b = np.concatenate([points[np.roll(way, -1)] for way in ways])
    shared = np.zeros(len(a), bool)
    for end in (at, to):
        shared |= (a == end).all(axis=1) | (b == end).all(axis=1)
    one, two = _side(at, to, a), _side(at, to, b)
    three, four = _side(a, b, at), _side(a, b, to)
    crossed = (one * two <= 0.0) & (three * four <= 0.0) & ~shared
    return not crossed.any()


def _side(a: Floats, b: Floats, c: Floats) -> Floats:
    """Twice the area of triangles, positive to the left of a to b."""
    u, v = b - a, c - a
    return np.asarray(u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0])


def _ears(points: Floats, way: Ints) -> Ints:
    """Triangles of a closed way that may run along a bridge twice."""
    rest = way
    result = []
    worth = _worth(points, rest, np.arange(len(rest)))
    while len(rest) > 3:
        # An ear with another corner inside is none; where rounding leaves none, the best is taken.
        best = -1
        for k in np.argsort(-worth, kind="stable").tolist():
            if worth[k] <= 0.0:
                break
            if not _holds_corner(points, rest, k):
                best = k
                break
        if best < 0:
            best = int(worth.argmax())
        count = len(rest)
        result.append([rest[best - 1], rest[best], rest[(best + 1) % count]])
        rest, worth = np.delete(rest, best), np.delete(worth, best)
        near = np.array([best - 1, best]) % len(rest)
        worth[near] = _worth(points, rest, near)
    result.append(rest.tolist())
    return np.array(result, np.int64)


def _worth(points: Floats, way: Ints, where: Ints) -> Floats:
    """Twice an ear's area over the square of its longest side, for corners of a way."""
    a, b = points[way[where - 1]], points[way[where]]
    c = points[way[(where + 1) % len(way)]]
    sides = [((p - q) ** 2).sum(axis=1) for p, q in ((a, b), (b, c), (c, a))]
    return np.asarray(_side(a, b, c) / np.maximum(np.max(sides, axis=0), 1e-300))


def _holds_corner(points: Floats, way: Ints, k: int) -> bool:
    a, b, c = points[way[k - 1]], points[way[k]], points[way[(k + 1) % len(way)]]
    others = points[way]
    inside: Bools = (
        (_side(a, b, others) >= 0.0) & (_side(b, c, others) >= 0.0) & (_side(c, a, others) >= 0.0)
    )
    for corner in (a, b, c):
        inside &= ~(others == corner).all(axis=1)
    return bool(inside.any())

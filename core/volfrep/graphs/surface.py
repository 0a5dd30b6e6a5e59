# SPDX-License-Identifier: LGPL-2.1-or-later
"""The surface of a network: joint by joint, and by a Boolean where joints leave no room.

A strut between two joints needs a place where nothing but itself is: there the pieces of its ends
meet in a flat disc. Where it is too short for that, or where struts run into each other without
sharing a node, the nodes about it are made of whole struts and balls, which manifold3d unites;
their discs towards the other joints stay as they are, so that the pieces still fit.

One Boolean of all struts and balls was tried and dropped: it took 20 times as long and left
needles.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.spatial import cKDTree

from ..grid.strut_graph import Wireframe
from ..mesh.booleans import from_library, to_library
from ..mesh.topology import edges_of
from ..mesh.triangle_mesh import TriangleMesh, compact
from ..util.errors import VolfrepError
from ..util.manifold import manifold_library
from ..util.numbers import place_text
from ..util.progress import Monitor
from ..util.types import Bools, Floats, Ints
from .clearance import too_near
from .half_struts import (
    HalfStruts,
    ball_directions,
    ball_scale,
    corner_scale,
    half_struts,
    hull_of,
)
from .joints import creases, joint_pieces, seats

if TYPE_CHECKING:
    import manifold3d

#: Corners round a strut: no fewer keep the volume, and no more are worth their triangles.
FEWEST_SIDES, MOST_SIDES = 10, 64
#: How often what is united is made larger, where a union has cut a disc.
_GROWTHS = 8
#: More overlapping struts and balls than this take too long to unite.
MOST_UNITED = 20_000


@dataclass(frozen=True, eq=False)
class GraphSurface:
    """A closed surface of a network.

    Attributes:
        mesh: mm.
        united: how many of its nodes were made by a Boolean.
        crowded: (k,) struts that are too short for the joints at their ends.
        overlapping: (l, 2) struts, and after them nodes, that overlap without sharing a node.
    """

    mesh: TriangleMesh
    united: int
    crowded: Ints
    overlapping: Ints


def sides_for(relative_deviation: float) -> int:
    """Corners round a strut whose facets stray from it by a deviation in units of its radius.

    Facets of edge e stray by e2 / (16 r) to either side.

    Raises:
        VolfrepError: that takes more than `MOST_SIDES`.
    """
    sides = math.ceil(2.0 * math.pi / math.sqrt(16.0 * relative_deviation) - 1e-9)
    if sides > MOST_SIDES:
        least = (2.0 * math.pi / MOST_SIDES) ** 2 / 16.0
        raise VolfrepError(
            f"A deviation of {relative_deviation:.2g} radii needs {sides} facets round a strut: "
            f"the limit is {MOST_SIDES}, which reaches {least:.2g} radii."
        )
    return max(sides, FEWEST_SIDES)


def graph_surface(frame: Wireframe, sides: int, monitor: Monitor) -> GraphSurface:
    """The closed surface of struts and balls.

    Args:
        frame: the network; a ball's radius is no smaller than those of its struts there.
        sides: corners round each strut.
        monitor: for progress and cancel.

    Raises:
        VolfrepError: too much of it overlaps, or a joint's struts are too thick for its angles.
    """
    halves = half_struts(frame, sides)
    crease = creases(halves, ball_scale(sides) * frame.joint_radii)
    seat, crowded = seats(halves, crease)
    overlapping = too_near(frame, corner_scale(sides), ball_scale(sides))
    monitor.tick(0.1)
    count = len(frame.struts)
    solo = np.ones(len(frame.nodes), bool)
    solo[frame.struts[crowded]] = False
    both = overlapping.ravel()
    solo[frame.struts[both[both < count]]] = False
    solo[both[both >= count] - count] = False
    points, rows, owner = np.zeros((0, 3)), np.zeros((0, 3), np.int64), np.zeros(0, np.int64)
    if solo.any():
        points, rows, owner, failed = joint_pieces(frame, halves, crease, seat, solo, monitor)
        solo[failed] = False
    monitor.tick(0.9)
    united, lost = None, np.zeros(0, np.int64)
    if not solo.all():
        for _ in range(_GROWTHS):
            united = _unite(frame, halves, seat, solo, sides, monitor)
            lost = _find_lost_discs(points, united, frame, solo, sides)
            if not len(lost):
                break
            solo[frame.struts[lost]] = False
    if len(lost):
        place = place_text(frame.nodes[frame.struts[lost[0]]].mean(axis=0))
        raise VolfrepError(
            f"Struts overlap so much about {place} that they cannot be united: make them thinner."
        )
    found = (int((~solo).sum()), np.flatnonzero(crowded), overlapping)
    rows = rows[solo[owner]]
    if united is None:
        return GraphSurface(compact(TriangleMesh(points, rows.astype(np.int32))), *found)
    number = _same_places(points[: count * sides], united)
    number = np.where(number >= 0, number, np.arange(len(number)) + len(points))
    joined = TriangleMesh(
        np.concatenate([points, united.vertices]),
        np.concatenate([rows, number[united.triangles]]).astype(np.int32),
    )
    return GraphSurface(compact(joined), *found)


def _unite(
    frame: Wireframe,
    halves: HalfStruts,
    seat: Floats,
    solo: Bools,
    sides: int,
    monitor: Monitor,
) -> TriangleMesh:
    """The union about nodes that are not meshed alone, open at the discs towards those that are."""
    library = manifold_library("Uniting struts that overlap")
    count = len(frame.struts)
    ends_solo = solo[frame.struts]
    struts = np.flatnonzero(~ends_solo.all(axis=1))
    nodes = np.flatnonzero(~solo)
    if len(struts) + len(nodes) > MOST_UNITED:
        raise VolfrepError(
            f"{len(struts):,} struts overlap others, or are too short for the joints at their "
            "ends: make the struts thinner, or take away the shortest ones."
        )
    total = halves.length[:count]
    low = np.where(ends_solo[:, 0], seat, 0.0)[struts]
    high = np.where(ends_solo[:, 1], seat, total)[struts]
    start = frame.nodes[frame.struts[struts, 0]]

    def ring(at: Floats) -> Floats:
        wide = halves.radius[struts] + halves.slope[struts] * at
        middle = start + halves.along[struts] * at[:, None]
        return np.asarray(middle[:, None] + wide[:, None, None] * halves.rays[struts])

    corners = np.concatenate([ring(low), ring(high)], axis=1)
    one = np.arange(sides)
    two = (one + 1) % sides
    wall = np.concatenate(
        [np.stack([one, two, two + sides], 1), np.stack([one, two + sides, one + sides], 1)]
    )
    fan = np.stack([np.zeros(sides - 2, np.int64), one[1:-1], one[2:]], axis=1)
    caps = (fan[:, ::-1], fan + sides)
    ball = ball_directions(sides)
    hull = hull_of(ball)
    pieces = []
    first = library.Manifold.reserve_ids(2 * len(struts) + len(nodes))
    for k in range(len(struts)):
        # Discs towards joints that are meshed alone are told apart from all other triangles.
        is_open = ends_solo[struts[k]]
        other = [cap for cap, opened in zip(caps, is_open, strict=True) if not opened]
        discs = [cap for cap, opened in zip(caps, is_open, strict=True) if opened]
        rows = np.concatenate([wall, *other, *discs])
        closed = len(rows) - sum(len(cap) for cap in discs)
        pieces.append(_piece(corners[k], rows, (closed, len(rows) - closed), first + 2 * k))
        monitor.tick(0.9)
    radius = ball_scale(sides) * frame.joint_radii[nodes]
    for k, node in enumerate(nodes.tolist()):
        place = frame.nodes[node] + radius[k] * ball
        pieces.append(_piece(place, hull, (len(hull),), first + 2 * len(struts) + k))
    result = monitor.call(
        lambda: library.Manifold.batch_boolean(pieces, library.OpType.Add).to_mesh64()
    )
    index = np.asarray(result.run_index).astype(np.int64) // 3
    origin = np.repeat(np.asarray(result.run_original_id).astype(np.int64), np.diff(index)) - first
    is_disc = (origin < 2 * len(struts)) & (origin % 2 == 1)
    whole = from_library(result)
    return compact(TriangleMesh(whole.vertices, whole.triangles[~is_disc]))


def _piece(corners: Floats, rows: Ints, runs: tuple[int, ...], first: int) -> manifold3d.Manifold:
    library = manifold_library("Uniting struts that overlap")
    source = to_library(
        TriangleMesh(corners, rows.astype(np.int32)),
        run_index=np.concatenate([[0], np.cumsum(runs)]).astype(np.uint64) * np.uint64(3),
        run_original_id=np.arange(first, first + len(runs), dtype=np.uint32),
    )
    return library.Manifold(source)


def _same_places(discs: Floats, united: TriangleMesh) -> Ints:
    """(n,) the corner of a disc that each vertex of a union is; -1 for none.

    What a Boolean does not cut has exactly the coordinates that it was given.
    """
    known = {place.tobytes(): k for k, place in enumerate(discs)}
    found = [known.get(place.tobytes(), -1) for place in united.vertices]
    return np.array(found, np.int64)


def _find_lost_discs(
    points: Floats, united: TriangleMesh, frame: Wireframe, solo: Bools, sides: int
) -> Ints:
    """The struts whose discs a union has cut, so that the joint beyond would not fit."""
    ends = solo[frame.struts]
    wanted = np.flatnonzero(ends.any(axis=1) & ~ends.all(axis=1))
    discs = points[: len(frame.struts) * sides]
    corner = _same_places(discs, united)
    edges = edges_of(united)
    open_at = edges.sides[edges.open_sides]
    strut = corner[open_at] // sides
    is_rim = (corner[open_at] >= 0).all(axis=1) & (strut[:, 0] == strut[:, 1])
    whole = np.bincount(strut[is_rim, 0], minlength=len(frame.struts))
    lost: Ints = wanted[whole[wanted] != sides]
    # What comes through the middle of a disc leaves its rim, and opens the union there.
    holes = united.vertices[open_at[~is_rim].ravel()]
    if len(holes):
        middles = discs.reshape(-1, sides, 3)[wanted].mean(axis=1)
        lost = np.union1d(lost, wanted[np.unique(cKDTree(middles).query(holes)[1])])
    return lost

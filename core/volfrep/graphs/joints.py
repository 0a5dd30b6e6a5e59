# SPDX-License-Identifier: LGPL-2.1-or-later
"""The surface of one joint of any struts: a star about its node, cut flat where it meets the next.

A half strut that begins at a node is convex and holds the node; so does the joint sphere. Their
union is star-shaped: a radius over every direction from the node. Its surface is therefore meshed
on the sphere of directions, by the convex hull of the directions of its vertices (their Delaunay
triangulation on the sphere), which can neither cross itself nor have a hole, whatever the angles.
The vertices lie on the rulings of the struts: where a ruling leaves the other struts and the
sphere (the crease, in closed form), and where it reaches the flat disc at which the piece of the
next joint begins. Both sides see the same vertices there.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.spatial import cKDTree

from ..grid.strut_graph import Wireframe
from ..util.linalg import times
from ..util.progress import Monitor
from ..util.ragged import spread
from ..util.types import Bools, Floats, Ints
from .half_struts import HalfStruts, ball_directions, ball_scale, hull_of
from .piece_fit import Pieces

#: Vertices of a piece that are nearer than this, in units of the facets' edge, are one.
_SAME = 0.25
#: How far the sphere's own vertices keep from struts, in units of the facets' edge.
_CLEAR = 0.3
#: Vertices along a ruling, in units of the angle between rulings.
_STRETCH = 1.0
#: Creases farther out than this, in units of the radius, are given vertices between the rulings.
_LATE = 1.5
#: Between a crease and the disc, in units of the strut's radius.
_COLLAR = 0.2
#: Directions are moved by so much before they are triangulated: four of them may lie on a circle.
_JITTER = 1e-7


def creases(halves: HalfStruts, balls: Floats) -> Floats:
    """(2 m, sides) how far from its node each ruling leaves the other struts and the ball.

    Infinite where a strut that widens never lets it out.

    Args:
        halves: the struts.
        balls: (n,) radii of the nodes' balls, mm.
    """
    ball = balls[halves.node]
    # |ray (r + k z) + u z| = R
    a = 1.0 + halves.slope**2
    b = halves.radius * halves.slope
    c = halves.radius**2 - ball**2
    reach = (-b + np.sqrt(np.maximum(b * b - a * c, 0.0))) / a
    found = np.repeat(np.where(c < 0.0, reach, 0.0)[:, None], halves.rays.shape[1], axis=1)
    one, two = _meeting(halves.node)
    chunk = max(1, 2_000_000 // halves.rays.shape[1])
    for k in range(0, len(one), chunk):
        mine, theirs = one[k : k + chunk], two[k : k + chunk]
        np.maximum.at(found, mine, _ruling_exits(halves, mine, theirs))
    return found


def _meeting(node: Ints) -> tuple[Ints, Ints]:
    """All ordered pairs of half struts at one node."""
    order = np.argsort(node, kind="stable")
    count = np.bincount(node)
    first = np.cumsum(count) - count
    times = count[node[order]]
    owner, place = spread(times)
    one, two = order[owner], order[first[node[order[owner]]] + place]
    return one[one != two], two[one != two]


def _ruling_exits(halves: HalfStruts, mine: Ints, theirs: Ints) -> Floats:
    """(pairs, sides) where rulings of some struts leave others; 0 where they are not inside."""
    rays = halves.rays[mine]
    across = halves.radius[mine, None, None] * rays
    step = halves.along[mine, None] + halves.slope[mine, None, None] * rays
    axis = halves.along[theirs, None]
    start, grow = (across * axis).sum(-1), (step * axis).sum(-1)
    wide, slope = halves.radius[theirs, None], halves.slope[theirs, None]
    share = 1.0 + slope**2
    a = (step * step).sum(-1) - share * grow**2
    b = (across * step).sum(-1) - share * start * grow - wide * slope * grow
    c = (across * across).sum(-1) - share * start**2 - 2.0 * wide * slope * start - wide**2
    inner = b * b - a * c
    with np.errstate(divide="ignore", invalid="ignore"):
        place = (-b + np.sqrt(inner)) / a
    left = np.where((inner > 0.0) & (a > 0.0), place, 0.0)
    left = np.where(start + grow * left > 0.0, np.maximum(left, 0.0), 0.0)
    # Two struts along each other, or one that widens faster than they part.
    lost = (a <= 1e-12) & (grow > 0.0)
    return np.where(lost, np.inf, left)


def seats(halves: HalfStruts, crease: Floats) -> tuple[Floats, Bools]:
    """Where the discs lie between the joints, and which struts have no room for one.

    Returns:
        (m,) distance from each strut's first node, mm, and (m,) bool.
    """
    need = crease.max(axis=1) + _COLLAR * halves.radius
    count = len(need) // 2
    near, far = need[:count], need[count:]
    length = halves.length[:count]
    crowded = ~(near + far <= length)
    with np.errstate(invalid="ignore"):
        place = 0.5 * (near + length - far)
    return np.where(crowded, 0.5 * length, place), crowded


def joint_pieces(
    frame: Wireframe,
    halves: HalfStruts,
    crease: Floats,
    seat: Floats,
    of_node: Bools,
    monitor: Monitor,
) -> tuple[Floats, Ints, Ints, Ints]:
    """The surfaces of some nodes' pieces, welded at their discs, open where the next is not one.

    Args:
        frame: the lattice.
        halves: its struts, seen from their nodes.
        crease: as of `creases`.
        seat: as of `seats`.
        of_node: (n,) which nodes.
        monitor: for cancel.

    Returns:
        vertices, of which the first m * sides are the discs' corners strut by strut; triangles
        and the node of each; and the nodes that could not be meshed, which have none.
    """
    sides, count = halves.rays.shape[1], len(seat)
    places = seat[:, None, None]
    start = frame.nodes[frame.struts[:, 0]]
    wide = halves.radius[:count] + halves.slope[:count] * seat
    rings = start[:, None] + halves.along[:count, None] * places
    rings = rings + wide[:, None, None] * halves.rays[:count]

    taking = np.flatnonzero(of_node[halves.node])
    arm_node = np.repeat(halves.node[taking], sides)
    local = crease[taking, :, None] * (
        halves.along[taking, None] + halves.slope[taking, None, None] * halves.rays[taking]
    )
    local = (local + halves.radius[taking, None, None] * halves.rays[taking]).reshape(-1, 3)
    levels, level_node = _levels(halves, crease, seat, taking)
    local, arm_node = np.concatenate([local, levels]), np.concatenate([arm_node, level_node])
    between, between_node = _between(frame, halves, crease, taking)
    local, arm_node = np.concatenate([local, between]), np.concatenate([arm_node, between_node])
    balls, ball_node = _ball_points(frame, halves, of_node, sides)
    free = np.concatenate([local, balls])
    free_node = np.concatenate([arm_node, ball_node])
    kept = _distinct(free, free_node, frame.joint_radii, _SAME * 2.0 * np.pi / sides)
    free, free_node = free[kept], free_node[kept]

    ring_number = (taking % count)[:, None] * sides + np.arange(sides)
    from_node = rings[taking % count] - frame.nodes[halves.node[taking], None]
    # Every vertex of every piece, piece by piece: the discs' first, strut by strut.
    vertex = np.concatenate([ring_number.ravel(), count * sides + np.arange(len(free))])
    place = np.concatenate([from_node.reshape(-1, 3), free])
    node = np.concatenate([np.repeat(halves.node[taking], sides), free_node])
    disc = np.concatenate([np.repeat(taking, sides), np.full(len(free), -1)])
    order = np.argsort(node, kind="stable")
    rows, failed = _triangulate(place[order], node[order], disc[order], monitor)
    surface = Pieces(place[order], node[order], frame, halves)
    rows = surface.flipped(rows)
    moved = surface.fitted(rows, disc[order] < 0)
    free[vertex[order][disc[order] < 0] - count * sides] = moved[disc[order] < 0]
    triangles = vertex[order][rows]
    points = np.concatenate([rings.reshape(-1, 3), frame.nodes[free_node] + free])
    return points, triangles, node[order][rows[:, 0]], failed


def _levels(halves: HalfStruts, crease: Floats, seat: Floats, taking: Ints) -> tuple[Floats, Ints]:
    """Vertices on the rulings between crease and disc, from the node, and their nodes.

    They are spaced as the rulings are, seen from the node, so that the triangulation of the
    directions joins each ruling to the next one and none beyond.
    """
    sides, count = halves.rays.shape[1], len(seat)
    seat_of = np.where(taking < count, seat[taking % count], 0.0)
    back = taking >= count
    seat_of[back] = halves.length[taking[back]] - seat[taking[back] % count]
    ratio = np.exp(2.0 * np.pi / sides * _STRETCH)
    points, nodes = [], []
    place = seat_of / ratio
    while True:
        far = place[:, None] > crease[taking] * (1.0 + 0.5 * (ratio - 1.0))
        far &= (place > 0.4 * halves.radius[taking])[:, None]
        if not far.any():
            break
        which, ray = np.nonzero(far)
        half = taking[which]
        wide = halves.radius[half] + halves.slope[half] * place[which]
        points.append(
            place[which, None] * halves.along[half] + wide[:, None] * halves.rays[half, ray]
        )
        nodes.append(halves.node[half])
        place = place / ratio
    if not points:
        return np.zeros((0, 3)), np.zeros(0, np.int64)
    return np.concatenate(points), np.concatenate(nodes)


def _between(
    frame: Wireframe, halves: HalfStruts, crease: Floats, taking: Ints
) -> tuple[Floats, Ints]:
    """Vertices of creases between the rulings, from the node, and their nodes.

    Where struts part late the notch between them is long, and the rulings alone would let facets
    span it.
    """
    narrow = taking[crease[taking].max(axis=1) > _LATE * halves.radius[taking]]
    if not len(narrow):
        return np.zeros((0, 3)), np.zeros(0, np.int64)
    sides = halves.rays.shape[1]
    rays = halves.rays + np.roll(halves.rays, -1, axis=1)
    rays /= np.linalg.norm(rays, axis=-1, keepdims=True)
    flat = np.cos(np.pi / sides)
    facets = replace(halves, rays=rays, radius=flat * halves.radius, slope=flat * halves.slope)
    balls = ball_scale(sides) * frame.joint_radii
    found = creases(facets, balls)[narrow]
    which, ray = np.nonzero(found > _LATE * halves.radius[narrow, None])
    half, place = narrow[which], found[which, ray]
    wide = facets.radius[half] + facets.slope[half] * place
    points = place[:, None] * facets.along[half] + wide[:, None] * rays[half, ray]
    return points, halves.node[half]


def _ball_points(
    frame: Wireframe, halves: HalfStruts, of_node: Bools, sides: int
) -> tuple[Floats, Ints]:
    """Vertices of the nodes' balls where no strut covers them, from the node, and their nodes."""
    spacing, ways = 2.0 * np.pi / sides, ball_directions(sides)
    number = len(ways)
    radius = ball_scale(sides) * frame.joint_radii
    seen = np.repeat(of_node[:, None], number, axis=1)
    for begin in range(0, len(halves.node), 20_000):
        some = slice(begin, begin + 20_000)
        node = halves.node[some]
        along = times(halves.along[some], ways.T) * radius[node, None]
        across = np.sqrt(np.maximum(radius[node, None] ** 2 - along**2, 0.0))
        beside = across - halves.radius[some, None] - halves.slope[some, None] * along
        away = np.hypot(np.minimum(along, 0.0), np.maximum(beside, 0.0))
        covered = away < _CLEAR * spacing * radius[node, None]
        np.logical_and.at(seen, node, ~covered)
    node, way = np.nonzero(seen)
    return radius[node, None] * ways[way], node


def _distinct(points: Floats, node: Ints, balls: Floats, edge: float) -> Bools:
    """Which points stay when those of a node that nearly coincide are made one.

    Args:
        points: from their nodes, mm.
        node: theirs.
        balls: (n,) the nodes' balls, mm.
        edge: the distance below which they do, in units of the ball.
    """
    lifted = np.concatenate([points / balls[node, None], 2.0 * edge * node[:, None]], axis=1)
    pairs = cKDTree(lifted).query_pairs(edge, output_type="ndarray")
    kept = np.ones(len(points), bool)
    kept[pairs.max(axis=1)] = False
    return kept


def _triangulate(place: Floats, node: Ints, disc: Ints, monitor: Monitor) -> tuple[Ints, Ints]:
    """The triangles of pieces, given all their vertices, piece by piece; the discs are left open.

    And the nodes at which that failed.

    Qhull takes one joint at a time; joints that look alike are triangulated once.
    """
    ways = place / np.linalg.norm(place, axis=1, keepdims=True)
    random = np.random.default_rng(0)
    begin = np.flatnonzero(np.diff(node, prepend=-1))
    end = np.append(begin[1:], len(node))
    longest = int((end - begin).max(initial=0))
    shaken = random.uniform(-_JITTER, _JITTER, (longest, 3))
    rounded = np.round(ways, 6) + 0.0
    known: dict[bytes, Ints] = {}
    found, failed = [], []
    for k, (low, high) in enumerate(zip(begin.tolist(), end.tolist(), strict=True)):
        if k % 256 == 0:
            monitor.tick(k / len(begin))
        key = rounded[low:high].tobytes()
        if key not in known:
            known[key] = _hull(ways[low:high] + shaken[: high - low], disc[low:high])
        rows = known[key]
        if not len(rows):
            failed.append(int(node[low]))
        found.append(rows + low)
    return np.concatenate(found), np.array(failed, np.int64)


def _hull(ways: Floats, disc: Ints) -> Ints:
    """Triangles over the sphere of directions, counter-clockwise from outside, without discs.

    None where they would not be those of a joint.
    """
    rows = hull_of(ways / np.linalg.norm(ways, axis=1, keepdims=True))
    of = disc[rows]
    flat = (of[:, 0] >= 0) & (of[:, 0] == of[:, 1]) & (of[:, 1] == of[:, 2])
    _, corners = np.unique(disc[disc >= 0], return_counts=True)
    if len(rows) != 2 * len(ways) - 4 or flat.sum() != (corners - 2).sum():
        return np.zeros((0, 3), np.int64)  # another strut is seen through one of the discs
    left: Ints = rows[~flat]
    return left

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Random networks in a part: Voronoi and Delaunay edges of points, short and narrow ones cleared.

The points reach beyond the part, so that struts cross its wall and end on it where they are cut.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.spatial import Delaunay, Voronoi

from ..design.graphs import RandomGraph
from ..mesh.topology import edge_keys, pieces_of
from ..mesh.triangle_mesh import TriangleMesh
from ..spatial.rays import inside_points
from ..util.errors import VolfrepError
from ..util.progress import Monitor
from ..util.types import Bools, Floats, Ints

#: How far the points reach beyond the part's box, in units of their distance.
_BEYOND = 2.0
#: Delaunay's edges longer than this, in units of that distance, span hollows of the points.
_LONGEST = 3.0
#: Places on a strut that are looked at to see whether it is in the part.
_LOOKS = 7
_FEWEST = 8
#: Halvings of a strut to find where it crosses the wall.
_BISECTIONS = 24
#: No more points than this are drawn in all, of which a thin part may hold few.
_MOST_DRAWN = 400_000


def random_graph(
    wanted: RandomGraph,
    domain: TriangleMesh,
    spacing: float,
    shortest: float,
    depth: Callable[[Floats], Floats],
    monitor: Monitor,
) -> tuple[Floats, Ints]:
    """The nodes and struts of a random network in a domain, or across its wall.

    Args:
        wanted: what kind, and of what points.
        domain: closed mesh, mm.
        spacing: how far apart the points are to lie where their number is not given, mm.
        shortest: struts below that are drawn together, where `wanted` does not say, mm.
        depth: gives the depth of points below the wall, mm; 0 outside.
        monitor: for progress and cancel.

    Returns:
        nodes (n, 3), mm, and struts (m, 2).

    Raises:
        VolfrepError: the domain takes too many points, or no strut is left.
    """
    points, spacing = _points(wanted, domain, spacing, depth, monitor)
    for _ in range(wanted.relax):
        points = _relax(points)
        monitor.tick(0.2)
    on_wall = np.zeros((0, 2), np.int64)
    if wanted.kind == "voronoi":
        found = Voronoi(points)
        nodes, struts = found.vertices, _ridge_edges(found)[0]
        if wanted.on_wall:
            nodes, struts, on_wall = _end_on_wall(found, struts, domain, monitor)
    else:
        nodes = points
        corners = Delaunay(points).simplices
        one, two = np.triu_indices(4, 1)
        struts = np.unique(
            np.sort(np.stack([corners[:, one], corners[:, two]], axis=-1).reshape(-1, 2)), axis=0
        )
        length = np.linalg.norm(nodes[struts[:, 1]] - nodes[struts[:, 0]], axis=1)
        struts = struts[length < _LONGEST * spacing]
    monitor.tick(0.5)
    kept = _in_domain(nodes, struts, domain, monitor)
    at_wall = np.zeros(len(nodes), bool)
    at_wall[on_wall] = True
    struts = np.concatenate([struts[kept], on_wall])
    at_wall = at_wall[np.unique(struts)]
    nodes, struts = _drop_unused(nodes, struts)
    nodes, struts = merge_short_struts(nodes, struts, wanted.shortest or shortest, at_wall)
    struts = without_narrow(nodes, struts, wanted.least_angle)
    struts = _without_free_ends(nodes, struts, domain, monitor)
    if not len(struts):
        raise VolfrepError(
            "The network has no strut in the part: take more points, or smaller cells."
        )
    return _drop_unused(nodes, struts)


def _points(
    wanted: RandomGraph,
    domain: TriangleMesh,
    spacing: float,
    depth: Callable[[Floats], Floats],
    monitor: Monitor,
) -> tuple[Floats, float]:
    """The points, and about how far they lie apart."""
    volume = domain.volume
    count = wanted.points or max(_FEWEST, round(volume / spacing**3))
    spacing = float(np.cbrt(volume / count))
    low, high = domain.bounds
    low, high = low - _BEYOND * spacing, high + _BEYOND * spacing
    random = np.random.default_rng(wanted.seed)
    even = not wanted.density.strip()
    needed = 1.2 * count * float(np.prod(high - low)) / volume + 50
    if not even:
        needed *= 3.0
    while True:
        if needed > _MOST_DRAWN:
            raise VolfrepError(
                f"A network of {count:,} points in this part is more than can be drawn: take "
                "fewer, or larger cells."
            )
        drawn = random.uniform(low, high, (int(needed), 3))
        if not even:
            drawn = drawn[_thin_out(wanted, drawn, depth, random)]
        inside = inside_points(domain, drawn, monitor)
        there = int(inside.sum())
        more = 1.2 * needed * count / max(there, 1)
        if there >= count or even or not there or more > _MOST_DRAWN:
            break
        needed = more
    if there < count:
        # A density that leaves nearly all out: as many as there are.
        return drawn, spacing
    # So many inside, and outside in proportion.
    kept = np.ones(len(drawn), bool)
    kept[random.permutation(np.flatnonzero(inside))[count:]] = False
    share = count / there
    kept[~inside] = random.random(int((~inside).sum())) < share
    return drawn[kept], spacing


def _thin_out(
    wanted: RandomGraph,
    drawn: Floats,
    depth: Callable[[Floats], Floats],
    random: np.random.Generator,
) -> Bools:
    """(n,) which of evenly drawn points stay, so that they lie as densely as is wanted."""
    if wanted.field is not None:
        least, most = wanted.field.range
        s = (wanted.field(drawn) - least) / max(most - least, 1e-300)
    else:
        below = depth(drawn)
        s = np.clip(below / max(float(below.max()), 1e-12), 0.0, 1.0)
    wish = np.maximum(wanted.formula(s), 0.0)
    stays: Bools = random.random(len(drawn)) * wish.max() < wish
    return stays


def _ridge_edges(found: Voronoi) -> tuple[Ints, Ints, Ints]:
    """Edges of a Voronoi diagram; and its ridges' corners one after the other, and their ridge."""
    sizes = np.array([len(ridge) for ridge in found.ridge_vertices])
    corner = np.concatenate([np.array(ridge, np.int64) for ridge in found.ridge_vertices])
    ridge = np.repeat(np.arange(len(sizes)), sizes)
    last = np.cumsum(sizes) - 1
    following = np.arange(1, len(corner) + 1)
    following[last] = last - sizes + 1
    edges = np.stack([corner, corner[following]], axis=1)
    edges = edges[(edges >= 0).all(axis=1)]
    return np.unique(np.sort(edges, axis=1), axis=0), corner, ridge


def _relax(points: Floats) -> Floats:
    """Points moved to the middle of their cells' corners; those of open cells stay."""
    found = Voronoi(points)
    _, corner, ridge = _ridge_edges(found)
    low, high = points.min(axis=0), points.max(axis=0)
    place = found.vertices[corner]
    good = (corner >= 0) & (place >= low).all(axis=1) & (place <= high).all(axis=1)
    total, number, bad = np.zeros_like(points), np.zeros(len(points)), np.zeros(len(points), bool)
    for side in (0, 1):
        owner = found.ridge_points[ridge, side]
        np.add.at(total, owner[good], place[good])
        np.add.at(number, owner[good], 1.0)
        bad[owner[~good]] = True
    moved = total / np.maximum(number, 1.0)[:, None]
    return np.where((bad | (number == 0))[:, None], points, moved)


def _end_on_wall(
    found: Voronoi, struts: Ints, domain: TriangleMesh, monitor: Monitor
) -> tuple[Floats, Ints, Ints]:
    """Voronoi edges that end on a wall, and struts along it where it cuts the cells' faces.

    Returns:
        nodes, the edges with their inner ends and places on the wall for those that cross it, and
        struts between such places on one face.
    """
    nodes = np.array(found.vertices)
    inside = inside_points(domain, nodes, monitor)
    crossing = np.flatnonzero(inside[struts[:, 0]] != inside[struts[:, 1]])
    inner = np.where(inside[struts[crossing, 0]], struts[crossing, 0], struts[crossing, 1])
    outer = struts[crossing].sum(axis=1) - inner
    low, high = nodes[inner], nodes[outer]
    for _ in range(_BISECTIONS):
        middle = 0.5 * (low + high)
        within = inside_points(domain, middle, monitor)[:, None]
        low, high = np.where(within, middle, low), np.where(within, high, middle)
    place = np.arange(len(crossing)) + len(nodes)
    ended = struts.copy()
    ended[crossing] = np.stack([inner, place], axis=1)
    # What crosses the domain between two outer ends cuts a corner off it: nothing holds that.
    ended = ended[(np.append(inside, np.ones(len(place), bool))[ended]).all(axis=1)]
    # A face's border is walked round; from where it leaves the domain to where it comes back the
    # wall cuts a corner off the face.
    key = edge_keys(struts[crossing][:, 0], struts[crossing][:, 1], len(nodes))
    known = dict(zip(key.tolist(), place.tolist(), strict=True))
    along = []
    for ridge in found.ridge_vertices:
        if -1 in ridge or inside[ridge].all() or not inside[ridge].any():
            continue
        steps = list(zip(ridge, [*ridge[1:], ridge[0]], strict=True))
        at = [k for k, (a, b) in enumerate(steps) if inside[a] and not inside[b]]
        for first in at:
            last = first + 1
            while inside[steps[last % len(steps)][0]] or not inside[steps[last % len(steps)][1]]:
                last += 1
            ends = [steps[first], steps[last % len(steps)]]
            along.append([known[min(a, b) * len(nodes) + max(a, b)] for a, b in ends])
    pairs = np.array(along, np.int64).reshape(-1, 2)
    return np.concatenate([nodes, 0.5 * (low + high)]), ended, pairs


def _in_domain(nodes: Floats, struts: Ints, domain: TriangleMesh, monitor: Monitor) -> Bools:
    """(m,) the struts of which some of a few places lie in the domain."""
    low, high = domain.bounds
    ends = nodes[struts]
    near = ((ends.max(axis=1) > low) & (ends.min(axis=1) < high)).all(axis=1)
    # What reaches far out of the box would be long, and is cut anyway.
    margin = 0.5 * float((high - low).max())
    near &= ((ends > low - margin) & (ends < high + margin)).all(axis=(1, 2))
    share = np.linspace(0.0, 1.0, _LOOKS)[:, None, None]
    start, end = nodes[struts[near]].swapaxes(0, 1)
    places = start + share * (end - start)
    inside = inside_points(domain, places.reshape(-1, 3), monitor).reshape(_LOOKS, -1)
    near[near] = inside.any(axis=0)
    return np.asarray(near, np.bool_)


def _drop_unused(nodes: Floats, struts: Ints) -> tuple[Floats, Ints]:
    used, rows = np.unique(struts, return_inverse=True)
    return nodes[used], rows.reshape(-1, 2)


def merge_short_struts(
    nodes: Floats, struts: Ints, shortest: float, anchors: Bools | None = None
) -> tuple[Floats, Ints]:
    """The network with the ends of short struts made one node, again and again, in their middle.

    The shortest go first, none beside another in the same round, so that long chains of short
    struts do not fall into one place.

    Args:
        nodes: (n, 3) mm.
        struts: (m, 2).
        shortest: length below which they are short, mm.
        anchors: (n,) nodes that others are drawn to; None for none.
    """
    anchors = np.zeros(len(nodes), bool) if anchors is None else anchors
    while len(struts):
        length = np.linalg.norm(nodes[struts[:, 1]] - nodes[struts[:, 0]], axis=1)
        short = np.flatnonzero(length < shortest)
        if not len(short):
            break
        rank = np.empty(len(short), np.int64)
        rank[np.argsort(length[short], kind="stable")] = np.arange(len(short))
        first = np.full(len(nodes), len(short))
        for side in (0, 1):
            np.minimum.at(first, struts[short, side], rank)
        chosen = short[(first[struts[short]] == rank[:, None]).all(axis=1)]
        count, label = pieces_of(struts[chosen][:, 0], struts[chosen][:, 1], len(nodes))
        has_anchor = np.zeros(count, bool)
        has_anchor[label[anchors]] = True
        counts = anchors | ~has_anchor[label]
        middle = np.zeros((count, 3))
        np.add.at(middle, label[counts], nodes[counts])
        nodes = middle / np.bincount(label[counts], minlength=count)[:, None]
        anchors = has_anchor
        struts = np.sort(label[struts], axis=1)
        struts = struts[struts[:, 0] != struts[:, 1]]
        struts = np.unique(struts, axis=0)
    return _drop_unused(nodes, struts)


def without_narrow(nodes: Floats, struts: Ints, degrees: float) -> Ints:
    """The struts without the longer one of any two that meet at less than an angle."""
    while len(struts):
        span = nodes[struts[:, 1]] - nodes[struts[:, 0]]
        length = np.linalg.norm(span, axis=1)
        along = np.concatenate([span, -span]) / np.tile(length, 2)[:, None]
        node, strut = struts.T.ravel(), np.tile(np.arange(len(struts)), 2)
        order = np.argsort(node, kind="stable")
        narrow = np.zeros(len(struts), bool)
        number = np.bincount(node)
        for step in range(1, int(number.max())):
            one, two = order[:-step], order[step:]
            same = node[one] == node[two]
            one, two = one[same], two[same]
            cosine = (along[one] * along[two]).sum(axis=1)
            close = cosine > np.cos(np.radians(degrees))
            a, b = strut[one[close]], strut[two[close]]
            longer = np.where((length[a] > length[b]) | ((length[a] == length[b]) & (a > b)), a, b)
            narrow[longer] = True
        if not narrow.any():
            break
        # The longest of a neighbourhood first: what is left of it may do without the others going.
        worst = np.zeros(len(nodes))
        for side in (0, 1):
            np.maximum.at(worst, struts[narrow, side], length[narrow])
        gone = narrow & (length >= worst[struts].max(axis=1))
        struts = struts[~gone]
    return struts


def _without_free_ends(nodes: Floats, struts: Ints, domain: TriangleMesh, monitor: Monitor) -> Ints:
    """The struts without those that end freely inside the domain."""
    inside = inside_points(domain, nodes, monitor)
    while len(struts):
        number = np.bincount(struts.ravel(), minlength=len(nodes))
        free = (inside & (number == 1))[struts].any(axis=1)
        if not free.any():
            break
        struts = struts[~free]
    return struts

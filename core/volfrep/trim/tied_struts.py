# SPDX-License-Identifier: LGPL-2.1-or-later
"""What hangs together in a trimmed lattice's mesh hangs together in its beams.

Beams touch at nodes only. Where the wall takes a node away, the ends of its struts still overlap
beside one another: such ends are drawn together into one node. Struts that lie in the wall, or
outside it by less than their radius, stay as thinner ones, of the area that is inside. Struts that
touch elsewhere are tied by a short strut between the nearest points of their axes.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..grid.strut_graph import Wireframe
from ..mesh.topology import pieces_of
from ..mesh.triangle_mesh import TriangleMesh
from ..spatial.proximity import closest_points
from ..spatial.rays import inside_points
from ..util.progress import Monitor
from ..util.ragged import spread
from ..util.types import Bools, Floats, Ints
from .clip_struts import SHORTEST_PIECE, Clipped

#: Axes nearer to each other than this, in radii, meet in one node; others get a tie.
_MEETS = 0.1
#: Bins along the longest side in which struts are that others may touch.
MOST_BINS = 256
#: A strut outside the wall of which less than this share of the section is inside is none.
_LEAST_SECTION = 0.05


def with_grazing(
    clipped: Clipped, lattice: Wireframe, boundary: TriangleMesh, grazing: Ints
) -> Clipped:
    """A clipped lattice and the struts whose sides alone reach in, as thin as what is inside.

    Struts that the wall cuts off just before a node of these go on to it.

    Args:
        clipped: the axes inside the wall.
        lattice: all the struts, mm.
        boundary: closed mesh that cuts them, mm.
        grazing: struts without a piece inside, both of whose nodes are nearer to the wall than
            their joints' radius.
    """
    start, end = lattice.nodes[lattice.struts[grazing]].swapaxes(0, 1)
    places = np.array([1.0, 3.0, 5.0, 7.0]) / 8.0
    points = start[:, None] + places[:, None] * (end - start)[:, None]
    off = closest_points(boundary, points.reshape(-1, 3))[1].reshape(-1, len(places))
    # What the axis dips in by is as good as on the wall.
    off[inside_points(boundary, points.reshape(-1, 3), Monitor()).reshape(off.shape)] = 0.0
    thick = lattice.radii[grazing].mean(axis=1)
    height = np.clip(off / thick[:, None], 0.0, 1.0)
    section = ((np.arccos(height) - height * np.sqrt(1.0 - height**2)) / np.pi).mean(axis=1)
    kept = section > _LEAST_SECTION
    added, share = grazing[kept], np.sqrt(section[kept])
    if not len(added):
        return clipped
    frame = clipped.wireframe
    count = len(frame.nodes)
    struts = frame.struts.astype(np.int64)
    # Rows of the whole lattice's nodes among the clipped ones, as far as they are there.
    row = np.full(len(lattice.nodes), -1, np.int64)
    for side, whole in ((0, clipped.low == 0.0), (1, clipped.high == 1.0)):
        row[lattice.struts[clipped.owner[whole], side]] = struts[whole, side]
    ends = lattice.struts[added].astype(np.int64)
    new = np.unique(ends[row[ends] < 0])
    row[new] = count + np.arange(len(new))
    is_new = np.zeros(len(lattice.nodes), bool)
    is_new[new] = True
    low, high = clipped.low.copy(), clipped.high.copy()
    radii = frame.radii.copy()
    for side, node, is_end in _find_lost_ends(clipped, lattice):
        at = frame.nodes[struts[:, side]]
        away = np.linalg.norm(lattice.nodes[node] - at, axis=1)
        onto = is_end & is_new[node] & (away < 2.0 * radii[:, side])
        struts[onto, side] = row[node[onto]]
        (low if side == 0 else high)[onto] = float(side)
    joined = Wireframe(
        np.concatenate([frame.nodes, lattice.nodes[new]]),
        np.concatenate([struts, row[ends]]).astype(np.int32),
        np.concatenate([radii, share[:, None] * lattice.radii[added]]),
        np.concatenate([frame.joint_radii, lattice.joint_radii[new]]),
    )
    number = len(added)
    return _drop_unused(
        Clipped(
            joined,
            np.concatenate([clipped.on_boundary, np.ones(len(new), bool)]),
            np.concatenate([clipped.owner, added]),
            np.concatenate([low, np.zeros(number)]),
            np.concatenate([high, np.ones(number)]),
            clipped.warnings,
        )
    )


def drawn_together(clipped: Clipped, lattice: Wireframe) -> Clipped:
    """A clipped lattice whose struts meet where the wall has taken their node away.

    Ends that overlap beside one another become one node, midway between them.

    Args:
        clipped: the axes inside the wall.
        lattice: all the struts, mm.
    """
    frame = clipped.wireframe
    struts = frame.struts.astype(np.int64)
    found = [
        np.stack([struts[is_end, side], node[is_end]], axis=1)
        for side, node, is_end in _find_lost_ends(clipped, lattice)
    ]
    end, lost = np.concatenate(found).T
    order = np.argsort(lost, kind="stable")
    end, lost = end[order], lost[order]
    _, first, number = np.unique(lost, return_index=True, return_counts=True)
    # All pairs of ends of one node.
    one, place = spread(np.repeat(first + number, number) - np.arange(len(end)) - 1)
    two = one + 1 + place
    gap = np.linalg.norm(frame.nodes[end[one]] - frame.nodes[end[two]], axis=1)
    reach = frame.joint_radii[end]
    near = gap < reach[one] + reach[two]
    pairs = np.stack([end[one[near]], end[two[near]]], axis=1)
    return _weld(clipped, pairs)


def tied(clipped: Clipped) -> Clipped:
    """A clipped lattice whose groups of struts that touch are tied where they do."""
    frame = clipped.wireframe
    group = groups_of(frame)
    start, end = frame.nodes[frame.struts].swapaxes(0, 1)
    thickest = frame.radii.max(axis=1)
    pairs, places, gap = find_touching(start, end, thickest, group[frame.struts[:, 0]])
    if not len(pairs):
        return clipped
    length = np.linalg.norm(np.diff(frame.nodes[frame.struts], axis=1)[:, 0], axis=1)
    radius = frame.radii.mean(axis=1)
    # Near a strut's end the tie is at its node: no piece is shorter than a beam may be.
    room = SHORTEST_PIECE * radius[pairs] / length[pairs]
    places = np.where(places < room, 0.0, np.where(places > 1.0 - room, 1.0, places))
    split, rows = _split(clipped, pairs.ravel(), places.ravel())
    rows = rows.reshape(-1, 2)
    rows = np.sort(rows[rows[:, 0] != rows[:, 1]], axis=1)
    rows = np.unique(rows, axis=0)
    frame = split.wireframe
    thick = frame.joint_radii[rows].min(axis=1)
    gap = np.linalg.norm(frame.nodes[rows[:, 1]] - frame.nodes[rows[:, 0]], axis=1)
    apart = gap > _MEETS * thick
    owner, share = _places_of(split)
    between = rows[apart]
    joined = Wireframe(
        frame.nodes,
        np.concatenate([frame.struts, between.astype(np.int32)]),
        np.concatenate([frame.radii, np.repeat(thick[apart, None], 2, axis=1)]),
        frame.joint_radii,
    )
    more = Clipped(
        joined,
        split.on_boundary,
        np.concatenate([split.owner, owner[between[:, 0]]]),
        np.concatenate([split.low, share[between[:, 0]]]),
        np.concatenate([split.high, share[between[:, 0]]]),
        split.warnings,
    )
    return _weld(more, rows[~apart])


def groups_of(frame: Wireframe) -> Ints:
    """(n,) the group of each node; struts join the nodes of one group."""
    return pieces_of(frame.struts[:, 0], frame.struts[:, 1], len(frame.nodes))[1]


def find_touching(
    start: Floats, end: Floats, radius: Floats, group: Ints
) -> tuple[Ints, Floats, Floats]:
    """Pairs of struts of different groups whose material meets.

    Args:
        start: (m, 3) of their axes, mm.
        end: (m, 3).
        radius: (m,) mm.
        group: (m,) of each.

    Returns:
        (p, 2) struts; (p, 2) where on them their axes are nearest, as shares of their lengths;
        (p,) how near, mm.
    """
    from scipy.spatial import cKDTree  # slow to import

    length = np.linalg.norm(end - start, axis=1)
    # Every strut as points no farther apart than its radius; those of all but the largest group
    # look for others near them.
    asks = group != np.bincount(group, length).argmax()
    reach = 3.0 * float(radius.max())
    some = np.flatnonzero(about(0.5 * (start + end), asks, float(length.max()) + reach))
    samples = np.ceil(length[some] / radius[some]).astype(np.int64) + 1
    row, place = spread(samples)
    share, strut = place / np.maximum(samples[row] - 1, 1), some[row]
    points = start[strut] + share[:, None] * (end[strut] - start[strut])
    asking = np.flatnonzero(asks[strut])
    near = cKDTree(points).query_ball_point(points[asking], reach, return_sorted=False)
    found = np.fromiter((len(each) for each in near), np.int64, len(near))
    other = strut[np.concatenate([*near, np.empty(0)]).astype(np.int64)]
    pairs = np.stack([np.repeat(strut[asking], found), other], axis=1)
    pairs = np.unique(np.sort(pairs[group[pairs[:, 0]] != group[pairs[:, 1]]], axis=1), axis=0)
    a, b = pairs.T
    places, gap = _nearest_places(start[a], end[a], start[b], end[b])
    touch = gap < radius[a] + radius[b]
    return pairs[touch], places[touch], gap[touch]


def about(points: Floats, asks: Bools, reach: float) -> Bools:
    """(n,) which of (n, 3) points may be as near as the reach, mm, to one that asks; and those."""
    low = points.min(axis=0)
    span = points.max(axis=0) - low
    size = max(reach, float(span.max()) / MOST_BINS, 1e-300)
    cell = ((points - low) / size).astype(np.int64)
    shape = (span / size).astype(np.int64) + 3
    middle = np.ravel_multi_index((1, 1, 1), tuple(shape))
    flat = np.ravel_multi_index(tuple(cell.T + 1), tuple(shape))
    asked = np.unique(flat[asks])
    near = np.zeros(int(shape.prod()), bool)
    for step in np.ndindex(3, 3, 3):
        near[asked + np.ravel_multi_index(step, tuple(shape)) - middle] = True
    return np.asarray(near[flat])


def _nearest_places(a: Floats, b: Floats, c: Floats, d: Floats) -> tuple[Floats, Floats]:
    """Where the segments a-b and c-d are nearest, (n, 2) shares of them, and (n,) how near
    (Ericson, Real-Time Collision Detection, section 5.1.9).
    """
    u, v, w = b - a, d - c, a - c
    uu, vv, uv = (np.einsum("ij,ij->i", *pair) for pair in ((u, u), (v, v), (u, v)))
    uw, vw = np.einsum("ij,ij->i", u, w), np.einsum("ij,ij->i", v, w)
    tiny = 1e-300
    det = uu * vv - uv * uv
    parallel = det <= 1e-12 * uu * vv
    s = np.where(parallel, 0.0, np.clip((uv * vw - vv * uw) / np.where(parallel, 1.0, det), 0, 1))
    t = np.clip((uv * s + vw) / np.maximum(vv, tiny), 0.0, 1.0)
    s = np.clip((uv * t - uw) / np.maximum(uu, tiny), 0.0, 1.0)
    gap = np.linalg.norm(w + s[:, None] * u - t[:, None] * v, axis=1)
    return np.stack([s, t], axis=1), np.asarray(gap)


def _find_lost_ends(clipped: Clipped, lattice: Wireframe) -> tuple[tuple[int, Ints, Bools], ...]:
    """For both sides: the whole strut's node there (m,), and which pieces end on the way to it."""
    owner = clipped.owner
    order = np.lexsort((clipped.low, owner))
    sorted_owner = owner[order]
    first, last = np.zeros(len(owner), bool), np.zeros(len(owner), bool)
    first[order] = np.diff(sorted_owner, prepend=-1) != 0
    last[order] = np.diff(sorted_owner, append=-1) != 0
    nodes = lattice.struts[owner].astype(np.int64)
    return (
        (0, nodes[:, 0], first & (clipped.low > 0.0)),
        (1, nodes[:, 1], last & (clipped.high < 1.0)),
    )


def _weld(clipped: Clipped, pairs: Ints) -> Clipped:
    """Nodes (p, 2) made one, in the middle of all that become one; no strut joins it to itself."""
    if not len(pairs):
        return clipped
    frame = clipped.wireframe
    row = pieces_of(pairs[:, 0], pairs[:, 1], len(frame.nodes))[1]
    number = np.bincount(row)
    nodes = np.stack([np.bincount(row, column) for column in frame.nodes.T], axis=1)
    joints, at_boundary = np.zeros(len(number)), np.zeros(len(number), bool)
    np.maximum.at(joints, row, frame.joint_radii)
    np.logical_or.at(at_boundary, row, clipped.on_boundary)
    struts = row[frame.struts]
    kept = struts[:, 0] != struts[:, 1]
    made = Wireframe(
        nodes / number[:, None], struts[kept].astype(np.int32), frame.radii[kept], joints
    )
    return _drop_unused(
        Clipped(
            made, at_boundary, clipped.owner[kept], clipped.low[kept], clipped.high[kept],
            clipped.warnings,
        )
    )  # fmt: skip


def _split(clipped: Clipped, strut: Ints, share: Floats) -> tuple[Clipped, Ints]:
    """A node at each of (p,) places, shares of struts; and (p,) the nodes."""
    frame = clipped.wireframe
    count = len(frame.struts)
    inner = (share > 0.0) & (share < 1.0)
    cuts, of = np.unique(
        np.stack([strut[inner], np.round(share[inner], 9)], axis=1), axis=0, return_inverse=True
    )
    cut_strut, cut_share = cuts[:, 0].astype(np.int64), cuts[:, 1]
    new = len(frame.nodes) + np.arange(len(cuts))
    rows = np.where(share <= 0.0, frame.struts[strut, 0], frame.struts[strut, 1]).astype(np.int64)
    rows[inner] = new[of.ravel()]
    ends, radii = frame.nodes[frame.struts[cut_strut]], frame.radii[cut_strut]
    nodes = ends[:, 0] + cut_share[:, None] * (ends[:, 1] - ends[:, 0])
    thick = radii[:, 0] + cut_share * (radii[:, 1] - radii[:, 0])
    # Along each strut: its first node, its cuts, its last one.
    every = np.arange(count)
    owner = np.concatenate([every, cut_strut, every])
    place = np.concatenate([np.zeros(count), cut_share, np.ones(count)])
    node = np.concatenate([frame.struts[:, 0], new, frame.struts[:, 1]]).astype(np.int64)
    order = np.lexsort((place, owner))
    owner, place, node = owner[order], place[order], node[order]
    begins = np.flatnonzero(owner[1:] == owner[:-1])
    piece, low, high = owner[begins], place[begins], place[begins + 1]
    wide, span = frame.radii[piece], clipped.high[piece] - clipped.low[piece]
    grown = wide[:, 1] - wide[:, 0]
    made = Wireframe(
        np.concatenate([frame.nodes, nodes]),
        np.stack([node[begins], node[begins + 1]], axis=1).astype(np.int32),
        np.stack([wide[:, 0] + low * grown, wide[:, 0] + high * grown], axis=1),
        np.concatenate([frame.joint_radii, thick]),
    )
    start = clipped.low[piece]
    return (
        Clipped(
            made,
            np.concatenate([clipped.on_boundary, np.zeros(len(cuts), bool)]),
            clipped.owner[piece],
            start + low * span,
            start + high * span,
            clipped.warnings,
        ),
        rows,
    )


def _places_of(clipped: Clipped) -> tuple[Ints, Floats]:
    """(n,) a strut of the whole lattice that each node lies on, and where on it."""
    frame = clipped.wireframe
    owner = np.zeros(len(frame.nodes), np.int64)
    share = np.zeros(len(frame.nodes))
    for side, place in ((0, clipped.low), (1, clipped.high)):
        owner[frame.struts[:, side]] = clipped.owner
        share[frame.struts[:, side]] = place
    return owner, share


def _drop_unused(clipped: Clipped) -> Clipped:
    """Without the nodes of no strut."""
    frame = clipped.wireframe
    used, rows = np.unique(frame.struts, return_inverse=True)
    made = Wireframe(
        frame.nodes[used], rows.reshape(-1, 2).astype(np.int32), frame.radii,
        frame.joint_radii[used],
    )  # fmt: skip
    return replace(clipped, wireframe=made, on_boundary=clipped.on_boundary[used])

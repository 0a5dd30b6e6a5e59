# SPDX-License-Identifier: LGPL-2.1-or-later
"""The volume of tapered struts and joint spheres in a domain, what overlaps once, by node radii.

Space is divided among the axes: every point belongs to the nearest one, whatever the radii. On a
ray that leaves an axis at a right angle, what belongs to the axis is a stretch of the ray that
begins at the axis, and so is what its own strut and the joint's sphere cover; another strut covers
a stretch whose ends are roots of a quadratic, and the domain's wall cuts it where it cuts it. So
the volume is a sum over rays of half the difference of squares of such ends: it is smooth in the
radii, its derivative is in closed form, and the rays are laid once. Where nothing but a strut
itself can cover its ray, the cone's own volume stands in for it. Behind a node, where it is nearer
than all axes, rays leave the node.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_matrix
from scipy.spatial import cKDTree

from ..design.cells import joint_radius
from ..graphs.clearance import segment_distances
from ..grid.strut_graph import Graph
from ..mesh.triangle_mesh import TriangleMesh
from ..spatial.rays import inside_points, segment_crossings
from ..util.linalg import axes_across
from ..util.progress import Monitor
from ..util.ragged import spread
from ..util.types import Bools, Floats, Ints

#: Rays of a whole lattice's struts, and of each at least and at most; the same behind its nodes.
_RAYS, _OF_STRUT = 100_000, (24, 256)
_DIRECTIONS, _OF_NODE = 200_000, (64, 1024)
#: Other struts that are looked at on a ray: those that come nearest to it.
_OTHERS = 8
#: Radii stay exact beyond their bounds by these factors.
_BELOW, _ABOVE = 0.7, 1.15
#: Pairs of a ray and a strut that are looked at together.
_CHUNK = 1_500_000
_GOLDEN = 0.5 * (np.sqrt(5.0) - 1.0)


@dataclass(frozen=True, eq=False)
class _Rays:
    """Stretches of rays that something besides their own strut may cover, or that a wall cuts.

    Attributes:
        weight: (s,) mm, what half a square of a length on it stands for.
        strut, node: (s,) whose it is, and the nearer of its two nodes.
        share, away: (s,) place on the strut's axis, 0 at its first node; mm from `node`.
        low, high: (s,) mm, where the stretch begins and ends.
        other: (s, k) other struts that may cover some of it, those that there are first; -1.
        begin, speed: (s, k) place on the other axis, mm from its first node: begin + speed x.
        square, twice, curve: (s, k) its distance squared: square + 2 twice x + curve x2.
        first, last: (s, k) mm, between which places on the ray lie beside the other strut.
    """

    weight: Floats
    strut: Ints
    node: Ints
    share: Floats
    away: Floats
    low: Floats
    high: Floats
    other: Ints
    begin: Floats
    speed: Floats
    square: Floats
    twice: Floats
    curve: Floats
    first: Floats
    last: Floats


@dataclass(frozen=True, eq=False)
class UnionVolume:
    """What struts and joints fill, as a function of the radii at the nodes.

    Attributes:
        struts: (m, 2) nodes.
        length: (m,) mm.
        cell_size: L, by which joints are larger than struts, mm.
        constant: mm3 that is filled whatever the radii.
        cones: (m, 3) factors of r1 r1, r1 r2, r2 r2.
        balls: (n,) factors of the joint spheres' radii cubed.
        rays: the rest, from axes.
        caps: weight, node, low and high of the stretches of rays from nodes that a wall cuts.
    """

    struts: Ints
    length: Floats
    cell_size: float
    constant: float
    cones: Floats
    balls: Floats
    rays: tuple[_Rays, ...]
    caps: tuple[Floats, Ints, Floats, Floats]

    def at(self, radii: Floats) -> float:
        """mm3, at radii (n,) mm of the nodes."""
        one, two = radii[self.struts].T
        joint = joint_radius(radii, self.cell_size)
        total = self.constant + float((self.cones * _squares(one, two)).sum())
        total += float(self.balls @ joint**3)
        for rays in self.rays:
            total += float(self._covered(rays, radii, joint, None))
        weight, node, low, high = self.caps
        reach = np.clip(joint[node], low, high)
        return total + float((weight * (reach**3 - low**3)).sum())

    def change(self, radii: Floats) -> Floats:
        """(n,) mm2, the derivative to each radius."""
        one, two = radii[self.struts].T
        joint, count = joint_radius(radii, self.cell_size), len(radii)
        growth = 1.0 + 2.0 * radii / self.cell_size
        by_ball = 3.0 * self.balls * joint**2
        weight, node, low, high = self.caps
        moves = (joint[node] > low) & (joint[node] < high)
        by_ball += np.bincount(node, 3.0 * weight * joint[node] ** 2 * moves, count)
        by_end = np.empty((len(self.struts), 2))
        by_end[:, 0] = 2.0 * self.cones[:, 0] * one + self.cones[:, 1] * two
        by_end[:, 1] = 2.0 * self.cones[:, 2] * two + self.cones[:, 1] * one
        for rays in self.rays:
            self._covered(rays, radii, joint, (by_end, by_ball))
        result = by_ball * growth
        for side in (0, 1):
            result += np.bincount(self.struts[:, side], by_end[:, side], count)
        return np.asarray(result)

    def _covered(
        self, rays: _Rays, radii: Floats, joint: Floats, changes: tuple[Floats, Floats] | None
    ) -> float:
        """What is covered of rays; adds to the changes to struts' ends and to joints' radii."""
        own, ball, reach = self._base(rays, radii, joint)
        open_to_others = reach < rays.high
        total = 0.0
        if rays.other.shape[1] and not open_to_others.all():
            full = ~open_to_others
            total = float(0.5 * rays.weight[full] @ (rays.high[full] ** 2 - rays.low[full] ** 2))
            rays = _taken(rays, np.flatnonzero(open_to_others))
            own, ball, reach = own[open_to_others], ball[open_to_others], reach[open_to_others]
        low, high = rays.low, rays.high
        area = 0.5 * (np.clip(reach, low, high) ** 2 - low**2)
        # How often half the square of each end counts: the own strut's, the ball's, the others'.
        counts = (reach > low) & (reach < high)
        of_base = counts.astype(float)
        width = rays.other.shape[1]
        of_start = np.zeros((len(own), width))
        of_end = np.zeros((len(own), width))
        if width:
            start, end, steady = self._stretches(rays, radii)
            order = np.argsort(start, axis=1)
            covered, last = reach, np.full(len(own), -1)
            every = np.arange(len(own))
            for place in range(width):
                k = order[:, place]
                begins, ends = start[every, k], np.minimum(end[every, k], high)
                fixed = steady[every, k]
                begin = np.maximum(np.maximum(begins, covered), low)
                more = ends > begin
                area[more] += 0.5 * (ends[more] ** 2 - begin[more] ** 2)
                if changes is not None:
                    by_end = more & (ends < high) & ~fixed[:, 1]
                    of_end[every[by_end], k[by_end]] += 1.0
                    by_start = more & (begin == begins) & (begins > covered) & ~fixed[:, 0]
                    of_start[every[by_start], k[by_start]] -= 1.0
                    before = more & (begin == covered) & (covered > low)
                    base = before & (last < 0)
                    of_base[base] -= 1.0
                    other = before & (last >= 0)
                    same = other & ~steady[every, np.maximum(last, 0), 1]
                    of_end[every[same], last[same]] -= 1.0
                grows = end[every, k] > covered
                last = np.where(grows, k, last)
                covered = np.maximum(covered, end[every, k])
        if changes is not None:
            by_strut, by_ball = changes
            bare = own >= ball
            gradient = rays.weight * of_base * bare * own
            count = len(self.struts)
            by_strut[:, 0] += np.bincount(rays.strut, gradient * (1.0 - rays.share), count)
            by_strut[:, 1] += np.bincount(rays.strut, gradient * rays.share, count)
            gradient = rays.weight * of_base * ~bare * joint[rays.node]
            by_ball += np.bincount(rays.node, gradient, len(by_ball))
            for counted, at in ((of_start, 0), (of_end, 1)) if width else ():
                row, k = np.nonzero(counted)
                self._moved_ends(rays, radii, row, k, at, counted[row, k], by_strut)
        return total + float(rays.weight @ area)

    def _base(self, rays: _Rays, radii: Floats, joint: Floats) -> tuple[Floats, Floats, Floats]:
        """(s,) how far the own strut reaches on rays, how far the joint's sphere, and either."""
        first, second = radii[self.struts[rays.strut]].T
        own = (1.0 - rays.share) * first + rays.share * second
        ball = np.sqrt(np.maximum(joint[rays.node] ** 2 - rays.away**2, 0.0))
        return own, ball, np.maximum(own, ball)

    def _stretches(self, rays: _Rays, radii: Floats) -> tuple[Floats, Floats, Bools]:
        """(s, k) where the other struts begin and end to cover rays; which ends no radius moves."""
        base, rate = self._width(rays, radii)
        curve = rays.curve - rate**2
        half = rays.twice - base * rate
        rest = rays.square - base**2
        left = half**2 - curve * rest
        root = np.sqrt(np.maximum(left, 0.0))
        stable = -(half + np.copysign(root, half))
        with np.errstate(divide="ignore", invalid="ignore"):
            one, two = stable / curve, rest / stable
        one = np.where(np.isfinite(one), one, np.inf)
        two = np.where(np.isfinite(two), two, 0.0)
        near, far = np.minimum(one, two), np.maximum(one, two)
        # A ray steeper than the cone enters it once: the other root is on the cone's far half.
        steep, grows = curve < 0.0, rate > 0.0
        start = np.where(steep, np.where(grows, far, -np.inf), near)
        end = np.where(steep, np.where(grows, np.inf, near), far)
        missed = left <= 0.0
        start = np.where(missed, np.where(steep, -np.inf, np.inf), start)
        end = np.where(missed, np.where(steep, np.inf, -np.inf), end)
        steady = np.stack([start <= rays.first, end >= rays.last], axis=2)
        start, end = np.maximum(start, rays.first), np.minimum(end, rays.last)
        nothing = (rays.other < 0) | (end <= start)
        return np.where(nothing, np.inf, start), np.where(nothing, -np.inf, end), steady

    def _width(self, rays: _Rays, radii: Floats) -> tuple[Floats, Floats]:
        """(s, k) the other struts' radii beside a ray's beginning, and how they grow along it."""
        other = np.maximum(rays.other, 0)
        one, two = np.moveaxis(radii[self.struts[other]], -1, 0)
        taper = (two - one) / self.length[other]
        return one + taper * rays.begin, taper * rays.speed

    def _moved_ends(
        self, rays: _Rays, radii: Floats, row: Ints, k: Ints, side: int, counted: Floats,
        by_strut: Floats,
    ) -> None:  # fmt: skip
        """Add what half the squares of ends on other struts change with these struts' radii."""
        some = _taken(rays, row, k[:, None])
        stretch = self._stretches(some, radii)[side][:, 0]
        base, rate = (values[:, 0] for values in self._width(some, radii))
        width = base + rate * stretch
        share = (some.begin[:, 0] + some.speed[:, 0] * stretch) / self.length[some.other[:, 0]]
        fall = (some.curve[:, 0] - rate**2) * stretch + some.twice[:, 0] - base * rate
        gradient = counted * some.weight * stretch * width / fall
        count = len(self.struts)
        by_strut[:, 0] += np.bincount(some.other[:, 0], gradient * (1.0 - share), count)
        by_strut[:, 1] += np.bincount(some.other[:, 0], gradient * share, count)


def _squares(one: Floats, two: Floats) -> Floats:
    return np.stack([one * one, one * two, two * two], axis=1)


def _taken(rays: _Rays, row: Ints, k: Ints | None = None) -> _Rays:
    """Some rows of rays, with all other struts, or with those of the columns (rows, 1)."""
    single = {name: getattr(rays, name)[row] for name in _OF_RAY}
    others = {name: getattr(rays, name)[row] for name in _OF_OTHER}
    if k is not None:
        others = {name: np.take_along_axis(values, k, 1) for name, values in others.items()}
    return _Rays(**single, **others)


_OF_RAY = ("weight", "strut", "node", "share", "away", "low", "high")
_OF_OTHER = ("other", "begin", "speed", "square", "twice", "curve", "first", "last")


def union_volume(
    graph: Graph, cell_size: float, low: Floats, high: Floats, domain: TriangleMesh | None = None
) -> UnionVolume:
    """Lay the rays of a lattice.

    Args:
        graph: its nodes and struts, whole, mm.
        cell_size: L, or of a network the median length of its struts: a joint's sphere has a
            radius of r (1 + r / L).
        low: (n,) mm, the least radius that a node may have.
        high: (n,) mm, the largest; between both, and a little beyond, the volume is right.
        domain: closed mesh; only what lies inside counts. None for everything.
    """
    nodes, struts = graph.nodes, graph.struts.astype(np.int64)
    low, high = _BELOW * low, _ABOVE * high
    laid = _Laying(nodes, struts, cell_size, low, high, domain)
    number = int(np.clip(_RAYS // max(len(struts), 1), *_OF_STRUT))
    constant, balance, parts = 0.0, np.zeros((len(struts), 3)), []
    step = max(1, _CHUNK // (number * laid.most_near))
    for begin in range(0, len(struts), step):
        some = np.arange(begin, min(begin + step, len(struts)))
        filled, taken, rays = laid.rays_of(some, number)
        constant += filled
        balance[some] = taken
        parts.append(rays)
    cones = np.pi / 3.0 * laid.length[:, None] * np.ones(3) - balance
    balls, caps = laid.behind_nodes()
    whole = _Rays(**{
        name: np.concatenate([getattr(part, name) for part in parts])
        for name in (*_OF_RAY, *_OF_OTHER)
    })  # fmt: skip
    return UnionVolume(
        struts, laid.length, cell_size, constant, cones, balls, tuple(_sorted(whole)), caps
    )


def _sorted(rays: _Rays) -> list[_Rays]:
    """The rays by how many other struts they may meet."""
    number = (rays.other >= 0).sum(axis=1)
    result = []
    for count in range(rays.other.shape[1] + 1):
        rows = np.flatnonzero(number == count)
        if len(rows):
            result.append(_Rays(
                **{name: getattr(rays, name)[rows] for name in _OF_RAY},
                **{name: getattr(rays, name)[rows, :count] for name in _OF_OTHER},
            ))  # fmt: skip
    return result


class _Laying:
    """What rays are laid in."""

    def __init__(
        self, nodes: Floats, struts: Ints, cell_size: float, low: Floats, high: Floats,
        domain: TriangleMesh | None,
    ) -> None:  # fmt: skip
        self.nodes, self.struts, self.domain = nodes, struts, domain
        self.start = nodes[struts[:, 0]]
        span = nodes[struts[:, 1]] - self.start
        self.length = np.linalg.norm(span, axis=1)
        self.along = span / self.length[:, None]
        self.low, self.high = low, high
        self.least_ball = joint_radius(low, cell_size)
        self.largest_ball = joint_radius(high, cell_size)
        self.reach = self.largest_ball[struts].max(axis=1)
        self.near_start, self.near = _near(self.start, span, self.length, struts, self.reach)
        self.most_near = int(np.diff(self.near_start).max(initial=1)) or 1
        self.random = np.random.default_rng(0)

    def rays_of(self, some: Ints, number: int) -> tuple[float, Floats, _Rays]:
        """The rays of some struts: what they fill for sure, what cones count of them, the rest.

        Returns:
            mm3; (some, 3) factors of the products of their radii; the stretches.
        """
        count = len(some)
        # A lattice of rank 1 on (along, round), turned at random for each strut. Not moved along
        # it: so the rays of a whole cone sum up to its volume, and nothing is left of it where
        # they stand in for it everywhere.
        step = np.arange(number)
        share = np.tile((step + 0.5) / number, count)
        angle = (2.0 * np.pi * (step * _GOLDEN + self.random.random((count, 1)))).ravel()
        strut = np.repeat(some, number)
        along = self.along[strut]
        one, two = axes_across(along)
        way = -(np.cos(angle)[:, None] * one + np.sin(angle)[:, None] * two)
        origin = self.start[strut] + (share * self.length[strut])[:, None] * along
        weight = 2.0 * np.pi * self.length[strut] / number
        node = np.where(share < 0.5, self.struts[strut, 0], self.struts[strut, 1])
        away = np.minimum(share, 1.0 - share) * self.length[strut]
        ends = self.struts[strut]
        least = (1.0 - share) * self.low[ends[:, 0]] + share * self.low[ends[:, 1]]
        ball = np.sqrt(np.maximum(self.least_ball[node] ** 2 - away**2, 0.0))
        sure = np.maximum(least, ball)
        own = (1.0 - share) * self.high[ends[:, 0]] + share * self.high[ends[:, 1]]
        by_ball = np.sqrt(np.maximum(self.largest_ball[node] ** 2 - away**2, 0.0))

        ray, other = self._pairs(strut)
        pairs = self._lines(origin, way, strut, ray, other)
        ray, other = ray[pairs.kept], other[pairs.kept]
        limit = np.full(len(strut), np.inf)
        np.minimum.at(limit, ray, pairs.nearer)
        # Beyond the largest radius near it nothing covers a ray.
        widest = np.maximum(own, by_ball)
        np.maximum.at(widest, ray, self.reach[other])
        limit = np.minimum(limit, widest)
        other_rows = self._nearest(ray, pairs, other, sure, limit, len(strut))
        met = other_rows[:, 0] >= 0

        inside, cut, stretch = self._in_domain(origin, way, limit)
        plain = inside & ~cut & ~met & (by_ball <= least) & (own <= limit)
        full = inside & ~cut & (sure >= limit)
        constant = float((weight[full] * 0.5 * limit[full] ** 2).sum())
        counted = ~plain
        parts = 0.5 * weight[:, None] * np.stack(
            [(1.0 - share) ** 2, 2.0 * share * (1.0 - share), share**2], axis=1
        )  # fmt: skip
        row = np.repeat(np.arange(count), number)[counted]
        taken: Floats = np.stack(
            [np.bincount(row, part[counted], count) for part in parts.T], axis=1
        ).astype(float)

        whole = np.flatnonzero(inside & ~cut & ~plain & ~full)
        of_cut, low, high = stretch
        rows = np.concatenate([whole, of_cut])
        low = np.concatenate([np.zeros(len(whole)), low])
        high = np.concatenate([limit[whole], high])
        chosen = other_rows[rows]
        at = np.maximum(chosen, 0)
        empty = chosen < 0

        def of(values: Floats, blank: float) -> Floats:
            if not len(values):
                return np.full(chosen.shape, blank)
            return np.where(empty, blank, values[at])

        others = np.where(empty, -1, other[at] if len(other) else -1)
        return constant, taken, _Rays(
            weight[rows], strut[rows], node[rows], share[rows], away[rows], low, high, others,
            of(pairs.begin, 0.0), of(pairs.speed, 0.0), of(pairs.square, 1.0),
            of(pairs.twice, 0.0), of(pairs.curve, 1.0), of(pairs.first, 0.0), of(pairs.last, 0.0),
        )  # fmt: skip

    def _pairs(self, strut: Ints) -> tuple[Ints, Ints]:
        """Rays, and the struts near their own."""
        begin = self.near_start[strut]
        ray, place = spread(self.near_start[strut + 1] - begin)
        return ray, self.near[begin[ray] + place]

    def _lines(self, origin: Floats, way: Floats, strut: Ints, ray: Ints, other: Ints) -> _Lines:
        """Other axes as seen from rays."""
        gap = origin[ray] - self.start[other]
        along, length = self.along[other], self.length[other]
        begin = np.einsum("ij,ij->i", gap, along)
        square = np.einsum("ij,ij->i", gap, gap)
        beside = np.clip(begin, 0.0, length)
        distance = np.sqrt(np.maximum(square - 2.0 * beside * begin + beside**2, 0.0))
        # Farther than that it neither covers the ray nor ends it before its largest radius.
        kept = distance < 2.0 * np.maximum(self.reach[strut[ray]], self.reach[other])
        ray, other, gap = ray[kept], other[kept], gap[kept]
        along, length, begin, square = along[kept], length[kept], begin[kept], square[kept]
        towards = way[ray]
        speed = np.einsum("ij,ij->i", towards, along)
        slope = np.einsum("ij,ij->i", towards, gap)
        with np.errstate(divide="ignore", invalid="ignore"):
            one, two = -begin / speed, (length - begin) / speed
        level = np.abs(speed) < 1e-12
        within = (begin >= 0.0) & (begin <= length)
        first = np.where(level, np.where(within, 0.0, np.inf), np.minimum(one, two))
        last = np.where(level, np.where(within, np.inf, -np.inf), np.maximum(one, two))
        # Where the other axis, or one of its ends, is as near as the ray's own.
        line = square - begin**2, slope - begin * speed, -(speed**2)
        nearer = _first_root(*line, first, last)
        far = square - 2.0 * begin * length + length**2, slope - length * speed
        for rest, half, is_first in ((square, slope, True), (*far, False)):
            with np.errstate(divide="ignore", invalid="ignore"):
                place = np.where(half < 0.0, -0.5 * rest / half, np.inf)
                beyond = begin + speed * place
            is_there = beyond <= 0.0 if is_first else beyond >= length
            nearer = np.minimum(nearer, np.where(is_there, place, np.inf))
        return _Lines(
            kept, begin, speed, line[0], line[1], 1.0 - speed**2, first, last,
            np.maximum(nearer, 0.0), square, slope,
        )  # fmt: skip

    def _nearest(
        self, ray: Ints, pairs: _Lines, other: Ints, sure: Floats, limit: Floats, count: int
    ) -> Ints:
        """(count, `_OTHERS`) rows of pairs that may cover something of their ray; -1 for none."""
        low, high = sure[ray], limit[ray]
        length = self.length[other]
        least = np.full(len(ray), np.inf)
        # A distance to a segment is convex along a ray: it is least where it is level, or at an end
        # of what is looked at.
        with np.errstate(divide="ignore", invalid="ignore"):
            level = np.where(pairs.curve > 0.0, -pairs.twice / pairs.curve, 0.0)
        for place in (low, high, level, -pairs.slope, length * pairs.speed - pairs.slope):
            x = np.clip(place, low, np.maximum(low, high))
            along = pairs.begin + pairs.speed * x
            beside = np.clip(along, 0.0, length)
            square = pairs.from_start + 2.0 * pairs.slope * x + x * x
            square += beside**2 - 2.0 * beside * along
            least = np.minimum(least, np.sqrt(np.maximum(square, 0.0)))
        spare = least - self.high[self.struts[other]].max(axis=1)
        able = np.flatnonzero((high > low) & (spare < 0.0))
        order = able[np.lexsort((spare[able], ray[able]))]
        result = np.full((count, _OTHERS), -1, np.int64)
        if len(order):
            own = ray[order]
            new = np.flatnonzero(np.append(True, own[1:] != own[:-1]))
            rank = np.arange(len(own)) - np.repeat(new, np.diff(np.append(new, len(own))))
            few = rank < _OTHERS
            result[own[few], rank[few]] = order[few]
        return result

    def _in_domain(
        self, origin: Floats, way: Floats, limit: Floats
    ) -> tuple[Bools, Bools, tuple[Ints, Floats, Floats]]:
        """Whether rays begin inside, whether a wall cuts them, and what is inside of those."""
        count = len(origin)
        none = np.zeros(0, np.int64), np.zeros(0), np.zeros(0)
        if self.domain is None:
            return np.ones(count, bool), np.zeros(count, bool), none
        inside = inside_points(self.domain, origin, Monitor())
        ray, place, leaves = segment_crossings(self.domain, origin, origin + limit[:, None] * way)
        place = place * limit[ray]
        cut = np.bincount(ray, minlength=count) > 0
        # Begins and ends by turns, from the ray's beginning where that lies inside.
        first = np.flatnonzero(cut & inside)
        owner = np.concatenate([ray, first, np.flatnonzero(cut)])
        at = np.concatenate([place, np.zeros(len(first)), limit[cut]])
        kind = np.concatenate([-leaves, np.ones(len(first)), np.zeros(int(cut.sum()))])
        order = np.lexsort((at, owner))
        owner, at, kind = owner[order], at[order], kind[order]
        depth = np.cumsum(kind)
        start = np.flatnonzero(np.append(True, owner[1:] != owner[:-1])) if len(owner) else none[0]
        before = np.concatenate([[0.0], depth])[start]
        size = np.diff(np.append(start, len(owner)))
        depth = depth - np.repeat(before, size)
        within = np.flatnonzero((depth[:-1] > 0.5) & (owner[1:] == owner[:-1]))
        return inside, cut, (owner[within], at[within], at[within + 1])

    def behind_nodes(self) -> tuple[Floats, tuple[Floats, Ints, Floats, Floats]]:
        """Factors of the cubes of joints' radii, and the stretches of what a wall cuts there."""
        count = len(self.nodes)
        number = int(np.clip(_DIRECTIONS // max(count, 1), *_OF_NODE))
        ends = self.struts.T.ravel()
        ways = np.concatenate([self.along, -self.along])
        order = np.argsort(ends, kind="stable")
        used, first = np.unique(ends[order], return_index=True)
        # Spirals from pole to pole, moved at random for each node.
        step = np.arange(number)
        moved = self.random.random((2, len(used), 1))
        height = 1.0 - 2.0 * (step + moved[0]) / number
        angle = 2.0 * np.pi * (_GOLDEN * step + moved[1])
        ring = np.sqrt(np.maximum(1.0 - height**2, 0.0))
        ball = np.stack([ring * np.cos(angle), ring * np.sin(angle), height], axis=2)
        row = np.repeat(np.arange(len(used)), np.diff(np.append(first, len(order))))
        behind = np.ones((len(used), number), bool)
        size = max(1, _CHUNK // number)
        for begin in range(0, len(order), size):
            some = slice(begin, begin + size)
            ahead = np.einsum("ikj,ij->ik", ball[row[some]], ways[order[some]]) > 0.0
            np.logical_and.at(behind, row[some], ~ahead)
        own, ray = np.nonzero(behind)
        node, each = used[own], 4.0 / 3.0 * np.pi / number
        limit = self.largest_ball[node]
        inside, cut, (of_cut, low, high) = self._in_domain(self.nodes[node], ball[own, ray], limit)
        balls = np.bincount(node[inside & ~cut], minlength=count) * each
        return balls, (np.full(len(of_cut), each), node[of_cut], low, high)


@dataclass(frozen=True, eq=False)
class _Lines:
    """Other axes as seen from rays: see `_Rays`; and where the ray comes as near to them."""

    kept: Bools
    begin: Floats
    speed: Floats
    square: Floats
    twice: Floats
    curve: Floats
    first: Floats
    last: Floats
    nearer: Floats
    from_start: Floats
    slope: Floats


def _first_root(rest: Floats, half: Floats, curve: Floats, low: Floats, high: Floats) -> Floats:
    """The first place above 0 and between two where rest + 2 half x + curve x2 is 0; else inf."""
    left = half**2 - curve * rest
    root = np.sqrt(np.maximum(left, 0.0))
    stable = -(half + np.copysign(root, half))
    with np.errstate(divide="ignore", invalid="ignore"):
        both = np.stack([stable / curve, rest / stable])
    low = np.maximum(low, 0.0)
    fits = (left >= 0.0) & np.isfinite(both) & (both >= low) & (both <= high)
    return np.asarray(np.where(fits, both, np.inf).min(axis=0))


def _near(
    start: Floats, span: Floats, length: Floats, struts: Ints, reach: Floats
) -> tuple[Ints, Ints]:
    """Each strut's row in (k,) the struts that may come near enough to overlap with it."""
    count = len(length)
    widest = float(reach.max())
    piece = max(float(np.median(length)), widest)
    number = np.maximum(np.ceil(length / piece).astype(np.int64), 1)
    owner, place = spread(number)
    middle = start[owner] + ((place + 0.5) / number[owner])[:, None] * span[owner]
    pairs = cKDTree(middle).query_pairs(piece + 2.0 * widest, output_type="ndarray")
    pairs = owner[pairs]
    pairs = pairs[pairs[:, 0] != pairs[:, 1]]
    pairs = np.unique(np.sort(pairs, axis=1), axis=0)
    one, two = pairs.T
    gap = segment_distances(start[one], start[one] + span[one], start[two], start[two] + span[two])
    pairs = pairs[gap < 2.0 * np.maximum(reach[one], reach[two])]
    both = np.concatenate([pairs, pairs[:, ::-1]])
    table = csr_matrix((np.ones(len(both), np.int8), (both[:, 0], both[:, 1])), (count, count))
    return table.indptr.astype(np.int64), table.indices.astype(np.int64)

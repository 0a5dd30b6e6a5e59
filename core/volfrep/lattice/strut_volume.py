# SPDX-License-Identifier: LGPL-2.1-or-later
"""The volume of a lattice in its domain at every strut radius, without a mesh.

A point is solid from the radius on at which the first strut or joint sphere reaches it. That
radius is found once for points spread evenly over the domain; the volume at any radius is then the
share of the points whose own radius is smaller, and the radius of a volume is read off the same
table. The points stand on upright lines that are cut exactly at the domain's surface.

This answers for all radii of a lattice at once, as a target asks; `sizing/union_volume` gives the
derivatives by every node's radius that a search of radii needs, and has no such table.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from ..grid.strut_graph import Wireframe
from ..mesh.triangle_mesh import TriangleMesh
from ..spatial.even_points import even_points
from ..spatial.winding import crossings
from ..util.progress import Monitor
from ..util.ragged import spread
from ..util.types import Floats

#: Points for a first guess and for the radius itself, as powers of two; a
#: sixteenth as many upright lines carry the points of a domain.
ROUGH, FINE = 15, 20
#: Marks along a strut, in cell sizes, by which the struts near a point are found; and how many of
#: the nearest marks are asked.
_MARKS = 0.06
_NEAREST = 2


@dataclass(frozen=True, eq=False)
class VolumeByRadius:
    """Volumes of a lattice over the radius of its struts.

    Attributes:
        radius: (n,) ascending, mm; none where no point is reached by any strut.
        volume: (n,) what is solid at each, mm3.
    """

    radius: Floats
    volume: Floats

    def at(self, radius: float) -> float:
        """The volume at a radius, mm3; 0 where no strut reaches a point."""
        if not len(self.radius):
            return 0.0
        return float(np.interp(radius, self.radius, self.volume, left=0.0))

    def points_in(self, volume: float) -> int:
        """How many points tell a volume, mm3."""
        return int(np.searchsorted(self.volume, volume))

    def radius_of(self, volume: float) -> float:
        """The radius of a volume, mm; the ends' for what lies beyond them.

        Raises:
            ValueError: no strut reaches a point.
        """
        return float(np.interp(volume, self.volume, self.radius))


def volume_by_radius(
    frame: Wireframe,
    radius: float,
    cell_size: float,
    points: Floats,
    weights: Floats,
    largest: float,
) -> VolumeByRadius:
    """The volumes of a lattice.

    Args:
        frame: its struts, made with one radius; where theirs differ from it, as of struts that
            are deformed with their cells, they are taken as in proportion to it.
        radius: that radius, mm.
        cell_size: L, mm.
        points: (n, 3), mm.
        weights: (n,) the volume that each stands for, mm3.
        largest: radius up to which volumes are wanted, mm: the smaller, the faster.
    """
    solid_from = _radii_reaching(frame, radius, cell_size, points, largest)
    known = np.flatnonzero(solid_from <= largest)
    order = known[np.argsort(solid_from[known])]
    steps = np.cumsum(weights[order])
    return VolumeByRadius(solid_from[order], steps - 0.5 * weights[order])


def points_inside(
    domain: TriangleMesh, points_log2: int, monitor: Monitor
) -> tuple[Floats, Floats]:
    """About 2^k (n, 3) points spread evenly over a domain, and (n,) the volume each stands for."""
    low, high = domain.bounds
    lines = even_points(2, points_log2 - 4) * (high - low)[:2] + low[:2]
    corners = domain.vertices[domain.triangles]
    line, _, height, leaves = monitor.call(lambda: crossings(corners, lines))
    order = np.lexsort((height, line))
    line, height, step = line[order], height[order], -leaves[order]
    # A closed mesh's lines end outside, so that the windings of all of them make one sum.
    winding = np.cumsum(step)
    inside = np.flatnonzero((winding > 0)[:-1] & (line[1:] == line[:-1]))
    start, length = height[inside], height[inside + 1] - height[inside]
    ends = np.cumsum(length)
    count = 2**points_log2
    # One in each pitch of all the lines laid end to end, anywhere in it.
    along = (np.arange(count) + np.random.default_rng(1).random(count)) * (ends[-1] / count)
    owner = np.minimum(np.searchsorted(ends, along, "right"), len(ends) - 1)
    points = np.empty((count, 3))
    points[:, :2] = lines[line[inside[owner]]]
    points[:, 2] = start[owner] + along - (ends[owner] - length[owner])
    return points, np.full(count, domain.volume / count)


def points_about(frame: Wireframe, reach: float, points_log2: int) -> tuple[Floats, Floats]:
    """Points of the box about all struts and `reach` mm beyond, as `points_inside`."""
    low, high = frame.nodes.min(axis=0) - reach, frame.nodes.max(axis=0) + reach
    points = low + even_points(3, points_log2) * (high - low)
    return points, np.full(len(points), float(np.prod(high - low)) / len(points))


def _radii_reaching(
    frame: Wireframe, radius: float, cell_size: float, points: Floats, largest: float
) -> Floats:
    """(n,) the strut radius from which on points are solid, mm; at most the largest is sure."""
    start, end = frame.nodes[frame.struts[:, 0]], frame.nodes[frame.struts[:, 1]]
    span = end - start
    length = np.linalg.norm(span, axis=1)
    number = np.maximum(np.ceil(length / (_MARKS * cell_size)).astype(np.int64), 2)
    strut, place = spread(number)
    marks = start[strut] + ((place + 0.5) / number[strut])[:, None] * span[strut]
    width = frame.radii.mean(axis=1) / radius
    joint = frame.joint_radii / (radius + radius**2 / cell_size)
    widest = max(float(width.max()), float(joint.max())) * (largest + largest**2 / cell_size)
    bound = float(np.hypot(widest, _MARKS * cell_size)) * (1.0 + 1e-6)
    away, mark = cKDTree(marks).query(points, k=_NEAREST, distance_upper_bound=bound)
    everywhere = np.full(len(points), np.inf)
    met = np.flatnonzero(np.isfinite(away[:, 0]))
    points, mark = points[met], mark[met]
    mark = np.where(mark == len(marks), mark[:, :1], mark)
    result = np.full(len(points), np.inf)
    for k in range(_NEAREST):
        near = strut[mark[:, k]]
        offset = points - start[near]
        share = np.einsum("ij,ij->i", offset, span[near]) / length[near] ** 2
        beside = share.clip(0.0, 1.0)
        away = np.linalg.norm(offset - beside[:, None] * span[near], axis=1)
        away /= width[near]
        away[(share < 0.0) | (share > 1.0)] = np.inf  # a cylinder ends flat, within the sphere
        np.minimum(result, away, out=result)
        for side in range(2):
            node = frame.struts[near, side]
            gap = np.linalg.norm(points - frame.nodes[node], axis=1) / joint[node]
            # Of r + r2 / L = gap.
            sphere = cell_size * (np.sqrt(0.25 + gap / cell_size) - 0.5)
            np.minimum(result, sphere, out=result)
    everywhere[met] = result
    return everywhere

# SPDX-License-Identifier: LGPL-2.1-or-later
"""The exact block of whole cells, by its own plain formulas: what the engine is measured against.

Space is cut into cubes of edge L about the corners of the cells. What lies in such a cube
depends only on which of the eight cells around its corner are there, so a block of any size is
a few kinds of cubes. Struts are capsules of radius r, joints are balls of radius r (1 + r / L),
as long as those balls stay below L / 2.
"""

from __future__ import annotations

import itertools
import math

import numpy as np

from volfrep.design.cells import UnitCell
from volfrep.mesh.triangle_mesh import TriangleMesh

Floats = np.ndarray
Sides = tuple[tuple[bool, bool], ...]  # for each axis: is there a cell below, is there one above


def surroundings(cell: UnitCell, size: float, sides: Sides) -> Floats:
    """(k, 2, 3) struts of the cells around a corner at the origin, each once."""
    seen: dict[frozenset[tuple[float, ...]], Floats] = {}
    choices = [[at for at, there in zip((-1, 0), pair, strict=True) if there] for pair in sides]
    for offset in itertools.product(*choices):
        for ends in (cell.nodes + np.array(offset))[cell.struts]:
            seen[frozenset(tuple(np.round(end, 6).tolist()) for end in ends)] = ends * size
    return np.array(list(seen.values()))


def distances(points: Floats, struts: Floats, radius: float, joint_radius: float) -> Floats:
    """Signed distance to the union (negative inside; inside it is at most the true one)."""
    nearest = np.full(len(points), np.inf)
    for start, end in struts:
        along = end - start
        share = np.clip((points - start) @ along / (along @ along), 0.0, 1.0)
        offset = points - start - share[:, None] * along
        np.minimum(nearest, np.sqrt((offset**2).sum(axis=1)) - radius, out=nearest)
    for node in np.unique(np.round(struts.reshape(-1, 3), 9), axis=0):
        offset = points - node
        np.minimum(nearest, np.sqrt((offset**2).sum(axis=1)) - joint_radius, out=nearest)
    return nearest


def near(struts: Floats, low: Floats, high: Floats, reach: float) -> Floats:
    """The struts whose boxes come within `reach` of the box from `low` to `high`."""
    below = struts.min(axis=1) - reach < high
    above = struts.max(axis=1) + reach > low
    return struts[(below & above).all(axis=1)]


def block_distances(
    points: Floats, cell: UnitCell, count: tuple[int, int, int], size: float, radius: float
) -> Floats:
    """Signed distance of points (block's corner at the origin) to the exact block."""
    joint = radius * (1 + radius / size)
    corner = np.clip(np.round(points / size), 0, count).astype(int)
    below, above = corner > 0, corner < np.array(count)
    kind = (below * 2 + above) @ np.array([16, 4, 1])
    result = np.empty(len(points))
    for value in np.unique(kind):
        rows = np.flatnonzero(kind == value)
        first = rows[0]
        sides = tuple(zip(below[first].tolist(), above[first].tolist(), strict=True))
        struts = surroundings(cell, size, sides)
        local = points[rows] - corner[rows] * size
        # Octant by octant, so that only the struts near it have to be tried.
        octant = (local > 0) @ np.array([4, 2, 1])
        for number in np.unique(octant):
            chosen = np.flatnonzero(octant == number)
            box = local[chosen]
            few = near(struts, box.min(axis=0), box.max(axis=0), size / 2)
            result[rows[chosen]] = distances(box, few, radius, joint)
    return result


def block_volume(
    cell: UnitCell, count: int, size: float, radius: float, samples: int = 64
) -> float:
    """Volume of a block of count x count x count cells of a cell with cubic symmetry, in mm3.

    A midpoint sum of a smooth step across the surface (wide enough not to alias with the grid,
    its second moment zero, so that a curved surface gets its right volume): good to 0.02 %.
    """
    axis = np.arange(samples)
    boxes = np.stack(np.meshgrid(axis, axis, axis, indexing="ij"), axis=-1).reshape(-1, 3)
    joint, step = radius * (1 + radius / size), size / (2 * samples)
    volume = 0.0
    for free in range(4):  # axes along which the corner lies on the outside of the block
        sides: Sides = ((False, True),) * free + ((True, True),) * (3 - free)
        struts = surroundings(cell, size, sides)
        corners = math.comb(3, free) * 2**free * (count - 1) ** (3 - free)
        for outside in range(free + 1):  # axes along which the octant looks outwards
            sign = np.array([-1.0] * outside + [1.0] * (3 - outside))
            points = (boxes + 0.5) * (sign * step)
            few = near(struts, points.min(axis=0), points.max(axis=0), joint)
            if not len(few):
                continue
            t = np.clip(distances(points, few, radius, joint) / (4 * step), -1.0, 1.0)
            filled = 0.5 - 9 / 8 * (t - 5 / 9 * t**3)
            octants = math.comb(free, outside) * 2 ** (3 - free)
            volume += corners * octants * float(filled.sum()) * step**3
    return volume


def sample_surface(mesh: TriangleMesh, count: int) -> Floats:
    """(count, 3) random points spread evenly over the mesh's area."""
    generator = np.random.default_rng(20250102)
    a, b, c = mesh.corners()
    areas = np.linalg.norm(np.cross(b - a, c - a), axis=1).cumsum()
    chosen = np.searchsorted(areas, generator.random(count) * areas[-1])
    u, v = generator.random((2, count, 1))
    root = np.sqrt(u)
    points: Floats = (1 - root) * a[chosen] + root * (1 - v) * b[chosen] + root * v * c[chosen]
    return points

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Lattices known exactly, without the engine: membership by folding into one cell, closed forms."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

#: rho = a x^2 - b x^3 with x = r / L, for joint spheres no larger than the struts' own overlap:
#: struts straight through their nodes, so that the spheres change nothing inside the lattice.
DENSITY = {
    "Box": (3 * np.pi, 8 * np.sqrt(2)),
    "CVC": (4 * np.sqrt(3) * np.pi, 16 * np.sqrt(6)),
    "Octet": (12 * np.sqrt(2) * np.pi, 64 + 64 * np.sqrt(2)),
}

#: True volumes of the free-standing block of 10 x 10 x 10 cells, L = 10, r = 1, mm3.
BLOCK_VOLUME = {"Box": 101_170.0, "CVC": 180_754.0, "FCC": 306_955.0}


def in_lattice(points, cell, cell_size, radius, active=None):
    """Whether points lie in the lattice: of all space, or of the active cells at the origin.

    Segment by segment and cell by cell, with distances from Pythagoras: shares nothing with the
    engine but the cell's nodes and struts.
    """
    joint = radius * (1 + radius / cell_size)
    inside = np.zeros(len(points), bool)
    joint_points = cell.nodes * cell_size
    home = np.floor(points / cell_size).astype(int)
    for shift in np.stack(np.meshgrid(*[(-1, 0, 1)] * 3), axis=-1).reshape(-1, 3):
        index = home + shift
        local = points - index * cell_size
        # No strut or joint of a cell reaches farther out of it than a joint's radius.
        there = ((local >= -joint) & (local <= cell_size + joint)).all(axis=1) & ~inside
        if active is not None:
            there &= ((index >= 0) & (index < active.shape)).all(axis=1)
            there[there] = active[tuple(index[there].T)]
        rows = np.flatnonzero(there)
        local = local[rows]
        found = np.zeros(len(rows), bool)
        for a, b in cell.struts:
            p, q = cell.nodes[a] * cell_size, cell.nodes[b] * cell_size
            t = (local - p) @ (q - p) / ((q - p) @ (q - p))
            gap = np.linalg.norm(local - p - t[:, None] * (q - p), axis=1)
            found |= (t >= 0) & (t <= 1) & (gap <= radius)
        for node in joint_points:
            found |= np.linalg.norm(local - node, axis=1) <= joint
        inside[rows[found]] = True
    return inside


def distances_to_one_cell(points, cell, cell_size, radius):
    """Signed distance to one free-standing cell: capsules, whose caps the joint spheres cover."""
    nearest = np.full(len(points), np.inf)
    for a, b in cell.struts:
        p, q = cell.nodes[a] * cell_size, cell.nodes[b] * cell_size
        t = np.clip((points - p) @ (q - p) / ((q - p) @ (q - p)), 0.0, 1.0)
        gap = np.linalg.norm(points - p - t[:, None] * (q - p), axis=1) - radius
        nearest = np.minimum(nearest, gap)
    for node in cell.nodes * cell_size:
        gap = np.linalg.norm(points - node, axis=1) - radius * (1 + radius / cell_size)
        nearest = np.minimum(nearest, gap)
    return nearest


def in_struts(points, graph):
    """Whether points lie in the cones and spheres of a `volfrep.grid.strut_graph.Wireframe`.

    Candidates by distance to the struts' middles, membership from the definition of a cone: shares
    nothing with the engine but the wireframe.
    """
    start, end = graph.nodes[graph.struts[:, 0]], graph.nodes[graph.struts[:, 1]]
    length = np.linalg.norm(end - start, axis=1)
    reach = float(length.max() / 2 + max(graph.radii.max(), graph.joint_radii.max()))
    inside = np.zeros(len(points), bool)
    tree = cKDTree((start + end) / 2)
    joints = cKDTree(graph.nodes)
    for part in np.array_split(np.arange(len(points)), max(1, len(points) // 20_000)):
        p = points[part]
        near = tree.query_ball_point(p, reach, workers=-1)
        row = np.repeat(np.arange(len(p)), [len(n) for n in near])
        strut = np.concatenate([np.array(n, int) for n in near])
        offset = p[row] - start[strut]
        axis = (end - start)[strut] / length[strut][:, None]
        t = (offset * axis).sum(axis=1)
        gap = np.linalg.norm(np.cross(offset, axis), axis=1)
        share = t / length[strut]
        radius = graph.radii[strut, 0] * (1 - share) + graph.radii[strut, 1] * share
        hit = (share >= 0) & (share <= 1) & (gap <= radius)
        inside[part[row[hit]]] = True
        near = joints.query_ball_point(p, graph.joint_radii.max(), workers=-1)
        row = np.repeat(np.arange(len(p)), [len(n) for n in near])
        node = np.concatenate([np.array(n, int) for n in near])
        hit = np.linalg.norm(p[row] - graph.nodes[node], axis=1) <= graph.joint_radii[node]
        inside[part[row[hit]]] = True
    return inside


def volume_of_struts(frame, points=400_000, seed=3):
    """Of a wireframe's struts and balls, by points spread in all of these.

    Each counts by how many of them hold it.
    """
    random = np.random.default_rng(seed)
    start, end = frame.nodes[frame.struts].swapaxes(0, 1)
    span = end - start
    length = np.linalg.norm(span, axis=1)
    along = span / length[:, None]
    one, two = frame.radii.T
    volume = np.concatenate(
        [np.pi * length / 3 * (one**2 + one * two + two**2), 4 / 3 * np.pi * frame.joint_radii**3]
    )
    body = random.choice(len(volume), points, p=volume / volume.sum())
    is_strut = body < len(length)
    place = np.empty((points, 3))
    strut = body[is_strut]
    # Along a cone by its cross-section, then within that.
    s = random.random(len(strut))
    a, b = one[strut], two[strut]
    with np.errstate(invalid="ignore", divide="ignore"):
        share = (np.cbrt(a**3 + s * (b**3 - a**3)) - a) / (b - a)
    share = np.where(np.abs(b - a) < 1e-9, s, share)
    wide = (a + share * (b - a)) * np.sqrt(random.random(len(strut)))
    across = np.cross(along[strut], random.normal(size=(len(strut), 3)))
    across /= np.linalg.norm(across, axis=1, keepdims=True)
    place[is_strut] = start[strut] + share[:, None] * span[strut] + wide[:, None] * across
    ball = body[~is_strut] - len(length)
    way = random.normal(size=(len(ball), 3))
    way /= np.linalg.norm(way, axis=1, keepdims=True)
    deep = frame.joint_radii[ball] * np.cbrt(random.random(len(ball)))
    place[~is_strut] = frame.nodes[ball] + deep[:, None] * way
    tree, held = cKDTree(place), np.zeros(points)
    reach = 0.5 * length + np.maximum(one, two)
    for k, found in enumerate(tree.query_ball_point(start + 0.5 * span, reach)):
        near = np.array(found, int)
        local = place[near] - start[k]
        at = local @ along[k]
        off = np.sqrt(np.maximum((local * local).sum(axis=1) - at**2, 0.0))
        radius = one[k] + (two[k] - one[k]) / length[k] * at
        held[near] += (at >= 0) & (at <= length[k]) & (off <= radius)
    for found in tree.query_ball_point(frame.nodes, frame.joint_radii):
        held[found] += 1
    return volume.sum() * np.mean(1.0 / np.maximum(held, 1))

# SPDX-License-Identifier: LGPL-2.1-or-later
"""A skin between two surfaces as second-order wedges, finer where struts end in it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_matrix
from scipy.spatial import cKDTree

from ..util.types import Bools, Floats, Ints

#: Pads take no more than this part of an edge, both ends together.
_MOST_OF_EDGE = 0.8
#: Directions in which the planes about a vertex agree to less than this say nothing of its place.
_FLAT = 0.03
#: So many times are inner vertices evened out where wedges would be turned over, and what is left
#: drawn back little by little: along the rim of a wall thinner than two skins both sides meet, and
#: what is drawn back there is missing.
_EVENED_OUT, _DRAWN_BACK, _PART = 60, 40, 0.1
#: The volume at a wedge's corner over what upright walls would give: at least, and wanted.
_UPRIGHT, _WANTED = 0.05, 0.2
#: What is beyond a node is sought among so many wedges, by so many of Newton's steps, and lies no
#: farther out of one than this part of its width.
_NEAREST, _NEWTON, _FARTHEST_OUT = 16, 12, 0.5


@dataclass(frozen=True, eq=False)
class WedgeMesh:
    """Second-order wedges with straight edges, one through the thickness.

    Attributes:
        nodes: (k, 3) mm.
        elements: (e, 15) int64: corners of the inner triangle and of the outer one, the middles of
            the inner edges and of the outer ones, and those across (the order of CalculiX).
        is_pad: (e,) bool, next to a vertex with a pad.
        triangles: (t, 3) of the surface, rows of its vertices.
        rows: (t,) which of the triangles that were given they are.
        of: (e,) the triangle that each wedge is a piece of.
        outer: (n,) the node at each vertex of the outer surface; -1 where none is used.
        inner: (n,) the same of the inner one.
        ring: (r, 2) a vertex with a pad, and a node on the pad's inner border.
    """

    nodes: Floats
    elements: Ints
    is_pad: Bools
    triangles: Ints
    rows: Ints
    of: Ints
    outer: Ints
    inner: Ints
    ring: Ints

    def on_outside(self) -> tuple[Ints, Ints, Floats]:
        """(k,) nodes on the outer surface, (k, 3) the vertices of a triangle each is in, and (k, 3)
        their shares.
        """
        nodes, at = np.unique(self.elements[:, [3, 4, 5, 9, 10, 11]], return_index=True)
        rows = self.triangles[self.of[at // 6]]
        return nodes, rows, barycentric(self.nodes[self.outer[rows]], self.nodes[nodes])

    def spread(self, loads: Floats) -> Floats:
        """(k, 3) N on nodes, of (n, 3) on vertices of the surface: over its triangles.

        What a vertex has goes to its triangles by area, as far as all their corners have some; on
        these it is a traction, linear, with the same force and moment.
        """
        rows = self.triangles
        corner = self.nodes[self.outer[rows]]
        area = 0.5 * np.linalg.norm(
            np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]), axis=1
        )
        loaded = (loads != 0.0).any(axis=1)
        taking = np.where(loaded[rows].all(axis=1), area, 0.0)
        whole = np.bincount(rows.ravel(), np.repeat(taking, 3), len(loads))
        result = np.zeros_like(self.nodes)
        alone = loaded & (whole == 0.0)
        result[self.outer[alone]] = loads[alone]
        share = taking[:, None] / np.maximum(whole[rows], 1e-300)
        nodal = share[:, :, None] * loads[rows]  # (t, 3, 3): what each corner gives
        mean = nodal.mean(axis=1, keepdims=True)
        traction = (3.0 * mean + 12.0 * (nodal - mean)) / area[:, None, None]

        piece = np.flatnonzero(taking[self.of] > 0.0)
        middles = self.elements[piece, 9:12]
        one, two, three = self.nodes[self.elements[piece, 3:6]].swapaxes(0, 1)
        weight = np.linalg.norm(np.cross(two - one, three - one), axis=1) / 6.0
        parts = barycentric(
            np.repeat(corner[self.of[piece]], 3, axis=0), self.nodes[middles].reshape(-1, 3)
        ).reshape(-1, 3, 3)
        forces = weight[:, None, None] * (parts @ traction[self.of[piece]])
        np.add.at(result, middles, forces)
        return result


def barycentric(corners: Floats, points: Floats) -> Floats:
    """(k, 3) shares of the corners (k, 3, 3) in points of their planes."""
    a, b, c = corners.swapaxes(0, 1)
    one, two, to = b - a, c - a, points - a
    d11, d12, d22 = ((x * y).sum(axis=1) for x, y in ((one, one), (one, two), (two, two)))
    p1, p2 = (to * one).sum(axis=1), (to * two).sum(axis=1)
    rest = np.maximum(d11 * d22 - d12**2, 1e-300)
    second, third = (d22 * p1 - d12 * p2) / rest, (d11 * p2 - d12 * p1) / rest
    return np.stack([1.0 - second - third, second, third], axis=1)


def pad_shares(length: Floats, first: Floats, second: Floats) -> tuple[Floats, Floats]:
    """(k,) parts of edges that the pads at their ends take: all they ask for, where there is room.

    Args:
        length: (k,) of the edges, mm.
        first: (k,) radius of the pad at the first end, mm; 0 for none.
        second: (k,) the same at the second.
    """
    allowed = 1.0 / np.maximum(length, (first + second) / _MOST_OF_EDGE)
    return first * allowed, second * allowed


def corner_angles(corners: Floats) -> Floats:
    """(t, 3) radians, of (t, 3, 3) triangles.

    By angles what faces a vertex counts as much however it is cut into triangles (G. Thuermer,
    C. Wuethrich, J. Graphics Tools 3, 1998): all of what is on one side of an edge may be needles.
    """
    one, two = np.roll(corners, -1, axis=1) - corners, np.roll(corners, 1, axis=1) - corners
    across = np.linalg.norm(np.cross(one, two), axis=2)
    return np.asarray(np.arctan2(across, np.einsum("tci,tci->tc", one, two)))


def vertex_planes(
    vertices: Floats, triangles: Ints, normal: Floats, weight: Floats
) -> tuple[Floats, Floats, Bools]:
    """The planes about vertices as one quadratic form: its values, axes, and which of them count.

    Args:
        vertices: (n, 3) mm.
        triangles: (t, 3) rows of them.
        normal: (t, 3) of unit length.
        weight: (t, 3) of each triangle at its corners.

    Returns:
        (n, 3) values; (n, 3, 3) axes as columns; (n, 3) bool, along which the planes hold the
        vertex: one on a face, two on an edge, three in a corner.
    """
    square = np.zeros((len(vertices), 3, 3))
    outer = normal[:, :, None] * normal[:, None, :]
    for corner in range(3):
        np.add.at(square, triangles[:, corner], outer * weight[:, corner, None, None])
    values, axes = np.linalg.eigh(square)
    return values, axes, values > _FLAT * np.maximum(values[:, -1:], 1e-300)


def wedge_mesh(outer: Floats, inner: Floats, triangles: Ints, pads: Floats) -> WedgeMesh:
    """Wedges between two surfaces of the same triangles.

    Args:
        outer: (n, 3) mm.
        inner: (n, 3) the same vertices on the other side, mm; where wedges would be turned over
            they are moved along their surface.
        triangles: (t, 3) rows of both, seen from outside anticlockwise; needles that are folded
            over have no wedge.
        pads: (n,) mm; about a vertex the triangles are cut at this distance from it along their
            edges, where it is above 0.
    """
    triangles = triangles.astype(np.int64)
    own = len(outer)
    inner = upright(outer, inner, triangles)
    rows = np.flatnonzero(_stands(outer[triangles], inner[triangles], _UPRIGHT))
    triangles = triangles[rows]
    vertices, pieces, is_pad, of, ring = _cut(own, triangles, pads, outer)
    (near, far), share = vertices
    above = (1.0 - share)[:, None] * outer[near] + share[:, None] * outer[far]
    below = (1.0 - share)[:, None] * inner[near] + share[:, None] * inner[far]

    used, flat = np.unique(pieces, return_inverse=True)
    corners = flat.reshape(pieces.shape)
    count = len(used)
    sides = np.sort(
        np.stack([corners, np.roll(corners, -1, axis=1)], axis=2).reshape(-1, 2), axis=1
    )
    sides, side = np.unique(sides, axis=0, return_inverse=True)
    side = side.reshape(-1, 3)
    above, below = above[used], below[used]
    middle = 0.5 * (above + below)
    nodes = np.concatenate(
        [below, above, middle, below[sides].mean(axis=1), above[sides].mean(axis=1)]
    )
    elements = np.concatenate(
        [corners, corners + count, side + 3 * count, side + 3 * count + len(sides),
         corners + 2 * count], axis=1,
    )  # fmt: skip
    place = np.full(len(near), -1, np.int64)
    place[used] = np.arange(count)
    ring = ring[place[ring[:, 1]] >= 0]
    return WedgeMesh(
        nodes,
        elements,
        is_pad,
        triangles,
        rows,
        of,
        np.where(place[:own] >= 0, place[:own] + count, -1),
        place[:own],
        np.stack([ring[:, 0], place[ring[:, 1]]], axis=1),
    )


def beyond_inner(mesh: WedgeMesh, inner: Ints) -> tuple[Ints, Ints, Floats]:
    """How the wedges on the other side move at the places of inner nodes.

    A tie between places apart from each other would hold their turn, too: so it is asked for at the
    very place, into or out of the nearest wedge, by its shape functions.

    Args:
        mesh: the skin.
        inner: (j,) nodes on its inner side that are connected with the skin beyond.

    Returns:
        (i,) those of them that have one; (i, 15) its nodes; (i, 15) their shares.
    """
    if not len(inner):
        return inner, np.empty((0, 15), np.int64), np.empty((0, 15))
    corners = mesh.nodes[mesh.elements[:, :6]]
    rise = corners[:, 3:].mean(axis=1) - corners[:, :3].mean(axis=1)
    # What an inner node's own wedges rise to is the side that is not meant.
    own = np.zeros_like(mesh.nodes)
    for corner in range(3):
        np.add.at(own, mesh.elements[:, corner], rise)
    count = min(_NEAREST, len(corners))
    near = cKDTree(corners[:, :3].mean(axis=1)).query(mesh.nodes[inner], count)[1]
    near = near.reshape(len(inner), count)
    row = np.repeat(np.arange(len(inner)), count)
    element = near.ravel()
    faces = np.einsum("ij,ij->i", rise[element], own[inner[row]]) < 0.0
    row, element = row[faces], element[faces]
    place, off = _place_in(corners[element], mesh.nodes[inner[row]])
    low = np.minimum(np.minimum(place[:, 0], place[:, 1]), 1.0 - place[:, 0] - place[:, 1])
    out = np.maximum(np.maximum(-low, 0.0), 0.5 * np.maximum(np.abs(place[:, 2]) - 1.0, 0.0))
    out = np.where(off, np.inf, out)
    order = np.lexsort([out, row])
    first = order[np.unique(row[order], return_index=True)[1]]
    first = first[out[first] < _FARTHEST_OUT]
    return inner[row[first]], mesh.elements[element[first]], wedge_shares(place[first])


def wedge_shares(place: Floats) -> Floats:
    """(k, 15) shape functions of a second-order wedge at (k, 3) places: two of its three area
    coordinates, those of the second and the third corner, and the height from -1 to 1.
    """
    two, three, height = place.T
    area = np.stack([1.0 - two - three, two, three], axis=1)
    z = height[:, None]
    sides = 2.0 * area * np.roll(area, -1, axis=1)
    return np.concatenate(
        [
            0.5 * area * (1.0 - z) * (2.0 * area - 2.0 - z),
            0.5 * area * (1.0 + z) * (2.0 * area - 2.0 + z),
            sides * (1.0 - z),
            sides * (1.0 + z),
            area * (1.0 - z**2),
        ],
        axis=1,
    )


def _place_in(corners: Floats, points: Floats) -> tuple[Floats, Bools]:
    """(k, 3) places of points in wedges of straight edges (k, 6, 3); and which were not found."""
    place = np.tile([1.0 / 3.0, 1.0 / 3.0, -1.0], (len(points), 1))
    low, high = corners[:, :3], corners[:, 3:]
    size = np.linalg.norm(corners - corners.mean(axis=1, keepdims=True), axis=2).max(axis=1)
    for _ in range(_NEWTON):
        area = np.stack([1.0 - place[:, 0] - place[:, 1], place[:, 0], place[:, 1]], axis=1)
        share = 0.5 * (1.0 + place[:, 2])[:, None, None]
        layer = (1.0 - share) * low + share * high
        rest = points - np.einsum("kc,kci->ki", area, layer)
        slopes = np.stack(
            [
                layer[:, 1] - layer[:, 0],
                layer[:, 2] - layer[:, 0],
                0.5 * np.einsum("kc,kci->ki", area, high - low),
            ],
            axis=2,
        )
        good = np.abs(np.linalg.det(slopes)) > 1e-9 * size**3
        slopes[~good] = np.eye(3)
        step = np.linalg.solve(slopes, rest[:, :, None])[:, :, 0]
        place = place + np.where(good[:, None], np.clip(step, -1.0, 1.0), 0.0)
    return place, np.linalg.norm(rest, axis=1) > 1e-6 * size


def _cut(
    own: int, triangles: Ints, pads: Floats, places: Floats
) -> tuple[tuple[tuple[Ints, Ints], Floats], Ints, Bools, Ints, Ints]:
    """Triangles cut at their pads.

    Returns:
        the vertices, each between two of the surface's with a share of the second; (e, 3) pieces;
        (e,) which are of a pad; (e,) of which triangle; (r, 2) pads' vertices with those on their
        borders.
    """
    start, end = triangles.ravel(), np.roll(triangles, -1, axis=1).ravel()
    # A cut lies on an edge, beside one of its ends: named by both, that end first.
    named = np.concatenate([np.stack([start, end], axis=1), np.stack([end, start], axis=1)])
    cut = pads[named[:, 0]] > 0.0
    keys, place = np.unique(named[cut, 0] * np.int64(own) + named[cut, 1], return_inverse=True)
    near, far = np.divmod(keys, own)
    length = np.linalg.norm(places[near] - places[far], axis=1)
    share = pad_shares(length, pads[near], pads[far])[0]
    points = named[:, 0].copy()
    points[cut] = own + place.ravel()
    at_start, at_end = points[: len(start)].reshape(-1, 3), points[len(start) :].reshape(-1, 3)
    # About each triangle: behind corner 0, before 1, behind 1, before 2, behind 2, before 0.
    six = np.stack([at_start, at_end], axis=2).reshape(-1, 6)
    panels = six[:, [[0, 1, 2], [2, 3, 4], [4, 5, 0], [0, 2, 4]]].reshape(-1, 3)
    tips = np.stack([triangles, at_start, np.roll(at_end, 1, axis=1)], axis=2).reshape(-1, 3)
    pieces = np.concatenate([panels, tips])
    is_pad = np.arange(len(pieces)) >= len(panels)
    good = (pieces != np.roll(pieces, 1, axis=1)).all(axis=1)
    every = np.arange(own)
    vertices = (np.append(every, near), np.append(every, far)), np.append(np.zeros(own), share)
    ring = np.stack([near, own + np.arange(len(near))], axis=1)
    every = np.arange(len(triangles))
    of = np.append(np.repeat(every, 4), np.repeat(every, 3))
    return vertices, pieces[good], is_pad[good], of[good], ring


def upright(outer: Floats, inner: Floats, triangles: Ints) -> Floats:
    """The inner vertices, moved where what is between the surfaces would be turned over.

    First along their surface, which keeps the thickness, towards the middle of their neighbours;
    what is left towards the outside. Where the outside itself is folded nothing helps, and nothing
    is done.
    """
    way = np.cross(*(outer[triangles[:, k]] - outer[triangles[:, 0]] for k in (1, 2)))
    mean = np.zeros_like(outer)
    for corner in range(3):
        np.add.at(mean, triangles[:, corner], way)
    folded = np.einsum("ij,ij->i", mean[triangles].sum(axis=1), way) <= 0.0
    inner = inner.copy()

    def turned(least: float) -> Bools:
        return np.asarray(~folded & ~_stands(outer[triangles], inner[triangles], least))

    if turned(_WANTED).any():
        size = np.linalg.norm(way, axis=1)
        normal = way / np.maximum(size, 1e-300)[:, None]
        angles = corner_angles(outer[triangles])
        _, axes, held = vertex_planes(outer, triangles, normal, angles)
        along = np.einsum("nik,nk,njk->nij", axes, (~held).astype(float), axes)
        pairs = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
        near = csr_matrix((np.ones(len(pairs)), tuple(pairs.T)), (len(outer),) * 2)
        near = near + near.T
        near.data[:] = 1.0
        number = np.maximum(np.asarray(near.sum(axis=1)).ravel(), 1.0)[:, None]
        for _ in range(_EVENED_OUT):
            bad = turned(_WANTED)
            if not bad.any():
                break
            some = np.unique(triangles[bad])
            step = (near[some] @ inner) / number[some] - inner[some]
            inner[some] += 0.5 * np.einsum("nij,nj->ni", along[some], step)
    for _ in range(_DRAWN_BACK):
        bad = turned(_UPRIGHT)
        if not bad.any():
            break
        some = np.unique(triangles[bad])
        inner[some] += _PART * (outer[some] - inner[some])
    return inner


def _stands(high: Floats, low: Floats, least: float) -> Bools:
    """(t,) whether prisms between triangles (t, 3, 3) are turned over nowhere."""
    ways = [np.cross(side[:, 1] - side[:, 0], side[:, 2] - side[:, 0]) for side in (low, high)]
    size = np.linalg.norm(ways[1], axis=1)
    result = np.ones(len(high), bool)
    for way in ways:
        for corner in range(3):
            rise = high[:, corner] - low[:, corner]
            whole = size * np.linalg.norm(rise, axis=1)
            result &= np.einsum("ij,ij->i", rise, way) > least * whole
    return result

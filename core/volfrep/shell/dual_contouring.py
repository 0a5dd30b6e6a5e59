# SPDX-License-Identifier: LGPL-2.1-or-later
"""Dual contouring: a vertex in each patch where its planes meet, a polygon round each crossed edge.

Ju, Losasso, Schaefer, Warren 2002, "Dual contouring of Hermite data": the vertices minimise
quadric error functions, so that edges and corners come out sharp, not chamfered.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..mesh.triangle_mesh import TriangleMesh
from ..util.linalg import dot_columns, symmetric_eigen
from ..util.types import Bools, Floats, Ints
from .octree import Crossings

#: Planes are those of one flat place if their mean normal is longer than this.
FLAT = 0.99
#: Directions in which planes vary by less than this (eigenvalue over the largest) do not move a
#: vertex.
WEAK = 0.02
#: Sweeps of the search for the best point inside a cube.
DESCENT_ROUNDS = 40
#: Vertices keep this distance to the faces of their cubes, in units of the cube: then facets of
#: neighbours do not touch.
MARGIN = 0.01


def place_vertices(
    crossings: Crossings,
    wanted: Bools,
    points: Floats,
    anchor: Floats,
    normal: Floats,
    low: Floats,
    high: Floats,
) -> Floats:
    """The points of some patches that lie best on the planes of their edges, inside their cubes.

    Args:
        crossings: n edges, p patches.
        wanted: (p,) which k of the patches.
        points: (n, 3) where the edges are crossed.
        anchor: (n, 3) a point of each edge's plane.
        normal: (n, 3) its normal.
        low: (k, 3) lowest corners of the wanted patches' cubes.
        high: (k, 3) highest corners.

    Returns:
        (k, 3) points.
    """
    patches = len(low)
    # An edge in the middle of a leaf's face has two quadrants there and counts once.
    several = crossings.leaf != np.roll(crossings.leaf, -1, axis=1)
    edge, quadrant = np.nonzero(several & wanted[crossings.patch])
    number = np.cumsum(wanted) - 1
    planes = _Planes(number[crossings.patch[edge, quadrant]], anchor[edge], normal[edge])
    count = np.bincount(planes.patch, minlength=patches)[:, None]
    # Of several sheets in one cube the best points could pass each other, the middles hardly.
    alone = crossings.alone[wanted]
    middle = planes.totals(np.where(alone[planes.patch, None], planes.anchor, points[edge])) / count
    mean = planes.totals(planes.normal) / count
    bent = np.linalg.norm(mean, axis=1) < FLAT
    flat = alone & ~bent
    vertices = middle.copy()
    vertices[alone & bent] = _meet(planes.of(alone & bent), middle[alone & bent])
    off = np.einsum("ij,ij->i", planes.of(flat).pull(middle[flat]) / count[flat], mean[flat])
    vertices[flat] += off[:, None] * mean[flat]
    # Held in their cubes, facets of neighbouring cubes cannot cross.
    margin = MARGIN * (high - low)
    low, high = low + margin, high - margin
    out = ((vertices < low) | (vertices > high)).any(axis=1)
    inside = np.clip(vertices[out], low[out], high[out])
    vertices[out] = _meet_in_box(planes.of(out), inside, low[out], high[out])
    return vertices


@dataclass(frozen=True, eq=False)
class _Planes:
    """Planes through (n, 3) anchors, each of one of several patches (n,)."""

    patch: Ints
    anchor: Floats
    normal: Floats

    def of(self, which: Bools) -> _Planes:
        """Those of some patches, which are numbered anew."""
        own = which[self.patch]
        number = np.cumsum(which) - 1
        return _Planes(number[self.patch[own]], self.anchor[own], self.normal[own])

    def totals(self, values: Floats) -> Floats:
        """(patches, k) sums of the rows of each patch."""
        sums = [np.bincount(self.patch, weights=column) for column in values.T]
        return np.stack(sums, axis=1)

    def squares(self) -> Floats:
        """(patches, 3, 3) sums of n n^T."""
        upper = self.normal[:, [0, 0, 0, 1, 1, 2]] * self.normal[:, [0, 1, 2, 1, 2, 2]]
        return self.totals(upper)[:, [0, 1, 2, 1, 3, 4, 2, 4, 5]].reshape(-1, 3, 3)

    def pull(self, points: Floats) -> Floats:
        """(patches, 3) sums of n (n . (anchor - point)), for a point a patch."""
        height = np.einsum("ij,ij->i", self.normal, self.anchor - points[self.patch])
        return self.totals(self.normal * height[:, None])


def _meet(planes: _Planes, middle: Floats) -> Floats:
    """The minimum of each patch's quadric error function that is nearest to its middle.

    Directions that the planes leave open are cut off, as in the pseudo-inverse of Ju et al. 2002.
    """
    values, vectors = symmetric_eigen(planes.squares())
    keep = values > WEAK * values[:, 2:]
    inverse = np.where(keep, 1.0 / np.where(keep, values, 1.0), 0.0)
    along = np.einsum("nij,ni->nj", vectors, planes.pull(middle)) * inverse
    return np.asarray(middle + np.einsum("nij,nj->ni", vectors, along))


def _meet_in_box(planes: _Planes, point: Floats, low: Floats, high: Floats) -> Floats:
    """The same held in a box, by coordinate descent from a point inside."""
    # A column for every entry: numpy takes rows of three slowly.
    matrix = np.ascontiguousarray(np.moveaxis(planes.squares(), 0, -1))
    pull, move = np.ascontiguousarray(planes.pull(point).T), np.zeros((3, len(point)))
    least, most = (np.ascontiguousarray((end - point).T) for end in (low, high))
    own = [np.maximum(matrix[k, k], 1e-6) for k in range(3)]
    for _ in range(DESCENT_ROUNDS):
        for k in range(3):
            slope = pull[k] - dot_columns(matrix[k], move)
            move[k] = np.minimum(np.maximum(move[k] + slope / own[k], least[k]), most[k])
    return np.asarray(point + move.T)


@dataclass(frozen=True, eq=False)
class Facets:
    """The polygons round the crossed edges, in triangles.

    Attributes:
        mesh: its first vertices are the patches'.
        edge: (m,) the crossed edge of each triangle.
        off: (n,) how far a polygon's corners lie off the plane of its edge, mm.
    """

    mesh: TriangleMesh
    edge: Ints
    off: Floats


def facets(crossings: Crossings, vertices: Floats, anchor: Floats, normal: Floats) -> Facets:
    """Every polygon in one or two triangles.

    Args:
        crossings: n edges, p patches.
        vertices: (p, 3) a point a patch.
        anchor: (n, 3) a point of each edge's plane.
        normal: (n, 3) its normal.
    """
    patch = crossings.patch
    middle = crossings.leaf == np.roll(crossings.leaf, -1, axis=1)
    three = np.flatnonzero(middle.any(axis=1))
    after = middle[three].argmax(axis=1)[:, None]
    triangles = np.take_along_axis(patch[three], (after + np.arange(1, 4)) % 4, axis=1)
    four = np.flatnonzero(~middle.any(axis=1))
    quads = patch[four]
    # Seen along the edge the four corners lie in the four quadrants round it: a diagonal that
    # leaves both triangles counter-clockwise exists, and keeps facets from folding over.
    corners = vertices[quads]
    rows, axis = np.arange(len(four)), crossings.edges.axis[four]
    u = corners[rows, :, (axis + 1) % 3]
    v = corners[rows, :, (axis + 2) % 3]

    def turn(a: int, b: int, c: int) -> Floats:
        du, dv = u[:, b] - u[:, a], v[:, b] - v[:, a]
        return np.asarray(du * (v[:, c] - v[:, a]) - dv * (u[:, c] - u[:, a]))

    first = np.minimum(turn(0, 1, 2), turn(0, 2, 3))
    second = np.minimum(turn(0, 1, 3), turn(1, 2, 3))
    # Where both will do, the one whose middle lies nearer to the exact plane.
    off = np.einsum("nij,nj->ni", vertices[patch] - anchor[:, None], normal)
    nearer = np.abs(off[four, 0] + off[four, 2]) <= np.abs(off[four, 1] + off[four, 3])
    use_first = np.where((first > 0) & (second > 0), nearer, first >= second)
    halves = np.where(
        use_first[:, None], quads[:, [0, 1, 2, 0, 2, 3]], quads[:, [0, 1, 3, 1, 2, 3]]
    ).reshape(-1, 3)
    edge = np.concatenate([np.repeat(four, 2), three])
    result = _outward(np.concatenate([halves, triangles]), crossings.edges.rising[edge])
    return Facets(TriangleMesh(vertices, result), edge, np.abs(off).max(axis=1))


def _outward(triangles: Ints, rising: Bools) -> NDArray[np.int32]:
    """Counter-clockwise round the edge is outward where its lower end is inside."""
    return np.where(rising[:, None], triangles, triangles[:, ::-1]).astype(np.int32)


def with_fans(crossings: Crossings, plain: Facets, cut: Bools, points: Floats) -> Facets:
    """With fans instead of some polygons, which have further vertices on some segments.

    A fan's triangles between its edge and cut segments each lie in one cube, with the vertex of
    the patch: two such triangles of different patches cannot cross but in a cube with several.
    (Ju, Udeshi 2006, "Intersection-free contouring on an octree grid".)

    Args:
        crossings: n edges, s segments.
        plain: their polygons in triangles.
        cut: (s,) segments that get a vertex.
        points: (k, 3) of the k `fan_edges`: where they are crossed.
    """
    segment, patch = crossings.segment, crossings.patch
    fans = fan_edges(crossings, cut)
    vertices = plain.mesh.vertices
    centre = np.full(len(patch), -1)
    centre[fans] = len(vertices) + np.arange(len(fans))
    on_segment = np.full(len(cut), -1)
    on_segment[cut] = len(vertices) + len(fans) + np.arange(int(cut.sum()))
    edge, quadrant = np.nonzero((segment >= 0) & (centre >= 0)[:, None])
    ends = segment[edge, quadrant]
    own = cut[ends]
    middles = np.zeros((len(cut), 3))
    np.add.at(middles, ends[own], points[centre[edge[own]] - len(vertices)] / 2.0)
    vertices = np.concatenate([vertices, points, middles[cut]])
    here, there = patch[edge, quadrant], patch[edge, (quadrant + 1) % 4]
    hub, on = centre[edge], on_segment[ends]
    pieces = (
        np.stack([hub, here, there], axis=1)[~own],
        np.stack([hub, here, on], axis=1)[own],
        np.stack([hub, on, there], axis=1)[own],
    )
    owner = np.concatenate([edge[~own], edge[own], edge[own]])
    stay = centre[plain.edge] < 0
    triangles = np.concatenate(
        [
            plain.mesh.triangles[stay],
            _outward(np.concatenate(pieces), crossings.edges.rising[owner]),
        ]
    )
    edges = np.concatenate([plain.edge[stay], owner])
    return Facets(TriangleMesh(vertices, triangles), edges, plain.off)


def fan_edges(crossings: Crossings, cut: Bools) -> Ints:
    """The edges whose polygons have a cut segment."""
    has = crossings.segment >= 0
    return np.flatnonzero((cut[crossings.segment] & has).any(axis=1))

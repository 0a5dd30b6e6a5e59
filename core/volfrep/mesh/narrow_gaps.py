# SPDX-License-Identifier: LGPL-2.1-or-later
"""Gaps a hair wide along the corner of a void, widened by what a surface may stray.

Where a strut grazes the corner between two walls it leaves a tunnel of a few thousandths of a mm.
Facets along it are as thin, and moves that mend needles take them for noise and crumple them: who
prints it cannot make it, and who fills the part with elements gets flat ones. The strut's corners
on either wall slide along this wall, away from the gap: the walls stay where they are, and what is
connected stays so.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..util.ragged import rows_of
from ..util.types import Bools, Floats, Ints
from . import remesh
from .patches import FaultFinder
from .topology import edge_keys
from .triangle_mesh import TriangleMesh

#: Gaps are widened where they are narrower than this part of how far a corner may go.
NARROW = 0.5
#: Walls that face each other more than this (cosine of their normals), about 30 degrees apart, are
#: left: corners that slide along them bring little.
FACING = -0.87
#: Facets on either side of an edge in a wall turn by less than this (cosine).
EVEN = 0.999
#: Facets may not turn by more than this (cosine), but those lower than this part of how far a
#: corner may go: they span the gap.
TURN = 0.7
THIN = 0.2


@dataclass(frozen=True, eq=False)
class _Gaps:
    """Corners of struts across narrow gaps.

    Attributes:
        vertices: (k, 2) rows, on one wall and on the other.
        ways: (k, 2, 3) unit vectors in either wall, away from the gap.
        widths: (k,) mm.
    """

    vertices: Ints
    ways: Floats
    widths: Floats


def with_wider_gaps(
    mesh: TriangleMesh,
    most: Callable[[Floats], Floats],
    shortest: float,
    find_faults: FaultFinder,
) -> TriangleMesh:
    """The closed mesh with gaps that are all but closed widened; itself where there are none.

    Args:
        mesh: closed, every edge of two facets.
        most: how far corners at points (l, 3) go, mm.
        shortest: gaps that are no longer than this are left, mm.
        find_faults: of a mesh and (m,) facets that are new, (m,) facets that may not stay: corners
            of these do not go.
    """
    gaps = _narrow_gaps(mesh, most, shortest)
    order = np.argsort(gaps.widths, kind="stable")
    rows, first = np.unique(gaps.vertices[order].ravel(), return_index=True)
    ways = gaps.ways[order].reshape(-1, 3)[first]
    ways *= most(mesh.vertices[rows])[:, None]
    triangles, count = mesh.triangles.astype(np.int64), len(mesh.vertices)
    corners = mesh.vertices[triangles]
    while len(rows):
        vertices, goes = mesh.vertices.copy(), np.zeros(count, bool)
        vertices[rows] += ways
        goes[rows] = True
        fresh = goes[triangles].any(axis=1)
        moved = TriangleMesh(vertices, mesh.triangles)
        wrong = find_faults(moved, fresh) & fresh
        thin = THIN * most(corners[fresh].mean(axis=1))
        wrong[fresh] |= _turn(corners[fresh], vertices[triangles[fresh]], thin)
        if not wrong.any():
            return moved
        near = np.zeros(count, bool)
        near[triangles[wrong]] = True
        rows, ways = rows[~near[rows]], ways[~near[rows]]
    return mesh


def _turn(before: Floats, after: Floats, thin: Floats) -> Bools:
    """Whether facets (m, 3, 3) turn, other than thin ones."""
    cosine = np.einsum("ij,ij->i", remesh.unit_normals(before), remesh.unit_normals(after))
    return np.asarray((cosine < TURN) & (remesh.heights(before) >= thin))


def _narrow_gaps(mesh: TriangleMesh, most: Callable[[Floats], Floats], shortest: float) -> _Gaps:
    """Short edges over a gap between two walls that meet at a vertex farther off.

    Three vertices that are joined in a ring, but are no facet: it runs round a tunnel.
    """
    vertices, count = mesh.vertices, len(mesh.vertices)
    edges = remesh.edges(mesh.triangles.astype(np.int64), count)
    keys = edge_keys(edges.ends[:, 0], edges.ends[:, 1], count)
    length = np.linalg.norm(vertices[edges.ends[:, 0]] - vertices[edges.ends[:, 1]], axis=1)
    short = np.flatnonzero(length < NARROW * most(vertices[edges.ends[:, 0]]))
    begin, ends = remesh.grouped(edges.ends.ravel(), edges.ends[:, ::-1].ravel(), count)
    row, owner = rows_of(begin, edges.ends[short, 0])
    across, tip = short[owner], ends[row]
    is_facet = (edges.opposite[across] == tip[:, None]).any(axis=1)
    one, two = edges.ends[across].T
    at = np.searchsorted(keys, edge_keys(two, tip, count))
    is_ring = (
        ~is_facet
        & (tip != two)
        & (keys[np.minimum(at, len(keys) - 1)] == edge_keys(two, tip, count))
    )
    across, one, two, tip = (part[is_ring] for part in (across, one, two, tip))
    normals = remesh.unit_normals(vertices[mesh.triangles])
    fits = np.linalg.norm(vertices[tip] - vertices[one], axis=1) > shortest
    ways, walls = np.zeros((len(tip), 2, 3)), []
    for k, (own, other) in enumerate(((one, two), (two, one))):
        pair = normals[edges.triangles[np.searchsorted(keys, edge_keys(own, tip, count))]]
        walls.append(pair[:, 0])
        fits &= np.einsum("ij,ij->i", pair[:, 0], pair[:, 1]) > EVEN
        over = vertices[own] - vertices[other]
        # The other wall lies outside of this one: what is between them is no material.
        fits &= np.einsum("ij,ij->i", pair[:, 0], over) < 0.0
        way = np.cross(pair[:, 0], vertices[own] - vertices[tip])
        way /= np.maximum(np.linalg.norm(way, axis=1, keepdims=True), 1e-300)
        ways[:, k] = way * np.sign(np.einsum("ij,ij->i", way, over))[:, None]
    fits &= np.einsum("ij,ij->i", *walls) > FACING
    return _Gaps(np.stack([one, two], axis=1)[fits], ways[fits], length[across][fits])

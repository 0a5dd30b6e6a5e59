# SPDX-License-Identifier: LGPL-2.1-or-later
"""A closed mesh as a boundary representation: edges, loops, plane faces, shells, bodies."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..util.errors import VolfrepError
from ..util.types import Floats, Ints
from .topology import edge_keys, pieces_of
from .triangle_mesh import TriangleMesh

#: OpenCASCADE's own default, in mm: points nearer than this are the same to it.
TOLERANCE = 1e-7


@dataclass(frozen=True, eq=False)
class FacetedBrep:
    """What a solid modeller asks of a mesh, one plane face a triangle.

    Attributes:
        mesh: the mesh itself.
        edges: (n, 2) int64, the vertices an edge runs from and to.
        loops: (m, 3) int64, the edges around each triangle, counted from 1; negative where the
            triangle runs along the edge backwards.
        normals: (m, 3) float64, unit normals that point outwards.
        shell: (m,) int64, the shell of each triangle.
        body: (s,) int64, the body that each shell bounds, from outside or as a void.
        is_void: (s,) bool, shells that enclose emptiness.
    """

    mesh: TriangleMesh
    edges: Ints
    loops: Ints
    normals: Floats
    shell: Ints
    body: Ints
    is_void: NDArray[np.bool_]

    @property
    def bodies(self) -> int:
        """Separate pieces of material."""
        return int(np.count_nonzero(~self.is_void))

    def shells_of(self, body: int) -> list[int]:
        """The body's outer shell, then its voids."""
        own = np.flatnonzero(self.body == body)
        return [int(k) for k in own[np.argsort(self.is_void[own], kind="stable")]]


def faceted_brep(mesh: TriangleMesh) -> FacetedBrep:
    """The boundary representation of a closed mesh, in mm.

    Raises:
        VolfrepError: the mesh is empty, is not closed, has triangles without an area, or
            encloses no volume.
    """
    if not len(mesh.triangles):
        raise VolfrepError("The mesh is empty: there is nothing to make a solid of.")
    edges, loops = _edges(mesh)
    a, b, c = mesh.corners()
    normals = np.cross(b - a, c - a)
    length = np.linalg.norm(normals, axis=1, keepdims=True)
    if not (length > TOLERANCE**2).all():
        raise VolfrepError(
            f"The mesh has {int((length <= TOLERANCE**2).sum())} triangles without an area: "
            "use a coarser deviation."
        )
    shell, volumes = _shells(mesh, loops, len(edges))
    if not (volumes > 0).any():
        raise VolfrepError("The mesh encloses no volume: is it inside out?")
    body = _bodies(mesh, shell, volumes)
    return FacetedBrep(mesh, edges, loops, normals / length, shell, body, volumes <= 0)


def _edges(mesh: TriangleMesh) -> tuple[Ints, Ints]:
    start = mesh.triangles.astype(np.int64)
    end = np.roll(start, -1, axis=1)
    packed = edge_keys(start, end, len(mesh.vertices))
    keys, inverse, counts = np.unique(packed.ravel(), return_inverse=True, return_counts=True)
    inverse = inverse.reshape(start.shape)
    sign = np.where(start < end, 1, -1)
    balance = np.bincount(inverse.ravel(), sign.ravel(), len(keys))
    if not (counts == 2).all() or balance.any():
        bad = int(((counts != 2) | (balance != 0)).sum())
        raise VolfrepError(
            f"The mesh is not closed: {bad} of its edges do not have a triangle on either side."
        )
    edges = np.stack([keys // len(mesh.vertices), keys % len(mesh.vertices)], axis=1)
    return edges, sign * (inverse + 1)


def _shells(mesh: TriangleMesh, loops: Ints, edges: int) -> tuple[Ints, Floats]:
    """The shell of every triangle, and the signed volume of every shell.

    Triangles that share an edge are of one shell; a vertex that two shells share does not join
    them.
    """
    count = len(loops)
    edge = np.abs(loops).ravel() - 1
    triangle = np.repeat(np.arange(count), 3)
    by_edge = np.argsort(edge, kind="stable")
    pairs = triangle[by_edge].reshape(edges, 2)  # closed: every edge has two triangles
    shells, shell = pieces_of(pairs[:, 0], pairs[:, 1], count)
    volumes = np.bincount(shell, mesh.signed_volumes(), shells)
    return shell, volumes.astype(np.float64)


def _bodies(mesh: TriangleMesh, shell: Ints, volumes: Floats) -> Ints:
    """The body that each shell bounds; a void belongs to the smallest body around it."""
    outer = np.flatnonzero(volumes > 0)
    body = np.zeros(len(volumes), np.int64)
    body[outer] = np.arange(len(outer))
    voids = np.flatnonzero(volumes <= 0)
    if len(outer) == 1 or not len(voids):
        return body
    by_size = outer[np.argsort(volumes[outer])]
    first = np.zeros(len(volumes), np.int64)
    first[shell[::-1]] = np.arange(len(shell))[::-1]
    for void in voids:
        inside = winding(mesh, mesh.vertices[mesh.triangles[first[void], 0]], shell)
        around = by_size[inside[by_size] > 0.5]
        if not len(around):
            raise VolfrepError("The mesh has a void that lies outside every body: repair it.")
        body[void] = body[around[0]]
    return body


def winding(mesh: TriangleMesh, point: Floats, shell: Ints) -> Floats:
    """How often each shell winds around a point, by its triangles' solid angles.

    A. van Oosterom and J. Strackee, IEEE Trans. Biomedical Engineering 30, 1983.
    """
    a, b, c = (corner - point for corner in mesh.corners())
    la, lb, lc = (np.linalg.norm(side, axis=1) for side in (a, b, c))
    upper = np.einsum("ij,ij->i", a, np.cross(b, c))
    dots = [np.einsum("ij,ij->i", p, q) for p, q in ((a, b), (b, c), (c, a))]
    angle = 2.0 * np.arctan2(upper, la * lb * lc + dots[0] * lc + dots[1] * la + dots[2] * lb)
    result: Floats = np.bincount(shell, weights=angle) / (4.0 * np.pi)
    return result

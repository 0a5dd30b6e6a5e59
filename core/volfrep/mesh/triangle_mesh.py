# SPDX-License-Identifier: LGPL-2.1-or-later
"""The one mesh type that every stage takes and returns."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from ..util.linalg import cross_columns, dot_columns, less_columns
from ..util.threads import in_threads

Number = TypeVar("Number", np.float64, np.float32, np.int32, np.int64)

#: Triangles that one thread takes at a time.
TRIANGLES_PER_STEP = 1 << 16
#: The least and the greatest coordinates are found of so many points in a row.
BOX_POINTS = 1 << 8


@dataclass(frozen=True, eq=False)
class TriangleMesh:
    """An indexed triangle mesh in mm.

    Attributes:
        vertices: (n, 3) float64 coordinates.
        triangles: (m, 3) int32 vertex indices, counter-clockwise seen from outside.

    >>> corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], float)
    >>> facets = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]], np.int32)
    >>> round(TriangleMesh(corners, facets).volume, 9)
    0.166666667
    """

    vertices: NDArray[np.float64]
    triangles: NDArray[np.int32]

    @property
    def bounds(self) -> NDArray[np.float64]:
        """(2, 3) lowest and highest corner of the box; zeros for an empty mesh."""
        return box_of(self.vertices)

    @property
    def volume(self) -> float:
        """Signed enclosed volume in mm3, by the divergence theorem about the box's centre."""
        return float(self.signed_volumes().sum())

    @property
    def area(self) -> float:
        """Surface area in mm2."""
        return float(self.areas().sum())

    def corners(self) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
        """The three (m, 3) arrays of corner coordinates."""
        t = self.triangles
        return self.vertices[t[:, 0]], self.vertices[t[:, 1]], self.vertices[t[:, 2]]

    def areas(self) -> NDArray[np.float64]:
        """(m,) area of each triangle, mm2."""
        result = np.empty(len(self.triangles))

        def block(start: int) -> None:
            part = slice(start, start + TRIANGLES_PER_STEP)
            a, b, c = (corners_at(self.vertices, self.triangles[part, k]).T for k in range(3))
            normal = cross_columns(less_columns(b, a), less_columns(c, a))
            result[part] = 0.5 * np.sqrt(dot_columns(normal, normal))

        for _ in in_threads(block, range(0, len(result), TRIANGLES_PER_STEP)):
            pass
        return result

    def signed_volumes(self) -> NDArray[np.float64]:
        """(m,) signed volume of the tetrahedron that each triangle spans with the box's centre."""
        if not len(self.triangles):
            return np.zeros(0)
        a, b, c = self.corners()
        centre = self.bounds.mean(axis=0)
        a, b, c = a - centre, b - centre, c - centre
        volumes: NDArray[np.float64] = np.einsum("ij,ij->i", a, np.cross(b, c)) / 6.0
        return volumes

    def reversed(self) -> TriangleMesh:
        """The same surface seen from the other side."""
        return TriangleMesh(self.vertices, np.ascontiguousarray(self.triangles[:, ::-1]))


def box_of(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """(2, 3) lowest and highest corner of the box about (n, 3) points; zeros for none."""
    if not len(points):
        return np.zeros((2, 3))
    # Many points a row first: numpy is slow at reducing many short rows.
    whole = len(points) // BOX_POINTS * BOX_POINTS
    rows, found = points[:whole].reshape(-1, 3 * BOX_POINTS), []
    for end in (np.minimum, np.maximum):
        left = points[whole:]
        if whole:
            left = np.concatenate([left, end.reduce(rows, axis=0).reshape(-1, 3)])
        found.append(end.reduce(left, axis=0))
    return np.array(found)


def triangle_boxes(
    columns: Iterable[NDArray[Any]], corners: NDArray[Any]
) -> tuple[NDArray[Any], NDArray[Any]]:
    """(3, m) lowest and highest corners of the boxes about triangles.

    Args:
        columns: where the vertices are along each axis, mm or in cells of a grid.
        corners: (3, m) the first, second and third vertices of the triangles.
    """
    low, high = [], []
    for along in columns:
        a, b, c = (along[corner] for corner in corners)
        low.append(np.minimum(np.minimum(a, b), c))
        high.append(np.maximum(np.maximum(a, b), c))
    return np.array(low), np.array(high)


def random_points(mesh: TriangleMesh, count: int) -> NDArray[np.float64]:
    """(count, 3) points spread at random over a surface, the same for the same surface."""
    area = mesh.areas()
    random = np.random.default_rng(0)
    pick = random.choice(len(area), count, p=area / area.sum())
    weight = random.dirichlet((1.0, 1.0, 1.0), count)
    a, b, c = (corner[pick] for corner in mesh.corners())
    points: NDArray[np.float64] = weight[:, :1] * a + weight[:, 1:2] * b + weight[:, 2:] * c
    return points


def empty_mesh() -> TriangleMesh:
    """A mesh without vertices or triangles."""
    return TriangleMesh(np.zeros((0, 3)), np.zeros((0, 3), np.int32))


def concatenate(*meshes: TriangleMesh) -> TriangleMesh:
    """All the meshes as one, nothing welded."""
    triangles = np.concatenate([mesh.triangles for mesh in meshes])
    first, begin = 0, 0
    for mesh in meshes:
        end = begin + len(mesh.triangles)
        triangles[begin:end] += np.int32(first)
        first, begin = first + len(mesh.vertices), end
    return TriangleMesh(np.concatenate([mesh.vertices for mesh in meshes]), triangles)


def compact(mesh: TriangleMesh, *, owned: bool = False) -> TriangleMesh:
    """The mesh without the vertices that no triangle uses.

    Args:
        mesh: any.
        owned: nobody else has its triangles: they are numbered anew where they are.
    """
    return compacted(mesh, owned=owned)[0]


def compacted(mesh: TriangleMesh, *, owned: bool = False) -> tuple[TriangleMesh, NDArray[np.int32]]:
    """As `compact`, and (n,) the new number of each vertex in use."""
    used = np.zeros(len(mesh.vertices), bool)
    used[mesh.triangles.ravel()] = True
    index = np.cumsum(used, dtype=np.int32)
    index -= 1
    triangles = mesh.triangles if owned else np.empty(mesh.triangles.shape, np.int32)
    np.take(index, mesh.triangles, out=triangles, mode="clip")
    return TriangleMesh(rows_where(used, mesh.vertices), triangles), index


def corners_at(vertices: NDArray[Number], triangles: NDArray[Any]) -> NDArray[Number]:
    """(..., 3) where the vertices are that some triangles name.

    As by an index, by which numpy takes rows in twice the time and more.
    """
    result: NDArray[Number] = np.take(vertices, triangles, axis=0, mode="clip")
    return result


def rows_where(kept: NDArray[np.bool_], rows: NDArray[Number]) -> NDArray[Number]:
    """Some of (n, k) rows: as by a mask, which numpy applies number by number."""
    result: NDArray[Number] = np.take(rows, np.flatnonzero(kept), axis=0, mode="clip")
    return result

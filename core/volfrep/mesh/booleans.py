# SPDX-License-Identifier: LGPL-2.1-or-later
"""Booleans of whole meshes by manifold3d, and how meshes get there and back."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ..util.errors import VolfrepError
from ..util.manifold import manifold_library
from .triangle_mesh import TriangleMesh, compact

if TYPE_CHECKING:
    import manifold3d


def difference(mesh: TriangleMesh, *others: TriangleMesh) -> TriangleMesh:
    """A closed mesh less others.

    Raises:
        VolfrepError: one of them is no solid that can be cut.
    """
    result = as_manifold(mesh)
    for other in others:
        result = result - as_manifold(other)
    return as_mesh(result)


def intersection(mesh: TriangleMesh, other: TriangleMesh) -> TriangleMesh:
    """What two closed meshes have in common.

    Raises:
        VolfrepError: one of them is no solid that can be cut.
    """
    return as_mesh(as_manifold(mesh) ^ as_manifold(other))


def as_manifold(mesh: TriangleMesh) -> manifold3d.Manifold:
    """A closed mesh as the library's solid.

    Raises:
        VolfrepError: it is none.
    """
    library = manifold_library("Cutting or uniting solids")
    solid: manifold3d.Manifold = library.Manifold(to_library(mesh))
    if solid.status() != library.Error.NoError:
        raise VolfrepError(
            f"A surface cannot be cut ({solid.status().name}): repair the part's mesh."
        )
    return solid


def as_mesh(solid: manifold3d.Manifold) -> TriangleMesh:
    """The library's solid as a mesh, welded."""
    return compact(from_library(solid.to_mesh64()))


def to_library(mesh: TriangleMesh, **more: NDArray[np.uint64 | np.uint32]) -> manifold3d.Mesh64:
    """A mesh as the library takes it, with what else it may be told of the triangles.

    This and `from_library` are the only ways there and back.
    """
    library = manifold_library("A Boolean of meshes")
    result: manifold3d.Mesh64 = library.Mesh64(
        np.ascontiguousarray(mesh.vertices),
        np.ascontiguousarray(mesh.triangles, dtype=np.uint64),
        **more,
    )
    return result


def from_library(data: manifold3d.Mesh64) -> TriangleMesh:
    """The library's mesh as ours: triangles and vertices in its order, doubled ones as one."""
    vertices = np.array(data.vert_properties[:, :3], np.float64)
    number = np.arange(len(vertices), dtype=np.int32)
    # Vertices are doubled where inputs meet; the library tells which are the same.
    number[np.asarray(data.merge_from_vert).astype(np.int64)] = np.asarray(
        data.merge_to_vert
    ).astype(np.int32)
    return TriangleMesh(vertices, number[np.asarray(data.tri_verts).astype(np.int32)])

# SPDX-License-Identifier: LGPL-2.1-or-later
"""The faces of a mesh as an eye sees them: facets that no sharp edge parts."""

from __future__ import annotations

import numpy as np

from ..util.types import Ints
from .remesh import facet_normals
from .topology import edges_of, pieces_of
from .triangle_mesh import TriangleMesh

#: Facets that meet at a larger angle, degrees, belong to different faces.
SHARP = 25.0


def smooth_faces(mesh: TriangleMesh) -> Ints:
    """(m,) the face of each triangle, numbered from 1 by falling area.

    Args:
        mesh: wound alike throughout, as a closed solid is.

    >>> corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 2]], float)
    >>> wedge = TriangleMesh(corners, np.array([[0, 1, 2], [0, 3, 1]], np.int32))
    >>> smooth_faces(wedge).tolist()
    [2, 1]
    """
    normals = facet_normals(mesh)
    one, two = (sides // 3 for sides in edges_of(mesh).pairs())
    smooth = np.einsum("ij,ij->i", normals[one], normals[two]) > np.cos(np.radians(SHARP))
    count, piece = pieces_of(one[smooth], two[smooth], len(mesh.triangles))
    area = np.bincount(piece, mesh.areas(), count)
    # To a millionth, so that equal faces keep the order of their facets whatever rounding does.
    order = np.argsort(-np.round(area / max(area.max(initial=0.0), 1e-300), 6), kind="stable")
    number = np.empty(count, np.int64)
    number[order] = np.arange(1, count + 1)
    return number[piece]

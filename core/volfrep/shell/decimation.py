# SPDX-License-Identifier: LGPL-2.1-or-later
"""Decimation of a contoured wall."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np

from ..mesh.booleans import from_library, to_library
from ..mesh.triangle_mesh import TriangleMesh
from ..util.manifold import has_manifold, manifold_library
from ..util.types import Bools
from .adaptive_contour import OffsetSurface
from .dual_contouring import Facets, fan_edges, with_fans
from .sampled_depth import DepthField

#: How far simplifying may move the wall, in units of the thickness.
TOLERANCE = 0.005
#: Rounds of false position on an edge that is crossed.
SECANTS = 5


def simplify(surface: OffsetSurface, field: DepthField) -> TriangleMesh:
    """The wall with fewer facets, a few of which may run through each other (`crossing_plugs`).

    Where two polygons would have the same two corners they are replaced by fans. Without
    manifold3d all facets stay.
    """
    call = field.depth.monitor.call
    facets = _with_fans(surface, call(surface.crossings.doubled), field)
    if not has_manifold():
        return facets.mesh
    return call(partial(_simplify, facets.mesh, TOLERANCE * field.depth.thickness))


def _with_fans(surface: OffsetSurface, cut: Bools, field: DepthField) -> Facets:
    """The wall's facets, with fans round the edges whose polygons have a cut segment."""
    call, crossings = field.depth.monitor.call, surface.crossings
    edges = call(lambda: fan_edges(crossings, cut))
    low, high = (
        crossings.edges.low[edges].astype(np.float64),
        crossings.edges.high[edges].astype(np.float64),
    )
    a, b = field.sample(crossings.edges.low[edges])[0], field.sample(crossings.edges.high[edges])[0]
    nodes = low
    for _ in range(SECANTS):
        share = np.clip(a / (a - b), 0.05, 0.95)[:, None]
        nodes = low + share * (high - low)
        value = field.depth.values(field.point(nodes))[0]
        as_low = (value < 0) == (a < 0)
        low, a = np.where(as_low[:, None], nodes, low), np.where(as_low, value, a)
        high, b = np.where(as_low[:, None], high, nodes), np.where(as_low, b, value)
    points = field.point(nodes)
    return call(lambda: with_fans(crossings, surface.facets, cut, points))


def _simplify(mesh: TriangleMesh, tolerance: float) -> TriangleMesh:
    """The mesh with fewer triangles, moved by less than the tolerance, as a valid manifold."""
    library = manifold_library("The inner surface of a skin")
    solid: Any = library.Manifold(to_library(mesh))
    if solid.status() != library.Error.NoError:
        raise RuntimeError(f"the inner wall is not manifold: {solid.status()}")
    return from_library(solid.simplify(tolerance).to_mesh64())

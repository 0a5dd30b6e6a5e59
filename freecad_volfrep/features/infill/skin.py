# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the triangles of an infill's mesh are: outside, inner wall or lattice."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from volfrep.util.errors import VolfrepError

from .freshness import why_stale

if TYPE_CHECKING:
    import FreeCAD as App

    from volfrep.jobs.pipeline import FilledMesh, ShownMesh
    from volfrep.mesh.triangle_mesh import TriangleMesh

#: Of the triangles of a mesh that is out of date, so many must be outside by the present solid if
#: they are outside the mesh: else the solid is another one.
SAME_SKIN = 0.99


@dataclass(eq=False)
class Made:
    """What a mesh is made of.

    Attributes:
        kinds: (t,) uint8, what its triangles are.
        triangles: digest of them.
        shown: what is drawn of it, before the object's Placement moves it, where that is known.
    """

    kinds: NDArray[np.uint8]
    triangles: bytes
    shown: ShownMesh | None


def made_of(filled: FilledMesh) -> Made:
    """To be kept with a mesh, so that its triangles can be told apart later, and drawn."""
    return Made(filled.kinds, filled.digest, filled.shown)


def is_just_made(obj: App.DocumentObject) -> bool:
    """Whether it is known what an infill's mesh was made of, without asking its properties."""
    made: Any = obj.Proxy.made
    return made is not None and len(made.kinds) == obj.Mesh.CountFacets


def kinds_of(obj: App.DocumentObject, mesh: TriangleMesh) -> NDArray[np.uint8]:
    """(t,) uint8 for each triangle of an infill's mesh, see `volfrep.reports.facet_roles`.

    What the mesh was made of is known since it was computed; for one from a file it is what the
    properties stand for. Where these have changed since, only the mesh itself is left to ask:
    what encloses a cavity is outside, what bounds one is lattice, its skin's wall too.

    Args:
        obj: the infill.
        mesh: its mesh, as it lies before the object's Placement moves it.
    """
    from volfrep.jobs.pipeline import triangles_digest
    from volfrep.mesh.vertex_cluster import is_outside
    from volfrep.reports.facet_roles import LATTICE, OUTSIDE, kinds_of_triangles

    made: Any = obj.Proxy.made
    if made is not None and made.triangles == triangles_digest(mesh):
        return made.kinds  # type: ignore[no-any-return]
    outside = is_outside(mesh)
    fallback = np.where(outside & (not outside.all()), OUTSIDE, LATTICE).astype(np.uint8)
    try:
        # Those of the present values: where other struts were asked for, the skin is the same.
        solid, spec, _ = obj.Proxy.wanted(obj)
        kinds = kinds_of_triangles(mesh, solid, spec)
    except VolfrepError:
        return fallback
    if why_stale(obj) and not outside.all() and ((kinds == OUTSIDE) == outside).mean() < SAME_SKIN:
        return fallback
    return kinds

# SPDX-License-Identifier: LGPL-2.1-or-later
"""A lattice of beams, cut and joined to its skin."""

from __future__ import annotations

from dataclasses import dataclass

from ..grid.strut_graph import Wireframe
from ..mesh.triangle_mesh import TriangleMesh


@dataclass(frozen=True, eq=False)
class BeamModel:
    """A lattice of beams, cut and joined to its skin; mm.

    Attributes:
        lattice: the nodes and struts, with their radii.
        clip: closed mesh; what of the lattice lies outside it is cut off. None: nothing is.
        skin: closed mesh that the lattice is joined to; None for none.
        warnings: sentences for the user.
    """

    lattice: Wireframe
    clip: TriangleMesh | None = None
    skin: TriangleMesh | None = None
    warnings: tuple[str, ...] = ()

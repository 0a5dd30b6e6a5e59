# SPDX-License-Identifier: LGPL-2.1-or-later
"""A lattice of beams, cut and joined to its skin."""

from __future__ import annotations

import numpy as np

from ..design.openings import DrainHoles
from ..design.spec_parts import Grid, Skin, Struts
from ..grid.strut_graph import BeamModel, Wireframe, select_struts
from ..mesh.booleans import difference
from ..mesh.triangle_mesh import TriangleMesh, concatenate
from ..spatial.proximity import are_nearer
from ..spatial.rays import inside_points
from ..util.errors import VolfrepError
from ..util.progress import Monitor
from ..util.types import Bools
from .drains import drain
from .trimmed_surface import TrimmedSurface


def part_beams(
    solid: TriangleMesh,
    cavity: TriangleMesh,
    struts: Wireframe,
    skin: Skin,
    drains: DrainHoles | None,
    monitor: Monitor,
) -> BeamModel:
    """A skin with the beams that reach into the part.

    Args:
        solid: the part, mm.
        cavity: closed mesh of what its skin leaves, mm.
        struts: those of the lattice that reach into the part.
        skin: between the two.
        drains: holes through it; None for none.
        monitor: for progress and cancel.

    Raises:
        VolfrepError: a drain hole cannot be where it is wanted.
    """
    boundary = joined_boundary(solid, cavity, skin)
    if drains is None:
        return BeamModel(struts, solid, boundary)
    closed = TrimmedSurface(boundary)
    drained = drain(closed, solid, cavity, struts, skin.deepest, drains, monitor)
    return BeamModel(struts, solid, drained.surface.mesh, drained.warnings)


def joined_boundary(solid: TriangleMesh, cavity: TriangleMesh, skin: Skin) -> TriangleMesh:
    """A part's skin as a closed mesh of its outer and its inner wall."""
    if skin.open_faces:
        return difference(solid, cavity)
    return concatenate(solid, cavity.reversed())


def reaching_into(lattice: Wireframe, solid: TriangleMesh, inside: Bools) -> Wireframe:
    """The lattice without the struts that lie outside a closed mesh altogether.

    Args:
        lattice: mm.
        solid: the mesh, mm.
        inside: (m,) struts that reach into it as is known already.
    """
    asked = np.flatnonzero(~inside)
    ends = lattice.nodes[lattice.struts[asked]]
    middle = ends.mean(axis=1)
    reach = 0.5 * np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    reach += lattice.joint_radii[lattice.struts[asked]].max(axis=1)
    outside = np.flatnonzero(~inside_points(solid, middle, Monitor()))
    outside = outside[~are_nearer(solid, middle[outside], reach[outside])]
    if not len(outside):
        return lattice
    return select_struts(lattice, np.delete(np.arange(len(inside)), asked[outside]))


def refuse_fillets(struts: Struts) -> None:
    """Raise a `VolfrepError` where there are fillets between struts."""
    if struts.fillet > 0:
        raise VolfrepError(
            "Beams have no fillets between them: set the fillet to 0, or write the mesh only."
        )


def deformed_struts(grid: Grid, struts: Struts, what: str = "Beams") -> tuple[str, ...]:
    """A sentence where struts are not the straight and round ones that are written of them."""
    if struts.keep_radius or (grid.size_grading is None and grid.cell_map is None):
        return ()
    return (
        f"{what} are straight and round, and these struts are deformed with their cells: write the "
        "mesh, or let them keep their radius.",
    )

# SPDX-License-Identifier: LGPL-2.1-or-later
"""A part whose lattice stays beams: what of the wireframe lies in it, what cuts it, its skin."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ..design.openings import lie_on, open_surface, open_triangles
from ..design.spec import LatticeSpec
from ..grid.strut_graph import Wireframe
from ..mesh.booleans import difference
from ..mesh.triangle_mesh import TriangleMesh, concatenate
from ..spatial.proximity import closest_points
from ..spatial.rays import inside_points
from ..trim.beam_model import BeamModel
from ..trim.boolean_trim import NUDGE
from ..trim.clip_struts import AT_WALL, Clipped, clip
from ..trim.drains import drain
from ..util.cache import StageCache
from ..util.errors import VolfrepError
from ..util.progress import Monitor, ProgressCallback
from .blocks import block_wireframe
from .pipeline import fill


def beam_model(
    solid: TriangleMesh,
    spec: LatticeSpec,
    *,
    progress: ProgressCallback | None = None,
    cache: StageCache | None = None,
) -> BeamModel:
    """What `fill` makes of a solid, with the lattice as beams.

    Takes no longer than finding the skin's inner wall, and no time where the cache holds it.

    Args:
        solid: checked closed mesh, mm.
        spec: what to make.
        progress: called with the fraction done and the stage; returning False cancels.
        cache: as for `fill`.

    Raises:
        VolfrepError: as `fill`; or there are fillets, or no lattice (the output ``domain``).
        Cancelled: the callback said so.
    """
    _refuse_fillets(spec)
    if spec.output == "domain":
        raise VolfrepError(
            "The output 'domain' holds no lattice to write as beams: choose part or lattice."
        )
    filled = fill(solid, replace(spec, output="domain"), progress=progress, cache=cache)
    if not spec.is_cut:
        return BeamModel(filled.wireframe, warnings=filled.report.warnings + deformed_struts(spec))
    domain = filled.mesh
    clip = domain if spec.output == "lattice" else solid
    with_skin = spec.output == "part" and spec.shell > 0
    lattice = _reaching_into(filled.wireframe, clip)
    warnings = filled.report.warnings + deformed_struts(spec)
    if not with_skin:
        return BeamModel(lattice, clip, None, warnings)
    skin = concatenate(solid, domain.reversed())
    if spec.open_faces:
        skin = difference(solid, domain)
    if spec.drains is not None:
        drained = drain(skin, solid, domain, lattice, spec.shell, spec.drains, Monitor(progress))
        return BeamModel(lattice, clip, drained.mesh, warnings + drained.warnings)
    return BeamModel(lattice, clip, skin, warnings)


def block_beams(spec: LatticeSpec, count: Sequence[int]) -> BeamModel:
    """What `block` makes, as beams.

    Args:
        spec: what to make; cell, sizes, origin and gradings count.
        count: cells along x, y, z.

    Raises:
        VolfrepError: the counts make no sense, or there are fillets.
    """
    _refuse_fillets(spec)
    return BeamModel(block_wireframe(spec, count), warnings=deformed_struts(spec))


def _refuse_fillets(spec: LatticeSpec) -> None:
    if spec.fillet > 0:
        raise VolfrepError(
            "Beams have no fillets between them: set the fillet to 0, or write the mesh only."
        )


def deformed_struts(spec: LatticeSpec, what: str = "Beams") -> tuple[str, ...]:
    """A sentence where struts are not the straight and round ones that are written of them."""
    if spec.keep_radius or (spec.size_grading is None and spec.cell_map is None):
        return ()
    return (
        f"{what} are straight and round, and these struts are deformed with their cells: write the "
        "mesh, or let them keep their radius.",
    )


def _reaching_into(lattice: Wireframe, solid: TriangleMesh) -> Wireframe:
    """The lattice without the struts that lie outside the solid altogether."""
    ends = lattice.nodes[lattice.struts]
    middle = ends.mean(axis=1)
    reach = 0.5 * np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    reach += lattice.joint_radii[lattice.struts].max(axis=1)
    outside = np.flatnonzero(~inside_points(solid, middle, Monitor()))
    if len(outside):
        outside = outside[closest_points(solid, middle[outside])[1] > reach[outside]]
    kept = np.delete(np.arange(len(middle)), outside)
    used, struts = np.unique(lattice.struts[kept], return_inverse=True)
    return Wireframe(
        lattice.nodes[used],
        struts.reshape(-1, 2).astype(np.int32),
        lattice.radii[kept],
        lattice.joint_radii[used],
    )


def clipped_infill(
    solid: TriangleMesh,
    spec: LatticeSpec,
    *,
    progress: ProgressCallback | None = None,
    cache: StageCache | None = None,
) -> Clipped:
    """The axes of the struts that `volfrep.fill` would put into a solid, cut at its inner wall.

    No lattice is meshed. The wireframe lies where the mesh's struts lie (`trim.NUDGE`).

    Args:
        solid: checked closed mesh, mm.
        spec: what the solid is filled with; its output does not count.
        progress: called with the fraction done and the stage; returning False cancels.
        cache: keeps the stages' results between runs.

    Raises:
        VolfrepError: the specification does not fit the solid, or no strut lies inside.
        Cancelled: the callback said so.
    """
    from .pipeline import fill

    result = fill(solid, replace(spec, output="domain"), progress=progress, cache=cache)
    if spec.boundary == "whole" and spec.shell == 0:
        return Clipped(result.wireframe, np.zeros(len(result.wireframe.nodes), bool))
    nudged = result.wireframe.nodes + NUDGE * spec.cell_size
    clipped = clip(replace(result.wireframe, nodes=nudged), result.mesh)
    if spec.open_faces:
        openings = open_surface(solid, open_triangles(solid, spec.open_faces))
        frame = clipped.wireframe
        free = lie_on(openings, frame.nodes, AT_WALL * frame.joint_radii)
        clipped = replace(clipped, on_wall=clipped.on_wall & ~free)
    if not len(clipped.wireframe.struts):
        raise VolfrepError(
            "No strut's axis lies inside the part: reduce the cell size or move the origin."
        )
    return clipped

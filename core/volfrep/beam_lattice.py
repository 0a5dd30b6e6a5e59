# SPDX-License-Identifier: LGPL-2.1-or-later
"""A part whose lattice stays beams: what of the wireframe lies in it, what cuts it, its skin."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from .blocks import block_wireframe
from .booleans import difference
from .cache import StageCache
from .distance import closest_points
from .drains import drain
from .errors import VolfrepError
from .mesh import TriangleMesh, concatenate
from .pipeline import fill
from .progress import Monitor, ProgressCallback
from .spec import LatticeSpec
from .voxels import inside_points
from .wireframe import Wireframe


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

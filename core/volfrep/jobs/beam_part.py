# SPDX-License-Identifier: LGPL-2.1-or-later
"""A lattice as beams, or as the axes of its struts, in one call."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ..design.spec import LatticeSpec
from ..fem.tet_mesh import TetrahedralMesh, tetrahedra
from ..grid.congruent_joints import distinct_joints
from ..grid.strut_graph import BeamModel, Wireframe
from ..mesh.triangle_mesh import TriangleMesh
from ..spatial.proximity import are_nearer
from ..spatial.rays import inside_points
from ..trim.beam_model import deformed_struts, refuse_fillets
from ..trim.clip_struts import Clipped
from ..util.cache import StageCache
from ..util.progress import Monitor, ProgressCallback
from .blocks import block_wireframe
from .infill import Infill


def beam_model(
    solid: TriangleMesh,
    spec: LatticeSpec,
    *,
    progress: ProgressCallback | None = None,
    cache: StageCache | None = None,
) -> BeamModel:
    """What `fill` makes of a solid, with the lattice as beams: `Infill.beams` in one call.

    Raises:
        VolfrepError: as `fill`; or there are fillets, or no lattice (the output ``domain``).
        Cancelled: the callback said so.
    """
    return Infill(solid, spec, progress=progress, cache=cache).beams


def clipped_infill(
    solid: TriangleMesh,
    spec: LatticeSpec,
    *,
    progress: ProgressCallback | None = None,
    cache: StageCache | None = None,
) -> Clipped:
    """The axes of the struts that `fill` would put into a solid: `Infill.axes` in one call.

    Raises:
        VolfrepError: the specification does not fit the solid, or no strut lies inside.
        Cancelled: the callback said so.
    """
    return Infill(solid, spec, progress=progress, cache=cache).axes


def exact_struts(
    solid: TriangleMesh,
    spec: LatticeSpec,
    *,
    progress: ProgressCallback | None = None,
    cache: StageCache | None = None,
) -> tuple[Wireframe, TriangleMesh | None]:
    """The struts that exact surfaces are made of, and what a wall cuts them at; None for no wall.

    Raises:
        VolfrepError: the specification does not fit the solid.
        Cancelled: the callback said so.
    """
    infill = Infill(solid, spec, progress=progress, cache=cache)
    return infill.lattice_beams.lattice, infill.cavity if spec.is_cut else None


def joints_at_boundary(
    lattice: Wireframe,
    domain: TriangleMesh | None,
    *,
    progress: ProgressCallback | None = None,
) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """(n,) which nodes' joints, half struts included, lie inside a wall, and which it may cut.

    Raises:
        Cancelled: the callback said so.
    """
    nodes, monitor = lattice.nodes, Monitor(progress)
    if domain is None:
        return np.ones(len(nodes), bool), np.zeros(len(nodes), bool)
    reach = np.zeros(len(nodes))
    for joint in distinct_joints(lattice):
        length = np.linalg.norm(joint.arms, axis=1) + joint.radii[:, 1]
        reach[joint.places] = max(float(length.max()), joint.ball)
    cut = are_nearer(domain, nodes, reach)
    return inside_points(domain, nodes, monitor) & ~cut, cut


def tetrahedra_of(
    mesh: TriangleMesh, *, progress: ProgressCallback | None = None
) -> TetrahedralMesh:
    """As `fem.tet_mesh.tetrahedra`, for a callback."""
    return tetrahedra(mesh, Monitor(progress))


def struts_and_cavity(
    solid: TriangleMesh,
    spec: LatticeSpec,
    *,
    progress: ProgressCallback | None = None,
    cache: StageCache | None = None,
) -> tuple[Wireframe, TriangleMesh]:
    """The struts of the active cells, and the wall that they are cut at: of `Infill` in one call.

    Raises:
        VolfrepError: the specification does not fit the solid.
        Cancelled: the callback said so.
    """
    infill = Infill(solid, spec, progress=progress, cache=cache)
    return infill.struts, infill.cavity


def block_beams(spec: LatticeSpec, count: Sequence[int]) -> BeamModel:
    """What `block` makes, as beams.

    Args:
        spec: what to make; cell, sizes, origin and gradings count.
        count: cells along x, y, z.

    Raises:
        VolfrepError: the counts make no sense, or there are fillets.
    """
    refuse_fillets(spec.struts)
    warnings = deformed_struts(spec.grid, spec.struts)
    return BeamModel(block_wireframe(spec, count), warnings=warnings)

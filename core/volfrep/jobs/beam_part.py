# SPDX-License-Identifier: LGPL-2.1-or-later
"""A lattice as beams, or as the axes of its struts, in one call."""

from __future__ import annotations

from collections.abc import Sequence

from ..design.spec import LatticeSpec
from ..grid.strut_graph import BeamModel, Wireframe
from ..mesh.triangle_mesh import TriangleMesh
from ..trim.beam_model import deformed_struts, refuse_fillets
from ..trim.clip_struts import Clipped
from ..util.cache import StageCache
from ..util.progress import ProgressCallback
from .blocks import block_wireframe
from .targets import infill_of


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
    return infill_of(solid, spec, progress=progress, cache=cache).beams


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
    return infill_of(solid, spec, progress=progress, cache=cache).axes


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
    infill = infill_of(solid, spec, progress=progress, cache=cache)
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

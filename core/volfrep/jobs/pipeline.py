# SPDX-License-Identifier: LGPL-2.1-or-later
"""Run the whole job in one call: offset, activate, mesh, trim, join.

The stages are those of `volfrep.jobs.infill.Infill`, which computes any of them alone.
"""

from __future__ import annotations

from concurrent.futures import Executor

from ..design.spec import LatticeSpec
from ..mesh.triangle_mesh import TriangleMesh
from ..reports.result import Result
from ..util.cache import StageCache
from ..util.progress import ProgressCallback
from .targets import filled


def fill(
    solid: TriangleMesh,
    spec: LatticeSpec,
    *,
    progress: ProgressCallback | None = None,
    cache: StageCache | None = None,
    executor: Executor | None = None,
) -> Result:
    """Fill a solid with a lattice: the stage of `Infill` that the specification's output names.

    Where the specification has a target, its radius is found first (`targets`).

    Args:
        solid: checked closed mesh (from `volfrep.io.solid.read_solid` or `check_solid`), mm;
            what they repaired goes into the report's warnings.
        spec: what to make.
        progress: called with the fraction done and the stage; returning False cancels.
        cache: keeps the stages' results between runs.
        executor: cuts the lattice at the wall, group by group; None: in this process.

    Raises:
        VolfrepError: the specification does not fit the solid; the text says what to change.
        Cancelled: the callback said so.
    """
    return filled(solid, spec, progress=progress, cache=cache, executor=executor)[0]

# SPDX-License-Identifier: LGPL-2.1-or-later
"""A part's struts as they are, solved for its load cases: nothing is sized."""

from __future__ import annotations

import numpy as np

from ...design.spec import LatticeSpec
from ...loads.load_cases import LoadCases, refuse_heat, with_weights
from ...mesh.triangle_mesh import TriangleMesh
from ...sizing.analysis import Analysis, Limits, analyse
from ...sizing.model import SizingModel
from ...util.cache import StageCache
from ...util.progress import Monitor, ProgressCallback
from ..infill import Infill
from .goal import Goal
from .part_model import part_model, without_target
from .printed import Printing


def solve_struts(
    solid: TriangleMesh,
    spec: LatticeSpec,
    loads: LoadCases,
    *,
    printing: Printing | None = None,
    progress: ProgressCallback | None = None,
    cache: StageCache | None = None,
) -> tuple[SizingModel, Analysis]:
    """What a part's struts do as they are: nothing is sized.

    Args:
        solid: checked closed mesh, mm.
        spec: what it is filled with, graded or not.
        loads: the material, and what the part carries.
        printing: how struts come out; None as they are drawn.
        progress: called with the fraction done and the stage; returning False cancels.
        cache: keeps the costly stages of the part.

    Raises:
        VolfrepError: as `size`.
        Cancelled: the callback said so.
    """
    cache = cache or StageCache()
    spec = without_target(solid, spec, Goal(), cache, progress, [])
    infill = Infill(solid, spec, monitor=Monitor(progress), cache=cache)
    frame = infill.struts
    radii = np.zeros(len(frame.nodes))
    radii[frame.struts] = frame.radii
    used = radii[radii > 0.0]
    refuse_heat(loads)
    loads = with_weights(loads)
    low, high = 0.999 * float(used.min()), 1.001 * float(used.max())
    goal = Goal(thinnest=low, thickest=high, printing=printing)
    model = part_model(infill, loads, goal, cache)
    return model, analyse(model.problem, np.maximum(radii, low), Limits())[0]

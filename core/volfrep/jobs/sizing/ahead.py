# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a sizing needs of a part before anything is known of its loads, made ahead of it."""

from __future__ import annotations

from ...design.forecast import forecast_fill
from ...design.spec import LatticeSpec
from ...mesh.triangle_mesh import TriangleMesh
from ...util.cache import StageCache
from ...util.progress import Monitor, ProgressCallback
from ..infill import Infill
from .buildable import buildable, checked, flat_struts
from .goal import Goal
from .part_model import all_struts, unloaded

#: A part whose mesh would take more memory, GB, or longer, s, is not prepared.
MOST_MEMORY, MOST_SECONDS = 1.0, 60.0


def prepare(
    solid: TriangleMesh,
    spec: LatticeSpec,
    goal: Goal,
    *,
    progress: ProgressCallback | None = None,
    cache: StageCache,
) -> bool:
    """Make what `size` needs of a part and no load changes, and leave it in the cache for it.

    Whatever differs then is made anew: what is kept goes by its content.

    Args:
        solid: checked closed mesh, mm.
        spec: what it is filled with.
        goal: between which radii, and how the part is built; its limits count by what they are of.
        progress: called with the fraction done and the stage; returning False cancels.
        cache: of the part's stages.

    Returns:
        Whether it was made: not where the radius is a target's, nor for a part that takes more
        than a user would spend on what may not be wanted.

    Raises:
        VolfrepError: as `size`.
        Cancelled: the callback said so.
    """
    if spec.target is not None:
        return False
    forecast = forecast_fill(solid, spec)
    if forecast.memory_gb > MOST_MEMORY or forecast.seconds > MOST_SECONDS:
        return False
    goal = buildable(checked(goal), spec)[0]
    monitor = Monitor(progress)
    wanted = Infill(solid, all_struts(spec), monitor=monitor, cache=cache)
    if goal.building is not None and flat_struts(goal.building, wanted)[1]:
        steeper = goal.building.without_flat_struts(spec)
        assert steeper is not None
        wanted = Infill(solid, all_struts(steeper), monitor=monitor, cache=cache)
    unloaded(wanted, goal, cache)
    return True

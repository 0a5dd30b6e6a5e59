# SPDX-License-Identifier: LGPL-2.1-or-later
"""The steady heat of a filled part, homogenised: its temperature everywhere, and what flows."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from scipy import ndimage

from ..continuum.model import ContinuumModel
from ..design.spec import LatticeSpec
from ..loads.load_cases import LoadCases
from ..mesh.triangle_mesh import TriangleMesh
from ..util.cache import Kept, StageCache
from ..util.content import content_of, digest_of
from ..util.errors import VolfrepError
from ..util.progress import Monitor, ProgressCallback
from ..util.types import Floats
from .homogenised import homogenise_part


@dataclass(frozen=True, eq=False)
class SteadyHeat:
    """Temperatures of a part, in the degrees of its loads.

    Attributes:
        low: (3,) the grid's first node, mm.
        edge: (3,) between its nodes, mm.
        values: (nx, ny, nz) at its nodes; where no part is, that of the nearest one.
        ends: the least and the largest in the part.
        faces: name, mean temperature and W into the part, of every face with heat.
        resistance: K/W between two temperatures, or a power and one; None where there are more.
        cells_across: where the part is thickest.
    """

    low: Floats
    edge: Floats
    values: Floats
    ends: tuple[float, float]
    faces: tuple[dict[str, Any], ...]
    resistance: float | None
    cells_across: float

    def at(self, points: Floats) -> Floats:
        """(n,) at (n, 3) points, mm."""
        places = (np.asarray(points, float) - self.low) / self.edge
        found: Floats = ndimage.map_coordinates(self.values, places.T, order=1, mode="nearest")
        return found


def solve_heat(
    solid: TriangleMesh,
    spec: LatticeSpec,
    loads: LoadCases,
    *,
    progress: ProgressCallback | None = None,
    cache: StageCache | None = None,
) -> SteadyHeat:
    """Solve the heat of a filled part; its load cases are left out.

    Args:
        solid: checked closed mesh, mm.
        spec: what it is filled with, graded or not.
        loads: the material, and the heat.
        progress: called with the fraction done and the stage; returning False cancels.
        cache: keeps the costly stages of the part, and the last result.

    Raises:
        VolfrepError: there is no heat, or as `homogenise_part`.
        Cancelled: the callback said so.
    """
    if not loads.heat:
        raise VolfrepError("There is no heat: give faces a temperature or a power.")
    cache, monitor = cache or StageCache(), Monitor(progress)

    def solved(solid: TriangleMesh, spec: LatticeSpec, loads: LoadCases) -> SteadyHeat:
        made = homogenise_part(solid, spec, loads, monitor=monitor, cache=cache)
        assert made.temperatures is not None
        report = made.report
        return SteadyHeat(
            *_filled(made.model, made.temperatures),
            (report["temperatures"][0], report["temperatures"][1]),
            tuple(report["heat"]),
            report["resistance_k_w"],
            report["cells_across"],
        )

    alone = replace(loads, cases=())
    inputs = (
        Kept(solid, content_of(solid.vertices, solid.triangles)),
        Kept(spec, spec.digest()), Kept(alone, digest_of(alone)),
    )  # fmt: skip
    return cache.run("heat", solved, *inputs).value


def _filled(model: ContinuumModel, values: Floats) -> tuple[Floats, Floats, Floats]:
    """The grid's first node, its steps, and values at all of its nodes."""
    edge = np.asarray(model.bricks.edge, float)
    count = np.array(model.size) + 1
    place = np.rint((model.nodes - model.low) / edge).astype(int)
    known = np.zeros(count, bool)
    known[tuple(place.T)] = True
    whole = np.zeros(count)
    whole[tuple(place.T)] = values
    nearest = ndimage.distance_transform_edt(
        ~known, sampling=edge, return_distances=False, return_indices=True
    )
    return np.asarray(model.low, float), edge, whole[tuple(nearest)]

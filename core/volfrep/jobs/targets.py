# SPDX-License-Identifier: LGPL-2.1-or-later
"""The infill that is asked for, and the strut radius of a target.

The part that comes out has the density, mass or stiffness that was aimed at.

The radius of a density or a mass is read off `lattice.strut_volume`, in the very domain that the
lattice is cut by. The mesh is then measured; where it misses by more than `CLOSE` it is made again,
with what it missed by.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from concurrent.futures import Executor
from dataclasses import replace
from functools import partial

import numpy as np

from ..design.spec import LatticeSpec
from ..design.target import Target
from ..io.solid import Solid
from ..lattice.strut_volume import (
    FINE,
    ROUGH,
    VolumeByRadius,
    points_about,
    points_inside,
    volume_by_radius,
)
from ..mechanics.density import relative_density
from ..mesh.triangle_mesh import TriangleMesh
from ..reports.report import Report
from ..reports.result import Result
from ..util.cache import StageCache
from ..util.errors import VolfrepError
from ..util.progress import Monitor, ProgressCallback
from .blocks import block_volume, block_wireframe, measured_block
from .graphs.infill import GraphInfill
from .graphs.targets import solve_graph_target
from .infill import Infill
from .rough_radius import radius_range
from .stiffness_target import ratio_of_stiffness
from .target_report import REACH, WantedVolume, make_until_met
from .tpms.infill import TpmsInfill
from .tpms.stiffness import solve_tpms_stiffness
from .tpms.targets import solve_tpms_block_target, solve_tpms_target

#: The first guess is this near, relative; a radius is sought up to so much above it.
_ROUGHLY = 1.12
#: Fewer points than these tell a first guess so badly that the radius is sought farther above it.
_SURE = 200


def infill_of(
    solid: TriangleMesh,
    spec: LatticeSpec,
    *,
    cache: StageCache | None = None,
    progress: ProgressCallback | None = None,
    monitor: Monitor | None = None,
    executor: Executor | None = None,
    streamed: bool = False,
) -> Infill:
    """The stages of a solid filled with cells, walls or a network; arguments as of `Infill`."""
    kind = TpmsInfill if spec.surface is not None else Infill
    if spec.network is not None:
        kind = GraphInfill
    return kind(
        solid, spec, cache=cache, progress=progress, monitor=monitor, executor=executor,
        streamed=streamed,
    )  # fmt: skip


def solve_target(
    solid: TriangleMesh | Solid,
    spec: LatticeSpec,
    *,
    progress: ProgressCallback | None = None,
    cache: StageCache | None = None,
    meshed: bool = True,
    executor: Executor | None = None,
    streamed: bool = False,
) -> Infill:
    """The infill of a solid whose struts have the radius of the specification's target.

    Args:
        solid: checked closed mesh, mm.
        spec: with a target, or without one: then nothing is sought.
        progress: called with the fraction done and the stage; returning False cancels.
        cache: keeps the stages; the wall is found once.
        meshed: whether its result is made and measured; otherwise the radius is the first one,
            as for beams.
        executor: as of `Infill`.
        streamed: as of `Infill`.

    Raises:
        VolfrepError: no radius meets the target (the text says what can be had), or the
            specification does not fit the solid.
        Cancelled: the callback said so.
    """
    cache = cache or StageCache()
    made_of = partial(infill_of, solid, cache=cache, executor=executor, streamed=streamed)
    infill = made_of(spec, progress=progress)
    target = spec.target
    if target is None or spec.output == "domain":
        return infill
    if target.aim == "stiffness":
        return made_of(_stiff(spec, target), progress=progress)
    if spec.surface is not None:
        return solve_tpms_target(infill, target, made_of, meshed=meshed)
    if spec.network is not None:
        return solve_graph_target(infill, target, made_of, meshed=meshed)
    monitor, domain = infill.monitor, infill.domain.mesh.volume
    frame = infill.struts
    with monitor.stage("target", 0.4, 0.4):
        skin = spec.skin_volume(solid.volume, domain)

        def table(fineness: int, largest: float) -> VolumeByRadius:
            if spec.is_cut:
                points, weights = points_inside(infill.domain.mesh, fineness, monitor)
            else:
                points, weights = points_about(frame, REACH * largest, fineness)
            return volume_by_radius(
                frame, spec.strut_radius, spec.cell_size, points, weights, largest
            )

        search = _Search(spec, WantedVolume(target, spec.density, domain, skin), table)

    def make(volume: float) -> Infill:
        return made_of(search.specification(volume), progress=progress, monitor=monitor)

    def measure(made: Infill) -> Report:
        return made.result.report

    return make_until_met(make, measure if meshed else None, search.wanted)


def fill_with_target(
    solid: TriangleMesh | Solid,
    spec: LatticeSpec,
    *,
    progress: ProgressCallback | None = None,
    cache: StageCache | None = None,
    executor: Executor | None = None,
) -> tuple[Result, LatticeSpec]:
    """The result of `solve_target`, and the specification with the radius that was found."""
    infill = solve_target(solid, spec, progress=progress, cache=cache, executor=executor)
    return infill.result, infill.spec


def solve_block_target(
    spec: LatticeSpec,
    count: Sequence[int],
    *,
    progress: ProgressCallback | None = None,
    meshed: bool = True,
) -> LatticeSpec:
    """The specification of a block, with the radius of its target; see `solve_target`.

    Args:
        spec: with a target, or without one: then it is returned as it is.
        count: cells along x, y, z.
        progress: called with the fraction done and the stage; returning False cancels.
        meshed: whether its octants, or the mesh of a graded block, are made and measured;
            otherwise the radius is the first one, as for beams.

    Raises:
        VolfrepError: as `solve_target`.
    """
    target = spec.target
    if target is None:
        return spec
    if spec.network is not None:
        raise VolfrepError(
            f"A block of '{spec.unit_cell().name}', whose cells are no cubes or whose struts "
            f"differ, takes no target of {target.called}: give the strut radius."
        )
    if target.aim == "stiffness":
        return _stiff(spec, target)
    if spec.surface is not None:
        return solve_tpms_block_target(spec, block_volume(spec, count), target)
    size = spec.cell_size
    block_wireframe(spec, count)  # the counts are checked
    repeats = not spec.is_graded
    # The volume of equal cells grows by the same with every further layer.
    shape = tuple(min(int(n), 2) for n in count) if repeats else tuple(int(n) for n in count)
    frame = block_wireframe(spec, shape)

    def table(fineness: int, largest: float) -> VolumeByRadius:
        points, weights = points_about(frame, REACH * largest, fineness)
        if repeats:
            inner = points - np.array(spec.origin or (0.0, 0.0, 0.0)) - size / 2.0
            middle = (inner >= 0.0) & (inner < size)
            times = np.where(middle & (np.array(count) > 1), np.array(count) - 1.0, 1.0)
            weights = weights * times.prod(axis=1)
        return volume_by_radius(frame, spec.strut_radius, size, points, weights, largest)

    wanted = WantedVolume(target, spec.density, block_volume(spec, count))
    search = _Search(spec, wanted, table)

    def measure(made: LatticeSpec) -> Report:
        return measured_block(made, count, progress=progress)

    return make_until_met(search.specification, measure if meshed else None, wanted)


def _stiff(spec: LatticeSpec, target: Target) -> LatticeSpec:
    if spec.surface is not None:
        return solve_tpms_stiffness(spec, target)
    size = spec.cell_size
    ratio = ratio_of_stiffness(spec.unit_cell(), target, spec.fillet / size)
    return replace(spec, strut_radius=ratio * size)


#: A table as exact as 2^k points, up to a radius.
_Table = Callable[[int, float], VolumeByRadius]


class _Search:
    """Radii of volumes, within what can be made."""

    def __init__(self, spec: LatticeSpec, wanted: WantedVolume, table: _Table) -> None:
        self._spec, self.wanted = spec, wanted
        self._low, self._high = radius_range(spec)
        self._table = table(ROUGH, self._high)
        most = self._volume(self._high)
        if most <= 0.0:
            raise VolfrepError(
                f"No strut of cells '{spec.unit_cell().name}' of {spec.cell_size:g} mm reaches "
                f"the {wanted.domain:.4g} mm3 that there are for the lattice, however thick, so "
                f"that no {wanted.target.called} can be met: reduce the cell size or the skin, or "
                "move the origin."
            )
        if wanted.lattice <= most:
            found = self._radius(wanted.lattice)
            points = self._table.points_in(wanted.lattice)
            slack = _ROUGHLY if points >= _SURE else 1.0 + 3.0 / math.sqrt(points + 1.0)
            self._high = min(self._high, slack * found)
            self._table = table(FINE, self._high)
        # Of the thinnest struts the rough table has hardly a point.
        least = self._volume(self._low)
        if not least <= wanted.lattice <= most:
            raise VolfrepError(self._refusal(least, most))

    def specification(self, volume: float) -> LatticeSpec:
        """With the radius of a volume of the lattice, mm3."""
        return replace(self._spec, strut_radius=self._radius(volume))

    def _radius(self, volume: float) -> float:
        low, high = self._low, self._high
        if not self._spec.fillet:
            return float(np.clip(self._table.radius_of(volume), low, high))
        if self._volume(high) <= volume:
            return high
        if self._volume(low) >= volume:
            return low
        from scipy.optimize import brentq  # slow to load, and every job loads this module

        return float(brentq(lambda r: self._volume(r) - volume, low, high, xtol=1e-5 * high))

    def _volume(self, radius: float) -> float:
        """The lattice's, with its fillets as the endless lattice has them."""
        volume = self._table.at(radius)
        if not self._spec.fillet:
            return volume
        cell, size = self._spec.unit_cell(), self._spec.cell_size
        plain = relative_density(cell, radius / size).value
        return (
            volume * relative_density(cell, radius / size, self._spec.fillet / size).value / plain
        )

    def _refusal(self, least: float, most: float) -> str:
        spec, target = self._spec, self.wanted.target
        if target.aim == "relative_density":
            unit, span = "", (least / self.wanted.domain, most / self.wanted.domain)
        else:
            factor, skin = spec.density / 1000.0, self.wanted.skin
            unit, span = " g", ((skin + least) * factor, (skin + most) * factor)
        text = (
            f"No strut radius gives a {target.called} of {target.value:.4g}{unit} with cells "
            f"'{spec.unit_cell().name}' of {spec.cell_size:g} mm: choose one from {span[0]:.4g} "
            f"to {span[1]:.4g}{unit}"
        )
        if target.aim == "mass" and self.wanted.skin:
            text += f", of which the skin is {self.wanted.skin * spec.density / 1000.0:.4g} g"
        return text + "."

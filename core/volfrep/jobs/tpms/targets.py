# SPDX-License-Identifier: LGPL-2.1-or-later
"""The thickness of a target: walls that come out with the density or the mass that is wanted.

A point is solid from one level on; the levels of many points, sorted, are the volume at each.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ...design.spec import LatticeSpec
from ...design.target import Target
from ...grid.coordinate_map import identity_map
from ...lattice.strut_volume import FINE, points_inside
from ...reports.report import Report
from ...spatial.even_points import even_points
from ...tpms.deform import part_levels
from ...util.errors import VolfrepError
from ..infill import Infill
from ..target_report import WantedVolume, make_until_met
from .level_table import level_table, with_volume
from .octants import solid_of

#: Points for the table, as a power of 2.
POINTS = FINE - 3


def solve_tpms_target(
    infill: Infill, target: Target, made_of: Callable[..., Infill], *, meshed: bool
) -> Infill:
    """The infill of walls with the thickness of a target.

    Args:
        infill: of the specification with the target.
        target: a relative density or a mass.
        made_of: makes another infill of a specification, with its monitor.
        meshed: whether the result is made and measured.

    Raises:
        VolfrepError: no thickness meets the target; the text says what can be had.
    """
    spec, monitor, placement = infill.spec, infill.monitor, infill.placement
    domain = infill.domain.mesh
    with monitor.stage("target", 0.4, 0.4):
        points, weights = points_inside(domain, POINTS, monitor)
        mapping = placement.mapping or identity_map(spec.cell_size)
        inside = mapping.to_lattice(points - placement.nudged(np.zeros(3)))
        start = infill.cells.padded.cells.origin
        solid = solid_of(spec)
        if mapping.is_rigid:
            levels = solid.levels((inside - start) / spec.cell_size) * spec.cell_size
        else:
            levels = part_levels(inside, start, solid, spec.cell_size, mapping)
        table = level_table(levels, weights)
    skin = spec.skin_volume(infill.solid.volume, domain.volume)
    wanted = WantedVolume(target, spec.density, domain.volume, skin)

    def make(volume: float) -> Infill:
        return made_of(with_volume(spec, target, table, volume, domain.volume), monitor=monitor)

    def measure(made: Infill) -> Report:
        return made.result.report

    return make_until_met(make, measure if meshed else None, wanted)


def solve_tpms_block_target(spec: LatticeSpec, volume: float, target: Target) -> LatticeSpec:
    """The specification of a block of walls, with the thickness of its target.

    Args:
        spec: of equal cells; each holds the same share of solid.
        volume: of the block's cells, mm3.
        target: a relative density or a mass.

    Raises:
        VolfrepError: no thickness meets the target, or the cells are graded.
    """
    if spec.size_grading is not None or spec.cell_map is not None:
        raise VolfrepError(
            f"A target of {target.called} is for blocks of equal cells of walls: give the "
            "thickness, or leave the cells equal."
        )
    points = even_points(3, POINTS)
    levels = solid_of(spec).levels(points) * spec.cell_size
    table = level_table(levels, np.full(len(points), volume / len(points)))
    wanted = WantedVolume(target, spec.density, volume).lattice
    return with_volume(spec, target, table, wanted, volume)

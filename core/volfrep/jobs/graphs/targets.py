# SPDX-License-Identifier: LGPL-2.1-or-later
"""The strut radius of a target for a network: of struts in a part that are no cells."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from ...design.target import Target
from ...grid.strut_graph import Wireframe
from ...lattice.strut_volume import FINE, points_about, points_inside
from ...reports.report import Report
from ...util.types import Floats
from ..infill import Infill
from ..target_report import REACH, WantedVolume, make_until_met
from .frame import graph_struts, median_length
from .radius import THICKEST, volumes, with_radius

#: Points for the table, as a power of 2.
POINTS = FINE - 2


def solve_graph_target(
    infill: Infill, target: Target, made_of: Callable[..., Infill], *, meshed: bool
) -> Infill:
    """The infill of a network with the radius of a target.

    Args:
        infill: of the specification with the target.
        target: a relative density or a mass.
        made_of: makes another infill of a specification, with its monitor.
        meshed: whether the result is made and measured.

    Raises:
        VolfrepError: no radius meets the target; the text says what can be had.
    """
    spec, monitor = infill.spec, infill.monitor
    domain = infill.domain.mesh
    skin = spec.skin_volume(infill.solid.volume, domain.volume)
    wanted = WantedVolume(target, spec.density, domain.volume, skin)

    def room(frame: Wireframe) -> tuple[Floats, Floats]:
        if spec.is_cut:
            return points_inside(domain, POINTS, monitor)
        return points_about(frame, REACH * THICKEST * median_length(frame), POINTS)

    with monitor.stage("target", 0.3, 0.4):
        fixed = with_radius(
            spec, infill.placement, lambda: domain, room, wanted.lattice, skin, monitor
        )
        frame = graph_struts(fixed, infill.placement, lambda: domain, monitor)
        table = volumes(frame, fixed, room)

    def make(volume: float) -> Infill:
        # The first radius is the one that the struts were found for.
        radius = fixed.strut_radius if volume == wanted.lattice else table.radius_of(volume)
        return made_of(replace(fixed, strut_radius=radius), monitor=monitor)

    def measure(made: Infill) -> Report:
        return made.result.report

    return make_until_met(make, measure if meshed else None, wanted)

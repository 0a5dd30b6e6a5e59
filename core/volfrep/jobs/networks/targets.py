# SPDX-License-Identifier: LGPL-2.1-or-later
"""The strut radius of a target for a network: of struts in a part that are no cells."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from ...design.target import Target
from ...grid.strut_graph import Wireframe
from ...lattice.strut_volume import FINE, points_about, points_inside
from ...util.types import Floats
from ..infill import Infill
from .frame import median_length, network_struts
from .radius import THICKEST, volumes, with_radius

#: A mesh that misses its target by more, relative, is made again; so many are made at most.
CLOSE = 3e-3
MESHES = 3
#: Points for the table, as a power of 2.
POINTS = FINE - 2
#: A joint sphere's radius over the strut's is less.
_REACH = 1.5


def aimed_network(
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
    skin = abs(infill.solid.volume) - domain.volume if spec.with_skin else 0.0
    scale = target.value * domain.volume
    if target.aim == "mass":
        scale = target.value * 1000.0 / spec.density
    wanted = scale - (skin if target.aim == "mass" else 0.0)

    def room(frame: Wireframe) -> tuple[Floats, Floats]:
        if spec.is_cut:
            return points_inside(domain, POINTS, monitor)
        return points_about(frame, _REACH * THICKEST * median_length(frame), POINTS)

    with monitor.stage("target", 0.3, 0.4):
        fixed = with_radius(spec, infill.placement, lambda: domain, room, wanted, skin, monitor)
        frame = network_struts(fixed, infill.placement, lambda: domain, monitor)
        table = volumes(frame, fixed, room)
    for made in range(1, MESHES + 1):
        infill = made_of(fixed, monitor=monitor)
        if not meshed:
            return infill
        report = infill.result.report
        missing = (target.value - report.relative_density) * domain.volume
        if target.aim == "mass":
            missing = scale - report.volume_mm3
        if abs(missing) <= CLOSE * scale or made == MESHES:
            break
        wanted += missing
        fixed = replace(fixed, strut_radius=table.radius_of(wanted))
    return infill

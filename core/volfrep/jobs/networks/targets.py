# SPDX-License-Identifier: LGPL-2.1-or-later
"""The strut radius of a target for a network: of struts in a part that are no cells."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from ...design.networks import RandomNetwork
from ...design.spec import LatticeSpec
from ...design.target import Target
from ...grid.placement import Placement
from ...grid.strut_graph import Wireframe
from ...lattice.strut_volume import (
    FINE,
    VolumeByRadius,
    points_about,
    points_inside,
    volume_by_radius,
)
from ...mesh.triangle_mesh import TriangleMesh
from ...util.errors import VolfrepError
from ...util.progress import Monitor
from ...util.types import Floats
from ..infill import Infill
from .frame import SHORTEST, median_length, network_struts

#: A mesh that misses its target by more, relative, is made again; so many are made at most.
CLOSE = 3e-3
MESHES = 3
#: Points for the table, as a power of 2.
POINTS = FINE - 2
#: The thinnest and the thickest radius that is looked for, in units of the median length.
THINNEST, THICKEST = 2e-3, 0.35
#: How often a random network is drawn anew because the struts that are too short for its radius
#: have changed.
DRAWN = 3
#: A joint sphere's radius over the strut's is less.
_REACH = 1.5

#: Points of a network's room and the volume that each stands for, mm and mm3.
Room = Callable[[Wireframe], tuple[Floats, Floats]]


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
        table = _table(frame, fixed, room)
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


def with_radius(
    spec: LatticeSpec,
    placement: Placement,
    domain_of: Callable[[], TriangleMesh],
    room: Room,
    wanted: float,
    skin: float,
    monitor: Monitor,
) -> LatticeSpec:
    """The specification with the radius for which a network has a volume.

    Of a random network the shortest strut is then fixed too, four of those radii, so that it
    stays the same graph.

    Args:
        spec: with a network and a target.
        placement: where it lies in the part.
        domain_of: gives what is filled.
        room: gives points of that, or of all about the network where nothing cuts it.
        wanted: the network's volume, mm3.
        skin: of the part, mm3; named where no radius meets the target.
        monitor: for progress and cancel.

    Raises:
        VolfrepError: no radius gives that volume.
    """
    network = spec.network
    follows = isinstance(network, RandomNetwork) and not network.shortest
    for _ in range(DRAWN if follows else 1):
        if isinstance(network, RandomNetwork) and follows:
            shortest = SHORTEST * spec.strut_radius
            spec = replace(spec, network=replace(network, shortest=shortest))
        frame = network_struts(spec, placement, domain_of, monitor)
        table, median = _table(frame, spec, room), median_length(frame)
        low, high = (share * median for share in (THINNEST, THICKEST))
        least, most = table.at(low), table.at(high)
        if not least <= wanted <= most:
            raise VolfrepError(
                f"No strut radius meets the target: the network would have to have {wanted:.4g} "
                f"mm3, and its struts, {median:.3g} mm long in the median, can have about "
                f"{least:.3g} to {most:.3g} mm3" + (f" beside the skin's {skin:.4g}." * bool(skin)
                                                    or ".")
            )  # fmt: skip
        spec = replace(spec, strut_radius=float(np.clip(table.radius_of(wanted), low, high)))
    return spec


def _table(frame: Wireframe, spec: LatticeSpec, room: Room) -> VolumeByRadius:
    points, weights = room(frame)
    median = median_length(frame)
    return volume_by_radius(frame, spec.strut_radius, median, points, weights, THICKEST * median)

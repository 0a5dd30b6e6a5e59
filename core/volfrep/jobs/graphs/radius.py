# SPDX-License-Identifier: LGPL-2.1-or-later
"""The strut radius for which a network has a volume, before anything is meshed."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from ...design.graphs import RandomGraph
from ...design.spec import LatticeSpec
from ...grid.placement import Placement
from ...grid.strut_graph import Wireframe
from ...lattice.strut_volume import VolumeByRadius, volume_by_radius
from ...mesh.triangle_mesh import TriangleMesh
from ...util.errors import VolfrepError
from ...util.progress import Monitor
from ...util.types import Floats
from .frame import SHORTEST, graph_struts, median_length

#: The thinnest and the thickest radius that is looked for, in units of the median length.
THINNEST, THICKEST = 2e-3, 0.35
#: How often a random network is drawn anew because the struts that are too short for its radius
#: have changed.
DRAWN = 3

#: Points of a network's room and the volume that each stands for, mm and mm3.
Room = Callable[[Wireframe], tuple[Floats, Floats]]


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
    follows = isinstance(network, RandomGraph) and not network.shortest
    for _ in range(DRAWN if follows else 1):
        if isinstance(network, RandomGraph) and follows:
            shortest = SHORTEST * spec.strut_radius
            spec = replace(spec, network=replace(network, shortest=shortest))
        frame = graph_struts(spec, placement, domain_of, monitor)
        table, median = volumes(frame, spec, room), median_length(frame)
        low, high = (share * median for share in (THINNEST, THICKEST))
        least, most = table.at(low), table.at(high)
        if not least <= wanted <= most:
            beside = f" beside the skin's {skin:.4g}" if skin else ""
            raise VolfrepError(
                f"No strut radius meets the target: the network would have to have {wanted:.4g} "
                f"mm3, and its struts, {median:.3g} mm long in the median, can have about "
                f"{least:.3g} to {most:.3g} mm3{beside}."
            )
        spec = replace(spec, strut_radius=float(np.clip(table.radius_of(wanted), low, high)))
    return spec


def volumes(frame: Wireframe, spec: LatticeSpec, room: Room) -> VolumeByRadius:
    """A network's volumes over the radius of its struts; arguments as of `with_radius`."""
    points, weights = room(frame)
    median = median_length(frame)
    return volume_by_radius(frame, spec.strut_radius, median, points, weights, THICKEST * median)

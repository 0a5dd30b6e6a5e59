# SPDX-License-Identifier: LGPL-2.1-or-later
"""The nodes and struts that a network comes to in a part, before any of it is meshed."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from ...design.graphs import RandomGraph, StretchedCells
from ...design.spec import LatticeSpec
from ...graphs.random_graph import random_graph
from ...grid.coordinate_map import mapped_box
from ...grid.placement import Placement
from ...grid.strut_graph import Wireframe
from ...lattice.strut_volume import volume_by_radius
from ...mesh.triangle_mesh import TriangleMesh
from ...spatial.proximity import closest_points
from ...spatial.rays import inside_points
from ...util.progress import Monitor
from ...util.types import Floats
from .free_space import cells_about, graph_wireframe, shift_nodes

#: Struts of a random network are drawn together where they are shorter than so many radii.
SHORTEST = 4.0


def graph_struts(
    spec: LatticeSpec,
    placement: Placement,
    domain_of: Callable[[], TriangleMesh],
    monitor: Monitor,
) -> Wireframe:
    """A network's nodes and struts, whole, where its mesh has them.

    Args:
        spec: with a network.
        placement: where it lies in the part.
        domain_of: gives what is filled; asked where the network depends on it.
        monitor: for progress and cancel.

    Raises:
        VolfrepError: nothing is left of it.
    """
    wanted = spec.network
    if isinstance(wanted, RandomGraph):
        domain = domain_of()

        def depth(points: Floats) -> Floats:
            inside = inside_points(domain, points, monitor)
            found = np.zeros(len(points))
            found[inside] = closest_points(domain, points[inside])[1]
            return found

        shortest = SHORTEST * spec.struts.extremes[1]
        nodes, struts = random_graph(wanted, domain, spec.cell_size, shortest, depth, monitor)
        return graph_wireframe(nodes, None, struts, spec, placement)
    mapping = placement.mapping
    if isinstance(wanted, StretchedCells):
        bounds = domain_of().bounds
        if mapping is not None:
            bounds = mapped_box(mapping.to_lattice, bounds)
        wanted = cells_about(bounds, spec)
        nodes = wanted.nodes
    else:
        assert wanted is not None
        nodes = shift_nodes(wanted, spec)
    if mapping is not None:
        nodes = mapping.to_part(nodes)
    return graph_wireframe(nodes, wanted, wanted.struts, spec, placement)


def fixed_graph(spec: LatticeSpec) -> LatticeSpec:
    """The specification whose random network stays the same graph whatever radii it is given."""
    network = spec.network
    if not isinstance(network, RandomGraph) or network.shortest:
        return spec
    shortest = SHORTEST * spec.struts.extremes[1]
    return replace(spec, network=replace(network, shortest=shortest))


def median_length(frame: Wireframe) -> float:
    """The median length of struts, which stands for L in their joints, mm."""
    span = frame.nodes[frame.struts[:, 1]] - frame.nodes[frame.struts[:, 0]]
    return float(np.median(np.linalg.norm(span, axis=1)))


def graph_volume(frame: Wireframe, spec: LatticeSpec, points: Floats, domain: float) -> float:
    """About the volume of a network's struts and joints in a domain, mm3.

    Args:
        frame: whole struts.
        spec: whose radius they have.
        points: (n, 3) spread evenly over the domain.
        domain: its volume, mm3.
    """
    radius, median = spec.template_radius, median_length(frame)
    weights = np.full(len(points), domain / max(len(points), 1))
    return volume_by_radius(frame, radius, median, points, weights, radius).at(radius)

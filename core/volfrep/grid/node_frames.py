# SPDX-License-Identifier: LGPL-2.1-or-later
"""Target positions, radii and frames of the nodes of a graded lattice."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..design.cells import joint_radius
from ..util.linalg import turns
from ..util.types import Floats, Ints
from .strut_graph import CellGraph, neighbour_table


@dataclass(frozen=True, eq=False)
class NodeFrames:
    """Target positions, radii and frames of the nodes of a lattice.

    Attributes:
        graph: which nodes and struts there are.
        points: (n, 3) where the nodes lie, mm.
        radius: (n,) radius of the struts where they end at each node, mm.
        joint: (n,) radius of the joint spheres, mm.
        rotation: (n, 3, 3) by which the map turns lattice space there, its stretch left out; None
            where the nodes stay in lattice space.
        were: (n, k, 3) directions of the struts in lattice space.
        neighbours: (n, k) the nodes at the other ends of a node's struts; -1 for none.
        directions: (n, k, 3) unit vectors to them.
        slopes: (n, k) by which the struts' radii grow on the way.
        period: (3,) after which the nodes repeat, mm; infinite where they do not.
    """

    graph: CellGraph
    points: Floats
    radius: Floats
    joint: Floats
    rotation: Floats | None
    were: Floats
    neighbours: Ints
    directions: Floats
    slopes: Floats
    period: Floats


def node_frames(
    graph: CellGraph,
    points: Floats,
    radius: Floats,
    cell_size: float,
    jacobian: Floats | None = None,
    period: Floats | None = None,
) -> NodeFrames:
    """The nodes of a graph at given places, with given radii; see `NodeFrames`.

    Args:
        graph: its nodes and struts.
        points: (n, 3) where the nodes are to lie, mm.
        radius: (n,) of the struts there, mm.
        cell_size: L, mm.
        jacobian: (n, 3, 3) of the map that took them from lattice space; None if they stay there.
        period: (3,) after which lattice space repeats, mm; infinite where it does not.
    """
    table = neighbour_table(graph.struts, len(points))
    period = np.full(3, np.inf) if period is None else period
    directions, length = _outwards(
        points, table, np.full(3, np.inf) if jacobian is not None else period
    )
    were, turn = directions, None
    if jacobian is not None:
        were, _ = _outwards(graph.nodes, table, period)
        turn = turns(jacobian)
    return NodeFrames(
        graph,
        points,
        radius,
        joint_radius(radius, cell_size),
        turn,
        were,
        table,
        directions,
        (radius[table] - radius[:, None]) / length,
        np.full(3, np.inf) if jacobian is not None else period,
    )


def _outwards(points: Floats, table: Ints, period: Floats) -> tuple[Floats, Floats]:
    """Directions and lengths of the struts of the neighbours' table."""
    span = shortest(points[table] - points[:, None], period)
    length = np.linalg.norm(span, axis=2)
    length[table < 0] = 1.0
    return span / length[:, :, None], length


def shortest(span: Floats, period: Floats) -> Floats:
    """Vectors between nodes, each to the nearest of its end's repetitions."""
    for axis in np.flatnonzero(np.isfinite(period)):
        span[..., axis] -= period[axis] * np.round(span[..., axis] / period[axis])
    return span

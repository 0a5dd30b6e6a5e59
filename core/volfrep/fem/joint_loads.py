# SPDX-License-Identifier: LGPL-2.1-or-later
"""The nodes of a lattice's joints in a mesh of tetrahedra, to hold and pull it as a beam model is.

A beam's joint is a point that is held or carries a force. In a solid it is a ball: all its nodes
are held, or carry the force as their shares of the ball's volume, so that it acts at its middle.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from ..grid.strut_graph import Wireframe
from ..util.errors import VolfrepError
from ..util.numbers import place_text
from ..util.types import Floats, Ints
from .tet_mesh import TetrahedralMesh

#: Nodes outside a ball by this much, mm, still belong to it.
TOLERANCE = 1e-6
#: Joints this near to the outermost ones, in units of their radius, lie on the same side.
ON_SIDE = 0.05


@dataclass(frozen=True, eq=False)
class Ball:
    """The nodes of one joint.

    Attributes:
        nodes: (k,) rows of the mesh's nodes.
        shares: (k,) their parts of the ball's volume, together 1.
    """

    nodes: Ints
    shares: Floats


def balls_of(filled: TetrahedralMesh, frame: Wireframe, joints: Ints) -> list[Ball]:
    """The nodes inside the spheres of some joints.

    Args:
        filled: a lattice as tetrahedra, mm.
        frame: the same lattice's struts and joints.
        joints: rows of its nodes.

    Raises:
        VolfrepError: a joint holds no node of the mesh.
    """
    # A tenth of each tetrahedron to each of its ten nodes.
    volume = np.repeat(filled.volumes() / 10.0, 10)
    weight = np.bincount(filled.elements.ravel(), volume, len(filled.nodes))
    found = cKDTree(filled.nodes).query_ball_point(
        frame.nodes[joints], frame.joint_radii[joints] + TOLERANCE, return_sorted=True
    )
    balls = []
    for joint, rows in zip(joints.tolist(), found, strict=True):
        nodes = np.array(rows, np.int64)
        if not len(nodes):
            raise VolfrepError(
                f"The joint at {place_text(frame.nodes[joint])} holds no node: is it the same "
                "lattice?"
            )
        balls.append(Ball(nodes, weight[nodes] / weight[nodes].sum()))
    return balls


def side_joints(filled: TetrahedralMesh, frame: Wireframe) -> dict[str, Ints]:
    """The nodes of the joints on each side of a lattice of whole cells, as XMIN to ZMAX.

    Such a lattice touches its box with the tops of round joints, a node each: held there alone,
    every joint would turn about it.
    """
    low, high = frame.nodes.min(axis=0), frame.nodes.max(axis=0)
    sets = {}
    for axis, letter in enumerate("XYZ"):
        place = frame.nodes[:, axis]
        near = ON_SIDE * frame.joint_radii
        for name, on_side in (
            (f"{letter}MIN", place <= low[axis] + near),
            (f"{letter}MAX", place >= high[axis] - near),
        ):
            balls = balls_of(filled, frame, np.flatnonzero(on_side))
            sets[name] = np.unique(np.concatenate([ball.nodes for ball in balls]))
    return sets

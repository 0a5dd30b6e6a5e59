# SPDX-License-Identifier: LGPL-2.1-or-later
"""Balls within a solid, against a plate, a ball and the edges of a box."""

import numpy as np
import pytest
import trimesh

import samples
from volfrep.mesh.triangle_mesh import TriangleMesh
from volfrep.spatial.medial_balls import wall_thickness


def test_a_box_is_as_thick_as_it_is_and_thinner_towards_its_edges() -> None:
    solid = samples.box((40.0, 30.0, 10.0))
    places = np.array([[20.0, 15, 10], [20, 15, 0], [20, 2, 10], [0, 15, 5], [1, 15, 10]])
    assert wall_thickness(solid, places) == pytest.approx([10.0, 10.0, 4.0, 10.0, 2.0], rel=0.06)


def test_a_ball_is_its_own() -> None:
    ball = trimesh.creation.icosphere(4, 5.0)
    mesh = TriangleMesh(ball.vertices, ball.faces.astype(np.int32))
    assert wall_thickness(mesh, ball.triangles_center[::400]) == pytest.approx(10.0, rel=0.06)


def test_a_wall_is_thin_however_large_the_part_is() -> None:
    """The first ball, of the part's diagonal, reaches far out of a thin plate."""
    plate = samples.box((200.0, 150.0, 2.0))
    places = np.array([[100.0, 75, 2], [100, 75, 0], [30, 40, 2]])
    assert wall_thickness(plate, places) == pytest.approx(2.0, rel=1e-6)

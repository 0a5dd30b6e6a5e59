# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a surface and a mended one are apart, by heights that are known."""

import numpy as np
import pytest

import samples
from volfrep.fem.strayed import farthest_apart
from volfrep.mesh.triangle_mesh import TriangleMesh


def test_the_same_surface_is_nowhere_apart():
    ball = samples.sphere(5.0, 2)
    turned = TriangleMesh(ball.vertices[::-1], len(ball.vertices) - 1 - ball.triangles)
    assert farthest_apart(ball, turned) == 0.0


def test_a_vertex_that_moved_is_as_far_as_it_went_from_either_side():
    box = samples.box((10.0, 10.0, 10.0))
    spiked = TriangleMesh(box.vertices.copy(), box.triangles)
    spiked.vertices[int(np.argmax(box.vertices.sum(axis=1)))] += 0.2
    for one, other in ((box, spiked), (spiked, box)):
        assert farthest_apart(one, other) == pytest.approx(0.2 * 3**0.5)


def test_an_edge_that_bridges_is_told_by_its_middle():
    """Facets of two sides of a ridge turned about: their vertices are the same, the edge is not."""
    points = np.array([[0, 0, 1], [4, 0, 1], [2, 2, 0], [2, -2, 0]], float)
    ridge = TriangleMesh(points, np.array([[0, 1, 2], [1, 0, 3]], np.int32))
    valley = TriangleMesh(points, np.array([[0, 3, 2], [1, 2, 3]], np.int32))
    assert farthest_apart(ridge, valley) == pytest.approx(2.0 / 5.0**0.5)

# SPDX-License-Identifier: LGPL-2.1-or-later
import numpy as np

import samples
from volfrep.mesh.triangle_mesh import TriangleMesh, concatenate
from volfrep.spatial.self_intersection import crossing_triangles


def everywhere(mesh):
    return np.ones(len(mesh.triangles), bool)


def test_clean_surfaces_do_not_cross():
    for part in (samples.plate(48), samples.sphere(subdivisions=3), samples.bracket(33.0)):
        assert not crossing_triangles(part, everywhere(part), 1e-9).any()


def test_two_boxes_that_overlap_cross_where_they_meet():
    a, b = samples.box(), samples.box((40.0, 30.0, 20.0), (20.0, 5.0, 7.0))
    both = concatenate(a, b)
    crossing = crossing_triangles(both, everywhere(both), 1e-9)
    assert crossing[: len(a.triangles)].any()
    assert crossing[len(a.triangles) :].any()
    # The far end faces of either box touch nothing of the other.
    for plane in (0.0, 60.0):
        far = (both.vertices[both.triangles][:, :, 0] == plane).all(axis=1)
        assert far.any()
        assert not crossing[far].any()


def test_a_spike_through_the_other_side_is_found_from_its_own_triangles():
    part = samples.sphere(20.0, 3)
    vertices = part.vertices.copy()
    top = int(vertices[:, 2].argmax())
    vertices[top] = [0.3, 0.2, -25.0]
    bent = TriangleMesh(vertices, part.triangles)
    spike = (bent.triangles == top).any(axis=1)
    crossing = crossing_triangles(bent, spike, 1e-6)
    assert crossing[spike].any()
    assert crossing[~spike].any()
    np.testing.assert_array_equal(crossing, crossing_triangles(bent, everywhere(bent), 1e-6))
    assert not crossing_triangles(bent, ~everywhere(bent), 1e-6).any()

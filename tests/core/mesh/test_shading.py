# SPDX-License-Identifier: LGPL-2.1-or-later
"""Normals and edges to draw with: a box has creases, a ball has none."""

import numpy as np
import pytest

import samples
from volfrep.mesh.shading import CREASE_ANGLE, shade, sharp_edges
from volfrep.mesh.triangle_mesh import TriangleMesh


def test_every_corner_of_a_box_has_the_normal_of_its_face():
    box = samples.box((3.0, 2.0, 1.0))
    drawn = shade(box)
    a, b, c = box.corners()
    facet = np.cross(b - a, c - a)
    facet /= np.linalg.norm(facet, axis=1)[:, None]
    assert len(drawn.points) == 24
    assert drawn.normals[drawn.triangles] == pytest.approx(np.repeat(facet[:, None], 3, axis=1))
    assert (drawn.points[drawn.triangles] == box.vertices[box.triangles]).all()


def test_a_ball_is_smooth():
    ball = samples.sphere(20.0, 4)
    drawn = shade(ball)
    assert len(drawn.points) == len(ball.vertices)
    # A mean of facets strays from the sphere's normal by less than the angle between two facets.
    cosine = (drawn.normals * drawn.points / 20.0).sum(axis=1)
    assert cosine.min() > np.cos(np.radians(2.0))
    assert len(sharp_edges(ball)) == 0


def test_normals_do_not_depend_on_how_triangles_are_numbered():
    box = samples.box()
    turned = TriangleMesh(box.vertices, np.roll(box.triangles[::-1], 1, axis=1))
    one, two = shade(box), shade(turned)
    back = np.roll(two.normals[two.triangles], -1, axis=1)[::-1]
    assert one.normals[one.triangles] == pytest.approx(back)


@pytest.mark.parametrize(("angle", "edges"), [(20.0, 0), (60.0, 1)])
def test_a_fold_is_an_edge_where_it_is_sharp(angle, edges):
    turn = np.radians(angle)
    points = np.array([[0, 0, 0], [0, 1, 0], [-1, 0, 0], [np.cos(turn), 0, -np.sin(turn)]], float)
    fold = TriangleMesh(points, np.array([[0, 1, 2], [1, 0, 3]], np.int32))
    found = sharp_edges(fold)
    border = 4
    assert len(found) == border + edges
    assert sum({0, 1} == set(pair) for pair in found.tolist()) == edges
    assert (len(shade(fold).points) == 4) == (turn < CREASE_ANGLE)


def test_the_edges_of_a_box_are_its_twelve():
    box = samples.box((3.0, 2.0, 1.0))
    start, end = box.vertices[sharp_edges(box).T]
    lengths = np.linalg.norm(end - start, axis=1)
    assert sorted(lengths) == pytest.approx([1.0] * 4 + [2.0] * 4 + [3.0] * 4)

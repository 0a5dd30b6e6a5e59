# SPDX-License-Identifier: LGPL-2.1-or-later
"""Sections of round struts and joint spheres have the area and the place of the true ones."""

import numpy as np
import pytest

from volfrep.grid.strut_graph import Wireframe
from volfrep.slicing.sections import bodies_of, section_polygons


def strut(start, end, radii, joint=1e-6):
    return bodies_of(
        Wireframe(
            np.array([start, end], float),
            np.array([[0, 1]], np.int32),
            np.array([radii], float),
            np.full(2, float(joint)),
        )
    )


def area(polygons):
    x, y = polygons[..., 0], polygons[..., 1]
    return float(0.5 * (x * np.roll(y, -1, 1) - np.roll(x, -1, 1) * y).sum())


def test_an_upright_strut_is_cut_in_its_circle():
    struts, joints = section_polygons(strut([1, 2, 0], [1, 2, 5], (0.5, 0.5)), 2.0, 1e-3)
    assert area(struts) == pytest.approx(np.pi * 0.25, rel=1e-6)
    assert struts[0].mean(axis=0) == pytest.approx([1, 2], abs=1e-9)
    assert len(joints) == 0


def test_a_leaning_strut_is_cut_in_an_ellipse():
    lean = strut([0, 0, 0], [30, 0, 40], (1.0, 1.0))
    struts, _ = section_polygons(lean, 20.0, 1e-4)
    assert area(struts) == pytest.approx(np.pi * 1.0 / 0.8, rel=1e-6)


@pytest.mark.parametrize("height", [-0.4, 0.0, 0.3])
def test_a_level_strut_is_cut_in_a_rectangle(height):
    struts, _ = section_polygons(strut([0, 0, 0], [10, 0, 0], (0.5, 0.5)), height, 1e-2)
    assert area(struts) == pytest.approx(10 * 2 * np.sqrt(0.25 - height**2), rel=1e-9)


@pytest.mark.parametrize("seed", range(6))
def test_a_cone_at_any_angle_is_cut_where_its_points_are(seed):
    rng = np.random.default_rng(seed)
    start, end = rng.normal(size=(2, 3)) * 2
    radii = rng.uniform(0.2, 0.9, 2)
    cone = strut(start, end, radii)
    z = float(rng.uniform(*cone.spans[0]))
    struts, _ = section_polygons(cone, z, 1e-4)
    low, high = struts[0].min(axis=0) - 0.05, struts[0].max(axis=0) + 0.05
    points = rng.uniform(low, high, (200_000, 2))
    along = end - start
    length = np.linalg.norm(along)
    away = np.column_stack([points, np.full(len(points), z)]) - start
    t = away @ along / length
    radius = radii[0] + (radii[1] - radii[0]) * t / length
    held = (t >= 0) & (t <= length) & ((away**2).sum(axis=1) - t**2 <= radius**2)
    box = float(np.prod(high - low))
    share = held.mean()
    # Three standard deviations of the count.
    error = 3 * box * np.sqrt(share * (1 - share) / len(points))
    assert area(struts) == pytest.approx(box * share, abs=error)


def test_joints_are_cut_in_circles_and_what_lies_elsewhere_is_not():
    bodies = strut([0, 0, 0], [0, 0, 10], (0.5, 0.5), joint=1.0)
    struts, joints = section_polygons(bodies, 10.6, 1e-4)
    assert len(struts) == 0
    assert area(joints) == pytest.approx(np.pi * (1 - 0.36), rel=1e-6)
    assert [len(found) for found in section_polygons(bodies, 12.0, 1e-4)] == [0, 0]

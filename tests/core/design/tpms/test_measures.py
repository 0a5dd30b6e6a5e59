# SPDX-License-Identifier: LGPL-2.1-or-later
"""Areas and curvatures of surfaces that repeat, beside those of minimal surfaces and of a ball."""

import numpy as np
import pytest

from volfrep.design.tpms import SURFACES, PeriodicSurface
from volfrep.design.tpms.measures import strongest_curvature, surface_area


@pytest.mark.parametrize(
    ("name", "area"), [("Schwarz P", 2.3451), ("Gyroid", 3.0915), ("Schwarz D", 3.8378)]
)
def test_walls_have_the_triangles_of_their_surfaces_area(name, area):
    """Within a tenth: areas of the minimal surfaces in a cell of 1; P faces x, y and z rarely."""
    assert surface_area(SURFACES[name]) == pytest.approx(area, rel=0.1)


@pytest.mark.parametrize("radius", [0.04, 0.06])
def test_the_curvature_of_a_ball_is_one_over_its_radius(radius):
    """Three cosines, whose sum is about 3 - (2 pi r)^2 / 2 near the middle."""
    level = 2.0 + np.cos(2.0 * np.pi * radius)  # on the axes
    ball = PeriodicSurface("Formula", f"cos(x) + cos(y) + cos(z) - {level}")
    assert strongest_curvature(ball) == pytest.approx(1.0 / radius, rel=0.05)


def test_a_plane_is_not_bent():
    assert strongest_curvature(PeriodicSurface("Formula", "cos(x) + 0 * y")) < 1e-6

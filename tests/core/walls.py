# SPDX-License-Identifier: LGPL-2.1-or-later
"""How thick a skin really is, measured by exact distances at random points of its inner wall."""

import numpy as np
import trimesh

from volfrep.spatial.proximity import closest_points


def wall_errors(solid, wall, thickness, points=10_000):
    """Relative error of the wall's thickness at random points of the inner wall."""
    inner = trimesh.Trimesh(wall.vertices, wall.triangles, process=False)
    sampled = trimesh.sample.sample_surface(inner, points, seed=8)[0]
    return closest_points(solid, np.asarray(sampled))[1] / thickness - 1.0

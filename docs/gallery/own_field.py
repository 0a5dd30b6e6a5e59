# SPDX-License-Identifier: LGPL-2.1-or-later
"""Strut radii by points with values, and by a function of points."""

import numpy as np
import trimesh

import volfrep

box = trimesh.creation.box((40, 20, 20))
points = np.random.default_rng(1).uniform(-20, 20, (200, 3))
radii = np.interp(points[:, 0], [-20, 20], [0.4, 1.0])
part = volfrep.fill(box, cell_size=10, shell=0, strut_radius=(points, radii))
round_it = volfrep.fill(
    box, cell_size=10, shell=0, strut_radius=lambda at: 0.4 + np.linalg.norm(at, axis=1) / 40
)
print(part.struts.radii.min(), round_it.struts.radii.max())

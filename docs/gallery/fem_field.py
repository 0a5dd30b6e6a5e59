# SPDX-License-Identifier: LGPL-2.1-or-later
"""Stresses of a FEM program at points, to radii: 0.4 mm at 0 MPa, 1.2 mm from 100 MPa on."""

import numpy as np
import trimesh

import volfrep

points = np.stack(np.meshgrid(*(np.linspace(0, side, 9) for side in (40, 20, 20))), -1)
stress = 120 * (1 - points[..., 0] / 40) * np.abs(points[..., 2] / 10 - 1)
part = volfrep.fill(
    trimesh.creation.box(bounds=((0, 0, 0), (40, 20, 20))),
    cell="CVC", cell_size=10, strut_radius=1, shell=1,
    radius_field=(points.reshape(-1, 3), stress.ravel()), radius_curve="0:0.4, 100:1.2",
)  # fmt: skip
print(part.fields["radius"].max())

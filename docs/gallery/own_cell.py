# SPDX-License-Identifier: LGPL-2.1-or-later
"""A unit cell of one's own: nodes in a cube from 0 to 1, and struts between them."""

import volfrep

nodes = [[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)] + [[0.5, 0.5, 0.3]]
cell = volfrep.make_cell("Tent", nodes, [[corner, 8] for corner in range(8)])
cube = volfrep.block((3, 3, 3), cell=cell, cell_size=8, strut_radius=0.5)
print(cube.report.bodies, f"body, {cube.report.relative_density:.1%} full")
cube.save("tents.stl")

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cells laid into the hexahedra of a mesh, which follow an arch."""

import meshio
import numpy as np

import volfrep

across, angle, along = np.meshgrid([20, 26, 32], np.linspace(0, np.pi, 9), [0, 8], indexing="ij")
points = np.stack([across * np.cos(angle), along, across * np.sin(angle)], -1).reshape(-1, 3)
rows = np.arange(len(points)).reshape(across.shape)
turn = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
boxes = np.stack([rows[i : i + 2, j : j + 8, k : k + 1].ravel() for i, j, k in turn], -1)
meshio.Mesh(points, {"hexahedron": boxes}).write("arch.vtk")
part = volfrep.mesh_network("arch.vtk", cell="BCC", strut_radius=0.6)
part.save("arch.stl")
print(part)

# SPDX-License-Identifier: LGPL-2.1-or-later
"""A mesh of trimesh, filled: its mass, and the lattice as a mesh again."""

import trimesh

import volfrep

part = volfrep.fill(trimesh.creation.capsule(20, 8), cell="BCC", cell_size=6, strut_radius=0.6)
print(part, f"of {part.mass:.1f} g")
part.mesh.export("filled.ply")

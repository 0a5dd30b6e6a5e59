# SPDX-License-Identifier: LGPL-2.1-or-later
"""A 3MF with the lattice as beams and as a mesh, its report, and the check for SLS."""

from pathlib import Path

import trimesh

import volfrep

part = volfrep.fill(trimesh.creation.box((30, 20, 20)), cell_size=10, shell=1.5, material="PA12")
for sentence in part.save("light.3mf", "both"):
    print(sentence)
Path("light.json").write_text(part.report.to_json(), encoding="utf-8")
print(part.check("SLS").to_text())

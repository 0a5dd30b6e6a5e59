# SPDX-License-Identifier: LGPL-2.1-or-later
"""Run by FreeCAD at its start, with or without windows.

Scripts import ``from freecad.volfrep import make_lattice_infill`` from then on. Nothing that costs
time is done.
"""

from freecad_volfrep.mesh_references import hold_meshes
from freecad_volfrep.revival import watch_documents

watch_documents()
hold_meshes()

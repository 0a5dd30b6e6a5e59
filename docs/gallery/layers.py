# SPDX-License-Identifier: LGPL-2.1-or-later
"""Layers for a printer, cut straight from the struts."""

import trimesh

import volfrep

part = volfrep.fill(trimesh.creation.box((20, 20, 10)), cell="BCC", shell=1, resolution=8)
made = part.layers("layers", layer=0.5, pixel=0.1)
print(made.count, "layers of", made.pixels, "pixels")

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Struts sized for a load: held at x = 0, pulled down at x = 20."""

import trimesh

import volfrep

box = trimesh.creation.box(bounds=((0, 0, 0), (20, 10, 10)))
left, right = ({"point": [x, 0, 0], "normal": [1, 0, 0]} for x in (0, 20))
loads = {
    "material": "Ti-6Al-4V",
    "support": [{"plane": left, "fixed": True}],
    "case": [{"load": [{"plane": right, "force": [0, 0, -100]}]}],
}
part = volfrep.size(
    box, loads, cell_size=5, shell=0, boundary="whole", safety=3, steps=5, proof=False
)
print(part.struts.to_frame()["radius"].describe())

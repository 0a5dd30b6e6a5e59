# SPDX-License-Identifier: LGPL-2.1-or-later
"""A TPMS sheet by one's own formula, thicker below than above."""

import volfrep

cube = volfrep.block(
    (1, 1, 2), cell="Formula", wall_formula="sin(x)*cos(y) + sin(y)*cos(z) + sin(z)*cos(x)",
    cell_size=10, wall_thickness="1.6 - z / 25", resolution=12,
)  # fmt: skip
print(cube)
cube.save("sheet.stl")

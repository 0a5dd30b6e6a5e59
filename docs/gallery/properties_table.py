# SPDX-License-Identifier: LGPL-2.1-or-later
"""What three lattices do, as tables of pandas."""

import pandas

import volfrep

found = {cell: volfrep.properties(cell, 10, 0.8) for cell in ("BCC", "Octet", "Kelvin")}
table = pandas.concat({cell: one.to_frame() for cell, one in found.items()})
print(table.unstack()["value"][["relative_density", "E100", "zener"]])
table.to_csv("properties.csv")

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Stiffness over relative density of three cells, as a plot."""

import matplotlib.pyplot as plt

import volfrep

densities = [0.05, 0.1, 0.15, 0.2]
for cell in ("BCC", "Octet", "Kelvin"):
    cubes = [volfrep.properties(cell, 10, relative_density=density) for density in densities]
    plt.plot(densities, [cube.values["E100"] for cube in cubes], label=cell)
plt.xlabel("relative density")
plt.ylabel("E100 / E of the solid")
plt.legend()
plt.savefig("densities.png")

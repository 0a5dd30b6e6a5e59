# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the paper prints: Bacciaglia, Liverani and Ceruti, "Voxelization and one-dimensional lattice
structures for industrial components using function representation".

Their machine: Intel i9-14900F, 96 GB, MATLAB 2024b, trimesh 4.6.9. Lengths in mm.
"""

from __future__ import annotations

#: L and r of the block and of the bracket.
SIZE, RADIUS = 10.0, 1.0
#: Section 2.3: points along each direction of the grid that one cell is sampled on.
POINTS = 30
#: Points at which files come nearest to the printed sizes. An odd number would put a sample where
#: the joint spheres of FCC, Octet and Octahedron touch the grid's border, and open the mesh there.
COARSE = 16

#: Table 1: seconds and MB of a block of 10 x 10 x 10 cells, by tool.
TABLE_1: dict[str, dict[str, tuple[float, float]]] = {
    "VOLFREP as published": {"Box": (22.08, 55.17), "FCC": (41.43, 146.74), "CVC": (12.35, 101.41)},
    "McMillan": {"Box": (56.33, 28.63), "CVC": (204.0, 43.44)},
    "BRep (SolidWorks)": {"Box": (712.0, 33.02), "FCC": (657.0, 121.32), "CVC": (414.0, 61.75)},
    "CSG (LSWM)": {"Box": (52.81, 141.237)},
    "Volume Lattice (Blender)": {
        "Box": (93.12, 67.26),
        "FCC": (440.36, 191.21),
        "CVC": (303.31, 142.42),
    },
}
BLOCK = TABLE_1["VOLFREP as published"]

#: Table 2, the CVC block: area / max side mean and deviation, area deviation, inradius /
#: circumradius mean and deviation.
TABLE_2 = {
    "VOLFREP as published": (0.513, 0.127, 0.026, 0.800, 0.141),
    "BRep (SolidWorks)": (0.114, 0.187, 0.174, 0.188, 0.304),
    "McMillan": (0.037, 0.031, 0.122, 0.060, 0.049),
    "Volume Lattice (Blender)": (0.350, 0.159, 0.159, 0.563, 0.231),
}

#: Section 4: RMS distance of 2 x 2 x 2 BCC cells to the B-rep, at 30 points.
RMS = 0.15

#: Section 3.1 and Table 3: the GE bracket.
BRACKET_GRID, BRACKET_ACTIVE = (18, 7, 11), 618
BRACKET = {
    "Box": (231.0, 44.16),
    "BCC": (335.0, 104.71),
    "FCC": (363.0, 117.50),
    "Octet": (422.0, 150.57),
    "Octahedron": (277.0, 97.02),
    "CVC": (248.0, 78.52),
}
#: Section 4 on Fig. 11, CVC: whole job and replication, with voxelisation and without.
WITH_VOXELS, WITHOUT_VOXELS = (248.0, 3.04), (284.0, 15.40)
#: Section 3.1 on Fig. 12b: cells whose replication takes an hour, extrapolated.
CELLS_IN_AN_HOUR = 17_576

#: Section 3.3 and Table 4: the piston rod.
ROD_GRID, ROD_ACTIVE = (26, 14, 6), 867
ROD = {
    "Box": (164.0, 17.11),
    "BCC": (220.0, 41.16),
    "FCC": (252.0, 46.19),
    "Octet": (281.0, 48.24),
    "Octahedron": (162.0, 37.30),
    "CVC": (149.0, 29.68),
}

#: Section 2.4: the wing.
WING_GRID, WING_SHARE = (51, 7, 50), 0.723

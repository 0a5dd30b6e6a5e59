# SPDX-License-Identifier: LGPL-2.1-or-later
"""Octet's stiffness by Gmsh's own solids and curved second-order tetrahedra in CalculiX.

Nothing of it is ours but the radius: geometry, mesh and solution are Gmsh's and CalculiX's. An
octant of the cell is a tetrahedron of six half struts between four eighths of joints; its faces
are mirrors, which the stretched cell keeps.
"""

import re
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

from volfrep.design.cells import LIBRARY, joint_radius
from volfrep.fem import tet_mesh
from volfrep.fem.deck import write_tetrahedra
from volfrep.mechanics.density import radius_of_density
from volfrep.mechanics.homogenise import homogenise
from volfrep.mechanics.materials import Material
from volfrep.mechanics.tensor import cubic, moduli

pytestmark = [
    pytest.mark.slow,
    *(
        pytest.mark.skipif(shutil.which(name) is None, reason=f"{name} is not installed")
        for name in ("ccx", "gmsh")
    ),
]

#: Watts et al. (2019), see test_homogenise: E over the solid's at a density of 0.2.
PUBLISHED = 0.03652
_GEO = """SetFactory("OpenCASCADE");
p() = {0,0,0, .5,.5,0, .5,0,.5, 0,.5,.5};
k = 0;
For i In {0:3}
 k++; Sphere(k) = {p(3*i), p(3*i+1), p(3*i+2), %(joint).12g};
 For j In {i+1:3}
  k++; Cylinder(k) = {p(3*i), p(3*i+1), p(3*i+2),
   p(3*j)-p(3*i), p(3*j+1)-p(3*i+1), p(3*j+2)-p(3*i+2), %(radius).12g};
 EndFor
EndFor
BooleanUnion(100) = {Volume{1}; Delete;}{Volume{2:k}; Delete;};
Box(200) = {0,0,0,.5,.5,.5};
BooleanIntersection(300) = {Volume{100}; Delete;}{Volume{200}; Delete;};
Mesh.CharacteristicLengthMax = %(edge).12g;
Mesh.CharacteristicLengthMin = %(edge).12g / 3;
Mesh.ElementOrder = 2;
Mesh.Algorithm3D = 1;
Mesh.MshFileVersion = 2.2;
Physical Volume(1) = {300};
"""


def stiffness(radius: float, edge: float, folder: Path):
    """C11 and C12 over the solid's E, with elements of so long an edge, and the number of nodes."""
    figures = {"radius": radius, "joint": joint_radius(radius, 1.0), "edge": edge}
    (folder / "octant.geo").write_text(_GEO % figures)
    gmsh = ["gmsh", "octant.geo", "-3", "-o", "octant.msh", "-v", "1"]
    subprocess.run(gmsh, cwd=folder, check=True, capture_output=True)
    nodes, elements = tet_mesh._read((folder / "octant.msh").read_bytes())
    used, rows = np.unique(elements, return_inverse=True)
    # Gmsh orders the last two mid-edge nodes the other way round than solvers do.
    rows = rows.reshape(-1, 10)[:, [0, 1, 2, 3, 4, 5, 6, 7, 9, 8]]
    filled = tet_mesh.TetrahedralMesh(nodes[used], rows)
    deck = folder / "octant_stretched.inp"
    write_tetrahedra(filled, deck, Material("SOLID", 1.0, 0.3, 1.0))
    deck.write_text(
        deck.read_text() + "*STEP\n*STATIC\n*BOUNDARY\nXMIN,1,1\nYMIN,2,2\nZMIN,3,3\nYMAX,2,2\n"
        "ZMAX,3,3\nXMAX,1,1,0.5\n*NODE PRINT,NSET=XMAX,TOTALS=ONLY\nRF\n"
        "*NODE PRINT,NSET=YMAX,TOTALS=ONLY\nRF\n*END STEP\n"
    )
    subprocess.run(["ccx", "-i", deck.stem], cwd=folder, check=True, capture_output=True)
    printed = re.findall(r"total force.*?\n\n(.*?)\n", deck.with_suffix(".dat").read_text())
    along, across = (float(line.split()[axis]) / 0.25 for axis, line in enumerate(printed))
    return along, across, len(filled.nodes)


def test_octet_is_as_stiff_as_gmshs_tetrahedra_and_stiffer_than_the_published_cubic(tmp_path: Path):
    """Tetrahedra are too stiff, less so the smaller they are: ours lies just below them.

    They come down to 3.9 % above the published value with 33,000 nodes, where the last step
    brought 0.2 %: no smaller ones will reach it.
    """
    cell = LIBRARY["Octet"]
    radius = radius_of_density(cell, 0.2)
    tensor = homogenise(cell, radius, density=0.2).tensor
    ours = moduli(tensor).E100
    found = []
    for edge in (radius / 1.5, radius / 2.5):
        along, across, _ = stiffness(radius, edge, tmp_path)
        assert across == pytest.approx(tensor[0, 1], rel=0.02)
        young = moduli(cubic(along, across, tensor[3, 3])).E100
        found.append(young)
    assert ours < found[1] < found[0] < 1.015 * ours
    step = found[0] - found[1]
    assert found[1] - 3.0 * step > 1.025 * PUBLISHED

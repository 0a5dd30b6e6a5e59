# SPDX-License-Identifier: LGPL-2.1-or-later
"""A curved body as voxels of its surface, beside CalculiX's second-order bricks that follow it."""

import shutil
from itertools import product

import numpy as np
import pytest
from manifold3d import CrossSection, Manifold

from volfrep.fem.calculix import solve
from volfrep.jobs.solving import solve_solid
from volfrep.loads.load_cases import Force, LoadCase, LoadCases, Support
from volfrep.loads.regions import InPlane
from volfrep.mechanics.materials import SolidMaterial
from volfrep.mesh.booleans import as_mesh

SOLID = SolidMaterial("X", 1.0, 1000.0, 0.3)
DEEP = 9.0
#: Elements along the quarter of a ring, across and deep.
COUNT = (24, 3, 3)
#: VTK's and Abaqus' order of the twenty nodes of a brick, in half edges.
_CORNERS = [(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2)]
_EDGES = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6),
          (3, 7)]  # fmt: skip
BRICK = np.array([*_CORNERS, *((np.add(_CORNERS[a], _CORNERS[b]) // 2) for a, b in _EDGES)])


def at(along, across, deep):
    """Where a place of the quarter of a ring lies, of numbers from 0 to 1; it is thinner midway."""
    turn = 0.5 * np.pi * along
    radius = 30.0 + (across - 0.5) * (5.0 + 4.0 * np.cos(2.0 * turn) ** 2)
    return np.stack(
        [radius * np.cos(turn), radius * np.sin(turn), DEEP * (1.0 - deep) + 0.0 * turn], axis=-1
    )


def calculix_deck():
    """The lines of a deck, and (n,) how a force of 1 N along x shares out at the end on the y-axis.

    An even traction on a face of eight nodes is -1 at a corner and 4 at a middle, in twelfths.
    """
    size = 2 * np.array(COUNT) + 1
    stride = np.array([size[1] * size[2], size[2], 1])
    grid = np.stack(np.meshgrid(*(np.arange(n) for n in size), indexing="ij"), -1).reshape(-1, 3)
    end = np.zeros(len(grid))
    for place in product(range(COUNT[1]), range(COUNT[2])):
        for corner in product(range(3), repeat=2):
            if corner != (1, 1):
                row = np.array([size[0] - 1, *(2 * np.array(place) + corner)]) @ stride
                is_corner = not any(one % 2 for one in corner)
                end[row] += (-1 if is_corner else 4) / 12 / (COUNT[1] * COUNT[2])
    places = np.array(list(product(*(range(n) for n in COUNT))))
    used, elements = np.unique((2 * places[:, None] + BRICK) @ stride, return_inverse=True)
    grid, end = grid[used], end[used]
    lines = ["*NODE,NSET=ALL"]
    nodes = at(*(grid / (size - 1)).T)
    lines += [f"{k},{x:.9g},{y:.9g},{z:.9g}" for k, (x, y, z) in enumerate(nodes, 1)]
    lines.append("*ELEMENT,TYPE=C3D20,ELSET=ALL")
    for k, rows in enumerate(elements.reshape(-1, 20) + 1, 1):
        lines += [f"{k},{','.join(map(str, rows[:10]))},", ",".join(map(str, rows[10:]))]
    lines += ["*MATERIAL,NAME=X", "*ELASTIC", "1000,0.3", "*SOLID SECTION,ELSET=ALL,MATERIAL=X"]
    lines += ["*BOUNDARY", *(f"{row + 1},1,3" for row in np.flatnonzero(grid[:, 0] == 0))]
    lines += ["*STEP", "*STATIC", "*CLOAD"]
    lines += [f"{row + 1},1,{end[row]:.9g}" for row in np.flatnonzero(end)]
    return [*lines, "*NODE PRINT,NSET=ALL", "U", "*END STEP"], end


@pytest.mark.skipif(shutil.which("ccx") is None, reason="CalculiX (ccx) is not installed")
def test_a_curved_arm_moves_as_second_order_bricks_that_follow_it(tmp_path):
    lines, end = calculix_deck()
    (tmp_path / "arm.inp").write_text("\n".join(lines) + "\n", encoding="ascii")
    there = float(end @ solve(tmp_path / "arm.inp")[:, 0])
    along = np.linspace(0.0, 1.0, 97)
    outline = [at(along, 1.0, 0.0)[:, :2], at(along, 0.0, 0.0)[::-1, :2]]
    outline = np.concatenate(outline)
    outline[np.abs(outline) < 1e-9] = 0.0
    arm = as_mesh(Manifold.extrude(CrossSection([outline.tolist()]), DEEP))
    held = Support(InPlane((0.0, 0.0, 0.0), (0.0, 1.0, 0.0)))
    pull = Force(InPlane((0.0, 0.0, 0.0), (1.0, 0.0, 0.0)), (1.0, 0.0, 0.0))
    loads = LoadCases(SOLID, (LoadCase("pull", (held,), (pull,)),))
    case = solve_solid(arm, loads, voxel=1.0).report["cases"][0]
    print(
        "\nvoxels over CalculiX",
        case["compliance_nmm"] / there,
        case["extrapolated"]["compliance_nmm"] / there,
    )
    assert case["compliance_nmm"] == pytest.approx(there, rel=0.04)
    assert case["extrapolated"]["compliance_nmm"] == pytest.approx(there, rel=0.02)

# SPDX-License-Identifier: LGPL-2.1-or-later
"""How much stiffer sized lattices are than one radius: a cantilever, and two published cases.

With `-s` each prints its line of the tables in docs/sizing.md.
"""

import manifold3d
import numpy as np
import pytest
import trimesh

from volfrep import LatticeSpec
from volfrep.design.cells import PAPERS
from volfrep.io.solid import check_solid
from volfrep.jobs.infill import Infill
from volfrep.jobs.sizing import Goal, size
from volfrep.loads.load_cases import Force, LoadCase, LoadCases, Support
from volfrep.loads.regions import InBox, InPlane
from volfrep.mechanics.materials import find_material
from volfrep.mesh.booleans import as_mesh
from volfrep.mesh.triangle_mesh import TriangleMesh
from volfrep.sizing.analysis import Limits, analysed

WHOLE = {"cell_size": 10, "shell": 0, "boundary": "whole", "activation": "inside"}


def block(x, y, z):
    shape = trimesh.creation.box((x, y, z))
    shape.apply_translation((x / 2, y / 2, z / 2))
    return check_solid(TriangleMesh(shape.vertices, shape.faces.astype(np.int32)), "box")


def ell():
    """An L of 6 x 1 x 6 cells less 3 x 1 x 3."""
    outline = [(0, 0), (60, 0), (60, 30), (30, 30), (30, 60), (0, 60)]
    flat = manifold3d.Manifold.extrude(manifold3d.CrossSection([outline]), 10.0)
    return check_solid(as_mesh(flat.rotate((90, 0, 0)).translate((0, 10, 0))), "L")


def ell_case():
    """Held at its top, pushed down at its end."""
    top, end = InPlane((0, 0, 60), (0, 0, 1)), InPlane((60, 0, 0), (1, 0, 0))
    return LoadCase("down", (Support(top),), (Force(end, (0, 0, -10.0)),))


def bend_case():
    """Half of a three-point bend: a mirror at x = 0, a foot below the other end."""
    mirror = Support(InPlane((0, 0, 0), (1, 0, 0)), (0.0, None, None), (True, False, False))
    foot = Support(InBox((99, -1, -1), (101, 51, 1)), (None, 0.0, 0.0), (True, True, True))
    ridge = InBox((-1, -1, 49), (1, 51, 51))
    return LoadCase("bend", (mirror, foot), (Force(ridge, (0, 0, -100.0)),))


@pytest.mark.parametrize(
    ("name", "cell", "radius", "least", "published"),
    [
        ("L", "BCC", 0.95, 2.2, 2.60),
        ("L", "CVC", 1.28, 4.2, 2.60),
        pytest.param("bend", "BCC", 0.72, 2.6, 3.82, marks=pytest.mark.slow),
        pytest.param("bend", "CVC", 0.85, 12.0, 3.82, marks=pytest.mark.slow),
    ],
)
def test_published_cases_gain_as_much_as_told(name, cell, radius, least, published):
    solid, case = (ell(), ell_case()) if name == "L" else (block(100, 50, 50), bend_case())
    loads = LoadCases(find_material("PLA"), (case,))
    spec = LatticeSpec(cell, strut_radius=radius, **WHOLE)
    made = size(solid, spec, loads, Goal(radius_min=0.3 * radius), prove_it=False)
    gain = made.report["same_mass"]["stiffer"][0]
    density = made.sized.analysis.volume / solid.volume
    print(f"\n{name} {cell}: density {density:.3f}, {gain:.2f} times (published {published})")
    assert gain > least


@pytest.mark.slow
@pytest.mark.parametrize("cell", PAPERS)
def test_a_sized_cantilever_is_stiffer_than_one_radius_with_the_same_mesh_volume(cell):
    solid = block(120, 40, 40)
    wall, tip = InPlane((0, 0, 0), (1, 0, 0)), InPlane((120, 0, 0), (1, 0, 0))
    case = LoadCase("down", (Support(wall),), (Force(tip, (0, 0, -200.0)),))
    loads = LoadCases(find_material("Ti-6Al-4V"), (case,))
    spec = LatticeSpec(cell, strut_radius=0.6, **WHOLE)
    made = size(solid, spec, loads, Goal(radius_max=1.2), prove_it=False)
    volume = Infill(solid, made.spec).part.report.volume_mm3
    radius = float(made.before.radii.mean())
    for _ in range(3):  # one radius whose mesh has the same volume
        even = Infill(solid, LatticeSpec(cell, strut_radius=radius, **WHOLE)).part.report.volume_mm3
        if abs(even / volume - 1.0) < 5e-4:
            break
        radius *= (volume / even) ** 0.52
    assert even == pytest.approx(volume, rel=2e-3)
    problem = made.model.problem
    one, _ = analysed(problem, np.full(len(problem.low), radius), Limits())
    gain = float(one.compliance[0] / made.sized.analysis.compliance[0])
    print(f"\n{cell}: {made.report['struts']} struts, {gain:.2f} times, {volume:,.0f} mm3")
    assert gain > 1.5

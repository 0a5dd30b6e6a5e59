# SPDX-License-Identifier: LGPL-2.1-or-later
"""How much stiffer sized lattices are than one radius: a cantilever, and two published cases.

With `-s` each prints its line of the tables in docs/sizing.md.
"""

import contextlib
import shutil

import manifold3d
import numpy as np
import pytest

from bench.static_step import StaticStep
from samples import solid_block as block
from volfrep import LatticeSpec
from volfrep.design.cells import PAPERS
from volfrep.fem.calculix import solve
from volfrep.fem.deck import write_tetrahedra
from volfrep.fem.joint_loads import balls_of
from volfrep.fem.tet_mesh import filled_by_gmsh
from volfrep.io.solid import check_solid
from volfrep.jobs.infill import Infill
from volfrep.jobs.sizing import Goal, size
from volfrep.loads.load_cases import Force, LoadCase, LoadCases, Support
from volfrep.loads.regions import InBox, InPlane
from volfrep.mechanics.materials import find_material
from volfrep.mesh.booleans import as_manifold, as_mesh
from volfrep.reports.sizing_report import least_gain
from volfrep.sizing.analysis import Limits, analyse
from volfrep.util.errors import VolfrepError

WHOLE = {"cell_size": 10, "shell": 0, "boundary": "whole", "activation": "inside"}


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


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "cell", "radius", "least", "published"),
    [
        ("L", "BCC", 0.95, 2.2, 2.60),
        ("L", "CVC", 1.28, 3.4, 2.60),
        ("bend", "BCC", 0.72, 2.4, 3.82),
        ("bend", "CVC", 0.85, 9.9, 3.82),
    ],
)
def test_published_cases_gain_as_much_as_told(name, cell, radius, least, published):
    solid, case = (ell(), ell_case()) if name == "L" else (block(100, 50, 50), bend_case())
    loads = LoadCases(find_material("PLA"), (case,))
    spec = LatticeSpec(cell, strut_radius=radius, **WHOLE)
    made = size(solid, spec, loads, Goal(thinnest=0.3 * radius), prove_it=False)
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
    made = size(solid, spec, loads, Goal(thickest=1.2), prove_it=False)
    volume = Infill(solid, made.spec).part.report.volume_mm3
    radius = float(made.before.radii.mean())
    for _ in range(3):  # one radius whose mesh has the same volume
        even = Infill(solid, LatticeSpec(cell, strut_radius=radius, **WHOLE)).part.report.volume_mm3
        if abs(even / volume - 1.0) < 5e-4:
            break
        radius *= (volume / even) ** 0.52
    assert even == pytest.approx(volume, rel=2e-3)
    problem = made.model.problem
    one, _ = analyse(problem, np.full(len(problem.low), radius), Limits())
    gain = float(one.compliance[0] / made.sized.analysis.compliance[0])
    print(f"\n{cell}: {made.report['struts']} struts, {gain:.2f} times, {volume:,.0f} mm3")
    assert gain > 1.5


def solid_work(infill, shares, held, loaded, force, folder):
    """N mm of a force on joints of a lattice, others held: second-order tetrahedra of its mesh."""
    for tolerance in (0.03, 0.025, 0.02, 0.015, 0.01):
        body = as_mesh(as_manifold(infill.part.mesh).simplify(tolerance))
        with contextlib.suppress(VolfrepError):
            filled = filled_by_gmsh(body)
            break
    frame = infill.struts
    balls = balls_of(filled, frame, loaded)
    nodes = np.concatenate([ball.nodes for ball in balls])
    parts = np.concatenate([ball.shares * share for ball, share in zip(balls, shares, strict=True)])
    fixed = np.unique(np.concatenate([ball.nodes for ball in balls_of(filled, frame, held)]))
    deck = folder / "solid.inp"
    step = StaticStep(fixed, nodes, force, parts)
    write_tetrahedra(filled, deck, find_material("Ti-6Al-4V").for_solver())
    step.add_to(deck, of_beams=False)
    return float(parts @ solve(deck)[nodes] @ np.array(force))


@pytest.mark.skipif(
    shutil.which("ccx") is None or shutil.which("gmsh") is None,
    reason="CalculiX (ccx) or Gmsh is not installed",
)
@pytest.mark.slow
def test_solids_leave_as_much_of_a_gain_as_is_told(tmp_path):
    """Octahedron, of which solids leave the least: thick struts bend between thin ones."""
    cell, length, force = "Octahedron", 40.0, (0.0, 0.0, -200.0)
    solid = block(length, 20, 20)
    wall, tip = InPlane((0, 0, 0), (1, 0, 0)), InPlane((length, 0, 0), (1, 0, 0))
    case = LoadCase("down", (Support(wall),), (Force(tip, force),))
    loads = LoadCases(find_material("Ti-6Al-4V"), (case,))
    spec = LatticeSpec(cell, strut_radius=0.6, **WHOLE)
    made = size(solid, spec, loads, Goal(thickest=1.2), prove_it=False)
    infill, radius = Infill(solid, made.spec), float(made.before.radii.mean())
    volume = infill.part.report.volume_mm3
    for _ in range(4):  # one radius whose mesh has the same volume
        even = Infill(solid, LatticeSpec(cell, strut_radius=radius, **WHOLE))
        radius *= (volume / even.part.report.volume_mm3) ** 0.52
    assert even.part.report.volume_mm3 == pytest.approx(volume, rel=2e-3)
    works = []
    for each in (infill, even):
        along = each.struts.nodes[:, 0]
        held, loaded = (np.flatnonzero(np.abs(along - x) < 1e-6) for x in (0.0, length))
        shares = np.full(len(loaded), 1.0 / len(loaded))
        works.append(solid_work(each, shares, held, loaded, force, tmp_path))
    same = made.report["same_mass"]
    gain = works[1] / works[0]
    print(f"\n{cell}: {gain:.2f} times by solids, {same['stiffer'][0]:.2f} told")
    assert same["stiffer_at_least"][0] <= gain
    assert gain < same["stiffer"][0]


def test_the_least_that_solids_may_leave_of_a_gain():
    assert least_gain(4.0) == pytest.approx(3.0)
    assert least_gain(1.1) == 1.0
    assert least_gain(0.9) == 0.9, "a design that is worse is told as it is"

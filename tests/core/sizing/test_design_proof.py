# SPDX-License-Identifier: LGPL-2.1-or-later
"""A final design solved by CalculiX too: bare, and with its skin."""

import shutil
from types import SimpleNamespace

import numpy as np
import pytest
import trimesh

from volfrep import LatticeSpec
from volfrep.design.cells import PAPERS
from volfrep.io.solid import check_solid
from volfrep.jobs.sizing import Goal, size
from volfrep.loads.load_cases import Force, LoadCase, LoadCases, Support
from volfrep.loads.regions import InPlane
from volfrep.mechanics.materials import find_material
from volfrep.mesh.triangle_mesh import TriangleMesh
from volfrep.sizing.analysis import Limits
from volfrep.sizing.proof import Proved, doubts

needs_calculix = pytest.mark.skipif(
    shutil.which("ccx") is None, reason="CalculiX (ccx) is not installed"
)


def sized(limits: Limits, **more):
    shape = trimesh.creation.box((20, 10, 10))
    shape.apply_translation((10, 5, 5))
    solid = check_solid(TriangleMesh(shape.vertices, shape.faces.astype(np.int32)), "box")
    wall, tip = (InPlane((x, 0, 0), (1, 0, 0)) for x in (0.0, 20.0))
    case = LoadCase("down", (Support(wall),), (Force(tip, (0, 0, -50.0)),))
    loads = LoadCases(find_material("Ti-6Al-4V"), (case,))
    spec = LatticeSpec("CVC", **{"cell_size": 10, "strut_radius": 0.7, **more})
    return size(solid, spec, loads, Goal(limits), most_steps=8)


@needs_calculix
def test_a_bare_design_holds_its_limits_in_calculix():
    made = sized(Limits(stress=400.0), shell=0, boundary="whole", activation="centre")
    proof = made.report["calculix"]
    assert max(proof["displacements_off"]) < 0.015
    assert made.sized.analysis.uses["stress"] * proof["largest_stress"] < 1.01


@needs_calculix
@pytest.mark.slow
def test_a_design_with_a_skin_holds_its_limits_in_calculix():
    limits = Limits(stress=60.0, displacement=0.003, frequency=3000.0)
    made = sized(limits, shell=0.8, cell_size=5, strut_radius=0.4)
    proof, uses = made.report["calculix"], made.sized.analysis.uses
    assert proof["with_the_skin"]
    assert max(proof["displacements_off"]) < 0.15
    assert uses["stress"] * proof["largest_stress"] < 1.01
    assert uses["displacement"] * max(proof["largest_displacement"]) < 1.01
    assert uses["frequency"] / proof["lowest_frequency"] < 1.01


@pytest.mark.costly
@needs_calculix
def test_a_skin_of_wedges_moves_as_shells_do():
    made = sized(Limits(stress=400.0), shell=0.8)
    proof = made.report["calculix"]
    assert proof["with_the_skin"]
    assert max(proof["displacements_off"]) < 0.03
    assert proof["largest_stress"] == pytest.approx(1.0, abs=0.1)


@needs_calculix
def test_a_face_that_is_held_is_held_where_struts_stand_on_it_too():
    """Of the box's wedges only the struts' pads were free to move there: it moved by half more."""
    proof = sized(Limits(stress=400.0), shell=0.4).report["calculix"]
    assert max(proof["displacements_off"]) < 0.03
    assert proof["largest_displacement"] == pytest.approx([1.0], abs=0.02)


@needs_calculix
@pytest.mark.slow
@pytest.mark.parametrize("cell", PAPERS)
def test_a_pressed_column_buckles_in_calculix_no_sooner_than_it_is_sized_for(cell):
    shape = trimesh.creation.box((20, 20, 30))
    shape.apply_translation((10, 10, 15))
    solid = check_solid(TriangleMesh(shape.vertices, shape.faces.astype(np.int32)), "column")
    foot, top = (InPlane((0, 0, z), (0, 0, 1)) for z in (0.0, 30.0))
    case = LoadCase("pressed", (Support(foot),), (Force(top, (0, 0, -400.0)),))
    loads = LoadCases(find_material("Ti-6Al-4V"), (case,))
    spec = LatticeSpec(
        cell, cell_size=10, strut_radius=0.5, shell=0, boundary="whole", activation="inside"
    )
    made = size(solid, spec, loads, Goal(Limits(buckling=2.0), thinnest=0.1, thickest=1.2))
    assert made.sized.holds
    assert made.sized.analysis.factors[0] > 1.999
    assert made.report["calculix"]["buckling_factors"][0] > 0.99 * 2.0
    if cell != "CVC":  # whose struts bend under the load: CalculiX's rigid joints turn otherwise
        factor = made.report["calculix"]["buckling_factors"][0]
        assert made.sized.analysis.factors[0] == pytest.approx(factor, rel=0.03)


@needs_calculix
@pytest.mark.slow
def test_a_pressed_tube_buckles_with_its_skin_as_calculix_says():
    """A long one as a column; a short one by dimples of its skin between struts."""
    for size_of, shell, cell in (((160, 20, 14), 1.0, 14.0), ((40, 30, 30), 0.4, 15.0)):
        shape = trimesh.creation.box(size_of)
        shape.apply_translation(np.array(size_of) / 2.0)
        solid = check_solid(TriangleMesh(shape.vertices, shape.faces.astype(np.int32)), "tube")
        foot, top = (InPlane((x, 0, 0), (1, 0, 0)) for x in (0.0, float(size_of[0])))
        case = LoadCase("pressed", (Support(foot),), (Force(top, (-1000.0, 0, 0)),))
        loads = LoadCases(find_material("Ti-6Al-4V"), (case,))
        spec = LatticeSpec("CVC", cell_size=cell, strut_radius=0.5, shell=shell)
        goal = Goal(Limits(buckling=5.0), thinnest=0.5)
        made = size(solid, spec, loads, goal, most_steps=10)
        assert made.sized.holds
        there = made.report["calculix"]["buckling_factors"][0]
        assert made.sized.analysis.factors[0] == pytest.approx(there, rel=0.08)


def figures(**more):
    """What CalculiX says of a design that it confirms."""
    values = {
        "displacements_off": [0.02, 0.05], "largest_displacement": [1.01, 0.97],
        "largest_stress": 0.99, "struts_compared": 0.9, "worst_strut_compared": True,
    }  # fmt: skip
    return {**values, **more}


@pytest.mark.parametrize(
    ("more", "said"),
    [
        ({}, None),
        ({"displacements_off": [0.02, 0.88]}, "displacements differ by 88% in case 'two'"),
        ({"largest_displacement": [0.8, 1.0]}, "is 0.8 times the design's own"),
        ({"worst_strut_compared": False}, "too short to be compared, as are 10% of"),
        ({"largest_stress": 1.2}, "largest stress is 1.2 times the design's own"),
        ({"largest_stress": 0.7}, "own, so that the part may be heavier than it need be"),
        ({"displacements_off": [np.nan, 0.0]}, "displacements differ by nan"),
    ],
)
def test_why_a_design_is_not_confirmed(more, said):
    final = SimpleNamespace(uses={"stress": 1.0}, factors=np.full(2, np.nan))
    found = doubts(figures(**more), final, ["one", "two"])
    assert (found == []) if said is None else (said in found[0])


def test_a_stress_that_was_not_compared_is_no_use_of_the_limit():
    final = SimpleNamespace(uses={"stress": 2.1}, factors=np.full(1, np.nan))
    limits = Limits(stress=100.0)
    unknown = Proved(figures(worst_strut_compared=False, largest_stress=None), np.ones(1))
    assert "stress" not in unknown.uses(limits, final)
    some = Proved(figures(worst_strut_compared=False, largest_stress=0.9), np.ones(1))
    assert some.uses(limits, final)["stress"] == pytest.approx(0.9 * 2.1), "CalculiX's own figure"
    below = SimpleNamespace(uses={"stress": 1.0}, factors=final.factors)
    assert "stress" not in some.uses(limits, below)

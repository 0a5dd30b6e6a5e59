# SPDX-License-Identifier: LGPL-2.1-or-later
"""Along which of its axes a part is best built, once the struts that lie too flat are gone."""

from dataclasses import replace

import numpy as np
import pytest
import trimesh

from volfrep.design.spec import LatticeSpec
from volfrep.design.spec_parts import FlatStruts
from volfrep.jobs.infill import Infill
from volfrep.jobs.sizing import Building, Goal, building_of, size, solve_struts
from volfrep.jobs.sizing.directions import advice, along_directions, directed, steep_cells
from volfrep.loads.load_cases import Force, LoadCase, LoadCases, Support
from volfrep.loads.regions import InPlane
from volfrep.mechanics.materials import find_material
from volfrep.mesh.triangle_mesh import TriangleMesh
from volfrep.reports.printability import print_report
from volfrep.reports.processes import find_process
from volfrep.sizing.analysis import Limits
from volfrep.util.cache import StageCache

SPEC = LatticeSpec("FCC", cell_size=10, strut_radius=0.8, shell=0)
COARSE = replace(SPEC, cell_size=20)
LPBF = find_process("LPBF")


def beam(flare=1.0):
    """Of 40 x 20 x 20 mm; its upper side is so many times as wide."""
    box = trimesh.creation.box((40, 20, 20))
    vertices = np.array(box.vertices)
    vertices[vertices[:, 2] > 0.0, 1] *= flare
    return TriangleMesh(vertices, np.array(box.faces, np.int32))


def bent(force=-200.0):
    left, right = (InPlane((x, 0, 0), (1, 0, 0)) for x in (-20.0, 20.0))
    case = LoadCase("bend", (Support(left),), (Force(right, (0, 0, force)),))
    return LoadCases(find_material("Ti-6Al-4V"), (case,))


def goal(up=(0.0, 0.0, 1.0), is_free=False):
    return Goal(Limits(displacement=0.1), building=Building(LPBF, up, is_free))


def compared(solid, spec, wanted):
    cache = StageCache()
    return along_directions(
        solid, spec, wanted.building, lambda spec: solve_struts(solid, spec, bent(), cache=cache)[1]
    )


def test_a_beam_of_fcc_cells_is_best_built_along_itself():
    """Struts along the beam, which carry its bending, are upright then."""
    found = compared(beam(), SPEC, goal(is_free=True))
    assert [one.up for one in found] == [(1.0, 0.0, 0.0), (0.0, 0.0, 1.0), (0.0, 1.0, 0.0)]
    wanted, why = directed(goal(is_free=True), found)
    assert wanted.building == Building(LPBF, (1.0, 0.0, 0.0))
    assert why.startswith("Built along x, the best of the part's axes for its lattice without ")
    infill = Infill(beam(), replace(SPEC, flat_struts=FlatStruts(45.0)))
    (said,) = advice(goal(), infill, None, lambda: found, stays=False)
    times = found[1].work / found[0].work
    assert said.startswith("Built along x the lattice without flatter struts is ")
    assert f" {times:.2g} times as stiff for its volume: choose" in said
    assert advice(wanted, infill, found, list, stays=False) == []


@pytest.mark.costly
def test_a_free_direction_makes_the_lighter_design():
    free, across = (
        size(beam(), SPEC, bent(), goal(is_free=is_free), prove_it=False)
        for is_free in (True, False)
    )
    assert free.building == Building(LPBF, (1.0, 0.0, 0.0))
    assert free.report["building"]["build_direction"] == [1.0, 0.0, 0.0]
    assert free.sized.holds
    assert across.sized.holds
    assert free.sized.analysis.volume < 0.67 * across.sized.analysis.volume
    assert any("choose that build direction" in note for note in across.report["notes"])


def test_an_axis_is_taken_the_way_round_in_which_less_hangs_over():
    """Sides that flare by 30 mm over a height of 20 are flatter than 45 degrees."""
    found = compared(beam(flare=4.0), COARSE, goal(is_free=True))
    assert {one.up: one.hanging_mm2 for one in found}[0.0, 0.0, -1.0] == 0.0
    found = compared(beam(flare=4.0), COARSE, goal((0.0, 0.0, 2.0)))
    sides = 2 * 40.0 * np.hypot(20.0, 30.0)
    assert {one.up: one.hanging_mm2 for one in found}[0.0, 0.0, 2.0] == pytest.approx(sides)


@pytest.mark.costly
def test_flat_struts_that_are_bridged_go_only_where_the_design_is_lighter_without():
    """Of FCC cells of 10 mm none is longer than FFF bridges."""
    spec, fff = replace(SPEC, strut_radius=1.2), Building(find_process("FFF"))
    for force, is_light in ((-20.0, True), (-2000.0, False)):
        limit = Limits(displacement=0.1)
        wanted = Goal(limit, building=fff)
        part, every = (
            size(beam(), spec, bent(force), goal, most_steps=4, prove_it=False)
            for goal in (wanted, Goal(limit, thinnest=1.0))
        )
        assert (part.report["building"]["removed"] > 0) == is_light
        assert (part.sized.analysis.volume < 0.99 * every.sized.analysis.volume) == is_light
        assert part.report["building"]["notes"] == []
        checked = print_report(beam(), part.model.wireframe, fff.process)
        assert checked.overhanging_share == 0.0


def test_a_cell_that_carries_along_no_axis_is_to_be_another_one():
    """Upright edges alone have free ends; FCCz has its upright faces' diagonals at 45 degrees."""
    spec = replace(SPEC, cell="Box")
    found = compared(beam(), spec, goal())
    assert found == []
    (said,) = advice(goal(), Infill(beam(), spec), found, list, stays=True)
    assert said.endswith("choose another one, such as FCCz with its z upwards.")
    assert [one.up for one in compared(beam(), replace(SPEC, cell="FCCz"), goal())] != []


def test_cells_are_steep_by_their_flattest_strut():
    assert steep_cells(45.0) == ["FCCz"]
    assert {"CVC", "BCCz", "Diamond"} <= set(steep_cells(35.2))
    assert not {"CVC", "BCCz", "Diamond"} & set(steep_cells(35.3))


def test_a_direction_is_free_where_nobody_asks_for_one():
    assert building_of("LPBF", None, SPEC).is_free
    assert building_of("lpbf", (0.0, 0.0, 1.0), SPEC) == Building(LPBF)
    lying = replace(SPEC, flat_struts=FlatStruts(30.0, (0.0, 1.0, 0.0)))
    assert building_of("LPBF", None, lying) == Building(LPBF, (0.0, 1.0, 0.0))

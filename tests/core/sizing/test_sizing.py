# SPDX-License-Identifier: LGPL-2.1-or-later
"""Radii at nodes: volume, bounds, derivatives, and designs that are better than one radius."""

from dataclasses import replace

import numpy as np
import pytest
import trimesh

from volfrep import LatticeSpec
from volfrep.design.cells import LIBRARY, PAPERS
from volfrep.fem.model import Case
from volfrep.grid.strut_graph import Graph
from volfrep.jobs.blocks import block, block_wireframe
from volfrep.jobs.sizing import radius_field
from volfrep.mechanics.catalogue import joint_law
from volfrep.mechanics.frame import SQUARE_SECTION
from volfrep.mesh.triangle_mesh import TriangleMesh
from volfrep.sizing import optimise
from volfrep.sizing.analysis import Limits, Problem, analyse
from volfrep.sizing.node_radii import (
    NodeRadii,
    largest_radii,
    smoothing,
    whole_struts,
)
from volfrep.sizing.optimise import HOLDS, cheapest, lightest, stiffest, thicken, uniform
from volfrep.sizing.proof import SHARED, Proved, correct_problem
from volfrep.sizing.structure import Structure
from volfrep.sizing.tapered_beams import Elastic, beams_of, end_table
from volfrep.sizing.union_volume import union_volume
from volfrep.util.errors import VolfrepError

TITANIUM = Elastic(110_000.0, 0.34, 4.41e-9)
WAYS = ((0.0, 0.0, -1.0), (0.0, 1.0, 0.0), (1.0, 0.0, 0.0))


def cantilever(cell="CVC", count=(6, 2, 2), radius=0.6, cases=1, size=10.0):
    """A block clamped at x = 0 and loaded at its other end, and its radius at every node."""
    frame = block_wireframe(LatticeSpec(cell, cell_size=size, strut_radius=radius), count)
    nodes, struts = frame.nodes, frame.struts.astype(np.int64)
    low = np.full(len(nodes), 0.5 * radius)
    high = largest_radii(nodes, struts, 2.0 * radius)
    ends = end_table(joint_law(LIBRARY[cell], size, "square"), low.min(), high.max())
    beams = beams_of(nodes, struts, TITANIUM, section=SQUARE_SECTION, ends=ends)
    held = np.repeat(nodes[:, :1] < 1e-6, 6, axis=1)
    tip = nodes[:, 0] > size * count[0] - 1e-6
    loads = np.zeros((cases, len(nodes), 6))
    for k, way in enumerate(WAYS[:cases]):
        loads[k, tip, :3] = 200.0 * np.array(way) / tip.sum()
    filled = union_volume(frame, size, low, high)
    shape = NodeRadii(whole_struts(struts, len(nodes)), filled)
    problem = Problem(
        Structure(nodes, beams), tuple(Case(held, load) for load in loads), shape, low, high,
        np.ones(len(nodes), bool),
    )  # fmt: skip
    return problem, np.full(len(nodes), radius)


@pytest.mark.costly
@pytest.mark.slow_but("CVC")
@pytest.mark.parametrize("cell", PAPERS)
def test_struts_and_joints_have_the_volume_of_their_mesh(cell):
    """Of thick joints whose struts thin away from them, and the reverse."""
    frame = block_wireframe(LatticeSpec(cell, cell_size=10.0, strut_radius=0.5), (2, 1, 1))
    high = largest_radii(frame.nodes, frame.struts.astype(np.int64), 1.5)
    low = np.full(len(high), 0.4)
    filled = union_volume(frame, 10.0, low, high)
    for radii in (np.where(np.arange(len(high)) % 3 == 0, high, 0.5), np.minimum(0.8, high)):
        field = radius_field(frame.nodes, radii)
        spec = LatticeSpec(cell, cell_size=10.0, radius_grading=field, deviation=0.01)
        made = block(spec, (2, 1, 1)).report.volume_mm3
        assert filled.at(radii) == pytest.approx(made, rel=3e-3)


def test_struts_count_as_far_as_they_lie_inside():
    """A cone that a box cuts lengthwise, and the whole of it with its balls: closed forms."""
    graph = Graph(np.array([[0.0, 0, 0], [10, 0, 0]]), np.array([[0, 1]], np.int32))
    radii = np.array([1.0, 2.0])
    box = trimesh.creation.box((8.0, 6.0, 6.0))
    box.apply_translation((4.0 + 1e-5, 3.0 - 1e-5, 0.1))
    half = TriangleMesh(np.array(box.vertices), np.array(box.faces).astype(np.int32))
    filled = union_volume(graph, 1e9, 0.9 * radii, 1.1 * radii, half)
    part = np.pi / 6.0 * 8.0 * (1.0 + 1.8 + 1.8**2)
    assert filled.at(radii) == pytest.approx(part, rel=1e-3)
    apart = union_volume(graph, 1e9, 0.9 * radii, 1.1 * radii)
    # Half a ball behind each end; the larger one is a little wider than the cone before it, by
    # 2 pi 2 times the integral of 0.1 z - z2 / 4.
    whole = np.pi / 3.0 * 10.0 * 7.0 + 2.0 / 3.0 * np.pi * 9.0 + 0.0335
    assert apart.at(radii) == pytest.approx(whole, rel=5e-4)


def test_the_volume_changes_with_the_radii_as_told():
    """Also where a wall cuts the struts."""
    problem, radii = cantilever("Octet", (2, 1, 1))
    random = np.random.default_rng(3)
    radii = problem.low + random.random(len(radii)) * (problem.high - problem.low)
    box = trimesh.creation.box((17.0, 9.0, 8.0))
    box.apply_translation((9.3, 4.9, 5.2))
    wall = TriangleMesh(np.array(box.vertices), np.array(box.faces).astype(np.int32))
    frame = block_wireframe(LatticeSpec("Octet", cell_size=10.0, strut_radius=0.6), (2, 1, 1))
    way = random.normal(size=len(radii))
    for domain in (None, wall):
        filled = union_volume(frame, 10.0, problem.low, problem.high, domain)
        change = (filled.at(radii + 1e-7 * way) - filled.at(radii - 1e-7 * way)) / 2e-7
        assert filled.change(radii) @ way == pytest.approx(change, rel=1e-6)
    shape = problem.radii
    aim = 1.1 * shape.volume(radii)
    scaled = shape.scaled_to(radii, aim, problem.low, problem.high)
    assert shape.volume(scaled) == pytest.approx(aim)
    least = shape.scaled_to(radii, 1e-3 * aim, problem.low, problem.high)
    assert least == pytest.approx(problem.low)


def test_struts_part_before_their_middles_at_the_largest_radius():
    """At a right angle they part at r from the node; at 60 degrees at r / tan 30."""
    nodes = np.array([[0, 0, 0], [10, 0, 0], [0, 10, 0]], float)
    pair = np.array([[0, 1], [0, 2]])
    square = largest_radii(nodes, pair, 99.0)[0]
    assert 0.8 * 5.0 < square < 5.0
    nodes[2] = 10 * np.array([0.5, np.sqrt(0.75), 0])
    sixty = largest_radii(nodes, pair, 99.0)[0]
    assert 0.8 * 5.0 < sixty / np.tan(np.radians(30)) < 5.0
    assert largest_radii(nodes, pair, 1.0)[0] == 1.0


@pytest.mark.slow_but("CVC")
@pytest.mark.parametrize("cell", PAPERS)
def test_a_lattice_whose_radii_jump_between_their_bounds_has_a_mesh(cell):
    frame = block_wireframe(LatticeSpec(cell, cell_size=10.0, strut_radius=0.5), (2, 1, 1))
    high = largest_radii(frame.nodes, frame.struts.astype(np.int64), 2.5)
    radii = np.where(np.arange(len(high)) % 3 == 0, 0.4, high)
    spec = LatticeSpec(cell, cell_size=10.0, radius_grading=radius_field(frame.nodes, radii))
    made = block(spec, (2, 1, 1))
    assert made.report.watertight
    assert made.report.bodies == 1


def test_derivatives_are_those_of_differences():
    problem, radii = cantilever(count=(4, 2, 2), cases=3)
    heavy = replace(problem.cases[1], acceleration=(2e8, -3e8, 1e8))
    problem = replace(problem, cases=(problem.cases[0], heavy, problem.cases[2]))
    radii = radii * (1.0 + 0.3 * np.sin(np.arange(len(radii))) ** 2)
    limits = Limits(stress=100.0, displacement=1.0, frequency=100.0, frame_buckling=1.0)
    found, changes = analyse(problem, radii, limits, with_changes=True)
    step = np.zeros(len(radii))
    step[23] = 1e-4
    high, low = (analyse(problem, radii + sign * step, limits)[0] for sign in (1, -1))
    assert changes.compliance[23] == pytest.approx(
        (high.compliance - low.compliance) / 2e-4, rel=1e-4
    )
    worst = int(np.argmax(changes.displacement_uses))
    assert changes.displacement_uses[worst] == pytest.approx(found.uses["displacement"])
    assert changes.displacement[23, worst] == pytest.approx(
        (high.uses["displacement"] - low.uses["displacement"]) / 2e-4, rel=1e-3
    )
    assert changes.frequency[23] == pytest.approx(
        (high.uses["frequency"] - low.uses["frequency"]) / 2e-4, rel=1e-3
    )
    first = int(np.argmax(changes.frame_uses))
    assert changes.frame_uses[first] == pytest.approx(found.uses["frame buckling"])
    assert changes.frame_buckling[23, first] == pytest.approx(
        (high.uses["frame buckling"] - low.uses["frame buckling"]) / 2e-4, rel=1e-2
    )


@pytest.mark.costly
@pytest.mark.slow_but("Box")
@pytest.mark.parametrize("cell", PAPERS)
def test_a_sized_cantilever_is_much_stiffer_than_an_even_one_of_its_volume(cell):
    problem, radii = cantilever(cell)
    even, _ = analyse(problem, radii, Limits())
    made = stiffest(problem, even.volume, radii)
    assert made.analysis.volume == pytest.approx(even.volume, rel=1e-3)
    assert (made.analysis.radii >= problem.low - 1e-12).all()
    assert (made.analysis.radii <= problem.high + 1e-12).all()
    assert even.compliance[0] > 1.4 * made.analysis.compliance[0]


@pytest.mark.costly
def test_the_lightest_design_holds_its_limits_and_saves_mass():
    problem, radii = cantilever(cases=2)
    even, _ = analyse(problem, radii, Limits(stress=1.0, displacement=1.0))
    limits = Limits(
        stress=float(even.stress.max()), displacement=even.uses["displacement"], buckling=2.0
    )
    made = lightest(problem, limits, radii, most_steps=30)
    one, holds = uniform(problem, limits)
    assert made.holds
    assert holds
    assert made.analysis.most_used <= HOLDS
    assert one.most_used <= HOLDS
    assert one.volume == pytest.approx(even.volume, rel=0.01)
    assert made.analysis.volume < 0.8 * one.volume


@pytest.mark.slow
def test_nodes_that_move_alike_are_all_held():
    """A block pulled along: its whole end moves by the limit, and one radius is far from least."""
    problem, radii = cantilever("BCC", (3, 2, 2), radius=1.0)
    nodes, case = problem.structure.nodes, problem.cases[0]
    tip = nodes[:, 0] > nodes[:, 0].max() - 1e-6
    loads = np.zeros_like(case.loads)
    loads[tip, 0] = 2000.0 / tip.sum()
    problem = replace(problem, cases=(replace(case, loads=loads),))
    even, _ = analyse(problem, radii, Limits(displacement=1.0))
    made = lightest(problem, Limits(displacement=even.uses["displacement"]), radii)
    assert made.holds
    assert made.stopped == "converged"
    assert made.analysis.volume < 0.9 * even.volume


def test_a_frequency_is_reached_with_less_mass():
    problem, radii = cantilever(count=(4, 1, 1))
    swings, _ = problem.structure.modes(problem.radii.of_struts(radii), problem.cases[0].fixed, 1)
    made = lightest(problem, Limits(frequency=float(swings[0])), radii, most_steps=20)
    assert made.holds
    assert made.analysis.frequency >= swings[0] * (1 - 2e-3)
    assert made.analysis.volume < 0.8 * problem.radii.volume(radii)


def test_a_search_ends_where_all_radii_are_the_least():
    """A skin that carries everything leaves nothing to be sized."""
    problem, radii = cantilever(count=(3, 1, 1))
    low = np.full(len(radii), 0.7 * radii.min())
    problem = replace(problem, low=low)
    thin, _ = analyse(problem, low, Limits(stress=1.0))
    made = lightest(problem, Limits(stress=100.0 * thin.most_used), radii)
    assert made.holds
    assert made.stopped == "converged"
    assert len(made.steps) < 6
    assert made.analysis.radii == pytest.approx(low)


def test_limits_that_cannot_be_held_are_told():
    problem, radii = cantilever(count=(3, 1, 1))
    made = lightest(problem, Limits(stress=1.0), radii, most_steps=4)
    assert not made.holds
    with pytest.raises(VolfrepError, match="needs a limit"):
        lightest(problem, Limits(), radii)
    case = problem.cases[0]
    pushed = replace(case, loads=0.0 * case.loads, prescribed=np.where(case.fixed, 0.1, 0.0))
    with pytest.raises(VolfrepError, match="has none"):
        stiffest(replace(problem, cases=(pushed,)), 300.0, radii)
    with pytest.raises(VolfrepError, match="cannot be reached"):
        stiffest(problem, 1e9, radii)
    with pytest.raises(VolfrepError, match="above 0"):
        Limits(stress=-1.0)


def test_a_search_whose_designs_stay_the_same_ends(monkeypatch):
    """Of a part that all but its thinnest struts bear, it is as light as after many more steps."""
    problem, start = cantilever("BCC", count=(3, 1, 1))
    bare = analyse(problem, problem.low, Limits(stress=1.0))[0]
    limits = Limits(stress=0.9 * bare.uses["stress"])
    short = lightest(problem, limits, start)
    monkeypatch.setattr(optimise, "_STILL", -1.0)
    long = lightest(problem, limits, start)
    assert short.stopped == long.stopped == "converged"
    assert (short.holds, long.holds) == (True, True)
    assert len(short.steps) < optimise._FEWEST < len(long.steps)
    assert short.analysis.volume == pytest.approx(long.analysis.volume, rel=1e-4)


@pytest.mark.costly
def test_a_search_that_is_stopped_keeps_the_best_so_far():
    problem, radii = cantilever()
    volume = problem.radii.volume(radii)
    made = stiffest(problem, volume, radii, watch=lambda number, _: number < 3)
    assert made.stopped == "cancelled"
    assert len(made.steps) == 4
    assert made.analysis.compliance[0] == pytest.approx(
        min(step.compliance for step in made.steps) * made.steps[0].compliance
        * analyse(problem, radii, Limits())[0].compliance[0]
    )  # fmt: skip


def test_smoothing_keeps_what_is_even_and_lessens_steps():
    struts = np.array([[0, 1], [1, 2], [2, 3]])
    mean = smoothing(struts, 4, 0.5)
    assert mean @ np.ones(4) == pytest.approx(1.0)
    assert (mean @ np.array([1.0, 0, 0, 0])).tolist() == [0.5, 0.25, 0, 0]


def test_prices_of_shared_limits_give_the_least_cost():
    """Two bars in a row, compliance 1 / r^3 each: equal radii of least cost."""
    radii = np.array([1.0, 1.5])
    uses = np.array([(radii**-3).sum()])
    changes = -3.0 * (radii**-4)[:, None]
    low, high = 0.3 * radii, 3.0 * radii
    found = cheapest(radii, np.ones(2), uses, changes, low, high)
    assert found == pytest.approx([2 ** (1 / 3)] * 2, rel=1e-3)


def test_a_design_is_corrected_where_calculix_finds_more():
    problem, radii = cantilever(count=(2, 1, 1))
    asked = Limits(stress=100.0, displacement=2.0, frequency=50.0)
    own = analyse(problem, radii, asked)[0]
    limits = Limits(own.stress.max(), own.largest[0] / 0.9, frequency=own.frequency)
    final = analyse(problem, radii, limits)[0]
    felt = np.ones(len(own.stress))
    felt[own.worst["stress"][1]] = 1.25
    proof = Proved(
        {
            "largest_stress": 1.25,
            "largest_displacement": [1.05],
            "lowest_frequency": 0.8,
            "worst_strut_compared": True,
        },
        felt,
    )
    assert proof.uses(limits, final) == pytest.approx(
        {"stress": 1.25, "displacement": 0.945, "frequency": 1.25}
    )
    assert not proof.holds(limits, final)
    there, stricter = correct_problem(problem, limits, final, proof)
    assert stricter.frequency == pytest.approx(1.25 * limits.frequency)
    assert stricter.stress == pytest.approx(SHARED * limits.stress)
    assert stricter.displacement == limits.displacement
    assert analyse(there, radii, limits)[0].uses["stress"] == pytest.approx(1.25)
    # No strut becomes thinner, and the limits are held by struts as stressed as CalculiX says.
    thicker, holds = thicken(there, Limits(stress=limits.stress), radii)
    assert holds
    assert (thicker.radii >= radii).all()
    assert thicker.radii.max() > radii.max()
    assert thicker.uses["stress"] <= 1.0
    # What cannot be held is left as it is, but for the struts that are asked for.
    most, holds = thicken(there, Limits(stress=1e-3 * limits.stress), radii)
    assert not holds
    assert (most.radii <= problem.high).all()

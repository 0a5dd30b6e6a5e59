# SPDX-License-Identifier: LGPL-2.1-or-later
"""A part's struts solved as they are, and a search for radii that is cancelled."""

import pickle
from dataclasses import replace

import numpy as np
import pytest
import trimesh

from volfrep.design.grading import RadiusGrading
from volfrep.design.profile import Profile
from volfrep.design.spec import LatticeSpec
from volfrep.jobs.infill import Infill
from volfrep.jobs.sizing import Goal, part_model, size, solve_struts
from volfrep.loads.load_cases import Force, LoadCase, LoadCases, Support
from volfrep.loads.regions import InPlane
from volfrep.mechanics.materials import find_material
from volfrep.mesh.triangle_mesh import TriangleMesh
from volfrep.sizing.analysis import Limits
from volfrep.sizing.strut_state import strut_states
from volfrep.util.cache import StageCache
from volfrep.util.errors import Cancelled

SPEC = LatticeSpec("BCC", cell_size=10, strut_radius=0.8, shell=0)


def beam():
    box = trimesh.creation.box((40, 20, 20))
    return TriangleMesh(np.array(box.vertices), np.array(box.faces, np.int32))


def bent(force=-200.0):
    left, right = (InPlane((x, 0, 0), (1, 0, 0)) for x in (-20.0, 20.0))
    case = LoadCase("bend", (Support(left),), (Force(right, (0, 0, force)),))
    return LoadCases(find_material("Ti-6Al-4V"), (case,))


@pytest.mark.costly
def test_what_is_solved_is_what_was_designed():
    goal = Goal(limits=Limits(displacement=0.3), thinnest=0.3, thickest=1.6)
    part = size(beam(), SPEC, bent(), goal, prove_it=False)
    assert part.sized.holds
    model, analysis = solve_struts(beam(), part.spec, bent())
    assert analysis.largest == pytest.approx(part.sized.analysis.largest, rel=5e-4)
    (state,) = strut_states(model.problem, analysis)
    assert state.stress.max() == pytest.approx(part.sized.analysis.stress.max(), rel=5e-4)
    # Twice the force, twice the displacement.
    _, doubled = solve_struts(beam(), part.spec, bent(-400.0))
    assert doubled.largest == pytest.approx(2.0 * analysis.largest)


def test_a_skin_begins_with_what_was_made_of_the_same_part(monkeypatch):
    spec, cache = replace(SPEC, shell=1.0, cell_size=20), StageCache()
    infill = Infill(beam(), spec, cache=cache)
    first = part_model.part_model(infill, bent(), Goal(), cache)

    def refuse(*_):
        raise AssertionError("made again")

    monkeypatch.setattr(part_model, "begun_surface", refuse)
    second = part_model.part_model(infill, bent(), Goal(), cache)
    assert first.skin is not None
    assert second.skin is not None
    np.testing.assert_array_equal(second.skin.middle, first.skin.middle)


@pytest.mark.slow
@pytest.mark.parametrize("shell", [0.0, 1.0])
def test_a_design_can_be_sent_to_another_process(shell):
    goal = Goal(limits=Limits(displacement=0.3), thinnest=0.3, thickest=1.6)
    wanted = replace(SPEC, shell=shell)
    part = size(beam(), wanted, bent(), goal, prove_it=False)
    there = pickle.loads(pickle.dumps(part))
    for here, sent in zip(
        part.states,
        strut_states(there.model.problem, there.sized.analysis),
        strict=True,
    ):
        np.testing.assert_array_equal(sent.stress, here.stress)
    model, analysis = pickle.loads(pickle.dumps(solve_struts(beam(), part.spec, bent())))
    assert strut_states(model.problem, analysis)
    steps = pickle.loads(pickle.dumps(part.sized.steps))
    assert len(steps) == len(part.sized.steps)


@pytest.mark.costly
def test_a_cancelled_search_keeps_the_best_and_asks_no_other_solver():
    asked = []

    def progress(fraction, stage):
        asked.append(stage)
        return asked.count("sizing") < 5

    goal = Goal(limits=Limits(displacement=0.3), thinnest=0.3, thickest=1.6)
    part = size(beam(), SPEC, bent(), goal, progress=progress)
    assert part.sized.stopped == "cancelled"
    assert 1 <= len(part.sized.steps) < 5
    assert part.sized.analysis.uses["displacement"] <= 1.001
    assert "proof" not in asked


def test_a_search_that_is_cancelled_before_it_began_has_nothing():
    with pytest.raises(Cancelled):
        size(beam(), SPEC, bent(), progress=lambda fraction, stage: False)


@pytest.mark.slow
def test_a_graded_lattice_ends_at_the_wall_where_the_one_of_its_own_radius_does():
    """A design, whose radii have changed since, is solved as it was sized."""
    tube = trimesh.creation.cylinder(17.0, 40.0, sections=48)
    tube.apply_transform(trimesh.transformations.rotation_matrix(np.pi / 2, (0, 1, 0)))
    solid = TriangleMesh(np.array(tube.vertices), np.array(tube.faces, np.int32))
    plain = LatticeSpec("CVC", cell_size=10, strut_radius=1.0, shell=0)
    graded = replace(plain, radius_grading=RadiusGrading("direction", Profile("linear", 0.5, 2.0)))
    ends = [len(Infill(solid, spec).axes.wireframe.struts) for spec in (plain, graded)]
    assert ends[0] != ends[1], "thinner struts end elsewhere"
    one, other = (
        solve_struts(solid, spec, bent())[0].problem.structure for spec in (plain, graded)
    )
    assert other.nodes == pytest.approx(one.nodes)
    assert (other.beams.struts == one.beams.struts).all()

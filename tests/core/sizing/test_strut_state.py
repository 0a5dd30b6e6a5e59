# SPDX-License-Identifier: LGPL-2.1-or-later
"""The state of struts under each load case."""

from dataclasses import replace

import numpy as np
import pytest

from volfrep.fem.model import Case
from volfrep.grid.strut_graph import Graph
from volfrep.jobs.sizing.governing import governing
from volfrep.sizing.analysis import Limits, Problem, analyse
from volfrep.sizing.node_radii import NodeRadii, whole_struts
from volfrep.sizing.structure import Structure
from volfrep.sizing.strut_state import drawn_factor, strut_states, value_range
from volfrep.sizing.tapered_beams import Elastic, beams_of
from volfrep.sizing.union_volume import union_volume

YOUNG, LENGTH, RADIUS = 2000.0, 100.0, 2.0
AREA, INERTIA = np.pi * RADIUS**2, 0.25 * np.pi * RADIUS**4


def rod():
    """Two struts along x, held at one end: pushed, then bent."""
    nodes = np.array([[0, 0, 0], [0.5 * LENGTH, 0, 0], [LENGTH, 0, 0]])
    struts = np.array([[0, 1], [1, 2]])
    held = np.zeros((3, 6), bool)
    held[0] = True
    loads = np.zeros((2, 3, 6))
    loads[0, 2, 0], loads[1, 2, 2] = -30.0, 6.0
    cases = tuple(
        Case(held, load, name=name) for name, load in zip(("push", "bend"), loads, strict=True)
    )
    low = np.full(3, 0.1)
    filled = union_volume(Graph(nodes, struts), LENGTH, low, 100 * low)
    radii = NodeRadii(whole_struts(struts, 3), filled)
    structure = Structure(nodes, beams_of(nodes, struts, Elastic(YOUNG)))
    return Problem(structure, cases, radii, low, 100 * low, np.ones(3, bool))


@pytest.fixture(scope="module")
def states():
    """Of the rod in both cases."""
    problem = rod()
    return strut_states(problem, analyse(problem, np.full(3, RADIUS), Limits())[0])


def test_a_rod_says_what_the_closed_forms_say(states):
    push, bend = states
    assert [state.name for state in states] == ["push", "bend"]
    assert push.radii.tolist() == [[RADIUS, RADIUS], [RADIUS, RADIUS]]
    assert push.stress == pytest.approx(np.full((2, 2), 30.0 / AREA))
    assert push.displacement[:, 1] == pytest.approx(30 * LENGTH / YOUNG / AREA * np.array([0.5, 1]))
    assert push.displacements[1, 1, 0] < 0
    moment = 6.0 * LENGTH * np.array([[1, 0.5], [0.5, 0]])
    shear = np.sqrt(3.0) * 4.0 / 3.0 * 6.0 / AREA
    assert bend.stress == pytest.approx(np.maximum(moment * RADIUS / INERTIA, shear))
    assert (bend.buckling[:, 0] == bend.buckling[:, 1]).all()
    assert push.buckling.min() > 0
    assert bend.buckling.max() < 1e-9


def test_what_governs_the_struts_of_the_rod():
    problem, radii = rod(), np.full(3, RADIUS)
    bent = 6.0 * LENGTH * RADIUS / INERTIA  # at the held end; half of it in the middle

    def found(problem=problem, **limits):
        limits = Limits(**limits)
        governed = governing(problem, analyse(problem, radii, limits)[0], limits)
        assert sum(row["struts"] for row in governed.of_struts()) == 2
        return [governed.names[k] for k in governed.rows]

    # The second strut has half the stress, and shares its thicker end with the first.
    assert found(stress=bent) == [("stress", "bend")] * 2
    assert found(stress=1.2 * bent) == [("one radius for all", "")] * 2
    moved = 6.0 * LENGTH**3 / (3.0 * YOUNG * INERTIA)
    assert found(stress=2.0 * bent, displacement=1.005 * moved)[1] == ("displacement", "bend")
    # Ends that are as thin as they may be.
    thin = replace(problem, low=np.array([0.1, RADIUS, RADIUS]))
    assert found(thin, stress=bent) == [("stress", "bend"), ("smallest radius", "")]
    assert found() == [("stiffness", "")] * 2
    # All brought to a limit by one factor: what was as thin as it may be is a little thicker.
    thin = replace(problem, low=np.full(3, RADIUS / 1.03))
    assert found(thin, stress=1.2 * bent) == [("smallest radius", "")] * 2
    # Not used, and thicker than it may be.
    radii[2] *= 1.5
    assert found(stress=1.3 * bent) == [("thickened with others", "")] * 2


def test_all_cases_have_one_scale_and_one_enlargement(states):
    assert value_range(states, "radii") == (RADIUS, RADIUS)
    low, high = value_range(states, "stress")
    assert (low, high) == (0.0, max(state.stress.max() for state in states))
    factor = drawn_factor(states)
    most = max(state.displacement.max() for state in states)
    assert 0.02 * LENGTH <= factor * most <= 0.0501 * LENGTH
    assert f"{factor:e}"[0] in "125"

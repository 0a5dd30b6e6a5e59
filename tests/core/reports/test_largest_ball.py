# SPDX-License-Identifier: LGPL-2.1-or-later
"""The largest ball that gets out of a lattice, against windows in closed form."""

from dataclasses import replace

import numpy as np
import pytest

from volfrep.design.cells import UnitCell, find_cell
from volfrep.design.grading import CellMap
from volfrep.design.graphs import RandomGraph
from volfrep.design.spec import LatticeSpec
from volfrep.jobs.kinds import lattice_kind
from volfrep.reports.largest_ball import largest_ball

#: Radii of the circles within the windows' axes, in units of L: a square of L, a triangle of
#: L / sqrt(2) (the Octet's and the FCC's faces are halved by their diagonals).
WINDOWS = {"Box": 0.5, "Octet": 0.5**0.5 / (2.0 * 3.0**0.5)}


@pytest.mark.costly
@pytest.mark.slow_but("Box-0.16")
@pytest.mark.parametrize("ratio", [0.06, 0.16])
@pytest.mark.parametrize("name", WINDOWS)
def test_a_window_lets_its_inscribed_circle_through(name, ratio):
    expected = 2.0 * (WINDOWS[name] - ratio)
    assert largest_ball(find_cell(name), ratio) == pytest.approx(expected, abs=2e-3)


@pytest.mark.slow
def test_the_octets_window_is_narrower_than_its_struts_are_apart():
    """L = 10, r = 1.6: 0.88 mm between struts that meet, where those that do not leave 1.8."""
    assert 10.0 * largest_ball(find_cell("Octet"), 0.16) == pytest.approx(0.88, abs=0.01)


@pytest.mark.slow
def test_nothing_passes_a_wall_of_struts():
    places = np.linspace(0.0, 1.0, 6)
    nodes = [(x, y, 0.5) for x in places for y in places]
    struts = [(6 * i + j, 6 * i + j + 1) for i in range(6) for j in range(5)]
    walled = UnitCell("Wall", nodes, struts)
    through = largest_ball(walled, 0.12)  # struts 0.2 apart overlap: only beside the wall
    assert through == pytest.approx(2.0 * (0.5 - 0.12), abs=0.01)
    shut = [*nodes, *((x, 0.5, z) for x in places for z in places),
            *((0.5, x, z) for x in places for z in places)]  # fmt: skip
    rows = [(36 * k + 6 * i + j, 36 * k + 6 * i + j + 1)
            for k in range(3) for i in range(6) for j in range(5)]  # fmt: skip
    assert largest_ball(UnitCell("Shut", shut, rows), 0.12) == 0.0


@pytest.mark.slow
def test_of_windows_that_differ_nothing_is_told():
    equal = LatticeSpec("Box", 10.0, 1.0)
    assert lattice_kind(equal).largest_ball() == pytest.approx(8.0)
    graded = replace(equal, cell_map=CellMap("spherical"))
    network = replace(equal, network=RandomGraph(points=20))
    assert lattice_kind(graded).largest_ball() is None
    assert lattice_kind(network).largest_ball() is None

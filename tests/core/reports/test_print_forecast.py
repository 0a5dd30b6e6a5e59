# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a printer minds, told of the preview, against the print report of the mesh."""

import numpy as np
import pytest

import samples
from volfrep.design.cells import LIBRARY, find_cell
from volfrep.design.grading import Orientation, RadiusGrading
from volfrep.design.graphs import RandomGraph
from volfrep.design.openings import DrainHoles, OpenPlane
from volfrep.design.profile import Profile
from volfrep.design.spec import LatticeSpec
from volfrep.grid.strut_graph import Wireframe, cell_graph
from volfrep.jobs.infill import Infill
from volfrep.jobs.preview import PartDepth, preview
from volfrep.reports.clearance import WIDEST_GAP, endless_gap, narrowest_gap
from volfrep.reports.printability import print_forecast, print_report
from volfrep.reports.processes import find_process
from volfrep.util.errors import VolfrepError

BOX = samples.box((40.0, 30.0, 20.0))


def told(spec, process="LPBF", up=(0.0, 0.0, 1.0)):
    shown = preview(BOX, spec, PartDepth(BOX, spec.open_faces))
    struts = shown.start, shown.end, shown.radii
    return print_forecast(spec, struts, (BOX.volume, shown.volume), find_process(process), up)


@pytest.mark.costly
@pytest.mark.slow_cases("FCC")
@pytest.mark.parametrize("cell", ["CVC", "FCC"])
def test_it_tells_what_the_report_finds(cell):
    spec = LatticeSpec(cell=cell, cell_size=10.0, strut_radius=0.5, shell=2.0, density=2.0)
    infill = Infill(BOX, spec)
    mesh = infill.part.mesh
    process = find_process("LPBF")
    found = print_report(mesh, infill.struts, process, density=2.0, domain=infill.domain.mesh)
    forecast = told(spec)
    assert forecast.thinnest_strut_mm == pytest.approx(found.thinnest_strut_mm)
    assert forecast.overhanging_share == pytest.approx(found.overhanging_share, abs=0.03)
    assert forecast.longest_flat_mm == pytest.approx(found.longest_bridge_mm, abs=0.5)
    assert forecast.mass_g == pytest.approx(found.mass_g, rel=0.03)
    assert found.voids == 1
    assert forecast.void_mm3 == pytest.approx(found.void_volume_mm3, rel=0.03)
    assert forecast.saved_g == pytest.approx(2.0 * found.void_volume_mm3 / 1000.0, rel=0.03)
    assert forecast.saved_share == pytest.approx(1.0 - mesh.volume / BOX.volume, abs=0.02)


def test_the_gap_of_a_network_is_not_that_of_a_cell():
    forecast = told(LatticeSpec(network=RandomGraph(points=20), strut_radius=0.5, shell=2.0))
    assert (forecast.narrowest_gap_mm, forecast.is_gap_known) == (None, False)


@pytest.mark.parametrize("cell", sorted(LIBRARY))
def test_two_cells_a_side_have_every_gap_of_an_endless_lattice(cell):
    ratio = 0.05
    graph = cell_graph(find_cell(cell), np.ones((3, 3, 3), bool), 1.0, np.zeros(3))
    count = len(graph.struts)
    joints = np.full(len(graph.nodes), ratio * (1.0 + ratio))
    lattice = Wireframe(graph.nodes, graph.struts, np.full((count, 2), ratio), joints)
    found = narrowest_gap(lattice, np.arange(count), WIDEST_GAP)
    assert endless_gap(find_cell(cell), ratio) == (
        None if found is None else pytest.approx(found[0], rel=1e-9)
    )


@pytest.mark.slow
def test_what_is_open_holds_nothing():
    lattice = {"cell": "CVC", "cell_size": 10.0, "strut_radius": 1.0}
    assert told(LatticeSpec(**lattice, shell=2.0)).void_mm3 > 0.0
    assert told(LatticeSpec(**lattice, shell=0.0)).void_mm3 == 0.0
    top = OpenPlane((0.0, 0.0, 20.0), (0.0, 0.0, 1.0))
    assert told(LatticeSpec(**lattice, shell=2.0, open_faces=(top,))).void_mm3 == 0.0
    drains = DrainHoles(4.0, count=1)
    assert told(LatticeSpec(**lattice, shell=2.0, drains=drains)).void_mm3 == 0.0


@pytest.mark.slow
def test_gaps_that_differ_are_not_told():
    even = LatticeSpec(cell="Cross", cell_size=10.0, strut_radius=1.0)
    assert told(even).narrowest_gap_mm == pytest.approx(2.8)
    graded = LatticeSpec(
        cell="Cross",
        cell_size=10.0,
        radius_grading=RadiusGrading("direction", Profile("linear", 0.5, 1.0)),
    )
    assert (told(graded).narrowest_gap_mm, told(graded).is_gap_known) == (None, False)
    turned = LatticeSpec(cell="Cross", cell_size=10.0, orientation=Orientation(angle=30.0))
    assert told(turned).is_gap_known


def test_overhangs_go_by_the_build_direction():
    spec = LatticeSpec(cell="Columns", cell_size=10.0, strut_radius=1.0, shell=0.0)
    assert told(spec).overhanging_share == 0.0
    lying = told(spec, up=(1.0, 0.0, 0.0))
    assert lying.overhanging_share == pytest.approx(1.0)
    assert lying.longest_flat_mm > 0.0
    with pytest.raises(VolfrepError, match="build direction"):
        told(spec, up=(0.0, 0.0, 0.0))


@pytest.mark.slow_but("None")
@pytest.mark.parametrize("grading", [None, RadiusGrading("skin", Profile("linear", 0.6, 1.2))])
def test_walls_have_no_struts_to_tell_of(grading):
    spec = LatticeSpec(cell="Gyroid", cell_size=10.0, shell=2.0, radius_grading=grading)
    forecast = told(spec)
    assert forecast.thinnest_strut_mm is None
    assert (forecast.narrowest_gap_mm, forecast.is_gap_known) == (None, False)
    assert 0.0 < forecast.saved_share < 1.0

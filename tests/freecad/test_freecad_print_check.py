# SPDX-License-Identifier: LGPL-2.1-or-later
"""The print check: the facets of the infill that hang over, and its figures."""

import json

import FreeCAD as App
import pytest

from conftest import SMALL
from freecad_volfrep import make_lattice_infill, make_print_check
from freecad_volfrep.features.properties.quantities import mass_of
from volfrep.design.cells import find_cell
from volfrep.reports.largest_ball import largest_ball
from volfrep.util.errors import VolfrepError


@pytest.fixture
def check(doc, infill):
    """A computed print check."""
    obj = make_print_check(doc, infill)
    doc.recompute()
    assert obj.isValid(), obj.getStatusString()
    return obj


def test_its_mesh_is_what_hangs_over(infill, check):
    facets = check.Mesh.Facets
    assert 0 < len(facets) < 0.5 * infill.Mesh.CountFacets
    assert check.Mesh.Area == pytest.approx(check.OverhangArea.Value, rel=1e-4)
    whole = {tuple(map(tuple, facet.Points)) for facet in infill.Mesh.Facets}
    for facet in facets:
        assert facet.Normal.z < -0.7
        assert max(point[2] for point in facet.Points) > 0  # the underside lies on the plate
        assert tuple(map(tuple, facet.Points)) in whole
    # The roof over the cavity, less the struts that carry it, and the struts' undersides.
    assert check.Mesh.Area > 26 * 16 - 60


@pytest.mark.costly
def test_figures(infill, check):
    report = json.loads(check.Report)
    assert "closed voids" in check.Text
    assert report["process"]["name"] == check.Process == "FFF"
    assert check.ThinnestStrut == pytest.approx(2.0)
    assert mass_of(check) == pytest.approx(mass_of(infill), rel=1e-4)
    ball = SMALL["CellSize"] * largest_ball(find_cell("CVC"), 0.1)
    assert report["largest_ball_mm"] == pytest.approx(ball)
    assert check.LargestBall == f"{ball:.3g} mm"
    assert check.OverhangShare == 100  # the struts of CVC rise at 35 degrees
    assert check.Voids == 1
    assert check.VoidVolume.Value == pytest.approx(12000 - infill.Volume.Value, rel=1e-4)
    assert len(check.Findings) == 1
    assert "45 degrees" in check.Findings[0]
    assert "Hubs" in check.Limits


@pytest.mark.slow
def test_a_graded_lattice_has_no_largest_ball(doc, infill, check):
    infill.CellMap = "Spherical"
    doc.recompute()
    assert check.isValid(), check.getStatusString()
    assert check.LargestBall == "differs from cell to cell"


@pytest.mark.costly
def test_another_process_and_direction(doc, check):
    check.BuildDirection = App.Vector(0, 0, -1)
    doc.recompute()
    assert all(facet.Normal.z > 0.7 for facet in check.Mesh.Facets)
    check.Process = "SLS"
    doc.recompute()
    assert check.isValid()
    assert check.Mesh.CountFacets == 0
    assert "unused material" in check.Findings[0]


@pytest.mark.costly
def test_it_follows_the_infill(doc, infill, check):
    area = check.OverhangArea.Value
    infill.CellSize = 15
    infill.StrutRadius = 0.75
    doc.recompute()
    assert check.isValid()
    assert check.ThinnestStrut == pytest.approx(1.5)
    assert check.Mesh.Area == pytest.approx(check.OverhangArea.Value, rel=1e-4) != area


@pytest.mark.slow
def test_it_lies_where_the_infill_does(doc, infill, check):
    part = doc.addObject("App::Part", "Holder")
    part.addObject(infill)
    part.Placement.Base = App.Vector(0, 0, 9)
    infill.Placement = App.Placement(App.Vector(0, 0, 50), App.Rotation(App.Vector(1, 0, 0), 90))
    doc.recompute()
    assert check.isValid()
    # Upright in the part from -9 to 11, the infill is turned to lie from 59 to 79: its underside,
    # at -9, now looks along -y, and what hangs over is the roof that was a wall, and struts.
    assert check.OverhangShare == 100
    assert all(facet.Normal.z < -0.7 for facet in check.Mesh.Facets)
    assert check.Mesh.BoundBox.ZMax == pytest.approx(77, abs=0.05)
    assert check.Mesh.BoundBox.YMin > -11
    assert check.Mesh.BoundBox.YMax < 9


@pytest.mark.costly
def test_saved_and_opened(doc, check, tmp_path):
    path = str(tmp_path / "check.FCStd")
    count, name = check.Mesh.CountFacets, check.Name
    doc.saveCopy(path)
    again = App.openDocument(path)
    try:
        found = again.getObject(name)
        assert "Up-to-date" in found.State
        assert found.Mesh.CountFacets == count
        found.BuildDirection = App.Vector(1, 0, 0)
        again.recompute()  # with nothing in the cache
        assert found.isValid(), found.getStatusString()
        assert found.Mesh.CountFacets not in (0, count)
    finally:
        App.closeDocument(again.Name)


def test_what_it_refuses(doc, box, infill):
    with pytest.raises(VolfrepError, match="not a lattice infill"):
        make_print_check(doc, box)
    with pytest.raises(VolfrepError, match="no process"):
        make_print_check(doc, infill, "CNC")
    with pytest.raises(VolfrepError, match="direction"):
        make_print_check(doc, infill, build_direction=(0, 0, 0))
    assert [obj.Name for obj in doc.Objects] == [box.Name, infill.Name]


@pytest.mark.costly
def test_what_it_cannot_look_at(doc, infill, check):
    check.BuildDirection = App.Vector(0, 0, 0)
    doc.recompute()
    assert not check.isValid()
    check.BuildDirection = App.Vector(0, 0, 1)
    infill.Output = "Domain"
    doc.recompute()
    assert "no lattice" in check.getStatusString()
    check.Infill = None
    doc.recompute()
    assert "choose a lattice infill" in check.getStatusString()


@pytest.mark.slow
def test_an_infill_that_is_out_of_date(doc, box):
    infill = make_lattice_infill(doc, box, AutoUpdate=False, **SMALL)
    infill.Proxy.update(infill)
    check = make_print_check(doc, infill)
    doc.recompute()
    assert check.isValid()
    infill.CellSize = 8
    doc.recompute()
    assert "out of date: update it first" in check.getStatusString()
    infill.Proxy.update(infill)
    assert check.isValid()

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Sized radii: an ordinary graded lattice that the document keeps."""

import FreeCAD as App
import numpy as np
import pytest

from conftest import SMALL
from freecad_volfrep import make_lattice_infill
from freecad_volfrep.features.infill.sized_radii import store_radii
from volfrep.jobs.infill import Infill

THIN = {**SMALL, "CellType": "BCC", "StrutRadius": 0.8, "ShellThickness": 1.0}


@pytest.fixture
def infill(doc, box):
    obj = make_lattice_infill(doc, box, **THIN)
    doc.recompute()
    assert obj.isValid(), obj.Status
    return obj


def struts_of(obj):
    solid, spec, cache = obj.Proxy.inputs(obj)
    return Infill(solid, spec, cache=cache).struts


def sized(obj):
    """Give every node a radius of its own, by its place; returns nodes and radii."""
    nodes = struts_of(obj).nodes
    radii = 0.5 + 0.7 * (0.5 + 0.5 * np.sin(nodes @ [0.31, 0.17, 0.23]))
    store_radii(obj, nodes, radii)
    obj.Document.recompute()
    assert obj.isValid(), obj.Status
    return nodes, radii


def digest(obj):
    return obj.Mesh.CountFacets, round(obj.Mesh.Volume, 3), round(obj.Mesh.Area, 3)


@pytest.mark.costly
def test_every_node_gets_the_radius_that_was_stored(infill):
    uniform = digest(infill)
    nodes, radii = sized(infill)
    frame = struts_of(infill)
    assert frame.nodes == pytest.approx(nodes)
    of_nodes = np.zeros(len(nodes))
    of_nodes[frame.struts] = frame.radii
    assert of_nodes == pytest.approx(radii, abs=1e-6)
    assert digest(infill) != uniform
    assert infill.RadiusGrading == "Field"
    assert f"{len(radii)} points of Size Lattice" in infill.Report


@pytest.mark.costly
def test_they_are_saved_opened_and_undone(doc, infill, runs, tmp_path):
    uniform = digest(infill)
    doc.openTransaction("Size Lattice")
    sized(infill)
    doc.commitTransaction()
    made = digest(infill)
    path = str(tmp_path / "sized.FCStd")
    doc.saveCopy(path)
    copy = App.openDocument(path)
    try:
        again = copy.getObject(infill.Name)
        assert digest(again) == made
        runs.clear()
        again.touch()
        copy.recompute()
        assert again.isValid(), again.Status
        assert runs == [], "nothing has changed"
    finally:
        App.closeDocument(copy.Name)
    App.setActiveDocument(doc.Name)
    doc.undo()
    doc.recompute()
    assert digest(infill) == uniform
    assert infill.SizedRadii == []
    doc.redo()
    doc.recompute()
    assert digest(infill) == made


@pytest.mark.slow
def test_radii_go_along_with_a_base_that_moves(doc, box, infill):
    sized(infill)
    before = digest(infill)
    box.Placement.Base = App.Vector(40, -7, 3)
    doc.recompute()
    assert infill.isValid(), infill.Status
    assert infill.Mesh.BoundBox.XMin == pytest.approx(40)
    assert infill.Mesh.Volume == pytest.approx(before[1], rel=1e-3)


def test_one_radius_for_all_is_no_grading(doc, infill):
    nodes = struts_of(infill).nodes
    store_radii(infill, nodes, np.full(len(nodes), 0.65))
    doc.recompute()
    assert (infill.RadiusGrading, infill.StrutRadius.Value) == ("None", 0.65)
    assert infill.StrutRadii == pytest.approx([0.65, 0.65])


@pytest.mark.slow
def test_a_file_goes_before_them(doc, infill, tmp_path):
    sized(infill)
    table = tmp_path / "radii.csv"
    table.write_text("x,y,z,r\n0,0,0,0.5\n30,0,0,1.2\n")
    infill.RadiusField = str(table)
    doc.recompute()
    assert "2 points of" in infill.Report
    infill.RadiusField = ""
    doc.recompute()
    assert "points of Size Lattice" in infill.Report

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Graded lattice infills: their properties, what they make, and FEM results that drive them."""

import Fem
import FreeCAD as App
import numpy as np
import ObjectsFem
import pytest

from conftest import SMALL
from freecad_volfrep import make_lattice_infill
from freecad_volfrep.bridge.fem_fields import field_of_result
from freecad_volfrep.features.infill.lattice_infill import UP_TO_DATE
from freecad_volfrep.features.infill.properties import PROPERTIES
from volfrep.design.parameters.table import CUSTOM_CELL, PARAMETERS
from volfrep.util.errors import VolfrepError

THIN = {**SMALL, "StrutRadius": 0.7, "ShellThickness": 1.5}
GROUPS = ("Cell size", "Strut radius", "Cell map", "Orientation")
GRADING = {
    name
    for one in PARAMETERS
    if one.group in GROUPS and one.in_freecad
    for name in (
        one.switch_name if one.switch else "",
        "" if one.position_of else one.property_name,
    )
} & {prop.name for prop in PROPERTIES}
#: What is shown where nothing is graded.
CHOOSERS = {"SizeGrading", "RadiusGrading", "CellMap", "Orientation"}


def shown(obj):
    return {name for name in GRADING if "Hidden" not in obj.getEditorMode(name)}


def digest(obj):
    return obj.Mesh.CountFacets, round(obj.Mesh.Volume, 3), round(obj.Mesh.Area, 3)


def about(axis, degrees, point=(0, 0, 0)):
    return App.Placement(App.Vector(*point), App.Rotation(App.Vector(*axis), degrees))


def test_the_editor_begins_with_what_is_used_most_and_each_group_is_short_enough_to_read(doc, box):
    obj = make_lattice_infill(doc, box, **SMALL)
    seen = [p.group for p in PROPERTIES if "Hidden" not in obj.getEditorMode(p.name)]
    assert sorted(set(seen)) == [
        "1 Lattice", "2 Skin", "3 Grading", "4 Print", "5 Result", "6 Advanced"
    ]  # fmt: skip
    rarely_set = {"5 Result", "6 Advanced"}
    assert max(seen.count(group) for group in set(seen) - rarely_set) <= 12


@pytest.mark.parametrize(
    ("values", "more"),
    [
        ({}, set()),
        (
            {"SizeGrading": "Linear"},
            {"LambdaStart", "LambdaEnd", "GradingDirection", "KeepRadius"},
        ),
        ({"SizeGrading": "Scalar"}, {"LambdaStart", "GradingDirection", "KeepRadius"}),
        ({"SizeGrading": "Formula"}, {"LambdaFormula", "GradingDirection", "KeepRadius"}),
        (
            {"RadiusGrading": "Direction"},
            {"RadiusProfile", "RadiusStart", "RadiusEnd", "RadiusDirection", "RemoveBelow"},
        ),
        (
            {"RadiusGrading": "Core", "RadiusProfile": "Formula"},
            {"RadiusProfile", "RadiusFormula", "RadiusReach", "RemoveBelow"},
        ),
        (
            {"RadiusGrading": "Field", "RadiusCurve": "0:1, 1:2"},
            {"RadiusField", "RadiusResult", "RadiusColumn", "RadiusCurve", "RemoveBelow"},
        ),
        (
            {"CellMap": "Spherical", "UseMapCentre": True},
            {"MapAxis", "MapAround", "UseMapCentre", "MapCentre", "KeepRadius"},
        ),
        ({"Orientation": about((0, 0, 1), 10)}, {"UseRotationOrigin"}),
    ],
)
def test_only_what_applies_is_shown(doc, box, values, more):
    obj = make_lattice_infill(doc, box, **SMALL)
    assert shown(obj) == CHOOSERS
    for name, value in values.items():
        setattr(obj, name, value)
    assert shown(obj) == CHOOSERS | more
    for name in values:
        default = {p.name: p.default for p in PROPERTIES}[name]
        setattr(obj, name, App.Placement() if name == "Orientation" else default)
    assert shown(obj) == CHOOSERS


def test_the_file_of_a_cell_is_shown_with_a_cell_of_ones_own(doc, box):
    obj = make_lattice_infill(doc, box, **SMALL)
    assert "Hidden" in obj.getEditorMode("CellFile")
    obj.CellType = CUSTOM_CELL
    assert "Hidden" not in obj.getEditorMode("CellFile")
    obj.CellType = "BCC"
    assert "Hidden" in obj.getEditorMode("CellFile")


@pytest.mark.costly_cases("values2-edges2-radii2")
@pytest.mark.slow_but("values2-edges2-radii2", "values7-None-None")
@pytest.mark.parametrize(
    ("values", "edges", "radii"),
    [
        ({"SizeGrading": "Linear", "LambdaEnd": 1.5}, (10, 20), (0.7, 0.7)),
        (
            {"SizeGrading": "Formula", "LambdaFormula": "1 + 0.5 * s", "KeepRadius": False},
            (10, 20),
            None,
        ),
        ({"RadiusGrading": "Direction", "RadiusEnd": 1.1}, (10, 10), (0.7, 1.1)),
        ({"RadiusGrading": "Direction", "RadiusProfile": "Formula"}, (10, 10), (0.8, 1.2)),
        ({"RadiusGrading": "Skin", "RadiusEnd": 1, "RadiusReach": 8}, (10, 10), (0.7, 1)),
        ({"RadiusGrading": "Core", "RadiusStart": 1, "RadiusReach": 8}, (10, 10), (0.7, 1)),
        ({"Orientation": about((1, 0, 0), 30)}, (10, 10), (0.7, 0.7)),
        ({"CellMap": "Cylindrical", "MapAround": 9, "MapAxis": App.Vector(1, 0, 0)}, None, None),
    ],
)
def test_each_grading_makes_one_closed_solid(doc, box, values, edges, radii):
    obj = make_lattice_infill(doc, box, **THIN, **values)
    doc.recompute()
    assert obj.isValid(), obj.Status
    assert obj.Status == UP_TO_DATE
    assert obj.Mesh.isSolid()
    assert (obj.Bodies, obj.Watertight) == (1, True)
    for found, expected in ((obj.CellEdges, edges), (obj.StrutRadii, radii)):
        if expected is not None:
            assert expected[0] - 1e-6 <= found[0] <= found[1] <= expected[1] + 1e-6
    assert obj.StrutLengths[0] > 0
    plain = make_lattice_infill(doc, box, **THIN)
    doc.recompute()
    assert digest(obj) != digest(plain)


def test_the_direction_is_that_of_the_property(doc, box):
    obj = make_lattice_infill(
        doc, box, **THIN, RadiusGrading="Direction", RadiusEnd=1.1, Output="Lattice"
    )
    obj.RadiusDirection = App.Vector(0, 0, -1)
    doc.recompute()
    facets = np.array([[facet.Points[0][2], facet.Area] for facet in obj.Mesh.Facets])
    low = facets[facets[:, 0] < 10, 1].sum()
    assert low > 1.1 * facets[facets[:, 0] > 10, 1].sum()


def result_of(doc, values, placement=None):
    """A FEM result with these values of the von Mises stress at six points, numbered oddly."""
    points = [(0, 0, 0), (0, 20, 0), (0, 0, 20), (30, 0, 0), (30, 20, 0), (30, 0, 20)]
    mesh = Fem.FemMesh()
    for number, point in zip((40, 7, 12, 3, 99, 5), points, strict=True):
        mesh.addNode(*point, number)
    for corners in ((40, 3, 7, 12), (3, 99, 7, 12), (3, 99, 12, 5)):
        mesh.addVolume(list(corners))
    holder = doc.addObject("Fem::FemMeshObject", "ResultMesh")
    holder.FemMesh = mesh
    if placement is not None:
        holder.Placement = placement
    result = ObjectsFem.makeResultMechanical(doc, "CCX_Results")
    result.Mesh = holder
    result.NodeNumbers = [40, 7, 12, 3, 99, 5]
    result.vonMises = values
    return result


STRESS = [10.0, 10.0, 10.0, 80.0, 80.0, 80.0]


@pytest.mark.costly
def test_a_fem_result_drives_the_radius(doc, box):
    result = result_of(doc, STRESS)
    obj = make_lattice_infill(
        doc, box, **THIN, RadiusGrading="Field", RadiusResult=result, RadiusEnd=1.1
    )
    doc.recompute()
    assert obj.isValid(), obj.Status
    assert obj.StrutRadii[0] == pytest.approx(0.7, abs=0.05)
    assert obj.StrutRadii[1] == pytest.approx(1.1, abs=0.05)
    assert "6 points of CCX_Results, vonMises" in obj.Report
    before, volume = digest(obj), obj.Volume.Value
    result.vonMises = [10.0, 80.0, 80.0, 80.0, 80.0, 80.0]
    doc.recompute()
    assert obj.isValid(), obj.Status
    assert digest(obj) != before
    assert obj.Volume.Value > volume
    obj.RadiusCurve = "0:0.6, 100:0.9"
    doc.recompute()
    assert 0.6 < obj.StrutRadii[0] < obj.StrutRadii[1] < 0.9


def test_values_belong_to_the_nodes_of_their_numbers(doc):
    result = result_of(doc, STRESS)
    field = field_of_result(result, "", App.Placement())
    assert field([[0, 20, 0], [30, 0, 20]]) == pytest.approx([10, 80])
    result.NodeNumbers = [3, 99, 5, 40, 7, 12]
    field = field_of_result(result, "vonMises", App.Placement())
    assert field([[0, 20, 0], [30, 0, 20]]) == pytest.approx([80, 10])


def test_the_field_lies_where_its_mesh_does_seen_from_the_object(doc):
    turned = App.Placement(App.Vector(100, 0, 0), App.Rotation(App.Vector(0, 0, 1), 90))
    result = result_of(doc, STRESS, turned)
    group = doc.addObject("App::Part", "Group")
    group.Placement = App.Placement(App.Vector(0, 50, 0), App.Rotation())
    doc.recompute()
    field = field_of_result(result, "vonMises", App.Placement())
    assert field([[100, 30, 0], [80, 0, 0]]) == pytest.approx([80, 10])
    field = field_of_result(result, "vonMises", group.Placement)
    assert field([[100, -20, 0], [80, -50, 0]]) == pytest.approx([80, 10])
    group.addObject(result.Mesh)
    field = field_of_result(result, "vonMises", group.Placement)
    assert field([[100, 30, 0], [80, 0, 0]]) == pytest.approx([80, 10])


def test_results_that_are_no_field_are_refused(doc, box):
    result = result_of(doc, STRESS)
    for quantity in ("Temperature", "Stats", "DisplacementVectors"):
        with pytest.raises(VolfrepError, match=f"no number '{quantity}'.*choose vonMises"):
            field_of_result(result, quantity, App.Placement())
    result.vonMises = []
    with pytest.raises(VolfrepError, match=r"no number 'vonMises'.*run the solver\."):
        field_of_result(result, "", App.Placement())
    result.vonMises = STRESS
    result.NodeNumbers = [40, 7, 12, 3, 99, 6]
    with pytest.raises(VolfrepError, match="values at node 6, which its mesh"):
        field_of_result(result, "", App.Placement())
    result.NodeNumbers = []
    with pytest.raises(VolfrepError, match="is empty: run the solver"):
        field_of_result(result, "", App.Placement())
    with pytest.raises(VolfrepError, match="is no FEM result"):
        field_of_result(box, "", App.Placement())


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"SizeGrading": "Linear", "LambdaEnd": 0.3}, "folds the lattice"),
        ({"SizeGrading": "Linear", "LambdaStart": -1}, "above 0, not -1"),
        ({"SizeGrading": "Formula", "LambdaFormula": "1 +"}, "cannot be read"),
        ({"SizeGrading": "Linear", "GradingDirection": App.Vector()}, "must not be zero"),
        ({"RadiusGrading": "Direction", "RadiusEnd": 8}, "too thick for a cell"),
        ({"RadiusGrading": "Skin", "RadiusReach": 0}, "above 0 mm"),
        ({"RadiusGrading": "Field"}, "choose a FEM result"),
        ({"RadiusGrading": "Field", "RadiusField": "/nowhere/none.csv"}, "none.csv"),
        ({"RadiusGrading": "Field", "RadiusCurve": "1;2"}, "is no pair"),
        ({"CellMap": "Cylindrical", "MapAround": 2}, "whole number from 4"),
        ({"CellMap": "Cylindrical", "MapAxis": App.Vector()}, "must not be zero"),
    ],
)
def test_bad_values_are_told_and_the_last_mesh_stays(doc, infill, values, message):
    before = digest(infill)
    for name, value in values.items():
        setattr(infill, name, value)
    doc.recompute()
    assert not infill.isValid()
    assert message in infill.Status
    assert infill.Status.count(". ") == 0
    assert digest(infill) == before


def test_file_and_result_at_once_are_refused(doc, infill):
    infill.RadiusGrading = "Field"
    infill.RadiusResult = result_of(doc, STRESS)
    infill.RadiusField = "/nowhere/none.csv"
    doc.recompute()
    assert "clear either RadiusField or RadiusResult" in infill.Status


@pytest.mark.costly
def test_saved_and_reopened(doc, box, runs, tmp_path):
    result = result_of(doc, STRESS)
    obj = make_lattice_infill(
        doc, box, **THIN, SizeGrading="Exponential", LambdaEnd=1.3,
        RadiusGrading="Field", RadiusResult=result, RadiusEnd=0.9,
        Orientation=about((0, 1, 1), 15),
    )  # fmt: skip
    doc.recompute()
    assert obj.isValid(), obj.Status
    kept = {name: str(getattr(obj, name)) for name in GRADING if name != "RadiusResult"}
    before, visible = digest(obj), shown(obj)
    path = str(tmp_path / "graded.FCStd")
    doc.saveCopy(path)
    copy = App.openDocument(path)
    try:
        again = copy.getObject(obj.Name)
        assert {name: str(getattr(again, name)) for name in kept} == kept
        assert again.RadiusResult == copy.getObject(result.Name)
        # FreeCAD numbers the nodes of a saved mesh anew.
        assert sorted(again.RadiusResult.Mesh.FemMesh.Nodes) != sorted(result.NodeNumbers)
        assert shown(again) == visible
        assert digest(again) == before
        runs.clear()
        again.touch()
        copy.recompute()
        assert again.isValid(), again.Status
        assert runs == [], "nothing has changed"
        again.SizeGrading = "None"
        assert "LambdaEnd" not in shown(again)
    finally:
        App.closeDocument(copy.Name)


def test_an_older_object_gets_the_gradings(doc, infill, runs):
    for name in GRADING:
        infill.removeProperty(name)
    infill.SchemaVersion = 1
    infill.Proxy.onDocumentRestored(infill)
    assert set(GRADING) <= set(infill.PropertiesList)
    assert shown(infill) == CHOOSERS
    infill.touch()
    doc.recompute()
    assert infill.isValid(), infill.Status
    assert runs == []

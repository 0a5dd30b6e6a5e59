# SPDX-License-Identifier: LGPL-2.1-or-later
"""The lattice infill object: made, edited, driven, undone, saved and reopened."""

import json

import FreeCAD as App
import pytest

from conftest import SMALL
from freecad_volfrep import make_lattice_infill
from freecad_volfrep.features import LatticeInfill
from freecad_volfrep.features.infill import lattice_infill
from freecad_volfrep.features.infill.factory import suggested_sizes
from freecad_volfrep.features.infill.infill_results import loaded
from freecad_volfrep.features.infill.lattice_infill import (
    BEING_MADE,
    CANCELLED,
    CANCELLED_FIRST,
    CHANGED,
    OUT_OF_DATE,
    UP_TO_DATE,
)
from freecad_volfrep.features.infill.properties import (
    PROPERTIES,
    RESULT,
    SCHEMA_VERSION,
    ensure_properties,
)
from freecad_volfrep.features.jobs.job import State
from freecad_volfrep.features.properties.quantities import mass_of, set_value
from volfrep.design.cells import PAPERS
from volfrep.util.errors import Cancelled, VolfrepError


def digest(obj):
    """What tells one mesh from another."""
    return obj.Mesh.CountFacets, round(obj.Mesh.Volume, 3), round(obj.Mesh.Area, 3)


def test_result_is_one_closed_light_solid(infill, box):
    assert infill.State == ["Up-to-date"]
    assert infill.TypeId == "Mesh::FeaturePython"
    assert infill.Mesh.isSolid()
    assert not infill.Mesh.hasNonManifolds()
    assert infill.Watertight
    assert infill.Bodies == 1
    assert 0.3 * box.Shape.Volume < infill.Mesh.Volume < 0.9 * box.Shape.Volume
    assert infill.Volume.Value == pytest.approx(infill.Mesh.Volume, rel=1e-4)
    assert infill.Triangles == infill.Mesh.CountFacets
    assert infill.CellsTotal >= infill.CellsActive > 0
    assert infill.Nodes > 0
    assert infill.Struts > 0
    assert 0 < infill.RelativeDensity < 1
    assert mass_of(infill) == pytest.approx(infill.Volume.Value / 1000)
    assert infill.Seconds > 0
    assert infill.Status == UP_TO_DATE
    for face in ("XMin", "YMin", "ZMin", "XMax", "YMax", "ZMax"):
        outer = getattr(box.Shape.BoundBox, face)
        assert getattr(infill.Mesh.BoundBox, face) == pytest.approx(outer, abs=1e-4)


@pytest.mark.parametrize(
    "cell", ["CVC", *(pytest.param(c, marks=pytest.mark.slow) for c in PAPERS if c != "CVC")]
)
def test_every_cell_of_the_library(doc, box, cell):
    obj = make_lattice_infill(doc, box, CellType=cell, **SMALL)
    doc.recompute()
    assert obj.isValid(), obj.getStatusString()
    assert obj.Mesh.isSolid()
    assert obj.Bodies == 1


def test_properties_are_grouped_and_described(infill):
    units = {"l", "t", "h", "A", "K", "m", "s", "g", "N", "J", "W", "V", "T", "F", "C", "H", "L"}
    for prop in PROPERTIES:
        assert infill.getGroupOfProperty(prop.name) == prop.group
        assert len(infill.getDocumentationOfProperty(prop.name)) > 10
        assert prop.name not in units
    read_only = {p.name for p in PROPERTIES if "ReadOnly" in infill.getTypeOfProperty(p.name)}
    assert read_only == {p.name for p in PROPERTIES if p.group == RESULT}
    hidden = {p.name for p in PROPERTIES if "Hidden" in infill.getTypeOfProperty(p.name)}
    stored = {"SizedNodes", "SizedRadii", "SizedFor", "SizedLoads", "SizedStates", "SizingReport",
              "SizedSkinPoints", "SizedSkin", "SizedLimits", "SizedSkinLimits",
              "Conductivity"}  # fmt: skip
    assert hidden == {"Fingerprint", "SchemaVersion"} | stored


@pytest.mark.costly_cases("JointFillet-0.5", "CellType-BCC", "Resolution-14")
@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("StrutRadius", 0.7),
        ("CellSize", 8),
        ("ShellThickness", 1.5),
        ("ShellThickness", 0),
        ("JointFillet", 0.5),
        ("CellType", "BCC"),
        ("Resolution", 14),
        ("Origin", App.Vector(3, 0, 0)),
        ("Output", "Lattice"),
        ("Output", "Domain"),
    ],
)
def test_editing_a_property_recomputes(doc, infill, runs, name, value):
    before = digest(infill)
    if name == "Origin":
        infill.UseOrigin = True
    setattr(infill, name, value)
    assert "Touched" in infill.State
    doc.recompute()
    assert infill.isValid(), infill.getStatusString()
    assert len(runs) == 1
    assert digest(infill) != before


@pytest.mark.slow
def test_deviation_instead_of_resolution(doc, infill):
    before = infill.Triangles
    infill.Resolution = 0
    infill.Deviation = 0.01
    doc.recompute()
    assert infill.isValid(), infill.getStatusString()
    assert infill.Triangles > before


@pytest.mark.slow
def test_activation_by_centre(doc, box):
    box.Length = 27
    obj = make_lattice_infill(doc, box, Activation="Touching", **SMALL)
    doc.recompute()
    assert obj.isValid(), obj.getStatusString()
    touching = obj.CellsActive
    obj.UseOrigin = True
    obj.Origin = App.Vector(4, 4, 4)
    doc.recompute()
    obj.Activation = "Centre"
    doc.recompute()
    assert obj.isValid(), obj.getStatusString()
    assert 0 < obj.CellsActive < max(obj.CellsTotal, touching)


def test_whole_cells_without_free_ends(doc, box):
    obj = make_lattice_infill(
        doc, box, **{**SMALL, "CellType": "CVC", "ShellThickness": 0, "Boundary": "Whole"}
    )
    doc.recompute()
    assert obj.isValid(), obj.getStatusString()
    struts, loops = obj.Struts, obj.Struts - obj.Nodes + 1
    assert (obj.Genus, obj.DanglingRemoved) == (loops, 0)
    obj.RemoveDangling = True
    doc.recompute()
    assert obj.isValid(), obj.getStatusString()
    assert obj.DanglingRemoved > 0
    assert obj.Struts == struts - obj.DanglingRemoved
    assert obj.Genus == loops == obj.Struts - obj.Nodes + 1


def test_density_changes_the_mass_alone(doc, infill, runs):
    set_value(infill, "Density", 2.7)
    doc.recompute()
    assert mass_of(infill) == pytest.approx(2.7 * infill.Volume.Value / 1000)
    assert runs == []


def test_editing_the_base_recomputes(doc, infill, box, runs):
    before = digest(infill)
    box.Height = 26
    doc.recompute()
    assert infill.isValid(), infill.getStatusString()
    assert len(runs) == 1
    assert digest(infill) != before
    assert infill.Mesh.BoundBox.ZMax == pytest.approx(26, abs=1e-4)


def test_a_change_runs_only_the_stages_it_affects(doc, box, monkeypatch):
    import volfrep.jobs.pipeline

    seen = []
    fill = volfrep.jobs.pipeline.fill

    def watching(*arguments, **options):
        result = fill(*arguments, **options)
        seen.append(result.report.work)
        return result

    monkeypatch.setattr(volfrep.jobs.pipeline, "fill", watching)
    obj = make_lattice_infill(doc, box, **SMALL)
    doc.recompute()
    obj.StrutRadius = 0.8
    doc.recompute()
    assert obj.isValid(), obj.getStatusString()
    first, second = seen
    assert first["walls found"] == 1
    assert "walls found" not in second


def test_nothing_runs_without_a_change(doc, infill, runs):
    infill.touch()
    doc.recompute()
    assert infill.isValid()
    assert runs == []


def test_moving_the_object_keeps_its_mesh_and_place(doc, infill, runs):
    before = digest(infill)
    place = App.Placement(App.Vector(5, 6, 7), App.Rotation(App.Vector(0, 0, 1), 30))
    infill.Placement = place
    doc.recompute()
    assert runs == []
    assert digest(infill) == before
    infill.StrutRadius = 0.8
    doc.recompute()
    assert len(runs) == 1
    assert infill.Placement.Base.isEqual(place.Base, 1e-9)
    assert infill.Placement.Rotation.isSame(place.Rotation, 1e-9)


@pytest.mark.costly
def test_expressions_and_spreadsheets_drive_it(doc, infill, box):
    sheet = doc.addObject("Spreadsheet::Sheet", "Sheet")
    sheet.set("A1", "0.8 mm")
    sheet.setAlias("A1", "radius")
    doc.recompute()
    infill.setExpression("StrutRadius", "Sheet.radius")
    infill.setExpression("CellSize", "Solid.Length / 3")
    doc.recompute()
    assert infill.isValid(), infill.getStatusString()
    assert infill.StrutRadius.Value == 0.8
    assert infill.CellSize.Value == 10
    before = digest(infill)
    sheet.set("A1", "1.1 mm")
    box.Length = 33
    doc.recompute()
    assert infill.isValid(), infill.getStatusString()
    assert (infill.StrutRadius.Value, infill.CellSize.Value) == (1.1, 11)
    assert digest(infill) != before


def test_results_drive_other_objects(doc, infill):
    cube = doc.addObject("Part::Box", "Cube")
    cube.setExpression("Length", f"{infill.Name}.Volume / 1000 mm^2")
    cube.setExpression("Width", f"{infill.Name}.Volume / (100 mm^2)")
    doc.recompute()
    assert cube.Length.Value == pytest.approx(mass_of(infill))
    infill.StrutRadius = 1.3
    doc.recompute()
    assert cube.Length.Value == pytest.approx(mass_of(infill))
    assert cube.Width.Value == pytest.approx(infill.Volume.Value / 100)


def test_undo_and_redo(doc, infill, runs):
    before = digest(infill)
    doc.openTransaction("Thicker")
    infill.StrutRadius = 1.5
    doc.recompute()
    doc.commitTransaction()
    after = digest(infill)
    assert after != before
    assert len(runs) == 1
    doc.undo()
    doc.recompute()
    assert infill.StrutRadius.Value == 1
    assert digest(infill) == before
    doc.redo()
    doc.recompute()
    assert infill.StrutRadius.Value == 1.5
    assert digest(infill) == after
    assert len(runs) == 1, "undo and redo bring the mesh back, they do not compute it"


def test_creation_is_one_undo_step(doc, box):
    doc.openTransaction("Lattice Infill")
    obj = make_lattice_infill(doc, box, **SMALL)
    doc.recompute()
    name = obj.Name
    doc.commitTransaction()
    doc.undo()
    assert doc.getObject(name) is None
    doc.redo()
    doc.recompute()
    assert doc.getObject(name).isValid()
    assert doc.getObject(name).Mesh.CountFacets > 0
    assert isinstance(doc.getObject(name).Proxy, LatticeInfill)


def test_saving_and_reopening_computes_nothing(doc, infill, runs, tmp_path):
    infill.Placement.Base = App.Vector(1, 2, 3)
    doc.recompute()
    before, mass = digest(infill), mass_of(infill)
    path = tmp_path / "part.FCStd"
    doc.saveCopy(str(path))
    name = infill.Name
    copy = App.openDocument(str(path))
    try:
        again = copy.getObject(name)
        assert isinstance(again.Proxy, LatticeInfill)
        assert again.State == ["Up-to-date"]
        assert copy.recompute() == 0
        again.touch()
        copy.recompute()
        assert again.isValid(), again.getStatusString()
        assert runs == []
        assert digest(again) == before
        assert mass_of(again) == pytest.approx(mass)
        assert again.Placement.Base == App.Vector(1, 2, 3)
        again.StrutRadius = 0.8
        copy.recompute()
        assert again.isValid(), again.getStatusString()
        assert len(runs) == 1
        assert digest(again) != before
    finally:
        App.closeDocument(copy.Name)


def test_saved_files_name_the_class_by_its_package():
    assert LatticeInfill.__module__ == "freecad.volfrep.features"
    assert LatticeInfill.__new__(LatticeInfill).dumps() is None


def test_an_older_object_gets_what_it_lacks(doc, infill):
    names = infill.PropertiesList
    infill.removeProperty("JointFillet")
    infill.removeProperty("Seconds")
    infill.SchemaVersion = 0
    infill.Proxy.onDocumentRestored(infill)
    assert sorted(infill.PropertiesList) == sorted(names)
    assert infill.JointFillet.Value == 0
    assert infill.SchemaVersion == SCHEMA_VERSION
    ensure_properties(infill)
    assert sorted(infill.PropertiesList) == sorted(names)
    doc.recompute()
    assert infill.isValid(), infill.getStatusString()


@pytest.mark.costly
def test_without_auto_update_it_waits_for_the_command(doc, infill, runs):
    before = digest(infill)
    infill.AutoUpdate = False
    infill.StrutRadius = 0.8
    doc.recompute()
    assert infill.isValid()
    assert infill.Status == OUT_OF_DATE
    assert digest(infill) == before
    assert runs == []
    assert infill.Proxy.update(infill)
    assert infill.Status == UP_TO_DATE
    assert digest(infill) != before
    assert len(runs) == 1
    infill.StrutRadius = 0.9
    doc.recompute()
    assert infill.Status == OUT_OF_DATE, "the command forces one update only"
    infill.AutoUpdate = True
    doc.recompute()
    assert infill.Status == UP_TO_DATE
    assert len(runs) == 2


def test_custom_cell_from_a_file(doc, infill, tmp_path):
    infill.CellType = "Custom"
    doc.recompute()
    assert not infill.isValid()
    assert "CellFile" in infill.getStatusString()
    path = tmp_path / "pillar.json"
    nodes = [[0.5, 0.5, 0], [0.5, 0.5, 1], [0.5, 0, 0.5], [0.5, 1, 0.5], [0.5, 0.5, 0.5]]
    path.write_text(json.dumps({"nodes": nodes, "struts": [[0, 4], [4, 1], [2, 4], [4, 3]]}))
    infill.CellFile = str(path)
    doc.recompute()
    assert infill.isValid(), infill.getStatusString()
    assert infill.Mesh.isSolid()


def test_two_infills_of_one_solid(doc, infill, box):
    other = make_lattice_infill(doc, box, **{**SMALL, "StrutRadius": 0.8})
    doc.recompute()
    assert infill.isValid()
    assert other.isValid()
    assert digest(other) != digest(infill)


def test_a_copy_works_by_itself(doc, infill, runs):
    copy = doc.copyObject(infill, False)
    doc.recompute()
    assert copy.isValid(), copy.getStatusString()
    assert digest(copy) == digest(infill)
    copy.StrutRadius = 0.8
    doc.recompute()
    assert copy.isValid(), copy.getStatusString()
    assert digest(copy) != digest(infill)


def test_cancelled_keeps_the_last_mesh(doc, infill, monkeypatch):
    before = digest(infill)

    def cancelled_at_once(title, call):
        return call.here(lambda fraction, stage: False)

    with monkeypatch.context() as patch:
        patch.setattr(lattice_infill, "run_call", cancelled_at_once)
        infill.StrutRadius = 0.8
        doc.recompute()
        assert not infill.Proxy.update(infill)
    assert infill.isValid(), "a cancelled job is no error"
    assert infill.Proxy.job.state is State.CANCELLED
    assert infill.Status == CANCELLED
    assert digest(infill) == before
    assert infill.Proxy.update(infill)
    assert infill.Status == UP_TO_DATE
    assert digest(infill) != before
    assert not issubclass(Cancelled, VolfrepError)


def test_cancelled_the_first_time_speaks_of_no_mesh(doc, box, monkeypatch):
    obj = make_lattice_infill(doc, box, **SMALL)
    with monkeypatch.context() as patch:
        patch.setattr(lattice_infill, "run_call", lambda _, call: call.here(lambda *_: False))
        doc.recompute()
    assert obj.Status == CANCELLED_FIRST
    assert not obj.Mesh.CountFacets


def come_of(asked):
    """What has come of a mesh that was asked for."""
    asked.go(State.RUNNING)
    forecast, filled = asked.call.here()
    return forecast, filled, loaded(filled)


@pytest.mark.costly
def test_a_mesh_that_is_made_beside_is_the_one_of_a_recompute(doc, infill):
    infill.StrutRadius = 0.8
    asked = infill.Proxy.begin(infill)
    assert infill.Status == BEING_MADE
    doc.recompute()
    assert infill.Status == BEING_MADE, "a recompute leaves it alone until it is there"
    assert infill.Proxy.arrive(infill, come_of(asked), None)
    assert infill.Status == UP_TO_DATE
    assert "Touched" not in infill.State
    beside = digest(infill)
    infill.StrutRadius = 0.7
    doc.recompute()
    infill.StrutRadius = 0.8
    doc.recompute()
    assert digest(infill) == beside
    assert infill.Proxy.begin(infill) is None, "there is nothing to make"
    infill.StrutRadius = 0.75
    infill.Proxy.begin(infill)
    assert infill.Proxy.update(infill), "who waits gets the mesh"
    assert infill.Status == UP_TO_DATE


@pytest.mark.costly
def test_values_that_change_while_it_is_made_leave_it_touched(doc, infill):
    infill.StrutRadius = 0.8
    asked = infill.Proxy.begin(infill)
    come = come_of(asked)
    infill.StrutRadius = 0.6
    doc.recompute()
    assert infill.Proxy.arrive(infill, come, None)
    made = come[1]
    assert infill.Volume.Value == pytest.approx(made.report.volume_mm3)
    assert infill.Status == CHANGED
    assert "Touched" in infill.State
    doc.recompute()
    assert infill.Status == UP_TO_DATE
    assert infill.Volume.Value < made.report.volume_mm3


def test_what_goes_wrong_beside_keeps_the_mesh_and_says_why(doc, infill):
    before = digest(infill)
    infill.StrutRadius = 0.8
    infill.Proxy.begin(infill)
    assert not infill.Proxy.arrive(infill, None, VolfrepError("The engine's process has ended."))
    assert not infill.isValid()
    assert infill.Status == "The engine's process has ended."
    assert digest(infill) == before
    infill.Proxy.begin(infill)
    assert not infill.Proxy.arrive(infill, None, Cancelled("by the user"))
    assert infill.isValid()
    assert infill.Status == CANCELLED
    assert digest(infill) == before
    infill.CellSize = 0
    assert infill.Proxy.begin(infill) is None
    assert not infill.isValid()


def test_the_factory_refuses_what_there_is_not(doc, box):
    count = len(doc.Objects)
    with pytest.raises(VolfrepError, match="no property 'Radius': choose from Base"):
        make_lattice_infill(doc, box, Radius=1)
    with pytest.raises(VolfrepError, match="CellType cannot be 'Gyrate': choose one of Octahedron"):
        make_lattice_infill(doc, box, CellType="Gyrate")
    with pytest.raises(VolfrepError, match="CellSize cannot be 'large'"):
        make_lattice_infill(doc, box, CellSize="large")
    assert len(doc.Objects) == count
    obj = make_lattice_infill(doc, box, StrutRadius="0.05 cm", Label="Light")
    assert obj.StrutRadius.Value == 0.5
    assert obj.Label == "Light"


@pytest.mark.parametrize(
    ("extent", "cell", "shell"),
    [
        ((10, 10, 10), 2, 0.4),
        ((178.5, 62.5, 108.3), 10, 2),
        ((1000, 800, 400), 100, 20),
        ((300, 300, 12), 10, 2),
        ((900, 10, 10), 5, 2.3),
        ((3, 0.5, 9), 0.2, 0.04),
    ],
)
def test_suggested_sizes_suit_the_part(extent, cell, shell):
    sizes = suggested_sizes(extent)
    assert sizes["CellSize"] == pytest.approx(cell)
    assert sizes["StrutRadius"] == pytest.approx(cell / 10)
    assert sizes["ShellThickness"] == pytest.approx(shell)

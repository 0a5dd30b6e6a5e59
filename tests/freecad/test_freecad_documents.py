# SPDX-License-Identifier: LGPL-2.1-or-later
"""Documents with lattice infills: saved, reopened, copied, undone, broken, of older releases."""

import math
import shutil
from pathlib import Path

import FreeCAD as App
import pytest

from conftest import said_without_packages
from freecad_volfrep import make_lattice_infill, preferences
from freecad_volfrep.features import LatticeInfill
from freecad_volfrep.features.infill import lattice_infill
from freecad_volfrep.features.infill.lattice_infill import LARGE, UP_TO_DATE
from freecad_volfrep.features.infill.properties import PROPERTIES, SCHEMA_VERSION
from freecad_volfrep.features.infill.values import specification_of
from freecad_volfrep.features.properties.migration import RENAMED, TURNED
from freecad_volfrep.features.properties.quantities import density_of, mass_of, set_value, supported
from volfrep.design.grading import CellMap, Orientation, RadiusGrading, SizeGrading
from volfrep.design.profile import Profile
from volfrep.design.spec import LatticeSpec

ROOT = Path(__file__).resolve().parents[2]
FIXTURES = sorted((ROOT / "tests" / "freecad" / "fixtures").glob("*.FCStd"))


def digest(obj):
    """What tells one mesh from another."""
    return obj.Mesh.CountFacets, round(obj.Mesh.Volume, 3), round(obj.Mesh.Area, 3)


@pytest.fixture
def reopened(tmp_path):
    """Opens a copy of a file or of a document, and closes it again."""
    opened = []

    def reopen(source):
        path = tmp_path / f"{len(opened)}.FCStd"
        if isinstance(source, Path):
            shutil.copy(source, path)
        else:
            source.saveCopy(str(path))
        opened.append(App.openDocument(str(path)).Name)
        return App.getDocument(opened[-1])

    yield reopen
    for name in opened:
        App.closeDocument(name)


def test_there_is_a_document_of_every_release():
    import volfrep

    assert [path.stem for path in FIXTURES][-1] == f"infill-{volfrep.__version__}"


@pytest.mark.costly_cases("infill-0.1.0-schema-3")
@pytest.mark.parametrize("path", FIXTURES, ids=lambda path: path.stem)
def test_documents_of_older_releases(path, reopened, runs):
    doc = reopened(path)
    plain, graded = doc.getObjectsByLabel("Plain")[0], doc.getObjectsByLabel("Graded")[0]
    for obj in (plain, graded):
        assert isinstance(obj.Proxy, LatticeInfill)
        assert obj.Mesh.isSolid()
        assert obj.SchemaVersion == SCHEMA_VERSION
        assert {prop.name for prop in PROPERTIES} <= set(obj.PropertiesList)
    before = digest(plain)
    plain.touch()
    doc.recompute()
    assert plain.isValid(), plain.getStatusString()
    # A release may mesh anew what it holds to be different, but not another lattice.
    assert plain.Mesh.Volume == pytest.approx(before[1], rel=0.01)
    doc.Solid.Length = 30
    doc.recompute()
    assert plain.isValid(), plain.getStatusString()
    assert graded.isValid(), graded.getStatusString()
    assert plain.StrutRadius.Value == pytest.approx(1.5), "the expression is still there"
    assert plain.Mesh.BoundBox.XMax == pytest.approx(30)
    assert graded.StrutRadii == pytest.approx([0.8, 1.2], abs=0.01)
    assert runs


SCHEMA_3 = ROOT / "tests" / "freecad" / "fixtures" / "infill-0.1.0-schema-3.FCStd"
#: The infills of that document as the release that wrote it computed them: facets, volume.
WRITTEN = {
    "Plain": (6048, 4798.55054526248),
    "Graded": (12088, 1969.5843253753437),
    "Bound": (10892, 1130.3216073555848),
    "Turned": (3522, 4057.12619012013),
}


@pytest.fixture
def earlier(reopened):
    """The infills of a document before the table of parameters, by their labels."""
    doc = reopened(SCHEMA_3)
    return {label: doc.getObjectsByLabel(label)[0] for label in WRITTEN}


def test_properties_with_other_names_keep_their_values(earlier):
    bound, turned = earlier["Bound"], earlier["Turned"]
    assert (bound.Activation, bound.Boundary, bound.Output) == ("Centre", "Whole", "Lattice")
    assert bound.RadiusProfile == "Quadratic"
    assert (bound.RadiusStart.Value, bound.RadiusEnd.Value) == (0.5, 1.0)
    assert (turned.LambdaStart, turned.LambdaEnd) == (1.0, 1.3)
    turn = turned.Orientation.Rotation
    assert turn.isSame(App.Rotation(App.Vector(1, 0, 1), 25), 1e-12)
    assert turned.UseRotationOrigin
    assert turned.Orientation.Base == App.Vector(3, 4, 5)
    for obj in earlier.values():
        assert not {*RENAMED, *TURNED} & set(obj.PropertiesList)
        groups = {prop.name: prop.group for prop in PROPERTIES}
        assert {name: obj.getGroupOfProperty(name) for name in groups} == groups


@pytest.mark.slow
def test_the_same_lattice_is_computed_again(earlier):
    """Where fewer facets were asked for than struts need, they had lost some of their volume."""
    for label, obj in earlier.items():
        obj.touch()
        obj.Document.recompute()
        assert obj.isValid(), obj.getStatusString()
        facets, volume = WRITTEN[label]
        # The same to the last bit where it was written; elsewhere numpy rounds otherwise.
        asked_for = not any("too coarse" in warning for warning in obj.Warnings)
        if asked_for:
            assert obj.Mesh.CountFacets == pytest.approx(facets, rel=0.01)
        else:
            assert obj.Mesh.CountFacets > facets
        assert obj.Volume.Value == pytest.approx(volume, rel=1e-3 if asked_for else 3e-2)


def test_the_same_specification_is_asked_for(earlier):
    plain = {"cell": "Box", "cell_size": 10, "resolution": 8}
    bound = LatticeSpec(
        **plain, strut_radius=0.8, shell=1.5, activation="centre", boundary="whole",
        output="lattice", density=2.7,
        radius_grading=RadiusGrading("skin", Profile("quadratic", 0.5, 1.0), reach=6.0),
        orientation=Orientation((0, 0, 1), 30.0),
    )  # fmt: skip
    assert specification_of(earlier["Bound"]) == bound
    turned = specification_of(earlier["Turned"])
    assert turned.orientation.origin == (3, 4, 5)
    assert turned.orientation.angle == 25
    assert turned.orientation.axis == pytest.approx((0.5**0.5, 0, 0.5**0.5))
    assert turned.cell_map == CellMap("cylindrical", (1, 2, 3), (0, 0, 1), 8)
    assert turned.size_grading == SizeGrading(Profile("linear", 1.0, 1.3))


def test_a_density_that_lacks_its_unit_is_told(doc, infill):
    infill.Density = 7.85 if supported(infill, "App::PropertyDensity") else 7850.0
    doc.recompute()
    assert "give it with its unit" in infill.Status
    set_value(infill, "Density", 7.85)
    doc.recompute()
    assert infill.isValid(), infill.Status
    assert mass_of(infill) == pytest.approx(7.85e-3 * infill.Volume.Value)


@pytest.mark.slow
def test_expressions_follow_the_names(earlier):
    doc = earlier["Plain"].Document
    doc.recompute()
    doc.Solid.Length, doc.Solid.Width = 30, 24
    doc.recompute()
    bound, turned = earlier["Bound"], earlier["Turned"]
    assert (bound.RadiusStart.Value, bound.RadiusEnd.Value) == pytest.approx((0.75, 1.2))
    assert math.degrees(bound.Orientation.Rotation.Angle) == pytest.approx(45)
    assert density_of(bound) == pytest.approx(2.7)
    assert turned.LambdaEnd == pytest.approx(1.2)
    assert turned.Orientation.Base.x == pytest.approx(4.5)
    doc.Sheet.set("A1", "50")
    doc.recompute()
    # A plain number drives an angle in degrees, as before.
    assert math.degrees(earlier["Graded"].Orientation.Rotation.Angle) == pytest.approx(50)
    assert doc.Other.Length.Value == pytest.approx(12), "of another object"
    assert doc.Sheet.B2.Value == pytest.approx(1.5), "and of a spreadsheet's cell"


@pytest.mark.slow
def test_a_migrated_document_is_saved_and_opened_as_it_is(earlier, reopened, runs):
    doc = earlier["Plain"].Document
    for obj in earlier.values():
        obj.touch()
    doc.recompute()
    runs.clear()
    again = reopened(doc)
    for label, obj in earlier.items():
        copy = again.getObject(obj.Name)
        assert digest(copy) == digest(obj)
        assert sorted(copy.ExpressionEngine) == sorted(obj.ExpressionEngine)
        before = {prop.name: str(getattr(copy, prop.name)) for prop in PROPERTIES}
        copy.Proxy.onDocumentRestored(copy)
        assert {prop.name: str(getattr(copy, prop.name)) for prop in PROPERTIES} == before, label
        copy.touch()
    again.recompute()
    assert runs == [], "nothing has changed"


def test_a_copy_in_another_document_brings_its_solid(infill):
    other = App.newDocument("Other")
    try:
        copy = other.copyObject(infill, True)
        other.recompute()
        assert copy.Document is other
        assert copy.Base.Document is other
        assert copy.isValid(), copy.getStatusString()
        assert digest(copy) == digest(infill)
        copy.Base.Length = 20
        other.recompute()
        assert copy.Mesh.BoundBox.XMax == pytest.approx(20)
        assert infill.Mesh.BoundBox.XMax == pytest.approx(30)
    finally:
        App.closeDocument(other.Name)


@pytest.mark.costly
def test_edits_undone_and_redone(doc, infill, runs):
    radii = [0.62, 0.69, 0.76, 0.83]
    seen = [digest(infill)]
    for radius in radii:
        doc.openTransaction("Radius")
        infill.StrutRadius = radius
        doc.recompute()
        doc.commitTransaction()
        assert infill.isValid(), infill.getStatusString()
        seen.append(digest(infill))
    assert len(set(seen)) == 1 + len(radii)
    count = len(runs)
    for expected in reversed(seen[:-1]):
        doc.undo()
        doc.recompute()
        assert digest(infill) == expected
        assert infill.Status == UP_TO_DATE
    for expected in seen[1:]:
        doc.redo()
        doc.recompute()
        assert digest(infill) == expected
    assert infill.StrutRadius.Value == pytest.approx(radii[-1])
    assert len(runs) == count, "undo and redo bring meshes back, they do not make them"


def test_a_renamed_base_is_the_same_base(doc, box, infill, runs, reopened):
    box.Label = "Renamed"
    doc.recompute()
    assert infill.isValid()
    assert runs == []
    again = reopened(doc).getObject(infill.Name)
    assert again.Base.Label == "Renamed"
    again.touch()
    again.Document.recompute()
    assert again.isValid(), again.getStatusString()
    assert runs == []


def test_without_its_base_a_document_opens_with_the_last_mesh(doc, box, infill, reopened):
    before = digest(infill)
    doc.removeObject(box.Name)
    again = reopened(doc).getObject(infill.Name)
    assert digest(again) == before
    again.touch()
    again.Document.recompute()
    assert not again.isValid()
    assert "Base" in again.getStatusString()
    assert digest(again) == before


def test_without_the_packages_a_document_opens_with_its_mesh(doc, infill, tmp_path):
    """In a FreeCAD whose profile has no packages: open, look, touch, save."""
    file = tmp_path / "part.FCStd"
    doc.saveCopy(str(file))
    lines = said_without_packages(
        tmp_path,
        f"doc = App.openDocument({str(file)!r})\n"
        f"obj = doc.getObject({infill.Name!r})\n"
        "print('OPENED', obj.Mesh.CountFacets, obj.StrutRadius.Value)\n"
        "obj.StrutRadius = 0.7\n"
        "doc.recompute()\n"
        "print('STATUS', obj.isValid(), obj.getStatusString())\n"
        "print('KEPT', obj.Mesh.CountFacets)\n"
        "doc.save()\n",
    )
    assert lines["OPENED"] == f"OPENED {infill.Triangles} 1.0"
    assert lines["STATUS"].startswith("STATUS False VOLFREP needs the Python packages")
    assert lines["KEPT"] == f"KEPT {infill.Triangles}"
    again = App.openDocument(str(file))
    try:
        obj = again.getObject(infill.Name)
        obj.touch()
        again.recompute()
        assert obj.isValid(), obj.getStatusString()
        assert obj.StrutRadius.Value == pytest.approx(0.7)
    finally:
        App.closeDocument(again.Name)


def test_what_a_change_comes_to_is_said_before_it_is_made(doc, infill):
    infill.AutoUpdate = False
    said = infill.Expected
    infill.Resolution = 40
    doc.recompute()
    assert infill.Expected != said
    assert infill.Expected.startswith("about 12 cells, ")


def test_a_large_job_waits_for_the_command(doc, infill, runs, monkeypatch):
    before = digest(infill)
    monkeypatch.setattr(lattice_infill, "largest_automatic", lambda: 1000.0)
    infill.StrutRadius = 0.8
    doc.recompute()
    assert infill.isValid()
    assert infill.Status == LARGE
    assert digest(infill) == before
    assert runs == []
    assert infill.Proxy.update(infill)
    assert infill.Status == UP_TO_DATE
    assert digest(infill) != before


def test_without_a_window_no_job_is_too_large_to_be_made():
    assert not App.GuiUp
    assert preferences.largest_automatic() == float("inf")


def test_a_defect_of_the_engine_is_a_sentence_and_loses_nothing(doc, infill, monkeypatch):
    import volfrep.jobs.pipeline

    before = digest(infill)

    def broken(*_, **__):
        raise ZeroDivisionError("by accident")

    with monkeypatch.context() as patch:
        patch.setattr(volfrep.jobs.pipeline, "fill", broken)
        infill.StrutRadius = 0.8
        doc.recompute()
    assert not infill.isValid()
    assert "ZeroDivisionError (by accident)" in infill.Status
    assert "report" in infill.getStatusString()
    assert digest(infill) == before
    doc.recompute()
    assert infill.isValid(), infill.getStatusString()


def test_strings_from_strangers_are_not_run(doc, box, tmp_path):
    """Every text a document can hold, with code in it: refused, and nothing happens."""
    trap = tmp_path / "trap"
    code = f"__import__('pathlib').Path({str(trap)!r}).touch()"
    settings = [
        {"SizeGrading": "formula", "LambdaFormula": code},
        {"RadiusGrading": "direction", "RadiusProfile": "formula", "RadiusFormula": code},
        {"CellType": "Custom", "CellFile": f"{code}.json"},
        {"RadiusGrading": "field", "RadiusField": f"{code}.csv", "RadiusColumn": code},
    ]
    for values in settings:
        obj = make_lattice_infill(doc, box, CellSize=10, StrutRadius=1, ShellThickness=2)
        for name, value in values.items():
            choices = obj.getEnumerationsOfProperty(name) or []
            match = [choice for choice in choices if choice.lower() == value.lower()]
            setattr(obj, name, match[0] if match else value)
        doc.recompute()
        assert not obj.isValid(), values
        assert not trap.exists()

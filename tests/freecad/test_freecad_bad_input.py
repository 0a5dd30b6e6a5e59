# SPDX-License-Identifier: LGPL-2.1-or-later
"""Bad input: the object turns Invalid, says why in one sentence, and keeps its last mesh."""

import math

import pytest

from conftest import SMALL, said_without_packages
from freecad_volfrep import make_lattice_infill


def assert_refused(obj, *words):
    """The object is Invalid and its status is one sentence that has the words in it."""
    assert not obj.isValid()
    assert "Invalid" in obj.State
    sentence = obj.getStatusString()
    assert sentence == obj.Status
    assert sentence.endswith(".")
    assert "\n" not in sentence
    assert sentence.count(". ") == 0
    assert sentence[0].isupper() or sentence[0] == "'"
    for word in words:
        assert word in sentence


def set_value(name, value):
    return lambda obj: setattr(obj, name, value)


def set_expression(name, expression):
    return lambda obj: obj.setExpression(name, expression)


@pytest.mark.costly_cases("<lambda>-words0")
@pytest.mark.parametrize(
    ("spoil", "words"),
    [
        (set_value("Base", None), ("solid",)),
        (set_value("StrutRadius", 0), ("strut radius", "above 0")),
        (set_value("StrutRadius", math.nan), ("strut radius", "finite")),
        (set_value("StrutRadius", math.inf), ("radius", "e+308")),
        (set_expression("StrutRadius", "-1 mm"), ("strut radius", "-1")),
        (set_value("StrutRadius", 6), ("6 mm", "10 mm", "too thick")),
        (set_value("CellSize", 0), ("cell size",)),
        (set_value("CellSize", math.nan), ("cell size", "finite")),
        (set_value("CellSize", 500), ("500",)),
        (set_expression("ShellThickness", "-2 mm"), ("skin thickness", "-2")),
        (set_value("ShellThickness", math.nan), ("skin thickness", "finite")),
        (set_value("ShellThickness", 15), ("15",)),
        (set_expression("JointFillet", "-1 mm"), ("fillet",)),
        (set_value("Resolution", -3), ("resolution",)),
        (set_value("Resolution", 100000), ("resolution",)),
        (set_value("Deviation", 0.1), ("resolution", "deviation")),
        (set_value("Density", -1), ("density",)),
        (set_value("Density", math.nan), ("density",)),
    ],
)
def test_a_senseless_value_leaves_the_last_mesh(doc, infill, spoil, words):
    before = infill.Mesh.CountFacets, infill.Mesh.Volume
    spoil(infill)
    doc.recompute()
    assert_refused(infill, *words)
    assert (infill.Mesh.CountFacets, infill.Mesh.Volume) == before


def test_a_job_larger_than_memory_is_refused_at_once(doc, infill, box):
    before = infill.Mesh.CountFacets
    box.Length = box.Width = box.Height = 1000
    infill.ShellThickness = 0
    infill.Resolution = 40
    doc.recompute()
    assert_refused(infill, "memory")
    assert infill.Mesh.CountFacets == before


def test_correcting_the_value_makes_it_valid_without_a_run(doc, infill, runs):
    infill.StrutRadius = 6
    doc.recompute()
    assert not infill.isValid()
    infill.StrutRadius = 1
    doc.recompute()
    assert infill.isValid()
    assert runs == []


def test_without_a_base(doc):
    obj = make_lattice_infill(doc, None, **SMALL)
    doc.recompute()
    assert_refused(obj, "Base")
    assert obj.Mesh.CountFacets == 0


def test_a_deleted_base(doc, infill, box):
    before = infill.Mesh.CountFacets
    doc.removeObject(box.Name)
    doc.recompute()
    assert_refused(infill, "Base")
    assert infill.Mesh.CountFacets == before


def test_a_null_shape(doc):
    empty = doc.addObject("Part::Feature", "Empty")
    obj = make_lattice_infill(doc, empty, **SMALL)
    doc.recompute()
    assert_refused(obj, "Empty", "no shape")


def test_a_shape_that_is_no_solid(doc, box):
    face = doc.addObject("Part::Feature", "Face")
    face.Shape = box.Shape.Faces[0]
    obj = make_lattice_infill(doc, face, **SMALL)
    doc.recompute()
    assert_refused(obj, "Face", "without a solid")


def test_an_object_that_has_no_shape_at_all(doc):
    text = doc.addObject("App::TextDocument", "Notes")
    obj = make_lattice_infill(doc, text, **SMALL)
    doc.recompute()
    assert_refused(obj, "Notes")


def test_an_open_mesh(doc):
    import Mesh

    sheet = doc.addObject("Mesh::Feature", "Sheet")
    box = Mesh.createBox(30, 20, 20)
    box.removeFacets([0])
    sheet.Mesh = box
    obj = make_lattice_infill(doc, sheet, **SMALL)
    doc.recompute()
    assert_refused(obj, "Sheet")


def test_an_empty_mesh(doc):
    empty = doc.addObject("Mesh::Feature", "Nothing")
    obj = make_lattice_infill(doc, empty, **SMALL)
    doc.recompute()
    assert_refused(obj, "empty")


def test_missing_packages_say_what_to_install(doc, infill, monkeypatch):
    from freecad_volfrep import engine

    monkeypatch.setattr(engine, "missing_packages", lambda: ["trimesh"])
    before = infill.Mesh.CountFacets
    infill.StrutRadius = 0.8
    doc.recompute()
    assert not infill.isValid()
    assert "trimesh" in infill.getStatusString()
    assert "-m pip install --target" in infill.getStatusString()
    assert infill.Mesh.CountFacets == before


def test_without_manifold3d_parts_are_filled_or_say_what_they_need(tmp_path):
    """The workbench loads, previews and fills; an open face needs it, and says how to get it."""
    lines = said_without_packages(
        tmp_path,
        "from freecad_volfrep import make_lattice_infill\n"
        "doc = App.newDocument('A')\n"
        "box = doc.addObject('Part::Box', 'B')\n"
        "box.Length, box.Width, box.Height = 20, 20, 20\n"
        f"obj = make_lattice_infill(doc, box, **{SMALL})\n"
        "from freecad_volfrep.features.infill.live_preview import LivePreview\n"
        "print('PREVIEW', LivePreview(obj).show().preview.cells)\n"
        "doc.recompute()\n"
        "print('FILLED', obj.isValid(), obj.Mesh.isSolid(), *obj.Warnings)\n"
        "obj.OpenFaces = [(box, ('Face6',))]\n"
        "doc.recompute()\n"
        "print('OPEN', obj.isValid(), obj.getStatusString())\n",
        but_for="manifold3d",
    )
    command = f"-m pip install --target {tmp_path}"
    assert lines["PREVIEW"] == "PREVIEW 8"
    assert lines["FILLED"].startswith("FILLED True True The skin's inner surface has more facets")
    assert command in lines["FILLED"]
    assert "needs the Python package manifold3d" in lines["OPEN"]
    assert command in lines["OPEN"]

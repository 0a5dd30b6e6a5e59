# SPDX-License-Identifier: LGPL-2.1-or-later
"""Faces with a skin of their own, and what is kept solid, picked on the solid."""

import FreeCAD as App
import pytest

from conftest import SMALL, top_of
from freecad_volfrep import make_lattice_infill
from freecad_volfrep.features.infill.picking import pick, unpick
from volfrep.util.errors import VolfrepError


@pytest.fixture
def infill(doc, box):
    box.Placement.Base = App.Vector(5, -3, 2)
    obj = make_lattice_infill(doc, box, **{**SMALL, "Output": "Domain"})
    doc.recompute()
    assert obj.isValid(), obj.getStatusString()
    return obj


def inside(box, infill, top, shell=None):
    """Volume of a box's cavity with another skin on its top, mm3."""
    shell = infill.ShellThickness.Value if shell is None else shell
    size = [box.Length.Value, box.Width.Value, box.Height.Value]
    return (size[0] - 2 * shell) * (size[1] - 2 * shell) * (size[2] - shell - top)


def test_a_face_has_the_skin_it_was_given_and_the_document_keeps_it(doc, box, infill, tmp_path):
    pick(infill, "SkinFaces", box, top_of(box), 4.0)
    doc.recompute()
    assert infill.isValid(), infill.Status
    assert infill.Volume.Value == pytest.approx(inside(box, infill, 4.0), rel=1e-4)
    file = str(tmp_path / "skins.FCStd")
    doc.saveCopy(file)
    again = App.openDocument(file)
    try:
        opened = again.getObject(infill.Name)
        assert list(opened.SkinThicknesses) == [4.0]
        assert [names for _, names in opened.SkinFaces] == [(top_of(again.getObject(box.Name)),)]
        opened.touch()
        again.recompute()
        assert opened.isValid(), opened.Status
    finally:
        App.closeDocument(again.Name)


def test_a_face_is_picked_changed_and_left_again(doc, box, infill):
    pick(infill, "SkinFaces", box, "Face1", 3.0)
    pick(infill, "SkinFaces", box, "Face6", 4.0)
    pick(infill, "SkinFaces", box, "Face1", 1.5)
    assert dict(zip(infill.SkinFaces[0][1], infill.SkinThicknesses, strict=True)) == {
        "Face1": 1.5, "Face6": 4.0,
    }  # fmt: skip
    pick(infill, "SkinFaces", box, "Face6", 4.0)
    assert [names for _, names in infill.SkinFaces] == [("Face1",)]
    assert list(infill.SkinThicknesses) == [1.5]
    unpick(infill, "SkinFaces")
    assert (infill.SkinFaces, list(infill.SkinThicknesses)) == ([], [])
    with pytest.raises(VolfrepError, match="is no face"):
        pick(infill, "SkinFaces", box, "Edge1", 2.0)


@pytest.mark.costly
def test_what_is_kept_solid_is_no_room_of_the_lattice(doc, box, infill):
    pick(infill, "KeepSolidAround", box, top_of(box))
    infill.KeepDistance = 6
    doc.recompute()
    assert infill.Volume.Value == pytest.approx(inside(box, infill, 6.0), rel=1e-4)
    pick(infill, "KeepSolidAround", box, top_of(box))
    assert infill.KeepSolidAround == []
    boss = doc.addObject("Part::Box", "Boss")
    boss.Length, boss.Width, boss.Height = 4, 4, 100
    boss.Placement.Base = box.Shape.BoundBox.Center + App.Vector(-2, -2, -50)
    doc.recompute()
    pick(infill, "KeepSolidAround", boss, "Face1")
    doc.recompute()
    assert infill.isValid(), infill.Status
    whole = inside(box, infill, infill.ShellThickness.Value)
    room = 16 * (box.Height.Value - 2 * infill.ShellThickness.Value)
    assert infill.Volume.Value == pytest.approx(whole - room, rel=1e-4)
    boss.Length = 8  # the infill follows it
    doc.recompute()
    assert infill.Volume.Value == pytest.approx(whole - 2 * room, rel=1e-4)
    with pytest.raises(VolfrepError, match="is no face of the part"):
        pick(infill, "KeepSolidAround", box, "Edge1")


@pytest.mark.costly_but("values2-thickness of a face's skin")
@pytest.mark.parametrize(
    ("values", "said"),
    [
        ({"SkinThicknesses": [1.0, 2.0]}, "SkinFaces holds 1 faces and SkinThicknesses 2 numbers"),
        ({"SkinThicknesses": [900.0]}, "leave nothing to fill"),
        ({"SkinThicknesses": [-1.0]}, "thickness of a face's skin"),
        ({"ShellThickness": 0}, "need a skin that they belong to"),
    ],
)
def test_what_makes_no_sense_is_one_sentence_and_loses_nothing(doc, box, infill, values, said):
    pick(infill, "SkinFaces", box, top_of(box), 4.0)
    doc.recompute()
    before = infill.Mesh.CountFacets
    for name, value in values.items():
        setattr(infill, name, value)
    doc.recompute()
    assert not infill.isValid()
    assert said in infill.Status
    assert infill.Mesh.CountFacets == before
    assert [names for _, names in infill.SkinFaces] == [(top_of(box),)]


def test_a_face_that_is_gone_and_a_body_that_fills_everything_are_told(doc, box, infill):
    before = infill.Mesh.CountFacets
    infill.KeepSolidAround = [(box, ("Face99",))]
    doc.recompute()
    assert "has no face 'Face99' any more" in infill.Status
    assert infill.Mesh.CountFacets == before
    huge = doc.addObject("Part::Box", "Huge")
    huge.Length = huge.Width = huge.Height = 400
    huge.Placement.Base = App.Vector(-200, -200, -200)
    infill.KeepSolidAround = [(huge, ("",))]
    doc.recompute()
    assert "leave nothing to fill" in infill.Status
    assert infill.Mesh.CountFacets == before

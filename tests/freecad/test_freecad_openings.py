# SPDX-License-Identifier: LGPL-2.1-or-later
"""Open faces and drain holes, picked on the solid."""

import FreeCAD as App
import pytest

from conftest import SMALL, top_of
from freecad_volfrep import make_lattice_infill
from freecad_volfrep.features.infill.openings import open_faces


@pytest.fixture
def infill(doc, box):
    box.Placement.Base = App.Vector(5, -3, 2)
    obj = make_lattice_infill(doc, box, **SMALL)
    doc.recompute()
    assert obj.isValid(), obj.getStatusString()
    return obj


@pytest.mark.costly
def test_a_picked_face_is_left_open(doc, box, infill):
    assert infill.Voids == 1
    closed = infill.Volume.Value
    infill.OpenFaces = [(box, (top_of(box),))]
    doc.recompute()
    assert infill.isValid(), infill.getStatusString()
    assert (infill.Voids, infill.Bodies, infill.Watertight) == (0, 1, True)
    assert infill.Volume.Value < closed
    infill.OpenFaces = []
    doc.recompute()
    assert infill.Volume.Value == pytest.approx(closed)


def test_faces_are_found_in_a_moved_group(doc, box, infill):
    infill.OpenFaces = [(box, (top_of(box),))]
    doc.recompute()
    volume = infill.Volume.Value
    part = doc.addObject("App::Part", "Group")
    part.Placement = App.Placement(App.Vector(7, 8, 9), App.Rotation(App.Vector(1, 2, 3), 40))
    part.addObject(box)
    doc.recompute()
    assert infill.isValid(), infill.getStatusString()
    assert infill.Voids == 0
    # The cells lie otherwise in the turned box, so the volume is near, not equal.
    assert infill.Volume.Value == pytest.approx(volume, rel=0.1)


def test_a_hole_is_drilled_in_the_middle_of_a_picked_face(doc, box, infill):
    infill.DrainDiameter = 3
    infill.DrainFaces = [(box, (top_of(box),))]
    doc.recompute()
    assert infill.isValid(), infill.getStatusString()
    (hole,) = infill.DrainHoles
    middle = box.Shape.Faces[int(top_of(box)[4:]) - 1].CenterOfMass
    assert (hole - middle).Length < 1e-6
    assert infill.Voids == 0


def test_holes_are_drilled_at_points_or_at_the_lowest_place(doc, box, infill):
    low = box.Shape.BoundBox
    infill.DrainDiameter = 3
    infill.DrainPoints = [App.Vector(low.Center.x, low.Center.y, low.ZMax)]
    doc.recompute()
    assert infill.isValid(), infill.getStatusString()
    assert infill.DrainHoles[0].z == pytest.approx(low.ZMax)
    infill.DrainPoints = []
    infill.DrainCount = 1
    doc.recompute()
    assert infill.isValid(), infill.getStatusString()
    assert infill.DrainHoles[0].z == pytest.approx(low.ZMin)
    assert infill.Voids == 0


def test_a_face_that_is_no_more_is_named(doc, box, infill):
    infill.OpenFaces = [(box, ("Edge1",))]
    doc.recompute()
    assert not infill.isValid()
    assert "has no face 'Edge1'" in infill.Status


@pytest.mark.slow
def test_picked_faces_are_added_to_those_that_are_open(doc, box, infill):
    top = top_of(box)
    open_faces(infill, [(box, (top,))])
    open_faces(infill, [(box, (top, "Face1"))])
    assert [(owner.Name, names) for owner, names in infill.OpenFaces] == [
        (box.Name, (top, "Face1"))
    ]
    doc.recompute()
    assert infill.isValid(), infill.getStatusString()


@pytest.mark.slow
def test_a_feature_of_a_body_stands_for_it(doc):
    body = doc.addObject("PartDesign::Body", "Body")
    block = doc.addObject("PartDesign::AdditiveBox", "Block")
    body.addObject(block)
    block.Length, block.Width, block.Height = 30, 20, 20
    body.Placement = App.Placement(App.Vector(3, 4, 5), App.Rotation(App.Vector(1, 1, 0), 30))
    doc.recompute()
    obj = make_lattice_infill(doc, body, **SMALL)
    open_faces(obj, [(block, ("Face6",))])
    doc.recompute()
    assert obj.isValid(), obj.getStatusString()
    assert obj.Voids == 0


@pytest.mark.costly
def test_faces_survive_saving(doc, box, infill, tmp_path):
    infill.OpenFaces = [(box, (top_of(box),))]
    infill.DrainDiameter = 2
    infill.DrainCount = 1
    doc.recompute()
    path = str(tmp_path / "open.FCStd")
    doc.saveCopy(path)
    again = App.openDocument(path)
    try:
        obj = again.getObject(infill.Name)
        assert [(o.Name, names) for o, names in obj.OpenFaces] == [(box.Name, (top_of(box),))]
        obj.touch()
        again.recompute()
        assert obj.isValid(), obj.getStatusString()
        assert obj.Voids == 0
    finally:
        App.closeDocument(again.Name)

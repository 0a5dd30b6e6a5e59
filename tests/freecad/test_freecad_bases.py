# SPDX-License-Identifier: LGPL-2.1-or-later
"""What can be filled, and where the result lies."""

import FreeCAD as App
import Mesh
import Part
import pytest

from conftest import SMALL
from freecad_volfrep import make_lattice_infill
from freecad_volfrep.bridge.solids import (
    SolidReader,
    is_fillable,
    mesh_in_document,
    parent_placement,
    resolve_base,
)

SIZE = (30, 20, 20)
BOX = [0, 0, 0, *SIZE]


def extent(mesh):
    """Box of a mesh of the engine's."""
    return pytest.approx([*mesh.bounds[0], *mesh.bounds[1]], abs=1e-4)


def read(base, frame=None):
    return SolidReader().read(base, frame or App.Placement())


def shifted(*by):
    return [c + d for c, d in zip(BOX, by * 2, strict=True)]


def move(obj, *by):
    obj.Placement = App.Placement(App.Vector(*by), App.Rotation())


@pytest.fixture
def body(doc):
    obj = doc.addObject("PartDesign::Body", "Body")
    feature = obj.newObject("PartDesign::AdditiveBox", "Block")
    feature.Length, feature.Width, feature.Height = SIZE
    doc.recompute()
    return obj


@pytest.fixture
def part(doc, body):
    """An App::Part inside another, both moved, with the Body inside."""
    outer = doc.addObject("App::Part", "Outer")
    inner = doc.addObject("App::Part", "Inner")
    outer.addObject(inner)
    inner.addObject(body)
    move(outer, 100, 0, 0)
    move(inner, 0, 50, 0)
    doc.recompute()
    return inner


def test_a_solid_where_it_is(doc, box):
    move(box, 1, 2, 3)
    assert shifted(1, 2, 3) == extent(read(box))


def test_a_turned_solid(doc, box):
    box.Placement = App.Placement(App.Vector(), App.Rotation(App.Vector(0, 0, 1), 90))
    assert extent(read(box)) == [-20, 0, 0, 0, 30, 20]


def test_a_body_and_its_feature(doc, body):
    move(body, 0, 0, 7)
    doc.recompute()
    assert shifted(0, 0, 7) == extent(read(body))
    assert resolve_base(body.Group[0]) is body
    obj = make_lattice_infill(doc, body.Group[0], **SMALL)
    assert obj.Base is body


def test_a_body_inside_parts(doc, part, body):
    move(body, 0, 0, 7)
    doc.recompute()
    assert shifted(100, 50, 7) == extent(read(body))


def test_a_part(doc, part):
    assert shifted(100, 50, 0) == extent(read(part))


def test_links(doc, part, box):
    for target, by in ((box, (0, 0, 9)), (part, (0, 0, 9))):
        link = doc.addObject("App::Link", "Link")
        link.LinkedObject = target
        move(link, 0, 0, 9)
        doc.recompute()
        assert shifted(*by) == extent(read(link))
        assert is_fillable(link)


def test_a_mesh_object_and_a_link_to_it(doc, part):
    obj = doc.addObject("Mesh::Feature", "Scan")
    obj.Mesh = Mesh.createBox(*SIZE)
    move(obj, 15, 10, 10)
    assert list(BOX) == extent(read(obj))
    link = doc.addObject("App::Link", "Link")
    link.LinkedObject = obj
    move(link, 15, 10, 12)
    doc.recompute()
    assert shifted(0, 0, 2) == extent(read(link))
    part.addObject(obj)
    assert shifted(100, 50, 0) == extent(read(obj))


def test_a_part_that_holds_a_mesh(doc):
    part = doc.addObject("App::Part", "Holder")
    obj = doc.addObject("Mesh::Feature", "Scan")
    obj.Mesh = Mesh.createBox(*SIZE)
    move(obj, 15, 10, 10)
    part.addObject(obj)
    move(part, 0, 0, 4)
    doc.recompute()
    assert shifted(0, 0, 4) == extent(read(part))


def test_the_mesh_lies_in_its_own_part(doc, part, body):
    obj = make_lattice_infill(doc, body, **SMALL)
    part.addObject(obj)
    doc.recompute()
    assert obj.isValid(), obj.getStatusString()
    assert list(BOX) == extent(read(body, parent_placement(obj)))
    assert obj.Mesh.BoundBox.XMax == pytest.approx(30, abs=1e-3)
    assert shifted(100, 50, 0) == extent(mesh_in_document(obj))


def test_moving_the_part_around_both_runs_nothing(doc, part, body, runs):
    obj = make_lattice_infill(doc, body, **SMALL)
    part.addObject(obj)
    doc.recompute()
    assert len(runs) == 1
    part.Placement = App.Placement(
        App.Vector(0.1, 33.3, 7.7), App.Rotation(App.Vector(1, 2, 3), 31)
    )
    obj.touch()
    doc.recompute()
    assert obj.isValid(), obj.getStatusString()
    assert len(runs) == 1


@pytest.mark.costly_cases("mesh")
@pytest.mark.parametrize("kind", ["mesh", "link", "part"])
def test_filling_what_is_not_a_plain_solid(doc, part, body, kind):
    if kind == "mesh":
        base = doc.addObject("Mesh::Feature", "Scan")
        base.Mesh = Mesh.createBox(*SIZE)
    elif kind == "link":
        base = doc.addObject("App::Link", "Link")
        base.LinkedObject = body
    else:
        base = part
    doc.recompute()
    obj = make_lattice_infill(doc, base, **SMALL)
    doc.recompute()
    assert obj.isValid(), obj.getStatusString()
    assert obj.Mesh.isSolid()
    assert obj.Bodies == 1


def test_overlapping_solids_are_fused(doc):
    shape = Part.Compound([Part.makeBox(20, 20, 20), Part.makeBox(20, 20, 20, App.Vector(10))])
    obj = doc.addObject("Part::Feature", "Two")
    obj.Shape = shape
    assert read(obj).volume == pytest.approx(30 * 20 * 20)


def test_a_curved_solid_is_meshed_closely(doc):
    obj = doc.addObject("Part::Feature", "Torus")
    obj.Shape = Part.makeTorus(30, 10)
    assert read(obj).volume == pytest.approx(obj.Shape.Volume, rel=3e-3)


@pytest.mark.costly
def test_the_display_does_not_change_the_mesh(doc):
    obj = doc.addObject("Part::Feature", "Torus")
    obj.Shape = Part.makeTorus(30, 10)
    before = len(read(obj).triangles)
    obj.Shape.tessellate(0.02)
    assert len(read(obj).triangles) == before


def test_the_shape_is_meshed_once(doc, box):
    reader = SolidReader()
    first = reader.read(box, App.Placement())
    assert reader.read(box, App.Placement()).triangles is first.triangles
    box.Length = 31
    doc.recompute()
    assert reader.read(box, App.Placement()).bounds[1, 0] == pytest.approx(31)


def test_what_the_command_accepts(doc, part, body, box):
    sketch = doc.addObject("Sketcher::SketchObject", "Sketch")
    empty = doc.addObject("Mesh::Feature", "Nothing")
    null = doc.addObject("Part::Feature", "Null")
    face = doc.addObject("Part::Feature", "Face")
    face.Shape = box.Shape.Faces[0]
    hollow = doc.addObject("App::Part", "Hollow")
    for obj in (part, body, body.Group[0], box):
        assert is_fillable(obj), obj.Label
    for obj in (sketch, empty, null, face, hollow):
        assert not is_fillable(obj), obj.Label


def test_repairs_of_a_mesh_are_told(doc):
    mesh = Mesh.createBox(*SIZE)
    facets = [[tuple(p) for p in facet.Points] for facet in mesh.Facets]
    facets[3] = facets[3][::-1]
    obj = doc.addObject("Mesh::Feature", "Loose")
    obj.Mesh = Mesh.Mesh([corner for facet in facets for corner in facet])
    infill = make_lattice_infill(doc, obj, **SMALL)
    doc.recompute()
    assert infill.isValid(), infill.Status
    assert any("Repaired: " in sentence for sentence in infill.Warnings), infill.Warnings
